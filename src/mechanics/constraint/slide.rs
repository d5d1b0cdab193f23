//! Slide:  b is on the axis of a beam and slides along it, all turns are free. 2 conditions.
//!
//! The conditions are those of an inline joint along the tangent at the point of the axis that is nearest to b
//! (MECHANICS 6): there they do not change with its station to first order. The joint is one entry an element of the
//! beam; all share the two conditions, and only that of the element with the nearest point imposes them.

use crate::math::Vec3;
use crate::math::hermite;
use crate::mechanics::beam::ancf14::coordinates::{ELEMENT, interpolate};
use crate::mechanics::beam::division::Division;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use std::sync::Arc;

/// Corrections of the nearest point at most, beyond one for each element on the way.
const MOST_CORRECTIONS: usize = 60;
/// A correction of this share of an element is round-off.
const ROUND_OFF: f64 = 1e-15;
/// The least share of `|r'|²` that is left of it beside the curvature: nearer to the center of curvature a point has no
/// nearest one.
const LEAST_SHARE: f64 = 0.1;

/// The beam that a slide is on.
#[derive(Clone, Debug, PartialEq)]
pub struct Way {
    /// The first element of the beam.
    pub first_element: usize,
    /// How the beam is divided into elements.
    pub division: Division,
    /// Where the slide is as drawn, a fraction of the beam's undeformed length.
    pub drawn: f64,
}

/// The part of a slide that holds b to one element.
#[derive(Clone, Debug, PartialEq)]
pub struct Slide {
    /// The beam.
    pub way: Arc<Way>,
    /// The element.
    pub element: usize,
    /// Where its station, a fraction of the beam's undeformed length, is remembered.
    pub memory: usize,
}

/// The point of an axis that is nearest to a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The element, by its number in the mesh.
    pub element: usize,
    /// The position in it, 0 to 1.
    pub xi: f64,
    /// The derivative of the axis by its arc length as drawn there.
    pub slope: Vec3,
    /// The curvature vector of the axis there, 1/m; 0 at an end of the beam that has been left.
    pub bend: Vec3,
    /// How far the position is beyond an end of the beam, along its tangent, m.
    pub beyond: f64,
}

impl Way {
    /// The point nearest to `place`, searched from the station `from` on, along the beam.
    pub fn nearest(&self, c: &Configuration, place: &Vec3, from: f64) -> Nearest {
        let last = self.division.elements() - 1;
        let (mut own, mut xi) = self.division.place(from.clamp(0.0, 1.0));
        for _ in 0..MOST_CORRECTIONS + last {
            let point = AxisPoint::new(c, self.first_element + own, xi);
            let wanted = xi + point.correction(place);
            let before = xi;
            let is_over = match wanted {
                _ if wanted > 1.0 && own < last => {
                    (own, xi) = (own + 1, 0.0);
                    false
                }
                _ if wanted < 0.0 && own > 0 => {
                    (own, xi) = (own - 1, 1.0);
                    false
                }
                _ => {
                    xi = wanted.clamp(0.0, 1.0);
                    let change = (xi - before).abs();
                    change <= ROUND_OFF || change.is_nan()
                }
            };
            if is_over {
                break;
            }
        }
        let point = AxisPoint::new(c, self.first_element + own, xi);
        let left = point.correction(place);
        let is_beyond = xi == 0.0 && own == 0 && left < 0.0 || xi == 1.0 && own == last && left > 0.0;
        let bend = if is_beyond { Vec3::zeros() } else { point.bend() };
        let beyond = if is_beyond { (place - point.place).dot(&point.slope.normalize()).abs() } else { 0.0 };
        Nearest { element: self.first_element + own, xi, slope: point.slope, bend, beyond }
    }

    /// The station of a point, a fraction of the beam's undeformed length.
    pub fn station(&self, nearest: &Nearest) -> f64 {
        let own = nearest.element - self.first_element;
        let [begin, end] = [own, own + 1].map(|end| self.division.fraction(end).unwrap_or(1.0));
        begin + (end - begin) * nearest.xi
    }
}

impl Slide {
    /// Whether it is the first entry of its joint, which has the conditions.
    pub fn is_first(&self) -> bool {
        self.element == self.way.first_element
    }

    /// The point nearest to `place`, searched from where it was at the last accepted state.
    pub fn nearest(&self, c: &Configuration, place: &Vec3) -> Nearest {
        self.way.nearest(c, place, c.memory.get(self.memory).copied().unwrap_or(self.way.drawn))
    }
}

impl Nearest {
    /// The section there.
    pub fn marker(&self) -> Marker {
        Marker::section(self.element, self.xi)
    }
}

/// A point of the axis of an element with its derivatives by the arc length as drawn.
struct AxisPoint {
    length: f64,
    place: Vec3,
    slope: Vec3,
    second: Vec3,
}

impl AxisPoint {
    fn new(c: &Configuration, element: usize, xi: f64) -> Self {
        let element = &c.mesh.elements[element];
        let (q, length) = (&c.beams.q[element.coordinates()][..ELEMENT], element.length());
        Self {
            length,
            place: interpolate(&hermite::shape(xi, length), q),
            slope: interpolate(&hermite::shape_x(xi, length), q),
            second: interpolate(&hermite::shape_xx(xi, length), q),
        }
    }

    /// Newton's correction of the position in the element to that of the point nearest to `place`.
    fn correction(&self, place: &Vec3) -> f64 {
        let (apart, square) = (place - self.place, self.slope.norm_squared());
        let denominator = (square - apart.dot(&self.second)).max(LEAST_SHARE * square);
        apart.dot(&self.slope) / denominator / self.length
    }

    fn bend(&self) -> Vec3 {
        let square = self.slope.norm_squared();
        let across = self.second - self.slope * (self.second.dot(&self.slope) / square);
        across / square
    }
}
