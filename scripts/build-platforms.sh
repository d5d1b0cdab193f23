#!/bin/sh
# Builds the libraries of FMUs for other platforms than this one, which `scripts/release.sh` puts into a release: 64-bit ARM, Windows; for Windows the program, too. The log is
# target/platforms.log. Needs what scripts/build-aarch64.sh and scripts/build-windows.sh need; takes half an hour.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
mkdir -p "$target"
log=$target/platforms.log
: > "$log"
for platform in aarch64 windows; do
    sh "scripts/build-$platform.sh" >> "$log" 2>&1 || {
        tail -n 20 "$log" >&2
        echo "what a release has for $platform was not built; the whole log is $log" >&2
        exit 1
    }
done
