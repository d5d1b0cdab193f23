//! What both elements cost: CPU time, as ratios.

use super::super::{Section, study};
use super::{BENCHMARKS, Benchmark, ELEMENTS, borrowed};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::Curves;
use std::fmt::Write;

/// Rounds over all meshes: of each mesh the smallest time counts.
const ROUNDS: usize = 3;
/// Runs are repeated until they have taken this much CPU time together, s: the system counts in steps of some
/// milliseconds.
const LEAST: f64 = 0.3;
/// A run that takes more than this is timed once: other work of the machine averages out, s.
const LONG: f64 = 8.0;

/// Meshes that are timed, of both elements: the first that has the paper's number is the one of the same mesh.
const MESHES: [[&[u32]; 2]; 4] = [
    [&[20, 40, 80, 160], &[20, 40, 80, 160]],
    [&[2, 4, 8, 16], &[4, 8, 16, 32]],
    [&[2, 4, 6, 12], &[6, 12, 24, 48]],
    [&[4, 8, 16], &[8, 16, 32]],
];

/// A mesh: its error and its cost.
struct Cost {
    elements: u32,
    error: f64,
    /// CPU time, s.
    time: f64,
    iterations: f64,
}

pub fn write(section: &mut Section) {
    section.say(&format!(
        "CPU times of the runs above, as ratios; no run is exactly as long as the last, so that this section is not written anew with the others, but by \
         `cargo run --release --bin validation \"Two elements: time\"`. What is timed is the CPU time of the thread, from the initialization to the last step, reading and \
         building the model left out: the smallest of {ROUNDS} rounds, in which short runs are repeated for at least {LEAST} s and those longer than {LONG} s are made once. \
         From one writing to the next the ratios differ by up to a tenth or so. Linux only."
    ));
    let costs: Vec<[Vec<Cost>; 2]> =
        BENCHMARKS.iter().zip(MESHES).map(|(benchmark, meshes)| costs(benchmark, meshes)).collect();
    let rows = || BENCHMARKS.iter().zip(&costs);

    section.say("With the mesh of the paper, ANCF24 over ANCF14:");
    let mut table = String::from(
        "| | elements | unknowns | Newton iterations | CPU time an iteration | CPU time | CPU time, the paper |\n|---|---|---|---|---|---|---|",
    );
    for (benchmark, costs) in rows() {
        let sizes = ELEMENTS.map(|element| benchmark.sizes(element, benchmark.mesh, &[]).unknowns as f64);
        let [own, other] =
            costs.each_ref().map(|costs| costs.iter().find(|cost| cost.elements == benchmark.mesh).unwrap());
        let (iterations, time) = (other.iterations / own.iterations, other.time / own.time);
        // Writing into a String cannot fail.
        let _ = write!(
            table,
            "\n| {} | {} | {:.2} | {iterations:.2} | {:.2} | {time:.2} | {} |",
            benchmark.name,
            benchmark.mesh,
            sizes[1] / sizes[0],
            time / iterations,
            benchmark.printed
        );
    }
    section.say(&table);

    section.say(
        "ANCF24 costs more here than in the paper. The paper's ratios are near that of the coordinates of a node, 12 to 7. Here most of the time of a step goes into the \
         factorization of its matrix (a general sparse LU), which grows faster than the number of unknowns: with their number in a row of the matrix too. The Princeton beam needs more iterations as well: \
         each of its loads is put on in one step.",
    );
    section.say("Error and CPU time of all meshes; 1 is the time of ANCF14 with the mesh of the paper:");
    let mut table = String::from("| | element | elements | error | CPU time |\n|---|---|---|---|---|");
    for (benchmark, costs) in rows() {
        let unit = unit(benchmark, costs);
        for (element, costs) in ["ANCF14", "ANCF24"].into_iter().zip(costs) {
            for cost in costs {
                let (error, time) = (study::small(cost.error), cost.time / unit.time);
                let _ = write!(table, "\n| {} | {element} | {} | {error} | {time:.2} |", benchmark.name, cost.elements);
            }
        }
    }
    section.say(&table);

    section.say(
        "At equal error: what ANCF24 needs for the error that ANCF14 has with the mesh of the paper, between two meshes by straight lines through the logarithms; the other \
         way round, the coarsest mesh of ANCF14 in the table that is as good as the best of ANCF24:",
    );
    let mut table = String::from(
        "| | error of ANCF14 | ANCF24: elements | CPU time over that of ANCF14 | best error of ANCF24 | ANCF14 as good: elements | CPU time of ANCF24 over that |\n|---|---|---|---|---|---|---|",
    );
    for (benchmark, costs) in rows() {
        let unit = unit(benchmark, costs);
        let reached = match at_error(&costs[1], unit.error) {
            Some((elements, time)) => format!("{elements:.0} | {:.1}", time / unit.time),
            None => String::from("not reached | "),
        };
        let best = costs[1].iter().min_by(|a, b| a.error.total_cmp(&b.error)).unwrap();
        let as_good = costs[0].iter().find(|cost| cost.error <= best.error);
        let as_good =
            as_good.map_or(String::from(" | "), |own| format!("{} | {:.1}", own.elements, best.time / own.time));
        let _ = write!(
            table,
            "\n| {} | {} | {reached} | {}, {} elements | {as_good} |",
            benchmark.name,
            study::small(unit.error),
            study::small(best.error),
            best.elements
        );
    }
    section.say(&table);
    section.say(
        "Where it is not reached, the error is that of the theory, not of the mesh: the sections above say which. Of the mesh's own error their tables with the finest mesh tell.",
    );
}

