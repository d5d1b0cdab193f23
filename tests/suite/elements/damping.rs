//! Kelvin-Voigt damping must be the dissipation that MECHANICS 3.8 defines: its forces the derivatives of Rayleigh's
//! function by the velocities, its tangents the derivatives of its forces, all found here by automatic differentiation
//! of the oracle's strains. A rigid motion must not be damped, any other must lose energy. A dropped or wrong term
//! shows at 1e-3 or more; the bound is rounding.

use crate::elements::element_derivatives::{curved, random_element_state, stiffness, straight};
use crate::random::Random;
use crate::support::oracle::{self, Scalar};
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf14::damping::{self, StrainVector};
use ancf14::mechanics::beam::ancf14::element::{Element, Evaluation, Place};
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::ancf14::natural::Natural;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::geometry::triad::Triad;
use nalgebra::{SMatrix, SVector};
use num_dual::{Dual, Dual2SVec64, DualSVec64, HyperDualSVec64};

type Coordinates = SVector<f64, 14>;
type Mixed = HyperDualSVec64<14, 14>;

const STRAINS: [Strain; 3] = [Strain::Small, Strain::Large, Strain::LargeTruncated];
/// Rounding of a second derivative, relative to its largest entry.
const ROUNDING: f64 = 1e-9;

/// An element in a random state: coordinates, reference triads, last accepted holonomy angle.
struct Case {
    element: Element,
    q: Coordinates,
    triads: [Triad; 2],
    previous: f64,
}

impl Case {
    fn random(random: &mut Random, element: Element) -> Self {
        let (q, triads, previous) = random_element_state(random, 0.7, 1.0, 1.5);
        Self { element, q, triads, previous }
    }

    /// Hands an evaluation at `q` to `use_it`.
    fn at<T>(&self, q: &Coordinates, use_it: impl FnOnce(&Evaluation) -> T) -> T {
        let q = q.as_slice();
        let frames = [NodeFrame::new(&q[..7], &self.triads[0]), NodeFrame::new(&q[7..], &self.triads[1])];
        use_it(&Evaluation::new(&self.element, q, [&frames[0], &frames[1]], self.previous, &Natural::default()))
    }

    /// The oracle's strains.
    fn strains<D: Scalar>(&self, q: &SVector<D, 14>) -> SVector<D, 12> {
        SVector::from(oracle::strains(&self.element, q.as_slice(), D::from(0.0), &self.triads, self.previous))
    }

    /// Viscous resultant over rate of each strain, from the definition, but for what couples axial strains with
    /// curvatures.
    fn viscosities(&self) -> [f64; 12] {
        let element = &self.element;
        let [a, b, c] = element.axial.each_ref().map(|point| point.stiffness.axial * point.weight);
        let bending = element.bending.each_ref().map(|point| {
            let k = point.stiffness;
            [k.bending_z, k.bending_y, k.torsion].map(|d| d * point.weight)
        });
        let [[d, e, f], [g, h, i], [j, k, l]] = bending;
        let all = element.stiffness.damping;
        let [a, b, c] = [a, b, c].map(|value| value * (all + element.tension_damping));
        let [d, e, f, g, h, i, j, k, l] = [d, e, f, g, h, i, j, k, l].map(|value| value * all);
        [a, b, c, d, e, f, g, h, i, j, k, l]
    }

    /// Rayleigh's function `Σ c W D rate²/2` at the coordinates `q` and velocities `v`, W.
    fn rayleigh(&self, q: &SVector<Mixed, 14>, v: &SVector<Mixed, 14>) -> Mixed {
        let moving = SVector::<Dual<Mixed>, 14>::from_fn(|i, _| Dual::new(q[i], v[i]));
        let rates = self.strains(&moving).map(|strain| strain.eps);
        let own: Mixed =
            rates.iter().zip(self.viscosities()).map(|(rate, viscosity)| *rate * *rate * (0.5 * viscosity)).sum();
        let Some(all) = &self.element.eccentricities else { return own };
        let off_axis = self.element.bending.iter().zip(all.iter()).enumerate().map(|(g, (point, eccentricity))| {
            let [w0, w1, w2] = point.from_axial;
            let axial = rates[0] * w0 + rates[1] * w1 + rates[2] * w2;
            let [s1, s2] = eccentricity.first;
            axial * (rates[3 + 3 * g] * s1 + rates[4 + 3 * g] * s2) * (-point.weight * self.element.stiffness.damping)
        });
        own + off_axis.sum::<Mixed>()
    }
}

