"""Do two units, coupled by a master, move as the same machine written in one model file?

An arm (force in, motion out) and a forearm with a weight (motion in, force out), twice:

- welded together. The master repeats every step, by the units' saved states, until the force that goes in is the reaction that
  comes out. The forearm is heavy: simple repetition multiplies the mismatch by some -10 and never ends, so the master solves by
  Newton's method with a Jacobian from the units' directional derivatives, kept and corrected by Broyden's formula.
- held by a bushing, which needs no repetition: the master hands over values once a step. The force is held during the step, or goes on
  along the slope of the last step.
"""

import csv
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, run
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

MODELS = ROOT / "tests/fmpy/coupling"
# Of what is compared: the ends of arm and weight.
PLACES = [f"{place}.position[{i}]" for place in ("arm_end", "weight_motion") for i in (1, 2, 3)]


class Unit:
    """An initialized instance of a packed model."""

    def __init__(self, model: str, folder: Path, step: float):
        path = folder / f"{model}.fmu"
        unpacked = folder / f"unit-{model}"
        if not path.exists():
            run("pack", MODELS / f"{model}.toml", "-o", path)
            extract(str(path), unpacked)
        description = read_model_description(str(path), validate=False)
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=unpacked,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=model,
        )
        self.slave.instantiate()
        self.slave.setupExperiment(startTime=0.0)
        self.set(["simulation.step"], [step])
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def get(self, names) -> np.ndarray:
        return np.array(self.slave.getReal([self.references[name] for name in names]))

    def set(self, names, values):
        self.slave.setReal([self.references[name] for name in names], [float(value) for value in values])

    def set_slopes(self, names, slopes):
        references = [self.references[name] for name in names]
        self.slave.setRealInputDerivatives(references, [1] * len(references), [float(slope) for slope in slopes])

    def rates(self, names) -> list[float]:
        """Derivatives of outputs with respect to time."""
        references = [self.references[name] for name in names]
        return self.slave.getRealOutputDerivatives(references, [1] * len(references))

    def derivatives(self, outputs, inputs) -> np.ndarray:
        """Derivatives of outputs at the end of the last step with respect to its inputs."""
        unknowns = [self.references[name] for name in outputs]
        columns = [self.slave.getDirectionalDerivative(unknowns, [self.references[name]], [1.0]) for name in inputs]
        return np.column_stack(columns)

    def close(self):
        self.slave.terminate()
        self.slave.freeInstance()


# Internal step with the bushing, s. A load acts at the end of an internal step: what is held lags by (H + h)/2, not H/2.
INTERNAL = 2.5e-4


def components(name, count):
    return [f"{name}[{i + 1}]" for i in range(count)]


WRENCH = components("tip.force", 3) + components("tip.moment", 3)
ARM_POSE = components("arm_end.position", 3) + components("arm_end.quaternion", 4)
HAND_POSE = components("hand.position", 3) + components("hand.quaternion", 4)
HAND_LOAD = components("hand_load.applied_force", 3) + components("hand_load.applied_moment", 3)
# Plain connections, from output to input: no factor, no third unit between.
CONNECTIONS = [*zip(ARM_POSE, HAND_POSE), *zip(HAND_LOAD, WRENCH)]


class Pair:
    """The arm and the other side of it."""

    def __init__(self, other: str, folder: Path, step: float):
        self.arm = Unit("arm", folder, step)
        self.other = Unit(other, folder, step)

    def wrench(self) -> np.ndarray:
        """What the other side does to the arm, N and N m."""
        return self.other.get(HAND_LOAD)

    def step(self, time, step, wrench, slope=None):
        """The arm under `wrench`, then the other side, moved by the arm's end."""
        self.arm.set(WRENCH, wrench)
        if slope is not None:
            self.arm.set_slopes(WRENCH, slope)
        self.arm.slave.doStep(time, step)
        self.other.set(HAND_POSE, self.arm.get(ARM_POSE))
        self.other.slave.doStep(time, step)

    def jacobian(self) -> np.ndarray:
        """The derivative of what the other side does to the arm, less what is done to it, by the latter: of the step just done."""
        motion = self.arm.derivatives(ARM_POSE, WRENCH)
        return self.other.derivatives(HAND_LOAD, HAND_POSE) @ motion - np.eye(6)

    def places(self) -> np.ndarray:
        return np.concatenate([self.arm.get(PLACES[:3]), self.other.get(PLACES[3:])])

    def close(self):
        self.arm.close()
        self.other.close()


