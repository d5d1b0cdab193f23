//! A chain of elements, clamped at one end, that falls under its weight: what a step costs over their number, and what
//! they occupy.

use crate::clock;
use crate::peer::Peer;
use crate::table::{Amount, Row};
use ancf14::fmi::Model;
use ancf14_testing::curves::load;
use std::process::Command;

/// Numbers of elements.
const SIZES: [usize; 4] = [10, 100, 1000, 10_000];
/// Integrators and tolerances: what a file has that says nothing; the peer's integrator, with a tolerance that stops at
/// what the step leaves anyway (see [`rows`]), so that a tangent a step is enough. The tangent is Newton's in both of
/// them.
pub const SETTINGS: [[&str; 2]; 2] = [["conserving", "1e-8"], ["generalized_alpha", "1e-4"]];
/// Steps of 1 ms at most.
const STEPS: u32 = 100;
/// CPU time of a size, s, after which no further step is taken, and no further run: all steps cost nearly the same.
const ENOUGH: f64 = 2.0;
/// Number of elements whose memory is measured: so many that what the program itself occupies is nothing.
const MANY: usize = 10_000;
/// Word of the command line that asks for the memory.
pub const MEMORY: &str = "--memory";

/// A square bar of steel, 2 m long.
pub fn model(elements: usize) -> String {
    format!(
        r#"
format = 1
model = {{ name = "Chain", gravity = [0, 0, -9.81] }}
material.steel = {{ young = 210e9, poisson = 0.3, density = 7800 }}
section.square = {{ shape = "rectangle", width = 0.02, height = 0.02 }}
beam.chain = {{ material = "steel", section = "square", from = [0, 0, 0], to = [2, 0, 0], elements = {elements}, strain = "small" }}
joint.root = {{ type = "weld", a = "ground", b = "chain.start" }}
simulation = {{ stop = 0.1, step = 1e-3, output_step = 1e-3 }}
"#
    )
}

/// Cost of a step, over the number of elements.
pub struct Cost {
    pub elements: usize,
    /// CPU time (s) and Newton iterations of a step with each of the settings.
    pub own: [(f64, f64); SETTINGS.len()],
    /// The peer's.
    pub peer: Option<f64>,
}

/// Least CPU time of a step of ours, s, and its iterations.
fn own(elements: usize, settings: [&str; 2]) -> (f64, f64) {
    let (begin, mut least) = (clock::cpu(), (f64::INFINITY, 0.0));
    while clock::cpu() - begin < ENOUGH {
        let run = falling(elements, settings);
        if run.0 < least.0 {
            least = run;
        }
    }
    least
}

/// Settings as keys of the model.
pub fn keys([integrator, tolerance]: [&str; 2]) -> [(&'static str, &str); 2] {
    [("simulation.integrator", integrator), ("simulation.tolerance", tolerance)]
}

/// CPU time (s) and iterations of a step, in the mean of a run.
fn falling(elements: usize, settings: [&str; 2]) -> (f64, f64) {
    let mut simulation = load(&model(elements), &keys(settings));
    let (begin, mut steps) = (clock::cpu(), 0);
    while steps < STEPS && clock::cpu() - begin < ENOUGH {
        steps += 1;
        simulation.advance(1e-3 * f64::from(steps)).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
    let iterations = simulation.state().statistics.iterations as f64;
    ((clock::cpu() - begin) / f64::from(steps), iterations / f64::from(steps))
}

/// CPU times of steps of both, and the memory of an element of the peer, bytes.
pub fn costs(peer: Option<&Peer>) -> (Vec<Cost>, Option<f64>) {
    let mut memory = None;
    let cost = |elements: usize| {
        let found = peer.map(|peer| peer.run("chain", &[&elements.to_string(), &STEPS.to_string()]));
        memory = found.as_ref().map(|found| found.curves.last("memory") / elements as f64);
        let peer = found.map(|found| found.seconds / f64::from(STEPS));
        Cost { elements, own: SETTINGS.map(|settings| own(elements, settings)), peer }
    };
    (SIZES.map(cost).into(), memory)
}

pub fn rows(costs: &[Cost], memory: Option<f64>) -> Vec<Row> {
    let mut rows = Vec::new();
    for (number, [integrator, tolerance]) in SETTINGS.into_iter().enumerate() {
        for cost in costs {
            let each = |time: f64| Amount::Time(time / cost.elements as f64);
            let (time, iterations) = cost.own[number];
            rows.push(Row {
                what: format!(
                    "chain of {} elements, {integrator}, tolerance {tolerance}, {iterations:.1} iterations a step, per element and step",
                    cost.elements
                ),
                ours: each(time),
                peer: cost.peer.map(|time| (each(time), String::from("generalized-alpha, modified Newton"))),
                goal: if cost.elements > 1000 { "4.5 us" } else { "3.5 us" },
                ..Row::default()
            });
        }
    }
    let coarse = departure(SETTINGS[0], "5e-4");
    for settings in &SETTINGS[1..] {
        let [integrator, tolerance] = settings;
        rows.push(Row {
            what: format!("chain of 100 elements, tip at 0.1 s: what {integrator} with tolerance {tolerance} changes; what half the step does"),
            errors: [format!("{:.2e} mm; {:.2e} mm", 1e3 * departure(*settings, "1e-3"), 1e3 * coarse), String::new()],
            goal: "less",
            ..Row::default()
        });
    }
    let program = std::env::current_exe().unwrap();
    // In a process of its own: what earlier rows have freed would hide it.
    let output = Command::new(program).arg(MEMORY).output().unwrap();
    let own = String::from_utf8_lossy(&output.stdout).trim().parse().map_or(Amount::Unknown, Amount::Memory);
    rows.push(Row {
        what: format!("memory of an element, chain of {MANY}, after {STEPS} steps"),
        ours: own,
        peer: memory.map(|memory| (Amount::Memory(memory), format!("after {STEPS} steps"))),
        goal: "5 kB",
        ..Row::default()
    });
    rows
}

/// How far the tip of a chain of 100 elements comes at the end from where the first settings bring it, m.
fn departure(settings: [&str; 2], step: &str) -> f64 {
    let tip = |settings: [&str; 2], step: &str| {
        let [integrator, tolerance] = keys(settings);
        let mut simulation = load(&model(100), &[integrator, tolerance, ("simulation.step", step)]);
        crate::runs::finish(&mut simulation);
        let state = simulation.state();
        let last = simulation.system().mesh.nodes.len() - 1;
        simulation.system().mesh.nodes[last].place(&state.q)
    };
    (tip(settings, step) - tip(SETTINGS[0], "1e-3")).norm()
}

/// Growth of the resident memory by building a long chain and its steps, bytes an element; empty where the system does
/// not say. From the second step on it stays the same.
pub fn memory() -> String {
    let Some(before) = clock::resident() else { return String::new() };
    let mut simulation = load(&model(MANY), &[]);
    crate::runs::finish(&mut simulation);
    clock::resident().map_or_else(String::new, |after| ((after - before) / MANY as f64).to_string())
}
