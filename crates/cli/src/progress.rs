//! How many rows a run has, and the bar that counts them.

use super::{Stop, voice};
use ancf14::fmi::Model;
use ancf14::model::entries::simulation::{SimulationSpec, Steps};
use ancf14::model::rows;
use ancf14::model::simulation::Simulation;
use indicatif::{ProgressBar, ProgressStyle};

/// A bar that fills with rows. A pipe gets none: indicatif draws on terminals only.
pub fn bar(last_row: u64) -> ProgressBar {
    if !voice::is_talkative() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}  {eta} left");
    ProgressBar::new(last_row).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// Number of the last row of results; row 0 is the start. Too many rows are a mistake of the file.
pub fn last_row(simulation: &Simulation) -> Result<u64, Stop> {
    let about = simulation.about();
    if let Some(last) = rows::last(about) {
        return Ok(last);
    }
    let (stop, step) = (about.stop, about.output_step);
    let document = simulation.document();
    let message =
        format!("the run would write {:.1e} rows of results, at most {:.0e} are possible", stop / step, rows::MOST);
    let label = format!("a row every {step:e} s, to {stop} s");
    let help = "give a larger simulation.output_step";
    let SimulationSpec { stop, steps, output_step, .. } = &document.simulation;
    let place = document.place(output_step.unwrap_or(if let Steps::Fixed(step) = steps { *step } else { *stop }));
    let mistake = document.diagnostic(place, &message, &label, help);
    Err(Stop::Bad(mistake.to_string()))
}
