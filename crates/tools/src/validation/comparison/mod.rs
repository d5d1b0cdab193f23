//! ANCF24, the paper's comparator, beside ANCF14: the four benchmarks of the paper with both elements, same mesh, same
//! step.

pub mod equilibria;
pub mod motion;
pub mod time;

use super::{buckling, princeton, shaft, spring};
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::{Curves, load};
use princeton::Tip;

/// The words of `element` in a model file.
pub const ELEMENTS: [&str; 2] = ["ancf14", "ancf24"];

/// A benchmark of the paper, for either element.
pub struct Benchmark {
    pub name: &'static str,
    pub model: &'static str,
    /// The beams that are made of the element.
    pub beams: &'static [&'static str],
    /// The beam whose elements are counted; the others keep theirs.
    pub counted: &'static str,
    /// Elements of the paper.
    pub mesh: u32,
    /// Sets of keys, a run each.
    pub cases: fn() -> Vec<Vec<(&'static str, String)>>,
    /// Error of the runs against the benchmark's reference, as its own section measures it.
    pub error: fn(&[Curves]) -> f64,
    /// Until when the runs are compared, s.
    pub until: f64,
    /// CPU time of ANCF24 over that of ANCF14, as the paper prints it.
    pub printed: f64,
}

/// Seconds of the shaft that are compared: where its reference is good for 1e-4.
const SHAFT_UNTIL: f64 = 1.25;
/// Seconds of the buckling that are compared.
const BUCKLING_UNTIL: f64 = 0.2;

/// In the order of the paper.
pub const BENCHMARKS: [Benchmark; 4] = [
    Benchmark {
        name: "helical spring",
        model: spring::MODEL,
        beams: &["coil"],
        counted: "coil",
        mesh: 20,
        cases: || vec![spring::STEPS.map(|(key, value)| (key, value.to_owned())).to_vec()],
        error: |runs| spring::force_error(&runs[0]),
        until: f64::INFINITY,
        printed: 1.55,
    },
    Benchmark {
        name: "Princeton beam",
        model: princeton::MODEL,
        beams: &["arm"],
        counted: "arm",
        mesh: 8,
        cases: || princeton::reference().iter().map(|row| princeton::weight(row.0, row.1).to_vec()).collect(),
        error: |runs| princeton::error(&tips(runs), princeton::COMPONENTS[1].3),
        until: f64::INFINITY,
        printed: 1.59,
    },
    Benchmark {
        name: "rotating shaft",
        model: shaft::MODEL,
        beams: &["shaft"],
        counted: "shaft",
        mesh: 6,
        cases: || vec![vec![("simulation.stop", SHAFT_UNTIL.to_string())]],
        error: |runs| shaft::error(&runs[0], &Curves::read(shaft::REFERENCE), SHAFT_UNTIL),
        until: SHAFT_UNTIL,
        printed: 1.63,
    },
    Benchmark {
        name: "lateral buckling",
        model: buckling::MODEL,
        beams: &["strip", "link", "crank"],
        counted: "strip",
        mesh: 8,
        cases: || vec![vec![("simulation.stop", BUCKLING_UNTIL.to_string())]],
        error: |runs| {
            let (own, reference) = (&runs[0], Curves::read(buckling::REFERENCE));
            own.difference(&own.column("P.displacement[2]"), &reference.column("y"), BUCKLING_UNTIL)
        },
        until: BUCKLING_UNTIL,
        printed: 1.51,
    },
];

/// The tips of the Princeton beam's runs.
pub fn tips(runs: &[Curves]) -> Vec<Tip> {
    runs.iter().map(Tip::of).collect()
}

/// Sizes of the system of equations.
#[derive(Clone, Copy, Debug)]
pub struct Sizes {
    pub coordinates: usize,
    /// Coordinates and multipliers.
    pub unknowns: usize,
}

impl Benchmark {
    /// The keys of each run with an element and a mesh; `more` keys are added, or replace those of the benchmark.
    pub fn keys(&self, element: &str, elements: u32, more: &[(&str, &str)]) -> Vec<Vec<(String, String)>> {
        let mut common: Vec<(String, String)> =
            self.beams.iter().map(|beam| (format!("{beam}.element"), element.to_owned())).collect();
        common.push((format!("{}.elements", self.counted), elements.to_string()));
        let added = more.iter().map(|(key, value)| (key.to_string(), value.to_string()));
        let of_case = |case: Vec<(&str, String)>| {
            let kept = case.into_iter().filter(|(key, _)| more.iter().all(|(other, _)| other != key));
            let kept = kept.map(|(key, value)| (key.to_owned(), value));
            common.iter().cloned().chain(kept).chain(added.clone()).collect()
        };
        (self.cases)().into_iter().map(of_case).collect()
    }

    /// Its runs.
    pub fn run(&self, element: &str, elements: u32, more: &[(&str, &str)]) -> Vec<Curves> {
        self.keys(element, elements, more).iter().map(|keys| Curves::run(self.model, &borrowed(keys))).collect()
    }

    /// The first of its runs, at its start.
    pub fn start(&self, element: &str, elements: u32, more: &[(&str, &str)]) -> Simulation {
        load(self.model, &borrowed(&self.keys(element, elements, more)[0]))
    }

    /// How many unknowns it has.
    pub fn sizes(&self, element: &str, elements: u32, more: &[(&str, &str)]) -> Sizes {
        let simulation = self.start(element, elements, more);
        let system = simulation.system();
        Sizes { coordinates: system.coordinates(), unknowns: system.coordinates() + system.constraints() }
    }
}

/// Newton iterations of the runs, as far as they are compared.
pub fn iterations(benchmark: &Benchmark, runs: &[Curves]) -> f64 {
    let last = |run: &Curves| run.time.iter().rposition(|time| *time <= benchmark.until + 1e-9).unwrap();
    runs.iter().map(|run| run.column("statistics.iterations")[last(run)]).sum()
}

fn borrowed(keys: &[(String, String)]) -> Vec<(&str, &str)> {
    keys.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect()
}

/// A row of the table of the same mesh; `runs` are those of both elements.
pub fn same_mesh(benchmark: &Benchmark, runs: [&[Curves]; 2]) -> String {
    let sizes = ELEMENTS.map(|element| benchmark.sizes(element, benchmark.mesh, &[]));
    let [own, other] = runs.map(|runs| (iterations(benchmark, runs), (benchmark.error)(runs)));
    format!(
        "\n| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
        benchmark.name,
        benchmark.mesh,
        sizes[0].coordinates,
        sizes[1].coordinates,
        sizes[0].unknowns,
        sizes[1].unknowns,
        own.0,
        other.0,
        super::study::small(own.1),
        super::study::small(other.1)
    )
}

/// The head of that table.
pub const SAME_MESH: &str = "| | elements | coordinates, ANCF14 | ANCF24 | unknowns, ANCF14 | ANCF24 | Newton iterations, ANCF14 | ANCF24 | error, ANCF14 | ANCF24 |\n\
                             |---|---|---|---|---|---|---|---|---|---|";
