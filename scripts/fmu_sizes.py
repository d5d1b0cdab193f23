"""Compares FMUs of FMI 2.0 and 3.0 of one model: sizes of their files, and how long FMPy reads, loads and initializes them. The model has 1,000 elements and results at 1,001 points.

    target/python-env/bin/python scripts/fmu_sizes.py [ANCF14]
"""

import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

ROOT = Path(__file__).resolve().parent.parent
ANCF14 = sys.argv[1] if len(sys.argv) > 1 else ROOT / "target/fmu/ancf14"
MODEL = """
format = 1
model.name = "Long"
material.steel = { young = 2e11, poisson = 0.3, density = 7850 }
section.rod = { shape = "circle", radius = 0.01 }
beam.rod = { material = "steel", section = "rod", from = [0, 0, 0], to = [100, 0, 0], elements = 1000 }
joint.root = { type = "weld", a = "ground", b = "rod.start" }
output.shape = { on = "rod", stations = 1001, quantities = ["displacement", "rotation", "curvature"] }
simulation = { stop = 1.0, step = 1e-3, output_step = 1e-2 }
"""


def best(work, times=5):
    """The shortest of some runs, ms, and the last result."""
    spans = []
    for _ in range(times):
        begin = time.perf_counter()
        result = work()
        spans.append(1e3 * (time.perf_counter() - begin))
    return min(spans), result


def initialized(version, folder, description):
    """An instance that is initialized and freed."""
    arguments = {"guid": description.guid, "unzipDirectory": folder, "modelIdentifier": description.coSimulation.modelIdentifier}
    unit = {"2": FMU2Slave, "3": FMU3Slave}[version](**arguments)
    unit.instantiate()
    if version == "2":
        unit.setupExperiment()
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    unit.freeInstance()


def figures(version, folder):
    fmu = folder / f"long{version}.fmu"
    subprocess.run([ANCF14, "pack", folder / "long.toml", "--fmi", version, "-o", fmu], check=True, capture_output=True)
    with zipfile.ZipFile(fmu) as archive:
        files = {info.filename: (info.file_size, info.compress_size) for info in archive.infolist()}
    for name in ["modelDescription.xml", "terminalsAndIcons/terminalsAndIcons.xml"]:
        yield f"{name}, kB (packed)", "{:.0f} ({:.0f})".format(*(size / 1e3 for size in files[name]))
    checked, description = best(lambda: read_model_description(str(fmu)))
    read, _ = best(lambda: read_model_description(str(fmu), validate=False))
    yield "variables", f"{len(description.modelVariables)}"
    yield "read_model_description, validated, ms", f"{checked:.0f}"
    yield "read_model_description, not validated, ms", f"{read:.0f}"
    unpacked = extract(str(fmu), folder / f"unit{version}")
    loaded, _ = best(lambda: initialized(version, unpacked, description))
    yield "load, instantiate and initialize, ms", f"{loaded:.0f}"


with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    (folder / "long.toml").write_text(MODEL)
    tables = {version: dict(figures(version, folder)) for version in ["2", "3"]}
print("| | FMI 2.0 | FMI 3.0 |\n|---|---|---|")
for row in tables["2"]:
    print(f"| {row} | {tables['2'][row]} | {tables['3'][row]} |")
