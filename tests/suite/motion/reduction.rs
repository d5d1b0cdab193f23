//! Linear systems with fewer states: the error of balanced truncation is below its bound at every order, modes with
//! static correction meet the static response, and poles at 0 stay at 0. Responses are those of the matrices, by a
//! solution at each frequency, not those that the reduction itself looks at.

use ancf14::model::linear::{Linear, PoleKind};
use ancf14::model::reduced::{Method, Reduced, Size};
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::load;
use nalgebra::{Complex, DMatrix};

pub const CANTILEVER: &str = r#"format = 1
model = { name = "Cantilever", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3, mass_damping = 0.5 }
section.rod = { shape = "rectangle", width = 0.02, height = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 16, rotary_inertia = false }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.push = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["displacement", "rotation"] }
simulation = { stop = 1, step = 1e-3, output_step = 1e-2 }
"#;

/// A beam on a cart that nothing holds, and on a drive.
pub const CART: &str = r#"format = 1
model = { name = "Cart", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3 }
section.rod = { shape = "rectangle", width = 0.02, height = 0.01 }
body.cart = { mass = 2, position = [0, 0, 0], inertia = [0.1, 0.1, 0.1] }
beam.mast = { material = "steel", section = "rod", from = [0, 0, 0], to = [0, 0, 1], elements = 4 }
joint.rail = { type = "prismatic", a = "ground", b = "cart", axis = [1, 0, 0] }
joint.motor = { type = "revolute", a = "cart", b = "mast.start", axis = [0, 1, 0] }
drive.turn = { joint = "motor", coordinate = "angle", value = 0 }
load.push = { at = "cart", force = [0, 0, 0], input = true }
output.x = { at = "rail", quantities = ["distance"] }
output.tip = { at = "mast.end", quantities = ["position", "acceleration"] }
simulation = { stop = 1, step = 1e-3 }
"#;

