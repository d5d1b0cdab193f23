//! Ropes over sheaves against closed forms, differences of their forces, and by their energy.

use crate::random::Random;
use crate::running::{goes_on_to_the_bit, run, start, try_start, value, vector};
use crate::support::machines::built;
use crate::support::tangent::{check_damping_matrix, forces_at_rest};
use ancf14::fmi::Model;
use ancf14::mechanics::beam::configuration::Dissipation;
use ancf14::mechanics::input::excitation::Excitation;
use ancf14::mechanics::marker::configuration::{Passage, TimeStep};
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::model::simulation::Simulation;
use std::f64::consts::{FRAC_PI_2, PI};

/// Two bodies with sheaves whose axes are not parallel, a third one on the ground, and a drum: the rope runs over them
/// from a point of the ground. Small stiffness, so that all derivatives count.
fn crooked(rest: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Crooked\"\ngravity = [0, 0, 0]\n\
         [body.hook]\nmass = 2\nposition = [0.1, 0.2, -1]\ninertia = [0.1, 0.2, 0.15]\n\
         [body.drum]\nmass = 3\nposition = [1.5, 0.1, 0.2]\ninertia = [0.1, 0.2, 0.15]\n\
         [surface.low]\non = \"hook\"\nshape = \"cylinder\"\naxis = [0.1, 1, 0.05]\nradius = 0.3\noffset = [0.02, 0, 0.01]\n\
         [surface.high]\nshape = \"cylinder\"\naxis = [-0.1, 1, 0.1]\nradius = 0.25\noffset = [0.6, 0, 0.5]\n\
         [surface.wound]\non = \"drum\"\nshape = \"cylinder\"\naxis = [0.05, -1, 0]\nradius = 0.2\n\
         [point.dead]\non = \"ground\"\noffset = [-0.4, 0.1, 0.8]\n\
         [rope.line]\nfrom = \"dead\"\nover = [\"low\", \"high\"]\nto_drum = \"wound\"\nturns = [-1, 1, -1]\n\
         stiffness = 40\nradius = 0.01\n{rest}\n\
         [simulation]\nstop = 1\n"
    )
}

/// How a rope holds on its sheaves. Friction: nothing slips, both sheaves slip, and without any.
const KINDS: [&str; 5] = [
    "pretension = 20",
    "pretension = 20\nsticks = true",
    "pretension = 20\nfriction = 0.02",
    "pretension = 20\nfriction = 5",
    "pretension = 20\nfriction = 0",
];

/// The tangent at rest against central differences of the forces: they are off by their round-off, 1e-9 of the largest
/// force, and by the square of their step times curvatures of up to 1e3.
#[test]
fn the_tangent_is_the_derivative() {
    for kind in KINDS {
        let (system, state) = built(&crooked(kind));
        let mut random = Random(7);
        let q: Vec<f64> = state.q.iter().map(|own| own + 0.05 * random.signed()).collect();
        let direction: Vec<f64> = q.iter().map(|_| random.signed()).collect();
        let moved = |h: f64| -> Vec<f64> { q.iter().zip(&direction).map(|(own, by)| own + h * by).collect() };
        let (_, tangent) = forces_at_rest(&system, &state, &q);
        let mut product = vec![0.0; q.len()];
        tangent.multiply_add(&direction, &mut product);
        let [plus, minus] = [1e-6, -1e-6].map(|h| forces_at_rest(&system, &state, &moved(h)).0);
        let scale = product.iter().fold(0.0_f64, |largest, own| largest.max(own.abs()));
        assert!(scale > 1.0, "{kind} does not act");
        for (index, own) in product.iter().enumerate() {
            let found = (plus[index] - minus[index]) / 2e-6;
            assert!((found - own).abs() < 1e-7 * scale, "{kind}, {index}: {found} {own}");
        }
    }
}

