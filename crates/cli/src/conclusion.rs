//! What a run leaves besides its rows and plots: summary.json, the page index.html, and some lines on the terminal.

use super::folder::Folder;
use super::{Complaint, Stop, say, voice};
use ancf14::error::decimal;
use ancf14::fmi::Model;
use ancf14::model::drawing::Drawing;
use ancf14::model::effort::Statistics;
use ancf14::model::refinement::{self, Outcome};
use ancf14::model::run::accuracy::Inexact;
use ancf14::model::simulation::Simulation;
use ancf14_report::draw::{self, PROJECTIONS};
use ancf14_report::extremes::{Extremes, Peak, chosen};
use ancf14_report::numbers::{significant, trimmed};
use ancf14_report::overview::Overview;
use ancf14_report::results::Results;
use ancf14_report::summary::{Accuracy, EstimatedError, Summary};
use serde_json::json;
use std::fmt::Write;

/// The document of a run.
pub const SUMMARY: &str = "summary.json";
/// The page of a run.
pub const PAGE: &str = "index.html";
/// Lines of the table on the terminal, without its head and its foot: all of it is a dozen.
const LINES: usize = 10;
/// Digits of the numbers in it.
const DIGITS: usize = 4;
/// Share of a range by which extremes lie beyond the rows before a line says so. Rows of a tenth of a period miss up to
/// `(1 - cos(pi/10))/2` of the range, 2.4 %.
const HIDDEN: f64 = 0.02;

/// Sums up a run that took these counts and `wall` seconds; none if it has no row. `settings` are the overrides of
/// `--set`; `outcome` is there if the run may have been repeated.
pub fn summary(
    simulation: &Simulation,
    results: &Results,
    settings: &[(String, String)],
    (statistics, wall): (Statistics, f64),
    is_complete: bool,
    outcome: Option<&Outcome>,
) -> Option<Summary> {
    let about = simulation.about();
    Some(Summary {
        program: format!("ancf14 {}", env!("CARGO_PKG_VERSION")),
        model: about.name.clone(),
        description: about.description.clone(),
        guid: about.guid.clone(),
        settings: settings.iter().cloned().collect(),
        complete: is_complete,
        stop: about.stop,
        reached: decimal(results.reached()?),
        rows: results.count,
        steps: statistics.steps,
        iterations: statistics.iterations,
        rejected: statistics.rejected,
        wall_time: wall,
        step_limits: simulation.step_limits(),
        time_step_errors: sorted(&simulation.estimated_errors()),
        mesh_errors: sorted(simulation.mesh_errors()),
        accuracy: outcome.map(|outcome| Accuracy {
            runs: outcome.runs,
            elements: outcome.elements,
            reached: outcome.end == refinement::End::Reached,
            worst: outcome.worst.as_ref().map(told),
        }),
        columns: results.extremes(),
    })
}

fn told(error: &Inexact) -> EstimatedError {
    EstimatedError { quantity: error.name.clone(), of_range: error.error }
}

/// Errors for programs, the largest first.
fn sorted(errors: &[Inexact]) -> Vec<EstimatedError> {
    let mut errors: Vec<EstimatedError> = errors.iter().map(told).collect();
    errors.sort_by(|a, b| b.of_range.total_cmp(&a.of_range));
    errors
}

/// Writes the document and the page, with the warnings so far and why the run ended early; with `--json` the document
/// is what the program prints. `pictures` are the plots, and `files` what else is in the folder.
pub fn write(
    summary: &Summary,
    (simulation, outcome): (&Simulation, &Result<(), Stop>),
    pictures: &[(String, String)],
    files: &[&str],
    folder: &Folder,
) -> Result<(), Stop> {
    let errors = outcome.as_ref().map_or_else(|stop| stop.complaints(), |()| Vec::new());
    voice::deliver(json!(summary));
    folder.write(SUMMARY, format!("{:#}\n", voice::whole(&errors)))?;
    let drawing = Drawing::new(simulation.document());
    let suited = draw::suited(&drawing);
    let mut views = PROJECTIONS;
    // The best one comes first.
    views.sort_by_key(|(_, view)| *view != suited);
    let drawings = views.map(|(word, view)| (word, draw::fitted(&drawing, view)));
    let errors: Vec<String> = errors.into_iter().map(Complaint::text).collect();
    let row_heading = simulation.document().row_heading();
    let page = Overview {
        summary,
        row_heading,
        errors: &errors,
        warnings: &voice::warnings(),
        drawings: &drawings,
        pictures,
        files,
    };
    folder.write(PAGE, page.html())
}

/// Says what the run took, how exact it is, and what its outputs came to.
/// `outcome` is there if the run may have been repeated.
pub fn tell(summary: &Summary, simulation: &Simulation, outcome: Option<&Outcome>) -> Result<(), Stop> {
    let Summary { reached, steps, iterations, rejected, wall_time, .. } = summary;
    let document = simulation.document();
    let counts =
        format!("{steps} steps, {iterations} Newton iterations, {rejected} rejected, {wall_time:.3} s wall time");
    say(&if document.follows_arc_length() {
        format!("arc length {reached}: {counts}")
    } else {
        format!("t = {reached} s: {counts}, {}", pace(*reached, *wall_time))
    })?;
    if let Some(limits) = &summary.step_limits {
        say(&format!("steps: {limits}"))?;
    }
    if let Some(outcome) = outcome {
        say(&outcome.line())?;
    }
    let is_compared = outcome.is_some_and(|outcome| outcome.runs > 1 || outcome.is_path);
    if !is_compared || outcome.is_some_and(|outcome| outcome.keeps_steps) {
        tell_error_of_steps(simulation)?;
    }
    if !is_compared {
        tell_error_of_mesh(simulation)?;
    }
    table(&summary.columns, document.row_heading()).map_or(Ok(()), |table| say(&table))?;
    hidden(summary, simulation.about().start).map_or(Ok(()), |hint| say(&hint))
}