pub fn linear(model: &Simulation, inputs: &[&str], outputs: &[&str]) -> Linear {
    let [inputs, outputs] =
        [inputs, outputs].map(|names| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
    model.linearize(Some(&inputs), Some(&outputs)).unwrap_or_else(|failure| panic!("{}", failure.message))
}

pub fn reduced(found: &Linear, model: &Simulation, size: Size, method: Method) -> Reduced {
    found.reduce(model, size, method).unwrap_or_else(|failure| panic!("{}", failure.message))
}

/// `C (s − A)⁻¹ B + D`.
pub fn response(linear: &Linear, s: Complex<f64>) -> DMatrix<Complex<f64>> {
    let count = linear.states.len();
    let of = |own: &ancf14::model::linear::Matrix| {
        DMatrix::from_fn(own.rows, own.columns, |row, column| Complex::from(own.at(row, column)))
    };
    let shifted = DMatrix::from_diagonal_element(count, count, s) - of(&linear.a);
    of(&linear.c) * shifted.lu().solve(&of(&linear.b)).unwrap() + of(&linear.d)
}

/// Frequencies from 1 to 2000 rad/s, and around the first resonance.
fn frequencies() -> impl Iterator<Item = f64> {
    let wide = (0..60).map(|number| 10.0_f64.powf(3.3 * f64::from(number) / 59.0));
    wide.chain((0..40).map(|number| 50.0 + 0.1 * f64::from(number)))
}

/// 226 states, of which eight leave 8.8e-7 of the peak, 16 times the response to a sudden change, which is the static
/// one. Static values and the first resonance are where the errors are.
#[test]
fn errors_of_balanced_truncation_are_below_their_bounds() {
    let model = load(CANTILEVER, &[]);
    let whole = linear(&model, &["push.force[3]"], &["tip.displacement[3]"]);
    let full: Vec<_> = frequencies().map(|omega| response(&whole, Complex::new(0.0, omega))[(0, 0)]).collect();
    let peak = full.iter().map(|own| own.norm()).fold(0.0, f64::max);
    let rest = response(&whole, Complex::from(0.0))[(0, 0)].norm();
    for (order, known) in [(2, 1.5e-2), (4, 6.0e-4), (6, 1.9e-5), (8, 8.8e-7)] {
        let small = reduced(&whole, &model, Size::Order(order), Method::Balanced);
        let errors = frequencies().zip(&full);
        let errors =
            errors.map(|(omega, own)| (response(&small.linear, Complex::new(0.0, omega))[(0, 0)] - own).norm());
        let error = errors.fold(0.0, f64::max) / rest;
        let bound = small.bound.unwrap();
        println!("{order} states: error {error:.2e}, looked at {:.2e}, bound {bound:.2e}", small.error);
        assert_eq!((small.linear.states.len(), small.whole, small.kept), (order, 226, 0));
        // Modes that hardly fade have the sum of their static responses within 1 %.
        assert!(error <= 1.01 * bound && small.error <= bound && error > 0.01 * bound, "{error:.2e} {bound:.2e}");
        assert!(bound * rest / peak < known, "{order}: {bound:.3e}, {known:.1e}");
    }
    let small = reduced(&whole, &model, Size::Error(1e-3), Method::Balanced);
    assert_eq!(small.linear.states.len(), 6, "of 4 states the bound is 0.7 %");
}

/// Outputs of different units and two inputs: every output is accurate as a share of its own static response.
#[test]
fn every_output_is_measured_by_its_own_response() {
    let model = load(CANTILEVER, &[]);
    let whole = linear(&model, &["push.force[3]", "push.force[2]"], &["tip.displacement", "tip.rotation[2]"]);
    let small = reduced(&whole, &model, Size::Error(1e-3), Method::Balanced);
    assert!(small.linear.states.len() <= 16 && small.bound.unwrap() <= 1e-3, "{}", small.linear.states.len());
    let pairs: Vec<_> =
        frequencies().map(|omega| [&whole, &small.linear].map(|own| response(own, Complex::new(0.0, omega)))).collect();
    for (output, name) in whole.outputs.iter().enumerate() {
        let size = |own: &DMatrix<Complex<f64>>| own.row(output).iter().map(|own| own.norm()).fold(0.0, f64::max);
        let rest = size(&response(&whole, Complex::from(0.0)));
        let error = pairs.iter().map(|[full, small]| size(&(full - small))).fold(0.0, f64::max);
        // Three responses of size 1 together are less than 2; along the beam nothing moves, and only round-off is left.
        let least = if name.name == "tip.displacement[1]" { 1e-9 } else { 0.0 };
        assert!(error <= 2e-3 * rest.max(least), "{}: {error:.1e} of {rest:.1e}", name.name);
    }
}

/// Modes keep their poles, and the static response is exact up to the round-off of stiff modes, 1e-8.
#[test]
fn modes_have_a_static_correction() {
    let model = load(CANTILEVER, &[]);
    let whole = linear(&model, &["push.force[3]"], &["tip.displacement[3]"]);
    let small = reduced(&whole, &model, Size::Order(4), Method::Modal);
    assert_eq!((small.linear.states.len(), small.bound), (4, None));
    let [full, own] = [&whole, &small.linear].map(|own| response(own, Complex::from(0.0))[(0, 0)]);
    assert!((full - own).norm() < 1e-7 * full.norm(), "{full} {own}");
    let [full, own] = [&whole, &small.linear].map(|own| response(own, Complex::new(0.0, 50.0))[(0, 0)]);
    let error = (full - own).norm() / full.norm();
    println!("at 50 rad/s: {error:.1e}, of the static response {:.1e}", small.error);
    assert!(error < 9.2e-4 && small.error < 1e-2, "{error:.1e} {:.1e}", small.error);
    let poles = whole.poles(&model).unwrap();
    for pole in &small.poles {
        let near = |own: &ancf14::model::linear::Pole| {
            f64::hypot(own.value[0] - pole.value[0], own.value[1] - pole.value[1]) < 1e-8 * pole.natural_frequency()
        };
        assert!(poles.iter().any(near), "{:?}", pole.value);
    }
}

/// A free cart and a drive: four poles at 0 stay exactly there, with their states' names, and the motion that they
/// make has the masses of the whole mechanism.
#[test]
fn poles_at_zero_are_kept() {
    let model = load(CART, &[]);
    let whole = linear(&model, &["push.force[1]", "turn.acceleration"], &["x.distance", "tip.position[1]"]);
    let small = reduced(&whole, &model, Size::Error(1e-3), Method::Balanced);
    let names: Vec<_> = small.linear.states.iter().map(|state| state.name.as_str()).collect();
    println!("{} states to {names:?}, bound {:?}", small.whole, small.bound);
    assert_eq!(small.kept, 4, "{names:?}");
    assert!(names.contains(&"turn.value") && names.contains(&"turn.rate"), "{names:?}");
    let zeros = small.poles.iter().filter(|pole| pole.value == [0.0, 0.0]).count();
    assert!(zeros == 4 && small.poles.iter().all(|pole| pole.kind != PoleKind::Unstable), "{:?}", small.poles);
    // The response of a free mass, far below all vibrations, and near the first one.
    let mass = 2.0 + 7850.0 * 0.02 * 0.01;
    for omega in [0.01, 1.0, 30.0] {
        let [full, own] = [&whole, &small.linear].map(|own| response(own, Complex::new(0.0, omega)));
        let error = (&full - &own).norm() / full.norm();
        println!("{omega} rad/s: {error:.1e}");
        assert!(error < 1e-3, "{omega}: {full} {own}");
    }
    let slow = response(&small.linear, Complex::new(0.0, 0.01))[(0, 0)];
    assert!((slow * Complex::from(-1e-4 * mass) - 1.0).norm() < 1e-5, "{slow}");
}

/// Without damping nothing can be left out: the message says how many states are kept, and what helps.
#[test]
fn systems_without_damping_are_refused() {
    let model = load(&CANTILEVER.replace(", damping = 1e-3, mass_damping = 0.5", ""), &[]);
    let whole = linear(&model, &["push.force[3]"], &["tip.displacement[3]"]);
    let message = whole.reduce(&model, Size::Order(8), Method::Balanced).unwrap_err().message;
    assert!(message.contains("do not fade") && message.contains("damping"), "{message}");
}

/// The responses that diagrams show are those of the matrices, by a solution at each frequency: of a cantilever, and of
/// a cart with poles at 0, through all resonances. The tolerance is the round-off of that solution: 1e-16 of the
/// largest entry of `A`, 1e13, against the softest stiffness.
#[test]
fn responses_are_those_of_the_matrices() {
    for (text, inputs, outputs) in [
        (CANTILEVER, &["push.force[3]"][..], &["tip.displacement[3]", "tip.rotation[2]"][..]),
        (CART, &["push.force[1]", "turn.acceleration"], &["x.distance", "tip.acceleration[1]"]),
    ] {
        let model = load(text, &[]);
        let found = linear(&model, inputs, outputs);
        let range = [10.0, 3000.0];
        let seen = found.responses(&model, Some(range)).unwrap();
        assert!(seen.frequencies.len() > 300 && seen.frequencies.is_sorted());
        assert!(seen.frequencies[0] >= range[0] * (1.0 - 1e-12) && *seen.frequencies.last().unwrap() <= range[1]);
        let mut largest = 0.0_f64;
        for (omega, values) in seen.frequencies.iter().zip(&seen.values) {
            let exact = response(&found, Complex::new(0.0, *omega));
            for (value, exact) in values.iter().zip(exact.iter()) {
                let apart = (Complex::new(value[0], value[1]) - exact).norm();
                largest = largest.max(apart / exact.norm());
            }
        }
        println!("{largest:.1e}");
        assert!(largest < 1e-5, "{largest:e}");
    }
}

/// A crane whose foot is moved along three axes: a motion along one axis swings a load of 1e-6 damping, and those along
/// the others leave it alone. Round-off of the poles at 0 moved it by 1e8 times its response. Outputs are measured by
/// their largest response to any input. At the peaks of the load, round-off of the stiffness moves the poles of the
/// solution at a frequency by some 1e-5 of their damping; half of the states leave no more than that.
#[test]
fn prescribed_motions_move_what_they_move() {
    let model = load(include_str!("../../../models/crane.toml"), &[]);
    let found = model.linearize(None, None).unwrap();
    assert_eq!((found.inputs.len(), found.outputs.len()), (3, 28));
    let seen = found.responses(&model, Some([0.5, 300.0])).unwrap();
    let small = reduced(&found, &model, Size::Order(90), Method::Balanced);
    let sizes = |own: &DMatrix<Complex<f64>>| own.row_iter().map(|row| row.camax()).collect::<Vec<_>>();
    // The largest sizes at all frequencies: of the responses, and of both differences.
    let mut largest = [[0.0_f64; 28]; 3];
    for (omega, values) in seen.frequencies.iter().zip(&seen.values).step_by(8) {
        let at = Complex::new(0.0, *omega);
        let exact = response(&found, at);
        let told = DMatrix::from_iterator(28, 3, values.iter().map(|own| Complex::new(own[0], own[1])));
        let all = [exact.clone(), told - &exact, response(&small.linear, at) - &exact];
        for (largest, own) in largest.iter_mut().zip(&all) {
            largest.iter_mut().zip(sizes(own)).for_each(|(largest, own)| *largest = largest.max(own));
        }
    }
    let share = |own: &[f64; 28]| own.iter().zip(&largest[0]).map(|(own, whole)| own / whole).fold(0.0, f64::max);
    let [told, reduced] = [share(&largest[1]), share(&largest[2])];
    println!("responses {told:.1e}, with {} of {} states {reduced:.1e}", small.linear.states.len(), small.whole);
    assert!(told < 1e-4 && reduced < 1e-4, "{told:.1e} {reduced:.1e}");
}
