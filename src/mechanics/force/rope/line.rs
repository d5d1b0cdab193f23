//! The straight line of a rope between two wheels (MECHANICS 3.15): where it leaves the first one, where it reaches the
//! second one, how long it is, and how all that changes with the wheels.
//!
//! A wheel has a center, two axes `e`, `f` across its own axis, a radius `ρ` and a turn `σ`: 1 where the rope runs
//! right-handed about its axis, −1 otherwise. The rope leaves or reaches it at the angle `φ`, in the direction
//! `r = e cos φ + f sin φ`. A point is a wheel with `ρ = 0`. The two angles follow from
//! `(Q − P)·r_a = 0` and `(Q − P)·r_b = 0`, which hold in a plane and with a fleet angle alike.
//!
//! Everything depends on nine scalar products of the vectors of both poses, [`Products`]. The reach is
//! `m = |Q − P| + ρ_a σ_a φ_a − ρ_b σ_b φ_b`: the length of rope between the marks `φ = 0` of both wheels.

use crate::math::elementary::{acos, atan2, cos, hypot, sin};
use crate::mechanics::geometry::pose::{PLACE, Pose, VECTORS, axis_vector};
use crate::mechanics::geometry::pose_pair::{PairHessian, PairVector};
use nalgebra::{Matrix2, SMatrix, SVector, Vector2};

/// Scalar products that a line depends on: `d·d`, `d·e_a`, `d·f_a`, `d·e_b`, `d·f_b`, `e_a·e_b`, `e_a·f_b`, `f_a·e_b`,
/// `f_a·f_b`, where `d` points from the center of a to that of b.
pub const PRODUCTS: usize = 9;
/// A number for each scalar product.
pub type Products = SVector<f64, PRODUCTS>;
/// Second derivatives by the scalar products.
pub type ProductsHessian = SMatrix<f64, PRODUCTS, PRODUCTS>;

/// Alternating steps from one wheel to the other before Newton's iteration begins.
const ALTERNATING: usize = 3;
/// Most iterations of Newton: it converges in two or three from there.
const MOST_ITERATIONS: usize = 20;
/// Change of the angles, rad, that ends the iteration: the next one would be round-off.
const CONVERGED: f64 = 1e-9;

/// A wheel as a rope sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// Radius of the axis of the rope, m; 0: a point.
    pub radius: f64,
    /// 1: the rope runs right-handed about the axis; -1: left-handed.
    pub turn: f64,
}

impl Wheel {
    /// A point.
    pub const POINT: Self = Self { radius: 0.0, turn: 1.0 };

    /// Radius with the sign of the turn, m.
    pub fn signed(&self) -> f64 {
        self.radius * self.turn
    }
}

/// A line, and its derivatives by the scalar products.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Length, m.
    pub length: f64,
    /// Angles at which it leaves a and reaches b, rad, -pi to pi about both directions of the axes as drawn.
    pub angles: [f64; 2],
    /// `∂m/∂y`.
    pub reach_by: Products,
    /// `∂φ/∂y`.
    pub angles_by: [Products; 2],
    /// How second derivatives follow.
    curvature: Curvature,
}

/// The second derivative `∂²m/∂y²` in parts.
#[derive(Clone, Copy, Debug)]
struct Curvature {
    /// `V` of `V Φ + Φᵀ Vᵀ + Φᵀ W Φ − w D Dᵀ`, where `Φ = ∂φ/∂y`.
    by_both: [Products; 2],
    by_angles: Matrix2<f64>,
    along: Products,
    weight: f64,
}

/// `g₀ d·d + g_a d·r_a + g_b d·r_b + g_k r_a·r_b + constant`: what lengths and conditions are made of.
#[derive(Clone, Copy, Debug)]
struct Form {
    square: f64,
    by_a: f64,
    by_b: f64,
    both: f64,
    constant: f64,
}

/// Cosine and sine of both angles.
type Turned = [(f64, f64); 2];

impl Form {
    fn scaled(&self, factor: f64) -> Self {
        Self {
            square: self.square * factor,
            by_a: self.by_a * factor,
            by_b: self.by_b * factor,
            both: self.both * factor,
            constant: self.constant * factor,
        }
    }

