//! Sections of thin walls, as unions of rectangles: I, box, channel, tee, angle.
//!
//! Integrals over the area are exact, about the centroid, for walls with sharp corners. The torsion constant is that of
//! thin walls: of open sections the sum of Saint-Venant's constants of the rectangles, of a box Bredt's
//! `4 A_m² / ∮ ds/t`. Warping is left out, and the shear center is taken to be the centroid: forces across a channel, a
//! tee or an angle do not twist it.

use super::section::{CORNERS, Outline, Section, rectangle_torsion_constant};
use crate::math::elementary::sin_cos;

/// A rectangle: its range along y and along z, m.
#[derive(Clone, Copy, Debug)]
struct Wall {
    y: [f64; 2],
    z: [f64; 2],
}

impl Wall {
    /// `∫ y^a z^b dA`.
    fn moment(&self, a: i32, b: i32) -> f64 {
        let one =
            |[low, high]: [f64; 2], power: i32| (high.powi(power + 1) - low.powi(power + 1)) / f64::from(power + 1);
        one(self.y, a) * one(self.z, b)
    }

    fn moved(&self, y: f64, z: f64) -> Self {
        Self { y: self.y.map(|own| own + y), z: self.z.map(|own| own + z) }
    }

    fn size(&self) -> [f64; 2] {
        [self.y, self.z].map(|[low, high]| high - low)
    }
}

impl Section {
    /// Flanges `width` (along y) × `flange`, and a web of thickness `web` between them, `height` (along z) in all, m.
    pub fn i_beam(width: f64, height: f64, web: f64, flange: f64) -> Self {
        let [w, h] = [0.5 * width, 0.5 * height];
        let inner = h - flange;
        let walls = [
            Wall { y: [-w, w], z: [inner, h] },
            Wall { y: [-0.5 * web, 0.5 * web], z: [-inner, inner] },
            Wall { y: [-w, w], z: [-h, -inner] },
        ];
        open(&walls, [[-w, -h], [w, -h], [w, h], [-w, h], [-w, -h], [w, h]])
    }

    /// Rectangle `width` (along y) × `height` (along z) with a hole, inside walls of thickness `wall`, m.
    pub fn hollow(width: f64, height: f64, wall: f64) -> Self {
        let [w, h] = [0.5 * width, 0.5 * height];
        let (inner_w, inner_h) = (w - wall, h - wall);
        let walls = [
            Wall { y: [-w, w], z: [inner_h, h] },
            Wall { y: [-w, w], z: [-h, -inner_h] },
            Wall { y: [-w, -inner_w], z: [-inner_h, inner_h] },
            Wall { y: [inner_w, w], z: [-inner_h, inner_h] },
        ];
        let (middle, way) = ((width - wall) * (height - wall), 2.0 * (width + height - 2.0 * wall));
        let constant = 4.0 * middle * middle * wall / way;
        let corners = [[-w, -h], [w, -h], [w, h], [-w, h], [-w, -h], [w, h]];
        composed(&walls, constant, corners, 2.0 * middle * wall)
    }

    /// A web of thickness `web` along z, `height` in all, with flanges `width` (web included) × `flange` towards y, m.
    pub fn channel(width: f64, height: f64, web: f64, flange: f64) -> Self {
        let h = 0.5 * height;
        let walls = [
            Wall { y: [0.0, web], z: [-h, h] },
            Wall { y: [web, width], z: [h - flange, h] },
            Wall { y: [web, width], z: [-h, flange - h] },
        ];
        open(&walls, [[0.0, -h], [width, -h], [width, h], [0.0, h], [0.0, -h], [width, h]])
    }

    /// A flange `width` (along y) × `flange` at the upper end of a web of thickness `web`, `height` (along z) in all,
    /// m.
    pub fn tee(width: f64, height: f64, web: f64, flange: f64) -> Self {
        let [w, half, below] = [0.5 * width, 0.5 * web, height - flange];
        let walls = [Wall { y: [-w, w], z: [below, height] }, Wall { y: [-half, half], z: [0.0, below] }];
        open(&walls, [[-w, height], [w, height], [w, below], [-w, below], [half, 0.0], [-half, 0.0]])
    }

    /// Legs of thickness `wall` towards y, `width` in all, and towards z, `height` in all, m.
    pub fn angle(width: f64, height: f64, wall: f64) -> Self {
        let walls = [Wall { y: [0.0, width], z: [0.0, wall] }, Wall { y: [0.0, wall], z: [wall, height] }];
        open(&walls, [[0.0, 0.0], [width, 0.0], [width, wall], [wall, height], [0.0, height], [0.0, 0.0]])
    }
}

/// Walls that enclose nothing: each twists as it would alone.
fn open(walls: &[Wall], corners: [[f64; 2]; CORNERS]) -> Section {
    let constant = walls.iter().map(|wall| wall.size()).map(|[y, z]| rectangle_torsion_constant(y, z)).sum();
    let thickest = walls.iter().map(|wall| wall.size()).map(|[y, z]| y.min(z)).fold(0.0, f64::max);
    composed(walls, constant, corners, constant / thickest)
}

/// The integrals of all walls about their centroid; corners are moved with them.
fn composed(walls: &[Wall], torsion_constant: f64, corners: [[f64; 2]; CORNERS], torsion_modulus: f64) -> Section {
    let whole = |a: i32, b: i32| walls.iter().map(|wall| wall.moment(a, b)).sum::<f64>();
    let area = whole(0, 0);
    let [y, z] = [whole(1, 0) / area, whole(0, 1) / area];
    let moment = |a: i32, b: i32| walls.iter().map(|wall| wall.moved(-y, -z).moment(a, b)).sum::<f64>();
    let (second_moment_y, second_moment_z) = (moment(0, 2), moment(2, 0));
    // Of a symmetric section only round-off would be left.
    let is_symmetric = y == 0.0 || z == 0.0;
    let section = Section {
        area,
        second_moment_y,
        second_moment_z,
        torsion_constant,
        polar_moment: second_moment_y + second_moment_z,
        product_moment: if is_symmetric { 0.0 } else { moment(1, 1) },
        outline: Outline::Walls { corners: corners.map(|corner| [corner[0] - y, corner[1] - z]), torsion_modulus },
        ..Section::EMPTY
    };
    let (angle, _) = section.principal_axes();
    Section {
        fourth_moments: turned(angle, [(4, 0), (3, 1), (2, 2), (1, 3), (0, 4)].map(|(a, b)| moment(a, b))),
        ..section
    }
}

/// `[∫ y⁴ dA, ∫ y² z² dA, ∫ z⁴ dA]` in axes that are turned by `angle`, rad, from
/// `[∫ y⁴, ∫ y³ z, ∫ y² z², ∫ y z³, ∫ z⁴]`.
fn turned(angle: f64, [m40, m31, m22, m13, m04]: [f64; 5]) -> [f64; 3] {
    let (s, c) = sin_cos(angle);
    let (ss, cc, sc) = (s * s, c * c, s * c);
    let mixed = cc - ss;
    [
        cc * cc * m40 + 4.0 * cc * sc * m31 + 6.0 * sc * sc * m22 + 4.0 * ss * sc * m13 + ss * ss * m04,
        sc * sc * (m40 + m04 - 2.0 * m22) + mixed * mixed * m22 + 2.0 * sc * mixed * (m13 - m31),
        ss * ss * m40 - 4.0 * ss * sc * m31 + 6.0 * sc * sc * m22 - 4.0 * cc * sc * m13 + cc * cc * m04,
    ]
}
