//! Is the mesh error of a motion told? It is compared with runs on meshes four times as fine.

use super::mesh_truth::{fine, true_error};
use super::refinement::repeated;
use crate::curves::Curves;
use ancf14::fmi::{Model, Value};
use ancf14::model::run::accuracy::{Differences, Inexact};
use ancf14::model::simulation::{Beside, Companion, Lost, Row, Simulation};

const PENDULUM: &str = include_str!("../../../models/pendulum.toml");
const CANTILEVER: &str = include_str!("../../../models/cantilever.toml");
const CRANE: &str = include_str!("../../../models/crane.toml");

/// A shaft of 10 elements that a torque twists smoothly, and that swings back; a joint holds its middle.
pub const SHAFT: &str = r#"
format = 1
[model]
name = "Shaft"
[material.steel]
young = 210e9
poisson = 0.3
density = 7850
[section.bar]
shape = "circle"
radius = 0.005
[beam.shaft]
material = "steel"
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 10
[joint.bearing]
type = "weld"
a = "ground"
b = "shaft.start"
[joint.middle]
type = "revolute"
a = "ground"
b = "shaft.node[5]"
axis = [1, 0, 0]
[load.torque]
at = "shaft.end"
moment = ["10*(1 - cos(2000*t)) + push", 0, 0]
[parameters]
push = 0
[load.extra]
at = "shaft.end"
moment = [0, 0, 0]
input = true
[output.end]
at = "shaft.end"
quantities = ["rotation"]
[simulation]
stop = 0.01
step = 2e-6
output_step = 1e-4
"#;

/// A cantilever that its weight and a force swing, on few elements and with large steps.
const SWING: &str = r#"
format = 1
[model]
name = "Swing"
gravity = [0, 0, -9.81]
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
damping = 2e-4
[section.strip]
shape = "rectangle"
width = 0.02
height = 0.004
[beam.arm]
material = "steel"
section = "strip"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 4
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[load.push]
at = "arm.end"
force = [0, 0, "-2*sin(10*t)"]
[output.tip]
at = "arm.end"
quantities = ["displacement", "velocity"]
[simulation]
accuracy = 2e-2
stop = 1.0
output_step = 2e-3
"#;

/// Quantities whose scales are their ranges, and whose largest errors are told.
const COMPARED: [&str; 6] = ["displacement", "position", "rotation", "velocity", "angle", "angle_rate"];
/// Errors below this share are told as small; what the steps cause differs between the meshes by about as much.
const LEAST: f64 = 1e-4;

fn load(text: &str, overrides: &[(String, String)]) -> Simulation {
    let mut simulation =
        Simulation::load("model.toml", text, overrides).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.ask_for_mesh_error(|companion| Box::new(companion));
    simulation
}

/// A run to its end, with its rows.
fn concluded(mut simulation: Simulation) -> (Simulation, Curves) {
    simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let rows = Curves::record(&mut simulation);
    simulation.conclude();
    (simulation, rows)
}

fn error(simulation: &Simulation, name: &str) -> f64 {
    let errors = simulation.mesh_errors();
    errors.iter().find(|own| own.name == name).unwrap_or_else(|| panic!("no error of {name}: {errors:?}")).error
}

/// All errors that are more than what the steps cause are told: at least half of them where vibrations that the mesh
/// does not resolve lower the order below the assumed one, and, where the order is the elements' own, 4, at most `(2^4
/// - 1)/(2^2 - 1) = 5` times.
#[test]
fn errors_of_motions_are_told() {
    let (mut compared, mut off) = (0, Vec::new());
    // Torsion alone has order 2, which is the one assumed.
    let bounds = |model| if model == "shaft" { 0.7..1.5 } else { 0.5..5.0 };
    for (model, text) in [("pendulum", PENDULUM), ("cantilever", CANTILEVER), ("shaft", SHAFT)] {
        let coarse = text.replace("elements = 8", "elements = 4");
        let (simulation, rows) = concluded(load(&coarse, &[]));
        let fine = fine(&coarse);
        for Inexact { name, error, .. } in simulation.mesh_errors() {
            let truth = true_error(&rows, &fine, name);
            println!("{model}: {name} told {error:.2e}, true {truth:.2e}");
            if truth > LEAST && COMPARED.iter().any(|quantity| name.ends_with(quantity)) {
                compared += 1;
                if !bounds(model).contains(&(error / truth)) {
                    off.push(format!("{model}: {name} told {error:e}, true {truth:e}"));
                }
            }
        }
    }
    assert!(compared > 5, "{compared} errors compared");
    assert!(off.is_empty(), "{off:#?}");
}

