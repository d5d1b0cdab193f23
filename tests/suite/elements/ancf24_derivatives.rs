//! Force, tangent, damping and mass of ANCF24 must be the derivatives of what MECHANICS 10 defines, found here by
//! automatic differentiation of the oracle's strains: straight, curved, pretwisted, sheared references, all laws. A
//! dropped or wrong term shows at 1e-3 or more; the bound is rounding: 1e-9 of the largest entry.

use crate::elements::ancf24_oracle::{self as oracle, Coordinates, DAMPING, DENSITY, LAWS};
use crate::random::Random;
use crate::support::marker_oracle::deep;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf24::damping;
use ancf14::mechanics::beam::ancf24::element::Element;
use nalgebra::{SMatrix, SVector};
use num_dual::{Dual, Dual2SVec64, HyperDualSVec64};

type Matrix = SMatrix<f64, 24, 24>;
type Mixed = HyperDualSVec64<24, 24>;

/// Rounding of a second derivative, relative to its largest entry.
const ROUNDING: f64 = 1e-9;
/// Length of a step, s.
const STEP: f64 = 0.3;

/// An element with its law and reference, in a random state.
struct Case {
    element: Element,
    law: SMatrix<f64, 6, 6>,
    reference: Coordinates,
    q: Coordinates,
}

/// Straight, and bent, twisted, sheared, stretched references, for every law.
fn cases(seed: u64) -> Vec<Case> {
    let mut random = Random(seed);
    let mut list = Vec::new();
    for kind in LAWS {
        for reference in [oracle::straight(), oracle::deformed(&mut random, 0.2)] {
            let (element, law) = (oracle::element(kind, &reference), oracle::law(kind));
            list.push(Case { element, law, reference, q: oracle::deformed(&mut random, 0.5) });
        }
    }
    list
}

fn random_vector(random: &mut Random) -> Coordinates {
    Coordinates::from_fn(|_, _| random.signed())
}

impl Case {
    fn energy(&self, q: &Coordinates) -> f64 {
        oracle::energy(&self.law, &self.reference, q.as_slice())
    }

    /// Stresses of `strains` at the middle of a step, worked by the strains at `middle + x`: the force is its
    /// derivative by x at 0.
    fn virtual_work(
        &self,
        start: &Coordinates,
        end: &SVector<Mixed, 24>,
        x: &SVector<Mixed, 24>,
        factors: [f64; 2],
    ) -> Mixed {
        let start: SVector<Mixed, 24> = start.map(Mixed::from);
        let middle = SVector::<Mixed, 24>::from_fn(|i, _| (start[i] + end[i]) * 0.5 + x[i]);
        let [virtually, from, to] = [&middle, &start, end].map(|q| oracle::strains(&self.reference, q.as_slice()));
        oracle::product(&self.law, &virtually, &from) * factors[0]
            + oracle::product(&self.law, &virtually, &to) * factors[1]
    }

    /// Rayleigh's function `∫ c rate : C : rate/2 dV` at the coordinates `q` and velocities `v`, W.
    fn rayleigh(&self, q: &SVector<Mixed, 24>, v: &SVector<Mixed, 24>) -> Mixed {
        let moving = SVector::<Dual<Mixed>, 24>::from_fn(|i, _| Dual::new(q[i], v[i]));
        let strains = oracle::strains(&self.reference, moving.as_slice());
        let rates: Vec<_> = strains.iter().map(|(strain, volume)| (strain.map(|strain| strain.eps), *volume)).collect();
        oracle::product(&self.law, &rates, &rates) * (0.5 * DAMPING)
    }
}

fn assert_close<const R: usize, const C: usize>(what: &str, found: &SMatrix<f64, R, C>, expected: &SMatrix<f64, R, C>) {
    let error = (found - expected).amax() / expected.amax();
    assert!(error < ROUNDING, "{what}: {error:e}");
}

/// Energy, gradient and Hessian; the gradient alone must be the same to the bit.
#[test]
fn gradient_and_hessian() {
    deep(check_gradient_and_hessian);
}

