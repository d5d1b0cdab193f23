#!/bin/sh
# Where a step of the shaft of the benchmark spends its instructions, or of its chain, for each element, counted by callgrind: a table in Markdown, shares of the whole step.
#
#     sh scripts/profile.sh shaft
#     sh scripts/profile.sh chain
#
# A row is a function with all that it calls; rows with the same indentation do not overlap. What the compiler has built into a caller counts there.
# Needs Rust and valgrind.
set -eu

kernel=${1:-shaft}
case $kernel in
    # Three steps an output.
    shaft) outputs=100 parts=300 ;;
    # A step an output, 100 elements.
    chain) outputs=20 parts=2000 ;;
    *) echo "usage: $0 shaft|chain" >&2; exit 2 ;;
esac
cd "$(dirname "$0")/.."
scripts/tools.sh
program=$(cargo bench --locked --bench speed --no-run 2>&1 | sed -n 's/.*Executable.*(\(.*\))$/\1/p')
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Two runs, so that the start can be taken out.
for times in 20 $((20 + outputs)); do
    valgrind --tool=callgrind --callgrind-out-file="$folder/$times" "$program" --count "$kernel" "$times" > /dev/null 2> "$folder/log" || {
        cat "$folder/log" >&2
        exit 1
    }
    callgrind_annotate --inclusive=yes --auto=no --threshold=100 "$folder/$times" | tr -d , > "$folder/$times.txt"
done

# instructions PATTERN TIMES: of the function whose line matches, the largest.
instructions() {
    grep -E "$1" "$folder/$2.txt" | awk '{ if ($1 > most) most = $1 } END { print most + 0 }'
}

# difference PATTERN: of the outputs between.
difference() {
    echo $(($(instructions "$1" $((20 + outputs))) - $(instructions "$1" 20)))
}

whole=$(difference 'simulation::Simulation as ancf14::fmi::Model>::advance')
echo "| part of a step | instructions | share |"
echo "|---|---|---|"
row() {
    own=$(difference "$2")
    echo "| $1 | $((own / parts)) | $((own * 100 / whole)) % |"
}
row 'step, all of it' 'simulation::Simulation as ancf14::fmi::Model>::advance'
row 'strains at the start' 'System>::begin_step'
row 'matrix and right side of an iteration' 'Problem>::linearize'
row '- elements, loads, springs' 'System>::forces_and_tangent'
row '- derivatives of joints' 'Kkt::set_curvatures'
row 'factorization' 'Multifrontal::factorize'
row 'solution, refined' 'Multifrontal::solve'
row 'forces at the end' 'System>::finish_step'
row 'solutions with the same factors' 'solve_roughly'
row 'velocities' 'Projection::set_velocity'
row 'error of the steps' 'time_error::Estimator::borrow_from'
row 'its velocities' 'Estimator::project'
row 'results and watch' 'simulation::Simulation::measure'
