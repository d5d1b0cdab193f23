//! Component mode synthesis: static responses to all inputs are exact, frequencies come from above, and matrices stay
//! symmetric, so that what is stable stays so. A basis that lacks a static response, coordinates that are not those of
//! the mass matrix, or rounded poles at 0 would show here. Responses are those of the matrices, by a solution at each
//! frequency.

use super::reduction::{CANTILEVER, CART, linear, reduced, response};
use ancf14::model::linear::{Linear, Matrix, Pole};
use ancf14::model::reduced::{Method, Reduced, Size};
use ancf14::model::simulation::Simulation;
use ancf14::model::steady::Spin;
use ancf14_testing::curves::load;
use nalgebra::{Complex, DMatrix, SymmetricEigen};

/// Balances of stiff modes leave this share of the soft ones, as for truncated modes.
const ROUND_OFF: f64 = 1e-7;

fn synthesis(found: &Linear, model: &Simulation, order: usize) -> Reduced {
    reduced(found, model, Size::Order(order), Method::CraigBampton)
}

fn matrix(own: &Matrix) -> DMatrix<f64> {
    DMatrix::from_column_slice(own.rows, own.columns, &own.values)
}

/// Stiffness and damping of a system without prescribed and free motions, whose coordinates have masses of 1.
fn second_order(found: &Linear) -> [DMatrix<f64>; 2] {
    let (a, count) = (matrix(&found.a), found.states.len() / 2);
    [-a.view((count, 0), (count, count)).clone_owned(), -a.view((count, count), (count, count)).clone_owned()]
}

/// Two loads in both planes and outputs of both, at each order: the response to constant inputs is the whole one's.
#[test]
fn static_responses_are_exact() {
    let model = load(CANTILEVER, &[]);
    let whole = linear(
        &model,
        &["push.force[3]", "push.force[2]"],
        &["tip.displacement", "tip.rotation", "momentum.linear[3]"],
    );
    let full = response(&whole, Complex::from(0.0));
    for order in [4, 5, 8, 14] {
        let small = synthesis(&whole, &model, order);
        assert_eq!((small.linear.states.len(), small.bound, small.kept), (order - order % 2, None, 0));
        let own = response(&small.linear, Complex::from(0.0));
        for (output, signal) in whole.outputs.iter().enumerate() {
            let largest = full.row(output).iter().map(|own| own.norm()).fold(0.0, f64::max);
            let apart = (full.row(output) - own.row(output)).iter().map(|own| own.norm()).fold(0.0, f64::max);
            println!("{order} {}: {apart:.1e} of {largest:.1e}", signal.name);
            // Along the beam nothing moves, and constant loads do not accelerate it: only round-off is left.
            assert!(apart < ROUND_OFF * largest.max(1e-3), "{order} {}: {apart:e} {largest:e}", signal.name);
        }
    }
}

/// The tip load's deflection `3 x² − x³` alone has the frequency `√(140/11)`, 1.5 % above that of the first mode, 3.516;
/// with each mode the next frequency comes down to that of the whole mechanism, never below it.
#[test]
fn frequencies_converge_from_above() {
    let model = load(CANTILEVER, &[]);
    let whole = linear(&model, &["push.force[3]"], &["tip.displacement[3]"]);
    let bar = f64::sqrt(2.1e11 * 0.02 * 0.01_f64.powi(3) / 12.0 / (7850.0 * 0.02 * 0.01));
    let known = [1.875_104_069, 4.694_091_133, 7.854_757_438, 10.995_540_735].map(|own: f64| own * own * bar);
    let mut last = [f64::INFINITY; 4];
    for order in [2, 4, 6, 8] {
        let small = synthesis(&whole, &model, order);
        let [stiffness, _] = second_order(&small.linear);
        let mut squares: Vec<f64> = SymmetricEigen::new(stiffness).eigenvalues.iter().copied().collect();
        squares.sort_by(f64::total_cmp);
        let above: Vec<f64> = squares.iter().zip(known).map(|(own, known)| own.sqrt() / known - 1.0).collect();
        println!("{order} states: {above:?}");
        // The mesh makes the fourth frequency 2e-4 higher, and Newton leaves the first ones within 1e-7.
        for (own, last) in above.iter().zip(&mut last) {
            assert!(*own > -1e-7 && *own <= *last + 1e-7, "{order}: {above:?}");
            *last = *own;
        }
        if order == 2 {
            assert!((squares[0].sqrt() / bar / f64::sqrt(140.0 / 11.0) - 1.0).abs() < 1e-6, "{above:?}");
        }
    }
    assert!(last[0] < 1e-6 && last[2] < 1e-4 && last[3] > 1e-3, "{last:?}");
}

