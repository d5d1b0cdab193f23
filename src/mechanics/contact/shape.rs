//! Shapes of surfaces: the distance of a point from them, and the direction in which it grows over a step.
//!
//! Points are in the axes of the surface, whose x is along its normal or axis. A contact of a beam is a function of the
//! distance of its axis. Over a step from `y₀` to `y₁` the force acts along the secant `n̄`, for which
//! `n̄·(y₁ − y₀) = d(y₁) − d(y₀)` holds exactly: the contact then does as much work as its energy changes.

use super::block;
use super::cone::Cone;
use super::secant::{NO_LENGTH, Secant, Share, across, axis_distance, in_meridian};
use crate::math::{Mat3, Vec3};

/// A shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// The half space under the plane x = 0.
    Plane,
    /// A cylinder about x.
    Cylinder {
        /// m.
        radius: f64,
        /// Half its length, m; what is beyond its ends does not touch it.
        half_length: f64,
        /// Beams touch it from inside: a tube.
        inside: bool,
    },
    /// A sphere.
    Sphere {
        /// m.
        radius: f64,
        /// Beams touch it from inside: a bowl.
        inside: bool,
    },
    /// A wheel about x with a round groove in its rim.
    Sheave {
        /// Radius to the bottom of the groove, m.
        radius: f64,
        /// Radius of the groove itself, m.
        groove: f64,
    },
    /// A wire that is bent to a circle about x.
    Ring {
        /// Radius to the middle of the wire, m.
        radius: f64,
        /// Radius of the wire itself, m.
        wire: f64,
    },
    /// A box with its middle at the origin.
    Box {
        /// Half its extents, m.
        half: Vec3,
    },
    /// A cone about x.
    Cone(Cone),
}

/// Share of the radius of curvature that a point may be inside a convex surface: deeper, it might leave on the other
/// side.
const CORE: f64 = 0.5;
/// How far from its bottom a sheave reaches, in radii of its groove.
const RIM: f64 = 2.0;
impl Shape {
    /// Distance of `y` from the surface, m; negative inside of what is solid; infinite where the surface is not.
    pub fn distance(&self, y: &Vec3) -> f64 {
        match *self {
            Self::Plane => y.x,
            Self::Cylinder { half_length, .. } if y.x.abs() > half_length => f64::INFINITY,
            Self::Cylinder { radius, inside, .. } => outwards(inside) * (axis_distance(y) - radius),
            Self::Sphere { radius, inside } => outwards(inside) * (y.norm() - radius),
            Self::Sheave { radius, groove } => {
                let beyond = axis_distance(y) - (radius + groove);
                if y.x.abs() > RIM * groove || beyond > (RIM - 1.0) * groove {
                    f64::INFINITY
                } else if beyond > 0.0 {
                    groove - y.x.abs()
                } else {
                    groove - (beyond * beyond + y.x * y.x).sqrt()
                }
            }
            Self::Ring { radius, wire } => from_wire(radius, y).norm() - wire,
            Self::Box { half } => block::distance(&half, y),
            Self::Cone(cone) => cone.distance(y),
        }
    }

    /// Whether its distance is made of parts, between which the curvature of the distance jumps.
    pub fn has_parts(&self) -> bool {
        matches!(self, Self::Box { .. } | Self::Cone(_))
    }

    /// A number of the part that is nearest to `y`: a face, an edge or a corner.
    pub fn part(&self, y: &Vec3) -> usize {
        match self {
            Self::Box { half } => block::part(half, y),
            Self::Cone(cone) => cone.part(y),
            _ => 0,
        }
    }

    /// A lower bound of how far `y` is from where the distance is finite and negative, m.
    pub fn least_distance(&self, y: &Vec3) -> f64 {
        match *self {
            Self::Cylinder { radius, half_length, inside } => {
                (outwards(inside) * (axis_distance(y) - radius)).max(y.x.abs() - half_length)
            }
            Self::Sheave { radius, groove } => {
                (axis_distance(y) - (radius + RIM * groove)).max(y.x.abs() - RIM * groove)
            }
            Self::Plane | Self::Sphere { .. } | Self::Ring { .. } | Self::Box { .. } | Self::Cone(_) => {
                self.distance(y)
            }
        }
    }

