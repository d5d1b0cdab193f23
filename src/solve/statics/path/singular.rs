//! Limit points of a path, where its parameter turns back, and branch points, where another path crosses: located
//! between two points of the path, and told.
//!
//! At both the equations are singular. A limit point is a root of the growth of the parameter; a branch point one of
//! `1/(cᵀ K⁻¹ c)`, which goes through zero as the smallest eigenvalue does, where `c` is the motion nearby that is
//! nearest to a null vector.

use super::super::Statics;
use crate::error::{Error, decimal};
use crate::mechanics::state::State;
use crate::mechanics::state::path_point::PathPoint;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::solve::linear::irregular;
use crate::solve::step::integrator::MOST_HALVINGS;

/// A singular point is located to this share of the step.
const LOCATED: f64 = 1e-10;
/// Most points that are tried for it.
const MOST_TRIALS: usize = 60;
/// Places of points around a branch point, by the step, that its place is interpolated between: cubically, to some 1e-8
/// of the step.
const AROUND: [f64; 4] = [-0.04, -0.02, 0.02, 0.04];
/// A step goes over to the other path if more than this share of it is left behind the branch point; else the next one
/// does.
const ROOM: f64 = 0.25;

/// How far beside a singular point motions are counted, as a share of the step: points that lie closer together count
/// as one. Still closer to it, round-off decides.
const NEARBY: f64 = 0.02;

/// Inverse iterations for the motion that is nearest to a null vector.
const INVERSE_ITERATIONS: usize = 12;

/// A function of points of a path that has a root at a singular one.
enum Test<'a> {
    /// How fast the parameter grows.
    Growth,
    /// How stiff the equations are against a motion.
    Stiffness(&'a [f64]),
}

/// A part of a path that a step has gone.
struct Stretch<'a> {
    system: &'a System,
    from: &'a State,
    /// The other end, which counts all iterations.
    to: &'a mut State,
    length: f64,
}

/// A singular point.
struct Singularity {
    /// Its distance from the start of the step.
    length: f64,
    /// The parameter there.
    parameter: f64,
    /// The equilibrium, or one close to it.
    state: State,
}

impl Statics {
    /// Looks for a singular point of the path from `state` to `next`, `length` further on, and remarks it. Where the
    /// user wants another path, takes `next` there.
    ///
    /// # Errors
    /// The step has several of them, or the other path is not found: a smaller step may do.
    pub(super) fn pass_singular_point(
        &mut self,
        system: &System,
        state: &State,
        next: &mut State,
        length: f64,
    ) -> Result<(), Error> {
        let (Some(from), Some(to)) = (&state.path, &next.path) else { return Ok(()) };
        let turns = (from.growth() < 0.0) != (to.growth() < 0.0);
        // Under loads that have no potential the count is that of the symmetric part of the stiffness.
        let counts = !system.follows_no_potential(&next.excitation);
        let change = to.unstable.abs_diff(from.unstable);
        let crosses = match from.sign * to.sign {
            0 => counts && change % 2 == 1,
            sign => sign < 0,
        };
        let at_once = counts && !crosses && change > 0;
        let is_simple = !counts || change <= 1;
        if turns && !(crosses && is_simple) && state.halving < MOST_HALVINGS {
            return Err(several_points(state));
        }
        let mut stretch = Stretch { system, from: state, to: next, length };
        if turns {
            let remark = self.pass_limit_point(&mut stretch);
            self.stability.add_remark(remark);
        } else if crosses || at_once {
            let remark = self.pass_branch_point(&mut stretch)?;
            self.stability.add_remark(remark);
        }
        Ok(())
    }

