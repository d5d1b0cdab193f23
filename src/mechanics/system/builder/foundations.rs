//! Foundations as drawn.

use super::SystemBuilder;
use crate::math::Mat3;
use crate::math::quadrature::FOUR_POINTS;
use crate::math::vectors::vec3;
use crate::mechanics::beam::ancf14::coordinates::SHAPE_PLACES;
use crate::mechanics::force::foundation::{Bed, Bedding, Foundation};

impl SystemBuilder {
    /// Adds a foundation of beam `beam` between two `fractions` of its length, with its axes as columns; none: those of
    /// the sections as drawn.
    pub fn add_foundation(
        &mut self,
        name: &str,
        (beam, fractions): (usize, [f64; 2]),
        axes: Option<Mat3>,
        bedding: Bedding,
    ) {
        let own = &self.system.beams[beam];
        let [(first, begin), (last, end)] = fractions.map(|fraction| own.division.place(fraction));
        let c = self.configuration();
        let bed = |number: usize| {
            let (element, q) = (own.first_element + number, &self.q);
            let element_of = &self.system.mesh.elements[element];
            let start = element_of.coordinates().start;
            let within = [if number == first { begin } else { 0.0 }, if number == last { end } else { 1.0 }];
            let of_section = |xi| element_of.section_pose(&c.beams, xi).axes;
            let axes = FOUR_POINTS.map(|xi| axes.unwrap_or_else(|| of_section(xi)));
            Bed { element, within, drawn: SHAPE_PLACES.map(|shape| vec3(q, start + shape)), axes }
        };
        let beds = (first..=last).map(bed).collect();
        self.system.foundations.push(Foundation { name: name.into(), beds, bedding });
    }
}
