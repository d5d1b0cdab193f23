//! `[material.NAME]`: a linear elastic, isotropic material.

use super::damping::Damping;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema;
use crate::model::text::diagnostic::Place;

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
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>) -> Option<Self> {
        let young = reader.number(&schema::YOUNG);
        let lateral = match reader.optional(&schema::POISSON) {
            Some(poisson) => {
                reader.exclude("shear", "poisson");
                Lateral::Poisson(poisson)
            }
            None => match reader.optional(&schema::SHEAR) {
                Some(shear) => Lateral::Shear(shear),
                None => {
                    reader.missing("poisson", "or `shear`, the shear modulus in Pa");
                    Lateral::Poisson(young)
                }
            },
        };
        let expansion = reader.optional(&schema::EXPANSION);
        let density = reader.number(&schema::DENSITY);
        let damping = Damping::read(&mut reader);
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, young, lateral, expansion, density, damping })
    }
}
