//! Beams that stay perfectly straight under compression. A beam with the least bow buckles, a straight one of the mesh
//! has nothing to buckle with.
//!
//! Under a thrust `P` far beyond the buckling load, bows of the wave number `√(P/(2 EI))` grow the fastest, with the
//! rate `P/(2 √(EI ρA))`: the largest of `k √((P − EI k²)/ρA)`.

use super::strain_fit::StrainFit;
use crate::math::vectors::vec3;
use crate::mechanics::beam::ancf14::coordinates::P;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use std::f64::consts::PI;

/// Slopes that are apart by less are parallel, rad: round-off, which a bow has outgrown long before it shows.
const PARALLEL: f64 = 1e-8;

/// The thrust in a straight beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thrust {
    /// Its mean along the beam, N.
    pub force: f64,
    /// `4 π² EI/L²`, N: no ends hold a beam up to more; `π²/4 EI/L²` where an end is free.
    pub critical: f64,
    /// How fast bows grow, 1/s.
    pub rate: f64,
}

impl System {
    /// The thrust in beam `beam` of ANCF14, if it is straight, can bend, and is held at its ends alone; none: it is
    /// not, or it is taut.
    pub fn straight_thrust(&self, beam: usize, state: &State, c: &Configuration) -> Option<Thrust> {
        let own = &self.beams[beam];
        let nodes = own.node_range();
        let inner = nodes.start + 1..nodes.end - 1;
        let is_guided = inner.into_iter().any(|node| self.held[node]);
        if is_guided || own.section.limp.bending || !self.contacts.is_empty() || !self.foundations.is_empty() {
            return None;
        }
        let mut direction = None;
        let (mut length, mut impulse, mut rigidity, mut line_density) = (0.0, 0.0, f64::INFINITY, 0.0_f64);
        for (number, index) in own.element_range().enumerate() {
            let AnyElement::Ancf14(element) = &self.mesh.elements[index] else { return None };
            let slope = vec3(&state.q, element.place.start + P);
            let first = *direction.get_or_insert(slope);
            if slope.cross(&first).norm() > PARALLEL * slope.norm() * first.norm() {
                return None;
            }
            let fit = StrainFit::of(self, own, number, c)?;
            length += element.length;
            impulse += fit.force().mean * element.length;
            rigidity = fit.rigidities[0].min(fit.rigidities[1]).min(rigidity);
            line_density = element.inertia.line_density.max(line_density);
        }
        let force = -impulse / length;
        let rate = force / (2.0 * (rigidity * line_density).sqrt());
        let are_tied = [nodes.start, nodes.end - 1].into_iter().all(|node| self.is_tied(node));
        let critical = rigidity * (if are_tied { 2.0 * PI } else { 0.5 * PI } / length).powi(2);
        (force > 0.0 && rigidity > 0.0).then_some(Thrust { force, critical, rate })
    }

    /// Whether anything ties a node to another part or to the ground. Ropes may, wherever they are.
    fn is_tied(&self, node: usize) -> bool {
        let is_there = |marker: &Marker| matches!(marker, Marker::Node { node: own, .. } if *own == node);
        let joints = self.joints.iter().flat_map(|joint| [&joint.a, &joint.b]);
        let measured = self.relative_coordinates.iter().flat_map(|coordinate| [&coordinate.a, &coordinate.b]);
        !self.ropes.is_empty() || joints.chain(measured).any(is_there)
    }
}