/// The forces over a step of 0.01 s between the coordinates `ends`, and their tangent times `along`.
fn forces_over_a_step(system: &System, before: &State, ends: [&[f64]; 2], along: &[f64]) -> [Vec<f64>; 2] {
    let middle: Vec<f64> = ends[0].iter().zip(ends[1]).map(|(start, end)| 0.5 * (start + end)).collect();
    let frames = [ends[0], ends[1], &middle].map(|q| {
        let mut frames = FrameCache::default();
        frames.set(system, q, &before.triads);
        frames
    });
    let at = |q, number: usize| system.configuration(q, &frames[number], before, &before.prescribed);
    let (start, end, c) = (at(ends[0], 0), at(ends[1], 1), at(&middle, 2));
    let passage = Passage::Step(TimeStep {
        start: &start,
        end: &end,
        increment: &[],
        duration: 0.01,
        velocity: &[],
        dissipation: Dissipation::new(0.8),
        strain_rates: &[],
        predicted_rates: &[],
        velocity_lead: &[],
        starts: &[],
    });
    let mut blocks = ancf14::math::blocks::Blocks::default();
    system.push_tangent_blocks(&mut blocks);
    let [mut forces, mut product] = [(); 2].map(|()| vec![0.0; along.len()]);
    system.forces_and_tangent(&c, &passage, &Excitation::default(), 1.0, &mut forces, &mut blocks);
    blocks.multiply_add(along, &mut product);
    [forces, product]
}

/// Over a step the tangent is twice the derivative by the end: central differences are off by their round-off, 1e-7.
#[test]
fn the_tangent_of_a_step_is_twice_the_derivative() {
    for kind in KINDS.into_iter().flat_map(|kind| [String::from(kind), format!("{kind}\ndamping = 0.3")]) {
        let (system, state) = built(&crooked(&kind));
        let mut random = Random(7);
        let begin: Vec<f64> = state.q.iter().map(|own| own + 0.02 * random.signed()).collect();
        let end: Vec<f64> = begin.iter().map(|own| own + 0.01 * random.signed()).collect();
        let along: Vec<f64> = end.iter().map(|_| random.signed()).collect();
        let over = |h: f64| {
            let end: Vec<f64> = end.iter().zip(&along).map(|(own, by)| own + h * by).collect();
            forces_over_a_step(&system, &state, [&begin, &end], &along)
        };
        let [[_, product], [plus, _], [minus, _]] = [0.0, 1e-6, -1e-6].map(over);
        let scale = product.iter().fold(0.0_f64, |largest, own| largest.max(own.abs()));
        assert!(scale > 1.0, "{kind} does not act");
        for (index, own) in product.iter().enumerate() {
            let found = (plus[index] - minus[index]) / 1e-6;
            assert!((found - own).abs() < 1e-7 * scale, "{kind}, {index}: {found} {own}");
        }
    }
}

/// The damping of a rope is in the damping matrix of modes.
#[test]
fn the_damping_matrix_is_the_derivative() {
    for kind in KINDS {
        let (system, state) = built(&crooked(&format!("{kind}\ndamping = 0.3")));
        check_damping_matrix(&system, state, kind);
    }
}

/// Four falls that carry 10 kg, whose rope is led down over the fourth sheave and pulled there by `force`, N. The
/// sheaves are bodies with an inertia of 0.002 kg m², or surfaces of the load and of the ground.
fn tackle(force: &str, rope: &str, has_wheels: bool, rest: &str) -> String {
    let mut text = format!(
        "format = 1\n[model]\nname = \"Tackle\"\ngravity = [0, 0, -9.81]\n\
         [body.load]\nmass = {}\ninertia = [0.1, 0.1, 0.1]\nposition = [0.15, 0, 0]\n\
         [body.handle]\nmass = {HANDLE}\ninertia = [1e-6, 1e-6, 1e-6]\nposition = [0.4, 0, 1]\n\
         [joint.slide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"load\"\naxis = [0, 0, 1]\n\
         [joint.pull]\ntype = \"prismatic\"\na = \"ground\"\nb = \"handle\"\naxis = [0, 0, 1]\n\
         [load.pull]\nat = \"handle\"\nforce = [0, 0, \"{} - ({force})\"]\n\
         [point.dead]\non = \"ground\"\noffset = [0, 0, 2]\n",
        if has_wheels { 10.0 - 2.0 * WHEEL } else { 10.0 },
        HANDLE * 9.81
    );
    for (number, x) in [0.05, 0.15, 0.25, 0.35].into_iter().enumerate() {
        let (z, on) = if number % 2 == 0 { (0, "load") } else { (2, "ground") };
        if has_wheels {
            text += &format!(
                "[body.wheel_{number}]\nmass = {WHEEL}\ninertia = [1e-3, 0.002, 1e-3]\nposition = [{x}, 0, {z}]\n\
                 [joint.pin_{number}]\ntype = \"revolute\"\na = \"{on}\"\nb = \"wheel_{number}\"\n\
                 axis = [0, 1, 0]\n"
            );
        }
        let (on, offset) = match (has_wheels, on) {
            (true, _) => (format!("wheel_{number}"), String::from("[0, 0, 0]")),
            (false, "load") => (String::from("load"), format!("[{}, 0, 0]", x - 0.15)),
            (false, _) => (String::from("ground"), format!("[{x}, 0, 2]")),
        };
        text += &format!(
            "[surface.sheave_{number}]\non = \"{on}\"\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.05\n\
             offset = {offset}\n"
        );
    }
    text += &format!(
        "[rope.rope]\nfrom = \"dead\"\nover = [\"sheave_0\", \"sheave_1\", \"sheave_2\", \"sheave_3\"]\nto = \"handle\"\n\
         turns = [-1, 1, -1, 1]\n{rope}\n\
         [output.load]\nat = \"load\"\nquantities = [\"displacement\", \"velocity\"]\n\
         [output.rope]\nat = \"rope\"\nquantities = [\"tension\", \"span_length\", \"wrap_angle\", \"slip\", \"length\", \
         \"energy\"]\n{rest}"
    );
    text
}

