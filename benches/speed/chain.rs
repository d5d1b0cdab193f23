//! A chain of elements, clamped at one end, that falls under its weight: what a step costs over their number, and what they occupy.

use crate::clock;
use crate::curves::load;
use crate::peer::Peer;
use crate::table::{Amount, Row};
use ancf14::fmi::Model;
use std::process::Command;

/// Numbers of elements.
const SIZES: [usize; 4] = [10, 100, 1000, 10_000];
/// With Newton's exact tangent at every iteration, and with a tolerance that stops at what the step leaves anyway (see [`rows`]): a single tangent.
const TOLERANCES: [&str; 2] = ["1e-8", "1e-4"];
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
    /// CPU time of a step with each tolerance, s.
    pub own: [f64; 2],
    /// Newton iterations of a step with each.
    pub iterations: [f64; 2],
    /// The peer's.
    pub peer: Option<f64>,
}

/// Least CPU time of a step of ours, s, and its iterations.
fn own(elements: usize, tolerance: &str) -> (f64, f64) {
    let (begin, mut least) = (clock::cpu(), (f64::INFINITY, 0.0));
    while clock::cpu() - begin < ENOUGH {
        let run = falling(elements, tolerance);
        if run.0 < least.0 {
            least = run;
        }
    }
    least
}

/// CPU time (s) and iterations of a step, in the mean of a run.
fn falling(elements: usize, tolerance: &str) -> (f64, f64) {
    let mut simulation = load(&model(elements), &[("simulation.tolerance", tolerance)]);
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
        let [exact, loose] = TOLERANCES.map(|tolerance| own(elements, tolerance));
        let peer = found.map(|found| found.seconds / f64::from(STEPS));
        Cost { elements, own: [exact.0, loose.0], iterations: [exact.1, loose.1], peer }
    };
    (SIZES.map(cost).into(), memory)
}

pub fn rows(costs: &[Cost], memory: Option<f64>) -> Vec<Row> {
    let mut rows = Vec::new();
    for (number, tolerance) in TOLERANCES.into_iter().enumerate() {
        for cost in costs {
            let each = |time: f64| Amount::Time(time / cost.elements as f64);
            rows.push(Row {
                what: format!(
                    "chain of {} elements, tolerance {tolerance}, {:.1} iterations a step, per element and step",
                    cost.elements, cost.iterations[number]
                ),
                ours: each(cost.own[number]),
                peer: cost.peer.map(|time| (each(time), String::from("modified Newton"))),
                goal: ["4 us", "1.3 us with a kept tangent"][number],
                ..Row::default()
            });
        }
    }
    let [loose, coarse] = departures();
    rows.push(Row {
        what: String::from(
            "chain of 100 elements, tip at 0.1 s: what the loose tolerance changes; what half the step changes",
        ),
        errors: [format!("{:.2e} mm; {:.2e} mm", 1e3 * loose, 1e3 * coarse), String::new()],
        goal: "less",
        ..Row::default()
    });
    let program = std::env::current_exe().unwrap();
    // In a process of its own: what earlier rows have freed would hide it.
    let output = Command::new(program).arg(MEMORY).output().unwrap();
    let own = String::from_utf8_lossy(&output.stdout).trim().parse().map_or(Amount::Unknown, Amount::Memory);
    rows.push(Row {
        what: format!("memory of an element, chain of {MANY}, after a step"),
        ours: own,
        peer: memory.map(|memory| (Amount::Memory(memory), String::from("after 100 steps"))),
        goal: "4 kB",
        ..Row::default()
    });
    rows
}

/// How far the tip of a chain of 100 elements is off at the end, m: by the loose tolerance, and by the step itself, against half of it.
fn departures() -> [f64; 2] {
    let tip = |keys: &[(&str, &str)]| {
        let mut simulation = load(&model(100), keys);
        crate::runs::finish(&mut simulation);
        let state = simulation.state();
        let last = simulation.system().mesh.nodes.len() - 1;
        simulation.system().mesh.nodes[last].place(&state.q)
    };
    let exact = tip(&[]);
    [("simulation.tolerance", TOLERANCES[1]), ("simulation.step", "5e-4")].map(|key| (tip(&[key]) - exact).norm())
}

/// Growth of the resident memory by building a long chain and its first step, bytes an element; empty where the system does not say.
pub fn memory() -> String {
    let Some(before) = clock::resident() else { return String::new() };
    let mut simulation = load(&model(MANY), &[]);
    simulation.advance(1e-3).unwrap_or_else(|failure| panic!("{}", failure.message));
    clock::resident().map_or_else(String::new, |after| ((after - before) / MANY as f64).to_string())
}
