//! What engages and releases joints, locks and drives, as switches of the system.

use super::{Builder, signal_with};
use crate::math::bounds::Bounds;
use crate::math::jet::Jet;
use crate::math::switches::Bounded;
use crate::mechanics::constraint::driven::Driven;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::input::switch::{ENGAGED, Switch, SwitchGuide};
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::entries::joint::Coordinate;
use crate::model::file::entries::lock::LockSpec;
use crate::model::file::entries::switch::SwitchSpec;
use crate::model::file::number::Number;

/// Instants at which it is asked whether a switch is engaged, where the bounds of its function do not tell: shorter
/// pulses may be missed.
const INSTANTS: u32 = 10_000;
/// Changes of a switch at most.
const MOST: usize = 100_000;

impl Builder<'_> {
    /// Adds a switch of what `title` names, within another one where the joint has one; returns its number.
    pub(super) fn add_switch(&mut self, title: String, written: SwitchSpec, within: Option<usize>) -> usize {
        let (guide, target) = match written.input {
            true => (SwitchGuide::Host, self.document.value(written.active)),
            false => (SwitchGuide::Signal(active(self.document, written.active)), 0.0),
        };
        self.system.add_switch(Switch { name: title, guide, within }, target)
    }

    pub(super) fn add_lock(&mut self, written: &LockSpec) {
        let sides = self.sides(&self.document.joints[written.joint]);
        let within = self.joint_switch(written.joint);
        let switch = self.add_switch(format!("lock {}", written.name), written.switch, within);
        let driven = match written.coordinate {
            Coordinate::Angle => Driven::Angle,
            Coordinate::Distance => Driven::Distance,
        };
        let lock = self.system.add_lock(&written.name, sides, driven, switch);
        self.system.add_lock_of(written.joint, lock);
    }
}

/// The function of time that engages: steps end where it does so or releases.
fn active(document: &Document, number: Number) -> Signal {
    let function = document.function(number);
    let flips = flips(&function, document.span());
    signal_with(document, number, flips)
}

/// The first instants after `begin` and up to `end`, s, at which a function engages or releases, ascending.
fn flips(function: &Function, [begin, end]: [f64; 2]) -> Vec<f64> {
    let is_engaged = |time: f64| function.value(time) >= ENGAGED;
    let even = (0..=INSTANTS).map(|k| begin + (end - begin) * f64::from(k) / f64::from(INSTANTS));
    let corners = function.breaks([begin, end]).into_iter().chain(switches(function, [begin, end]));
    let around = corners.flat_map(|time| [time.next_down(), time, time.next_up()]);
    let mut times: Vec<f64> = even.chain(around.filter(|time| (begin..=end).contains(time))).collect();
    times.sort_by(f64::total_cmp);
    let changes = times.windows(2).filter(|pair| is_engaged(pair[0]) != is_engaged(pair[1]));
    changes.map(|pair| first_of(&is_engaged, pair[0], pair[1])).collect()
}

/// Where a function, or whether it engages, switches, ascending: at most as many times as steps may end for.
fn switches(function: &Function, [begin, end]: [f64; 2]) -> Vec<f64> {
    let engaged = |interval| Bounds::at_most(Bounds::constant(ENGAGED), function.over(interval));
    let jet = |time: f64| Jet::constant(f64::from(u8::from(function.value(time) >= ENGAGED)));
    let truth = Bounded { jet: &jet, bounds: &engaged };
    let mut found = Vec::new();
    let mut at = begin;
    while let Some(next) = truth.first_switch([at, end]).filter(|_| found.len() < MOST) {
        found.push(next);
        at = next;
    }
    found
}

/// The first double after `before` at which `is_engaged` is what it is at `after`, where it changes once between them.
fn first_of(is_engaged: &impl Fn(f64) -> bool, mut before: f64, mut after: f64) -> f64 {
    let wanted = is_engaged(after);
    loop {
        let middle = before + 0.5 * (after - before);
        if middle <= before || middle >= after {
            return after;
        }
        *(if is_engaged(middle) == wanted { &mut after } else { &mut before }) = middle;
    }
}
