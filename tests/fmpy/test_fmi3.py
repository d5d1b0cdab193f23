"""Do units of FMI 3.0 hold what their description says, in FMPy? The numbers must be those of `ancf14 run` and of the unit of FMI 2.0, bit for bit, with
intermediate updates on and off; the description and the terminals must be valid."""

import re
import subprocess
import zipfile
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi3 import FMU3Slave
from fmpy.validation import validate_fmu
from lxml import etree

from conftest import ROOT, run
from test_description import checked_by_fmutool, complaints
from test_simulation import output_step, outputs, simulate, table

HELD = ROOT / "tests/suite/fmi/fmi3/held.toml"


def pack(source, folder) -> Path:
    packed = folder / f"{Path(source).stem}.fmu"
    run("pack", source, "--fmi", "3", "-o", packed)
    return packed


@pytest.fixture(scope="module")
def fmu3(fmu, tmp_path_factory) -> Path:
    """The unit of FMI 3.0 of the model file inside the FMU."""
    folder = tmp_path_factory.mktemp(f"{fmu.stem}-3")
    with zipfile.ZipFile(fmu) as archive:
        (folder / f"{fmu.stem}.toml").write_bytes(archive.read("resources/model.toml"))
    return pack(folder / f"{fmu.stem}.toml", folder)


def element(result, name):
    """The column of a scalar of FMI 2.0 in a result of FMI 3.0: `tip.force[2]` of the array `tip.force`, `s.x[2,1]` of `s.x`."""
    if name in result.dtype.names:
        return result[name].astype(float)
    array, index = re.fullmatch(r"(.*)\[([\d,]+)\]", name).groups()
    place = tuple(int(number) - 1 for number in index.split(","))
    return result[array][(slice(None), *place)].astype(float)


def simulate3(fmu, step, stop, **more):
    return simulate_fmu(str(fmu), validate=False, start_time=0.0, stop_time=stop, output_interval=step, fmi_type="CoSimulation", **more)


def xml(fmu, name):
    with zipfile.ZipFile(fmu) as archive:
        return etree.ElementTree(etree.fromstring(archive.read(name)))


def test_the_files_are_valid(fmu3):
    assert validate_fmu(str(fmu3)) == []
    description, terminals = xml(fmu3, "modelDescription.xml"), xml(fmu3, "terminalsAndIcons/terminalsAndIcons.xml")
    assert complaints("fmi3/fmi3ModelDescription.xsd", description) == []
    assert complaints("fmi3/fmi3TerminalsAndIcons.xsd", terminals) == []
    names = {variable.get("name") for variable in description.find("ModelVariables").iter() if variable.get("name")}
    terminal_names = [terminal.get("name") for terminal in terminals.iter("Terminal")]
    assert len(set(terminal_names)) == len(terminal_names)
    for terminal in terminals.iter("Terminal"):
        members = [member.get("memberName") for member in terminal]
        assert len(set(members)) == len(members) > 0
        assert {member.get("variableName") for member in terminal} <= names
    with zipfile.ZipFile(fmu3) as archive:
        assert archive.read("terminalsAndIcons/icon.png").startswith(b"\x89PNG")
        assert etree.fromstring(archive.read("terminalsAndIcons/icon.svg")).tag == "{http://www.w3.org/2000/svg}svg"


def test_fmutool_finds_nothing(fmu3):
    checked_by_fmutool(fmu3, "3.0")


