#!/bin/sh
# All tests: formatting, lints, Rust, C (a part of the Rust suite), the page of `ancf14 view` in Chromium, the FMUs of all models in FMPy, libcosim and
# fmutool, the book, and what a release has: the archive and the Python wheel. The solver of pages is tested as well where it is there (scripts/build-wasm.sh) and of these
# sources. Needs Rust, a C and C++ compiler, Python 3, and pkg-config, valgrind, node and Chromium (installed here if that is possible).
#
#     sh scripts/test.sh              everything, in two lanes side by side
#     sh scripts/test.sh rust         the lints, the Rust tests and the documentation of the library
#     sh scripts/test.sh delivered    builds what users get, and tests it
#
# Prints how long each stage takes: wall time, and CPU time, which depends less on what else the machine does.
set -eu

cd "$(dirname "$0")/.."
target=${CARGO_TARGET_DIR:-$PWD/target}
mkdir -p "$target"
log=$target/delivered.log
spent=$(mktemp)
trap 'rm -f "$spent"' EXIT
# Some shells run no trap of EXIT when a signal ends them.
trap 'exit 130' INT
trap 'exit 143' TERM

# Sets `cpu` to the CPU seconds that the children of this shell have taken so far. In a pipe, `times` would count those of another shell.
count_cpu() {
    times > "$spent"
    cpu=$(sed -n '2s/[ms]/ /gp' "$spent" | awk '{ printf "%d", 60 * ($1 + $3) + $2 + $4 }')
}

# stage NAME COMMAND...: runs the command, and tells how long it took.
stage() {
    name=$1
    shift
    began=$(date +%s)
    count_cpu
    before=$cpu
    "$@"
    count_cpu
    echo "stage $name: $(($(date +%s) - began)) s, CPU time $((cpu - before)) s"
}

release() {
    ANCF14_LIVE=no scripts/release.sh > "$target/release.log" 2>&1 || {
        cat "$target/release.log"
        return 1
    }
}

case ${1:-all} in
    rust)
        stage clippy cargo clippy --locked --workspace --all-targets --quiet -- --deny warnings
        stage "build of the Rust tests" cargo test --locked --no-run
        stage "Rust tests" cargo test --locked
        # The whole workspace, so that cargo chooses the features of the lints, and finds the dependencies checked.
        RUSTDOCFLAGS='--deny warnings' stage documentation cargo doc --locked --workspace --no-deps --quiet
        exit
        ;;
    delivered)
        stage book scripts/book.sh
        stage release release
        stage pages scripts/viewer.sh
        ANCF14=target/fmu/ancf14 ANCF14_GALLERY=$target/gallery stage FMPy \
            target/python-env/bin/python -m pytest -q -p no:cacheprovider --durations=10 tests/fmpy
        stage "release test" scripts/release-test.sh
        exit
        ;;
    all) ;;
    *)
        echo "usage: sh scripts/test.sh [rust | delivered]" >&2
        exit 2
        ;;
esac

# lane NAME: starts one of the lanes above as a process group, so that a signal reaches everything that it has started. `set -m` needs a terminal in some shells.
lane() {
    exec "${PYTHON:-python3}" -c 'import os, sys; os.setpgid(0, 0); os.execvp(sys.argv[1], sys.argv[1:])' sh scripts/test.sh "$1"
}

# A failure of the Rust lane, or a signal to this script, ends the other lane; a failure of the delivered lane is reported at the end.
rust=
delivered=
end_lanes() {
    rm -f "$spent"
    for group in $rust $delivered; do
        kill -TERM "-$group" 2> /dev/null || kill "$group" 2> /dev/null || true
    done
    wait 2> /dev/null || true
}
trap end_lanes EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

stage tools scripts/tools.sh
stage formatting cargo fmt --all -- --check
(lane delivered) > "$log" 2>&1 < /dev/null &
delivered=$!
# In the background too: a shell hears a signal while it waits, but not while it runs a command.
(lane rust) < /dev/null &
rust=$!
wait "$rust"
rust=
passed=true
wait "$delivered" || passed=false
delivered=
cat "$log"
[ "$passed" = true ]
