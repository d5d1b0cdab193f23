//! `view`: simulates as `run` does, and writes one HTML file that shows the mechanism move.

use super::output::{self, Input};
use super::progress::{bar, last_row};
use super::{Stop, complain, failed, page, say, start};
use ancf14::fmi::Model;
use ancf14::model::rows;
use ancf14::model::simulation::Simulation;
use ancf14_view::{Film, Live, ended_early};
use std::path::{Path, PathBuf};

/// Simulates and writes the page `file`; with `modes` the page shows so many natural modes about the initial state too, with `live` it has the solver.
pub fn view(
    mut simulation: Simulation,
    file: &Path,
    inputs: &[Input<'_>],
    modes: Option<u16>,
    live: Option<&Live>,
) -> Result<(), Stop> {
    output::spare(inputs, &[PathBuf::from(file)])?;
    let last_row = last_row(&simulation)?;
    let mut film = Film::new(&simulation, last_row);
    start(&mut simulation)?;
    film.look(0, &simulation);
    if let Some(count) = modes {
        let found = simulation.modes(usize::from(count)).map_err(|failure| failed(&simulation, &failure))?;
        found.warnings.iter().for_each(|warning| complain(&format!("warning: {warning}")));
        film.add_modes(&simulation, &found);
    }
    let outcome = simulate(&mut simulation, &mut film, last_row);
    if let Err(Stop::Failed(message)) = &outcome {
        film.note(&ended_early(simulation.time(), message));
    }
    let text = page(&film, live)?;
    output::write(file, text.as_bytes())?;
    let megabytes = text.len() as f64 / 1e6;
    say(&format!("{} instants, {megabytes:.2} MB: open {} in a browser", film.instants(), file.display()))?;
    outcome
}

fn simulate(simulation: &mut Simulation, film: &mut Film, last_row: u64) -> Result<(), Stop> {
    let bar = bar(last_row);
    let warn = |simulation: &mut Simulation| {
        for warning in simulation.take_warnings() {
            bar.suspend(|| complain(&format!("warning: {warning}")));
        }
    };
    let outcome = (1..=last_row).try_for_each(|row| {
        let advanced = simulation.advance(rows::time(simulation.about(), row, last_row));
        warn(simulation);
        advanced.map_err(|failure| failed(simulation, &failure))?;
        film.look(row, simulation);
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
