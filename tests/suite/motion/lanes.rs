//! Results must not depend on the width of the processor's lanes: kernels in lanes of four doubles make the operations of those in lanes of two, in the same order. A fused multiplication
//! and addition, or a sum in another order, would change the last digits, and a host on another computer would not compute what `ancf14 run` does.

use crate::curves::load;
use ancf14::fmi::Model;
use ancf14::math::lanes;

/// Keys of a model file and their values.
type Keys = [(&'static str, &'static str)];

/// Small and large strain, linear and quadratic twist, all solvers, damping, bodies, joints, fronts of many sizes; how many rows of each.
const RUNS: [(&str, &str, &Keys, u32); 8] = [
    ("rotating_shaft", include_str!("../../../models/rotating_shaft.toml"), &[], 20),
    ("lateral_buckling", include_str!("../../../models/lateral_buckling.toml"), &[], 20),
    ("four_bar", include_str!("../../../models/four_bar.toml"), &[("simulation.integrator", "generalized_alpha")], 10),
    ("cantilever", include_str!("../../../models/cantilever.toml"), &[], 10),
    ("pendulum", include_str!("../../../models/pendulum.toml"), &[("material.steel.damping", "1e-3")], 10),
    ("crane", include_str!("../../../models/crane.toml"), &[], 10),
    ("princeton_beam", include_str!("../../../models/princeton_beam.toml"), &[("arm.strain", "large")], 1),
    ("helical_spring", include_str!("../../../models/helical_spring.toml"), &[], 1),
];

/// All values of all rows as bits.
fn bits(text: &str, keys: &Keys, rows: u32) -> Vec<u64> {
    let mut simulation = load(text, keys);
    let (start, step) = (simulation.time(), simulation.about().output_step);
    let mut all = Vec::new();
    for row in 0..=rows {
        if row > 0 {
            simulation.advance(start + f64::from(row) * step).unwrap_or_else(|failure| panic!("{}", failure.message));
        }
        all.extend((0..simulation.variables().len()).map(|place| simulation.value(place).number().to_bits()));
    }
    all
}

/// Other tests that run at the same time change their lanes too, and notice nothing.
#[test]
fn results_do_not_depend_on_the_lanes() {
    lanes::set_narrow(false);
    println!("lanes are wide: {}", lanes::are_wide());
    for (name, text, keys, rows) in RUNS {
        lanes::set_narrow(false);
        let widest = bits(text, keys, rows);
        lanes::set_narrow(true);
        let narrow = bits(text, keys, rows);
        lanes::set_narrow(false);
        assert_eq!(widest.len(), narrow.len());
        let apart = widest.iter().zip(&narrow).filter(|(widest, narrow)| widest != narrow).count();
        assert!(apart == 0, "{name}: {apart} of {} values differ", widest.len());
    }
}
