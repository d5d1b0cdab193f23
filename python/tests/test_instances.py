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
instance = pickle.load(open("instance.pickle", "rb"))
for _ in range(7):
    instance.step(1e-3)
sys.stdout.write(instance["tip.displacement"].tobytes().hex() + " " + instance.time.hex())
"""


def started() -> ancf14.Instance:
    instance = ancf14.Model.from_string(PUSHED).instance()
    instance["steel.density"] = 8000
    instance.initialize()
    for _ in range(9):
        instance.step(1e-3)
    return instance


def test_saved_states_go_on_with_the_same_bits() -> None:
    instance = started()
    saved = instance.state
    Path("instance.pickle").write_bytes(pickle.dumps(instance))
    ends = []
    for _ in range(2):
        for _ in range(7):
            instance.step(1e-3)
        ends.append(instance["tip.displacement"].tobytes().hex() + " " + instance.time.hex())
        instance.state = saved
    other = subprocess.run([sys.executable, "-c", GO_ON], capture_output=True, text=True, check=True)
    assert [*ends, other.stdout] == [ends[0]] * 3
    assert instance.time == 9 * 1e-3


def test_steps_have_the_bits_of_a_run() -> None:
    """The solver chooses the steps of this model, so that a time that is off by round-off would give other bits."""
    model = ancf14.Model.from_string(PUSHED.replace("stop = 0.02, step = 1e-3", "stop = 0.05, output_step = 1e-3"))
    results = model.run({"steel.density": 8000})
    instance = model.instance()
    instance["steel.density"] = 8000
    instance.initialize()
    for row in range(1, 50):
        instance.step(1e-3)
        assert instance.time == pytest.approx(row * 1e-3, rel=1e-15)  # one rounding
        assert instance["tip.displacement"].tobytes() == results["tip.displacement"][row].tobytes()


def test_values_are_read_and_set_by_name() -> None:
    instance = ancf14.Model.from_string(PUSHED).instance()
    instance["push.force"] = [1, 2, 3]
    assert instance["push.force"].tolist() == [1, 2, 3] and instance["push.force[2]"] == 2
    with pytest.raises(ancf14.CallError, match="initialize"):
        instance["tip.displacement"]
    with pytest.raises(ancf14.CallError, match="density"):
        instance["steel.density"] = -1
    assert instance["steel.density"] == 7850
    with pytest.raises(ancf14.VariableError, match="did you mean"):
        instance["steel.densty"] = 1
    with pytest.raises(ancf14.CallError, match=r"\(3,\)"):
        instance["push.force"] = 1
    # That it is a result counts, not its shape.
    for name, value in (("tip.displacement", 1), ("tip.displacement", [1, 2, 3]), ("tip.displacement[1]", 1)):
        with pytest.raises(ancf14.CallError, match="is a result and cannot be set"):
            instance[name] = value
    instance.initialize()
    with pytest.raises(ancf14.CallError, match="before the simulation is initialized"):
        instance["steel.density"] = 8000
    instance.reset()
    assert instance["push.force"].tolist() == [0, 0, 0] and instance.time == 0


def test_states_of_other_models_are_refused() -> None:
    other = ancf14.Model(MODELS / "cantilever.toml").instance().state
    with pytest.raises(ancf14.CallError, match="another model"):
        started().state = other


def test_models_can_be_pickled() -> None:
    model = ancf14.Model.from_string(PUSHED, {"arm.elements": 3})
    same = pickle.loads(pickle.dumps(model))
    assert same.parameters == model.parameters and same.parameters["arm.elements"].value == 3
    assert np.array_equal(same.run()["tip.displacement"], model.run()["tip.displacement"])
