//! From instantiating the unit of the rotating shaft to the end of its first step: reading, building, equilibrium,
//! step.

use crate::clock;
use crate::table::{Amount, Row};
use ancf14::fmi::instance::Instance;
use ancf14::model::simulation::Simulation;

const MODEL: &str = include_str!("../../../../models/rotating_shaft.toml");
/// First communication step, s.
const STEP: f64 = 1e-3;

/// What a host makes a unit do first. Without the C calls around it, which cost 0.1 microseconds each
/// (benches/overhead.rs).
fn first_step() {
    let model = Simulation::load("model.toml", MODEL, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    let mut instance = Instance::new(model, false);
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    instance.do_step(0.0, STEP).unwrap();
}

pub fn rows() -> Vec<Row> {
    vec![Row {
        what: String::from("unit of the rotating shaft: from instantiation to the end of the first step"),
        ours: Amount::Time(clock::least_call(1, first_step)),
        goal: "1 ms",
        ..Row::default()
    }]
}
