//! Steps that the solver chooses by an asked accuracy.

use crate::running::{run, start, try_start, value};
use ancf14::fmi::{Model, Value};
use ancf14::model::run::levels::{Level, merged};
use ancf14::model::simulation::Simulation;

/// A body on a spring, 31.6 rad/s, for 5 periods.
fn oscillator(settings: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Oscillator\"\n[body.b]\nmass = 1\nposition = [0, 0, -1]\ninertia = [0.1, 0.1, 0.1]\n\
         velocity = [0, 0, 1]\n[frame.hook]\nposition = [0, 0, 0]\n[spring.coil]\na = \"hook\"\nb = \"b\"\nstiffness = 1000\n\
         [load.push]\nat = \"b\"\nforce = [0, 0, 0]\ninput = true\n\
         [output.P]\nat = \"b\"\nquantities = [\"displacement\", \"velocity\"]\n[simulation]\nstop = 1\n{settings}\n"
    )
}

fn omega() -> f64 {
    1000.0_f64.sqrt()
}

/// The largest error of the oscillator over its range of two amplitudes, at rows `every` s.
fn error(simulation: &mut Simulation, every: f64) -> f64 {
    let mut largest = 0.0_f64;
    run(simulation, every, 1.0, |simulation| {
        let exact = (omega() * simulation.time()).sin() / omega();
        largest = largest.max((value(simulation, "P.displacement[3]") - exact).abs());
    });
    0.5 * largest * omega()
}

/// The error follows the accuracy and is about that. With steps whose error is `(omega h)^3 / 12`, of the amplitude,
/// 1.5e-2 times the accuracy and its root, the error of 5 periods, `7/6 omega t (omega h)^2 / 24` of the range, is 0.6
/// of the accuracy; and half as much again because the steps become longer where the third derivative passes through
/// zero.
#[test]
fn the_error_is_the_one_asked_for() {
    let mut steps = Vec::new();
    for accuracy in [1e-2, 1e-3, 1e-4, 1e-5] {
        let mut simulation = start(&oscillator(&format!("accuracy = {accuracy:e}")));
        let found = error(&mut simulation, 0.05);
        assert!(found < 1.5 * accuracy && found > 0.2 * accuracy, "{accuracy}: {found}");
        let statistics = simulation.state().statistics;
        assert!(statistics.rejected * 50 < statistics.steps, "{statistics:?}");
        steps.push(statistics.steps as f64);
    }
    // A second-order rule takes ten times the steps for a hundredth of the error.
    assert!((steps[3] / steps[1] / 10.0 - 1.0).abs() < 0.1, "{steps:?}");
}

/// A wheel that starts smoothly and turns by 0.6 rad between two rows, more than a step may: steps stay below that
/// instead of being rejected once a row, and the first, tiny energy raises no alarm.
#[test]
fn wheels_turn_without_rejected_steps() {
    for rate in ["150*smoothstep(0, 0.5, t)", "1200*min(t, 0.5)^3"] {
        let mut simulation = start(&format!(
            "format = 1\n[model]\nname = \"Wheel\"\n[body.wheel]\nmass = 1\nposition = [0, 0, 0]\ninertia = [0.04, 0.06, 0.04]\n\
             [joint.shaft]\ntype = \"revolute\"\na = \"ground\"\nb = \"wheel\"\naxis = [0, 1, 0]\n\
             [drive.motor]\njoint = \"shaft\"\ncoordinate = \"angle\"\nrate = \"{rate}\"\n[simulation]\nstop = 2\n"
        ));
        run(&mut simulation, 4e-3, 2.0, |_| ());
        simulation.conclude();
        assert_eq!(simulation.take_warnings(), Vec::<String>::new(), "{rate}");
        let statistics = simulation.state().statistics;
        assert!(statistics.rejected * 50 < statistics.steps, "{rate}: {statistics:?}");
    }
}

/// How a host cuts the time into communication steps changes no more than the accuracy.
#[test]
fn communication_steps_do_not_matter() {
    for every in [1.0, 0.1, 7.3e-3, 1e-3] {
        let mut simulation = start(&oscillator("accuracy = 1e-3"));
        let found = error(&mut simulation, every);
        assert!(found < 1.5e-3, "{every}: {found}");
    }
}

