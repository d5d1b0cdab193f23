//! How many rows a run has, and the bar that counts them.

use super::{Stop, voice};
use ancf14::error::decimal;
use ancf14::fmi::Model;
use ancf14::model::entries::simulation::{SimulationSpec, Steps};
use ancf14::model::rows;
use ancf14::model::simulation::{Beginning, Simulation};
use indicatif::{ProgressBar, ProgressStyle};

/// A bar that fills with rows. A pipe gets none: indicatif draws on terminals only.
pub fn bar(last_row: u64) -> ProgressBar {
    if !voice::is_talkative() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}  {eta} left");
    ProgressBar::new(last_row).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// The rows of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plan {
    /// Time of row 0, s.
    pub begin: f64,
    /// Number of the row after it among those of a run from 0, and of the last one.
    pub rows: [u64; 2],
    /// How many rows there are besides row 0.
    pub count: u64,
}

/// The rows of a run that begins where the model file says, or with the state of another one.
pub fn plan(simulation: &Simulation, from: Option<&Beginning>) -> Result<Plan, Stop> {
    let (about, last) = (simulation.about(), last_row(simulation)?);
    let Some(from) = from else { return Ok(Plan { begin: about.start, rows: [1, last], count: last }) };
    let (begin, stop) = (from.time(), about.stop);
    let first = rows::first_after(about, begin, last).ok_or_else(|| {
        Stop::Bad(format!(
            "error: the state is at t = {} s, and the run ends at simulation.stop = {stop} s; give a later end, as in --set simulation.stop={}",
            decimal(begin),
            decimal(begin + stop)
        ))
    })?;
    Ok(Plan { begin, rows: [first, last], count: last - first + 1 })
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
