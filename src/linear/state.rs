//! Everything of a linear system that changes between two calls.

use serde::{Deserialize, Serialize};

/// State, inputs and results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// s.
    pub(super) time: f64,
    /// The state of the system.
    pub(super) z: Vec<f64>,
    /// The inputs as set last, and their rates for the next step.
    pub(super) values: Vec<f64>,
    pub(super) slopes: Vec<f64>,
    /// The results.
    pub(super) outputs: Vec<f64>,
    /// The inputs that the last step ended with, and their rates during it.
    pub(super) ends: Vec<f64>,
    pub(super) rates: Vec<f64>,
    /// The length of the last step, s; none: there is no such step.
    pub(super) length: Option<f64>,
}

impl State {
    /// A state at rest, with these inputs and results.
    pub(super) fn new(time: f64, order: usize, inputs: &[f64], outputs: &[f64]) -> Self {
        let slopes = vec![0.0; inputs.len()];
        Self {
            time,
            z: vec![0.0; order],
            values: inputs.to_vec(),
            slopes: slopes.clone(),
            outputs: outputs.to_vec(),
            ends: inputs.to_vec(),
            rates: slopes,
            length: None,
        }
    }

    /// Begins at `time`, s, with the inputs and states as set and these results.
    pub(super) fn begin(&mut self, time: f64, outputs: &[f64]) {
        self.time = time;
        self.outputs.copy_from_slice(outputs);
        self.ends.copy_from_slice(&self.values);
        self.rates.fill(0.0);
        self.length = None;
    }

    /// A step has ended at `time`, s, with the inputs `ends`: its rates are used up.
    pub(super) fn arrive(&mut self, time: f64, length: f64, ends: &[f64]) {
        self.time = time;
        self.length = Some(length);
        self.ends.copy_from_slice(ends);
        self.rates.copy_from_slice(&self.slopes);
        self.slopes.fill(0.0);
    }

    fn lists(&self) -> [&[f64]; 6] {
        [&self.z, &self.values, &self.slopes, &self.outputs, &self.ends, &self.rates]
    }

    /// Its bytes, behind `bytes`.
    pub fn write(&self, bytes: Vec<u8>) -> Vec<u8> {
        postcard::to_extend(self, bytes).expect("a Vec takes every byte, and all lengths are known")
    }

    /// The state of these bytes.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, String> {
        let (state, rest): (Self, _) =
            postcard::take_from_bytes(bytes).map_err(|reason| format!("the state cannot be read: {reason}"))?;
        match rest.len() {
            0 => Ok(state),
            more => Err(format!("{more} bytes are left behind the state")),
        }
    }

    /// Whether it is a state of the same system, with finite numbers.
    pub(super) fn has_the_shape_of(&self, other: &Self) -> bool {
        let is_finite = self.lists().iter().flat_map(|list| list.iter()).all(|value| value.is_finite());
        let lengths = |state: &Self| state.lists().map(<[f64]>::len);
        let times = self.time.is_finite() && self.length.is_none_or(|length| length > 0.0 && length.is_finite());
        lengths(self) == lengths(other) && is_finite && times
    }
}
