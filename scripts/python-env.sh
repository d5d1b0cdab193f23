#!/bin/sh
# Makes target/python-env, the Python environment of the host tests, if it is missing or its requirements have changed.
# Prints nothing unless something fails. Needs Python 3.11 or later; PYTHON names another one than python3.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
requirements="$root/tests/fmpy/requirements.txt"
environment="${CARGO_TARGET_DIR:-$root/target}/python-env"
made_from="$environment/made-from.txt"

if cmp -s "$requirements" "$made_from"; then
    exit 0
fi
rm -rf "$environment"
"${PYTHON:-python3}" -m venv "$environment"
"$environment/bin/python" -m pip install --quiet --disable-pip-version-check --requirement "$requirements"
cp "$requirements" "$made_from"
