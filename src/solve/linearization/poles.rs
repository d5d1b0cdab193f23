//! Poles: the eigenvalues of `A`, and how the motion of each goes on.

use super::base::Base;
use super::independent::Selection;
use crate::math::blocks::Blocks;
use crate::math::elementary::{atan2, hypot, sin_cos};
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::linear::Singular;
use crate::solve::linear::dense::{Complex, Dense};
use crate::solve::modes::subspace::dot;
use crate::solve::modes::{ROUND_OFF, linearize};
use crate::solve::newton::kkt::Kkt;

/// Largest number of states whose poles are found: the time grows with its third power, and 900 take seconds.
pub const MOST_STATES: usize = 1500;
/// Round-off of a pole, over the largest one.
const NOISE: f64 = 1e-15;
/// Round-off of a real part, over the pole.
const LEAST_RATIO: f64 = 1e-9;
/// Rounding of a double pole at 0 over the share of the stiffness that is round-off: a double root has its square root.
const MARGIN: f64 = 1e3;

/// How the motion of a pole goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoleKind {
    /// Nothing holds the motion: the pole is 0 to round-off.
    Rigid,
    /// It vibrates, and fades or stays.
    Oscillating,
    /// It fades without a vibration.
    Overdamped,
    /// It grows.
    Unstable,
}

/// A pole.
#[derive(Clone, Debug, PartialEq)]
pub struct Pole {
    /// Real and imaginary part, rad/s.
    pub value: [f64; 2],
    /// How its motion goes on.
    pub kind: PoleKind,
    /// The motion of all coordinates when it is largest, with the pole's vector.
    pub shape: Vec<f64>,
    /// Real and imaginary part of that vector.
    pub parts: [Vec<f64>; 2],
}

impl Pole {
    /// `|λ|`, rad/s: of a motion with viscous damping the frequency without it.
    pub fn natural_frequency(&self) -> f64 {
        hypot(self.value[0], self.value[1])
    }

    /// `−Re λ/|λ|`; 0 of a rigid motion.
    pub fn damping_ratio(&self) -> f64 {
        let size = self.natural_frequency();
        if self.kind == PoleKind::Rigid || size == 0.0 { 0.0 } else { -self.value[0] / size }
    }
}

/// The poles of `a`, by rising `|λ|`: of a pair the one with the positive imaginary part. `selection` has the first
/// states.
///
/// # Errors
/// They do not converge.
pub fn poles(system: &System, base: &Base, selection: &Selection, a: &Dense) -> Result<Vec<Pole>, Singular> {
    let found = a.eigenvectors()?;
    let kinds = Kinds::new(system, base, found.iter().map(|(value, _)| *value));
    let mut poles: Vec<Pole> = Vec::new();
    for (value, vector) in found.into_iter().filter(|(value, _)| value.im >= 0.0) {
        let (shape, parts) = shape(selection, &vector);
        poles.push(Pole { value: [value.re, value.im], kind: kinds.of(system, value, &shape), shape, parts });
    }
    poles.sort_by(|a, b| a.natural_frequency().total_cmp(&b.natural_frequency()));
    Ok(poles)
}

/// The motion of the coordinates when it is largest, by the vector of its pole; and real and imaginary part of that
/// vector in all coordinates.
pub(super) fn shape(selection: &Selection, vector: &[Complex]) -> (Vec<f64>, [Vec<f64>; 2]) {
    let free = selection.chosen.len();
    let parts: [Vec<f64>; 2] =
        [|own: &Complex| own.re, |own: &Complex| own.im].map(|part| vector[..free].iter().map(part).collect());
    let [real, imaginary] = parts.each_ref().map(|part| dot(part, part));
    let product = dot(&parts[0], &parts[1]);
    // The phase at which Re(v exp(i φ)) is longest.
    let (sin, cos) = sin_cos(0.5 * atan2(-2.0 * product, real - imaginary));
    let parts = parts.map(|part| selection.shapes.times(&part));
    let shape = parts[0].iter().zip(&parts[1]).map(|(real, imaginary)| cos * real - sin * imaginary).collect();
    (shape, parts)
}

/// Tells how motions go on, by the poles of a system and their shapes.
pub(super) struct Kinds {
    stillness: Stillness,
    noise: f64,
}

impl Kinds {
    /// Prepares for the system about `base`, with all its poles.
    pub fn new(system: &System, base: &Base, poles: impl Iterator<Item = Complex>) -> Self {
        let largest = poles.map(|value| value.norm()).fold(0.0, f64::max);
        Self { stillness: Stillness::new(system, base), noise: NOISE * largest }
    }

    /// The kind of the pole `value`.
    pub fn of(&self, system: &System, value: Complex, shape: &[f64]) -> PoleKind {
        self.of_noisy(system, value, shape, || self.noise)
    }

    /// The same with the round-off `noise` of this pole, where its real part is positive.
    pub fn of_noisy(&self, system: &System, value: Complex, shape: &[f64], noise: impl FnOnce() -> f64) -> PoleKind {
        let size = value.norm();
        if size <= self.noise || self.stillness.is_rigid(system, size, shape) {
            PoleKind::Rigid
        } else if value.re > LEAST_RATIO * size && value.re > noise() {
            PoleKind::Unstable
        } else if value.im != 0.0 {
            PoleKind::Oscillating
        } else {
            PoleKind::Overdamped
        }
    }
}

/// Tells motions that nothing holds by the stiffness of their shapes.
struct Stillness {
    stiffness: Blocks,
    frames: FrameCache,
    base: Base,
}

impl Stillness {
    fn new(system: &System, base: &Base) -> Self {
        let mut kkt = Kkt::for_equilibria(system);
        let stiffness = linearize(system, &base.state, &base.response.multipliers, &mut kkt).symmetric_part();
        let mut frames = FrameCache::default();
        frames.set(system, &base.state.q, &base.state.triads);
        Self { stiffness, frames, base: base.clone() }
    }

    /// Whether a motion of this shape, with a pole of this size, is one that nothing holds.
    fn is_rigid(&self, system: &System, size: f64, shape: &[f64]) -> bool {
        let mut momentum = vec![0.0; shape.len()];
        let state = &self.base.state;
        let mass = MassAt::new(&state.prescribed.drives, &self.frames).wet(&state.q, state.time);
        system.mass_times(mass, shape, &mut momentum);
        let mass = dot(shape, &momentum);
        mass > 0.0 && size * size <= MARGIN * ROUND_OFF * self.stiffness.magnitude(shape) / mass
    }
}
