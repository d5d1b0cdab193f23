"""What shared libraries and programs of Linux need of their computer."""

import io

from elftools.elf.elffile import ELFFile

GLIBC = (2, 17)
OLDEST = {"x64": "GLIBC_2.2.5", "AArch64": "GLIBC_2.17"}
"""The first version of glibc's symbols on a processor, which every file imports."""
OWN_PARTS_OF_GLIBC = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}


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


def needs_an_old_c_library_only(data: bytes, machine: str) -> None:
    """Fails unless a file is for the processor and needs nothing but glibc 2.17."""
    file = elf(data)
    assert file.get_machine_arch() == machine, file.get_machine_arch()
    assert {"libc.so.6"} <= needed(file) <= OWN_PARTS_OF_GLIBC, needed(file)
    found = versions(file)
    assert OLDEST[machine] in found, found
    for version in found:
        assert version.startswith("GLIBC_") and tuple(map(int, version[6:].split("."))) <= GLIBC, version
