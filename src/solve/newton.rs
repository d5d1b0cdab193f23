//! Newton's iteration on the constrained system, the same for an equilibrium and for a step.

use super::kkt::Kkt;
use crate::error::Error;
use crate::mechanics::system::System;

/// Most iterations: a step that needs more is heading for a far root, halving it is better (MECHANICS 7.4).
pub const MOST_ITERATIONS: usize = 15;

/// How an iteration went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Iterations made.
    pub iterations: usize,
    /// Size of each correction (see [`System::correction_size`]); unused places are 0.
    pub corrections: [f64; MOST_ITERATIONS],
}

/// Something Newton can solve.
pub trait Problem {
    /// Sets `right` to minus the residual at the current unknowns, and the matrix of `kkt` to its derivative;
    /// returns the time at which loads were taken, s.
    fn linearize(&mut self, kkt: &mut Kkt, right: &mut [f64]) -> f64;

    /// Adds a correction to the unknowns.
    fn correct(&mut self, correction: &[f64]);
}

/// Iterates until a correction of the coordinates is below `tolerance`; that correction is applied too, so that by the quadratic
/// convergence of the exact tangent what remains is at round-off.
///
/// # Errors
/// The matrix is singular, or `limit` iterations were not enough; `iterations` counts on in any case.
pub fn solve(
    system: &System,
    problem: &mut impl Problem,
    kkt: &mut Kkt,
    right: &mut [f64],
    (tolerance, limit): (f64, usize),
    time: f64,
    iterations: &mut u64,
) -> Result<Convergence, Error> {
    let mut convergence = Convergence { iterations: 0, corrections: [0.0; MOST_ITERATIONS] };
    let mut last = (f64::INFINITY, 0);
    while convergence.iterations < limit {
        let loads_time = problem.linearize(kkt, right);
        if right.iter().any(|value| !value.is_finite()) {
            *iterations += 1;
            return Err(Error::NotFinite { time: loads_time, what: system.describe_not_finite(loads_time) });
        }
        kkt.solve(system, right, time)?;
        problem.correct(right);
        last = system.correction_size(right);
        convergence.corrections[convergence.iterations] = last.0;
        convergence.iterations += 1;
        *iterations += 1;
        if last.0 < tolerance {
            return Ok(convergence);
        }
        if !last.0.is_finite() {
            break;
        }
    }
    let place = system.describe_unknown(last.1);
    Err(Error::NotConverged { time, iterations: convergence.iterations, correction: last.0, place, tolerance })
}
