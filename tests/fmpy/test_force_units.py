"""A unit that is only a spring and a damper between the ground and a frame that its host moves: are its force and the force's derivative right, in FMI 2.0 and 3.0?"""

import numpy as np
import pytest
from conftest import ROOT, run
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

MODEL = ROOT / "tests/suite/fmi/spring_unit.toml"
STIFFNESS, DAMPING, STEP = 100.0, 2.0, 0.01


@pytest.mark.parametrize("version", [2, 3])
def test_spring_units(tmp_path, version):
    run("pack", "--fmi", str(version), MODEL, "-o", tmp_path / "unit.fmu")
    description = read_model_description(str(tmp_path / "unit.fmu"))
    folder = extract(str(tmp_path / "unit.fmu"))
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    unit = (FMU2Slave if version == 2 else FMU3Slave)(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="unit",
    )
    unit.instantiate()
    if version == 2:
        unit.setupExperiment(startTime=0.0)
        unit.enterInitializationMode()
        unit.exitInitializationMode()
        tip, force, grip = references["tip.position[1]"], references["strut.force"], references["grip.applied_force[1]"]
        push, read = (lambda way: unit.setReal([tip], [way])), (lambda: unit.getReal([force, grip]))
    else:
        unit.enterInitializationMode(startTime=0.0)
        unit.exitInitializationMode()
        tip, force, grip = references["tip.position"], references["strut.force"], references["grip.applied_force"]
        push = lambda way: unit.setFloat64([tip], [way, 0.0, 0.0])
        read = lambda: unit.getFloat64([force, grip], 4)[:2]
    for step in range(1, 11):
        speed = 0.5
        push(speed * STEP * step)
        unit.doStep((step - 1) * STEP, STEP)
    tension, pull = read()
    expected = STIFFNESS * speed * STEP * 10 + DAMPING * speed
    # Round-off of 6 N; the speed is that of the host's last two values.
    assert abs(tension - expected) < 1e-9 and abs(pull + expected) < 1e-9
    if version == 2:
        # At constant speed the force grows by the stiffness alone.
        rate = unit.getRealOutputDerivatives([force], [1]) if hasattr(unit, "getRealOutputDerivatives") else None
        if rate is not None:
            assert abs(rate[0] - STIFFNESS * speed) < 1e-6
        # Over a step, the way reaches its new value, and the speed of it.
        slope = unit.getDirectionalDerivative([force], [tip], [1.0])[0]
        assert slope > STIFFNESS and np.isfinite(slope)
    unit.terminate()
    unit.freeInstance()