    fn minus(&self, other: &Self) -> Self {
        Self {
            square: self.square - other.square,
            by_a: self.by_a - other.by_a,
            by_b: self.by_b - other.by_b,
            both: self.both - other.both,
            constant: self.constant - other.constant,
        }
    }

    /// The coefficients of the products, where each pair is a direction or its derivative: linear in both.
    fn coefficients(&self, square: f64, a: Option<(f64, f64)>, b: Option<(f64, f64)>, ab: Turned) -> Products {
        let [(ca, sa), (cb, sb)] = ab;
        let (by_a, by_b) = (a.unwrap_or((0.0, 0.0)), b.unwrap_or((0.0, 0.0)));
        let k = self.both;
        Products::from([
            self.square * square,
            self.by_a * by_a.0,
            self.by_a * by_a.1,
            self.by_b * by_b.0,
            self.by_b * by_b.1,
            k * ca * cb,
            k * ca * sb,
            k * sa * cb,
            k * sa * sb,
        ])
    }

    /// `∂G/∂y`.
    fn by_products(&self, [a, b]: Turned) -> Products {
        self.coefficients(1.0, Some(a), Some(b), [a, b])
    }

    /// `∂²G/∂y∂φ`, for both angles.
    fn by_both(&self, [a, b]: Turned) -> [Products; 2] {
        let [ta, tb] = [a, b].map(|(c, s)| (-s, c));
        [self.coefficients(0.0, Some(ta), None, [ta, b]), self.coefficients(0.0, None, Some(tb), [a, tb])]
    }

    fn value(&self, y: &Products, at: Turned) -> f64 {
        self.by_products(at).dot(y) + self.constant
    }

    /// `∂G/∂φ`.
    fn by_angles(&self, y: &Products, at: Turned) -> Vector2<f64> {
        let [a, b] = self.by_both(at);
        Vector2::new(a.dot(y), b.dot(y))
    }

    /// `∂²G/∂φ²`.
    fn by_angles_twice(&self, y: &Products, [a, b]: Turned) -> Matrix2<f64> {
        let back = |(c, s): (f64, f64)| (-c, -s);
        let across = |(c, s): (f64, f64)| (-s, c);
        let aa = self.coefficients(0.0, Some(back(a)), None, [back(a), b]).dot(y);
        let bb = self.coefficients(0.0, None, Some(back(b)), [a, back(b)]).dot(y);
        let ab = self.coefficients(0.0, None, None, [across(a), across(b)]).dot(y);
        Matrix2::new(aa, ab, ab, bb)
    }
}

/// `|Q − P|²`, and the conditions of both wheels.
fn forms([a, b]: [f64; 2]) -> (Form, [Form; 2]) {
    let square = Form { square: 1.0, by_a: -2.0 * a, by_b: 2.0 * b, both: -2.0 * a * b, constant: a * a + b * b };
    let leaves = Form { square: 0.0, by_a: 1.0, by_b: 0.0, both: b, constant: -a };
    let reaches = Form { square: 0.0, by_a: 0.0, by_b: 1.0, both: -a, constant: b };
    (square, [leaves, reaches])
}

/// The scalar products of two poses, whose first axes are those of the wheels.
pub fn products(a: &Pose, b: &Pose) -> Products {
    let d = b.place - a.place;
    let [ea, fa, eb, fb] = [a.axis(1), a.axis(2), b.axis(1), b.axis(2)];
    Products::from([
        d.dot(&d),
        d.dot(&ea),
        d.dot(&fa),
        d.dot(&eb),
        d.dot(&fb),
        ea.dot(&eb),
        ea.dot(&fb),
        fa.dot(&eb),
        fa.dot(&fb),
    ])
}

