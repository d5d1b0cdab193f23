//! One element: its forces, and with their derivatives; a step of a system of them beside the same of the paper's
//! comparator, ANCF24.

use crate::clock;
use crate::runs;
use crate::shaft;
use crate::table::{Amount, Row};
use ancf14::mechanics::beam::configuration::{BeamConfiguration, Passage};
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::load;
use std::hint::black_box;

const MODEL: &str = include_str!("../../../../models/princeton_beam.toml");

/// The strip at its largest deflection: bent about both axes and twisted, so that nothing vanishes.
const BENT: [(&str, &str); 2] = [("P", "13.345"), ("arm.strain", "large")];
/// Calls in a round, of all elements in turn.
const CALLS: usize = 2000;

/// Steps of the shaft that both elements take, in a row; the start from equilibrium is left out.
const STEPS: [(&str, &str); 2] = [("simulation.stop", "0.1"), ("simulation.integrator", "conserving")];
const ELEMENTS: [&str; 2] = ["ancf14", "ancf24"];

/// A bent beam.
pub struct Bent {
    simulation: Simulation,
    frames: FrameCache,
    forces: Vec<f64>,
    block: Vec<f64>,
}

impl Bent {
    pub fn new(element: &str) -> Self {
        let keys: Vec<_> = BENT.into_iter().filter(|(key, _)| element == "ancf14" || *key != "arm.strain").collect();
        let mut simulation = load(MODEL, &[&keys[..], &[("arm.element", element)]].concat());
        runs::finish(&mut simulation);
        let (system, state) = (simulation.system(), simulation.state());
        let mut frames = FrameCache::default();
        frames.set(system, &state.q, &state.triads);
        let size = system.mesh.elements[0].coordinates().len();
        Self { forces: vec![0.0; system.coordinates()], block: vec![0.0; size * size], frames, simulation }
    }

    /// How many elements it has.
    pub fn elements(&self) -> usize {
        self.simulation.system().mesh.elements.len()
    }

    /// The gradient of each element.
    pub fn gradients(&mut self) {
        let Self { simulation, frames, forces, .. } = self;
        let c = configuration(simulation, frames);
        for element in &simulation.system().mesh.elements {
            element.add_gradient(&c, &Passage::Rest, black_box(forces));
        }
    }

    /// The gradient and the Hessian of each element.
    pub fn hessians(&mut self) {
        let Self { simulation, frames, forces, block } = self;
        let c = configuration(simulation, frames);
        for element in &simulation.system().mesh.elements {
            element.add_gradient_and_set_hessian(&c, &Passage::Rest, 1.0, forces, black_box(block));
        }
    }
}

fn configuration<'a>(simulation: &'a Simulation, frames: &'a FrameCache) -> BeamConfiguration<'a> {
    let state = simulation.state();
    simulation.system().configuration(&state.q, frames, state, &state.prescribed).beams
}

pub fn rows() -> Vec<Row> {
    let [own, other] = ELEMENTS.map(|element| {
        let mut bent = Bent::new(element);
        let elements = bent.elements() as f64;
        let gradient = clock::least_call(CALLS, || bent.gradients()) / elements;
        let hessian = clock::least_call(CALLS, || bent.hessians()) / elements;
        [gradient, hessian]
    });
    let model = shaft::model();
    let [own_step, other_step] = ELEMENTS.map(|element| {
        let keys = [&STEPS[..], &[("shaft.element", element)]].concat();
        runs::stepping(&model, &keys)
    });
    let beside = |time: f64| Some((Amount::Time(time), String::from("ANCF24")));
    let kernel = |what: &str, k: usize, goal| Row {
        what: format!("one element: {what}"),
        ours: Amount::Time(own[k]),
        peer: beside(other[k]),
        goal,
        ..Row::default()
    };
    let step = Row {
        what: String::from("rotating shaft, 6 elements, 200 steps to 0.1 s"),
        ours: Amount::Time(own_step),
        peer: beside(other_step),
        goal: "2 times",
        ..Row::default()
    };
    vec![kernel("gradient", 0, "0.3 us"), kernel("gradient and Hessian", 1, "1.5 us"), step]
}
