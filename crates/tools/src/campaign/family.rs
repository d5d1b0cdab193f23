//! Families of columns, and what an error in them is: the components of a vector, or the energies of a machine, are
//! compared with one scale.

use super::run::{Column, Record};

/// Share of the rows of a force in which it may be off: forces hold the fast oscillations that a step does not resolve,
/// and jump where the motion only bends. Motions and energies are right in every row or wrong.
pub const ROUGH_SHARE: f64 = 0.05;
/// Below this share of what is usual in a machine, a family is zero by symmetry: what it holds is round-off.
const ZERO: f64 = 1e-6;

/// The same of a force or moment beside the largest one of its machine: an axial force is a component of a section's
/// force, of which the others are not there to be compared with.
pub const SMALL_FORCE: f64 = 0.1;

/// What is not compared: counts of the solver, and momenta, which say nothing that velocities do not say.
const LEFT_OUT: [&str; 2] = ["statistics", "momentum"];
/// What is compared in most of its rows only.
const ROUGH: [&str; 12] = [
    "acceleration",
    "section_force",
    "section_moment",
    "stress",
    "axial_strain",
    "curvature",
    "torsion",
    "reaction_force",
    "reaction_moment",
    "applied_force",
    "applied_moment",
    "effort",
];
/// What has no natural zero: its scale is how far it changes. All else is compared with its largest size.
const CHANGING: [&str; 7] = ["position", "displacement", "rotation", "quaternion", "angle", "distance", "gravity"];

/// Columns that are compared together.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// `tip.displacement`, or `energy`.
    pub name: String,
    unit: String,
    columns: Vec<usize>,
    is_rough: bool,
}

impl Family {
    /// All families of a table.
    pub fn all(columns: &[Column]) -> Vec<Self> {
        let mut families: Vec<Self> = Vec::new();
        for (number, Column { name, unit }) in columns.iter().enumerate() {
            let (part, quantity) = words(name);
            if LEFT_OUT.contains(&part) {
                continue;
            }
            let name = if part == "energy" { part.to_owned() } else { format!("{part}.{quantity}") };
            match families.iter_mut().find(|family| family.name == name) {
                Some(family) => family.columns.push(number),
                None => {
                    let is_rough = ROUGH.contains(&quantity);
                    families.push(Self { name, unit: unit.clone(), columns: vec![number], is_rough });
                }
            }
        }
        families
    }

    /// Share of the rows that may be off.
    pub fn share(&self) -> f64 {
        if self.is_rough { ROUGH_SHARE } else { 0.0 }
    }

    /// What differences are compared with, over the first `rows` rows of `reference`.
    pub fn scale(&self, reference: &Record, rows: usize) -> f64 {
        let extent = self.columns.iter().map(|column| extent(reference, *column, rows)).fold(0.0, f64::max);
        extent.max(ZERO * usual(reference, &self.unit, rows))
    }

    /// Largest difference between two rows of the same number; not-a-number where one is in them.
    pub fn difference(&self, own: &[f64], other: &[f64]) -> f64 {
        let sizes = self.columns.iter().map(|column| (own[*column] - other[*column]).abs());
        sizes.fold(0.0, |largest, size| if size > largest || size.is_nan() { size } else { largest })
    }
}

/// Part and quantity of a column: `tip.displacement[1]` is of `tip`, a `displacement`.
fn words(column: &str) -> (&str, &str) {
    let name = column.split('[').next().unwrap_or(column);
    name.split_once('.').unwrap_or((name, ""))
}

/// How far a column changes, or how large it gets.
fn extent(record: &Record, column: usize, rows: usize) -> f64 {
    let name = record.columns[column].name.as_str();
    let values = record.rows[..rows].iter().map(|(_, row)| row[column]);
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if name == "energy.total" {
        // It holds the weight's energy, whose zero is anywhere.
        return 0.0;
    }
    if CHANGING.contains(&words(name).1) { high - low } else { high.abs().max(low.abs()) }
}

/// What is usual for a unit in this machine: lengths of its size, its size or a radian in its duration, the largest of
/// its forces.
fn usual(record: &Record, unit: &str, rows: usize) -> f64 {
    let (size, time) = (record.size, record.duration);
    let largest = |unit: &str| {
        let columns = (0..record.columns.len()).filter(|column| record.columns[*column].unit == unit);
        columns.map(|column| extent(record, column, rows)).fold(0.0, f64::max)
    };
    // A moment over the size of the machine is a force across its beams.
    match unit {
        "m" => size,
        "m/s" => size / time,
        "m/s2" => size / time.powi(2),
        "rad" | "" => 1.0,
        "rad/s" => 1.0 / time,
        "1/m" | "rad/m" => 1.0 / size,
        "N" => largest("N").max(largest("N.m") / size) * SMALL_FORCE / ZERO,
        "N.m" => (largest("N.m") * SMALL_FORCE / ZERO).max(largest("N") * size),
        other => largest(other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A component that is zero by symmetry is compared with the others; one that nobody moves, with what is usual.
    #[test]
    fn scales_are_those_of_families() {
        let columns = [
            ("tip.position[1]", "m"),
            ("tip.position[2]", "m"),
            ("root.reaction_force[1]", "N"),
            ("idle.velocity[1]", "m/s"),
        ];
        let own = Record::sample(&columns, [vec![5.0, 1e-12, 3.0, 1e-15], vec![6.0, -1e-12, -4.0, 0.0]]);
        let families = Family::all(&own.columns);
        let scales: Vec<f64> = families.iter().map(|family| family.scale(&own, 2)).collect();
        assert_eq!(scales, [1.0, 4.0, 2e-6]);
        assert_eq!(families[0].difference(&own.rows[0].1, &own.rows[1].1), 1.0);
        assert_eq!([families[0].share(), families[1].share()], [0.0, ROUGH_SHARE]);
    }
}
