//! Loads, actuators, drives and frames that oscillate too fast for a fixed step.

use super::{Note, STEPS_PER_PERIOD, step_for};
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::entries::frame::Orientation;
use crate::model::file::entries::load::Target;
use crate::model::file::entries::simulation::{Analysis, Steps};
use crate::model::file::number::Number;

/// Samples of a function in a step, and in all.
const PER_STEP: f64 = 4.0;
const MOST: u32 = 100_000;
/// Samples of all functions of a model: half a second. Of each function there are a few hundred steps at least.
const MOST_OF_ALL: usize = 10_000_000;
const LEAST: usize = 1_000;
/// Golden ratio less 1: samples at even distances would see an oscillation of the same period as a constant.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// A change of direction smaller than this share of the range is a ripple.
const RIPPLE: f64 = 0.1;
/// So many rises and falls in a row are an oscillation; fewer may be a pulse.
const IN_A_ROW: usize = 4;

/// Names what oscillates within less than ten steps.
pub fn fast_signals(document: &Document) -> Vec<Note> {
    let Steps::Fixed(step) = document.simulation.steps else { return Vec::new() };
    if document.simulation.analysis != Analysis::Dynamic {
        return Vec::new();
    }
    let (length, stop) = (document.value(step), document.value(document.simulation.stop));
    let functions: Vec<(Number, Function)> = signals(document)
        .into_iter()
        .map(|number| (number, document.function(number)))
        .filter(|(_, function)| !function.is_constant() && function.readings().is_empty())
        .collect();
    let most = (MOST_OF_ALL / functions.len().max(1)).clamp(LEAST, MOST as usize) as u32;
    let note = |(number, function): (Number, Function)| {
        let period = shortest_period(&function, [length, stop], most)?;
        let text = format!(
            "oscillates with a period of {period:.2e} s, which is {:.1} steps of step = {length} s. An oscillation needs {STEPS_PER_PERIOD} steps or more: set step = \
             {:.1e} or less, or leave `step` out, and the solver chooses its steps",
            period / length,
            step_for(period)
        );
        Some(Note::of(document, number, &text))
    };
    functions.into_iter().filter_map(note).collect()
}

/// The numbers that may change in time and that no host gives, but for switches.
pub fn signals(document: &Document) -> Vec<Number> {
    let loads = document.loads.iter().filter(|load| !load.input).flat_map(|load| [load.force, load.moment].concat());
    let stations = document.loads.iter().filter_map(|load| match load.target {
        Target::Moving { station, .. } => Some(station),
        Target::At(_) | Target::On(_) => None,
    });
    let actuators = document.actuators.iter().filter(|own| !own.input).map(|own| own.effort);
    let drives = document.motions().filter(|(_, is_input)| !is_input).map(|(motion, _)| motion.number());
    let frames = document.frames.iter().filter(|frame| !frame.input).flat_map(|frame| {
        let turn = match &frame.orientation {
            Orientation::Rotation(numbers) => &numbers[..],
            Orientation::Quaternion(numbers) => numbers,
        };
        frame.position.iter().chain(turn).copied().collect::<Vec<_>>()
    });
    loads.chain(stations).chain(actuators).chain(drives).chain(frames).collect()
}

/// The shortest period below `STEPS_PER_PERIOD` steps of length `step` with which a function oscillates up to `stop`,
/// s, by `most` samples. Where pieces meet, steps end: a swing across such an instant is resolved.
fn shortest_period(function: &Function, [step, stop]: [f64; 2], most: u32) -> Option<f64> {
    let count = (PER_STEP * stop / step).ceil().min(f64::from(most)) as u32;
    let time = |k: u32| (f64::from(k) + 0.5 * (f64::from(k) * GOLDEN).fract()) * step / PER_STEP;
    let samples: Vec<(f64, f64)> =
        (0..count).map(|k| (time(k), function.value(time(k)))).filter(|(_, value)| value.is_finite()).collect();
    let (low, high) = samples
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (_, value)| (low.min(*value), high.max(*value)));
    let turns = turns(&samples, RIPPLE * (high - low));
    let breaks = function.breaks([0.0, stop]);
    let is_fast = |from: f64, to: f64| {
        let after = breaks.partition_point(|time| *time < from);
        to - from < 0.5 * STEPS_PER_PERIOD * step && breaks.get(after).is_none_or(|time| *time > to)
    };
    let fast = turns.windows(IN_A_ROW + 1).filter(|row| row.windows(2).all(|pair| is_fast(pair[0], pair[1])));
    let periods = fast.map(|row| 2.0 * (row[IN_A_ROW] - row[0]) / IN_A_ROW as f64);
    periods.min_by(f64::total_cmp)
}

/// When a sampled function turns back, s: at extremes that are followed by a change of more than `ripple`.
fn turns(samples: &[(f64, f64)], ripple: f64) -> Vec<f64> {
    let mut turns = Vec::new();
    let Some(first) = samples.first() else { return turns };
    // The extreme since the last turn, and the sign of the direction that led to it; 0: none has yet.
    let (mut extreme, mut direction) = (*first, 0.0);
    for (time, value) in samples {
        let change = value - extreme.1;
        if change * direction > 0.0 || (direction == 0.0 && change.abs() > ripple) {
            if direction == 0.0 {
                direction = change.signum();
            }
            extreme = (*time, *value);
        } else if change.abs() > ripple {
            turns.push(extreme.0);
            direction = -direction;
            extreme = (*time, *value);
        }
    }
    turns
}
