//! Bending: `(1 + 3 e)/2 (E Iz g1² + E Iy g2²)`, J/m; `e = 0` for small strain (MECHANICS 3.1, 3.2).

use crate::mechanics::beam::ancf14::strain::{BendingStiffness, Resultants, Rigidities, Strain, Strains};

/// How much the axial Green strain stiffens bending: `d(1 + 3 e)/de`, none for small strain.
fn coupling(stiffness: &BendingStiffness) -> f64 {
    match stiffness.strain {
        Strain::Small => 0.0,
        Strain::Large | Strain::LargeTruncated => 3.0,
    }
}

/// Energy density, J/m.
pub fn energy(stiffness: &BendingStiffness, strains: &Strains) -> f64 {
    let [g1, g2, _, e] = (*strains).into();
    0.5 * (1.0 + coupling(stiffness) * e) * (stiffness.bending_z * g1 * g1 + stiffness.bending_y * g2 * g2)
}

/// Derivatives by the strains: moments (N m), 0, and the axial part (J/m).
#[inline]
pub fn gradient(stiffness: &BendingStiffness, strains: &Strains) -> Resultants {
    let [g1, g2, _, e] = (*strains).into();
    let factor = 1.0 + coupling(stiffness) * e;
    let square = stiffness.bending_z * g1 * g1 + stiffness.bending_y * g2 * g2;
    Resultants::new(
        factor * stiffness.bending_z * g1,
        factor * stiffness.bending_y * g2,
        0.0,
        0.5 * coupling(stiffness) * square,
    )
}

/// Second derivatives by the strains.
#[inline]
pub fn hessian(stiffness: &BendingStiffness, strains: &Strains) -> Rigidities {
    let [g1, g2, _, e] = (*strains).into();
    let factor = 1.0 + coupling(stiffness) * e;
    let [about_z, about_y] = [stiffness.bending_z, stiffness.bending_y];
    Rigidities {
        bending: [factor * about_z, factor * about_y],
        with_axial: [coupling(stiffness) * about_z * g1, coupling(stiffness) * about_y * g2],
        ..Rigidities::default()
    }
}