def test_updates_change_no_bit(fmu3, results, tmp_path):
    """A host that hears of each internal step and reads all outputs there gets the same bits, of every model."""
    header, expected = table(results)
    description = read_model_description(str(fmu3), validate=False)
    places, references, count, told = {}, [], 0, []
    for variable in description.modelVariables:
        if variable.causality == "output" and variable.type == "Float64":
            references.append(variable.valueReference)
            for index in np.ndindex(*(variable.shape or ())):
                inside = ",".join(str(place + 1) for place in index)
                places[f"{variable.name}[{inside}]" if inside else variable.name] = count
                count += 1

    def update(_environment, time, *_more):
        told.append((time, slave.getFloat64(references, count)))

    slave = FMU3Slave(
        guid=description.guid, unzipDirectory=extract(str(fmu3), tmp_path), modelIdentifier=description.coSimulation.modelIdentifier
    )
    slave.instantiate(intermediateUpdate=update, requiredIntermediateVariables=references)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    step = float(description.defaultExperiment.stepSize)
    order = [places[name] for name in header[1:] if name in places]
    columns = [place for place, name in enumerate(header) if name in places]
    for k, row in enumerate(expected):
        if k > 0:
            slave.doStep((k - 1) * step, step)
            assert told[-1][1] == slave.getFloat64(references, count)
        assert np.array_equal(np.array(slave.getFloat64(references, count))[order], row[columns]), f"row {k}"
    assert len(told) >= len(expected) - 1 and len(columns) > 0
    slave.terminate()
    slave.freeInstance()


def test_same_bits_as_the_command_line_and_as_fmi_2(fmu, fmu3, results):
    header, expected = table(results)
    step, stop = output_step(fmu), float(read_model_description(str(fmu), validate=False).defaultExperiment.stopTime)
    result = simulate3(fmu3, step, stop)
    assert np.allclose(result["time"], expected[:, 0], rtol=1e-12, atol=0.0)  # FMPy's own multiples
    for place, name in enumerate(header[1:], start=1):
        assert np.array_equal(element(result, name), expected[:, place]), name
    other, _messages = simulate(fmu, step)
    for name in outputs(fmu):
        assert np.array_equal(element(result, name), other[name].astype(float)), name


def test_the_library_is_that_of_fmi_2(fmu, fmu3):
    def library(path):
        with zipfile.ZipFile(path) as archive:
            (name,) = [name for name in archive.namelist() if name.startswith("binaries/")]
            return archive.read(name)

    assert library(fmu) == library(fmu3)


def test_warnings_are_told_where_logging_is_on(fmu3, warnings):
    experiment = read_model_description(str(fmu3), validate=False).defaultExperiment
    step, stop = float(experiment.stepSize), float(experiment.stopTime)
    for on in [False, True]:
        messages = []
        simulate3(
            fmu3, step, stop, debug_logging=on, logger=lambda _environment, status, category, text: messages.append((status, category, text))
        )
        told = [text.decode().replace("##", "#") for status, _category, text in messages if status > 0]
        assert told == (warnings if on else [])


class Slave:
    """The held arm in FMPy, with intermediate updates if `update` is given."""

    def __init__(self, folder, update=None):
        packed = pack(HELD, folder)
        self.description = read_model_description(str(packed))
        self.reference = {variable.name: variable.valueReference for variable in self.description.modelVariables}
        self.fmu = FMU3Slave(
            guid=self.description.guid, unzipDirectory=extract(str(packed)), modelIdentifier=self.description.coSimulation.modelIdentifier
        )
        tip = [self.reference["tip.position"]] if update else None
        self.fmu.instantiate(earlyReturnAllowed=True, intermediateUpdate=update, requiredIntermediateVariables=tip)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def push(self, force):
        self.fmu.setFloat64([self.reference["push.force"]], force)

    def get(self, name, count=3):
        return self.fmu.getFloat64([self.reference[name]], count)


