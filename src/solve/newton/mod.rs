//! Newton's iteration on the constrained system, the same for an equilibrium and for a step.

mod definite;
pub mod kkt;
pub mod prediction;
pub mod refinement;
mod yielding;

use self::kkt::Kkt;
use crate::error::Error;
use crate::mechanics::state::Shrinking;
use crate::mechanics::system::System;

/// Most iterations: a step that needs more is heading for a far root, halving it is better (MECHANICS 7.4).
pub const MOST_ITERATIONS: usize = 15;

/// How an iteration went.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Iterations made.
    pub iterations: usize,
    /// Size of each correction (see [`System::motion_size`]), then that of the refinement of a single one. Where an
    /// iteration with another matrix follows, the second one is at least the first correction of that. Unused places
    /// are 0.
    pub corrections: [f64; MOST_ITERATIONS],
    /// How often the solution has to be refined with the same tangent.
    pub refinements: usize,
}

impl Convergence {
    /// Sizes of the corrections that iterations have made.
    pub fn made(&self) -> &[f64] {
        &self.corrections[..self.iterations]
    }

    /// Takes the size of the first refinement for that of a second correction: both are what a single correction has
    /// left.
    pub fn measure(&mut self, refinement: f64) {
        if self.iterations == 1 {
            self.corrections[1] = refinement;
        }
    }
}

/// Something Newton can solve.
pub trait Problem {
    /// Sets `right` to minus the residual at the current unknowns, and the matrix of `kkt` to its derivative, or to one
    /// that converges as fast or nearly so; returns the time at which loads were taken, s. After a correction `right`
    /// still has it.
    fn linearize(&mut self, kkt: &mut Kkt, right: &mut [f64]) -> f64;

    /// The force law that is not defined at the current unknowns, in words.
    fn undefined_law(&self) -> Option<String>;

    /// Extends the correction that solves the linear system by unknowns that the system does not have; returns the size
    /// of their own corrections.
    ///
    /// # Errors
    /// They are not determined.
    fn extend(&mut self, _kkt: &mut Kkt, _correction: &mut [f64]) -> Result<f64, Error> {
        Ok(0.0)
    }

    /// The size to which a correction of `size` is shortened before it is added: most are not.
    fn shortened(&mut self, size: f64) -> f64 {
        size
    }

    /// Adds a correction to the unknowns.
    fn correct(&mut self, correction: &[f64]);
}

/// When an iteration ends; sizes are those of [`System::motion_size`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// A correction is below this size. It is applied too, so that with an exact tangent, by its quadratic convergence,
    /// what remains is at round-off; with one that leaves a share of each correction, as that of damped beams at an
    /// instant, that share of it remains.
    Correction(f64),
    /// What remains after a correction is below a bound, by the ratio of the last two corrections, or after the first
    /// one by the `expected` ratio.
    Remainder {
        /// The bound: a size, and a share of the first correction.
        size: [f64; 2],
        /// How the first two corrections are expected to shrink.
        expected: Shrinking,
        /// Most refinements of the solution, 1 or more.
        refinements: usize,
    },
}

impl Goal {
    fn size(self) -> f64 {
        match self {
            Self::Correction(size) | Self::Remainder { size: [size, _], .. } => size,
        }
    }

    /// How often the solution has to be refined, where the goal is reached with the corrections made so far.
    fn reached(self, corrections: &[f64]) -> Option<usize> {
        match self {
            Self::Correction(size) => (*corrections.last()? < size).then_some(0),
            Self::Remainder { size, expected, refinements } => {
                refinement::needed(corrections, size, expected, refinements)
            }
        }
    }
}

/// How many iterations there may be, and what happens where they were not enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The iteration fails.
    Fails(usize),
    /// The last correction is taken for the solution, whatever it leaves.
    Ends(usize),
}

/// Iterates until `goal` is reached, or up to `limit`.
///
/// # Errors
/// The matrix is singular, or the iterations were not enough; `iterations` counts on in any case.
pub fn solve(
    system: &System,
    problem: &mut impl Problem,
    kkt: &mut Kkt,
    right: &mut [f64],
    (goal, limit): (Goal, Limit),
    time: f64,
    iterations: &mut u64,
) -> Result<Convergence, Error> {
    let mut convergence = Convergence { iterations: 0, corrections: [0.0; MOST_ITERATIONS], refinements: 0 };
    let mut last = f64::INFINITY;
    let (Limit::Fails(most) | Limit::Ends(most)) = limit;
    while convergence.iterations < most {
        let loads_time = problem.linearize(kkt, right);
        if right.iter().any(|value| !value.is_finite()) {
            *iterations += 1;
            let what = problem.undefined_law().unwrap_or_else(|| system.describe_not_finite(loads_time));
            return Err(Error::NotFinite { time: loads_time, what });
        }
        kkt.solve(system, right, time)?;
        let extension = problem.extend(kkt, right)?;
        let size = system.motion_size(right);
        let shortened = problem.shortened(size);
        if shortened < size {
            right.iter_mut().for_each(|correction| *correction *= shortened / size);
        }
        problem.correct(right);
        last = size + extension;
        convergence.corrections[convergence.iterations] = last;
        convergence.iterations += 1;
        *iterations += 1;
        if let Some(refinements) = goal.reached(&convergence.corrections[..convergence.iterations]) {
            return Ok(Convergence { refinements, ..convergence });
        }
        if !last.is_finite() {
            break;
        }
    }
    if matches!(limit, Limit::Ends(_)) && last.is_finite() {
        return Ok(convergence);
    }
    Err(not_converged(system, right, (convergence.iterations, last), time, goal.size()))
}

/// The error that Newton has not converged after so many iterations. `correction` is the last one that was found, and
/// has this size.
pub fn not_converged(
    system: &System,
    correction: &[f64],
    (iterations, size): (usize, f64),
    time: f64,
    tolerance: f64,
) -> Error {
    let (_, largest) = system.correction_size(correction);
    Error::NotConverged { time, iterations, correction: size, place: system.describe_unknown(largest), tolerance }
}
