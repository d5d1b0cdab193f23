//! A joint leaves free the motions that its name promises, no more and no less: of the velocities of its two sides,
//! those that all conditions allow are the common rigid motions and the analytical relative ones, here by the rank of
//! the Jacobian (rigidity of bodies included) and by the motions themselves. As drawn and after the parts have moved. A
//! condition too many or too few shows in the rank, a wrong axis in a free motion that is not.

use crate::random::Random;
use crate::support::machines::integrate;
use crate::support::parts::{KINDS, Kind, Pair, Part, Twist, coordinate_velocity};
use ancf14::math::Vec3;
use ancf14::math::vectors::{set_vec3, vec3};
use ancf14::mechanics::beam::ancf14::coordinates::P;
use ancf14::mechanics::beam::node::Node;
use ancf14::mechanics::constraint::joint::Joint;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::dynamics::midpoint::Midpoint;
use ancf14::solve::dynamics::start;
use nalgebra::{DMatrix, DVector};

const SIDES: [[Part; 2]; 11] = [
    [Part::Body, Part::Body],
    [Part::Body, Part::Beam],
    [Part::Beam, Part::Body],
    [Part::Ground, Part::Body],
    [Part::Body, Part::Ground],
    [Part::Frame, Part::Body],
    [Part::Frame, Part::Beam],
    [Part::Ground, Part::Ancf24],
    [Part::Ancf24, Part::Body],
    [Part::Beam, Part::Ancf24],
    [Part::Ancf24, Part::Ancf24],
];
/// Smallest singular value of independent rows and motions, whose entries are of order 1; dependent ones give 1e-16.
const INDEPENDENT: f64 = 1e-3;

/// The Jacobian of all conditions by all coordinates.
fn jacobian(system: &System, state: &State) -> DMatrix<f64> {
    let mut snapshot = FrameCache::default();
    let mut gradients = Vec::new();
    system.constraint_gradients(&snapshot.of(system, state), &mut gradients);
    let mut sum = DMatrix::zeros(system.constraints(), system.coordinates());
    let mut row = 0;
    for (joint, gradient) in system.joints.iter().zip(&gradients) {
        for (marker, block) in [(&joint.a, &gradient.a), (&joint.b, &gradient.b)] {
            for (local, column) in marker.coordinates(&system.mesh).enumerate() {
                for condition in 0..joint.rows() {
                    sum[(row + condition, column)] += block[(condition, local)];
                }
            }
        }
        row += joint.rows();
    }
    sum
}

/// The motions that must be free, in the coordinates of the two sides.
fn expected(pair: &Pair, kind: &Kind) -> Vec<Vec<f64>> {
    let Pair { system, state, sides } = pair;
    let mut snapshot = FrameCache::default();
    let poses = sides.map(|side| side.pose(&snapshot.of(system, state)));
    let moves = |marker: &Marker| matches!(marker, Marker::Body { .. } | Marker::Node { .. });
    let mut list = Vec::new();
    if sides.iter().all(moves) {
        let (place, none) = (poses[1].place, Vec3::zeros());
        for axis in 0..3 {
            let unit = Vec3::ith(axis, 1.0);
            for twist in [Twist { place, linear: unit, angular: none }, Twist { place, linear: none, angular: unit }] {
                let [a, b] = sides.map(|side| coordinate_velocity(system, state, &side, &twist));
                list.push(a.iter().zip(&b).map(|(a, b)| a + b).collect());
            }
        }
    }
    let moved = if moves(&sides[1]) { &sides[1] } else { &sides[0] };
    list.extend(kind.free(&poses[0], &poses[1]).iter().map(|twist| coordinate_velocity(system, state, moved, twist)));
    for side in sides {
        if let Marker::Node { node, .. } = side {
            let start = side.coordinates(&system.mesh).start + P;
            // The slope of a beam may always stretch; of ANCF24 it may lean too.
            let changes = match system.mesh.nodes[*node] {
                Node::Ancf14 { .. } => vec![vec3(&state.q, start)],
                Node::Ancf24 { .. } => vec![Vec3::x(), Vec3::y(), Vec3::z()],
            };
            for change in changes {
                let mut motion = vec![0.0; state.q.len()];
                set_vec3(&mut motion, start, &change);
                list.push(motion);
            }
        }
    }
    list
}

