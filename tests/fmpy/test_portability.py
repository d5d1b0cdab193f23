"""Does what is shipped run elsewhere? The library inside an FMU and the command line need nothing of their machine but the C library as it
was in 2012, leave nothing behind in the process of their host, and panics stop inside. A plain build needs the C library of the machine it
was built on."""

import ctypes
import io
import re
import subprocess
import zipfile
from pathlib import Path

import _ctypes
import fmpy
import pytest
from elftools.elf.elffile import ELFFile

from conftest import ROOT, executable

GLIBC = (2, 17)
LIBRARY_BYTES = 4_100_000  # 3.95 MB; the 75 functions of FMI 3.0, each with its own guard against panics, are some 0.19 MB of them
OWN_PARTS_OF_GLIBC = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "ld-linux-x86-64.so.2"}

# Threads, and whatever has to be called when a thread ends: a library that was unloaded by then kills its host, and a key that is
# taken at every load is not given back.
LEFT_BEHIND = re.compile("pthread_create|pthread_key_|pthread_[sg]etspecific|thrd_|tss_|__cxa_thread_atexit|atexit|fork|signal|sigaction")

# Functions of model exchange, in the standard's headers too.
MODEL_EXCHANGE = {
    "fmi2EnterEventMode", "fmi2NewDiscreteStates", "fmi2EnterContinuousTimeMode", "fmi2CompletedIntegratorStep", "fmi2SetTime",
    "fmi2SetContinuousStates", "fmi2GetDerivatives", "fmi2GetEventIndicators", "fmi2GetContinuousStates",
    "fmi2GetNominalsOfContinuousStates",
}  # fmt: skip


def library(fmu) -> bytes:
    with zipfile.ZipFile(fmu) as archive:
        (name,) = [name for name in archive.namelist() if name.startswith("binaries/linux64/")]
        return archive.read(name)


@pytest.fixture(scope="module")
def shipped(request) -> bytes:
    return library(request.config.fmus[0])


def elf(data: bytes) -> ELFFile:
    return ELFFile(io.BytesIO(data))


def needed(file: ELFFile) -> set[str]:
    return {tag.needed for tag in file.get_section_by_name(".dynamic").iter_tags("DT_NEEDED")}


def versions(file: ELFFile) -> set[str]:
    section = file.get_section_by_name(".gnu.version_r")
    return {version.name for _library, auxiliary in section.iter_versions() for version in auxiliary}


def symbols(file: ELFFile, *, imported: bool) -> set[str]:
    table = file.get_section_by_name(".dynsym")
    return {symbol.name for symbol in table.iter_symbols() if symbol.name and (symbol["st_shndx"] == "SHN_UNDEF") == imported}


def test_every_fmu_has_the_same_library(shipped, fmu):
    assert library(fmu) == shipped


def test_the_library_records_no_file_name(shipped):
    """A program may link the library of an FMU by its path: with a file name in it, the program would look for a file of that name."""
    assert [tag.soname for tag in elf(shipped).get_section_by_name(".dynamic").iter_tags("DT_SONAME")] == []


@pytest.mark.parametrize("what", ["library", "command line"])
def test_an_old_c_library_is_enough(shipped, what):
    file = elf(shipped if what == "library" else executable().read_bytes())
    assert file.get_machine_arch() == "x64"
    assert {"libc.so.6"} <= needed(file) <= OWN_PARTS_OF_GLIBC
    assert "GLIBC_2.2.5" in (found := versions(file))
    for version in found:
        assert version.startswith("GLIBC_") and tuple(map(int, version[6:].split("."))) <= GLIBC, version


def test_the_names_are_those_of_the_standard_and_our_own(shipped):
    header = (Path(fmpy.__file__).parent / "c-code/fmi2Functions.h").read_text()
    standard = set(re.findall(r"#define (fmi2\w+) +fmi2FullName", header)) - MODEL_EXCHANGE
    assert len(standard) == 34
    header = (Path(fmpy.__file__).parent / "c-code/fmi3Functions.h").read_text()
    standard |= set(re.findall(r"#define (fmi3\w+) +fmi3FullName", header))
    assert len(standard) == 34 + 75
    own = set(re.findall(r"\b(ancf14_\w+)\(", (ROOT / "include/ancf14.h").read_text()))
    assert len(own) == 24
    assert symbols(elf(shipped), imported=False) == standard | own


def test_nothing_is_left_in_the_process(shipped):
    file = elf(shipped)
    assert [name for name in symbols(file, imported=True) if LEFT_BEHIND.match(name)] == []
    tags = {tag.entry.d_tag for tag in file.get_section_by_name(".dynamic").iter_tags()}
    assert "DT_FINI" not in tags and "DT_FINI_ARRAY" not in tags


def test_it_is_small_and_unwinds(shipped):
    file = elf(shipped)
    assert len(shipped) < LIBRARY_BYTES
    names = {section.name for section in file.iter_sections()}
    assert ".symtab" not in names and not any(name.startswith(".debug") for name in names)
    assert {".eh_frame", ".eh_frame_hdr", ".gcc_except_table"} <= names


def test_panics_stop_inside(tmp_path, capfd):
    """In a library built like the shipped one, loaded and unloaded more often than a process has thread keys."""
    built = tmp_path / "panics.so"
    subprocess.run(
        ["rustc", "--edition", "2024", "--crate-type", "cdylib", ROOT / "tests/fmpy/panics.rs", "-o", built]
        + ["-C", "opt-level=3", "-C", "lto=fat", "-C", "codegen-units=1", "-C", "strip=symbols"]
        + ["-C", f"linker={ROOT / 'scripts/linker.sh'}", "-C", "linker-features=-lld"],
        check=True,
        capture_output=True,
    )
    file = elf(built.read_bytes())
    assert needed(file) <= OWN_PARTS_OF_GLIBC and symbols(file, imported=False) == {"step"}
    capfd.readouterr()
    for _ in range(1100):
        loaded = ctypes.CDLL(str(built))
        loaded.step.argtypes = [ctypes.c_double, ctypes.POINTER(ctypes.c_uint32), ctypes.c_char_p]
        for value, status in [(0.5, 0), (2.5, 4), (0.5, 0)]:
            dropped, text = ctypes.c_uint32(0), ctypes.create_string_buffer(200)
            assert loaded.step(value, dropped, text) == status
            assert dropped.value == 21
            said = re.fullmatch(r"2\.5 is too much \(.*panics\.rs:\d+\)", text.value.decode())
            assert said if status else not text.value
        _ctypes.dlclose(loaded._handle)
    assert "panics.so" not in Path("/proc/self/maps").read_text()
    assert capfd.readouterr() == ("", "")
