//! Derivatives of inputs by time, as a host sets them for one communication step.

use super::number::Number;

/// The derivatives that are set, each for the next step only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slopes {
    list: Vec<(Number, f64)>,
    /// The last step changed loads along their derivatives: the next one must see to them again.
    changed_loads: bool,
}

impl Slopes {
    /// Sets the derivative of an input, 1/s of its unit.
    pub fn set(&mut self, number: Number, slope: f64) {
        self.list.retain(|(own, _)| *own != number);
        self.list.push((number, slope));
    }

    /// The derivative of an input; 0 where none is set.
    pub fn of(&self, number: Number) -> f64 {
        self.list.iter().find(|(own, _)| *own == number).map_or(0.0, |(_, slope)| *slope)
    }

    /// Whether loads must be brought to what is set now: some have a derivative, or had one in the last step.
    pub fn change_loads(&self) -> bool {
        !self.list.is_empty() || self.changed_loads
    }

    /// The step is done: what was set is used up.
    pub fn end_step(&mut self) {
        self.changed_loads = !self.list.is_empty();
        self.list.clear();
    }
}
