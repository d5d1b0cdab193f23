#!/bin/sh
# Installs what scripts/build.sh has built below the folder PREFIX: the program, the header, the library (the static one, those for other platforms and the solver of
# pages too, if they are there), files for pkg-config and CMake, licences. Nothing installed knows PREFIX: the folder may be moved.
#
#     sh scripts/build.sh && sh scripts/install.sh PREFIX
#     sh scripts/build.sh --quick && sh scripts/install.sh PREFIX --quick
#
# ANCF14_BUILD is the folder that was built into [default: target/fmu, with --quick target/quick].
set -eu

case $#,${2:-} in
    1,) folder=fmu quick= ;;
    2,--quick) folder=quick quick=" --quick" ;;
    *) set -- "" ;;
esac
if [ -z "$1" ]; then
    echo "usage: sh scripts/install.sh PREFIX [--quick]" >&2
    exit 2
fi
mkdir -p "$1"
prefix=$(cd "$1" && pwd)
cd "$(dirname "$0")/.."
build=${ANCF14_BUILD:-target/$folder}
case $(uname -s) in
    Darwin) library=libancf14.dylib ;;
    *) library=libancf14.so ;;
esac
for file in ancf14 "$library"; do
    if [ ! -f "$build/$file" ]; then
        echo "$build/$file is missing; build it first: sh scripts/build.sh$quick" >&2
        exit 1
    fi
done
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
# fill TEMPLATE FILE: the template with the version and the library's name.
fill() {
    sed -e "s/@VERSION@/$version/" -e "s/@LIBRARY@/$library/" "scripts/install/$1" > "$2"
    chmod 644 "$2"
}

cmake=$prefix/lib/cmake/ancf14
licences=$prefix/share/doc/ancf14
mkdir -p "$prefix/bin" "$prefix/include" "$prefix/lib/pkgconfig" "$cmake" "$licences"
install -m 755 "$build/ancf14" "$prefix/bin/ancf14"
install -m 644 include/ancf14.h "$prefix/include/ancf14.h"
install -m 755 "$build/$library" "$prefix/lib/$library"
# Libraries for other platforms, of scripts/build-platforms.sh, which `ancf14 pack` puts into FMUs.
for file in aarch64-linux/libancf14.so x86_64-windows/ancf14.dll; do
    if [ -f "$build/$file" ]; then
        mkdir -p "$prefix/lib/${file%/*}"
        install -m 755 "$build/$file" "$prefix/lib/$file"
    fi
done
if [ -f "$build/ancf14.wasm" ]; then
    install -m 644 "$build/ancf14.wasm" "$prefix/lib/ancf14.wasm"
fi
if [ -f "$build/libancf14.a" ]; then
    install -m 644 "$build/libancf14.a" "$prefix/lib/libancf14.a"
fi
fill ancf14.pc.in "$prefix/lib/pkgconfig/ancf14.pc"
fill ancf14Config.cmake.in "$cmake/ancf14Config.cmake"
fill ancf14ConfigVersion.cmake.in "$cmake/ancf14ConfigVersion.cmake"
install -m 644 LICENSE licenses/* "$licences"
