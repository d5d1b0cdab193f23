//! The quadrature points of an element: what each of them knows of the undeformed beam (MECHANICS 2.16) and of its
//! section.
//!
//! Elements of one length and section share the part that follows from these: it is most of what a point has, and a
//! beam has it once.

use crate::mechanics::beam::ancf14::strain::{AxialStiffness, BendingStiffness};
use std::ops::Deref;
use std::sync::Arc;

/// The part of a Lobatto point that follows from the length of the element and its section.
#[derive(Clone, Debug, PartialEq)]
pub struct AxialRule {
    /// `N'_a`.
    pub shape_x: [f64; 4],
    /// Stiffness of the section here.
    pub stiffness: AxialStiffness,
}

/// A Lobatto point: stretching is taken here.
#[derive(Clone, Debug, PartialEq)]
pub struct AxialPoint {
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
    /// The part that other elements may share.
    pub rule: Arc<AxialRule>,
}

impl Deref for AxialPoint {
    type Target = AxialRule;

    #[inline]
    fn deref(&self) -> &AxialRule {
        &self.rule
    }
}

/// The part of a Gauss point that follows from the length of the element and its section.
#[derive(Clone, Debug, PartialEq)]
pub struct BendingRule {
    /// Position in the element, 0 to 1.
    pub xi: f64,
    /// `N'_a`.
    pub shape_x: [f64; 4],
    /// `N''_a`, 1/m.
    pub shape_xx: [f64; 4],
    /// `l A_gh` of (2.13), m.
    pub collocation: [f64; 3],
    /// Quadratic Lagrange polynomials of the axial points, here.
    pub from_axial: [f64; 3],
    /// Stiffness of the section here.
    pub stiffness: BendingStiffness,
    /// Angle about the tangent from the axes of the interpolated section to the principal axes of the section here,
    /// rad.
    pub principal: f64,
    /// The part of it to the axes of the section here, rad.
    pub turn: f64,
}

/// A Gauss point: bending and torsion are taken here.
#[derive(Clone, Debug, PartialEq)]
pub struct BendingPoint {
    /// Quadrature weight `w l J0`, m.
    pub weight: f64,
    /// `J0 = |r0'|`, 1.
    pub reference_stretch: f64,
    /// `1/(l J0)`, 1/m: torsion by twist.
    pub torsion_by_twist: f64,
    /// Curvatures `gamma_10`, `gamma_20` (1/m) and torsion (rad/m) of the undeformed beam.
    pub reference: [f64; 3],
    /// The part that other elements may share.
    pub rule: Arc<BendingRule>,
}

impl Deref for BendingPoint {
    type Target = BendingRule;

    #[inline]
    fn deref(&self) -> &BendingRule {
        &self.rule
    }
}
