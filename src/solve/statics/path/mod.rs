//! Equilibria along a path, by its arc length: the parameter of loads, drives, frames and temperatures is an unknown as
//! the coordinates are, so that the path goes on past limit points, where no equilibrium is near under a larger load
//! (MECHANICS 7.11).
//!
//! A step goes along the tangent of the path, then by Newton within the plane across it. Where the determinant of the
//! equations changes its sign, it has passed a limit point or a point where another path crosses (singular.rs).

mod corrector;
mod singular;

use self::corrector::{Across, Border};
use super::Statics;
use super::equilibrium::Equilibrium;
use crate::error::Error;
use crate::math::elementary::acos;
use crate::mechanics::state::State;
use crate::mechanics::state::path_point::PathPoint;
use crate::mechanics::system::System;
use crate::solve::newton::{self, Goal, Limit};

/// Largest turn of the tangent in a step, as its cosine: a step that turns further may have gone over to another path.
const LEAST_COSINE: f64 = 0.9;
/// Most iterations of a step: one that needs more may be heading for another path.
const MOST_ITERATIONS: usize = 8;

/// Where to go over to the path that crosses: the number of the branch point, from 1; negative: in the opposite
/// direction.
pub type Branch = i64;

/// How a path is followed, with scratch memory.
#[derive(Debug, Default)]
pub struct Path {
    branches: Vec<Branch>,
    border: Border,
}

impl Statics {
    /// Follows the path of equilibria by its arc length, over to other paths at `branches`.
    pub fn follow_path(mut self, branches: Vec<Branch>) -> Self {
        self.path = Some(Box::new(Path { branches, border: Border::default() }));
        self
    }

    /// Makes the equilibrium `state` the start of a path, if one is followed: in the direction in which the parameter
    /// grows.
    ///
    /// # Errors
    /// The path has no direction there.
    pub fn begin_path(&mut self, system: &System, state: &mut State) -> Result<(), Error> {
        if self.path.is_none() {
            return Ok(());
        }
        let mut tangent = vec![0.0; state.q.len() + 1];
        tangent[state.q.len()] = 1.0;
        state.path = Some(PathPoint { parameter: state.time, ..PathPoint::default() });
        self.set_tangent(system, state, &tangent).map(|_| ())
    }

    /// Takes `state` to `end`, `length` further along its path.
    ///
    /// # Errors
    /// Newton has not found the path, or it may be another one: `state` is as it was, but for the count of iterations.
    pub(super) fn step_along(
        &mut self,
        system: &System,
        state: &mut State,
        length: f64,
        end: f64,
    ) -> Result<(), Error> {
        if state.path.is_none() {
            return Err(Error::NotInitialized);
        }
        let mut next = self.next.take().unwrap_or_else(|| state.clone());
        next.clone_from(state);
        let lag = next.path.as_mut().map_or(0.0, |path| std::mem::take(&mut path.lag));
        let length = length + lag;
        let outcome = self.go_along(system, state, &mut next, length).and_then(|()| match lag {
            0.0 => self.pass_singular_point(system, state, &mut next, length),
            // It began at a branch point.
            _ => Ok(()),
        });
        match outcome {
            Ok(()) => {
                next.time = end;
                next.statistics.steps += 1;
                std::mem::swap(state, &mut next);
            }
            Err(_) => state.statistics = next.statistics,
        }
        self.next = Some(next);
        outcome
    }

    /// Takes `state`, which is close to a path of equilibria, to the nearest point of the path: within the plane across
    /// the direction that the path has there. A limit point is no obstacle, since the parameter changes too.
    ///
    /// # Errors
    /// Newton has not found the path; callers must discard `state`.
    pub fn settle_across(&mut self, system: &System, state: &mut State) -> Result<(), Error> {
        state.path = Some(PathPoint { parameter: state.instant(), ..PathPoint::default() });
        let wanted = state.clone();
        if self.go_across(system, &wanted, state).is_ok() {
            return Ok(());
        }
        // The equilibrium under the same load shows a better direction where the shape is far from the path.
        state.clone_from(&wanted);
        self.settle(system, state)?;
        self.go_across(system, &wanted, state)
    }

    /// Takes `state` along the path to the plane across it through `wanted`.
    fn go_across(&mut self, system: &System, wanted: &State, state: &mut State) -> Result<(), Error> {
        let mut direction = vec![0.0; state.q.len() + 1];
        direction[state.q.len()] = 1.0;
        self.set_tangent(system, state, &direction)?;
        let from = state.clone();
        let tangent = from.path.as_ref().map_or(&direction, |path| &path.tangent);
        let apart = wanted.q.iter().zip(&from.q).map(|(wanted, own)| wanted - own);
        let apart: Vec<f64> = apart.chain([wanted.instant() - from.instant()]).collect();
        self.find_along(system, &from, state, scalar_product(system, tangent, &apart))
    }

