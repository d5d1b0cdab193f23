//! What a host gives while the model runs: the values of the inputs, and their derivatives for one communication step.

use crate::fmi::variable::Causality;
use crate::model::file::document::Document;
use crate::model::file::number::Number;
use crate::model::file::range::Range;
use std::sync::Arc;

/// Values and derivatives of the inputs, as set last.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inputs {
    /// Which numbers of the file they are, ascending.
    numbers: Arc<[Number]>,
    /// Their allowed values.
    ranges: Arc<[Range]>,
    /// Their values.
    values: Vec<f64>,
    /// Their derivatives by time for the next step, 1/s of their units; 0 where none is set.
    slopes: Vec<f64>,
}

impl Inputs {
    /// The inputs of a file at their start values.
    pub fn new(document: &Document) -> Self {
        let inputs = document.parameters().iter().filter(|row| row.variable.causality == Causality::Input);
        let mut list: Vec<(Number, f64)> = inputs.map(|row| (row.number, row.variable.start.number())).collect();
        list.sort_by_key(|(number, _)| *number);
        let (numbers, values): (Vec<Number>, Vec<f64>) = list.into_iter().unzip();
        let ranges = numbers.iter().map(|number| document.range(*number)).collect();
        let slopes = vec![0.0; values.len()];
        Self { numbers: numbers.into(), ranges, values, slopes }
    }

    /// The place of an input in this list; none: the number is no input.
    pub fn place(&self, number: Number) -> Option<usize> {
        self.numbers.binary_search(&number).ok()
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.numbers.len()
    }

    /// The number of the file that is at `place`.
    pub fn number(&self, place: usize) -> Number {
        self.numbers[place]
    }

    /// Numbers and values.
    pub fn iter(&self) -> impl Iterator<Item = (Number, f64)> + '_ {
        self.numbers.iter().copied().zip(self.values.iter().copied())
    }

    /// The value at `place`.
    pub fn value(&self, place: usize) -> f64 {
        self.values[place]
    }

    /// Sets the value at `place`; false where it is not allowed.
    pub fn set(&mut self, place: usize, value: f64) -> bool {
        let allowed = value.is_finite() && self.ranges[place].contains(value);
        if allowed {
            self.values[place] = value;
        }
        allowed
    }

    /// Sets the derivative at `place`, for the next step only.
    pub fn set_slope(&mut self, place: usize, slope: f64) {
        self.slopes[place] = slope;
    }

    /// All values, all derivatives.
    pub fn parts(&self) -> [&[f64]; 2] {
        [&self.values, &self.slopes]
    }

    /// Sets all values and derivatives; false where there are not as many as inputs.
    pub fn set_parts(&mut self, parts: [&[f64]; 2]) -> bool {
        let fits = parts.iter().all(|part| part.len() == self.numbers.len());
        if fits {
            let [values, slopes] = parts;
            self.values.copy_from_slice(values);
            self.slopes.copy_from_slice(slopes);
        }
        fits
    }

    /// Value and derivative of a number: an input of the file.
    pub fn line(&self, number: Number) -> (f64, f64) {
        self.place(number).map_or((f64::NAN, 0.0), |place| (self.values[place], self.slopes[place]))
    }

    /// The step is done: its derivatives are used up.
    pub fn end_step(&mut self) {
        self.slopes.fill(0.0);
    }

    /// Takes the values of another one, keeping the own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.numbers = Arc::clone(&other.numbers);
        self.ranges = Arc::clone(&other.ranges);
        self.values.clone_from(&other.values);
        self.slopes.clone_from(&other.slopes);
    }
}
