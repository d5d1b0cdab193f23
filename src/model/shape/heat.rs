//! Where beams are asked for their temperature.

use crate::math::quadrature::{GAUSS_POINTS, LOBATTO_POINTS};
use crate::mechanics::beam::centerline::Centerline;
use crate::mechanics::beam::profile::inside;
use crate::mechanics::input::heat::POINTS;

/// Arc lengths at which an element knows its temperature, m; at its ends just inside it.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    /// Of the temperature on the axis.
    pub axial: [f64; POINTS],
    /// Of its gradient.
    pub bending: [f64; POINTS],
}

/// Where the elements of a beam know their temperatures.
pub fn places(line: &Centerline) -> impl Iterator<Item = Places> + '_ {
    let length: f64 = line.spans.iter().map(|span| span.length).sum();
    line.spans.iter().map(move |span| {
        let ends = [span.node, span.node + 1].map(|node| line.nodes[node].fraction);
        let at = |xi: f64| inside(ends, xi) * length;
        Places { axial: LOBATTO_POINTS.map(at), bending: GAUSS_POINTS.map(at) }
    })
}
