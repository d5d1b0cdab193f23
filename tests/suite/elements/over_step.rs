//! Forces over a step (MECHANICS 7.6): the resultants of the mean strains along the derivatives of the strains in the
//! middle. They must work as much as the energy changes but for third order, must not see rigid motions however far
//! they turn, must lose energy to damping and to nothing else; and the tangent must follow large turns, or Newton would
//! need many iterations wherever something rotates.

use crate::elements::element_derivatives::{curved, random_element_state, stiffness, straight};
use crate::random::Random;
use crate::support::oracle;
use ancf14::math::rotation;
use ancf14::mechanics::beam::ancf14::damping;
use ancf14::mechanics::beam::ancf14::element::Element;
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::ancf14::over_step::{EndStrains, STRAINS};
use ancf14::mechanics::beam::ancf14::strain::{Stiffness, Strain};
use ancf14::mechanics::beam::configuration::{BeamConfiguration, Dissipation, Passage, TimeStep};
use ancf14::mechanics::beam::element::BeamElement;
use ancf14::mechanics::geometry::triad::Triad;
use nalgebra::{SMatrix, SVector};
use num_dual::DualSVec64;

type Coordinates = SVector<f64, 14>;
type Matrix = SMatrix<f64, 14, 14>;

/// Length of the step, s.
const STEP: f64 = 0.3;

/// An element at the start of a step, in charts centered there.
struct Case {
    element: Element,
    start: Coordinates,
    triads: [Triad; 2],
    previous: f64,
}

/// What an element answers over a step.
struct Answer {
    force: Coordinates,
    tangent: Matrix,
    /// Elastic energy at the end, J, and what damping has taken and heat has given.
    end: [f64; 3],
    rates: [f64; STRAINS],
}

impl Case {
    fn new(random: &mut Random, element: Element) -> Self {
        let (start, triads, previous) = random_element_state(random, 0.7, 0.5, 0.5);
        let frames = [0, 1].map(|i| NodeFrame::new(&start.as_slice()[7 * i..7 * i + 7], &triads[i]));
        let mut case = Self { element, start, triads: frames.map(|frame| frame.carried()), previous };
        // The holonomy angle of this very state.
        let frames = case.frames(&case.start);
        case.previous =
            ancf14::mechanics::beam::ancf14::kinematics::Holonomy::new(&frames[0], &frames[1], previous).angle;
        case
    }

    fn frames(&self, q: &Coordinates) -> Vec<NodeFrame> {
        (0..2).map(|i| NodeFrame::new(&q.as_slice()[7 * i..7 * i + 7], &self.triads[i])).collect()
    }

    fn over(&self, end: &Coordinates, dissipation: Dissipation) -> Answer {
        let (middle, increment) = ((self.start + end) * 0.5, end - self.start);
        let states = [&self.start, &middle, end];
        let frames = states.map(|q| self.frames(q));
        let holonomy = [self.previous];
        let at = |i: usize| BeamConfiguration {
            q: states[i].as_slice(),
            frames: &frames[i],
            holonomy: &holonomy,
            heats: &[],
            drives: &[],
        };
        let (start, middle, end) = (at(0), at(1), at(2));
        let still = [0.0; STRAINS];
        let begin = EndStrains::new(&self.element.evaluation(&start));
        let step = TimeStep {
            start: &start,
            end: &end,
            increment: increment.as_slice(),
            duration: STEP,
            velocity: &[],
            dissipation,
            strain_rates: &still,
            predicted_rates: &still,
            velocity_lead: &[],
            starts: &[begin],
        };
        let (mut force, mut tangent) = (Coordinates::zeros(), Matrix::zeros());
        let passage = Passage::Step(step);
        self.element.add_gradient_and_set_hessian(&middle, &passage, 1.0, force.as_mut_slice(), tangent.as_mut_slice());
        let (mut alone, mut finished) = (Coordinates::zeros(), Coordinates::zeros());
        self.element.add_gradient(&middle, &passage, alone.as_mut_slice());
        let mut rates = [0.0; STRAINS];
        let end = self.element.finish_step(&middle, &step, finished.as_mut_slice(), &mut rates);
        assert_eq!((alone, finished), (force, force));
        Answer { force, tangent, end, rates }
    }

