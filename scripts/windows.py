"""Runs the program for Windows under Wine, out of the archive of a release, which is unpacked into a folder whose name has a space and letters beyond ASCII. Every command
that writes something runs there, and runs of models give the results of this computer.

    python windows.py PROGRAM ARCHIVE.zip

PROGRAM is `ancf14` of this computer. Prints a table in Markdown, the largest difference of an output from that of PROGRAM; fails if a command does not run, or if outputs
differ by more than SHARE of platforms.py. Needs, of Debian:

    apt-get install wine wine64"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import urllib.request
import zipfile
from pathlib import Path

from platforms import CACHE, MODELS, ROOT, largest_share, numbers, ran, refuse_more_than_round_off, shown

PLACE = "Modèle für µ"
"""The folder of the program and of the models: spaces and letters that no code page of Windows has all of."""
# Wine's own folder, so that none of the user is touched; its names of files are those of the locale.
ENVIRONMENT = {"WINEPREFIX": str(ROOT / "target/wine"), "WINEDEBUG": "-all", "LC_ALL": "C.UTF-8"}
# Windows has had this library since Windows 8, but Wine has it only since version 9: there this takes its place.
RANDOM = """
#include <windows.h>
BOOLEAN WINAPI SystemFunction036(void *bytes, ULONG count);
__declspec(dllexport) BOOL WINAPI ProcessPrng(BYTE *bytes, SIZE_T count) { return SystemFunction036(bytes, (ULONG)count); }
"""
MISTAKEN = '[material.m]\nyoung = "high"\n'
TIMEOUT = 300


def prepared() -> dict[str, str]:
    """The environment in which Wine behaves as Windows 10, which Rust and Python need."""
    if shutil.which("wine") is None:
        sys.exit("wine is missing, which runs programs for Windows here; install it: apt-get install wine wine64")
    environment = os.environ | ENVIRONMENT
    Path(ENVIRONMENT["WINEPREFIX"]).parent.mkdir(exist_ok=True)
    ran(["wine", "winecfg", "-v", "win10"], env=environment, stdin=subprocess.DEVNULL)
    library = Path(ENVIRONMENT["WINEPREFIX"]) / "drive_c/windows/system32/bcryptprimitives.dll"
    if not library.is_file():
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / "random.c"
            source.write_text(RANDOM)
            zig = [sys.executable, "-m", "ziglang", "cc", "-target", "x86_64-windows-gnu", "-shared", source, "-ladvapi32"]
            ran([*zig, "-o", Path(folder) / library.name], cwd=folder, env=os.environ | CACHE)
            shutil.copy(Path(folder) / library.name, library)
    return environment


def on_drive(path: Path) -> str:
    """A path of this computer as Wine's programs see it: drive Z is the root."""
    return "Z:" + str(path).replace("/", "\\")


class Windows:
    """The program in a folder."""

    def __init__(self, program: Path, place: Path, environment: dict[str, str]) -> None:
        self.words = ["wine", program]
        self.place = place
        self.options = {"cwd": place, "env": environment, "encoding": "utf-8"}

    def ran(self, *words: object) -> str:
        """What a command printed."""
        return ran([*self.words, *words], stdin=subprocess.DEVNULL, timeout=TIMEOUT, **self.options)

    def refused(self, code: int, *words: object) -> str:
        """What a command complained of, which ended with a code."""
        done = subprocess.run(
            [str(word) for word in (*self.words, *words)], capture_output=True, stdin=subprocess.DEVNULL, timeout=TIMEOUT, **self.options
        )
        if done.returncode != code:
            sys.exit(f"{words} ended with {done.returncode}, not {code}:\n{done.stdout}{done.stderr}")
        return done.stderr

    def wrote(self, *names: str) -> None:
        for name in names:
            if not (self.place / name).is_file() or (self.place / name).stat().st_size == 0:
                sys.exit(f"{name} was not written; there are {sorted(path.name for path in self.place.iterdir())}")


