//! Numbers that elements have in common are in memory once: those that follow from length and section alone, which most
//! elements of a beam have alike.
//!
//! They are two thirds of an element's numbers. A beam of many elements then has them in the processor's nearest cache.

use super::element::Element;
use std::sync::Arc;

impl Element {
    /// Takes the numbers of `other` for its own where both are equal.
    pub fn share(&mut self, other: &Self) {
        for (own, other) in self.axial.iter_mut().zip(&other.axial) {
            share(&mut own.rule, &other.rule);
        }
        for (own, other) in self.bending.iter_mut().zip(&other.bending) {
            share(&mut own.rule, &other.rule);
        }
        share(&mut self.inertia, &other.inertia);
    }
}

fn share<T: PartialEq>(own: &mut Arc<T>, other: &Arc<T>) {
    if own == other {
        *own = Arc::clone(other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::mechanics::beam::ancf14::coordinates::{ELEMENT, NODE};
    use crate::mechanics::beam::ancf14::element::Place;
    use crate::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
    use crate::mechanics::beam::ancf14::frame::NodeFrame;
    use crate::mechanics::beam::ancf14::strain::{Stiffness, Strain};
    use crate::mechanics::geometry::triad::Triad;

    /// A straight element of length `length`, m, at some distance from the origin, with the torsional rigidity
    /// `torsion`.
    fn element(length: f64, torsion: f64) -> Element {
        let mut q = [0.0; ELEMENT];
        (q[0], q[3], q[NODE], q[NODE + 3]) = (7.0, 1.0, 7.0 + length, 1.0);
        let triad = Triad::new(&Vec3::x(), &Vec3::y());
        let frames = [NodeFrame::new(&q[..NODE], &triad), NodeFrame::new(&q[NODE..], &triad)];
        let stiffness = Stiffness {
            strain: Strain::Small,
            twist: Twist::Linear,
            axial: 3.0,
            bending_y: 1.0,
            bending_z: 2.0,
            torsion,
            wagner: 0.0,
            fourth: [0.0; 3],
            damping: 0.0,
        };
        Element::new(Place::default(), length, stiffness, [1.0, 0.1], &q, [&frames[0], &frames[1]], 0.0)
    }

    /// Which parts of two elements are the same memory: axial points, bending points, inertia.
    fn is_shared(own: &Element, other: &Element) -> [bool; 3] {
        [
            own.axial.iter().zip(&other.axial).all(|(own, other)| Arc::ptr_eq(&own.rule, &other.rule)),
            own.bending.iter().zip(&other.bending).all(|(own, other)| Arc::ptr_eq(&own.rule, &other.rule)),
            Arc::ptr_eq(&own.inertia, &other.inertia),
        ]
    }

    /// What is equal is shared, and nothing else; no number changes.
    #[test]
    fn equal_numbers_are_shared() {
        let first = element(0.1, 5.0);
        for (other, expected) in
            [(element(0.1, 5.0), [true; 3]), (element(0.1, 6.0), [true, false, true]), (element(0.2, 5.0), [false; 3])]
        {
            let mut own = other.clone();
            own.share(&first);
            assert_eq!(own, other);
            assert_eq!(is_shared(&own, &first), expected);
        }
    }
}
