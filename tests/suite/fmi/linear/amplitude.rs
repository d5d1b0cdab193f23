//! Does the small unit of a mechanism know how nonlinear its motion is?

use super::{OMEGA, begun, matrix, oscillator, outputs};
use crate::support::allocations;
use ancf14::fmi::instance::Instance;
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::Causality;
use ancf14::fmi::{Model, Value};
use ancf14::linear::{Amplitude, File, Unit};
use ancf14::model::reduced::{Method, Reduced, Size};
use ancf14::model::simulation::Simulation;
use ancf14::packed::Packed;
use ancf14_pack::small::{Reduction, Small};
use ancf14_testing::curves::load;
use std::f64::consts::TAU;

/// Value reference of the share: behind an input and three outputs.
const SHARE: u32 = 4;
/// Linear, even and odd parts of the oscillator's positions and of its rates.
const LINEAR: [f64; 2] = [1.0, OMEGA];
const EVEN: [f64; 2] = [0.0, 0.4];
const ODD: [f64; 2] = [0.9, 0.0];

/// The oscillator with the amplitude `|x + i v/ω|`.
fn nonlinear() -> File {
    let amplitude = Amplitude {
        real: matrix(&[[1.0, 0.0]]),
        imaginary: matrix(&[[0.0, 1.0 / OMEGA]]),
        linear: matrix(&[LINEAR]),
        even: matrix(&[EVEN]),
        odd: matrix(&[ODD]),
    };
    File { amplitude: Some(amplitude), ..oscillator() }
}

fn share([x, v]: [f64; 2]) -> f64 {
    let size = x.hypot(v / OMEGA);
    let parts = (0..2).map(|kind| (LINEAR[kind] * size, EVEN[kind] * size.powi(2) + ODD[kind] * size.powi(3)));
    parts.map(|(linear, rest)| rest / (linear + rest)).fold(0.0, f64::max)
}

fn exchange(standard: Standard) -> Instance<Packed> {
    let unit = Unit::load("linear.toml", &nonlinear().text()).unwrap();
    let unit = Instance::for_model_exchange(standard, Packed::Linear(Box::new(unit)), false);
    let mut unit = unit.unwrap();
    unit.enter_initialization_mode_for(None, 0.0, None).unwrap();
    unit.exit_initialization_mode().unwrap();
    unit.enter_continuous_time_mode().unwrap();
    unit
}

fn warnings(instance: &mut Instance<Packed>) -> usize {
    instance.take_entries().iter().filter(|own| own.message.contains("not small any more")).count()
}

#[test]
fn the_share_is_an_output() {
    let file = nonlinear();
    assert_eq!(File::read("linear.toml", &file.text()).unwrap().amplitude, file.amplitude);
    let unit = Unit::load("linear.toml", &file.text()).unwrap();
    let own = &unit.variables()[SHARE as usize];
    assert_eq!((own.name.as_str(), own.causality, own.start), ("amplitude_error", Causality::Output, Value::Real(0.0)));
    assert_eq!((own.found_from.as_deref(), &own.follows_from[..]), (Some(&[5, 6][..]), &[5, 6][..]));
    for standard in [Standard::Fmi2, Standard::Fmi3] {
        let mut instance = exchange(standard);
        for state in [[0.0; 2], [0.03, 0.0], [0.02, -0.3], [0.5, 2.0]] {
            instance.set_continuous_states(&state).unwrap();
            let [found] = outputs::<1>(&mut instance, SHARE);
            assert!((found - share(state)).abs() < 1e-15, "{found} {}", share(state));
            let mut slopes = [f64::NAN; 2];
            for (known, slope) in [5, 6].iter().zip(&mut slopes) {
                instance.directional_derivative(&[SHARE], &[*known], &[1.0], std::slice::from_mut(slope)).unwrap();
            }
            let moved = |place: usize, by: f64| {
                let mut moved = state;
                moved[place] += by;
                share(moved)
            };
            for (place, slope) in slopes.iter().enumerate() {
                let exact = (moved(place, 1e-6) - moved(place, -1e-6)) / 2e-6;
                assert!((slope - exact).abs() < 1e-8, "{slope} {exact}");
            }
        }
    }
}

