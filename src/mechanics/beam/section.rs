//! Cross-sections: integrals over the area, fourth moments included (MECHANICS 3.2b).
//!
//! Local y and z go through the centroid, x is the tangent, `z = x × y`. Sections of thin walls are in walls.rs.

use super::material::Material;
use crate::math::elementary::{atan2, cosh, hypot, sin_cos, tanh};
use std::f64::consts::PI;

/// Rounding of integrals that a user copies from a table, as a share.
const INTEGRAL_ROUNDING: f64 = 1e-3;

/// The outline of a section, m: where its stress is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outline {
    /// `width` along y, `height` along z.
    Rectangle {
        /// Along y.
        width: f64,
        /// Along z.
        height: f64,
    },
    /// Solid circle.
    Circle {
        /// Its radius.
        radius: f64,
    },
    /// Circular tube.
    Tube {
        /// Radius of the hole.
        inner: f64,
        /// Radius outside.
        outer: f64,
    },
    /// Solid ellipse with these semi-axes.
    Ellipse {
        /// Along y.
        y: f64,
        /// Along z.
        z: f64,
    },
    /// Thin walls.
    Walls {
        /// The outermost points, y and z.
        corners: [[f64; 2]; CORNERS],
        /// Torque over the largest Saint-Venant shear stress, m³.
        torsion_modulus: f64,
    },
    /// Not known: the section is given by its integrals alone.
    General,
}

/// Outermost points of thin walls at most.
pub const CORNERS: usize = 6;

impl Outline {
    /// Size along y and along z, m; none if it is not known.
    pub fn size(&self) -> Option<[f64; 2]> {
        match self {
            Self::Rectangle { width, height } => Some([*width, *height]),
            Self::Circle { radius } | Self::Tube { outer: radius, .. } => Some([2.0 * radius; 2]),
            Self::Ellipse { y, z } => Some([2.0 * y, 2.0 * z]),
            Self::Walls { corners, .. } => {
                let most =
                    |axis: usize, sign: f64| corners.iter().map(|corner| sign * corner[axis]).fold(0.0, f64::max);
                Some([0, 1].map(|axis| most(axis, 1.0) + most(axis, -1.0)))
            }
            Self::General => None,
        }
    }

    /// Largest size of `axial + z curvature_y − y curvature_z` over the outline, 1, with the curvatures about y and z
    /// in 1/m; none if it is not known.
    pub fn largest_strain(&self, axial: f64, curvature: &[f64; 2]) -> Option<f64> {
        let [about_y, about_z] = curvature;
        let bending = match self {
            Self::Rectangle { width, height } => 0.5 * (height * about_y.abs() + width * about_z.abs()),
            Self::Circle { radius } | Self::Tube { outer: radius, .. } => radius * hypot(*about_y, *about_z),
            Self::Ellipse { y, z } => hypot(z * about_y, y * about_z),
            Self::Walls { corners, .. } => {
                let strains = corners.iter().map(|[y, z]| (axial + z * about_y - y * about_z).abs());
                return Some(strains.fold(0.0, f64::max));
            }
            Self::General => return None,
        };
        Some(axial.abs() + bending)
    }

    /// A point of the outline, y and z, m, where `axial + z curvature_y − y curvature_z` is largest in size; none if
    /// the outline is not known. Where all points are alike it is the middle of them.
    pub fn farthest_point(&self, axial: f64, curvature: &[f64; 2]) -> Option<[f64; 2]> {
        let [about_y, about_z] = *curvature;
        if let Self::Walls { corners, .. } = self {
            let strain = |[y, z]: &[f64; 2]| (axial + z * about_y - y * about_z).abs();
            return corners.iter().copied().max_by(|a, b| strain(a).total_cmp(&strain(b)));
        }
        // Where it is compressed the largest stress is on the other side.
        let side = if axial < 0.0 { -1.0 } else { 1.0 };
        self.most_stretched(about_y, about_z).map(|place| place.map(|part| side * part))
    }

