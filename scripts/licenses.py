"""Writes the licences of all that is linked: licenses/license.txt for the library of an FMU, for documentation/licenses in it, licenses/program.txt for the
program and the Python package, and licenses/solver.txt for the solver in pages, which have it too.

    target/python-env/bin/python scripts/licenses.py

Crates are those that the packages depend on under Linux and under Windows; of crates without a file of their licence the text is that of
their licence expression.
"""

import json
import re
import subprocess
from pathlib import Path

import ziglang

ROOT = Path(__file__).resolve().parents[1]
# The page, its title, and the packages whose crates it lists.
PAGES = {
    "license.txt": ("the libraries of this unit", ["ancf14", "ancf14-component"]),
    "program.txt": ("the program ancf14 and the Python package", ["ancf14-cli", "ancf14-python"]),
    "solver.txt": ("the solver of this page, which is WebAssembly", ["ancf14-live"]),
}
FILES = re.compile(r"(?i)(licen[sc]e|copying|copyright|notice|unlicense)")
TRIPLES = ["x86_64-unknown-linux-gnu", "x86_64-pc-windows-gnu"]
# The platform of a package that is empty on others.
OTHERS = {"ancf14-component": ["wasm32-unknown-unknown"]}
GRANT = "Permission is hereby granted, free of charge"
LINE = "=" * 100

# What the standard library brings along; its licence is in the texts below, as that of many crates.
STANDARD_LIBRARY = """\
Rust standard library: MIT OR Apache-2.0 (The Rust Project contributors), with the crates addr2line, adler2, cfg-if, compiler_builtins, gimli,
    hashbrown, libc, memchr, miniz_oxide, object, rustc-demangle, std_detect (MIT OR Apache-2.0, or one of both) in it"""

MIT = """\
MIT License

Copyright (c) {holders}

Permission is hereby granted, free of charge, to any person obtaining a copy of this software and associated documentation files (the "Software"),
to deal in the Software without restriction, including without limitation the rights to use, copy, modify, merge, publish, distribute, sublicense,
and/or sell copies of the Software, and to permit persons to whom the Software is furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS
IN THE SOFTWARE.
"""


def cargo(*words) -> str:
    return subprocess.run(["cargo", *words, "--locked"], cwd=ROOT, check=True, capture_output=True, text=True).stdout


def linked(page: str) -> list[dict]:
    """The crates whose code can be in what a page is about, by name and version; compiler plugins stay outside."""
    packages = json.loads(cargo("metadata", "--format-version", "1"))["packages"]
    by_name = {(package["name"], package["version"]): package for package in packages}
    lines = []
    for package in PAGES[page][1]:
        targets = [word for triple in OTHERS.get(package, TRIPLES) for word in ("--target", triple)]
        tree = ["tree", "--package", package, "--edges", "normal,no-proc-macro", *targets, "--prefix", "none", "--format", "{p}"]
        lines += [line.split() for line in cargo(*tree).splitlines() if line]
    found = sorted({(name, version.removeprefix("v")) for name, version, *_ in lines})
    return [by_name[key] for key in found if by_name[key]["source"] is not None]


def clean(text: str) -> str:
    return "\n".join(line.rstrip() for line in text.replace("\r\n", "\n").strip().split("\n")) + "\n"


def texts(package: dict) -> list[str]:
    folder = Path(package["manifest_path"]).parent
    files = sorted(path for path in folder.iterdir() if path.is_file() and FILES.match(path.name))
    found = [clean(path.read_text()) for path in files]
    if re.search(r"(^|OR |/)MIT", package["license"]) and any(GRANT in text for text in found):
        # Of several licences to choose from this one is taken.
        found = [text for text in found if GRANT in text or not re.search("Apache License|UNLICENSE|unlicense", text)]
    elif package["license"] == "MIT":
        found.append(MIT.format(holders=", ".join(package["authors"]) or f"the authors of {package['name']}"))
    if not found:
        raise SystemExit(f"{package['name']} has no licence file")
    return found


def text(page: str) -> str:
    """The text of a page."""
    holders: dict[str, list[str]] = {clean((ROOT / "LICENSE").read_text()): ["ancf14"]}
    lines = ["ancf14: MIT OR Apache-2.0"]
    for package in linked(page):
        name = f"{package['name']} {package['version']}"
        lines.append(f"{name}: {package['license']}")
        for licence in texts(package):
            holders.setdefault(licence, []).append(name)
    lines.append(STANDARD_LIBRARY)
    if page != "program.txt":
        lines.append("    and dlmalloc (MIT OR Apache-2.0)")
    if page != "solver.txt":
        zig = Path(ziglang.__file__).parent
        lines += ["compiler-rt of Zig: MIT", "libunwind of LLVM: Apache-2.0 WITH LLVM-exception"]
        holders.setdefault(clean((zig / "LICENSE").read_text()), []).append("compiler-rt of Zig")
        holders.setdefault(clean((zig / "lib/libunwind/LICENSE.TXT").read_text()), []).append("libunwind of LLVM")
    out = [f"Licences of the software in {PAGES[page][0]}", "", *lines]
    for licence, names in holders.items():
        out += ["", LINE, ", ".join(names), LINE, "", licence.rstrip("\n")]
    return "\n".join(out) + "\n"


if __name__ == "__main__":
    for page in PAGES:
        (ROOT / "licenses" / page).write_text(text(page))
