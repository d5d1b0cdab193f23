//! Modes that reach their accuracy by themselves: the mechanism is built again with twice the elements, and the
//! frequencies of both meshes are compared in their order. Where the file leaves the mesh to the program, the finer
//! one takes over until two agree; numbers of elements that the file gives are kept, and warned of.

use crate::fmi::{Failure, Model};
use crate::math::elementary::pow;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::accuracy::{at_most, percent};
use crate::model::run::levels::{self, Level, Override};
use crate::model::run::simulation::Simulation;
use crate::model::run::simulation::campbell::{Campbell, Sweep};
use crate::model::view::modes::{Kind, Mode, Modes};

/// The error of a frequency that a reader expects, as a share; one of twice that is warned of.
const EXPECTED: f64 = 0.005;
const WARNED: f64 = 2.0;
/// The order of frequencies in the length of the elements,
const ORDER: f64 = 4.0;
/// and the least gain by a mesh twice as fine: next to clamped ends, soft strings gain a little more.
const LEAST_GAIN: f64 = 1.5;
/// Elements of a finer mesh at most: modes of more take minutes.
const MOST_ELEMENTS: usize = 4000;
/// Eigenvalues below this share of the highest one are compared on that scale: they are round-off of it.
const SMALL: f64 = 1e-9;

/// Modes on a mesh that shows their frequencies.
#[derive(Debug)]
pub struct RefinedModes {
    /// The mechanism that they are of; none: it is the one that was asked.
    pub simulation: Option<Box<Simulation>>,
    /// The modes, with their errors because of the mesh.
    pub modes: Modes,
    /// The elements of all beams.
    pub elements: usize,
    /// The program chooses all of them.
    is_chosen: bool,
}

impl RefinedModes {
    /// The line about the mesh: `16 elements, accuracy of the frequencies: 0.13 %`; none: nothing is known.
    pub fn line(&self) -> Option<String> {
        let (_, error) = worst(&self.modes)?;
        let known = if error > 1.0 { String::from("not known") } else { at_most(error) };
        Some(format!("{} elements, accuracy of the frequencies: {known}", self.elements))
    }

    /// The warning about the mesh; none: frequencies are as right as a reader expects.
    pub fn warning(&self) -> Option<String> {
        warning(&self.modes, self.is_chosen)
    }
}

impl Simulation {
    /// The `count` lowest modes about the state that is reached, the start or an equilibrium, on a mesh with which
    /// frequencies are right to 0.5 %, if the file leaves that to the program; otherwise with a warning.
    ///
    /// # Errors
    /// As [`Simulation::modes`].
    pub fn refined_modes(&self, count: usize) -> Result<RefinedModes, Failure> {
        let chosen: Vec<bool> = self.document().beams.iter().map(|beam| beam.is_meshed_by_program).collect();
        let (mut simulation, mut modes) = (None, self.modes(count)?);
        let mut before: Option<f64> = None;
        while chosen.contains(&true) {
            let current = simulation.as_deref().unwrap_or(self);
            let changes = levels::finer(current.document(), &chosen, 2.0);
            let Some((finer, found)) = changes.and_then(|changes| current.modes_with(changes, count)) else { break };
            let differences = differences(&modes, &found);
            let largest = differences.iter().flatten().copied().fold(0.0, f64::max);
            // The first two meshes do not show how fast the error falls: it is taken to be their difference.
            let gain = before.map_or(2.0, |before| (before / largest).clamp(LEAST_GAIN, pow(2.0_f64, ORDER)));
            (simulation, modes) = (Some(finer), with_errors(found, &differences, 1.0 / (gain - 1.0)));
            if largest <= EXPECTED * (gain - 1.0) {
                break;
            }
            before = Some(largest);
        }
        let current = simulation.as_deref().unwrap_or(self);
        let elements = current.system().mesh.elements.len();
        if chosen.contains(&false) {
            modes = current.with_mesh_errors(modes, count);
        } else if let Some(warning) = warning(&modes, true) {
            modes.warnings.push(warning);
        }
        Ok(RefinedModes { simulation, modes, elements, is_chosen: !chosen.contains(&false) })
    }

