//! Vibrations by the speed of a rotation, in plain types.

use ancf14::model::campbell::{Campbell, Point};
use ancf14_report::campbell::{csv, excitation, frame, svg, word};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::f64::consts::TAU;

/// Speed, mode, direction, and what excites it.
type FoundCritical = (f64, usize, &'static str, &'static str);

/// The vibrations by the speed.
#[pyclass(frozen)]
pub struct FoundCampbell {
    found: Campbell,
    model: String,
}

impl FoundCampbell {
    /// The vibrations of the model called `model`.
    pub fn new(found: Campbell, model: String) -> Self {
        Self { found, model }
    }

    /// Something of each mode at each speed, speed after speed.
    fn each<T>(&self, of: impl Fn(&Point) -> T) -> Vec<T> {
        let Campbell { speeds, modes, .. } = &self.found;
        (0..speeds.len()).flat_map(|row| modes.iter().map(move |points| &points[row])).map(of).collect()
    }
}

#[pymethods]
impl FoundCampbell {
    /// Speeds, frame and limit of stability.
    fn summary(&self) -> (Vec<f64>, &'static str, Option<f64>) {
        (self.found.speeds.clone(), frame(self.found.frame), self.found.stability_limit)
    }

    /// Frequencies, damping ratios and real parts.
    fn numbers(&self) -> [Vec<f64>; 3] {
        [self.each(|own| own.frequency() / TAU), self.each(Point::damping_ratio), self.each(|own| own.value[0])]
    }

    fn directions(&self) -> Vec<&'static str> {
        self.each(|own| word(own.whirl))
    }

    fn critical_speeds(&self) -> Vec<FoundCritical> {
        let all = self.found.critical.iter();
        all.map(|own| (own.speed, own.mode, word(own.whirl), excitation(&self.found, own))).collect()
    }

    /// The part that each mode moves most.
    fn moves(&self) -> Vec<String> {
        self.found.moves.clone()
    }

    /// Sentences about the modes.
    fn warnings(&self) -> Vec<String> {
        self.found.warnings.clone()
    }

    /// The text of a file: `csv` or `svg`.
    fn text(&self, kind: &str) -> PyResult<String> {
        match kind {
            "csv" => Ok(csv(&self.found)),
            _ => svg(&self.found, &self.model).map_err(|reason| PyRuntimeError::new_err(reason.to_string())),
        }
    }
}
