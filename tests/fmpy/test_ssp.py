"""Do two units, coupled terminal by terminal in an SSP file, move as the same mechanism in one model file? The system of examples/ssp, written by its script from the
terminals of the units, in FMPy's master for SSP, which steps both sides in parallel."""

import subprocess
import sys
import zipfile

import fmpy.ssp
import numpy as np
import pytest
from conftest import ROOT, run
from fmpy.ssp.simulation import simulate_ssp
from lxml import etree
from pathlib import Path

EXAMPLE = ROOT / "examples/ssp"
SCHEMA = Path(fmpy.ssp.__file__).parent / "schema/SystemStructureDescription.xsd"
PAIRS = ["arm.arm_end=forearm.hand", "forearm.hand_load=arm.tip"]
STOP = 0.256


def couple(*words):
    return subprocess.run([sys.executable, EXAMPLE / "couple.py", *words], capture_output=True, text=True)


@pytest.fixture(scope="module")
def units(tmp_path_factory):
    folder = tmp_path_factory.mktemp("ssp")
    for name in ["arm", "forearm"]:
        run("pack", EXAMPLE / f"{name}.toml", "-o", folder / f"{name}.fmu")
    return folder


@pytest.fixture(scope="module")
def system(units):
    done = couple(units / "arm.fmu", units / "forearm.fmu", *PAIRS, "-o", units / "system.ssp")
    assert done.returncode == 0, done.stderr
    assert "2 FMUs, 12 connections" in done.stdout
    return units / "system.ssp"


def test_the_description_is_valid(system):
    with zipfile.ZipFile(system) as archive:
        document = etree.ElementTree(etree.fromstring(archive.read("SystemStructure.ssd")))
    schema = etree.XMLSchema(etree.parse(SCHEMA))
    schema.validate(document)
    assert [str(error) for error in schema.error_log] == []


@pytest.mark.parametrize("pair, says", [("arm.shoulder=forearm.hand", "no terminal shoulder"), ("forearm.weight_motion=arm.tip", "no output force[1]")])
def test_wrong_pairs_are_refused(units, pair, says):
    done = couple(units / "arm.fmu", units / "forearm.fmu", pair, "-o", units / "wrong.ssp")
    assert done.returncode != 0 and says in done.stderr
    assert not (units / "wrong.ssp").exists()


def fmu(path, version="2.0"):
    """An FMU without a library: an output and an input, each in a terminal."""
    path.parent.mkdir(exist_ok=True)
    variables = "".join(f'<ScalarVariable name="{kind}" causality="{kind}"><{tag}/></ScalarVariable>' for kind, tag in [("output", "Integer"), ("input", "Real")])
    terminals = "".join(f'<Terminal name="{kind}s"><TerminalMemberVariable memberName="x" variableName="{kind}"/></Terminal>' for kind in ["output", "input"])
    with zipfile.ZipFile(path, "w") as archive:
        head = f'<fmiModelDescription fmiVersion="{version}"><DefaultExperiment stopTime="1"/>'
        archive.writestr("modelDescription.xml", f"{head}<ModelVariables>{variables}</ModelVariables></fmiModelDescription>")
        archive.writestr("terminalsAndIcons/terminalsAndIcons.xml", f"<fmiTerminalsAndIcons><Terminals>{terminals}</Terminals></fmiTerminalsAndIcons>")
    return path


def test_connectors_have_the_types_of_their_variables(tmp_path):
    done = couple(fmu(tmp_path / "a.fmu"), fmu(tmp_path / "b.fmu"), "a.outputs=b.inputs", "-o", tmp_path / "system.ssp")
    assert done.returncode == 0, done.stderr
    with zipfile.ZipFile(tmp_path / "system.ssp") as archive:
        connectors = etree.fromstring(archive.read("SystemStructure.ssd")).findall(".//{*}Connector")
    assert {(connector.get("name"), etree.QName(connector[0]).localname) for connector in connectors} == {("output", "Integer"), ("input", "Real")}


@pytest.mark.parametrize(
    "second, version, pair, says",
    [
        ("b.fmu", "2.0", "a.outputs=c.inputs", "no FMU is named c; the FMUs are a, b"),
        ("b.fmu", "2.0", "a.outputs", "write UNIT.TERMINAL=UNIT.TERMINAL"),
        ("b.fmu", "2.0", "a.outputs=b", "write UNIT.TERMINAL=UNIT.TERMINAL"),
        ("other/a.fmu", "2.0", "a.outputs=a.inputs", "have the same name a: rename one"),
        ("b.fmu", "3.0", "a.outputs=b.inputs", "b.fmu is an FMU of FMI 3.0, and SSP 1.0 takes FMI 2.0: pack it again with --fmi 2"),
    ],
)
def test_mistakes_are_refused_in_one_sentence(tmp_path, second, version, pair, says):
    done = couple(fmu(tmp_path / "a.fmu"), fmu(tmp_path / second, version), pair, "-o", tmp_path / "wrong.ssp")
    assert done.returncode != 0 and says in done.stderr and "Traceback" not in done.stderr, done.stderr
    assert not (tmp_path / "wrong.ssp").exists()


def places(system, step):
    """Displacements of the end of the arm and of the weight at the ends of the steps, m."""
    rows = simulate_ssp(str(system), stop_time=STOP - step / 2, step_size=step)
    columns = [rows[f"{place}.position[{i}]"] for place in ("arm.arm_end", "forearm.weight_motion") for i in (1, 2, 3)]
    return np.column_stack(columns) - [0, 0, 0, 0, 0.5, 0]


def test_the_system_moves_as_one_mechanism(system, tmp_path):
    """Both sides are one step late: order 1. Twice the step, twice the error, within a fifth since the second order is in it too."""
    run("run", ROOT / "tests/fmpy/coupling/whole_bushed.toml", "--out", tmp_path / "whole")
    with open(tmp_path / "whole/results.csv") as file:
        header = file.readline().strip().split(",")
        whole = np.loadtxt(file, delimiter=",")
    wanted = [header.index(f"{place}.position[{i}]") for place in ("arm_end", "weight_motion") for i in (1, 2, 3)]
    times, moved = whole[:, 0], whole[:, wanted] - whole[0, wanted]
    errors = []
    for step in [2e-3, 1e-3]:
        coupled = places(system, step)
        every = round((times[1] - times[0]) / step)
        reached = coupled[every - 1 :: every]
        errors.append(np.abs(reached - moved[1 : len(reached) + 1]).max() / np.abs(moved).max())
    print("SSP: errors at 2 and 1 ms:", errors)
    assert errors[0] < 0.03
    assert 1.6 < errors[0] / errors[1] < 2.4
