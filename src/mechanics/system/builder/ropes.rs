//! Ropes as drawn.

use super::SystemBuilder;
use crate::math::Vec3;
use crate::math::elementary::{asin, cos, sin};
use crate::mechanics::force::rope::line::{Wheel, products, stretched};
use crate::mechanics::force::rope::tensions::{Elasticity, Hold};
use crate::mechanics::force::rope::{Rope, Seat};
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::marker::Marker;
use std::f64::consts::{FRAC_PI_4, TAU};

/// Largest angle of a rope to the plane of a sheave as drawn, rad: fleet angles are a few degrees.
pub const STEEPEST: f64 = FRAC_PI_4;

/// A rope in words of the drawing.
#[derive(Clone, Debug)]
pub struct RopeDesign {
    /// Its name.
    pub name: String,
    /// Its first end, its wheels in the order of the rope, its last end: name, center and size.
    pub seats: Vec<(String, Marker, Wheel)>,
    /// Its elasticity.
    pub elasticity: Elasticity,
    /// How its sheaves hold it; none: it runs freely over them.
    pub hold: Option<Hold>,
    /// How long it is without tension.
    pub slack: Slack,
}

/// How long a rope is without tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slack {
    /// Strain as drawn.
    Strain(f64),
    /// Length, m.
    Length(f64),
}

/// A rope as drawn.
#[derive(Clone, Copy, Debug)]
pub enum Drawn {
    /// It is possible.
    Possible,
    /// The wheels at both ends of this span are inside each other.
    Impossible(usize),
    /// The rope is at this angle to the plane of the wheel of this index, rad.
    Steep(usize, f64),
}

impl SystemBuilder {
    /// Adds a rope, and says how it is drawn; an impossible one is not added.
    pub fn add_rope(&mut self, design: &RopeDesign) -> Drawn {
        let c = self.configuration();
        let mut seats: Vec<Seat> = Vec::new();
        let mut parts = Vec::new();
        for (name, marker, wheel) in &design.seats {
            let range = marker.coordinates(&self.system.mesh);
            let part = (!range.is_empty()).then(|| match parts.iter().position(|own| *own == range) {
                Some(known) => known,
                None => {
                    parts.push(range);
                    parts.len() - 1
                }
            });
            seats.push(Seat { name: name.clone(), marker: *marker, wheel: *wheel, drawn: [0.0; 2], part });
        }
        let mut lengths = Vec::new();
        for span in 0..seats.len() - 1 {
            let wheels = [span, span + 1].map(|seat| seats[seat].wheel);
            let [a, b] = [span, span + 1].map(|seat| seats[seat].marker.pose(&c));
            let Some((length, [leaves, reaches])) = stretched(wheels, &products(&a, &b)) else {
                return Drawn::Impossible(span);
            };
            let ends = [(&a, leaves, wheels[0]), (&b, reaches, wheels[1])]
                .map(|(pose, angle, wheel)| on_rim(pose, angle, wheel));
            for (seat, pose) in [(span, &a), (span + 1, &b)] {
                let angle = asin((pose.axis(0).dot(&(ends[1] - ends[0])) / length).clamp(-1.0, 1.0)).abs();
                if seats[seat].wheel.radius > 0.0 && angle > STEEPEST {
                    return Drawn::Steep(seat, angle);
                }
            }
            lengths.push(length);
            (seats[span].drawn[1], seats[span + 1].drawn[0]) = (leaves, reaches);
        }
        let last = seats.len() - 1;
        let mut arcs = vec![0.0; seats.len()];
        for (number, seat) in seats.iter_mut().enumerate().filter(|(number, _)| (1..last).contains(number)) {
            // As drawn a rope goes at most once around a sheave.
            let [reaches, leaves] = seat.drawn;
            let wrap = (seat.wheel.turn * (leaves - reaches)).rem_euclid(TAU);
            seat.drawn[1] = reaches + seat.wheel.turn * wrap;
            arcs[number] = seat.wheel.radius * wrap;
        }
        let stretches: Vec<f64> = match design.hold {
            Some(_) => (0..last).map(|span| lengths[span] + 0.5 * (arcs[span] + arcs[span + 1])).collect(),
            None => vec![lengths.iter().sum::<f64>() + arcs.iter().sum::<f64>()],
        };
        let length: f64 = stretches.iter().sum();
        let strain = match design.slack {
            Slack::Strain(strain) => strain,
            Slack::Length(free) => length / free - 1.0,
        };
        let rope = Rope {
            name: design.name.clone(),
            seats,
            parts,
            elasticity: design.elasticity,
            hold: design.hold,
            strain,
            free: stretches.iter().map(|own| own / (1.0 + strain)).collect(),
            memory: self.memory,
        };
        self.memory += rope.remembered();
        self.system.ropes.push(rope);
        Drawn::Possible
    }
}

/// The point of a wheel at an angle, m.
fn on_rim(pose: &Pose, angle: f64, wheel: Wheel) -> Vec3 {
    pose.place + (pose.axis(1) * cos(angle) + pose.axis(2) * sin(angle)) * wheel.radius
}
