//! Torsion: Saint-Venant's `G Jt/2 tau²`, J/m (MECHANICS 3.1). The Wagner term lives with the axial points, in
//! axial.rs.

use crate::mechanics::beam::ancf14::strain::{BendingStiffness, Resultants, Rigidities, Strains};

/// Energy density, J/m.
pub fn energy(stiffness: &BendingStiffness, strains: &Strains) -> f64 {
    0.5 * stiffness.torsion * strains[2] * strains[2]
}

/// Derivatives by the strains: the torque, N m.
#[inline]
pub fn gradient(stiffness: &BendingStiffness, strains: &Strains) -> Resultants {
    Resultants::new(0.0, 0.0, stiffness.torsion * strains[2], 0.0)
}

/// Second derivatives by the strains.
#[inline]
pub fn hessian(stiffness: &BendingStiffness, _strains: &Strains) -> Rigidities {
    Rigidities { torsion: stiffness.torsion, ..Rigidities::default() }
}
