//! A rigid body in a fluid: buoyancy, drag and added mass at its center of mass, in its own axes.
//!
//! `F = s [−m_d g + m_d u̇ + D_a (u̇ − v̇) + |w| D_d w]` with the displaced mass `m_d`, the velocity `v` of its center,
//! that of the fluid `u`, `w = u − v`, and `D = A diag A^T` of added masses and of drag areas along its axes `A`. The
//! share `s` that is wet is that of a sphere of its volume.

use crate::math::elementary::cbrt;
use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::body::kinematics::{self, BODY};
use crate::mechanics::fluid::flow::Seen;
use crate::mechanics::fluid::medium::Side;
use crate::mechanics::geometry::pose::axis_place;
use std::f64::consts::PI;

/// Speed below all that matters, m/s.
const STILL: f64 = 1e-30;

/// How fluid acts on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WetBody {
    /// Its number.
    pub body: usize,
    /// Its first coordinate.
    pub start: usize,
    /// Displaced volume, m³.
    pub volume: f64,
    /// Mass of the displaced fluid, kg.
    pub displaced: f64,
    /// `ρ/2` times the drag areas, in the axes of its directors, kg/m.
    pub drag: Mat3,
    /// Added mass, in the same axes, kg.
    pub added: Mat3,
}

/// How a body moves where the forces are taken.
#[derive(Clone, Copy, Debug)]
pub struct Floating {
    /// Its center, m.
    pub position: Vec3,
    /// Its velocity, m/s.
    pub velocity: Vec3,
    /// Its acceleration, m/s²; at an instant 0, as the mass matrix has it.
    pub acceleration: Vec3,
    /// Its directors, as columns.
    pub directors: Mat3,
}

/// The fluid where a body is.
#[derive(Clone, Copy, Debug)]
pub struct Around {
    /// Its motion and its surface.
    pub seen: Seen,
    /// Gravity, m/s².
    pub gravity: Vec3,
    /// Share of the drag that acts, 0 to 1.
    pub share: f64,
    /// The side of the surface that the fluid fills.
    pub side: Side,
}

/// The force on a body with its derivatives.
#[derive(Clone, Copy, Debug)]
pub struct OnBody {
    /// Force at its center, N.
    pub force: Vec3,
    /// Its derivative with respect to the velocity, N s/m.
    pub by_velocity: Mat3,
    /// Added mass in global axes, kg.
    pub added: Mat3,
    /// Derivative with respect to the position at a given velocity, N/m.
    pub by_position: Mat3,
    /// Derivatives with respect to the directors, N.
    pub by_directors: [Mat3; 3],
}

impl Floating {
    /// Takes the coordinates `q` of the system, with the velocities and the accelerations of all of them.
    pub fn with(start: usize, q: &[f64], velocity: Option<&[f64]>, acceleration: Option<&[f64]>) -> Self {
        let of = |all: Option<&[f64]>| all.map_or_else(Vec3::zeros, |all| vec3(all, start));
        Self {
            position: vec3(q, start),
            velocity: of(velocity),
            acceleration: of(acceleration),
            directors: kinematics::pose(q, start).axes,
        }
    }
}

impl WetBody {
    /// The share of a body that is wet, `height` m above the surface, and its derivative with respect to it, 1/m.
    fn wet_share(&self, height: f64) -> [f64; 2] {
        let radius = cbrt(0.75 / PI * self.volume);
        if height >= radius {
            return [0.0; 2];
        }
        if height <= -radius {
            return [1.0, 0.0];
        }
        let x = height / radius;
        [0.25 * (1.0 - x) * (1.0 - x) * (2.0 + x), -0.75 * (1.0 - x * x) / radius]
    }

    /// The force of the fluid.
    pub fn force(&self, moving: &Floating, fluid: &Around) -> OnBody {
        let Floating { position, velocity, acceleration, directors } = *moving;
        let sign = fluid.side.sign();
        let [share, share_z] = self.wet_share(sign * (position.z - fluid.seen.height));
        let turned = |own: &Mat3| directors * own * directors.transpose();
        let (drag, added) = (turned(&self.drag), turned(&self.added));
        let relative = fluid.seen.flow.velocity - velocity;
        let speed = relative.norm() + STILL;
        let pushed = fluid.seen.flow.acceleration - acceleration;
        let own = (fluid.seen.flow.acceleration - fluid.gravity) * self.displaced;
        let whole = own + added * pushed + drag * relative * (speed * fluid.share);
        let by_speed = drag * relative * relative.transpose() / speed;
        let mut by_position = Mat3::zeros();
        by_position.set_column(2, &(whole * (sign * share_z)));
        let by_directors = [0, 1, 2].map(|k| {
            let of_drag = by_director(&self.drag, &directors, k, &relative) * (speed * fluid.share);
            (of_drag + by_director(&self.added, &directors, k, &pushed)) * share
        });
        OnBody {
            force: whole * share,
            by_velocity: (drag * speed + by_speed) * (-share * fluid.share),
            added: added * share,
            by_position,
            by_directors,
        }
    }
}

