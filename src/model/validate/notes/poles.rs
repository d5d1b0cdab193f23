//! Loads that grow without bound at an instant: steps pass over it, and what they miss is arbitrary.

use super::Note;
use crate::math::range::Range;
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::number::Number;

/// Instants at which a load is looked at whose bounds do not exclude a pole, and at which its size is taken before.
const SAMPLES: usize = 1000;
const FIRST_SAMPLES: usize = 10;
/// Where in its part of the time each of them is.
const OFF: f64 = 0.381_966;
/// A peak whose neighborhood is searched is so many times the mean size.
const PEAK: f64 = 5.0;
/// Halvings of the neighborhood of a peak, and those of its second half.
const HALVINGS: usize = 40;
const LAST_HALVINGS: usize = 20;
/// Growth over the second half of the search: a simple pole grows by 2^20, the inverse of a root by 2^10, which a step
/// may pass.
const UNBOUNDED: f64 = 1e4;

/// Names loads and actuators with a pole.
pub fn poles(document: &Document) -> Vec<Note> {
    let loads = document.loads.iter().filter(|load| !load.input);
    let loads = loads.flat_map(|load| load.force.into_iter().chain(load.moment));
    let efforts = document.actuators.iter().filter(|actuator| !actuator.input).map(|actuator| actuator.effort);
    let stop = document.value(document.simulation.stop);
    let note = |number: Number| {
        let time = pole(&document.function(number), stop)?;
        let text = format!(
            "grows without bound near t = {time:.4} s: the result depends on where the steps are. Limit it with min and max, or write it in pieces"
        );
        Some(Note::of(document, number, &text))
    };
    loads.chain(efforts).filter_map(note).collect()
}

/// When a function has a pole; none: it has none that 1000 samples show.
fn pole(function: &Function, stop: f64) -> Option<f64> {
    if function.is_constant() {
        return None;
    }
    // Off the ends of pieces and the zeros of denominators.
    let sizes = |count: usize| -> Vec<f64> {
        let time = |k: usize| (k as f64 + OFF) * (stop / count as f64);
        (0..count).map(|k| function.value(time(k)).abs()).collect()
    };
    let mean = |sizes: &[f64]| sizes.iter().sum::<f64>() / sizes.len() as f64;
    let bounds = function.over(Range { low: 0.0, high: stop }).value;
    let largest = f64::max(bounds.low.abs(), bounds.high.abs());
    if largest <= UNBOUNDED * mean(&sizes(FIRST_SAMPLES)) {
        return None;
    }
    let interval = stop / SAMPLES as f64;
    let time = |k: usize| (k as f64 + OFF) * interval;
    let sizes = sizes(SAMPLES);
    let mean = mean(&sizes);
    let mut peaks = (1..SAMPLES - 1).filter(|k| sizes[*k] >= sizes[k - 1] && sizes[*k] >= sizes[k + 1]);
    peaks.find_map(|k| {
        let (mut at, mut width) = (time(k), interval);
        if !sizes[k].is_finite() || sizes[k] < PEAK * mean {
            return None;
        }
        let size = |time: f64| function.value(time).abs();
        let mut before = sizes[k];
        for halving in 1..=HALVINGS {
            width *= 0.5;
            at = [at - width, at, at + width].into_iter().max_by(|a, b| size(*a).total_cmp(&size(*b)))?;
            if halving == HALVINGS - LAST_HALVINGS {
                before = size(at);
            }
        }
        (size(at) > UNBOUNDED * before).then_some(at)
    })
}
