"""A unit whose model file has `correction = true` tells corrected results, those of `ancf14 run`, in both versions of FMI."""

import numpy as np
import pytest
from conftest import ROOT, run
from fmpy import read_model_description, simulate_fmu
from test_fmi3 import element
from test_simulation import table

STOP = 0.3
NAME = "middle.displacement[2]"


@pytest.mark.parametrize("version", ["2", "3"])
def test_same_bits_as_the_command_line(version, tmp_path):
    shaft = (ROOT / "models" / "rotating_shaft.toml").read_text()
    fmu, found = tmp_path / "shaft.fmu", {}
    for key in ["correction = true", ""]:
        model = tmp_path / "shaft.toml"
        model.write_text(shaft.replace("stop = 2.5\n", f"stop = {STOP}\n{key}\n"))
        if key:
            run("pack", model, "-o", fmu, "--fmi", version)
        run("run", model, "-o", tmp_path / "results")
        header, rows = table(tmp_path / "results" / "results.csv")
        found[key] = rows[:, header.index(NAME)]
    interval = float(read_model_description(str(fmu)).defaultExperiment.stepSize)
    result = element(simulate_fmu(str(fmu), stop_time=STOP, output_interval=interval), NAME)
    assert np.array_equal(result, found["correction = true"])
    assert not np.array_equal(result, found[""])
