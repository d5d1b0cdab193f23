//! The rotary inertia that follows the sections (MECHANICS 3.3b): its momentum, its force and its velocity terms are
//! derivatives of one kinetic energy, with the frames of the nodes turned as far as one likes. A force that is not the
//! derivative of the energy, or a lost part of a frame's turn, lets a bar that spins gain energy or angular momentum.

use crate::elements::element_derivatives::random_element_state;
use crate::random::Random;
use ancf14::math::{Vec3, hermite, vectors::vec3};
use ancf14::mechanics::beam::ancf14::coordinates::{ELEMENT, NODE, P, SHAPE_PLACES, THETA, interpolate};
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::ancf14::rotary_inertia::{MassMoments, RotaryInertia, rotary_inertia};
use ancf14::mechanics::geometry::triad::Triad;
use nalgebra::{SMatrix, SVector};

type Coordinates = SVector<f64, ELEMENT>;
type Matrix = SMatrix<f64, ELEMENT, ELEMENT>;

const LENGTH: f64 = 0.7;
/// Of a section whose principal axes are not its y and z, kg m.
const MOMENTS: MassMoments = [3.0, 1.2, 0.4];
/// Change of coordinates of a central difference of fourth order: its error and round-off are both near 1e-12.
const CHANGE: f64 = 1e-3;

/// A random element with its reference triads, and random velocities.
fn random_motion(random: &mut Random) -> (Coordinates, [Triad; 2], Coordinates) {
    let (q, triads, _) = random_element_state(random, LENGTH, 0.5, 0.5);
    (q, triads, Coordinates::from_fn(|_, _| random.signed()))
}

fn frames(q: &Coordinates, triads: &[Triad; 2]) -> [NodeFrame; 2] {
    [0, 1].map(|node| NodeFrame::new(&q.as_slice()[NODE * node..NODE * (node + 1)], &triads[node]))
}

fn rest() -> RotaryInertia {
    rotary_inertia([MOMENTS; 5], LENGTH).2.expect("the moments differ")
}

/// `D v` at `q`.
fn momentum(q: &Coordinates, triads: &[Triad; 2], velocity: &Coordinates) -> Coordinates {
    let [first, second] = frames(q, triads);
    let mut momentum = Coordinates::zeros();
    rest().add_times([&first, &second], 1.0, velocity.as_slice(), momentum.as_mut_slice());
    momentum
}

/// Derivative of `value` at `q` along `direction`.
fn along(q: &Coordinates, direction: &Coordinates, value: impl Fn(&Coordinates) -> Coordinates) -> Coordinates {
    let at = |steps: f64| value(&(q + direction * (steps * CHANGE)));
    ((at(1.0) - at(-1.0)) * 8.0 - (at(2.0) - at(-2.0))) / (12.0 * CHANGE)
}

/// The constant part and the part that follows make the kinetic energy of a section that turns with its two moments,
/// `½ ∫ (ρ∫y² (y·ṙ')² + 2 ρ∫yz (y·ṙ') (z·ṙ') + ρ∫z² (z·ṙ')²) dx`, where nothing is stretched and the frame is the same
/// along the element; round-off.
#[test]
fn energy_is_that_of_the_moments() {
    let mut random = Random(7);
    let (_, _, velocity) = random_motion(&mut random);
    let axes = Triad::new(&Vec3::new(0.2, -0.5, 0.8), &Vec3::x());
    let mut q = Coordinates::zeros();
    for node in 0..2 {
        q.fixed_rows_mut::<3>(node * NODE + P).copy_from(&axes.t);
        q[node * NODE + 6] = 0.9;
    }
    let [first, second] = frames(&q, &[axes; 2]);
    let section = first.section();
    let (constant, _, rest) = rotary_inertia([MOMENTS; 5], LENGTH);
    let along = rest.unwrap().form([&first, &second], velocity.as_slice());
    let everywhere: f64 = (0..4)
        .flat_map(|a| (0..4).map(move |b| (a, b)))
        .map(|(a, b)| {
            let [a_velocity, b_velocity] = [a, b].map(|place| vec3(velocity.as_slice(), SHAPE_PLACES[place]));
            constant[a][b] * a_velocity.dot(&b_velocity)
        })
        .sum();
    // Simpson's rule over ten pieces is exact to 1e-5 for a polynomial of degree 4: a finer one to round-off.
    let pieces = 2000;
    let expected: f64 = (0..=pieces)
        .map(|number| {
            let weight = if number == 0 || number == pieces { 1.0 } else { f64::from(2 + 2 * (number % 2)) };
            let rate =
                interpolate(&hermite::shape_x(f64::from(number) / f64::from(pieces), LENGTH), velocity.as_slice());
            let [t, y, z] = [0, 1, 2].map(|axis| section.column(axis).dot(&rate));
            // The constant part has the smaller moment along the tangent too: a part of the stretch.
            let least = 2.1 - 0.9_f64.hypot(0.4);
            let form = MOMENTS[0] * y * y + 2.0 * MOMENTS[2] * y * z + MOMENTS[1] * z * z + least * t * t;
            weight * form * LENGTH / (3.0 * f64::from(pieces))
        })
        .sum();
    assert!((along + everywhere - expected).abs() < 1e-11 * expected, "{} {expected}", along + everywhere);
}