/// Mass of the end of the rope that is pulled, kg.
const HANDLE: f64 = 0.1;
/// Mass of a sheave that turns, kg.
const WHEEL: f64 = 1e-3;

/// The rate of the load, m/s, and its way, m.
fn lifted(own: &Simulation) -> [f64; 2] {
    [vector(own, "load.velocity").z, vector(own, "load.displacement").z]
}

/// A rope that runs freely has one tension: the load of mass `m` and the end of mass `e`, which moves four times as
/// fast, are pulled by `F`: `a = (4 F − m g)/(m + 16 e)`. Drawn with the tension that it keeps, nothing vibrates: but
/// for the tolerance of the solution, the answer is exact.
#[test]
fn block_and_tackle() {
    let expected = (4.0 * 30.0 - 98.1) / (10.0 + 16.0 * HANDLE);
    let rope = format!("stiffness = 1e6\npretension = {}", 30.0 - 4.0 * HANDLE * expected);
    let mut own = start(&tackle("30", &rope, false, "[simulation]\nstop = 0.5\nstep = 1e-3\n"));
    run(&mut own, 0.5, 0.5, |_| {});
    let [rate, way] = lifted(&own);
    assert!((rate / (0.5 * expected) - 1.0).abs() < 1e-9, "{rate}");
    assert!((way / (0.125 * expected) - 1.0).abs() < 1e-9, "{way}");
    // Half a turn each, and as much rope as before.
    for sheave in 1..=4 {
        assert!((value(&own, &format!("rope.wrap_angle[{sheave}]")) - PI).abs() < 1e-9);
    }
    let length: f64 = (1..=5).map(|span| value(&own, &format!("rope.span_length[{span}]"))).sum();
    let (whole, drawn) = (value(&own, "rope.length"), 9.0 + 4.0 * PI * 0.05);
    assert!((whole - length - 4.0 * PI * 0.05).abs() < 1e-12 && (whole - drawn).abs() < 1e-6, "{whole} {length}");
}

/// Sheaves that the rope turns: sheave `k` turns `k` times as fast as the rope runs to the first one, so that the mass
/// grows by `I/R² (1 + 4 + 9 + 16)`. The mean over the motion is exact to 1e-6: the rope, whose spans begin with one
/// tension, vibrates by 2e-8 m of 0.05 m, and a sheave that turns by `d` = 2e-3 rad in a step takes `d²/12` less torque.
#[test]
fn block_and_tackle_with_sheaves_that_turn() {
    let mass = 10.0 + 0.002 / 0.0025 * 30.0 + 16.0 * HANDLE;
    let expected = (4.0 * 30.0 - 98.1) / mass;
    let rest = "[output.turn]\nat = \"pin_3\"\nquantities = [\"angle\"]\n\
        [simulation]\nstop = 0.4\nstep = 1e-4\nspectral_radius = 1\n";
    let mut own = start(&tackle("30", "stiffness = 1e9\npretension = 28\nsticks = true", true, rest));
    run(&mut own, 0.4, 0.4, |_| {});
    let [_, way] = lifted(&own);
    assert!((way / (0.08 * expected) - 1.0).abs() < 1e-6, "{way}, expected {}", 0.08 * expected);
    let angle = value(&own, "turn.angle");
    assert!((angle.abs() - 4.0 * way / 0.05).abs() < 1e-4, "{angle}");
    assert!(value(&own, "rope.slip[4]").abs() < 1e-6);
}

