//! One row of the variable table: what XML, values, CLI listing, C header and documentation are made of.

use super::{Value, lifecycle::Standard};

/// A scalar variable of the FMU. Its value reference is its place in the model's table.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Structured name: `tip.displacement[1]`.
    pub name: String,
    /// Meaning, axes and sign, as a sentence.
    pub description: String,
    /// FMI causality.
    pub causality: Causality,
    /// FMI variability.
    pub variability: Variability,
    /// Start value (parameters, inputs); the type of the variable is the type of this value.
    pub start: Value,
    /// Smallest allowed value.
    pub min: Option<f64>,
    /// Largest allowed value.
    pub max: Option<f64>,
    /// What is measured (position, force, ...): type definition and unit.
    pub quantity: Quantity,
    /// Order of magnitude of its values; none: not known.
    pub nominal: Option<f64>,
    /// Unit that a host shows by default: `mm`, `deg`, `kN`, ...; none: the SI unit.
    pub display_unit: Option<String>,
    /// Where the initialization calculates it: the inputs and parameters that it is found from, or more, by value
    /// references, ascending; none: all of them.
    pub found_from: Option<Vec<usize>>,
    /// Model Exchange: the state whose derivative by time it is.
    pub derivative_of: Option<usize>,
    /// Model Exchange: the inputs and states that it depends on at one instant, by value references, ascending.
    pub follows_from: Vec<usize>,
}

impl Variable {
    /// Whether it is a continuous state, which a host may integrate.
    pub fn is_state(&self) -> bool {
        self.causality == Causality::Local && self.derivative_of.is_none()
    }

    /// FMI 2.0's name of its type.
    pub fn type_name(&self) -> &'static str {
        match self.start {
            Value::Real(_) => "Real",
            Value::Integer(_) => "Integer",
        }
    }

    /// The name of its type in a version of the standard.
    pub fn type_name_in(&self, standard: Standard) -> &'static str {
        type_word(standard, self.type_name())
    }
}

/// A type of FMI 2.0 as a version of the standard calls it.
pub(super) fn type_word(standard: Standard, word: &'static str) -> &'static str {
    match (standard, word) {
        (Standard::Fmi3, "Real") => "Float64",
        (Standard::Fmi3, "Integer") => "Int32",
        (_, other) => other,
    }
}

/// FMI causality, as far as used here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    /// A number of the model file.
    Parameter,
    /// A number of the model file that follows from other parameters.
    CalculatedParameter,
    /// Given by the host.
    Input,
    /// A result.
    Output,
    /// A continuous state, or its derivative by time.
    Local,
    /// The independent variable.
    Independent,
}

impl Causality {
    /// The word of the standard.
    pub fn word(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            Self::CalculatedParameter => "calculatedParameter",
            Self::Input => "input",
            Self::Output => "output",
            Self::Local => "local",
            Self::Independent => "independent",
        }
    }
}

/// FMI variability, as far as used here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variability {
    /// Set before initialization only.
    Fixed,
    /// May be changed between two steps.
    Tunable,
    /// Changes at communication points only (counts).
    Discrete,
    /// Changes with time.
    Continuous,
}

impl Variability {
    /// The word of the standard.
    pub fn word(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Tunable => "tunable",
            Self::Discrete => "discrete",
            Self::Continuous => "continuous",
        }
    }
}

/// A coherent SI unit as exponents, and the name of the type definition that carries it.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// Name of the type definition: `Position`, `Force`, ...; empty: a plain `Real` or `Integer`.
    pub name: &'static str,
    /// Unit label: `m`, `N.m`, `rad/s`; empty: dimensionless.
    pub unit: String,
    /// Exponents of kg, m, s, K, rad, where the label is a known SI unit.
    pub exponents: Option<Exponents>,
}

/// Exponents of the SI base units, as FMI's `BaseUnit` writes them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exponents {
    /// Kilogram.
    pub kg: i32,
    /// Meter.
    pub m: i32,
    /// Second.
    pub s: i32,
    /// Kelvin.
    pub kelvin: i32,
    /// Radian.
    pub rad: i32,
}