/// The share in co-simulation is that of the end of the step, its derivatives too, and no memory is asked for.
#[test]
fn steps_end_with_the_share() {
    let mut instance = begun(nonlinear());
    instance.set_real(&[0], &[super::U0 + 20.0]).unwrap();
    let mut shares = Vec::new();
    for number in 0..3 {
        let step = if number == 1 { 0.1 } else { 1e-5 };
        instance.do_step(instance.time(), step).unwrap();
        shares.push(outputs::<1>(&mut instance, SHARE)[0]);
        let [x, v] = outputs::<2>(&mut instance, 5);
        assert!((shares[number] - share([x, v])).abs() < 1e-15, "{shares:?}");
        let mut rate = [f64::NAN];
        instance.get_real_output_derivatives(&[SHARE], &[1], &mut rate).unwrap();
        let mut rates = [f64::NAN; 2];
        instance.get_real(&[7, 8], &mut rates).unwrap();
        let at = |by: f64| share([x + by * rates[0], v + by * rates[1]]);
        let exact = (at(1e-7) - at(-1e-7)) / 2e-7;
        assert!((rate[0] - exact).abs() < 1e-6 * (1.0 + exact.abs()), "{rate:?} {exact}");
    }
    // The input during the last step, 1e-5 s, moves the rate.
    let mut change = [f64::NAN];
    instance.directional_derivative(&[SHARE], &[0], &[1.0], &mut change).unwrap();
    let [x, v] = outputs::<2>(&mut instance, 5);
    let exact = (share([x, v + 1e-5]) - share([x, v - 1e-5])) / 2.0;
    assert!((change[0] - exact).abs() < 1e-3 * exact.abs(), "{change:?} {exact}");

    let time = instance.time();
    let asked = allocations::count(|| {
        for number in 0..100 {
            instance.do_step(time + f64::from(number) * 1e-5, 1e-5).unwrap();
        }
    });
    assert_eq!(asked, 0);
}

#[test]
fn a_warning_appears_once() {
    let mut instance = begun(nonlinear());
    instance.do_step(0.0, 0.1).unwrap();
    assert_eq!(warnings(&mut instance), 0);
    for _ in 0..2 {
        instance.set_real(&[0], &[super::U0 + 20.0]).unwrap();
        let mut seen = 0;
        for number in 1..6 {
            instance.do_step(instance.time(), 0.1).unwrap();
            seen += warnings(&mut instance);
            assert_eq!(seen, usize::from(number >= 1), "{}", outputs::<1>(&mut instance, SHARE)[0]);
        }
        instance.reset().unwrap();
        instance.setup_experiment(None, 0.0, None).unwrap();
        instance.enter_initialization_mode().unwrap();
        instance.exit_initialization_mode().unwrap();
        assert_eq!(warnings(&mut instance), 0);
    }
    for standard in [Standard::Fmi2, Standard::Fmi3] {
        let mut instance = exchange(standard);
        for (state, expected) in [(0.01, 0), (0.2, 1), (0.3, 0), (0.0, 0), (0.3, 0)] {
            instance.set_continuous_states(&[state, 0.0]).unwrap();
            outputs::<1>(&mut instance, SHARE);
            assert_eq!(warnings(&mut instance), expected, "{standard:?} {state}");
        }
    }
}

/// Numbers too large for their third power are no error, and damaged parts of the file are.
#[test]
fn odd_files_and_amplitudes() {
    let mut instance = exchange(Standard::Fmi2);
    instance.set_continuous_states(&[1e160, 0.0]).unwrap();
    assert_eq!(outputs::<1>(&mut instance, SHARE), [1.0]);
    let text = nonlinear().text();
    for (from, to, key) in [
        ("motions_odd = [", "motions_odds = [", "`motions_odd` is missing"),
        ("motions_real = [", "motions_reals = [", "`motions_real` is missing"),
        ("motions_real = [\n  [1.0, 0.0],\n]", "motions_real = []", "`motions_real` has 0 rows"),
        ("motions_linear = [", "motions_linear = [[],", "`motions_linear` has 0 numbers"),
        ("motions_imaginary = [", "motions_imaginary = [[0.0, 0.0],", "`motions_imaginary` is not"),
    ] {
        assert!(text.contains(from), "{from}");
        let failure = Unit::load("linear.toml", &text.replace(from, to)).unwrap_err();
        assert!(failure.message.contains(key), "{to}: {}", failure.message);
    }
}

