//! Whether a static path jumps: Newton may land on another branch, beyond a limit point, where an increment of the
//! loads is larger than what is left until there. Both ends are stable then, and nothing else tells.
//!
//! A path that changes much faster than before is looked at in ever smaller parts of the increment, each time in the
//! half that changes more: what a smooth path changes by falls with the part, a jump stays as it is.

use super::Statics;
use crate::error::decimal;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// Times as fast as before at which a change is looked at.
const SUDDEN: f64 = 4.0;
/// A change below this size is no jump: lengths over the mechanism's size, slopes and angles in rad.
const NOTABLE: f64 = 0.02;
/// Halvings of the increment, and the share of its change that the last part keeps where there is a jump. A smooth path
/// keeps 1/256; close to a limit point the change goes with the root of the distance: 1/16.
const HALVINGS: u32 = 8;
const KEPT: f64 = 0.25;
/// A part of the way, as a share of it, beyond which Newton does not fail for its size any more.
const SMALLEST_PART: f64 = 1.0 / 256.0;

/// How fast the path was in its last increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pace {
    /// End of the increment, s.
    time: f64,
    /// Change of the coordinates a second: lengths over the mechanism's size, slopes and angles in rad.
    rate: f64,
}

impl Statics {
    /// Looks at the increment from `before` to `after` and remarks a jump.
    pub(super) fn watch_pace(&mut self, system: &System, before: &State, after: &State) {
        let change = distance(system, before, after);
        let rate = change / (after.time - before.time);
        let usual = self.pace.filter(|pace| pace.time == before.time).map_or(0.0, |pace| SUDDEN * pace.rate);
        self.pace = Some(Pace { time: after.time, rate });
        if change < NOTABLE || rate <= usual {
            return;
        }
        // States of their own: no count of the run changes.
        let Some([from, to]) = self.find_jump(system, before, after) else { return };
        let doubt = system.doubt_of_strain(&self.scratch.frames.of(system, before));
        let at = |share: f64| decimal(before.time + share * (after.time - before.time));
        self.stability.add_remark(format!(
            "the equilibrium jumps to another branch between t = {} s and {} s: the path passes a limit point, beyond which no equilibrium is near{doubt}; \
             in between it is unstable. Prescribe a displacement by a drive instead of the load to follow it",
            at(from),
            at(to)
        ));
    }

    /// The shares of the increment from `before` to `after` between which the path jumps, if it does.
    fn find_jump(&mut self, system: &System, before: &State, after: &State) -> Option<[f64; 2]> {
        let time = after.time;
        system.excite(time, &before.targets, &mut self.target);
        system.prescribe(before, time, &mut self.target_motion);
        self.begin.clone_from(before);
        let whole = distance(system, before, after);
        let (mut first, mut last) = ((0.0, before.clone()), (1.0, after.clone()));
        for _ in 0..HALVINGS {
            let share = 0.5 * (first.0 + last.0);
            let mut middle = first.1.clone();
            if !self.follow(system, &mut middle, (first.0, share), time) {
                return Some([first.0, last.0]);
            }
            if distance(system, &first.1, &middle) >= distance(system, &middle, &last.1) {
                last = (share, middle);
            } else {
                first = (share, middle);
            }
        }
        (distance(system, &first.1, &last.1) > KEPT * whole).then_some([first.0, last.0])
    }

    /// Takes `state` from one share of the increment that has begun to another, in smaller parts where Newton needs
    /// them; returns whether there is a way.
    fn follow(&mut self, system: &System, state: &mut State, (from, to): (f64, f64), time: f64) -> bool {
        let (mut share, mut part) = (from, to - from);
        while share < to {
            let next = f64::min(share + part, to);
            self.current.set_between(&self.begin.excitation, &self.target, next);
            if self.move_to(system, next, share, time).and_then(|()| self.solve(system, state, time)).is_ok() {
                share = next;
                continue;
            }
            part *= 0.5;
            if part < SMALLEST_PART * (to - from) {
                return false;
            }
        }
        true
    }
}

/// How far apart two equilibria are: lengths over the mechanism's size, slopes and angles in rad.
fn distance(system: &System, one: &State, other: &State) -> f64 {
    let change: Vec<f64> = one.q.iter().zip(&other.q).map(|(one, other)| other - one).collect();
    system.correction_size(&change).0
}
