#!/bin/sh
# Builds the command line and the library that goes into FMUs, both with all optimization, into target/fmu. On Linux they run on
# every x86-64 system since 2012 (glibc 2.17): scripts/linker.sh.
#
#     sh scripts/build.sh            what is shipped
#     sh scripts/build.sh --quick    the same for this computer, into target/quick, in a shorter time
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
case $(uname -s) in
    Darwin) suffix=dylib ;;
    *) suffix=so ;;
esac
library=libancf14.$suffix
built_library=libancf14_library.$suffix
case ${1:-} in
    "") ;;
    --quick)
        # One command, so that both share all that is compiled.
        cargo build --locked --profile quick --package ancf14-library --package ancf14-cli
        cp "$target/quick/$built_library" "$target/quick/$library"
        exit
        ;;
    *)
        echo "usage: sh scripts/build.sh [--quick]" >&2
        exit 2
        ;;
esac
. scripts/target.sh
fmu=$target/fmu
mkdir -p "$fmu"
# On its own: together with its rlib, cargo would silently drop the link-time optimization of the library.
cargo rustc --locked --profile fmu --package ancf14-library --lib --crate-type cdylib
# What was built from other sources is not delivered with it: the libraries for other platforms and the program for Windows (scripts/build-platforms.sh), the component (scripts/build-component.sh), the solver of pages (scripts/build-wasm.sh).
if [ -f "$fmu/$library" ] && ! cmp -s "$built/$built_library" "$fmu/$library"; then
    rm -rf "$fmu/aarch64-linux" "$fmu/x86_64-windows"
fi
scripts/build-component.sh --check "$fmu/wasm32-wasip2/ancf14.wasm" 2> /dev/null || rm -rf "$fmu/wasm32-wasip2"
scripts/build-wasm.sh --check "$fmu/ancf14.wasm" 2> /dev/null || rm -f "$fmu/ancf14.wasm"
install -m 755 "$built/$built_library" "$fmu/$library"
# The Python package is selected too, so that cargo chooses the features of scripts/wheel.sh, which then finds all but the module compiled; only the program is built.
cargo build --locked --profile fmu --package ancf14-cli --package ancf14-python --bin ancf14
if ! cmp -s "$built/ancf14" "$fmu/ancf14"; then
    rm -f "$fmu/x86_64-windows/ancf14.exe"
fi
install -m 755 "$built/ancf14" "$fmu/ancf14"
