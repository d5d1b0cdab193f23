//! The quadrature points of an element: what each of them knows of the undeformed beam (MECHANICS 2.16) and of its section.

use crate::mechanics::beam::ancf14::strain::{AxialStiffness, BendingStiffness};

/// A Lobatto point: stretching is taken here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxialPoint {
    /// `N'_a`.
    pub shape_x: [f64; 4],
    /// Quadrature weight `w l J0`, m.
    pub weight: f64,
    /// `J0 = |r0'|`, 1.
    pub reference_stretch: f64,
    /// `|r0'|²`, 1.
    pub reference_square: f64,
    /// `1/(l J0)`, 1/m: torsion by twist.
    pub torsion_by_twist: f64,
    /// Mean torsion of the undeformed beam, rad/m.
    pub reference_torsion: f64,
    /// Strain without stress, by tension as drawn, 1.
    pub natural: f64,
    /// Stiffness of the section here.
    pub stiffness: AxialStiffness,
}

/// A Gauss point: bending and torsion are taken here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendingPoint {
    /// Place in the element, 0 to 1.
    pub xi: f64,
    /// `N'_a`.
    pub shape_x: [f64; 4],
    /// `N''_a`, 1/m.
    pub shape_xx: [f64; 4],
    /// `l A_gh` of (2.13), m.
    pub collocation: [f64; 3],
    /// Quadratic Lagrange polynomials of the axial points, here.
    pub from_axial: [f64; 3],
    /// Quadrature weight `w l J0`, m.
    pub weight: f64,
    /// `J0 = |r0'|`, 1.
    pub reference_stretch: f64,
    /// `1/(l J0)`, 1/m: torsion by twist.
    pub torsion_by_twist: f64,
    /// Curvatures `gamma_10`, `gamma_20` (1/m) and torsion (rad/m) of the undeformed beam.
    pub reference: [f64; 3],
    /// Stiffness of the section here.
    pub stiffness: BendingStiffness,
    /// Angle about the tangent from the axes of the interpolated section to the principal axes of the section here, rad.
    pub principal: f64,
    /// The part of it to the axes of the section here, rad.
    pub turn: f64,
}