/// What acts for a ten-thousandth of the time is not stepped over: the momentum is that of the pulse, to round-off of
/// the times.
#[test]
fn short_pulses_are_hit() {
    let text = "format = 1\n[model]\nname = \"Pulse\"\ngravity = [0, 0, 0]\n[body.b]\nmass = 2\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
                [load.hit]\nat = \"b\"\nforce = [0, 0, [{ until = 0.5, is = 0 }, { until = 0.5001, is = 1000 }, { is = 0 }]]\n\
                [output.P]\nat = \"b\"\nquantities = [\"velocity\"]\n[simulation]\nstop = 1\n";
    let mut simulation = start(text);
    simulation.advance(1.0).unwrap();
    let velocity = value(&simulation, "P.velocity[3]");
    assert!((velocity - 0.05).abs() < 1e-12, "{velocity}");
    assert!(simulation.state().statistics.steps < 200, "{:?}", simulation.state().statistics);
}

/// A force that jumps on what has been at rest: the steps that have grown until then do not spoil the first one behind
/// it, whatever the rows.
#[test]
fn late_jumps_are_resolved() {
    let text = oscillator("")
        .replace("velocity = [0, 0, 1]\n", "")
        .replace("force = [0, 0, 0]\ninput = true", "force = [0, 0, [{ until = 0.5, is = 0 }, { is = 100 }]]");
    for every in [1.0, 0.25, 0.05, 2e-3] {
        let mut simulation = start(&text);
        let mut largest = 0.0_f64;
        run(&mut simulation, every, 1.0, |simulation| {
            let turn = omega() * (simulation.time() - 0.5).max(0.0);
            largest = largest.max((value(simulation, "P.displacement[3]") - 0.1 * (1.0 - turn.cos())).abs());
        });
        // Of the range, 0.2 m.
        assert!(largest / 0.2 < 1.5e-3, "{every}: {}", largest / 0.2);
    }
}

/// The same with an input, which is constant after its one jump; and its derivative is that of the steps that were
/// taken: against a difference, whose steps differ by what the accuracy allows.
#[test]
fn late_jumps_of_inputs_are_resolved() {
    let text = oscillator("").replace("velocity = [0, 0, 1]\n", "");
    for every in [0.25, 0.05] {
        let mut simulation = start(&text);
        let find = |simulation: &Simulation, name: &str| {
            simulation.variables().iter().position(|variable| variable.name == name).expect("a variable")
        };
        let (push, place) = (find(&simulation, "push.force[3]"), find(&simulation, "P.displacement[3]"));
        simulation.advance(every).unwrap();
        let before = simulation.snapshot();
        let end = |simulation: &mut Simulation, force: f64| {
            simulation.restore(&before);
            simulation.set_value(push, Value::Real(force)).unwrap();
            simulation.advance(2.0 * every).unwrap();
            simulation.value(place).number()
        };
        let difference = (end(&mut simulation, 101.0) - end(&mut simulation, 99.0)) / 2.0;
        let found = end(&mut simulation, 100.0);
        let exact = 0.1 * (1.0 - (omega() * every).cos());
        assert!((found - exact).abs() / 0.2 < 1.5e-3, "{every}: {found} instead of {exact}");
        let derivative = simulation.partial_derivative(place, push).unwrap();
        assert!((derivative - difference).abs() < 1e-2 * 2e-3, "{every}: {derivative} instead of {difference}");
    }
}

/// A force that a host moves in steps: the motion from each to the next is known in closed form.
#[test]
fn jumps_of_inputs_are_no_errors() {
    let mut simulation = start(&oscillator("accuracy = 1e-3"));
    let push = simulation.variables().iter().position(|variable| variable.name == "push.force[3]").expect("the input");
    // About the place where spring and force balance, the state turns by omega t.
    let (mut place, mut velocity, mut largest) = (0.0_f64, 1.0_f64, 0.0_f64);
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    let every = 0.01;
    for row in 0..100 {
        let force = 20.0 * (0.3 * f64::from(row)).sin();
        simulation.set_value(push, Value::Real(force)).unwrap();
        simulation.advance(f64::from(row + 1) * every).unwrap();
        let rest = force / 1000.0;
        let (sin, cos) = (omega() * every).sin_cos();
        let from = place - rest;
        place = rest + from * cos + velocity / omega() * sin;
        velocity = velocity * cos - from * omega() * sin;
        largest = largest.max((value(&simulation, "P.displacement[3]") - place).abs());
        (low, high) = (low.min(place), high.max(place));
    }
    assert!(largest < 1.5e-3 * (high - low), "{}", largest / (high - low));
    // Not many more than without the force.
    let steps = simulation.state().statistics.steps;
    assert!(steps < 4000, "{steps}");
}

