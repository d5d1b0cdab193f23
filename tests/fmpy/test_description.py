"""Do the checkers find anything to say about an FMU? FMPy's rules, the standard's schema, and fmutool's checks; test_rules.py asks what they
do not."""

import re
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
from fmpy.validation import validate_fmu
from lxml import etree

SCHEMAS = Path(fmpy.__file__).parent / "schema"


def document(fmu, name="modelDescription.xml") -> etree._ElementTree:
    with zipfile.ZipFile(fmu) as archive:
        return etree.ElementTree(etree.fromstring(archive.read(name)))


def complaints(schema, document) -> list[str]:
    schema = etree.XMLSchema(etree.parse(SCHEMAS / schema))
    schema.validate(document)
    return [str(error) for error in schema.error_log]


def test_fmpy_finds_no_problem(fmu):
    assert validate_fmu(str(fmu)) == []


def test_schema(fmu):
    assert complaints("fmi2/fmi2ModelDescription.xsd", document(fmu)) == []


def test_terminals(fmu):
    """Since 2.0.4 units have the terminals of FMI 3.0, by its schema; of scalars here."""
    terminals = document(fmu, "terminalsAndIcons/terminalsAndIcons.xml")
    assert complaints("fmi3/fmi3TerminalsAndIcons.xsd", terminals) == []
    connected = {variable.get("name") for variable in document(fmu).find("ModelVariables") if variable.get("causality") in ("input", "output")}
    names = [terminal.get("name") for terminal in terminals.iter("Terminal")]
    assert len(set(names)) == len(names) > 0
    for terminal in terminals.iter("Terminal"):
        members = [member.get("memberName") for member in terminal]
        assert len(set(members)) == len(members) > 0
        assert {member.get("variableName") for member in terminal} <= connected


def checked_by_fmutool(fmu, version):
    """Its exit code is always 0: what it found is in the text, one line per finding behind its level."""
    tool = Path(sys.executable).with_name("fmutool")
    done = subprocess.run([tool, "-input", fmu, "-check"], capture_output=True, text=True)
    text = done.stdout + done.stderr
    assert f"seems to be compliant with FMI-{version}" in text, text
    found = re.findall(r"^(?:WARNING|ERROR|CRITICAL|FATAL).*$|^Traceback.*$", text, flags=re.MULTILINE)
    assert found == [], text


def test_fmutool_finds_nothing(fmu):
    checked_by_fmutool(fmu, "2.0")
