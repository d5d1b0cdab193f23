//! Temperatures that change along a beam, and those that a host gives. What must hold: closed forms of free and held
//! beams, the order of the element, the account of energy, the results of a temperature that is a function of time.

use super::stress_as_drawn::{AREA, HELD, STATIC, at_end, strip};
use crate::running::{run, start, value, vector};
use ancf14::fmi::{Model, Value};
use ancf14::math::integral::integral;
use ancf14::model::simulation::Simulation;

const EXPANSION: f64 = 1.2e-5;

/// A bar that is warm along half of its length grows by `α T L/2`, and between walls it presses with half of the force
/// of one that is warm everywhere. Both are exact where the temperature jumps at a node: each element has its own side
/// of it.
#[test]
fn a_bar_heated_along_half_of_its_length() {
    let keys = "elements = 4\nstrain = \"small\"\ntemperature = \"if(s < 1, 100*t, 0)\"";
    let free = at_end(&strip(keys, STATIC));
    // To the tolerance of the equilibrium.
    let growth = vector(&free, "tip.displacement").x / (EXPANSION * 100.0 * 1.0) - 1.0;
    assert!(growth.abs() < 1e-8, "{growth:e}");
    let reaction = "[output.wall]\nat = \"right\"\nquantities = [\"reaction_force\"]\n";
    let held = at_end(&strip(keys, &format!("{HELD}{reaction}{STATIC}")));
    let force = vector(&held, "wall.reaction_force").x.abs() / (2.1e11 * AREA * EXPANSION * 50.0) - 1.0;
    // Stretch acts on the force in second order: by its own size.
    assert!(force.abs() < EXPANSION * 100.0, "{force:e}");
}

