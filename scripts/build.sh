#!/bin/sh
# Builds the command line and the library that goes into FMUs, both with all optimization, into target/fmu. On Linux they run on
# every x86-64 system since 2012 (glibc 2.17): scripts/linker.sh.
#
#     sh scripts/build.sh            what is shipped
#     sh scripts/build.sh --quick    the same for this computer, into target/quick, in a shorter time
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
case ${1:-} in
    "") ;;
    --quick)
        # One command, so that both share all that is compiled.
        exec cargo build --locked --profile quick --package ancf14 --package ancf14-cli
        ;;
    *)
        echo "usage: sh scripts/build.sh [--quick]" >&2
        exit 2
        ;;
esac
. scripts/target.sh
case $(uname -s) in
    Darwin) library=libancf14.dylib ;;
    *) library=libancf14.so ;;
esac
fmu=$target/fmu
mkdir -p "$fmu"
# deliver FILE: copies it into target/fmu. What was built from other sources is not delivered with it: the libraries for other platforms (scripts/build-platforms.sh) if the
# library changes, and the solver of pages (scripts/build-wasm.sh) if library or program change.
deliver() {
    if [ -f "$fmu/$1" ] && ! cmp -s "$built/$1" "$fmu/$1"; then
        rm -f "$fmu/ancf14.wasm"
        if [ "$1" = "$library" ]; then
            rm -rf "$fmu/aarch64-linux" "$fmu/x86_64-windows"
        fi
    fi
    install -m 755 "$built/$1" "$fmu/$1"
}

# On its own: together with the rlib, cargo would silently drop the link-time optimization. First, and delivered at once, because the builds of the program and of the
# wheel put a library without that in its place.
cargo rustc --locked --profile fmu --package ancf14 --lib --crate-type cdylib
deliver "$library"
# The Python package is selected too, so that cargo chooses the features of scripts/wheel.sh, which then finds all but the module compiled; only the program is built.
cargo build --locked --profile fmu --package ancf14-cli --package ancf14-python --bin ancf14
deliver ancf14
