//! A linear system as a model for FMI: what the small FMU of a reduced mechanism runs.
//!
//! The state moves by the matrix exponential: a step has no error but round-off, whatever its length, while inputs are
//! constant or change linearly during it. Signals have the meaning of those of the mechanism: the values that they have
//! in the state that the system is about are added. It begins in that state.
//!
//! As of the mechanism itself, outputs are those of the end of the last step, with the inputs that this step ends with:
//! an input that is set at a communication point acts from the next step on. In Model Exchange a host integrates the
//! states, and outputs are those of the instant.

mod amplitude;
mod exchange;
pub mod file;
mod matrix;
mod state;
mod system;

pub use self::amplitude::{Amplitude, MOST_KINDS};
pub use self::file::{File, MOST_STATES, Signal};
pub use self::matrix::Matrix;
pub use self::state::State;
pub use self::system::System;

use self::amplitude::{NAME, WARNED};
use self::system::{Known, Stride, Unknown};
use crate::fmi::continuous::Continuous;
use crate::fmi::variable::Variable;
use crate::fmi::{About, Failure, LogCategory, Model, Value};

/// The shortest step, as a share of the default communication step, and of the time.
const STEP_ROUNDING: f64 = 1e-6;
const TIME_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A linear system that runs.
#[derive(Clone, Debug)]
pub struct Unit {
    about: About,
    variables: Vec<Variable>,
    /// Values of the inputs and of the outputs in the state that the system is about; the share of nonlinearity is the
    /// last output.
    inputs: Vec<f64>,
    outputs: Vec<f64>,
    system: System,
    amplitude: Option<Amplitude>,
    state: State,
    /// The state at the end of a step under way, and memory for it.
    next: Vec<f64>,
    ends: Vec<f64>,
    rest: Vec<f64>,
    changes: Vec<f64>,
    /// Derivatives of the states by time, as evaluated last.
    rates: Vec<f64>,
    /// They and the outputs are those of the inputs and states as set.
    settled: bool,
    /// Where the step ends that has begun but is not taken, s.
    end: Option<f64>,
    /// A warning that the motion is not small is given, or was: it is given once.
    warned: Warned,
}

/// Whether the warning of a motion that is not small is due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Warned {
    No,
    Now,
    Before,
}

impl Unit {
    /// Reads the text of a file, which messages call `name`.
    ///
    /// # Errors
    /// It is no such file.
    #[inline(never)]
    pub fn load(name: &str, text: &str) -> Result<Self, Failure> {
        Self::new(File::read(name, text)?)
    }

    /// The unit of a file that was read.
    ///
    /// # Errors
    /// Its numbers are too large.
    pub fn new(file: File) -> Result<Self, Failure> {
        let File { about, inputs, outputs, states, a, b, c, d, mut amplitude } = file;
        let system = System::new(a, b, c, d).ok_or_else(|| {
            wrong(String::from("the linear system has numbers that are too large; pack the FMU again"))
        })?;
        let variables = exchange::variables([&inputs, &outputs], amplitude.as_ref(), &states, &system);
        if let Some(amplitude) = &mut amplitude {
            amplitude.scale(|state| system.unit(state));
        }
        let values = |signals: &[Signal]| signals.iter().map(|signal| signal.value).collect::<Vec<f64>>();
        let (inputs, mut outputs) = (values(&inputs), values(&outputs));
        outputs.extend(amplitude.is_some().then_some(0.0));
        let state = State::new(about.start, system.order(), &inputs, &outputs);
        Ok(Self {
            next: vec![0.0; system.order()],
            rest: vec![0.0; system.order()],
            rates: vec![0.0; system.order()],
            settled: false,
            ends: vec![0.0; inputs.len()],
            changes: vec![0.0; inputs.len()],
            about,
            variables,
            inputs,
            outputs,
            system,
            amplitude,
            state,
            end: None,
            warned: Warned::No,
        })
    }

    /// The number of an input, of an output.
    fn input(&self, reference: usize) -> Option<usize> {
        (reference < self.inputs.len()).then_some(reference)
    }

    fn output(&self, reference: usize) -> Option<usize> {
        reference.checked_sub(self.inputs.len()).filter(|number| *number < self.outputs.len())
    }

    /// The number of a state, of the derivative of a state.
    fn state(&self, reference: usize) -> Option<usize> {
        let first = self.inputs.len() + self.outputs.len();
        reference.checked_sub(first).filter(|number| *number < self.system.order())
    }

    fn rate(&self, reference: usize) -> Option<usize> {
        self.state(reference.checked_sub(self.system.order())?)
    }

    fn output_named(&self, reference: usize) -> Result<usize, Failure> {
        self.output(reference).ok_or_else(|| wrong(format!("`{}` is no output", self.variables[reference].name)))
    }

