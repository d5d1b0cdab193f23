//! A kernel, so many times and nothing else: for counters of instructions (scripts/instructions.sh).

use crate::element::Bent;
use crate::linear::Step;

/// Elements of the chain whose matrix is factorized.
const CHAIN: usize = 100;

/// The names of the kernels.
pub const KERNELS: [&str; 3] = ["gradient", "hessian", "factorization"];

/// Runs `kernel` as often as `text` says, and returns how many results a run has.
pub fn run(kernel: &str, text: &str) -> usize {
    let times: usize = text.parse().unwrap_or_else(|_| panic!("{text} is not a number of runs"));
    let mut step;
    let mut bent;
    let (parts, mut work): (usize, Box<dyn FnMut()>) = match kernel {
        "factorization" => {
            step = Step::new(CHAIN);
            (step.unknowns(), Box::new(|| step.solve()))
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
