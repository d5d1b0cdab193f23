"""Do saved states go on with the same bits, also in another process, and are values refused that the model refuses?"""

import pickle
import subprocess
import sys
from pathlib import Path

import ancf14
import numpy as np
import pytest

from conftest import MODELS
from test_runs import PUSHED

GO_ON = """
import pickle, sys
unit = pickle.load(open("unit.pickle", "rb"))
for _ in range(7):
    unit.step(1e-3)
sys.stdout.write(unit["tip.displacement"].tobytes().hex() + " " + unit.time.hex())
"""


def started() -> ancf14.Unit:
    unit = ancf14.Model.from_string(PUSHED).unit()
    unit["steel.density"] = 8000
    unit.initialize()
    for _ in range(9):
        unit.step(1e-3)
    return unit


def test_saved_states_go_on_with_the_same_bits() -> None:
    unit = started()
    saved = unit.state
    Path("unit.pickle").write_bytes(pickle.dumps(unit))
    ends = []
    for _ in range(2):
        for _ in range(7):
            unit.step(1e-3)
        ends.append(unit["tip.displacement"].tobytes().hex() + " " + unit.time.hex())
        unit.state = saved
    other = subprocess.run([sys.executable, "-c", GO_ON], capture_output=True, text=True, check=True)
    assert [*ends, other.stdout] == [ends[0]] * 3
    assert unit.time == 9 * 1e-3


def test_steps_have_the_bits_of_a_run() -> None:
    """The solver chooses the steps of this model, so that a time that is off by round-off would give other bits."""
    model = ancf14.Model.from_string(PUSHED.replace("stop = 0.02, step = 1e-3", "stop = 0.05, output_step = 1e-3"))
    results = model.run({"steel.density": 8000})
    unit = model.unit()
    unit["steel.density"] = 8000
    unit.initialize()
    for row in range(1, 50):
        unit.step(1e-3)
        assert unit.time == pytest.approx(row * 1e-3, rel=1e-15)  # one rounding
        assert unit["tip.displacement"].tobytes() == results["tip.displacement"][row].tobytes()


def test_values_are_read_and_set_by_name() -> None:
    unit = ancf14.Model.from_string(PUSHED).unit()
    unit["push.force"] = [1, 2, 3]
    assert unit["push.force"].tolist() == [1, 2, 3] and unit["push.force[2]"] == 2
    with pytest.raises(ancf14.CallError, match="initialize"):
        unit["tip.displacement"]
    with pytest.raises(ancf14.CallError, match="density"):
        unit["steel.density"] = -1
    assert unit["steel.density"] == 7850
    with pytest.raises(ancf14.VariableError, match="did you mean"):
        unit["steel.densty"] = 1
    with pytest.raises(ancf14.CallError, match=r"\(3,\)"):
        unit["push.force"] = 1
    # That it is a result counts, not its shape.
    for name, value in (("tip.displacement", 1), ("tip.displacement", [1, 2, 3]), ("tip.displacement[1]", 1)):
        with pytest.raises(ancf14.CallError, match="is a result and cannot be set"):
            unit[name] = value
    unit.initialize()
    with pytest.raises(ancf14.CallError, match="before the simulation is initialized"):
        unit["steel.density"] = 8000
    unit.reset()
    assert unit["push.force"].tolist() == [0, 0, 0] and unit.time == 0


def test_states_of_other_models_are_refused() -> None:
    other = ancf14.Model(MODELS / "cantilever.toml").unit().state
    with pytest.raises(ancf14.CallError, match="another model"):
        started().state = other


def test_models_can_be_pickled() -> None:
    model = ancf14.Model.from_string(PUSHED, {"arm.elements": 3})
    same = pickle.loads(pickle.dumps(model))
    assert same.parameters == model.parameters and same.parameters["arm.elements"].value == 3
    assert np.array_equal(same.run()["tip.displacement"], model.run()["tip.displacement"])
