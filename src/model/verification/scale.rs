//! The scale of every column of a run that is verified, from the tally of its values.

use super::tally::Tally;
use crate::model::run::scale::{Measures, Span, counts_from_zero, family};
use std::collections::BTreeMap;

/// The scales of columns, each given with its unit: those of the quantities that they belong to; 0: the quantity is
/// zero.
pub fn scales(columns: &[(&str, &str, &Tally)], measures: &Measures) -> Vec<f64> {
    let mut spans: BTreeMap<&str, Span> = BTreeMap::new();
    for (name, _, tally) in columns {
        let span = spans.entry(family(name)).or_default();
        span.include(range(name, tally), tally.size());
    }
    let units: BTreeMap<&str, &str> = columns.iter().map(|(name, unit, _)| (family(name), *unit)).collect();
    let quantities: Vec<_> = spans.iter().map(|(name, span)| (*name, units[name], *span)).collect();
    let scales: BTreeMap<&str, f64> = spans.keys().copied().zip(measures.scales(&quantities)).collect();
    columns.iter().map(|(name, ..)| scales[family(name)]).collect()
}

/// The largest energy of a run, J; none: the energies are not among the columns.
pub fn energy(columns: &[(&str, &str, &Tally)]) -> Option<f64> {
    let energies = columns.iter().filter(|(name, ..)| name.starts_with("energy."));
    energies.map(|(name, _, tally)| range(name, tally)).reduce(f64::max)
}

/// How far a column ranges.
fn range(name: &str, tally: &Tally) -> f64 {
    if counts_from_zero(name) { tally.size() } else { tally.range() }
}

#[cfg(test)]
mod tests {
    use super::super::tally::Sample;
    use super::*;
    use crate::mechanics::output::beam_scale::BeamScale;
    use crate::model::run::scale::Beams;

    const NONE: BeamScale =
        BeamScale { energy: 0.0, force: 0.0, moment: 0.0, stress: 0.0, strain: 0.0, curvature: 0.0 };
    const MACHINE: Measures = Measures {
        size: 2.0,
        duration: 10.0,
        energy: 100.0,
        gravity: 9.81,
        beams: Beams { of_unit_strain: NONE, relieved: NONE },
    };

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

    /// An axial force beside a moment that bends is compared with a tenth of what the moment is as a force, 9000 N m
    /// over 2 m, and one of round-off with nothing; strains have no share in pure numbers of other names.
    #[test]
    fn small_quantities_are_compared_with_the_largest_of_their_kind() {
        let found = of([
            ("foot.section_force", "N", [0.0, 12.0]),
            ("foot.section_moment[1]", "N.m", [0.0, 9000.0]),
            ("hinge.effort", "N", [0.0, 4e-3]),
            ("foot.axial_strain", "", [0.0, 1e-3]),
            ("body.quaternion[1]", "", [0.5, 1.0]),
        ]);
        assert_eq!(found, [450.0, 9000.0, 0.0, 1e-3, 0.5]);
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
