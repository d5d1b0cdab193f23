#!/bin/sh
# Instructions that a call takes, counted by callgrind: of the gradient of an element, of gradient and Hessian, of a
# factorization with its solution, for each unknown, of an equilibrium of the Princeton beam, of a step of the shaft of the benchmark, and of a step of its
# chain, for each element, with the defaults. Counts do not depend on what else the machine does: they show a loss of speed
# that times hide. Each kernel is run N and 2 N times, so that the difference is N times the kernel and nothing else.
# Needs Rust and valgrind.
set -eu

cd "$(dirname "$0")/.."
scripts/tools.sh
program=$(cargo bench --locked --bench speed --no-run 2>&1 | sed -n 's/.*Executable.*(\(.*\))$/\1/p')
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# instructions KERNEL TIMES: of the whole process.
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" --count "$1" "$2" > /dev/null 2> "$log" || {
        cat "$log" >&2
        exit 1
    }
    sed -n 's/.*Collected : //p' "$log"
}

times=20
for kernel in gradient hessian factorization equilibrium shaft chain damped_chain alpha_chain damped_alpha_chain; do
    once=$(instructions "$kernel" "$times")
    twice=$(instructions "$kernel" $((2 * times)))
    # How many elements or unknowns a run has.
    parts=$("$program" --count "$kernel" 1)
    case $kernel in
        factorization) part=unknown ;;
        equilibrium) part=load ;;
        shaft) part=step ;;
        *) part=element ;;
    esac
    echo "$kernel: $(((twice - once) / times / parts)) instructions for each $part"
done
