//! `view`: simulates as `run` does, and writes one HTML file that shows the mechanism move.

use super::advance::advance;
use super::output::{self, Input};
use super::progress::last_row;
use super::{Stop, complain, failed, page, say, start};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14_view::{Film, Live, ended_early};
use std::path::{Path, PathBuf};

/// Simulates and writes the page `file`; with `modes` the page shows so many natural modes about the initial state too, with `live` it has the solver.
pub fn view(
    simulation: Simulation,
    file: &Path,
    inputs: &[Input<'_>],
    modes: Option<u16>,
    live: Option<&Live>,
) -> Result<(), Stop> {
    output::spare(inputs, &[PathBuf::from(file)])?;
    let (film, outcome) = filmed(simulation, modes, |_| Ok(()))?;
    let text = page(&film, live)?;
    output::write(file, text.as_bytes())?;
    let megabytes = text.len() as f64 / 1e6;
    say(&format!("{} instants, {megabytes:.2} MB: open {} in a browser", film.instants(), file.display()))?;
    outcome
}

/// What there is to see of a simulation, of one that fails up to the failure. `look` is told the share of the rows that are done.
pub fn filmed(
    mut simulation: Simulation,
    modes: Option<u16>,
    mut look: impl FnMut(f64) -> Result<(), Stop>,
) -> Result<(Film, Result<(), Stop>), Stop> {
    let last_row = last_row(&simulation)?;
    let mut film = Film::new(&simulation, last_row);
    start(&mut simulation)?;
    film.look(0, &simulation);
    if let Some(count) = modes {
        let found = simulation.modes(usize::from(count)).map_err(|failure| failed(&simulation, &failure))?;
        found.warnings.iter().for_each(|warning| complain(&format!("warning: {warning}")));
        film.add_modes(&simulation, &found);
    }
    let outcome = advance(&mut simulation, last_row, |row, simulation| {
        film.look(row, simulation);
        look(row as f64 / last_row as f64)
    });
    if let Err(Stop::Failed(message)) = &outcome {
        film.note(&ended_early(simulation.time(), message));
    }
    Ok((film, outcome))
}