/// The two vectors of each scalar product of axes, and the axis of each of those with `d`: their places among the
/// vectors of a pair of poses.
const WITH_D: [usize; 4] = [axis_vector(1), axis_vector(2), VECTORS + axis_vector(1), VECTORS + axis_vector(2)];
const OF_AXES: [[usize; 2]; 4] = [
    [axis_vector(1), VECTORS + axis_vector(1)],
    [axis_vector(1), VECTORS + axis_vector(2)],
    [axis_vector(2), VECTORS + axis_vector(1)],
    [axis_vector(2), VECTORS + axis_vector(2)],
];

/// The derivative of `weights · y` by the vectors of both poses.
pub fn by_poses(a: &Pose, b: &Pose, weights: &Products) -> PairVector {
    let vector = |place: usize| {
        let pose = if place < VECTORS { a } else { b };
        pose.axis(place % VECTORS - axis_vector(0))
    };
    let d = b.place - a.place;
    let mut sum = PairVector::zeros();
    let mut by_d = d * (2.0 * weights[0]);
    for (place, weight) in WITH_D.into_iter().zip(&weights.as_slice()[1..5]) {
        by_d += vector(place) * *weight;
        let mut column = sum.column_mut(place);
        column += d * *weight;
    }
    for ([one, other], weight) in OF_AXES.into_iter().zip(&weights.as_slice()[5..]) {
        let (first, second) = (vector(one), vector(other));
        let mut column = sum.column_mut(one);
        column += second * *weight;
        let mut column = sum.column_mut(other);
        column += first * *weight;
    }
    sum.set_column(PLACE, &-by_d);
    sum.set_column(VECTORS + PLACE, &by_d);
    sum
}

/// The second derivative of `weights · y` by the vectors of both poses.
pub fn by_poses_twice(weights: &Products) -> PairHessian {
    let mut sum = PairHessian::default();
    for (one, other, sign) in
        [(PLACE, PLACE, 1.0), (VECTORS + PLACE, VECTORS + PLACE, 1.0), (PLACE, VECTORS + PLACE, -1.0)]
    {
        sum.add_product(one, other, 2.0 * sign * weights[0]);
    }
    for (place, weight) in WITH_D.into_iter().zip(&weights.as_slice()[1..5]) {
        sum.add_product(PLACE, place, -weight);
        sum.add_product(VECTORS + PLACE, place, *weight);
    }
    for ([one, other], weight) in OF_AXES.into_iter().zip(&weights.as_slice()[5..]) {
        sum.add_product(one, other, *weight);
    }
    sum
}

/// Length of the line between two wheels, m, and its angles, rad.
pub fn stretched(wheels: [Wheel; 2], y: &Products) -> Option<(f64, [f64; 2])> {
    let (square, conditions) = forms(wheels.map(|wheel| wheel.radius));
    let angles = angles(wheels, &conditions, y)?;
    let length_square = square.value(y, angles.map(|angle| (cos(angle), sin(angle))));
    (length_square > 0.0).then(|| (length_square.sqrt(), angles))
}

impl Line {
    /// The line between two wheels whose scalar products are `y`; none: one of them is inside the other, or a center is
    /// on the line.
    pub fn between(wheels: [Wheel; 2], y: &Products) -> Option<Self> {
        let radii = wheels.map(|wheel| wheel.radius);
        let (square, conditions) = forms(radii);
        let angles = angles(wheels, &conditions, y)?;
        let at = angles.map(|angle| (cos(angle), sin(angle)));
        let length_square = square.value(y, at);
        // Not-a-number must fail.
        let length = (length_square > 0.0).then(|| length_square.sqrt())?;
        let (inverse, conditions_by) = condition_tangent(&conditions, radii, y, at)?;
        let angles_by =
            [0, 1].map(|row| -(conditions_by[0] * inverse[(row, 0)] + conditions_by[1] * inverse[(row, 1)]));
        let along_angles = square.by_angles(y, at);
        let reach_by_angles = along_angles / (2.0 * length) + Vector2::new(wheels[0].signed(), -wheels[1].signed());
        // Multipliers of the conditions: the reach is stationary with them.
        let multipliers = inverse.tr_mul(&reach_by_angles);
        let held = Form {
            square: 0.0,
            by_a: multipliers[0] * conditions[0].by_a,
            by_b: multipliers[1] * conditions[1].by_b,
            both: multipliers[0] * conditions[0].both + multipliers[1] * conditions[1].both,
            constant: 0.0,
        };
        let square_by = square.by_products(at);
        let whole = square.scaled(0.5 / length).minus(&held);
        let curvature = Curvature {
            by_both: whole.by_both(at),
            by_angles: whole.by_angles_twice(y, at),
            along: square_by + angles_by[0] * along_angles[0] + angles_by[1] * along_angles[1],
            weight: 0.25 / (length * length_square),
        };
        Some(Self { length, angles, reach_by: whole.by_products(at), angles_by, curvature })
    }

