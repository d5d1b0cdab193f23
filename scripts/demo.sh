#!/bin/sh
# The whole way once: builds everything, simulates a model, packs it, runs it in FMPy, compares the numbers.
# Needs Rust, a C compiler (as linker) and Python 3.
set -eu

cd "$(dirname "$0")/.."
scripts/build.sh
scripts/python-env.sh
out=target/demo
rm -rf "$out"
mkdir -p "$out"
echo "Simulating models/pendulum.toml ..."
target/fmu/ancf14 run models/pendulum.toml --out "$out/pendulum-results"
target/fmu/ancf14 check models/pendulum.toml --draw "$out/pendulum.svg" > "$out/pendulum-variables.txt"
target/fmu/ancf14 pack models/pendulum.toml -o "$out/Pendulum.fmu"
echo "Running $out/Pendulum.fmu in FMPy ..."
target/python-env/bin/python scripts/compare.py "$out/Pendulum.fmu" "$out/pendulum-results/results.csv"
echo "Results and plots: $out/pendulum-results, the mechanism as drawn: $out/pendulum.svg"
