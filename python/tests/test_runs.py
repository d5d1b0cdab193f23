"""Does a run give the numbers of the command line, in the shapes that the pages promise? A wrong order of rows or columns, a lost parameter or another
rounding gives other bytes."""

import csv
import pickle
import subprocess
import sys
import threading
import time
import warnings
from pathlib import Path

import ancf14
import numpy as np
import pytest

from conftest import MODELS, program

PUSHED = """
format = 1
model = { name = "Pushed", gravity = [0, 0, -9.81] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850 }
section.rod = { shape = "circle", radius = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 2 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.push = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["displacement"] }
simulation = { stop = 0.02, step = 1e-3 }
"""
NAMES = sorted(file.stem for file in MODELS.glob("*.toml"))


@pytest.mark.parametrize("name", NAMES)
def test_results_have_the_bits_of_the_command_line(name: str) -> None:
    file = MODELS / f"{name}.toml"
    done = program(Path.cwd(), "run", str(file), "-o", "out", "--set", "simulation.stop=0.05")
    assert done.returncode == 0, done.stderr
    results = ancf14.Model(file).run(stop=0.05)
    with open("out/results.csv", newline="") as table:
        header, *rows = csv.reader(table)
    assert header == ["time", *results.columns]
    numbers = np.array(rows, dtype=float)
    assert numbers[:, 0].tobytes() == results.time.tobytes()
    for place, column in enumerate(results.columns):
        assert numbers[:, place + 1].tobytes() == results[column].tobytes(), column
    results.to_csv("own.csv")
    assert Path("own.csv").read_bytes() == Path("out/results.csv").read_bytes()


def test_arrays_have_the_bits_of_the_table() -> None:
    arguments = ["run", str(MODELS / "crane.toml"), "-o", "out", "--set", "simulation.stop=0.05", "--format", "npz"]
    done = program(Path.cwd(), *arguments)
    assert done.returncode == 0, done.stderr
    first = Path("out/results.npz").read_bytes()
    with open("out/results.csv", newline="") as table:
        header, *rows = csv.reader(table)
    results = ancf14.Model(MODELS / "crane.toml").run(stop=0.05)
    with np.load("out/results.npz") as arrays:
        assert list(arrays["columns"]) == header and sorted(arrays) == sorted([*header, "columns", "units"])
        assert list(arrays["units"]) == ["s", *(results.units[name] for name in results.columns)]
        for place, name in enumerate(header):
            column = np.array([row[place] for row in rows], dtype=arrays[name].dtype)
            assert arrays[name].tobytes() == column.tobytes(), name
        # Counts are whole numbers.
        assert {arrays[name].dtype for name in header} == {np.dtype("<f8"), np.dtype("<i4")}
    assert program(Path.cwd(), *arguments).returncode == 0
    assert Path("out/results.npz").read_bytes() == first


def test_ranges_are_those_of_columns() -> None:
    """The ranges along a beam are the extremes of the columns of the same stations, and means over time: of straight lines from row to row."""
    stations = 'on = "arm", stations = 3, quantities = ["displacement", "twist"]'
    outputs = f'output.all = {{ {stations} }}\noutput.graph = {{ {stations}, summary = "range", from = 0.005 }}\n'
    model = PUSHED.replace("output.tip", outputs + "output.tip")
    results = ancf14.Model.from_string(model).run(inputs={"push.force": [0.0, 3.0, 5.0]})
    counted = results.time >= 0.005
    for quantity in ("displacement", "twist"):
        found, own, time = results.ranges[f"graph.{quantity}"], results[f"all.{quantity}"][counted], results.time[counted]
        assert np.array_equal(found.minimum, own.min(axis=0)) and np.array_equal(found.maximum, own.max(axis=0))
        assert np.array_equal(found.time_of_maximum, time[own.argmax(axis=0)])
        # Sums of 16 numbers, in another order.
        assert np.allclose(found.mean, np.trapezoid(own, time, axis=0) / (time[-1] - time[0]), rtol=0, atol=1e-14)
        assert np.array_equal(found.arc_length, [0, 0.5, 1])
    assert results.ranges["graph.displacement"].unit == "m" and not any(name.startswith("graph.") for name in results.columns)


def test_parameters_are_those_of_set() -> None:
    file = MODELS / "cantilever.toml"
    overrides = ["--set", "arm.elements=3", "--set", "strip.height=0.0051234567890123", "--set", "arm.strain=small"]
    assert program(Path.cwd(), "run", str(file), "-o", "out", *overrides, "--set", "simulation.stop=0.1").returncode == 0
    model = ancf14.Model(file)
    model.run({"arm.elements": np.int64(3), "strip.height": 0.0051234567890123, "arm.strain": "small"}, stop=0.1).to_csv("own.csv")
    assert Path("own.csv").read_bytes() == Path("out/results.csv").read_bytes()