    /// A point of a doubly symmetric outline where `z about_y − y about_z` is largest.
    fn most_stretched(&self, about_y: f64, about_z: f64) -> Option<[f64; 2]> {
        let sign = |number: f64| if number == 0.0 { 0.0 } else { number.signum() };
        match self {
            Self::Rectangle { width, height } => Some([-0.5 * width * sign(about_z), 0.5 * height * sign(about_y)]),
            Self::Ellipse { y, z } => {
                let amount = hypot(z * about_y, y * about_z).max(f64::MIN_POSITIVE);
                Some([-y * (y * about_z / amount), z * (z * about_y / amount)])
            }
            Self::Circle { radius } | Self::Tube { outer: radius, .. } => {
                // Never a division by 0, which hosts may trap.
                let amount = hypot(about_y, about_z).max(f64::MIN_POSITIVE);
                Some([-radius * (about_z / amount), radius * (about_y / amount)])
            }
            Self::Walls { .. } | Self::General => None,
        }
    }

    /// Torque over the largest Saint-Venant shear stress that it makes, m³; none if the outline is not known.
    pub fn torsion_modulus(&self) -> Option<f64> {
        match self {
            Self::Rectangle { width, height } => Some(rectangle_torsion_modulus(*width, *height)),
            Self::Circle { radius } => Some(Section::circle(*radius).torsion_constant / radius),
            Self::Tube { inner, outer } => Some(Section::tube(*inner, *outer).torsion_constant / outer),
            Self::Ellipse { y, z } => Some(0.5 * PI * y * z * y.min(*z)),
            Self::Walls { torsion_modulus, .. } => Some(*torsion_modulus),
            Self::General => None,
        }
    }
}

/// Which rigidities a section lacks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Limp {
    /// Against bending about y or z.
    pub bending: bool,
    /// Against torsion.
    pub torsion: bool,
}

/// The integrals of a section that the element needs, and its outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Area A, m².
    pub area: f64,
    /// `Iy = ∫ z² dA`, m⁴: bending about y.
    pub second_moment_y: f64,
    /// `Iz = ∫ y² dA`, m⁴: bending about z.
    pub second_moment_z: f64,
    /// Saint-Venant's torsion constant Jt, m⁴.
    pub torsion_constant: f64,
    /// Polar moment Ip, m⁴: spin inertia and Wagner term.
    pub polar_moment: f64,
    /// `[∫ y⁴ dA, ∫ y² z² dA, ∫ z⁴ dA]` about the principal axes, m⁶.
    pub fourth_moments: [f64; 3],
    /// Product of area `Iyz = ∫ y z dA`, m⁴; 0 where y and z are principal axes.
    pub product_moment: f64,
    /// Where the tension center is, y and z, m; the integrals are those about the axis of the beam.
    pub tension_center: [f64; 2],
    /// Turn about the tangent from the beam's own section to this one, rad.
    pub twist: f64,
    /// Mass per length, kg/m, its polar moment, and its moments about y and z, kg m, where they do not follow from the
    /// density.
    pub inertia: Option<[f64; 4]>,
    /// Mass per length of what fills it, kg/m.
    pub contents: f64,
    /// Its outline; the integrals may be given differently.
    pub outline: Outline,
    /// Which rigidities are least ones in place of its own: the spin of a chain means nothing.
    pub limp: Limp,
}

impl Section {
    /// No area at all, in principal axes: what others begin with.
    pub const EMPTY: Self = Self {
        area: 0.0,
        second_moment_y: 0.0,
        second_moment_z: 0.0,
        torsion_constant: 0.0,
        polar_moment: 0.0,
        fourth_moments: [0.0; 3],
        product_moment: 0.0,
        tension_center: [0.0; 2],
        twist: 0.0,
        inertia: None,
        contents: 0.0,
        outline: Outline::General,
        limp: Limp { bending: false, torsion: false },
    };

    /// Mass per length, kg/m, and its polar moment, kg m, of a section of `material`.
    pub fn densities(&self, material: &Material) -> [f64; 2] {
        match self.inertia {
            Some([line_density, spin, ..]) => [line_density, spin],
            None => {
                let [line_density, spin] = [self.area, self.polar_moment].map(|integral| material.density * integral);
                [line_density + self.contents, spin]
            }
        }
    }

    /// `[∫ρ y² dA, ∫ρ z² dA, ∫ρ y z dA]` of a section of `material`, kg m.
    pub fn mass_moments(&self, material: &Material) -> [f64; 3] {
        match self.inertia {
            Some([.., about_y, about_z]) => [about_z, about_y, 0.0],
            None => [self.second_moment_z, self.second_moment_y, self.product_moment]
                .map(|integral| material.density * integral),
        }
    }

