"""A unit without `simulation.step` chooses its steps: by the same accuracy as the first run of `ancf14 run`, or by the tolerance of the host."""

import csv
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, run
from fmpy import read_model_description, simulate_fmu


@pytest.fixture(scope="module")
def model(tmp_path_factory) -> Path:
    """The cantilever without its step."""
    lines = (ROOT / "models" / "cantilever.toml").read_text().splitlines(keepends=True)
    file = tmp_path_factory.mktemp("chosen_steps") / "cantilever.toml"
    file.write_text("".join(line for line in lines if not line.startswith("step =")))
    run("pack", file, "-o", file.with_suffix(".fmu"))
    return file


def simulate(model, **settings):
    fmu = str(model.with_suffix(".fmu"))
    experiment = read_model_description(fmu).defaultExperiment
    return simulate_fmu(fmu, stop_time=float(experiment.stopTime), output_interval=float(experiment.stepSize), **settings)


def test_same_bits_as_the_command_line(model):
    run("run", model, "--no-refine", "-o", model.parent / "results")
    with open(model.parent / "results" / "results.csv", newline="") as file:
        header, *rows = csv.reader(file)
    result = simulate(model)
    for place, name in enumerate(header[1:], start=1):
        assert np.array_equal(result[name].astype(float), [float(row[place]) for row in rows]), name


def test_a_tolerance_is_the_accuracy(model):
    asked = simulate(model, relative_tolerance=1e-4)
    given = simulate(model, start_values={"simulation.accuracy": 1e-4})
    assert asked.tobytes() == given.tobytes()
    assert asked["statistics.steps"][-1] > 2 * simulate(model, relative_tolerance=1e-3)["statistics.steps"][-1]


def test_the_description_has_the_accuracy(model):
    description = read_model_description(str(model.with_suffix(".fmu")))
    names = [variable.name for variable in description.modelVariables]
    assert "simulation.accuracy" in names and "simulation.step" not in names
    assert float(description.defaultExperiment.tolerance) == 1e-3