/// The pull that lifts the load over four posts with friction: each passes on `exp(−μπ)` of the tension before it, so
/// that the falls carry `F Σ exp(−kμπ)` in all. It is 50.615 N for `μ = 0.1`. The pull grows from what the rope is drawn
/// with to half a percent less, where nothing but the stretch of the rope moves the load, and to 3 % more.
#[test]
fn posts_with_friction_hold_a_load() {
    let share: f64 = (1..=4).map(|post| (-0.1 * PI * f64::from(post)).exp()).sum();
    let (limit, begin) = (98.1 / share, 98.1 / 4.0);
    assert!((limit - 50.61498).abs() < 1e-5);
    for (factor, lifts) in [(0.995, false), (1.03, true)] {
        let pull = format!("{begin} + {} * min(t, 1)", factor * limit - begin);
        let rope = format!("stiffness = 1e6\ndamping = 300\npretension = {begin}\nfriction = 0.1");
        let mut own = start(&tackle(
            &pull,
            &rope,
            false,
            "[simulation]\nstop = 2\nstep = 2e-3\ntotals = [\"energy\", \"work\"]\n",
        ));
        run(&mut own, 1.2, 1.2, |_| {});
        let [before, _] = lifted(&own);
        own.advance(2.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        let [rate, way] = lifted(&own);
        let expected = if lifts { (factor * 98.1 - 98.1) / (10.0 + 4.0 * HANDLE * share) } else { 0.0 };
        assert!(
            ((rate - before) / 0.8 - expected).abs() < 1e-3 * 0.294,
            "{factor}: {} {expected}",
            (rate - before) / 0.8
        );
        assert!(lifts || way.abs() < 1e-3, "{way}");
        for post in 1..=4 {
            let [one, other] = [post, post + 1].map(|span| value(&own, &format!("rope.tension[{span}]")));
            // At the end of a step that slides the ratio is that of the elastic tensions; damping adds 1e-6.
            assert!(!lifts || (other / one / (0.1 * PI).exp() - 1.0).abs() < 1e-5, "{one} {other}");
        }
    }
}

/// A post between two ends that are not above each other: the wrap angle follows from the two tangents, and the tension
/// from it, `exp(μθ)`. Equilibria, in which the load grows until it slips.
#[test]
fn a_capstan() {
    let text = "format = 1\n[model]\nname = \"Capstan\"\ngravity = [0, 0, 0]\n\
        [body.load]\nmass = 1\ninertia = [1, 1, 1]\nposition = [0.6, 0, 0.2]\n\
        [surface.post]\nshape = \"cylinder\"\naxis = [0, 2, 0]\nradius = 0.19\n\
        [point.dead]\non = \"ground\"\noffset = [-0.8, 0, -0.3]\n\
        [joint.slide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"load\"\naxis = [1, 0, 0]\n\
        [spring.soft]\na = \"dead\"\nb = \"load\"\nstiffness = 100\n\
        [rope.line]\nfrom = \"dead\"\nover = \"post\"\nturns = [1]\nto = \"load\"\nstiffness = 1e4\nradius = 0.01\n\
        friction = 0.3\npretension = 5\n\
        [load.pull]\nat = \"load\"\nforce = [\"200*t\", 0, 0]\n\
        [output.line]\nat = \"line\"\nquantities = [\"tension\", \"wrap_angle\", \"slip\"]\n\
        [output.load_at]\nat = \"load\"\nquantities = [\"position\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.02\n";
    let mut own = start(text);
    run(&mut own, 0.1, 1.0, |_| {});
    // Over the top from left to right, seen from the negative y: the tangent from a point at the distance `D`.
    let tangent = |x: f64, z: f64| (0.2 / x.hypot(z)).acos();
    let [before, behind] = [[-0.8_f64, -0.3], [vector(&own, "load_at.position").x, 0.2]];
    let apart = (behind[0].atan2(behind[1]) - before[0].atan2(before[1])).rem_euclid(2.0 * PI);
    let wrap = apart - tangent(before[0], before[1]) - tangent(behind[0], behind[1]);
    let found = value(&own, "line.wrap_angle");
    let ratio = value(&own, "line.tension[2]") / value(&own, "line.tension[1]");
    assert!((found - wrap).abs() < 1e-9, "{found} {wrap}");
    assert!((ratio / (0.3 * wrap).exp() - 1.0).abs() < 1e-8, "{ratio}");
    assert!(value(&own, "line.slip") > 1e-4);
}

/// A drum of 0.2 m and a rope of 0.01 m radius that a drive turns by an angle: the load, whose tension stays its weight,
/// rises by 0.21 m for each radian. Any number of turns.
#[test]
fn a_drum_winds_up() {
    let text = "format = 1\n[model]\nname = \"Hoist\"\ngravity = [0, 0, -9.81]\n\
        [body.load]\nmass = 5\ninertia = [1, 1, 1]\nposition = [1, 0, -4]\n\
        [body.drum]\nmass = 3\ninertia = [0.1, 0.1, 0.1]\nposition = [0, 0, 0]\n\
        [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"drum\"\naxis = [0, 1, 0]\n\
        [drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nvalue = \"-5*t^2\"\n\
        [joint.slide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"load\"\naxis = [0, 0, 1]\n\
        [surface.barrel]\non = \"drum\"\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.2\n\
        [surface.head]\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.09\noffset = [0.9, 0, 1]\n\
        [rope.line]\nfrom_drum = \"barrel\"\nover = \"head\"\nturns = [1, 1]\nto = \"load\"\nstiffness = 1e7\nradius = 0.01\n\
        pretension = 59.55\n\
        [output.load]\nat = \"load\"\nquantities = [\"displacement\"]\n\
        [output.line]\nat = \"line\"\nquantities = [\"tension\", \"length\"]\n\
        [output.motor]\nat = \"motor\"\nquantities = [\"effort\"]\n\
        [simulation]\nstop = 1\nstep = 2e-3\ntotals = [\"energy\", \"work\"]\n";
    let mut own = start(text);
    run(&mut own, 1.0, 1.0, |_| {});
    let way = vector(&own, "load.displacement").z;
    let tension = value(&own, "line.tension[1]");
    // A load of 5 kg that is lifted with 2.1 m/s² has 59.55 N: the rope is drawn with it, and keeps it.
    assert!((way - 0.21 * 5.0).abs() < 1e-5, "{way}");
    assert!((tension / 59.55 - 1.0).abs() < 1e-2, "{tension}");
}

/// A mass that hangs on a rope over a sheave: `ω² = EA/(S m)` with the free length `S` of spans and arc, and as a
/// pendulum on the hanging part `l`: `ω² = T/(m l)`, where half of the sheave's arc unwinds at each side to second order.
#[test]
fn frequencies_of_a_hanging_mass() {
    let text = "format = 1\n[model]\nname = \"Hanging\"\ngravity = [0, 0, -9.81]\n\
        [body.load]\nmass = 5\ninertia = [1, 1, 1]\nposition = [0.1, 0, -2]\n\
        [surface.head]\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.1\n\
        [point.dead]\non = \"ground\"\noffset = [-0.1, 0, -1]\n\
        [rope.line]\nfrom = \"dead\"\nover = \"head\"\nturns = [1]\nto = \"load\"\nstiffness = 1e4\npretension = 49.05\n\
        [joint.guide]\ntype = \"bushing\"\na = \"ground\"\nb = \"load\"\nrotational_stiffness = [1e6, 1e6, 1e6]\nstiffness = [0, 0, 0]\n\
        [simulation]\nstop = 1\n";
    let own = start(text);
    let found = own.modes(3).unwrap_or_else(|failure| panic!("{}", failure.message)).modes;
    let free = (3.0 + 0.1 * PI) / (1.0 + 49.05 / 1e4);
    for expected in [9.81 / 2.0, 1e4 / (free * 5.0)] {
        let nearest = found.iter().map(|mode| (mode.eigenvalue / expected - 1.0).abs()).fold(f64::INFINITY, f64::min);
        let all: Vec<f64> = found.iter().map(|mode| mode.eigenvalue).collect();
        assert!(nearest < 1e-6, "{expected}: {nearest:e} of {all:?}");
    }
}

/// Bodies that a rope pulls and turns: energy and the energy that friction and damping take balance but for the
/// third-order terms of directions that turn in a step, 1e-4 of what moves.
#[test]
fn energy_balances() {
    let rest = "[output.line]\nat = \"line\"\nquantities = [\"energy\", \"slip\"]\n";
    for kind in KINDS.into_iter().chain(["pretension = 20\nfriction = 0.02\ndamping = 0.3"]) {
        let text = crooked(&format!("{kind}\n{rest}"))
            .replace("stop = 1\n", "stop = 0.15\nstep = 1e-3\nspectral_radius = 1\ntotals = [\"energy\", \"work\"]\n");
        let mut own = start(&text);
        run(&mut own, 0.05, 0.15, |_| {});
        let (drift, taken) = (value(&own, "work.drift"), value(&own, "work.dissipated"));
        let moving = value(&own, "energy.kinetic");
        assert!(moving > 0.1 && drift.abs() < 1e-4 * moving, "{kind}: {drift:e} of {moving:e}");
        // What sticks takes the strain before the step for that of its middle: third-order terms as well.
        let takes = kind.contains("damping") || kind.contains("0.02");
        assert!(taken > -1e-5 * moving && (taken > 2e-5 * moving) == takes, "{kind}: {taken:e}");
    }
}

/// A run goes on from a saved state to the bit.
#[test]
fn states_go_on_to_the_bit() {
    let rest = "[output.line]\nat = \"line\"\nquantities = [\"tension\", \"slip\"]\n";
    for kind in KINDS {
        let mut own = start(&crooked(&format!("{kind}\n{rest}")).replace("stop = 1\n", "stop = 1\nstep = 2e-3\n"));
        run(&mut own, 0.05, 0.05, |_| {});
        goes_on_to_the_bit(&mut own, 0.1);
    }
}

/// A rope between points alone, which never pushes, is a spring that acts on one side. Its direction over a step lacks
/// the third-order term that a spring has: 1e-6 of the way with these steps.
#[test]
fn a_rope_without_sheaves_is_a_spring() {
    let results = [
        "[rope.line]\nfrom = \"ground\"\nto = \"bob\"\nstiffness = 500\nlength = 0.9\n",
        "[spring.line]\na = \"ground\"\nb = \"bob\"\nstiffness = 555.5555555555555\nlength = 0.9\nonly = \"tension\"\n",
    ]
    .map(|line| {
        let text = format!(
            "format = 1\n[model]\nname = \"Bob\"\ngravity = [0, 0, -9.81]\n\
             [body.bob]\nmass = 1\ninertia = [1, 1, 1]\nposition = [0.9, 0, 0.1]\n{line}\
             [output.bob_at]\nat = \"bob\"\nquantities = [\"position\"]\n\
             [simulation]\nstop = 1\nstep = 2e-3\n"
        );
        let mut own = start(&text);
        run(&mut own, 1.0, 1.0, |_| {});
        vector(&own, "bob_at.position")
    });
    assert!((results[0] - results[1]).norm() < 1e-5, "{} {}", results[0], results[1]);
}

/// Wheels inside each other, and a wheel whose axis is along the rope, are mistakes that the message names.
#[test]
fn wheels_that_a_rope_cannot_reach_are_a_mistake() {
    let text = crooked("").replace("position = [0.1, 0.2, -1]", "position = [0.6, 0, 0.45]");
    let message = try_start(&text).unwrap_err();
    assert!(message.contains("rope line has no way from low to high"), "{message}");
    let text = crooked("").replace("axis = [-0.1, 1, 0.1]", "axis = [-0.1, 0.4, 1]");
    let message = try_start(&text).unwrap_err();
    assert!(message.contains("to the plane of surface high") && message.contains("at most 45"), "{message}");
}

/// A quarter of a turn around a sheave stays a quarter, whatever whole turns its body makes: angles go on over turns.
#[test]
fn wraps_of_sheaves_that_spin() {
    let text = "format = 1\n[model]\nname = \"Spin\"\ngravity = [0, 0, 0]\n\
        [body.wheel]\nmass = 1\ninertia = [1, 1, 1]\nposition = [0, 0, 0]\nangular_velocity = [0, 40, 0]\n\
        [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"wheel\"\naxis = [0, 1, 0]\n\
        [surface.rim]\non = \"wheel\"\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.1\n\
        [point.left]\non = \"ground\"\noffset = [-1, 0, 0.1]\n[point.below]\non = \"ground\"\noffset = [0.1, 0, -1]\n\
        [rope.line]\nfrom = \"left\"\nover = \"rim\"\nturns = [1]\nto = \"below\"\nstiffness = 1e4\npretension = 20\n\
        friction = 0\n\
        [output.line]\nat = \"line\"\nquantities = [\"tension\", \"wrap_angle\", \"slip\"]\n\
        [output.axle]\nat = \"axle\"\nquantities = [\"angle\"]\n\
        [simulation]\nstop = 0.5\nstep = 2e-3\n";
    let mut own = start(text);
    run(&mut own, 0.5, 0.5, |_| {});
    assert!((value(&own, "line.wrap_angle") - FRAC_PI_2).abs() < 1e-9);
    assert!((value(&own, "line.tension[2]") - 20.0).abs() < 1e-6);
    // The surface ran forward under the rope.
    let angle = value(&own, "axle.angle");
    assert!(angle > 3.0 * PI && (value(&own, "line.slip") + 0.1 * angle).abs() < 1e-9, "{}", value(&own, "line.slip"));
}

/// A rope that holds a beam between two nodes from a frame, beside a spring of the same stiffness `EA/length`: section
/// forces on both sides of the rope and what the frame must supply are the same to the tolerance of the solution.
#[test]
fn a_rope_between_a_beam_and_a_frame() {
    let lines = [
        "[rope.line]\nfrom = \"hand\"\nto = \"bar@0.6\"\nstiffness = 500\nlength = 0.5\n",
        "[spring.line]\na = \"hand\"\nb = \"bar@0.6\"\nstiffness = 1000\nlength = 0.5\nonly = \"tension\"\n",
    ];
    let [rope, spring] = lines.map(|line| {
        let mut own = start(&format!(
            "format = 1\n[model]\nname = \"Held\"\n\
             [section.s]\nshape = \"rigidities\"\nEA = 1e4\nEI_y = 1\nEI_z = 1\nGJ = 1\nline_density = 2\n\
             [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
             [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"bar.start\"\n\
             [frame.hand]\nposition = [0.6, 0.1, 0.55]\n{line}\
             [output.bar]\non = \"bar\"\nstations = 11\nquantities = [\"section_force\", \"section_moment\"]\n\
             [output.hand]\nat = \"hand\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\n"
        ));
        run(&mut own, 1.0, 1.0, |_| {});
        let results = own
            .variables()
            .iter()
            .enumerate()
            .filter(|(_, row)| row.name.starts_with("bar.section") || row.name.starts_with("hand.reaction"));
        results.map(|(index, _)| own.value(index).number()).collect::<Vec<f64>>()
    });
    assert!(rope.len() == spring.len() && rope.len() > 60);
    let scale = spring.iter().fold(0.0_f64, |largest, own| largest.max(own.abs()));
    for (rope, spring) in rope.iter().zip(&spring) {
        assert!((rope - spring).abs() < 1e-8 * scale, "{rope} {spring}");
    }
}

/// A run warns of a rope that was slack all the time, and of one that has left its sheave: the hand at its end rises from
/// below the sheave to far above it.
#[test]
fn warnings_of_ropes() {
    let warnings = |rope: &str| {
        let mut own = start(&format!(
            "format = 1\n[model]\nname = \"Warned\"\ngravity = [0, 0, 0]\n\
             [body.bob]\nmass = 1\ninertia = [1, 1, 1]\nposition = [-1, 0, 0]\n\
             [joint.held]\ntype = \"weld\"\na = \"ground\"\nb = \"bob\"\n\
             [frame.hand]\nposition = [1, 0, \"-0.5 + 1.5*t\"]\n\
             [surface.head]\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.1\n\
             [rope.line]\nfrom = \"bob\"\nover = \"head\"\nturns = [1]\nto = \"hand\"\nstiffness = 100\n{rope}\n\
             [simulation]\nstop = 1\n"
        ));
        run(&mut own, 0.1, 1.0, |_| {});
        own.conclude();
        own.take_warnings()
    };
    let slack = warnings("length = 9");
    assert!(slack.iter().any(|own| own.contains("rope line was slack all the time")), "{slack:?}");
    let taut = warnings("pretension = 30");
    assert!(taut.iter().any(|own| own.contains("rope line has left sheave head at t = 0.")), "{taut:?}");
    assert!(!taut.iter().any(|own| own.contains("slack")), "{taut:?}");
}