    /// Locates the limit point of `stretch`, in words.
    fn pass_limit_point(&mut self, stretch: &mut Stretch) -> String {
        let grows = stretch.from.path.as_ref().is_some_and(|path| path.growth() > 0.0);
        let extremum = if grows { "maximum" } else { "minimum" };
        match self.locate(stretch, &Test::Growth) {
            Some(point) => {
                let (at, parameter) = (decimal(stretch.from.time + point.length), decimal(point.parameter));
                format!("the path passes a limit point at the arc length {at}: t has a {extremum} of {parameter} there")
            }
            None => {
                let [first, last] = [0.0, stretch.length].map(|length| decimal(stretch.from.time + length));
                format!(
                    "the path passes a limit point between the arc lengths {first} and {last}: Newton did not locate the {extremum} of t; take a smaller step"
                )
            }
        }
    }

    /// Locates the branch point of `stretch`, in words; takes its end to the other path if the user wants that.
    ///
    /// # Errors
    /// The other path is not found in what is left of the step.
    fn pass_branch_point(&mut self, stretch: &mut Stretch) -> Result<String, Error> {
        let (system, state) = (stretch.system, stretch.from);
        let Some((mut point, mut direction)) = self.branch_point(stretch) else {
            if state.halving < MOST_HALVINGS {
                return Err(several_points(state));
            }
            let [first, last] = stretch.ends();
            return Ok(format!("other paths may cross between t = {first} and {last}: they were not found"));
        };
        let number = state.path.as_ref().map_or(0, |path| path.branch_points) + 1;
        let mut frames = FrameCache::default();
        let moved = system.most_moved(&frames.of(system, &point.state), &direction).what;
        let (at, parameter) = (decimal(state.time + point.length), decimal(point.parameter));
        let ways = self.released_at(stretch, point.length);
        let several = match (state.path.as_ref(), stretch.to.path.as_ref()) {
            (Some(from), Some(to)) => from.unstable.abs_diff(to.unstable) != ways,
            _ => false,
        };
        if several && state.halving < MOST_HALVINGS {
            return Err(several_points(state));
        }
        let place = format!("branch point {number} at the arc length {at}, t = {parameter}");
        let ways = if ways > 1 { format!(" in {ways} ways at once") } else { String::new() };
        let branches = self.path.as_ref().map_or(&[][..], |path| &path.branches);
        let wanted = branches.iter().find(|branch| branch.unsigned_abs() == number).copied();
        let (Some(wanted), Some(path)) = (wanted, &mut point.state.path) else {
            if let Some(path) = &mut stretch.to.path {
                path.branch_points = number;
            }
            return Ok(format!(
                "another path crosses{ways} at {place}: along it {moved} moves most; simulation.branches = [{number}] goes over to it"
            ));
        };
        if wanted < 0 {
            direction.iter_mut().for_each(|value| *value = -*value);
        }
        direction.push(0.0);
        (path.tangent, path.branch_points) = (direction, number);
        let tried = stretch.to.statistics;
        stretch.to.clone_from(&point.state);
        stretch.to.statistics = tried;
        let rest = stretch.length - point.length;
        if rest > ROOM * stretch.length {
            self.go_along(system, &point.state, stretch.to, rest)?;
        } else if let Some(path) = &mut stretch.to.path {
            // So short a step would not tell one path from the other.
            path.lag = rest.max(f64::MIN_POSITIVE);
        }
        Ok(format!("the run goes over to the path that crosses{ways} at {place}: along it {moved} moves most"))
    }

    /// The branch point of `stretch`, with the direction of the path that crosses there.
    fn branch_point(&mut self, stretch: &mut Stretch) -> Option<(Singularity, Vec<f64>)> {
        for end in [stretch.to.clone(), stretch.from.clone()] {
            let Some(forces) = self.nearly_null(stretch.system, &end) else { continue };
            let Some(point) = self.locate(stretch, &Test::Stiffness(&forces)) else { continue };
            if let Some(direction) = self.null_vector(stretch.system, &point.state, &forces) {
                return Some((point, direction));
            }
        }
        None
    }