/// Errors over the numbers of elements, and the order that they fall with.
fn orders(elements: &[u32], error: impl Fn(u32) -> f64) -> Vec<f64> {
    let errors: Vec<f64> = elements.iter().map(|elements| error(*elements)).collect();
    println!("{errors:?}");
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

/// The length of a free bar under `T = 100 exp(s)` converges with order 4: the strains are taken by Simpson's rule.
#[test]
fn the_growth_of_a_bar_is_of_order_4() {
    let exact = EXPANSION * 100.0 * (2.0_f64.exp() - 1.0);
    let orders = orders(&[1, 2, 4], |elements| {
        let keys = format!("elements = {elements}\nstrain = \"small\"\ntemperature = \"100*exp(s)*t\"");
        (vector(&at_end(&strip(&keys, STATIC)), "tip.displacement").x / exact - 1.0).abs()
    });
    assert!(orders.iter().all(|order| *order > 3.85 && *order < 4.1), "{orders:?}");
}

/// The tip of a strip under a gradient that changes along it: against the curve with that curvature.
#[test]
fn the_bend_of_a_strip_is_of_order_4() {
    let curvature = |s: f64| EXPANSION * 4e4 * (1.5 * s).sin();
    let turn = |s: f64| EXPANSION * 4e4 * (1.0 - (1.5 * s).cos()) / 1.5;
    // A positive curvature bends down.
    let exact = [integral(&|s| turn(s).cos(), 0.0, 2.0) - 2.0, -integral(&|s| turn(s).sin(), 0.0, 2.0)];
    let orders = orders(&[4, 8, 16], |elements| {
        let keys = format!("elements = {elements}\ntemperature_gradient = [0, \"4e4*sin(1.5*s)*t\"]");
        let bent = at_end(&strip(&keys, STATIC));
        let tip = vector(&bent, "tip.displacement");
        if elements == 16 {
            // Strains that are results are those against the one without stress. The curvature of an element is nearly
            // linear along it, and that of the heat leaves a straight line by `l² κ''/12`: 1.5² l²/12 of it, 2.9e-3.
            let moment = vector(&bent, "middle.section_moment").norm();
            let rigidity = 2.1e11 * 0.02 * 0.01_f64.powi(3) / 12.0;
            println!("moment {:e} of that of the curvature", moment / (rigidity * curvature(1.0)));
            assert!(moment < 4e-3 * rigidity * curvature(1.0), "{moment}");
        }
        (tip.x - exact[0]).hypot(tip.z - exact[1])
    });
    assert!(orders.iter().all(|order| *order > 3.8), "{orders:?}");
}

/// A wave of heat along a strip that swings: the account of energy closes, with the work of heat among that of loads.
#[test]
fn heat_along_a_beam_is_in_the_account_of_energy() {
    let keys = "elements = 4\ntemperature = \"30*sin(9*t - 2*s)\"\ntemperature_gradient = [\"1e3*s*sin(7*t)\", \"2e3*sin(5*t)*cos(s)\"]";
    let simulation =
        "[simulation]\nstop = 1\nstep = 1e-3\nspectral_radius = 1\ntolerance = 1e-9\ntotals = [\"energy\", \"work\"]";
    let mut swinging = start(&strip(keys, simulation));
    let (mut drift, mut most, mut work) = (0.0_f64, 0.0_f64, 0.0_f64);
    run(&mut swinging, 0.01, 1.0, |simulation| {
        drift = drift.max(value(simulation, "work.drift").abs());
        most = most.max(value(simulation, "energy.total"));
        work = work.max(value(simulation, "work.loads").abs());
    });
    println!("drift {drift:e} J of {most} J, work {work} J");
    // The tolerance of Newton's iteration, of 1000 steps.
    assert!(most > 0.05 && work > 0.05 && drift < 1e-6 * most, "{drift} {most} {work}");
}

/// The mesh error of an equilibrium is found on a mesh of twice the elements, which has temperatures of its own: it is
/// told within a factor of 2.
#[test]
fn the_mesh_error_is_told_with_the_temperatures_of_the_finer_mesh() {
    let keys = |elements: u32| {
        format!("elements = {elements}\ntemperature_gradient = [0, \"4e4*sin(1.5*s)*t\"]\ntwist = \"quadratic\"")
    };
    let mut coarse = at_end(&strip(&keys(4), STATIC));
    coarse.conclude();
    let told = coarse.mesh_errors().iter().find(|own| own.name == "tip.displacement");
    let told = told.unwrap_or_else(|| panic!("no error of the tip")).error;
    let [own, fine] = [4, 16].map(|elements| vector(&at_end(&strip(&keys(elements), STATIC)), "tip.displacement"));
    let real = (own - fine).norm() / fine.norm();
    assert!(told > 0.5 * real && told < 2.0 * real, "{told:e} {real:e}");
}

const SWINGING: &str = "[simulation]\nstop = 0.5\nstep = 2e-3\noutput_step = 0.01\n";

/// All results of a run.
fn rows(simulation: &mut Simulation) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    run(simulation, 0.01, 0.5, |simulation| {
        let count = simulation.variables().len();
        rows.push(
            (0..count)
                .filter_map(|place| match simulation.value(place) {
                    Value::Real(value) => Some(value),
                    Value::Integer(_) => None,
                })
                .collect(),
        );
    });
    rows
}

/// A temperature that is the same along the beam has the same results whether or not its expression knows `s`.
#[test]
fn points_of_one_temperature_change_nothing() {
    let keys = |more: &str| {
        format!("elements = 3\ntemperature = \"30*sin(9*t){more}\"\ntemperature_gradient = [0, \"2e3*sin(5*t){more}\"]")
    };
    let [uniform, along] = ["", " + 0*s"].map(|more| rows(&mut start(&strip(&keys(more), SWINGING))));
    assert_eq!(uniform, along);
}

fn place(simulation: &Simulation, name: &str) -> usize {
    let found = simulation.variables().iter().position(|variable| variable.name == name);
    found.unwrap_or_else(|| panic!("no variable {name}"))
}

const GIVEN: &str = "elements = 3\ntemperature_input = true\ntemperature = 0\ntemperature_gradient = [0, 0]";

/// Takes a communication step with the temperature and its gradient at the end, or with those at the start and their
/// derivatives.
fn give(simulation: &mut Simulation, end: f64, by_rate: bool) {
    let every = 0.01;
    for (name, rate) in [("strip.temperature", 40.0), ("strip.temperature_gradient[2]", 3e3)] {
        let place = place(simulation, name);
        let from = if by_rate { end - every } else { end };
        simulation.set_value(place, Value::Real(rate * from)).unwrap();
        if by_rate {
            simulation.set_input_derivative(place, rate);
        }
    }
    simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
}

