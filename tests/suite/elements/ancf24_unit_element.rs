//! One undeformed and one sheared element of ANCF24 against the numbers that Project Chrono tests its own with, in
//! tests/references/ancf24_unit_element.csv: mass, weight, internal force, both tangents.
//!
//! Chrono splits the material: what does not couple strains, `diag(E, E, E, G, k G, k G)`, acts over the whole section,
//! the rest, of Poisson's effect, on the axis alone. Ours does not, but its sections can be put together so: fibers
//! without distance from the axis lie on it.

use crate::support::gauss::gauss;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf24::coordinates::ELEMENT;
use ancf14::mechanics::beam::ancf24::element::{Element, Properties};
use ancf14::mechanics::beam::ancf24::station::{Fibers, Station};
use ancf14::mechanics::beam::ancf24::strain::VoigtMatrix;
use nalgebra::{SMatrix, SVector};

const LENGTH: f64 = 1.0;
const WIDTH: f64 = 0.1;
const DENSITY: f64 = 7850.0;
const YOUNG: f64 = 210e9;
const POISSON: f64 = 0.3;
/// Points along the axis, of both parts of the energy: the file's numbers are exact integrals (four points miss them by
/// 5e-8, three by 1e-4; strains are of fourth degree in the length, their squares of eighth).
const POINTS: usize = 5;
/// The file has 15 digits, of entries that sums of larger terms make.
const ROUNDING: f64 = 1e-9;

/// The rows of the file called `name`, without name and number.
fn table<const R: usize, const C: usize>(name: &str) -> SMatrix<f64, R, C> {
    let text = include_str!("../../references/ancf24_unit_element.csv");
    let rows: Vec<Vec<f64>> = text
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>())
        .filter(|cells| cells[0] == name)
        .map(|cells| cells[2..].iter().map(|cell| cell.parse().unwrap()).collect())
        .collect();
    assert_eq!((rows.len(), rows[0].len()), (R, C), "{name}");
    SMatrix::from_fn(|row, column| rows[row][column])
}

/// Normal stresses of Poisson's effect beyond those of Young's modulus alone, and what does not couple.
fn laws() -> [VoigtMatrix; 2] {
    let shear = YOUNG / (2.0 * (1.0 + POISSON));
    let factor = 10.0 * (1.0 + POISSON) / (12.0 + 11.0 * POISSON);
    let alone = [YOUNG, YOUNG, YOUNG, shear, shear * factor, shear * factor];
    let coupling = YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON));
    let mut coupled = VoigtMatrix::zeros();
    for row in 0..3 {
        for column in 0..3 {
            coupled[(row, column)] = coupling * if row == column { 2.0 * POISSON } else { 1.0 };
        }
    }
    [VoigtMatrix::from_diagonal(&SVector::from(alone)), coupled]
}

/// Chrono's element, undeformed, and its coordinates.
fn element() -> (Element, [f64; ELEMENT]) {
    let mut reference = [0.0; ELEMENT];
    for node in 0..2 {
        reference[12 * node] = LENGTH * node as f64;
        (0..3).for_each(|axis| reference[12 * node + 3 + 4 * axis] = 1.0);
    }
    let area = WIDTH * WIDTH;
    let distance = (WIDTH * WIDTH / 12.0_f64).sqrt();
    let fibers = [Fibers { area, y: distance, z: distance }, Fibers { area, y: 0.0, z: 0.0 }];
    let properties = Properties {
        law: laws()[0],
        fibers: fibers[0],
        line_density: DENSITY * area,
        section_inertia: [DENSITY * area * distance * distance; 2],
        damping: 0.0,
    };
    let mut stations = Vec::new();
    for (fibers, law) in fibers.iter().zip(laws()) {
        let station = |(xi, weight)| Station::new(xi, LENGTH, &reference, fibers, &law, weight * LENGTH);
        stations.extend(gauss(POINTS).into_iter().map(station));
    }
    (Element { stations, ..Element::new(0, LENGTH, properties, &reference) }, reference)
}

fn force_and_tangent(element: &Element, q: &[f64]) -> (SVector<f64, ELEMENT>, SMatrix<f64, ELEMENT, ELEMENT>) {
    let mut force = SVector::<f64, ELEMENT>::zeros();
    let mut tangent = SMatrix::<f64, ELEMENT, ELEMENT>::zeros();
    element.add_gradient_and_hessian(q, None, 1.0, force.as_mut_slice(), tangent.as_mut_slice());
    (force, tangent)
}

/// Largest difference relative to the largest entry.
fn error<const R: usize, const C: usize>(found: &SMatrix<f64, R, C>, expected: &SMatrix<f64, R, C>) -> f64 {
    (found - expected).amax() / expected.amax()
}

/// The second node moved by 1 mm along z.
fn sheared(reference: &[f64; ELEMENT]) -> [f64; ELEMENT] {
    let mut q = *reference;
    q[14] += 0.001;
    q
}

/// Mass and weight; the tolerance is the file's digits.
#[test]
fn mass_and_weight() {
    let (element, _) = element();
    let mut mass = SMatrix::<f64, ELEMENT, ELEMENT>::zeros();
    element.mass.add(1.0, mass.as_mut_slice());
    let scalar: SMatrix<f64, 8, 8> = table("M");
    let expected =
        SMatrix::from_fn(|row, column| if row % 3 == column % 3 { scalar[(row / 3, column / 3)] } else { 0.0 });
    let of_mass = error(&mass, &expected);
    let mut weight = SVector::<f64, ELEMENT>::zeros();
    for (place, part) in [0, 3, 12, 15].into_iter().zip(element.weight(&Vec3::new(0.0, 0.0, -9.80665))) {
        weight.fixed_rows_mut::<3>(place).copy_from(&part);
    }
    let of_weight = error(&weight, &table::<ELEMENT, 1>("Qgrav"));
    println!("mass {of_mass:.1e}, weight {of_weight:.1e}");
    assert!(of_mass < ROUNDING && of_weight < ROUNDING);
}

/// Internal force of the sheared element and the tangents of both states; the tolerance is the file's digits.
#[test]
fn force_and_tangents() {
    let (element, reference) = element();
    let (force_0, tangent_0) = force_and_tangent(&element, &reference);
    let (force_1, tangent_1) = force_and_tangent(&element, &sheared(&reference));
    assert_eq!(force_0.amax(), 0.0);
    let errors =
        [error(&-force_1, &table("Qint_smalldisp")), error(&tangent_0, &table("K0")), error(&tangent_1, &table("K1"))];
    println!("force {:.1e}, tangents {:.1e}, {:.1e}", errors[0], errors[1], errors[2]);
    assert!(errors.iter().all(|error| *error < ROUNDING), "{errors:?}");
}
