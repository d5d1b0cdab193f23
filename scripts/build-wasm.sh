#!/bin/sh
# Builds the solver for the page of `ancf14 view --live`: target/fmu/ancf14.wasm, next to the program. scripts/wasm.sh says what is needed.
#
#     sh scripts/build-wasm.sh                 builds it, unless it is there and belongs to these sources
#     sh scripts/build-wasm.sh --check FILE    fails if FILE is missing or of other sources
#
# The last section of the module is the SHA-256 of all that it is built from, as 64 hexadecimal digits.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
module=${2:-$target/fmu/ancf14.wasm}
sources=$(find Cargo.toml Cargo.lock src crates/live crates/view/Cargo.toml crates/view/src viewer/dist licenses scripts/build-wasm.sh scripts/wasm.sh -type f | LC_ALL=C sort | xargs sha256sum | sha256sum | cut -c 1-64)
if [ -f "$module" ] && [ "$(tail -c 64 "$module" | tr -d '\000')" = "$sources" ]; then
    exit
fi
case $#,${1:-} in
    0,) ;;
    2,--check)
        echo "$module is missing or was built from other sources; build it anew: sh scripts/build-wasm.sh" >&2
        exit 1
        ;;
    *)
        echo "usage: sh scripts/build-wasm.sh [--check FILE]" >&2
        exit 2
        ;;
esac
. scripts/wasm.sh
build_wasm ancf14-live
mkdir -p "$target/fmu"
# A custom section (0) of 72 bytes, with a name of 7 bytes. The module takes its name when it is whole.
{
    cat "$target/$triple/page/ancf14_live.wasm"
    printf '\000\110\007sources%s' "$sources"
} > "$module.part"
mv "$module.part" "$module"
