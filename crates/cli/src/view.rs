//! `view`: simulates as `run` does, and writes one HTML file that shows the mechanism move; two runs of it too, of
//! which one may be that of another page.

use super::output::{self, Input};
use super::progress::last_row;
use super::repeat::{self, Seen, repeat};
use super::run::VIEW;
use super::{MODEL_FILE, ModelArguments, Stop, complain, failed, live, load, name, say, stem, unwritten};
use ancf14::fmi::Model;
use ancf14::model::run::levels;
use ancf14::model::simulation::Simulation;
use ancf14_view::{Film, Live, Second, Shown, ended_early, html};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::{iter, slice};

/// What is asked for.
#[derive(Debug)]
pub struct Order<'a> {
    /// The model, or a page or folder of results that has its run.
    pub model: &'a ModelArguments,
    /// A run to compare with.
    pub other: Option<&'a Path>,
    /// The page; none: named after the model.
    pub output: Option<PathBuf>,
    /// How many natural modes about the initial state the page shows too.
    pub modes: Option<u16>,
    /// That the page has the solver, and where it is.
    pub live: Option<Option<PathBuf>>,
    /// A single run, also where the file leaves its steps or meshes to the program.
    pub no_refine: bool,
    /// The program next to which the solver is; none: the running program.
    pub program: Option<&'a Path>,
}

/// Simulates and writes the page.
pub fn view(order: Order<'_>) -> Result<(), Stop> {
    let Order { model, other, output, modes, live, no_refine, program } = order;
    let source = Source::of(&model.file);
    let other = other.map(Source::of);
    let sources = || iter::once(&source).chain(&other);
    refuse(&source, sources().any(Source::is_model), model, (modes.is_some(), live.is_some()))?;
    let opened = source.open(model)?;
    let second = other.as_ref().map(|other| other.open(model)).transpose()?;
    let solver = live.map(|given| live::solver(given.as_deref(), program)).transpose()?;
    let file = output.unwrap_or_else(|| {
        let mut ending = OsString::new();
        if let Some(other) = &other {
            ending.push("-and-");
            ending.push(stem(other.given));
        }
        ending.push(".html");
        model.beside(ending)
    });
    let solver_file = solver.iter().map(|(path, _)| (live::SOLVER, path.as_path()));
    let read: Vec<Input<'_>> = sources().map(Source::input).chain(solver_file).collect();
    output::spare(&read, slice::from_ref(&file))?;
    if let (Opened::Model(simulation, _), true) = (&opened, solver.is_some())
        && simulation.first_state().is_some()
    {
        let reason =
            "error: a page with the solver cannot begin with a state: the model file has simulation.from_state";
        return Err(Stop::Bad(format!("{reason}; leave out --live")));
    }
    let mut live = match (&opened, solver) {
        (Opened::Model(simulation, text), Some((_, solver))) => Some(Live {
            solver,
            file: model.name(),
            overrides: simulation.document().remaining(&model.overrides),
            text: text.clone(),
            modes,
        }),
        _ => None,
    };
    let (run, found, mut outcome) = opened.shown(modes, !no_refine)?;
    if let Some(live) = &mut live {
        live.overrides = levels::merged(&live.overrides, found);
    }
    let mut compared = None;
    if let (Some(other), Some(second)) = (&other, second) {
        let names = names([&source, other], &model.overrides);
        let (run, _, ended) = second.shown(None, !no_refine)?;
        compared = Some(Second { names, run });
        outcome = match (outcome, ended) {
            // One reason ends the program: the other one is told here.
            (Err(reason), Err(other)) => {
                complain(&other.to_string());
                Err(reason)
            }
            (outcome, ended) => outcome.and(ended),
        };
    }
    let text = html(&run, compared.as_ref(), live.as_ref()).map_err(|reason| unwritten(&reason))?;
    output::write(&file, text.as_bytes())?;
    let megabytes = text.len() as f64 / 1e6;
    say(&format!("{} instants, {megabytes:.2} MB: open {} in a browser", run.instants, file.display()))?;
    outcome
}

/// Refuses options that only a model has.
fn refuse(
    first: &Source<'_>,
    has_model: bool,
    model: &ModelArguments,
    (modes, live): (bool, bool),
) -> Result<(), Stop> {
    let given = first.given.display();
    let reason = match (first.is_model(), modes, live) {
        _ if !has_model && !model.overrides.is_empty() => {
            format!("--set changes a model file, and {given} has results")
        }
        (false, true, _) => {
            format!("--modes needs a model file, and {given} has results; find modes when its page is written")
        }
        (false, _, true) => format!("--live needs a model file, and {given} has results; give the model file first"),
        _ => return Ok(()),
    };
    Err(Stop::Bad(format!("error: {reason}")))
}

/// Where a run comes from.
#[derive(Debug)]
struct Source<'a> {
    /// As the command names it.
    given: &'a Path,
    /// The page that has it; none: it is a model file, which is simulated.
    page: Option<PathBuf>,
}

