#!/bin/sh
# Makes sure that there is valgrind, which looks over the memory of the C examples: installs it from Debian's packages, as root.
# Prints nothing unless something fails.
set -eu

if command -v valgrind > /dev/null; then
    exit 0
fi
if [ "$(id -u)" != 0 ] || ! command -v apt-get > /dev/null; then
    echo "valgrind is missing, which the tests need: install it with this system's package manager" >&2
    exit 1
fi
log=$(mktemp)
if ! { apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends valgrind; } > "$log" 2>&1; then
    cat "$log" >&2
    exit 1
fi
rm "$log"