def files_of(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def compare_runs(windows: Windows, program: Path) -> None:
    """Runs models there and here, and prints the table."""
    print("| model | outputs | rows | Windows, Wine |\n|---|---|---|---|", flush=True)
    worst = 0.0
    for name, stop in MODELS.items():
        model = shutil.copy(ROOT / f"models/{name}.toml", windows.place)
        # A table beside the model.
        for table in (ROOT / "models").glob(f"{name}*.csv"):
            shutil.copy(table, windows.place)
        words = ["--set", f"simulation.stop={stop}", "-o"]
        windows.ran("run", Path(model).name, *words, f"{name}-ü")
        here = windows.place / f"{name}-here"
        ran([program, "run", model, *words, here])
        there = windows.place / f"{name}-ü"
        if files_of(there) != files_of(here):
            sys.exit(f"{name}: the folder of results has {files_of(there)}, and {files_of(here)} here")
        tables = [numbers((folder / "results.csv").read_text()) for folder in (there, here)]
        share = largest_share(*tables)
        worst = max(worst, share)
        print(f"| {name}, {stop:g} s | {tables[1].shape[1] - 1} | {len(tables[1])} | {shown(share)} |", flush=True)
    refuse_more_than_round_off(worst)


def run_commands(windows: Windows) -> None:
    """The other commands, on a model of a template, as a user types them."""
    windows.ran("new", "Träger", "--template", "beam")
    windows.wrote("Träger.toml")
    windows.refused(2, "new", "Träger", "--template", "beam")
    windows.ran("new", "rotor.toml", "--template", "rotor")
    if "Träger.toml" not in windows.ran("check", "Träger.toml", "--draw", "Bild.svg"):
        sys.exit("`check` does not name the model file as it was given")
    windows.ran("check", "Träger.toml", "--draw", "Bild.png")
    windows.wrote("Bild.svg", "Bild.png")
    if json.loads(windows.ran("--json", "check", "Träger.toml"))["variables"] == []:
        sys.exit("`check --json` lists no variables")
    # A whole path of Windows works, too.
    windows.ran("run", on_drive(windows.place / "Träger.toml"), "--view", "--verify")
    windows.wrote("Träger-results/results.csv", "Träger-results/errors.csv", "Träger-results/index.html", "Träger-results/view.html")
    # The second run takes the place of the first one.
    for _ in range(2):
        windows.ran("run", "Träger.toml", "--save-state", "Ende.state", "--no-refine", "-o", "alone")
    windows.ran("modes", "Träger.toml", "--count", "4")
    windows.wrote("Träger-results/modes.csv")
    windows.ran("tune", "Träger.toml")
    windows.wrote("Träger.tuned.toml")
    windows.ran("linearize", "Träger.toml", "-o", "Träger.npz", "--at", "equilibrium")
    windows.ran("linearize", "Träger.toml", "-o", "Träger.mat")
    windows.ran("linearize", "Träger.toml", "-o", "klein.fmu")
    for model in ("c-examples/arm.toml", "models/crane.toml"):
        shutil.copy(ROOT / model, windows.place)
    windows.ran("linearize", "arm.toml", "--bode", "Bode.svg", "--poles")
    windows.ran("reduce", "crane.toml", "--order", "8", "-o", "weniger.mat")
    windows.ran("campbell", "rotor.toml", "--without-gravity", "--speeds", "10:50:20", "-o", "Drehzahl.csv", "--plot", "Drehzahl.svg")
    windows.ran("export", "Träger.toml", "--vtk", "Träger vtk", "--every", "10")
    windows.ran("view", "Träger.toml")
    windows.ran("view", "Träger.toml", "rotor.toml", "--no-refine", "-o", "zwei Läufe.html")
    windows.ran("header", "Träger.toml", "-o", "Träger.h")
    windows.ran("man", "man")
    windows.ran("completions", "powershell")
    windows.ran("demo")
    windows.wrote("ancf14-demo-results/results.csv")
    windows.wrote("Träger.npz", "Träger.mat", "klein.fmu", "Bode.svg", "weniger.mat", "Drehzahl.csv", "Drehzahl.svg")
    windows.wrote("Träger.html", "zwei Läufe.html", "Träger.h")
    windows.wrote("Träger vtk/beams.pvd", "man/ancf14.1")
    (windows.place / "falsch.toml").write_text(MISTAKEN)
    if "falsch.toml" not in windows.refused(2, "check", "falsch.toml"):
        sys.exit("a mistake does not name its file")
    windows.refused(2, "check", "not-there.toml")
    # A file that a command reads is not written to, and a model file names files of its folder only.
    windows.refused(2, "tune", "rotor.toml", "-o", ".\\ROTOR.TOML")
    include(windows)


def include(windows: Windows) -> None:
    """A model with lines as Windows ends them, which includes a file of a folder below, and one that may not."""
    parts = windows.place / "Teile ü"
    parts.mkdir()
    model = (windows.place / "rotor.toml").read_text(encoding="utf-8")
    (parts / "part.toml").write_text("format = 1\n[material.spare]\nyoung = 7e10\npoisson = 0.3\ndensity = 2700\n")
    shutil.copy(parts / "part.toml", windows.place)
    for name, place, words in [("whole.toml", "Teile ü/part.toml", []), ("Teile ü/out.toml", "../part.toml", ["--allow-outside"])]:
        text = f'{model}\n[include.spare]\nfile = "{place}"\n'
        (windows.place / name).write_text(text, encoding="utf-8", newline="\r\n")
        windows.ran("check", name, *words)
        if words and "outside" not in windows.refused(2, "check", name):
            sys.exit(f"{name} includes a file from outside of its folder")


def pack(windows: Windows, others: list[str]) -> list[str]:
    """The platforms of FMUs of both versions."""
    names = {"2": {"x86_64-windows": "win64", "x86_64-linux": "linux64"}, "3": {}}
    for version, own in names.items():
        windows.ran("pack", "Träger.toml", "-o", f"Träger {version}.fmu", "--fmi", version)
        with zipfile.ZipFile(windows.place / f"Träger {version}.fmu") as archive:
            packed = {entry.split("/")[1] for entry in archive.namelist() if entry.startswith("binaries/") and not entry.endswith("/")}
        wanted = {own.get(platform, platform) for platform in ("x86_64-windows", *others)}
        if packed != wanted:
            sys.exit(f"an FMU of FMI {version}.0 has libraries for {sorted(packed)}, not for {sorted(wanted)}")
    return sorted(packed)


def watch(windows: Windows) -> None:
    """A page that is served, and served anew when its file is saved."""
    words = [str(word) for word in (*windows.words, "view", "Träger.toml", "--watch")]
    served = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, **windows.options)
    try:
        line = served.stdout.readline()
        address = next(word for word in line.split() if word.startswith("http"))

        def get(name: str) -> str:
            with urllib.request.urlopen(address + name, timeout=TIMEOUT) as answer:
                return answer.read().decode()

        def wait_for(run: int) -> None:
            while json.loads(get("news"))["run"] < run:
                if served.poll() is not None:
                    sys.exit("the program that serves the page has ended")

        if "<html" not in get(""):
            sys.exit(f"{address} is no page")
        wait_for(1)
        with (windows.place / "Träger.toml").open("a") as file:
            file.write("# saved again\n")
        wait_for(2)
    finally:
        served.kill()
        served.wait()


def main(program: Path, archive: Path) -> None:
    environment = prepared()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / PLACE
        place.mkdir()
        with zipfile.ZipFile(archive) as packed:
            packed.extractall(place)
        root = place / archive.stem
        windows = Windows(root / "bin/ancf14.exe", place, environment)
        version = windows.ran("--version").strip()
        compare_runs(windows, program)
        run_commands(windows)
        others = sorted(path.name for path in (root / "lib").iterdir() if path.is_dir())
        platforms = pack(windows, others)
        if (root / "lib/ancf14.wasm").is_file():
            windows.ran("view", "Träger.toml", "--live", "-o", "live.html")
        watch(windows)
        print(f"\n{version} for Windows: every command runs; it packs FMUs for {', '.join(platforms)}.")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