    /// The vibrations by the speed, on the mesh on which those at rest have the accuracy of [`Self::refined_modes`].
    ///
    /// # Errors
    /// As [`Simulation::campbell`].
    pub fn refined_campbell(&self, sweep: &Sweep) -> Result<Campbell, Failure> {
        // A mechanism without modes at rest may have some about a rotation.
        let Ok(refined) = self.refined_modes(sweep.count) else { return self.campbell(sweep) };
        let mut found = refined.simulation.as_deref().unwrap_or(self).campbell(sweep)?;
        found.warnings.extend(refined.warning());
        Ok(found)
    }

    /// The modes of the mesh of this mechanism, with a warning where it is too coarse.
    ///
    /// # Errors
    /// As [`Simulation::modes`].
    pub fn judged_modes(&self, count: usize) -> Result<Modes, Failure> {
        Ok(self.with_mesh_errors(self.modes(count)?, count))
    }

    /// `modes` of this mechanism with their errors because of the mesh, and the warning about them.
    fn with_mesh_errors(&self, modes: Modes, count: usize) -> Modes {
        let changes = Level::DoubleElements.overrides(self.document());
        let Some((_, finer)) = changes.and_then(|changes| self.modes_with(changes, count)) else { return modes };
        let gain = pow(2.0_f64, ORDER);
        let differences = differences(&modes, &finer);
        let mut modes = with_errors(modes, &differences, gain / (gain - 1.0));
        modes.warnings.extend(warning(&modes, false));
        modes
    }

    /// The same mechanism in the same state with `changes`, and its modes; none: it has no such mesh, or is not found
    /// in that state.
    fn modes_with(&self, changes: Vec<Override>, count: usize) -> Option<(Box<Self>, Modes)> {
        let (time, start) = (self.time(), self.about().start);
        let is_reached_again = time == start || self.document().simulation.analysis == Analysis::Static;
        if !is_reached_again || 2 * self.system().mesh.elements.len() > MOST_ELEMENTS {
            return None;
        }
        let mut finer = self.repeated(changes, None).ok()?;
        finer.initialize(start).ok()?;
        if time > start {
            finer.advance(time).ok()?;
        }
        let modes = finer.modes(count).ok()?;
        Some((Box::new(finer), modes))
    }
}

/// The share by which the frequency of each mode of `own` that vibrates differs from that of a mesh twice as fine.
fn differences(own: &Modes, finer: &Modes) -> Vec<Option<f64>> {
    let highest = finer.modes.iter().map(|mode| mode.eigenvalue.abs()).fold(0.0, f64::max);
    let share = |(number, mode): (usize, &Mode)| {
        let other = finer.modes.get(number).map_or(0.0, |other| other.eigenvalue);
        // A frequency is the root of its eigenvalue.
        let difference = 0.5 * (mode.eigenvalue - other).abs() / other.abs().max(SMALL * highest);
        (mode.kind == Kind::Vibration).then_some(difference)
    };
    own.modes.iter().enumerate().map(share).collect()
}

/// `modes` with errors that are `factor` times the differences of two meshes.
fn with_errors(mut modes: Modes, differences: &[Option<f64>], factor: f64) -> Modes {
    let errors = differences.iter().map(|own| own.map(|own| own * factor));
    modes.modes.iter_mut().zip(errors).for_each(|(mode, error)| mode.mesh_error = error);
    modes
}

/// The number of the mode with the largest error, from 1 on, and that error; none: nothing is known.
fn worst(modes: &Modes) -> Option<(usize, f64)> {
    let known = modes.modes.iter().enumerate().filter_map(|(number, mode)| Some((number + 1, mode.mesh_error?)));
    known.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The warning about a mesh, which the program has chosen or the file gives.
fn warning(modes: &Modes, is_chosen: bool) -> Option<String> {
    let (mode, error) = worst(modes).filter(|(_, error)| *error > WARNED * EXPECTED)?;
    let size = if error > 1.0 { String::from("more than 100 %") } else { format!("about {}", percent(error)) };
    let times = pow(error.min(1.0) / EXPECTED, 1.0 / ORDER);
    let remedy = match is_chosen {
        true => String::from("ask for fewer modes, or give the beams more `elements`"),
        false => format!("take {times:.1} times the elements, or leave `elements` to the program"),
    };
    Some(format!(
        "the frequency of mode {mode} is off by {size} because of the mesh, as one twice as fine shows; {remedy}"
    ))
}
