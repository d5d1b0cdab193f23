//! Does `--verify` tell the error of a run? The runs beside the first one must be the same machine, measured at the
//! same material points at the same instants, and what they tell must be near the true error where a closed form gives
//! it, and never far below. A wrong code gives error bars that are worse than none.

use crate::curves::{Curves, load};
use ancf14::fmi::Model;
use ancf14::fmi::variable::Causality;
use ancf14::model::run::levels::{Level, merged};
use ancf14::model::simulation::Simulation;
use ancf14::model::verification::estimate::{Limit, Order, Trust};
use ancf14::model::verification::{Report, Row, Verification};
use std::f64::consts::TAU;

const CANTILEVER: &str = include_str!("../../../models/cantilever.toml");
const ROLL_UP: &str = include_str!("../../../models/roll_up.toml");
const PRINCETON: &str = include_str!("../../../models/princeton_beam.toml");
const CRANE: &str = include_str!("../../../models/crane.toml");

/// The accuracy wanted where a test does not ask for another.
const WANTED: f64 = 1e-3;

fn owned(overrides: &[(&str, &str)]) -> Vec<(String, String)> {
    overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect()
}

/// A model run to its end, and what is told of its errors.
fn verified(text: &str, overrides: &[(&str, &str)], wanted: f64) -> Report {
    let mut simulation = load(text, overrides);
    let mut verification = Verification::new(&simulation, "model.toml", text, &owned(overrides));
    let rows = Curves::record(&mut simulation);
    let names: Vec<String> = results(&simulation);
    let columns: Vec<Vec<f64>> = names.iter().map(|name| rows.column(name)).collect();
    for (row, time) in rows.time.iter().enumerate() {
        let values: Vec<f64> = columns.iter().map(|column| column[row]).collect();
        verification.compare(row as u64, *time, &values);
    }
    verification.report(&simulation, wanted)
}

fn results(simulation: &Simulation) -> Vec<String> {
    let outputs = simulation.variables().iter().filter(|variable| variable.causality == Causality::Output);
    outputs.map(|variable| variable.name.clone()).collect()
}

fn row<'a>(report: &'a Report, name: &str) -> &'a Row {
    report.rows.iter().find(|row| row.name == name).unwrap_or_else(|| panic!("no column {name}"))
}

/// A cantilever rolled up is an arc of a circle at every instant: the end's place is known. The estimate is within a
/// factor of 2.
#[test]
fn estimates_meet_a_closed_form() {
    for elements in ["4", "8", "16"] {
        let overrides = [("strip.elements", elements)];
        let report = verified(ROLL_UP, &overrides, WANTED);
        let curves = Curves::run(ROLL_UP, &overrides);
        let place = |turn: f64| if turn == 0.0 { [1.0, 0.0] } else { [turn.sin() / turn, (1.0 - turn.cos()) / turn] };
        for axis in [0, 1] {
            let name = format!("tip.position[{}]", axis + 1);
            let own = curves.column(&name);
            let truth = own.iter().zip(&curves.time).map(|(own, time)| (own - place(TAU * time)[axis]).abs());
            let truth = truth.fold(0.0, f64::max);
            let Row { estimate, .. } = row(&report, &name);
            let ratio = estimate.error() / truth;
            assert!((0.5..=2.0).contains(&ratio), "{elements} elements, {name}: {ratio}");
            assert_eq!((estimate.limit, estimate.step), (Limit::Elements, 0.0));
        }
    }
}

/// The strip that bends both ways is limited by its linear twist, and quadratic twist is what helps.
#[test]
fn linear_twist_is_found_out() {
    let report = verified(PRINCETON, &[], 1e-4);
    assert_eq!(row(&report, "tip.displacement[3]").estimate.limit, Limit::Twist);
    assert_eq!(report.remedy.as_deref(), Some(&[String::from("arm.twist = \"quadratic\"")][..]));
    let report = verified(PRINCETON, &[("arm.twist", "quadratic")], 1e-4);
    assert_eq!(row(&report, "tip.displacement[3]").estimate.limit, Limit::Elements);
    assert_eq!(report.remedy.as_deref(), Some(&[][..]));
}

/// A rigid pendulum, whose only error is that of the step.
const PENDULUM: &str = r#"format = 1
[model]
name = "Pendulum"
gravity = [0, 0, -9.81]
[body.bob]
mass = 1.0
position = [1, 0, 0]
inertia = [0.1, 0.1, 0.1]
[joint.hinge]
type = "revolute"
a = "ground"
b = "bob"
at = [0, 0, 0]
axis = [0, 1, 0]
[output.place]
at = "bob"
quantities = ["position"]
[simulation]
stop = 2
step = 0.02
output_step = 0.1
"#;

