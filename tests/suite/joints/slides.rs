//! Joints that slide along a beam.

use crate::random::Random;
use crate::running::{goes_on_to_the_bit, run, start, value, vector};
use crate::support::machines::built;
use ancf14::fmi::Model;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::dynamics;
use ancf14::solve::dynamics::midpoint::Midpoint;
use std::f64::consts::PI;

const G: f64 = 9.81;

/// A wire along `line` that is clamped at both ends, with a bead of 1 kg at `position` on it.
fn wire(line: &str, rigidity: f64, density: f64, bead: &str, rest: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Wire\"\ngravity = [0, 0, -9.81]\n\
         [section.s]\nshape = \"rigidities\"\nEA = {rigidity}\nEI_y = {rigidity}\nEI_z = {rigidity}\nGJ = {rigidity}\n\
         line_density = {density}\n\
         [beam.wire]\nsection = \"s\"\n{line}\n\
         [joint.left]\ntype = \"weld\"\na = \"ground\"\nb = \"wire.start\"\n\
         [joint.right]\ntype = \"weld\"\na = \"ground\"\nb = \"wire.end\"\n\
         [body.bead]\nmass = 1\ninertia = [1e-4, 1e-4, 1e-4]\n{bead}\n\
         [output.m]\nat = \"bead\"\nquantities = [\"position\", \"velocity\"]\n{rest}"
    )
}

/// A bead at rest slides down a straight wire of 30 degrees as a block on an inclined plane does, over seven elements:
/// 1/2 g sin(30) t². The wire of 1e8 N m² gives by 1e-8 m; the law is quadratic, which the step takes exactly.
#[test]
fn straight_wire() {
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    let line = format!("from = [0, 0, 0]\nto = [{}, 0, {}]\nelements = 10", 5.0 * cos, -5.0 * sin);
    let bead = format!("position = [{}, 0, {}]", 0.5 * cos, -0.5 * sin);
    let rest = "[joint.guide]\ntype = \"slide\"\na = \"wire@0.1\"\nb = \"bead\"\n\
        [output.w]\nat = \"guide\"\nquantities = [\"distance\", \"distance_rate\"]\n\
        [simulation]\nstep = 5e-3\nstop = 1.2\n";
    let mut own = start(&wire(&line, 1e8, 1.0, &bead, rest));
    run(&mut own, 0.05, 1.2, |own| {
        let t = own.state().time;
        let way = 0.5 + 0.5 * G * sin * t * t;
        let found = vector(own, "m.position");
        assert!((found.x - way * cos).abs() < 1e-6 && (found.z + way * sin).abs() < 1e-6, "{t}: {found:?}, {way}");
        assert!((value(own, "w.distance") - way + 0.5).abs() < 1e-6, "{t}: {}", value(own, "w.distance"));
        // The wire is let go too, and vibrates along itself with g sin L/(2c), 1.2e-3 m/s.
        assert!((value(own, "w.distance_rate") - G * sin * t).abs() < 2e-3, "{t}: {}", value(own, "w.distance_rate"));
    });
}

