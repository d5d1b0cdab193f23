//! The costs of one mechanism: measured in a process of their own, passed on as numbers in a line.

use crate::clock;
use ancf14::fmi::Model;
use ancf14::mechanics::system::System;
use ancf14::model::simulation::Simulation;
use ancf14::solve::linear::elimination_tree::Fronts;
use ancf14::solve::newton::kkt::{self, Kkt};
use ancf14_testing::large::{Search, chain, comb, net};
use std::process::Command;

/// Words of the command line that ask for the costs of a motion and of an equilibrium.
pub const MOTION: &str = "--motion";
pub const EQUILIBRIUM: &str = "--equilibrium";

/// Steps of 1 ms at most, and the CPU time, s, after which no further one is taken.
const STEPS: u32 = 20;
const ENOUGH: f64 = 10.0;

fn model(kind: &str, size: usize, search: Search) -> String {
    match kind {
        "chain" => chain(size, search),
        "comb" => comb(size, search),
        _ => net(size, "spherical", search),
    }
}

fn load(kind: &str, size: usize, search: Search) -> Simulation {
    let text = model(kind, size, search);
    Simulation::load("model.toml", &text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message))
}

/// Multiplications of a factorization in a step; not a number where there are no fronts.
fn multiplications(system: &System) -> f64 {
    let kkt = Kkt::for_steps(system);
    let Some(fronts) = Fronts::new(kkt::unknowns(system, true), &kkt.blocks) else { return f64::NAN };
    let shapes = fronts.fronts.iter().map(|front| front.shape());
    shapes.flat_map(|own| own.border..own.border + own.pivots).map(|left| (left * left) as f64).sum()
}

/// Elements, CPU times (s) of loading, of the start and of a step, iterations of a step, multiplications of a
/// factorization, and memory (bytes), in a line.
pub fn motion(kind: &str, size: usize) -> String {
    let begin = clock::cpu();
    let mut simulation = load(kind, size, Search::Motion);
    let loaded = clock::cpu();
    simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let started = clock::cpu();
    let mut steps = 0;
    while steps < STEPS && clock::cpu() - started < ENOUGH {
        steps += 1;
        simulation.advance(1e-3 * f64::from(steps)).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
    let step = (clock::cpu() - started) / f64::from(steps);
    let memory = largest_memory();
    let system = simulation.system();
    let iterations = simulation.state().statistics.iterations as f64 / f64::from(steps);
    let elements = system.mesh.elements.len();
    let work = multiplications(system);
    format!("{elements} {} {} {step} {iterations} {work} {memory}", loaded - begin, started - loaded)
}

/// CPU time (s) of the first equilibrium, its iterations, and memory (bytes), in a line; nothing where none is found.
pub fn equilibrium(kind: &str, size: usize) -> String {
    let mut simulation = load(kind, size, Search::Equilibrium);
    let mut found = true;
    let time = clock::timed(|| found = simulation.initialize(0.0).is_ok());
    if found {
        format!("{time} {} {}", simulation.state().statistics.iterations, largest_memory())
    } else {
        String::new()
    }
}

/// The largest resident memory of this process so far, bytes; not a number where the system does not say.
fn largest_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:"));
    line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok()).map_or(f64::NAN, |number| 1024.0 * number)
}

/// What a mechanism costs.
pub struct Costs {
    /// What [`motion`] tells.
    motion: Vec<f64>,
    /// What [`equilibrium`] tells.
    equilibrium: Vec<f64>,
}

impl Costs {
    /// Of a mechanism; `is_short`: its equilibrium takes little enough time to look for it.
    pub fn of(kind: &str, size: usize, is_short: bool) -> Self {
        let numbers = |word: &str| -> Vec<f64> {
            let program = std::env::current_exe().unwrap();
            let output = Command::new(program).args([word, kind, &size.to_string()]).output().unwrap();
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            text.split_whitespace().map(|number| number.parse().unwrap()).collect()
        };
        Self { motion: numbers(MOTION), equilibrium: if is_short { numbers(EQUILIBRIUM) } else { Vec::new() } }
    }

    /// CPU time of the equilibrium, s, where one was found.
    pub fn equilibrium(&self) -> Option<f64> {
        self.equilibrium.first().copied()
    }

    /// Its row of the table; exponents are those from `last` on.
    pub fn line(&self, kind: &str, last: Option<&Self>) -> String {
        let [elements, load, start, step, iterations, work, memory] = self.motion[..] else {
            return format!("| {kind} | not run |");
        };
        let exponents = last.map_or_else(String::new, |last| {
            let sizes = (elements / last.motion[0]).ln();
            let exponent = |own: Option<&f64>, before: Option<&f64>| match (own, before) {
                (Some(own), Some(before)) => format!("{:.2}", (own / before).ln() / sizes),
                _ => String::from("-"),
            };
            let of_motion = [1, 2, 3, 5, 6].map(|number| exponent(self.motion.get(number), last.motion.get(number)));
            let of_equilibrium = exponent(self.equilibrium.first(), last.equilibrium.first());
            format!("{}, {of_equilibrium}", of_motion.join(", "))
        });
        let found = match self.equilibrium[..] {
            [time, iterations, memory] => format!("{} | {iterations} | {}", seconds(time), megabytes(memory)),
            _ => String::from("- | - | -"),
        };
        format!(
            "| {kind} | {elements} | {} | {} | {} | {iterations:.1} | {work:.1e} | {} | {found} | {exponents} |",
            seconds(load),
            seconds(start),
            seconds(step),
            megabytes(memory)
        )
    }
}

fn seconds(time: f64) -> String {
    if time < 1.0 { format!("{:.2} ms", 1e3 * time) } else { format!("{time:.2} s") }
}

fn megabytes(memory: f64) -> String {
    format!("{:.0} MB", memory / 1e6)
}