/// With the settings that are proposed a motion has the accuracy wanted, against one with far finer steps; and a
/// rolled-up strip has, against the circle.
#[test]
fn remedies_reach_the_accuracy() {
    let with = |text: &str, own: &[(&str, &str)], settings: &[String]| {
        let all = merged(&owned(own), settings.iter().map(|setting| split(setting)).collect());
        let all: Vec<_> = all.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
        Curves::run(text, &all)
    };
    let name = "place.position[3]";
    let finest = Curves::run(PENDULUM, &[("simulation.step", "1e-4")]).column(name);
    for wanted in [2e-4, 5e-5, 1e-5] {
        let report = verified(PENDULUM, &[], wanted);
        let Row { scale, remedy, .. } = row(&report, name);
        assert!(row(&report, name).relative() > wanted);
        let curves = with(PENDULUM, &[], remedy.as_ref().expect("a remedy"));
        let error = curves.difference(&curves.column(name), &finest, 2.0) / scale;
        // The next coarser step that could be proposed is twice as long at most.
        assert!((0.2 * wanted..=wanted).contains(&error), "wanted {wanted}: {error} with {remedy:?}");
    }
    let coarse = [("strip.elements", "4")];
    for wanted in [1e-3, 1e-5] {
        let report = verified(ROLL_UP, &coarse, wanted);
        let Row { scale, remedy, .. } = row(&report, "tip.position[1]");
        let curves = with(ROLL_UP, &coarse, remedy.as_ref().expect("a remedy"));
        let error = curves.last("tip.position[1]").abs() / scale;
        assert!(error <= wanted, "wanted {wanted}: {error} with {remedy:?}");
    }
}

/// A setting of a report as an override.
fn split(setting: &str) -> (String, String) {
    let (key, value) = setting.split_once(" = ").expect("key = value");
    (key.to_owned(), value.trim_matches('"').to_owned())
}

/// Points that nodes are named for stay where they are, on straight beams, curves and polylines, and rows stay at their
/// times.
#[test]
fn other_meshes_measure_the_same_points() {
    let line = "[joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.node[0]\"\n\
                [joint.hold]\ntype = \"spherical\"\na = \"ground\"\nb = \"arm.node[2]\"\n\
                [spring.tie]\na = \"ground\"\nb = \"arm.node[4]\"\nstiffness = 10\n\
                [load.push]\nat = \"arm.node[4]\"\nforce = [0, 0, -1]\n\
                [output.inner]\nat = \"arm.node[2]\"\nquantities = [\"position\"]\n\
                [output.outer]\nat = \"arm.node[4]\"\nquantities = [\"position\"]\n\
                [output.shape]\non = \"arm\"\nstations = 5\nquantities = [\"position\"]\n\
                [simulation]\nstop = 0.02\nstep = 1e-3\n";
    let head = CANTILEVER.split("[beam.arm]").next().expect("a beam");
    let beam = "[beam.arm]\nmaterial = \"steel\"\nsection = \"strip\"\ny_axis = [0, 0, 1]\n";
    for shape in [
        "from = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n",
        "curve = { x = \"s\", y = \"0.1*sin(s)\", z = 0, s = [0, 1] }\nelements = 4\n",
        "curve = { x = \"s\", y = \"s^2\", z = 0, s = [0, 1] }\nspacing = \"s\"\nelements = 4\n",
        // Two elements and two; eight are not twice as many in each piece: 5 and 3.
        "curve = { points = [[0, 0, 0], [1, 0, 0], [1, 0.72, 0]], polyline = true }\nelements = 4\n",
    ] {
        let text = format!("{head}{beam}{shape}{line}");
        let own = load(&text, &[]);
        for level in Level::ALL {
            let overrides = level.overrides(own.document()).expect("a level");
            let overrides: Vec<_> = overrides.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
            let other = load(&text, &overrides);
            assert_eq!(results(&own), results(&other));
            let value = |simulation: &Simulation, name: &str| {
                let place = simulation.variables().iter().position(|variable| variable.name == name).expect("a column");
                simulation.value(place).number()
            };
            for name in results(&own).iter().filter(|name| name.starts_with("inner") || name.starts_with("outer")) {
                let [here, there] = [&own, &other].map(|simulation| value(simulation, name));
                assert!((here - there).abs() < 1e-9, "{shape}{level:?} {name}: {here} {there}");
            }
            assert_eq!(own.about().output_step, other.about().output_step);
        }
    }
}

