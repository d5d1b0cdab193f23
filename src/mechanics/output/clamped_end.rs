//! Clamped ends of taut beams. Under a tension `T` a beam bends at a clamped end within its bending length, `√(EI/T)`,
//! and is nearly straight beyond it. An element that is longer leaves this bend out: its energy is small, but the
//! moment at the end is wrong.

use super::strain_fit::StrainFit;
use crate::mechanics::constraint::joint::Joint;
use crate::mechanics::constraint::primitive::Primitive;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;

/// An element of so many bending lengths does not resolve the bend at a clamped end.
const COARSE: f64 = 2.0;
/// An element that turns by less is straight, rad.
const STRAIGHT: f64 = 1e-3;

/// A clamped end whose bending length is shorter than the element there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoarseEnd {
    /// The node.
    pub node: usize,
    /// The element.
    pub element: usize,
    /// Tension of the element, N.
    pub tension: f64,
    /// `√(EI/T)`, m.
    pub bending_length: f64,
    /// Length of the element, m.
    pub length: f64,
}

impl System {
    /// The clamped end whose element is longest in bending lengths, if it does not resolve the bend there.
    pub fn coarse_end(&self, c: &Configuration) -> Option<CoarseEnd> {
        let ends = self.joints.iter().filter_map(clamped_node).flat_map(|node| {
            let beam = self.beams.iter().find(|beam| beam.node_range().contains(&node));
            let elements = beam.map_or([None; 2], |beam| beam.elements_at(node));
            // The node is the end of the first one, the beginning of the second one.
            elements.into_iter().zip([0.5, -0.5]).filter_map(move |(element, side)| {
                let element = element?;
                let fit = StrainFit::of(self, beam?, element - beam?.first_element, c)?;
                Some(CoarseEnd { node, element, ..bend(&fit, side)? })
            })
        });
        let share = |end: &CoarseEnd| end.length / end.bending_length;
        ends.filter(|end| share(end) > COARSE).max_by(|a, b| share(a).total_cmp(&share(b)))
    }
}

/// The node that a joint clamps to the ground or a frame; none: it clamps none. A body that is not held gives way.
fn clamped_node(joint: &Joint) -> Option<usize> {
    let holds_slope = joint.primitives.iter().any(|primitive| matches!(primitive, Primitive::Unturned(_)));
    match (joint.a, joint.b) {
        (Marker::Node { node, .. }, other) | (other, Marker::Node { node, .. })
            if holds_slope && matches!(other, Marker::Ground(_) | Marker::Frame { .. }) =>
        {
            Some(node)
        }
        _ => None,
    }
}

/// The bend of an element at `side` of its middle, in lengths, in the direction in which its bending length is shorter;
/// none: it is not taut, or straight.
fn bend(fit: &StrainFit, side: f64) -> Option<CoarseEnd> {
    let (length, tension) = (fit.length(), fit.force().mean);
    let is_bent = |k: &usize| fit.strains[*k].at(side * length).abs() * length > STRAIGHT;
    let rigidity = [0, 1].into_iter().filter(is_bent).map(|k| fit.rigidities[k]).reduce(f64::min)?;
    let bending_length = (rigidity / tension).sqrt();
    (tension > 0.0).then_some(CoarseEnd { node: 0, element: 0, tension, bending_length, length })
}
