//! Quantities that two outputs measure at the same place: one variable with two names.

use crate::model::file::entries::output::{OutputSpec, Target};
use crate::model::file::quantity::Quantity;

/// The quantities so far, with their outputs and the rows that they begin at.
#[derive(Debug, Default)]
pub struct Measured<'a>(Vec<(&'a OutputSpec, Quantity, usize)>);

impl<'a> Measured<'a> {
    /// The row that a quantity of an output begins at for the first time: an earlier one, or `row`.
    pub fn first(&mut self, output: &'a OutputSpec, quantity: Quantity, row: usize) -> usize {
        let same = self.0.iter().find(|(other, known, _)| *known == quantity && see_the_same(other, output));
        if let Some((_, _, earlier)) = same {
            return *earlier;
        }
        self.0.push((output, quantity, row));
        row
    }
}

/// Whether two outputs look at the same, seen by the same.
fn see_the_same(a: &OutputSpec, b: &OutputSpec) -> bool {
    let observers = match (&a.observer, &b.observer) {
        (None, None) => true,
        (Some(a), Some(b)) => a.anchor.is_where(&b.anchor),
        _ => false,
    };
    let targets = match (&a.target, &b.target) {
        (Target::At(a), Target::At(b)) => a.is_where(b),
        (a, b) => a == b,
    };
    observers && targets
}
