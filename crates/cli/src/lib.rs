//! The command line of ancf14: commands, arguments and exit codes: 0, 1 (the run failed), 2 (bad file or arguments), 128 and the number
//! of a signal that ended a run. The program and the Python package both call [`main`].

mod check;
mod demo;
mod export;
mod folder;
mod keeper;
mod modes;
mod output;
mod picture;
mod progress;
mod rows;
mod run;
mod verify;
mod view;

use ancf14::fmi::{Failure, Model};
use ancf14::model::simulation::Simulation;
use ancf14::model::{file, notes};
use ancf14_pack::libraries::Platform;
use ancf14_report::view::Film;
use clap::{Args, Parser, Subcommand};
use std::ffi::{OsStr, OsString};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use verify::Wish;

/// Simulates flexible beams described in a model file, and packs them as FMUs.
#[derive(Debug, Parser)]
#[command(name = "ancf14", version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Simulate a model: results.csv and one plot per quantity
    ///
    /// During the run its rows are in results.part.csv, which becomes results.csv at the end. A run that fails or is
    /// interrupted leaves its rows there. Files of the previous run in the same folder are replaced.
    Run {
        #[command(flatten)]
        model: ModelArguments,
        /// Estimate the error of every column from further runs with other steps and meshes: errors.csv and errors.svg. ACCURACY is the
        /// wanted error as a share of each column's range [default: 0.001]
        #[arg(long, value_name = "ACCURACY", num_args = 0..=1, require_equals = true, value_parser = verify::accuracy)]
        verify: Option<Option<f64>>,
        /// Also write view.html, a page that shows the moving mechanism
        #[arg(long)]
        view: bool,
        /// Folder for the results [default: <file stem>-results, in the current folder]
        #[arg(short, long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Validate a model and list its variables
    Check {
        #[command(flatten)]
        model: ModelArguments,
        /// Draw the mechanism: an SVG picture with names, or a PNG picture without
        #[arg(long, value_name = "FILE.svg")]
        draw: Option<PathBuf>,
        /// Print the model file without copies and includes instead: it gives the same results
        #[arg(long, conflicts_with = "draw")]
        resolved: bool,
    },
    /// Find natural frequencies and shapes: modes.csv, shapes.csv and a picture
    Modes {
        #[command(flatten)]
        model: ModelArguments,
        #[command(flatten)]
        wishes: modes::Wishes,
        /// Folder for the results [default: <file stem>-results, in the current folder]
        #[arg(short, long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Simulate a model and write a page that shows it in motion: one HTML file, in three dimensions, with charts
    ///
    /// The page opens in any browser, from the disk, without loading anything else. If the run fails, the page shows it up to the failure.
    View {
        #[command(flatten)]
        model: ModelArguments,
        /// The page [default: <file stem>.html, in the current folder]
        #[arg(short, long, value_name = "PAGE.html")]
        output: Option<PathBuf>,
        /// Also show the N lowest natural modes about the initial state [default of N: 10]
        #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true, value_parser = modes::count)]
        modes: Option<Option<u16>>,
    },
    /// Pack a model as an FMU for co-simulation (FMI 2.0)
    Pack {
        /// Model file
        #[arg(value_name = "MODEL.toml")]
        file: PathBuf,
        /// The FMU
        #[arg(short, long, value_name = "MODEL.fmu")]
        output: PathBuf,
        /// Shared library to pack [default: next to this program, or in ../lib]
        #[arg(long, value_name = "PATH")]
        library: Option<PathBuf>,
        /// Also pack a library for another platform: --binary win64=ancf14.dll
        #[arg(long = "binary", value_name = "PLATFORM=PATH", value_parser = export::platform_and_path)]
        binaries: Vec<(Platform, PathBuf)>,
    },
    /// Write a C header with the GUID and value references of a model
    Header {
        /// Model file
        #[arg(value_name = "MODEL.toml")]
        file: PathBuf,
        /// The header
        #[arg(short, long, value_name = "MODEL.h")]
        output: PathBuf,
        /// Prefix of its names [default: the model's identifier]
        #[arg(long, value_name = "NAME")]
        prefix: Option<String>,
    },
    /// Simulate a flexible double pendulum into ./ancf14-demo-results
    Demo,
}

#[derive(Args, Debug)]
struct ModelArguments {
    /// Model file
    #[arg(value_name = "MODEL.toml")]
    file: PathBuf,
    /// Change a number or a word of the model: --set steel.young=2.1e11 --set arm.strain=small
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = key_and_value)]
    overrides: Vec<(String, String)>,
}

