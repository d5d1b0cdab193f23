#!/bin/sh
# All tests: formatting, lints, Rust, C (a part of the Rust suite), and the FMUs of all models in FMPy, libcosim and fmutool.
# Needs Rust, a C compiler, valgrind (installed here if that is possible) and Python 3.
set -eu

cd "$(dirname "$0")/.."
scripts/valgrind.sh
cargo fmt --all -- --check
cargo clippy --locked --all-targets --quiet -- --deny warnings
cargo test --locked
scripts/build.sh
scripts/python-env.sh
ANCF14=target/fmu/ancf14 target/python-env/bin/python -m pytest -q -p no:cacheprovider tests/fmpy
