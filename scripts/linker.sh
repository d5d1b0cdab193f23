#!/bin/sh
# The linker of what is shipped: Zig's, out of target/python-env, against the symbols that glibc had in version 2.17 (2012),
# with an unwinder of its own instead of libgcc_s. Called by rustc (scripts/target.sh, scripts/aarch64.sh). ANCF14_MACHINE is the processor
# [default: x86_64].
set -eu

target=${CARGO_TARGET_DIR:-$(cd "$(dirname "$0")/.." && pwd)/target}
# Zig compiles that unwinder and the stubs of glibc once, into this folder.
export ZIG_GLOBAL_CACHE_DIR="$target/zig" ZIG_LOCAL_CACHE_DIR="$target/zig"
exec "$target/python-env/bin/python" -m ziglang cc -target "${ANCF14_MACHINE:-x86_64}-linux-gnu.2.17" "$@"
