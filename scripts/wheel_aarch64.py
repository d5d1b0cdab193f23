"""Runs the Python wheel for 64-bit ARM under qemu, on Debian, in Debian's Python for ARM, which it unpacks into target/arm-env without installing it. The wheel's program and module run
models to the same bytes, and the module packs an FMU.

    python wheel_aarch64.py PROGRAM WHEEL

PROGRAM is `ancf14` of this computer. Prints a table in Markdown, the largest difference of an output from that of PROGRAM; fails if something does not run or if outputs differ by more than SHARE of
platforms.py. Needs, of Debian:

    apt-get install qemu-user"""

import shutil
import sys
import tempfile
import zipfile
from pathlib import Path

from platforms import MODELS, ROOT, largest_share, numbers, ran, refuse_more_than_round_off, shown

ENVIRONMENT = ROOT / "target/arm-env"
COMMAND = "import sys; from ancf14._command import main; sys.exit(main())"
MODULE = "import ancf14, sys; ancf14.Model(sys.argv[1]).run(stop=float(sys.argv[2])).to_csv(sys.argv[3])"
PACK = "import ancf14, sys; ancf14.Model(sys.argv[1]).pack(sys.argv[2], fmi=3)"


def unpack_python() -> list[object]:
    """Debian's Python for ARM with all that it and numpy need, the wheel, and the command that starts it here."""
    apt, root, site = ENVIRONMENT / "apt", ENVIRONMENT / "root", ENVIRONMENT / "site"
    for folder in ("lists/partial", "archives/partial"):
        (apt / folder).mkdir(parents=True)
    (apt / "status").touch()
    # Folders of its own, in which no package is installed: apt then takes all that Python needs.
    options = {
        "APT::Architecture": "arm64",
        "APT::Architectures": "arm64",
        "APT::Sandbox::User": "root",
        "Debug::NoLocking": "true",
        "Dir::Cache": apt,
        "Dir::State::lists": apt / "lists",
        "Dir::State::status": apt / "status",
    }
    words = ["apt-get", "-qq", *(word for key, value in options.items() for word in ("-o", f"{key}={value}"))]
    ran([*words, "update"])
    ran([*words, "install", "--download-only", "--yes", "--no-install-recommends", "python3", "libstdc++6"])
    for package in sorted((apt / "archives").glob("*.deb")):
        ran(["dpkg-deb", "--extract", package, root])
    platforms = [word for name in ("manylinux2014", "manylinux_2_28") for word in ("--platform", f"{name}_aarch64")]
    version = ran(["qemu-aarch64", "-L", root, root / "usr/bin/python3", "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]).strip()
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--only-binary=:all:", *platforms]
    ran([*pip, "--python-version", version, "--target", site, sys.argv[2]])
    return ["qemu-aarch64", "-L", root, "-E", f"PYTHONPATH={site}", root / "usr/bin/python3"]


def main(program: Path) -> None:
    if shutil.which("qemu-aarch64") is None:
        sys.exit("qemu-aarch64 is missing, which runs programs for 64-bit ARM here; install it: apt-get install qemu-user")
    shutil.rmtree(ENVIRONMENT, ignore_errors=True)
    python = unpack_python()
    print("| model | outputs | rows | 64-bit ARM, qemu |\n|---|---|---|---|", flush=True)
    worst = 0.0
    for name, stop in MODELS.items():
        model = ROOT / f"models/{name}.toml"
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            words = ["run", model, "--set", f"simulation.stop={stop}", "-o"]
            ran([program, *words, folder / "here"])
            ran([*python, "-c", COMMAND, *words, folder / "arm"])
            ran([*python, "-c", MODULE, model, stop, folder / "module.csv"])
            here = numbers((folder / "here/results.csv").read_text())
            # The program and the module of the wheel are the same code.
            arm = folder / "arm/results.csv"
            if (folder / "module.csv").read_bytes() != arm.read_bytes():
                sys.exit(f"{name}: the wheel's program and module have different results")
            share = largest_share(numbers(arm.read_text()), here)
            worst = max(worst, share)
        print(f"| {name}, {stop:g} s | {here.shape[1] - 1} | {len(here)} | {shown(share)} |", flush=True)
    refuse_more_than_round_off(worst)
    with tempfile.TemporaryDirectory() as place:
        fmu = Path(place) / "pendulum.fmu"
        ran([*python, "-c", PACK, ROOT / "models/pendulum.toml", fmu])
        with zipfile.ZipFile(fmu) as archive:
            packed = sorted(entry.split("/")[1] for entry in archive.namelist() if entry.startswith("binaries/") and not entry.endswith("/"))
    if "aarch64-linux" not in packed:
        sys.exit(f"the FMU that the wheel packs has libraries for {packed} only")
    print(f"\nThe wheel packs FMUs for {', '.join(packed)}.")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
