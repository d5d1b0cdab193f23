//! Joints: lists of primitive conditions `phi = 0` between two markers (MECHANICS 6). A kind of joint is a file with its list.

pub mod primitive;
pub mod revolute;
pub mod spherical;
pub mod weld;

use super::marker::{Configuration, MARKER, Marker, MarkerMatrix};
use nalgebra::SMatrix;
use primitive::{MOST_ROWS, Primitive, RelativeStiffness, Wrenches};

/// Most conditions a joint has.
pub const MOST_CONDITIONS: usize = 6;

/// A joint between two markers.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name in the model file.
    pub name: String,
    /// One side.
    pub a: Marker,
    /// The other side.
    pub b: Marker,
    /// The conditions.
    pub primitives: &'static [Primitive],
}

/// Gradient of a joint's conditions by the coordinates of its two sides, rows in order, 6×14 each; unused rows are zero.
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

    /// The conditions, zero when they hold; m or 1.
    pub fn phi(&self, c: &Configuration, phi: &mut [f64]) {
        let (a, b) = (self.a.pose(c), self.b.pose(c));
        let mut row = 0;
        for primitive in self.primitives {
            primitive.phi(&a, &b, &mut phi[row..row + primitive.rows()]);
            row += primitive.rows();
        }
    }

    /// `∂phi/∂q` of both sides.
    pub fn phi_q(&self, c: &Configuration) -> JointGradient {
        let (a, b) = (self.a.pose(c), self.b.pose(c));
        let (motion_a, motion_b) = (self.a.motion(c), self.b.motion(c));
        let mut gradient = JointGradient { a: SMatrix::zeros(), b: SMatrix::zeros() };
        let mut row = 0;
        for primitive in self.primitives {
            for local in 0..primitive.rows() {
                let wrench = primitive.phi_motion(&a, &b, local);
                let by_a = motion_a.place_q.tr_mul(&wrench.fixed_rows::<3>(0))
                    + motion_a.turn_q.tr_mul(&wrench.fixed_rows::<3>(3));
                let by_b = motion_b.place_q.tr_mul(&wrench.fixed_rows::<3>(6))
                    + motion_b.turn_q.tr_mul(&wrench.fixed_rows::<3>(9));
                gradient.a.set_row(row, &by_a.transpose());
                gradient.b.set_row(row, &by_b.transpose());
                row += 1;
            }
        }
        gradient
    }

    /// `∂²(lambda·phi)/∂q²` as the blocks `aa, ab, ba, bb`, 14×14 each.
    pub fn phi_qq(&self, c: &Configuration, lambda: &[f64]) -> [MarkerMatrix; 4] {
        let (a, b) = (self.a.pose(c), self.b.pose(c));
        let (motion_a, motion_b) = (self.a.motion(c), self.b.motion(c));
        let mut wrench = Wrenches::zeros();
        let mut stiffness = RelativeStiffness::zeros();
        let mut row = 0;
        for primitive in self.primitives {
            debug_assert!(primitive.rows() <= MOST_ROWS);
            let own = &lambda[row..row + primitive.rows()];
            for (local, factor) in own.iter().enumerate() {
                wrench += primitive.phi_motion(&a, &b, local) * *factor;
            }
            primitive.add_stiffness(&a, &b, own, &mut stiffness);
            row += primitive.rows();
        }
        let part = |start: usize| wrench.fixed_rows::<3>(start).into_owned();
        let own_a = self.a.wrench_stiffness(c, &part(0), &part(3));
        let own_b = self.b.wrench_stiffness(c, &part(6), &part(9));
        let stack = |motion: &super::marker::Motion| {
            let mut stacked = SMatrix::<f64, 6, MARKER>::zeros();
            stacked.fixed_rows_mut::<3>(0).copy_from(&motion.place_q);
            stacked.fixed_rows_mut::<3>(3).copy_from(&motion.turn_q);
            stacked
        };
        let (moves_a, moves_b) = (stack(&motion_a), stack(&motion_b));
        let block = |row: usize, column: usize| stiffness.fixed_view::<6, 6>(row, column).into_owned();
        [
            moves_a.tr_mul(&(block(0, 0) * moves_a)) + own_a,
            moves_a.tr_mul(&(block(0, 6) * moves_b)),
            moves_b.tr_mul(&(block(6, 0) * moves_a)),
            moves_b.tr_mul(&(block(6, 6) * moves_b)) + own_b,
        ]
    }
}
