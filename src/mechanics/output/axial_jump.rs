//! Axial forces that jump at an inner node, where a load, a joint or a spring holds the beam. The stretch `|r'|` is one
//! unknown at a node: the jump is spread over both elements, with an overshoot of 6 % of it, however fine the mesh is.

use super::strain_fit::StrainFit;
use crate::mechanics::beam::Beam;
use crate::mechanics::beam::resultants::SectionShape;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::system::System;

/// Gauss' two places in an element: the mean of the axial force over it is right, jump or not.
const PLACES: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// A jump of the axial force at a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxialJump {
    /// The node.
    pub node: usize,
    /// From the element before it to the one after it, N.
    pub jump: f64,
    /// The larger axial force of both, in size, N.
    pub axial: f64,
    /// The larger force of both in any direction, N.
    pub carried: f64,
}

impl System {
    /// The largest jump of the axial force at an inner node that `sensor` is within an element of; none where nothing
    /// acts there.
    pub fn axial_jump_near(&self, c: &Configuration, sensor: &Sensor) -> Option<AxialJump> {
        let (number, _) = sensor.on_beam?;
        let beam = &self.beams[number];
        let first = beam.first_element;
        let ends = sensor.elements().flat_map(|element| [element - first, element - first + 1]);
        let jumps = ends.filter_map(|end| {
            if end == 0 || end >= beam.elements() || self.is_open(beam, end) || beam.corners.contains(&end) {
                return None;
            }
            let [before, after] = [end - 1, end].map(|number| {
                let axial = self.mean_axial_force(c, first + number);
                (axial, axial.hypot(self.shear_force(c, beam, number)))
            });
            let (axial, carried) = (before.0.abs().max(after.0.abs()), before.1.max(after.1));
            Some(AxialJump { node: beam.node(end), jump: after.0 - before.0, axial, carried })
        });
        jumps.max_by(|a, b| a.jump.abs().total_cmp(&b.jump.abs()))
    }

    /// Mean shear force of element `number` of `beam`, N: the slope of its moments; of ANCF24 it is not known.
    fn shear_force(&self, c: &Configuration, beam: &Beam, number: usize) -> f64 {
        let Some(fit) = StrainFit::of(self, beam, number, c) else { return 0.0 };
        let [about_z, about_y] = [0, 1].map(|k| fit.rigidities[k] * fit.strains[k].slope);
        about_z.hypot(about_y)
    }

    /// Mean axial force of an element, N.
    fn mean_axial_force(&self, c: &Configuration, element: usize) -> f64 {
        // The undeformed shape takes curvature and torsion away only, but for the stretch, which is 1 between unit
        // tangents to a high order.
        let drawn = SectionShape { stretch: 1.0, ..SectionShape::default() };
        PLACES.iter().map(|xi| 0.5 * self.mesh.elements[element].section_forces(&c.beams, *xi, &drawn).axial).sum()
    }
}
