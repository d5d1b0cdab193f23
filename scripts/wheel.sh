#!/bin/sh
# Builds a Python wheel into target/wheels: the module, the command line, the library of FMUs and the solver of pages. On Linux it runs on
# every system since 2014 (manylinux2014): scripts/linker.sh.
#
#     sh scripts/wheel.sh                  for this computer; needs what scripts/build.sh builds
#     sh scripts/wheel.sh aarch64-linux    for Linux on 64-bit ARM, from Linux on x86-64; also needs what scripts/build-aarch64.sh builds
#     sh scripts/wheel.sh x86_64-windows   for Windows on x86-64, from Linux on x86-64; also needs what scripts/build-windows.sh builds
#
# The solver is there if scripts/build-wasm.sh has built it, and libraries for other platforms, which `pack` puts into FMUs, if scripts/build-platforms.sh has.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
case ${1:-} in
    "")
        . scripts/target.sh
        scripts/python-env.sh
        library=libancf14.so
        others="aarch64-linux/libancf14.so x86_64-windows/ancf14.dll"
        rm -rf "$target/wheels"
        set -- --interpreter "$target/python-env/bin/python"
        if [ "$(uname -sm)" = "Linux x86_64" ]; then
            set -- "$@" --compatibility manylinux2014
        fi
        ;;
    aarch64-linux)
        . scripts/aarch64.sh
        library=aarch64-linux/libancf14.so
        others="x86_64-linux/libancf14.so x86_64-windows/ancf14.dll"
        rm -f "$target"/wheels/*_aarch64.whl
        set -- --target "$triple" -Z "$standard_library" --compatibility manylinux2014
        ;;
    x86_64-windows)
        scripts/python-env.sh
        . scripts/windows.sh
        library=x86_64-windows/ancf14.dll
        others="x86_64-linux/libancf14.so aarch64-linux/libancf14.so"
        rm -f "$target"/wheels/*-win_amd64.whl
        set -- --target "$triple" -Z "$standard_library"
        ;;
    *)
        echo "usage: sh scripts/wheel.sh [aarch64-linux | x86_64-windows]" >&2
        exit 2
        ;;
esac
package=python/python/ancf14
rm -f "$package/libancf14.so" "$package/ancf14.dll"
cp "$target/fmu/$library" "$package/${library##*/}"
rm -rf "$package/x86_64-linux" "$package/aarch64-linux" "$package/x86_64-windows"
for file in $others; do
    # The library of this computer lies in no folder.
    from=$target/fmu/${file#x86_64-linux/}
    if [ -f "$from" ]; then
        mkdir "$package/${file%/*}"
        cp "$from" "$package/$file"
    fi
done
rm -f "$package/ancf14.wasm"
if [ -f "$target/fmu/ancf14.wasm" ]; then
    cp "$target/fmu/ancf14.wasm" "$package/ancf14.wasm"
fi
cp LICENSE licenses/program.txt licenses/solver.txt licenses/viewer.txt python/
"$target/python-env/bin/python" -m maturin build --quiet --locked --profile fmu --manifest-path python/Cargo.toml --out "$target/wheels" "$@"
