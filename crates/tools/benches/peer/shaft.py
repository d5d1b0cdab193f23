"""The rotating shaft: python shaft.py ELEMENTS STEP prints displacements of its middle."""

import sys
from math import pi, sin

from beams import *

LENGTH, INNER, OUTER, YOUNG, POISSON, DENSITY, GRAVITY = 6.0, 0.045, 0.05, 210e9, 0.3, 7800.0, 9.81
DISK, ABOUT, ECCENTRICITY, SPEED = 70.573, [2.0325, 1.0163, 1.0163], 0.05, 60.0
STOP, OUTPUT_STEP = 2.5, 2e-3


def angle(t):
    if t < 0.5:
        return 0.4 * SPEED * (t - sin(2 * pi * t) / (2 * pi))
    if t < 1.0:
        return 0.2 * SPEED + 0.8 * SPEED * (t - 0.5)
    if t < 1.25:
        return 0.6 * SPEED + 0.2 * SPEED * (5 * (t - 1) - sin(4 * pi * (t - 1)) / (4 * pi))
    return 0.85 * SPEED + 1.2 * SPEED * (t - 1.25)


def run(count, step):
    container, mbs = system()
    area, second = pi * (OUTER**2 - INNER**2), pi / 4 * (OUTER**4 - INNER**4)
    torsion = YOUNG / (2 * (1 + POISSON)) * 2 * second
    bending, inertia = [YOUNG * second] * 2, [DENSITY * second] * 2
    made = slender(YOUNG * area, torsion, bending, LENGTH / count, DENSITY * area, inertia)
    nodes, elements = straight(mbs, [0, 0, 0], [LENGTH, 0, 0], np.eye(3), count, made)
    middle = nodes[count // 2]
    offset = DISK * ECCENTRICITY**2
    about_node = [ABOUT[0] + offset, ABOUT[1] + offset, ABOUT[2], 0, 0, 0]
    disk = mbs.AddObject(
        ObjectRigidBody(nodeNumber=middle, mass=DISK, inertia=about_node, centerOfMass=[0, 0, ECCENTRICITY])
    )
    weigh(mbs, [*elements, disk], [0, 0, -GRAVITY])
    # The static solver runs its load factor as time: the drive stands still there.
    driven = {"on": False}
    turn = lambda mbs, t, item, offsets: [0, 0, 0, angle(t) if driven["on"] else 0, 0, 0]
    mbs.AddObject(GenericJoint(markerNumbers=[ground(mbs, [0, 0, 0]), node(mbs, nodes[0])], offsetUserFunction=turn))
    bearing = [ground(mbs, [LENGTH, 0, 0]), node(mbs, nodes[-1])]
    mbs.AddObject(GenericJoint(markerNumbers=bearing, constrainedAxes=[0, 1, 1, 0, 1, 1]))
    sensor = watch(mbs, middle)
    mbs.Assemble()
    mbs.SolveStatic(equilibrium("sparse", 1, 1e-7), updateInitialValues=True)
    driven["on"] = True
    made = motion("sparse", step, STOP, OUTPUT_STEP)
    return cpu(lambda: mbs.SolveDynamic(made)), mbs.GetSensorStoredData(sensor)[:, [0, 2, 3]]


answer(repeated(lambda: run(int(sys.argv[1]), float(sys.argv[2]))), "time,y,z")
