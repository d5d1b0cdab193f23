//! Loads: generalized forces and their derivatives against automatic differentiation of the markers they act on.

use crate::random::Random;
use crate::support::marker_oracle::{ALL, All, BODY, Dual, Machine, ROUNDING, deep};
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::force::load::{Direction, Load, LoadGuide, Site};
use ancf14::mechanics::input::excitation::{HostWrench, Wrench};
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::marker::Marker;
use nalgebra::SMatrix;

/// A component of a marker's pose with its gradient and Hessian by all coordinates.
type Component = (f64, All<f64>, SMatrix<f64, ALL, ALL>);

fn component(machine: &Machine, marker: &Marker, vector: usize, axis: usize) -> Component {
    num_dual::hessian(|q: All<Dual>| machine.pose(marker, q.as_slice())[vector][axis], &machine.all())
}

/// The turn by coordinate j is `dφ_j = 1/2 Σ_i a_i × ∂_j a_i` over the axes a_i; the work of a moment m along it, and
/// the derivative of that by coordinate k, follow from the axes' gradients and Hessians.
fn generalized_force(
    parts: &[[Component; 3]; 4],
    wrench: &dyn Fn(Option<usize>) -> (Vec3, Vec3),
    j: usize,
    k: Option<usize>,
) -> f64 {
    let value = |i: usize| Vec3::from_fn(|axis, _| parts[i][axis].0);
    let by = |i: usize, j: usize| Vec3::from_fn(|axis, _| parts[i][axis].1[j]);
    let twice = |i: usize, j: usize, k: usize| Vec3::from_fn(|axis, _| parts[i][axis].2[(j, k)]);
    let turn = (1..4).map(|i| value(i).cross(&by(i, j))).sum::<Vec3>() * 0.5;
    let (force, moment) = wrench(None);
    let Some(k) = k else { return force.dot(&by(0, j)) + moment.dot(&turn) };
    let turn_k = (1..4).map(|i| by(i, k).cross(&by(i, j)) + value(i).cross(&twice(i, j, k))).sum::<Vec3>() * 0.5;
    let (force_k, moment_k) = wrench(Some(k));
    force_k.dot(&by(0, j)) + force.dot(&twice(0, j, k)) + moment_k.dot(&turn) + moment.dot(&turn_k)
}

/// Dead and follower forces and moments, at nodes, bodies and inside elements of both formulations: generalized force
/// and its derivative.
#[test]
fn load_derivatives() {
    deep(check_load_derivatives);
}

fn check_load_derivatives() {
    let mut random = Random(8);
    let mut constant = 0;
    for case in 0..32 {
        let machine = Machine::new(&mut random);
        let marker = match case % 8 {
            0 => Marker::Node { node: 1, offset: Vec3::zeros(), axes: Mat3::identity() },
            1 => Marker::Node { node: 3, offset: Vec3::zeros(), axes: Mat3::identity() },
            2 => Marker::Body { start: BODY, offset: random.vector(), axes: random.rotation() },
            3 => Marker::section(case / 8 % 2, 0.5 + 0.49 * random.signed()),
            4 => Marker::Node { node: 5, offset: random.vector(), axes: random.rotation() },
            5 => Marker::section(2, 0.5 + 0.49 * random.signed()),
            kind => {
                let (offset, axes) = (random.vector(), random.rotation());
                let element = if kind == 6 { case / 8 % 2 } else { 2 };
                Marker::Section { element, xi: 0.5 + 0.49 * random.signed(), offset, axes }
            }
        };
        let direction = if case / 16 == 0 { Direction::Global } else { Direction::Follower };
        let (force, moment) = (random.vector(), random.vector());
        let signals = |v: Vec3| [0, 1, 2].map(|i| Signal::Constant(v[i]));
        let load = Load {
            name: "load".into(),
            site: Site::Point(marker),
            guide: LoadGuide::Signals { force: signals(force), moment: signals(moment) },
            direction,
        };
        let parts: [[Component; 3]; 4] =
            std::array::from_fn(|vector| std::array::from_fn(|axis| component(&machine, &marker, vector, axis)));
        // A follower's components are along the axes, and turn with them.
        let along_axes = |v: &Vec3, k: Option<usize>| {
            Vec3::from_fn(|axis, _| {
                (0..3).map(|i| v[i] * k.map_or(parts[1 + i][axis].0, |k| parts[1 + i][axis].1[k])).sum()
            })
        };
        let wrench = |k: Option<usize>| match direction {
            Direction::Global if k.is_some() => (Vec3::zeros(), Vec3::zeros()),
            Direction::Global => (force, moment),
            Direction::Follower => (along_axes(&force, k), along_axes(&moment, k)),
        };
        let c = machine.configuration();
        let range = marker.coordinates(&machine.mesh);
        let (own, own_q) = (
            load.point_force(&marker, &c, &load.at(0.0, &HostWrench::default())),
            load.point_force_q(&marker, &c, &load.at(0.0, &HostWrench::default())),
        );
        for (i, j) in range.clone().enumerate() {
            assert!(
                (own[i] - generalized_force(&parts, &wrench, j, None)).abs() < ROUNDING,
                "force {i} of case {case}"
            );
            for (l, k) in range.clone().enumerate() {
                let expected = generalized_force(&parts, &wrench, j, Some(k));
                let error = own_q[(i, l)] - expected;
                assert!(error.abs() < ROUNDING * own_q.amax().max(1.0), "stiffness {i} {l} of case {case}: {error:e}");
            }
        }
        // Equations leave out what is said to be zero.
        for moment in [moment, Vec3::zeros()] {
            let wrench = Wrench { force, moment };
            if load.is_constant(&wrench) {
                constant += 1;
                let force_q = load.point_force_q(&marker, &c, &wrench);
                assert_eq!(force_q.amax(), 0.0, "stiffness of case {case} under {wrench:?}");
            }
        }
    }
    // Dead forces at two nodes and in two sections, in two cases each.
    assert_eq!(constant, 8);
}

