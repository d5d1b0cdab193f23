//! The linear system about a state: poles and transfer functions against closed forms, the matrices of a rigid
//! mechanism, and the linear motion against the nonlinear one. A stiffness by differences along coordinates is off by
//! 1e-4 in the first test, directors among the states are in that of the rotor, and a forgotten motion of the supports
//! in that of the drive.

use ancf14::model::linear::{Linear, Matrix, Pole, PoleKind};
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::{Curves, load};
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::PI;

const YOUNG: f64 = 2.1e11;
const DENSITY: f64 = 7850.0;
/// Damping in proportion to stiffness, s, and to mass, 1/s.
const STIFFNESS_DAMPING: f64 = 1e-3;
const MASS_DAMPING: f64 = 0.5;
/// Width and height of the cantilever, m; its length is 1 m.
const WIDTH: f64 = 0.02;
const HEIGHT: f64 = 0.01;

const CANTILEVER: &str = r#"format = 1
model = { name = "Cantilever", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3, mass_damping = 0.5 }
section.rod = { shape = "rectangle", width = 0.02, height = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 16, rotary_inertia = false }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.push = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["displacement", "velocity", "acceleration"] }
simulation = { stop = 1, step = 1e-3, output_step = 1e-2 }
"#;

const CART_POLE: &str = r#"format = 1
model = { name = "CartPole", gravity = [0, 0, -9.81] }
body.cart = { mass = 2, position = [0, 0, 0], inertia = [0.1, 0.1, 0.1] }
body.pole = { mass = 0.5, position = [0, 0, 0.6], inertia = [0.02, 0.02, 0.001] }
joint.rail = { type = "prismatic", a = "ground", b = "cart", axis = [1, 0, 0], damping = 0.7 }
joint.pin = { type = "revolute", a = "cart", b = "pole", at = [0, 0, 0], axis = [0, 1, 0], damping = 0.03 }
load.push = { at = "cart", force = [0, 0, 0], input = true }
output.x = { at = "rail", quantities = ["distance", "distance_rate"] }
output.a = { at = "pin", quantities = ["angle", "angle_rate"] }
simulation = { stop = 1, step = 1e-3 }
"#;

/// An overhung rotor on a shaft without mass.
const ROTOR: &str = r#"format = 1
model = { name = "Overhung", gravity = [0, 0, 0] }
parameters = { speed = 100.0 }
material.light = { young = 2.1e11, poisson = 0.3, density = 1e-3 }
section.rod = { shape = "circle", radius = 0.01 }
beam.shaft = { material = "light", section = "rod", from = [0, 0, 0], to = [0.5, 0, 0], elements = 4, angular_velocity = ["speed", 0, 0] }
body.disk = { mass = 5, position = [0.5, 0, 0], inertia = [0.04, 0.022, 0.022], angular_velocity = ["speed", 0, 0] }
joint.bearing = { type = "revolute", a = "ground", b = "shaft.start", axis = [1, 0, 0] }
joint.hub = { type = "weld", a = "shaft.end", b = "disk" }
drive.motor = { joint = "bearing", coordinate = "angle", value = "speed*t" }
output.tip = { at = "shaft.end", quantities = ["displacement"] }
simulation = { stop = 1, step = 1e-3 }
"#;

/// A flexible arm with a payload, whose root a drive turns by 1e-3 rad in 0.2 s.
const ARM: &str = r#"format = 1
model = { name = "Arm" }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3 }
section.rod = { shape = "rectangle", width = 0.01, height = 0.02 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 6 }
body.payload = { mass = 0.5, position = [1, 0, 0], inertia = [1e-4, 1e-4, 1e-4] }
joint.grip = { type = "weld", a = "arm.end", b = "payload" }
joint.motor = { type = "revolute", a = "ground", b = "arm.start", axis = [0, 0, 1] }
drive.turn = { joint = "motor", coordinate = "angle", value = [{ until = 0.2, is = "1e-3*(t/0.2 - sin(2*pi*t/0.2)/(2*pi))" }, { is = 1e-3 }] }
output.tip = { at = "payload", quantities = ["position", "velocity", "acceleration"] }
output.torque = { at = "turn", quantities = ["angle", "effort"] }
simulation = { stop = 0.4, step = 1e-4, output_step = 2e-3 }
"#;