/// A bead on a ring is a pendulum, with large swings: the ring of 24 elements is a circle to 5e-6 and its arc to 1e-5,
/// steps of 2 ms are a thousandth of the period. Its energy is constant.
#[test]
fn ring_is_a_pendulum() {
    let line = "curve = { x = \"sin(s)\", y = 0, z = \"-cos(s)\", s = [-2.5, 2.5] }\nelements = 24";
    let rest = "[joint.guide]\ntype = \"slide\"\na = \"wire@0.7\"\nb = \"bead\"\n[simulation]\nstep = 2e-3\nstop = 2\n\
        totals = [\"energy\"]\n";
    let mut own = start(&wire(line, 1e6, 1.0, "position = [\"sin(1)\", 0, \"-cos(1)\"]", rest));
    let energy = value(&own, "energy.total");
    // Runge and Kutta with steps that leave 1e-12.
    let (mut angle, mut rate, steps) = (1.0_f64, 0.0_f64, 500);
    run(&mut own, 0.05, 2.0, |own| {
        if own.state().time > 0.0 {
            let h = 0.05 / f64::from(steps);
            for _ in 0..steps {
                let f = |angle: f64, rate: f64| (rate, -G * angle.sin());
                let a = f(angle, rate);
                let b = f(angle + 0.5 * h * a.0, rate + 0.5 * h * a.1);
                let c = f(angle + 0.5 * h * b.0, rate + 0.5 * h * b.1);
                let d = f(angle + h * c.0, rate + h * c.1);
                angle += h / 6.0 * (a.0 + 2.0 * b.0 + 2.0 * c.0 + d.0);
                rate += h / 6.0 * (a.1 + 2.0 * b.1 + 2.0 * c.1 + d.1);
            }
        }
        let found = vector(own, "m.position");
        let error = (found.x - angle.sin()).abs().max((found.z + angle.cos()).abs());
        assert!(error < 2e-4, "{}: {error:e}", own.state().time);
        // Of 4.5 J that swing. The ring vibrates as the bead passes from element to element, and the dissipation of the
        // step takes that.
        let change = value(own, "energy.total") - energy;
        assert!(change < 1e-4 && change > -1e-3, "{change}");
    });
}

/// The reaction of a bead that passes the lowest point of a ring at 3 m/s is `m v²/R` at once, without gravity. The ring of 1e6
/// kg/m stands still; the curvature in the middle of an element of 0.21 m is that of the circle to 2e-3.
#[test]
fn reaction_has_the_curvature() {
    let line = "curve = { x = \"sin(s)\", y = 0, z = \"-cos(s)\", s = [-2.5, 2.5] }\nelements = 25";
    let rest = "[joint.guide]\ntype = \"slide\"\na = \"wire@0.5\"\nb = \"bead\"\n\
        [output.w]\nat = \"guide\"\nquantities = [\"reaction_force\"]\n[simulation]\nstep = 1e-3\nstop = 1\n";
    let text = wire(line, 1e6, 1e6, "position = [0, 0, -1]\nvelocity = [3, 0, 0]", rest);
    let own = start(&text.replace("gravity = [0, 0, -9.81]", "gravity = [0, 0, 0]"));
    let found = vector(&own, "w.reaction_force");
    let expected = 9.0;
    assert!((found.z / expected - 1.0).abs() < 3e-3 && found.x.abs() < 1e-3 * expected, "{found:?}, {expected}");
}

/// A pulley on a rope between two supports at one height, drawn at two fifths of the rope, rests in the middle: the rope
/// turns it back by mesh and kink alone near there, so that it stays within a fortieth of an element of 0.1 m.
#[test]
fn pulley_on_a_rope() {
    let text = "format = 1\n[model]\nname = \"Pulley\"\ngravity = [0, 0, -9.81]\n\
        [parameters]\nbegin = \"asin(0.6)\"\nplace = \"begin + 0.4*(pi - 2*begin)\"\n\
        [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 0.1\nEI_z = 0.1\nGJ = 0.1\nline_density = 1e-3\n\
        [beam.rope]\nsection = \"s\"\nelements = 60\n\
        curve = { x = \"2 - 2.5*cos(s)\", y = 0, z = \"1.5 - 2.5*sin(s)\", s = [\"begin\", \"pi - begin\"] }\n\
        [joint.left]\ntype = \"spherical\"\na = \"ground\"\nb = \"rope.start\"\n\
        [joint.right]\ntype = \"spherical\"\na = \"ground\"\nb = \"rope.end\"\n\
        [body.load]\nmass = 1\ninertia = [1e-4, 1e-4, 1e-4]\n\
        position = [\"2 - 2.5*cos(place)\", 0, \"1.5 - 2.5*sin(place)\"]\n\
        [joint.guide]\ntype = \"slide\"\na = \"rope@0.4\"\nb = \"load\"\n\
        [output.m]\nat = \"load\"\nquantities = [\"position\"]\n\
        [output.w]\nat = \"guide\"\nquantities = [\"reaction_force\"]\n\
        [simulation]\nanalysis = \"static\"\nstop = 1\noutput_step = 1\n";
    let mut own = start(text);
    run(&mut own, 1.0, 1.0, |_| {});
    let (found, force) = (vector(&own, "m.position"), vector(&own, "w.reaction_force"));
    assert!((found.x - 2.0).abs() < 2.5e-3 && found.z < -1.1, "{found:?}");
    assert!((force.z / G - 1.0).abs() < 1e-6 && force.xy().norm() < 1e-6 * G, "{force:?}");
}

