//! What the error of a column is compared with: the range of the quantity that it is a component of.
//!
//! A component that is zero by symmetry has the round-off of the others for its range, so that all components of a quantity have one
//! scale, the largest range among them. A quantity that is zero as a whole is found by what its unit amounts to in this machine.

use super::tally::Tally;
use std::collections::BTreeMap;

/// A quantity that changes by less than this share of its size is a constant: it is compared with its size.
const CONSTANT: f64 = 1e-6;
/// A quantity below this share of what its unit amounts to in the machine is zero: the round-off of large numbers that cancel.
const ZERO: f64 = 1e-9;
/// Strains and quaternions: a strain of 1e-12 is round-off.
const PURE_NUMBER: f64 = 1e-3;

/// What units amount to in a machine.
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
}

impl Measures {
    /// One of a unit, in the unit; 0: not known.
    pub fn natural(&self, unit: &str) -> f64 {
        let Self { size, duration, energy, gravity } = *self;
        match unit {
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
        }
    }
}

/// The family of all energies.
pub const ENERGY: &str = "energy";

/// The quantity that a column is a component of: `tip.velocity` of `tip.velocity[2]`; all energies are one.
pub fn family(name: &str) -> &str {
    if name.starts_with("energy.") { ENERGY } else { name.split('[').next().unwrap_or(name) }
}

/// The scales of columns, each given with its unit: those of the quantities that they belong to; 0: the quantity is zero.
pub fn scales(columns: &[(&str, &str, &Tally)], measures: &Measures) -> Vec<f64> {
    let mut spans: BTreeMap<&str, Span> = BTreeMap::new();
    for (name, _, tally) in columns {
        let span = spans.entry(family(name)).or_default();
        span.include(range(name, tally), tally.size());
    }
    columns.iter().map(|(name, unit, _)| spans[family(name)].scale(measures.natural(unit))).collect()
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
    pub fn scale(self, natural: f64) -> f64 {
        let scale = if self.range > CONSTANT * self.size { self.range } else { self.size };
        if scale > ZERO * natural { scale } else { 0.0 }
    }
}

/// The largest energy of a run, J.
pub fn energy(columns: &[(&str, &str, &Tally)]) -> f64 {
    let energies = columns.iter().filter(|(name, ..)| name.starts_with("energy."));
    energies.map(|(name, _, tally)| range(name, tally)).fold(0.0, f64::max)
}

/// How far a column ranges.
fn range(name: &str, tally: &Tally) -> f64 {
    if counts_from_zero(name) { tally.size() } else { tally.range() }
}

/// Whether a column ranges from zero on: kinetic and elastic energy are zero at rest and as drawn; that of gravity may have any constant.
pub fn counts_from_zero(name: &str) -> bool {
    matches!(name, "energy.kinetic" | "energy.elastic")
}

#[cfg(test)]
mod tests {
    use super::super::tally::Sample;
    use super::*;

    const MACHINE: Measures = Measures { size: 2.0, duration: 10.0, energy: 100.0, gravity: 9.81 };

    fn tally(values: [f64; 2]) -> Tally {
        let mut tally = Tally::default();
        values.into_iter().for_each(|own| tally.add(0.0, Sample { own, ..Sample::default() }));
        tally
    }

    fn of<const N: usize>(columns: [(&str, &str, [f64; 2]); N]) -> Vec<f64> {
        let tallies = columns.map(|(_, _, values)| tally(values));
        let rows: Vec<_> = columns.iter().zip(&tallies).map(|((name, unit, _), tally)| (*name, *unit, tally)).collect();
        scales(&rows, &MACHINE)
    }

    /// Components and stations share the largest range among them; another quantity has its own.
    #[test]
    fn components_share_a_scale() {
        let found = of([
            ("tip.velocity[1]", "m/s", [1e-17, -1e-17]),
            ("tip.velocity[2]", "m/s", [-1.0, 3.0]),
            ("tip.position[1]", "m", [1000.0, 1000.1]),
            ("shape.twist[1]", "rad", [0.0, 0.0]),
            ("shape.twist[2]", "rad", [0.0, 0.5]),
        ]);
        assert_eq!(found[..2], [4.0; 2]);
        assert!((found[2] - 0.1).abs() < 1e-9);
        assert_eq!(found[3..], [0.5; 2]);
    }

    /// A constant is compared with its size, a quantity of round-off with nothing.
    #[test]
    fn constants_and_zeros_are_told_apart() {
        let found = of([
            ("hinge.reaction_force[3]", "N", [98.1, 98.1 + 1e-9]),
            ("hinge.reaction_moment[1]", "N.m", [1e-12, -3e-11]),
            ("tip.acceleration[1]", "m/s2", [1e-9, -1e-9]),
        ]);
        assert_eq!(found, [98.1 + 1e-9, 0.0, 0.0]);
    }

    /// Energies are one quantity; the constant in that of gravity does not count.
    #[test]
    fn energies_are_compared_with_the_largest() {
        let found = of([
            ("energy.kinetic", "J", [0.0, 5.0]),
            ("energy.gravity", "J", [1e4, 1e4 - 5.0]),
            ("energy.total", "J", [1e4, 1e4]),
        ]);
        assert_eq!(found, [5.0; 3]);
    }
}
