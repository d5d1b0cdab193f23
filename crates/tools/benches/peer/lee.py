"""Lee's frame by load steps up to 1.25 times the load that it bears (models/lee_frame.toml): the load of the last equilibrium that is found.

Prints the number of load steps, the load over that of `t = 1` and the displacement of the loaded point of each equilibrium found, and whether the solver came to the end.
"""

import contextlib
import io

from beams import *  # noqa: F403, what the cases share

SIDE, YOUNG, WIDTH, HEIGHT = 1.2, 7.2e9, 0.06, 0.02
LOAD = 4000.0
UPWARD = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])


def run(count, load_steps):
    _, mbs = system()
    area, bending = WIDTH * HEIGHT, YOUNG * WIDTH * HEIGHT**3 / 12
    made = slender(YOUNG * area, bending, (bending, 100 * bending), SIDE / count)
    column, _ = straight(mbs, [0, 0, 0], [0, 0, SIDE], UPWARD, count, made)
    girder, _ = straight(mbs, [0, 0, SIDE], [SIDE, 0, SIDE], np.eye(3), count, made)
    hinge = [1, 1, 1, 1, 0, 1]
    # Axes of joints are those of space as drawn.
    for place, number, frame in (([0, 0, 0], column[0], UPWARD), ([SIDE, 0, SIDE], girder[-1], np.eye(3))):
        sides = [ground(mbs, place), node(mbs, number)]
        mbs.AddObject(GenericJoint(markerNumbers=sides, constrainedAxes=hinge, rotationMarker1=frame.T))
    sides = [node(mbs, column[-1]), node(mbs, girder[0])]
    mbs.AddObject(GenericJoint(markerNumbers=sides, constrainedAxes=[1] * 6, rotationMarker0=UPWARD.T))
    loaded = girder[count // 5]
    mbs.AddLoad(Force(markerNumber=node(mbs, loaded), loadVector=[0, 0, -1.25 * LOAD]))
    sensor = watch(mbs, loaded)
    mbs.Assemble()
    made = equilibrium("sparse", load_steps, 1e-8)
    finished = True
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            finished = exu.SolveStatic(mbs, made, updateInitialValues=True, showHints=False) is not False
        except Exception:
            finished = False
    return finished, mbs.GetSensorStoredData(sensor)


for load_steps in (25, 100, 400):
    finished, rows = run(10, load_steps)
    for factor, _, _, z in rows:
        print(load_steps, f"{1.25 * factor:.6f} {z:.6f}")
    print(load_steps, "finished" if finished else "failed")
