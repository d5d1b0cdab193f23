#!/bin/sh
# Builds the command line and the library that goes into FMUs, both with all optimization, into target/fmu. On Linux they run on
# every x86-64 system since 2012 (glibc 2.17): scripts/linker.sh.
set -eu

cd "$(dirname "$0")/.."
set --
if [ "$(uname -sm)" = "Linux x86_64" ]; then
    scripts/python-env.sh
    set -- -C linker=scripts/linker.sh -C linker-features=-lld
fi
cargo rustc --locked --profile fmu --package ancf14-cli --bin ancf14 -- "$@"
fmu=${CARGO_TARGET_DIR:-$PWD/target}/fmu
before=$(cksum "$fmu/libancf14.so" 2> /dev/null || true)
# On its own: together with the rlib, cargo would silently drop the link-time optimization.
cargo rustc --locked --profile fmu --package ancf14 --lib --crate-type cdylib -- "$@"
# Libraries for other platforms (scripts/build-platforms.sh) that were built from other sources are not packed beside this one.
if [ -n "$before" ] && [ "$(cksum "$fmu/libancf14.so")" != "$before" ]; then
    rm -rf "$fmu/aarch64-linux" "$fmu/x86_64-windows"
fi
