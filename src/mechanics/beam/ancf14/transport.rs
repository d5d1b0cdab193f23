//! Mass that passes through the mesh of a beam that is paid out (MECHANICS 3.11).

use super::payout::Extent;
use crate::math::hermite;
use crate::math::quadrature::{FIVE_POINTS, FIVE_WEIGHTS};

/// Matrices of the transport of mass through an element: each stands before the unit matrix of space, and multiplies
/// the coordinates of the curve. With the shape functions `N` and `d = X − x`:
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transport {
    /// `ρA ∫ d N_a N'_b dx`: kg for two places, kg m for a place and a slope, kg m² for two slopes.
    pub first: [[f64; 4]; 4],
    /// `ρA ∫ d² N_a N''_b dx`, in the same units.
    pub second: [[f64; 4]; 4],
    /// `ρA ∫ d² N'_a N'_b dx`, in the same units.
    pub square: [[f64; 4]; 4],
}

impl Transport {
    /// Of an element of `length` m and `density` kg/m that begins `distance` m before the far end; negative: behind it.
    pub fn new(density: f64, length: f64, distance: f64) -> Self {
        let mut all = Self { first: [[0.0; 4]; 4], second: [[0.0; 4]; 4], square: [[0.0; 4]; 4] };
        // Polynomials of degree 6: the rule is exact.
        for (xi, weight) in FIVE_POINTS.into_iter().zip(FIVE_WEIGHTS) {
            let (n, n_x, n_xx) =
                (hermite::shape(xi, length), hermite::shape_x(xi, length), hermite::shape_xx(xi, length));
            let (mass, d) = (density * length * weight, distance - xi * length);
            for a in 0..4 {
                for b in 0..4 {
                    all.first[a][b] += mass * d * n[a] * n_x[b];
                    all.second[a][b] += mass * d * d * n[a] * n_xx[b];
                    all.square[a][b] += mass * d * d * n_x[a] * n_x[b];
                }
            }
        }
        all
    }

    /// The matrix that multiplies the coordinates in the force of inertia,
    /// `lambda [(lambda''/lambda − 2 r²) first + r² second]` with `r = lambda'/lambda`.
    pub fn by_q(&self, extent: &Extent) -> [[f64; 4]; 4] {
        let square = extent.rate * extent.rate;
        let (by_first, by_second) = (extent.ratio * (extent.acceleration - 2.0 * square), extent.ratio * square);
        std::array::from_fn(|a| std::array::from_fn(|b| by_first * self.first[a][b] + by_second * self.second[a][b]))
    }
}