fn check_gradient_and_hessian() {
    for case in cases(31) {
        let energy = |q: SVector<Dual2SVec64<24>, 24>| oracle::energy(&case.law, &case.reference, q.as_slice());
        let (energy, gradient, hessian) = num_dual::hessian(energy, &case.q);
        let (mut force, mut tangent) = (Coordinates::zeros(), Matrix::zeros());
        let q = case.q.as_slice();
        case.element.add_gradient_and_hessian(q, None, 2.0, force.as_mut_slice(), tangent.as_mut_slice());
        assert!((case.element.energy(q) / energy - 1.0).abs() < ROUNDING);
        assert_close("gradient", &force, &gradient);
        assert_close("Hessian", &tangent, &(hessian * 2.0));
        let mut alone = Coordinates::zeros();
        case.element.add_gradient(q, None, alone.as_mut_slice());
        assert_eq!(alone, force);
    }
}

/// As drawn, an element of any shape has no strain, no energy and no force at all: its strains are differences of the
/// same products.
#[test]
fn undeformed_elements_are_free_of_stress() {
    for case in cases(33) {
        let mut force = Coordinates::zeros();
        case.element.add_gradient(case.reference.as_slice(), None, force.as_mut_slice());
        assert_eq!((case.element.energy(case.reference.as_slice()), force), (0.0, Coordinates::zeros()));
    }
}

/// Over a step the stresses are the means of its ends'; the tangent is twice the derivative by the coordinates at its
/// end (MECHANICS 10.5).
#[test]
fn force_and_tangent_over_a_step() {
    deep(check_force_and_tangent_over_a_step);
}

fn check_force_and_tangent_over_a_step() {
    let mut random = Random(35);
    for case in cases(34) {
        let end = case.q + random_vector(&mut random) * 0.3;
        let (middle, increment) = ((case.q + end) * 0.5, end - case.q);
        let (_, expected, _, by_end) = num_dual::partial_hessian(
            |(x, end): (SVector<Mixed, 24>, SVector<Mixed, 24>)| case.virtual_work(&case.q, &end, &x, [0.5, 0.5]),
            (&Coordinates::zeros(), &end),
        );
        let (mut force, mut tangent) = (Coordinates::zeros(), Matrix::zeros());
        let increment = Some(increment.as_slice());
        let (forces, block) = (force.as_mut_slice(), tangent.as_mut_slice());
        case.element.add_gradient_and_hessian(middle.as_slice(), increment, 1.0, forces, block);
        assert_close("force", &force, &expected);
        assert_close("tangent", &tangent, &(by_end * 2.0));
        let mut alone = Coordinates::zeros();
        case.element.add_gradient(middle.as_slice(), increment, alone.as_mut_slice());
        assert_eq!(alone, force);
    }
}

/// The force over a step works by the increment what the energy increases by, however large the step; the tolerance is
/// rounding of the energies.
#[test]
fn work_over_a_step_is_the_increment_of_the_energy() {
    let mut random = Random(37);
    for case in cases(36) {
        let end = oracle::deformed(&mut random, 0.5);
        let mut force = Coordinates::zeros();
        let (middle, increment) = ((case.q + end) * 0.5, end - case.q);
        case.element.add_gradient(middle.as_slice(), Some(increment.as_slice()), force.as_mut_slice());
        let energies = [&case.q, &end].map(|q| case.energy(q));
        let error = (force.dot(&increment) - (energies[1] - energies[0])) / (energies[0] + energies[1]);
        assert!(error.abs() < 1e-13, "{error:e}");
    }
}

/// Viscous force over a step and its tangent.
#[test]
fn damping_over_a_step() {
    deep(check_damping_over_a_step);
}