/// The error that the reduction tells is that of the responses, and falls with the states, by far faster than that of
/// truncated modes; an error that is asked for is met.
#[test]
fn responses_converge() {
    let model = load(CANTILEVER, &[]);
    let whole = linear(&model, &["push.force[3]"], &["tip.displacement[3]"]);
    let rest = response(&whole, Complex::from(0.0))[(0, 0)].norm();
    let frequencies = [1.0, 30.0, 52.0, 52.47, 53.0, 150.0, 327.0, 500.0, 900.0, 2000.0];
    for (order, most) in [(4, 5e-2), (6, 1e-3), (8, 1e-4)] {
        let small = synthesis(&whole, &model, order);
        let apart = frequencies.map(|omega| {
            let [full, own] = [&whole, &small.linear].map(|own| response(own, Complex::new(0.0, omega))[(0, 0)]);
            (full - own).norm() / rest
        });
        println!("{order} states: told {:.1e}, found {apart:?}", small.error);
        let largest = apart.iter().copied().fold(0.0, f64::max);
        assert!(small.error < most && largest < 1.01 * small.error && largest > 0.05 * small.error, "{apart:?}");
        let modal = reduced(&whole, &model, Size::Order(order), Method::Modal);
        assert!(order < 6 || small.error < 0.6 * modal.error, "{order}: {:e} {:e}", small.error, modal.error);
    }
    let small = reduced(&whole, &model, Size::Error(1e-3), Method::CraigBampton);
    assert!(small.linear.states.len() == 6 && small.error <= 1e-3, "{:e}", small.error);
}

/// A free cart, and a drive that an input accelerates: poles at 0 stay there, and the difference of the responses falls
/// with the square of the frequency, as the terms `1/s²`, `1/s` and 1 are exact.
#[test]
fn prescribed_and_free_motions_are_exact_where_they_are_slow() {
    let model = load(CART, &[]);
    let whole = linear(&model, &["push.force[1]", "turn.acceleration"], &["x.distance", "tip.position[1]"]);
    let small = synthesis(&whole, &model, 12);
    let names: Vec<_> = small.linear.states.iter().map(|state| state.name.as_str()).collect();
    println!("{names:?}, error {:.1e}", small.error);
    assert_eq!((small.kept, names.len()), (4, 12));
    assert_eq!(names[8..], ["static[1].rate", "static[2].rate", "turn.value", "turn.rate"]);
    assert_eq!((names[1], names[4], names[6]), ("mode[1]", "static[2]", "mode[1].rate"));
    assert_eq!(small.poles.iter().filter(|pole| pole.value == [0.0, 0.0]).count(), 4, "{:?}", small.poles);
    let apart = |omega: f64| {
        let [full, own] = [&whole, &small.linear].map(|own| response(own, Complex::new(0.0, omega)));
        (&full - &own).map(|own| own.norm())
    };
    let [slow, fast] = [40.0, 80.0].map(apart);
    println!("{slow:.2e} {fast:.2e}");
    // Along the rail only round-off is left.
    let falls = |column: usize| (fast[(1, column)] / slow[(1, column)] - 4.0).abs() < 0.2;
    assert!(falls(0) && falls(1) && slow.row(0).max() < 1e-14 && fast.max() < 1e-10, "{slow:e} {fast:e}");
    // Near the first vibration too, some 30 Hz.
    let [full, own] = [&whole, &small.linear].map(|own| response(own, Complex::new(0.0, 100.0)));
    assert!((&full - &own).norm() < 1e-3 * full.norm(), "{full} {own}");
}

/// A damper at the tip, far from proportional: stiffness and damping stay symmetric, damping positive, all poles stable.
#[test]
fn matrices_stay_symmetric_and_stable() {
    let damper = "frame.wall = { position = [1, 0.5, -1] }\nspring.damper = { a = \"wall\", b = \"arm.end\", stiffness = 10, damping = 40 }\n";
    let model = load(&CANTILEVER.replace("load.push", &format!("{damper}load.push")), &[]);
    let whole = linear(&model, &["push.force[3]", "push.force[2]"], &["tip.displacement"]);
    for order in [4, 6, 10, 16, 24] {
        let small = synthesis(&whole, &model, order);
        let [stiffness, damping] = second_order(&small.linear);
        for own in [&stiffness, &damping] {
            assert!((own - own.transpose()).amax() <= 1e-9 * own.amax(), "{order}: {own:.3e}");
        }
        let least = SymmetricEigen::new(damping.clone()).eigenvalues.min();
        assert!(least > -1e-9 * damping.amax(), "{order}: {least:e}");
        assert!(small.poles.iter().all(|pole| pole.value[0] < 0.0), "{order}: {:?}", small.poles);
    }
}

