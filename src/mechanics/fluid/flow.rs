//! The motion of the fluid at a point.

use crate::math::Vec3;
use serde::{Deserialize, Serialize};

/// The motion of the fluid at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Flow {
    /// Velocity, m/s.
    pub velocity: Vec3,
    /// Acceleration, m/s².
    pub acceleration: Vec3,
}

/// The fluid at a point, with its surface over or under it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seen {
    /// Its motion.
    pub flow: Flow,
    /// Height of the surface, of the state, m.
    pub height: f64,
}

impl Seen {
    /// The sum of what is seen at four points, with these weights.
    pub fn between(points: &[Self; 4], weights: &[f64; 4]) -> Self {
        let mut sum = Self::default();
        for (point, weight) in points.iter().zip(weights) {
            sum.flow.velocity += point.flow.velocity * *weight;
            sum.flow.acceleration += point.flow.acceleration * *weight;
            sum.height += point.height * weight;
        }
        sum
    }
}