    /// The same section, of a material with the moduli 1, with this rigidity against bending and torsion where it has
    /// none: no load could be borne across it, and no section would have a spin.
    #[must_use]
    pub fn with_least_rigidity(self, least: f64) -> Self {
        let own = [self.second_moment_y, self.second_moment_z, self.torsion_constant];
        if least == 0.0 || own.iter().all(|rigidity| *rigidity > 0.0) {
            return self;
        }
        let [second_moment_y, second_moment_z, torsion_constant] =
            own.map(|rigidity| if rigidity > 0.0 { rigidity } else { least });
        let polar_moment = second_moment_y + second_moment_z;
        let inertia = self.inertia.map(|[line_density, spin, about_y, about_z]| {
            let own = line_density * polar_moment / self.area;
            [line_density, if spin > 0.0 { spin.max(own) } else { own }, about_y, about_z]
        });
        Self {
            second_moment_y,
            second_moment_z,
            torsion_constant,
            polar_moment,
            fourth_moments: Self::rectangular_fourth_moments(self.area, second_moment_y, second_moment_z),
            inertia,
            limp: Limp { bending: own[0] <= 0.0 || own[1] <= 0.0, torsion: own[2] <= 0.0 },
            ..self
        }
    }

    /// Angle about the tangent from y to the principal axis nearest to it, rad, and the second moments about the
    /// principal y and z, m⁴.
    pub fn principal_axes(&self) -> (f64, [f64; 2]) {
        let Self { second_moment_y: about_y, second_moment_z: about_z, product_moment, .. } = *self;
        if product_moment == 0.0 {
            return (0.0, [about_y, about_z]);
        }
        let (mean, half) = (0.5 * (about_y + about_z), 0.5 * (about_z - about_y));
        let radius = hypot(half, product_moment);
        if half < 0.0 {
            (0.5 * atan2(-product_moment, -half), [mean + radius, mean - radius])
        } else {
            (0.5 * atan2(product_moment, half), [mean - radius, mean + radius])
        }
    }

    /// The same section with its tension center at `center`, y and z, m, instead of on the axis: its integrals become
    /// those about the axis (Steiner). The fourth moments about the tension center are taken as those along the
    /// principal axes of the sum; `∫y³z` and `∫yz³` are left out.
    pub fn with_tension_center(self, center: [f64; 2]) -> Self {
        let (own, [y, z]) = (self, center);
        let mut section = Self {
            second_moment_y: own.second_moment_y + own.area * z * z,
            second_moment_z: own.second_moment_z + own.area * y * y,
            product_moment: own.product_moment + own.area * y * z,
            polar_moment: own.polar_moment + own.area * (y * y + z * z),
            tension_center: center,
            ..own
        };
        let ([y, z], [own_y, own_z, own_yz]) = section.about_tension_center();
        let [yyyy, yyzz, zzzz] = own.fourth_moments;
        section.fourth_moments = [
            yyyy + y * y * (6.0 * own_z + own.area * y * y),
            yyzz + y * y * own_y + z * z * own_z + 4.0 * y * z * own_yz + own.area * y * y * z * z,
            zzzz + z * z * (6.0 * own_y + own.area * z * z),
        ];
        section
    }

    /// In the principal axes of the section about the axis: the tension center, m, and the second moments about axes
    /// through it, `Iy`, `Iz` and `Iyz`, m⁴.
    fn about_tension_center(&self) -> ([f64; 2], [f64; 3]) {
        let (angle, [about_y, about_z]) = self.principal_axes();
        let ((sin, cos), [y, z]) = (sin_cos(angle), self.tension_center);
        let [y, z] = [cos * y + sin * z, cos * z - sin * y];
        ([y, z], [about_y - self.area * z * z, about_z - self.area * y * y, -self.area * y * z])
    }

    /// First moments `∫ (y, z) dA`, m³, and third moments `[∫y³, ∫y²z, ∫yz², ∫z³] dA`, m⁵, about the principal axes
    /// through the axis of the beam, of a section that is symmetric about its tension center; none where that is on the
    /// axis.
    pub fn odd_moments(&self) -> Option<([f64; 2], [f64; 4])> {
        if self.tension_center == [0.0; 2] {
            return None;
        }
        let ([y, z], [own_y, own_z, own_yz]) = self.about_tension_center();
        let third = [
            y * (3.0 * own_z + self.area * y * y),
            z * own_z + 2.0 * y * own_yz + self.area * y * y * z,
            y * own_y + 2.0 * z * own_yz + self.area * y * z * z,
            z * (3.0 * own_y + self.area * z * z),
        ];
        Some(([y, z].map(|part| self.area * part), third))
    }

