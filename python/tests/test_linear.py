"""Is a linear system that of the closed form, and do its files have the same numbers?"""

import json
import zipfile
from pathlib import Path

import ancf14
import numpy as np
import pytest
from conftest import MODELS

CANTILEVER = MODELS / "cantilever.toml"

# A mass of 2 kg on a spring of 200 N/m and a damper of 4 N s/m: x'' = -100 x - 2 x' + u/2.
SLIDER = """
format = 1
model = { name = "Slider", gravity = [0, 0, 0] }
body.slider = { mass = 2, position = [0, 0, 0], inertia = [0.1, 0.1, 0.1] }
joint.rail = { type = "prismatic", a = "ground", b = "slider", axis = [1, 0, 0], damping = 4, stiffness = 200 }
load.push = { at = "slider", force = [3, 0, 0], input = true }
output.way = { at = "rail", quantities = ["distance", "distance_rate"] }
simulation = { stop = 1, step = 1e-3 }
"""


def test_matrices_and_poles_are_those_of_the_closed_form() -> None:
    model = ancf14.Model.from_string(SLIDER)
    system = model.linearize(["push.force[1]"], ["way.distance", "way.distance_rate"], at="equilibrium")
    assert system.A == pytest.approx(np.array([[0, 1], [-100, -2]]), abs=1e-12)
    assert system.B == pytest.approx(np.array([[0], [0.5]]), abs=1e-14)
    assert system.C == pytest.approx(np.eye(2), abs=1e-10) and system.D == pytest.approx(np.zeros((2, 1)), abs=1e-15)
    assert system.states == ["slider.position[1]", "slider.position[1].rate"] and system.units["slider.position[1].rate"] == "m/s"
    assert system.u0.tolist() == [3] and system.y0 == pytest.approx([3 / 200, 0], rel=1e-9)
    assert system.poles == pytest.approx([-1 + 1j * np.sqrt(99)], rel=1e-12)
    assert system.damping == pytest.approx([0.1], rel=1e-12) and system.frequencies == pytest.approx([10 / (2 * np.pi)], rel=1e-12)
    assert system.kinds == ["oscillating"]
    # The whole vector, and all outputs.
    assert model.linearize(["push.force"], at="equilibrium").D.shape == (2, 3)


def test_a_state_that_is_no_equilibrium_is_warned_of() -> None:
    with pytest.warns(ancf14.SolverWarning, match="not in equilibrium"):
        ancf14.Model.from_string(SLIDER).linearize()
    with pytest.warns(ancf14.SolverWarning, match="the mechanism moves"):
        assert ancf14.Model.from_string(SLIDER).linearize(at=0.1).time == 0.1


def test_files_have_the_same_numbers(tmp_path: Path) -> None:
    system = ancf14.Model(CANTILEVER).linearize(at="equilibrium")
    archive = np.load(system.save(tmp_path / "m.npz"))
    document = json.loads(system.save(tmp_path / "m.json").read_text())
    loadmat = pytest.importorskip("scipy.io").loadmat
    structure = loadmat(system.save(tmp_path / "m.mat"), simplify_cells=True)["sys"]
    for name in "ABCD":
        own = getattr(system, name)
        assert np.array_equal(archive[name], own), name
        assert np.array_equal(np.array(document[name]).reshape(own.shape), own), name
        assert np.array_equal(np.asarray(structure[name]).reshape(own.shape), own), name
    assert archive["states"].tolist() == document["states"] == list(structure["states"]) == system.states
    assert archive["outputs"].tolist() == system.outputs == list(structure["outputs"])
    found = np.array(document["poles_real"]) + 1j * np.array(document["poles_imag"])
    assert len(found) == len(system.states)
    assert found[0] == system.poles[0] and found[1] == system.poles[0].conjugate()
    with pytest.raises(ancf14.CallError, match="ends in .npz, .mat, .json or .mo"):
        system.save(tmp_path / "m.csv")


def test_python_control_takes_it() -> None:
    control = pytest.importorskip("control")
    system = ancf14.Model.from_string(SLIDER).linearize(["push.force[1]"], ["way.distance"], at="equilibrium")
    own = system.to_control()
    assert own.input_labels == ["push_force[1]"] and own.output_labels == ["way_distance"]
    # At rest the force is that of the spring.
    assert control.dcgain(own) == pytest.approx(1 / 200, rel=1e-9)


def test_mistakes_are_told() -> None:
    model = ancf14.Model.from_string(SLIDER)
    with pytest.raises(ancf14.CallError, match='"start", "equilibrium" or a time'):
        model.linearize(at="rest")
    with pytest.raises(ancf14.CallError, match="a list of names"):
        model.linearize("push.force")
    with pytest.raises(ancf14.RunError, match="no input `pull.force`"):
        model.linearize(["pull.force"])


# A round shaft with a disk at its end, in a bearing that a drive turns.
ROTOR = """
format = 1
model = { name = "Rotor", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 2e-5 }
section.rod = { shape = "circle", radius = 0.01 }
beam.shaft = { material = "steel", section = "rod", from = [0, 0, 0], to = [0.5, 0, 0], elements = 4 }
body.disk = { mass = 5, position = [0.5, 0, 0], inertia = [0.04, 0.022, 0.022] }
joint.bearing = { type = "revolute", a = "ground", b = "shaft.start", axis = [1, 0, 0] }
joint.hub = { type = "weld", a = "shaft.end", b = "disk" }
drive.motor = { joint = "bearing", coordinate = "angle", value = 0 }
load.push = { at = "disk", force = [0, 0, 0], input = true }
output.tip = { at = "disk", quantities = ["position"] }
simulation = { stop = 1, step = 1e-3 }
"""


