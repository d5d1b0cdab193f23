//! Does the small unit of a mechanism move as the mechanism does, where motions are small?

use super::begun;
use ancf14::fmi::instance::Instance;
use ancf14::fmi::variable::Causality;
use ancf14::fmi::{About, Model};
use ancf14::linear::File;
use ancf14::model::reduced::{Method, Reduced, Size};
use ancf14::model::simulation::Simulation;
use ancf14::packed::Packed;
use ancf14_pack::small::{Reduction, Small};
use ancf14_testing::curves::load;

const ARM: &str = r#"format = 1
model = { name = "Arm", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3, mass_damping = 0.5 }
section.rod = { shape = "rectangle", width = 0.02, height = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 8, rotary_inertia = false }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.push = { at = "arm.end", force = [0, 0, 5], input = true }
output.tip = { at = "arm.end", quantities = ["position", "velocity"] }
simulation = { initial = "equilibrium", stop = 0.5, step = 2.5e-4, output_step = 1e-3 }
"#;

const TURNED: &str = r#"format = 1
model = { name = "Turned arm", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3 }
section.rod = { shape = "rectangle", width = 0.02, height = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
joint.motor = { type = "revolute", a = "ground", b = "arm.start", axis = [0, 1, 0] }
drive.turn = { joint = "motor", coordinate = "angle", value = 0.25 }
output.motor = { at = "motor", quantities = ["angle", "angle_rate"] }
simulation = { initial = "equilibrium", stop = 1, step = 1e-3 }
"#;

fn small(model: &Simulation, inputs: &[&str], outputs: &[&str], size: Size) -> Small {
    let [inputs, outputs] =
        [inputs, outputs].map(|names| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>());
    let whole = model.linearize(Some(&inputs), Some(&outputs)).unwrap_or_else(|failure| panic!("{}", failure.message));
    let found = whole.reduce(model, size, Method::Balanced).unwrap_or_else(|failure| panic!("{}", failure.message));
    let Reduced { linear, poles, whole, kept, bound, error } = found;
    Small::new(model, &linear, &poles, Some(Reduction { whole, kept, bound, error })).unwrap()
}

fn unit(small: &Small) -> Instance<Packed> {
    begun(File::read("linear.toml", &small.text).unwrap())
}

/// The arm is bent by its input, 5 N, and pushed by up to 12 N more: the tip moves by 1.6 % of the length, and both
/// units are given the same values and derivatives. The bar is 0.3 % of the largest motion, which is the square of the
/// slope.
#[test]
fn small_motions_are_those_of_the_mechanism() {
    let model = load(ARM, &[]);
    let small = small(&model, &["push.force[3]"], &["tip.position[3]", "tip.velocity[3]"], Size::Order(8));
    assert_eq!(small.origin.order, 8);
    let mut linear = unit(&small);
    let packed = Simulation::load("model.toml", ARM, &[]).unwrap();
    let names = packed.variables().iter().map(|variable| variable.name.clone()).collect::<Vec<_>>();
    let reference = |name: &str| names.iter().position(|own| own == name).unwrap() as u32;
    let [push, position] = [reference("push.force[3]"), reference("tip.position[3]")];
    let mut full = Instance::new(Packed::Mechanism(Box::new(packed)), false);
    full.setup_experiment(None, 0.0, None).unwrap();
    full.enter_initialization_mode().unwrap();
    full.exit_initialization_mode().unwrap();
    let force = |time: f64| 5.0 + 12.0 * (1.0 - (30.0 * time).cos()) / 2.0;
    let (mut start, mut largest, mut difference) = (None, 0.0_f64, 0.0_f64);
    for number in 0..500 {
        let time = f64::from(number) * 1e-3;
        let slope = (force(time + 1e-3) - force(time)) / 1e-3;
        let mut tips = [f64::NAN; 2];
        for (index, (unit, (push, tip))) in
            [(&mut full, (push, position)), (&mut linear, (0, 1))].into_iter().enumerate()
        {
            unit.get_real(&[tip], &mut tips[index..=index]).unwrap();
            unit.set_real(&[push], &[force(time)]).unwrap();
            unit.set_real_input_derivatives(&[push], &[1], &[slope]).unwrap();
            unit.do_step(time, 1e-3).unwrap();
        }
        let start = *start.get_or_insert(tips[0]);
        largest = largest.max((tips[0] - start).abs());
        difference = difference.max((tips[1] - tips[0]).abs());
    }
    println!("tip moves by {largest:.4} of the length, difference {:.2e} of that", difference / largest);
    assert!((0.015..0.02).contains(&largest), "{largest}");
    assert!(difference < 3e-3 * largest, "{difference:e} {largest}");
}

/// The start values of inputs are those of the state, descriptions and units those of the mechanism.
#[test]
fn signals_have_the_words_of_the_mechanism() {
    let model = load(ARM, &[]);
    let small = small(&model, &["push.force[3]"], &["tip.position[3]"], Size::Order(4));
    let variables = small.unit.variables();
    assert_eq!((variables[0].name.as_str(), variables[0].start.number()), ("push.force[3]", 5.0));
    let known = |name: &str| model.variables().iter().find(|variable| variable.name == name).unwrap();
    for variable in variables.iter().filter(|variable| variable.causality != Causality::Local) {
        let known = known(&variable.name);
        assert_eq!((&variable.description, &variable.quantity.unit), (&known.description, &known.quantity.unit));
        assert!(variable.description.len() > 10, "{}", variable.description);
    }
    let About { name, identifier, stop, output_step, .. } = small.unit.about();
    assert_eq!((name.as_str(), identifier.as_str()), ("Arm, linear", "Arm_linear"));
    assert_eq!((*stop, *output_step), (0.5, 1e-3));
}

/// A drive is given by its acceleration: the angle of its joint is its double integral, from its angle in the state.
#[test]
fn drives_are_given_by_their_acceleration() {
    let model = load(TURNED, &[]);
    let small = small(&model, &["turn.acceleration"], &["motor.angle", "motor.angle_rate"], Size::Error(1e-2));
    assert!(small.unit.variables()[0].description.starts_with("Acceleration of turn"));
    let mut instance = unit(&small);
    for (time, acceleration, ramp) in [(0.0, 0.5, 0.0), (0.25, 0.5, 3.0)] {
        instance.set_real(&[0], &[acceleration]).unwrap();
        instance.set_real_input_derivatives(&[0], &[1], &[ramp]).unwrap();
        instance.do_step(time, 0.25).unwrap();
    }
    let (h, a, s) = (0.25_f64, 0.5, 3.0);
    let (rate, angle) = (a * h, a * h * h / 2.0);
    let angle = angle + rate * h + a * h * h / 2.0 + s * h.powi(3) / 6.0;
    let rate = rate + a * h + s * h * h / 2.0;
    let found = super::outputs::<2>(&mut instance, 1);
    println!("{found:?}, {angle} {rate}");
    // Outputs are differences of fourth order with steps of 1e-4 of an element: 1e-11 of the motion.
    assert!((found[0] - 0.25 - angle).abs() < 1e-9 && (found[1] - rate).abs() < 1e-9, "{found:?} {angle} {rate}");
}

/// A whole system of many states is refused for an FMU, with the remedy.
#[test]
fn large_systems_are_refused() {
    let model = load(ARM, &[("arm.elements", "32")]);
    let inputs = [String::from("push.force[3]")];
    let whole = model.linearize(Some(&inputs), None).unwrap();
    let refused = Small::new(&model, &whole, &[], None).unwrap_err().to_string();
    assert!(refused.contains("an FMU can have at most 300") && refused.contains("ancf14 reduce"), "{refused}");
}
