"""Does CasADi find a better motion of the crane's foot through the adjoint derivatives of the unit? The program of examples/casadi, with its figures."""

import importlib.util

import casadi
import numpy as np
import pytest
from conftest import ROOT, run
from fmpy import extract

PROGRAM = ROOT / "examples/casadi/crane.py"


@pytest.fixture(scope="module")
def crane():
    specification = importlib.util.spec_from_file_location("crane", PROGRAM)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def packed(tmp_path_factory):
    path = tmp_path_factory.mktemp("casadi") / "crane.fmu"
    run("pack", ROOT / "models/crane.toml", "--fmi", "3", "-o", path)
    return str(path)


def test_the_gradient_is_that_of_repeated_steps(crane, packed):
    """The load moves with the foot by 3 % in a step: differences over 2 mm leave out less than 1e-6 of that, and Newton's tolerance less than 1e-8."""
    unit = crane.Crane(packed)
    for foot in [0.1, 0.25]:
        unit.step([foot, 0, 0])
        unit.accept()
    seed, near = np.array([1.0, 0.2, -0.3, 0.7, 0.1, 0.4]), np.array([0.4, 0.05, 0.0])
    differences = []
    for axis in np.eye(3):
        ends = []
        for side in [-1e-3, 1e-3]:
            unit.step(near + side * axis)
            ends.append(seed @ unit.read())
        differences.append((ends[1] - ends[0]) / 2e-3)
    unit.step(near)
    assert np.array(unit.gradient(seed)) == pytest.approx(differences, rel=1e-5, abs=1e-5 * np.abs(differences).max())
    unit.close()


def test_the_load_swings_less(crane, packed):
    """A ramp of 3 s excites the swing of 3.7 s; the optimized motion takes most of it away, with a few trials a step."""
    ramp, optimized = crane.ramped(packed), crane.optimized(packed)
    print(f"CasADi: swing {crane.swing(ramp):.3f} m along a ramp, {crane.swing(optimized):.3f} m optimized")
    assert abs(optimized[-1, 1] - crane.TRAVEL) < 0.05
    assert crane.swing(optimized) < 0.15 * crane.swing(ramp)


def test_casadi_reads_the_description(packed, tmp_path):
    """CasADi stopped at initial unknowns that do not list what they depend on. It now reads all of the description,
    and then refuses what is no model exchange: its importer has no units of co-simulation, for which the program
    above has its own."""
    with pytest.raises(RuntimeError, match="FMU must be of ModelExchange type"):
        casadi.DaeBuilder("crane", str(extract(packed, tmp_path)))
