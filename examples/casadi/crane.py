"""CasADi optimizes the motion of a flexible crane's foot through the adjoint derivatives of its FMU: the load travels 2 m and stops without swinging.

In each communication step the position of the foot at its end minimizes a cost of the load's position and velocity there. CasADi's SQP method takes the gradient of the cost from
`fmi3GetAdjointDerivative`, and repeats the step from an FMU state. The cost beyond the step is that of a pendulum on the same rope, by a Riccati equation: the FMU does not give
derivatives with respect to its state, so that an optimization over many steps has no exact gradient. CasADi's own importer of FMUs is for model exchange.

    ancf14 pack models/crane.toml --fmi 3 -o crane.fmu
    pip install casadi==3.8.2 FMPy==0.3.32
    python crane.py crane.fmu
"""

import shutil
import sys

import casadi as ca
import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi3 import FMU3Slave

STEP, STOP, TRAVEL = 0.2, 8.0, 2.0  # s, s, m
GRAVITY, ROPE = 9.81, 3.4  # m/s², m
WEIGHT = 1.0  # of the acceleration of the foot
NEAR = 1e-4  # m, to the best position of the foot
SEEN = ["load_motion.position", "load_motion.velocity"]


class Crane:
    """The FMU in Step Mode, with states to go back to."""

    def __init__(self, path: str):
        description = read_model_description(path)
        self.reference = {variable.name: variable.valueReference for variable in description.modelVariables}
        identifier = description.coSimulation.modelIdentifier
        self.folder = extract(path)
        self.fmu = FMU3Slave(guid=description.guid, unzipDirectory=self.folder, modelIdentifier=identifier)
        self.fmu.instantiate()
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()
        self.seen = [self.reference[name] for name in SEEN]
        self.foot = [self.reference["foot.position"]]
        self.start, self.time, self.steps = self.read()[0], 0.0, 0
        self.begin, self.tried = self.fmu.getFMUState(), None

    def read(self) -> np.ndarray:
        return np.array(self.fmu.getFloat64(self.seen, 6))

    def step(self, foot):
        """Takes the step, or takes it again to other positions of the foot, m."""
        foot = [float(value) for value in foot]
        if foot == self.tried:
            return
        self.fmu.setFMUState(self.begin)
        self.fmu.setFloat64(self.foot, foot)
        self.fmu.doStep(self.time, STEP)
        self.tried, self.steps = foot, self.steps + 1

    def gradient(self, seed) -> list[float]:
        """The derivative of the outputs times `seed` with respect to the position of the foot."""
        return self.fmu.getAdjointDerivative(self.seen, self.foot, [float(value) for value in seed], 3)

    def accept(self):
        """Goes on from the end of the step."""
        self.fmu.freeFMUState(self.begin)
        self.begin, self.tried, self.time = self.fmu.getFMUState(), None, self.time + STEP

    def close(self):
        self.fmu.freeFMUState(self.begin)
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


class Function(ca.Callback):
    """A function of CasADi with columns of given lengths in and out."""

    def __init__(self, name, lengths_in, length_out, options=None):
        ca.Callback.__init__(self)
        self.lengths_in, self.length_out = lengths_in, length_out
        self.construct(name, options or {})

    def get_n_in(self):
        return len(self.lengths_in)

    def get_n_out(self):
        return 1

    def get_sparsity_in(self, place):
        return ca.Sparsity.dense(self.lengths_in[place], 1)

    def get_sparsity_out(self, _place):
        return ca.Sparsity.dense(self.length_out, 1)


class Adjoint(Function):
    """The transposed derivative of the step times a seed."""

    def __init__(self, crane, name, options):
        self.crane = crane
        super().__init__(name, [3, 6, 6], 3, options)

    def eval(self, arguments):
        foot, _outputs, seed = (np.array(argument).ravel() for argument in arguments)
        self.crane.step(foot)
        return [ca.DM(self.crane.gradient(seed))]


class Step(Function):
    """Position and velocity of the load at the end of the step, from the position of the foot there."""

    def __init__(self, crane):
        self.crane = crane
        super().__init__("step", [3], 6)

    def eval(self, arguments):
        self.crane.step(np.array(arguments[0]).ravel())
        return [ca.DM(self.crane.read())]

    def has_reverse(self, count):
        return count == 1

    def get_reverse(self, _count, name, _names_in, _names_out, options):
        self.adjoint = Adjoint(self.crane, name, options)
        return self.adjoint


