"""Lateral buckling: python buckling.py STRIP LINK CRANK STEP, three numbers of elements, prints displacements of the strip's middle."""

import sys
from math import cos, pi

from beams import *

YOUNG, POISSON, DENSITY, OFFSET, HALF_TURN = 73e9, 0.3, 2680.0, 1e-4, 0.4
STOP, OUTPUT_STEP = 0.5, 5e-4
# Area, second moments about y and z, torsion constant.
STRIP = 1e-3, 0.01 * 0.1**3 / 12, 0.1 * 0.01**3 / 12, 3.12e-8
LINK = pi * 0.012**2, pi * 0.012**4 / 4, pi * 0.012**4 / 4, 3.26e-8
CRANK = pi * 0.024**2, pi * 0.024**4 / 4, pi * 0.024**4 / 4, 5.21e-7


def angle(t):
    return 0.5 * pi * (1 - cos(pi * t / HALF_TURN)) if t < HALF_TURN else pi


def made(shape, h):
    area, about_y, about_z, torsion = shape
    bending, inertia = [YOUNG * about_y, YOUNG * about_z], [DENSITY * about_y, DENSITY * about_z]
    return slender(YOUNG * area, YOUNG / (2 * (1 + POISSON)) * torsion, bending, h, DENSITY * area, inertia)


def run(counts, step):
    container, mbs = system()
    upright, down = np.eye(3), np.array([[0, 0, 1.0], [0, 1.0, 0], [-1.0, 0, 0]])
    foot, pin, top = [0.95, OFFSET, -0.25], [1, OFFSET, -0.25], [1, OFFSET, 0]
    strip, _ = straight(mbs, [0, 0, 0], [1, 0, 0], upright, counts[0], made(STRIP, 1 / counts[0]))
    link, _ = straight(mbs, top, pin, down, counts[1], made(LINK, 0.25 / counts[1]))
    crank, _ = straight(mbs, foot, pin, upright, counts[2], made(CRANK, 0.05 / counts[2]))
    mbs.AddObject(GenericJoint(markerNumbers=[ground(mbs, [0, 0, 0]), node(mbs, strip[0])]))
    # A body of nearly no mass carries the place beside the axis at which the link holds on.
    arm = mbs.AddObject(ObjectRigidBody(nodeNumber=strip[-1], mass=1e-9, inertia=[1e-12] * 3 + [0] * 3))
    beside = mbs.AddMarker(MarkerBodyRigid(bodyNumber=arm, localPosition=[0, OFFSET, 0]))
    mbs.AddObject(SphericalJoint(markerNumbers=[beside, node(mbs, link[0])]))
    hinge = [node(mbs, crank[-1]), node(mbs, link[-1])]
    mbs.AddObject(GenericJoint(markerNumbers=hinge, constrainedAxes=[1, 1, 1, 1, 0, 1], rotationMarker1=down.T))
    turn = lambda mbs, t, item, offsets: [0, 0, 0, 0, -angle(t), 0]
    mbs.AddObject(GenericJoint(markerNumbers=[ground(mbs, foot), node(mbs, crank[0])], offsetUserFunction=turn))
    sensor = watch(mbs, strip[counts[0] // 2])
    mbs.Assemble()
    made_so = motion("sparse", step, STOP, max(step, OUTPUT_STEP))
    return cpu(lambda: mbs.SolveDynamic(made_so)), mbs.GetSensorStoredData(sensor)


answer(repeated(lambda: run([int(count) for count in sys.argv[1:4]], float(sys.argv[4]))), "time,x,y,z")
