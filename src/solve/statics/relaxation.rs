//! The first equilibrium of a system that has no stiffness as drawn: what hangs slack falls, without swinging, to where
//! it hangs.
//!
//! Pseudo-transient continuation: `[K + μ M, Gᵀ; G, 0]`, one linear solve a step, `μ` falling where the potential falls
//! and rising where it does not. It ends where Newton without `μ` takes over. A motion that stays free is found by
//! that.

use super::{Equilibrium, LARGEST_TURN, Statics};
use crate::error::{Error, decimal};
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::mass::MassAt;
use crate::solve::newton::Problem;

/// Most steps; a fall from a quarter turn away takes some twenty.
const STEPS: usize = 500;
/// Largest correction of a step: lengths over the system's size, slopes and angles in rad.
const LARGEST_CORRECTION: f64 = 0.3;
/// A correction that Newton can be trusted with.
const NEAR: f64 = 1e-4;
/// Factors by which `μ` falls after a good step and rises after a bad one.
const FALL: f64 = 0.5;
const RISE: f64 = 4.0;
/// Largest `μ`, in that of the first step: where that is not enough it is drives and frames that move too far, and ever
/// larger ones would only make multipliers grow that pass for stiffness.
const MOST_DAMPING: f64 = 1e6;
/// An equilibrium so far from the drawing is another one than was drawn: places over the system's size, slopes, angles
/// and directors as they are. Of the axes of a body that turns by 53 degrees a component changes by 0.8.
const FAR: f64 = 0.8;
/// Shares of the way of drives and frames that are taken in one step.
const LARGEST_SHARE: f64 = 0.05;
const SMALLEST_SHARE: f64 = 1e-4;

impl Statics {
    /// Lets the system fall from `state` to the equilibrium under the whole excitation of `time`, s, and writes it
    /// there.
    ///
    /// # Errors
    /// It does not come to rest, or a part of it can move freely.
    pub(super) fn relax(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        self.current.copy_from(&self.target);
        self.begin.clone_from(state);
        let (mut share, mut increment) = (0.0, LARGEST_SHARE);
        let (mut damping, mut most, mut near) = (None, f64::INFINITY, NEAR);
        let mut outcome = Ok(());
        for _ in 0..STEPS {
            let next = f64::min(share + increment, 1.0);
            self.current_motion.set_between(&self.begin.prescribed, &self.target_motion, next);
            let given = (&self.current, &self.current_motion);
            Equilibrium::near(system, state, time, given, &mut self.scratch).linearize(&mut self.kkt, &mut self.right);
            // At first so much that free fall would make steps of a tenth of the system.
            let current = *damping.get_or_insert_with(|| {
                let first = first_damping(system, &self.right);
                most = MOST_DAMPING * first;
                first
            });
            system.add_mass(MassAt::CONSTANT, current, &mut self.kkt.blocks);
            state.statistics.iterations += 1;
            self.kkt.solve(system, &mut self.right, time)?;
            let (size, _) = system.correction_size(&self.right);
            // What the forces do along the correction: down the potential, unless drives and frames drag it up.
            let work: f64 = self.scratch.forces.iter().zip(&self.right).map(|(force, change)| -force * change).sum();
            let falls = work >= 0.0 || share < 1.0;
            if !falls || size.is_nan() || size > LARGEST_CORRECTION || !self.accept(system, state, time) {
                damping = Some(f64::min(current * RISE, most));
                increment = f64::max(0.5 * increment, SMALLEST_SHARE);
                state.statistics.rejected += 1;
                continue;
            }
            share = next;
            increment = f64::min(2.0 * increment, LARGEST_SHARE);
            damping = Some(current * FALL);
            if size < near && share == 1.0 {
                // A small correction may be due to the damping alone: Newton without it tells.
                outcome = self.solve(system, state, time);
                if outcome.is_ok() {
                    self.arrive(state);
                    return Ok(());
                }
                near *= 0.1;
            }
        }
        outcome.and_then(|()| self.solve(system, state, time))?;
        self.arrive(state);
        Ok(())
    }

    /// Remarks that the equilibrium `found`, to which the system has fallen from `drawn`, is far from there.
    pub(super) fn remark_fall(&mut self, system: &System, drawn: &State, found: &State) {
        let change: Vec<f64> = found.q.iter().zip(&drawn.q).map(|(found, drawn)| found - drawn).collect();
        let (size, index) = system.correction_size(&change);
        // Drives that are not where they are drawn move the mechanism on purpose.
        let mut drives = found.prescribed.drives.iter().zip(&drawn.prescribed.drives);
        let is_driven = drives.any(|(found, drawn)| found.value != drawn.value);
        if size > FAR && !is_driven {
            self.stability.add_remark(format!(
                "the equilibrium of t = {} s is found far from where the mechanism is drawn, by letting it fall to where it hangs; {} has moved most. If it should stay, hold it by a \
                 joint, a [lock.NAME] or a spring; if it should hang, draw it near its equilibrium",
                decimal(found.time),
                system.describe_unknown(index)
            ));
        }
    }

    /// Takes the correction in `right` into `state`, if the system bears it.
    fn accept(&mut self, system: &System, state: &mut State, time: f64) -> bool {
        let scratch = &mut self.scratch;
        let (coordinates, multipliers) = self.right.split_at(state.q.len());
        for (value, change) in scratch.q.iter_mut().zip(coordinates) {
            *value += change;
        }
        for (value, change) in scratch.multipliers.iter_mut().zip(multipliers) {
            *value += change;
        }
        let configuration = scratch.frames.at(system, &scratch.q, state, &self.current_motion);
        if system.check(&configuration, state, LARGEST_TURN, time).is_err() {
            return false;
        }
        state.multipliers.copy_from_slice(&scratch.multipliers);
        system.arrive(state, (&scratch.q, &scratch.frames, &self.current_motion), None);
        true
    }
}

/// `μ` at which the acceleration of the whole system by its unbalanced forces makes a step of a tenth of its size,
/// 1/s².
fn first_damping(system: &System, forces: &[f64]) -> f64 {
    let coordinates = system.coordinates();
    let mut ones = vec![0.0; coordinates];
    let places = (0..coordinates).filter(|index| system.is_place(*index));
    places.for_each(|index| ones[index] = 1.0);
    let mut masses = vec![0.0; coordinates];
    system.mass_times(MassAt::CONSTANT, &ones, &mut masses);
    let mut fastest = 0.0_f64;
    for index in (0..coordinates).filter(|index| system.is_place(*index) && masses[*index] > 0.0) {
        fastest = fastest.max(forces[index].abs() / masses[index]);
    }
    // Without unbalanced forces anything will do: there is nothing to fall.
    if fastest > 0.0 && fastest.is_finite() { 10.0 * fastest / system.size } else { 1.0 }
}
