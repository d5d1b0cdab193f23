"""Do the programs of python/examples find what they look for? The bounds follow from the problems: known causes, closed forms, limits that were set."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from conftest import MODELS, ROOT


def numbers(name: str) -> list[float]:
    """Run a copy of a program in its folder, as a notebook runs, and return the numbers that it prints."""
    examples = shutil.copytree(ROOT / "python" / "examples", Path("python/examples"))
    shutil.copytree(MODELS, Path("models"))
    done = subprocess.run([sys.executable, f"{name}.py"], cwd=examples, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return [float(number) for number in re.findall(r"(?<![\w'])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?", done.stdout)]


def test_a_short_rope_swings_least() -> None:
    *_, best = numbers("crane_study")
    assert "</html>" in Path("python/examples/crane_study.html").read_text()
    # The slower the load swings beside the start and the stop of the trolley, the more of them it keeps.
    assert best == 1


def test_shares_are_those_of_the_closed_form() -> None:
    shares = numbers("sobol")
    # The frequency goes with height/length^2 sqrt(young): variances of the logarithms, each of a uniform interval.
    relative = [2 * 0.05, 0.0, 0.1, 0.5 * 2 / 70]
    expected = [own**2 / sum(other**2 for other in relative) for own in relative]
    # 128 base points find indices to about 1/sqrt(128) of their complement.
    assert shares == pytest.approx(expected, abs=0.05)


def test_the_fit_finds_the_causes_of_the_record() -> None:
    young, young_deviation, damping, damping_deviation = numbers("fit")
    # Three deviations of the estimate, and what is left out in print.
    assert young == pytest.approx(72.5, abs=72.5 * 3e-2 * young_deviation + 0.006)
    assert damping == pytest.approx(8e-4, abs=8e-4 * 3e-2 * damping_deviation + 6e-7)


def test_the_controller_stops_the_swing() -> None:
    _, free, _, held = numbers("controller")
    assert held < 0.5 * free


def test_the_filter_finds_the_force() -> None:
    force, deviation = numbers("particle_filter")
    assert deviation < 2 and force == pytest.approx(22, abs=3 * deviation)


def test_the_spring_meets_its_limits() -> None:
    wire, _, stiffness, stress, _ = numbers("spring_design")
    assert stiffness == pytest.approx(400, abs=1) and stress <= 600 and 0.5 <= wire <= 2


def test_the_whirl_begins_where_damping_ratios_say() -> None:
    critical, without, begins, expected = numbers("whirl")
    # Damping of the material drives the whirl as soon as the rotation is faster than the vibration.
    assert without == pytest.approx(critical, abs=2e-3)
    # The ratios are those at rest: gyroscopic moments change them by the share of the frequency, 2e-4.
    assert begins == pytest.approx(expected, rel=1e-3)


def test_the_arm_stops_without_a_swing() -> None:
    states, kept, bound, _, damped, _, controlled = numbers("flexible_arm")
    assert kept < states / 10 and bound < 2
    # The figures of docs/controller.md: the tip is a meter from the shoulder, and turns by 60 degrees.
    assert controlled < 2 and damped > 80
