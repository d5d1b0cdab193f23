"""Does a number set by a host mean the same as in the file? Parameters, counts and inputs, against `ancf14 run --set`."""

import csv

import numpy as np
import pytest
from conftest import ROOT, run
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave

CASES = {
    "parameters": ("models/cantilever.toml", {"steel.young": 1.1e11, "arm.elements": 4, "gravity[2]": 3.0, "simulation.step": 2.5e-3}),
    "inputs": ("tests/suite/fmi/model.toml", {"tip.force[3]": -7.5, "tip.moment[2]": 0.25, "young": 1.9e11}),
}


@pytest.mark.parametrize("case", CASES)
def test_set_by_the_host(case, tmp_path):
    model, values = CASES[case]
    run("pack", ROOT / model, "-o", tmp_path / "unit.fmu")
    changes = [word for name, value in values.items() for word in ("--set", f"{name}={value!r}")]
    run("run", ROOT / model, "--out", tmp_path / "results", *changes)
    run("run", ROOT / model, "--out", tmp_path / "unchanged")
    tables = []
    for folder in ("results", "unchanged"):
        with open(tmp_path / folder / "results.csv", newline="") as file:
            names, *rows = csv.reader(file)
        tables.append(np.array([[float(cell) for cell in row] for row in rows]))
    expected, unchanged = tables
    assert not np.array_equal(expected, unchanged)
    result = simulate_fmu(
        str(tmp_path / "unit.fmu"),
        start_values=values,
        stop_time=expected[-1, 0],
        output_interval=expected[1, 0],
        fmi_type="CoSimulation",
    )
    for place, name in enumerate(names[1:], start=1):
        assert np.array_equal(result[name].astype(float), expected[:, place]), name


def test_input_that_changes(tmp_path):
    """A force that the host changes at every communication point is held over the step: the beam of the file, with the same
    force written as a piecewise constant expression, moves the same. (Internal steps end at the communication points.)"""
    text = (ROOT / "tests/suite/fmi/model.toml").read_text()
    (tmp_path / "input.toml").write_text(text)
    pieces = ", ".join(f'{{ until = {0.01 * k!r}, is = "{-k}" }}' for k in range(1, 10))
    force = f'[0, 0, [{pieces}, {{ is = "-10" }}]]'
    (tmp_path / "expression.toml").write_text(
        text.replace("force = [0.0, 0.0, 0.0]", f"force = {force}").replace("input = true", "")
    )
    run("pack", tmp_path / "input.toml", "-o", tmp_path / "unit.fmu")
    run("run", tmp_path / "expression.toml", "--out", tmp_path / "results")
    with open(tmp_path / "results/results.csv", newline="") as file:
        names, *rows = csv.reader(file)
    expected = np.array([[float(cell) for cell in row] for row in rows])
    times = 0.01 * np.arange(10)
    signal = np.array([(t, -(k + 1.0)) for k, t in enumerate(times)], dtype=[("time", float), ("tip.force[3]", float)])
    # FMPy interpolates between samples: two at each change make it a staircase.
    doubled = np.repeat(signal, 2)[1:]
    doubled["tip.force[3]"] = np.repeat(signal["tip.force[3]"], 2)[:-1]
    result = simulate_fmu(
        str(tmp_path / "unit.fmu"), input=doubled, stop_time=0.1, output_interval=0.01, fmi_type="CoSimulation"
    )
    place = names.index("P.position[3]")
    assert abs(expected[-1, place]) > 1e-4
    # The staircase's values are exact, its times carry round-off: the same bits, or at most the last ones differ.
    assert np.allclose(result["P.position[3]"], expected[:, place], rtol=0.0, atol=1e-13)


def test_frame_that_the_host_moves(tmp_path):
    """The foot of the crane, moved by FMPy with values and derivatives, goes the way that an expression takes it: a cubic in each communication
    step, whose velocities at the ends follow from the mean velocities of this step and the one before."""
    model = ROOT / "models/crane.toml"
    run("pack", model, "-o", tmp_path / "unit.fmu")
    # Mean velocity 0.5 m/s from 0.1 to 1.1 s. In the step after each of the two changes the velocity at the end is `s + (s - s')/2`.
    cubic = "{x} + {h}*({v}*u*(1 - u)^2 + {s}*u^2*(3 - 2*u) - {w}*u^2*(1 - u))"
    starts = [(0.1, 0.0, 0.0, 0.75, 0.5), (0.12, 0.01, 0.75, 0.5, 0.5), (1.1, 0.5, 0.5, -0.25, 0.0), (1.12, 0.5, -0.25, 0.0, 0.0)]
    curves = [cubic.format(x=x, h=0.02, v=v, w=w, s=s).replace("u", f"((t - {t})/0.02)") for t, x, v, w, s in starts]
    ends = [0.1, 0.12, 0.14, 1.1, 1.12, 1.14]
    ways = ["0", curves[0], curves[1], "0.5*(t - 0.1)", curves[2], curves[3]]
    pieces = ", ".join(f'{{ until = {end}, is = "{way}" }}' for end, way in zip(ends, ways)) + ', { is = "0.5" }'
    pieces = f"[{pieces}]"
    motion = ["--set", "foot.input=false", "--set", f"foot.position[1]={pieces}", "--set", "simulation.stop=2"]
    run("run", model, "--out", tmp_path / "results", *motion)
    with open(tmp_path / "results/results.csv", newline="") as file:
        names, *rows = csv.reader(file)
    expected = np.array([[float(cell) for cell in row] for row in rows])
    path = str(tmp_path / "unit.fmu")
    description = read_model_description(path)
    reference = {variable.name: variable.valueReference for variable in description.modelVariables}
    watched = ("load_motion.position[1]", "boom_tip.position[3]", "drive_load.position[1]")
    # By hand: FMPy's own loop with derivatives works for exactly nine inputs.
    unit = FMU2Slave(
        guid=description.guid,
        unzipDirectory=extract(path, tmp_path / "unit"),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    unit.instantiate()
    unit.setupExperiment(startTime=0.0)
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    rows = [unit.getReal([reference[name] for name in watched])]
    foot = [reference["foot.position[1]"]]
    for k in range(100):
        time = 0.02 * k
        unit.setReal(foot, [float(np.interp(time, [0.1, 1.1], [0.0, 0.5]))])
        unit.setRealInputDerivatives(foot, [1], [0.5 if 0.1 <= time + 1e-9 and time < 1.1 - 1e-9 else 0.0])
        unit.doStep(time, 0.02)
        rows.append(unit.getReal([reference[name] for name in watched]))
    unit.terminate()
    unit.freeInstance()
    for column, name in zip(np.array(rows).T, watched):
        place = names.index(name)
        assert np.ptp(expected[:, place]) > 1e-3, "it moves"
        # Places at the ends of internal steps carry round-off: 1e-16 s times 0.5 m/s, in steps of 5 ms.
        assert np.allclose(column, expected[:, place], rtol=0.0, atol=1e-9), name
