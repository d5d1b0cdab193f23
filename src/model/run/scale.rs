//! What the errors of a quantity are compared with: the range of all its components over a run.
//!
//! A component that is zero by symmetry has the round-off of the others for its range, so that all components of a
//! quantity have one scale, the largest range among them, and at least a tenth of the largest quantity of its kind: an
//! axial force of 12 N where a clamp bears 600 N is not judged to a percent of itself. A quantity that is zero as a
//! whole is found by what its unit amounts to in this system.
//!
//! Beams that follow their heat or their prestress hold nothing, but for what a mesh makes of it: their forces and
//! energies are compared with those that the same deformation would hold without heat or prestress.

use crate::math::Vec3;
use crate::math::rotation::rotation_between;
use crate::mechanics::output::beam_scale::BeamScale;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A quantity that changes by less than this share of its size is a constant: it is compared with its size.
const CONSTANT: f64 = 1e-6;
/// A quantity below this share of what its unit amounts to in the system is zero: the round-off of large numbers that
/// cancel.
const ZERO: f64 = 1e-9;
/// Strains and quaternions: a strain of 1e-12 is round-off.
const PURE_NUMBER: f64 = 1e-3;

/// A constant position is compared with so many sizes of the mechanism as drawn at most: a winch may pay out more.
const MOST_SIZES: f64 = 2.0;

/// A quantity is compared with this share at least of the largest one of its kind: what is far smaller than the others
/// does not matter to a reader.
const SMALL: f64 = 0.1;
/// A quantity below this share of the largest one of its kind is zero: the round-off of the others.
const ROUND_OFF: f64 = 1e-6;

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
    /// What the errors of quantities are compared with, each given with its name, its unit and how it ranges: its own
    /// range, but at least a tenth of the largest one of its kind, except for lengths, angles and their rates; 0: zero.
    pub fn scales(&self, quantities: &[(&str, &str, Span)]) -> Vec<f64> {
        let mut largest: BTreeMap<&str, f64> = BTreeMap::new();
        for (name, unit, span) in quantities {
            // Forces count from zero; what else there is may have any constant.
            let extent = if matches!(*unit, "N" | "N.m") { span.size } else { span.range };
            let own = largest.entry(kind(name, unit)).or_default();
            *own = own.max(extent);
        }
        // Moments over the size of the system are forces.
        let of_moments = largest.get("N.m").map_or(0.0, |moment| moment / self.size);
        largest.entry("N").and_modify(|force| *force = force.max(of_moments));
        let scale = |(name, unit, span): &(&str, &str, Span)| {
            let largest = largest.get(kind(name, unit)).copied().unwrap_or(0.0);
            let own = match self.scale(unit, *span) {
                own if own > 0.0 && is_of_contact(name) => own.max(span.size),
                own => own,
            };
            match unit.starts_with('m') || unit.starts_with("rad") {
                // A tilt is not measured by the turns of a shaft, nor a bearing by the way of a crane.
                true => own,
                false if own > ROUND_OFF * largest => own.max(SMALL * largest),
                false => 0.0,
            }
        };
        quantities.iter().map(scale).collect()
    }

    /// The scale of a quantity with this unit that ranges as `span`, for itself; 0: it is zero.
    fn scale(&self, unit: &str, span: Span) -> f64 {
        let scale = span.scale(self.natural(unit), if unit == "m" { MOST_SIZES * self.size } else { f64::INFINITY });
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
            "rad/s2" => 1.0 / (duration * duration),
            "1/m" | "rad/m" => 1.0 / size,
            "" => PURE_NUMBER,
            "N" => energy / size,
            "N.m" | "J" => energy,
            "W" => energy / duration,
            "kg.m/s" => energy * duration / size,
            "kg.m2/s" => energy * duration,
            _ => 0.0,
        };
        natural.max(of_round_off)
    }
}

/// Whether a column tells how much of a beam touches a surface: 0 where none does, so that it counts from there.
fn is_of_contact(name: &str) -> bool {
    const QUANTITIES: [&str; 5] = [".contact_length", ".laid_length", ".penetration", ".sliding", ".wrap_angle"];
    QUANTITIES.iter().any(|quantity| name.ends_with(quantity))
}

/// Replaces the rotation vectors of `other`, which begin at the numbers `rotations`, by those of `own` plus the turn
/// from one to the other. Components of rotation vectors that are near to each other as turns may be far apart.
pub fn compare_turns(rotations: &[usize], own: &[f64], other: &mut [f64]) {
    for first in rotations {
        let [from, to] = [own, &*other].map(|row| Vec3::from_row_slice(&row[*first..first + 3]));
        other[*first..first + 3].copy_from_slice((from + rotation_between(&from, &to)).as_slice());
    }
}

/// What is compared: quantities of one unit, and of those without a unit the ones of one name, `tip.axial_strain` with
/// `foot.axial_strain`.
fn kind<'a>(name: &'a str, unit: &'a str) -> &'a str {
    if unit.is_empty() { name.rsplit('.').next().unwrap_or(name) } else { unit }
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

    /// The scale of a quantity whose unit amounts to `natural`; 0: it is zero. A constant is compared with `most` at
    /// most: a position of an equilibrium far from the origin is judged by the size of the mechanism.
    fn scale(self, natural: f64, most: f64) -> f64 {
        let scale = if self.range > CONSTANT * self.size { self.range } else { self.size.min(most) };
        if scale > ZERO * natural { scale } else { 0.0 }
    }
}

/// Whether a column ranges from zero on: kinetic and elastic energy are zero at rest and as drawn; that of gravity may
/// have any constant.
pub fn counts_from_zero(name: &str) -> bool {
    matches!(name, "energy.kinetic" | "energy.elastic")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wrap of 3 rad that changes by 0.1 rad is judged against 3 rad, an angle against its change.
    #[test]
    fn quantities_of_contact_count_from_zero() {
        let measures = Measures { size: 1.0, duration: 1.0, energy: 1.0, gravity: 9.81, beams: Beams::default() };
        let span = Span { range: 0.1, size: 3.0 };
        let scales = measures.scales(&[("grip.wrap_angle", "rad", span), ("hinge.angle", "rad", span)]);
        assert_eq!(scales, [3.0, 0.1]);
        assert_eq!(measures.scales(&[("line.laid_length", "m", span)]), [3.0]);
        assert_eq!(measures.scales(&[("grip.sliding", "", Span::default())]), [0.0]);
    }

    /// Round-off of an acceleration of an angle, and of a power, is zero.
    #[test]
    fn round_off_is_zero_in_every_unit() {
        let measures = Measures { size: 1.0, duration: 1.0, energy: 1.0, gravity: 9.81, beams: Beams::default() };
        let span = Span { range: 1e-12, size: 1e-12 };
        for unit in ["m", "m/s", "m/s2", "rad", "rad/s", "rad/s2", "N", "N.m", "J", "W", "1/m"] {
            assert_eq!(measures.scales(&[("any.quantity", unit, span)]), [0.0], "{unit}");
        }
    }

    /// An equilibrium 100 km from the origin is judged as one there.
    #[test]
    fn constant_positions_are_judged_by_the_size_of_the_mechanism() {
        let measures = Measures { size: 2.0, duration: 1.0, energy: 1.0, gravity: 9.81, beams: Beams::default() };
        let at = |size: f64| measures.scales(&[("tip.position", "m", Span { range: 0.0, size })])[0];
        assert_eq!([at(0.5), at(1e5)], [0.5, 4.0]);
    }
}
