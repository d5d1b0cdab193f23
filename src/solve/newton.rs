//! Newton's iteration on the constrained system, the same for an equilibrium and for a step.

use super::kkt::Kkt;
use super::linear::Singular;
use crate::error::Error;
use crate::mechanics::system::System;

/// Most iterations: a step that needs more is heading for a far root, halving it is better (MECHANICS 7.4).
pub const MOST_ITERATIONS: usize = 15;

/// A factor between corrections by which a tangent of before is as good as a new one, which costs three times as much. What a last correction leaves
/// is below a ninth of it then.
const FAST: f64 = 0.1;
/// A correction below which the next one is that much smaller: its square is multiplied with 1 to 3 in the shaft, the buckling strip, the chain.
const NEAR: f64 = 0.03;
/// A tolerance above this does not ask for round-off: tangents may serve for more than one iteration. Below it they do not: what they leave is
/// small in the size of corrections, but has a direction in which stiff beams gain or lose energy (1e-9 in 2,000 steps instead of 1e-12).
pub const LOOSE: f64 = 1e-6;

/// Backward error of a correction: the next residual shows what it leaves, the last one leaves this share of a small correction.
const CORRECTION_ERROR: f64 = 1e-9;

/// How an iteration went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Iterations made.
    pub iterations: usize,
    /// Tangents made for them.
    pub tangents: usize,
    /// Size of each correction (see [`System::correction_size`]); unused places are 0.
    pub corrections: [f64; MOST_ITERATIONS],
}

/// Something Newton can solve.
pub trait Problem {
    /// Sets `right` to minus the residual at the current unknowns, and the matrix of `kkt` to its derivative;
    /// returns the time at which loads were taken, s.
    fn linearize(&mut self, kkt: &mut Kkt, right: &mut [f64]) -> f64;

    /// [`Self::linearize`] without the matrix, for an iteration with the one of before; none: every iteration needs its own.
    fn residual(&mut self, _right: &mut [f64]) -> Option<f64> {
        None
    }

    /// Adds a correction to the unknowns.
    fn correct(&mut self, correction: &[f64]);
}

/// Iterates until a correction of the coordinates is below `tolerance`; that correction is applied too, so that by the quadratic
/// convergence of the exact tangent what remains is at round-off. With a loose tolerance a tangent serves for more than one iteration where
/// corrections are small: they fall by a constant factor then.
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
    let mut convergence = Convergence { iterations: 0, tangents: 0, corrections: [0.0; MOST_ITERATIONS] };
    let mut last = (f64::INFINITY, 0);
    let mut keeps_tangent = false;
    while convergence.iterations < limit {
        let kept = if keeps_tangent { problem.residual(right) } else { None };
        let loads_time = kept.unwrap_or_else(|| problem.linearize(kkt, right));
        if right.iter().any(|value| !value.is_finite()) {
            *iterations += 1;
            return Err(Error::NotFinite { time: loads_time, what: system.describe_not_finite(loads_time) });
        }
        if kept.is_none() {
            kkt.factorize(system, time)?;
            convergence.tangents += 1;
        }
        kkt.solve_to(CORRECTION_ERROR, right).map_err(|Singular| kkt.singular(system, time))?;
        problem.correct(right);
        let before = last.0;
        last = system.correction_size(right);
        convergence.corrections[convergence.iterations] = last.0;
        convergence.iterations += 1;
        *iterations += 1;
        let (size, is_fast) = (last.0, last.0 < FAST * before);
        if size < tolerance && (kept.is_none() || is_fast) {
            return Ok(convergence);
        }
        keeps_tangent = tolerance > LOOSE && if kept.is_none() { size < NEAR } else { is_fast };
        if !last.0.is_finite() {
            break;
        }
    }
    let place = system.describe_unknown(last.1);
    Err(Error::NotConverged { time, iterations: convergence.iterations, correction: last.0, place, tolerance })
}
