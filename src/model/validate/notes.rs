//! Legal models that are hardly ever meant: parts that nothing holds, joints between places that do not meet, materials
//! in other units than SI, stubby beams, angles in degrees, motions that begin with a blow, loads with a pole, steps
//! almost as long as the motion or as an oscillation of what acts, too many switches, loads
//! that miss their beam, forces that do not do what they should, elements too long for what they touch, copies
//! in one place.

mod angles;
mod arms;
mod contacts;
mod fast_signals;
mod forces;
mod groups;
mod hidden_jumps;
mod lines;
mod loose;
mod many_switches;
mod materials;
mod moving_loads;
mod poles;
mod slenderness;
mod starts;

use super::Lines;
use crate::math::elementary::{log10, pow};
use crate::model::file::document::Document;
use crate::model::file::entries::simulation::{Analysis, Steps};
use crate::model::file::number::Number;
use crate::model::text::diagnostic::Place;

/// Steps of a motion below which its results are not a curve.
const FEWEST_STEPS: f64 = 10.0;
/// Relative round-off of the quotient of two lengths of time.
const ROUND_OFF: f64 = 1e-9;
/// Parts that a note names, at most.
const NAMED: usize = 5;

/// One thing that the author of a model should know about it.
struct Note {
    /// The number or the part that it is about.
    place: Place,
    /// What is odd, and what to do.
    text: String,
}

impl Note {
    /// About a number, whose name comes first.
    fn of(document: &Document, number: Number, text: &str) -> Self {
        Self { place: document.place(number), text: format!("{} {text}", document.name(number)) }
    }
}

/// What the author of a model should know about it: file, line, what is odd and what to do. Copies of one line give one
/// note.
pub fn notes(document: &Document) -> Vec<String> {
    let lines = Lines::of(document);
    let kinds = [
        loose::loose_parts(document),
        arms::silent_arms(document, &lines),
        materials::odd_materials(document),
        slenderness::stubby_beams(document, &lines),
        angles::odd_angles(document),
        lines::lines(document),
        starts::jumps(document, &lines),
        contacts::coarse_contacts(document, &lines),
        poles::poles(document),
        hidden_jumps::hidden_jumps(document),
        forces::turned_laws(document),
        forces::violated_stops(document),
        forces::stacked_copies(document),
        long_step(document).into_iter().collect(),
        fast_signals::fast_signals(document),
        many_switches::many_switches(document),
        moving_loads::absent_loads(document),
    ];
    let mut notes = Vec::new();
    for kind in kinds {
        let mut told: Vec<Place> = Vec::new();
        notes.extend(kind.into_iter().filter(|note| {
            let origin = document.origin_place(note.place);
            let is_new = note.place.source > 0 || !told.contains(&origin);
            told.push(origin);
            is_new
        }));
    }
    let notes = notes.iter().map(|note| format!("{}: {}", document.origin(note.place), note.text));
    document.remarks().iter().cloned().chain(notes).collect()
}

/// `beam a, beam b and 3 more`.
pub fn listed(names: &[&str]) -> String {
    let (shown, rest) = names.split_at(names.len().min(NAMED));
    match (rest.len(), shown.split_last()) {
        (0, Some((last, others))) if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        (0, _) => shown.join(", "),
        (count, _) => format!("{} and {count} more", shown.join(", ")),
    }
}

/// Steps that a period needs. With ten, the midpoint of a step misses 5 % of an amplitude, `1 - cos(pi/10)`, and the
/// conserving integrator lengthens the period of a vibration by 3 %, `(2 pi/10)²/12`.
pub const STEPS_PER_PERIOD: f64 = 10.0;

/// The longest step for a period, s, rounded down to two digits, as a message proposes it.
pub fn step_for(period: f64) -> f64 {
    let longest = period / STEPS_PER_PERIOD;
    let unit = pow(10_f64, log10(longest).floor() - 1.0);
    (longest / unit).floor() * unit
}

/// Says that a motion has few steps only.
fn long_step(document: &Document) -> Option<Note> {
    let Steps::Fixed(step) = document.simulation.steps else { return None };
    let (length, stop) = (document.value(step), document.value(document.simulation.stop));
    let is_long = document.simulation.analysis == Analysis::Dynamic && length * FEWEST_STEPS > stop * (1.0 + ROUND_OFF);
    is_long.then(|| {
        let text = format!(
            "= {length} s is longer than a tenth of stop = {stop} s. Leave `step` out, and the solver chooses its steps"
        );
        Note::of(document, step, &text)
    })
}
