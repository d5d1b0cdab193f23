//! The damping of a material: its coefficients, or the damping ratios that it has at two frequencies.

use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::Rule;
use std::f64::consts::TAU;

pub(super) const MATERIAL_DAMPING: Rule =
    Rule::new("damping", "viscous stress per strain rate, over the modulus", "s").from(0.0).tunable();
pub(super) const MASS_DAMPING: Rule =
    Rule::new("mass_damping", "damping in proportion to mass: force over mass and velocity", "1/s").from(0.0).tunable();
pub(super) const DAMPING_RATIOS: Rule =
    Rule::new("damping_ratios", "ratio of critical damping at each of two frequencies", "").from(0.0).tunable();
pub(super) const DAMPING_FREQUENCIES: Rule =
    Rule::new("damping_frequencies", "frequency at which a ratio of critical damping is given", "Hz")
        .above(0.0)
        .tunable();

/// The damping of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// In proportion to stiffness and to mass.
    Coefficients {
        /// Kelvin-Voigt damping, s: stress = E (strain + damping * strain rate).
        stiffness: Number,
        /// Force over mass and velocity, 1/s.
        mass: Number,
    },
    /// Such that vibrations of two frequencies have these ratios of the critical damping.
    Ratios {
        /// 1.
        ratios: [Number; 2],
        /// Hz.
        frequencies: [Number; 2],
    },
}

impl Damping {
    pub(super) fn read(reader: &mut Reader<'_, '_>) -> Self {
        if reader.has("damping_ratios") || reader.has("damping_frequencies") {
            reader.exclude("damping", "damping_ratios");
            reader.exclude("mass_damping", "damping_ratios");
            let ratios = reader.list(&DAMPING_RATIOS, "a list of 2");
            return Self::Ratios { ratios, frequencies: reader.list(&DAMPING_FREQUENCIES, "a list of 2") };
        }
        Self::Coefficients {
            stiffness: reader.number_or(&MATERIAL_DAMPING, 0.0),
            mass: reader.number_or(&MASS_DAMPING, 0.0),
        }
    }

    /// Damping in proportion to stiffness, s, and to mass, 1/s: `ζ = c ω/2 + a/(2 ω)` at both frequencies.
    pub fn coefficients(&self, value: impl Fn(Number) -> f64) -> [f64; 2] {
        match self {
            Self::Coefficients { stiffness, mass } => [value(*stiffness), value(*mass)],
            Self::Ratios { ratios, frequencies } => {
                let ([z1, z2], [w1, w2]) = (ratios.map(&value), frequencies.map(|frequency| TAU * value(frequency)));
                let difference = w2 * w2 - w1 * w1;
                [2.0 * (z2 * w2 - z1 * w1) / difference, 2.0 * w1 * w2 * (z1 * w2 - z2 * w1) / difference]
            }
        }
    }

    /// The ratios for which damping would have to be negative, in words; none: all is well.
    pub fn objection(&self, value: impl Fn(Number) -> f64) -> Option<(Number, String)> {
        let Self::Ratios { ratios, frequencies } = self else { return None };
        let ([z1, z2], [f1, f2]) = (ratios.map(&value), frequencies.map(&value));
        if f1 >= f2 {
            return Some((frequencies[0], format!("must be below the second frequency, {f2} Hz")));
        }
        let [least, most] = [z1 * f1 / f2, z1 * f2 / f1];
        let allowed = format!("must be from {least:.4} to {most:.4}, for no damping to be negative");
        (z2 < least || z2 > most).then_some((ratios[1], allowed))
    }
}
