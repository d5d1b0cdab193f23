//! What the errors of a quantity are compared with: the range of all its components over a run.
//!
//! A component that is zero by symmetry has the round-off of the others for its range, so that all components of a
//! quantity have one scale, the largest range among them. A quantity that is zero as a whole is found by what its unit
//! amounts to in this system.
//!
//! Beams that follow their heat or their prestress hold nothing, but for what a mesh makes of it: their forces and
//! energies are compared with those that the same deformation would hold without heat or prestress.

use crate::math::Vec3;
use crate::math::rotation::rotation_between;
use crate::mechanics::output::beam_scale::BeamScale;
use serde::{Deserialize, Serialize};

/// A quantity that changes by less than this share of its size is a constant: it is compared with its size.
const CONSTANT: f64 = 1e-6;
/// A quantity below this share of what its unit amounts to in the system is zero: the round-off of large numbers that
/// cancel.
const ZERO: f64 = 1e-9;
/// Strains and quaternions: a strain of 1e-12 is round-off.
const PURE_NUMBER: f64 = 1e-3;

/// What units amount to in a system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// Its extent, m.
    pub size: f64,
    /// The time that is simulated, s.
    pub duration: f64,
    /// Its largest energy, J.
    pub energy: f64,
    /// Gravity, m/s²: at rest it is what accelerations cancel against.
    pub gravity: f64,
    /// What its beams do.
    pub beams: Beams,
}

/// What quantities of beams amount to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Beams {
    /// At a strain of 1.
    pub of_unit_strain: BeamScale,
    /// Where they have relieved most of their strains without stress.
    pub relieved: BeamScale,
}

impl Measures {
    /// The scale of a quantity with this unit that ranges as `span`; 0: it is zero.
    pub fn scale(&self, unit: &str, span: Span) -> f64 {
        let scale = span.scale(self.natural(unit));
        if scale > 0.0 { scale.max(self.beams.relieved.of(unit)) } else { 0.0 }
    }

    /// One of a unit, in the unit; 0: not known.
    fn natural(&self, unit: &str) -> f64 {
        let Self { size, duration, gravity, beams, .. } = *self;
        // Of a strain that is round-off: energies are squares.
        let strain = if unit == "J" { PURE_NUMBER * PURE_NUMBER * ZERO } else { PURE_NUMBER };
        let of_round_off = strain * beams.of_unit_strain.of(unit);
        let energy = self.energy.max(beams.relieved.energy);
        let natural = match unit {
            "m" => size,
            "m/s" => size / duration,
            "m/s2" => gravity.max(size / (duration * duration)),
            "rad" => 1.0,
            "rad/s" => 1.0 / duration,
            "1/m" | "rad/m" => 1.0 / size,
            "" => PURE_NUMBER,
            "N" => energy / size,
            "N.m" | "J" => energy,
            "kg.m/s" => energy * duration / size,
            "kg.m2/s" => energy * duration,
            _ => 0.0,
        };
        natural.max(of_round_off)
    }
}

/// Replaces the rotation vectors of `other`, which begin at the numbers `rotations`, by those of `own` plus the turn
/// from one to the other. Components of rotation vectors that are near to each other as turns may be far apart.
pub fn compare_turns(rotations: &[usize], own: &[f64], other: &mut [f64]) {
    for first in rotations {
        let [from, to] = [own, &*other].map(|row| Vec3::from_row_slice(&row[*first..first + 3]));
        other[*first..first + 3].copy_from_slice((from + rotation_between(&from, &to)).as_slice());
    }
}

/// The family of all energies.
pub const ENERGY: &str = "energy";

/// The quantity that a column is a component of: `tip.velocity` of `tip.velocity[2]`; all energies are one.
pub fn family(name: &str) -> &str {
    if name.starts_with("energy.") { ENERGY } else { name.split('[').next().unwrap_or(name) }
}

/// How far the components of a quantity range, and how large they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Span {
    /// The largest range.
    pub range: f64,
    /// The largest size.
    pub size: f64,
}

impl Span {
    /// Includes a component with this range and size.
    pub fn include(&mut self, range: f64, size: f64) {
        (self.range, self.size) = (self.range.max(range), self.size.max(size));
    }

    /// The scale of a quantity whose unit amounts to `natural`; 0: it is zero.
    fn scale(self, natural: f64) -> f64 {
        let scale = if self.range > CONSTANT * self.size { self.range } else { self.size };
        if scale > ZERO * natural { scale } else { 0.0 }
    }
}

/// Whether a column ranges from zero on: kinetic and elastic energy are zero at rest and as drawn; that of gravity may
/// have any constant.
pub fn counts_from_zero(name: &str) -> bool {
    matches!(name, "energy.kinetic" | "energy.elastic")
}
