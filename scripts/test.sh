#!/bin/sh
# All tests: formatting, lints, Rust, C (a part of the Rust suite), the page of `ancf14 view` in Chromium, the FMUs of all models in FMPy, libcosim and
# fmutool, and what a release has: the archive and the Python wheel. Needs Rust, a C and C++ compiler, Python 3, and pkg-config, valgrind, node and Chromium (installed here if that is possible).
set -eu

cd "$(dirname "$0")/.."
scripts/tools.sh
cargo fmt --all -- --check
cargo clippy --locked --workspace --all-targets --quiet -- --deny warnings
cargo test --locked
RUSTDOCFLAGS='--deny warnings' cargo doc --locked --no-deps --quiet
scripts/build.sh
scripts/viewer.sh
scripts/python-env.sh
ANCF14=target/fmu/ancf14 target/python-env/bin/python -m pytest -q -p no:cacheprovider tests/fmpy
scripts/release.sh
scripts/release-test.sh
