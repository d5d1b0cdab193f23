//! What joints are made of: scalar conditions between two poses, with their derivatives by the poses' vectors.
//!
//! All but angles are bilinear in the two poses. Conditions by products of axes hold at half-turn relatives of what is
//! meant too; `is_upright` tells them apart (MECHANICS 6).

use crate::mechanics::geometry::pose::{PLACE, Pose, VECTORS, axis_vector};
use crate::mechanics::geometry::pose_pair::{PairHessian, PairVector};
use crate::mechanics::marker::relative_coordinate::{Measure, near};

/// Most rows a primitive has.
pub const MOST_ROWS: usize = 3;

/// A condition between the poses of a joint's two sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Primitive {
    /// The places are one: `T_a[i]·(x_a − x_b) = 0`, 3 rows, m. In a's axes, not in global ones: a condition that does
    /// not change when all turns has forces without moment, also in the middle of a step, where the places of beams'
    /// nodes are not quite one.
    Coincident,
    /// Axis `i` of a and axis `i` of b are one: `T_a[i]·T_b[j] = T_a[i]·T_b[k] = 0`, 2 rows.
    Parallel(usize),
    /// b is not turned about axis `i` against a: `T_a[j]·T_b[k] = 0`, 1 row; the axes `i` are parallel otherwise.
    Unturned(usize),
    /// Axis `i` of a and axis `j` of b are perpendicular: `T_a[i]·T_b[j] = 0`, 1 row.
    Perpendicular(usize, usize),
    /// A measure has the value that a drive prescribes, 0 without a drive: 1 row, m or rad.
    Measured(Measure),
    /// Axes `i` and `j` of b are perpendicular, or, where they are one, of length 1: `T_b[i]·T_b[j] = 0` or
    /// `(|T_b[i]|² − 1)/2 = 0`, 1 row.
    Rigid(usize, usize),
}

impl Primitive {
    /// Number of rows.
    pub fn rows(self) -> usize {
        match self {
            Self::Coincident => 3,
            Self::Parallel(_) => 2,
            Self::Unturned(_) | Self::Perpendicular(..) | Self::Measured(_) | Self::Rigid(..) => 1,
        }
    }

    /// The axes of a and b whose product row `row` is, where it is one.
    fn product(self, row: usize) -> Option<(usize, usize)> {
        match self {
            Self::Parallel(i) => Some((i, (i + 1 + row) % 3)),
            Self::Unturned(i) => Some(((i + 1) % 3, (i + 2) % 3)),
            Self::Perpendicular(i, j) => Some((i, j)),
            Self::Coincident | Self::Measured(_) | Self::Rigid(..) => None,
        }
    }

    /// The conditions, zero when they hold; `prescribed` is what a drive prescribes.
    pub fn phi(self, a: &Pose, b: &Pose, prescribed: f64, phi: &mut [f64]) {
        match self {
            Self::Coincident => {
                for (axis, phi) in phi.iter_mut().enumerate() {
                    *phi = -Measure::Distance(axis).value(a, b, 0.0);
                }
            }
            Self::Measured(measure @ Measure::Angle(_)) => {
                // The difference within half a turn: the turns are the step's to follow.
                phi[0] = near(measure.value(a, b, 0.0) - prescribed, 0.0);
            }
            Self::Measured(measure) => phi[0] = measure.value(a, b, 0.0) - prescribed,
            Self::Rigid(i, j) => {
                let product = b.axis(i).dot(&b.axis(j));
                phi[0] = if i == j { 0.5 * (product - 1.0) } else { product };
            }
            _ => {
                for (row, phi) in phi.iter_mut().enumerate() {
                    *phi = self.product(row).map_or(0.0, |(i, j)| a.axis(i).dot(&b.axis(j)));
                }
            }
        }
    }

    /// Sets `gradient`, which is zero, to that of row `row` by the vectors of both poses.
    #[inline]
    pub fn set_phi_x(self, a: &Pose, b: &Pose, row: usize, gradient: &mut PairVector) {
        match self {
            Self::Coincident => {
                gradient.set_column(axis_vector(row), &(a.place - b.place));
                gradient.set_column(PLACE, &a.axis(row));
                gradient.set_column(VECTORS + PLACE, &-a.axis(row));
            }
            Self::Measured(measure) => *gradient = measure.gradient(a, b),
            Self::Rigid(i, j) => {
                gradient.set_column(VECTORS + axis_vector(i), &b.axis(j));
                gradient.set_column(VECTORS + axis_vector(j), &b.axis(i));
            }
            _ => {
                if let Some((i, j)) = self.product(row) {
                    gradient.set_column(axis_vector(i), &b.axis(j));
                    gradient.set_column(VECTORS + axis_vector(j), &a.axis(i));
                }
            }
        }
    }

    /// Adds the second derivative of `Σ lambda·phi` by the vectors of both poses.
    pub fn add_phi_xx(self, a: &Pose, b: &Pose, lambda: &[f64], sum: &mut PairHessian) {
        match self {
            Self::Coincident => {
                for (axis, lambda) in lambda.iter().enumerate() {
                    Measure::Distance(axis).add_hessian(a, b, -lambda, sum);
                }
            }
            Self::Measured(measure) => measure.add_hessian(a, b, lambda[0], sum),
            Self::Rigid(i, j) => {
                sum.add_product(VECTORS + axis_vector(i), VECTORS + axis_vector(j), lambda[0]);
            }
            _ => {
                for (row, lambda) in lambda.iter().enumerate() {
                    if let Some((i, j)) = self.product(row) {
                        sum.add_product(axis_vector(i), VECTORS + axis_vector(j), *lambda);
                    }
                }
            }
        }
    }

    /// Whether this is what is meant, not a relative of it by half a turn.
    pub fn is_upright(self, a: &Pose, b: &Pose) -> bool {
        let along = |i: usize| a.axis(i).dot(&b.axis(i)) > 0.0;
        match self {
            Self::Parallel(i) => along(i),
            Self::Unturned(i) => along((i + 1) % 3),
            Self::Coincident | Self::Perpendicular(..) | Self::Measured(_) | Self::Rigid(..) => true,
        }
    }
}
