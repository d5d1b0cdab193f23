//! Markers, joints and loads: their derivatives against automatic differentiation of the definitions, at random pose, offset and axes.
//! A dropped term shows at 1e-2 or more; the bound is rounding.

use crate::element_derivatives::{random_element_state, stiffness, straight};
use crate::oracle::{self, Scalar};
use crate::random::Random;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::coordinates::NODE;
use ancf14::mechanics::beam::element::Element;
use ancf14::mechanics::beam::frame::{NodeFrame, Triad};
use ancf14::mechanics::beam::strain::Strain;
use ancf14::mechanics::joint::{Joint, primitive::Primitive, revolute, spherical, weld};
use ancf14::mechanics::load::{Direction, Load, Signal};
use ancf14::mechanics::marker::{Configuration, Marker, Pose};
use nalgebra::{SMatrix, SVector};
use num_dual::Dual2SVec64;

const ROUNDING: f64 = 1e-9;

/// Two elements of two beams (nodes 0, 1 and 2, 3) in a random state.
struct Pair {
    elements: [Element; 2],
    q: SVector<f64, 28>,
    triads: [Triad; 4],
    holonomy: [f64; 2],
    frames: [NodeFrame; 4],
}

impl Pair {
    fn new(random: &mut Random) -> Self {
        let mut q = SVector::<f64, 28>::zeros();
        let mut triads = [Triad { t: Vec3::x(), u: Vec3::y() }; 4];
        let mut holonomy = [0.0; 2];
        for beam in 0..2 {
            let (own, own_triads, previous) = random_element_state(random, 0.7, 0.8, 1.0);
            q.fixed_rows_mut::<14>(14 * beam).copy_from(&own);
            triads[2 * beam..2 * beam + 2].copy_from_slice(&own_triads);
            holonomy[beam] = previous;
        }
        let frames =
            std::array::from_fn(|node| NodeFrame::new(&q.as_slice()[NODE * node..NODE * (node + 1)], &triads[node]));
        let first = straight(0.7, stiffness(Strain::Small));
        let second = Element { node: 2, ..first.clone() };
        Self { elements: [first, second], q, triads, holonomy, frames }
    }

    fn configuration(&self) -> Configuration<'_> {
        Configuration { q: self.q.as_slice(), frames: &self.frames, holonomy: &self.holonomy, elements: &self.elements }
    }

    /// Place and the three axes of a marker, over any dual number.
    fn pose<D: Scalar>(&self, marker: &Marker, q: &[D]) -> [[D; 3]; 4] {
        let combine = |columns: &[[D; 3]; 3], local: &Vec3| {
            let mut sum = [D::from(0.0); 3];
            for (column, factor) in columns.iter().zip(local) {
                sum = oracle::sum(&sum, &oracle::scale(column, D::from(*factor)));
            }
            sum
        };
        match marker {
            Marker::Ground(pose) => {
                let axis = |i: usize| oracle::constant(&pose.axes.column(i).into_owned());
                [oracle::constant(&pose.place), axis(0), axis(1), axis(2)]
            }
            Marker::Node { node, offset, axes } => {
                let own = &q[NODE * node..NODE * (node + 1)];
                let frame = oracle::node(own, &self.triads[*node]);
                let columns = [frame.t, frame.y, frame.z];
                let axis = |i: usize| combine(&columns, &axes.column(i).into_owned());
                let place = oracle::sum(&[own[0], own[1], own[2]], &combine(&columns, offset));
                [place, axis(0), axis(1), axis(2)]
            }
            Marker::Section { element, xi } => {
                let part = &self.elements[*element];
                let own = &q[NODE * part.node..NODE * (part.node + 2)];
                let triads = [self.triads[part.node], self.triads[part.node + 1]];
                let (t, y, _) = oracle::inside(part, own, &triads, self.holonomy[*element], *xi);
                let shape = ancf14::math::hermite::shape(*xi, part.length);
                let place = std::array::from_fn(|i| {
                    own[i] * shape[0] + own[3 + i] * shape[1] + own[7 + i] * shape[2] + own[10 + i] * shape[3]
                });
                [place, t, y, oracle::cross(&t, &y)]
            }
        }
    }
}

fn random_node(random: &mut Random, node: usize) -> Marker {
    Marker::Node { node, offset: random.vector(), axes: random.rotation() }
}

fn random_ground(random: &mut Random) -> Marker {
    Marker::Ground(Pose { place: random.vector(), axes: random.rotation() })
}