    /// Rectangle `width` (along y) × `height` (along z), m.
    pub fn rectangle(width: f64, height: f64) -> Self {
        let second_moment_y = width * height.powi(3) / 12.0;
        let second_moment_z = height * width.powi(3) / 12.0;
        Self {
            area: width * height,
            second_moment_y,
            second_moment_z,
            torsion_constant: rectangle_torsion_constant(width, height),
            polar_moment: second_moment_y + second_moment_z,
            fourth_moments: [
                height * width.powi(5) / 80.0,
                width.powi(3) * height.powi(3) / 144.0,
                width * height.powi(5) / 80.0,
            ],
            outline: Outline::Rectangle { width, height },
            ..Self::EMPTY
        }
    }

    /// Fourth moments `[∫ y⁴ dA, ∫ y² z² dA, ∫ z⁴ dA]` of the rectangle that has this area (m²) and these second
    /// moments about y and z (m⁴), m⁶: an estimate for a section whose outline is not known. A circle has `2 Iz²/A`
    /// instead of `1.8 Iz²/A`, a thin tube `1.5 Iz²/A`.
    pub fn rectangular_fourth_moments(area: f64, second_moment_y: f64, second_moment_z: f64) -> [f64; 3] {
        [
            1.8 * second_moment_z * second_moment_z / area,
            second_moment_y * second_moment_z / area,
            1.8 * second_moment_y * second_moment_y / area,
        ]
    }

    /// `∫ r⁴ dA − Ip²/A`, m⁶, with `r² = y² + z²`: what torsion stiffens by at large strain. No section has less than 0
    /// (Cauchy and Schwarz); integrals that are given one by one may.
    pub fn twist_stiffening(&self) -> f64 {
        let [yyyy, yyzz, zzzz] = self.fourth_moments;
        let (whole, relief) = (yyyy + 2.0 * yyzz + zzzz, self.polar_moment * self.polar_moment / self.area);
        // Of a thin tube nothing but round-off is left.
        if whole < (1.0 - INTEGRAL_ROUNDING) * relief { whole - relief } else { f64::max(whole - relief, 0.0) }
    }

    /// Larger radius of gyration, `√(I/A)`, m.
    pub fn gyration(&self) -> f64 {
        (self.second_moment_y.max(self.second_moment_z) / self.area).sqrt()
    }

    /// Solid circle, m.
    pub fn circle(radius: f64) -> Self {
        let second_moment = PI * radius.powi(4) / 4.0;
        let fourth = PI * radius.powi(6) / 24.0;
        Self {
            area: PI * radius * radius,
            second_moment_y: second_moment,
            second_moment_z: second_moment,
            torsion_constant: 2.0 * second_moment,
            polar_moment: 2.0 * second_moment,
            fourth_moments: [3.0 * fourth, fourth, 3.0 * fourth],
            outline: Outline::Circle { radius },
            ..Self::EMPTY
        }
    }

    /// Solid ellipse `width` (along y) × `height` (along z), m.
    pub fn ellipse(width: f64, height: f64) -> Self {
        let (y, z) = (0.5 * width, 0.5 * height);
        let (second_moment_y, second_moment_z) = (PI * y * z.powi(3) / 4.0, PI * z * y.powi(3) / 4.0);
        Self {
            area: PI * y * z,
            second_moment_y,
            second_moment_z,
            torsion_constant: PI * (y * z).powi(3) / (y * y + z * z),
            polar_moment: second_moment_y + second_moment_z,
            fourth_moments: [PI * y.powi(5) * z / 8.0, PI * (y * z).powi(3) / 24.0, PI * y * z.powi(5) / 8.0],
            outline: Outline::Ellipse { y, z },
            ..Self::EMPTY
        }
    }

    /// Circular tube between the radii `inner` and `outer`, m.
    pub fn tube(inner: f64, outer: f64) -> Self {
        let (hole, disk) = (Self::circle(inner), Self::circle(outer));
        Self {
            area: disk.area - hole.area,
            second_moment_y: disk.second_moment_y - hole.second_moment_y,
            second_moment_z: disk.second_moment_z - hole.second_moment_z,
            torsion_constant: disk.torsion_constant - hole.torsion_constant,
            polar_moment: disk.polar_moment - hole.polar_moment,
            fourth_moments: std::array::from_fn(|i| disk.fourth_moments[i] - hole.fourth_moments[i]),
            outline: Outline::Tube { inner, outer },
            ..Self::EMPTY
        }
    }
}

