#!/bin/sh
# The linker for WebAssembly: Zig's, out of target/python-env. Called by rustc (scripts/build-wasm.sh).
set -eu

target=${CARGO_TARGET_DIR:-$(cd "$(dirname "$0")/.." && pwd)/target}
# rustc names the kind of linker first, for one that is several.
if [ "${1:-}" = -flavor ]; then
    shift 2
fi
exec "$target/python-env/bin/python" -m ziglang wasm-ld "$@"