/// A ripple of a thousandth of the motion, 100 times as fast, that holds the steps up: they become longer where results
/// that are asked for are far more exact than that, and stay so where the ripple itself is a result. Without rows
/// on the way nothing is known of results.
#[test]
fn steps_are_as_exact_as_the_results_ask_for() {
    let rippled = |settings: &str| {
        oscillator(settings)
            + "[body.r]\nmass = 1\nposition = [5, 0, -1]\ninertia = [0.1, 0.1, 0.1]\nvelocity = [0, 0, 0.1]\n\
               [point.nail]\non = \"ground\"\noffset = [5, 0, 0]\n\
               [spring.wire]\na = \"nail\"\nb = \"r\"\nstiffness = 1e7\n"
    };
    let shown = "[output.R]\nat = \"r\"\nquantities = [\"displacement\"]\n";
    let steps = |text: &str, every: f64| {
        let mut simulation = start(text);
        let found = error(&mut simulation, every);
        (simulation.state().statistics.steps, found)
    };
    // The ripple has a hundredth of the energy.
    let quiet = rippled("totals = []");
    let [(unknown, _), (eased, found), (asked, _)] =
        [steps(&quiet, 1.0), steps(&quiet, 0.01), steps(&(quiet.clone() + shown), 0.01)];
    println!(
        "{unknown} steps without rows, {eased} with rows, error {found:.1e}, {asked} where the ripple is a result"
    );
    // Thirty times the error of a step is three times its length; the growth takes a tenth of the motion.
    assert!(2 * eased < unknown && found < 1e-3, "{eased} of {unknown} steps, {found}");
    assert!(10 * asked > 9 * unknown, "{asked} of {unknown} steps");
}

