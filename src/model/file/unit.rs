//! The FMI type definition that goes with a unit label of the model file.

use crate::fmi::unit::Unit;
use crate::fmi::variable::Quantity;

/// Type definition of a unit label.
const TYPES: [(&str, &str); 21] = [
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
    ("N.m/rad", "RotationalStiffness"),
    ("N.s/m", "Damping"),
    ("N.m.s/rad", "RotationalDamping"),
    ("kg", "Mass"),
    ("kg.m2", "MomentOfInertia"),
    ("kg/m3", "Density"),
    ("m2", "Area"),
    ("m4", "SecondMomentOfArea"),
    ("s", "Time"),
    ("J", "Energy"),
];

/// Units without a type definition.
const OTHERS: [(&str, &str); 2] = [("Hz", ""), ("W", "")];

/// The quantity of a unit label; an empty label is a plain number, an unknown one has no exponents.
pub fn quantity(label: &str) -> Quantity {
    let name = TYPES.iter().find(|(unit, _)| *unit == label).map_or("", |(_, name)| name);
    Quantity::new(name, label)
}

/// For a label that would need a conversion, and so is legal for display only: the coherent one to write.
pub fn coherent_instead(label: &str) -> Option<&'static str> {
    let unit = Unit::parse(label).filter(|unit| !unit.is_coherent())?;
    let same = |known: &&(&str, &str)| Unit::parse(known.0).is_some_and(|known| known.exponents == unit.exponents);
    Some(TYPES.iter().chain(&OTHERS).find(same).map_or("the coherent SI unit", |(known, _)| known))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every row is a coherent unit: its exponents reach the FMU.
    #[test]
    fn types_have_exponents() {
        for (label, name) in TYPES {
            let quantity = quantity(label);
            assert!(quantity.name == name && quantity.exponents.is_some(), "{label}");
        }
    }

    #[test]
    fn conversions_name_the_unit_to_write() {
        assert_eq!(coherent_instead("mm"), Some("m"));
        assert_eq!(coherent_instead("kN"), Some("N"));
        assert_eq!(coherent_instead("1/min"), Some("Hz"));
        assert_eq!(coherent_instead("m"), None);
        assert_eq!(coherent_instead("EUR"), None);
    }
}