/// A thin rod that falls and slides through an eye in the ground, frictionless: with the place `s` of its middle behind
/// the eye and the angle `a` to the horizontal `s'' = s a'² - g sin a`, `((m L²/12 + m s²) a')' = -m g s cos a`. The rod of
/// 1e4 N m² bends by 2e-5 m, and steps of 1 ms are off by 1e-6. Its energy is constant.
#[test]
fn beam_through_an_eye() {
    let text = "format = 1\n[model]\nname = \"Eye\"\ngravity = [0, 0, -9.81]\n\
        [section.s]\nshape = \"rigidities\"\nEA = 1e6\nEI_y = 1e4\nEI_z = 1e4\nGJ = 1e4\nline_density = 1\n\
        [beam.rod]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [\"cos(0.5)\", 0, \"sin(0.5)\"]\nelements = 6\n\
        [joint.eye]\ntype = \"slide\"\na = \"rod@0.6\"\nb = \"ground\"\n\
        [output.m]\nat = \"rod@0.5\"\nquantities = [\"position\"]\n\
        [simulation]\nstep = 1e-3\nstop = 0.25\ntotals = [\"energy\"]\nspectral_radius = 1\n";
    let mut own = start(text);
    let energy = value(&own, "energy.total");
    let eye = [0.6 * 0.5_f64.cos(), 0.6 * 0.5_f64.sin()];
    // Place, angle, and their rates.
    let mut state = [-0.1, 0.5, 0.0, 0.0];
    let rates = |[s, a, speed, turn]: [f64; 4]| {
        let turning = (-G * s * a.cos() - 2.0 * s * speed * turn) / (1.0 / 12.0 + s * s);
        [speed, turn, s * turn * turn - G * a.sin(), turning]
    };
    let moved = |from: [f64; 4], by: [f64; 4], h: f64| -> [f64; 4] { std::array::from_fn(|i| from[i] + h * by[i]) };
    let mut slid = 0.0_f64;
    run(&mut own, 0.01, 0.25, |own| {
        // Runge and Kutta with steps that leave 1e-12.
        for _ in 0..100 {
            let h = 1e-4;
            let a = rates(state);
            let b = rates(moved(state, a, 0.5 * h));
            let c = rates(moved(state, b, 0.5 * h));
            let d = rates(moved(state, c, h));
            state = std::array::from_fn(|i| state[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        }
        let [s, a, ..] = state;
        slid = slid.max((s + 0.1).abs());
        let found = vector(own, "m.position");
        let error = (found.x - eye[0] - s * a.cos()).abs().max((found.z - eye[1] - s * a.sin()).abs());
        assert!(error < 1e-4, "{}: {error:e}", own.state().time);
        assert!((value(own, "energy.total") - energy).abs() < 1e-4, "{}", value(own, "energy.total") - energy);
    });
    assert!(slid > 0.1, "{slid}");
}

fn conditions(system: &System, state: &State, q: &[f64]) -> Vec<f64> {
    let mut frames = FrameCache::default();
    frames.set(system, q, &state.triads);
    let c = system.configuration(q, &frames, state, &state.prescribed);
    let mut found = vec![0.0; system.constraints()];
    system.constraint_conditions(&c, &mut found);
    found
}

/// Gradient and second derivative of the conditions along motions that they allow, by differences of the conditions: the
/// bead slides by them.
#[test]
fn conditions_follow_the_bead() {
    let line = "curve = { x = \"sin(s)\", y = \"0.2*s\", z = \"-cos(s)\", s = [-2.5, 2.5] }\nelements = 7";
    let rest =
        "[joint.guide]\ntype = \"slide\"\na = \"wire@0.65\"\nb = \"bead\"\n[simulation]\nstep = 1e-3\nstop = 1\n";
    let bead = "position = [\"sin(0.75)\", 0.15, \"-cos(0.75)\"]";
    let (system, mut state) = built(&wire(line, 1.0, 1.0, bead, rest));
    let mut random = Random(3);
    state.velocity = state.q.iter().map(|_| random.signed()).collect();
    dynamics::start::set_motion(&system, &mut Midpoint::new(&system, 1.0, 1.0, 1e-10), &mut state).expect("a start");
    let velocity = state.velocity.clone();
    let mut frames = FrameCache::default();
    let c = frames.of(&system, &state);
    let mut gradients = Vec::new();
    system.constraint_gradients(&c, &mut gradients);
    let mut rates = vec![0.0; system.constraints()];
    system.add_constraint_rates(&gradients, &velocity, &mut rates);
    let mut second = vec![0.0; system.constraints()];
    system.constraint_accelerations(&c, &velocity, &mut second);
    let rows = system.joints_with_rows().find(|(joint, _)| joint.slide.is_some()).expect("a slide").1;
    let at = |by: f64| {
        let q: Vec<f64> = state.q.iter().zip(&velocity).map(|(q, v)| q + by * v).collect();
        conditions(&system, &state, &q)
    };
    let h = 1e-4;
    let (more, now, less) = (at(h), at(0.0), at(-h));
    for row in rows {
        assert!(rates[row].abs() < 1e-12, "the velocities are allowed: {:e}", rates[row]);
        // Differences: h² of third derivatives, about 10, and 1e-16/h².
        let first = (more[row] - less[row]) / (2.0 * h);
        assert!((first - rates[row]).abs() < 1e-6, "{row}: {first:e}, {:e}", rates[row]);
        let found = (more[row] - 2.0 * now[row] + less[row]) / (h * h);
        assert!((found - second[row]).abs() < 1e-5 * (1.0 + second[row].abs()), "{row}: {found:e}, {:e}", second[row]);
        assert!(second[row].abs() > 1e-2, "{row}: {:e}", second[row]);
    }
}

/// Who slides to the end of a beam is told so, with a remedy.
#[test]
fn end_of_the_beam() {
    let line = "from = [0, 0, 0]\nto = [1, 0, -1]\nelements = 4";
    let rest = "[joint.guide]\ntype = \"slide\"\na = \"wire@0.8\"\nb = \"bead\"\n[simulation]\nstep = 1e-2\nstop = 2\n";
    let mut own = start(&wire(line, 1e8, 1.0, "position = [0.8, 0, -0.8]", rest));
    let message = (1..200).find_map(|row| own.advance(f64::from(row) * 0.01).err()).expect("an end").message;
    assert!(message.contains("joint guide has come to an end of beam wire"), "{message}");
    // 1/2 g sin(45) t² = 0.2 sqrt(2) m.
    let expected = (0.4 * 2.0_f64.sqrt() / (G * (PI / 4.0).sin())).sqrt();
    assert!((own.state().time - expected).abs() < 0.02, "{}, {expected}", own.state().time);
}

/// A run goes on from a saved state to the bit, also over nodes of the wire, with a bead and a load that moves.
#[test]
fn states_go_on_to_the_bit() {
    let line = "curve = { x = \"sin(s)\", y = 0, z = \"-cos(s)\", s = [-2.5, 2.5] }\nelements = 12";
    let rest = "[joint.guide]\ntype = \"slide\"\na = \"wire@0.7\"\nb = \"bead\"\n\
        [load.runner]\non = \"wire\"\nstation = \"t\"\nforce = [0, 1, -10]\n\
        [output.w]\nat = \"guide\"\nquantities = [\"distance\", \"reaction_force\"]\n\
        [simulation]\nstep = 5e-3\nstop = 2\n";
    let mut own = start(&wire(line, 1e4, 1.0, "position = [\"sin(1)\", 0, \"-cos(1)\"]", rest));
    for number in 1..=20 {
        let begin = 0.05 * f64::from(number);
        own.advance(begin).unwrap_or_else(|failure| panic!("{}", failure.message));
        goes_on_to_the_bit(&mut own, begin + 0.07);
    }
    assert!(value(&own, "w.distance") < -0.5, "{}", value(&own, "w.distance"));
}
