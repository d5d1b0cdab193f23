//! The linear system in independent coordinates: `dx/dt = A x + B u`, `y = C x + D u`.
//!
//! The states are the changes of the independent coordinates, then their rates, then value and rate of every input that
//! prescribes a motion: its own input is the acceleration, which two integrators make the motion of.

use super::base::Base;
use super::differences::shortest;
use super::independent::Selection;
use super::{Inputs, Linearization};
use crate::error::Error;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::rotation::Rotation;
use crate::mechanics::system::variation::Variation;
use crate::solve::linear::dense::Dense;
use crate::solve::sensitivity::STENCIL;
use crate::solve::step::response::{Responder, Response};

/// Largest change of a coordinate for the derivatives of outputs: of a position over the shortest element. What a
/// difference of fourth order leaves out is round-off, also of strains of slender beams.
const REACH: f64 = 1e-4;
/// Change of an input for derivatives: forces are linear in loads.
const OF_FORCE: f64 = 1.0;

/// A system of first order.
#[derive(Clone, Debug, PartialEq)]
pub struct StateSpace {
    /// `A`.
    pub a: Dense,
    /// `B`, a column an input.
    pub b: Dense,
    /// `C`, a row an output.
    pub c: Dense,
    /// `D`.
    pub d: Dense,
}

/// The motion that a unit of a state or of an input makes.
#[derive(Clone, Debug)]
struct Motion {
    q: Vec<f64>,
    velocity: Vec<f64>,
    response: Response,
    /// The input that changes, and which derivative of it.
    given: Option<(usize, usize)>,
}

/// Makes the matrices.
#[derive(Debug)]
pub struct Reduction<'a, I> {
    system: &'a System,
    base: &'a Base,
    inputs: &'a I,
    selection: &'a Selection,
    linearization: Linearization,
    responder: Responder,
    frames: FrameCache,
    /// The frame that the states are seen from, which turns; none: the fixed frame.
    rotation: Option<&'a Rotation>,
    /// Rates and second derivatives of the coordinates of the base, as seen from there.
    relative: [Vec<f64>; 2],
}

