//! How the vectors of a pose move with the coordinates of its marker, and the way back: derivatives by poses as
//! derivatives by coordinates.
//!
//! A pose on a body is linear in the body's coordinates. One on a beam moves with its place and turns:
//! `dX = dx + dφ × arm` for the place, `dφ × axis` for an axis.

use super::Marker;
use crate::math::{Mat3, Vec3};
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerMatrix, MarkerVector};
use crate::mechanics::geometry::pose::{PLACE, PoseVector, VECTORS};
use crate::mechanics::geometry::pose_pair::{PairHessian, PairVector};
use crate::mechanics::marker::configuration::Configuration;
use nalgebra::SMatrix;
use std::ops::Range;

/// Derivatives of the vectors of a pose by the coordinates of its marker.
#[expect(clippy::large_enum_variant, reason = "it lives on the stack of one function")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PoseGradient {
    /// On the ground or on a moving frame: there are no coordinates.
    Fixed,
    /// On a body, whose own vectors the columns of these factors sum up.
    Body(SMatrix<f64, VECTORS, VECTORS>),
    /// On a beam.
    Beam(Turning),
}

/// How a pose on a beam moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning {
    /// What turns: the arm from the point that `place_q` moves to the place, m, and the axes.
    pub arms: PoseVector,
    /// `∂x/∂q`, 3×24.
    pub place_q: ByCoordinates,
    /// `∂φ/∂q`, 3×24, rad.
    pub turn_q: ByCoordinates,
    /// Number of coordinates; those that move the point come first.
    pub count: usize,
    /// Number of coordinates that move the point.
    pub placing: usize,
    /// The first coordinate that turns.
    pub turning: usize,
}

impl Turning {
    /// The turn by the coordinate `column`.
    fn turn(&self, column: usize) -> Vec3 {
        self.turn_q.column(column).into_owned()
    }

    /// `Σ arm × force`.
    fn moment(&self, force: &PoseVector) -> Vec3 {
        let of = |number: usize| Vec3::from(self.arms.data.0[number]).cross(&Vec3::from(force.data.0[number]));
        of(0) + of(1) + of(2) + of(3)
    }

    /// `turn × arm` for all arms.
    fn turned(&self, turn: &Vec3) -> PoseVector {
        let mut sum = PoseVector::zeros();
        (0..VECTORS).for_each(|number| sum.set_column(number, &turn.cross(&self.arms.column(number))));
        sum
    }

    /// The columns of the gradient that turn.
    fn turns(&self) -> Range<usize> {
        self.turning..self.count
    }
}

impl PoseGradient {
    /// Number of coordinates.
    pub fn count(&self) -> usize {
        match self {
            Self::Fixed => 0,
            Self::Body(_) => BODY,
            Self::Beam(beam) => beam.count,
        }
    }

    /// By the coordinate `number`.
    pub fn column(&self, number: usize) -> PoseVector {
        let mut sum = PoseVector::zeros();
        match self {
            Self::Fixed => {}
            Self::Body(factors) => sum.set_row(number % 3, &factors.row(number / 3)),
            Self::Beam(beam) => {
                if number >= beam.turning {
                    sum = beam.turned(&beam.turn(number));
                }
                if number < beam.placing {
                    let mut place = sum.column_mut(PLACE);
                    place += beam.place_q.column(number);
                }
            }
        }
        sum
    }

    /// The change of the pose when coordinates change by `change`.
    pub fn times(&self, change: &MarkerVector) -> PoseVector {
        match self {
            Self::Fixed => PoseVector::zeros(),
            Self::Body(factors) => PoseVector::from_column_slice(&change.as_slice()[..BODY]) * factors,
            Self::Beam(beam) => {
                let mut sum = beam.turned(&(beam.turn_q * change));
                let mut place = sum.column_mut(PLACE);
                place += beam.place_q * change;
                sum
            }
        }
    }