/// A reduced system whose motions are measured.
fn reduced(model: &Simulation, inputs: &[&str], outputs: &[&str], size: Size) -> Reduced {
    let [inputs, outputs] =
        [inputs, outputs].map(|names| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
    let whole = model.linearize(Some(&inputs), Some(&outputs)).unwrap_or_else(|failure| panic!("{}", failure.message));
    let found = whole.reduce(model, size, Method::Balanced);
    let mut found = found.unwrap_or_else(|failure| panic!("{}", failure.message));
    let measured = found.linear.measure_amplitude(&whole, model);
    assert_eq!(measured.is_ok(), found.linear.amplitude.is_some());
    found
}

fn small(model: &Simulation, inputs: &[&str], outputs: &[&str], size: Size) -> Small {
    let Reduced { linear, poles, whole, kept, bound, error } = reduced(model, inputs, outputs, size);
    Small::new(model, &linear, &poles, Some(Reduction { whole, kept, bound, error })).unwrap()
}

/// The linear, even and odd parts of all motions of a mechanism with a force.
fn parts(text: &str) -> Vec<[f64; 3]> {
    let found = reduced(&load(text, &[]), &["push.force[3]"], &["tip.position"], Size::Order(6));
    let motions = found.linear.amplitude.expect("numbers").motions;
    motions
        .iter()
        .flat_map(|own| (0..own.linear.len()).map(|kind| [own.linear[kind], own.even[kind], own.odd[kind]]))
        .collect()
}

/// All parts are those expected, up to a share of them.
fn check_parts(found: &[[f64; 3]], expected: &[[f64; 3]], share: f64) {
    println!("{found:?}\n{expected:?}");
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        assert!((found - expected).abs() <= share * expected.abs(), "{found:e} {expected:e}");
    }
}

/// A run of the mechanism and of its small unit: the input of the mechanism, the one of the unit, and the outputs,
/// which have one unit.
struct Pair<'a> {
    small: &'a Small,
    text: &'a str,
    host: &'a str,
    /// Length of the run and of a step, s.
    times: [f64; 2],
}

impl Pair<'_> {
    /// The largest error of the outputs over the largest motion, the largest estimate, and that motion, where
    /// `signal` is the change of both inputs by time.
    fn shares(&self, signal: impl Fn(f64) -> [f64; 2]) -> [f64; 3] {
        let mut linear = begun(File::read("linear.toml", &self.small.text).unwrap());
        let full = Simulation::load("model.toml", self.text, &[]).unwrap();
        let names: Vec<String> = full.variables().iter().map(|own| own.name.clone()).collect();
        let reference = |name: &str| names.iter().position(|own| own == name).unwrap() as u32;
        let variables = self.small.unit.variables();
        let last = variables.iter().position(|own| own.name == "amplitude_error").unwrap();
        let tips: Vec<u32> = variables[1..last].iter().map(|own| reference(&own.name)).collect();
        let own_tips: Vec<u32> = (1..=last as u32).collect();
        let mut full = Instance::new(Packed::Mechanism(Box::new(full)), false);
        full.setup_experiment(None, 0.0, None).unwrap();
        full.enter_initialization_mode().unwrap();
        full.exit_initialization_mode().unwrap();
        let (mut begin, mut now, mut own) = (vec![0.0; last - 1], vec![0.0; last - 1], vec![0.0; last]);
        full.get_real(&tips, &mut begin).unwrap();
        let size = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        let (mut error, mut motion, mut estimate) = (0.0_f64, 0.0_f64, 0.0_f64);
        let [stop, step] = self.times;
        for number in 0..(stop / step).round() as usize {
            let time = number as f64 * step;
            let (from, to) = (signal(time), signal(time + step));
            for (unit, place, part) in [(&mut full, reference(self.host), 0), (&mut linear, 0, 1)] {
                unit.set_real(&[place], &[from[part]]).unwrap();
                unit.set_real_input_derivatives(&[place], &[1], &[(to[part] - from[part]) / step]).unwrap();
                unit.do_step(time, step).unwrap();
            }
            full.get_real(&tips, &mut now).unwrap();
            linear.get_real(&own_tips, &mut own).unwrap();
            error = error.max(size(&now, &own[..last - 1]));
            motion = motion.max(size(&now, &begin));
            estimate = estimate.max(own[last - 1]);
        }
        [error / motion, estimate, motion]
    }

    /// The estimates of motions of these sizes are within a factor 3 of the truth.
    fn check(&self, name: &str, sizes: &[f64], signal: impl Fn(f64) -> [f64; 2]) {
        for size in sizes {
            let [share, estimate, motion] = self.shares(|time| signal(time).map(|own| own * size));
            let ratio = share / estimate;
            println!("{name} {size}: moves {motion:.2e}, true {share:.2e}, estimated {estimate:.2e}, ratio {ratio:.2}");
            assert!((2e-3..0.12).contains(&share), "{name} {size}: {share:e}");
            assert!((1.0 / 3.0..3.0).contains(&ratio), "{name} {size}: {share:e} {estimate:e}");
        }
    }
}

