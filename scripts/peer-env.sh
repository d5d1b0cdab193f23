#!/bin/sh
# Makes target/peer-env, the Python environment of EXUDYN, with which `cargo bench --bench speed` compares, if it is missing or its
# requirements have changed.
# Prints nothing unless something fails. Needs Python 3.11 or later; PYTHON names another one than python3.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
peer="$root/crates/tools/benches/peer/requirements.txt"
environment="${CARGO_TARGET_DIR:-$root/target}/peer-env"
made_from="$environment/made-from.txt"

if cmp -s "$peer" "$made_from"; then
    exit 0
fi
rm -rf "$environment"
"${PYTHON:-python3}" -m venv "$environment"
"$environment/bin/python" -m pip install --quiet --disable-pip-version-check --requirement "$peer"
cp "$peer" "$made_from"
