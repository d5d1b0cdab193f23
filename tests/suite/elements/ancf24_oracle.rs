//! ANCF24's strains written a second time, straight from the definition, over any dual number: `F = (∂r/∂X)(∂r0/∂X)⁻¹`,
//! `E = (Fᵀ F − 1)/2` in the section's axes. It shares no formula with the closed form, which has neither `F` nor a
//! base inverted with `q`.

use crate::random::Random;
use crate::support::gauss::gauss;
use crate::support::oracle::{Scalar, cross, dot, scale, sum};
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf24::element::{Element, Properties};
use ancf14::mechanics::beam::ancf24::law::Shear;
use ancf14::mechanics::beam::design::{BeamDesign, Elements};
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::section::Section;
use nalgebra::{SMatrix, SVector};

pub type Coordinates = SVector<f64, 24>;

pub const LENGTH: f64 = 0.7;
const WIDTH: f64 = 0.2;
const HEIGHT: f64 = 0.3;
const YOUNG: f64 = 40.0;
const POISSON: f64 = 0.3;
pub const DENSITY: f64 = 3.0;
pub const DAMPING: f64 = 0.02;
/// Torsion constant of a section that is not the one of its width and height.
const TORSION: f64 = 3e-4;

/// A law and a reference: all kinds of element.
pub const LAWS: [(bool, Shear); 4] =
    [(false, Shear::Section), (false, Shear::Continuum), (true, Shear::Section), (true, Shear::Continuum)];

/// An undeformed element along x.
pub fn straight() -> Coordinates {
    let mut q = Coordinates::zeros();
    for node in 0..2 {
        q[12 * node] = LENGTH * node as f64;
        (0..3).for_each(|axis| q[12 * node + 3 + 4 * axis] = 1.0);
    }
    q
}

/// A place in space, slopes and sections bent, stretched, sheared and twisted at random against [`straight`], turned as
/// a whole.
pub fn deformed(random: &mut Random, size: f64) -> Coordinates {
    let (turn, place) = (random.rotation(), random.vector());
    let mut q = straight();
    for vector in 0..8 {
        let of_place = vector % 4 == 0;
        let change = random.vector() * if of_place { 0.5 * LENGTH * size } else { size };
        let moved = turn * (q.fixed_rows::<3>(3 * vector) + change) + if of_place { place } else { Vec3::zeros() };
        q.fixed_rows_mut::<3>(3 * vector).copy_from(&moved);
    }
    q
}

/// What a beam of such elements is made of.
pub fn design((poisson, shear): (bool, Shear)) -> BeamDesign {
    let shear_modulus = Material::shear_from_poisson(YOUNG, POISSON);
    BeamDesign {
        material: Material { young: YOUNG, shear: shear_modulus, density: DENSITY, damping: DAMPING },
        section: Section { torsion_constant: TORSION, ..Section::rectangle(WIDTH, HEIGHT) },
        elements: Elements::Ancf24 { poisson, shear },
        ..crate::support::machines::design("beam", 1)
    }
}

/// The element as a machine has it, undeformed at `reference`.
pub fn element(law: (bool, Shear), reference: &Coordinates) -> Element {
    Element::new(0, LENGTH, properties(law), &std::array::from_fn(|index| reference[index]))
}

fn properties(law: (bool, Shear)) -> Properties {
    let mut builder = ancf14::mechanics::system::builder::SystemBuilder::default();
    builder.add_beam(&design(law));
    let (system, _) = builder.finish(Vec3::zeros());
    crate::support::machines::ancf24_elements(&system).next().unwrap().properties
}

/// Stresses by strains `xx, yy, zz, 2 yz, 2 zx, 2 xy`, Pa.
pub fn law((poisson, shear): (bool, Shear)) -> SMatrix<f64, 6, 6> {
    let modulus = YOUNG / (2.0 * (1.0 + POISSON));
    let across = match shear {
        Shear::Continuum => modulus,
        // Of the section's torsional stiffness as its sections turn, `G ∫ (y² + z²) dA`.
        Shear::Section => modulus * TORSION / (WIDTH * HEIGHT * (WIDTH * WIDTH + HEIGHT * HEIGHT) / 12.0),
    };
    let nu = if poisson { POISSON } else { 0.0 };
    let factor = YOUNG / ((1.0 + nu) * (1.0 - 2.0 * nu));
    SMatrix::from_fn(|row, column| match (row, column) {
        (0..3, 0..3) if row == column => factor * (1.0 - nu),
        (0..3, 0..3) => factor * nu,
        (3, 3) => modulus,
        (4, 4) | (5, 5) => across,
        _ => 0.0,
    })
}

/// Weights of the element's eight vectors in `∂r/∂x`, `∂r/∂y`, `∂r/∂z` at a point of the beam as it would be straight.
fn slopes(xi: f64, y: f64, z: f64) -> [[f64; 8]; 3] {
    let l = LENGTH;
    let (first, second) = (1.0 - 4.0 * xi + 3.0 * xi * xi, 3.0 * xi * xi - 2.0 * xi);
    let along = 6.0 * (xi - xi * xi) / l;
    [
        [-along, first, -y / l, -z / l, along, second, y / l, z / l],
        [0.0, 0.0, 1.0 - xi, 0.0, 0.0, 0.0, xi, 0.0],
        [0.0, 0.0, 0.0, 1.0 - xi, 0.0, 0.0, 0.0, xi],
    ]
}