/// Derivative of `A own A^T vector` with respect to director `k`.
fn by_director(own: &Mat3, directors: &Mat3, k: usize, vector: &Vec3) -> Mat3 {
    let seen = own * directors.tr_mul(vector);
    let across: Vec3 = directors * own.column(k);
    Mat3::identity() * seen[k] + across * vector.transpose()
}

impl OnBody {
    /// Adds `factor` times the derivative of the force with respect to the coordinates, of which velocities change by
    /// `by[0]` and accelerations by `by[1]`, to the column-major `block`, 12×12.
    pub fn add_tangent(&self, by: [f64; 2], factor: f64, block: &mut [f64]) {
        let by_center = self.by_position + self.by_velocity * by[0] - self.added * by[1];
        add(block, 0, &(by_center * factor));
        for (director, own) in self.by_directors.iter().enumerate() {
            add(block, axis_place(director), &(own * factor));
        }
    }

    /// Adds `factor` times a matrix of the center to the column-major `block`, 12×12.
    pub fn add_of_center(own: &Mat3, factor: f64, block: &mut [f64]) {
        add(block, 0, &(own * factor));
    }
}

/// Adds a matrix to the first rows of a block.
fn add(block: &mut [f64], column: usize, own: &Mat3) {
    let (columns, _) = block.as_chunks_mut::<BODY>();
    for j in 0..3 {
        (0..3).for_each(|i| columns[column + j][i] += own[(i, j)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Derivatives agree with central differences, whose error is the square of their step.
    #[test]
    fn derivatives() {
        [Side::Below, Side::Above].into_iter().for_each(derivatives_on);
    }

    fn derivatives_on(side: Side) {
        let own = WetBody {
            body: 0,
            start: 0,
            volume: 2.0,
            displaced: 2050.0,
            drag: Mat3::new(300.0, 20.0, 0.0, 20.0, 500.0, 10.0, 0.0, 10.0, 900.0),
            added: Mat3::from_diagonal(&Vec3::new(800.0, 1000.0, 1500.0)),
        };
        let mut seen = Seen { height: 0.1, ..Seen::default() };
        seen.flow.velocity = Vec3::new(0.5, 0.2, -0.3);
        seen.flow.acceleration = Vec3::new(0.1, -0.4, 0.2);
        let fluid = Around { seen, gravity: Vec3::new(0.0, 0.0, -9.81), share: 0.7, side };
        let q: [f64; BODY] = [0.3, -0.2, 0.25, 0.8, 0.6, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 1.0];
        let (velocity, acceleration) = ([0.4, -0.1, 0.6], [0.2, 0.3, -0.1]);
        let by = [3.0, 5.0];
        let at = |q: &[f64; BODY], by_q: [f64; 3]| {
            let moved = |own: [f64; 3], by: f64| -> [f64; 3] { std::array::from_fn(|i| own[i] + by * by_q[i]) };
            let (v, a) = (moved(velocity, by[0]), moved(acceleration, by[1]));
            own.force(&Floating::with(0, q, Some(&v), Some(&a)), &fluid)
        };
        let mut block = [0.0; BODY * BODY];
        at(&q, [0.0; 3]).add_tangent(by, 1.0, &mut block);
        let step = 1e-6;
        for column in 0..BODY {
            let [plus, minus] = [step, -step].map(|change| {
                let (mut moved, mut by_q) = (q, [0.0; 3]);
                moved[column] += change;
                if column < 3 {
                    by_q[column] = change;
                }
                at(&moved, by_q).force
            });
            let expected = (plus - minus) / (2.0 * step);
            for row in 0..3 {
                let found = block[column * BODY + row];
                assert!((found - expected[row]).abs() < 1e-3, "{row} {column}: {found} {}", expected[row]);
            }
        }
    }
}
