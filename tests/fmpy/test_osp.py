"""Does another master, libcosim of the Open Simulation Platform, compute the same bits? It keeps time in nanoseconds and
gathers everything through one native library, so it sees the unit differently than FMPy does."""

import csv

from fmpy import read_model_description
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave


def test_same_bits_as_the_command_line(fmu, results):
    description = read_model_description(str(fmu), validate=False)
    step = float(description.defaultExperiment.stepSize) * 1e9
    assert abs(step - round(step)) < 1e-6, "libcosim counts time in whole nanoseconds: give the model such an output step"
    with open(results, newline="") as file:
        names, *rows = csv.reader(file)
    reals = [v for v in description.modelVariables if v.causality == "output" and v.type == "Real"]
    references = [v.valueReference for v in reals]
    places = [names.index(v.name) for v in reals]

    execution = CosimExecution.from_step_size(step_size=round(step))
    slave = execution.add_local_slave(CosimLocalSlave(fmu_path=str(fmu), instance_name="unit"))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer=observer)
    for row in rows[1:]:
        assert execution.step()
        got = list(observer.last_real_values(slave_index=slave, variable_references=references))
        assert got == [float(row[place]) for place in places], row[0]