    /// `∂²m/∂y²`.
    pub fn reach_by_twice(&self) -> ProductsHessian {
        let Curvature { by_both, by_angles, along, weight } = &self.curvature;
        let mut sum = along * along.transpose() * -*weight;
        for (row, (by, own)) in by_both.iter().zip(&self.angles_by).enumerate() {
            let half =
                by + self.angles_by[0] * (0.5 * by_angles[(row, 0)]) + self.angles_by[1] * (0.5 * by_angles[(row, 1)]);
            sum += half * own.transpose() + own * half.transpose();
        }
        sum
    }
}

/// The inverse of the derivative of both conditions by both angles, and their derivatives by the scalar products; the
/// condition of a point is that its angle is 0.
fn condition_tangent(
    conditions: &[Form; 2],
    radii: [f64; 2],
    y: &Products,
    at: Turned,
) -> Option<(Matrix2<f64>, [Products; 2])> {
    let mut tangent = Matrix2::identity();
    let mut by = [Products::zeros(); 2];
    for row in 0..2 {
        if radii[row] > 0.0 {
            tangent.set_row(row, &conditions[row].by_angles(y, at).transpose());
            by[row] = conditions[row].by_products(at);
        }
    }
    // The angle of a point has no part in the condition of a wheel: its radius is 0 there.
    Some((tangent.try_inverse()?, by))
}

/// The angles at which the line leaves a and reaches b.
fn angles(wheels: [Wheel; 2], conditions: &[Form; 2], y: &Products) -> Option<[f64; 2]> {
    let [a, b] = wheels;
    let [mut leaving, mut reaching] = [0.0_f64; 2];
    // Each wheel sees the other one's point: the branch is that of the turn.
    let mut radius_seen = 0.0;
    for _ in 0..ALTERNATING {
        if a.radius > 0.0 {
            let (c, s) = (radius_seen * cos(reaching), radius_seen * sin(reaching));
            let seen = [y[1] + y[5] * c + y[6] * s, y[2] + y[7] * c + y[8] * s];
            leaving = atan2(seen[1], seen[0]) - a.turn * half_angle(a.radius, seen)?;
        }
        if b.radius > 0.0 {
            let (c, s) = (a.radius * cos(leaving), a.radius * sin(leaving));
            let seen = [-y[3] + y[5] * c + y[7] * s, -y[4] + y[6] * c + y[8] * s];
            reaching = atan2(seen[1], seen[0]) + b.turn * half_angle(b.radius, seen)?;
        }
        radius_seen = b.radius;
    }
    let radii = [a.radius, b.radius];
    if radii == [0.0; 2] {
        return Some([0.0; 2]);
    }
    for _ in 0..MOST_ITERATIONS {
        let at = [leaving, reaching].map(|angle: f64| (cos(angle), sin(angle)));
        let (inverse, _) = condition_tangent(conditions, radii, y, at)?;
        let left = [0, 1].map(|row| if radii[row] > 0.0 { conditions[row].value(y, at) } else { 0.0 });
        let change = inverse * Vector2::from(left);
        leaving -= change[0];
        reaching -= change[1];
        if change.amax() < CONVERGED {
            return Some([leaving, reaching]);
        }
    }
    None
}

/// Half the angle under which both tangents to a wheel from a point touch it, rad; none: the point is inside.
fn half_angle(radius: f64, seen: [f64; 2]) -> Option<f64> {
    let distance = hypot(seen[0], seen[1]);
    (distance > radius).then(|| acos(radius / distance))
}