/// Weights of the eight vectors in `r(x, y, z)`.
fn shape(xi: f64, y: f64, z: f64) -> [f64; 8] {
    let (cube, square, l) = (xi * xi * xi, xi * xi, LENGTH);
    [
        1.0 - 3.0 * square + 2.0 * cube,
        l * (xi - 2.0 * square + cube),
        y * (1.0 - xi),
        z * (1.0 - xi),
        3.0 * square - 2.0 * cube,
        l * (cube - square),
        y * xi,
        z * xi,
    ]
}

fn combined<D: Scalar>(weights: &[f64; 8], q: &[D]) -> [D; 3] {
    std::array::from_fn(|axis| (0..8).map(|a| q[3 * a + axis] * weights[a]).fold(D::from(0.0), |sum, part| sum + part))
}

/// Points of the volume with their shares of `dx dy dz`, m³: `along` of them along the axis, two by two across.
fn points(along: usize) -> Vec<([f64; 3], f64)> {
    let mut list = Vec::new();
    for (xi, weight) in gauss(along) {
        for (eta, weight_y) in gauss(2) {
            for (zeta, weight_z) in gauss(2) {
                let place = [xi, (eta - 0.5) * WIDTH, (zeta - 0.5) * HEIGHT];
                list.push((place, weight * weight_y * weight_z * LENGTH * WIDTH * HEIGHT));
            }
        }
    }
    list
}

/// `∂r/∂X`, columns.
fn base(point: &[f64; 3], q: &Coordinates) -> Mat3 {
    let columns = slopes(point[0], point[1], point[2]).map(|weights| Vec3::from(combined(&weights, q.as_slice())));
    Mat3::from_columns(&columns)
}

/// The strains at all points, with what volume of the undeformed beam each stands for, m³.
pub fn strains<D: Scalar>(reference: &Coordinates, q: &[D]) -> Vec<([D; 6], f64)> {
    points(5).iter().map(|(point, share)| strain(point, *share, reference, q)).collect()
}

fn strain<D: Scalar>(point: &[f64; 3], share: f64, reference: &Coordinates, q: &[D]) -> ([D; 6], f64) {
    let undeformed = base(point, reference);
    let inverse = undeformed.try_inverse().unwrap();
    let t = undeformed.column(0).normalize();
    let y = (undeformed.column(1) - t * t.dot(&undeformed.column(1))).normalize();
    // F times the section's axes.
    let to_axes = inverse * Mat3::from_columns(&[t, y, t.cross(&y)]);
    let columns = slopes(point[0], point[1], point[2]).map(|weights| combined(&weights, q));
    let f: [[D; 3]; 3] = std::array::from_fn(|axis| {
        let parts: [[D; 3]; 3] = std::array::from_fn(|k| scale(&columns[k], D::from(to_axes[(k, axis)])));
        sum(&sum(&parts[0], &parts[1]), &parts[2])
    });
    let half = |a: usize| (dot(&f[a], &f[a]) - 1.0) * 0.5;
    let strains = [half(0), half(1), half(2), dot(&f[1], &f[2]), dot(&f[2], &f[0]), dot(&f[0], &f[1])];
    (strains, share * undeformed.determinant())
}

/// `Σ a : C : b` over all points, the strains `a` of one state and `b` of another.
pub fn product<D: Scalar>(law: &SMatrix<f64, 6, 6>, a: &[([D; 6], f64)], b: &[([D; 6], f64)]) -> D {
    let mut total = D::from(0.0);
    for ((a, volume), (b, _)) in a.iter().zip(b) {
        for (row, a) in a.iter().enumerate() {
            let stress = (0..6).fold(D::from(0.0), |sum, column| sum + b[column] * law[(row, column)]);
            total += *a * stress * *volume;
        }
    }
    total
}

/// Strain energy, J.
pub fn energy<D: Scalar>(law: &SMatrix<f64, 6, 6>, reference: &Coordinates, q: &[D]) -> D {
    let strains = strains(reference, q);
    product(law, &strains, &strains) * 0.5
}

/// Kinetic energy of the straight element at these velocities, J: of all its points.
pub fn kinetic_energy(velocity: &Coordinates) -> f64 {
    let at = |((xi, y, z), share): ((f64, f64, f64), f64)| {
        0.5 * DENSITY * share * Vec3::from(combined(&shape(xi, y, z), velocity.as_slice())).norm_squared()
    };
    points(4).into_iter().map(|([xi, y, z], share)| at(((xi, y, z), share))).sum()
}

/// Axes `t, y, z` of a section by its `r_y` and `r_z`: y along r_y, z along what of r_z is perpendicular to it
/// (MECHANICS 10.7).
pub fn axes<D: Scalar>(r_y: &[D; 3], r_z: &[D; 3]) -> [[D; 3]; 3] {
    let unit = |v: &[D; 3]| scale(v, dot(v, v).sqrt().recip());
    let y = unit(r_y);
    let z = unit(&sum(r_z, &scale(&y, -dot(&y, r_z))));
    [cross(&y, &z), y, z]
}