    /// How many motions begin or cease to release energy at the singular point of `stretch` that is `at` from its
    /// start.
    fn released_at(&mut self, stretch: &mut Stretch, at: f64) -> u64 {
        let mut counts = [0; 2];
        for (count, side) in counts.iter_mut().zip([-NEARBY, NEARBY]) {
            let length = (at + side * stretch.length).clamp(0.0, stretch.length);
            let Some(nearby) = self.point_at(stretch, length) else { continue };
            if self.linearize(stretch.system, &nearby).is_ok() {
                *count = self.kkt.releasing_motions(stretch.system).unwrap_or(0) as u64;
            }
        }
        counts[0].abs_diff(counts[1])
    }

    /// The motion that is nearest to a null vector of the equations at `point`, times the weights of
    /// [`System::mean_product`]: by inverse iterations.
    fn nearly_null(&mut self, system: &System, point: &State) -> Option<Vec<f64>> {
        self.linearize(system, point).ok()?;
        let count = point.q.len();
        let weight = |index| if system.is_place(index) { 1.0 / (system.spread * system.spread) } else { 1.0 };
        let mut motion: Vec<f64> = (0..self.right.len()).map(irregular).collect();
        for _ in 0..INVERSE_ITERATIONS {
            let size = system.mean_product(&motion[..count], &motion[..count]).sqrt();
            for (index, value) in motion[..count].iter_mut().enumerate() {
                *value *= weight(index) / size;
            }
            motion[count..].fill(0.0);
            self.kkt.solve_again(&mut motion).ok()?;
        }
        motion.truncate(count);
        let size = system.mean_product(&motion, &motion).sqrt();
        motion.iter_mut().enumerate().for_each(|(index, value)| *value *= weight(index) / size);
        motion.iter().all(|value| value.is_finite()).then_some(motion)
    }

    /// The motion against which the equations are singular at `point`, of length 1 by [`System::mean_product`]: the
    /// coordinate that moves most grows.
    fn null_vector(&mut self, system: &System, point: &State, forces: &[f64]) -> Option<Vec<f64>> {
        let mut motion = self.response_to(system, point, forces)?;
        motion.truncate(forces.len());
        let (_, largest) = system.correction_size(&motion);
        let size = system.mean_product(&motion, &motion).sqrt() * motion[largest].signum();
        motion.iter_mut().for_each(|value| *value /= size);
        motion.iter().all(|value| value.is_finite()).then_some(motion)
    }

    /// What forces `forces` on the coordinates do at `point`, to first order; none where the equations are singular to
    /// round-off.
    fn response_to(&mut self, system: &System, point: &State, forces: &[f64]) -> Option<Vec<f64>> {
        self.linearize(system, point).ok()?;
        let mut response = vec![0.0; self.right.len()];
        response[..forces.len()].copy_from_slice(forces);
        self.kkt.solve_again(&mut response).ok()?;
        Some(response)
    }

    /// The root of `test` in `stretch`; none if both ends are on one side of it.
    fn locate(&mut self, stretch: &mut Stretch, test: &Test) -> Option<Singularity> {
        let (start, end) = (stretch.from.clone(), stretch.to.clone());
        let low = self.value(stretch, start, test)?.0;
        let mut ends = [(0.0, low), (stretch.length, self.value(stretch, end, test)?.0)];
        if (ends[0].1 < 0.0) == (ends[1].1 < 0.0) {
            return None;
        }
        let mut found: Option<Singularity> = None;
        for _ in 0..MOST_TRIALS {
            let [(first, low), (last, high)] = ends;
            let trial = (first * high - last * low) / (high - low);
            let Some((value, point)) = self.try_at(stretch, trial, test) else {
                return self.interpolate(stretch, trial, test);
            };
            let moved = found.as_ref().map_or(f64::INFINITY, |found| (found.length - trial).abs());
            found = Some(Singularity { length: trial, parameter: point.instant(), state: point });
            if value == 0.0 || moved < LOCATED * stretch.length {
                break;
            }
            // The Illinois rule: an end that stays counts half, so that both approach the root.
            ends[0] = if (value < 0.0) == (high < 0.0) { (first, 0.5 * low) } else { (last, high) };
            ends[1] = (trial, value);
        }
        found
    }

