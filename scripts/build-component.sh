#!/bin/sh
# Builds the library of FMUs as a component of WebAssembly, as the working draft of FMI-LS-WASM describes it: target/fmu/wasm32-wasip2/ancf14.wasm, where `ancf14 pack --fmi 3`
# finds it. It needs what scripts/build-wasm.sh needs. wasm-tools, of a Python package, makes a component of the module.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
environment=$target/component-env
folder=$target/fmu/wasm32-wasip2
if ! cmp -s scripts/component-requirements.txt "$environment/made-from.txt"; then
    rm -rf "$environment"
    "${PYTHON:-python3}" -m venv "$environment"
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check --requirement scripts/component-requirements.txt
    cp scripts/component-requirements.txt "$environment/made-from.txt"
fi
. scripts/wasm.sh
build_wasm ancf14-component
mkdir -p "$folder"
"$environment/bin/wasm-tools" component new "$target/$triple/page/ancf14_component.wasm" -o "$folder/ancf14.wasm.part"
mv "$folder/ancf14.wasm.part" "$folder/ancf14.wasm"
