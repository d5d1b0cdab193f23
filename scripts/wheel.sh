#!/bin/sh
# Builds the Python wheel into target/wheels: the module, the command line, the library of FMUs and the solver of pages. On Linux it runs on
# every x86-64 system since 2014 (manylinux2014): scripts/linker.sh. Needs what scripts/build.sh builds; the solver
# is there if scripts/build-wasm.sh has built it.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
. scripts/target.sh
scripts/python-env.sh
package=python/python/ancf14
cp "$target/fmu/libancf14.so" "$package/libancf14.so"
# Libraries for other platforms, of scripts/build-platforms.sh, which `pack` puts into FMUs.
for file in aarch64-linux/libancf14.so x86_64-windows/ancf14.dll; do
    rm -rf "${package:?}/${file%/*}"
    if [ -f "$target/fmu/$file" ]; then
        mkdir "$package/${file%/*}"
        cp "$target/fmu/$file" "$package/$file"
    fi
done
rm -f "$package/ancf14.wasm"
if [ -f "$target/fmu/ancf14.wasm" ]; then
    cp "$target/fmu/ancf14.wasm" "$package/ancf14.wasm"
fi
cp LICENSE licenses/program.txt licenses/solver.txt licenses/viewer.txt python/
rm -rf "$target/wheels"
set --
if [ "$(uname -sm)" = "Linux x86_64" ]; then
    set -- --compatibility manylinux2014
fi
"$target/python-env/bin/python" -m maturin build --quiet --locked --profile fmu --manifest-path python/Cargo.toml \
    --interpreter "$target/python-env/bin/python" --out "$target/wheels" "$@"