def pendulum_cost() -> np.ndarray:
    """The quadratic cost of the rest of the motion, of load and foot with their velocities, if the load were a pendulum."""
    stiffness = GRAVITY / ROPE
    rates = np.array([[0, 1, 0, 0], [-stiffness, 0, stiffness, 0], [0, 0, 0, 1], [0, 0, 0, 0]])
    over, pushed, term = np.eye(4), STEP * np.eye(4), np.eye(4)
    for k in range(1, 20):
        term = term @ rates * STEP / k
        over, pushed = over + term, pushed + term * STEP / (k + 1)
    push = pushed[:, 3:]
    cost = np.eye(4)
    for _ in range(2000):
        gain = np.linalg.solve(WEIGHT + push.T @ cost @ push, push.T @ cost @ over)
        cost = np.eye(4) + over.T @ cost @ (over - push @ gain)
    return cost


def problem(step: Step, start: float):
    """The optimization of a step: of the position of the foot, from its position, mean velocity and velocity so far."""
    foot, before = ca.MX.sym("foot"), ca.MX.sym("before", 3)
    outputs = step(ca.vertcat(foot, 0, 0))
    mean = (foot - before[0]) / STEP
    acceleration = (mean - before[1]) / STEP
    # The FMU ends a step with this velocity of a frame (docs/coupling.md).
    velocity = mean + acceleration * STEP / 2
    state = ca.vertcat(outputs[0] - start - TRAVEL, outputs[3], foot - TRAVEL, velocity)
    weights = pendulum_cost()
    # The load follows the foot little within a step: the curvature of the cost is that of the foot's own motion.
    own = np.array([0, 0, 1, 1.5 / STEP])
    curvature = 2 * (own @ weights @ own + WEIGHT / STEP**4)
    cost = ca.dot(state, ca.mtimes(ca.DM(weights), state)) + WEIGHT * acceleration**2
    names = ["x", "p", "lam_f", "lam_g"]
    multiplier = ca.MX.sym("multiplier")
    constant = ca.Function("hess_lag", [foot, before, multiplier, ca.MX(0, 1)], [multiplier * curvature], names, ["hess_gamma_x_x"])
    options = {"qpsol": "qrqp", "qpsol_options": {"print_iter": False, "print_header": False}, "hess_lag": constant}
    quiet = {"print_time": False, "print_iteration": False, "print_header": False, "print_status": False}
    return ca.nlpsol("crane", "sqpmethod", {"x": foot, "p": before, "f": cost}, options | quiet | {"max_iter": 8, "tol_du": NEAR * curvature})


def optimized(path: str) -> np.ndarray:
    """Rows of time, position of the foot and of the load, m."""
    crane = Crane(path)
    step = Step(crane)
    solver = problem(step, crane.start)
    rows, before = [], np.zeros(3)
    while crane.time < STOP - STEP / 2:
        foot = float(solver(x0=before[0] + STEP * before[2], p=before)["x"])
        crane.step([foot, 0, 0])
        crane.accept()
        mean = (foot - before[0]) / STEP
        before = np.array([foot, mean, mean + (mean - before[1]) / 2])
        rows.append([crane.time, foot, crane.read()[0] - crane.start])
    print(f"{crane.steps} steps for {len(rows)} communication steps")
    crane.close()
    return np.array(rows)


def ramped(path: str) -> np.ndarray:
    """The same rows if the foot travels along a smooth ramp of 3 s."""
    crane = Crane(path)
    rows = []
    while crane.time < STOP - STEP / 2:
        share = min((crane.time + STEP) / 3, 1)
        foot = TRAVEL * share**2 * (3 - 2 * share)
        crane.step([foot, 0, 0])
        crane.accept()
        rows.append([crane.time, foot, crane.read()[0] - crane.start])
    crane.close()
    return np.array(rows)


def swing(rows: np.ndarray) -> float:
    """The width of the swing in the last 3 s, m."""
    return float(np.ptp(rows[rows[:, 0] > STOP - 3, 2]))


if __name__ == "__main__":
    for name, rows in [("ramp", ramped(sys.argv[1])), ("optimized", optimized(sys.argv[1]))]:
        print(f"{name}: foot at {rows[-1, 1]:.3f} m, load at {rows[-1, 2]:.3f} m, swing {swing(rows):.3f} m")