fn key_and_value(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() && !value.trim().is_empty() => {
            Ok((key.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("KEY=VALUE was expected, like steel.young=2.1e11".to_owned()),
    }
}

/// Why a command ends early, with its exit code.
#[derive(Debug)]
enum Stop {
    /// The run failed: 1.
    Failed(String),
    /// Bad file or arguments: 2.
    Bad(String),
    /// A signal ended it: the code is given.
    Interrupted(String, u8),
}

/// Runs the command that the arguments ask for, the name of the program first, and returns the exit code. `pack` looks for the library of FMUs next to
/// the file `program`; none: next to the running program.
pub fn main(arguments: impl IntoIterator<Item = OsString>, program: Option<&Path>) -> u8 {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(text) => return shown(&text),
    };
    match execute(arguments.command, program) {
        Ok(()) => 0,
        Err(stop) => {
            let (message, code) = match stop {
                Stop::Failed(message) => (message, 1),
                Stop::Bad(message) => (message, 2),
                Stop::Interrupted(message, code) => (message, code),
            };
            complain(&message);
            code
        }
    }
}

fn execute(command: Command, program: Option<&Path>) -> Result<(), Stop> {
    match command {
        Command::Run { model, verify, view, out } => {
            let (simulation, text) = model.load()?;
            let file_name = model.file.display().to_string();
            let is_wanted = verify.is_some() || simulation.document().simulation.verify;
            let accuracy = verify.flatten().unwrap_or(verify::ACCURACY);
            let overrides = simulation.document().remaining(&model.overrides);
            let wish = Wish { file_name: &file_name, text: &text, overrides: &overrides, accuracy };
            let film = view.then(|| progress::last_row(&simulation).map(|last| Film::new(&simulation, last)));
            let (directory, wish) = (model.directory(out), is_wanted.then_some(wish));
            run::run(simulation, &directory, &[model.input()], wish, film.transpose()?)
        }
        Command::Check { model, resolved: true, .. } => {
            let (simulation, text) = model.load()?;
            check::resolved(&text, &simulation.document().remaining(&model.overrides))
        }
        Command::Check { model, draw, .. } => {
            let picture = draw.as_deref().map(picture::Target::of).transpose()?;
            output::spare(&[model.input()], draw.as_slice())?;
            let (simulation, _) = model.load()?;
            check::check(simulation, &model.file, picture)
        }
        Command::Modes { model, wishes, out } => {
            let (simulation, _) = model.load()?;
            modes::modes(simulation, wishes, &model.directory(out), &[model.input()])
        }
        Command::View { model, output, modes } => {
            let (simulation, _) = model.load()?;
            let file = output.unwrap_or_else(|| model.beside(".html"));
            view::view(simulation, &file, &[model.input()], modes.map(|count| count.unwrap_or(modes::COUNT)))
        }
        Command::Pack { file, output, library, binaries } => {
            export::pack(&file, &output, library.as_deref(), binaries, program)
        }
        Command::Header { file, output, prefix } => export::header(&file, &output, prefix.as_deref()),
        Command::Demo => demo::demo(),
    }
}

/// Shows a message of the argument parser: help and version are what was asked for, the rest is a mistake.
fn shown(text: &clap::Error) -> u8 {
    match text.print() {
        Err(reason) if reason.kind() != ErrorKind::BrokenPipe => 1,
        _ => u8::try_from(text.exit_code()).unwrap_or(2),
    }
}

impl ModelArguments {
    fn load(&self) -> Result<(Simulation, String), Stop> {
        load(&self.file, &self.overrides)
    }

    fn input(&self) -> output::Input<'_> {
        (MODEL_FILE, &self.file)
    }

    /// The folder of the results: `m.toml` to `m-results` in the current folder, unless another one is given.
    fn directory(&self, given: Option<PathBuf>) -> PathBuf {
        given.unwrap_or_else(|| self.beside("-results"))
    }

    /// The name of the model file without its ending, and `ending`: in the current folder.
    fn beside(&self, ending: &str) -> PathBuf {
        let mut name = self.file.file_stem().unwrap_or(OsStr::new("model")).to_owned();
        name.push(ending);
        PathBuf::from(name)
    }
}

/// The model file as messages call it.
const MODEL_FILE: &str = "the model file";

/// Reads a model file; gives its text too, without copies and includes.
fn load(path: &Path, overrides: &[(String, String)]) -> Result<(Simulation, String), Stop> {
    let name = path.display().to_string();
    let text = file::text(path).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    let simulation = Simulation::load_in(path.parent(), &name, &text, overrides)
        .map_err(|Failure { message, .. }| Stop::Bad(message))?;
    let text = simulation.document().text().to_owned();
    Ok((simulation, text))
}

/// Finds the initial state, with the warnings about it and about the file.
fn start(simulation: &mut Simulation) -> Result<(), Stop> {
    let notes = notes::notes(simulation.document());
    let initialized = simulation.initialize(0.0);
    for warning in notes.into_iter().chain(simulation.take_warnings()) {
        complain(&format!("warning: {warning}"));
    }
    initialized.map_err(|failure| failed(simulation, &failure))
}

/// The message about a simulation that failed, with the line of the part that it names.
fn failed(simulation: &Simulation, failure: &Failure) -> Stop {
    let Failure { message, .. } = failure;
    let located = simulation.document().locate(message);
    Stop::Failed(located.map_or_else(|| format!("error: {message}"), |mistake| mistake.to_string()))
}

/// The page of a film.
fn page(film: &Film) -> Result<String, Stop> {
    film.page().map_err(|reason| Stop::Failed(format!("error: cannot write the page: {reason}")))
}

/// Prints a line. A reader who has gone, as `head` does, is no reason to fail.
fn say(text: &str) -> Result<(), Stop> {
    match writeln!(io::stdout(), "{text}") {
        Err(reason) if reason.kind() != ErrorKind::BrokenPipe => {
            Err(Stop::Failed(format!("error: cannot write to the standard output: {reason}")))
        }
        _ => Ok(()),
    }
}

/// Prints a line of what went wrong.
fn complain(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}
