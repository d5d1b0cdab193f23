//! Bode's diagram of a linear system: the magnitude of its responses in decibels, and their phase below, by the
//! frequency.

use crate::chart::{Chart, Layout, Line, Stroke};
use ancf14::model::linear::{Linear, Signal};
use ancf14::model::reduced::Responses;
use std::error::Error;
use std::f64::consts::{PI, TAU};

/// A magnitude below this share of the largest one of its response is not shown: its logarithm is without a bound.
const LEAST: f64 = 1e-12;

/// The diagram of `linear`, the system of `model`.
///
/// # Errors
/// It cannot be drawn.
pub fn svg(linear: &Linear, found: &Responses, model: &str) -> Result<String, Box<dyn Error>> {
    let names = |signals: &[Signal]| signals.iter().map(|own| own.name.clone()).collect::<Vec<_>>();
    let (inputs, outputs) = (names(&linear.inputs), names(&linear.outputs));
    let (mut magnitudes, mut phases) = (Vec::new(), Vec::new());
    for (column, input) in inputs.iter().enumerate() {
        for (row, output) in outputs.iter().enumerate() {
            let number = column * outputs.len() + row;
            let name = match (inputs.len(), outputs.len()) {
                (1, _) => output.clone(),
                (_, 1) => input.clone(),
                _ => format!("{output} / {input}"),
            };
            let line = |name: String, points| Line { name, stroke: Stroke::Solid, color: number, points };
            let [magnitude, phase] = curves(found, number);
            magnitudes.push(line(name, magnitude));
            phases.push(line(String::new(), phase));
        }
    }
    let title = match (&inputs[..], &outputs[..]) {
        ([input], [output]) => format!("{model}: {output} by {input}"),
        ([input], _) => format!("{model}: responses to {input}"),
        (_, [output]) => format!("{model}: {output} by each input"),
        _ => format!("{model}: responses"),
    };
    magnitudes.append(&mut phases);
    let axes = ["frequency (Hz)".to_owned(), "magnitude (dB)".to_owned()];
    Chart { title, axes, layout: Layout::Bode, lines: magnitudes }.svg()
}

/// Magnitude, dB, and phase, degrees and without jumps, of response `number`, by the logarithm of the frequency in Hz.
fn curves(found: &Responses, number: usize) -> [Vec<(f64, f64)>; 2] {
    let own = || found.values.iter().map(|values| values[number]);
    let size = |[real, imaginary]: [f64; 2]| real.hypot(imaginary);
    let largest = own().map(size).filter(|size| size.is_finite()).fold(0.0, f64::max);
    let (mut magnitude, mut phase) = (Vec::new(), Vec::new());
    let mut last: Option<f64> = None;
    for (omega, value) in found.frequencies.iter().zip(own()) {
        // Not-a-number, at the pole of an undamped vibration, is not shown either.
        if !(size(value) > LEAST * largest && size(value).is_finite()) {
            continue;
        }
        let at = (omega / TAU).log10();
        let angle = value[1].atan2(value[0]);
        // From frequency to frequency the phase goes on by less than half a turn.
        let angle = last.map_or(angle, |last| angle + TAU * ((last - angle) / TAU).round());
        last = Some(angle);
        magnitude.push((at, 20.0 * size(value).log10()));
        phase.push((at, angle * 180.0 / PI));
    }
    [magnitude, phase]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An oscillator falls by 40 dB in a decade behind its resonance, and its phase from 0 to -180 degrees, without a
    /// jump.
    #[test]
    fn curves_of_an_oscillator() {
        let frequencies: Vec<f64> = (0..401).map(|k| 10.0_f64.powf(-2.0 + 0.01 * f64::from(k))).collect();
        let response = |omega: &f64| {
            let (real, imaginary) = (1.0 - omega * omega, 0.02 * omega);
            let square = real * real + imaginary * imaginary;
            vec![[real / square, -imaginary / square]]
        };
        let values = frequencies.iter().map(response).collect();
        let [magnitude, phase] = curves(&Responses { frequencies, values }, 0);
        // (1 - w²)² at a hundredth and at a hundred: 1e-4 of the magnitude, 1e-3 dB.
        assert!(magnitude[0].1.abs() < 2e-3 && (magnitude[400].1 + 80.0).abs() < 2e-3);
        assert!((magnitude[200].1 - 20.0 * 50.0_f64.log10()).abs() < 1e-9);
        // 0.02 of a degree is the damping there.
        assert!(phase[0].1.abs() < 0.02 && (phase[400].1 + 180.0).abs() < 0.02);
        assert!(phase.windows(2).all(|pair| (pair[1].1 - pair[0].1).abs() < 120.0));
        assert_eq!(magnitude[200].0, -TAU.log10());
    }
}
