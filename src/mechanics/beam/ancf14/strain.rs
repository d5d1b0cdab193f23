//! What an energy density of a bending point depends on, and its derivatives in the same order.

use super::energy::quadratic_twist::Twist;
use nalgebra::SVector;
use std::ops::{Add, Mul};

/// Strains at a bending point: `[g1, g2, tau, e]` = curvature about z and (negative) about y (1/m), torsion (rad/m),
/// axial strain of the axial points carried to the bending point (1): Green's, for small strain the engineering
/// one where a tension center off the axis couples it with bending, else 0.
pub type Strains = SVector<f64, 4>;
/// Derivatives of a density by [`Strains`]: stress resultants.
pub type Resultants = SVector<f64, 4>;

/// Second derivatives of a density by [`Strains`]; those that are not here are 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rigidities {
    /// By `g1` twice and by `g2` twice, N m².
    pub bending: [f64; 2],
    /// By `g1` and `g2`, N m².
    pub cross: f64,
    /// By `tau` twice, N m².
    pub torsion: f64,
    /// By `g1` and by `g2`, and by `tau`, N m².
    pub with_torsion: [f64; 2],
    /// By `g1` and by `g2`, and by `e`, N m.
    pub with_axial: [f64; 2],
}

impl Rigidities {
    /// Adds `factor` times the rigidities of small strains.
    #[inline]
    pub fn stiffen(&mut self, stiffness: &BendingStiffness, factor: f64) {
        self.bending[0] += factor * stiffness.bending_z;
        self.bending[1] += factor * stiffness.bending_y;
        self.torsion += factor * stiffness.torsion;
    }
}

impl Add for Rigidities {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let pair = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        Self {
            bending: pair(self.bending, other.bending),
            cross: self.cross + other.cross,
            torsion: self.torsion + other.torsion,
            with_torsion: pair(self.with_torsion, other.with_torsion),
            with_axial: pair(self.with_axial, other.with_axial),
        }
    }
}

impl Mul<f64> for Rigidities {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self {
            bending: self.bending.map(|rigidity| rigidity * factor),
            cross: self.cross * factor,
            torsion: self.torsion * factor,
            with_torsion: self.with_torsion.map(|rigidity| rigidity * factor),
            with_axial: self.with_axial.map(|rigidity| rigidity * factor),
        }
    }
}

/// Which terms of the strain energy are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strain {
    /// `eps = |r'| − 1`, linear in the strains (MECHANICS 3.1).
    Small,
    /// Full Green-Lagrange strain, fourth moments included (3.2b).
    Large,
    /// The paper's: Green-Lagrange without fourth moments (3.2), unbounded below at large twist rates (trap 9).
    LargeTruncated,
}

/// Odd moments of a section about the axis, in its principal axes there, multiplied by Young's modulus: of a tension
/// center off the axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Eccentricity {
    /// `E ∫ (y, z) dA`, N m.
    pub first: [f64; 2],
    /// `E [∫y³, ∫y²z, ∫yz², ∫z³] dA`, N m³; 0 for small strain.
    pub third: [f64; 4],
}

/// Stiffness of a section against what the axial points see.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxialStiffness {
    /// `E A`, N.
    pub axial: f64,
    /// `E Ip`, N m²: the Wagner term; 0 for small strain.
    pub wagner: f64,
}

/// Stiffness of a section against what the bending points see, in its principal axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendingStiffness {
    /// Which terms of the energy are kept.
    pub strain: Strain,
    /// `E Iy`, N m².
    pub bending_y: f64,
    /// `E Iz`, N m².
    pub bending_z: f64,
    /// `G Jt`, N m².
    pub torsion: f64,
    /// `E [∫y⁴, ∫y²z², ∫z⁴] dA`, N m⁴; 0 unless the strain is large.
    pub fourth: [f64; 3],
}

/// Stiffness of a section, Young's and shear modulus included, and how its strains are found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// Which terms of the energy are kept.
    pub strain: Strain,
    /// How the twist runs inside an element.
    pub twist: Twist,
    /// `E A`, N.
    pub axial: f64,
    /// `E Iy`, N m².
    pub bending_y: f64,
    /// `E Iz`, N m².
    pub bending_z: f64,
    /// `G Jt`, N m².
    pub torsion: f64,
    /// `E Ip`, N m²: the Wagner term; 0 for small strain.
    pub wagner: f64,
    /// `E [∫y⁴, ∫y²z², ∫z⁴] dA`, N m⁴; 0 unless the strain is large.
    pub fourth: [f64; 3],
    /// Kelvin-Voigt damping: what multiplies the strain rate, s; 0: none.
    pub damping: f64,
}

impl Stiffness {
    /// The part that the axial points see.
    pub fn at_axial_point(&self) -> AxialStiffness {
        AxialStiffness { axial: self.axial, wagner: self.wagner }
    }

    /// The part that the bending points see.
    pub fn at_bending_point(&self) -> BendingStiffness {
        let Self { strain, bending_y, bending_z, torsion, fourth, .. } = *self;
        BendingStiffness { strain, bending_y, bending_z, torsion, fourth }
    }
}
