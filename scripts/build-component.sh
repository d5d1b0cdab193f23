#!/bin/sh
# Builds the library of FMUs as a component of WebAssembly, as the working draft of FMI-LS-WASM describes it: target/fmu/wasm32-wasip2/ancf14.wasm, where `ancf14 pack --fmi 3`
# finds it. scripts/wasm.sh says what is needed. wasm-tools, of a Python package, makes a component of the module.
#
#     sh scripts/build-component.sh                 builds it, unless it is there and belongs to these sources
#     sh scripts/build-component.sh --check FILE    fails if FILE is missing or of other sources
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
environment=$target/component-env
folder=$target/fmu/wasm32-wasip2
. scripts/wasm.sh
if [ $# -eq 0 ] && ! cmp -s scripts/component-requirements.txt "$environment/made-from.txt"; then
    rm -rf "$environment"
    "${PYTHON:-python3}" -m venv "$environment"
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check --requirement scripts/component-requirements.txt
    cp scripts/component-requirements.txt "$environment/made-from.txt"
fi
sources=$(hash_of crates/component scripts/build-component.sh scripts/component-requirements.txt)
stop_if_built "$folder/ancf14.wasm" "$@"
build_wasm ancf14-component
mkdir -p "$folder"
"$environment/bin/wasm-tools" component new "$target/$triple/page/ancf14_component.wasm" -o "$target/$triple/page/ancf14_component.component.wasm"
mark "$target/$triple/page/ancf14_component.component.wasm" "$folder/ancf14.wasm"