/// A source that has been read.
#[derive(Debug)]
enum Opened {
    /// A model, and its text without copies and includes.
    Model(Box<Simulation>, String),
    /// The run of a page.
    Page(Shown),
}

impl<'a> Source<'a> {
    fn of(given: &'a Path) -> Self {
        let page = match fs::metadata(given) {
            Ok(there) if there.is_dir() => Some(given.join(VIEW)),
            // A pipe can be read once only: it has a model.
            Ok(there) if there.is_file() && begins_as_page(given) => Some(given.to_owned()),
            _ => None,
        };
        Self { given, page }
    }

    fn is_model(&self) -> bool {
        self.page.is_none()
    }

    fn input(&self) -> Input<'_> {
        self.page.as_ref().map_or((MODEL_FILE, self.given), |page| ("a page that is to be shown", page))
    }

    fn open(&self, model: &ModelArguments) -> Result<Opened, Stop> {
        let Some(page) = &self.page else {
            let (simulation, text) = load(self.given, &model.overrides, model.files.reach())?;
            return Ok(Opened::Model(Box::new(simulation), text));
        };
        let shown = page.display();
        let text = fs::read_to_string(page).map_err(|reason| {
            let remedy = if self.given == page { "" } else { "; ancf14 run --view writes it into a folder of results" };
            Stop::Bad(format!("error: cannot read {shown}: {reason}{remedy}"))
        })?;
        Shown::of_page(&text).map(Opened::Page).ok_or_else(|| {
            let program = concat!("ancf14 ", env!("CARGO_PKG_VERSION"));
            Stop::Bad(format!(
                "error: {shown} is not a page with a run that {program} can read; write it anew with ancf14 view"
            ))
        })
    }
}

/// A run, the steps and meshes that were found for it, and how it has ended.
type Run = (Shown, Vec<(String, String)>, Result<(), Stop>);

impl Opened {
    /// The run, simulated if it is that of a model.
    fn shown(self, modes: Option<u16>, refines: bool) -> Result<Run, Stop> {
        match self {
            Self::Page(run) => Ok((run, Vec::new(), Ok(()))),
            Self::Model(simulation, _) => {
                let refines = refines && repeat::refines(&simulation);
                let Filmed { film, outcome, found } = filmed(*simulation, modes, refines, |_| Ok(()))?;
                Ok((film.shown().map_err(|reason| unwritten(&reason))?, found, outcome))
            }
        }
    }
}

/// What the page calls its runs: the names of their files, with folders where they would be the same, and what is
/// changed in models.
fn names(sources: [&Source<'_>; 2], overrides: &[(String, String)]) -> [String; 2] {
    let named = |source: &Source<'_>, file: String| -> String {
        let changes = overrides.iter().filter(|_| source.is_model()).map(|(key, value)| format!(", {key} = {value}"));
        iter::once(file).chain(changes).collect()
    };
    let file = |given: &Path| given.file_name().map_or_else(|| name(given), |file| name(Path::new(file)));
    let [first, second] = sources.map(|source| named(source, file(source.given)));
    if first == second { sources.map(|source| named(source, name(source.given))) } else { [first, second] }
}

/// Whether a file begins as a page does.
fn begins_as_page(path: &Path) -> bool {
    const BEGIN: &[u8] = b"<!DOCTYPE html>";
    let mut begin = Vec::new();
    let read = File::open(path).and_then(|file| file.take(BEGIN.len() as u64).read_to_end(&mut begin));
    read.is_ok() && begin == BEGIN
}

/// The film of a simulation.
pub struct Filmed {
    /// The last run that counts, one that fails up to the failure.
    pub film: Film,
    /// How it has ended.
    pub outcome: Result<(), Stop>,
    /// The steps and meshes of that run, as overrides; empty: those of the file.
    pub found: Vec<(String, String)>,
}

/// Films a simulation, and again until it is accurate if it `refines`. `look` is told the share of the rows of a run that
/// are done.
pub fn filmed(
    simulation: Simulation,
    modes: Option<u16>,
    refines: bool,
    mut look: impl FnMut(f64) -> Result<(), Stop>,
) -> Result<Filmed, Stop> {
    let last_row = last_row(&simulation)?;
    let begin = |simulation: &Simulation, held: &mut Vec<String>| {
        let mut film = Film::new(simulation, last_row);
        if let Some(count) = modes {
            let found = simulation.judged_modes(usize::from(count)).map_err(|failure| failed(simulation, &failure))?;
            film.add_modes(simulation, &found);
            held.extend(found.warnings);
        }
        Ok(film)
    };
    let row = |film: &mut Film, row: u64, simulation: &Simulation| {
        film.look(row, simulation);
        look(row as f64 / last_row as f64)
    };
    let Seen { simulation, look: mut film, outcome, found, .. } = repeat(simulation, refines, begin, row)?;
    if let Err(Stop::Failed(message)) = &outcome {
        film.note(&ended_early(simulation.time(), message));
    }
    let found = found.map_or_else(Vec::new, |found| found.overrides());
    Ok(Filmed { film, outcome, found })
}
