"""Does a unit packed on one machine run on another, whose sine ends in other bits? The C library has several versions of each function and takes
the one for its processor; GLIBC_TUNABLES makes it believe in an older one."""

import os
import subprocess
import sys

import pytest
from conftest import executable
from fmpy import read_model_description

OLD_PROCESSOR = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"}
PROCESSORS = {"this": {}, "old": OLD_PROCESSOR}

# Numbers at which the versions of some C library differ; each goes into a start value, one through another parameter.
MODEL = """
format = 1
[model]
name = "Sine"
[parameters]
reach = { value = "sin(0.16009323252834995)", unit = "m" }
bend = "tanh(0.994597*0.7)"
power = "1.0731^0.7310058*bend"
[material.steel]
young = "2.1e11*power"
poisson = 0.3
density = 7850
[section.bar]
shape = "circle"
radius = 0.01
[beam.arm]
material = "steel"
section = "bar"
from = [0, 0, 0]
to = ["reach", 0, 0]
elements = 2
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[load.tip]
at = "arm.end"
force = ["exp(0.3*pi)", 0, 0]
input = true
[output.P]
at = "arm.end"
quantities = ["position"]
[simulation]
stop = 3e-3
step = 1e-3
"""


@pytest.fixture(scope="module")
def units(tmp_path_factory):
    """The same file, packed on both."""
    folder = tmp_path_factory.mktemp("machines")
    (folder / "model.toml").write_text(MODEL)
    for name, environment in PROCESSORS.items():
        words = [executable(), "pack", folder / "model.toml", "-o", folder / f"{name}.fmu"]
        subprocess.run(words, check=True, stdout=subprocess.DEVNULL, env=os.environ | environment)
    return folder


def test_regression_one_guid(units):
    guids = {read_model_description(str(units / f"{name}.fmu"), validate=False).guid for name in PROCESSORS}
    assert len(guids) == 1


@pytest.mark.parametrize("packed, runs", [("this", "old"), ("old", "this")])
def test_regression_packed_here_run_there(units, packed, runs):
    program = "import sys; from fmpy import simulate_fmu; print(len(simulate_fmu(sys.argv[1], stop_time=3e-3, output_interval=1e-3)))"
    words = [sys.executable, "-c", program, units / f"{packed}.fmu"]
    done = subprocess.run(words, capture_output=True, text=True, env=os.environ | PROCESSORS[runs])
    said = [line for line in done.stdout.splitlines() if "because of the length of the steps" not in line]
    assert (done.returncode, said) == (0, ["4"]), done.stdout + done.stderr
