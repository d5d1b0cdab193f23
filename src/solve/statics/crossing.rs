//! Where a path of equilibria becomes unstable, or stable again.

use super::Statics;
use super::stability::{self, Softest, StabilityRecord};
use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;

/// Least energy that a motion releases at an unstable equilibrium, over its cost at the stable one next to it. A part
/// that can nearly move freely, as a rope along its post does, costs about nothing in both. A path that goes on
/// becoming unstable is seen one increment later.
const NEUTRAL: f64 = 0.02;

impl Statics {
    /// Remarks that the equilibrium `state` is unstable and follows from none that is known.
    pub(super) fn remark_start(&mut self, system: &System, state: &State) {
        if self.linearize(system, state).is_ok()
            && let Some(softest) = stability::softest(system, &mut self.kkt, state)
        {
            self.stability.remark_start(system, state, &softest);
        }
    }

    /// Looks whether the path has become unstable, or stable again, from `state`, of which `before` is known, to
    /// `next`.
    pub(super) fn watch_stability(&mut self, system: &System, state: &State, next: &State, before: StabilityRecord) {
        let unstable_now = self.judge(system, next);
        if !self.stability.differs(before) {
            return;
        }
        let (unstable, stable) = if unstable_now { (next, state) } else { (state, next) };
        let Some(softest) = self.softest_of(system, unstable) else { return };
        if softest.is_stable() {
            self.stability.mark_stable(unstable.time);
            return;
        }
        let Some(other) = self.cost_elsewhere(system, &softest, unstable, stable) else { return };
        if softest.eigenvalue > -NEUTRAL * other {
            self.stability.mark_stable(unstable.time);
            return;
        }
        self.stability.remark(system, unstable, before, &softest, other);
        if unstable_now && self.crossing.is_none() {
            self.crossing = Some(Box::new([state.clone(), next.clone()]));
        }
    }

    /// The softest motion about `state`.
    fn softest_of(&mut self, system: &System, state: &State) -> Option<Softest> {
        self.linearize(system, state).ok()?;
        stability::softest(system, &mut self.kkt, state)
    }

    /// The cost of `softest`, a motion about `here`, at `there`, 1/s².
    fn cost_elsewhere(&mut self, system: &System, softest: &Softest, here: &State, there: &State) -> Option<f64> {
        self.linearize(system, there).ok()?;
        let (mut own, mut other) = (FrameCache::default(), FrameCache::default());
        let shape = system.motion_about(&softest.shape, &own.of(system, here), &other.of(system, there));
        Some(self.kkt.blocks.form(&shape, &shape))
    }

    /// The equilibria before and after the path has become unstable for the first time; none: it has not.
    pub fn crossing(&self) -> Option<&[State; 2]> {
        self.crossing.as_deref()
    }

    /// The time at which a path through two equilibria becomes unstable, s, before, between or after them, by the
    /// softest motion of the second one; none where that is not found.
    pub fn critical_time_by(&mut self, system: &System, [first, second]: [&State; 2]) -> Option<f64> {
        let softest = self.softest_of(system, second)?;
        let before = self.cost_elsewhere(system, &softest, second, first)?;
        let lost = before - softest.eigenvalue;
        let share = if lost > 0.0 { before / lost } else { f64::NAN };
        share.is_finite().then_some(first.time + (second.time - first.time) * share)
    }

    /// Settles `state`, whose shape is taken from another mesh, as [`Self::settle`] does, and watches the stability of
    /// the path from `before`, the equilibrium before it; none: it is the first one.
    ///
    /// # Errors
    /// As of [`Self::settle`].
    pub fn settle_after(&mut self, system: &System, before: Option<&State>, state: &mut State) -> Result<(), Error> {
        let known = self.stability.known();
        self.settle(system, state)?;
        let Some(before) = before else {
            if self.is_unstable(system, state) {
                self.remark_start(system, state);
            }
            return Ok(());
        };
        let known = known.filter(|known| known.time == before.time).or_else(|| {
            self.judge(system, before);
            self.stability.known()
        });
        if let Some(known) = known {
            self.watch_stability(system, before, state, known);
        }
        Ok(())
    }
}