    /// Takes `next`, a copy of `state`, to the point of the path that is `length` further on, with the tangent there.
    ///
    /// # Errors
    /// As [`Self::step_along`]; callers must discard `next`.
    fn go_along(&mut self, system: &System, state: &State, next: &mut State, length: f64) -> Result<(), Error> {
        self.find_along(system, state, next, length)?;
        let (Some(from), Some(_)) = (&state.path, &next.path) else { return Ok(()) };
        let cosine = self.set_tangent(system, next, &from.tangent)?;
        if cosine < LEAST_COSINE {
            let what = format!("turns by {:.2} rad within a step", acos(cosine));
            return Err(Error::PathLost { parameter: from.parameter, what });
        }
        Ok(())
    }

    /// Takes `next`, a copy of `state`, to the point of the path that is `length` further on; its tangent is not set.
    ///
    /// # Errors
    /// As [`Self::step_along`].
    fn find_along(&mut self, system: &System, state: &State, next: &mut State, length: f64) -> Result<(), Error> {
        let (Some(from), Some(path)) = (&state.path, &mut self.path) else { return Ok(()) };
        let scratch = &mut self.scratch;
        scratch.multipliers.copy_from_slice(&state.multipliers);
        for ((q, start), slope) in scratch.q.iter_mut().zip(&state.q).zip(&from.tangent) {
            *q = start + length * slope;
        }
        let mut problem = Across {
            system,
            state,
            from,
            length,
            parameter: from.parameter + length * from.growth(),
            excitation: &mut self.current,
            motion: &mut self.current_motion,
            border: &mut path.border,
            scratch,
        };
        let mut iterations = next.statistics.iterations;
        let control = (Goal::Correction(self.tolerance), Limit::Fails(MOST_ITERATIONS));
        let time = from.parameter;
        let solved =
            newton::solve(system, &mut problem, &mut self.kkt, &mut self.right, control, time, &mut iterations);
        let parameter = problem.parameter;
        problem.set_given(parameter);
        next.statistics.iterations = iterations;
        self.convergence = Some(solved?);
        self.take_over(system, next, time)?;
        next.excitation.copy_from(&self.current);
        if let Some(path) = &mut next.path {
            path.parameter = parameter;
        }
        Ok(())
    }

    /// Sets the tangent at `state`, an equilibrium of its path, in the direction of `before`; returns the cosine of the
    /// angle between the two. Counts motions that release energy.
    ///
    /// # Errors
    /// The equations are singular.
    fn set_tangent(&mut self, system: &System, state: &mut State, before: &[f64]) -> Result<f64, Error> {
        let parameter = state.instant();
        let (Some(mut point), Some(path)) = (state.path.take(), &mut self.path) else { return Ok(1.0) };
        let mut problem = Across {
            system,
            state,
            from: &point,
            length: 0.0,
            parameter,
            excitation: &mut self.current,
            motion: &mut self.current_motion,
            border: &mut path.border,
            scratch: &mut self.scratch,
        };
        problem.set_given(parameter);
        let given = (&*problem.excitation, &*problem.motion);
        let outcome = {
            let mut equilibrium = Equilibrium::near(system, state, parameter, given, problem.scratch);
            newton::Problem::linearize(&mut equilibrium, &mut self.kkt, &mut self.right);
            self.kkt.factorize(system, parameter)
        };
        let outcome = outcome.and_then(|()| problem.find_border(&mut self.kkt));
        let mut cosine = 1.0;
        if outcome.is_ok() {
            let slopes = &path.border.response[..state.q.len()];
            let size = (system.mean_product(slopes, slopes) + 1.0).sqrt();
            point.tangent.clear();
            point.tangent.extend(slopes.iter().chain([&1.0]).map(|slope| slope / size));
            cosine = scalar_product(system, &point.tangent, before);
            if cosine < 0.0 {
                point.tangent.iter_mut().for_each(|value| *value = -*value);
                cosine = -cosine;
            }
            point.sign = self.kkt.sign();
            // Where a pivot is too small to tell its sign, the count before is the best guess.
            point.unstable = self.kkt.releasing_motions(system).map_or(point.unstable, |count| count as u64);
        }
        state.path = Some(point);
        outcome.map(|()| cosine)
    }
}

/// The scalar product of two directions of a path: changes of the coordinates, then of the parameter.
fn scalar_product(system: &System, one: &[f64], other: &[f64]) -> f64 {
    let [(one, first), (other, second)] = [one, other].map(|list| list.split_at(list.len().saturating_sub(1)));
    system.mean_product(one, other) + first.iter().zip(second).map(|(one, other)| one * other).sum::<f64>()
}