    /// Takes a step to `end`, s. Not inlined: the functions of FMI have little stack.
    #[inline(never)]
    fn step(&mut self, end: f64) -> Result<(), Failure> {
        let length = end - self.state.time;
        if length < self.shortest_step() {
            self.state.slopes.fill(0.0);
            return Ok(());
        }
        let State { z, values, slopes, .. } = &self.state;
        difference(&mut self.changes, values, &self.inputs);
        let stride = Stride { state: z, inputs: &self.changes, rates: slopes, length };
        let taken = self.system.step(stride, [&mut self.next, &mut self.ends, &mut self.rest]);
        let is_finite = taken && self.system.are_finite(&self.next);
        for (end, (value, slope)) in self.ends.iter_mut().zip(values.iter().zip(slopes)) {
            *end = value + slope * length;
        }
        difference(&mut self.changes, &self.ends, &self.inputs);
        let (next, changes) = (&self.next, &self.changes);
        let too_large = self.too_large(next, changes);
        if let Some(name) = too_large.or((!is_finite).then_some("its state")) {
            let failure = wrong(format!(
                "{name} is too large for a number at t = {end} s: the motion of a linear system that is not stable \
                 grows without bound, or an input is far too large; end the run before, or set a reasonable value"
            ));
            self.state.slopes.fill(0.0);
            return Err(failure);
        }
        for (row, output) in self.state.outputs.iter_mut().enumerate() {
            *output = result((&self.system, self.amplitude.as_ref()), &self.outputs, row, &self.next, &self.changes);
        }
        std::mem::swap(&mut self.state.z, &mut self.next);
        self.state.arrive(end, length, &self.ends);
        self.settled = false;
        self.look();
        Ok(())
    }

    /// Warns once where the outputs are those of a motion that is not small.
    fn look(&mut self) {
        let share = self.amplitude.as_ref().and(self.state.outputs.last());
        if self.warned == Warned::No && share.is_some_and(|share| *share > WARNED) {
            self.warned = Warned::Now;
        }
    }

    /// How fast the output `row` changes as the state changes by `change`, and the inputs change by `inputs`.
    fn slope(&self, row: usize, change: &[f64], inputs: &[f64]) -> f64 {
        match &self.amplitude {
            Some(amplitude) if row + 1 == self.outputs.len() => amplitude.share_rate(&self.state.z, change),
            _ => self.system.output(row, change, inputs),
        }
    }

    /// An output of a state that is too large for a number.
    fn too_large(&self, state: &[f64], changes: &[f64]) -> Option<&str> {
        let result = |row: usize| result((&self.system, self.amplitude.as_ref()), &self.outputs, row, state, changes);
        let row = (0..self.outputs.len()).find(|row| !result(*row).is_finite())?;
        Some(&self.variables[self.inputs.len() + row].name)
    }
}

/// Output number `row`, about its value in `about`.
fn result(
    (system, amplitude): (&System, Option<&Amplitude>),
    about: &[f64],
    row: usize,
    state: &[f64],
    changes: &[f64],
) -> f64 {
    match amplitude {
        Some(amplitude) if row + 1 == about.len() => amplitude.share(state),
        _ => about[row] + system.output(row, state, changes),
    }
}

/// `target = a − b`.
fn difference(target: &mut [f64], a: &[f64], b: &[f64]) {
    target.iter_mut().zip(a.iter().zip(b)).for_each(|(target, (a, b))| *target = a - b);
}

impl Model for Unit {
    type Snapshot = State;

    fn about(&self) -> &About {
        &self.about
    }

    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn value(&self, reference: usize) -> Value {
        let state = |number: usize| self.state.z[number] * self.system.unit(number);
        let value = self.input(reference).map(|number| self.state.values[number]);
        let value = value.or_else(|| self.output(reference).map(|number| self.state.outputs[number]));
        let value = value.or_else(|| self.state(reference).map(state));
        Value::Real(value.unwrap_or_else(|| self.rate(reference).map_or(0.0, |number| self.rates[number])))
    }

    fn set_value(&mut self, reference: usize, value: Value) -> Result<(), Failure> {
        let name = &self.variables[reference].name;
        let Value::Real(value) = value else {
            return Err(wrong(format!("`{name}` is a Real, not an Integer")));
        };
        let (list, number, value) = match (self.input(reference), self.state(reference)) {
            (Some(number), _) => (&mut self.state.values, number, value),
            (None, Some(number)) => (&mut self.state.z, number, value / self.system.unit(number)),
            (None, None) => return Err(wrong(format!("`{name}` is a result and cannot be set"))),
        };
        if !value.is_finite() {
            return Err(wrong(format!("`{name}` would be too large for a number; set a reasonable value")));
        }
        list[number] = value;
        self.settled = false;
        Ok(())
    }

    fn set_tolerance(&mut self, _tolerance: f64) -> Option<f64> {
        None
    }

    fn set_input_derivative(&mut self, reference: usize, derivative: f64) {
        if let Some(number) = self.input(reference) {
            self.state.slopes[number] = derivative;
        }
    }

    fn check(&self) -> Result<(), Failure> {
        Ok(())
    }

