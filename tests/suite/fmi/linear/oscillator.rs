//! Are the steps of a linear unit exact? A damped oscillator has a closed form for inputs that are constant or change
//! linearly.

use super::{OMEGA, U0, Y0, ZETA, begun, oscillator, outputs};
use crate::random::Random;
use crate::support::allocations;
use ancf14::fmi::instance::Instance;
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::Causality;
use ancf14::fmi::{Model, Value};
use ancf14::linear::{File, Unit};
use ancf14::packed::Packed;

/// Position and rate after `h` s, from `x` and `v`, with the input `u + s t`.
pub(super) fn moved([x, v]: [f64; 2], u: f64, s: f64, h: f64) -> [f64; 2] {
    let (decay, omega) = (ZETA * OMEGA, OMEGA * (1.0 - ZETA * ZETA).sqrt());
    // The particular solution p + q t, and the rest, which vibrates.
    let q = s / OMEGA.powi(2);
    let p = (u - 2.0 * decay * q) / OMEGA.powi(2);
    let (a, b) = (x - p, (v - q + decay * (x - p)) / omega);
    let (fade, (sin, cos)) = ((-decay * h).exp(), (omega * h).sin_cos());
    let swing = a * cos + b * sin;
    let rate = omega * (b * cos - a * sin) - decay * swing;
    [p + q * h + fade * swing, q + fade * rate]
}

/// Two hundred steps of 1e-4 s to 10 s, a new length each, with inputs that ramp.
#[test]
fn steps_of_any_length_are_exact() {
    let mut instance = begun(oscillator());
    assert_eq!(outputs::<3>(&mut instance, 1), Y0, "it begins in its state");
    let mut random = Random(1);
    let (mut time, mut state) = (0.0, [0.0; 2]);
    let mut worst: f64 = 0.0;
    for _ in 0..200 {
        let step = 10.0_f64.powf(2.5 * random.signed() - 1.5);
        let (value, slope) = (random.signed(), random.signed() / step);
        instance.set_real(&[0], &[U0 + value]).unwrap();
        instance.set_real_input_derivatives(&[0], &[1], &[slope]).unwrap();
        instance.do_step(time, step).unwrap();
        let taken = (time + step) - time;
        state = moved(state, value, slope, taken);
        time += step;
        let end = value + slope * taken;
        let acceleration = end - 2.0 * ZETA * OMEGA * state[1] - OMEGA.powi(2) * state[0];
        let found = outputs::<3>(&mut instance, 1);
        let errors = found.iter().zip(Y0).zip([state[0], state[1], acceleration]);
        worst = errors.map(|((found, offset), exact)| (found - offset - exact).abs()).fold(worst, f64::max);
    }
    println!("largest error {worst:.1e}");
    // A few round-offs of accelerations up to ω² a step, 1e-14 each.
    assert!(worst < 1e-12, "{worst:.1e}");
}

/// A derivative of an input is for one step.
#[test]
fn ramps_last_for_one_step() {
    let mut instance = begun(oscillator());
    instance.set_real_input_derivatives(&[0], &[1], &[2.0]).unwrap();
    instance.do_step(0.0, 0.25).unwrap();
    instance.do_step(0.25, 0.25).unwrap();
    let first = moved([0.0; 2], 0.0, 2.0, 0.25);
    let second = moved(first, 0.0, 0.0, 0.25);
    let found = outputs::<2>(&mut instance, 1);
    assert!((found[0] - Y0[0] - second[0]).abs() < 1e-15, "{found:?} {second:?}");
    assert!((found[1] - Y0[1] - second[1]).abs() < 1e-14, "{found:?} {second:?}");
}