/// A host that gives a temperature that grows steadily gets the results of the function of time: by the values at the
/// ends of its steps, and by values with their derivatives. Only the round-off of the temperature differs.
#[test]
fn a_host_gives_what_a_function_of_time_is() {
    let keys = GIVEN
        .replace("temperature_input = true\n", "")
        .replace("temperature = 0", "temperature = \"40*t\"")
        .replace("[0, 0]", "[0, \"3e3*t\"]");
    let mut expected = start(&strip(&keys, SWINGING));
    let mut given = [false, true].map(|by_rate| (start(&strip(GIVEN, SWINGING)), by_rate));
    let mut most = 0.0_f64;
    for number in 1..=50 {
        let end = f64::from(number) * 0.01;
        expected.advance(end).unwrap();
        for (simulation, by_rate) in &mut given {
            give(simulation, end, *by_rate);
            for name in ["tip.displacement", "middle.section_moment"] {
                let [own, other] = [&*simulation, &expected].map(|simulation| vector(simulation, name));
                let scale = if name == "tip.displacement" { 1.0 } else { 10.0 };
                assert!((own - other).norm() < 1e-8 * scale, "{name} at {end} s: {own} {other}");
            }
        }
        most = most.max(vector(&expected, "tip.displacement").norm());
    }
    assert!(most > 1e-3, "{most}");
}

/// A temperature that a host changes once is reached in one step, stays, and does its work: the account of energy
/// closes.
#[test]
fn a_host_heats_and_stops() {
    let totals = format!("{SWINGING}spectral_radius = 1\ntolerance = 1e-9\ntotals = [\"energy\", \"work\"]\n");
    let mut heated = start(&strip(GIVEN, &totals));
    heated.set_value(place(&heated, "strip.temperature"), Value::Real(50.0)).unwrap();
    heated.set_value(place(&heated, "strip.temperature_gradient[2]"), Value::Real(2e3)).unwrap();
    let (mut works, mut drift, mut most) = (Vec::new(), 0.0_f64, 0.0_f64);
    run(&mut heated, 0.01, 0.5, |simulation| {
        works.push(value(simulation, "work.loads"));
        drift = drift.max(value(simulation, "work.drift").abs());
        most = most.max(value(simulation, "energy.total"));
    });
    println!("{works:?} {drift:e} of {most}");
    assert!(works[0] > 1e-2 && works.iter().all(|work| *work == works[0]), "{works:?}");
    assert!(drift < 1e-6 * most, "{drift} {most}");
}

/// A state that is saved within the run, and a step that is taken again, have the same bits; the derivatives of a step
/// by the temperature are those of two runs.
#[test]
fn states_and_derivatives_know_the_temperature_of_a_host() {
    let mut simulation = start(&strip(GIVEN, SWINGING));
    for number in 1..=10 {
        give(&mut simulation, f64::from(number) * 0.01, false);
    }
    let snapshot = simulation.snapshot();
    let mut other = start(&strip(GIVEN, SWINGING));
    let bytes = simulation.write(&snapshot, Vec::new());
    let read = other.read(&bytes).unwrap_or_else(|problem| panic!("{}", problem.message));
    other.restore(&read);
    for number in 11..=20 {
        give(&mut simulation, f64::from(number) * 0.01, false);
        give(&mut other, f64::from(number) * 0.01, false);
    }
    assert_eq!(vector(&simulation, "tip.displacement"), vector(&other, "tip.displacement"));
    let input = place(&simulation, "strip.temperature_gradient[2]");
    let results = ["tip.displacement[3]", "middle.section_moment[2]"].map(|name| place(&simulation, name));
    simulation.restore(&snapshot);
    let at_end = |simulation: &mut Simulation, value: f64| {
        simulation.restore(&snapshot);
        simulation.set_value(input, Value::Real(value)).unwrap();
        simulation.advance(0.11).unwrap();
        results.map(|place| simulation.value(place).number())
    };
    let [before, after] = [330.0 - 10.0, 330.0 + 10.0].map(|value| at_end(&mut simulation, value));
    at_end(&mut simulation, 330.0);
    for (place, (before, after)) in results.into_iter().zip(before.into_iter().zip(after)) {
        let quotient = (after - before) / 20.0;
        let found = simulation.partial_derivative(place, input).unwrap_or_else(|failure| panic!("{}", failure.message));
        // The difference of two runs has the tolerance of their iterations.
        assert!(quotient != 0.0 && (found / quotient - 1.0).abs() < 1e-4, "{found:e} {quotient:e}");
    }
}
