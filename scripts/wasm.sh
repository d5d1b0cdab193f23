# Sourced by scripts/build-wasm.sh and scripts/build-component.sh, in the root of the repository, after `target`, the folder of cargo: `build_wasm PACKAGE` builds a package for WebAssembly. Takes
# the toolchain's own standard library for WebAssembly (`rustup target add wasm32-unknown-unknown`) if there is one. Otherwise it builds the standard library from its source, which
# needs, of Debian:
#
#     apt-get install rustc-web cargo-web rust-web-src
#
# shellcheck shell=sh
triple=wasm32-unknown-unknown

build_wasm() {
    set -- build --locked --profile page --package "$1" --target "$triple"
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
    RUSTFLAGS="-C target-feature=+simd128 --remap-path-prefix=$PWD/= --remap-path-prefix=${CARGO_HOME:-$HOME/.cargo}/registry/src/= --remap-path-prefix=/usr/lib/rustlib/src/rust/="
    export RUSTFLAGS
    cargo "$@"
}
