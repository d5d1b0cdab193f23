//! The closed gradient and Hessian of the element must be the derivatives of the energy as MECHANICS defines it.
//! A dropped or wrong term shows at 1e-3 or more; the bound is rounding: 1e-9 of the largest entry.

use crate::random::Random;
use crate::support::oracle;
use ancf14::math::{Vec3, rotation};
use ancf14::mechanics::beam::ancf14::along::{Along, SectionAt};
use ancf14::mechanics::beam::ancf14::element::{Element, Evaluation, Place};
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::ancf14::natural::Natural;
use ancf14::mechanics::beam::ancf14::strain::{Eccentricity, Stiffness, Strain};
use ancf14::mechanics::geometry::triad::Triad;
use nalgebra::SVector;
use num_dual::Dual2SVec64;

const STRAINS: [Strain; 3] = [Strain::Small, Strain::Large, Strain::LargeTruncated];
/// Rounding of a second derivative, relative to its largest entry.
const ROUNDING: f64 = 1e-9;

pub fn stiffness(strain: Strain) -> Stiffness {
    let fourth = if strain == Strain::Large { [0.03, 0.02, 0.05] } else { [0.0; 3] };
    let wagner = if strain == Strain::Small { 0.0 } else { 1.3 };
    Stiffness {
        strain,
        twist: Twist::Linear,
        axial: 40.0,
        bending_y: 1.7,
        bending_z: 0.6,
        torsion: 0.9,
        wagner,
        fourth,
        damping: 0.02,
    }
}

/// Coordinates of an element of length `length` with the given bend and twist scale, and reference triads near its
/// tangents.
pub fn random_element_state(
    random: &mut Random,
    length: f64,
    bend: f64,
    twist: f64,
) -> (SVector<f64, 14>, [Triad; 2], f64) {
    let turn = random.rotation();
    let place = random.vector();
    let mut q = SVector::<f64, 14>::zeros();
    let along = turn.column(0).into_owned();
    let ends = [
        place,
        place + along * (length * (1.0 + 0.1 * bend * random.signed())) + random.vector() * (0.3 * bend * length),
    ];
    let mut triads = [Triad { t: along, u: along }; 2];
    for node in 0..2 {
        let slope = along * (1.0 + 0.1 * bend * random.signed()) + random.vector() * (0.6 * bend);
        let reference = rotation::rotation_matrix(&(random.vector() * (0.5 * bend))) * slope;
        q.fixed_rows_mut::<3>(7 * node).copy_from(&ends[node]);
        q.fixed_rows_mut::<3>(7 * node + 3).copy_from(&slope);
        q[7 * node + 6] = twist * random.signed();
        triads[node] = Triad::new(&reference, &(turn * Vec3::y() + random.vector() * (0.5 * twist.min(1.0))));
    }
    (q, triads, 0.4 * twist.min(1.0) * random.signed())
}

pub fn straight(length: f64, stiffness: Stiffness) -> Element {
    let mut q = [0.0; 14];
    (q[3], q[7], q[10]) = (1.0, length, 1.0);
    let triad = Triad { t: Vec3::x(), u: Vec3::y() };
    let frames = [NodeFrame::new(&q[..7], &triad), NodeFrame::new(&q[7..], &triad)];
    Element::new(Place::default(), length, stiffness, [1.0, 0.1], &q, [&frames[0], &frames[1]], 0.0)
}

/// An element whose undeformed shape is bent and twisted at random, and whose section varies, principal axes and, but
/// with the truncated strain, tension center included.
pub fn curved(random: &mut Random, length: f64, stiffness: Stiffness) -> Element {
    let (q, triads, previous) = random_element_state(random, length, 0.3, 0.5);
    let frames = [NodeFrame::new(&q.as_slice()[..7], &triads[0]), NodeFrame::new(&q.as_slice()[7..], &triads[1])];
    let frames = [&frames[0], &frames[1]];
    let sections = Along::new(move |xi| {
        let share = 1.0 - 0.6 * xi * xi;
        let stiffness = Stiffness {
            axial: share * stiffness.axial,
            bending_y: share * share * stiffness.bending_y,
            bending_z: (1.0 + xi) * stiffness.bending_z,
            torsion: share * stiffness.torsion,
            wagner: share * stiffness.wagner,
            fourth: stiffness.fourth.map(|moment| share * moment),
            ..stiffness
        };
        let third = match stiffness.strain {
            Strain::Large => [0.05, -0.03, 0.04 * share, 0.02].map(|moment| share * moment),
            Strain::Small | Strain::LargeTruncated => [0.0; 4],
        };
        let first = [1.5 * share, -2.0 * share];
        let eccentricity = (stiffness.strain != Strain::LargeTruncated).then_some(Eccentricity { first, third });
        SectionAt {
            stiffness,
            densities: [1.0, 0.1],
            mass_moments: [0.0; 3],
            turn: 0.3 - 0.5 * xi,
            principal: 0.2 - 0.3 * xi,
            eccentricity,
        }
    });
    Element::new(Place::default(), length, stiffness, [1.0, 0.1], q.as_slice(), frames, previous).with_sections(
        sections,
        q.as_slice(),
        frames,
        previous,
    )
}

