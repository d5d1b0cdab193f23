#!/bin/sh
# Builds the library of FMUs for Windows (x86-64) on Debian: target/fmu/x86_64-windows/ancf14.dll, where `ancf14 pack` finds it. The standard library is built from
# its source, since the compiler of the distribution is all there is. Needs, of Debian:
#
#     apt-get install rustc-web cargo-web rust-web-src gcc-mingw-w64-x86-64
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
# Debian's own compiler, not one of rustup; building the standard library is an unstable feature of cargo.
export PATH=/usr/bin:/bin RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1
/usr/bin/cargo rustc --locked --profile fmu --package ancf14-library --lib --crate-type cdylib --target x86_64-pc-windows-gnu -Zbuild-std=std,panic_unwind
mkdir -p "$target/fmu/x86_64-windows"
cp "$target/x86_64-pc-windows-gnu/fmu/ancf14_library.dll" "$target/fmu/x86_64-windows/ancf14.dll"
