//! What outputs tell of a section: strains of its fibers, and what its stresses amount to.

use super::coordinates::{Directors, Interpolation, part};
use super::element::Element;
use super::frame::SectionFrame;
use crate::math::quadrature::{FIVE_POINTS, FIVE_WEIGHTS};
use crate::mechanics::beam::resultants::SectionShape;

/// The triad of the section with the directors `d`.
pub fn frame(d: &Directors) -> SectionFrame {
    SectionFrame::new(&part(d, 1), &part(d, 2))
}

/// The section at `xi` of the coordinates `q` (24): it bends and twists as its triad turns along the axis.
pub fn shape(element: &Element, q: &[f64], xi: f64) -> SectionShape {
    let directors = Interpolation::new(xi, element.length).directors(q);
    let frame = frame(&directors);
    let [by_y, by_z] = frame.turn_by();
    let turn = frame.axes.tr_mul(&(by_y * part(&directors, 3) + by_z * part(&directors, 4)));
    SectionShape { stretch: part(&directors, 0).norm(), curvature: [turn[1], turn[2]], torsion: turn[0] }
}

/// Turn of the triad about its normal between the first node and `xi`, undeformed value taken off, rad.
pub fn twist(element: &Element, q: &[f64], xi: f64) -> f64 {
    let rate = |xi: f64| shape(element, q, xi).torsion - shape(element, &element.reference, xi).torsion;
    let sum: f64 = FIVE_POINTS.into_iter().zip(FIVE_WEIGHTS).map(|(point, weight)| weight * rate(xi * point)).sum();
    sum * xi * element.length
}
