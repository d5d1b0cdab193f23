# %% [markdown]
"""A flexible arm that turns by 1 rad without a swing: linearized, reduced, a controller by python-control, and the nonlinear arm in its loop."""

# %%
import ancf14
import control
import numpy as np
from numpy.typing import NDArray

STEP = 2e-3
TARGET = 1.0
ARM = """
format = 1
model = { name = "FlexibleArm" }
material.alloy = { young = 70e9, poisson = 0.33, density = 2700, damping = 1e-4 }
section.strip = { shape = "rectangle", width = 0.004, height = 0.04 }
beam.arm = { material = "alloy", section = "strip", from = [0, 0, 0], to = [1, 0, 0], elements = 6 }
body.hub = { mass = 1, position = [0, 0, 0], inertia = [0.05, 0.05, 0.05] }
body.payload = { mass = 0.3, position = [1, 0, 0], inertia = [1e-4, 1e-4, 1e-4] }
joint.shoulder = { type = "revolute", a = "ground", b = "hub", axis = [0, 0, 1] }
joint.clamp = { type = "weld", a = "hub", b = "arm.start" }
joint.gripper = { type = "weld", a = "arm.end", b = "payload" }
actuator.motor = { joint = "shoulder", coordinate = "angle", effort = 0, input = true }
output.hinge = { at = "shoulder", quantities = ["angle", "angle_rate"] }
output.gauge = { at = "arm@0.1", quantities = ["curvature"] }
output.tip = { at = "arm.end", quantities = ["displacement"] }
simulation = { stop = 3, step = 2e-3 }
"""
MODEL = ancf14.Model.from_string(ARM)

# %% [markdown]
# The motor turns the arm; the shoulder and a strain gauge are measured. Few states are left.


# %%
def reduced() -> control.StateSpace:
    """The linear system from the effort to angle, curvature at the gauge, and deflection of the tip."""
    whole = MODEL.linearize(inputs=["motor.effort"], outputs=["hinge.angle", "gauge.curvature[2]", "tip.displacement[2]"])
    small = whole.reduce(error=0.02)
    print(f"{len(whole.states)} states, reduced to {len(small.states)}, at most {100 * (small.bound or 0):.2g} % off")
    return small.to_control()


# %% [markdown]
# Linear-quadratic: the distance of the tip from its target costs, and so does the effort. An observer finds the states from the measurements.


# %%
def regulator(arm: control.StateSpace) -> control.StateSpace:
    """The sampled controller from the measurements, the angle less its target, to the effort of the motor."""
    sampled = control.c2d(arm, STEP)
    measured, tip = sampled.C[:2], sampled.C[2]
    # The rates of the tip and of the shoulder cost as well, so that no mode that moves them stays undamped.
    rates = np.vstack([arm.C[2] @ arm.A, arm.C[0] @ arm.A])
    cost = 1000 * np.outer(tip, tip) + 4 * rates.T @ rates
    gain, *_ = control.dlqr(sampled.A, sampled.B, (cost + cost.T) / 2 + 1e-9 * np.eye(sampled.nstates), [[0.01]])
    noise = sampled.B @ sampled.B.T + 1e-7 * np.eye(sampled.nstates)
    observer, *_ = control.dlqe(sampled.A, np.eye(sampled.nstates), measured, noise, np.diag([1e-8, 1e-6]))
    return control.ss(sampled.A - observer @ measured - sampled.B @ gain, observer, -gain, np.zeros((1, 2)), STEP)


def travel(controller: control.StateSpace | None) -> NDArray[np.float64]:
    """The distance of the tip from its target along its way in the nonlinear run, m. Without a controller, the motor is a spring and a damper."""
    instance = MODEL.instance()
    instance.initialize()
    state = None if controller is None else np.zeros(controller.nstates)
    places = []
    for _ in range(round(3 / STEP)):
        angle, rate, curvature = instance["hinge.angle"], instance["hinge.angle_rate"], instance["gauge.curvature[2]"]
        wanted = TARGET
        if controller is None or state is None:
            instance["motor.effort"] = 40 * (TARGET - angle) - 4 * rate
        else:
            instance["motor.effort"] = float((controller.C @ state)[0])
            state = controller.A @ state + controller.B @ np.array([angle - TARGET, curvature])
        instance.step(STEP)
        x, y = 1 + instance["tip.displacement[1]"], instance["tip.displacement[2]"]
        places.append(y * np.cos(TARGET) - x * np.sin(TARGET))
    return np.array(places)


# %%
if __name__ == "__main__":
    controller = regulator(reduced())
    for name, own in (("spring and damper", None), ("linear-quadratic", controller)):
        rest = travel(own)[round(1.6 / STEP) :]
        print(f"{name}: after 1.6 s the tip is within {1000 * np.abs(rest).max():.2f} mm")
