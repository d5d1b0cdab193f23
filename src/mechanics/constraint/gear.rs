//! A gear: the coordinates of two joints are proportional, `x_a − ratio·x_b = 0`, or one follows the other like a cam,
//! `x_a − f(x_b) = 0`. 1 condition.
//!
//! Each coordinate lies between two markers, as every joint does, so that a gear is a pair of joints which share one
//! condition: the first one sets it, the second one adds to it.

use crate::math::jet::Jet;
use crate::mechanics::constraint::primitive::Primitive;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::relative_coordinate::Measure;
use std::fmt;
use std::sync::Arc;

/// The law of a cam: the coordinate of its follower as a function of its own, with two derivatives.
#[derive(Clone)]
pub struct CamLaw(pub Arc<dyn Fn(f64) -> Jet + Send + Sync>);

impl PartialEq for CamLaw {
    /// Whether it is the same function, not an equal one.
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for CamLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "f(x)")
    }
}

/// How a coordinate enters the condition of a gear.
#[derive(Clone, Debug, PartialEq)]
pub struct GearSide {
    /// The gear, by its number.
    pub gear: usize,
    /// The coordinate, by its number among the relative coordinates: it goes on over any number of turns.
    pub coordinate: usize,
    /// Its factor: 1 for the first side, `−ratio` for the second one, −1 with a law.
    pub factor: f64,
    /// The law that it enters by; none: itself.
    pub law: Option<CamLaw>,
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

    /// What it adds to the condition at the value `x` of its coordinate, with two derivatives.
    pub fn part(&self, x: f64) -> Jet {
        let Some(law) = &self.law else { return Jet { value: self.factor * x, first: self.factor, second: 0.0 } };
        let Jet { value, first, second } = (law.0)(x);
        Jet { value: self.factor * value, first: self.factor * first, second: self.factor * second }
    }

    /// The value of its coordinate as an earlier instant had it, which tells full turns apart.
    pub fn previous(&self, c: &Configuration) -> f64 {
        c.relative_values[self.coordinate]
    }
}
