"""Does a unit bear what hosts do to it in long studies? Very many simulations in one process, very many loads of its library, many instances in
many threads, a fork, a small stack, and traps: the same bits, no memory lost, and not a word on stdout or stderr."""

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


def unpack(fmu, folder):
    """Unpacks a unit; its description."""
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder / "unit")
    return read_model_description(str(fmu), validate=False)


def ends(description) -> list[str]:
    """The value references of the first input, or -1, and of the first and the last output."""
    reals = [variable for variable in description.modelVariables if variable.type == "Real"]
    inputs = [variable.valueReference for variable in reals if variable.causality == "input"] or [-1]
    outputs = [variable.valueReference for variable in reals if variable.causality == "output"]
    return [str(reference) for reference in (inputs[0], outputs[0], outputs[-1])]


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


# Of a thread, KiB: docs/portability.md promises that the first one is enough, and says that 140 are used, 176 with ropes. Compilers
# differ by some KiB.
LARGE, USUAL, WITH_ROPES = 256, 144, 184


def bears_small_stacks(fmu, folder, least=USUAL):
    description = unpack(fmu, folder)
    program = build("small_stack", folder, library(folder), "-pthread")
    for stack in (LARGE, least):
        words = [description.guid, str(stack), str(description.defaultExperiment.stepSize), *ends(description)]
        assert quiet(program, folder / "unit/resources", *words) == "", f"{stack} KiB"


def test_small_stacks(fmu, tmp_path):
    """Every unit, with derivatives by time and by inputs and a state as bytes, in a thread with the stack that is promised to be enough."""
    bears_small_stacks(fmu, tmp_path, WITH_ROPES if fmu.stem in ("derrick", "belt_drive") else USUAL)


def test_small_stacks_and_a_bushing(tmp_path):
    """The second derivatives of springs between two parts are the largest matrices."""
    run("pack", ROOT / "tests/fmpy/coupling/bushed.toml", "-o", tmp_path / "unit.fmu")
    bears_small_stacks(tmp_path / "unit.fmu", tmp_path)


def survives_traps(fmu, folder):
    description = unpack(fmu, folder)
    program = build("traps", folder, library(folder), "-lm")
    words = [description.guid, str(description.defaultExperiment.stepSize), "3", *ends(description)]
    assert quiet(program, folder / "unit/resources", *words) == ""


def test_traps(fmu, tmp_path):
    """Every unit, with gravity and without, in a host that traps divisions by zero, invalid operations and overflows,
    and rounds upward: the program compares the bits with those of a usual host."""
    survives_traps(fmu, tmp_path)


# The branch of `if` that is not taken is 0/0 at t = 0, the rates of `sqrt(t)` are infinite there, and `exp` overflows
# in the bounds of the load over the run; a correction divides by ranges that are still 0.
EXPRESSIONS = """
format = 1
[model]
name = "Expressions"
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
[section.square]
shape = "rectangle"
width = 0.01
height = 0.01
[beam.arm]
material = "steel"
section = "square"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 2
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[load.tip]
at = "arm.end"
force = [0, "if(t > 0, sin(10*t)/t, 10)", "sqrt(t) + if(t < 0, exp(1e4*(1 + t)), 1)"]
[output.P]
at = "arm.end"
quantities = ["position", "velocity"]
[simulation]
stop = 0.1
step = 1e-3
correction = true
"""


def test_traps_and_expressions(tmp_path):
    """Expressions have values that are not finite, also where nothing asks for them."""
    (tmp_path / "expressions.toml").write_text(EXPRESSIONS)
    run("pack", tmp_path / "expressions.toml", "-o", tmp_path / "unit.fmu")
    survives_traps(tmp_path / "unit.fmu", tmp_path)