const STEEL: &str = r#"format = 1
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3, mass_damping = 0.5 }
section.rod = { shape = "rectangle", width = 0.02, height = 0.01 }
"#;

const ARM: &str = r#"model = { name = "Arm", gravity = [0, 0, 0] }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 8 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.push = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["position", "velocity"] }
simulation = { initial = "equilibrium", stop = 0.5, step = 5e-4, output_step = 1e-3 }
"#;

/// A beam between two clamps: it is stretched.
const STRIP: &str = r#"model = { name = "Strip", gravity = [0, 0, 0] }
beam.strip = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 8 }
joint.start = { type = "weld", a = "ground", b = "strip.start" }
joint.end = { type = "weld", a = "ground", b = "strip.end" }
load.push = { at = "strip@0.5", force = [0, 0, 0], input = true }
output.middle = { at = "strip@0.5", quantities = ["position"] }
simulation = { initial = "equilibrium", stop = 0.5, step = 5e-4, output_step = 1e-3 }
"#;

const PENDULUM: &str = r#"model = { name = "Pendulum", gravity = [0, 0, -9.81] }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [0, 0, -1], elements = 4, y_axis = [0, 1, 0] }
joint.root = { type = "revolute", a = "ground", b = "arm.start", axis = [0, 1, 0], damping = 0.05 }
load.push = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["position"] }
simulation = { initial = "equilibrium", stop = 0.5, step = 5e-3, output_step = 1e-2 }
"#;

/// An arm on a motor: its turn is a state with a pole at 0.
const TURNED: &str = r#"model = { name = "Turned arm", gravity = [0, 0, 0] }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
joint.motor = { type = "revolute", a = "ground", b = "arm.start", axis = [0, 1, 0] }
drive.turn = { joint = "motor", coordinate = "angle", value = 0, input = "value" }
output.tip = { at = "arm.end", quantities = ["position"] }
simulation = { initial = "equilibrium", stop = 1, step = 1e-3 }
"#;

/// The force begins and ends smoothly, below the first vibration and near it.
fn pulse(omega: f64) -> impl Fn(f64) -> [f64; 2] {
    move |time| [(1.0 - (omega * time).cos()) / 2.0; 2]
}

#[test]
fn estimates_of_forced_motions_are_near_the_truth() {
    let text = format!("{STEEL}{ARM}");
    let model = load(&text, &[]);
    for (outputs, sizes) in
        [(&["tip.position[3]"][..], &[40.0, 120.0, 240.0]), (&["tip.position"], &[3.0, 12.0, 120.0])]
    {
        let small = &small(&model, &["push.force[3]"], outputs, Size::Order(8));
        let pair = Pair { small, text: &text, host: "push.force[3]", times: [0.25, 1e-3] };
        pair.check(&format!("arm, {outputs:?}"), sizes, pulse(30.0));
    }
    let text = format!("{STEEL}{STRIP}");
    let small_strip = &small(&load(&text, &[]), &["push.force[3]"], &["middle.position[3]"], Size::Order(8));
    let pair = Pair { small: small_strip, text: &text, host: "push.force[3]", times: [0.1, 1e-3] };
    pair.check("strip", &[40.0, 120.0, 220.0], pulse(60.0));
    let text = format!("{STEEL}{PENDULUM}");
    let model = load(&text, &[]);
    for (outputs, sizes) in [(&["tip.position[1]"][..], &[0.4, 0.8, 1.5]), (&["tip.position"], &[0.02, 0.1, 0.5])] {
        let small = &small(&model, &["push.force[1]"], outputs, Size::Order(4));
        let pair = Pair { small, text: &text, host: "push.force[1]", times: [3.0, 1e-2] };
        pair.check(&format!("pendulum, {outputs:?}"), sizes, pulse(4.0));
    }
}

