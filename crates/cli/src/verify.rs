//! `run --verify`: compares the rows of a run with those of other steps and meshes, and tells the errors: a table,
//! errors.csv and errors.svg.

use super::folder::Folder;
use super::keeper::{Keeper, interrupted};
use super::progress::bar;
use super::rows::{Shared, locked};
use super::{Stop, complain, output, say};
use ancf14::error::decimal;
use ancf14::fmi::Model;
use ancf14::model::rows;
use ancf14::model::run::levels::{Level, Override};
use ancf14::model::simulation::Simulation;
use ancf14::model::verification::estimate::{Limit, Order, Trust};
use ancf14::model::verification::{Report, Row, Verification};
use ancf14_report::bars::Bars;
use ancf14_report::errors;
use ancf14_report::numbers::shortest;
use std::fmt::Write;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

/// What is written.
pub const FILES: [&str; 2] = ["errors.csv", "errors.svg"];
/// The error that columns should not exceed where no other one is given, of their range: what a plot can just show.
pub const ACCURACY: f64 = 1e-3;
/// Columns of which the terminal tells.
const SHOWN: usize = 8;
/// Settings of which a message tells.
const SETTINGS: usize = 4;

/// That errors be told, with what the runs beside the first one are made of.
#[derive(Clone, Copy, Debug)]
pub struct Wish<'a> {
    /// The model file's name, for messages.
    pub file_name: &'a str,
    /// What is in it.
    pub text: &'a str,
    /// The overrides of the first run.
    pub overrides: &'a [Override],
    /// The error that columns should not exceed, relative.
    pub accuracy: f64,
}

/// The value of `--verify`.
pub fn accuracy(text: &str) -> Result<f64, String> {
    let accuracy = text.parse().ok().filter(|accuracy| (1e-12..1.0).contains(accuracy));
    accuracy.ok_or_else(|| String::from("a share of the range was expected, like 0.001"))
}

/// Estimates the errors of a run that has come to its end, with its rows in the file `written`.
pub fn verify(
    simulation: &Simulation,
    written: Shared,
    last_row: u64,
    folder: &Folder,
    wish: Wish<'_>,
) -> Result<(), Stop> {
    let mut verification = Verification::new(simulation, wish.file_name, wish.text, wish.overrides);
    if verification.runs() == 0 {
        return say("nothing to verify: an equilibrium without beams has neither steps nor elements");
    }
    let table = locked(&written).path.clone();
    let keeper =
        Keeper::start(written).map_err(|reason| Stop::Failed(format!("error: cannot watch for signals: {reason}")))?;
    let unread = |reason: &dyn std::fmt::Display| {
        Stop::Failed(format!("error: cannot read {} to verify it: {reason}", table.display()))
    };
    let mut rows = rows(&table).map_err(|reason| unread(&reason))?;
    let bar = bar(last_row + 1);
    bar.set_message(format!("{} runs to verify it", verification.runs()));
    for row in 0..=last_row {
        if let Some(signal) = keeper.signal() {
            bar.finish_and_clear();
            let message =
                format!("error: {}\nthe results are complete, their errors are not told", interrupted(signal));
            return Err(Stop::Interrupted(message, signal.exit_code()));
        }
        let values = rows.next().unwrap_or_else(|| Err(io::ErrorKind::UnexpectedEof.into()));
        let values = values.map_err(|reason| unread(&reason))?;
        verification.compare(row, rows::time(simulation.about(), row, last_row), &values);
        bar.inc(1);
    }
    bar.finish_and_clear();
    drop(keeper);
    let report = verification.report(simulation, wish.accuracy);
    tell(&report, &verification, folder)
}

/// The rows of a table of results, without their times.
fn rows(path: &Path) -> io::Result<impl Iterator<Item = io::Result<Vec<f64>>>> {
    let lines = BufReader::new(File::open(path)?).lines().skip(1);
    Ok(lines.map(|line| {
        let values = line?.split(',').skip(1).map(str::parse).collect::<Result<_, _>>();
        values.map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "a row is not made of numbers"))
    }))
}

/// Writes the files, and says what is worst.
fn tell(report: &Report, verification: &Verification, folder: &Folder) -> Result<(), Stop> {
    let mut worst: Vec<&Row> = report.counted().filter(|row| row.estimate.trust != Trust::RoundOff).collect();
    worst.sort_by(|a, b| b.relative().total_cmp(&a.relative()));
    let [table, picture] = FILES;
    folder.write(table, errors::csv(report))?;
    let svg = Bars::of(&worst, report.wanted).svg();
    folder.write(picture, &svg.map_err(|reason| output::trouble(&folder.file(picture), &reason))?)?;
    say(&shown(&worst, report, verification.runs()))?;
    say(&format!(
        "all {} columns in {} and {}",
        report.rows.len(),
        folder.file(table).display(),
        folder.file(picture).display()
    ))?;
    warnings(report).iter().for_each(|warning| complain(&format!("warning: {warning}")));
    Ok(())
}

