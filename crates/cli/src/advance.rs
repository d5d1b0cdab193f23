//! A simulation row by row, with a bar that fills and warnings as they come.

use super::progress::bar;
use super::{Stop, complain, failed};
use ancf14::fmi::Model;
use ancf14::model::rows;
use ancf14::model::simulation::Simulation;

/// Simulates from the initial state, row 0, to the end, and lets `look` see each row. Warnings are told as they come, or
/// are `held`.
pub fn advance(
    simulation: &mut Simulation,
    last_row: u64,
    mut held: Option<&mut Vec<String>>,
    mut look: impl FnMut(u64, &Simulation) -> Result<(), Stop>,
) -> Result<(), Stop> {
    let bar = bar(last_row);
    let mut warn = |simulation: &mut Simulation| {
        for warning in simulation.take_warnings() {
            match &mut held {
                Some(held) => held.push(warning),
                None => bar.suspend(|| complain(&format!("warning: {warning}"))),
            }
        }
    };
    let outcome = (1..=last_row).try_for_each(|row| {
        let advanced = simulation.advance(rows::time(simulation.about(), row, last_row));
        warn(simulation);
        advanced.map_err(|failure| failed(simulation, &failure))?;
        look(row, simulation)?;
        bar.inc(1);
        Ok(())
    });
    bar.finish_and_clear();
    if outcome.is_ok() {
        simulation.conclude();
        warn(simulation);
    }
    outcome
}
