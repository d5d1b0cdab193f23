#!/bin/sh
# Builds the library of FMUs and the program for Windows (x86-64) on Debian: target/fmu/x86_64-windows/ancf14.dll, where `ancf14 pack` finds it, and
# ancf14.exe beside it. Needs what scripts/windows.sh needs.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
. scripts/windows.sh
built=$target/$triple/fmu
folder=$target/fmu/x86_64-windows
cargo rustc --locked --profile fmu --package ancf14-library --lib --crate-type cdylib --target "$triple" -Z "$standard_library"
# The Python package is selected too, as in scripts/build.sh, so that cargo chooses the features of scripts/wheel.sh.
cargo build --locked --profile fmu --package ancf14-cli --package ancf14-python --bin ancf14 --target "$triple" -Z "$standard_library"
mkdir -p "$folder"
cp "$built/ancf14_library.dll" "$folder/ancf14.dll"
cp "$built/ancf14.exe" "$folder/ancf14.exe"
