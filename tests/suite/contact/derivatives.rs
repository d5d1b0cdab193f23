//! Tangents of contact against differences of its forces, on the ground, a moving frame and a body.

use crate::random::Random;
use crate::support::machines::built;
use crate::support::tangent::{check_damping_matrix, forces_at_rest};
use ancf14::math::blocks::Blocks;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;

/// A soft beam of two elements across `surface`, which presses into it.
fn model(surface: &str, friction: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Touching\"\ngravity = [0, 0, 0]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 10\nEI_y = 0.1\nEI_z = 0.1\nGJ = 0.1\nline_density = 1\n\
         [beam.bar]\nsection = \"s\"\nfrom = [-0.4, 0.02, 0.28]\nto = [0.5, 0.05, 0.31]\nelements = 2\n\
         [body.wheel]\nmass = 2\nposition = [0.02, 0.1, 0.03]\ninertia = [0.1, 0.2, 0.15]\n\
         [frame.cart]\nposition = [0, 0, 0.01]\n\
         [surface.own]\n{surface}\n\
         [contact.press]\nof = \"bar\"\nwith = \"own\"\nstiffness = 50\nradius = 0.03\n{friction}\n\
         [simulation]\nstop = 1\n"
    )
}

/// All of the beam is inside: pieces that end where the gap is 0 move with the beam, and a rule of three points is not
/// exact for them.
const SURFACES: [&str; 10] = [
    "shape = \"plane\"\nnormal = [0.1, 0, 1]\noffset = [0, 0, 0.4]",
    "shape = \"cylinder\"\naxis = [0.1, 1, 0]\nradius = 0.7\non = \"cart\"",
    "shape = \"cylinder\"\naxis = [0.1, 1, 0]\nradius = 0.7\non = \"wheel\"",
    "shape = \"sphere\"\nradius = 0.7\non = \"wheel\"\noffset = [0.01, -0.1, 0]",
    "shape = \"cylinder\"\naxis = [1, 0, 0.05]\nradius = 0.2\ninside = true\non = \"wheel\"",
    "shape = \"sheave\"\naxis = [0, 1, 0]\nradius = 0.7\ngroove = 0.2\non = \"wheel\"",
    "shape = \"ring\"\naxis = [0.1, 1, 0]\nradius = 1\nwire = 0.4\non = \"wheel\"\noffset = [0, -0.25, -0.7]",
    "shape = \"cone\"\naxis = [0.1, 1, 0]\nradius = 0.5\nend_radius = 0.9\nlength = 2\non = \"wheel\"",
    // An edge along the beam, 18 mm from its axis.
    "shape = \"box\"\nsize = [1.2, 0.5, 0.5]\n\
     edges = [[0.998890737, 0.033296358, 0.033296358], \
     [-0.033314830, 0.999444907, 0.000000000], [-0.033277875, -0.001109263, 0.999445523]]\n\
     offset = [0.067514, -0.226562, 0.031146]\non = \"cart\"",
    "shape = \"box\"\nsize = [1.5, 1, 1]\non = \"wheel\"",
];

/// The forces of contact alone, and the tangent of all forces.
fn forces(system: &System, before: &State, q: &[f64]) -> (Vec<f64>, Blocks) {
    let mut without = system.clone();
    without.contacts.clear();
    let ((whole, blocks), (beams, _)) = (forces_at_rest(system, before, q), forces_at_rest(&without, before, q));
    (whole.iter().zip(&beams).map(|(whole, beams)| whole - beams).collect(), blocks)
}

/// Along any change of all coordinates the tangent is the derivative. Differences of 1e-6 are off by round-off of 1e-10
/// and by their square times curvatures of up to 1e3.
fn check(surface: &str, friction: &str, bound: f64) {
    let (system, state) = built(&model(surface, friction));
    let mut random = Random(7);
    let q = state.q.clone();
    for _ in 0..3 {
        let along: Vec<f64> = q.iter().map(|_| random.signed()).collect();
        let left: Vec<f64> = q.iter().map(|_| random.signed()).collect();
        let at = |share: f64| q.iter().zip(&along).map(|(q, change)| q + share * change).collect::<Vec<_>>();
        let (here, blocks) = forces(&system, &state, &q);
        assert!(here.iter().any(|force| *force != 0.0), "{surface} does not touch");
        let mut without = system.clone();
        without.contacts.clear();
        let without = forces_at_rest(&without, &state, &q).1.form(&left, &along);
        let found = blocks.form(&left, &along) - without;
        let [plus, minus] = [1e-6, -1e-6].map(|share| forces(&system, &state, &at(share)).0);
        let expected: f64 = left.iter().zip(plus.iter().zip(&minus)).map(|(w, (a, b))| w * (a - b) / 2e-6).sum();
        assert!((found - expected).abs() < bound * expected.abs().max(1.0), "{surface}: {found} {expected}");
    }
}

#[test]
fn tangents_of_normal_forces() {
    SURFACES.iter().for_each(|surface| check(surface, "", 1e-7));
}

/// Friction of a beam that sticks to a plane: how the turn of a section and the length under pressure change with the
/// coordinates, and where the center of pressure moves, is left to the iteration.
#[test]
fn tangents_of_friction() {
    check(SURFACES[0], "friction = 0.3\nfriction_stiffness = 20", 1e-2);
}

/// A level beam that slides on a level plane: while all of it is shifted, its friction follows the pressure, which grows
/// with the depth, and turns with the way. Nothing is left to the iteration then.
#[test]
fn friction_that_slides_follows_the_pressure() {
    let surface = "shape = \"plane\"\nnormal = [0, 0, 1]\noffset = [0, 0, 0.4]";
    let text =
        model(surface, "friction = 0.3\nfriction_stiffness = 20").replace("[0.5, 0.05, 0.31]", "[0.5, 0.02, 0.28]");
    let (system, mut state) = built(&text);
    // Far beyond the limit, between x and y.
    state.lists.memory.fill(10.0);
    let mut random = Random(11);
    let q = state.q.clone();
    let left: Vec<f64> = q.iter().map(|_| random.signed()).collect();
    let (here, blocks) = forces(&system, &state, &q);
    assert!(here[0].abs() > 0.1 && here[1].abs() > 0.1, "{here:?}");
    let mut without = system.clone();
    without.contacts.clear();
    let (_, beams) = forces_at_rest(&without, &state, &q);
    for axis in 0..3 {
        let along: Vec<f64> = (0..q.len()).map(|index| f64::from(index < 21 && index % 7 == axis)).collect();
        let found = blocks.form(&left, &along) - beams.form(&left, &along);
        let [plus, minus] = [1e-6, -1e-6].map(|share| {
            let moved: Vec<f64> = q.iter().zip(&along).map(|(q, change)| q + share * change).collect();
            forces(&system, &state, &moved).0
        });
        let expected: f64 = left.iter().zip(plus.iter().zip(&minus)).map(|(w, (a, b))| w * (a - b) / 2e-6).sum();
        assert!((found - expected).abs() < 1e-7 * expected.abs().max(1.0), "axis {axis}: {found} {expected}");
    }
}

/// The damping matrix is the derivative of the forces with respect to the velocities, which they are linear in.
#[test]
fn damping_matrices() {
    for surface in SURFACES {
        let (system, state) = built(&model(surface, "damping = 0.3"));
        check_damping_matrix(&system, state, surface);
    }
}
