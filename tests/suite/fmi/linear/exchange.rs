//! Model Exchange: are derivatives and outputs those of the matrices at every instant, so that the solver of a host
//! meets the closed form of the motion, also where the input jumps?

use super::exchange_host::{OUTPUTS, Place, RATES, STATE, STATES, Unit};
use super::oscillator::moved;
use super::{OMEGA, U0, Y0, ZETA, begun, matrix, oscillator};
use crate::random::Random;
use ancf14::fmi::Model;
use ancf14::fmi::instance::Instance;
use ancf14::fmi::lifecycle::{Kind, Mode, Standard};
use ancf14::linear::Unit as Linear;
use ancf14::packed::Packed;

const BOTH: [Standard; 2] = [Standard::Fmi2, Standard::Fmi3];

/// `x''` of the oscillator with the change `u` of the input.
fn acceleration([x, v]: [f64; STATES], u: f64) -> f64 {
    u - 2.0 * ZETA * OMEGA * v - OMEGA.powi(2) * x
}

/// Random states and inputs, by both ways to read and to set them. A state that is counted in units of 1e12 costs no
/// digit: units are powers of two.
#[test]
fn rates_and_outputs_follow_at_once() {
    let unit_of_rate = 2.0_f64.powi(40);
    let mut odd = oscillator();
    odd.a = matrix(&[[0.0, unit_of_rate], [-OMEGA * OMEGA / unit_of_rate, -2.0 * ZETA * OMEGA]]);
    odd.b = matrix(&[[0.0], [1.0 / unit_of_rate]]);
    odd.c = matrix(&[[1.0, 0.0], [0.0, unit_of_rate], [-OMEGA * OMEGA, -2.0 * ZETA * OMEGA * unit_of_rate]]);
    for (file, size) in [(oscillator(), 1.0), (odd, unit_of_rate)] {
        let place = Place::new(&file.text());
        for standard in BOTH {
            let unit = Unit::in_mode(&place, standard, Mode::ContinuousTime);
            let mut random = Random(3);
            for number in 0..50 {
                let (u, state) = (random.signed(), [random.signed(), random.signed()]);
                let given = [state[0], state[1] / size];
                assert!(unit.set_time(0.1 * f64::from(number)) && unit.set(&[0], &[U0 + u]));
                let done = if number % 2 == 0 { unit.set_states(&given) } else { unit.set(&STATE, &given) };
                assert!(done, "{:?}", unit.lines());
                assert_eq!(unit.states(), given);
                let rates = unit.derivatives().unwrap();
                let exact = [state[1], acceleration(state, u)];
                // A few round-offs of the largest term, 49.
                assert!((rates[0] - exact[0]).abs() < 1e-15, "{rates:?} {exact:?}");
                assert!((rates[1] * size - exact[1]).abs() < 5e-14, "{rates:?} {exact:?}");
                let (mut again, mut results) = ([f64::NAN; STATES], [f64::NAN; 3]);
                assert!(unit.get(&RATES, &mut again) && unit.get(&OUTPUTS, &mut results));
                assert_eq!(again, rates);
                for ((found, offset), exact) in results.into_iter().zip(Y0).zip([state[0], state[1], exact[1]]) {
                    assert!((found - offset - exact).abs() < 5e-14, "{results:?} {exact}");
                }
            }
        }
    }
}

/// A step of Runge and Kutta's method of order 4, with the input `u + s t`.
fn runge_kutta(unit: &Unit, time: f64, step: f64, input: impl Fn(f64) -> f64) {
    let x = unit.states();
    let rate = |time: f64, along: [f64; STATES], length: f64| {
        assert!(unit.set_time(time) && unit.set(&[0], &[input(time)]));
        assert!(unit.set_states(&[x[0] + length * along[0], x[1] + length * along[1]]));
        unit.derivatives().unwrap()
    };
    let a = rate(time, [0.0; STATES], 0.0);
    let b = rate(time + step / 2.0, a, step / 2.0);
    let c = rate(time + step / 2.0, b, step / 2.0);
    let d = rate(time + step, c, step);
    let next: Vec<f64> = (0..STATES).map(|k| x[k] + step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k])).collect();
    assert!(unit.set_states(&next));
    assert!(unit.call(ancf14::fmi::lifecycle::Call::CompletedIntegratorStep));
}

