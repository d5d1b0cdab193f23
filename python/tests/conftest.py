"""What the tests share: the models of the repository, and the program of the wheel."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
MODELS = ROOT / "models"
PROGRAM = Path(sys.executable).with_name("ancf14")


def program(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the program that the wheel has installed."""
    return subprocess.run([PROGRAM, *arguments], cwd=folder, capture_output=True, text=True, check=False)


def pytest_configure(config: pytest.Config) -> None:
    # The shipped models are short runs here; a test that is about warnings asks for them.
    config.addinivalue_line("filterwarnings", "ignore::ancf14.SolverWarning")


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
