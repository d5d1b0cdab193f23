//! What an energy density of a bending point depends on, and its derivatives in the same order.

use super::quadratic_twist::Twist;
use nalgebra::{SMatrix, SVector};

/// Strains at a bending point: `[g1, g2, tau, e]` = curvature about z and (negative) about y (1/m), torsion (rad/m),
/// axial Green strain of the axial points carried to the bending point (1).
pub type Strains = SVector<f64, 4>;
/// Derivatives of a density by [`Strains`]: stress resultants.
pub type Resultants = SVector<f64, 4>;
/// Second derivatives of a density by [`Strains`].
pub type Rigidities = SMatrix<f64, 4, 4>;

/// Which terms of the strain energy are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strain {
    /// `eps = |r'| − 1`, no coupling (MECHANICS 3.1).
    Small,
    /// Full Green-Lagrange strain, fourth moments included (3.2b).
    Large,
    /// The paper's: Green-Lagrange without fourth moments (3.2), unbounded below at large twist rates (trap 9).
    LargeTruncated,
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
