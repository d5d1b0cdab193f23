#!/bin/sh
# Builds the solver for the page of `ancf14 view --live`: target/fmu/ancf14.wasm, next to the program. Takes the toolchain's own standard library for WebAssembly
# (`rustup target add wasm32-unknown-unknown`) if there is one. Otherwise it builds the standard library from its source, which needs, of Debian:
#
#     apt-get install rustc-web cargo-web rust-web-src
#
#     sh scripts/build-wasm.sh                 builds it, unless it is there and belongs to these sources
#     sh scripts/build-wasm.sh --check FILE    fails if FILE is missing or of other sources
#
# The last section of the module is the SHA-256 of all that it is built from, as 64 hexadecimal digits.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
triple=wasm32-unknown-unknown
registry=${CARGO_HOME:-$HOME/.cargo}/registry/src
module=${2:-$target/fmu/ancf14.wasm}
sources=$(find Cargo.toml Cargo.lock src crates/live crates/view/Cargo.toml crates/view/src viewer/dist licenses scripts/build-wasm.sh -type f | LC_ALL=C sort | xargs sha256sum | sha256sum | cut -c 1-64)
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
set -- build --locked --profile page --package ancf14-live --target "$triple"
if [ ! -d "$(rustc --print sysroot)/lib/rustlib/$triple/lib" ]; then
    if [ ! -d /usr/lib/rustlib/src/rust/library ] || [ ! -x /usr/bin/cargo ]; then
        echo "no standard library for WebAssembly: run rustup target add $triple, or on Debian apt-get install rustc-web cargo-web rust-web-src" >&2
        exit 1
    fi
    scripts/python-env.sh
    # Debian's own compiler, not one of rustup; building the standard library is an unstable feature of cargo.
    export PATH=/usr/bin:/bin RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1
    set -- "$@" -Zbuild-std=std,panic_abort --config "target.$triple.linker=\"$PWD/scripts/wasm-linker.sh\""
fi
# Two doubles at a time, as on x86-64: browsers can since March 2023. The operations and their order are the same.
# Messages of a panic name files: the same ones whoever builds it.
RUSTFLAGS="-C target-feature=+simd128 --remap-path-prefix=$PWD/= --remap-path-prefix=$registry/= --remap-path-prefix=/usr/lib/rustlib/src/rust/="
export RUSTFLAGS
cargo "$@"
mkdir -p "$target/fmu"
# A custom section (0) of 72 bytes, with a name of 7 bytes. The module takes its name when it is whole.
{
    cat "$target/$triple/page/ancf14_live.wasm"
    printf '\000\110\007sources%s' "$sources"
} > "$module.part"
mv "$module.part" "$module"
