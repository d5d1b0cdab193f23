//! The machine at one instant, and how it passes through it: what every part computes from.

use super::ancf14::frame::NodeFrame;
use super::mesh::Mesh;
use super::prescribed::Prescribed;

/// The machine at one instant: what every part computes from.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// All coordinates.
    pub q: &'a [f64],
    /// Frames at `q` of all nodes that have one: ANCF14's.
    pub frames: &'a [NodeFrame],
    /// Holonomy angles of all elements that have one at the last accepted state, rad.
    pub holonomy: &'a [f64],
    /// Readings of all gauges at the last accepted state: angles go on from there.
    pub readings: &'a [f64],
    /// What drives and moving frames prescribe.
    pub prescribed: &'a Prescribed,
    /// All nodes and elements.
    pub mesh: &'a Mesh,
}

/// How fast the machine passes through the configuration in which its forces are taken: what dampers ask.
#[derive(Clone, Copy, Debug)]
pub enum Rates<'a> {
    /// Not at all: an equilibrium.
    Rest,
    /// Over a step, in whose middle forces are taken: rates are differences of the ends' strains and readings.
    Step {
        /// Start of the step.
        start: &'a Configuration<'a>,
        /// End of the step.
        end: &'a Configuration<'a>,
        /// Length of the step, s.
        duration: f64,
        /// Velocities of the coordinates at the start, 1/s each.
        velocity: &'a [f64],
    },
    /// With these velocities of the coordinates, 1/s each.
    Instant(&'a [f64]),
}

/// How the forces of a configuration are taken.
#[derive(Clone, Copy, Debug)]
pub struct Passage<'a> {
    /// The change of `q` over a step, where the axial strain is the mean of its two ends' (MECHANICS 7.6).
    pub increment: Option<&'a [f64]>,
    /// Rates of strains and gauges.
    pub rates: Rates<'a>,
}

impl Passage<'_> {
    /// Nothing moves.
    pub const REST: Self = Self { increment: None, rates: Rates::Rest };
}
