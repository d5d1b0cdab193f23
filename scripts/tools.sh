#!/bin/sh
# Makes sure that the programs are there which the tests need beside Rust, C and Python: valgrind looks over the memory of the C examples, pkg-config finds the installed
# library, node and Chromium run the page of `ancf14 view`; its solver is built with a standard library for WebAssembly. Installs from Debian's packages those that are missing, as root.
# Prints nothing unless something fails.
set -eu

missing=
command -v valgrind > /dev/null || missing="$missing valgrind"
command -v pkg-config > /dev/null || missing="$missing pkg-config"
command -v c++ > /dev/null || missing="$missing g++"
command -v node > /dev/null || missing="$missing nodejs"
command -v npm > /dev/null || missing="$missing npm"
command -v chromium > /dev/null || command -v chromium-browser > /dev/null || command -v google-chrome > /dev/null || missing="$missing chromium"
# The standard library for WebAssembly, of rustup or of Debian (scripts/build-wasm.sh).
[ -d "$(rustc --print sysroot)/lib/rustlib/wasm32-unknown-unknown/lib" ] || [ -d /usr/lib/rustlib/src/rust/library ] || missing="$missing rustc-web cargo-web rust-web-src"
if [ -z "$missing" ]; then
    exit 0
fi
if [ "$(id -u)" != 0 ] || ! command -v apt-get > /dev/null; then
    echo "the tests need these programs, which are missing:$missing; install them with this system's package manager" >&2
    exit 1
fi
log=$(mktemp)
# Each name is a word of its own.
# shellcheck disable=SC2086
if ! { apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $missing; } > "$log" 2>&1; then
    cat "$log" >&2
    exit 1
fi
rm "$log"