def test_vibrations_by_speed(tmp_path: Path) -> None:
    model = ancf14.Model.from_string(ROTOR)
    found = model.campbell("motor", np.arange(0, 201, 50), count=2)
    assert found.frame == "fixed" and found.frequencies.shape == found.damping.shape == found.directions.shape == (5, 2)
    assert found.directions[1:].tolist() == [["backward", "forward"]] * 4
    assert np.all(np.diff(found.frequencies[:, 0]) < 0) and np.all(np.diff(found.frequencies[:, 1]) > 0)
    # Each mode is a vibration of the linear system at its speed; damping makes the stiff modes of the shaft fade without one.
    swings = model.linearize(steady=("motor", 100.0)).poles.imag
    assert found.frequencies[2] == pytest.approx(np.sort(swings[swings > 0])[:2] / (2 * np.pi), rel=1e-6)
    forward = [own for own in found.critical_speeds if own.direction == "forward"]
    assert len(forward) == 1 and forward[0].excited_by == "unbalance" and forward[0].mode == 1
    # Damping of the shaft feeds forward whirl from its critical speed on.
    assert found.stability_limit == pytest.approx(forward[0].speed, rel=1e-4)
    assert found.moves == ["shaft.end", "shaft.end"]
    found.save(tmp_path / "c.svg")
    rows = found.save(tmp_path / "c.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) == 11 and (tmp_path / "c.svg").read_text(encoding="utf-8").startswith("<svg")
    with pytest.raises(ancf14.CallError, match="rise from one to the next"):
        model.campbell("motor", [1.0, 0.0])
    with pytest.raises(ancf14.CallError, match="count is at least 1, not 0"):
        model.campbell("motor", [1.0], count=0)
    with pytest.raises(ancf14.Error, match="its drives are: motor"):
        model.campbell("engine", [1.0])
    with pytest.raises(ancf14.CallError, match="has no other state"):
        model.linearize(at="equilibrium", steady=("motor", 1.0))


def test_a_small_fmu_without_an_estimate_is_warned_of(tmp_path: Path) -> None:
    model = ancf14.Model.from_string(ROTOR.replace("gravity = [0, 0, 0]", "gravity = [0, 0, -9.81]"))
    with pytest.warns(ancf14.SolverWarning, match="not in equilibrium"):
        whole = model.linearize(["push.force[3]"], ["tip.position[3]"])
    small = whole.reduce(order=6)
    with pytest.warns(ancf14.SolverWarning, match="has no amplitude_error: the mechanism moves"):
        small.pack(tmp_path / "small.fmu")


def test_reduced_systems(tmp_path: Path) -> None:
    model = ancf14.Model.from_string(ROTOR)
    whole = model.linearize(["push.force[3]"], ["tip.position[3]"])
    small = whole.reduce(error=1e-3)
    assert whole.bound is None and small.bound is not None and small.error is not None
    assert small.error <= small.bound <= 1e-3 and len(small.states) < 10 < len(whole.states)

    def response(system: ancf14.Linearization, omega: float) -> complex:
        return complex((system.C @ np.linalg.solve(1j * omega * np.eye(len(system.A)) - system.A, system.B) + system.D)[0, 0])

    peak = max(abs(response(whole, omega)) for omega in [*np.linspace(1, 200, 400), abs(whole.poles[0].imag)])
    for omega in (0.0, 50.0, 88.0, 300.0):
        assert abs(response(small, omega) - response(whole, omega)) <= 1e-3 * peak
    assert len(whole.reduce(order=4, method="modal").states) == 4
    synthesis = whole.reduce(order=6, method="craig-bampton")
    assert synthesis.states == ["mode[1]", "mode[2]", "static[1]", "mode[1].rate", "mode[2].rate", "static[1].rate"]
    assert synthesis.bound is None and response(synthesis, 0.0) == pytest.approx(response(whole, 0.0), rel=1e-7)
    assert synthesis.A[3:, :3] == pytest.approx(synthesis.A[3:, :3].T, rel=1e-9, abs=1e-6)
    with pytest.raises(ancf14.CallError, match='"modal" or "craig-bampton"'):
        whole.reduce(order=6, method="guyan")
    assert len(np.load(small.save(tmp_path / "small.npz"))["A"]) == len(small.states)
    for fmi, word in [(2, "guid"), (3, "instantiationToken")]:
        with zipfile.ZipFile(small.pack(tmp_path / "small.fmu", fmi=fmi)) as archive:
            assert word in archive.read("modelDescription.xml").decode() and len(archive.read("resources/linear.toml")) > 500
    with pytest.raises(ancf14.CallError, match="ends in .fmu"):
        small.pack(tmp_path / "small.zip")
    with pytest.raises(ancf14.CallError, match="fmi is 2 or 3, not 1"):
        small.pack(tmp_path / "small.fmu", fmi=1)
    with pytest.raises(ancf14.Error, match="reduced already"):
        small.reduce()
    with pytest.raises(ancf14.CallError, match="exclude each other"):
        whole.reduce(error=0.1, order=2)
