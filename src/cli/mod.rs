//! Commands, arguments and exit codes: 0, 1 (the run failed), 2 (bad file or arguments). The only part that prints.

mod chart;
mod check;
mod demo;
mod draw;
mod export;
mod modes;
mod picture;
mod plot;
mod results;
mod run;
mod shapes;

use ancf14::fmi::Failure;
use ancf14::fmi::package::Platform;
use ancf14::model::simulation::Simulation;
use clap::{Args, Parser, Subcommand};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

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
    Run {
        #[command(flatten)]
        model: ModelArguments,
        /// Directory of the results [default: <file stem>-results]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Validate a model and list its variables
    Check {
        #[command(flatten)]
        model: ModelArguments,
        /// Draw the mechanism as an SVG picture
        #[arg(long, value_name = "FILE.svg")]
        draw: Option<PathBuf>,
    },
    /// Find natural frequencies and shapes: modes.csv, shapes.csv and a picture
    Modes {
        #[command(flatten)]
        model: ModelArguments,
        #[command(flatten)]
        wishes: modes::Wishes,
        /// Directory of the results [default: <file stem>-results]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Pack a model as an FMU for co-simulation (FMI 2.0)
    Pack {
        /// Model file
        #[arg(value_name = "MODEL.toml")]
        file: PathBuf,
        /// FMU to write
        #[arg(short, long, value_name = "MODEL.fmu")]
        output: PathBuf,
        /// Shared library to pack [default: beside this program, or in ../lib]
        #[arg(long, value_name = "PATH")]
        library: Option<PathBuf>,
        /// Library of another platform to pack too: --binary win64=ancf14.dll
        #[arg(long = "binary", value_name = "PLATFORM=PATH", value_parser = export::platform_and_path)]
        binaries: Vec<(Platform, PathBuf)>,
    },
    /// Write a C header with the GUID and value references of a model
    Header {
        /// Model file
        #[arg(value_name = "MODEL.toml")]
        file: PathBuf,
        /// Header to write
        #[arg(short, long, value_name = "MODEL.h")]
        output: PathBuf,
        /// What its names begin with [default: the model's identifier]
        #[arg(long, value_name = "NAME")]
        prefix: Option<String>,
    },
    /// Simulate a flexible double pendulum, results in ./ancf14-demo-results
    Demo,
}

#[derive(Args, Debug)]
struct ModelArguments {
    /// Model file
    #[arg(value_name = "MODEL.toml")]
    file: PathBuf,
    /// Change a number or word of the model: --set steel.young=2.1e11 --set arm.strain=small
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
}

/// Runs the command that the arguments ask for.
pub fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Run { model, out } => {
            let out = out.unwrap_or_else(|| default_directory(&model.file));
            load(&model.file, &model.overrides).and_then(|(simulation, _)| run::run(simulation, &out))
        }
        Command::Check { model, draw } => load(&model.file, &model.overrides)
            .and_then(|(simulation, _)| check::check(&simulation, &model.file, draw.as_deref())),
        Command::Modes { model, wishes, out } => {
            let out = out.unwrap_or_else(|| default_directory(&model.file));
            load(&model.file, &model.overrides).and_then(|(simulation, _)| modes::modes(simulation, wishes, &out))
        }
        Command::Pack { file, output, library, binaries } => load(&file, &[])
            .and_then(|loaded| export::spare(&file, &output).map(|()| loaded))
            .and_then(|(simulation, text)| export::pack(&simulation, &text, &output, library.as_deref(), binaries)),
        Command::Header { file, output, prefix } => load(&file, &[])
            .and_then(|loaded| export::spare(&file, &output).map(|()| loaded))
            .and_then(|(simulation, _)| export::header(&simulation, &output, prefix.as_deref())),
        Command::Demo => demo::demo(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Stop::Failed(message)) => {
            complain(&message);
            ExitCode::from(1)
        }
        Err(Stop::Bad(message)) => {
            complain(&message);
            ExitCode::from(2)
        }
    }
}

/// Reads a model file; gives its text too.
fn load(file: &Path, overrides: &[(String, String)]) -> Result<(Simulation, String), Stop> {
    let name = file.display();
    let bytes = fs::read(file).map_err(|reason| Stop::Bad(format!("error: cannot read {name}: {reason}")))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        Stop::Bad(format!("error: {name} is no UTF-8 text: byte {} is wrong", error.utf8_error().valid_up_to() + 1))
    })?;
    let simulation =
        Simulation::load(&name.to_string(), &text, overrides).map_err(|Failure { message, .. }| Stop::Bad(message))?;
    Ok((simulation, text))
}

/// `m.toml` to `m-results`, in the working directory.
fn default_directory(file: &Path) -> PathBuf {
    let stem = file.file_stem().map_or("model".into(), |stem| stem.to_string_lossy());
    PathBuf::from(format!("{stem}-results"))
}

/// Prints a line; nobody may be listening any more, which is no reason to fail.
fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// Prints a line of what went wrong.
fn complain(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Writes a file of text.
fn write(path: &Path, text: &str) -> Result<(), Stop> {
    fs::write(path, text).map_err(|reason| Stop::Failed(format!("error: cannot write {}: {reason}", path.display())))
}