def test_intermediate_updates(tmp_path):
    """Results with and without updates are bit-identical; during one the tip moves on; a host that asks returns early and goes on from there."""
    told, ask = [], []

    def update(_environment, time, set_requested, get_allowed, finished, can_return, requested, _return_time):
        assert get_allowed and finished and bool(set_requested) == bool(can_return)
        told.append((time, slave.get("tip.position")))
        if ask and time >= ask[0] and can_return:
            requested[0] = True

    slave, alone = Slave(tmp_path, update), Slave(tmp_path)
    for unit in [slave, alone]:
        unit.push([0.0, 0.3, 1.0])
        assert unit.fmu.doStep(0.0, 0.01) == (False, False, False, 0.01)
    assert len(told) == 10
    assert told[-1][1] == slave.get("tip.position") == alone.get("tip.position")
    assert len({tuple(place) for _time, place in told}) == 10
    ask.append(0.0145)
    event, end, early, time = slave.fmu.doStep(0.01, 0.01)
    assert (event, end, early) == (False, False, True) and abs(time - 0.015) < 1e-15
    alone.fmu.doStep(0.01, time - 0.01)
    assert slave.get("tip.velocity") == alone.get("tip.velocity")
    for unit in [slave, alone]:
        unit.fmu.terminate()
        unit.fmu.freeInstance()


def test_inputs_between_internal_steps(tmp_path):
    """An input that is set in the middle acts on the rest: the bits are those of two communication steps."""
    told = []

    def update(_environment, time, set_requested, *_more):
        told.append(time)
        if len(told) == 5 and set_requested:
            slave.push([0.0, 0.3, 1.0])

    slave, other = Slave(tmp_path, update), Slave(tmp_path)
    slave.fmu.doStep(0.0, 0.01)
    other.fmu.doStep(0.0, told[4])
    other.push([0.0, 0.3, 1.0])
    other.fmu.doStep(told[4], 0.01 - told[4])
    assert len(told) == 10
    for name in ["tip.position", "tip.velocity"]:
        assert slave.get(name) == other.get(name)
    untouched = Slave(tmp_path)
    untouched.fmu.doStep(0.0, 0.01)
    assert untouched.get("tip.position") != slave.get("tip.position")
    for unit in [slave, other, untouched]:
        unit.fmu.terminate()
        unit.fmu.freeInstance()


def test_rollback_and_derivatives(tmp_path):
    """A repeated step has the same bits, also from bytes; adjoint and directional derivatives are of one matrix."""
    unit = Slave(tmp_path)
    unit.fmu.doStep(0.0, 0.01)
    state = unit.fmu.getFMUState()
    data = unit.fmu.serializeFMUState(state)
    unit.push([0.0, 0.0, 2.0])
    unit.fmu.doStep(0.01, 0.01)
    first = unit.get("tip.position")
    unknowns, knowns = [unit.reference["tip.position"]], [unit.reference["push.force"]]
    seed, direction = [0.3, -1.0, 2.0], [1.0, 0.5, -0.7]
    forward = unit.fmu.getDirectionalDerivative(unknowns, knowns, direction, 3)
    backward = unit.fmu.getAdjointDerivative(unknowns, knowns, seed, 3)
    assert np.dot(seed, forward) == pytest.approx(np.dot(backward, direction), rel=1e-12)  # sums of the same 9 products
    unit.fmu.setFMUState(state)
    unit.fmu.freeFMUState(state)
    unit.push([0.0, 0.0, 2.0])
    unit.fmu.doStep(0.01, 0.01)
    assert unit.get("tip.position") == first
    copy = unit.fmu.deserializeFMUState(data)
    unit.fmu.setFMUState(copy)
    unit.push([0.0, 0.0, 2.0])
    unit.fmu.doStep(0.01, 0.01)
    assert unit.get("tip.position") == first
    unit.fmu.freeInstance()


def test_the_version_is_chosen(tmp_path):
    """2 is the default; another version is a wrong argument."""
    run("pack", HELD, "-o", tmp_path / "two.fmu")
    run("pack", HELD, "--fmi", "2", "-o", tmp_path / "same.fmu")
    assert (tmp_path / "two.fmu").read_bytes() == (tmp_path / "same.fmu").read_bytes()
    assert read_model_description(str(tmp_path / "two.fmu")).fmiVersion == "2.0"
    from conftest import executable

    refused = subprocess.run([executable(), "pack", HELD, "--fmi", "1", "-o", tmp_path / "one.fmu"], capture_output=True, text=True)
    assert refused.returncode == 2 and "2 or 3" in refused.stderr
