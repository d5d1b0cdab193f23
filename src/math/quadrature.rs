//! Quadrature on [0, 1] and the collocation weights that go with it (MECHANICS 5.1, 5.2, 2.13).

const SQRT_15: f64 = 3.872_983_346_207_417;

/// Points of the 3-point Gauss rule.
pub const GAUSS_POINTS: [f64; 3] = [0.5 - SQRT_15 / 10.0, 0.5, 0.5 + SQRT_15 / 10.0];
/// Weights of the 3-point Gauss rule.
pub const GAUSS_WEIGHTS: [f64; 3] = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];

/// Points of the 4-point Gauss rule.
pub const FOUR_POINTS: [f64; 4] =
    [0.069_431_844_202_973_71, 0.330_009_478_207_571_87, 0.669_990_521_792_428_1, 0.930_568_155_797_026_3];
/// Weights of the 4-point Gauss rule.
pub const FOUR_WEIGHTS: [f64; 4] =
    [0.173_927_422_568_726_93, 0.326_072_577_431_273_07, 0.326_072_577_431_273_07, 0.173_927_422_568_726_93];

/// Points of the 5-point Gauss rule.
pub const FIVE_POINTS: [f64; 5] =
    [0.046_910_077_030_668_004, 0.230_765_344_947_158_45, 0.5, 0.769_234_655_052_841_6, 0.953_089_922_969_332];
/// Weights of the 5-point Gauss rule.
pub const FIVE_WEIGHTS: [f64; 5] = [
    0.118_463_442_528_094_54,
    0.239_314_335_249_683_23,
    64.0 / 225.0,
    0.239_314_335_249_683_23,
    0.118_463_442_528_094_54,
];

/// Points of the 3-point Lobatto rule: both ends and the middle.
pub const LOBATTO_POINTS: [f64; 3] = [0.0, 0.5, 1.0];
/// Weights of the 3-point Lobatto rule.
pub const LOBATTO_WEIGHTS: [f64; 3] = [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0];

/// Values at `xi` of the three quadratic Lagrange polynomials on `points`.
pub fn lagrange(points: &[f64; 3], xi: f64) -> [f64; 3] {
    let [a, b, c] = *points;
    [
        (xi - b) * (xi - c) / ((a - b) * (a - c)),
        (xi - a) * (xi - c) / ((b - a) * (b - c)),
        (xi - a) * (xi - b) / ((c - a) * (c - b)),
    ]
}

/// `A_h(ξ) = ∫_0^ξ (Lagrange polynomial h on the Gauss points) dξ`; at the Gauss points the matrix of 3-stage Gauss
/// collocation.
pub fn collocation(xi: f64) -> [f64; 3] {
    // A quadratic is integrated exactly over [0, ξ] by Simpson's rule.
    let (start, middle, end) =
        (lagrange(&GAUSS_POINTS, 0.0), lagrange(&GAUSS_POINTS, 0.5 * xi), lagrange(&GAUSS_POINTS, xi));
    std::array::from_fn(|h| xi / 6.0 * (start[h] + 4.0 * middle[h] + end[h]))
}

/// `∫_0^ξ (Lagrange polynomial g on the five Gauss points) dξ / w_g`: the shares up to `xi` of what stands for the
/// whole of [0, 1] at each point; at 1 they are 1.
pub fn shares_of_five(xi: f64) -> [f64; 5] {
    if xi == 1.0 {
        return [1.0; 5];
    }
    // The rule itself, over [0, ξ], is exact for the polynomials of degree 4.
    let inner = FIVE_POINTS.map(|point| point * xi);
    std::array::from_fn(|g| {
        let value = |x: f64| -> f64 {
            let others = FIVE_POINTS.iter().enumerate().filter(|(k, _)| *k != g);
            others.map(|(_, point)| (x - point) / (FIVE_POINTS[g] - point)).product()
        };
        let integral: f64 = inner.iter().zip(FIVE_WEIGHTS).map(|(x, weight)| weight * value(*x)).sum();
        xi * integral / FIVE_WEIGHTS[g]
    })
}

/// [`shares_of_five`] on the three Gauss points.
pub fn shares_of_three(xi: f64) -> [f64; 3] {
    if xi == 1.0 {
        return [1.0; 3];
    }
    let integrals = collocation(xi);
    [0, 1, 2].map(|g| integrals[g] / GAUSS_WEIGHTS[g])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The integrals of the Lagrange polynomials must be the Butcher matrix that MECHANICS 3.3 prints; the tolerance is
    /// rounding.
    #[test]
    fn collocation_is_the_gauss_matrix() {
        let s = SQRT_15;
        let printed = [
            [5.0 / 36.0, 2.0 / 9.0 - s / 15.0, 5.0 / 36.0 - s / 30.0],
            [5.0 / 36.0 + s / 24.0, 2.0 / 9.0, 5.0 / 36.0 - s / 24.0],
            [5.0 / 36.0 + s / 30.0, 2.0 / 9.0 + s / 15.0, 5.0 / 36.0],
        ];
        for (row, xi) in printed.iter().zip(GAUSS_POINTS) {
            for (value, expected) in collocation(xi).iter().zip(row) {
                assert!((value - expected).abs() < 1e-15);
            }
        }
    }

    /// Polynomials as high as the points determine must be integrated up to any position; the tolerance is rounding.
    #[test]
    fn shares_integrate_polynomials() {
        for xi in [0.0_f64, 0.2, 0.5, 0.83, 1.0] {
            let of = |power: i32| xi.powi(power + 1) / f64::from(power + 1);
            for power in 0..5 {
                let values = FIVE_POINTS.iter().zip(FIVE_WEIGHTS).map(|(x, weight)| weight * x.powi(power));
                let sum: f64 = values.zip(shares_of_five(xi)).map(|(value, share)| value * share).sum();
                assert!((sum - of(power)).abs() < 1e-14);
            }
            for power in 0..3 {
                let values = GAUSS_POINTS.iter().zip(GAUSS_WEIGHTS).map(|(x, weight)| weight * x.powi(power));
                let sum: f64 = values.zip(shares_of_three(xi)).map(|(value, share)| value * share).sum();
                assert!((sum - of(power)).abs() < 1e-14);
            }
        }
    }
}
