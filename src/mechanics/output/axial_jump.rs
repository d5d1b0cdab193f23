//! Axial forces that jump at an inner node, where a load, a joint or a spring holds the beam. The stretch `|r'|` is one unknown at a node: the jump is spread over
//! both elements, with an overshoot of 6 % of it, however fine the mesh is.

use crate::mechanics::beam::resultants::SectionShape;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::system::System;

/// A jump below this share of the larger axial force beside it does not matter: its overshoot is below 1 %.
const NOTABLE: f64 = 0.15;

/// Gauss' two places in an element: the mean of the axial force over it is right, jump or not.
const PLACES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

impl System {
    /// The inner node with a jump of the axial force that `sensor` is within an element of, in words, and the jump, N.
    pub fn axial_jump_near(&self, c: &Configuration, sensor: &Sensor) -> Option<(String, f64)> {
        let (number, _) = sensor.on_beam?;
        let beam = &self.beams[number];
        let elements = beam.element_range();
        for element in sensor.elements() {
            let local = element - elements.start;
            for end in [local, local + 1].into_iter().filter(|end| 0 < *end && *end < beam.elements()) {
                let node = beam.node(end);
                if beam.corners.contains(&end) || !self.is_held(node) {
                    continue;
                }
                let [before, after] =
                    [elements.start + end - 1, elements.start + end].map(|own| self.mean_axial_force(c, own));
                let jump = after - before;
                if jump.abs() > NOTABLE * before.abs().max(after.abs()) {
                    return Some((self.describe_node(node), jump));
                }
            }
        }
        None
    }

    /// Mean axial force of an element, N.
    fn mean_axial_force(&self, c: &Configuration, element: usize) -> f64 {
        // The undeformed shape takes curvature and torsion away only, but for the stretch, which is 1 between unit tangents to a high order.
        let drawn = SectionShape { stretch: 1.0, ..SectionShape::default() };
        PLACES.iter().map(|xi| 0.5 * self.mesh.elements[element].section_forces(&c.beams, *xi, &drawn).axial).sum()
    }
}
