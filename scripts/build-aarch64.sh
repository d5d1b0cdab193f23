#!/bin/sh
# Builds the library of FMUs for Linux on 64-bit ARM on Debian: target/fmu/aarch64-linux/libancf14.so, where
# `ancf14 pack` finds it. Needs what scripts/aarch64.sh needs.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
. scripts/aarch64.sh
cargo rustc --locked --profile fmu --package ancf14-library --lib --crate-type cdylib --target "$triple" -Z "$standard_library"
mkdir -p "$target/fmu/aarch64-linux"
cp "$target/$triple/fmu/libancf14_library.so" "$target/fmu/aarch64-linux/libancf14.so"
