"""Runs an FMU in FMPy and compares every output at every time with results.csv of `ancf14 run`, bit for bit.

    python compare.py MODEL.fmu results.csv
"""

import csv
import sys

from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu


def main(fmu, results):
    problems = validate_fmu(fmu)
    if problems:
        sys.exit("FMPy finds problems in the FMU:\n" + "\n".join(problems))
    experiment = read_model_description(fmu).defaultExperiment
    got = simulate_fmu(fmu, stop_time=float(experiment.stopTime), output_interval=float(experiment.stepSize))
    with open(results, newline="") as file:
        header, *rows = csv.reader(file)
    if len(rows) != len(got):
        sys.exit(f"FMPy has {len(got)} rows, {results} has {len(rows)}")
    different = 0
    for row, own in zip(rows, got):
        # Column 0 is time: FMPy's own multiples of the step, equal up to round-off.
        different += sum(float(cell) != float(own[name]) for name, cell in zip(header[1:], row[1:]))
    values = len(rows) * (len(header) - 1)
    last = ", ".join(f"{name} = {cell}" for name, cell in zip(header[:4], rows[-1][:4]))
    print(f"{fmu}: no problems; {values} values at {len(rows)} times, {different} differ from {results}")
    print(f"last row: {last}")
    if different:
        sys.exit(1)


main(*sys.argv[1:])
