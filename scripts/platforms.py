"""Runs packed models on the processors and systems that their FMUs have libraries for, and compares all outputs with those of this computer:
64-bit ARM under qemu, Windows under Wine. Each FMU is unpacked, and c-examples/simulate_fmi2.c, compiled for the platform, runs its library.

    python platforms.py PROGRAM

PROGRAM is `ancf14`, beside which the libraries lie. Prints a table in Markdown; fails if a library is missing or does not run, or if outputs differ by more than SHARE."""

import csv
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
# Models with the time at which they stop, s: under qemu a step takes ten times longer.
MODELS = {"pendulum": 1.0, "crane": 2.0, "four_bar": 0.5, "lateral_buckling": 0.2, "rotating_shaft": 0.05}
SHARE = 1e-5
"""The largest difference of an output, as a share of its largest value. Libraries of C round `sin` and `pow` differently in the last digit, 1e-16. A beam that buckles and
a shaft in resonance make 1e-7 of that (docs/portability.md); this is a hundred times as much."""
# Folder in an FMU of FMI 3.0, target of Zig, how a program of that platform is started here, and what to install for that.
PLATFORMS = {
    "x86_64-linux": ("x86_64-linux-gnu.2.17", [], ""),
    "aarch64-linux": ("aarch64-linux-gnu.2.17", ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"], "qemu-user libc6-arm64-cross"),
    "x86_64-windows": ("x86_64-windows-gnu", ["wine"], "wine wine64"),
}
# Zig compiles what it needs of each platform's C library once, into this folder, as in scripts/linker.sh.
CACHE = {name: str(Path(sys.prefix).parent / "zig") for name in ("ZIG_GLOBAL_CACHE_DIR", "ZIG_LOCAL_CACHE_DIR")}


def ran(words: list[object], **options) -> str:
    """What a command printed. One that fails ends this script with what it said."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))} failed with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def numbers(table: str) -> np.ndarray:
    """The rows of a table in CSV."""
    head, *lines = table.splitlines()
    # Counts of steps and iterations are no results.
    kept = [place for place, name in enumerate(next(csv.reader([head]))) if not name.startswith("statistics.")]
    return np.genfromtxt(lines, delimiter=",", usecols=kept)


def largest_share(rows: np.ndarray, here: np.ndarray) -> float:
    """The largest difference of an output, as a share of its largest value on this computer; infinite if a number is not finite."""
    if rows.shape != here.shape:
        sys.exit(f"a table has {rows.shape} rows and columns there, and {here.shape} here")
    if not (np.isfinite(rows).all() and np.isfinite(here).all()):
        return math.inf
    difference, largest = np.abs(rows - here).max(axis=0), np.abs(here).max(axis=0)
    # An output that is zero here must be zero there.
    return np.divide(difference, largest, out=np.where(difference > 0, np.inf, 0.0), where=largest > 0).max()


def shown(share: float) -> str:
    return "bit-identical" if share == 0 else f"{share:.0e}"


def refuse_more_than_round_off(worst: float) -> None:
    if not worst <= SHARE:
        sys.exit(f"an output differs by {worst:.1e} of its largest value; no more than {SHARE:.0e} was expected")


def outputs(program: Path, model: Path, folder: Path) -> dict[str, np.ndarray]:
    """The rows of a model on every platform."""
    header, fmu = folder / "model.h", folder / "model.fmu"
    ran([program, "header", model, "--prefix", "MODEL", "-o", header])
    ran([program, "pack", model, "-o", fmu, "--fmi", "3"])
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder / "unit")
    rows = {}
    for platform, (target, emulator, packages) in PLATFORMS.items():
        libraries = list((folder / "unit/binaries" / platform).glob("*"))
        if len(libraries) != 1:
            sys.exit(f"the FMU has no library for {platform}; build it first: sh scripts/build-platforms.sh")
        if emulator and shutil.which(emulator[0]) is None:
            sys.exit(f"{emulator[0]} is missing, which runs programs for {platform} here; install it: apt-get install {packages}")
        place = folder / platform
        place.mkdir()
        name = "ancf14.dll" if platform.endswith("windows") else "libancf14.so"
        shutil.copy(libraries[0], place / name)
        example, executable = ROOT / "c-examples/simulate_fmi2.c", place / "simulate.exe"
        zig = [sys.executable, "-m", "ziglang", "cc", "-target", target, "-std=c99", f"-I{ROOT / 'include'}", f"-I{folder}"]
        ran([*zig, example, place / name, "-Wl,-rpath,$ORIGIN", "-o", executable], cwd=place, env=os.environ | CACHE)
        resources = folder / "unit/resources"
        # Wine's drive Z is the root of this file system.
        path = f"Z:{resources}" if platform.endswith("windows") else resources
        printed = ran([*emulator, executable, path], cwd=place, env=os.environ | {"WINEDEBUG": "-all", "LD_LIBRARY_PATH": str(place)})
        rows[platform] = numbers(printed)
    return rows


def main(program: Path) -> None:
    own, *others = PLATFORMS
    print(f"| model | outputs | rows | {' | '.join(others)} |\n|---|---|---|{'---|' * len(others)}", flush=True)
    worst = 0.0
    for name, stop in MODELS.items():
        with tempfile.TemporaryDirectory() as folder:
            text = ran([program, "check", ROOT / f"models/{name}.toml", "--resolved"])
            text, count = re.subn(r"^stop = .*$", f"stop = {stop}", text, flags=re.MULTILINE)
            if count != 1:
                sys.exit(f"models/{name}.toml has {count} lines `stop = ...`, not one")
            model = Path(folder) / "short.toml"
            model.write_text(text)
            rows = outputs(program, model, Path(folder))
        here = rows[own]
        cells = []
        for other in others:
            share = largest_share(rows[other], here)
            worst = max(worst, share)
            cells.append(shown(share))
        print(f"| {name}, {stop:g} s | {here.shape[1] - 1} | {len(here)} | {' | '.join(cells)} |", flush=True)
    refuse_more_than_round_off(worst)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
