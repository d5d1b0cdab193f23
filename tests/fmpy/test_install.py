"""Does CMake find what scripts/install.sh installs, by the commands of docs/programming.md, and do the programs run from there?"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import ROOT, executable

PAGE = (ROOT / "docs/programming.md").read_text()
# Of the Python environment, which is not on the path.
CMAKE = Path(sys.executable).parent


@pytest.fixture(scope="module")
def prefix(tmp_path_factory) -> Path:
    prefix = tmp_path_factory.mktemp("install") / "ancf14"
    build = {"ANCF14_BUILD": str(executable().resolve().parent)}
    subprocess.run(["sh", ROOT / "scripts/install.sh", prefix], check=True, env=os.environ | build)
    return prefix


def shell(line, prefix, folder) -> str:
    """What a line of the page prints, in a folder of its own beside the examples."""
    for name in ["c-examples", "models"]:
        if not (folder / name).exists():
            (folder / name).symlink_to(ROOT / name)
    environment = os.environ | {"PREFIX": str(prefix), "PATH": f"{CMAKE}:{os.environ['PATH']}"}
    return subprocess.run(["sh", "-c", line], cwd=folder, env=environment, capture_output=True, text=True, check=True).stdout


def test_cmake_builds_the_examples(prefix, tmp_path):
    lines = re.findall(r"^cmake .*$", PAGE, re.MULTILINE)
    assert len(lines) == 2
    for line in lines:
        shell(line, prefix, tmp_path)
    for program in ["./simulate c-examples/arm.toml", './simulate_cpp c-examples/arm.toml "tip.position[3]"']:
        expected = PAGE.split(f"\n{program}\n")[1].split("```text\n")[1].split("```")[0]
        assert shell(f"build/{program}", prefix, tmp_path) == expected


@pytest.mark.parametrize("wanted, is_found", [("", True), ("0.1", True), ("0.2", False), ("1.0", False)])
def test_cmake_compares_versions(wanted, is_found, prefix, tmp_path):
    script = f'cmake_minimum_required(VERSION 3.16)\nproject(x C)\nfind_package(ancf14 {wanted} QUIET)\nmessage(STATUS "found ${{ancf14_FOUND}}")\n'
    (tmp_path / "CMakeLists.txt").write_text(script)
    said = shell('cmake -S . -B build -D CMAKE_PREFIX_PATH="$PREFIX"', prefix, tmp_path)
    assert f"found {int(is_found)}" in said