# Of the wrench, N and N m. The softest motion is that of the arm's end, 1/(3 E I) = 1e-3 m/N: places are wrong by 1e-9 m at most
# where the wrench is wrong by this; 1e-6 of how far the weight goes is 1e-7 m.
MISMATCH = 1e-6
MOST_REPETITIONS = 20


@cache
def iterated(folder: Path, step: float, stop: float):
    """Places at the ends of all steps of the welded pair; with the repetitions a step needs in the mean, and the largest factor by
    which a mismatch would grow under simple repetition."""
    pair = Pair("held", folder, step)
    wrench, last_wrench, jacobian, count = np.zeros(6), np.zeros(6), None, 0
    places = [pair.places()]
    for k in range(round(stop / step)):
        time = k * step
        states = [unit.slave.getFMUstate() for unit in (pair.arm, pair.other)]

        def mismatch(wrench):
            nonlocal count
            count += 1
            for unit, state in zip((pair.arm, pair.other), states):
                unit.slave.setFMUstate(state)
            pair.step(time, step, wrench)
            return pair.wrench() - wrench

        wrench, last_wrench = 2 * wrench - last_wrench, wrench
        rest = mismatch(wrench)
        if jacobian is None:
            jacobian = pair.jacobian()
            growth = np.abs(np.linalg.eigvals(jacobian + np.eye(6))).max()
        for _ in range(MOST_REPETITIONS):
            if np.abs(rest).max() < MISMATCH:
                break
            change = np.linalg.solve(jacobian, -rest)
            wrench = wrench + change
            last_rest, rest = rest, mismatch(wrench)
            jacobian += np.outer(rest - last_rest - jacobian @ change, change) / (change @ change)
        else:
            pytest.fail(f"t = {time} s: a mismatch of {np.abs(rest).max()} is left")
        for unit, state in zip((pair.arm, pair.other), states):
            unit.slave.freeFMUstate(state)
        places.append(pair.places())
    pair.close()
    return np.array(places), count / (len(places) - 1), growth


def explicit(folder: Path, step: float, stop: float, along_slope: bool):
    """Places at the ends of all steps of the pair with the bushing, with short internal steps."""
    pair = Pair("bushed", folder, INTERNAL)
    wrench = last_wrench = pair.wrench()
    places = [pair.places()]
    for k in range(round(stop / step)):
        pair.step(k * step, step, wrench, (wrench - last_wrench) / step if along_slope else None)
        wrench, last_wrench = pair.wrench(), wrench
        places.append(pair.places())
    pair.close()
    return np.array(places)


def connected(folder: Path, step: float, stop: float, extrapolates=False):
    """Places at the ends of all steps of the pair with the bushing, by the plainest of masters: every unit takes its step, then every
    connection hands its value over, or its value and its derivative by time, as PyFMI's master with `extrapolation_order` 1 does."""
    arm, other = Unit("arm", folder, INTERNAL), Unit("bushed", folder, INTERNAL)

    def hand_over():
        for output, entry in CONNECTIONS:
            source, target = (arm, other) if output in arm.references and entry in other.references else (other, arm)
            target.set([entry], source.get([output]))
            if extrapolates:
                target.set_slopes([entry], source.rates([output]))

    hand_over()
    places = [np.concatenate([arm.get(PLACES[:3]), other.get(PLACES[3:])])]
    for k in range(round(stop / step)):
        for unit in (arm, other):
            unit.slave.doStep(k * step, step)
        hand_over()
        places.append(np.concatenate([arm.get(PLACES[:3]), other.get(PLACES[3:])]))
    arm.close()
    other.close()
    return np.array(places)


@cache
def whole(model: str, folder: Path, step: float, output_step: float) -> np.ndarray:
    """Places of the one-file model."""
    results = folder / f"{model}-{step}"
    changes = ["--set", f"simulation.step={step}", "--set", f"simulation.output_step={output_step}"]
    run("run", MODELS / f"{model}.toml", "--out", results, *changes)
    with open(results / "results.csv", newline="") as file:
        names, *rows = csv.reader(file)
    return np.array([[float(row[names.index(name)]) for name in PLACES] for row in rows])


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    return tmp_path_factory.mktemp("coupling")