const ROTOR: &str = r#"format = 1
model = { name = "Rotor", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, mass_damping = 5 }
section.rod = { shape = "circle", radius = 0.01 }
beam.shaft = { material = "steel", section = "rod", from = [0, 0, 0], to = [0.5, 0, 0], elements = 4 }
body.disk = { mass = 5, position = [0.5, 0, 0], inertia = [0.04, 0.022, 0.022] }
joint.bearing = { type = "revolute", a = "ground", b = "shaft.start", axis = [1, 0, 0] }
joint.hub = { type = "weld", a = "shaft.end", b = "disk" }
drive.motor = { joint = "bearing", coordinate = "angle", value = 0 }
load.push = { at = "disk", force = [0, 0, 0], input = true }
output.tip = { at = "disk", quantities = ["position"] }
simulation = { stop = 1, step = 1e-3 }
"#;

/// Gyroscopic forces take no energy: a rotor keeps its whirls. Damping that turns with the shaft is no symmetric
/// stiffness, and refused, as loads that follow the motion are; the messages say what helps.
#[test]
fn what_is_not_symmetric_is_refused() {
    let model = load(ROTOR, &[]);
    let names = |name: &str| vec![name.to_owned()];
    let spin = Spin { drive: "motor".to_owned(), speed: 100.0, is_weightless: false };
    let about = |model: &Simulation| {
        model.linearize_steady(&spin, Some(&names("push.force[3]")), Some(&names("tip.position"))).unwrap()
    };
    let whole = about(&model);
    let small = synthesis(&whole, &model, 14);
    let [full, own] = [&whole, &small.linear].map(|own| response(own, Complex::from(0.0)));
    assert!((&full - &own).norm() < ROUND_OFF * full.norm(), "{full} {own}");
    println!("rotor, error {:.1e}", small.error);
    assert!(small.error < 3e-2 && small.poles.iter().all(|pole| pole.value[0] < 0.0), "{:e}", small.error);

    let model = load(&ROTOR.replace("mass_damping = 5", "damping = 2e-5"), &[]);
    let message = about(&model).reduce(&model, Size::Order(14), Method::CraigBampton).unwrap_err().message;
    assert!(message.contains("symmetric stiffness") && message.contains("--method balanced"), "{message}");

    let follower = "load.follow = { at = \"arm.end\", force = [-50, 0, 0], follower = true }\n";
    let model = load(&CANTILEVER.replace("load.push", &format!("{follower}load.push")), &[]);
    let whole = linear(&model, &["push.force"], &["tip.displacement[3]"]);
    let message = whole.reduce(&model, Size::Order(8), Method::CraigBampton).unwrap_err().message;
    assert!(message.contains("symmetric stiffness, and 3.3e-2 of that"), "{message}");

    let model = load(CANTILEVER, &[]);
    let whole = linear(&model, &["push.force"], &["tip.displacement[3]"]);
    let message = whole.reduce(&model, Size::Order(4), Method::CraigBampton).unwrap_err().message;
    assert!(message.contains("6 states here; ask for at least 6"), "{message}");
}
/// A load on a rope, whose pendulum is 1e12 times softer than the rope: its poles are those of the whole system to
/// their damping of 1e-6, and it follows the foot of the crane as in the whole system below and above its frequency.
#[test]
fn soft_motions_of_stiff_parts_keep_their_digits() {
    let model = load(include_str!("../../../models/crane.toml"), &[]);
    let whole = linear(&model, &["foot.position[2]"], &["load_motion.position[2]"]);
    let poles = whole.poles(&model).unwrap();
    let small = synthesis(&whole, &model, 30);
    println!("crane, {} states: {:.1e}", small.linear.states.len(), small.error);
    for pole in small.poles.iter().filter(|pole| pole.natural_frequency() > 0.0).take(5) {
        let apart = |own: &Pole| f64::hypot(own.value[0] - pole.value[0], own.value[1] - pole.value[1]);
        let nearest = poles.iter().map(apart).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-9 * pole.natural_frequency(), "{:?}: {nearest:e}", pole.value);
    }
    for omega in [0.5, 1.0, 3.0, 10.0] {
        let [full, own] = [&whole, &small.linear].map(|own| response(own, Complex::new(0.0, omega))[(0, 0)]);
        println!("{omega} rad/s: {full} {own}");
        assert!((full - own).norm() < 1e-4 * full.norm(), "{omega}: {full} {own}");
    }

    // Without gravity the rope of the crane takes no load across it.
    let model = load(include_str!("../../../models/crane.toml"), &[("model.gravity", "[0, 0, 0]")]);
    let whole = model.linearize(None, None).unwrap();
    let message = whole.reduce(&model, Size::Order(60), Method::CraigBampton).unwrap_err().message;
    assert!(message.contains("other undamped motions") && message.contains("--method balanced"), "{message}");
}
