//! `run`: initialize, advance from row to row, write, plot, and say what it took.

use super::attempt::{Attempt, End, NEXT, Script};
use super::background;
use super::conclusion::{self, PAGE, SUMMARY};
use super::folder::Folder;
use super::inputs::Inputs;
use super::keeper::Keeper;
use super::output::{self, Input, trouble};
use super::progress::Plan;
use super::rows::{Rows, Shared, locked};
use super::verify::{self, Wish};
use super::{Stop, complain, page, say, stages};
use ancf14::error::decimal;
use ancf14::fmi::Model;
use ancf14::model::effort::{self, Statistics};
use ancf14::model::ranges::Ranges;
use ancf14::model::refinement::Refinement;
use ancf14::model::simulation::{Beginning, Simulation};
use ancf14_report::plot::Plot;
use ancf14_report::ranges;
use ancf14_report::results::Results;
use ancf14_view::{Film, ended_early};
use std::fs;
use std::path::Path;
use std::time::Instant;

/// The table of results, and its name until the run has come to its end.
const COMPLETE: &str = "results.csv";
const PARTIAL: &str = "results.part.csv";
/// The table as arrays.
const ARRAYS: &str = "results.npz";
/// Minimum, maximum and mean by station.
const RANGES: &str = "ranges.csv";
/// The page that shows it move.
pub const VIEW: &str = "view.html";

/// The files that the table is written to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// results.csv
    #[default]
    Csv,
    /// results.csv, and at the end results.npz, which numpy.load reads
    Npz,
}

/// What is asked for.
#[derive(Debug, Default)]
pub struct Order<'a> {
    /// A table of inputs; none: the start values of the file.
    pub inputs: Option<&'a Inputs>,
    /// The state of another run that it begins with.
    pub from: Option<Beginning>,
    /// Where the state at the end goes.
    pub save: Option<&'a Path>,
    /// Its rows.
    pub plan: Plan,
    /// Files that the command reads.
    pub read: &'a [Input<'a>],
    /// The overrides of `--set`.
    pub settings: &'a [(String, String)],
    /// That errors be estimated.
    pub wish: Option<Wish<'a>>,
    /// That no second run, with half the elements, tell the mesh error of a motion.
    pub is_alone: bool,
    /// That it is repeated with finer steps and meshes until it is accurate.
    pub is_repeated: bool,
    /// The cost of the repetitions at most, over that of the run; none: as usual.
    pub budget: Option<f64>,
    /// A page that shows the mechanism move.
    pub film: Option<Film>,
    /// The files of the table.
    pub format: Format,
}

/// Simulates and writes everything into the folder `directory`.
pub fn run(mut simulation: Simulation, directory: &Path, order: Order<'_>) -> Result<(), Stop> {
    let Order { inputs, from, save, plan, read, settings, wish, is_alone, is_repeated, budget, film, format } = order;
    let last_row = plan.count;
    let mut folder = Folder::open(directory)?;
    let partial = folder.file(PARTIAL);
    let mut results = Results::new(simulation.variables(), last_row);
    if format == Format::Npz {
        results.keep();
    }
    let rows = Rows::shared(partial.clone());
    let plots = Plot::all(&results.columns, simulation.document());
    let ranges = simulation.ranges();
    let has_ranges = !ranges.list.is_empty();
    let of_wish = wish.iter().flat_map(|_| &verify::FILES);
    let own = [COMPLETE, PARTIAL, NEXT, SUMMARY, PAGE]
        .iter()
        .chain(of_wish)
        .chain(film.iter().map(|_| &VIEW))
        .chain((format == Format::Npz).then_some(&ARRAYS))
        .chain(has_ranges.then_some(&RANGES))
        .map(|name| (*name).to_owned());
    let names: Vec<String> = plots.iter().map(Plot::file).chain(ranges::files(&ranges)).chain(own).collect();
    if let Some(path) = save {
        folder.keep_apart(path, &names)?;
        output::try_out(path)?;
    }
    folder.claim("run", &simulation.about().guid, &names, read)?;
    // The further runs of --verify tell it; a run that begins with a state has none on another mesh.
    if !is_alone && wish.is_none() && from.is_none() && simulation.first_state().is_none() {
        simulation.ask_for_mesh_error(background::start);
    }
    let keeper = Keeper::start(Shared::clone(&rows))
        .map_err(|reason| Stop::Failed(format!("error: cannot watch for signals: {reason}")))?;
    say(&format!("rows go to {}, which becomes {COMPLETE} at the end", partial.display()))?;

    // The state of a run that is continued has its counts.
    let before = from.as_ref().map_or(Statistics::default(), Beginning::counts);
    let begin = plan.begin;
    let clock = Instant::now();
    let is_repeated = is_repeated && wish.is_none() && from.is_none();
    let mut refinement = if is_repeated { Refinement::of(&mut simulation, budget) } else { None };
    let script = Script { inputs, from: from.as_ref(), plan };
    let mut attempt = Attempt { simulation, results, ranges, rows, film, held: Vec::new() };
    let mut outcome = attempt.run(script, refinement.as_mut(), &keeper, false);
    if let Some(refinement) = refinement.as_mut() {
        if let Err(End::Model(failure @ Stop::Failed(_))) = outcome {
            outcome = attempt.rescue(failure, script, refinement, (&folder, &keeper));
        }
        if outcome.is_ok() {
            outcome = attempt.repeat(script, refinement, &folder, &keeper);
        }
    }
    let wall = clock.elapsed().as_secs_f64();
    let is_complete = outcome.is_ok();
    attempt.tell();
    let Attempt { mut simulation, mut results, ranges, rows, film, .. } = attempt;
    results.zeros = simulation.zeros();
    let saved = save.filter(|_| is_complete).map_or(Ok(()), |path| stages::save(path, &simulation));
    let finished = finish((&results, &ranges), &rows, &plots, &folder, is_complete);
    if is_complete && refinement.is_none() {
        // This may wait for the comparison run: a signal still ends it.
        simulation.conclude();
        simulation.take_warnings().iter().for_each(|warning| complain(&format!("warning: {warning}")));
    }
    drop(keeper);
    let (statistics, reached) = (simulation.state().statistics.since(before), results.reached().unwrap_or(begin));
    if let Some(warning) = effort::rejections(simulation.document(), &statistics, reached - begin, results.count) {
        complain(&format!("warning: {warning}"));
    }
    let outcome = outcome.map_err(|end| end.stop(&locked(&rows)));
    let refined = refinement.as_ref().filter(|_| is_complete).map(|own| own.outcome(&simulation));
    let counts = (statistics, wall);
    let summary = conclusion::summary(&simulation, &results, settings, counts, is_complete, refined.as_ref());
    let told = match (&finished, &summary) {
        (Ok(_), Some(summary)) => conclusion::tell(summary, &simulation, refined.as_ref()),
        _ => Ok(()),
    };
    let (finished, mut pictures) = finished.map_or_else(|stop| (Err(stop), Vec::new()), |pictures| (Ok(()), pictures));
    let mut files = vec![if is_complete { COMPLETE } else { PARTIAL }, SUMMARY];
    files.extend(film.iter().map(|_| VIEW));
    files.extend((is_complete && format == Format::Npz).then_some(ARRAYS));
    files.extend((is_complete && has_ranges).then_some(RANGES));
    let conclude = |outcome: &Result<(), Stop>, pictures: &[(String, String)], files: &[&str]| {
        let write = |summary| conclusion::write(summary, (&simulation, outcome), pictures, files, &folder);
        summary.as_ref().map_or(Ok(()), write)
    };
    let written = conclude(&outcome, &pictures, &files);
    let pointed = match &summary {
        Some(summary) if finished.is_ok() && written.is_ok() => {
            let (table, page) = (locked(&rows).path.clone(), folder.file(PAGE));
            say(&format!("{} rows in {}; all plots on one page: {}", summary.rows, table.display(), page.display()))
        }
        _ => Ok(()),
    };
    let shown = film.map_or(Ok(()), |film| show(film, &folder, &outcome, reached));
    // The first reason to fail is the one to tell.
    outcome.and(finished).and(saved).and(told).and(written).and(pointed).and(shown)?;
    let Some(wish) = wish else { return Ok(()) };
    let verified = verify::verify(&simulation, rows, last_row, &folder, wish);
    // Again, with the errors and the warnings about them.
    let [table, chart] = verify::FILES;
    if let Ok(svg) = fs::read_to_string(folder.file(chart)) {
        pictures.insert(0, (chart.to_owned(), svg));
        files.push(table);
    }
    let written = conclude(&verified, &pictures, &files);
    verified.and(written)
}

