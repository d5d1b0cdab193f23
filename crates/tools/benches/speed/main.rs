//! What does a simulation cost, and what does it cost the peer at the same error? Prints a table, in Markdown:
//!
//!     scripts/peer-env.sh                                     once, for the columns of the peer cargo bench --bench
//!     speed                               some two minutes cargo bench --bench speed -- --plot docs/scaling.svg    and
//!     draws the time of a step over the number of elements cargo bench --bench speed -- --only princeton
//!     prints the rows of one part cargo bench --bench speed -- --count hessian 1000       runs one kernel and nothing
//!     else: scripts/instructions.sh
//!
//! All times are CPU times, the least of several; the peer runs in the same minutes, on one thread. Nothing is
//! asserted: times belong to the machine.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]
#![allow(clippy::print_stderr, reason = "and says where it is")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot run has nothing to say")]

mod buckling;
mod chain;
mod clock;
mod count;
mod element;
mod linear;
mod peer;
mod plot;
mod princeton;
mod runs;
mod shaft;
mod spring;
mod start;
mod table;

use ancf14_testing::root;
use peer::Peer;
use std::path::Path;
use table::Row;

fn main() {
    // cargo adds --bench.
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => measure(|_| true, None),
        ["--only", part] if part == CHAIN || PARTS.iter().any(|(name, _)| *name == part) => {
            measure(|name| name == part, None)
        }
        // Cargo runs a benchmark in the folder of its package.
        ["--plot", file] => measure(|_| true, Some(&root().join(file))),
        ["--count", kernel, times] => println!("{}", count::run(kernel, times)),
        [chain::MEMORY] => println!("{}", chain::memory()),
        _ => panic!(
            "arguments: none, --plot FILE.svg, --only {}|{CHAIN}, or --count {} TIMES",
            PARTS.map(|(name, _)| name).join("|"),
            count::KERNELS.join("|")
        ),
    }
}

/// The rows of a part of the table.
type Rows = fn(Option<&Peer>) -> Vec<Row>;

/// The last part of the table: its costs are also drawn.
const CHAIN: &str = "chain";

/// The other parts of the table, in its order.
const PARTS: [(&str, Rows); 7] = [
    ("element", |_| element::rows()),
    ("linear", |_| linear::rows()),
    ("start", |_| start::rows()),
    ("shaft", shaft::rows),
    ("buckling", buckling::rows),
    ("princeton", princeton::rows),
    ("spring", spring::rows),
];

/// Prints the rows of the parts whose names `is_wanted` accepts, part by part; draws the costs of the chain into the
/// file `picture`.
fn measure(is_wanted: impl Fn(&str) -> bool, picture: Option<&Path>) {
    let peer = Peer::find();
    if peer.is_none() {
        eprintln!("The peer is not there: scripts/peer-env.sh gets it. Ours alone:");
    }
    let peer = peer.as_ref();
    let print = |rows: Vec<Row>| rows.iter().for_each(|row| println!("{}", row.line()));
    println!("{}", table::HEAD);
    for (_, rows) in PARTS.iter().filter(|(name, _)| is_wanted(name)) {
        print(rows(peer));
    }
    if is_wanted(CHAIN) {
        let (costs, memory) = chain::costs(peer);
        print(chain::rows(&costs, memory));
        if let Some(file) = picture {
            plot::draw(&costs, file).unwrap();
        }
    }
}
