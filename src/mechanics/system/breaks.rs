//! The times at which functions of time change from one piece to the next: steps end there, and a motion must not jump
//! there.

use crate::error::decimal;
use crate::math::resolution::Sight;
use crate::mechanics::input::guide::Guide;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::system::System;

/// Jumps below this size are rounding of the pieces' numbers, rad or m per m of the mechanism's size (at least 1 m).
const ROUNDING: f64 = 1e-9;

/// How near to a break the end of a step counts as that break, in steps: a step of that length would turn the round-off
/// of positions into velocities.
pub const AT_BREAK: f64 = 1e-6;

/// Jumps below this share of what a function does over a step are round-off of its pieces.
const SMOOTH: f64 = 1e-9;

/// Changes below this share over [`AT_BREAK`] of a step are no jumps.
const NEARLY_SMOOTH: f64 = 1e-4;

/// Whether a signal, or one of its first `derivatives` derivatives, jumps at `time`, s, one of its breaks; compared
/// with its changes over `step` s.
fn jumps(signal: &Signal, time: f64, step: f64, derivatives: usize) -> bool {
    changes(signal, [time.next_down(), time], step, derivatives, SMOOTH)
}

/// Whether a signal, or one of its first `derivatives` derivatives, changes between two times, s, by more than `share`
/// of what it does over `step` s.
fn changes(signal: &Signal, times: [f64; 2], step: f64, derivatives: usize, share: f64) -> bool {
    if matches!(signal, Signal::Constant(_)) {
        return false;
    }
    let [before, after] =
        times.map(|time| signal.jet(time)).map(|jet| [jet.value, jet.first * step, jet.second * step * step]);
    let size = before.iter().chain(&after).map(|part| part.abs()).fold(0.0, f64::max);
    (0..=derivatives).any(|order| (after[order] - before[order]).abs() > share * size)
}

