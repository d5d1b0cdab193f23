# Sourced by scripts/build-wasm.sh and scripts/build-component.sh, in the root of the repository. The last section of what they build is the SHA-256 of all its sources, as 64 hexadecimal digits.
#
# `build_wasm PACKAGE` builds a package for WebAssembly. It takes the toolchain's own standard library for WebAssembly (`rustup target add wasm32-unknown-unknown`) if there is
# one. Otherwise it builds the standard library from its source, which needs, of Debian:
#
#     apt-get install rustc-web cargo-web rust-web-src
#
# shellcheck shell=sh
triple=wasm32-unknown-unknown

# The hash of the sources that both have and of those in PATH...
hash_of() {
    find Cargo.toml Cargo.lock src scripts/wasm.sh "$@" -type f | LC_ALL=C sort | xargs sha256sum | sha256sum | cut -c 1-64
}

# `stop_if_built FILE [--check OTHER]` ends the script if FILE, or OTHER, has the hash $sources; also if it does not and is to be checked only.
stop_if_built() {
    if [ $# -ne 1 ] && [ "$#,$2" != 3,--check ]; then
        echo "usage: sh scripts/$(basename "$0") [--check FILE]" >&2
        exit 2
    fi
    if [ -f "${3:-$1}" ] && [ "$(tail -c 64 "${3:-$1}" | tr -d '\000')" = "$sources" ]; then
        exit
    fi
    if [ $# -eq 3 ]; then
        echo "$3 is missing or was built from other sources; build it anew: sh scripts/$(basename "$0")" >&2
        exit 1
    fi
}

# `mark FILE MARKED` writes FILE with the hash $sources: a custom section (0) of 72 bytes, with a name of 7 bytes. MARKED takes its name when it is whole.
mark() {
    {
        cat "$1"
        printf '\000\110\007sources%s' "$sources"
    } > "$2.part"
    mv "$2.part" "$2"
}

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