/// Straight and curved, twisted, stretched references for every strain.
fn cases(seed: u64) -> Vec<Case> {
    let mut random = Random(seed);
    let mut list = Vec::new();
    for strain in STRAINS {
        for _ in 0..6 {
            list.push(Case::random(&mut random, straight(0.7, stiffness(strain))));
            let mut element = curved(&mut random, 0.7, stiffness(strain));
            element.tension_damping = 0.03;
            list.push(Case::random(&mut random, element));
        }
    }
    list
}

fn random_velocity(random: &mut Random) -> Coordinates {
    Coordinates::from_fn(|_, _| random.signed())
}

/// Largest difference relative to the largest entry.
fn error<const R: usize, const C: usize>(found: &SMatrix<f64, R, C>, expected: &SMatrix<f64, R, C>) -> f64 {
    (found - expected).amax() / expected.amax()
}

fn assert_close<const R: usize, const C: usize>(what: &str, found: &SMatrix<f64, R, C>, expected: &SMatrix<f64, R, C>) {
    let error = error(found, expected);
    assert!(error < ROUNDING, "{what}: {error:e}\n{:.3}", found - expected);
}

/// Derivative of the viscous force by the velocities.
fn by_velocity(evaluation: &Evaluation, velocity: &Coordinates) -> SMatrix<f64, 14, 14> {
    damping::force_and_tangent(evaluation, velocity, [0.0, 1.0]).1
}

#[test]
fn strains_and_their_derivatives() {
    let mut random = Random(21);
    for case in cases(20) {
        let (strains, strains_q) = num_dual::jacobian(|q: SVector<DualSVec64<14>, 14>| case.strains(&q), &case.q);
        let resultants = StrainVector::from_fn(|_, _| random.signed());
        let contracted = |q: SVector<Dual2SVec64<14>, 14>| -> Dual2SVec64<14> {
            case.strains(&q).iter().zip(&resultants).map(|(strain, factor)| *strain * *factor).sum()
        };
        let (_, _, hessian) = num_dual::hessian(contracted, &case.q);
        case.at(&case.q, |evaluation| {
            assert_close("strains", &damping::strains(evaluation), &strains);
            assert_close("gradients", &damping::strains_q(evaluation), &strains_q.transpose());
            assert_close("Hessian", &damping::stress_hessian(evaluation, &resultants), &hessian);
        });
    }
}

#[test]
fn force_and_derivatives_at_an_instant() {
    let mut random = Random(25);
    for case in cases(24) {
        let velocity = random_velocity(&mut random);
        let (_, force, _, force_q) = num_dual::partial_hessian(
            |(v, q): (SVector<Mixed, 14>, SVector<Mixed, 14>)| case.rayleigh(&q, &v),
            (&velocity, &case.q),
        );
        // In the velocities Rayleigh's function is quadratic: its mixed derivative by v and another copy of v.
        let still: SVector<Mixed, 14> = case.q.map(Mixed::from);
        let (_, _, _, force_v) = num_dual::partial_hessian(
            |(a, b): (SVector<Mixed, 14>, SVector<Mixed, 14>)| case.rayleigh(&still, &(a + b)),
            (&velocity, &Coordinates::zeros()),
        );
        case.at(&case.q, |evaluation| {
            assert_close("force", &damping::force(evaluation, &velocity), &force);
            let (again, by_q) = damping::force_and_tangent(evaluation, &velocity, [1.0, 0.0]);
            assert_close("force beside its tangent", &again, &force);
            assert_close("by the coordinates", &by_q, &force_q);
            assert_close("by the velocities", &by_velocity(evaluation, &velocity), &force_v);
        });
    }
}

/// Where the beam is undeformed, Kelvin-Voigt damping is stiffness-proportional: `c` times the elastic tangent,
/// whatever the strain measure.
#[test]
fn at_rest_damping_is_proportional_to_stiffness() {
    let triad = Triad { t: Vec3::x(), u: Vec3::y() };
    for strain in STRAINS {
        let element = straight(0.7, stiffness(strain));
        let mut q = Coordinates::zeros();
        (q[3], q[7], q[10]) = (1.0, 0.7, 1.0);
        let case = Case { element, q, triads: [triad; 2], previous: 0.0 };
        case.at(&q, |evaluation| {
            let (_, stiffness) = evaluation.gradient_and_hessian();
            let by_velocity = by_velocity(evaluation, &Coordinates::zeros());
            assert_close("damping", &by_velocity, &(stiffness * case.element.stiffness.damping));
        });
    }
}

