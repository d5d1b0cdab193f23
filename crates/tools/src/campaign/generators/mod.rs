//! Machines from seeded random numbers, as the text of model files. A group is a file, a kind of machine a function.

mod choice;
mod contrast;
mod driven;
mod impacting;
mod late;
mod pendulums;
mod redundant;
mod scaled;
mod slack;
mod snapping;
mod spinning;
mod statics;
mod text;

use super::machine::Machine;
use choice::Choice;

/// A kind of machine: its name, how many of it are made, and how.
struct Kind {
    name: &'static str,
    count: u64,
    make: fn(&mut Choice) -> String,
    /// The integrator of the reference, see [`Machine::judge`].
    judge: Option<&'static str>,
}

impl Kind {
    const fn new(name: &'static str, count: u64, make: fn(&mut Choice) -> String) -> Self {
        Self { name, count, make, judge: None }
    }
}

/// Machines that begin at a time other than 0 are in this group, and it is [`late::START`].
const LATE: &str = "late";

/// All groups with their kinds.
const GROUPS: [(&str, &[Kind]); 12] = [
    ("spinning", &spinning::KINDS),
    ("impacting", &impacting::KINDS),
    ("snapping", &snapping::KINDS),
    ("slack", &slack::KINDS),
    ("redundant", &redundant::KINDS),
    ("tiny", &scaled::TINY),
    ("huge", &scaled::HUGE),
    (LATE, &late::KINDS),
    ("contrast", &contrast::KINDS),
    ("driven", &driven::KINDS),
    ("pendulums", &pendulums::KINDS),
    ("statics", &statics::KINDS),
];

/// The machines of all groups: the same ones each time, and one that is added changes no other.
pub fn machines() -> Vec<Machine> {
    let mut machines = Vec::new();
    for (group, kinds) in GROUPS {
        for Kind { name, count, make, judge } in kinds {
            for number in 1..=*count {
                let name = format!("{group}_{name}_{number}");
                let text = make(&mut Choice::of(&name));
                let start = if group == LATE { late::START } else { 0.0 };
                machines.push(Machine { name, group, text, start, judge: *judge });
            }
        }
    }
    machines
}
