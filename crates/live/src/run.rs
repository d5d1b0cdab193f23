//! A run that goes on row by row, with its film and its warnings.

use ancf14::error::decimal;
use ancf14::fmi::{Failure, Model};
use ancf14::model::simulation::Simulation;
use ancf14::model::{notes, rows};
use ancf14_view::{Effort, Film, ended_early};
use serde_json::json;

/// A run under way.
#[derive(Debug)]
pub struct Run {
    simulation: Simulation,
    film: Film,
    row: u64,
    last_row: u64,
    warnings: Vec<String>,
    error: Option<String>,
}

impl Run {
    /// Finds the initial state of a simulation that has just been loaded, and natural modes about it.
    ///
    /// # Errors
    /// The solver finds none: its message.
    pub fn start(mut simulation: Simulation, last_row: u64, modes: Option<u16>) -> Result<Self, String> {
        let mut film = Film::new(&simulation, last_row);
        let mut warnings = notes::notes(simulation.document());
        let initialized = simulation.initialize(0.0);
        warnings.extend(simulation.take_warnings());
        initialized.map_err(|failure| told(&simulation, &failure))?;
        film.look(0, &simulation);
        if let Some(count) = modes {
            let found = simulation.judged_modes(usize::from(count)).map_err(|failure| told(&simulation, &failure))?;
            warnings.extend(found.warnings.iter().cloned());
            film.add_modes(&simulation, &found);
        }
        Ok(Self { simulation, film, row: 0, last_row, warnings, error: None })
    }

    /// Goes on by a row; whether it was the last one.
    ///
    /// # Errors
    /// The solver fails; [`Self::finish`] says why.
    pub fn advance(&mut self) -> Result<bool, ()> {
        if self.row < self.last_row {
            self.row += 1;
            let time = rows::time(self.simulation.about(), self.row, self.last_row);
            let advanced = self.simulation.advance(time);
            self.warnings.extend(self.simulation.take_warnings());
            if let Err(failure) = advanced {
                self.error = Some(told(&self.simulation, &failure));
                return Err(());
            }
            self.film.look(self.row, &self.simulation);
        }
        Ok(self.row == self.last_row)
    }

    /// Ends the run; one that is `stopped` says so. Returns JSON: warnings, the error if there was one, the data of the
    /// page.
    pub fn finish(mut self, stopped: bool) -> String {
        let time = self.simulation.time();
        match &self.error {
            Some(message) => self.film.note(&ended_early(time, message)),
            None if stopped => self.film.note(&format!("The run was stopped at t = {} s.", decimal(time))),
            None => {
                self.simulation.conclude();
                self.warnings.extend(self.simulation.take_warnings());
            }
        }
        match self.film.data(Effort::Soon) {
            Ok(data) => {
                let (warnings, error) = (json!(self.warnings), json!(self.error));
                format!("{{\"warnings\":{warnings},\"error\":{error},\"data\":{data}}}")
            }
            Err(reason) => json!({ "error": format!("error: the page cannot be written: {reason}") }).to_string(),
        }
    }
}

/// The message about a simulation that failed, with the line of the part that it names.
pub fn told(simulation: &Simulation, failure: &Failure) -> String {
    let located = simulation.document().locate(&failure.message);
    located.map_or_else(|| format!("error: {}", failure.message), |mistake| mistake.to_string())
}
