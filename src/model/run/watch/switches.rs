//! Whether what a function of time is to engage and release ever does so.

use crate::error::decimal;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::input::switch::{Switch, SwitchGuide};
use crate::mechanics::system::System;
use crate::model::validate::notes::listed;

/// Instants of a run at which a switch is looked at, besides those at which it is known to change: a host may run
/// beyond the end of the file.
const INSTANTS: u32 = 1000;

/// What a run over `span`, s, has not shown of the switches: those that never engage, and those that never release. A
/// host's are its own business, and numbers are meant.
pub fn idle(system: &System, span: [f64; 2]) -> Vec<String> {
    let [begin, end] = span;
    if end <= begin {
        return Vec::new();
    }
    let mut idle: [Vec<&str>; 2] = [Vec::new(), Vec::new()];
    for switch in &system.switches {
        let SwitchGuide::Signal(signal) = &switch.guide else { continue };
        if let (false, Some(is_engaged)) = (matches!(signal, Signal::Constant(_)), throughout(switch, signal, span)) {
            idle[usize::from(is_engaged)].push(&switch.name);
        }
    }
    let [released, engaged] = idle;
    let (from, to) = (decimal(begin), decimal(end));
    let told = |names: &[&str], [one, many]: [&str; 2], below: &str| {
        let verb = if names.len() == 1 { one } else { many };
        let text = format!(
            "{} {verb} between t = {from} s and t = {to} s: `active` is {below} 0.5 all the time; correct the times in `active`, or run until it \
             switches (simulation.stop)",
            listed(names)
        );
        (!names.is_empty()).then_some(text)
    };
    let released = told(&released, ["never engages", "never engage"], "below");
    let engaged = told(&engaged, ["is never released", "are never released"], "at least");
    released.into_iter().chain(engaged).collect()
}

/// Whether a switch is engaged at all instants of `span`, s, or at none; none: it switches.
fn throughout(switch: &Switch, signal: &Signal, [begin, end]: [f64; 2]) -> Option<bool> {
    let even = (0..=INSTANTS).map(|k| begin + (end - begin) * f64::from(k) / f64::from(INSTANTS));
    let changes = signal.breaks().iter().copied().filter(|time| (begin..=end).contains(time));
    let is_engaged = switch.is_on(begin, 0.0);
    even.chain(changes).all(|time| switch.is_on(time, 0.0) == is_engaged).then_some(is_engaged)
}