/// A load along elements of both formulations is the sum of loads on their load points, in proportion to the lengths
/// that they stand for.
#[test]
fn loads_along_elements() {
    deep(check_loads_along_elements);
}

fn check_loads_along_elements() {
    let mut random = Random(21);
    for case in 0..16 {
        let machine = Machine::new(&mut random);
        let c = machine.configuration();
        let (force, moment) = (random.vector(), if case % 2 == 0 { random.vector() } else { Vec3::zeros() });
        let wrench = Wrench { force, moment };
        let direction = if case % 4 < 2 { Direction::Global } else { Direction::Follower };
        let load = |site: Site| Load { name: "load".into(), site, guide: LoadGuide::Host, direction };
        let elements = 0..machine.mesh.elements.len();
        let line = load(Site::Line(elements.clone()));
        let mut told = Vec::new();
        line.each_force(&c, (&wrench, 0.0), |range, own| told.push((range, own.to_vec())));
        assert_eq!(told.len(), elements.len());
        let whole = line.markers(&machine.mesh);
        for number in elements {
            let element = &machine.mesh.elements[number];
            let (range, own) = &told[number];
            assert_eq!(*range, element.coordinates());
            let count = range.len();
            let mut stiffness = vec![0.0; count * count];
            element.add_line_stiffness(&c.beams, &line.along(&wrench), 2.0, &mut stiffness);
            let (mut sum, mut sum_q) = (vec![0.0; count], vec![0.0; count * count]);
            for (xi, share) in element.load_points() {
                let marker = Marker::section(number, xi);
                assert!(whole.contains(&marker));
                let part = Wrench { force: force * share, moment: moment * share };
                let point = load(Site::Point(marker));
                let (by_point, by_point_q) =
                    (point.point_force(&marker, &c, &part), point.point_force_q(&marker, &c, &part));
                for i in 0..count {
                    sum[i] += by_point[i];
                    (0..count).for_each(|j| sum_q[j * count + i] += 2.0 * by_point_q[(i, j)]);
                }
            }
            let is_near = |a: &[f64], b: &[f64]| {
                let size = b.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
                a.iter().zip(b).all(|(a, b)| (a - b).abs() < ROUNDING * size)
            };
            assert!(is_near(own, &sum), "force of element {number}, case {case}");
            assert!(is_near(&stiffness, &sum_q), "stiffness of element {number}, case {case}");
            assert_eq!(
                line.is_constant(&wrench),
                stiffness.iter().all(|value| *value == 0.0),
                "constant element {number}, case {case}"
            );
        }
    }
}
