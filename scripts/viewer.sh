#!/bin/sh
# Tests the page of `ancf14 view`: that the committed program belongs to its sources, its types, its parts in node, and whole pages of target/fmu/ancf14 in
# Chromium. Needs node, npm and Chromium (scripts/tools.sh).
set -eu

cd "$(dirname "$0")/../viewer"
npm ci --silent --no-audit --no-fund
npm test --silent
ANCF14="${ANCF14:-target/fmu/ancf14}" npm run browser --silent
