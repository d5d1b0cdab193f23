"""Do the C examples work with the standard's own headers too? Then our header promises nothing the standard does not."""

import csv
import io
import os
import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest

from conftest import ROOT, run

STANDARD = Path(fmpy.__file__).parent / "c-code"

HEADERS = pytest.mark.parametrize("headers", ["ours", "the standard's"])


def build(example, headers, library, folder) -> Path:
    """An example, built as strict C99 with what the folder has for the model."""
    if headers != "ours":
        (folder / "ancf14.h").write_text('#include "fmi2Functions.h"\n')
    folders = [folder, ROOT / "include" if headers == "ours" else STANDARD]
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", *(f"-I{one}" for one in folders)]
    program = folder / example
    subprocess.run(["cc", *strict, ROOT / f"c-examples/{example}.c", library, "-lm", "-o", program], check=True)
    return program


@HEADERS
def test_example(fmu, results, warnings, headers, tmp_path):
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(tmp_path / "unit")
    run("header", tmp_path / "unit/resources/model.toml", "--prefix", "MODEL", "-o", tmp_path / "model.h")
    library = next((tmp_path / "unit/binaries/linux64").glob("*.so"))
    program = build("simulate_fmi2", headers, library, tmp_path)
    words = [program, tmp_path / "unit/resources"]
    done = subprocess.run(words, capture_output=True, text=True, check=True, env=os.environ | {"LC_ALL": "C"})
    assert [line.split("] ", 1)[1] for line in done.stderr.splitlines()] == warnings
    header, *rows = csv.reader(io.StringIO(done.stdout))
    with open(results, newline="") as file:
        names, *expected = csv.reader(file)
    order = [header.index(name) for name in names]
    got = np.array([[float(row[place]) for place in order] for row in rows])
    expected = np.array([[float(cell) for cell in row] for row in expected])
    assert np.array_equal(got[:, 1:], expected[:, 1:])


def but_for_accuracy(text):
    """What is said besides that a short run is not accurate."""
    return "".join(line for line in text.splitlines(keepends=True) if "because of the length of the steps" not in line)


@HEADERS
@pytest.mark.parametrize(
    "example, runs", [("save_and_restore", [["state.bin"], ["state.bin", "go-on"]]), ("two_instances", [[]]), ("jacobian", [[]])]
)
def test_example_with_the_arm(example, runs, headers, tmp_path):
    """Each compares its own numbers and fails where they differ."""
    run("pack", ROOT / "c-examples/arm.toml", "-o", tmp_path / "arm.fmu")
    with zipfile.ZipFile(tmp_path / "arm.fmu") as archive:
        archive.extractall(tmp_path / "unit")
    run("header", ROOT / "c-examples/arm.toml", "--prefix", "ARM", "-o", tmp_path / "arm.h")
    program = build(example, headers, next((tmp_path / "unit/binaries/linux64").glob("*.so")), tmp_path)
    for words in runs:
        done = subprocess.run(
            [program, tmp_path / "unit/resources", *words], cwd=tmp_path, capture_output=True, text=True, check=True
        )
        assert done.stdout and not but_for_accuracy(done.stderr)
