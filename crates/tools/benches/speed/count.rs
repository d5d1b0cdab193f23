//! A kernel, so many times and nothing else: for counters of instructions (scripts/instructions.sh,
//! scripts/profile.sh).

use crate::chain;
use crate::element::Bent;
use crate::linear::Step;
use crate::princeton::Load;
use crate::shaft;
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::load;

/// Elements of the chain whose matrix is factorized, and of the one that falls.
const CHAIN: usize = 100;

/// The names of the kernels.
pub const KERNELS: [&str; 9] = [
    "gradient",
    "hessian",
    "factorization",
    "equilibrium",
    "shaft",
    "chain",
    "damped_chain",
    "alpha_chain",
    "damped_alpha_chain",
];

/// Runs `kernel` as often as `text` says, and returns how many results a run has.
pub fn run(kernel: &str, text: &str) -> usize {
    let times: usize = text.parse().unwrap_or_else(|_| panic!("{text} is not a number of runs"));
    let mut step;
    let mut bent;
    let mut simulation;
    let load_alone;
    let (parts, mut work): (usize, Box<dyn FnMut()>) = match kernel {
        "factorization" => {
            step = Step::new(CHAIN);
            (step.unknowns(), Box::new(|| step.solve()))
        }
        "equilibrium" => {
            load_alone = Load::new();
            (1, Box::new(|| load_alone.bear()))
        }
        "shaft" => {
            simulation = load(&shaft::model(), &shaft::OWN);
            (shaft::STEPS_AN_OUTPUT, Box::new(outputs(&mut simulation)))
        }
        "chain" | "damped_chain" | "alpha_chain" | "damped_alpha_chain" => {
            let damping = ("material.steel.damping", if kernel.starts_with("damped") { "1e-4" } else { "0" });
            let [integrator, tolerance] = chain::keys(chain::SETTINGS[usize::from(kernel.contains("alpha"))]);
            simulation = load(&chain::model(CHAIN), &[damping, integrator, tolerance]);
            (CHAIN, Box::new(outputs(&mut simulation)))
        }
        _ => {
            bent = Bent::new("ancf14");
            let elements = bent.elements();
            match kernel {
                "gradient" => (elements, Box::new(|| bent.gradients())),
                "hessian" => (elements, Box::new(|| bent.hessians())),
                _ => panic!("no kernel is called {kernel}; there are {}", KERNELS.join(", ")),
            }
        }
    };
    (0..times).for_each(|_| work());
    parts
}

/// Brings `simulation` to its next output.
fn outputs(simulation: &mut Simulation) -> impl FnMut() {
    let output_step = simulation.about().output_step;
    let mut number = 0;
    move || {
        number += 1;
        simulation.advance(f64::from(number) * output_step).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
}
