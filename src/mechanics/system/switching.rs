//! What switches engage and release at an instant: joints, locks and drives, which hold where they stand then
//! (MECHANICS 7.10).

use super::frame_cache::FrameCache;
use super::{AT_BREAK, System};
use crate::mechanics::constraint::joint::{Held, Holding};
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::input::host_motion::Targets;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::input::switch::Switch;
use crate::mechanics::marker::Marker;
use crate::mechanics::state::State;

/// A lock: keeps a relative coordinate where it stands.
#[derive(Clone, Debug)]
pub struct Lock {
    /// The relative coordinate, by its number.
    pub coordinate: usize,
    /// What engages and releases it.
    pub switch: usize,
}

impl System {
    /// Whether each switch is to be engaged at `time`, s.
    pub fn holds_at<'a>(&'a self, time: f64, targets: &'a Targets) -> impl Iterator<Item = bool> + 'a {
        let is_on = move |number: usize| {
            // None where nobody asks a host: what its motion is does not depend on it.
            let target = targets.switches.get(number).copied().unwrap_or_default();
            self.switches[number].is_on(time, target)
        };
        let all = self.switches.iter().enumerate();
        all.map(move |(number, switch)| is_on(number) && switch.within.is_none_or(is_on))
    }

    /// The name of the first switch whose function of time has no value at `time`, s.
    pub fn undefined_switch(&self, time: f64) -> Option<&str> {
        let is_undefined = |switch: &&Switch| switch.signal().is_some_and(|signal| signal.at(time).is_nan());
        self.switches.iter().find(is_undefined).map(|switch| switch.name.as_str())
    }

    /// Whether a switch that is engaged in `state` is to be released at `next`, s, the end of a step from there.
    pub fn releases(&self, switch: usize, state: &State, next: f64) -> bool {
        let instant = next + AT_BREAK * (next - state.time);
        let stays = || self.holds_at(instant, &state.targets).nth(switch) == Some(true);
        state.prescribed.holds[switch].is_engaged && !stays()
    }

    /// Whether a switch of `state` is to change at `time`, s.
    pub fn switches_at(&self, state: &State, time: f64) -> bool {
        let Prescribed { holds, .. } = &state.prescribed;
        self.holds_at(time, &state.targets).zip(holds).any(|(is_engaged, hold)| is_engaged != hold.is_engaged)
    }

    /// Engages and releases what is to be so at `time`, s: what engages holds where it stands in `state`. Multipliers
    /// of what changes are 0 from then on. Returns whether anything engages.
    pub fn switch(&self, state: &mut State, time: f64) -> bool {
        let wanted: Vec<bool> = self.holds_at(time, &state.targets).collect();
        let changes = |state: &State, switch: usize| state.prescribed.holds[switch].is_engaged != wanted[switch];
        let mut frames = FrameCache::default();
        let mut engages = false;
        for (joint, rows) in self.joints_with_rows() {
            let Some(Holding { switch, held }) = joint.holding else { continue };
            if !changes(state, switch) {
                continue;
            }
            state.multipliers[rows.clone()].fill(0.0);
            if !wanted[switch] {
                continue;
            }
            engages = true;
            match held {
                Held::Coordinate(coordinate) => {
                    let from = joint.drive.map_or(0.0, |drive| state.prescribed.drives[drive].value);
                    state.prescribed.holds[switch].value = state.relative_values[coordinate] - from;
                }
                Held::Pose => {
                    let configuration = frames.of(self, state);
                    let [a, b] = [&joint.a, &joint.b].map(|side: &Marker| side.pose(&configuration));
                    let (place, axes) = a.relative(&b);
                    state.prescribed.holds[switch].pose = Pose { place, axes };
                }
            }
        }
        for (hold, is_engaged) in state.prescribed.holds.iter_mut().zip(wanted) {
            hold.is_engaged = is_engaged;
        }
        engages
    }

    /// Number of the constraint conditions that are released where switches are as in `prescribed`.
    pub fn released_constraints(&self, prescribed: &Prescribed) -> usize {
        let is_released = |holding: &Holding| prescribed.holds.get(holding.switch).is_some_and(|hold| !hold.is_engaged);
        let released = self.joints.iter().filter(|joint| joint.holding.as_ref().is_some_and(is_released));
        released.map(|joint| joint.rows()).sum()
    }
}