impl System {
    /// All functions of time: those of loads, actuators, drives, frames and switches.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        let loads = self.loads.iter().flat_map(|load| load.signals().chain(load.track_signals()));
        let actuators = self.actuators.iter().filter_map(|actuator| actuator.signal());
        let drives = self.drives.iter().filter_map(|drive| drive.signal());
        let frames = self.moving_frames.iter().flat_map(|frame| frame.signals());
        let heats = self.heats.iter().flat_map(|heat| heat.signals());
        let switches = self.switches.iter().filter_map(|switch| switch.signal());
        loads.chain(actuators).chain(drives).chain(frames).chain(heats).chain(switches)
    }

    /// Collects [`System::breaks`] from all functions of time.
    pub fn collect_breaks(&mut self) {
        let mut breaks: Vec<f64> = self.signals().flat_map(|signal| signal.breaks()).copied().collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        self.breaks = breaks;
    }

    /// The first break after `from` and before `to`, s, that is further than `margin` s from both.
    pub fn break_between(&self, from: f64, to: f64, margin: f64) -> Option<f64> {
        let first = self.breaks.partition_point(|time| *time <= from + margin);
        self.breaks.get(first).copied().filter(|time| *time < to - margin)
    }

    /// The break within [`AT_BREAK`] of a step of `step` s from `time`, s.
    fn break_at(&self, time: f64, step: f64) -> Option<f64> {
        let margin = AT_BREAK * step;
        let first = self.breaks.partition_point(|own| *own < time - margin);
        self.breaks.get(first).copied().filter(|own| *own <= time + margin)
    }

    /// The first time after `from` and before `to`, s, that is further than `margin` s from both, at which a function
    /// of time switches.
    pub fn switch_between(&self, from: f64, to: f64, margin: f64) -> Option<f64> {
        let (from, to) = (from + margin, to - margin);
        let earlier = |end: f64, signal: &Signal| signal.first_switch([from, end]).unwrap_or(end);
        let first = self.signals().fold(to, earlier);
        (first < to).then_some(first)
    }

    /// The end of a step from `from` on the way to `to`, s, that sees as much as `sight` of loads, efforts,
    /// temperatures and motions.
    pub fn seen_until(&self, from: f64, to: f64, sight: Sight) -> f64 {
        // What begins at an end of the step is not within it.
        let margin = AT_BREAK * (to - from);
        let inside = [from + margin, to - margin];
        let load = |end: f64, signal: &Signal| signal.seen_until([inside[0], end], sight);
        let motion = |end: f64, signal: &Signal| signal.motion_seen_until([inside[0], end], sight);
        let end = self.loads.iter().flat_map(|load| load.signals()).fold(inside[1], load);
        let end = self.loads.iter().flat_map(|load| load.track_signals()).fold(end, motion);
        let end = self.actuators.iter().filter_map(|actuator| actuator.signal()).fold(end, load);
        let end = self.heats.iter().flat_map(|heat| heat.signals()).fold(end, load);
        let end = self.moving_frames.iter().flat_map(|frame| frame.signals()).fold(end, motion);
        let end = self.drives.iter().fold(end, |end, drive| match &drive.guide {
            Guide::Rate(signal) => load(end, signal),
            Guide::Value(signal) => motion(end, signal),
            Guide::HostValue | Guide::HostRate => end,
        });
        if end < inside[1] { end } else { to }
    }

    /// The jump of a signal, or of one of its first `derivatives` derivatives, within [`AT_BREAK`] of a step of `step`
    /// s from `time`, s.
    fn jumps_near(&self, signal: &Signal, time: f64, step: f64, derivatives: usize) -> bool {
        if let Some(known) = self.break_at(time, step).filter(|known| signal.breaks_at(*known)) {
            return jumps(signal, known, step, derivatives);
        }
        let margin = AT_BREAK * step;
        let near = [time - margin, time + margin];
        changes(signal, near, step, derivatives, NEARLY_SMOOTH)
            && signal.first_switch(near).is_some_and(|own| jumps(signal, own, step, derivatives))
    }

    /// Whether a load or an effort jumps within [`AT_BREAK`] of a step of `step` s from `time`, or the motion of a
    /// drive or a frame, its velocity or its acceleration: what is known of the motion before does not hold behind it.
    /// Pieces that meet smoothly change nothing.
    pub fn is_sudden(&self, time: f64, step: f64) -> bool {
        let jumps = |signal: &Signal, derivatives: usize| self.jumps_near(signal, time, step, derivatives);
        self.loads.iter().flat_map(|load| load.signals().chain(load.track_signals())).any(|signal| jumps(signal, 0))
            || self.actuators.iter().filter_map(|actuator| actuator.signal()).any(|signal| jumps(signal, 0))
            || self.drives.iter().filter_map(|drive| drive.signal()).any(|signal| jumps(signal, 2))
            || self.moving_frames.iter().flat_map(|frame| frame.signals()).any(|signal| jumps(signal, 2))
    }

    /// Whether the velocity of a drive or a frame jumps within [`AT_BREAK`] of a step of `step` s from `time`.
    pub fn is_struck(&self, time: f64, step: f64) -> bool {
        let jumps = |signal: &Signal, derivatives: usize| self.jumps_near(signal, time, step, derivatives);
        // Of a rate the velocity is the value itself.
        self.drives.iter().any(|drive| match &drive.guide {
            Guide::Rate(signal) => jumps(signal, 0),
            _ => drive.signal().is_some_and(|signal| jumps(signal, 1)),
        }) || self.moving_frames.iter().flat_map(|frame| frame.signals()).any(|signal| jumps(signal, 1))
    }

    /// The jumps of the prescribed motion after `from` up to `to`, s, each as a sentence. No finite force moves a
    /// mechanism at once.
    pub fn jumps(&self, from: f64, to: f64) -> Vec<String> {
        let least = ROUNDING * self.size.max(1.0);
        let mut found = Vec::new();
        let first = self.breaks.partition_point(|time| *time <= from);
        for time in self.breaks[first..].iter().copied().take_while(|time| *time <= to) {
            let mut tell = |part: String, jump: f64| {
                found.push(format!(
                    "{part} jumps by {} at t = {} s, which no finite force can do: velocities and efforts mean nothing from there on; \
                     let it move over several steps, or give its rate",
                    decimal(jump.abs()),
                    decimal(time)
                ));
            };
            for drive in &self.drives {
                if let Guide::Value(signal) = &drive.guide
                    && signal.breaks_at(time)
                    && signal.jump(time).abs() > least
                {
                    tell(format!("the value of {}", drive.label()), signal.jump(time));
                }
            }
            for frame in &self.moving_frames {
                let jumps = frame.signals().filter(|signal| signal.breaks_at(time));
                let largest = jumps.map(|signal| signal.jump(time).abs()).fold(0.0, f64::max);
                if largest > least {
                    tell(format!("the motion of frame {}", frame.name), largest);
                }
            }
        }
        found
    }
}
