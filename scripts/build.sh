#!/bin/sh
# Builds the command line and the library that goes into FMUs, both with all optimization, into target/fmu.
set -eu

cd "$(dirname "$0")/.."
cargo build --locked --profile fmu --bin ancf14
# On its own: together with the rlib, cargo would silently drop the link-time optimization.
cargo rustc --locked --profile fmu --lib --crate-type cdylib