fn singular_values(matrix: &DMatrix<f64>) -> Vec<f64> {
    let mut values: Vec<f64> = matrix.clone().singular_values().iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// The smallest singular value of the rows, and the largest rate of a condition under a motion that must be free.
fn check(pair: &Pair, kind: &Kind) -> (f64, f64) {
    let Pair { system, state, sides } = pair;
    let columns: Vec<usize> = sides.iter().flat_map(|side| side.coordinates(&system.mesh)).collect();
    let whole = jacobian(system, state);
    let restricted = whole.select_columns(&columns);
    let rows = restricted.nrows();
    let motions = expected(pair, kind);
    assert_eq!(columns.len() - rows, motions.len(), "{}: a condition too many or too few", kind.name);
    let least = if rows > 0 { singular_values(&restricted)[rows - 1] } else { f64::INFINITY };
    assert!(least > INDEPENDENT, "{}: dependent conditions, {least:e}", kind.name);
    if motions.is_empty() {
        return (least, 0.0);
    }
    let basis = DMatrix::from_fn(columns.len(), motions.len(), |row, motion| motions[motion][columns[row]]);
    let independent = singular_values(&basis)[motions.len() - 1];
    assert!(independent > INDEPENDENT, "{}: the motions are not independent, {independent:e}", kind.name);
    let rates = motions.iter().map(|motion| (&whole * DVector::from_column_slice(motion)).amax());
    (least, rates.fold(0.0, f64::max))
}

#[test]
fn the_promised_motions_are_free_and_no_others() {
    let mut random = Random(111);
    for kind in &KINDS {
        let (mut least, mut largest) = (f64::INFINITY, 0.0_f64);
        for parts in SIDES {
            let mut pair = Pair::new(&mut random, parts, kind);
            let rows: usize = pair.system.joints.iter().map(Joint::rows).sum();
            let bodies = pair.system.bodies.len();
            // A section of ANCF24 that is tied to anything is rigid.
            let sections = parts.into_iter().filter(|part| *part == Part::Ancf24).count();
            assert_eq!(rows, 6 * bodies + 3 * sections + 6 - kind.slides.len() - kind.turns.len());
            for moved in [false, true] {
                if moved {
                    let Pair { system, state, .. } = &mut pair;
                    integrate(system, state, 1.0, (1e-3, 200), |_| {}).unwrap();
                }
                let (smallest, rate) = check(&pair, kind);
                (least, largest) = (least.min(smallest), largest.max(rate));
                // Velocities of order 1 times round-off of poses after 200 steps.
                assert!(rate < 1e-12, "{parts:?} {}: a free motion changes a condition by {rate:e} 1/s", kind.name);
            }
        }
        println!("{}: smallest singular value {least:.1e}, rate of a condition {largest:.1e}", kind.name);
    }
}

/// The start takes velocities that a joint allows as they are, of both sides and all kinds.
#[test]
fn allowed_velocities_are_kept_at_the_start() {
    let mut random = Random(112);
    for kind in &KINDS {
        for parts in SIDES {
            let Pair { system, mut state, .. } = Pair::new(&mut random, parts, kind);
            let given = state.velocity.clone();
            let mut midpoint = Midpoint::new(&system, 1.0, 1.0, 1e-8);
            let lost = start::set_motion(&system, &mut midpoint, &mut state).unwrap();
            let change = state.velocity.iter().zip(&given).fold(0.0_f64, |sum, (a, b)| sum.max((a - b).abs()));
            // Velocities of some m/s; round-off through a matrix of condition 1e4: the inertia of slopes against that
            // of bodies.
            assert!(lost == 0.0 && change < 1e-11, "{parts:?} {}: {change:e}", kind.name);
        }
    }
}
