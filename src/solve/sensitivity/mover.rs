//! States as they would be, had the host given something else.

use super::{Inputs, REACH};
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::variation::Variation;

/// A communication step.
#[derive(Debug)]
pub struct Step<'a, N> {
    /// The state at its start.
    pub start: &'a State,
    /// What the host gave for it.
    pub inputs: &'a N,
    /// Whether frames and drives move at its end: they do not in an equilibrium.
    pub moves: bool,
}

impl<N> Clone for Step<'_, N> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<N> Copy for Step<'_, N> {}

impl<N: Inputs> Step<'_, N> {
    /// The change of input `number` for differences along a direction: of states, and of the unknowns of a step of
    /// `step` s.
    pub(super) fn reach(
        &self,
        system: &System,
        number: usize,
        variation: &Variation,
        change: &[f64],
        step: f64,
    ) -> f64 {
        let size = |list: &[f64]| if list.is_empty() { 0.0 } else { system.correction_size(list).0 };
        let algorithmic = &variation.lists.algorithmic_acceleration;
        let motion = [
            size(&variation.lists.q),
            size(change),
            step * size(&variation.lists.velocity),
            step * step * size(algorithmic),
        ];
        let motion = motion.into_iter().fold(0.0, f64::max);
        // Compilers divide first and choose afterwards: not by 0, which hosts may trap.
        let by_motion = if motion > 0.0 {
            system.smooth_reach(system.straight_reach(REACH)) / motion.max(f64::MIN_POSITIVE)
        } else {
            f64::INFINITY
        };
        let reach = f64::min(REACH * self.inputs.unit(number), by_motion);
        // What does not move at all, or not yet, may change by anything.
        if reach.is_finite() { reach } else { 1.0 }
    }
}

/// Makes changed states.
#[derive(Debug, Default)]
pub(super) struct Mover {
    moved: State,
    motion: Prescribed,
    frames: FrameCache,
}

impl Mover {
    /// The state `from` of the communication step `step`, had input `number` been larger by `by`; `variation` is how it
    /// depends on that input.
    pub fn move_from(
        &mut self,
        system: &System,
        step: &Step<'_, impl Inputs>,
        number: usize,
        from: &State,
        variation: &Variation,
        by: f64,
    ) -> &State {
        let Self { moved, motion, frames } = self;
        moved.clone_from(from);
        step.inputs.aim(number, by, &mut moved.targets);
        if from.time > step.start.time {
            system.prescribe(moved, from.time, motion);
            std::mem::swap(&mut moved.prescribed, motion);
            if !step.moves {
                moved.prescribed.stop();
            }
        }
        variation.apply(system, by, moved, frames);
        moved
    }

    /// The gradients of the constraints at `state`, and its configuration.
    pub fn gradients_at<'a>(
        &'a mut self,
        system: &'a System,
        state: &'a State,
        gradients: &mut Vec<JointGradient>,
    ) -> Configuration<'a> {
        let configuration = self.frames.of(system, state);
        system.constraint_gradients(&configuration, gradients);
        configuration
    }

    /// The frames at `state` where the mass matrix depends on them.
    pub fn mass_frames(&mut self, system: &System, state: &State) -> &FrameCache {
        if system.has_following_inertia() {
            self.frames.set(system, &state.q, &state.triads);
        }
        &self.frames
    }
}
