//! Fourth moments: what the square of the Green strain's quadratic part adds (MECHANICS 3.2b), J/m,
//! `E/8 [tau⁴ (yyyy + 2 yyzz + zzzz) + 2 tau² (g1² (yyyy + yyzz) + g2² (zzzz + yyzz)) + g1⁴ yyyy + 6 g1² g2² yyzz + g2⁴ zzzz]`.
//! It bounds the energy from below; all of it is 0 unless the strain is large.

use crate::mechanics::beam::ancf14::strain::{BendingStiffness, Resultants, Rigidities, Strains};

/// Energy density, J/m.
pub fn energy(stiffness: &BendingStiffness, strains: &Strains) -> f64 {
    let [yyyy, yyzz, zzzz] = stiffness.fourth;
    let [g1, g2, tau] = [strains[0] * strains[0], strains[1] * strains[1], strains[2] * strains[2]];
    0.125
        * (tau * tau * (yyyy + 2.0 * yyzz + zzzz)
            + 2.0 * tau * (g1 * (yyyy + yyzz) + g2 * (zzzz + yyzz))
            + g1 * g1 * yyyy
            + 6.0 * g1 * g2 * yyzz
            + g2 * g2 * zzzz)
}

/// Derivatives by the strains: moments and torque, N m.
#[inline]
pub fn gradient(stiffness: &BendingStiffness, strains: &Strains) -> Resultants {
    let [yyyy, yyzz, zzzz] = stiffness.fourth;
    let [g1, g2, tau, _] = (*strains).into();
    Resultants::new(
        0.5 * g1 * (tau * tau * (yyyy + yyzz) + g1 * g1 * yyyy + 3.0 * g2 * g2 * yyzz),
        0.5 * g2 * (tau * tau * (zzzz + yyzz) + g2 * g2 * zzzz + 3.0 * g1 * g1 * yyzz),
        0.5 * tau * (tau * tau * (yyyy + 2.0 * yyzz + zzzz) + g1 * g1 * (yyyy + yyzz) + g2 * g2 * (zzzz + yyzz)),
        0.0,
    )
}

/// Second derivatives by the strains.
#[inline]
pub fn hessian(stiffness: &BendingStiffness, strains: &Strains) -> Rigidities {
    let [yyyy, yyzz, zzzz] = stiffness.fourth;
    let [g1, g2, tau, _] = (*strains).into();
    Rigidities {
        bending: [
            0.5 * (tau * tau * (yyyy + yyzz) + 3.0 * g1 * g1 * yyyy + 3.0 * g2 * g2 * yyzz),
            0.5 * (tau * tau * (zzzz + yyzz) + 3.0 * g2 * g2 * zzzz + 3.0 * g1 * g1 * yyzz),
        ],
        cross: 3.0 * g1 * g2 * yyzz,
        torsion: 0.5
            * (3.0 * tau * tau * (yyyy + 2.0 * yyzz + zzzz) + g1 * g1 * (yyyy + yyzz) + g2 * g2 * (zzzz + yyzz)),
        with_torsion: [tau * g1 * (yyyy + yyzz), tau * g2 * (zzzz + yyzz)],
        with_axial: [0.0; 2],
    }
}
