//! Derivatives of the start: how the initial values of outputs and calculated parameters change with the inputs and
//! parameters that they are found from.
//!
//! The initial state is found again with a value that differs a little: whatever the start is, a drawing or an
//! equilibrium, its derivative is a difference. The change moves the system by about [`REACH`] of its size, where it
//! moves it at all. Nothing follows from a value that cannot be another one, as that of a drive that must begin at 0.

use super::Simulation;
use super::derivatives::finite;
use super::start::NoStart;
use crate::fmi::{Failure, Model, Value};

/// First change of a value, relative; of 0 the change itself, of a position over the system's size.
const TRIAL: f64 = 1e-6;
/// How far the system shall move, over its size: what a central difference of fourth order leaves out is then
/// round-off, and what the solver leaves of an equilibrium is small beside it.
const REACH: f64 = 1e-4;
/// The change is at most so many times the trial: a thousandth of a value.
const LARGEST: f64 = 1e3;
/// The change is at least this part of the trial: beyond, round-off is all there is.
const SMALLEST: f64 = 1e-5;

/// Offsets and weights of differences: central of fourth order, and, at the ends of a range, forward and backward of
/// second order.
const STENCILS: [&[(f64, f64)]; 3] = [
    &[(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)],
    &[(0.0, -1.5), (1.0, 2.0), (2.0, -0.5)],
    &[(0.0, 1.5), (-1.0, -2.0), (-2.0, 0.5)],
];

impl Simulation {
    /// The derivative of the initial value of variable `unknown` by that of variable `known`, a Real that can be set.
    pub(super) fn start_derivative(&mut self, unknown: usize, known: usize) -> Result<f64, Failure> {
        if let Some((_, column)) = self.derived.starts.iter().find(|(reference, _)| *reference == known) {
            return finite(column[unknown]);
        }
        let (present, warnings) = (self.save(), std::mem::take(&mut self.warnings));
        let starts = std::mem::take(&mut self.derived.starts);
        let column = self.start_column(known);
        self.go_back_to(&present);
        (self.warnings, self.derived.starts) = (warnings, starts);
        let column = match column {
            Ok(column) => column,
            Err(NoStart::NotFound(failure)) => return Err(failure),
            Err(NoStart::Refused(failure)) => {
                self.tell_fixed(known, &failure);
                vec![0.0; self.table.variables.len()]
            }
        };
        let derivative = column[unknown];
        self.derived.starts.push((known, column));
        finite(derivative)
    }

    /// Tells, once, that variable `known` cannot begin otherwise.
    fn tell_fixed(&mut self, known: usize, reason: &Failure) {
        if !self.told_fixed.contains(&known) {
            self.told_fixed.push(known);
            let Failure { message, .. } = reason;
            let name = &self.table.variables[known].name;
            self.warnings.push(format!(
                "derivatives of initial values with respect to {name} are given as 0, because it cannot begin at another \
                 value: {message}"
            ));
        }
    }

    /// Derivatives of all initial values by that of variable `known`. Leaves the model anywhere.
    fn start_column(&mut self, known: usize) -> Result<Vec<f64>, NoStart> {
        let (time, value) = (self.time(), self.value(known).number());
        let size = self.runner.system.size;
        let is_place = self.table.variables[known].quantity.unit == "m";
        let scale = match value.abs() {
            0.0 if is_place => size,
            0.0 => 1.0,
            amount => amount,
        };
        let trial = TRIAL * scale;
        let here = self.runner.state.q.clone();
        let at = |model: &mut Self, change: f64| -> Result<(), NoStart> {
            model.set_value(known, Value::Real(value + change))?;
            model.find_start(time)
        };
        at(self, trial).or_else(|above| {
            at(self, -trial).map_err(|below| if matches!(below, NoStart::Refused(_)) { above } else { below })
        })?;
        let there = &self.runner.state.q;
        // Another mesh has other coordinates: nothing is known of how far it is.
        let moved = match there.len() == here.len() {
            true => there.iter().zip(&here).map(|(there, here)| (there - here).abs()).fold(0.0, f64::max) / size,
            false => 0.0,
        };
        let wanted = REACH / moved.max(f64::MIN_POSITIVE); // of nothing far beyond the largest
        let change = trial * wanted.clamp(SMALLEST, LARGEST);
        let mut difference = |stencil: &[(f64, f64)]| {
            let mut sum = vec![0.0; self.table.variables.len()];
            for &(offset, weight) in stencil {
                at(self, offset * change)?;
                for (reference, sum) in sum.iter_mut().enumerate() {
                    *sum += weight / change * self.value(reference).number();
                }
            }
            Ok(sum)
        };
        let [central, forward, backward] = STENCILS;
        let first = difference(central);
        first.or_else(|failure: NoStart| difference(forward).or_else(|_| difference(backward)).map_err(|_| failure))
    }
}