/// Brings the rows and the ranges to the disk and draws the plots; returns their names and texts.
fn finish(
    (results, ranges): (&Results, &Ranges),
    rows: &Shared,
    plots: &[Plot],
    folder: &Folder,
    is_complete: bool,
) -> Result<Vec<(String, String)>, Stop> {
    let Some(reached) = results.reached() else { return Ok(Vec::new()) };
    let (partial, complete) = (folder.file(PARTIAL), folder.file(COMPLETE));
    locked(rows).finish().map_err(|reason| trouble(&partial, &reason))?;
    let remark = if is_complete {
        fs::rename(&partial, &complete).map_err(|reason| trouble(&complete, &reason))?;
        locked(rows).path.clone_from(&complete);
        if let Some(arrays) = results.npz() {
            folder.write(ARRAYS, arrays.map_err(|reason| trouble(&folder.file(ARRAYS), &reason))?)?;
        }
        String::new()
    } else {
        format!(" (incomplete: to t = {} s)", decimal(reached))
    };
    let drawn = if results.count > 1 { plots } else { &[] };
    let draw = |plot: &Plot| {
        let name = plot.file();
        let svg = plot.svg(results, &remark).map_err(|reason| trouble(&folder.file(&name), &reason))?;
        folder.write(&name, &svg)?;
        Ok((name, svg))
    };
    let mut pictures: Vec<_> = drawn.iter().map(draw).collect::<Result<_, _>>()?;
    if is_complete && !ranges.list.is_empty() {
        pictures.extend(write_ranges(ranges, &results.zeros, folder)?);
    }
    Ok(pictures)
}

/// Writes the ranges over time and draws them; returns the names and texts of the charts.
fn write_ranges(ranges: &Ranges, zeros: &[String], folder: &Folder) -> Result<Vec<(String, String)>, Stop> {
    folder.write(RANGES, ranges::table(ranges))?;
    let charts = ranges::pictures(ranges, zeros).map_err(|reason| trouble(&folder.file(RANGES), &reason))?;
    let pictures: Vec<(String, String)> = ranges::files(ranges).zip(charts).collect();
    pictures.iter().try_for_each(|(name, svg)| folder.write(name, svg))?;
    Ok(pictures)
}

/// Writes the page, of a run that failed too.
fn show(mut film: Film, folder: &Folder, outcome: &Result<(), Stop>, reached: f64) -> Result<(), Stop> {
    if let Err(Stop::Failed(message) | Stop::Interrupted(message, _)) = outcome {
        film.note(&ended_early(reached, message));
    }
    if film.instants() == 0 {
        return Ok(());
    }
    folder.write(VIEW, &page(&film)?)?;
    say(&format!("open {} in a browser to see it move", folder.file(VIEW).display()))
}
