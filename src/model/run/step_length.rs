//! Whether a fixed step can show the vibrations of a mechanism that has nothing but vibrations.

use crate::model::file::entries::simulation::{Analysis, Steps};
use crate::model::run::simulation::Simulation;
use crate::solve::modes::{Kind, modes};

/// Steps that a vibration needs: the conserving integrator lengthens the period of one with ten steps by 3 %, `(2 pi/10)²/12`.
const STEPS: f64 = 10.0;
/// Modes that are asked for: the slowest, and one more for the iteration.
const MODES: usize = 2;

/// Tells a step that resolves no natural vibration of the state that is reached. Where something else moves the mechanism, a drive, a moving frame or a rigid motion, the step may be
/// meant for that.
pub fn long_step(simulation: &Simulation) -> Option<String> {
    let document = simulation.document();
    let Steps::Fixed(step) = document.simulation.steps else { return None };
    if document.simulation.analysis != Analysis::Dynamic || !document.drives.is_empty() || !document.frames.is_empty() {
        return None;
    }
    let found = modes(simulation.system(), simulation.state(), MODES).ok()?;
    let slowest = found.modes.first().filter(|mode| mode.kind == Kind::Vibration)?;
    let (period, length) = (std::f64::consts::TAU / slowest.eigenvalue.sqrt(), document.value(step));
    if period >= STEPS * length {
        return None;
    }
    // A tenth of the period, in two digits.
    let unit = 10_f64.powf((period / STEPS).log10().floor() - 1.0);
    let shorter = (period / STEPS / unit).floor() * unit;
    Some(format!(
        "{}: {} = {length} s resolves no vibration: the slowest one has a period of {period:.2e} s, {:.1} steps. The results are those of a motion without \
         vibrations. If vibrations matter, set step = {shorter:.1e} or less, or leave `step` out, and the solver chooses its steps",
        document.origin(document.place(step)),
        document.name(step),
        period / length
    ))
}