/// The table of the terminal, the worst columns first.
fn shown(worst: &[&Row], report: &Report, runs: usize) -> String {
    let mut text = format!("errors, estimated by {runs} more runs:");
    let Some(_) = worst.first() else { return format!("{text} none above round-off") };
    let width = worst.iter().take(SHOWN).map(|row| row.name.len()).max().unwrap_or(0).max("column".len());
    // Writing into a String cannot fail.
    let _ = write!(
        text,
        "\n  {:width$}  {:>9}  {:>18}  {:>11}  {:>9}  {:>9}  limited by",
        "column", "of range", "error", "at t (s)", "step", "mesh"
    );
    for row in worst.iter().take(SHOWN) {
        let estimate = &row.estimate;
        let error = format!("{:.1e} {}", estimate.error(), row.unit);
        let _ = write!(
            text,
            "\n  {:width$}  {:>9}  {error:>18}  {:>11}  {:>9}  {:>9}  {}",
            row.name,
            percent(row.relative()),
            decimal(estimate.time),
            small(report.part(Level::HalfStep, estimate.step)),
            small(report.part(Level::DoubleElements, estimate.mesh)),
            limit(row),
        );
    }
    if let Some(next) = worst.get(SHOWN) {
        let _ = write!(text, "\n  and {} others, at most {}", worst.len() - SHOWN, percent(next.relative()));
    }
    text
}

/// What limits a column, and how fast that falls.
fn limit(row: &Row) -> String {
    let (limit, order) = (row.estimate.limit, row.estimate.order);
    let order = match order {
        // Adding zero takes the sign off a zero.
        Order::Observed(order) => format!("order {:.1} observed", (10.0 * order).round() / 10.0 + 0.0),
        Order::Assumed(order) => format!("order {order} assumed"),
    };
    match row.estimate.trust {
        Trust::Bound => format!("{}, {order}: a bound", limit.word()),
        Trust::Estimate | Trust::RoundOff => format!("{}, {order}", limit.word()),
    }
}

/// What the user should know: runs that failed, columns that miss the accuracy, and the remedy.
fn warnings(report: &Report) -> Vec<String> {
    let failed = report.failures.iter().map(|(level, reason)| {
        format!("the run with {} failed, and its part of the errors is unknown beyond: {reason}", level.words())
    });
    let mut warnings: Vec<String> = failed.collect();
    let missed: Vec<&Row> = report.counted().filter(|row| row.relative() > report.wanted).collect();
    let Some(worst) = missed.iter().max_by(|a, b| a.relative().total_cmp(&b.relative())) else { return warnings };
    let mut text = format!(
        "{} of {} columns miss {} of their range, {} by most, {}",
        missed.len(),
        report.counted().count(),
        percent(report.wanted),
        worst.name,
        percent(worst.relative())
    );
    // Writing into a String cannot fail.
    if let Some(settings) = report.remedy.as_ref().filter(|settings| !settings.is_empty()) {
        let _ = write!(text, "; take {}", joined(settings));
    }
    let stuck: Vec<&&Row> = missed.iter().filter(|row| row.remedy.is_none()).collect();
    if let Some(row) = stuck.iter().max_by(|a, b| a.relative().total_cmp(&b.relative())) {
        let (count, name, limit) = (stuck.len(), &row.name, row.estimate.limit);
        let _ = write!(text, "; for {count} of them, {name} first, no setting can be named: {}", obstacle(limit));
    }
    warnings.push(text);
    warnings
}

/// Why no setting reaches the accuracy, and what else to try.
fn obstacle(limit: Limit) -> &'static str {
    match limit {
        Limit::Step => {
            "their errors fall too slowly with the step, as where something oscillates faster than steps follow; give the material damping, or \
             let loads and drives begin smoothly"
        }
        Limit::Elements | Limit::Twist => {
            "their errors fall too slowly with the elements, as strains and section forces at single points do; read them further from \
             joints and loads"
        }
    }
}

/// Settings in a sentence.
fn joined(settings: &[String]) -> String {
    match settings {
        [own @ .., last] if own.len() >= SETTINGS => {
            let rest = own.len() - (SETTINGS - 1);
            format!("{} and {rest} more, {last} among them", own[..SETTINGS - 1].join(", "))
        }
        [own @ .., last] if !own.is_empty() => format!("{} and {last}", own.join(", ")),
        _ => settings.concat(),
    }
}

/// A part of an error, if it is known.
fn small(part: Option<f64>) -> String {
    match part {
        None => String::from("unknown"),
        Some(0.0) => String::from("0"),
        Some(value) => format!("{value:.1e}"),
    }
}

/// A share, with two digits.
fn percent(share: f64) -> String {
    let value: f64 = format!("{:.1e}", 100.0 * share).parse().unwrap_or(100.0 * share);
    format!("{} %", shortest(value))
}
