"""Does the small FMU of a reduced mechanism move as the mechanism does, in FMPy, for both versions of the standard? Its files must be valid."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest
import rules
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

from conftest import ROOT, run
from test_description import checked_by_fmutool, complaints, document
from test_rules import description

ARM = """
format = 1
model = { name = "Arm", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3, mass_damping = 0.5 }
section.rod = { shape = "rectangle", width = 0.02, height = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 8 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.push = { at = "arm.end", force = [0, 0, 1], input = true }
output.tip = { at = "arm.end", quantities = ["position", "acceleration"] }
simulation = { initial = "equilibrium", stop = 0.4, step = 2.5e-4, output_step = 1e-3 }
"""
INPUT, OUTPUT = "push.force[3]", "tip.position[3]"


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("small")
    source = folder / "arm.toml"
    source.write_text(ARM)
    run("pack", source, "-o", folder / "full.fmu")
    for fmi in ("2", "3"):
        run("reduce", source, "--inputs", INPUT, "--outputs", "tip.position[3],tip.acceleration[3]", "--error", "0.01%", "--fmi", fmi, "-o", folder / f"small{fmi}.fmu")
    return folder


def simulate(fmu):
    times = np.linspace(0, 0.4, 401)
    push = np.zeros(401, dtype=[("time", float), (INPUT, float)])
    push["time"], push[INPUT] = times, 1 + 12 * (1 - np.cos(30 * times)) / 2
    return simulate_fmu(str(fmu), start_time=0.0, stop_time=0.4, output_interval=1e-3, input=push, output=[OUTPUT], fmi_type="CoSimulation")


def test_it_moves_as_the_mechanism(folder):
    full, small = (simulate(folder / name)[OUTPUT] for name in ("full.fmu", "small2.fmu"))
    moved = np.max(np.abs(full - full[0]))
    assert 0.015 < moved < 0.02
    # The square of the slope, 2.5e-4, and a few 1e-4 more from the reduction and the steps of the mechanism.
    assert np.max(np.abs(small - full)) < 1e-3 * moved


def test_both_versions_are_one(folder):
    two, three = (simulate(folder / f"small{fmi}.fmu")[OUTPUT] for fmi in "23")
    assert np.array_equal(two, three)


def test_it_begins_in_the_state_of_the_mechanism(folder):
    start = {variable.name: variable.start for variable in read_model_description(str(folder / "small2.fmu")).modelVariables}
    assert start[INPUT] == "1.0"
    small, full = (simulate_fmu(str(folder / name), stop_time=0.1, output=[OUTPUT])[OUTPUT] for name in ("small2.fmu", "full.fmu"))
    assert np.ptp(small) == 0 and abs(small[0] - full[0]) < 1e-12


@pytest.mark.parametrize("fmi", ["2", "3"])
def test_its_files_are_valid(folder, fmi):
    small = folder / f"small{fmi}.fmu"
    assert validate_fmu(str(small)) == []
    assert complaints(f"fmi{fmi}/fmi{fmi}ModelDescription.xsd", document(small)) == []
    assert complaints("fmi3/fmi3TerminalsAndIcons.xsd", document(small, "terminalsAndIcons/terminalsAndIcons.xml")) == []
    checked_by_fmutool(small, f"{fmi}.0")


def test_it_keeps_the_rules(folder):
    small = folder / "small2.fmu"
    problems = rules.archive_problems(small.read_bytes()) + rules.description_problems(description(small))
    assert problems == []


def test_the_small_crane_moves_as_the_crane(tmp_path):
    """The example of the page. The crane knows the host's motion at ends of steps only, which leaves 0.24 % with steps of 5 ms, and in proportion with others."""
    specification = importlib.util.spec_from_file_location("small_crane", ROOT / "examples/fmpy/small_crane.py")
    example = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(example)
    full, small = tmp_path / "crane.fmu", tmp_path / "small.fmu"
    run("pack", ROOT / "models/crane.toml", "-o", full)
    run("reduce", ROOT / "models/crane.toml", "--at", "equilibrium", "--order", "20", "--inputs", "foot.position[1]", "--outputs", ",".join(example.OUTPUTS), "-o", small)
    times, position, acceleration = example.motion()
    whole, _ = example.run(str(full), "foot.position[1]", times, position)
    reduced, _ = example.run(str(small), "foot.acceleration[1]", times, acceleration)
    for name in example.OUTPUTS:
        assert np.max(np.abs(reduced[name] - whole[name])) < 0.004 * np.ptp(whole[name]), name