    /// Gives to `put`, for each coordinate, the generalized force of forces on the vectors of the pose.
    #[inline]
    pub fn pull_back(&self, force: &PoseVector, mut put: impl FnMut(usize, f64)) {
        match self {
            Self::Fixed => {}
            Self::Body(factors) => {
                let ([first, second, third, fourth], [a, b, c, d]) = (&force.data.0, &factors.data.0);
                for vector in 0..VECTORS {
                    let [a, b, c, d] = [a[vector], b[vector], c[vector], d[vector]];
                    for axis in 0..3 {
                        let value = first[axis] * a + second[axis] * b + third[axis] * c + fourth[axis] * d;
                        put(3 * vector + axis, value);
                    }
                }
            }
            Self::Beam(beam) => {
                let (place, moment) = (force.data.0[PLACE], beam.moment(force));
                let dot = |a: &[f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
                for (number, (place_q, turn_q)) in beam.place_q.data.0.iter().zip(&beam.turn_q.data.0).enumerate() {
                    if number == beam.count {
                        break;
                    }
                    let by_place = if number < beam.placing { dot(place_q, place) } else { 0.0 };
                    let by_turn = if number < beam.turning { 0.0 } else { dot(turn_q, moment.data.0[0]) };
                    put(number, by_place + by_turn);
                }
            }
        }
    }

    /// [`Self::pull_back`] as a vector.
    pub fn generalized(&self, force: &PoseVector) -> MarkerVector {
        let mut sum = MarkerVector::zeros();
        self.pull_back(force, |number, value| sum[number] = value);
        sum
    }

    /// Sets `block` to the second derivative by the coordinates of this pose (rows) and of `other` (columns) of what
    /// has the second derivatives `scalars` times the identity by their vectors.
    fn pull_back_scalars(&self, scalars: &SMatrix<f64, VECTORS, VECTORS>, other: &Self, block: &mut MarkerMatrix) {
        let is_zero = scalars.as_slice().iter().all(|value| *value == 0.0);
        let mut clear =
            || (0..other.count()).for_each(|column| block.column_mut(column).rows_mut(0, self.count()).fill(0.0));
        match (self, other) {
            (Self::Fixed, _) | (_, Self::Fixed) => {}
            _ if is_zero => clear(),
            (Self::Body(left), Self::Body(right)) => {
                clear();
                let own = left * scalars * right.transpose();
                for (row, column, axis) in
                    (0..BODY).flat_map(|row| (0..VECTORS).map(move |column| (row / 3, column, row % 3)))
                {
                    block[(3 * row + axis, 3 * column + axis)] = own[(row, column)];
                }
            }
            // Whole rows: a body takes a force for less than a beam does.
            (Self::Beam(_), Self::Body(_)) => {
                for row in 0..self.count() {
                    let force: PoseVector = self.column(row) * scalars;
                    other.pull_back(&force, |column, value| block[(row, column)] = value);
                }
            }
            (_, Self::Beam(_)) => {
                let transposed = scalars.transpose();
                for column in 0..other.count() {
                    let force: PoseVector = other.column(column) * transposed;
                    self.pull_back(&force, |row, value| block[(row, column)] = value);
                }
            }
        }
    }

    /// Adds `∂(pose_qᵀ f)/∂q` of frozen forces on the vectors of the pose, the pose of `marker`: where it turns, it
    /// bends.
    pub fn add_bend(&self, marker: &Marker, c: &Configuration, force: &PoseVector, block: &mut MarkerMatrix) {
        let Self::Beam(beam) = self else { return };
        if beam.turns().is_empty() {
            return;
        }
        // The arms turn: d(a × f) = (dφ × a) × f = (a fᵀ − (a·f) I) dφ.
        let turning: Mat3 = beam.arms * force.transpose() - Mat3::identity() * beam.arms.dot(force);
        for column in beam.turns() {
            let right = turning * beam.turn(column);
            for row in beam.turns() {
                block[(row, column)] += beam.turn_q.column(row).dot(&right);
            }
        }
        marker.add_moment_stiffness(c, &beam.moment(force), block);
    }

    /// Second derivative of the vectors of the pose, the pose of `marker`, by time when coordinates change at the
    /// constant rates `velocity`.
    pub fn convective(&self, marker: &Marker, c: &Configuration, velocity: &MarkerVector) -> PoseVector {
        let Self::Beam(beam) = self else { return PoseVector::zeros() };
        let spin: Vec3 = beam.turn_q * velocity;
        // d(∂φ/∂q)/dt v, from the work of a moment along each axis.
        let spin_t = Vec3::from_fn(|axis, _| {
            let (mut stiffness, mut unit) = (MarkerMatrix::zeros(), Vec3::zeros());
            unit[axis] = 1.0;
            marker.add_moment_stiffness(c, &unit, &mut stiffness);
            velocity.dot(&(stiffness * velocity))
        });
        let mut sum = beam.turned(&spin_t);
        let turned = beam.turned(&spin);
        for number in 0..VECTORS {
            let mut column = sum.column_mut(number);
            column += spin.cross(&turned.column(number));
        }
        sum
    }
}

/// The part of `pair` that belongs to one side: 0 or 1.
pub fn of_side(pair: &PairVector, side: usize) -> PoseVector {
    pair.fixed_columns::<VECTORS>(VECTORS * side).into_owned()
}

/// Sets `blocks` to the second derivative by the coordinates of both sides, `aa, ab, ba, bb`, of what has these
/// derivatives by the vectors of their poses, which move as `sides` say. Only the rows and columns of the markers' own
/// coordinates are set.
pub fn pull_back(
    c: &Configuration,
    markers: [&Marker; 2],
    sides: &[PoseGradient; 2],
    gradient: &PairVector,
    hessian: &PairHessian,
    blocks: &mut [MarkerMatrix; 4],
) {
    let counts = sides.each_ref().map(PoseGradient::count);
    for (place, left, right) in [(0, 0, 0), (1, 0, 1), (3, 1, 1)] {
        let scalars = hessian.scalars.fixed_view::<VECTORS, VECTORS>(VECTORS * left, VECTORS * right);
        sides[left].pull_back_scalars(&scalars.into_owned(), &sides[right], &mut blocks[place]);
    }
    for (side, marker) in markers.into_iter().enumerate() {
        sides[side].add_bend(marker, c, &of_side(gradient, side), &mut blocks[3 * side]);
    }
    let [_, ab, ba, _] = blocks;
    for row in 0..counts[0] {
        for column in 0..counts[1] {
            ba[(column, row)] = ab[(row, column)];
        }
    }
    if hessian.has_products() {
        let [first, both, second] = hessian.weights;
        let generalized = |vector, side: usize| sides[side].generalized(&of_side(vector, side));
        let [one, other] = &hessian.vectors;
        let vectors = [[generalized(one, 0), generalized(one, 1)], [generalized(other, 0), generalized(other, 1)]];
        for (number, block) in blocks.iter_mut().enumerate() {
            let (left, right) = (number / 2, number % 2);
            for column in 0..counts[right] {
                let by = [vectors[0][right][column], vectors[1][right][column]];
                let by = [first * by[0] + both * by[1], both * by[0] + second * by[1]];
                for row in 0..counts[left] {
                    block[(row, column)] += vectors[0][left][row] * by[0] + vectors[1][left][row] * by[1];
                }
            }
        }
    }
}
