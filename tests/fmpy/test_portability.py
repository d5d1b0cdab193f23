"""Does what is shipped run elsewhere? The library inside an FMU and the command line need nothing of their machine but the C library as it
was in 2012, leave nothing behind in the process of their host, and panics stop inside. A plain build needs the C library of the machine it
was built on."""

import ctypes
import re
import subprocess
import zipfile
from pathlib import Path

import _ctypes
import fmpy
import pytest

from conftest import ROOT, executable
from elf_files import OWN_PARTS_OF_GLIBC, elf, needed, needs_an_old_c_library_only, symbols, versions

# 4.51 MB, with the comparison run of the mesh error, winches and states to begin with; the 75 functions of FMI 3.0, each with its own
# guard against panics, are some 0.19 MB of them. Start poses of frames, grounds of parts, damping ratios and notes brought it to 4.62 MB; bounds and switches of
# expressions, the time-step error of all forces, free motions in equilibria and the floating-point environment of calls to 4.81 MB; tables of keys, surfaces,
# scales of what relieves heat, friction that holds and transposed solutions to 4.91 MB; mass that follows the section, section forces by equilibrium
# and automatic meshes to 5.01 MB; water with its waves and lines, contact with friction, and linear systems to 5.74 MB; air and beams that touch each other to
# 5.81 MB; curves that are drawn tight, rings, boxes and cones, pressures, and critical times that are right to 5.89 MB; elementary functions of its own to 5.93 MB.
LIBRARY_BYTES = 5_950_000

# Threads, and whatever has to be called when a thread ends: a library that was unloaded by then kills its host, and a key that is
# taken at every load is not given back.
LEFT_BEHIND = re.compile("pthread_create|pthread_key_|pthread_[sg]etspecific|thrd_|tss_|__cxa_thread_atexit|atexit|fork|signal|sigaction")

# Functions of the C library whose last digit depends on its version and on the processor. The solver has its own (src/math/elementary.rs).
ELEMENTARY = set("sin cos sincos tan asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp exp2 expm1 log log2 log10 log1p pow cbrt hypot".split())


def library(fmu) -> bytes:
    with zipfile.ZipFile(fmu) as archive:
        (name,) = [name for name in archive.namelist() if name.startswith("binaries/linux64/")]
        return archive.read(name)


@pytest.fixture(scope="module")
def shipped(request) -> bytes:
    return library(request.config.fmus[0])


def test_every_fmu_has_the_same_library(shipped, fmu):
    assert library(fmu) == shipped


def test_the_library_records_no_file_name(shipped):
    """A program may link the library of an FMU by its path: with a file name in it, the program would look for a file of that name."""
    assert [tag.soname for tag in elf(shipped).get_section_by_name(".dynamic").iter_tags("DT_SONAME")] == []


@pytest.mark.parametrize("what", ["library", "command line"])
def test_an_old_c_library_is_enough(shipped, what):
    needs_an_old_c_library_only(shipped if what == "library" else executable().read_bytes(), "x64")


def test_the_names_are_those_of_the_standard_and_our_own(shipped):
    header = (Path(fmpy.__file__).parent / "c-code/fmi2Functions.h").read_text()
    standard = set(re.findall(r"#define (fmi2\w+) +fmi2FullName", header))
    assert len(standard) == 44
    header = (Path(fmpy.__file__).parent / "c-code/fmi3Functions.h").read_text()
    standard |= set(re.findall(r"#define (fmi3\w+) +fmi3FullName", header))
    assert len(standard) == 44 + 75
    own = set(re.findall(r"\b(ancf14_\w+)\(", (ROOT / "include/ancf14.h").read_text()))
    assert len(own) == 25
    assert symbols(elf(shipped), imported=False) == standard | own


def test_results_do_not_depend_on_the_c_library(shipped):
    assert symbols(elf(shipped), imported=True) & ELEMENTARY == set()


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
