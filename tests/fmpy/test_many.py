"""Does a unit bear what hosts do to it in long studies? Very many simulations in one process, very many loads of its library, many instances in
many threads, and a fork: the same bits, no memory lost, and not a word on stdout or stderr."""

import subprocess
import sys
import zipfile

import pytest
from conftest import ROOT, run
from fmpy import read_model_description

MODEL = ROOT / "tests/suite/fmi/model.toml"


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("many")
    run("pack", MODEL, "-o", folder / "unit.fmu")
    with zipfile.ZipFile(folder / "unit.fmu") as archive:
        archive.extractall(folder / "unit")
    return folder


def library(packed):
    return next((packed / "unit/binaries/linux64").glob("*.so"))


def build(name, packed, *more):
    """A program of tests/c as strict C99."""
    program = packed / name
    strict = ["-std=c99", "-D_POSIX_C_SOURCE=200809L", "-Wall", "-Wextra", "-Werror", "-pedantic"]
    words = ["cc", *strict, f"-I{ROOT / 'include'}", ROOT / f"tests/c/{name}.c", *more, "-o", program]
    subprocess.run(words, check=True)
    return program


def quiet(*words) -> str:
    """What a program prints that succeeds and says nothing on stderr."""
    done = subprocess.run(words, capture_output=True, text=True)
    assert done.returncode == 0, f"exit code {done.returncode}: {done.stdout[-500:]}{done.stderr[-500:]}"
    assert done.stderr == ""
    return done.stdout


RUNS = """
import sys
from fmpy import read_model_description, simulate_fmu
folder, count = sys.argv[1], int(sys.argv[2])
description = read_model_description(folder)
first = None
for _ in range(count):
    result = simulate_fmu(folder, model_description=description, validate=False, stop_time=0.002, output_interval=1e-3).tobytes()
    first = first or result
    assert result == first
"""


@pytest.mark.parametrize("version", ["2", "3"])
def test_1100_simulations_in_one_process(version, tmp_path):
    """A library that takes a thread key at each load aborts the process after some 1,020 of them."""
    run("pack", MODEL, "--fmi", version, "-o", tmp_path / "unit.fmu")
    with zipfile.ZipFile(tmp_path / "unit.fmu") as archive:
        archive.extractall(tmp_path / "unit")
    said = quiet(sys.executable, "-c", RUNS, tmp_path / "unit", "1100").splitlines()
    assert [line for line in said if "because of the length of the steps" not in line] == []


def test_10000_loads_leave_no_memory_behind(packed):
    """Within 1 MiB from the 1,000th cycle to the 10,000th: nothing of 117 bytes or more is left behind at each."""
    guid = read_model_description(str(packed / "unit.fmu"), validate=False).guid
    program = build("load_cycles", packed, "-ldl")
    few, many = map(int, quiet(program, library(packed), packed / "unit/resources", guid, "1000", "10000").split())
    print(f"{few} KiB, then {many} KiB")
    assert few > 0 and abs(many - few) < 1024


def test_threads_and_forks_compute_the_same_bits(packed):
    """The program compares: 64 instances alone, then by 8 threads, then in a parent and its child."""
    description = read_model_description(str(packed / "unit.fmu"), validate=False)
    references = {variable.name: str(variable.valueReference) for variable in description.modelVariables}
    program = build("threads", packed, library(packed), "-pthread")
    words = [description.guid, references["tip.force[3]"], references["P.position[3]"]]
    assert quiet(program, packed / "unit/resources", *words) == ""


# Of a thread, KiB: docs/portability.md promises that it is enough.
STACK = 256


def test_small_stacks(fmu, tmp_path):
    """Every unit, with derivatives by time and by inputs and a state as bytes, in a thread with the stack that is promised to be enough."""
    description = read_model_description(str(fmu), validate=False)
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(tmp_path / "unit")
    program = build("small_stack", tmp_path, library(tmp_path), "-pthread")
    reals = [variable for variable in description.modelVariables if variable.type == "Real"]
    inputs = [variable.valueReference for variable in reals if variable.causality == "input"] or [-1]
    outputs = [variable.valueReference for variable in reals if variable.causality == "output"]
    words = [description.guid, STACK, description.defaultExperiment.stepSize, inputs[0], outputs[0], outputs[-1]]
    assert quiet(program, tmp_path / "unit/resources", *map(str, words)) == ""
