#!/bin/sh
# Makes of the folder PREFIX, which scripts/install.sh has filled on Linux on x86-64, one for Windows: the program and the library of FMUs for Windows in bin/ and lib/, and beside the
# library those for other platforms.
#
#     sh scripts/install-windows.sh PREFIX WINDOWS
#
# ANCF14_BUILD is the folder that was built into [default: target/fmu].
set -eu

if [ $# != 2 ]; then
    echo "usage: sh scripts/install-windows.sh PREFIX WINDOWS" >&2
    exit 2
fi
cp -r "$1" "$2"
windows=$(cd "$2" && pwd)
cd "$(dirname "$0")/.."
build=${ANCF14_BUILD:-target/fmu}
# Files for pkg-config and CMake name the library of Linux.
rm -rf "$windows/bin/ancf14" "$windows/lib/pkgconfig" "$windows/lib/cmake" "$windows/lib/x86_64-windows" "$windows/lib/libancf14.a"
install -m 755 "$build/x86_64-windows/ancf14.exe" "$windows/bin/ancf14.exe"
install -m 755 "$build/x86_64-windows/ancf14.dll" "$windows/lib/ancf14.dll"
mkdir "$windows/lib/x86_64-linux"
mv "$windows/lib/libancf14.so" "$windows/lib/x86_64-linux/libancf14.so"
