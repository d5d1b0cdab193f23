"""Does the C example work with the standard's own headers too? Then our header promises nothing the standard does not."""

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


@pytest.mark.parametrize("headers", ["ours", "the standard's"])
def test_example(fmu, results, warnings, headers, tmp_path):
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(tmp_path / "unit")
    run("header", tmp_path / "unit/resources/model.toml", "--prefix", "MODEL", "-o", tmp_path / "model.h")
    if headers != "ours":
        (tmp_path / "ancf14.h").write_text('#include "fmi2Functions.h"\n')
    library = next((tmp_path / "unit/binaries/linux64").glob("*.so"))
    folders = [tmp_path, ROOT / "include" if headers == "ours" else STANDARD]
    program = tmp_path / "simulate"
    strict = ["-std=c99", "-Wall", "-Wextra", "-Werror", *(f"-I{folder}" for folder in folders)]
    subprocess.run(["cc", *strict, ROOT / "c-examples/simulate.c", library, "-o", program], check=True)
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
