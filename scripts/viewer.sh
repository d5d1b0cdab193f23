#!/bin/sh
# Tests the page of `ancf14 view`: that the committed program belongs to its sources, its types, its parts in node, and whole pages of target/fmu/ancf14 in
# Chromium; with the solver in the page too, if scripts/build-wasm.sh has built it, which must be of these sources. Needs node, npm and Chromium (scripts/tools.sh), and what scripts/build.sh builds.
set -eu

cd "$(dirname "$0")/../viewer"
npm ci --silent --no-audit --no-fund
npm test --silent
ANCF14="${ANCF14:-target/fmu/ancf14}"
export ANCF14
npm run browser --silent
cd ..
solver=${ANCF14%/*}/ancf14.wasm
if [ -f "$solver" ]; then
    scripts/build-wasm.sh --check "$solver"
    cd viewer
    npm run live --silent
fi
