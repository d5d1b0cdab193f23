//! The distance from a cone: from its side, from the flat faces at its ends, and from their edges. An edge of no radius
//! is the tip.
//!
//! It is a function of the point in the plane through the axis, where the cone is a trapezoid.

use super::block::within;
use super::secant::{Local, Secant, across, axis_distance, in_meridian};
use crate::math::{Mat3, Vec3};

/// A cone about x, from one end to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Radii at its start and at its end, m.
    pub radii: [f64; 2],
    /// Half its length, m.
    pub half_length: f64,
}

/// A part of the cone that may be nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Side,
    Face(usize),
    Edge(usize),
}

impl Cone {
    /// Half the sum of its radii, m.
    pub fn mean_radius(&self) -> f64 {
        0.5 * (self.radii[0] + self.radii[1])
    }

    /// Radius at a position along the axis, m.
    fn radius_at(&self, x: f64) -> f64 {
        self.mean_radius() + 0.5 * (self.radii[1] - self.radii[0]) * x / self.half_length
    }

    /// Outward normal of the side in the plane through the axis.
    fn side(&self) -> Vec3 {
        Vec3::new(0.5 * (self.radii[0] - self.radii[1]), self.half_length, 0.0).normalize()
    }

    /// The edge at an end, in the plane through the axis.
    fn edge(&self, end: usize) -> Vec3 {
        Vec3::new(sign(end) * self.half_length, self.radii[end], 0.0)
    }

    fn height_over_side(&self, point: &Vec3) -> f64 {
        self.side().dot(&(point - Vec3::new(0.0, self.mean_radius(), 0.0)))
    }

    /// The part of the cone that is nearest to `point` in the plane through the axis.
    fn nearest(&self, point: &Vec3) -> Part {
        let (normal, height) = (self.side(), self.height_over_side(point));
        let along = Vec3::new(normal.y, -normal.x, 0.0);
        let (foot, reach) =
            (along.dot(&(point - Vec3::new(0.0, self.mean_radius(), 0.0))), self.half_length / normal.y);
        let end = usize::from(point.x > 0.0);
        let beyond = point.x.abs() - self.half_length;
        if height >= 0.0 {
            return match foot {
                _ if beyond >= 0.0 && point.y <= self.radii[end] => Part::Face(end),
                foot if foot.abs() <= reach => Part::Side,
                foot => Part::Edge(usize::from(foot > 0.0)),
            };
        }
        if beyond >= 0.0 {
            return if point.y <= self.radii[end] { Part::Face(end) } else { Part::Edge(end) };
        }
        if height > beyond { Part::Side } else { Part::Face(end) }
    }

    fn local(&self, part: Part, point: &Vec3) -> Local {
        let flat = |value, gradient| Local { value, gradient, curvature: Mat3::zeros() };
        match part {
            Part::Side => flat(self.height_over_side(point), self.side()),
            Part::Face(end) => flat(sign(end) * point.x - self.half_length, Vec3::x() * sign(end)),
            Part::Edge(end) => {
                let from = point - self.edge(end);
                let Secant { direction, by_end } = Secant::of_norm(&from, &from);
                Local { value: from.norm(), gradient: direction, curvature: by_end * 2.0 }
            }
        }
    }

    /// Distance of `y`, m.
    pub(super) fn distance(&self, y: &Vec3) -> f64 {
        let point = in_meridian(y);
        self.local(self.nearest(&point), &point).value
    }

    /// A number of what is nearest to `y`.
    pub(super) fn part(&self, y: &Vec3) -> usize {
        match self.nearest(&in_meridian(y)) {
            Part::Side => 0,
            Part::Face(end) => 1 + end,
            Part::Edge(end) => 3 + end,
        }
    }

    /// The secant of the distance.
    pub(super) fn secant(&self, start: &Vec3, end: &Vec3) -> Secant {
        let points = [start, end].map(in_meridian);
        let parts = points.map(|point| self.nearest(&point));
        let [first, last] = &points;
        let inner = match parts[0] {
            part if part != parts[1] => {
                let local = |point: &Vec3| self.local(self.nearest(point), point);
                Secant::of_pieces(local, first, last, self.half_length + self.mean_radius())
            }
            Part::Edge(end) => Secant::of_norm(&(first - self.edge(end)), &(last - self.edge(end))),
            part => Secant::constant(self.local(part, last).gradient),
        };
        Secant::of_meridian(start, end, &inner)
    }

    /// Whether the way from `start` to `end` leads through a cone that is `share` as long and as thick.
    pub(super) fn is_crossed(&self, share: f64, start: &Vec3, end: &Vec3) -> bool {
        let [enter, leave] = within(share * self.half_length, start.x, end.x);
        if enter >= leave {
            return false;
        }
        let (from, way) = (across(start), across(&(end - start)));
        // Nearest to the axis; the thickest end of that part of the way counts too.
        let nearest = (-from.dot(&way) / way.norm_squared().max(f64::MIN_POSITIVE)).clamp(enter, leave);
        [enter, nearest, leave].into_iter().any(|at| {
            let point = start + (end - start) * at;
            axis_distance(&point) < share * self.radius_at(point.x)
        })
    }
}

/// Side of the middle that an end is on.
fn sign(end: usize) -> f64 {
    if end == 0 { -1.0 } else { 1.0 }
}
