//! How do time and memory grow with the size of a mechanism? Prints a table, in Markdown, of chains, combs and nets:
//!
//!     cargo bench --bench scale                  all sizes, some minutes
//!     cargo bench --bench scale -- net           one kind of mechanism
//!
//! Each row ends with exponents: 1 where a cost is in proportion to the number of elements. A cost that jumps from one
//! size to the next is a cliff. Multiplications of a factorization, iterations and exponents do not depend on the
//! machine; times are CPU times. Each mechanism runs in a process of its own, whose largest memory is told. Nothing is
//! asserted: times belong to the machine.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot run has nothing to say")]

#[path = "../speed/clock.rs"]
#[allow(dead_code, reason = "the other benchmark needs the rest")]
mod clock;
mod costs;

use costs::Costs;

/// Kinds of mechanisms and their sizes: elements of a chain, nodes of a comb's spine, ropes of a net.
const SIZES: [(&str, &[usize]); 3] =
    [("chain", &[100, 1000, 10_000, 100_000]), ("comb", &[20, 100, 500, 2000]), ("net", &[7, 20, 40, 70])];

/// CPU time of an equilibrium, s, beyond which none of a larger mechanism is looked for.
const ENOUGH: f64 = 2.0;

const HEAD: &str = "| mechanism | elements | load | start | step | iterations | multiplications | memory | equilibrium | iterations | memory | exponents: load, start, step, multiplications, memory, equilibrium |\n\
                    |---|---|---|---|---|---|---|---|---|---|---|---|";

fn main() {
    // cargo adds --bench.
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => measure(|_| true),
        [kind] if SIZES.iter().any(|(own, _)| *own == kind) => measure(|own| own == kind),
        [costs::MOTION, kind, size] => println!("{}", costs::motion(kind, size.parse().unwrap())),
        [costs::EQUILIBRIUM, kind, size] => println!("{}", costs::equilibrium(kind, size.parse().unwrap())),
        _ => panic!("arguments: none, or one of {}", SIZES.map(|(kind, _)| kind).join(", ")),
    }
}

/// Prints the rows of the kinds that `is_wanted` accepts.
fn measure(is_wanted: impl Fn(&str) -> bool) {
    println!("{HEAD}");
    for (kind, sizes) in SIZES.iter().filter(|(kind, _)| is_wanted(kind)) {
        let mut last: Option<Costs> = None;
        for size in *sizes {
            let is_short = last.as_ref().is_none_or(|last| last.equilibrium().is_none_or(|time| time < ENOUGH));
            let costs = Costs::of(kind, *size, is_short);
            println!("{}", costs.line(kind, last.as_ref()));
            last = Some(costs);
        }
    }
}
