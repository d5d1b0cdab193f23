//! Shapes of surfaces: the distance of a point from them, and the direction in which it grows over a step.
//!
//! Points are in the axes of the surface, whose x is along its normal or axis. A contact of a beam is a function of the
//! distance of its axis. Over a step from `y₀` to `y₁` the force acts along the secant `n̄`, for which
//! `n̄·(y₁ − y₀) = d(y₁) − d(y₀)` holds exactly: the contact then does as much work as its energy changes.

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
}

/// Share of the radius of curvature that a point may be inside a convex surface: deeper, it might leave on the other
/// side.
const CORE: f64 = 0.5;
/// How far from its bottom a sheave reaches, in radii of its groove.
const RIM: f64 = 2.0;
/// Lengths, over those of the shape, below which directions are round-off.
const NO_LENGTH: f64 = 1e-300;

/// A direction over a step, and its derivative with respect to the point at the end.
#[derive(Clone, Copy, Debug)]
pub struct Secant {
    /// `n̄`; its length is not 1 where the normal turns over the step.
    pub direction: Vec3,
    /// `∂n̄/∂y₁`, 1/m.
    pub by_end: Mat3,
}

/// `y` without its part along the axis.
fn across(y: &Vec3) -> Vec3 {
    Vec3::new(0.0, y.y, y.z)
}

/// Distance from the axis, m.
fn axis_distance(y: &Vec3) -> f64 {
    (y.y * y.y + y.z * y.z).sqrt()
}

/// The secant of `|y|` over a step between two vectors, and its derivative: `(y₀ + y₁)/(|y₀| + |y₁|)`.
fn secant_of_norm(start: &Vec3, end: &Vec3) -> Secant {
    let (length, sum) = (end.norm().max(NO_LENGTH), (start.norm() + end.norm()).max(NO_LENGTH));
    let direction = (start + end) / sum;
    Secant { direction, by_end: (Mat3::identity() - direction * (end / length).transpose()) / sum }
}

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
            Self::Plane | Self::Sphere { .. } => self.distance(y),
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
            Self::Plane => Secant { direction: Vec3::x(), by_end: Mat3::zeros() },
            Self::Cylinder { inside, .. } => {
                let Secant { direction, by_end } = secant_of_norm(&across(start), &across(end));
                // Along the axis nothing changes.
                let along = Mat3::from_diagonal(&Vec3::new(0.0, 1.0, 1.0));
                Secant { direction: direction * outwards(inside), by_end: by_end * along * outwards(inside) }
            }
            Self::Sphere { inside, .. } => {
                let Secant { direction, by_end } = secant_of_norm(start, end);
                Secant { direction: direction * outwards(inside), by_end: by_end * outwards(inside) }
            }
            Self::Sheave { radius, groove } => secant_of_groove(radius + groove, start, end),
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
        }
    }

    /// The least radius of curvature of what is convex, m; infinite of what is not.
    pub fn radius(&self) -> f64 {
        match *self {
            Self::Plane | Self::Cylinder { inside: true, .. } | Self::Sphere { inside: true, .. } => f64::INFINITY,
            Self::Cylinder { radius, .. } | Self::Sphere { radius, .. } | Self::Sheave { radius, .. } => radius,
        }
    }
}

/// Sign of the distance from the surface by that from its middle.
fn outwards(inside: bool) -> f64 {
    if inside { -1.0 } else { 1.0 }
}

/// The secant of the distance from a groove whose middle runs at `pitch`: that of the distance from the middle, by the
/// chain of the secants of the distance from the axis and of the distance from the middle of the groove.
fn secant_of_groove(pitch: f64, start: &Vec3, end: &Vec3) -> Secant {
    let radial = secant_of_norm(&across(start), &across(end));
    // Above the middle of the groove its sides are flat.
    let in_groove = |y: &Vec3| Vec3::new(y.x, (axis_distance(y) - pitch).min(0.0), 0.0);
    let [first, last] = [in_groove(start), in_groove(end)];
    let Secant { direction: inner, by_end: inner_by_end } = secant_of_norm(&first, &last);
    // Share of the way along the radius that lies below the middle.
    let [below, whole] = [last.y - first.y, axis_distance(end) - axis_distance(start)];
    let share = if whole == 0.0 { f64::from(first.y < 0.0) } else { below / whole };
    let end_radius = axis_distance(end).max(NO_LENGTH);
    let out = across(end) / end_radius;
    let is_below = f64::from(last.y < 0.0);
    let share_by_end = if whole == 0.0 { 0.0 } else { (is_below - share) / whole };
    // Derivatives of `(x, min(ρ − pitch, 0))` at the end.
    let first_row = inner_by_end.column(0) * Vec3::x().transpose();
    let second_row = inner_by_end.column(1) * (out * is_below).transpose();
    let inner_by_place: Mat3 = first_row + second_row;
    let by_radius = inner.y * share;
    let mut by_end = Mat3::zeros();
    by_end.set_row(0, &inner_by_place.row(0));
    by_end += radial.direction * inner_by_place.row(1) * share;
    by_end += radial.direction * out.transpose() * (inner.y * share_by_end);
    by_end += radial.by_end * Mat3::from_diagonal(&Vec3::new(0.0, 1.0, 1.0)) * by_radius;
    Secant { direction: -(Vec3::x() * inner.x + radial.direction * by_radius), by_end: -by_end }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Shape; 6] = [
        Shape::Plane,
        Shape::Cylinder { radius: 0.3, half_length: 1.0, inside: false },
        Shape::Cylinder { radius: 0.3, half_length: 1.0, inside: true },
        Shape::Sphere { radius: 0.3, inside: false },
        Shape::Sphere { radius: 0.3, inside: true },
        Shape::Sheave { radius: 0.25, groove: 0.05 },
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

    /// A point that has passed through the middle of a cylinder is told.
    #[test]
    fn the_core() {
        let shape = SHAPES[1];
        let [start, near, far] = [[0.0, 0.31, 0.0], [0.0, 0.2, 0.0], [0.0, -0.31, 0.1]].map(Vec3::from);
        assert!(!shape.is_run_through(&start, &near));
        assert!(shape.is_run_through(&start, &far));
    }
}