    /// Unit normal at `y`, towards what touches the surface.
    pub fn normal(&self, y: &Vec3) -> Vec3 {
        self.secant(y, y).direction
    }

    /// Derivative of the normal with respect to the point, 1/m.
    pub fn normal_by_position(&self, y: &Vec3) -> Mat3 {
        // The derivative by one of two equal ends is half of it.
        self.secant(y, y).by_end * 2.0
    }

    /// The direction from `start` to `end`.
    pub fn secant(&self, start: &Vec3, end: &Vec3) -> Secant {
        match *self {
            Self::Plane => Secant::constant(Vec3::x()),
            Self::Cylinder { inside, .. } => {
                let Secant { direction, by_end } = Secant::of_norm(&across(start), &across(end));
                // Along the axis nothing changes.
                let along = Mat3::from_diagonal(&Vec3::new(0.0, 1.0, 1.0));
                Secant { direction: direction * outwards(inside), by_end: by_end * along * outwards(inside) }
            }
            Self::Sphere { inside, .. } => {
                let Secant { direction, by_end } = Secant::of_norm(start, end);
                Secant { direction: direction * outwards(inside), by_end: by_end * outwards(inside) }
            }
            Self::Sheave { radius, groove } => secant_of_groove(radius + groove, start, end),
            Self::Ring { radius, .. } => {
                let inner = Secant::of_norm(&from_wire(radius, start), &from_wire(radius, end));
                Secant::of_meridian(start, end, &inner)
            }
            Self::Box { half } => block::secant(&half, start, end),
            Self::Cone(cone) => cone.secant(start, end),
        }
    }

    /// Whether the way from `start` to `end` leads through the core of what is solid: the point might leave on the
    /// other side, with a force the wrong way.
    pub fn is_run_through(&self, start: &Vec3, end: &Vec3) -> bool {
        let nearest = |start: Vec3, end: Vec3| {
            let way = end - start;
            let share = (-start.dot(&way) / way.norm_squared().max(NO_LENGTH)).clamp(0.0, 1.0);
            (start + way * share).norm()
        };
        match *self {
            Self::Plane => false,
            Self::Cylinder { inside, half_length, .. } if inside || start.x.abs().min(end.x.abs()) > half_length => {
                false
            }
            Self::Cylinder { radius, .. } => nearest(across(start), across(end)) < CORE * radius,
            Self::Sphere { inside: true, .. } => false,
            Self::Sphere { radius, .. } => nearest(*start, *end) < CORE * radius,
            Self::Sheave { radius, groove } => {
                start.x.abs().min(end.x.abs()) < groove && nearest(across(start), across(end)) < CORE * radius
            }
            Self::Ring { radius, wire } => nearest(from_wire(radius, start), from_wire(radius, end)) < CORE * wire,
            Self::Box { half } => block::is_crossed(&(half * CORE), start, end),
            Self::Cone(cone) => cone.is_crossed(CORE, start, end),
        }
    }

    /// How large is what a beam could run through, m: the least radius of curvature of what is convex, half the least
    /// extent of a box, the radius in the middle of a cone; infinite of what has no other side.
    pub fn radius(&self) -> f64 {
        match *self {
            Self::Plane | Self::Cylinder { inside: true, .. } | Self::Sphere { inside: true, .. } => f64::INFINITY,
            Self::Cylinder { radius, .. } | Self::Sphere { radius, .. } | Self::Sheave { radius, .. } => radius,
            Self::Ring { wire, .. } => wire,
            Self::Box { half } => half.min(),
            Self::Cone(cone) => cone.mean_radius(),
        }
    }
}

/// Sign of the distance from the surface by that from its middle.
fn outwards(inside: bool) -> f64 {
    if inside { -1.0 } else { 1.0 }
}

/// The point `y` in the plane through the axis, from the middle of a wire that is bent about it.
fn from_wire(radius: f64, y: &Vec3) -> Vec3 {
    in_meridian(y) - Vec3::y() * radius
}

