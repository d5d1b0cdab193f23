//! Efforts of actuators that follow coordinates of the mechanism: controllers without a host.
//!
//! `e(t, x₁, x₂, …)` of coordinates and their rates. Over a step a coordinate is the mean of both its ends and its rate
//! the mean rate, so that the effort is implicit, and exact in the tangent. Where the expression has a corner between
//! both ends, the effort is its mean over the way. Walls and ropes that are written as efforts then return exactly the
//! work that they have taken.

use crate::math::integral::{integral_to_ends, integral_within};
use crate::mechanics::geometry::marker_jacobian::MarkerVector;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};
use crate::mechanics::marker::relative_coordinate::RelativeCoordinate;
use std::cell::RefCell;
use std::fmt;
use std::sync::Arc;

/// The effort at a time, s, and at what is read, and its derivative with respect to one of these, by its place; beyond
/// the end: none of them.
pub type EffortFunction = dyn Fn(f64, &[f64], usize) -> [f64; 2] + Send + Sync;

/// Intervals at most of the integral over a step: room for two jumps.
const INTERVALS: u32 = 120;
/// Share of a derivative up to which it is integrated: no result depends on it, only how fast Newton converges.
const SLOPE_ERROR: f64 = 1e-10;
/// The effort is linear over the way if its value in the middle is the mean of those at the ends up to so many times
/// the round-off of its largest one.
const STRAIGHT: f64 = 16.0;

/// An effort that follows coordinates.
#[derive(Clone)]
pub struct EffortLaw {
    /// The function of time that it is where everything stands as drawn: for its breaks.
    pub signal: Signal,
    /// The effort, N m or N.
    pub function: Arc<EffortFunction>,
    /// What it reads.
    pub readings: Vec<Reading>,
    /// Whether its expression may have corners: `max`, `abs`, `if`, and functions of the file.
    pub has_corners: bool,
}

/// A relative coordinate, or its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// The coordinate, by its number.
    pub coordinate: usize,
    /// Its rate, not itself.
    pub is_rate: bool,
}

impl fmt::Debug for EffortLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "f(t, {:?})", self.readings)
    }
}

/// The readings of an effort over a step, or at an instant.
#[derive(Clone, Debug)]
pub struct Way {
    /// The time, s.
    pub time: f64,
    /// The readings: coordinates in the middle of their way, rates.
    pub values: Vec<f64>,
    /// Half of the way of each, 0 of rates; none: there is no way, or it does not matter.
    pub halves: Option<Vec<f64>>,
}

impl EffortLaw {
    /// The effort, N or N m.
    pub fn over(&self, way: &Way) -> f64 {
        let value = |values: &[f64]| (self.function)(way.time, values, usize::MAX)[0];
        let Some(along) = Along::new(self, way) else { return value(&way.values) };
        let round_off = |values: &[f64]| -> f64 {
            let of = |(index, read): (usize, &f64)| (read * (self.function)(way.time, values, index)[1]).abs();
            f64::EPSILON * values.iter().enumerate().map(of).sum::<f64>()
        };
        let error = [0.0, 1.0].map(|share| along.at(share, round_off)).into_iter().fold(0.0, f64::max);
        let error = if error.is_finite() { error } else { 0.0 };
        integral_to_ends(&|share| along.at(share, value), 0.0, 1.0, error, INTERVALS)
    }

    /// Its derivative with respect to the reading of this index; of a coordinate twice that with respect to its end.
    pub fn slope(&self, way: &Way, index: usize) -> f64 {
        let slope = |values: &[f64]| (self.function)(way.time, values, index)[1];
        let Some(along) = Along::new(self, way) else { return slope(&way.values) };
        let is_rate = self.readings[index].is_rate;
        let weight = |share: f64| if is_rate { 1.0 } else { 2.0 * share };
        let size = [0.0, 0.5, 1.0].map(|share| along.at(share, slope).abs()).into_iter().fold(0.0, f64::max);
        integral_within(&|share| weight(share) * along.at(share, slope), 0.0, 1.0, SLOPE_ERROR * size)
    }
}

/// A way on which the effort is not linear.
struct Along<'a> {
    way: &'a Way,
    halves: &'a [f64],
    values: RefCell<Vec<f64>>,
}

impl<'a> Along<'a> {
    /// None: the effort in the middle is the mean.
    fn new(law: &EffortLaw, way: &'a Way) -> Option<Self> {
        let halves = way.halves.as_deref()?;
        let along = Self { way, halves, values: RefCell::new(way.values.clone()) };
        let value = |values: &[f64]| (law.function)(way.time, values, usize::MAX)[0];
        let [start, middle, end] = [0.0, 0.5, 1.0].map(|share| along.at(share, value));
        let largest = start.abs().max(middle.abs()).max(end.abs());
        let is_straight = (0.5 * (start + end) - middle).abs() <= STRAIGHT * f64::EPSILON * largest;
        (!is_straight).then_some(along)
    }

    /// The result of `take` at this share of the way.
    fn at(&self, share: f64, take: impl Fn(&[f64]) -> f64) -> f64 {
        let mut values = self.values.borrow_mut();
        let read = self.way.values.iter().zip(self.halves);
        values.iter_mut().zip(read).for_each(|(own, (middle, half))| *own = middle + (2.0 * share - 1.0) * half);
        take(&values)
    }
}

impl Reading {
    /// Half of the way of what is read over a step; 0 of a rate.
    pub fn half_of_way(self, all: &[RelativeCoordinate], step: &TimeStep) -> f64 {
        let at = |c: &Configuration| all[self.coordinate].value(c, c.relative_values[self.coordinate]);
        if self.is_rate { 0.0 } else { 0.5 * (at(step.end) - at(step.start)) }
    }

    /// What is read as the system passes through `c`, m, rad, m/s or rad/s.
    pub fn value(self, all: &[RelativeCoordinate], c: &Configuration, passage: &Passage) -> f64 {
        let own = &all[self.coordinate];
        let at = |c: &Configuration| own.value(c, c.relative_values[self.coordinate]);
        match (passage, self.is_rate) {
            (Passage::Rest | Passage::Corrected(_), true) => 0.0,
            (Passage::Rest | Passage::Corrected(_) | Passage::Instant { .. }, false) => at(c),
            (Passage::Instant { velocity, .. }, true) => own.rate(c, velocity),
            (Passage::Step(step), false) => 0.5 * (at(step.start) + at(step.end)),
            (Passage::Step(step), true) => (at(step.end) - at(step.start)) / step.duration,
        }
    }

    /// Its derivative with respect to the coordinates of both sides, 24×1 each; over a step twice that with respect to
    /// those at its end.
    pub fn gradient(self, all: &[RelativeCoordinate], c: &Configuration, passage: &Passage) -> [MarkerVector; 2] {
        let own = &all[self.coordinate];
        match (passage, self.is_rate) {
            (Passage::Rest | Passage::Corrected(_), true) => [MarkerVector::zeros(); 2],
            (Passage::Rest | Passage::Corrected(_) | Passage::Instant { .. }, false) => own.gradient(c),
            (Passage::Instant { velocity, .. }, true) => own.rate_gradient(c, velocity),
            (Passage::Step(step), false) => own.gradient(step.end),
            // Divided one by one: a factor `2/duration` would be moved to where there is no step, and hosts may trap a
            // division by zero.
            (Passage::Step(step), true) => own.gradient(step.end).map(|side| 2.0 * side / step.duration),
        }
    }
}
