//! Green-Lagrange strain: half the scalar products of the base vectors `g = (∂r/∂x, ∂r/∂y, ∂r/∂z)`, less those of the
//! undeformed beam.
//!
//! In Voigt's order `xx, yy, zz, 2 yz, 2 zx, 2 xy`. The products are quadratic: their derivative is linear in `g`,
//! their second one constant.

use crate::math::{Mat3, Vec3};
use nalgebra::{SMatrix, SVector};

/// Strains or stresses in Voigt's order; shear strains are doubled.
pub type Voigt = SVector<f64, 6>;
/// A stiffness in Voigt's order.
pub type VoigtMatrix = SMatrix<f64, 6, 6>;
/// Derivative of strains by the three base vectors.
pub type ByBase = SMatrix<f64, 6, 9>;

/// Which base vectors multiply in each position.
pub const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];

/// The strains that each base vector is in, and which one it multiplies there.
pub const STRAINS_OF: [[(usize, usize); 3]; 3] =
    [[(0, 0), (4, 2), (5, 1)], [(1, 1), (3, 2), (5, 0)], [(2, 2), (3, 1), (4, 0)]];

/// Half the scalar products of the base vectors `g`.
pub fn products(g: &[Vec3; 3]) -> Voigt {
    Voigt::from_fn(|i, _| {
        let (a, b) = PAIRS[i];
        g[a].dot(&g[b]) * if a == b { 0.5 } else { 1.0 }
    })
}

/// Derivative of [`products`] by the base vectors: linear in them.
pub fn products_g(g: &[Vec3; 3]) -> ByBase {
    let mut sum = ByBase::zeros();
    for (row, (a, b)) in PAIRS.into_iter().enumerate() {
        sum.fixed_view_mut::<1, 3>(row, 3 * a).copy_from(&g[b].transpose());
        sum.fixed_view_mut::<1, 3>(row, 3 * b).copy_from(&g[a].transpose());
    }
    sum
}

/// The symmetric matrix with these components; strains' shears halved first.
pub fn tensor(stress: &Voigt) -> Mat3 {
    Mat3::new(
        stress[0], stress[5], stress[4], //
        stress[5], stress[1], stress[3], //
        stress[4], stress[3], stress[2],
    )
}

/// Strains in local axes by strains in the base `base`, whose columns are base vectors in these axes:
/// `E_local = J^-T E J^-1`; none where the base has no volume.
pub fn to_local(base: &Mat3) -> Option<VoigtMatrix> {
    let inverse = base.try_inverse()?;
    let mut sum = VoigtMatrix::zeros();
    for (column, (a, b)) in PAIRS.into_iter().enumerate() {
        // The tensor of a unit strain, doubled shear counted.
        let mut unit = Mat3::zeros();
        unit[(a, b)] += 0.5;
        unit[(b, a)] += 0.5;
        let local = inverse.tr_mul(&(unit * inverse));
        for (row, (a, b)) in PAIRS.into_iter().enumerate() {
            sum[(row, column)] = local[(a, b)] * if a == b { 1.0 } else { 2.0 };
        }
    }
    Some(sum)
}