fn linear(model: &Simulation, inputs: &[&str], outputs: &[&str]) -> Linear {
    let [inputs, outputs] =
        [inputs, outputs].map(|names| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
    model.linearize(Some(&inputs), Some(&outputs)).unwrap_or_else(|failure| panic!("{}", failure.message))
}

fn value(pole: &Pole) -> Complex<f64> {
    Complex::new(pole.value[0], pole.value[1])
}

/// The pole nearest to `exact`, whose imaginary part is positive, and its relative error.
fn nearest(poles: &[Pole], exact: Complex<f64>) -> (&Pole, f64) {
    let error = |pole: &Pole| (value(pole) - exact).norm() / exact.norm();
    let found = poles.iter().min_by(|a, b| error(a).total_cmp(&error(b))).unwrap();
    (found, error(found))
}

/// `C (s − A)⁻¹ B + D` of the first input to the first output.
fn transfer(linear: &Linear, s: Complex<f64>) -> Complex<f64> {
    let count = linear.states.len();
    let shifted = DMatrix::from_fn(count, count, |row, column| {
        let own = Complex::from(-linear.a.at(row, column));
        if row == column { s + own } else { own }
    });
    let right = DVector::from_fn(count, |row, _| Complex::from(linear.b.at(row, 0)));
    let state = shifted.lu().solve(&right).unwrap();
    let sum: Complex<f64> = (0..count).map(|own| state[own] * linear.c.at(0, own)).sum();
    sum + linear.d.at(0, 0)
}

/// The roots `k L` of `1 + cos cosh`.
const ROOTS: [f64; 3] = [1.875_104_068_711_961_1, 4.694_091_132_974_174, 7.854_757_438_237_613];

/// `λ² + (c ω² + a) λ + ω² = 0` of the modes `ω` without damping. Errors of 16 elements of order 4 in the waves'
/// length: 1.3e-7, 5.2e-6, 4.5e-5.
#[test]
fn poles_of_a_damped_cantilever_meet_the_closed_form() {
    let model = load(CANTILEVER, &[]);
    let found = linear(&model, &["push.force[3]"], &["tip.displacement[3]"]);
    assert!(found.warnings.is_empty() && found.states.len() == 226, "{:?}", found.warnings);
    let poles = found.poles(&model).unwrap();
    let speed = |moment: f64| (YOUNG * moment / (DENSITY * WIDTH * HEIGHT)).sqrt();
    let axes = [WIDTH * HEIGHT.powi(3) / 12.0, HEIGHT * WIDTH.powi(3) / 12.0];
    // The third pole about the stiff axis is near the critical damping, where errors of the frequency count twice.
    for (moment, bounds) in axes.into_iter().zip([[3e-7, 6e-6, 5e-5], [3e-7, 6e-6, 1.5e-4]]) {
        for (root, bound) in ROOTS.into_iter().zip(bounds) {
            let omega = speed(moment) * root * root;
            let decay = 0.5 * (STIFFNESS_DAMPING * omega * omega + MASS_DAMPING);
            let swing = Complex::from(omega * omega - decay * decay).sqrt() * Complex::new(0.0, 1.0);
            let exact = swing - decay;
            let (pole, error) = nearest(&poles, exact);
            let ratio = pole.damping_ratio() / (decay / exact.norm()) - 1.0;
            println!("{exact:.4}: error {error:.1e}, of the damping ratio {ratio:.1e}");
            assert!(error < bound && ratio.abs() < bound && pole.kind == PoleKind::Oscillating, "{exact}: {error:.1e}");
        }
    }
}

/// The tip compliance of the beam `EI (1 + i c ω) w⁗ = (ω² − i a ω) ρA w` under a force at its end.
#[test]
fn compliance_of_a_damped_cantilever_meets_the_closed_form() {
    let model = load(CANTILEVER, &[]);
    let found = linear(&model, &["push.force[3]"], &["tip.displacement[3]"]);
    for (omega, bound) in [(1.0, 1e-8), (50.0, 5e-6), (327.0, 5e-5)] {
        let rigidity = Complex::new(1.0, omega * STIFFNESS_DAMPING) * (YOUNG * WIDTH * HEIGHT.powi(3) / 12.0);
        let inertia = Complex::new(omega * omega, -omega * MASS_DAMPING) * (DENSITY * WIDTH * HEIGHT);
        let k = (inertia / rigidity).powf(0.25);
        let (sin, cos, sinh, cosh) = (k.sin(), k.cos(), k.sinh(), k.cosh());
        let exact = (sin * cosh - cos * sinh) / (rigidity * k.powi(3) * (Complex::from(1.0) + cos * cosh));
        let error = (transfer(&found, Complex::new(0.0, omega)) - exact).norm() / exact.norm();
        println!("{omega} rad/s: {error:.1e}");
        assert!(error < bound, "{omega} rad/s: {error:.1e}");
    }
}

/// The velocity is `s` times the displacement, and the acceleration `s` times that, to round-off of the stiff modes.
#[test]
fn rates_of_outputs_are_those_of_the_outputs() {
    let model = load(CANTILEVER, &[]);
    let s = Complex::new(0.0, 80.0);
    let [position, velocity, acceleration] = ["displacement", "velocity", "acceleration"]
        .map(|quantity| transfer(&linear(&model, &["push.force[3]"], &[&format!("tip.{quantity}[3]")]), s));
    assert!((velocity / (s * position) - 1.0).norm() < 1e-9, "{velocity} {position}");
    assert!((acceleration / (s * velocity) - 1.0).norm() < 1e-6, "{acceleration} {velocity}");
}

/// A pole on a cart: masses `M`, `m`, distance `l` of the centers, inertia `J`, dampers `c` and `d`. The matrices in the
/// outputs, which are as many as the states, meet the closed form to round-off.
#[test]
fn a_pole_on_a_cart_has_the_matrices_of_the_textbook() {
    let model = load(CART_POLE, &[]);
    let found = linear(&model, &["push.force[1]"], &["x.distance", "a.angle", "x.distance_rate", "a.angle_rate"]);
    assert_eq!(found.states.len(), 4, "{:?}", found.states);
    let of = |matrix: &Matrix| DMatrix::from_column_slice(matrix.rows, matrix.columns, &matrix.values);
    let [a, b, c] = [&found.a, &found.b, &found.c].map(of);
    let (own_a, own_b) = (&c * a * c.clone().try_inverse().unwrap(), &c * b);
    let (cart, pole, length, inertia, gravity, damper, hinge) = (2.0, 0.5, 0.6, 0.02, 9.81, 0.7, 0.03);
    let coupling = pole * length;
    let mass = DMatrix::from_row_slice(2, 2, &[cart + pole, coupling, coupling, inertia + coupling * length]);
    let inverse = mass.try_inverse().unwrap();
    let stiff = &inverse * DMatrix::from_row_slice(2, 2, &[0.0, 0.0, 0.0, coupling * gravity]);
    let damped = &inverse * DMatrix::from_row_slice(2, 2, &[-damper, 0.0, 0.0, -hinge]);
    let mut exact = DMatrix::zeros(4, 4);
    exact[(0, 2)] = 1.0;
    exact[(1, 3)] = 1.0;
    exact.view_mut((2, 0), (2, 2)).copy_from(&stiff);
    exact.view_mut((2, 2), (2, 2)).copy_from(&damped);
    let exact_b = DMatrix::from_row_slice(4, 1, &[0.0, 0.0, inverse[(0, 0)], inverse[(1, 0)]]);
    let errors = [(own_a - &exact).amax() / exact.amax(), (own_b - &exact_b).amax() / exact_b.amax()];
    println!("A {:.1e}, B {:.1e}", errors[0], errors[1]);
    assert!(errors.iter().all(|error| *error < 1e-12), "{errors:?}");
    let poles = found.poles(&model).unwrap();
    let kinds = [PoleKind::Rigid, PoleKind::Overdamped, PoleKind::Unstable, PoleKind::Overdamped];
    assert_eq!(poles.iter().map(|pole| pole.kind).collect::<Vec<_>>(), kinds, "{poles:?}");
}

/// Whirl of the overhung rotor, in the fixed frame: `(k11 − m ω²)(k22 − J_d ω² + Ω J_p ω) = k12²`, backward where `ω` is
/// negative. The mass of the shaft, 1.6e-7 kg of 5 kg, and round-off of its stiff modes leave 1e-8.
#[test]
fn whirl_of_an_overhung_rotor_meets_the_closed_form() {
    let (mass, polar, diametral, length) = (5.0, 0.04, 0.022, 0.5_f64);
    let rigidity = YOUNG * PI * 0.01_f64.powi(4) / 4.0;
    let [k11, k12, k22] = [12.0 / length, -6.0, 4.0 * length].map(|factor| factor * rigidity / (length * length));
    for (speed, starts) in [(0.0, [-87.2, 87.2, -789.8, 789.8]), (100.0, [-83.7, 90.8, -708.1, 882.8])] {
        let residual = |omega: f64| {
            (k11 - mass * omega * omega) * (k22 - diametral * omega * omega + speed * polar * omega) - k12 * k12
        };
        let newton = |omega: f64| {
            let step = 1e-5 * omega;
            omega - residual(omega) * 2.0 * step / (residual(omega + step) - residual(omega - step))
        };
        let model = load(ROTOR, &[("speed", &speed.to_string())]);
        let poles = linear(&model, &[], &[]).poles(&model).unwrap();
        for start in starts {
            let exact = (0..20).fold(start, |omega, _| newton(omega));
            let (pole, error) = nearest(&poles, Complex::new(0.0, exact.abs()));
            println!("{speed} rad/s: {exact:.4}, error {error:.1e}, real part {:.1e}", pole.value[0]);
            assert!(error < 1e-7, "{exact}: {pole:?}");
        }
    }
}

/// The arm on a drive as a linear system whose input is the acceleration of the drive, against the nonlinear run: the
/// rest is what an angle of 1e-3 rad has of nonlinearity, and the error of the steps.
#[test]
fn an_arm_on_a_drive_moves_as_the_nonlinear_one() {
    let outputs = ["tip.position[2]", "tip.acceleration[2]", "torque.effort"];
    let found = linear(&load(ARM, &[]), &["turn.acceleration"], &outputs);
    assert!(found.states.iter().any(|state| state.name == "turn.rate"), "{:?}", found.states);
    let (step, count, each) = (2e-4, 2000, 10);
    let states = found.states.len();
    // The input is linear over a step.
    let held = DMatrix::from_fn(states + 2, states + 2, |row, column| {
        if row < states && column < states {
            found.a.at(row, column) * step
        } else if row < states && column == states {
            found.b.at(row, 0) * step
        } else if row == states && column == states + 1 {
            1.0
        } else {
            0.0
        }
    });
    let held = held.exp();
    let acceleration = |number: usize| {
        let time = number as f64 * step;
        if time < 0.2 { 1e-3 * 2.0 * PI / 0.04 * (2.0 * PI * time / 0.2).sin() } else { 0.0 }
    };
    let mut state = DVector::zeros(states + 2);
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for number in 0..=count {
        let input = acceleration(number);
        if number % each == 0 {
            let output = |row: usize| {
                let sum: f64 = (0..states).map(|own| found.c.at(row, own) * state[own]).sum();
                found.outputs[row].value + sum + found.d.at(row, 0) * input
            };
            rows.push((0..outputs.len()).map(output).collect());
        }
        state[states] = input;
        state[states + 1] = acceleration(number + 1) - input;
        state = &held * &state;
    }
    let curves = Curves::run(ARM, &[]);
    for ((number, name), bound) in outputs.iter().enumerate().zip([2e-5, 5e-4, 1e-3]) {
        let full = curves.column(name);
        let largest = full.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let difference = full.iter().zip(&rows).map(|(full, row)| (full - row[number]).abs()).fold(0.0, f64::max);
        println!("{name}: {:.1e} of {largest:.2e}", difference / largest);
        assert!(full.len() == rows.len() && difference < bound * largest, "{name}: {:.1e}", difference / largest);
    }
}

/// Refusals name what there is.
#[test]
fn unknown_names_are_refused() {
    let model = load(CANTILEVER, &[]);
    let told =
        |inputs: &[String], outputs: &[String]| model.linearize(Some(inputs), Some(outputs)).unwrap_err().message;
    let message = told(&["pull.force".to_owned()], &[]);
    assert!(message.contains("no input `pull.force`") && message.contains("push.force[3]"), "{message}");
    let message = told(&[], &["tip.angle".to_owned()]);
    assert!(message.contains("no output `tip.angle`") && message.contains("tip.displacement[3]"), "{message}");
}
