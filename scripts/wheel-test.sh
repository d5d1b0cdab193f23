#!/bin/sh
# Installs the wheel of scripts/wheel.sh into an empty environment, target/wheel-env, and runs the tests of the Python package there.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
rm -rf "$target/wheel-env"
"${PYTHON:-python3}" -m venv "$target/wheel-env"
python="$target/wheel-env/bin/python"
"$python" -m pip install --quiet --disable-pip-version-check "$target"/wheels/ancf14-*.whl --requirement python/tests/requirements.txt
"$python" -m pytest -q -p no:cacheprovider --rootdir python/tests python/tests
"$python" -m mypy --config-file python/pyproject.toml --cache-dir /dev/null --package ancf14
cd python/tests
"$python" -m mypy --config-file ../pyproject.toml --cache-dir /dev/null .
cd ../examples
"$python" -m mypy --config-file ../pyproject.toml --cache-dir /dev/null .
