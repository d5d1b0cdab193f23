"""The helical spring: python spring.py ELEMENTS LOAD_STEPS prints force and pull at 40 mm."""

import sys
from math import pi

from beams import *

DIAMETER, SHEAR, POISSON, PULL = 2e-3, 80e9, 0.3, 0.04
YOUNG = 2 * SHEAR * (1 + POISSON)
# Pieces of the curve, and points of a piece of it that its arc length is taken from.
BREAKS, FINE = [0, 0.15, 0.35, 0.5], 20000


def place(s):
    """The curve; s is an array."""
    rise = np.where(s < 0.15, 0.5 * (1 + np.tanh(50 * s - 3)), np.where(s > 0.35, 0.5 * (1 + np.tanh(22 - 50 * s)), 1.0))
    return np.array([0.05 * s, 0.02 * rise * np.cos(8 * pi * s), 0.02 * rise * np.sin(8 * pi * s)]).T


def frames(s):
    """Frames carried along the curve without twist, at each s of a fine line of points (double reflection)."""
    points = place(s)
    tangents = np.gradient(points, s, axis=0, edge_order=2)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    normal = np.cross(tangents[0], [0, 0, 1.0])
    normals = [normal / np.linalg.norm(normal)]
    for k in range(len(s) - 1):
        reflect = lambda v, along: v - 2 * (along @ v) / (along @ along) * along
        chord = points[k + 1] - points[k]
        carried, tangent = reflect(normals[-1], chord), reflect(tangents[k], chord)
        turn = tangents[k + 1] - tangent
        normal = reflect(carried, turn) if turn @ turn > 0 else carried
        normal -= (normal @ tangents[k + 1]) * tangents[k + 1]
        normals.append(normal / np.linalg.norm(normal))
    return points, [np.column_stack([t, n, np.cross(t, n)]) for t, n in zip(tangents, normals)]


def mesh(count):
    """Places and frames at equal arc lengths, and that length."""
    s = np.linspace(0, 0.5, FINE + 1)
    points, along = frames(s)
    arc = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    chosen = np.searchsorted(arc, np.linspace(0, arc[-1], count + 1) - 1e-12)
    return points[chosen], [along[k] for k in chosen], arc[-1] / count


def run(load_steps, places, along, h):
    container, mbs = system()
    area, second = pi * DIAMETER**2 / 4, pi * DIAMETER**4 / 64
    made = section(YOUNG * area, [6 / 7 * SHEAR * area] * 2, SHEAR * 2 * second, [YOUNG * second] * 2)
    nodes, _ = beam(mbs, places, along, h, made)
    held = [ground(mbs, places[0]), node(mbs, nodes[0])]
    mbs.AddObject(GenericJoint(markerNumbers=held, constrainedAxes=[1, 1, 1, 1, 0, 0], rotationMarker1=along[0].T))
    origin = mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=mbs.AddNode(NodePointGround()), coordinate=0))
    end = [mbs.AddMarker(MarkerNodeCoordinate(nodeNumber=nodes[-1], coordinate=axis)) for axis in range(3)]
    for axis in [1, 2]:
        mbs.AddObject(CoordinateConstraint(markerNumbers=[origin, end[axis]]))
    pull = lambda mbs, t, item, offset: PULL * t
    puller = mbs.AddObject(CoordinateConstraint(markerNumbers=[origin, end[0]], offsetUserFunction=pull))
    force = SensorObject(
        objectNumber=puller, storeInternal=True, writeToFile=False, outputVariableType=exu.OutputVariableType.Force
    )
    force = mbs.AddSensor(force)
    pulled = watch(mbs, nodes[-1])
    mbs.Assemble()
    solved = equilibrium("sparse", load_steps, 1e-4)
    seconds = cpu(lambda: mbs.SolveStatic(solved))
    return seconds, [[mbs.GetSensorStoredData(pulled)[-1][1], mbs.GetSensorStoredData(force)[-1][1]]]


meshed = mesh(int(sys.argv[1]))
answer(repeated(lambda: run(int(sys.argv[2]), *meshed)), "pull,force")