/// A host that adds up its time asks for lengths that differ by round-off. One set of matrices serves all of them, no
/// memory is asked for, and the error stays that of the time: a length that is a third of a millisecond would
/// otherwise be off by up to 5e-10 of itself, and the phase after 33 s by 1e-7. Nothing fades here.
#[test]
fn lengths_that_differ_by_round_off_are_one() {
    let mut file = oscillator();
    file.a = super::matrix(&[[0.0, 1.0], [-OMEGA * OMEGA, 0.0]]);
    let mut instance = begun(file);
    let step = 1e-3 / 3.0;
    instance.set_real(&[0], &[U0 + 1.0]).unwrap();
    instance.do_step(0.0, step).unwrap();
    let mut time = step;
    let asked = allocations::count(|| {
        for _ in 1..100_000 {
            instance.do_step(time, step).unwrap();
            time += step;
        }
    });
    assert_eq!(asked, 0);
    let found = outputs::<2>(&mut instance, 1);
    let error = (OMEGA.powi(2) * (found[0] - Y0[0]) - (1.0 - (OMEGA * time).cos())).abs();
    println!("error after {time} s: {error:.1e}");
    // 1e5 steps with a few round-offs of 1e-16 each, all of one sign at worst.
    assert!(error < 1e-10, "{error:.1e}");
}

/// A step of 1,600 periods, of a state whose rate is counted in units of 1e12: the round-off of the phase is that of the
/// period, as long as coordinates are of like size.
#[test]
fn odd_units_cost_no_digits() {
    let (omega, unit) = (1e4_f64, 2.0_f64.powi(40));
    let mut file = oscillator();
    file.a = super::matrix(&[[0.0, unit], [-omega * omega / unit, 0.0]]);
    file.b = super::matrix(&[[0.0], [1.0 / unit]]);
    file.c = super::matrix(&[[1.0, 0.0], [0.0, unit], [0.0, 0.0]]);
    let mut instance = begun(file);
    instance.set_real(&[0], &[U0 + 1.0]).unwrap();
    instance.do_step(0.0, 1.0).unwrap();
    let rate = outputs::<2>(&mut instance, 1)[1] - Y0[1];
    let error = (omega * rate - omega.sin()).abs();
    println!("error {error:.1e}");
    // 15 doublings take a round-off of 1e-16 to 4e-12; the offset of the output leaves 4e-16 of the rate, times omega.
    assert!(error < 1e-10, "{error:.1e}");
}

/// Derivatives of outputs by time and by inputs, at the end of a step and in the initial state.
#[test]
fn derivatives_are_exact() {
    let mut instance = begun(oscillator());
    instance.set_real(&[0], &[U0 + 0.7]).unwrap();
    instance.set_real_input_derivatives(&[0], &[1], &[0.4]).unwrap();
    instance.do_step(0.0, 0.3).unwrap();
    let found = outputs::<3>(&mut instance, 1);
    let mut rates = [f64::NAN; 3];
    instance.get_real_output_derivatives(&[1, 2, 3], &[1; 3], &mut rates).unwrap();
    let [velocity, acceleration] = [found[1] - Y0[1], found[2] - Y0[2]];
    let jerk = 0.4 - 2.0 * ZETA * OMEGA * acceleration - OMEGA.powi(2) * velocity;
    for (rate, exact) in rates.into_iter().zip([velocity, acceleration, jerk]) {
        assert!((rate - exact).abs() < 1e-14 * OMEGA.powi(3), "{rate} {exact}");
    }
    let mut changes = [f64::NAN; 3];
    instance.directional_derivative(&[1, 2, 3], &[0], &[1.0], &mut changes).unwrap();
    // The motion is linear: it is that of an input of 1.
    let [x, v] = moved([0.0; 2], 1.0, 0.0, 0.3);
    for (change, exact) in changes.into_iter().zip([x, v, 1.0 - 2.0 * ZETA * OMEGA * v - OMEGA.powi(2) * x]) {
        assert!((change - exact).abs() < 1e-15, "{change} {exact}");
    }

    instance.reset().unwrap();
    assert_eq!(outputs::<3>(&mut instance, 1), Y0, "start values");
    instance.setup_experiment(None, 2.0, None).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.set_real(&[0], &[U0 + 0.25]).unwrap();
    assert_eq!(outputs::<3>(&mut instance, 1), [Y0[0], Y0[1], Y0[2] + 0.25], "the input acts at once at the start");
    instance.directional_derivative(&[1, 2, 3], &[0], &[1.0], &mut changes).unwrap();
    assert_eq!(changes, [0.0, 0.0, 1.0]);
    instance.exit_initialization_mode().unwrap();
    assert_eq!(instance.time(), 2.0);
    instance.directional_derivative(&[1, 2, 3], &[0], &[1.0], &mut changes).unwrap();
    assert_eq!(changes, [0.0; 3], "no step has been taken");
}

