"""Drives a crane and its reduced linear system by the same motion of the foot in FMPy, and tells how far apart they are.

    ancf14 pack models/crane.toml -o crane.fmu
    ancf14 reduce models/crane.toml --at equilibrium --order 20 --inputs foot.position[1] \
        --outputs load_motion.position[1],load_motion.velocity[1],drive_load.reaction_force[1] -o small.fmu
    python examples/fmpy/small_crane.py crane.fmu small.fmu

The crane takes the position of the foot, the small FMU its acceleration: about an equilibrium, the motion of a frame follows from that.
"""

import argparse
import time

import numpy as np
from fmpy import simulate_fmu

# The foot moves by WAY, m, within DURATION, s; the load swings on until STOP, s. Steps are those of the model.
WAY, DURATION, STOP, STEP = 0.2, 4.0, 10.0, 0.005
OUTPUTS = ["load_motion.position[1]", "load_motion.velocity[1]", "drive_load.reaction_force[1]"]


def motion() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, position and acceleration of the foot: a polynomial whose acceleration begins and ends at 0."""
    times = np.linspace(0, STOP, round(STOP / STEP) + 1)
    share = np.minimum(times / DURATION, 1)
    position = WAY * share**3 * (10 - 15 * share + 6 * share**2)
    return times, position, WAY / DURATION**2 * share * (60 - 180 * share + 120 * share**2)


def run(fmu: str, name: str, times: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, float]:
    """Results of an FMU whose input has these values, and the time that they took, s."""
    signal = np.array(list(zip(times, values, strict=True)), dtype=[("time", float), (name, float)])
    begin = time.perf_counter()
    settings = {"start_time": 0.0, "stop_time": STOP, "output_interval": STEP, "fmi_type": "CoSimulation"}
    return simulate_fmu(fmu, input=signal, output=OUTPUTS, **settings), time.perf_counter() - begin


def main() -> None:
    arguments = argparse.ArgumentParser(description="Drives a crane and its reduced linear system by the same motion of the foot")
    arguments.add_argument("crane", help="the FMU of ancf14 pack")
    arguments.add_argument("small", help="the FMU of ancf14 reduce")
    fmus = arguments.parse_args()
    times, position, acceleration = motion()
    full, taken = run(fmus.crane, "foot.position[1]", times, position)
    small, less = run(fmus.small, "foot.acceleration[1]", times, acceleration)
    for name in OUTPUTS:
        moved = np.ptp(full[name])
        print(f"{name}: moves by {moved:.4g}, the linear one is off by {np.abs(small[name] - full[name]).max() / moved:.2g} of that")
    print(f"the crane took {taken:.2f} s, its linear system {less:.3f} s")


if __name__ == "__main__":
    main()
