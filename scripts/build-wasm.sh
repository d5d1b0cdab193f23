#!/bin/sh
# Builds the solver for the page of `ancf14 view --live`: target/fmu/ancf14.wasm, next to the program. scripts/wasm.sh says what is needed.
#
#     sh scripts/build-wasm.sh                 builds it, unless it is there and belongs to these sources
#     sh scripts/build-wasm.sh --check FILE    fails if FILE is missing or of other sources
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
. scripts/wasm.sh
sources=$(hash_of crates/live crates/view/Cargo.toml crates/view/src viewer/dist licenses scripts/build-wasm.sh)
stop_if_built "$target/fmu/ancf14.wasm" "$@"
build_wasm ancf14-live
mkdir -p "$target/fmu"
mark "$target/$triple/page/ancf14_live.wasm" "$target/fmu/ancf14.wasm"
