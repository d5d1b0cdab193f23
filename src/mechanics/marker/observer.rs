//! What somebody sees who moves with a marker: places from its origin, directions along its axes, rates as measured
//! there.
//!
//! With the place `o` and the axes `a_i` of the marker, the place of a point `x` has the components `p_i = a_i·d`,
//! `d = x − o`. Velocity and acceleration are the derivatives of these numbers: `p_i' = a_i'·d + a_i·d'`,
//! `p_i'' = a_i''·d + 2 a_i'·d' + a_i·d''`. In vectors, with the angular velocity `ω` of the marker, `d' − ω × d` and
//! `d'' − ω' × d − ω × (ω × d) − 2 ω × (d' − ω × d)` along its axes.

use super::Marker;
use super::configuration::Configuration;
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::pose::{PLACE, Pose, PoseVector, angular_velocity, axis_vector};

/// Who looks at a sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Observer {
    /// What moves with it.
    marker: Marker,
    /// Position and axes as drawn.
    drawn: Pose,
}

impl Observer {
    /// On `marker`, in the configuration `c` as drawn.
    pub fn new(c: &Configuration, marker: Marker) -> Self {
        Self { marker, drawn: marker.pose(c) }
    }

    /// A pose as it is seen.
    pub fn see(&self, c: &Configuration, pose: &Pose) -> Pose {
        relative(&self.marker.pose(c), pose)
    }

    /// A pose as it was seen in the drawing.
    pub fn see_drawn(&self, pose: &Pose) -> Pose {
        relative(&self.drawn, pose)
    }

    /// A vector along the axes of the marker.
    pub fn turn(&self, c: &Configuration, vector: &Vec3) -> Vec3 {
        self.marker.pose(c).axes.tr_mul(vector)
    }

    /// Velocity (m/s) and angular velocity (rad/s), as seen, of what is at `place` and has them as `motion` in global
    /// axes.
    pub fn motion(&self, c: &Configuration, velocity: &[f64], place: &Vec3, motion: (Vec3, Vec3)) -> (Vec3, Vec3) {
        let (own, rate) = (self.marker.pose(c), pose(&self.marker.pose_rate(c, velocity)));
        let linear = rate.axes.tr_mul(&(place - own.place)) + own.axes.tr_mul(&(motion.0 - rate.place));
        (linear, own.axes.tr_mul(&(motion.1 - angular_velocity(&own, &rate))))
    }

    /// Acceleration as seen, m/s², of what has the position, the velocity and the acceleration `of` in global axes.
    pub fn acceleration(&self, c: &Configuration, velocity: &[f64], acceleration: &[f64], of: [Vec3; 3]) -> Vec3 {
        let (own, rate) = (self.marker.pose(c), pose(&self.marker.pose_rate(c, velocity)));
        let second = pose(&self.marker.pose_acceleration(c, velocity, acceleration));
        let [place, linear, acceleration] = of;
        second.axes.tr_mul(&(place - own.place))
            + rate.axes.tr_mul(&(linear - rate.place)) * 2.0
            + own.axes.tr_mul(&(acceleration - second.place))
    }
}

fn relative(own: &Pose, other: &Pose) -> Pose {
    let (place, axes) = own.relative(other);
    Pose { place, axes }
}

fn pose(vectors: &PoseVector) -> Pose {
    let axes: Mat3 = vectors.fixed_columns::<3>(axis_vector(0)).into_owned();
    Pose { place: vectors.column(PLACE).into_owned(), axes }
}
