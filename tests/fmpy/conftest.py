"""Host tests: every FMU goes through real hosts and checkers.

    scripts/build.sh
    scripts/python-env.sh
    target/python-env/bin/python -m pytest -q tests/fmpy

ANCF14       the executable; default target/fmu/ancf14
ANCF14_FMUS  a folder with FMUs to test; default: all of models/*.toml and of tests/suite/fmi/, packed by the executable
"""

import os
import subprocess
import tempfile
import zipfile
from ctypes import byref
from pathlib import Path

import pytest
from fmpy import fmi2
from fmpy.logging import addLoggerProxy

ROOT = Path(__file__).resolve().parents[2]
SOURCES = [*sorted(ROOT.glob("models/*.toml")), *sorted(ROOT.glob("tests/suite/fmi/*.toml"))]


# Words of warnings about the mesh of a motion: the command tells them from a second run beside the first one, which an FMU does without.
OF_THE_COMMAND = ["as estimated from a run with", "the mesh together", "the mesh error is not known: a run with"]


def executable() -> Path:
    return Path(os.environ.get("ANCF14", ROOT / "target/fmu/ancf14"))


def run(*words) -> list[str]:
    """Runs the executable and gives its warnings; a failure shows what it said."""
    done = subprocess.run([executable(), *words], capture_output=True, text=True)
    assert done.returncode == 0, f"ancf14 {' '.join(map(str, words))}:\n{done.stdout}{done.stderr}"
    return [line.removeprefix("warning: ") for line in done.stderr.splitlines() if line.startswith("warning: ")]


def pack_all(folder: Path):
    for source in SOURCES:
        run("pack", source, "-o", folder / f"{source.stem}.fmu")


def pytest_configure(config):
    given = os.environ.get("ANCF14_FMUS")
    if given is None:
        config.packed = tempfile.TemporaryDirectory(prefix="ancf14-fmus-")
        given = config.packed.name
        pack_all(Path(given))
    config.fmus = sorted(Path(given).glob("*.fmu"))
    if not config.fmus:
        raise pytest.UsageError(f"there is no FMU in {given}")


# FMPy keeps one native logger of FMI 2.0 for the process: the one registered last. `simulate_fmu(logger=...)` registers its own and frees it at its end.
# The next unit that logs through FMPy's default callbacks would then call freed memory, so each test registers a logger that lasts.
LASTING = fmi2.fmi2CallbackFunctions()
PRINTER = fmi2.fmi2CallbackLoggerTYPE(fmi2.printLogMessage)


@pytest.fixture(autouse=True)
def lasting_logger():
    yield
    LASTING.logger = PRINTER
    addLoggerProxy(byref(LASTING))


def pytest_generate_tests(metafunc):
    if "fmu" in metafunc.fixturenames:
        fmus = metafunc.config.fmus
        metafunc.parametrize("fmu", fmus, ids=[path.stem for path in fmus], scope="module")


@pytest.fixture(scope="module")
def results(fmu, tmp_path_factory) -> Path:
    """results.csv of `ancf14 run` on the model file inside the FMU."""
    folder = tmp_path_factory.mktemp(fmu.stem)
    with zipfile.ZipFile(fmu) as archive:
        (folder / "model.toml").write_bytes(archive.read("resources/model.toml"))
    told = run("run", folder / "model.toml", "--out", folder / "results")
    warnings = [warning for warning in told if not any(words in warning for words in OF_THE_COMMAND)]
    (folder / "results" / "warnings.txt").write_text("".join(f"{warning}\n" for warning in warnings))
    return folder / "results" / "results.csv"


@pytest.fixture(scope="module")
def warnings(results) -> list[str]:
    """What `ancf14 run` warned of: hosts must be told the same, and nothing else."""
    return (results.parent / "warnings.txt").read_text().splitlines()