/// Internal steps end at every row. Where rows are a step apart, or nearer, half the step is half of what is really
/// taken.
#[test]
fn half_the_step_is_half_of_what_is_taken() {
    let steps = |text: &str, overrides: &[(&str, &str)]| -> Option<f64> {
        let own = load(text, overrides);
        let list = Level::HalfStep.overrides(own.document())?;
        list.iter().find(|(key, _)| key == "simulation.step").map(|(_, value)| value.parse().unwrap())
    };
    assert_eq!(steps(CANTILEVER, &[]), Some(5e-4));
    assert_eq!(steps(CANTILEVER, &[("simulation.output_step", "2e-4")]), Some(1e-4));
    assert_eq!(steps(PRINCETON, &[]), None, "statics has no step error");
    // The order is observed all the same: rows two steps apart have longer steps between them.
    let damped = [("steel.damping", "1e-3"), ("simulation.output_step", "1e-3"), ("simulation.stop", "0.3")];
    let report = verified(CANTILEVER, &damped, WANTED);
    let order = row(&report, "tip.displacement[3]").estimate.order.value();
    assert!((order - 2.0).abs() < 0.3, "{order}");
}

/// Rows may bound the steps that the solver chooses: half of them, and twice as long ones, still show the order. The
/// remedy names the longest step. A run with the remedy needs none.
#[test]
fn steps_that_rows_bound_are_verified() {
    let text = "format = 1\n[model]\nname = \"Oscillator\"\n[body.b]\nmass = 1\nposition = [0, 0, -1]\n\
                inertia = [0.1, 0.1, 0.1]\nvelocity = [0, 0, 1]\n[frame.hook]\nposition = [0, 0, 0]\n\
                [spring.coil]\na = \"hook\"\nb = \"b\"\nstiffness = 1000\n\
                [output.way]\nat = \"b\"\nquantities = [\"displacement\"]\n\
                [simulation]\nstop = 0.6\noutput_step = 2.4e-3\naccuracy = 0.1\n";
    let report = verified(text, &[], WANTED);
    let order = row(&report, "way.displacement[3]").estimate.order;
    // The first steps are short in all three runs.
    assert!(matches!(order, Order::Observed(order) if (order - 2.0).abs() < 0.3), "{order:?}");
    let remedy = report.remedy.expect("a remedy");
    assert!(remedy.iter().any(|setting| setting.starts_with("simulation.longest_step = ")), "{remedy:?}");
    let settings: Vec<_> = remedy.iter().filter_map(|setting| setting.split_once(" = ")).collect();
    let better = verified(text, &settings, WANTED);
    assert_eq!(better.remedy, Some(Vec::new()));
}

/// What the user overrides holds in all runs; what a level sets replaces it.
#[test]
fn overrides_of_the_user_hold() {
    let own = owned(&[("arm.elements", "3"), ("steel.young", "1e11")]);
    let level = owned(&[("arm.elements", "6")]);
    assert_eq!(merged(&own, level), owned(&[("steel.young", "1e11"), ("arm.elements", "6")]));
    // A step error that depends on the overridden length of the run.
    let [short, long] = ["0.2", "1"].map(|stop| {
        let report = verified(CANTILEVER, &[("simulation.stop", stop), ("steel.damping", "1e-3")], WANTED);
        row(&report, "tip.displacement[3]").estimate.time
    });
    assert!(short <= 0.2 && long > 0.2, "{short} {long}");
}

/// A run beside the first one that cannot be built is reported with its reason, and what the others tell is kept.
#[test]
fn failures_are_told() {
    // Of three elements the first piece has two, of six three: the joint in its middle has no node.
    let line =
        "y_axis = [0, 0, 1]\ncurve = { points = [[0, 0, 0], [1, 0, 0], [1, 0.72, 0]], polyline = true }\nelements = 3";
    let hold = "[joint.hold]\ntype = \"inplane\"\na = \"ground\"\nb = \"arm.node[1]\"\naxis = [0, 1, 0]\n";
    let text = CANTILEVER.replace("from = [0, 0, 0]\nto = [1, 0, 0]\nelements = 8", line) + hold;
    let report = verified(&text, &[("simulation.stop", "0.1")], WANTED);
    let [(Level::DoubleElements, reason)] = report.failures.as_slice() else { panic!("{:?}", report.failures) };
    assert!(reason.contains("arm"), "{reason}");
    let estimate = row(&report, "tip.displacement[3]").estimate;
    assert!(estimate.step > 0.0 && estimate.mesh == 0.0);
    // Where nothing but a load and an output is there, a fraction does.
    let push = "[load.push]\nat = \"arm.node[1]\"\nforce = [0, 0, -1]\n";
    let text = text.replace(hold, push);
    assert!(verified(&text, &[("simulation.stop", "0.1")], WANTED).failures.is_empty());
}

/// A crane that stands still, its host away: nothing moves, and no column of round-off passes for an error.
#[test]
fn round_off_is_no_error() {
    let report = verified(CRANE, &[("simulation.stop", "1")], WANTED);
    for row in &report.rows {
        assert!(row.relative() < WANTED, "{}: {:?}", row.name, row.estimate);
    }
    let still = row(&report, "load_motion.acceleration[3]");
    assert_eq!(still.estimate.trust, Trust::RoundOff);
    assert_eq!(report.remedy.as_deref(), Some(&[][..]));
}
