//! Linear systems as files: for numpy and python-control, for MATLAB and Octave, and as JSON.

use crate::arrays::{Array, npz};
use crate::mat::{self, Value};
use ancf14::model::linear::{Linear, Matrix, Pole, PoleKind, Signal};
use serde_json::json;
use zip::result::ZipResult;

/// A linear system with what its files say of it.
#[derive(Clone, Copy, Debug)]
pub struct System<'a> {
    /// The matrices.
    pub linear: &'a Linear,
    /// The poles, as far as they are known.
    pub poles: &'a [Pole],
    /// The name of the model.
    pub model: &'a str,
    /// The version of the program.
    pub version: &'a str,
    /// The time for which inputs are held, s; none: the system is one of continuous time.
    pub step: Option<f64>,
}

/// How the motion of a pole goes on, in a word.
pub fn word(kind: PoleKind) -> &'static str {
    match kind {
        PoleKind::Rigid => "rigid",
        PoleKind::Oscillating => "oscillating",
        PoleKind::Overdamped => "overdamped",
        PoleKind::Unstable => "unstable",
    }
}

fn names(signals: &[Signal]) -> Vec<&str> {
    signals.iter().map(|signal| signal.name.as_str()).collect()
}

fn units(signals: &[Signal]) -> Vec<&str> {
    signals.iter().map(|signal| signal.unit.as_str()).collect()
}

fn values(signals: &[Signal]) -> Vec<f64> {
    signals.iter().map(|signal| signal.value).collect()
}

/// Real and imaginary parts of all poles, those of a pair one after the other.
fn pole_parts(poles: &[Pole]) -> [Vec<f64>; 2] {
    let mut parts = [Vec::new(), Vec::new()];
    for Pole { value: [real, imaginary], .. } in poles {
        for sign in if *imaginary == 0.0 { &[1.0][..] } else { &[1.0, -1.0] } {
            parts[0].push(*real);
            parts[1].push(sign * imaginary);
        }
    }
    parts
}

impl System<'_> {
    /// The bytes of an archive for `numpy.load`.
    ///
    /// # Errors
    /// The archive does not take an entry.
    pub fn npz(&self) -> ZipResult<Vec<u8>> {
        let Linear { states, inputs, outputs, a, b, c, d, time, .. } = self.linear;
        let [u0, y0] = [inputs, outputs].map(|signals| values(signals));
        let [real, imaginary] = pole_parts(self.poles);
        let time = [*time];
        let mut arrays: Vec<(&str, Array<'_>)> = [("A", a), ("B", b), ("C", c), ("D", d)]
            .map(|(name, own)| (name, Array::Matrix(&own.values, own.rows)))
            .into();
        arrays.extend([
            ("u0", Array::Reals(&u0)),
            ("y0", Array::Reals(&y0)),
            ("time", Array::Reals(&time)),
            ("poles_real", Array::Reals(&real)),
            ("poles_imag", Array::Reals(&imaginary)),
            ("states", Array::Words(names(states))),
            ("inputs", Array::Words(names(inputs))),
            ("outputs", Array::Words(names(outputs))),
            ("state_units", Array::Words(units(states))),
            ("input_units", Array::Words(units(inputs))),
            ("output_units", Array::Words(units(outputs))),
            ("model", Array::Words(vec![self.model])),
            ("version", Array::Words(vec![self.version])),
        ]);
        let step = self.step.map(|step| [step]);
        arrays.extend(step.as_ref().map(|step| ("dt", Array::Reals(step))));
        npz(&arrays)
    }

    /// The bytes of a file for MATLAB and Octave: the structure `sys`.
    pub fn mat(&self) -> Vec<u8> {
        let Linear { states, inputs, outputs, a, b, c, d, time, .. } = self.linear;
        let [u0, y0] = [inputs, outputs].map(|signals| values(signals));
        let [real, imaginary] = pole_parts(self.poles);
        let time = [*time];
        let column = |values| Value::Matrix(values, [values.len(), 1]);
        let mut fields: Vec<(&str, Value<'_>)> = [("A", a), ("B", b), ("C", c), ("D", d)]
            .map(|(name, own)| (name, Value::Matrix(&own.values, [own.rows, own.columns])))
            .into();
        fields.extend([
            ("u0", column(&u0)),
            ("y0", column(&y0)),
            ("time", column(&time)),
            ("poles_real", column(&real)),
            ("poles_imag", column(&imaginary)),
            ("states", Value::Texts(names(states))),
            ("inputs", Value::Texts(names(inputs))),
            ("outputs", Value::Texts(names(outputs))),
            ("state_units", Value::Texts(units(states))),
            ("input_units", Value::Texts(units(inputs))),
            ("output_units", Value::Texts(units(outputs))),
            ("model", Value::Text(self.model)),
            ("version", Value::Text(self.version)),
        ]);
        let step = self.step.map(|step| [step]);
        fields.extend(step.as_ref().map(|step| ("dt", column(step))));
        mat::file(&[("sys", Value::Structure(fields))])
    }

    /// The text of a JSON document; matrices are lists of rows.
    pub fn json(&self) -> String {
        let Linear { states, inputs, outputs, a, b, c, d, time, .. } = self.linear;
        let rows = |matrix: &Matrix| -> Vec<Vec<f64>> {
            let row = |row: usize| (0..matrix.columns).map(|column| matrix.at(row, column)).collect();
            (0..matrix.rows).map(row).collect()
        };
        let [real, imaginary] = pole_parts(self.poles);
        let mut document = json!({
            "model": self.model, "version": self.version, "time": time,
            "A": rows(a), "B": rows(b), "C": rows(c), "D": rows(d),
            "u0": values(inputs), "y0": values(outputs),
            "poles_real": real, "poles_imag": imaginary,
            "states": names(states), "inputs": names(inputs), "outputs": names(outputs),
            "state_units": units(states), "input_units": units(inputs), "output_units": units(outputs),
        });
        if let Some(step) = self.step {
            document["dt"] = json!(step);
        }
        format!("{document}\n")
    }
}