/// A shaft of two elements, which a joint holds in the middle, is compared with one of four.
#[test]
fn the_coarsest_mesh_is_compared_with_a_finer_one() {
    let coarse = SHAFT.replace("elements = 10", "elements = 2").replace("node[5]", "node[1]");
    let (mut simulation, _) = concluded(load(&coarse, &[]));
    let told = simulation.take_warnings();
    let words = "because of the mesh, as estimated from a run with twice the elements";
    assert!(told.iter().any(|warning| warning.contains(words)), "{told:?}");
    let off = error(&simulation, "end.rotation");
    let finer = concluded(load(SHAFT, &[])).0;
    assert!(off > 3.0 * error(&finer, "end.rotation"), "{off}");
}

/// The run beside changes nothing, and tells the same each time.
#[test]
fn results_are_the_same_bits() {
    let runs = [0, 1].map(|_| concluded(load(PENDULUM, &[])));
    let mut alone = Simulation::load("model.toml", PENDULUM, &[]).unwrap();
    alone.initialize(0.0).unwrap();
    let rows = Curves::record(&mut alone);
    for (simulation, own) in &runs {
        for name in rows.names() {
            let bits = |curves: &Curves| curves.column(name).iter().map(|value| value.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(own), bits(&rows), "{name}");
        }
        assert!(!simulation.mesh_errors().is_empty());
        assert_eq!(simulation.mesh_errors(), runs[0].0.mesh_errors());
    }
    alone.conclude();
    assert_eq!(alone.mesh_errors(), []);
}

/// The steps and the mesh are each good enough by themselves, but not both together.
#[test]
fn errors_of_steps_and_mesh_count_together() {
    let warnings = |overrides: &[(String, String)]| {
        let (mut simulation, _) = concluded(load(SWING, overrides));
        simulation.take_warnings()
    };
    let told = warnings(&[]);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains("because of the length of the steps and the mesh together"), "{told:?}");
    assert_eq!(warnings(&[(String::from("arm.elements"), String::from("8"))]), [""; 0]);
    assert_eq!(warnings(&[(String::from("simulation.accuracy"), String::from("1e-3"))]), [""; 0]);
}

/// Parameters that a host sets before the start, and inputs, are those of both runs.
#[test]
fn numbers_of_a_host_count_in_motions() {
    let place = |simulation: &Simulation, name: &str| {
        simulation.variables().iter().position(|variable| variable.name == name).unwrap()
    };
    let run = |overrides: &[(String, String)], parameter: Option<f64>| {
        let mut simulation = load(SHAFT, overrides);
        if let Some(value) = parameter {
            let push = place(&simulation, "push");
            simulation.set_value(push, Value::Real(value)).unwrap();
        }
        let moment = place(&simulation, "extra.moment[1]");
        simulation.initialize(0.0).unwrap();
        for row in 1..=100_u32 {
            let time = f64::from(row) * 1e-4;
            simulation.set_value(moment, Value::Real(3.0 * (900.0 * time).sin())).unwrap();
            simulation.advance(time).unwrap();
        }
        simulation.conclude();
        simulation
    };
    let set = run(&[], Some(5.0));
    let written = run(&[(String::from("push"), String::from("5"))], None);
    assert_eq!(set.mesh_errors(), written.mesh_errors());
    // Without the input in both, they would be apart by its share of the motion, about a third, and the error would be
    // told as a third of that or more.
    let off = error(&set, "end.rotation");
    assert!((1e-4..0.05).contains(&off), "{off}");
}

/// After a parameter that is set on the way, or a restored state, both runs are no longer the same.
#[test]
fn the_error_is_unknown_where_the_runs_part() {
    let mut simulation = load(CRANE, &[]);
    simulation.initialize(0.0).unwrap();
    simulation.advance(0.1).unwrap();
    let state = simulation.snapshot();
    simulation.restore(&state);
    simulation.advance(0.2).unwrap();
    simulation.conclude();
    assert_eq!(simulation.mesh_errors(), []);

    let mut simulation = load(CRANE, &[]);
    let gravity = simulation.variables().iter().position(|variable| variable.name == "gravity[3]").unwrap();
    simulation.initialize(0.0).unwrap();
    simulation.advance(0.1).unwrap();
    simulation.set_value(gravity, Value::Real(-9.0)).unwrap();
    simulation.advance(0.2).unwrap();
    simulation.conclude();
    assert_eq!(simulation.mesh_errors(), []);
}

/// A run that ends early.
#[derive(Debug)]
struct Failing;

impl Beside for Failing {
    fn go_on(&mut self, _: Row) {}

    fn finish(self: Box<Self>) -> Result<Differences, Lost> {
        Err(Lost::Motion(String::from("error: no step is short enough.\n --> model.toml")))
    }
}

