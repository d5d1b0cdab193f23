"""Does a host compute the numbers of `ancf14 run`? Bit for bit, also with a ten times larger communication step."""

import csv
import re

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu


def table(path):
    """Header and columns of results.csv."""
    with open(path, newline="") as file:
        header, *rows = csv.reader(file)
    return header, np.array([[float(cell) for cell in row] for row in rows])


def simulate(fmu, step):
    """FMPy's result at every communication point, with the messages of the unit."""
    messages = []
    experiment = read_model_description(str(fmu), validate=False).defaultExperiment
    result = simulate_fmu(
        str(fmu),
        validate=False,  # test_description does
        start_time=0.0,
        stop_time=float(experiment.stopTime),
        output_interval=step,
        fmi_type="CoSimulation",
        logger=lambda _environment, name, status, category, message: messages.append((name, status, category, message)),
    )
    return result, messages


def outputs(fmu):
    """Names of the outputs, in the order of the description."""
    return [v.name for v in read_model_description(str(fmu), validate=False).modelVariables if v.causality == "output"]


def output_step(fmu):
    return float(read_model_description(str(fmu), validate=False).defaultExperiment.stepSize)


def test_columns(fmu, results):
    header, _ = table(results)
    assert header == ["time", *outputs(fmu)]


@pytest.mark.parametrize("times", [1, 10])
def test_same_bits_as_the_command_line(fmu, results, warnings, times):
    header, expected = table(results)
    result, messages = simulate(fmu, times * output_step(fmu))
    if times == 1:
        assert [message.decode() for _name, _status, _category, message in messages] == warnings
    else:  # what is said of the times between which something happens depends on them; errors are told from some 1 %, below which one of 0.9 to 1.2 % may fall
        near = [text for text in warnings if re.search(r"off by about (0\.9\d?|1\.[0-2]) %", text)]
        assert len(warnings) - len(near) <= len(messages) <= len(warnings)
    rows = expected[::times]
    if (len(expected) - 1) % times != 0:  # the last step of the host is a shorter one, to the stop time
        rows = np.vstack([rows, expected[-1]])
    assert np.allclose(result["time"], rows[:, 0], rtol=1e-12, atol=0.0)  # FMPy's own multiples
    for place, name in enumerate(header[1:], start=1):
        if times == 1 or not name.startswith("statistics."):
            assert np.array_equal(result[name].astype(float), rows[:, place]), name


def test_two_runs_in_one_process_agree(fmu):
    first, _ = simulate(fmu, output_step(fmu))
    second, _ = simulate(fmu, output_step(fmu))
    assert first.tobytes() == second.tobytes()
