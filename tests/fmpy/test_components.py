"""Does the list of components of a release have everything that is in it, with the checksums of the lock files and a licence that is delivered too? A crate that came, went or changed its version would
otherwise be missing from the list, or stand in it with the wrong checksum."""

import base64
import json
import os
import subprocess
import sys
import tomllib

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "scripts"))
import licenses  # noqa: E402

# 2001-09-09 in seconds since 1970.
TIME = "1000000000"


def written(folder, environment):
    path = folder / "list.cdx.json"
    subprocess.run([sys.executable, ROOT / "scripts/components.py", path], check=True, env=environment)
    return path.read_bytes()


@pytest.fixture(scope="module")
def listed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("components")
    first, second = (written(folder, os.environ | {"SOURCE_DATE_EPOCH": TIME}) for _ in range(2))
    assert first == second, "two lists of the same sources differ"
    return json.loads(first)


def checksums() -> dict[str, str]:
    """Checksums of all packages of the lock files, by package URL."""
    crates = tomllib.loads((ROOT / "Cargo.lock").read_text())["package"]
    found = {f"pkg:cargo/{crate['name']}@{crate['version']}": crate["checksum"] for crate in crates if "checksum" in crate}
    for path, package in json.loads((ROOT / "viewer/package-lock.json").read_text())["packages"].items():
        if path and "integrity" in package:
            name = path.rpartition("node_modules/")[2]
            found[f"pkg:npm/{name}@{package['version']}"] = base64.b64decode(package["integrity"].split("-", 1)[1]).hex()
    return found


def test_it_is_a_list_of_this_program(listed):
    version = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]["version"]
    assert (listed["bomFormat"], listed["specVersion"]) == ("CycloneDX", "1.5")
    assert listed["metadata"]["timestamp"] == "2001-09-09T01:46:40Z"
    program = listed["metadata"]["component"]
    assert (program["name"], program["version"]) == ("ancf14", version)


def test_everything_that_is_linked_is_listed(listed):
    refs = [entry["bom-ref"] for entry in listed["components"]]
    assert len(refs) == len(set(refs))
    crates = {f"pkg:cargo/{package['name']}@{package['version']}" for page in licenses.PAGES for package in licenses.linked(page)}
    assert {ref for ref in refs if ref.startswith("pkg:cargo/")} == crates
    dependencies = json.loads((ROOT / "viewer/package.json").read_text())["dependencies"]
    assert {ref for ref in refs if ref.startswith("pkg:npm/")} == {f"pkg:npm/{name}@{version}" for name, version in dependencies.items()}


def test_checksums_are_those_of_the_lock_files(listed):
    known = checksums()
    for entry in listed["components"]:
        digests = [digest["content"] for digest in entry["hashes"]]
        # No lock file has what compilers add, and the theme of the book.
        expected = [] if entry["purl"].startswith(("pkg:generic/", "pkg:pypi/")) else [known[entry["purl"]]]
        assert digests == expected, entry["purl"]


def test_each_licence_is_delivered(listed):
    """The pages of licences name each crate with the licence that the list has."""
    text = "\n".join((ROOT / "licenses" / page).read_text() for page in licenses.PAGES)
    for entry in listed["components"]:
        [licence] = entry["licenses"]
        assert "/" not in licence["expression"]
        if entry["purl"].startswith("pkg:cargo/"):
            lines = [line for line in text.split("\n") if line.startswith(f"{entry['name']} {entry['version']}: ")]
            assert lines and {line.partition(": ")[2].replace(" / ", "/").replace("/", " OR ") for line in lines} == {licence["expression"]}


def test_every_component_is_needed(listed):
    """The dependencies lead from the program to each component, and name nothing that is not listed."""
    needs = {entry["ref"]: entry["dependsOn"] for entry in listed["dependencies"]}
    assert needs.keys() == {"ancf14"} | {entry["bom-ref"] for entry in listed["components"]}
    reached, waiting = set(), ["ancf14"]
    while waiting:
        ref = waiting.pop()
        if ref not in reached:
            reached.add(ref)
            waiting += needs[ref]
    assert reached == needs.keys()
