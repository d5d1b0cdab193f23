"""Does the plainest host get through every unit? It adds up its time as the standard's own example does (section 4.2.5), ends with whatever
is left, and takes any status but fmi2OK for the end of the run, and any invalid operation or division by zero. It asks for both kinds of derivatives wherever the standard allows it."""

import math
from ctypes import CDLL, c_double, c_int, c_uint

import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

OK = 0
# Of the C library's fenv.h for x86: what compilers of Fortran and Pascal let hosts die of.
INVALID, DIVISION_BY_ZERO = 1, 4
MATHS = CDLL("libm.so.6")
# Communication steps: the unit's own, and that of a common master.
STEPS = [None, 1e-2]


class Host:
    """An instance whose every call must return fmi2OK."""

    def __init__(self, fmu, folder):
        self.description = read_model_description(str(fmu), validate=False)
        self.slave = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=extract(str(fmu), str(folder)),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="unit",
        )
        self.slave.instantiate()
        reals = [v for v in self.description.modelVariables if v.type == "Real"]
        self.inputs = [v for v in reals if v.causality == "input"]
        self.outputs = [v for v in reals if v.causality == "output"]
        self.parameters = [v for v in reals if v.causality == "parameter"]

    def call(self, name, *arguments, raises=0):
        """FMPy raises at errors only. `raises`: floating-point exceptions that may be raised."""
        function = getattr(self.slave.dll, name)
        MATHS.feclearexcept(INVALID | DIVISION_BY_ZERO)
        status = function(self.slave.component, *arguments)
        raised = MATHS.fetestexcept(INVALID | DIVISION_BY_ZERO)
        assert status == OK, f"{name}: status {status}"
        assert raised & ~raises == 0, f"{name}: floating-point exceptions {raised}"

    def references(self, variables):
        return (c_uint * len(variables))(*[v.valueReference for v in variables])

    def initialize(self, start=0.0):
        self.call("fmi2SetupExperiment", c_int(0), c_double(0.0), c_double(start), c_int(0), c_double(0.0))
        self.call("fmi2EnterInitializationMode")

    def values(self):
        found = (c_double * len(self.outputs))()
        self.call("fmi2GetReal", self.references(self.outputs), len(self.outputs), found)
        return list(found)

    def slopes(self):
        """Derivatives of all outputs by time."""
        n = len(self.outputs)
        found = (c_double * n)()
        self.call("fmi2GetRealOutputDerivatives", self.references(self.outputs), n, (c_int * n)(*[1] * n), found)
        return list(found)

    def derivatives(self, known, raises=0):
        """Derivatives of all outputs by a variable."""
        n = len(self.outputs)
        found = (c_double * n)()
        one = (c_double * 1)(1.0)
        arguments = self.references(self.outputs), n, self.references([known]), 1, one, found
        self.call("fmi2GetDirectionalDerivative", *arguments, raises=raises)
        return list(found)

    def step(self, time, step):
        self.call("fmi2DoStep", c_double(time), c_double(step), c_int(1))

    def close(self):
        self.slave.terminate()
        self.slave.freeInstance()


def finite(values):
    return all(map(math.isfinite, values))


@pytest.mark.parametrize("step", STEPS)
def test_time_added_up(fmu, step, tmp_path):
    host = Host(fmu, tmp_path)
    experiment = host.description.defaultExperiment
    stop = float(experiment.stopTime)
    step = step or float(experiment.stepSize)
    host.initialize()
    host.call("fmi2ExitInitializationMode")
    time = 0.0
    while time < stop:
        h = min(step, stop - time)
        host.step(time, h)
        time += h
    assert finite(host.values())
    host.close()


def test_derivatives_at_the_start(fmu, tmp_path):
    host = Host(fmu, tmp_path)
    host.initialize()
    assert finite(host.slopes())
    for known in host.inputs + host.parameters[:1]:
        # The start is found again with other parameters; an attempt that goes astray may do so by way of infinities.
        assert finite(host.derivatives(known, raises=INVALID | DIVISION_BY_ZERO))
    host.call("fmi2ExitInitializationMode")
    assert finite(host.slopes())
    for known in host.inputs:
        assert host.derivatives(known) == [0.0] * len(host.outputs)
    host.step(0.0, 1e-3)
    assert finite(host.slopes())
    for known in host.inputs:
        assert finite(host.derivatives(known))
    host.close()