/// A host's tolerance is the accuracy.
#[test]
fn a_tolerance_is_the_accuracy() {
    let mut simulation =
        Simulation::load("m.toml", &oscillator(""), &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    assert_eq!(simulation.about().tolerance, 1e-3);
    assert_eq!(simulation.set_tolerance(1e-5), Some(1e-5));
    assert_eq!(value(&simulation, "simulation.accuracy"), 1e-5);
    simulation.initialize(0.0).unwrap();
    assert!(error(&mut simulation, 0.05) < 1.5e-5);
    // Steps that are given stay so.
    let mut simulation = start(&oscillator("step = 1e-3"));
    assert_eq!(simulation.set_tolerance(1e-5), None);
}

/// A run whose results are off by more than a reader expects names the accuracy, not a step that the file does not
/// have.
#[test]
fn inexact_results_ask_for_another_accuracy() {
    let mut simulation = start(&oscillator("accuracy = 0.05"));
    run(&mut simulation, 0.05, 1.0, |_| {});
    simulation.conclude();
    let warnings = simulation.take_warnings();
    assert!(warnings.iter().any(|warning| warning.contains("take a smaller simulation.accuracy: ")), "{warnings:?}");
}

/// Where the error of a step is not known a step must be given, and the message says so.
#[test]
fn steps_are_chosen_only_where_errors_are_known() {
    let message = try_start(&oscillator("integrator = \"generalized_alpha\"")).unwrap_err();
    assert!(message.contains("[simulation] needs the key `step`"), "{message}");
    let message = try_start(&oscillator("spectral_radius = 1")).unwrap_err();
    assert!(message.contains("cannot choose the steps") && message.contains("give simulation.step"), "{message}");
    let message = try_start(&oscillator("accuracy = 1e-3\nstep = 1e-3")).unwrap_err();
    assert!(message.contains("accuracy and step exclude each other"), "{message}");
}

/// A run of many steps says what holds them: the accuracy of a fast part, or changes of what acts.
#[test]
fn many_steps_say_why() {
    let limits = |text: &str, stop: f64| {
        let mut simulation = start(text);
        simulation.advance(stop).unwrap();
        assert!(simulation.state().statistics.steps >= 20_000, "{:?}", simulation.state().statistics);
        simulation.step_limits().unwrap()
    };
    let vibration = oscillator("accuracy = 1e-6").replace("stop = 1\n", "stop = 4\n");
    let text = limits(&vibration, 4.0);
    assert!(
        text.starts_with("100 % are as long as simulation.accuracy allows, mostly because of b (along z)."),
        "{text}"
    );

    let blows = "format = 1\n[model]\nname = \"Blows\"\ngravity = [0, 0, 0]\n[body.b]\nmass = 1\nposition = [0, 0, 0]\n\
                 inertia = [1, 1, 1]\n[load.hit]\nat = \"b\"\nforce = [\"if(sin(4e4*t) > 0, 1, -1)\", 0, 0]\n[simulation]\nstop = 1\n";
    let text = limits(blows, 1.0);
    assert!(text.contains("% end where a load, a drive, a joint or a contact changes"), "{text}");

    let mut few = start(&oscillator(""));
    few.advance(1.0).unwrap();
    assert_eq!(few.step_limits(), None);
}

/// The steps between two rows of a body that coasts: they have no error, and only their bounds matter.
fn steps_of_coasting(settings: &[(String, String)]) -> f64 {
    let text = "format = 1\n[model]\nname = \"Coasting\"\n[body.b]\nmass = 1\nposition = [0, 0, 0]\n\
                inertia = [1, 1, 1]\nvelocity = [1, 0, 0]\n[output.way]\nat = \"b\"\nquantities = [\"position\"]\n\
                [simulation]\nstop = 1\noutput_step = 0.01\n";
    let mut simulation = Simulation::load("coasting.toml", text, settings).unwrap();
    simulation.initialize(0.0).unwrap();
    // Steps have grown to their bound by the middle of the motion.
    let [middle, end] = [0, 50].map(|first| {
        (first + 1..=first + 50).for_each(|row| simulation.advance(f64::from(row) * 0.01).unwrap());
        simulation.state().statistics.steps
    });
    (end - middle) as f64 / 50.0
}

/// Rows bound steps without error, and so does a longest step that is asked for: whole steps fill the time between two
/// rows. The run that a verification compares with has steps half as long, whatever bounds them.
#[test]
fn steps_are_no_longer_than_asked_for() {
    let asked = |step: &str| vec![(String::from("simulation.longest_step"), String::from(step))];
    for (settings, steps) in [(vec![], 1.0), (asked("5e-3"), 2.0), (asked("4.9e-3"), 3.0), (asked("0.1"), 1.0)] {
        assert_eq!(steps_of_coasting(&settings), steps, "{settings:?}");
        let text = include_str!("../../../models/cantilever.toml").replace("step = 1e-3\n", "");
        let text = text.replace("output_step = 5e-3", "output_step = 1e-2");
        let simulation = Simulation::load("m.toml", &text, &settings).unwrap();
        let half = Level::HalfStep.overrides(simulation.document()).unwrap();
        assert_eq!(steps_of_coasting(&merged(&settings, half)), 2.0 * steps, "{settings:?}");
    }
}

/// A smaller accuracy would not shorten steps that rows bound. A warning names the longest step instead, and a run with
/// the number that it advises needs no warning.
#[test]
fn advice_names_what_bounds_the_steps() {
    let warned = |settings: &str| {
        let mut simulation = start(&oscillator(settings));
        let found = error(&mut simulation, 2.5e-3);
        simulation.conclude();
        (found, simulation.take_warnings().join("\n"))
    };
    let (found, warning) = warned("accuracy = 0.1");
    let advised = warning.split("take a smaller simulation.longest_step in the model file: ").nth(1).expect(&warning);
    let advised = advised.split(' ').next().unwrap();
    let (better, nothing) = warned(&format!("accuracy = 0.1\nlongest_step = {advised}"));
    assert!(found > 0.005 && better < 0.0035 && nothing.is_empty(), "{found} {better} {nothing}");
    assert!(warned("accuracy = 1e-2").1.contains("take a smaller simulation.accuracy: "));
}