fn compare(element: &Element, q: &SVector<f64, 14>, triads: &[Triad; 2], previous: f64) {
    let (energy, gradient, hessian) = num_dual::hessian(
        |q: SVector<Dual2SVec64<14>, 14>| oracle::energy(element, q.as_slice(), 0.0.into(), triads, previous),
        q,
    );
    let frames = [NodeFrame::new(&q.as_slice()[..7], &triads[0]), NodeFrame::new(&q.as_slice()[7..], &triads[1])];
    let evaluation = Evaluation::new(element, q.as_slice(), [&frames[0], &frames[1]], previous, &Natural::default());
    let (closed_gradient, closed_hessian) = evaluation.gradient_and_hessian();
    assert!(
        (evaluation.energy() - energy).abs() <= ROUNDING * energy.abs().max(1e-6),
        "{} {energy}",
        evaluation.energy()
    );
    let error = (closed_gradient - gradient).amax() / gradient.amax().max(1e-3);
    assert!(error < ROUNDING, "gradient: {error:e}");
    let error = (closed_hessian - hessian).amax() / hessian.amax();
    assert!(error < ROUNDING, "Hessian: {error:e} in {:?}\n{:.3}", element.stiffness.strain, closed_hessian - hessian);
    assert_eq!(evaluation.gradient(), closed_gradient);
}

#[test]
fn random_states() {
    let mut random = Random(1);
    for strain in STRAINS {
        for _ in 0..20 {
            let element = straight(0.7, stiffness(strain));
            let (q, triads, previous) = random_element_state(&mut random, 0.7, 1.0, 1.5);
            compare(&element, &q, &triads, previous);
            let element = curved(&mut random, 0.7, stiffness(strain));
            compare(&element, &q, &triads, previous);
        }
    }
}

/// Straight and nearly straight: where the paper's arccos and divisions by the angle lose all digits.
#[test]
fn straight_and_nearly_straight_states() {
    let mut random = Random(2);
    for strain in STRAINS {
        let element = straight(0.7, stiffness(strain));
        for bend in [0.0, 1e-12, 1e-9, 1e-6, 1e-3] {
            let (q, triads, previous) = random_element_state(&mut random, 0.7, bend, bend);
            compare(&element, &q, &triads, previous);
        }
    }
}

/// Twist beyond half a turn within one element, on the branch that `previous` names.
#[test]
fn strongly_twisted_states() {
    let mut random = Random(3);
    for strain in STRAINS {
        let element = straight(0.7, stiffness(strain));
        for turns in [-3.0, 1.0, 5.0] {
            let (q, triads, _) = random_element_state(&mut random, 0.7, 0.8, 6.0);
            compare(&element, &q, &triads, turns * std::f64::consts::TAU);
        }
    }
}

/// Work of the axial force by the increment of the slopes must be the increment of the axial energy (MECHANICS 7.6).
#[test]
fn axial_work_over_a_step_is_the_energy_increment() {
    use ancf14::mechanics::beam::ancf14::energy::axial::{Slope, small};
    let mut random = Random(5);
    let stiffness = stiffness(Strain::Small).at_axial_point();
    for _ in 0..100 {
        let (start, end) = (random.vector() + Vec3::x() * 2.0, random.vector() + Vec3::x() * 2.0);
        let over = Slope {
            middle: (start + end) / 2.0,
            increment: end - start,
            reference_stretch: 1.1,
            reference_square: 1.21,
            natural: 0.0,
        };
        let at = |slope: Vec3| Slope {
            middle: slope,
            increment: Vec3::zeros(),
            reference_stretch: 1.1,
            reference_square: 1.21,
            natural: 0.0,
        };
        let force = over.engineering_strain_mean_p() * small::force(&stiffness, over.engineering_strain());
        let work = force.dot(&(end - start));
        let rise = small::energy(&stiffness, &at(end)) - small::energy(&stiffness, &at(start));
        assert!((work - rise).abs() < 1e-12 * stiffness.axial);
    }
}
