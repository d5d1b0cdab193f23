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

SCHEMA = Path(fmpy.__file__).parent / "schema/fmi2/fmi2ModelDescription.xsd"


def description(fmu) -> etree._ElementTree:
    with zipfile.ZipFile(fmu) as archive:
        return etree.ElementTree(etree.fromstring(archive.read("modelDescription.xml")))


def test_fmpy_finds_no_problem(fmu):
    assert validate_fmu(str(fmu)) == []


def test_schema(fmu):
    schema = etree.XMLSchema(etree.parse(SCHEMA))
    schema.validate(description(fmu))
    assert [str(error) for error in schema.error_log] == []


def test_fmutool_finds_nothing(fmu):
    """Its exit code is always 0: what it found is in the text, one line per finding behind its level."""
    tool = Path(sys.executable).with_name("fmutool")
    done = subprocess.run([tool, "-input", fmu, "-check"], capture_output=True, text=True)
    text = done.stdout + done.stderr
    assert "seems to be compliant with FMI-2.0" in text, text
    found = re.findall(r"^(?:WARNING|ERROR|CRITICAL|FATAL).*$|^Traceback.*$", text, flags=re.MULTILINE)
    assert found == [], text