    /// The state turned by `turn` and shifted, rigidly.
    fn moved(&self, random: &mut Random, angle: f64) -> Coordinates {
        let (turn, shift) = (rotation::rotation_matrix(&(random.direction() * angle)), random.vector());
        let mut end = self.start;
        for (i, frame) in self.frames(&self.start).iter().enumerate() {
            let place = turn * self.start.fixed_rows::<3>(7 * i) + shift;
            let slope = turn * self.start.fixed_rows::<3>(7 * i + 3);
            end.fixed_rows_mut::<3>(7 * i).copy_from(&place);
            end.fixed_rows_mut::<3>(7 * i + 3).copy_from(&slope);
            // The angle at which the frame carried along the tangent has the section turned with the rest, on the
            // nearest branch.
            let carried = NodeFrame::new(&end.as_slice()[7 * i..7 * i + 7], &self.triads[i]);
            let (y, axes) = (turn * frame.section().column(1), carried.section());
            end[7 * i + 6] += f64::atan2(y.dot(&axes.column(2)), y.dot(&axes.column(1)));
        }
        end
    }
}

/// Straight and curved elements of every strain and twist, without damping.
fn cases(seed: u64) -> Vec<Case> {
    let mut random = Random(seed);
    let mut cases = Vec::new();
    for strain in [Strain::Small, Strain::Large, Strain::LargeTruncated] {
        for twist in [Twist::Linear, Twist::Quadratic] {
            let own = Stiffness { twist, damping: 0.0, ..stiffness(strain) };
            for _ in 0..4 {
                let element = straight(0.7, own);
                cases.push(Case::new(&mut random, element));
                let element = curved(&mut random, 0.7, own);
                cases.push(Case::new(&mut random, element));
            }
        }
    }
    cases
}

/// The definition, in the oracle's strains and their derivatives by automatic differentiation; stretching, which has a
/// direction of its own, is left out.
#[test]
fn force_by_definition() {
    let mut random = Random(41);
    let dissipation = Dissipation { by_last_step: 0.03, by_start: 0.02 };
    for _ in 0..20 {
        let own = Stiffness { axial: 0.0, damping: 0.05, ..stiffness(Strain::Small) };
        let element = Element { eccentricities: None, ..curved(&mut random, 0.7, own) };
        let case = Case::new(&mut random, element);
        let end = case.start + Coordinates::from_fn(|_, _| 0.1 * random.signed());
        let strains = |q: SVector<DualSVec64<14>, 14>| {
            SVector::from(oracle::strains(&case.element, q.as_slice(), 0.0.into(), &case.triads, case.previous))
        };
        let [(first, _), (_, middle_q), (last, _)] =
            [case.start, (case.start + end) * 0.5, end].map(|q| num_dual::jacobian(strains, &q));
        let rigidities = SVector::<f64, STRAINS>::from(case.element.rigidities());
        let stresses = (first + last) * 0.5 + (last - first) * (0.05 / STEP + dissipation.sum());
        let expected = middle_q.transpose() * rigidities.component_mul(&stresses);
        let Answer { force, rates, end: [_, taken, _], .. } = case.over(&end, dissipation);
        let error = (force - expected).amax() / expected.amax();
        assert!(error < 1e-12, "force: {error:e}");
        let expected_rates = (last - first) / STEP;
        let error = (SVector::from(rates) - expected_rates).amax() / expected_rates.amax();
        assert!(error < 1e-12, "rates: {error:e}");
        let expected = 0.05 * STEP * rigidities.dot(&expected_rates.component_mul(&expected_rates));
        assert!((taken / expected - 1.0).abs() < 1e-12, "{taken} {expected}");
    }
}

/// What the force works beyond the change of the energy falls with the third power of the increment: by 1000 from 0.01
/// to 0.001, one of order 2 by 100; but where rounding of the energies, 1e-16 of some 10 J, shows.
#[test]
fn work_is_the_change_of_energy() {
    let mut random = Random(42);
    // Of all cases together: in a single one terms of the third power may cancel each other.
    let mut excess = [0.0; 2];
    for case in cases(43) {
        let direction = Coordinates::from_fn(|_, _| random.signed());
        let still = case.over(&case.start, Dissipation::default()).end[0];
        for (sum, size) in excess.iter_mut().zip([0.01, 0.001]) {
            let answer = case.over(&(case.start + direction * size), Dissipation::default());
            *sum += (answer.force.dot(&direction) * size - (answer.end[0] - still)).abs();
        }
    }
    assert!(excess[1] < 3e-3 * excess[0], "{excess:?}");
}

/// A turn of 1.2 rad within one step and a shift: no strain changes, and the damping takes nothing. Rounding of strains
/// of order 1 in these units.
#[test]
fn rigid_motions_change_nothing() {
    let mut random = Random(44);
    let dissipation = Dissipation { by_last_step: 0.1, by_start: 0.1 };
    for mut case in cases(45) {
        case.element.stiffness.damping = 0.05;
        let end = case.moved(&mut random, 1.2);
        let answer = case.over(&end, dissipation);
        let largest = answer.rates.iter().fold(0.0, |largest: f64, rate| largest.max(rate.abs()));
        assert!(largest * STEP < 1e-12, "strains change by {largest:e}");
        assert!(answer.end[1] < 1e-20, "damping takes {:e} J", answer.end[1]);
    }
}