/// Saint-Venant's torsion constant of a rectangle, m⁴: `a b³/3 (1 − 192 b/(π⁵ a) Σ_{n odd} tanh(nπa/2b)/n⁵)`, a ≥ b
/// (Timoshenko).
pub(super) fn rectangle_torsion_constant(width: f64, height: f64) -> f64 {
    let (long, short) = (width.max(height), width.min(height));
    // The terms fall with n⁻⁵: 40 of them leave less than 1e-9 of the constant; summed from the smallest.
    let series: f64 =
        (0..40).rev().map(|k| f64::from(2 * k + 1)).map(|n| tanh(n * PI * long / (2.0 * short)) / n.powi(5)).sum();
    long * short.powi(3) / 3.0 * (1.0 - 192.0 * short / (PI.powi(5) * long) * series)
}

/// `Jt / (b (1 − 8/π² Σ_{n odd} 1/(n² cosh(nπa/2b))))`, m³, a ≥ b: the shear is largest in the middle of the long sides
/// (Timoshenko).
fn rectangle_torsion_modulus(width: f64, height: f64) -> f64 {
    let (long, short) = (width.max(height), width.min(height));
    // The terms fall with exp(−nπ/2) at least: 12 of them leave less than 1e-17.
    let series: f64 =
        (0..12).rev().map(|k| f64::from(2 * k + 1)).map(|n| 1.0 / (n * n * cosh(n * PI * long / (2.0 * short)))).sum();
    rectangle_torsion_constant(width, height) / (short * (1.0 - 8.0 / (PI * PI) * series))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The square's constant 0.140577 a⁴ stands in every table (and in the 45-degree bend's reference); a thin strip
    /// tends to a b³/3.
    #[test]
    fn torsion_of_rectangles() {
        assert!((Section::rectangle(1.0, 1.0).torsion_constant - 0.140_577_0).abs() < 1e-7);
        let strip = Section::rectangle(1e-3, 1.0).torsion_constant;
        assert!((strip / (1e-9 / 3.0) - 1.0).abs() < 1e-3);
        assert_eq!(Section::rectangle(2.0, 3.0).torsion_constant, Section::rectangle(3.0, 2.0).torsion_constant);
    }

    /// Largest shear of a rectangle a × b is T/(k a b²); k to three digits as in Timoshenko's table, a b²/3 for a thin
    /// strip.
    #[test]
    fn torsional_shear_of_rectangles() {
        for (ratio, k) in [(1.0, 0.208), (1.5, 0.231), (2.0, 0.246), (3.0, 0.267), (4.0, 0.282), (10.0, 0.312)] {
            for (width, height) in [(ratio * 0.01, 0.01), (0.01, ratio * 0.01)] {
                let modulus = Outline::Rectangle { width, height }.torsion_modulus().unwrap();
                assert!((modulus / (ratio * 1e-6) - k).abs() < 5.1e-4, "{ratio}: {}", modulus / (ratio * 1e-6));
            }
        }
        let strip = Outline::Rectangle { width: 1e-3, height: 1.0 }.torsion_modulus().unwrap();
        assert!((strip * 3e6 - 1.0).abs() < 1e-3);
    }

    /// A midpoint rule over the area must find the same moments; its error with 400 × 400 cells is below 1e-4 relative.
    #[test]
    fn moments_are_integrals() {
        let (width, height, cells) = (0.03, 0.05, 400);
        let section = Section::rectangle(width, height);
        let mut sums = [0.0; 5];
        let cell = width * height / f64::from(cells * cells);
        for i in 0..cells {
            for j in 0..cells {
                let y = width * ((f64::from(i) + 0.5) / f64::from(cells) - 0.5);
                let z = height * ((f64::from(j) + 0.5) / f64::from(cells) - 0.5);
                for (sum, value) in sums.iter_mut().zip([z * z, y * y, y.powi(4), y * y * z * z, z.powi(4)]) {
                    *sum += cell * value;
                }
            }
        }
        let [yyyy, yyzz, zzzz] = section.fourth_moments;
        let closed = [section.second_moment_y, section.second_moment_z, yyyy, yyzz, zzzz];
        for (sum, value) in sums.iter().zip(closed) {
            assert!((sum / value - 1.0).abs() < 1e-4);
        }
    }
}
