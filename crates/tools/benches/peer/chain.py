"""A clamped chain that falls under its weight: python chain.py ELEMENTS STEPS prints the memory it takes and where its tip comes."""

import sys

from beams import *

LENGTH, WIDTH, YOUNG, POISSON, DENSITY, GRAVITY, STEP = 2.0, 0.02, 210e9, 0.3, 7800.0, 9.81, 1e-3


def resident():
    with open("/proc/self/status") as status:
        return 1024 * next(int(line.split()[1]) for line in status if line.startswith("VmRSS:"))


def run(count, steps):
    before = resident()
    container, mbs = system()
    area, second, shear = WIDTH**2, WIDTH**4 / 12, YOUNG / (2 * (1 + POISSON))
    shears, torsion = [5 / 6 * shear * area] * 2, shear * 0.1405770 * WIDTH**4
    made = section(YOUNG * area, shears, torsion, [YOUNG * second] * 2, DENSITY * area, [DENSITY * second] * 2)
    nodes, elements = straight(mbs, [0, 0, 0], [LENGTH, 0, 0], np.eye(3), count, made)
    weigh(mbs, elements, [0, 0, -GRAVITY])
    mbs.AddObject(GenericJoint(markerNumbers=[ground(mbs, [0, 0, 0]), node(mbs, nodes[0])]))
    mbs.Assemble()
    solved = motion("sparse", STEP, STEP * steps, STEP * steps)
    seconds = cpu(lambda: mbs.SolveDynamic(solved))
    tip = mbs.GetNodeOutput(nodes[-1], exu.OutputVariableType.Displacement)
    return seconds, [[count, resident() - before, tip[2]]]


# The memory is that of the first run: a second one finds what the first has freed.
answer(repeated(lambda: run(int(sys.argv[1]), int(sys.argv[2]))), "elements,memory,tip")