/// The secant of the distance from a groove whose middle runs at `pitch`: that of the distance from the middle, by the
/// chain of the secants of the distance from the axis and of the distance from the middle of the groove.
fn secant_of_groove(pitch: f64, start: &Vec3, end: &Vec3) -> Secant {
    // Above the middle of the groove its sides are flat.
    let [first, last] = [start, end].map(|y| pitch - axis_distance(y));
    let in_groove = |y: &Vec3, below: f64| Vec3::new(y.x, -below.max(0.0), 0.0);
    let mut inner = Secant::of_norm(&in_groove(start, first), &in_groove(end, last));
    let Share { share, by_end } = Share::over(first, last);
    let slope = Vec3::new(1.0, f64::from(last > 0.0), 0.0);
    inner.by_end *= Mat3::from_diagonal(&slope);
    inner.by_end.row_mut(1).scale_mut(share);
    inner.by_end[(1, 1)] -= inner.direction.y * by_end;
    inner.direction.y *= share;
    let Secant { direction, by_end } = Secant::of_meridian(start, end, &inner);
    Secant { direction: -direction, by_end: -by_end }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Shape; 11] = [
        Shape::Plane,
        Shape::Cylinder { radius: 0.3, half_length: 1.0, inside: false },
        Shape::Cylinder { radius: 0.3, half_length: 1.0, inside: true },
        Shape::Sphere { radius: 0.3, inside: false },
        Shape::Sphere { radius: 0.3, inside: true },
        Shape::Sheave { radius: 0.25, groove: 0.05 },
        Shape::Ring { radius: 0.25, wire: 0.05 },
        // Ways from its faces, edges and corners, and inside of it.
        Shape::Box { half: Vec3::new(0.0062, 0.1, 0.17) },
        Shape::Box { half: Vec3::new(0.5, 0.26, 0.28) },
        Shape::Cone(Cone { radii: [0.3, 0.25], half_length: 0.02 }),
        // Its tip is not far.
        Shape::Cone(Cone { radii: [0.0, 0.5], half_length: 0.5 }),
    ];

    fn pairs() -> impl Iterator<Item = [Vec3; 2]> {
        let starts = [[0.01, 0.24, 0.13], [0.02, -0.2, 0.19], [-0.015, 0.05, -0.27], [0.03, 0.3, 0.04]];
        let ways = [[0.004, 0.02, -0.03], [-0.005, -0.03, 0.01], [0.01, 0.015, 0.02]];
        starts.into_iter().flat_map(move |start| {
            ways.into_iter().map(move |way| [Vec3::from(start), Vec3::from(start) + Vec3::from(way)])
        })
    }

    /// Along the secant a step works as much as the distance changes: to round-off.
    #[test]
    fn secants_are_exact() {
        for shape in SHAPES {
            for [start, end] in pairs() {
                let change = shape.distance(&end) - shape.distance(&start);
                let found = shape.secant(&start, &end).direction.dot(&(end - start));
                assert!((found - change).abs() < 1e-14, "{shape:?} {start:?} {end:?}: {found} {change}");
            }
        }
    }

    /// Derivatives agree with central differences, whose error is the square of their step.
    #[test]
    fn derivatives() {
        let step = 1e-6;
        for shape in SHAPES {
            for [start, end] in pairs() {
                let by_end = shape.secant(&start, &end).by_end;
                for axis in 0..3 {
                    let mut change = Vec3::zeros();
                    change[axis] = step;
                    let [plus, minus] = [end + change, end - change].map(|end| shape.secant(&start, &end).direction);
                    let found: Vec3 = by_end.column(axis).into();
                    let expected = (plus - minus) / (2.0 * step);
                    // Curvatures of curvatures are up to 1/(0.02 m)³.
                    assert!((found - expected).norm() < 1e-6, "{shape:?} {axis}: {found:?} {expected:?}");
                }
            }
        }
    }

    /// The point that is a distance away along the normal lies on the surface: to round-off.
    #[test]
    fn distances_are_those_of_the_nearest_point() {
        for shape in SHAPES {
            for [start, _] in pairs() {
                let normal = shape.normal(&start);
                assert!((normal.norm() - 1.0).abs() < 1e-14, "{shape:?} {start:?}: {normal:?}");
                let foot = start - normal * shape.distance(&start);
                assert!(shape.distance(&foot).abs() < 1e-14, "{shape:?} {start:?}: {foot:?}");
            }
        }
    }

    /// Wires, faces, edges, corners and tips: distances from them by Pythagoras.
    #[test]
    fn corners_are_sharp() {
        let cube = Shape::Box { half: Vec3::new(1.0, 2.0, 3.0) };
        let ring = Shape::Ring { radius: 1.0, wire: 0.1 };
        let tip = Shape::Cone(Cone { radii: [1.0, 0.0], half_length: 2.0 });
        let widening = Shape::Cone(Cone { radii: [1.0, 3.0], half_length: 1.0 });
        for (shape, y, exact) in [
            (ring, [0.3, 0.0, -1.4], 0.4),
            (ring, [0.0, 0.6, 0.8], -0.1),
            (ring, [0.0, 0.0, 0.0], 0.9),
            (cube, [1.5, 1.0, -2.0], 0.5),
            (cube, [1.0 + 3.0, 2.0 + 4.0, 0.0], 5.0),
            (cube, [-1.0 - 2.0, 2.0 + 3.0, -3.0 - 6.0], 7.0),
            (cube, [0.5, 1.7, 0.0], -0.3),
            (tip, [2.5, 0.0, 0.0], 0.5),
            (tip, [2.4, 0.2, -0.2], 0.4_f64.hypot(0.08_f64.sqrt())),
            (tip, [-3.0, 0.6, 0.8], 1.0),
            (tip, [-2.4, 1.3, 0.0], 0.5),
            // Half the radius from the axis, in the middle: on the side.
            (tip, [0.0, 0.3, 0.4], 0.0),
            (tip, [0.0, 0.0, 0.0], -2.0 / 17_f64.sqrt()),
            (widening, [1.5, 2.9, 0.0], 0.5),
            (widening, [1.3, 0.0, 3.4], 0.5),
            (widening, [0.0, 3.0, 0.0], 0.5_f64.sqrt()),
            (widening, [0.9, 0.1, 0.0], -0.1),
        ] {
            let found = shape.distance(&Vec3::from(y));
            assert!((found - exact).abs() < 1e-14, "{shape:?} {y:?}: {found} {exact}");
        }
    }

    /// A point that has passed through the middle of a cylinder is told.
    #[test]
    fn the_core() {
        let shape = SHAPES[1];
        let [start, near, far] = [[0.0, 0.31, 0.0], [0.0, 0.2, 0.0], [0.0, -0.31, 0.1]].map(Vec3::from);
        assert!(!shape.is_run_through(&start, &near));
        assert!(shape.is_run_through(&start, &far));
    }

    /// Ways along and through shapes with two sides; through the hole of a ring there is nothing.
    #[test]
    fn cores_of_rings_boxes_and_cones() {
        let ring = Shape::Ring { radius: 0.3, wire: 0.02 };
        let plate = Shape::Box { half: Vec3::new(0.5, 0.5, 0.01) };
        let cone = Shape::Cone(Cone { radii: [0.2, 0.0], half_length: 0.3 });
        for (shape, start, end, crosses) in [
            (ring, [0.04, 0.3, 0.0], [-0.04, 0.3, 0.005], true),
            (ring, [0.04, 0.3, 0.0], [-0.04, 0.33, 0.0], false),
            (ring, [0.04, 0.1, 0.0], [-0.04, 0.1, 0.0], false),
            (plate, [0.1, 0.2, 0.03], [0.1, 0.2, -0.03], true),
            (plate, [0.1, 0.2, 0.03], [0.3, 0.2, 0.006], false),
            (plate, [0.3, 0.2, 0.03], [0.3, 0.2, -0.03], false),
            (cone, [-0.1, 0.2, 0.0], [-0.1, -0.2, 0.05], true),
            (cone, [-0.1, 0.2, 0.0], [-0.1, 0.1, 0.0], false),
            (cone, [0.4, 0.0, 0.0], [0.0, 0.0, 0.0], true),
            (cone, [0.2, 0.1, 0.0], [0.2, -0.1, 0.0], false),
            // It is thinner there than in its middle, and thicker where the way leaves it.
            (cone, [0.1, 0.2, 0.04], [0.1, -0.2, 0.04], false),
            (cone, [0.1, 0.05, 0.0], [-0.2, 0.06, 0.0], true),
        ] {
            let found = shape.is_run_through(&Vec3::from(start), &Vec3::from(end));
            assert_eq!(found, crosses, "{shape:?} {start:?} {end:?}");
        }
    }
}
