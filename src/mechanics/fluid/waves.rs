//! Waves by Airy's theory: sums of components that travel without seeing each other.
//!
//! A component has the elevation `A cos θ`, `θ = k (x cos β + y sin β) − ω t + φ`, with `ω² = g k tanh(k h)`, the
//! velocities `A ω C cos θ` along its direction and `A ω S sin θ` upwards, `C = cosh(k (z + h))/sinh(k h)` and
//! `S = sinh(k (z + h))/sinh(k h)` at `z` above still water, and the accelerations of these at a fixed point.

use super::flow::Flow;
use crate::math::Vec3;
use crate::math::elementary::{cos, exp, exp_m1, sin_cos, tanh};

/// The flow above still water, where the theory of small waves has no water.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stretching {
    /// The same formulas.
    None,
    /// The velocities of still water level.
    Vertical,
    /// The velocities of a column of still water that is stretched to the surface.
    #[default]
    Wheeler,
}

/// A component.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// Amplitude of the elevation, m.
    pub amplitude: f64,
    /// Angular frequency, rad/s.
    pub frequency: f64,
    /// Wave number, rad/m.
    pub number: f64,
    /// Direction in which it travels, x and y of a unit vector.
    pub direction: [f64; 2],
    /// Phase at the origin and the start of time, rad.
    pub phase: f64,
}

impl Component {
    /// `θ` at this point and time.
    fn angle(&self, x: f64, y: f64, time: f64) -> f64 {
        let [along_x, along_y] = self.direction;
        self.number * (x * along_x + y * along_y) - self.frequency * time + self.phase
    }
}

/// All waves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Waves {
    /// Their components.
    pub components: Vec<Component>,
    /// Above still water.
    pub stretching: Stretching,
}

impl Waves {
    /// The elevation above still water at a point and time, m.
    pub fn elevation(&self, x: f64, y: f64, time: f64) -> f64 {
        self.components.iter().fold(0.0, |sum, own| sum + own.amplitude * cos(own.angle(x, y, time)))
    }

    /// The motion at `z` above still water in water of `depth` m, where the elevation is `elevation` m.
    pub fn flow(&self, [x, y, z]: [f64; 3], time: f64, depth: Option<f64>, elevation: f64) -> Flow {
        let z = match (self.stretching, depth) {
            (Stretching::None, _) => z,
            (Stretching::Vertical, _) => z.min(0.0),
            (Stretching::Wheeler, None) => z - elevation,
            (Stretching::Wheeler, Some(depth)) => (z - elevation) * depth / (depth + elevation).max(f64::MIN_POSITIVE),
        };
        let mut flow = Flow::default();
        for own in &self.components {
            let (sin, cos) = sin_cos(own.angle(x, y, time));
            let [level, upward] = decay(own.number, z, depth);
            let speed = own.amplitude * own.frequency;
            let [along_x, along_y] = own.direction;
            let (u, a) = (speed * level * cos, speed * own.frequency * level * sin);
            flow.velocity += Vec3::new(u * along_x, u * along_y, speed * upward * sin);
            flow.acceleration += Vec3::new(a * along_x, a * along_y, -speed * own.frequency * upward * cos);
        }
        flow
    }
}

/// `cosh(k (z + h))/sinh(k h)` and `sinh(k (z + h))/sinh(k h)`; without a depth both are `exp(k z)`.
fn decay(number: f64, z: f64, depth: Option<f64>) -> [f64; 2] {
    let down = exp(number * z);
    let Some(depth) = depth else { return [down; 2] };
    // Without functions that overflow.
    let (up, whole) = (exp(-number * (z + 2.0 * depth)), -exp_m1(-2.0 * number * depth));
    [(down + up) / whole, (down - up) / whole]
}

/// Newton's steps at most: the first guess is within a few percent.
const MOST_STEPS: usize = 50;

/// The wave number of the angular frequency `frequency`, rad/s, in gravity `gravity`, m/s², and water of `depth` m:
/// `ω² = g k tanh(k h)`, rad/m.
pub fn wave_number(frequency: f64, gravity: f64, depth: Option<f64>) -> f64 {
    let deep = frequency * frequency / gravity;
    let Some(depth) = depth else { return deep };
    let wanted = deep * depth;
    let mut x = wanted.max(wanted.sqrt());
    for _ in 0..MOST_STEPS {
        let tanh = tanh(x);
        let change = (wanted - x * tanh) / (tanh + x * (1.0 - tanh * tanh));
        x += change;
        if change.abs() <= 1e-15 * x {
            break;
        }
    }
    x / depth
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Wave numbers of three waves to the last printed digit.
    #[test]
    fn dispersion() {
        for (period, depth, number) in
            [(10.0, 100.0, 0.040_268_631_148), (10.0, 20.0, 0.051_825_681_472), (6.0, 8.0, 0.138_936_005_011)]
        {
            assert!((wave_number(TAU / period, 9.81, Some(depth)) - number).abs() < 1e-12);
        }
        assert_eq!(wave_number(1.0, 9.81, None), 1.0 / 9.81);
    }

    /// Accelerations are the derivatives of the velocities at a fixed point, and the water is not squeezed: the
    /// divergence of the velocity is 0. Differences over 1e-5 are right to 1e-8.
    #[test]
    fn accelerations_and_continuity() {
        let (frequency, depth) = (TAU / 8.0, Some(30.0));
        let component = Component {
            amplitude: 1.5,
            frequency,
            number: wave_number(frequency, 9.81, depth),
            direction: [0.6, 0.8],
            phase: 0.3,
        };
        let waves = Waves { components: vec![component], stretching: Stretching::None };
        let at = |x: f64, y: f64, z: f64, t: f64| waves.flow([x, y, z], t, depth, 0.0);
        let (x, y, z, t, d) = (3.0, -2.0, -4.0, 1.7, 1e-5);
        let rate = (at(x, y, z, t + d).velocity - at(x, y, z, t - d).velocity) / (2.0 * d);
        assert!((rate - at(x, y, z, t).acceleration).norm() < 1e-8);
        let divergence = at(x + d, y, z, t).velocity.x - at(x - d, y, z, t).velocity.x + at(x, y + d, z, t).velocity.y
            - at(x, y - d, z, t).velocity.y
            + at(x, y, z + d, t).velocity.z
            - at(x, y, z - d, t).velocity.z;
        assert!((divergence / (2.0 * d)).abs() < 1e-8);
        // The bottom lets no water through, and the surface moves with it.
        assert!(at(x, y, -30.0, t).velocity.z.abs() < 1e-12);
        let rise = (waves.elevation(x, y, t + d) - waves.elevation(x, y, t - d)) / (2.0 * d);
        assert!((rise - at(x, y, 0.0, t).velocity.z).abs() < 1e-8);
    }
}