/// The force is the derivative of the energy with respect to the coordinates, and the rate of the momentum that along
/// the velocities.
#[test]
fn forces_are_derivatives_of_the_energy() {
    let mut random = Random(11);
    for _ in 0..20 {
        let (q, triads, velocity) = random_motion(&mut random);
        let [first, second] = frames(&q, &triads);
        let mut gradient = Coordinates::zeros();
        rest().add_gradient([&first, &second], 1.0, velocity.as_slice(), gradient.as_mut_slice());
        let energy = |q: &Coordinates| Coordinates::from_element(0.5 * momentum(q, &triads, &velocity).dot(&velocity));
        for number in 0..ELEMENT {
            let mut unit = Coordinates::zeros();
            unit[number] = 1.0;
            let expected = along(&q, &unit, energy)[0];
            assert!((gradient[number] - expected).abs() < 1e-9, "{number}: {} {expected}", gradient[number]);
        }
        let rate = rest().rate_times([&first, &second], velocity.as_slice());
        let expected = along(&q, &velocity, |q| momentum(q, &triads, &velocity));
        assert!((rate - expected).amax() < 1e-9, "{rate} {expected}");
    }
}

/// The matrix is that of the momentum, its bound acts along all axes, and its gyroscopic part is the skew part of the
/// derivative of the momentum with respect to the angles.
#[test]
fn matrices_are_those_of_the_momentum() {
    let mut random = Random(13);
    for _ in 0..20 {
        let (q, triads, velocity) = random_motion(&mut random);
        let [first, second] = frames(&q, &triads);
        let (mut mass, mut gyroscopic) = (Matrix::zeros(), Matrix::zeros());
        rest().add([&first, &second], 2.0, mass.as_mut_slice());
        assert!((mass * velocity - momentum(&q, &triads, &velocity) * 2.0).amax() < 1e-13);
        let mut bound = Matrix::zeros();
        rest().add_everywhere(bound.as_mut_slice());
        let mut lacking = Coordinates::zeros();
        rest().add_lacking_times([&first, &second], velocity.as_slice(), lacking.as_mut_slice());
        assert!((bound * velocity - mass * velocity * 0.5 - lacking).amax() < 1e-13);
        assert!((bound - mass * 0.5).symmetric_eigenvalues().min() > -1e-13);
        rest().add_gyroscopic([&first, &second], velocity.as_slice(), 2.0, gyroscopic.as_mut_slice());
        let mut by_q = Matrix::zeros();
        for number in [THETA, NODE + THETA] {
            let mut unit = Coordinates::zeros();
            unit[number] = 1.0;
            by_q.set_column(number, &along(&q, &unit, |q| momentum(q, &triads, &velocity)));
        }
        let expected = (by_q - by_q.transpose()) * 2.0;
        assert!((gyroscopic - expected).amax() < 1e-9, "{}", (gyroscopic - expected).amax());
    }
}