impl<'a, I: Inputs> Reduction<'a, I> {
    /// Prepares the reduction of `linearization` about `base` to the coordinates of `selection`.
    pub fn new(
        (system, base, inputs): (&'a System, &'a Base, &'a I),
        linearization: Linearization,
        selection: &'a Selection,
    ) -> Self {
        let (responder, frames) = (Responder::new(system), FrameCache::default());
        let relative = [base.state.velocity.clone(), base.response.acceleration.clone()];
        Self { system, base, inputs, selection, linearization, responder, frames, rotation: None, relative }
    }

    /// The same, with states as seen from a frame that turns with `rotation` and has now the axes of the selection.
    #[must_use]
    pub fn seen_from(self, rotation: &'a Rotation) -> Self {
        let relative = rotation.relative_motion(&self.base.state, &self.base.response.acceleration);
        Self { rotation: Some(rotation), relative, ..self }
    }

    /// The matrices; `read` tells the outputs of a state, `outputs` in number.
    ///
    /// # Errors
    /// The constraints are redundant, or a number is not finite.
    pub fn matrices(
        &mut self,
        outputs: usize,
        mut read: impl FnMut(&State, &Response, &mut [f64]),
    ) -> Result<StateSpace, Error> {
        let free = self.selection.chosen.len();
        let motions: Vec<usize> = (0..self.inputs.count()).filter(|number| self.inputs.is_motion(*number)).collect();
        let (states, count) = (2 * (free + motions.len()), self.inputs.count());
        let mut a = Dense::zeros(states, states);
        let mut b = Dense::zeros(states, count);
        let mut c = Dense::zeros(outputs, states);
        let mut d = Dense::zeros(outputs, count);
        let mut set = |own: &mut Self, motion: &Motion, rows: &mut [f64], seen: &mut [f64]| {
            own.accelerations(motion, &mut rows[free..2 * free]);
            own.outputs(motion, &mut read, seen);
        };
        for number in 0..free {
            let motion = self.of_coordinate(number)?;
            set(self, &motion, a.column_mut(number), c.column_mut(number));
            let motion = self.of_rate(number)?;
            let column = free + number;
            a.column_mut(column)[number] = 1.0;
            set(self, &motion, a.column_mut(column), c.column_mut(column));
        }
        for (own, number) in motions.iter().enumerate() {
            let [value, rate] = [0, 1].map(|order| 2 * free + 2 * own + order);
            let motion = self.of_input(*number, 0)?;
            set(self, &motion, a.column_mut(value), c.column_mut(value));
            let motion = self.of_input(*number, 1)?;
            a.column_mut(rate)[value] = 1.0;
            set(self, &motion, a.column_mut(rate), c.column_mut(rate));
            b.column_mut(*number)[rate] = 1.0;
        }
        for number in 0..count {
            let order = if self.inputs.is_motion(number) { 2 } else { 0 };
            let motion = self.of_input(number, order)?;
            set(self, &motion, b.column_mut(number), d.column_mut(number));
        }
        Ok(StateSpace { a, b, c, d })
    }

    /// A unit of independent coordinate `number`, its rate being unchanged.
    fn of_coordinate(&mut self, number: usize) -> Result<Motion, Error> {
        let q = self.selection.shapes.column(number).to_vec();
        self.finish(q, vec![0.0; self.system.constraints()], None, None)
    }

    /// A unit of the rate of independent coordinate `number`.
    fn of_rate(&mut self, number: usize) -> Result<Motion, Error> {
        let still = vec![0.0; self.system.coordinates()];
        self.finish(still, vec![0.0; self.system.constraints()], Some(number), None)
    }

    /// A unit of derivative number `order` of input `number`, the independent coordinates and rates being unchanged.
    fn of_input(&mut self, number: usize, order: usize) -> Result<Motion, Error> {
        let conditions = self.system.constraints();
        let (mut held, mut rates) = (vec![0.0; conditions], vec![0.0; conditions]);
        if self.inputs.is_motion(number) && order < 2 {
            let base = self.base;
            self.each_change(number, order, |system, state, frames, weight| {
                let configuration = frames.of(system, state);
                let (mut own, mut gradients) = (vec![0.0; conditions], Vec::new());
                if order == 0 {
                    system.constraint_conditions(&configuration, &mut own);
                    held.iter_mut().zip(&own).for_each(|(held, own)| *held -= weight * own);
                }
                system.constraint_rates(&configuration, &mut own);
                system.constraint_gradients(&configuration, &mut gradients);
                system.add_constraint_rates(&gradients, &base.state.velocity, &mut own);
                rates.iter_mut().zip(&own).for_each(|(rate, own)| *rate -= weight * own);
                Ok(())
            })?;
        }
        let q = self.lift(&held, None, &[])?;
        self.finish(q, rates, None, Some((number, order)))
    }

    /// The change of all coordinates that changes the conditions by `conditions` and the independent coordinates by
    /// nothing, or the rate of one of them by 1; `present` is what the rates of the independent ones have already.
    fn lift(&mut self, conditions: &[f64], unit: Option<usize>, present: &[f64]) -> Result<Vec<f64>, Error> {
        let (coordinates, free) = (self.system.coordinates(), self.selection.chosen.len());
        let mut found = vec![0.0; coordinates + conditions.len()];
        if conditions.iter().any(|value| *value != 0.0) {
            found[coordinates..].copy_from_slice(conditions);
            self.linearization.respond(self.system, &mut found)?;
        }
        found.truncate(coordinates);
        let mut wrong = vec![0.0; free];
        let directors = &self.base.state.q;
        self.selection.read(self.system, &[(1.0, directors, &found)], &found, &mut wrong);
        wrong.iter_mut().zip(present).for_each(|(wrong, present)| *wrong += present);
        if let Some(unit) = unit {
            wrong[unit] -= 1.0;
        }
        let back = self.selection.shapes.times(&wrong);
        found.iter_mut().zip(back).for_each(|(found, back)| *found -= back);
        Ok(found)
    }

    /// Velocities, accelerations and multipliers that belong to the change `q`, where the rates of the conditions have
    /// `rates` besides.
    fn finish(
        &mut self,
        q: Vec<f64>,
        mut rates: Vec<f64>,
        unit: Option<usize>,
        given: Option<(usize, usize)>,
    ) -> Result<Motion, Error> {
        let (coordinates, free) = (self.system.coordinates(), self.selection.chosen.len());
        // Charts and directors that move have a part in the rates of the independent coordinates.
        let mut present = vec![0.0; free];
        if !self.base.is_at_rest {
            let mut turned = vec![0.0; coordinates];
            self.add_turning(&q, &mut turned);
            let pairs = [(1.0, &self.relative[0][..], &q[..]), (1.0, &self.base.state.q, &turned)];
            self.selection.read(self.system, &pairs, &turned, &mut present);
            let mut own = vec![0.0; rates.len()];
            self.linearization.rates_by_q.multiply_add(&q, &mut own);
            rates.iter_mut().zip(&own).for_each(|(rate, own)| *rate -= own);
        }
        let velocity = self.lift(&rates, unit, &present)?;
        let mut right = vec![0.0; coordinates + rates.len()];
        if let Some((number, order)) = given {
            self.add_given(number, order, &mut right)?;
        }
        self.linearization.add_forces(&q, &velocity, &mut right);
        self.linearization.respond(self.system, &mut right)?;
        let multipliers = right.split_off(coordinates);
        Ok(Motion { q, velocity, response: Response { acceleration: right, multipliers }, given })
    }

    /// Adds what an input changes the balance of the base by.
    fn add_given(&mut self, number: usize, order: usize, right: &mut [f64]) -> Result<(), Error> {
        let mut responder = std::mem::replace(&mut self.responder, Responder::new(self.system));
        let (base, mut own) = (self.base, vec![0.0; right.len()]);
        let added = self.each_change(number, order, |system, state, _, weight| {
            responder.balance(system, state, &base.response, &mut own)?;
            right.iter_mut().zip(&own).for_each(|(right, own)| *right += weight * own);
            Ok(())
        });
        self.responder = responder;
        added
    }

    /// Calls `take` with states in which an input is changed, each with its weight in the derivative.
    fn each_change(
        &mut self,
        number: usize,
        order: usize,
        mut take: impl FnMut(&System, &State, &mut FrameCache, f64) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let unit = match (self.inputs.is_motion(number), order) {
            (true, 0) => REACH * shortest(self.system),
            _ => OF_FORCE,
        };
        let mut moved = State::default();
        for (offset, weight) in STENCIL {
            moved.clone_from(&self.base.state);
            self.inputs.change(number, order, offset * unit, &mut moved);
            take(self.system, &moved, &mut self.frames, weight / unit)?;
        }
        Ok(())
    }

    /// `target += (N − W) q`: what charts that go with the motion, and the frame, change the rates by.
    fn add_turning(&self, q: &[f64], target: &mut [f64]) {
        self.linearization.add_turning(q, 1.0, target);
        if let Some(rotation) = self.rotation {
            target.iter_mut().zip(rotation.cross(q)).for_each(|(own, turned)| *own -= turned);
        }
    }

    /// Sets `rows` to the second derivatives of the independent coordinates.
    fn accelerations(&self, motion: &Motion, rows: &mut [f64]) {
        let state = &self.base.state;
        let Motion { q, velocity, response, .. } = motion;
        let (mut rate, mut second) = (velocity.clone(), response.acceleration.clone());
        if !self.base.is_at_rest {
            // d²q/dt² = da − W dv + (N − W) dq/dt, dq/dt = dv + (N − W) dq.
            self.add_turning(q, &mut rate);
            self.add_turning(&rate, &mut second);
            if let Some(rotation) = self.rotation {
                second.iter_mut().zip(rotation.cross(velocity)).for_each(|(own, turned)| *own -= turned);
            }
        }
        let [base_rate, base_second] = &self.relative;
        let pairs = [(1.0, &base_second[..], &q[..]), (2.0, base_rate, &rate), (1.0, &state.q, &second)];
        self.selection.read(self.system, &pairs, &second, rows);
    }

    /// Sets `seen` to what the outputs change by.
    fn outputs(&self, motion: &Motion, read: &mut impl FnMut(&State, &Response, &mut [f64]), seen: &mut [f64]) {
        let (system, base) = (self.system, self.base);
        let mut change = Variation::default();
        change.set_zero(&base.state);
        change.lists.q.copy_from_slice(&motion.q);
        change.lists.velocity.copy_from_slice(&motion.velocity);
        let unit = self.unit(motion);
        let (mut moved, mut frames, mut values) = (State::default(), FrameCache::default(), vec![0.0; seen.len()]);
        let mut response = base.response.clone();
        for (offset, weight) in STENCIL {
            let by = offset * unit;
            moved.clone_from(&base.state);
            if let Some((number, order)) = motion.given {
                self.inputs.change(number, order, by, &mut moved);
            }
            change.apply(system, by, &mut moved, &mut frames);
            system.set_momentum(&mut moved);
            set_moved(&mut response.acceleration, &base.response.acceleration, &motion.response.acceleration, by);
            set_moved(&mut response.multipliers, &base.response.multipliers, &motion.response.multipliers, by);
            read(&moved, &response, &mut values);
            seen.iter_mut().zip(&values).for_each(|(seen, value)| *seen += weight / unit * value);
        }
    }

    /// The step of differences along `motion`: small for positions, slopes and their rates.
    fn unit(&self, motion: &Motion) -> f64 {
        let reach = self.system.smooth_reach(REACH);
        let length = self.system.size / shortest(self.system);
        let size = |changes: &[f64]| {
            let [positions, others] = self.system.motion_sizes(changes);
            (positions * length).max(others)
        };
        let largest = size(&motion.q).max(size(&motion.velocity));
        let given = match motion.given {
            Some((number, 0)) if self.inputs.is_motion(number) => REACH * shortest(self.system),
            _ => OF_FORCE,
        };
        if largest > 0.0 { f64::min(given, reach / largest) } else { given }
    }
}

fn set_moved(target: &mut [f64], base: &[f64], change: &[f64], by: f64) {
    for ((target, base), change) in target.iter_mut().zip(base).zip(change) {
        *target = base + by * change;
    }
}

/// Changes the derivative of order `order` of drive `drive` by `by`.
pub fn change_drive(prescribed: &mut Prescribed, drive: usize, order: usize, by: f64) {
    let jet = &mut prescribed.drives[drive];
    *[&mut jet.value, &mut jet.first, &mut jet.second][order] += by;
}