/// The user hears of a run beside that has not come to the end.
#[test]
fn a_run_that_ends_early_leaves_the_error_unknown() {
    let mut simulation = Simulation::load("model.toml", SWING, &[]).unwrap();
    simulation.ask_for_mesh_error(|_: Companion| Box::new(Failing));
    let (mut simulation, _) = concluded(simulation);
    assert_eq!(simulation.mesh_errors(), []);
    let told = simulation.take_warnings();
    let expected = "the mesh error is not known: a run with half the elements, for comparison, stopped early (no step is short enough). The mesh may be too coarse; take more elements";
    assert_eq!(told, [expected]);
}

/// A run that is halted in the middle of its second row.
#[derive(Debug)]
struct Halting {
    companion: Companion,
    has_begun: bool,
}

impl Beside for Halting {
    fn go_on(&mut self, row: Row) {
        let (halt, has_begun) = (self.companion.halt(), std::mem::replace(&mut self.has_begun, true));
        std::thread::scope(|scope| {
            scope.spawn(|| self.companion.go_on(row));
            if has_begun {
                // The row takes a second: it is under way.
                std::thread::sleep(std::time::Duration::from_millis(20));
                halt.set();
            }
        });
    }

    fn finish(self: Box<Self>) -> Result<Differences, Lost> {
        Box::new(self.companion).finish()
    }
}

/// A run beside that is halted ends within its row: it never comes to the end, where it would tell the error.
#[test]
fn a_run_is_halted_within_a_row() {
    let long = ["simulation.stop", "simulation.output_step"].map(|key| (key.to_owned(), "40".to_owned()));
    let mut simulation = Simulation::load("model.toml", SWING, &long).unwrap();
    simulation.ask_for_mesh_error(|companion| Box::new(Halting { companion, has_begun: false }));
    let (simulation, rows) = concluded(simulation);
    assert_eq!(rows.time.len(), 2);
    assert_eq!(simulation.mesh_errors(), []);
}

/// Whoever halts the run beside hears nothing of the mesh.
#[test]
fn a_halted_run_tells_nothing() {
    let mut simulation = Simulation::load("model.toml", SWING, &[]).unwrap();
    simulation.ask_for_mesh_error(|companion| Box::new(companion)).set();
    let (mut simulation, _) = concluded(simulation);
    assert_eq!(simulation.mesh_errors(), []);
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
    // Asked again, it compares again.
    let mut simulation = Simulation::load("model.toml", SWING, &[]).unwrap();
    simulation.ask_for_mesh_error(|companion| Box::new(companion)).set();
    simulation.ask_for_mesh_error(|companion| Box::new(companion));
    let (simulation, _) = concluded(simulation);
    assert!(!simulation.mesh_errors().is_empty());
}

/// A stiff wire that a frame pushes with jerk: the steps of the first run make an alternation that half the elements
/// have otherwise, by 8 % of the force. The last run has finer steps, and is compared with half the elements anew, which
/// have its steps. The force is `m a`; a percent is what a reader expects.
#[test]
fn repeated_runs_know_their_mesh_error_by_their_own_steps() {
    let text = "format = 1\n[model]\nname = \"Pushed\"\n\
         [material.steel]\nyoung = 60e9\npoisson = 0.3\ndensity = 6500\n\
         [section.wire]\nshape = \"circle\"\nradius = 0.0002\n\
         [beam.bar]\nmaterial = \"steel\"\nsection = \"wire\"\nfrom = [0, 0, 0]\nto = [0.3, 0, 0]\nelements = 12\n\
         [frame.push]\nposition = [\"0.2*t^3/6\", 0, 0]\n\
         [joint.grip]\ntype = \"weld\"\na = \"push\"\nb = \"bar.start\"\n\
         [output.pusher]\nat = \"push\"\nquantities = [\"reaction_force\"]\n\
         [simulation]\nstop = 2\noutput_step = 0.02\n";
    let (rows, outcome, simulation) = repeated(text, &["pusher.reaction_force[1]"], None);
    let mass = 6500.0 * std::f64::consts::PI * 0.0002 * 0.0002 * 0.3;
    for row in &rows {
        let exact = mass * 0.2 * row.time;
        assert!((row.values[0] - exact).abs() < 1e-2 * mass * 0.4, "{row:?} {exact}");
    }
    let force = simulation.mesh_errors().iter().find(|own| own.name == "pusher.reaction_force").expect("it is judged");
    println!("{} runs: {force:?}", outcome.runs);
    assert!(outcome.runs > 1 && force.error < 1e-2, "{outcome:?} {force:?}");
}