    fn initialize(&mut self, start: f64) -> Result<(), Failure> {
        difference(&mut self.changes, &self.state.values, &self.inputs);
        if let Some(name) = self.too_large(&self.state.z, &self.changes) {
            return Err(wrong(format!(
                "{name} is too large for a number: an input or a state is far too large; set another value"
            )));
        }
        let (z, changes) = (&self.state.z, &self.changes);
        let result = |row: usize| result((&self.system, self.amplitude.as_ref()), &self.outputs, row, z, changes);
        let results: Vec<f64> = (0..self.outputs.len()).map(result).collect();
        self.state.begin(start, &results);
        (self.end, self.settled) = (None, false);
        self.look();
        Ok(())
    }

    fn time(&self) -> f64 {
        self.state.time
    }

    fn shortest_step(&self) -> f64 {
        f64::max(STEP_ROUNDING * self.about.output_step, TIME_ROUNDING * self.state.time.abs())
    }

    fn accept_step(&self, _end: f64) -> Result<(), Failure> {
        Ok(())
    }

    fn advance(&mut self, end: f64) -> Result<(), Failure> {
        self.end = None;
        self.step(end)
    }

    fn begin_step(&mut self, end: f64) -> Result<(), Failure> {
        self.end = Some(end);
        Ok(())
    }

    fn take_part(&mut self) -> Result<bool, Failure> {
        self.end.take().map_or(Ok(()), |end| self.step(end)).map(|()| true)
    }

    fn look_between(&mut self) -> Result<(), Failure> {
        Ok(())
    }

    fn end_step(&mut self) -> Result<(), Failure> {
        self.end = None;
        Ok(())
    }

    fn output_derivative(&mut self, reference: usize) -> Result<f64, Failure> {
        let row = self.output_named(reference)?;
        difference(&mut self.changes, &self.state.ends, &self.inputs);
        self.system.rate(&self.state.z, &self.changes, &mut self.rest);
        Ok(self.slope(row, &self.rest, &self.state.rates))
    }

    fn partial_derivative(&mut self, output: usize, input: usize) -> Result<f64, Failure> {
        let row = self.output_named(output)?;
        match (self.input(input), self.state.length) {
            (None, _) => Err(wrong(String::from("results have derivatives by inputs only"))),
            (_, None) => Ok(0.0),
            (Some(column), Some(length)) => {
                let change = self.system.sensitivity(column, length).ok_or_else(|| {
                    wrong(String::from("the last step is too long for a derivative; take shorter steps"))
                })?;
                let unit = |own: usize| if own == column { 1.0 } else { 0.0 };
                Ok(self.slope(row, &change, &(0..self.inputs.len()).map(unit).collect::<Vec<f64>>()))
            }
        }
    }

    fn initial_derivative(&mut self, unknown: usize, known: usize) -> Result<f64, Failure> {
        let of = self.output(unknown).map(Unknown::Output).or_else(|| self.rate(unknown).map(Unknown::Rate));
        let by = self.input(known).map(Known::Input).or_else(|| self.state(known).map(Known::State));
        match (of, by) {
            (Some(Unknown::Output(row)), Some(by)) if self.amplitude.is_some() && row + 1 == self.outputs.len() => {
                let mut change = vec![0.0; self.system.order()];
                if let Known::State(state) = by {
                    change[state] = 1.0 / self.system.unit(state);
                }
                Ok(self.slope(row, &change, &[]))
            }
            (Some(of), Some(by)) => Ok(self.system.slope(of, by)),
            _ => Err(wrong(String::from("outputs and rates of states have derivatives by inputs and states only"))),
        }
    }

    fn continuous(&mut self) -> Option<&mut dyn Continuous> {
        Some(self)
    }

    fn conclude(&mut self) {}

    fn take_warnings(&mut self) -> Vec<String> {
        if self.warned != Warned::Now {
            return Vec::new();
        }
        self.warned = Warned::Before;
        let share = self.state.outputs.last().map_or(0.0, |share| 100.0 * share);
        vec![format!(
            "the motion is not small any more: at t = {} s nonlinearity, which this linear system leaves out, has an \
             estimated share of {share:.1} % of the motion; compare it with the FMU of the mechanism. {NAME} has the \
             share at any time, and this warning appears once",
            self.state.time
        )]
    }

    fn reset(&mut self) {
        self.state = State::new(self.about.start, self.system.order(), &self.inputs, &self.outputs);
        (self.end, self.settled, self.warned) = (None, false, Warned::No);
        self.rates.fill(0.0);
    }

    fn snapshot(&self) -> State {
        self.state.clone()
    }

    fn restore(&mut self, snapshot: &State) {
        self.state.clone_from(snapshot);
        (self.end, self.settled) = (None, false);
    }

    fn write(&self, snapshot: &State, bytes: Vec<u8>) -> Vec<u8> {
        snapshot.write(bytes)
    }

    fn read(&self, bytes: &[u8]) -> Result<State, Failure> {
        let state = State::read(bytes).map_err(wrong)?;
        match state.has_the_shape_of(&self.state) {
            true => Ok(state),
            false => Err(wrong(String::from("the state belongs to a linear system of another shape"))),
        }
    }
}

fn wrong(message: String) -> Failure {
    Failure { message, category: LogCategory::StatusError, line: None }
}
