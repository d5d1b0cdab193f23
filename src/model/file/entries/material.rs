//! `[material.NAME]`: a linear elastic, isotropic material.

use super::Parts;
use super::damping::{DAMPING_FREQUENCIES, DAMPING_RATIOS, Damping, MASS_DAMPING, MATERIAL_DAMPING};
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Rule};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::number(&[&YOUNG]),
    Key::number(&[&POISSON]),
    Key::number(&[&SHEAR]),
    Key::number(&[&DENSITY]),
    Key::number(&[&MATERIAL_DAMPING]),
    Key::number(&[&MASS_DAMPING]),
    Key::list(&[&DAMPING_RATIOS], "2"),
    Key::list(&[&DAMPING_FREQUENCIES], "2"),
    Key::number(&[&EXPANSION]),
];

const YOUNG: Rule = Rule::new("young", "Young's modulus", "Pa").above(0.0);
const POISSON: Rule = Rule::new("poisson", "Poisson's ratio", "").above(-1.0).below(0.5);
const SHEAR: Rule = Rule::new("shear", "shear modulus", "Pa").above(0.0);
pub(super) const EXPANSION: Rule = Rule::new("expansion", "thermal expansion", "1/K");
const DENSITY: Rule = Rule::new("density", "density", "kg/m3").above(0.0);

/// A section `[material.NAME]`.
#[derive(Clone, Debug)]
pub struct MaterialSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Young's modulus, Pa.
    pub young: Number,
    /// What gives the shear modulus.
    pub lateral: Lateral,
    /// Thermal expansion, 1/K.
    pub expansion: Option<Number>,
    /// Density, kg/m³.
    pub density: Number,
    /// Its damping.
    pub damping: Damping,
}

/// The second elastic constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lateral {
    /// Poisson's ratio: G = E / (2 (1 + ν)).
    Poisson(Number),
    /// The shear modulus itself, Pa.
    Shear(Number),
}

impl MaterialSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let young = reader.number(&YOUNG);
        let lateral = match reader.optional(&POISSON) {
            Some(poisson) => {
                reader.exclude("shear", "poisson");
                Lateral::Poisson(poisson)
            }
            None => match reader.optional(&SHEAR) {
                Some(shear) => Lateral::Shear(shear),
                None => {
                    reader.missing("poisson", "or `shear`, the shear modulus in Pa");
                    Lateral::Poisson(young)
                }
            },
        };
        let expansion = reader.optional(&EXPANSION);
        let density = reader.number(&DENSITY);
        let damping = Damping::read(&mut reader);
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, young, lateral, expansion, density, damping })
    }
}
