//! Moduli and densities in other units than SI: far below those of all that beams are made of.

use super::Note;
use crate::model::file::document::Document;
use crate::model::file::entries::material::{Lateral, MaterialSpec};
use crate::model::file::entries::simulation::Analysis;
use crate::model::shape::shown;

/// Young's modulus below which a number is in MPa or GPa, Pa: of all that beams are made of, only rubber and foam are
/// softer.
const SOFTEST: f64 = 1e7;
/// The same for rubber, Pa: silicone has 5e5 Pa, gels have less.
const SOFTEST_RUBBER: f64 = 1e5;
/// Poisson's ratio from which a material is rubber: it keeps its volume.
const RUBBER: f64 = 0.45;
/// Young's modulus above which there is no material, Pa: diamond has 1.2e12 Pa.
const STIFFEST: f64 = 2e12;
/// Density below which a number is in g/cm³ or t/mm³, kg/m³: balsa wood has 100 kg/m³.
const LIGHTEST: f64 = 50.0;
/// Density below which a number in no unit is that of a material, kg/m³: the beam is to have stiffness alone.
const NO_MASS: f64 = 0.04;
/// Density above which there is no material, kg/m³: osmium has 22,600 kg/m³.
const HEAVIEST: f64 = 25e3;

/// Names moduli and densities that are unusually small. In statics the density need not matter.
pub fn odd_materials(document: &Document) -> Vec<Note> {
    let is_dynamic = document.simulation.analysis == Analysis::Dynamic;
    let used = |index: &usize| document.beams.iter().any(|beam| beam.material == Some(*index));
    let materials = (0..document.materials.len()).filter(used).map(|index| &document.materials[index]);
    let mut notes = Vec::new();
    for material in materials {
        let (young, density) = (document.value(material.young), document.value(material.density));
        if young < softest(document, material) {
            notes.push(Note::of(
                document,
                material.young,
                &format!(
                    "= {} Pa is unusually soft. {}",
                    shown(young),
                    remedy(young, &[(1e9, "GPa"), (1e6, "MPa")], SOFTEST, STIFFEST, "Rubber has poisson = 0.49")
                ),
            ));
        }
        let units = [(1e3, "g/cm3"), (1e9, "kg/mm3"), (1e12, "t/mm3")];
        let has_mass = density >= NO_MASS || units.iter().any(|(size, _)| is_of_material(density * size));
        if is_dynamic && density < LIGHTEST && has_mass {
            notes.push(Note::of(
                document,
                material.density,
                &format!(
                    "= {} kg/m3 is unusually light. {}",
                    shown(density),
                    remedy(density, &units, LIGHTEST, HEAVIEST, "The unit is kg/m3")
                ),
            ));
        }
    }
    notes
}

/// Whether a material may have this density, kg/m³.
fn is_of_material(density: f64) -> bool {
    (LIGHTEST..=HEAVIEST).contains(&density)
}

/// The modulus below which that of a material is odd, Pa.
fn softest(document: &Document, material: &MaterialSpec) -> f64 {
    let poisson = match material.lateral {
        Lateral::Poisson(poisson) => document.value(poisson),
        Lateral::Shear(shear) => 0.5 * document.value(material.young) / document.value(shear) - 1.0,
    };
    if poisson >= RUBBER { SOFTEST_RUBBER } else { SOFTEST }
}

/// What to write if `value` was meant in one of `units`, each with its size: the first one in which a material has it;
/// else `otherwise`.
fn remedy(value: f64, units: &[(f64, &str)], least: f64, most: f64, otherwise: &str) -> String {
    let fits = |size: f64| (least..=most).contains(&(value * size));
    units.iter().find(|(size, _)| fits(*size)).map_or_else(
        || String::from(otherwise),
        |(size, unit)| format!("If this is in {unit}, write {}", shown(value * size)),
    )
}
