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
    fn natural(&self, unit: &str) -> f64 {
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

/// The quantity that a column is a component of: `tip.velocity` of `tip.velocity[2]`; all energies are one.
pub fn family(name: &str) -> &str {
    if name.starts_with("energy.") { "energy" } else { name.split('[').next().unwrap_or(name) }
}

/// The scales of columns, each given with its unit: those of the quantities that they belong to; 0: the quantity is zero.
pub fn scales(columns: &[(&str, &str, &Tally)], measures: &Measures) -> Vec<f64> {
    let mut spans: BTreeMap<&str, Span> = BTreeMap::new();
    for (name, _, tally) in columns {
        let span = spans.entry(family(name)).or_default();
        span.range = span.range.max(range(name, tally));
        span.size = span.size.max(tally.size());
    }
    columns.iter().map(|(name, unit, _)| spans[family(name)].scale(measures.natural(unit))).collect()
}

/// How far the components of a quantity range, and how large they are.
#[derive(Clone, Copy, Debug, Default)]
struct Span {
    range: f64,
    size: f64,
}

impl Span {
    /// The scale of a quantity whose unit amounts to `natural`.
    fn scale(self, natural: f64) -> f64 {
        let scale = if self.range > CONSTANT * self.size { self.range } else { self.size };
        if scale > ZERO * natural { scale } else { 0.0 }
    }
}

/// The largest energy of a run, J.
pub fn energy(columns: &[(&str, &str, &Tally)]) -> f64 {
    let energies = columns.iter().filter(|(name, ..)| name.starts_with("energy."));
    energies.map(|(name, _, tally)| range(name, tally)).fold(0.0, f64::max)
}

/// How far a column ranges. Kinetic and elastic energy are zero at rest and as drawn; that of gravity may have any constant.
fn range(name: &str, tally: &Tally) -> f64 {
    if matches!(name, "energy.kinetic" | "energy.elastic") { tally.size() } else { tally.range() }
}
