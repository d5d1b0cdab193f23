//! SI unit labels: what a label measures, as exponents, and the FMI type definition that goes with it.
//!
//! A label is a product of known units with integer exponents, `/` for what divides: `N.m`, `kg/m3`, `rad/s`, `1/s`.

use crate::fmi::variable::{Exponents, Quantity};

/// Units without a prefix: label and exponents of kg, m, s, rad.
const UNITS: [(&str, [i32; 4]); 12] = [
    ("kg", [1, 0, 0, 0]),
    ("m", [0, 1, 0, 0]),
    ("s", [0, 0, 1, 0]),
    ("rad", [0, 0, 0, 1]),
    ("N", [1, 1, -2, 0]),
    ("Pa", [1, -1, -2, 0]),
    ("J", [1, 2, -2, 0]),
    ("W", [1, 2, -3, 0]),
    ("Hz", [0, 0, -1, 0]),
    ("sr", [0, 0, 0, 2]),
    ("1", [0, 0, 0, 0]),
    ("", [0, 0, 0, 0]),
];

/// Labels that would need a conversion: legal for display only, with the coherent unit to write.
pub const DISPLAY_ONLY: [(&str, &str); 18] = [
    ("mm", "m"),
    ("cm", "m"),
    ("km", "m"),
    ("um", "m"),
    ("deg", "rad"),
    ("g", "kg"),
    ("t", "kg"),
    ("kN", "N"),
    ("MN", "N"),
    ("kPa", "Pa"),
    ("MPa", "Pa"),
    ("GPa", "Pa"),
    ("N/mm2", "Pa"),
    ("N.mm", "N.m"),
    ("ms", "s"),
    ("min", "s"),
    ("h", "s"),
    ("rpm", "rad/s"),
];

/// Type definition of a unit label.
const TYPES: [(&str, &str); 16] = [
    ("m", "Position"),
    ("rad", "Angle"),
    ("m/s", "Velocity"),
    ("m/s2", "Acceleration"),
    ("rad/s", "AngularVelocity"),
    ("N", "Force"),
    ("N.m", "Torque"),
    ("N/m", "ForcePerLength"),
    ("1/m", "Curvature"),
    ("rad/m", "Torsion"),
    ("Pa", "Stress"),
    ("kg/m3", "Density"),
    ("m2", "Area"),
    ("m4", "SecondMomentOfArea"),
    ("s", "Time"),
    ("J", "Energy"),
];

/// The quantity of a unit label; an empty label is a plain number, an unknown one has no exponents.
pub fn quantity(label: &str) -> Quantity {
    let name = TYPES.iter().find(|(unit, _)| *unit == label).map_or("", |(_, name)| name);
    Quantity { name, unit: label.to_owned(), exponents: if label.is_empty() { None } else { exponents(label) } }
}

/// The exponents of a label, None if a part of it is not known.
pub fn exponents(label: &str) -> Option<Exponents> {
    let (above, below) = label.split_once('/').unwrap_or((label, ""));
    if below.contains('/') {
        return None;
    }
    let mut sum = [0; 4];
    for (part, sign) in above.split('.').map(|part| (part, 1)).chain(below.split('.').map(|part| (part, -1))) {
        let split = part.find(|c: char| c.is_ascii_digit() || c == '-').filter(|&at| at > 0).unwrap_or(part.len());
        let (unit, exponent) = part.split_at(split);
        let exponent: i32 =
            if exponent.is_empty() { 1 } else { exponent.parse().ok().filter(|n: &i32| n.abs() < 10)? };
        let (_, unit) = UNITS.iter().find(|(name, _)| *name == unit)?;
        for (total, part) in sum.iter_mut().zip(unit) {
            *total += sign * exponent * part;
        }
    }
    Some(Exponents { kg: sum[0], m: sum[1], s: sum[2], rad: sum[3] })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Labels are products: a torque is an energy by its exponents, a pressure a force over an area.
    #[test]
    fn labels_give_their_exponents() {
        assert_eq!(exponents("N.m"), exponents("J"));
        assert_eq!(exponents("N/m2"), exponents("Pa"));
        assert_eq!(exponents("kg.m2/s2"), exponents("J"));
        assert_eq!(exponents("kg/m3"), Some(Exponents { kg: 1, m: -3, s: 0, rad: 0 }));
        assert_eq!(exponents("1/s"), exponents("Hz"));
        assert_eq!(exponents("m-1"), exponents("1/m"));
        assert_eq!(exponents("rad/s"), Some(Exponents { kg: 0, m: 0, s: -1, rad: 1 }));
    }

    /// What is not known gives no exponents, never wrong ones.
    #[test]
    fn unknown_labels_give_none() {
        for label in ["EUR", "m/s/s", "mm", "m99", "m2x", "/m/"] {
            assert_eq!(exponents(label), None, "{label}");
        }
    }
}