/// A motor that turns, and a crane whose foot moves: the foot alone is linear, the load that swings is not.
#[test]
fn estimates_of_prescribed_motions_are_near_the_truth() {
    // A way that goes smoothly from 0 to 1, with its acceleration.
    let way = |omega: f64| {
        move |time: f64| match omega * time {
            phase if phase < TAU => [(phase - phase.sin()) / TAU, omega * omega * phase.sin() / TAU],
            _ => [1.0, 0.0],
        }
    };
    let text = format!("{STEEL}{TURNED}");
    let model = load(&text, &[]);
    for (outputs, sizes) in [(&["tip.position[3]"][..], &[0.12, 0.4, 0.6]), (&["tip.position"], &[0.01, 0.1, 0.2])] {
        let small = &small(&model, &["turn.acceleration"], outputs, Size::Order(8));
        let pair = Pair { small, text: &text, host: "turn.value", times: [0.6, 1e-3] };
        pair.check(&format!("turned arm, {outputs:?}"), sizes, way(15.0));
    }
    let text = include_str!("../../../../models/crane.toml");
    let small = &small(&load(text, &[]), &["foot.acceleration[1]"], &["load_motion.position"], Size::Order(12));
    let pair = Pair { small, text, host: "foot.position[1]", times: [6.0, 2e-2] };
    pair.check("crane", &[0.1, 1.0, 3.0], way(2.0));
}

/// A load that changes by time is no part of the motion that is measured.
#[test]
fn functions_of_time_have_no_share() {
    let text = format!("{STEEL}{ARM}");
    let shaken = format!("{text}load.shake = {{ at = \"arm.end\", force = [0, 0, \"10*sin(20*t)\"] }}\n");
    check_parts(&parts(&shaken), &parts(&text), 0.03);
}

/// Steps that the solver chooses give the same numbers as given ones.
#[test]
fn an_accuracy_gives_the_same_parts() {
    let text = format!("{STEEL}{ARM}");
    let paced = text.replace("step = 5e-4,", "accuracy = 1e-4,");
    assert_ne!(paced, text);
    check_parts(&parts(&paced), &parts(&text), 1e-3);
}

/// A file has room for 16 units of outputs: the ones with the largest nonlinear parts stay.
#[test]
fn the_most_nonlinear_units_stay() {
    let model = load(&format!("{STEEL}{ARM}"), &[]);
    let mut linear = reduced(&model, &["push.force[3]"], &["tip.position[3]"], Size::Order(6)).linear;
    let mut amplitude = linear.amplitude.take().unwrap();
    for own in &mut amplitude.motions {
        let odd = |kind: u32| if [3, 5].contains(&kind) { 0.0 } else { 1.0 };
        own.odd = (0..18).map(odd).collect();
        own.even = vec![0.0; 18];
        own.linear = (0..18).map(f64::from).map(|kind| 2.0 + kind).collect();
    }
    linear.amplitude = Some(amplitude);
    let text = Small::new(&model, &linear, &[], None).unwrap().text;
    let amplitude = File::read("linear.toml", &text).unwrap().amplitude.unwrap();
    let row: Vec<f64> = (0..amplitude.linear.columns).map(|column| amplitude.linear.at(0, column)).collect();
    assert_eq!(row, [2, 3, 4, 6, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19].map(f64::from));
}

/// A drive whose rate a host gives has a position that no equilibrium tells of: it counts as linear.
#[test]
fn a_drive_with_a_rate_is_linear() {
    let text = format!("{STEEL}{}", TURNED.replace("value = 0, input = \"value\"", "rate = 0, input = \"rate\""));
    let linear = reduced(&load(&text, &[]), &["turn.acceleration"], &["tip.position"], Size::Order(8)).linear;
    let value = linear.states.iter().position(|own| own.name == "turn.value").unwrap();
    let motions = linear.amplitude.unwrap().motions;
    let motion = motions.iter().find(|own| own.weights[0][value] == 1.0 && own.weights[0].iter().sum::<f64>() == 1.0);
    let motion = motion.unwrap();
    assert!((motion.linear[0] - 1.0).abs() < 1e-6, "{motion:?}");
    assert!(motion.even[0] == 0.0 && motion.odd[0] == 0.0, "{motion:?}");
}

/// Nothing is measured about a state that moves on.
#[test]
fn motions_have_no_share() {
    let text = format!(
        "{STEEL}{}",
        PENDULUM.replace("equilibrium", "as_drawn").replace("to = [0, 0, -1]", "to = [0.6, 0, -0.8]")
    );
    let unit = small(&load(&text, &[]), &["push.force[1]"], &["tip.position[1]"], Size::Order(8)).unit;
    assert!(unit.variables().iter().all(|own| own.name != "amplitude_error"));
}
