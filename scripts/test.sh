#!/bin/sh
# All tests: formatting, lints, Rust, C (a part of the Rust suite), the page of `ancf14 view` in Chromium, the FMUs of all models in FMPy, libcosim and
# fmutool, and what a release has: the archive and the Python wheel. The solver of pages is tested as well where it is there: scripts/build-wasm.sh, then
# scripts/viewer.sh. Needs Rust, a C and C++ compiler, Python 3, and pkg-config, valgrind, node and Chromium (installed here if that is possible).
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
scripts/tools.sh
cargo fmt --all -- --check
mkdir -p "$target"

# Builds what users get, and tests it.
delivered() {
    ANCF14_LIVE=no scripts/release.sh > "$target/release.log" 2>&1 || {
        cat "$target/release.log"
        return 1
    }
    scripts/viewer.sh
    ANCF14=target/fmu/ancf14 target/python-env/bin/python -m pytest -q -p no:cacheprovider tests/fmpy
    scripts/release-test.sh
}

# Runs beside the Rust tests: the optimized build and the hosts use a single core.
(set -e; delivered) > "$target/delivered.log" 2>&1 &
delivered=$!
trap 'kill "$delivered" 2> /dev/null || true' EXIT
cargo clippy --locked --workspace --all-targets --quiet -- --deny warnings
cargo test --locked
RUSTDOCFLAGS='--deny warnings' cargo doc --locked --no-deps --quiet
passed=true
wait "$delivered" || passed=false
trap - EXIT
cat "$target/delivered.log"
[ "$passed" = true ]
