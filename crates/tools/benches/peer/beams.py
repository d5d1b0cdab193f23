"""What the cases of the peer share: sections, beams, supports, solver settings, and the clock of CPU time.

Beams are EXUDYN's geometrically exact ones with two nodes. With `slender` the shear flexibility is h^2/(12 E I) of an element, "residual
bending flexibility": that makes the linear element exact for cubic bending, and the beam one without shear.
"""

import contextlib
import io
import sys
import time

sys.exudynFast = True  # the module without checks of ranges
with contextlib.redirect_stdout(io.StringIO()):
    import exudyn as exu
    from exudyn.utilities import *  # noqa: F403, the item classes

import numpy as np
from scipy.spatial.transform import Rotation

SOLVERS = {"sparse": exu.LinearSolverType.EigenSparse, "dense": exu.LinearSolverType.EigenDense}


def section(axial, shear, torsion, bending, line_density=1.0, inertia=(1.0, 1.0)):
    """Rigidities EA, GA (y, z), GJ, EI (about y, z); rho A and rho I (about y, z)."""
    made = exu.BeamSection()
    made.stiffnessMatrix = np.diag([axial, *shear, torsion, *bending])
    made.massPerLength = line_density
    made.inertia = np.diag([sum(inertia), *inertia])
    return made


def slender(axial, torsion, bending, h, line_density=1.0, inertia=(1.0, 1.0)):
    """A section of elements of length h without shear."""
    about_y, about_z = bending
    shear = [12 * about_z / h**2, 12 * about_y / h**2]
    return section(axial, shear, torsion, bending, line_density, inertia)


def system():
    container = exu.SystemContainer()
    return container, container.AddSystem()


def beam(mbs, places, frames, length, made):
    """Elements of one length through places, with the section's frames there: nodes, elements."""
    nodes = []
    for place, frame in zip(places, frames):
        x, y, z, w = Rotation.from_matrix(frame).as_quat()
        nodes.append(mbs.AddNode(NodeRigidBodyEP(referenceCoordinates=[*map(float, place), w, x, y, z])))
    pairs = zip(nodes, nodes[1:])
    elements = [
        mbs.AddObject(ObjectBeamGeometricallyExact(nodeNumbers=list(pair), length=length, sectionData=made)) for pair in pairs
    ]
    return nodes, elements


def straight(mbs, start, end, frame, count, made):
    """A straight beam of `count` elements."""
    start, end = np.array(start, float), np.array(end, float)
    places = [start + (end - start) * k / count for k in range(count + 1)]
    return beam(mbs, places, [frame] * (count + 1), float(np.linalg.norm(end - start)) / count, made)


def ground(mbs, place):
    body = mbs.AddObject(ObjectGround(referencePosition=[*map(float, place)]))
    return mbs.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=[0, 0, 0]))


def node(mbs, number):
    return mbs.AddMarker(MarkerNodeRigid(nodeNumber=number))


def weigh(mbs, bodies, gravity):
    for body in bodies:
        marker = mbs.AddMarker(MarkerBodyMass(bodyNumber=body))
        mbs.AddLoad(LoadMassProportional(markerNumber=marker, loadVector=gravity))


def watch(mbs, number, what=exu.OutputVariableType.Displacement):
    return mbs.AddSensor(SensorNode(nodeNumber=number, storeInternal=True, writeToFile=False, outputVariableType=what))


def settings(solver, tolerance):
    made = exu.SimulationSettings()
    made.solution.file.write = False
    made.linearSolver.solverType = SOLVERS[solver]
    made.linearSolver.reuseAnalyzedPattern = solver == "sparse"
    made.parallel.numberOfThreads = 1
    for part in [made.staticSolver, made.timeIntegration]:
        part.verboseMode = 0
        part.newton.relativeTolerance = tolerance
        part.newton.absoluteTolerance = tolerance
    return made


def equilibrium(solver, load_steps, tolerance):
    made = settings(solver, tolerance)
    made.staticSolver.numberOfLoadSteps = load_steps
    made.solution.sensors.writePeriod = 0.5 / load_steps
    return made


def motion(solver, step, stop, output_step, tolerance=1e-3):
    """Generalized-alpha with modified Newton: the fastest of its integrators here. Below 1e-3 its tolerance only costs time."""
    made = settings(solver, tolerance)
    made.timeIntegration.newton.useModifiedNewton = True
    made.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    made.timeIntegration.numberOfSteps = round(stop / step)
    made.timeIntegration.endTime = stop
    made.solution.sensors.writePeriod = output_step
    return made


def repeated(run):
    """Runs until they have taken 4 s together, so that the least time of a short one is not that of a disturbance; at most 10."""
    runs = [run()]
    while len(runs) < 10 and sum(seconds for seconds, _ in runs) < 4:
        runs.append(run())
    return runs


def cpu(work):
    """CPU time of a call, s: on a busy machine the time of the clock on the wall says nothing."""
    begin = time.process_time()
    work()
    return time.process_time() - begin


def answer(runs, header):
    """Prints the least CPU time of the runs and their table: what benches/speed/peer.rs reads."""
    print(f"# cpu {min(seconds for seconds, _ in runs)}")
    print(header)
    for row in runs[0][1]:
        print(",".join(f"{value:.12g}" for value in row))
