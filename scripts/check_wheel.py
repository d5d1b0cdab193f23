"""Checks a wheel for Linux or Windows without installing it: names, tags and hashes agree, and module and library of FMUs need nothing but glibc 2.17 of the processor that the tags name, or
what every Windows has.

    python check_wheel.py WHEEL

Prints a line with the size of the wheel; fails at the first mistake."""

import base64
import csv
import hashlib
import re
import subprocess
import sys
import tempfile
import zipfile
from email import message_from_bytes
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests/fmpy"))
from elf_files import needs_an_old_c_library_only  # noqa: E402

MACHINES = {"x86_64": "x64", "aarch64": "AArch64"}
"""The processor in a tag, and the name that pyelftools has for it."""
WINDOWS = "win_amd64"
# Libraries for other platforms by their folder, as `find_others` of crates/pack looks for them, with the processor of those for Linux.
OTHERS = {"ancf14/x86_64-linux/libancf14.so": "x64", "ancf14/aarch64-linux/libancf14.so": "AArch64"}
# Every Windows since 10 has them.
PARTS_OF_WINDOWS = re.compile(r"(?i)(kernel32|ntdll|msvcrt|ws2_32|userenv|bcrypt(primitives)?|advapi32|api-ms-win-core-[\w-]+)\.dll")


def needs_windows_only(data: bytes, *others: str) -> None:
    """Fails unless a file is for Windows on x86-64 and needs nothing but Windows and the libraries that are named."""
    with tempfile.NamedTemporaryFile() as file:
        file.write(data)
        file.flush()
        told = subprocess.run(["objdump", "--private-headers", file.name], check=True, capture_output=True, text=True).stdout
    assert "file format pei-x86-64" in told, told[:100]
    needed = re.findall(r"DLL Name: (\S+)", told)
    assert needed, "it imports nothing"
    strangers = [name for name in needed if name not in others and not PARTS_OF_WINDOWS.fullmatch(name)]
    assert not strangers, strangers


def check(wheel: Path) -> None:
    name, version, python, abi, platforms = wheel.stem.split("-")
    information = f"{name}-{version}.dist-info"
    with zipfile.ZipFile(wheel) as archive:
        files = {file: archive.read(file) for file in archive.namelist()}
    head = message_from_bytes(files[f"{information}/WHEEL"])
    assert head["Root-Is-Purelib"] == "false", head["Root-Is-Purelib"]
    written = {tag for line in head.get_all("Tag") for tag in line.rsplit("-", 1)[1].split(".")}
    assert written == set(platforms.split(".")), f"WHEEL has tags for {written}, the name has {platforms}"
    assert {line.rsplit("-", 1)[0] for line in head.get_all("Tag")} == {f"{python}-{abi}"} == {"cp311-abi3"}, f"{python}-{abi}"

    record = f"{information}/RECORD"
    rows = {file: (hash_, size) for file, hash_, size in csv.reader(files[record].decode().splitlines())}
    assert rows.keys() == files.keys(), f"RECORD and the archive differ in {rows.keys() ^ files.keys()}"
    for file, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        assert rows[file] == (("", "") if file == record else (f"sha256={digest}", str(len(data)))), f"RECORD is wrong about {file}"

    if written == {WINDOWS}:
        module = "ancf14/_native.pyd"
        needs_windows_only(files[module], "python3.dll")
        needs_windows_only(files["ancf14/ancf14.dll"])
        assert "ancf14/libancf14.so" not in files, "a library of Linux lies where that of Windows belongs"
    else:
        (processor,) = [one for one in MACHINES if all(platform.endswith(f"_{one}") for platform in written)]
        assert written == {f"manylinux2014_{processor}", f"manylinux_2_17_{processor}"}, written
        module = "ancf14/_native.abi3.so"
        for file in (module, "ancf14/libancf14.so"):
            needs_an_old_c_library_only(files[file], MACHINES[processor])
        assert f"ancf14/{processor}-linux/libancf14.so" not in files, "the library of this processor is there twice"
    for file, machine in OTHERS.items():
        if file in files:
            needs_an_old_c_library_only(files[file], machine)
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB, the module {len(files[module]) / 1e6:.1f} MB; tags, hashes and libraries are right")


if __name__ == "__main__":
    check(Path(sys.argv[1]))