/// A host of FMI 3.0 has adjoint derivatives too, and takes the step in one part.
#[test]
fn hosts_of_the_other_standard_are_served() {
    let unit = Unit::load("linear.toml", &oscillator().text()).unwrap();
    let mut instance = Instance::of(Standard::Fmi3, Packed::Linear(Box::new(unit)), false);
    instance.enter_initialization_mode_for(None, 0.0, None).unwrap();
    instance.exit_initialization_mode().unwrap();
    instance.set_real(&[0], &[U0 + 1.0]).unwrap();
    instance.begin_step(0.0, 0.3).unwrap();
    let progress = instance.take_part().unwrap();
    assert!(progress.arrived && progress.time == 0.3, "{progress:?}");
    instance.go_on().unwrap();
    let [x, v] = moved([0.0; 2], 1.0, 0.0, 0.3);
    let found = outputs::<2>(&mut instance, 1);
    assert!((found[0] - Y0[0] - x).abs() < 1e-15 && (found[1] - Y0[1] - v).abs() < 1e-15, "{found:?} {x} {v}");
    let mut adjoint = [f64::NAN];
    instance.adjoint_derivative(&[1, 2], &[0], &[1.0, -3.0], &mut adjoint).unwrap();
    assert!((adjoint[0] - (x - 3.0 * v)).abs() < 1e-15, "{adjoint:?}");
}

/// The variable table is that of the file, and initial values depend on what the matrices have entries for.
#[test]
fn variables_are_those_of_the_file() {
    let file = oscillator();
    let unit = Unit::load("linear.toml", &file.text()).unwrap();
    let variables = unit.variables();
    assert_eq!(variables.len(), 8);
    assert_eq!((variables[0].causality, variables[0].start), (Causality::Input, Value::Real(U0)));
    let calculated = variables[1..].iter().filter(|variable| !variable.is_state());
    let found_from: Vec<_> = calculated.map(|variable| variable.found_from.clone().unwrap()).collect();
    assert_eq!(found_from, [vec![4], vec![5], vec![0, 4, 5], vec![5], vec![0, 4, 5]]);
    let descriptions = [&variables[4], &variables[7]].map(|variable| variable.description.as_str());
    assert_eq!(descriptions, ["State 1 of the linear system, x, m", "Derivative of state 2 by time"]);
    assert_eq!(unit.about().name, file.about.name, "the text keeps every character");
    let read = File::read("linear.toml", &file.text()).unwrap();
    assert_eq!((&read.a, &read.b, &read.c, &read.d), (&file.a, &file.b, &file.c, &file.d), "and every digit");
    assert_eq!((&read.inputs, &read.outputs, &read.states), (&file.inputs, &file.outputs, &file.states));
}

/// A motion that grows ends with a sentence, and the state before can be read and left.
#[test]
fn unstable_systems_end_with_an_error() {
    let mut file = oscillator();
    file.a = super::matrix(&[[30.0, 0.0], [0.0, 20.0]]);
    file.b = super::matrix(&[[1.0], [1.0]]);
    let mut instance = begun(file);
    instance.set_real(&[0], &[U0 + 1.0]).unwrap();
    instance.do_step(0.0, 1.0).unwrap();
    let before = outputs::<3>(&mut instance, 1);
    let state = instance.state().unwrap();
    let error = instance.do_step(1.0, 100.0).unwrap_err().to_string();
    assert!(error.contains("is too large for a number at t = 101 s"), "{error}");
    assert_eq!(outputs::<3>(&mut instance, 1), before);
    instance.set_state(&state).unwrap();
    instance.do_step(1.0, 0.1).unwrap();
}
