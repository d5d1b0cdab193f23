#!/bin/sh
# Runs the examples of the Python package as notebooks, and writes a page of each into target/notebooks. Needs the wheel (scripts/wheel.sh).
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
environment=$target/notebook-env
rm -rf "$environment" "$target/notebooks"
"${PYTHON:-python3}" -m venv "$environment"
"$environment/bin/python" -m pip install --quiet --disable-pip-version-check "$target"/wheels/ancf14-*_"$(uname -m)".whl --requirement python/tests/requirements.txt \
    --requirement python/examples/requirements.txt
# A copy, which the examples write into.
mkdir -p "$target/notebooks/python"
cp -r models "$target/notebooks"
cp -r python/examples "$target/notebooks/python"
cd "$target/notebooks/python/examples"
"$environment/bin/jupytext" --quiet --to ipynb ./*.py
"$environment/bin/jupyter" nbconvert --log-level WARN --execute --to html --output-dir "$target/notebooks" ./*.ipynb
ls "$target"/notebooks/*.html
