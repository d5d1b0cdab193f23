#!/bin/sh
# The whole way once: a quick build, a simulation, an FMU, which runs in FMPy, and a comparison of the numbers.
# Needs Rust, a C compiler (as linker) and Python 3.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-target}
scripts/python-env.sh &
environment=$!
# A failed build does not leave the other one behind.
trap 'wait "$environment" || true' EXIT
scripts/build.sh --quick
wait "$environment"
trap - EXIT
ancf14=$target/quick/ancf14
out=$target/demo
rm -rf "$out"
mkdir -p "$out"
echo "Simulating models/pendulum.toml ..."
"$ancf14" run models/pendulum.toml --out "$out/pendulum-results"
"$ancf14" check models/pendulum.toml --draw "$out/pendulum.svg" > "$out/pendulum-variables.txt"
"$ancf14" pack models/pendulum.toml -o "$out/Pendulum.fmu"
echo "Running $out/Pendulum.fmu in FMPy ..."
"$target/python-env/bin/python" scripts/compare.py "$out/Pendulum.fmu" "$out/pendulum-results/results.csv"
echo "Results and plots: $out/pendulum-results, the mechanism as drawn: $out/pendulum.svg"
echo "The program is $ancf14"