/// An input that ramps for half a second, jumps, and stays: the host enters Event Mode where it jumps.
#[test]
fn a_solver_meets_the_exact_motion() {
    use ancf14::fmi::lifecycle::Call;
    let place = Place::new(&oscillator().text());
    const STEPS: i32 = 512;
    let step = 0.5 / f64::from(STEPS);
    for standard in BOTH {
        let unit = Unit::in_mode(&place, standard, Mode::ContinuousTime);
        (0..STEPS).for_each(|k| runge_kutta(&unit, f64::from(k) * step, step, |time| U0 + 2.0 * time));
        for call in [Call::EnterEventMode, Call::UpdateDiscreteStates] {
            assert!(unit.call(call) && unit.set(&[0], &[U0 - 1.0]), "{:?}", unit.lines());
        }
        let first = moved([0.0; 2], 0.0, 2.0, 0.5);
        let mut at_jump = [f64::NAN; 3];
        assert!(unit.get(&OUTPUTS, &mut at_jump));
        let exact = acceleration(first, -1.0);
        assert!((at_jump[2] - Y0[2] - exact).abs() < 1e-10, "{at_jump:?} {exact}: the jump acts at once");
        assert!(unit.call(Call::EnterContinuousTimeMode));
        (STEPS..2 * STEPS).for_each(|k| runge_kutta(&unit, f64::from(k) * step, step, |_| U0 - 1.0));
        assert!(unit.call(Call::Terminate));
        let second = moved(first, -1.0, 0.0, 0.5);
        let mut found = [f64::NAN; 3];
        assert!(unit.get(&OUTPUTS, &mut found), "results of the end can be read");
        let exact = [second[0], second[1], acceleration(second, -1.0)];
        let errors =
            found.into_iter().zip(Y0).zip(exact).map(|((found, offset), exact)| (found - offset - exact).abs());
        let worst = errors.fold(0.0, f64::max);
        println!("largest error {worst:.1e}");
        // 1,024 steps of (omega h)⁵/120 of accelerations up to 2, omega h = 0.007: 2e-10.
        assert!(worst < 3e-10, "{worst:.1e}");
    }
}

/// Directional derivatives are the entries of the matrices.
#[test]
fn derivatives_are_those_of_the_instant() {
    let place = Place::new(&oscillator().text());
    for standard in BOTH {
        let unit = Unit::in_mode(&place, standard, Mode::ContinuousTime);
        assert_eq!(unit.directional(&OUTPUTS, &[0]).unwrap(), [0.0, 0.0, 1.0]);
        assert!(unit.directional(&[0], &[0]).is_none() && unit.directional(&OUTPUTS, &[1]).is_none());
        assert!(unit.lines().iter().all(|line| line.contains("here derivatives are")));
    }
    let unit = Unit::in_mode(&place, Standard::Fmi2, Mode::Event);
    let of_state = |state: u32| unit.directional(&[1, 2, 3, 6, 7], &[state]).unwrap();
    let (stiffness, damping) = (-OMEGA * OMEGA, -2.0 * ZETA * OMEGA);
    assert_eq!(of_state(STATE[0]), [1.0, 0.0, stiffness, 0.0, stiffness]);
    assert_eq!(of_state(STATE[1]), [0.0, 1.0, damping, 1.0, damping]);
    assert_eq!(unit.directional(&RATES, &[0]).unwrap(), [0.0, 1.0]);
}

/// What a variable depends on is asked for in FMI 3.0, element by element.
#[test]
fn dependencies_are_entries_that_are_not_zero() {
    let unit = Linear::load("linear.toml", &oscillator().text()).unwrap();
    let mut instance = Instance::for_model_exchange(Standard::Fmi3, Packed::Linear(Box::new(unit)), false).unwrap();
    let counts =
        |instance: &Instance<Packed>| [1, 2, 3, 6].map(|reference| instance.count_dependencies(reference).unwrap());
    assert_eq!(counts(&instance), [1, 1, 3, 4], "the rates are one array");
    instance.enter_initialization_mode_for(None, 0.0, None).unwrap();
    instance.exit_initialization_mode().unwrap();
    assert_eq!(counts(&instance), [1, 1, 3, 4]);
    let (mut elements, mut references, mut others) = ([0; 4], [0; 4], [0; 4]);
    instance.dependencies(6, &mut elements, &mut references, &mut others).unwrap();
    assert_eq!((elements, references, others), ([1, 2, 2, 2], [4, 0, 4, 4], [2, 1, 1, 2]));
    assert!(instance.count_dependencies(4).is_err(), "a state depends on nothing");
}