/// lambda · phi of a joint over any dual number.
fn weighted_conditions<D: Scalar>(pair: &Pair, joint: &Joint, lambda: &[f64], q: &[D]) -> D {
    let (a, b) = (pair.pose(&joint.a, q), pair.pose(&joint.b, q));
    let mut sum = D::from(0.0);
    let mut row = 0;
    for primitive in joint.primitives {
        match *primitive {
            Primitive::Coincident => {
                for axis in 0..3 {
                    sum += (a[0][axis] - b[0][axis]) * lambda[row + axis];
                }
            }
            Primitive::Perpendicular(i, j) => sum += oracle::dot(&a[1 + i], &b[1 + j]) * lambda[row],
        }
        row += primitive.rows();
    }
    sum
}

#[test]
fn joint_derivatives() {
    let mut random = Random(7);
    for (primitives, rows) in [(weld::PRIMITIVES, 6), (spherical::PRIMITIVES, 3), (revolute::PRIMITIVES, 5)] {
        for sides in 0..12 {
            let pair = Pair::new(&mut random);
            let a = if sides % 3 == 0 { random_ground(&mut random) } else { random_node(&mut random, 1) };
            let joint = Joint { name: "joint".into(), a, b: random_node(&mut random, 2), primitives };
            assert_eq!(joint.rows(), rows);
            let lambda: Vec<f64> = (0..rows).map(|_| random.signed()).collect();
            let (value, gradient, hessian) = num_dual::hessian(
                |q: SVector<Dual2SVec64<28>, 28>| weighted_conditions(&pair, &joint, &lambda, q.as_slice()),
                &pair.q,
            );
            let c = pair.configuration();
            let mut phi = vec![0.0; rows];
            joint.phi(&c, &mut phi);
            let sum: f64 = phi.iter().zip(&lambda).map(|(phi, lambda)| phi * lambda).sum();
            assert!((sum - value).abs() < ROUNDING);

            let own = joint.phi_q(&c);
            let ranges = [joint.a.coordinates(&pair.elements), joint.b.coordinates(&pair.elements)];
            let mut closed = SVector::<f64, 28>::zeros();
            for (range, block) in ranges.iter().zip([own.a, own.b]) {
                for (local, index) in range.clone().enumerate() {
                    closed[index] += (0..rows).map(|row| lambda[row] * block[(row, local)]).sum::<f64>();
                }
            }
            assert!((closed - gradient).amax() < ROUNDING * gradient.amax());

            let blocks = joint.phi_qq(&c, &lambda);
            let mut closed = SMatrix::<f64, 28, 28>::zeros();
            for (place, block) in blocks.iter().enumerate() {
                for (i, row) in ranges[place / 2].clone().enumerate() {
                    for (j, column) in ranges[place % 2].clone().enumerate() {
                        closed[(row, column)] += block[(i, j)];
                    }
                }
            }
            let error = (closed - hessian).amax() / hessian.amax();
            assert!(error < ROUNDING, "{error:e}");
        }
    }
}

/// A component of a marker's pose with its gradient and Hessian by all 28 coordinates.
type Component = (f64, SVector<f64, 28>, SMatrix<f64, 28, 28>);

fn component(pair: &Pair, marker: &Marker, vector: usize, axis: usize) -> Component {
    num_dual::hessian(|q: SVector<Dual2SVec64<28>, 28>| pair.pose(marker, q.as_slice())[vector][axis], &pair.q)
}

/// The turn by coordinate j is `dφ_j = 1/2 Σ_i a_i × ∂_j a_i` over the axes a_i; the work of a moment m along it, and the derivative of
/// that by coordinate k, follow from the axes' gradients and Hessians.
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

/// Dead and follower forces and moments, at nodes and inside elements: generalized force and its derivative.
#[test]
fn load_derivatives() {
    let mut random = Random(8);
    for case in 0..12 {
        let pair = Pair::new(&mut random);
        let marker = match case % 3 {
            0 => Marker::Node { node: 1, offset: Vec3::zeros(), axes: Mat3::identity() },
            1 => Marker::Node { node: 3, offset: Vec3::zeros(), axes: Mat3::identity() },
            _ => Marker::Section { element: case / 3 % 2, xi: 0.5 + 0.49 * random.signed() },
        };
        let direction = if case % 2 == 0 { Direction::Global } else { Direction::Follower };
        let (force, moment) = (random.vector(), random.vector());
        let signals = |v: Vec3| [0, 1, 2].map(|i| Signal::Constant(v[i]));
        let load = Load {
            name: "load".into(),
            points: vec![(marker, 1.0)],
            force: signals(force),
            moment: signals(moment),
            direction,
        };
        let parts: [[Component; 3]; 4] =
            std::array::from_fn(|vector| std::array::from_fn(|axis| component(&pair, &marker, vector, axis)));
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
        let c = pair.configuration();
        let range = marker.coordinates(&pair.elements);
        let (own, own_q) = (load.force(&c, 0, &load.at(0.0)), load.force_q(&c, 0, &load.at(0.0)));
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
    }
}