fn check_damping_over_a_step() {
    let mut random = Random(39);
    for case in cases(38) {
        let end = case.q + random_vector(&mut random) * 0.3;
        let middle = (case.q + end) * 0.5;
        let rate = DAMPING / STEP;
        let (_, expected, _, by_end) = num_dual::partial_hessian(
            |(x, end): (SVector<Mixed, 24>, SVector<Mixed, 24>)| case.virtual_work(&case.q, &end, &x, [-rate, rate]),
            (&Coordinates::zeros(), &end),
        );
        let (mut force, mut tangent, mut alone) = (Coordinates::zeros(), Matrix::zeros(), Coordinates::zeros());
        let places = [case.q.as_slice(), middle.as_slice(), end.as_slice()];
        let (forces, block) = (force.as_mut_slice(), tangent.as_mut_slice());
        damping::add_force_and_tangent_over_step(&case.element, places, STEP, 1.0, forces, block);
        assert_close("force", &force, &expected);
        assert_close("tangent", &tangent, &(by_end * 2.0));
        damping::add_force_over_step(&case.element, places, STEP, alone.as_mut_slice());
        assert_eq!(alone, force);
    }
}

/// Viscous force at an instant, the derivative of Rayleigh's function by the velocities, and its own by coordinates and
/// velocities.
#[test]
fn damping_at_an_instant() {
    deep(check_damping_at_an_instant);
}

fn check_damping_at_an_instant() {
    let mut random = Random(41);
    for case in cases(40) {
        let velocity = random_vector(&mut random);
        let (_, expected, _, by_q) = num_dual::partial_hessian(
            |(v, q): (SVector<Mixed, 24>, SVector<Mixed, 24>)| case.rayleigh(&q, &v),
            (&velocity, &case.q),
        );
        // In the velocities Rayleigh's function is quadratic: its mixed derivative by v and another copy of v.
        let still: SVector<Mixed, 24> = case.q.map(Mixed::from);
        let (_, _, _, by_v) = num_dual::partial_hessian(
            |(a, b): (SVector<Mixed, 24>, SVector<Mixed, 24>)| case.rayleigh(&still, &(a + b)),
            (&velocity, &Coordinates::zeros()),
        );
        let (mut force, mut tangent, mut matrix) = (Coordinates::zeros(), Matrix::zeros(), Matrix::zeros());
        let (q, v) = (case.q.as_slice(), velocity.as_slice());
        damping::add_force_and_tangent(&case.element, q, v, 1.0, force.as_mut_slice(), tangent.as_mut_slice());
        damping::add_force_v(&case.element, q, 1.0, matrix.as_mut_slice());
        assert_close("force", &force, &expected);
        assert_close("by the coordinates", &tangent, &by_q);
        assert_close("by the velocities", &matrix, &by_v);
        let mut alone = Coordinates::zeros();
        damping::add_force(&case.element, q, v, alone.as_mut_slice());
        assert_eq!(alone, force);
    }
}

/// The kinetic energy is that of all points of the volume, of a rectangle that is not a square; and weight pulls at the
/// mass.
#[test]
fn mass_and_weight() {
    let element = oracle::element(LAWS[0], &oracle::straight());
    let mut mass = Matrix::zeros();
    element.mass.add(1.0, mass.as_mut_slice());
    let mut random = Random(43);
    for _ in 0..20 {
        let velocity = random_vector(&mut random);
        let mut momentum = Coordinates::zeros();
        element.mass.add_times(velocity.as_slice(), momentum.as_mut_slice());
        assert_close("momentum", &momentum, &(mass * velocity));
        let energy = oracle::kinetic_energy(&velocity);
        assert!((0.5 * velocity.dot(&momentum) / energy - 1.0).abs() < ROUNDING);
    }
    // A fall of the whole element.
    let gravity = Vec3::new(1.0, -2.0, 3.0);
    let fall = Coordinates::from_fn(|i, _| if i % 12 < 3 { gravity[i % 3] } else { 0.0 });
    let mut weight = Coordinates::zeros();
    for (place, part) in [0, 3, 12, 15].into_iter().zip(element.weight(&gravity)) {
        weight.fixed_rows_mut::<3>(place).copy_from(&part);
    }
    assert_close("weight", &weight, &(mass * fall));
    let expected = DENSITY * oracle::design(LAWS[0]).section.area * oracle::LENGTH;
    assert!((fall.dot(&weight) / (expected * gravity.norm_squared()) - 1.0).abs() < ROUNDING);
}
