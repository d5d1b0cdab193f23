//! Linear systems: names, matrices and poles in plain types, and their files.

use ancf14::model::linear::{Linear, Matrix, Pole, Signal};
use ancf14::model::reduced::{Method, Reduced, Size};
use ancf14::model::simulation::Simulation;
use ancf14_pack::small::{Reduction, Small, without_amplitude};
use ancf14_report::matrices::{System, word};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// Name, unit and value of a state, an input or an output.
type Named = (String, String, f64);
/// Kind, real and imaginary part of a pole; of a pair that with the positive imaginary part.
type FoundPole = (&'static str, f64, f64);

/// The linear system about a state.
#[pyclass(frozen)]
pub struct LinearSystem {
    linear: Linear,
    poles: Result<Vec<Pole>, String>,
    model: String,
    /// States, kept ones, bound and error; none: it is whole.
    reduction: Option<(usize, usize, Option<f64>, f64)>,
    /// The whole system that this one is a reduction of.
    whole: Option<Box<Linear>>,
}

impl LinearSystem {
    /// Of a simulation, with its poles.
    pub fn new(linear: Linear, poles: Result<Vec<Pole>, String>, model: String) -> Self {
        Self { linear, poles, model, reduction: None, whole: None }
    }

    /// The system as an FMU has it, and a warning if it cannot estimate its own error.
    ///
    /// # Errors
    /// It has too many states.
    pub fn small(&self, simulation: &Simulation) -> Result<(Small, Option<String>), String> {
        let reduction = self.reduction.map(|(whole, kept, bound, error)| Reduction { whole, kept, bound, error });
        let poles = self.poles.as_deref().unwrap_or_default();
        let mut linear = self.linear.clone();
        let measured = self.whole.as_ref().map_or(Ok(()), |whole| linear.measure_amplitude(whole, simulation));
        let small = Small::new(simulation, &linear, poles, reduction).map_err(|reason| reason.to_string())?;
        Ok((small, measured.err().map(|reason| without_amplitude(&reason))))
    }

    /// The same with fewer states.
    ///
    /// # Errors
    /// It is reduced already, or as [`Linear::reduce`].
    pub fn reduced(&self, simulation: &Simulation, size: Size, method: Method) -> Result<Self, String> {
        if self.reduction.is_some() {
            return Err("the system is reduced already; reduce the whole one".to_owned());
        }
        let found = self.linear.reduce(simulation, size, method).map_err(|failure| failure.message)?;
        let Reduced { linear, poles, whole, kept, bound, error } = found;
        let reduction = Some((whole, kept, bound, error));
        let whole = Some(Box::new(self.linear.clone()));
        Ok(Self { linear, poles: Ok(poles), model: self.model.clone(), reduction, whole })
    }
}

fn named(signals: &[Signal]) -> Vec<Named> {
    signals.iter().map(|signal| (signal.name.clone(), signal.unit.clone(), signal.value)).collect()
}

#[pymethods]
impl LinearSystem {
    /// States, inputs and outputs.
    fn signals(&self) -> [Vec<Named>; 3] {
        [&self.linear.states, &self.linear.inputs, &self.linear.outputs].map(|signals| named(signals))
    }

    /// The bytes of the matrices `A`, `B`, `C`, `D`, column after column.
    fn matrices<'py>(&self, py: Python<'py>) -> [Bound<'py, PyBytes>; 4] {
        let Linear { a, b, c, d, .. } = &self.linear;
        [a, b, c, d].map(|matrix: &Matrix| {
            let bytes: Vec<u8> = matrix.values.iter().flat_map(|value| value.to_le_bytes()).collect();
            PyBytes::new(py, &bytes)
        })
    }

    /// The poles.
    fn poles(&self) -> PyResult<Vec<FoundPole>> {
        let poles = self.poles.as_ref().map_err(|reason| PyRuntimeError::new_err(reason.clone()))?;
        Ok(poles.iter().map(|pole| (word(pole.kind), pole.value[0], pole.value[1])).collect())
    }

    /// States of the whole system, kept ones, bound and error; none: it is the whole one.
    fn reduction(&self) -> Option<(usize, usize, Option<f64>, f64)> {
        self.reduction
    }

    /// The time of the state, s.
    fn time(&self) -> f64 {
        self.linear.time
    }

    /// The warnings about the state.
    fn warnings(&self) -> Vec<String> {
        self.linear.warnings.clone()
    }

    /// The bytes of a file: `npz`, `mat`, `mo` or `json`.
    fn file<'py>(&self, py: Python<'py>, kind: &str) -> PyResult<Bound<'py, PyBytes>> {
        let poles = self.poles.as_deref().unwrap_or_default();
        let version = env!("CARGO_PKG_VERSION");
        let system = System { linear: &self.linear, poles, model: &self.model, version, step: None };
        let bytes = match kind {
            "npz" => system.npz().map_err(|reason| PyRuntimeError::new_err(reason.to_string()))?,
            "mat" => system.mat(),
            "mo" => system.modelica().into_bytes(),
            _ => system.json().into_bytes(),
        };
        Ok(PyBytes::new(py, &bytes))
    }
}