def test_vectors_have_a_row_an_instant() -> None:
    results = ancf14.Model.from_string(PUSHED).run()
    assert results.time.shape == (21,) and results.time[-1] == 0.02
    tip = results["tip.displacement"]
    assert tip.shape == (21, 3)
    assert (tip[:, 2] == results["tip.displacement[3]"]).all() and tip[-1, 2] < 0
    assert results.units["tip.displacement"] == results.units["tip.displacement[3]"] == "m"
    with pytest.raises(ancf14.VariableError, match=r"tip\.displacement"):
        results["tip.displacment"]
    same = pickle.loads(pickle.dumps(results))
    assert same["tip.displacement"].tobytes() == tip.tobytes()


def test_inputs_are_constants_arrays_and_functions() -> None:
    model = ancf14.Model.from_string(PUSHED)
    assert list(model.inputs)[:3] == ["push.force[1]", "push.force[2]", "push.force[3]"]
    function = model.run(inputs={"push.force": lambda t: (0, 0, 100 * t)})
    array = model.run(inputs={"push.force[3]": 100 * function.time})
    assert function["tip.displacement"].tobytes() == array["tip.displacement"].tobytes()
    constant = model.run(inputs={"push.force": (0, 0, 5)})
    assert constant["tip.displacement[3]"][-1] > function["tip.displacement[3]"][-1] > model.run()["tip.displacement[3]"][-1]
    # Step by step, the same input gives the same bits.
    instance = model.instance()
    instance["push.force[3]"] = 0
    instance.initialize()
    for at in function.time[1:]:
        instance.advance(at)
        instance["push.force"] = (0, 0, 100 * at)
    assert instance["tip.displacement"].tobytes() == function["tip.displacement"][-1].tobytes()
    with pytest.raises(ancf14.CallError, match=r"\(21, 3\)"):
        model.run(inputs={"push.force": np.zeros((20, 3))})
    with pytest.raises(ancf14.VariableError, match=r"push\.force"):
        model.run(inputs={"pull.force": 1})


def test_mistakes_are_underlined() -> None:
    with pytest.raises(ancf14.ModelError, match=r"\^") as caught:
        ancf14.Model.from_string(PUSHED.replace("young = 2.1e11", "young = -1"))
    assert caught.value.line == 4 and "model.toml:4:" in str(caught.value)
    with pytest.raises(ancf14.ModelError) as of_file:
        ancf14.Model("nowhere.toml")
    assert of_file.value.line is None and "nowhere.toml" in str(of_file.value)
    with pytest.raises(ancf14.ModelError, match="arm.elments"):
        ancf14.Model.from_string(PUSHED).run({"arm.elments": 2})


def test_warnings_of_the_solver_are_warnings() -> None:
    with pytest.warns(ancf14.SolverWarning, match="young") as told:
        model = ancf14.Model.from_string(PUSHED.replace("young = 2.1e11", "young = 2.1e5"))
    assert told[0].filename == __file__
    assert len(told) == 1 and model.name == "Pushed"


def test_a_coarse_mesh_of_a_motion_is_a_warning() -> None:
    model = ancf14.Model(MODELS / "cantilever.toml")
    with pytest.warns(ancf14.SolverWarning, match="because of the mesh, as estimated from a run with half the elements"):
        model.run({"arm.elements": 4})
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        model.run({"arm.elements": 4}, mesh_error=False)
    assert not any("because of the mesh" in str(warning.message) for warning in told)


def test_a_failed_run_leaves_its_rows() -> None:
    fails = PUSHED.replace("force = [0, 0, 0], input = true", 'force = [0, 0, "sqrt(0.0105-t)"]')
    with pytest.raises(ancf14.RunError) as caught:
        ancf14.Model.from_string(fails).run()
    assert caught.value.results is not None and 0 < len(caught.value.results.time) < 21


def test_other_threads_work_during_a_run() -> None:
    model = ancf14.Model(MODELS / "pendulum.toml")
    run = threading.Thread(target=model.run)
    run.start()
    count = 0
    while run.is_alive():
        time.sleep(1e-3)
        count += 1
    assert count > 20


INTERRUPTED = """
import sys, threading, time, signal, os
import ancf14
model = ancf14.Model(sys.argv[1])
signal.signal(signal.SIGINT, signal.default_int_handler)  # shells ignore it for what runs in the background
threading.Timer(0.7, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
start = time.monotonic()
try:
    model.run({"arm.elements": 60}, stop=1e4, output_step=float(sys.argv[2]))
except ancf14.Interrupted as stopped:
    print(time.monotonic() - start, len(stopped.results.time), stopped.results["tip.displacement"].shape[1])
"""


@pytest.mark.parametrize("output_step", [1e-3, 1e4])
def test_an_interrupted_run_leaves_its_rows(output_step: float) -> None:
    """With an output step of 1e4 s a single row takes minutes."""
    arguments = [sys.executable, "-c", INTERRUPTED, str(MODELS / "cantilever.toml"), str(output_step)]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=60, check=True)
    seconds, rows, axes = done.stdout.split()
    assert float(seconds) < 2 and int(axes) == 3
    assert int(rows) == 1 if output_step > 1 else int(rows) > 10