/// ANCF14 with the mesh of the paper.
fn unit<'a>(benchmark: &Benchmark, costs: &'a [Vec<Cost>; 2]) -> &'a Cost {
    costs[0].iter().find(|cost| cost.elements == benchmark.mesh).unwrap()
}

/// Elements and CPU time (s) for an error, between the first mesh that is better and the one before it.
fn at_error(costs: &[Cost], error: f64) -> Option<(f64, f64)> {
    let after = costs.iter().position(|cost| cost.error <= error)?;
    let fine = &costs[after];
    let coarse = &costs[after.checked_sub(1)?];
    let part = (coarse.error / error).ln() / (coarse.error / fine.error).ln();
    let between = |coarse: f64, fine: f64| coarse * (fine / coarse).powf(part);
    Some((between(f64::from(coarse.elements), f64::from(fine.elements)), between(coarse.time, fine.time)))
}

/// Errors and smallest CPU times of all meshes of both elements.
fn costs(benchmark: &Benchmark, meshes: [&[u32]; 2]) -> [Vec<Cost>; 2] {
    let mut costs = [0, 1].map(|k| {
        let new = |n: &u32| Cost { elements: *n, error: 0.0, time: f64::INFINITY, iterations: 0.0 };
        meshes[k].iter().map(new).collect::<Vec<_>>()
    });
    for _ in 0..ROUNDS {
        // Both elements in turn, so that other work of the machine meets both.
        for (element, costs) in ELEMENTS.iter().zip(&mut costs) {
            for cost in costs {
                if !(LONG..f64::INFINITY).contains(&cost.time) {
                    let (runs, time) = timed(benchmark, element, cost.elements);
                    cost.time = cost.time.min(time);
                    (cost.error, cost.iterations) = ((benchmark.error)(&runs), super::iterations(benchmark, &runs));
                }
            }
        }
    }
    costs
}

/// The runs of a mesh, and the CPU time that they take together, s.
fn timed(benchmark: &Benchmark, element: &str, elements: u32) -> (Vec<Curves>, f64) {
    let keys = benchmark.keys(element, elements, &[]);
    let (mut total, mut count) = (0.0, 0.0);
    loop {
        let mut loaded: Vec<Simulation> = keys.iter().map(|keys| read(benchmark.model, &borrowed(keys))).collect();
        let begin = cpu();
        let runs: Vec<Curves> = loaded
            .iter_mut()
            .map(|simulation| {
                simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
                Curves::record(simulation)
            })
            .collect();
        (total, count) = (total + cpu() - begin, count + 1.0);
        if total >= LEAST {
            return (runs, total / count);
        }
    }
}

fn read(model: &str, keys: &[(&str, &str)]) -> Simulation {
    let keys: Vec<_> = keys.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    Simulation::load("model.toml", model, &keys).unwrap_or_else(|failure| panic!("{}", failure.message))
}

/// CPU time of this thread so far, s.
fn cpu() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    let nanoseconds: f64 = text.split_whitespace().next().unwrap().parse().unwrap();
    1e-9 * nanoseconds
}