    /// The root of `test` near `about`, interpolated between points around it: nearest to a branch point Newton cannot
    /// tell one path from the other. None if one of the points is not found either: fewer would give fewer digits.
    fn interpolate(&mut self, stretch: &mut Stretch, about: f64, test: &Test) -> Option<Singularity> {
        let mut points: Vec<(f64, [f64; 2])> = Vec::new();
        let mut nearest: Option<(f64, State)> = None;
        for offset in AROUND {
            let trial = about + offset * stretch.length;
            let (value, point) = self.try_at(stretch, trial, test)?;
            points.push((value, [trial, point.instant()]));
            if nearest.as_ref().is_none_or(|(best, _)| value.abs() < *best) {
                nearest = Some((value.abs(), point));
            }
        }
        let [length, parameter] = at_root(&points);
        nearest.map(|(_, state)| Singularity { length, parameter, state })
    }

    /// The point of the path that is `length` from the start of `stretch`, with the value of `test` there; none where
    /// it is not found.
    fn try_at(&mut self, stretch: &mut Stretch, length: f64, test: &Test) -> Option<(f64, State)> {
        let point = self.point_at(stretch, length)?;
        self.value(stretch, point, test)
    }

    /// The point of the path that is `length` from the start of `stretch`, without its tangent; none where it is not
    /// found.
    fn point_at(&mut self, stretch: &mut Stretch, length: f64) -> Option<State> {
        let mut point = stretch.from.clone();
        let outcome = self.find_along(stretch.system, stretch.from, &mut point, length);
        stretch.to.statistics.iterations += point.statistics.iterations - stretch.from.statistics.iterations;
        outcome.ok().map(|()| point)
    }

    /// The value of `test` at `point` of `stretch`, which gets its tangent if the test needs it.
    fn value(&mut self, stretch: &Stretch, mut point: State, test: &Test) -> Option<(f64, State)> {
        let value = match test {
            Test::Growth => {
                let before = &stretch.from.path.as_ref()?.tangent;
                self.set_tangent(stretch.system, &mut point, before).ok()?;
                point.path.as_ref().map(PathPoint::growth)?
            }
            Test::Stiffness(shape) => {
                let response = self.response_to(stretch.system, &point, shape)?;
                let work: f64 = response.iter().zip(*shape).map(|(response, force)| response * force).sum();
                1.0 / work
            }
        };
        Some((value, point))
    }
}

impl Stretch<'_> {
    /// The parameters at both ends, rounded for messages.
    fn ends(&self) -> [f64; 2] {
        [self.from, &*self.to].map(|state| decimal(state.instant()))
    }
}

/// The reason to halve a step that has passed several singular points.
fn several_points(state: &State) -> Error {
    Error::PathLost { parameter: state.instant(), what: String::from("has several singular points within a step") }
}

/// The two functions of a value at its root, by Lagrange's polynomial through points around it.
fn at_root(points: &[(f64, [f64; 2])]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for (number, (value, own)) in points.iter().enumerate() {
        let others = points.iter().enumerate().filter(|(other, _)| *other != number);
        let weight: f64 = others.map(|(_, (other, _))| other / (other - value)).product();
        sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += weight * own);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The place of the root and what else is known there, of functions that are cubic in the value: exact but for
    /// rounding.
    #[test]
    fn roots_are_interpolated_cubically() {
        let known = |value: f64| [0.7 + 2.0 * value - 3.0 * value * value + value.powi(3), 5.0 - value.powi(3)];
        let points = [-0.4, -0.15, 0.1, 0.5].map(|value| (value, known(value)));
        let [place, other] = at_root(&points);
        assert!((place - 0.7).abs() < 1e-14 && (other - 5.0).abs() < 1e-14, "{place} {other}");
    }
}
