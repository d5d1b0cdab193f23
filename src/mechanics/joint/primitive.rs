//! What joints are made of: scalar conditions between two markers, with their derivatives by the markers' motion.
//!
//! A condition's gradient is a wrench on each side; its second derivative is a stiffness in `(x_a, φ_a, x_b, φ_b)`.

use crate::math::{Mat3, Vec3};
use crate::mechanics::marker::Pose;
use nalgebra::{SMatrix, SVector};

/// Most rows a primitive has.
pub const MOST_ROWS: usize = 3;

/// Gradient by the motion of both sides: `[x_a, φ_a, x_b, φ_b]`.
pub type Wrenches = SVector<f64, 12>;
/// Second derivative by the motion of both sides, 12×12.
pub type RelativeStiffness = SMatrix<f64, 12, 12>;

/// A condition between the frames of a joint's two sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Primitive {
    /// The places are one: `x_a − x_b = 0`, 3 rows, m.
    Coincident,
    /// Axis `0` of a and axis `1` of b are perpendicular: `T_a[0]·T_b[1] = 0`, 1 row.
    Perpendicular(usize, usize),
}

impl Primitive {
    /// Number of rows.
    pub fn rows(self) -> usize {
        match self {
            Self::Coincident => 3,
            Self::Perpendicular(..) => 1,
        }
    }

    /// The conditions, zero when they hold.
    pub fn phi(self, a: &Pose, b: &Pose, phi: &mut [f64]) {
        match self {
            Self::Coincident => phi.copy_from_slice((a.place - b.place).as_slice()),
            Self::Perpendicular(i, j) => phi[0] = a.axes.column(i).dot(&b.axes.column(j)),
        }
    }

    /// Gradient of row `row` by the motion of both sides.
    pub fn phi_motion(self, a: &Pose, b: &Pose, row: usize) -> Wrenches {
        let mut sum = Wrenches::zeros();
        match self {
            Self::Coincident => {
                sum[row] = 1.0;
                sum[6 + row] = -1.0;
            }
            Self::Perpendicular(i, j) => {
                let turn = axis(a, i).cross(&axis(b, j));
                sum.fixed_rows_mut::<3>(3).copy_from(&turn);
                sum.fixed_rows_mut::<3>(9).copy_from(&-turn);
            }
        }
        sum
    }

    /// Adds the derivative of the gradient of `Σ lambda·phi` by the motion of both sides, wrenches seen in space.
    pub fn add_stiffness(self, a: &Pose, b: &Pose, lambda: &[f64], sum: &mut RelativeStiffness) {
        match self {
            Self::Coincident => {}
            Self::Perpendicular(i, j) => {
                let (axis_a, axis_b) = (axis(a, i), axis(b, j));
                let cosine = Mat3::identity() * axis_a.dot(&axis_b);
                // d(a × b) = (a bᵀ − a·b) dφ_a + (a·b − b aᵀ) dφ_b.
                let by_a = (axis_a * axis_b.transpose() - cosine) * lambda[0];
                let by_b = (cosine - axis_b * axis_a.transpose()) * lambda[0];
                for (row, sign) in [(3, 1.0), (9, -1.0)] {
                    let mut view = sum.fixed_view_mut::<3, 3>(row, 3);
                    view += by_a * sign;
                    let mut view = sum.fixed_view_mut::<3, 3>(row, 9);
                    view += by_b * sign;
                }
            }
        }
    }
}

fn axis(pose: &Pose, number: usize) -> Vec3 {
    pose.axes.column(number).into_owned()
}
