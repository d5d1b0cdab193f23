//! A tension center off the axis: what the odd moments of a section about the axis add to its energy (MECHANICS 3.2c),
//! J/m, `−λ e S·g − tau² M·g/2 − K(g)/2` with `λ² = 1 + 2 e`, `S = EA c`, `M = E ∫ (y, z) r² dA` and
//! `K(g) = E ∫ (y g1 + z g2)³ dA`; for small strain `−e S·g`, with the engineering strain `e`.
//!
//! They are the products of the linear part of the fibers' Green strain with its other parts. Where the tension center
//! is on the axis and the section is symmetric all of them are 0: most elements have none.

use crate::mechanics::beam::ancf14::strain::{Eccentricity, Resultants, Rigidities, Strain, Strains};

/// `E ∫ (y, z) r² dA`, N m³: the moments through which torsion bends the beam.
fn by_torsion(moments: &Eccentricity) -> [f64; 2] {
    let [yyy, yyz, yzz, zzz] = moments.third;
    [yyy + yzz, yyz + zzz]
}

/// `e λ` of the axial Green strain, with its first two derivatives, 1; of the engineering strain `e` itself.
fn stretched(strain: Strain, e: f64) -> [f64; 3] {
    if strain == Strain::Small {
        return [e, 1.0, 0.0];
    }
    let square = 1.0 + 2.0 * e;
    let stretch = square.sqrt();
    [e * stretch, (1.0 + 3.0 * e) / stretch, (2.0 + 3.0 * e) / (square * stretch)]
}

/// Energy density, J/m.
pub fn energy(strain: Strain, moments: &Eccentricity, strains: &Strains) -> f64 {
    let [g1, g2, tau, e] = (*strains).into();
    let ([s1, s2], [m1, m2], [yyy, yyz, yzz, zzz]) = (moments.first, by_torsion(moments), moments.third);
    let cube = yyy * g1 * g1 * g1 + 3.0 * g1 * g2 * (yyz * g1 + yzz * g2) + zzz * g2 * g2 * g2;
    let [stretched, ..] = stretched(strain, e);
    -stretched * (s1 * g1 + s2 * g2) - 0.5 * (tau * tau * (m1 * g1 + m2 * g2) + cube)
}

/// Derivatives by the strains: moments and torque (N m), and the axial part (N).
pub fn gradient(strain: Strain, moments: &Eccentricity, strains: &Strains) -> Resultants {
    let [g1, g2, tau, e] = (*strains).into();
    let ([s1, s2], [m1, m2], [yyy, yyz, yzz, zzz]) = (moments.first, by_torsion(moments), moments.third);
    let [stretched, by_e, _] = stretched(strain, e);
    Resultants::new(
        -stretched * s1 - 0.5 * (tau * tau * m1 + 3.0 * (yyy * g1 * g1 + 2.0 * yyz * g1 * g2 + yzz * g2 * g2)),
        -stretched * s2 - 0.5 * (tau * tau * m2 + 3.0 * (yyz * g1 * g1 + 2.0 * yzz * g1 * g2 + zzz * g2 * g2)),
        -tau * (m1 * g1 + m2 * g2),
        -by_e * (s1 * g1 + s2 * g2),
    )
}

/// Second derivative by the axial strain, N.
pub fn axial(strain: Strain, moments: &Eccentricity, strains: &Strains) -> f64 {
    let ([g1, g2, _, e], [s1, s2]) = ((*strains).into(), moments.first);
    let [.., second] = stretched(strain, e);
    -second * (s1 * g1 + s2 * g2)
}

/// Second derivatives by the strains, but for [`axial`]; the rate-dependent stress is `stiffening` times that of small
/// strains.
pub fn hessian(strain: Strain, moments: &Eccentricity, strains: &Strains, stiffening: f64) -> Rigidities {
    let [g1, g2, tau, e] = (*strains).into();
    let [_, by_e, _] = stretched(strain, e);
    let ([m1, m2], [yyy, yyz, yzz, zzz]) = (by_torsion(moments), moments.third);
    Rigidities {
        bending: [-3.0 * (yyy * g1 + yyz * g2), -3.0 * (yzz * g1 + zzz * g2)],
        cross: -3.0 * (yyz * g1 + yzz * g2),
        torsion: -(m1 * g1 + m2 * g2),
        with_torsion: [-tau * m1, -tau * m2],
        with_axial: moments.first.map(|moment| -moment * (by_e + stiffening)),
    }
}
