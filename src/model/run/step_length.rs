//! Whether a fixed step can show the vibrations of a mechanism that has nothing but vibrations.

use crate::model::file::entries::simulation::{Analysis, Steps};
use crate::model::run::simulation::Simulation;
use crate::model::validate::notes::{STEPS_PER_PERIOD, step_for};
use crate::solve::modes::slowest::slowest;
use crate::solve::modes::{Kind, modes};
use std::f64::consts::TAU;

/// Modes that are asked for: the slowest, and one more for the iteration.
const MODES: usize = 2;

/// Most elements of a mechanism whose modes are found for sure, which takes more time and memory than a run of many
/// steps; beyond, the period told is the longest one that was found.
const MOST_ELEMENTS: usize = 2000;

/// Tells a step that resolves no natural vibration of the state that is reached. Where something else moves the
/// mechanism, a drive, a moving frame or a rigid motion, the step may be meant for that.
pub fn long_step(simulation: &Simulation) -> Option<String> {
    let document = simulation.document();
    let Steps::Fixed(step) = document.simulation.steps else { return None };
    if document.simulation.analysis != Analysis::Dynamic || !document.drives.is_empty() || !document.frames.is_empty() {
        return None;
    }
    let (system, state, length) = (simulation.system(), simulation.state(), document.value(step));
    let limit = (TAU / (STEPS_PER_PERIOD * length)).powi(2);
    // Most mechanisms have a motion that is slow enough.
    let bound = slowest(system, state, limit).ok().filter(|bound| *bound >= limit)?;
    let (square, about) = if system.mesh.elements.len() > MOST_ELEMENTS {
        (bound, "about ")
    } else {
        let found = modes(system, state, MODES).ok()?;
        (found.modes.first().filter(|mode| mode.kind == Kind::Vibration)?.eigenvalue, "")
    };
    let period = TAU / square.sqrt();
    if period >= STEPS_PER_PERIOD * length {
        return None;
    }
    Some(format!(
        "{}: {} = {length} s resolves no vibration: the slowest one has a period of {about}{period:.2e} s, {:.1} steps. The results are those of a motion without \
         vibrations. If vibrations matter, set step = {:.1e} or less, or leave `step` out, and the solver chooses its steps",
        document.origin(document.place(step)),
        document.name(step),
        period / length,
        step_for(period)
    ))
}
