#!/bin/sh
# Builds the library of FMUs for Linux on 64-bit ARM (aarch64, glibc 2.17) on Debian: target/fmu/aarch64-linux/libancf14.so, where
# `ancf14 pack` finds it. The standard library is built from its source, since the compiler of the distribution is all there is. Needs Python 3.11 or later and, of Debian:
#
#     apt-get install rustc-web cargo-web rust-web-src
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
scripts/python-env.sh
# Debian's own compiler, not one of rustup; building the standard library is an unstable feature of cargo.
export PATH=/usr/bin:/bin RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 ANCF14_MACHINE=aarch64
/usr/bin/cargo rustc --locked --profile fmu --package ancf14-library --lib --crate-type cdylib --target aarch64-unknown-linux-gnu -Zbuild-std=std,panic_unwind -- \
    -C linker=scripts/linker.sh
mkdir -p "$target/fmu/aarch64-linux"
cp "$target/aarch64-unknown-linux-gnu/fmu/libancf14_library.so" "$target/fmu/aarch64-linux/libancf14.so"
