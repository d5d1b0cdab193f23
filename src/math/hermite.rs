//! Cubic Hermite shape functions of a beam element (MECHANICS 3.3): `r(ξ) = Σ_a N_a X_a`, `X = (r_0, p_0, r_1, p_1)`,
//! `p = r'`.
//!
//! `ξ = x / l` runs over [0, 1]; primes are derivatives by arc length.

/// `N_a(ξ)`: 1, m, 1, m.
pub fn shape(xi: f64, length: f64) -> [f64; 4] {
    let (xi2, xi3) = (xi * xi, xi * xi * xi);
    [1.0 - 3.0 * xi2 + 2.0 * xi3, length * (xi - 2.0 * xi2 + xi3), 3.0 * xi2 - 2.0 * xi3, length * (xi3 - xi2)]
}

/// `N'_a(ξ)`: 1/m, 1, 1/m, 1.
pub fn shape_x(xi: f64, length: f64) -> [f64; 4] {
    let xi2 = xi * xi;
    [6.0 * (xi2 - xi) / length, 1.0 - 4.0 * xi + 3.0 * xi2, 6.0 * (xi - xi2) / length, 3.0 * xi2 - 2.0 * xi]
}

/// `N''_a(ξ)`: 1/m², 1/m, 1/m², 1/m.
pub fn shape_xx(xi: f64, length: f64) -> [f64; 4] {
    let square = length * length;
    [(12.0 * xi - 6.0) / square, (6.0 * xi - 4.0) / length, (6.0 - 12.0 * xi) / square, (6.0 * xi - 2.0) / length]
}

/// `∫ N_a dx` over the element: m, m², m, m².
pub fn integrals(length: f64) -> [f64; 4] {
    [6.0, length, 6.0, -length].map(|integral| length / 12.0 * integral)
}

/// `∫ N_a N_b dx` over the element.
pub fn products(length: f64) -> [[f64; 4]; 4] {
    let l = length;
    [
        [156.0, 22.0 * l, 54.0, -13.0 * l],
        [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
        [54.0, 13.0 * l, 156.0, -22.0 * l],
        [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
    ]
    .map(|row| row.map(|product| l / 420.0 * product))
}
