"""Do the checkers find anything to say about an FMU? FMPy's rules, the standard's schema, and fmutool's checks."""

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


def test_archive(fmu):
    """Forward slashes, ASCII names, one date, no zip64, and what the standard wants where it wants it."""
    root = description(fmu).getroot()
    identifier = root.find("CoSimulation").get("modelIdentifier")
    with zipfile.ZipFile(fmu) as archive:
        entries = archive.infolist()
        assert archive.testzip() is None
    names = [entry.orig_filename for entry in entries]
    assert all(name.isascii() and "\\" not in name for name in names)
    assert {entry.date_time for entry in entries} == {(1980, 1, 1, 0, 0, 0)}
    assert all(entry.extract_version < 45 for entry in entries)
    assert {"modelDescription.xml", f"binaries/linux64/{identifier}.so", "resources/model.toml"} <= set(names)


def test_rules_without_a_checker(fmu):
    """What no tool looks at: identifiers, bounds around start, units in use, categories named once."""
    root = description(fmu).getroot()
    assert re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", root.find("CoSimulation").get("modelIdentifier"))
    assert len(names := [c.get("name") for c in root.iter("Category")]) == len(set(names)) > 0
    used = set()
    for variable in root.iter("ScalarVariable"):
        number = variable[0]
        low, high = float(number.get("min", "-inf")), float(number.get("max", "inf"))
        assert low <= float(number.get("start", low if low > float("-inf") else min(high, 0.0))) <= high, variable.get("name")
        used.add(number.get("unit"))
    assert {unit.get("name") for unit in root.iter("Unit")} == used - {None}
    experiment = root.find("DefaultExperiment")
    assert float(experiment.get("stepSize")) > 0 and float(experiment.get("stopTime")) > 0
    declared = {t.get("name") for t in root.iter("SimpleType")}
    assert declared.isdisjoint(v.get("name") for v in root.iter("ScalarVariable"))
