//! Joints: lists of primitive conditions `phi = 0` between two markers (MECHANICS 6). A kind of joint is a file with its list.
//!
//! The rigidity of bodies and the drives are lists of conditions too: whatever holds the machine together is a [`Joint`].

pub mod cylindrical;
pub mod driven;
pub mod inline;
pub mod inplane;
pub mod primitive;
pub mod prismatic;
pub mod revolute;
pub mod spherical;
pub mod universal;
pub mod weld;

use super::configuration::Configuration;
use super::marker::{MARKER, Marker, MarkerMatrix, MarkerVector};
use super::pose::{POSE, PairMatrix, PairVector, Pose, PoseVector};
use crate::math::jet::Jet;
use nalgebra::SMatrix;
use primitive::{MOST_ROWS, Primitive};

/// Most conditions a joint has.
pub const MOST_CONDITIONS: usize = 6;

/// A joint between two markers.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// What it is, and its name in the model file: `joint hinge`.
    pub name: String,
    /// One side.
    pub a: Marker,
    /// The other side.
    pub b: Marker,
    /// The conditions.
    pub primitives: &'static [Primitive],
    /// The drive that prescribes the measure of its only primitive, if one does.
    pub drive: Option<usize>,
}

/// Gradient of a joint's conditions by the coordinates of its two sides, rows in order, 6×24 each; unused rows are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointGradient {
    /// By the coordinates of side a.
    pub a: SMatrix<f64, MOST_CONDITIONS, MARKER>,
    /// By the coordinates of side b.
    pub b: SMatrix<f64, MOST_CONDITIONS, MARKER>,
}

impl Joint {
    /// Number of conditions.
    pub fn rows(&self) -> usize {
        self.primitives.iter().map(|primitive| primitive.rows()).sum()
    }

    /// What its drive prescribes, with its rate and acceleration; nothing: 0.
    fn prescribed(&self, c: &Configuration) -> Jet {
        self.drive.map_or(Jet::constant(0.0), |drive| c.prescribed.drives[drive])
    }

    /// The conditions, zero when they hold; m or 1.
    pub fn phi(&self, c: &Configuration, phi: &mut [f64]) {
        let (a, b) = (self.a.pose(c), self.b.pose(c));
        let prescribed = self.prescribed(c).value;
        let mut row = 0;
        for primitive in self.primitives {
            primitive.phi(&a, &b, prescribed, &mut phi[row..row + primitive.rows()]);
            row += primitive.rows();
        }
    }

    /// Gradients of all rows by the numbers of both poses, in order.
    fn rows_x(&self, a: &Pose, b: &Pose) -> ([PairVector; MOST_CONDITIONS], usize) {
        let mut gradients = [PairVector::zeros(); MOST_CONDITIONS];
        let mut row = 0;
        for primitive in self.primitives {
            for local in 0..primitive.rows() {
                gradients[row] = primitive.phi_x(a, b, local);
                row += 1;
            }
        }
        (gradients, row)
    }

    /// `∂phi/∂q` of both sides.
    pub fn phi_q(&self, c: &Configuration) -> JointGradient {
        let (gradients, rows) = self.rows_x(&self.a.pose(c), &self.b.pose(c));
        let mut gradient = JointGradient { a: SMatrix::zeros(), b: SMatrix::zeros() };
        for (side, (marker, target)) in [(&self.a, &mut gradient.a), (&self.b, &mut gradient.b)].into_iter().enumerate()
        {
            let pose_q = marker.pose_q(c);
            for column in 0..marker.coordinates(c.mesh).len() {
                for (row, phi_x) in gradients[..rows].iter().enumerate() {
                    target[(row, column)] = phi_x.fixed_rows::<POSE>(POSE * side).dot(&pose_q.column(column));
                }
            }
        }
        gradient
    }

    /// Gradient and second derivative of `lambda·phi` by the numbers of both poses.
    fn weighted(&self, a: &Pose, b: &Pose, lambda: &[f64]) -> (PairVector, PairMatrix) {
        let mut hessian = PairMatrix::zeros();
        let mut row = 0;
        for primitive in self.primitives {
            debug_assert!(primitive.rows() <= MOST_ROWS);
            primitive.add_phi_xx(a, b, &lambda[row..row + primitive.rows()], &mut hessian);
            row += primitive.rows();
        }
        (self.force_x(a, b, lambda), hessian)
    }

    fn force_x(&self, a: &Pose, b: &Pose, lambda: &[f64]) -> PairVector {
        let (gradients, rows) = self.rows_x(a, b);
        gradients[..rows].iter().zip(lambda).map(|(gradient, lambda)| gradient * *lambda).sum()
    }

    /// Sets `blocks` to `∂²(lambda·phi)/∂q²`: `aa, ab, ba, bb`, 24×24 each, of which only the rows and columns of the markers' own coordinates are set.
    pub fn phi_qq(&self, c: &Configuration, lambda: &[f64], blocks: &mut [MarkerMatrix; 4]) {
        let (gradient, hessian) = self.weighted(&self.a.pose(c), &self.b.pose(c), lambda);
        pull_back(c, [&self.a, &self.b], &gradient, &hessian, blocks);
    }

