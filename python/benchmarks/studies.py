"""Runs per second of a parameter study of short runs: threads, processes, Dask, FMPy and EXUDYN, one after the other on the same machine.

A pendulum swings for 10 steps; the study keeps its lowest point. In an environment with the wheel:

    pip install --requirement python/tests/requirements.txt --requirement python/benchmarks/requirements.txt
    python python/benchmarks/studies.py
"""

import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import ancf14
import numpy as np

PENDULUM = """
format = 1
model = { name = "Pendulum", gravity = [0, 0, -9.81] }
parameters = { mass = 2.0 }
body.bob = { mass = "mass", inertia = [0.1, 0.1, 0.1], position = [1, 0, 0] }
joint.pivot = { type = "revolute", a = "ground", b = "bob", at = [0, 0, 0], axis = [0, 1, 0] }
output.bob = { at = "bob", quantities = ["displacement"] }
simulation = { stop = 0.1, step = 1e-2, output_step = 1e-2 }
"""
LOWEST = "bob.displacement[3]:min"


def masses(count: int) -> list[float]:
    return [float(mass) for mass in np.linspace(1, 5, count)]


def by_fmpy(file: Path, count: int, *, once: bool) -> None:
    """A loop of simulate_fmu, of which the FMU is unzipped and read once or for each run."""
    import fmpy

    known = {"model_description": fmpy.read_model_description(str(file))} if once else {}
    fmu = fmpy.extract(str(file)) if once else str(file)
    for mass in masses(count):
        results = fmpy.simulate_fmu(
            fmu, start_values={"mass": mass}, stop_time=0.1, output_interval=1e-2, output=["bob.displacement[3]"], **known
        )
        results["bob.displacement[3]"].min()


def pendulum_of_exudyn(parameters: dict[str, Any]) -> float:
    """The same pendulum with the same steps."""
    import exudyn
    import exudyn.itemInterface as items
    import exudyn.utilities as utilities

    mbs = exudyn.SystemContainer().AddSystem()
    inertia = utilities.RigidBodyInertia(mass=parameters["mass"], inertiaTensor=0.1 * np.eye(3))
    bob = mbs.CreateRigidBody(inertia=inertia, referencePosition=[1, 0, 0], gravity=[0, 0, -9.81])
    ground = mbs.CreateGround()
    mbs.CreateRevoluteJoint(itemNumbers=[ground, bob], position=[0, 0, 0], axis=[0, 1, 0], useGlobalFrame=True)
    sensor = mbs.AddSensor(items.SensorBody(bodyNumber=bob, storeInternal=True, outputVariableType=exudyn.OutputVariableType.Displacement))
    mbs.Assemble()
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.numberOfSteps = 10
    settings.timeIntegration.endTime = 0.1
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 1e-2
    mbs.SolveDynamic(settings)
    return float(mbs.GetSensorStoredData(sensor)[:, 3].min())


def by_exudyn(count: int, processes: int) -> None:
    from exudyn.processing import ProcessParameterList

    points = [{"mass": mass} for mass in masses(count)]
    more = {"numberOfThreads": processes} if processes > 1 else {}
    ProcessParameterList(pendulum_of_exudyn, points, useMultiProcessing=processes > 1, showProgress=False, **more)


def row(name: str, count: int, run: Callable[[int], object]) -> None:
    run(min(count, 50))
    begin = time.perf_counter()
    run(count)
    seconds = time.perf_counter() - begin
    print(f"| {name} | {count} | {count / seconds:.0f} | {1e3 * seconds / count:.2f} ms |", flush=True)


if __name__ == "__main__":
    model = ancf14.Model.from_string(PENDULUM)

    def sweep(executor: Any) -> Callable[[int], object]:
        return lambda count: model.sweep({"mass": masses(count)}, [LOWEST], executor=executor)

    def solve(count: int) -> None:
        """The solver alone: one instance that is reset."""
        instance = model.instance()
        for mass in masses(count):
            instance.reset()
            instance["mass"] = mass
            instance.initialize()
            for k in range(10):
                instance.advance(1e-2 * (k + 1))

    print("| | runs | runs per second | time per run |\n|---|---|---|---|")
    row("no study: one `instance`, reset for each run", 10_000, solve)
    row("`sweep`, 1 thread", 10_000, sweep(ThreadPoolExecutor(1)))
    row("`sweep`, 2 threads", 10_000, sweep(ThreadPoolExecutor(2)))
    with ProcessPoolExecutor(2, get_context("spawn")) as processes:
        row("`sweep`, 2 processes", 10_000, sweep(processes))
    from dask.distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        row("`sweep`, Dask, 2 processes", 10_000, sweep(client.get_executor()))
    with tempfile.TemporaryDirectory() as folder:
        fmu = model.pack(Path(folder) / "pendulum.fmu")
        row("FMPy, `simulate_fmu` in a loop, the same FMU", 200, lambda count: by_fmpy(fmu, count, once=False))
        row("FMPy, the same, unzipped and read once", 1000, lambda count: by_fmpy(fmu, count, once=True))
    row("EXUDYN, `ProcessParameterList`, 1 process", 1000, lambda count: by_exudyn(count, 1))
    row("EXUDYN, `ProcessParameterList`, 2 processes", 1000, lambda count: by_exudyn(count, 2))
