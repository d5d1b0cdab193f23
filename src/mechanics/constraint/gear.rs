//! A gear: the coordinates of two joints are proportional, `x_a − ratio·x_b = 0`. 1 condition.
//!
//! Each coordinate lies between two markers, as every joint does, so that a gear is a pair of joints which share one condition: the first one sets it, the second one
//! adds to it.

use crate::mechanics::constraint::primitive::Primitive;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::relative_coordinate::Measure;

/// How a coordinate enters the condition of a gear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GearSide {
    /// The gear, by its number.
    pub gear: usize,
    /// The coordinate, by its number among the relative coordinates: it goes on over any number of turns.
    pub coordinate: usize,
    /// Its factor: 1 for the first side, `−ratio` for the second one.
    pub factor: f64,
    /// Whether it is the second side, whose part is added to the condition of the joint before it.
    pub is_second: bool,
}

impl GearSide {
    /// Its condition.
    pub fn primitives(measure: Measure) -> &'static [Primitive] {
        match measure {
            Measure::Angle(_) => &[Primitive::Measured(Measure::Angle(0))],
            _ => &[Primitive::Measured(Measure::Distance(0))],
        }
    }

    /// The value of its coordinate as an earlier instant had it, which tells full turns apart.
    pub fn previous(&self, c: &Configuration) -> f64 {
        c.relative_values[self.coordinate]
    }
}
