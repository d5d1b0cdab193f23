//! The variables of a simulation, as a program sees them.

use crate::fmi::variable::{self, Causality, Variability};

/// Which variable of a model: found once by its name, it reads and sets the variable without a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct VariableId(pub(super) usize);

impl VariableId {
    /// The place in the list of all variables, from 0: the value reference of the FMU.
    pub fn index(self) -> usize {
        self.0
    }
}

/// What a variable is, and so when it can be set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number of the model file; it can be set before the simulation is initialized.
    Parameter,
    /// A number of the model file that can be set between two steps too.
    Tunable,
    /// A number of the model file that follows from others; it cannot be set.
    Calculated,
    /// A number that the program gives; it can be set at any time, and acts from the next step on.
    Input,
    /// A result; it can be read once the simulation is initialized.
    Output,
}

/// A variable of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variable<'a> {
    /// For reading and setting it.
    pub id: VariableId,
    /// Its name, as in the results of `ancf14 run`: `tip.displacement[3]`.
    pub name: &'a str,
    /// Its SI unit: `m`, `N.m`, `rad/s`; empty: it has none.
    pub unit: &'a str,
    /// What it means, with axes and sign.
    pub description: &'a str,
    /// What it is.
    pub kind: Kind,
    /// The smallest and the largest value that it can be set to.
    pub bounds: [Option<f64>; 2],
}

impl<'a> Variable<'a> {
    pub(super) fn new(index: usize, row: &'a variable::Variable) -> Self {
        Self {
            id: VariableId(index),
            name: &row.name,
            unit: &row.quantity.unit,
            description: &row.description,
            kind: Kind::of(row),
            bounds: [row.min, row.max],
        }
    }
}

impl Kind {
    pub(super) fn of(row: &variable::Variable) -> Self {
        match (row.causality, row.variability) {
            (Causality::Parameter, Variability::Tunable) => Self::Tunable,
            (Causality::Parameter, _) => Self::Parameter,
            (Causality::CalculatedParameter, _) => Self::Calculated,
            (Causality::Input, _) => Self::Input,
            (Causality::Output | Causality::Local | Causality::Independent, _) => Self::Output,
        }
    }
}