/// Whatever the motion, damping takes power out of it: a sum of squares, and as a form in all velocities without a
/// negative direction (but for rounding of its 6 rigid motions).
#[test]
fn damping_dissipates() {
    let mut random = Random(29);
    for case in cases(28) {
        let velocity = random_velocity(&mut random);
        let (power, by_velocity) = case.at(&case.q, |evaluation| {
            (velocity.dot(&damping::force(evaluation, &velocity)), by_velocity(evaluation, &velocity))
        });
        assert!(power > 0.0, "{power:e}");
        let powers = by_velocity.symmetric_eigenvalues();
        assert!(powers.min() > -1e-12 * powers.max(), "{powers:e}");
    }
}

/// What the velocities change by with the coordinates, 1/s: the damping then doubles the rigidities.
const VELOCITY_BY_Q: f64 = 50.0;

/// Force and matrix of the energy and the damping, with the derivatives of both.
fn exact(evaluation: &Evaluation, velocity: &Coordinates) -> (Coordinates, SMatrix<f64, 14, 14>) {
    let (force, tangent) = evaluation.gradient_and_hessian();
    let (viscous, viscous_tangent) = damping::force_and_tangent(evaluation, velocity, [1.0, VELOCITY_BY_Q]);
    (force + viscous, tangent + viscous_tangent)
}

/// Force and matrix of Newton's iteration.
fn of_iteration(evaluation: &Evaluation, velocity: &Coordinates) -> (Coordinates, SMatrix<f64, 14, 14>) {
    let mut damped = evaluation.clone();
    damped.set_damping(velocity.as_slice(), VELOCITY_BY_Q);
    damped.gradient_and_hessian()
}

/// The matrix of the iteration is an approximation, its force is not. Where nothing moves the matrix is exact, whatever
/// the shape; what the damping takes is the work of its force.
#[test]
fn iteration_has_the_exact_force() {
    let mut random = Random(31);
    for case in cases(30) {
        let (velocity, still) = (random_velocity(&mut random), Coordinates::zeros());
        case.at(&case.q, |evaluation| {
            assert_close("force", &of_iteration(evaluation, &velocity).0, &exact(evaluation, &velocity).0);
            assert_close("matrix", &of_iteration(evaluation, &still).1, &exact(evaluation, &still).1);
            let (power, taken) =
                (velocity.dot(&damping::force(evaluation, &velocity)), evaluation.viscous_power(velocity.as_slice()));
            assert!((power - taken).abs() < ROUNDING * power, "{power:e}, {taken:e}");
        });
    }
}

/// An element that turns as a whole without being deformed, however its nodes' frames have turned from their
/// references, has the exact matrix of the iteration: the derivatives of its strains turn with it. Without their turn
/// the matrix would be off by a hundredth of its largest entry.
#[test]
fn turning_as_a_whole_leaves_the_matrix_exact() {
    let mut random = Random(33);
    for case in cases(32) {
        let Case { q, triads, previous, .. } = case;
        let own = q.as_slice();
        let nodes = [NodeFrame::new(&own[..7], &triads[0]), NodeFrame::new(&own[7..], &triads[1])];
        let stiffness = case.element.stiffness;
        let mut element =
            Element::new(Place::default(), 0.7, stiffness, [1.0, 0.1], own, [&nodes[0], &nodes[1]], previous);
        element.tension_damping = case.element.tension_damping;
        let (spin, mut velocity) = (random.vector() * 2.0, Coordinates::zeros());
        for (node, frame) in nodes.iter().enumerate() {
            let at = |place: usize| Vec3::from_column_slice(&own[7 * node + place..7 * node + place + 3]);
            let slope_rate = spin.cross(&at(3));
            velocity.fixed_rows_mut::<3>(7 * node).copy_from(&spin.cross(&at(0)));
            velocity.fixed_rows_mut::<3>(7 * node + 3).copy_from(&slope_rate);
            // The section turns about its tangent with the spin too (MECHANICS 2.5).
            velocity[7 * node + 6] = frame.t.dot(&spin) + frame.k.dot(&slope_rate) / frame.stretch;
        }
        let case = Case { element, q, triads, previous };
        case.at(&q, |evaluation| {
            let expected = exact(evaluation, &velocity).1;
            assert_close("matrix", &of_iteration(evaluation, &velocity).1, &expected);
            let turned = error(&of_iteration(evaluation, &Coordinates::zeros()).1, &expected);
            assert!(turned > 1e-3, "{turned:e}");
        });
    }
}
