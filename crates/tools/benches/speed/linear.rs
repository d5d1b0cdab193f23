//! The linear system of a step of a chain: factorized and solved with once.

use crate::chain;
use crate::clock;
use crate::table::{Amount, Row};
use ancf14::mechanics::input::excitation::Excitation;
use ancf14::mechanics::marker::configuration::Passage;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::mechanics::system::mass::MassAt;
use ancf14::model::simulation::Simulation;
use ancf14::solve::newton::kkt::Kkt;
use ancf14_testing::curves::load;

/// Numbers of elements: with 7 coordinates a node some 1,000, 10,000 and 100,000 unknowns.
const SIZES: [usize; 3] = [142, 1428, 14_285];
/// Length of the step whose matrix it is, s.
const STEP: f64 = 1e-3;

/// The matrix of a step, and a right side.
pub struct Step {
    simulation: Simulation,
    kkt: Kkt,
    right: Vec<f64>,
    vector: Vec<f64>,
}

impl Step {
    /// Of a chain of `elements`, each 0.1 m long, at rest.
    pub fn new(elements: usize) -> Self {
        let length = (0.1 * elements as f64).to_string();
        let simulation = load(&chain::model(elements), &[("chain.to[1]", &length)]);
        let (system, state) = (simulation.system(), simulation.state());
        let mut frames = FrameCache::default();
        let c = frames.of(system, state);
        let mut excitation = Excitation::default();
        system.excite(state.time, &state.targets, &mut excitation);
        let mut right = vec![0.0; system.coordinates()];
        let mut kkt = Kkt::for_steps(system);
        let scale = 0.25 * STEP * STEP;
        system.forces_and_tangent(&c, &Passage::Rest, &excitation, scale, &mut right, &mut kkt.blocks);
        system.add_mass(MassAt::CONSTANT, 1.0, &mut kkt.blocks);
        let mut gradients = Vec::new();
        system.constraint_gradients(&c, &mut gradients);
        kkt.set_constraints(system, &gradients, &gradients, 1.0);
        right.resize(system.coordinates() + system.constraints(), 0.0);
        Self { simulation, kkt, vector: right.clone(), right }
    }

    /// How many unknowns it has.
    pub fn unknowns(&self) -> usize {
        self.right.len()
    }

    /// Factorizes and solves.
    pub fn solve(&mut self) {
        self.vector.copy_from_slice(&self.right);
        self.kkt.solve(self.simulation.system(), &mut self.vector, 0.0).unwrap();
    }
}

pub fn rows() -> Vec<Row> {
    let mut measured = Vec::new();
    let mut rows = Vec::new();
    for elements in SIZES {
        let mut step = Step::new(elements);
        let unknowns = step.unknowns() as f64;
        let time = clock::least_call(1, || step.solve());
        measured.push((unknowns, time));
        rows.push(Row {
            what: format!("factorize and solve, chain of {unknowns} unknowns, per unknown"),
            ours: Amount::Time(time / unknowns),
            goal: "80 ns",
            ..Row::default()
        });
    }
    let [first, .., last] = &measured[..] else { unreachable!("there are three sizes") };
    rows.push(Row {
        what: String::from("exponent of that time over the unknowns"),
        ours: Amount::Number((last.1 / first.1).ln() / (last.0 / first.0).ln()),
        goal: "below 1.05",
        ..Row::default()
    });
    rows
}
