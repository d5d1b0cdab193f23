//! `run`: initialize, advance from row to row, write, plot, and say what it took.

use super::results::Results;
use super::{Stop, complain, plot, say};
use ancf14::error::decimal;
use ancf14::fmi::{Failure, Model};
use ancf14::model::simulation::Simulation;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::Path;
use std::time::Instant;

/// An output step may miss the end by its round-off without making a row of its own, in output steps.
const ROUNDING: f64 = 1e-9;

/// Simulates and writes everything into `directory`.
pub fn run(mut simulation: Simulation, directory: &Path) -> Result<(), Stop> {
    std::fs::create_dir_all(directory).map_err(|reason| trouble(&directory.display().to_string(), &reason))?;
    let path = directory.join("results.csv");
    let shown = path.display().to_string();
    let mut results = Results::create(&path, simulation.variables()).map_err(|reason| trouble(&shown, &reason))?;

    let clock = Instant::now();
    let outcome = simulate(&mut simulation, &mut results);
    let wall = clock.elapsed().as_secs_f64();
    results.flush().map_err(|reason| trouble(&shown, &reason))?;
    let plots = plot::plots(&results, directory).map_err(|reason| trouble("the plots", &reason))?;
    let reached = results.times.last().copied();
    if let Some(reached) = reached {
        say(&summary(&results, reached, wall));
        say(&format!("{} rows in {shown}, {plots} plots beside it", results.rows.len()));
    }
    match (outcome, reached) {
        (Ok(()), _) => Ok(()),
        (Err(Interruption::Write(reason)), _) => Err(trouble(&shown, &reason)),
        (Err(Interruption::Model(failure)), Some(reached)) => {
            Err(Stop::Failed(format!("error: {}\nthe rows up to t = {} s are kept", failure.message, decimal(reached))))
        }
        (Err(Interruption::Model(failure)), None) => Err(Stop::Failed(format!("error: {}", failure.message))),
    }
}

/// What cannot be written.
pub fn trouble(what: &str, reason: &dyn std::fmt::Display) -> Stop {
    Stop::Failed(format!("error: cannot write {what}: {reason}"))
}

/// What ends a run early.
enum Interruption {
    Model(Failure),
    Write(std::io::Error),
}

fn simulate(simulation: &mut Simulation, results: &mut Results) -> Result<(), Interruption> {
    let (stop, step) = (simulation.about().stop, simulation.about().output_step);
    let rows = last_row(stop, step);
    let bar = ProgressBar::new(rows);
    // A pipe gets no bar: indicatif draws on terminals only.
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}  {eta} left");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    simulation.initialize(0.0).map_err(Interruption::Model)?;
    warn(simulation, &bar);
    results.record(0.0, simulation).map_err(Interruption::Write)?;
    for row in 1..=rows {
        let time = if row == rows { stop } else { row as f64 * step };
        let advanced = simulation.advance(time);
        warn(simulation, &bar);
        if let Err(failure) = advanced {
            bar.finish_and_clear();
            return Err(Interruption::Model(failure));
        }
        results.record(time, simulation).map_err(Interruption::Write)?;
        bar.set_message(format!("t = {time:.4} s"));
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}

/// Number of the last row; row 0 is the start.
fn last_row(stop: f64, step: f64) -> u64 {
    ((stop / step - ROUNDING).ceil() as u64).max(1)
}

fn warn(simulation: &mut Simulation, bar: &ProgressBar) {
    for warning in simulation.take_warnings() {
        bar.suspend(|| complain(&format!("warning: {warning}")));
    }
}

/// What it took.
fn summary(results: &Results, reached: f64, wall: f64) -> String {
    let count = |name: &str| results.last(name).unwrap_or(0.0);
    let (steps, iterations, rejected) =
        (count("statistics.steps"), count("statistics.iterations"), count("statistics.rejected"));
    let speed = if wall > 0.0 { reached / wall } else { f64::INFINITY };
    format!(
        "t = {} s: {steps} steps, {iterations} Newton iterations, {rejected} rejected, \
         {wall:.3} s wall time, {speed:.3} x real time",
        decimal(reached)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The last row is at the end, no row twice, also where the division is not exact.
    #[test]
    fn rows_end_at_the_stop() {
        assert_eq!(last_row(0.5, 1e-3), 500);
        assert_eq!(last_row(0.3, 0.1), 3);
        assert_eq!(last_row(1.0, 0.3), 4);
        assert_eq!(last_row(0.1, 1.0), 1);
        assert_eq!(last_row(10.0, 1e-4), 100_000);
    }
}