/// A state alone at its nominal value moves no output by more than its nominal value, and one of them by as much.
#[test]
fn nominal_values_fit_the_outputs() {
    let mut file = oscillator();
    for (output, nominal) in file.outputs.iter_mut().zip([0.01, 0.1, 1.0]) {
        output.nominal = Some(nominal);
    }
    let place = Place::new(&file.text());
    let unit = Unit::in_mode(&place, Standard::Fmi3, Mode::Instantiated);
    let nominals = unit.nominals();
    let share =
        |output: usize, state: usize| file.c.at(output, state).abs() * nominals[state] / [0.01, 0.1, 1.0][output];
    let shares: Vec<f64> = (0..3).flat_map(|output| (0..STATES).map(move |state| share(output, state))).collect();
    let largest = shares.iter().copied().fold(0.0, f64::max);
    assert!((largest - 1.0).abs() < 1e-15 && nominals.iter().all(|nominal| *nominal > 1e-3), "{nominals:?} {shares:?}");
}

/// States have start values in co-simulation too, and states and rates can be read: the oscillator is let go.
#[test]
fn co_simulation_begins_with_the_states_too() {
    let mut instance = begun(oscillator());
    instance.reset().unwrap();
    instance.setup_experiment(None, 0.0, None).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.set_real(&STATE, &[0.5, -2.0]).unwrap();
    let mut rates = [f64::NAN; STATES];
    instance.get_real(&RATES, &mut rates).unwrap();
    assert_eq!(rates, [-2.0, acceleration([0.5, -2.0], 0.0)]);
    instance.exit_initialization_mode().unwrap();
    instance.do_step(0.0, 0.3).unwrap();
    let exact = moved([0.5, -2.0], 0.0, 0.0, 0.3);
    let mut found = [f64::NAN; 5];
    instance.get_real(&[4, 5, 6, 7, 1], &mut found).unwrap();
    for (found, exact) in
        found.into_iter().zip([exact[0], exact[1], exact[1], acceleration(exact, 0.0), exact[0] + Y0[0]])
    {
        assert!((found - exact).abs() < 1e-13, "{found} {exact}");
    }
    let refused = instance.set_real(&STATE, &[0.0; 2]).unwrap_err().to_string();
    assert!(refused.contains("state state[1] can be set before the end of the initialization"), "{refused}");
}

/// Numbers that are too large are errors, and the host goes on with smaller ones.
#[test]
fn odd_numbers_are_refused() {
    let place = Place::new(&oscillator().text());
    for standard in BOTH {
        let unit = Unit::in_mode(&place, standard, Mode::ContinuousTime);
        let refused = |done: bool, words: &str| {
            let lines = unit.lines();
            assert!(!done && lines.len() == 1 && lines[0].contains(words), "{words}: {lines:?}");
        };
        refused(unit.set_time(f64::NAN), "variable time cannot be NaN");
        refused(unit.set_states(&[f64::INFINITY, 0.0]), "variable state[1] cannot be inf");
        refused(unit.set_states(&[0.0; 3]), "the call is for 3 states or event indicators, and this unit has 2");
        assert_eq!(unit.states(), [0.0; 2]);
        assert!(unit.set_states(&[5e306, 0.0]));
        refused(unit.derivatives().is_some(), "too large for a number");
        let mut values = [7.5; 3];
        refused(unit.get(&OUTPUTS, &mut values), "x.acceleration is too large for a number");
        assert_eq!(values, [7.5; 3]);
        assert!(unit.set_states(&[1.0, 0.0]) && unit.derivatives().is_some());
    }
    let kinds = [Kind::CoSimulation, Kind::ModelExchange].map(|kind| kind.to_string());
    assert_eq!(kinds, ["co-simulation", "Model Exchange"]);
    assert!(Linear::load("linear.toml", &oscillator().text()).unwrap().continuous().is_some());
}