/// Tells the result of the table whose extremes lie the furthest beyond those of the rows: its plot and results.csv
/// miss them.
fn hidden(summary: &Summary, start: f64) -> Option<String> {
    let columns = chosen(&summary.columns, LINES).into_iter().map(|place| &summary.columns[place]);
    let worst = columns.max_by(|a, b| a.beyond_rows.total_cmp(&b.beyond_rows))?;
    let step = (summary.reached - start) / summary.steps as f64;
    (worst.beyond_rows > HIDDEN).then(|| {
        format!(
            "{} has an extreme between its rows, {:.0} % of the range beyond them: to see it in the plot, set \
             simulation.output_step = {step:.0e}",
            worst.name,
            100.0 * worst.beyond_rows
        )
    })
}

/// Says how exact the results of a run are as its steps go.
fn tell_error_of_steps(simulation: &Simulation) -> Result<(), Stop> {
    simulation.least_accurate().map_or(Ok(()), |worst| {
        say(&format!("time-step error: {} of the range of {}, the least accurate result", worst.size(), worst.name))
    })
}

/// Says how exact the results of a single run are as its mesh goes.
fn tell_error_of_mesh(simulation: &Simulation) -> Result<(), Stop> {
    if let Some(worst) = simulation.largest_mesh_error() {
        say(&format!("mesh error: {} of the range of {}, the least accurate result", worst.size(), worst.name))?;
    } else if simulation.seeks_mesh_error() {
        say("mesh error: unknown; run with --verify to estimate it")?;
    }
    Ok(())
}

/// How fast a run was compared with real time.
fn pace(simulated: f64, wall: f64) -> String {
    let factor = simulated / wall;
    match factor {
        _ if !factor.is_finite() || factor == 0.0 => String::from("too short to measure its speed"),
        1.0.. => format!("{} times faster than real time", two_digits(factor)),
        _ => format!("{} times slower than real time", two_digits(1.0 / factor)),
    }
}

/// A number with two digits at least: 1.3, 17, 2450.
fn two_digits(value: f64) -> String {
    if value < 10.0 { format!("{value:.1}") } else { format!("{value:.0}") }
}

/// Extremes of the columns that tell most, `at` their rows; none if there are no outputs.
fn table(columns: &[Extremes], at: &str) -> Option<String> {
    let places = chosen(columns, LINES);
    let head = ["", "minimum", at, "maximum", at, "at the end"].map(str::to_owned);
    let rows = places.iter().map(|place| {
        let Extremes { name, unit, minimum, maximum, last, .. } = &columns[*place];
        let [[lowest, at_lowest], [highest, at_highest]] = [minimum, maximum].map(peak);
        let unit = if unit.is_empty() { String::new() } else { format!(" ({unit})") };
        [format!("{name}{unit}"), lowest, at_lowest, highest, at_highest, number(*last)]
    });
    let rows: Vec<[String; 6]> = std::iter::once(head).chain(rows).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; 6] = std::array::from_fn(width);
    let mut text = String::new();
    for [name, numbers @ ..] in &rows {
        // Writing into a String cannot fail.
        let _ = write!(text, "  {name:<width$}", width = widths[0]);
        for (number, width) in numbers.iter().zip(&widths[1..]) {
            let _ = write!(text, "  {number:>width$}");
        }
        text.push('\n');
    }
    let left = columns.len() - places.len();
    let plural = if left == 1 { "" } else { "s" };
    if left > 0 {
        let _ = write!(text, "  {left} more column{plural} in {SUMMARY}");
    }
    (!places.is_empty()).then_some(text)
}

/// An extreme and its time.
fn peak(peak: &Option<Peak>) -> [String; 2] {
    let time = peak.map_or_else(|| String::from("-"), |peak| trimmed(peak.time, DIGITS));
    [number(peak.map(|peak| peak.value)), time]
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(|| String::from("-"), |value| significant(value, DIGITS))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reader sees which of the two is the faster one.
    #[test]
    fn the_pace_says_faster_or_slower() {
        assert_eq!(pace(10.0, 2.0), "5.0 times faster than real time");
        assert_eq!(pace(1.0, 4.0), "4.0 times slower than real time");
        assert_eq!(pace(0.0, 1.0), pace(1.0, 0.0));
    }

    /// Numbers stand below one another, and the table says what it leaves out.
    #[test]
    fn the_table_is_aligned() {
        let column = |name: &str, low: f64, high: f64| Extremes {
            name: name.to_owned(),
            unit: "m".to_owned(),
            minimum: Some(Peak { value: low, time: 0.25 }),
            maximum: Some(Peak { value: high, time: 1.0 }),
            last: None,
            beyond_rows: 0.0,
        };
        let text = table(
            &[column("tip.x", -0.11004, 0.0), column("root.angle", 1e-7, 123.4), column("energy.total", 0.0, 0.0)],
            "at t (s)",
        )
        .unwrap();
        assert_eq!(
            text.lines().collect::<Vec<_>>(),
            [
                "                   minimum  at t (s)  maximum  at t (s)  at the end",
                "  tip.x (m)        -0.1100      0.25        0         1           -",
                "  root.angle (m)  1.000e-7      0.25    123.4         1           -",
                "  1 more column in summary.json",
            ]
        );
        assert_eq!(table(&[column("energy.total", 0.0, 0.0)], "at t (s)"), None);
    }
}