@pytest.mark.parametrize("step", [4e-3, 2e-3, 1e-3])
def test_iterated_steps_are_those_of_one_model(folder, step):
    """With `generalized_alpha` the reaction belongs to the end of the step, where the arm's equation takes its load: with internal steps
    as long as the communication steps, both sides solve the very equations of the one-file model, at any step."""
    expected = whole("whole_held", folder, step, step)
    places, repetitions, growth = iterated(folder, step, 0.256)
    way = np.ptp(expected, axis=0).max()
    print(f"step {step}: {np.abs(places - expected).max() / way:.1e} of {way} m, {repetitions:.2f} repetitions, factor {growth:.1f}")
    assert way > 0.05 and growth > 5.0, "it moves, and simple repetition would not do"
    assert np.abs(places - expected).max() < 1e-6 * way
    # An affine problem of 6 unknowns takes Broyden's method 12 evaluations at most; a Jacobian that is kept takes far fewer.
    assert repetitions < 12.0


def test_iterated_steps_converge_with_order_2(folder):
    """The order of the integrator, not that of an interface that lags behind. Places differ from those of the next step by
    `c h² (1 + O(h))`; with 16 steps of 4 ms in the fastest motion of interest the second term is some tenths of an order."""
    steps = [4e-3, 2e-3, 1e-3]
    ways = [iterated(folder, step, 0.256)[0][:: round(4e-3 / step)] for step in steps]
    far, near = (np.abs(b - a).max() for a, b in zip(ways, ways[1:]))
    order = np.log2(far / near)
    print(f"order {order:.2f}")
    assert 1.7 < order < 2.3


# Communication steps of the table of masters in docs/coupling.md, s.
STEPS = [8e-3, 4e-3, 2e-3, 1e-3]


def convergence(folder, master):
    """Errors of a master with the bushing at these steps, as shares of how far it moves, and the orders between
    them."""
    expected = whole("whole_bushed", folder, INTERNAL, STEPS[0])
    way = np.ptp(expected, axis=0).max()
    errors = [np.abs(master(step)[:: round(STEPS[0] / step)] - expected).max() / way for step in STEPS]
    orders = [np.log2(a / b) for a, b in zip(errors, errors[1:])]
    print("errors", ", ".join(f"{100 * error:.2g} %" for error in errors), f"of {way:.3f} m, orders {np.array(orders)}")
    assert way > 0.05
    return np.array(errors), np.array(orders)


@pytest.mark.parametrize("along_slope, order", [(False, 1), (True, 2)], ids=["held", "along slope"])
def test_explicit_bushing_converges(folder, along_slope, order):
    """A force held over a step H lags by (H + h)/2 in the mean: order 1. Along the slope of the last step it is off by H² F''/2: order 2,
    like the motion, which is linear in a step. The weight swings at some 20 rad/s, 0.16 rad a step of 8 ms: the next term of the error
    is that much smaller, which is worth log2(1.16/1.08) = 0.1 of an order; internal steps of H/4 and less at most another 0.1."""
    _, orders = convergence(folder, lambda step: explicit(folder, step, 0.256, along_slope))
    assert np.abs(orders - order).max() < 0.2


def test_plain_connections_converge(folder):
    """Both units step at once: what goes over is a step old on either side, order 1, with twice the error of one
    delay."""
    _, orders = convergence(folder, lambda step: connected(folder, step, 0.256))
    assert np.abs(orders - 1).max() < 0.2


def test_extrapolated_connections_converge(folder):
    """Both units step at once, and go along the derivatives that the other one gives: order 2, but for steps that are
    too long for what feeds back. The difference of a force over a communication step is half a step old. Its
    derivative at an instant, or over the last internal step, is not, but feeds back more: with these the forearm
    fails at 4 ms and at 2 ms."""
    errors, orders = convergence(folder, lambda step: connected(folder, step, 0.256, True))
    assert errors[1] < 0.05 and errors[2] < 1e-3
    assert orders[-1] > 1.8
