//! Bodies as flat polygons: boxes and cylinders.

use ancf14::model::view::Solid;
use std::f64::consts::TAU;

/// Sides of a cylinder.
const SIDES: usize = 24;

/// Corners of a solid in its own axes, m, and its polygons, seen from outside against the clock.
pub fn surface(solid: Solid) -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
    match solid {
        Solid::Box(edges) => {
            let corner =
                |number: usize| [0, 1, 2].map(|axis| edges[axis] * if number >> axis & 1 == 1 { 0.5 } else { -0.5 });
            let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
            ((0..8).map(corner).collect(), faces.map(Vec::from).to_vec())
        }
        Solid::Cylinder { axis, radius, length } => {
            let corner = |side: usize, end: f64| {
                let (sine, cosine) = (TAU * side as f64 / SIDES as f64).sin_cos();
                let mut place = [0.0; 3];
                place[axis] = end * length;
                place[(axis + 1) % 3] = radius * cosine;
                place[(axis + 2) % 3] = radius * sine;
                place
            };
            let corners = [-0.5, 0.5].iter().flat_map(|end| (0..SIDES).map(move |side| corner(side, *end)));
            let wall = |side: usize| vec![side, (side + 1) % SIDES, SIDES + (side + 1) % SIDES, SIDES + side];
            let ends = [(0..SIDES).rev().collect(), (SIDES..2 * SIDES).collect()];
            (corners.collect(), (0..SIDES).map(wall).chain(ends).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume inside closed polygons, by the divergence theorem: negative if they are seen from inside.
    fn volume((corners, faces): &(Vec<[f64; 3]>, Vec<Vec<usize>>)) -> f64 {
        let product = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        let triangles = faces.iter().flat_map(|face| face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]));
        triangles.map(|[a, b, c]| product(corners[a], corners[b], corners[c]) / 6.0).sum()
    }

    /// The surface of a solid is closed and seen from outside: a face that is missing or turned round changes the
    /// volume. A prism of n sides has `n/2 r² sin(2π/n)` of the area of its circle. Rounding: some units of the last
    /// place.
    #[test]
    fn surfaces_enclose_their_volume() {
        let of_box = volume(&surface(Solid::Box([0.1, 0.2, 0.4])));
        assert!((of_box - 0.008).abs() < 1e-15, "{of_box}");
        let area = SIDES as f64 / 2.0 * (TAU / SIDES as f64).sin() * 0.09;
        for axis in 0..3 {
            let found = volume(&surface(Solid::Cylinder { axis, radius: 0.3, length: 0.05 }));
            assert!((found - 0.05 * area).abs() < 1e-15, "{found}");
        }
    }
}