/// Over a short step the tangent is twice the derivative of the force by the end's coordinates, found by central
/// differences: but for the quadratic twist, whose internal coordinate does not follow the dissipation, a share of
/// 0.04. Over a rigid turn of 0.5 rad it errs by less than half the sine of half the turn, by which the derivatives of
/// the middle alone would err.
#[test]
fn tangent_follows_turns() {
    let mut random = Random(46);
    for mut case in cases(47) {
        if case.element.stiffness.twist == Twist::Linear {
            // The damping of the quadratic twist is that of the linear one, as the dissipation is.
            (case.element.stiffness.damping, case.element.tension_damping) = (0.01, 0.02);
        }
        let direction = Coordinates::from_fn(|_, _| random.signed());
        for (end, tolerance) in
            [(case.start + direction * 1e-5, 5e-3), (case.moved(&mut random, 0.5), 0.5 * 0.25_f64.sin())]
        {
            let answer = case.over(&end, Dissipation { by_last_step: 0.02, by_start: 0.0 });
            let mut differences = Matrix::zeros();
            let width = 1e-5;
            for column in 0..14 {
                let mut shift = Coordinates::zeros();
                shift[column] = width;
                let [more, less] = [end + shift, end - shift]
                    .map(|end| case.over(&end, Dissipation { by_last_step: 0.02, by_start: 0.0 }).force);
                differences.set_column(column, &((more - less) / width));
            }
            let error = (answer.tangent - differences).amax() / differences.amax();
            assert!(error < tolerance, "{error:e} of {tolerance:e} in {:?}", case.element.stiffness);
        }
    }
}

/// Over a step so short that strains change in proportion to it, damping does what it does at an instant with the mean
/// velocity; and takes the work of that force. Coupled strains and the damping of tension included. The increment is
/// 1e-6: what is of its second order, and rounding over it, are below 1e-5.
#[test]
fn damping_over_a_short_step_is_that_of_an_instant() {
    let mut random = Random(50);
    for mut case in cases(51).into_iter().filter(|case| case.element.stiffness.twist == Twist::Linear) {
        let increment = Coordinates::from_fn(|_, _| random.signed()) * 1e-6;
        let end = case.start + increment;
        let still = case.over(&end, Dissipation::default());
        (case.element.stiffness.damping, case.element.tension_damping) = (0.05, 0.03);
        let damped = case.over(&end, Dissipation::default());
        let frames = case.frames(&case.start);
        let holonomy = [case.previous];
        let c = BeamConfiguration {
            q: case.start.as_slice(),
            frames: &frames,
            holonomy: &holonomy,
            heats: &[],
            drives: &[],
        };
        let expected = damping::force(&case.element.evaluation(&c), &(increment / STEP));
        let error = (damped.force - still.force - expected).amax() / expected.amax();
        assert!(error < 1e-5, "{error:e} in {:?}", case.element.stiffness);
        let work = expected.dot(&increment);
        assert!((damped.end[1] / work - 1.0).abs() < 1e-5, "{:e} {work:e}", damped.end[1]);
    }
}

/// The rates of an instant are those over a step along the velocity, to the square of the step's length: also of the
/// quadratic twist, whose internal coordinate moves along.
#[test]
fn rates_of_an_instant_are_those_of_a_short_step() {
    let mut random = Random(48);
    for case in cases(49) {
        let velocity = Coordinates::from_fn(|_, _| random.signed());
        let [there, back] =
            [1e-4, -1e-4].map(|time| case.over(&(case.start + velocity * time), Dissipation::default()).rates);
        let holonomy = [case.previous];
        let frames = case.frames(&case.start);
        let c = BeamConfiguration {
            q: case.start.as_slice(),
            frames: &frames,
            holonomy: &holonomy,
            heats: &[],
            drives: &[],
        };
        let found = case.element.strain_rates(&case.element.evaluation(&c), velocity.as_slice());
        // Central differences over the time of both steps.
        let expected: Vec<f64> = there.iter().zip(&back).map(|(a, b)| 0.5 * (a - b) * STEP / 1e-4).collect();
        let size = expected.iter().fold(0.0, |size: f64, rate| size.max(rate.abs()));
        let error = found.iter().zip(&expected).fold(0.0, |error: f64, (a, b)| error.max((a - b).abs()));
        assert!(error < 1e-5 * size, "{error:e} of {size:e} in {:?}", case.element.stiffness);
    }
}
