"""Writes the list of all components that a release contains, as CycloneDX 1.5: the crates that are linked into library, program, Python module and solver of pages, the packages in the page, what
compilers add, and the theme of the book; with versions, licences, checksums, and which of them needs which.

    target/python-env/bin/python scripts/components.py FILE.cdx.json

SOURCE_DATE_EPOCH is the time that it states; without it there is none. Crates are those that scripts/licenses.py names; their checksums are those of Cargo.lock and viewer/package-lock.json.
"""

import base64
import importlib.metadata
import json
import os
import re
import sys
import tomllib
from datetime import UTC, datetime
from pathlib import Path

import licenses
from licenses import ROOT, cargo

# What is delivered, and the page of licences that names its crates.
PARTS = {"library": "license.txt", "program and Python module": "program.txt", "solver of pages": "solver.txt"}
OWN = "MIT OR Apache-2.0"


def component(purl: str, name: str, version: str, licence: str, digests: dict[str, str], parts: list[str]) -> dict:
    """A component that is in the named parts."""
    return {
        "type": "library",
        "bom-ref": purl,
        "name": name,
        "version": version,
        # Some crates write the alternative with a stroke.
        "licenses": [{"expression": re.sub(r" *(?<!-)/ *", " OR ", licence)}],
        "hashes": [{"alg": algorithm, "content": digest} for algorithm, digest in digests.items()],
        "purl": purl,
        "properties": [{"name": "ancf14:part", "value": part} for part in parts],
    }


def crates() -> list[dict]:
    """All crates, by name and version."""
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text(encoding="utf-8"))
    checksums = {(package["name"], package["version"]): package.get("checksum") for package in lock["package"]}
    found: dict[tuple[str, str], tuple[str, list[str]]] = {}
    for part, page in PARTS.items():
        for package in licenses.linked(page):
            _, parts = found.setdefault((package["name"], package["version"]), (package["license"], []))
            parts.append(part)
    return [
        component(f"pkg:cargo/{name}@{version}", name, version, licence, {"SHA-256": checksums[name, version]}, parts)
        for (name, version), (licence, parts) in sorted(found.items())
    ]


def in_the_page() -> list[dict]:
    """The packages of npm that viewer/build.mjs bundles."""
    packages = json.loads((ROOT / "viewer/package-lock.json").read_text(encoding="utf-8"))["packages"]
    found = []
    for name in packages[""]["dependencies"]:
        package = packages[f"node_modules/{name}"]
        digest = base64.b64decode(package["integrity"].removeprefix("sha512-")).hex()
        found.append(component(f"pkg:npm/{name}@{package['version']}", name, package["version"], package["license"], {"SHA-512": digest}, ["page"]))
    return found


def of_compilers() -> list[dict]:
    """What Rust and Zig link in addition; their versions are those of the compilers here."""
    rust = re.search(r"^release: (\S+)", cargo("version", "--verbose"), re.MULTILINE)[1]
    zig = importlib.metadata.version("ziglang")
    native = ["library", "program and Python module"]
    return [
        component(f"pkg:generic/rust-std@{rust}", "rust-std", rust, OWN, {}, list(PARTS)),
        component(f"pkg:generic/zig-compiler-rt@{zig}", "zig-compiler-rt", zig, "MIT", {}, native),
        component(f"pkg:generic/llvm-libunwind@{zig}", "llvm-libunwind", zig, "Apache-2.0 WITH LLVM-exception", {}, native),
    ]


def in_the_book() -> list[dict]:
    """The theme, whose scripts and style sheets are in the book."""
    pinned = (ROOT / "scripts/book-requirements.txt").read_text(encoding="utf-8")
    version = re.search(r"^mkdocs-material==(\S+)", pinned, re.MULTILINE)[1]
    return [component(f"pkg:pypi/mkdocs-material@{version}", "mkdocs-material", version, "MIT", {}, ["book"])]


def needs(components: list[dict]) -> list[dict]:
    """Which crate needs which, and what the program itself needs."""
    known = {entry["bom-ref"] for entry in components}
    metadata = json.loads(cargo("metadata", "--format-version", "1"))
    ref = {package["id"]: f"pkg:cargo/{package['name']}@{package['version']}" for package in metadata["packages"]}
    own = {package["id"] for package in metadata["packages"] if package["source"] is None}
    edges: dict[str, set[str]] = {"ancf14": known - {entry for entry in known if entry.startswith("pkg:cargo/")}, **{entry: set() for entry in known}}
    for node in metadata["resolve"]["nodes"]:
        source = "ancf14" if node["id"] in own else ref[node["id"]]
        # A dependency without a kind is linked; others serve builds and tests.
        linked = [dependency["pkg"] for dependency in node["deps"] if any(kind["kind"] is None for kind in dependency["dep_kinds"])]
        if source in edges:
            edges[source] |= {ref[package] for package in linked} & known
    return [{"ref": source, "dependsOn": sorted(targets)} for source, targets in sorted(edges.items())]


def document(time: int | None) -> dict:
    """The whole list; `time` in seconds since 1970."""
    version = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
    components = crates() + in_the_page() + of_compilers() + in_the_book()
    program = {"type": "application", "bom-ref": "ancf14", "name": "ancf14", "version": version, "licenses": [{"expression": OWN}]}
    stated = {} if time is None else {"timestamp": datetime.fromtimestamp(time, UTC).strftime("%Y-%m-%dT%H:%M:%SZ")}
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {**stated, "component": program},
        "components": components,
        "dependencies": needs(components),
    }


if __name__ == "__main__":
    time = os.environ.get("SOURCE_DATE_EPOCH")
    text = json.dumps(document(int(time) if time else None), indent=1)
    Path(sys.argv[1]).write_text(text + "\n", encoding="utf-8")