    /// `phi''` at an instant without the part of the accelerations, `v·phi_qq·v + 2 phi_qt·v + phi_tt`, row after row.
    pub fn phi_tt(&self, c: &Configuration, velocity: &[f64], phi_tt: &mut [f64]) {
        let (a, b) = (self.a.pose(c), self.b.pose(c));
        let moves = [&self.a, &self.b].map(|marker| {
            let own = own_velocity(c, marker, velocity);
            let [explicit, acceleration] = marker.pose_t(c);
            (own, marker.pose_q(c) * own + explicit.numbers(), acceleration.numbers())
        });
        let mut rate = PairVector::zeros();
        let mut acceleration = PairVector::zeros();
        for (side, (_, first, second)) in moves.iter().enumerate() {
            rate.fixed_rows_mut::<POSE>(POSE * side).copy_from(first);
            acceleration.fixed_rows_mut::<POSE>(POSE * side).copy_from(second);
        }
        let rows = self.rows();
        for (row, phi_tt) in phi_tt.iter_mut().enumerate() {
            let mut unit = [0.0; MOST_CONDITIONS];
            unit[row] = 1.0;
            let (gradient, hessian) = self.weighted(&a, &b, &unit[..rows]);
            *phi_tt = rate.dot(&(hessian * rate)) + gradient.dot(&acceleration) - self.prescribed(c).second;
            for (side, marker) in [&self.a, &self.b].into_iter().enumerate() {
                let own = &moves[side].0;
                let force: PoseVector = gradient.fixed_rows::<POSE>(POSE * side).into_owned();
                *phi_tt += own.dot(&(marker.pose_qq(c, &force) * own));
            }
        }
    }

    /// `∂phi/∂t` at fixed coordinates, row after row.
    pub fn phi_t(&self, c: &Configuration, phi_t: &mut [f64]) {
        let moving = [&self.a, &self.b].map(|marker| marker.pose_t(c)[0].numbers());
        let (gradients, rows) = self.rows_x(&self.a.pose(c), &self.b.pose(c));
        for (phi_t, gradient) in phi_t.iter_mut().zip(&gradients[..rows]) {
            let by_frames: f64 = (0..2).map(|side| gradient.fixed_rows::<POSE>(POSE * side).dot(&moving[side])).sum();
            *phi_t = by_frames - self.prescribed(c).first;
        }
    }

    /// `∂(lambda·phi)/∂X` by the numbers of both poses, 24×1: minus the forces of the joint on them.
    pub fn phi_x(&self, c: &Configuration, lambda: &[f64]) -> PairVector {
        self.force_x(&self.a.pose(c), &self.b.pose(c), lambda)
    }

    /// Whether the sides are as meant, not half-turn relatives of it (MECHANICS 6).
    pub fn is_upright(&self, c: &Configuration) -> bool {
        let (a, b) = (self.a.pose(c), self.b.pose(c));
        self.primitives.iter().all(|primitive| primitive.is_upright(&a, &b))
    }
}

/// The velocities of a marker's own coordinates, padded with zeros.
pub fn own_velocity(c: &Configuration, marker: &Marker, velocity: &[f64]) -> MarkerVector {
    let range = marker.coordinates(c.mesh);
    let mut own = MarkerVector::zeros();
    own.as_mut_slice()[..range.len()].copy_from_slice(&velocity[range]);
    own
}

/// Sets `blocks` to the second derivative by the coordinates of both sides, `aa, ab, ba, bb`, of what has these derivatives by the poses' numbers.
/// Only the rows and columns of the markers' own coordinates are set.
pub fn pull_back(
    c: &Configuration,
    [a, b]: [&Marker; 2],
    gradient: &PairVector,
    hessian: &PairMatrix,
    blocks: &mut [MarkerMatrix; 4],
) {
    let sides = [a, b];
    let gradients = [a.pose_q(c), b.pose_q(c)];
    // Ground and frames have no coordinates.
    let counts = sides.map(|side| side.coordinates(c.mesh).len());
    for (number, product) in blocks.iter_mut().enumerate() {
        let (left, right) = (number / 2, number % 2);
        let block = hessian.fixed_view::<POSE, POSE>(POSE * left, POSE * right);
        // Most conditions do not bend all sides.
        let bends = counts[left] > 0 && block.iter().any(|value| *value != 0.0);
        for column in 0..counts[right] {
            let mut target = product.column_mut(column);
            if !bends {
                target.rows_mut(0, counts[left]).fill(0.0);
                continue;
            }
            let bent: PoseVector = block * gradients[right].column(column);
            for row in 0..counts[left] {
                target[row] = gradients[left].column(row).dot(&bent);
            }
        }
    }
    for (side, marker) in sides.into_iter().enumerate().filter(|(_, marker)| marker.is_of_beam()) {
        let force: PoseVector = gradient.fixed_rows::<POSE>(POSE * side).into_owned();
        let own = marker.pose_qq(c, &force);
        for column in 0..counts[side] {
            let mut target = blocks[3 * side].column_mut(column);
            (0..counts[side]).for_each(|row| target[row] += own[(row, column)]);
        }
    }
}
