#!/bin/sh
# Makes target/python-env, the Python environment of the linker and of the host tests, if it is missing or its requirements have
# changed.
# Prints nothing unless something fails. Needs Python 3.11 or later; PYTHON names another one than python3.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
linker="$root/scripts/requirements.txt"
tests="$root/tests/fmpy/requirements.txt"
environment="${CARGO_TARGET_DIR:-$root/target}/python-env"
made_from="$environment/made-from.txt"

if cat "$linker" "$tests" | cmp -s - "$made_from"; then
    exit 0
fi
rm -rf "$environment"
"${PYTHON:-python3}" -m venv "$environment"
"$environment/bin/python" -m pip install --quiet --disable-pip-version-check --requirement "$linker" --requirement "$tests"
cat "$linker" "$tests" > "$made_from"
