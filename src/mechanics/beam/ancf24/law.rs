//! St Venant-Kirchhoff material in the section's axes, and the two cures of the element's diseases.
//!
//! Linear across, the section cannot bend as Poisson's effect has it, nor warp. With the full law it so resists bending
//! by `λ + 2 G` instead of `E` (Poisson locking), and torsion by `G (Iy + Iz)` instead of `G Jt`.

use super::strain::VoigtMatrix;
use crate::mechanics::beam::material::Material;
use crate::mechanics::beam::section::Section;

/// Which transverse shear moduli the material has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shear {
    /// `G Jt/(Iy + Iz)`: the section has its torsional stiffness, though it does not warp.
    Section,
    /// `G`: the element of 2001.
    Continuum,
}

/// Stresses by Green-Lagrange strains in Voigt's order, Pa: `E` in all three directions and no coupling of them, or,
/// with `poisson`, Hooke's law; `3 G > E` then.
pub fn law(material: &Material, section: &Section, poisson: bool, shear: Shear) -> VoigtMatrix {
    let (young, modulus) = (material.young, material.shear);
    let across = match shear {
        Shear::Section => modulus * section.torsion_constant / (section.second_moment_y + section.second_moment_z),
        Shear::Continuum => modulus,
    };
    let mut sum = VoigtMatrix::zeros();
    if poisson {
        // Lamé's first constant.
        let coupling = modulus * (young - 2.0 * modulus) / (3.0 * modulus - young);
        sum.fixed_view_mut::<3, 3>(0, 0).fill(coupling);
        (0..3).for_each(|i| sum[(i, i)] += 2.0 * modulus);
    } else {
        (0..3).for_each(|i| sum[(i, i)] = young);
    }
    for (place, modulus) in [(3, modulus), (4, across), (5, across)] {
        sum[(place, place)] = modulus;
    }
    sum
}
