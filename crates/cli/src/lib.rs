//! The command line of ancf14: commands, arguments and exit codes: 0, 1 (the run failed), 2 (bad file or arguments),
//! 128 and the number of a signal that ended a run. The program and the Python package both call [`main`].

mod advance;
mod arguments;
mod attempt;
pub mod background;
mod campbell;
mod check;
mod conclusion;
mod demo;
mod export;
mod folder;
mod inputs;
mod keeper;
mod linear_file;
mod linearize;
mod live;
mod loading;
mod model_arguments;
mod modes;
mod moordyn;
mod new;
mod output;
mod picture;
mod progress;
mod reduce;
mod repeat;
mod rows;
mod run;
mod shell;
mod stages;
mod stop;
mod tune;
mod verify;
mod view;
mod voice;
mod vtk;
mod watch;

use ancf14::fmi::lifecycle::Standard;
use ancf14::model::refinement::is_repeated;
use ancf14_pack::libraries::Platform;
use ancf14_report::draw::Projection;
use ancf14_view::Film;
use clap::{Parser, Subcommand};
use inputs::Inputs;
use loading::{failed, load, start};
use model_arguments::{FileArguments, INPUTS, MODEL_FILE, ModelArguments, is_piped, name, stem};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use stop::Stop;
use verify::Wish;
use voice::{Complaint, Style, complain, say};

/// The line below the list of commands.
const BOOK: &str = "The documentation is share/doc/ancf14/book/index.html of a release, and docs/ of the sources.";

/// Simulates flexible beams described in a model file, and packs them as FMUs.
#[derive(Debug, Parser)]
#[command(name = "ancf14", version, arg_required_else_help = true, after_help = BOOK)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Say nothing but what was asked for, warnings and errors
    #[arg(short, long, global = true)]
    quiet: bool,
    /// Answer with one JSON document on the standard output: variables of `check`, extremes of `run`, modes of `modes`,
    /// poles of `linearize`, modes of `campbell`, warnings and errors of all commands
    #[arg(long, global = true, conflicts_with = "quiet")]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Start a model file from a template, with comments
    New {
        /// The file, with or without .toml
        #[arg(required_unless_present = "list")]
        name: Option<PathBuf>,
        /// The template
        #[arg(short, long, default_value = "beam")]
        template: String,
        /// Convert an input file of MoorDyn instead
        #[arg(long, value_name = "LINES", conflicts_with_all = ["template", "list"])]
        from_moordyn: Option<PathBuf>,
        /// List the templates instead
        #[arg(long, conflicts_with = "name")]
        list: bool,
    },
    /// Simulate a model: results.csv, a plot of each quantity, summary.json, and index.html, which shows everything on
    /// one page
    ///
    /// During the run its rows are in results.part.csv, which becomes results.csv at the end. A run that fails or is
    /// interrupted leaves its rows there. Files of the previous run in the same folder are replaced.
    Run {
        #[command(flatten)]
        model: ModelArguments,
        /// Estimate the error of every column from further runs with other steps and meshes: errors.csv and errors.svg.
        /// ACCURACY is the wanted error as a share of each column's range [default: 0.001]
        #[arg(long, value_name = "ACCURACY", num_args = 0..=1, require_equals = true, value_parser = verify::accuracy)]
        verify: Option<Option<f64>>,
        /// Leave out the second run of a motion, with half the elements, that tells the mesh error
        #[arg(long)]
        no_mesh_error: bool,
        /// Repeat the run with finer steps until its results are accurate, where the model file has an `accuracy`. Where
        /// it leaves the steps or the elements of a beam to the program, that is the default
        #[arg(long)]
        refine: bool,
        /// Run once, also where the model file leaves the steps or the elements of a beam to the program
        #[arg(long, conflicts_with_all = ["refine", "budget"])]
        no_refine: bool,
        /// Bound of the cost of all repetitions together, over the cost of the first run [default: 20, and half a minute
        /// in any case]
        #[arg(long, value_name = "TIMES", value_parser = arguments::budget)]
        budget: Option<f64>,
        /// Also write view.html, a page that shows the moving mechanism
        #[arg(long)]
        view: bool,
        /// Give the inputs of the model from a table: a column `time` and one for each input, linear between the rows
        #[arg(long, value_name = "FILE.csv", conflicts_with = "verify")]
        inputs: Option<PathBuf>,
        /// Start from a state written by --save-state, instead of at t = 0. A run of the same model file with the same
        /// overrides, except simulation.stop and simulation.output_step, continues the run that left the state. Any
        /// other model with the same parts has its own loads, drives and switches
        #[arg(long, value_name = "FILE", conflicts_with = "verify")]
        from_state: Option<PathBuf>,
        /// Write the state at the end of the run, for --from-state of another run
        #[arg(long, value_name = "FILE")]
        save_state: Option<PathBuf>,
        /// Files of the table
        #[arg(long, value_enum, default_value_t)]
        format: run::Format,
        /// Folder for the results [default: <file stem>-results, in the current folder]
        #[arg(short, long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Run a model until its results are accurate, and write the elements and steps that it took into a copy of its file
    Tune {
        /// Model file
        #[arg(value_name = "MODEL.toml")]
        file: PathBuf,
        #[command(flatten)]
        files: FileArguments,
        /// Run with the inputs of a table, as `run` does [default: inputs keep their start values]
        #[arg(long, value_name = "FILE.csv")]
        inputs: Option<PathBuf>,
        /// The copy [default: MODEL.tuned.toml, beside the model file]
        #[arg(short, long, value_name = "OUT.toml")]
        output: Option<PathBuf>,
        /// Bound of the cost of all repetitions together, over the cost of the first run [default: 20, and half a minute
        /// in any case]
        #[arg(long, value_name = "TIMES", value_parser = arguments::budget)]
        budget: Option<f64>,
    },
    /// Validate a model and list its variables
    Check {
        #[command(flatten)]
        model: ModelArguments,
        /// Draw the mechanism: an SVG picture with names, or a PNG picture without
        #[arg(long, value_name = "FILE.svg")]
        draw: Option<PathBuf>,
        /// Draw it from another side: front, top, side, iso or oblique [default: oblique]
        #[arg(long, value_name = "VIEW", value_parser = picture::view, requires = "draw")]
        view: Option<Projection>,
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
    /// Linearize a model about a state: matrices A, B, C, D with named states, inputs and outputs, and its poles
    ///
    /// The matrices are exact derivatives, in as many coordinates as the joints leave. An input that prescribes a
    /// motion is its acceleration; its value and rate are states.
    Linearize {
        #[command(flatten)]
        model: ModelArguments,
        #[command(flatten)]
        wishes: linearize::Wishes,
    },
    /// Write the linear system of a model with fewer states, for controllers and for simulation in real time
    ///
    /// Poles that do not fade stay as they are. The command leaves out as many other states as the error allows.
    Reduce {
        #[command(flatten)]
        model: ModelArguments,
        #[command(flatten)]
        wishes: reduce::Wishes,
    },
    /// Find the vibrations of a mechanism that turns, by its speed: frequencies, damping, direction of whirl, critical
    /// speeds and the limit of stability
    ///
    /// At each speed the command finds the relative equilibrium and the poles about it, and follows the modes by their
    /// vectors.
    Campbell {
        #[command(flatten)]
        model: ModelArguments,
        #[command(flatten)]
        wishes: campbell::Wishes,
    },
    /// Simulate a model and write a page that shows it in motion: one HTML file, in three dimensions, with charts
    ///
    /// The page opens in any browser, from the disk, without loading anything else. If the run fails, the page shows it
    /// up to the failure. Instead of a model file, a page that this command has written, or a folder of results with
    /// view.html, gives its run.
    View {
        #[command(flatten)]
        model: ModelArguments,
        /// Compare with a second run, shown as a ghost: another model file, a page, or a folder of results
        #[arg(value_name = "OTHER")]
        other: Option<PathBuf>,
        /// The page [default: <file stem>.html, of two runs <file stem>-and-<file stem>.html, in the current folder]
        #[arg(short, long, value_name = "PAGE.html")]
        output: Option<PathBuf>,
        /// Also show the N lowest natural modes about the initial state [default of N: 10]
        #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true, value_parser = modes::count)]
        modes: Option<Option<u16>>,
        /// Put the solver into the page: its reader changes parameters and simulates again, without a network. FILE is
        /// the solver [default: ancf14.wasm next to this program, or in ../lib]
        #[arg(long, value_name = "FILE.wasm", num_args = 0..=1, require_equals = true)]
        live: Option<Option<PathBuf>>,
        /// Simulate once, also where the model file leaves steps or meshes to the program; the page is there sooner
        #[arg(long)]
        no_refine: bool,
        /// Serve the page on this computer instead of writing it. Whenever a file of the model is saved, simulate once
        /// and update the page; mistakes appear above the last picture. Ctrl-C ends it
        #[arg(long, conflicts_with_all = ["output", "live", "other"])]
        watch: bool,
    },
    /// Simulate a model and write files that ParaView and PyVista read: beams with their section forces, bodies,
    /// joints, loads
    ///
    /// The command writes one file per kind of part and row of results, and one list per kind: beams.pvd, bodies.pvd,
    /// joints.pvd. If the run fails, the files show it up to the failure. Files of the previous export in the same
    /// folder are replaced.
    Export {
        #[command(flatten)]
        model: ModelArguments,
        /// Folder for files of VTK
        #[arg(long, value_name = "DIR")]
        vtk: PathBuf,
        /// Write one row of results in N, and the last one [default: each row]
        #[arg(long, value_name = "N", value_parser = vtk::every)]
        every: Option<u64>,
        /// Simulate once, also where the model file leaves steps or meshes to the program
        #[arg(long)]
        no_refine: bool,
    },
    /// Pack a model as an FMU for co-simulation (FMI 2.0 or 3.0)
    ///
    /// The FMU runs on this platform, and on those whose libraries lie beside the library of this one, as in a release:
    /// aarch64-linux/libancf14.so, x86_64-windows/ancf14.dll.
    Pack {
        /// Model file
        #[arg(value_name = "MODEL.toml")]
        file: PathBuf,
        #[command(flatten)]
        files: FileArguments,
        /// The FMU
        #[arg(short, long, value_name = "MODEL.fmu")]
        output: PathBuf,
        /// Version of the standard: 2 or 3
        #[arg(long, value_name = "VERSION", default_value = "2", value_parser = export::standard)]
        fmi: Standard,
        /// Shared library to pack [default: next to this program, or in ../lib]
        #[arg(long, value_name = "PATH")]
        library: Option<PathBuf>,
        /// Keep the first automatic meshes; by default the model runs, and the FMU gets the elements and steps with which
        /// its results are accurate
        #[arg(long)]
        no_refine: bool,
        /// Find them with the inputs of a table, as `run` reads it [default: inputs keep their start values]
        #[arg(long, value_name = "FILE.csv", conflicts_with = "no_refine")]
        inputs: Option<PathBuf>,
        /// Pack this library for another platform: --binary win64=ancf14.dll
        #[arg(long = "binary", value_name = "PLATFORM=PATH", value_parser = export::platform_and_path)]
        binaries: Vec<(Platform, PathBuf)>,
    },
    /// Write a C header with the GUID and value references of a model
    Header {
        /// Model file
        #[arg(value_name = "MODEL.toml")]
        file: PathBuf,
        #[command(flatten)]
        files: FileArguments,
        /// The header
        #[arg(short, long, value_name = "MODEL.h")]
        output: PathBuf,
        /// Prefix of its names [default: the model's identifier]
        #[arg(long, value_name = "NAME")]
        prefix: Option<String>,
        /// As of `pack`
        #[arg(long)]
        no_refine: bool,
        /// As of `pack`
        #[arg(long, value_name = "FILE.csv", conflicts_with = "no_refine")]
        inputs: Option<PathBuf>,
    },
    /// Simulate a flexible double pendulum into ./ancf14-demo-results
    Demo,
    /// Print the completions of a shell: ancf14 completions bash > ~/.local/share/bash-completion/completions/ancf14
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Write manual pages
    Man {
        /// Folder for the pages, for instance ~/.local/share/man/man1
        #[arg(value_name = "DIR")]
        folder: PathBuf,
    },
}

/// Runs the command that the arguments ask for, the name of the program first, and returns the exit code. `pack` looks
/// for the library of FMUs next to the file `program`; none: next to the running program.
pub fn main(arguments: impl IntoIterator<Item = OsString>, program: Option<&Path>) -> u8 {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(text) => return arguments::shown(&text),
    };
    voice::set(match (arguments.quiet, arguments.json) {
        (_, true) => Style::Json,
        (true, false) => Style::Quiet,
        (false, false) => Style::Text,
    });
    let outcome = execute(arguments.command, program);
    let code = outcome.as_ref().map_or_else(Stop::code, |()| 0);
    let stop = if voice::is_json() {
        voice::conclude(&outcome.map_or_else(|stop| stop.complaints(), |()| Vec::new())).err()
    } else {
        outcome.err()
    };
    match stop {
        None => code,
        Some(stop) => {
            complain(&stop.to_string());
            stop.code()
        }
    }
}

fn execute(command: Command, program: Option<&Path>) -> Result<(), Stop> {
    match command {
        Command::New { name: Some(name), from_moordyn: Some(from), .. } => new::converted(&name, &from),
        Command::New { name: Some(name), template, .. } => new::new(&name, &template),
        Command::New { name: None, .. } => new::list(),
        Command::Run {
            model,
            verify,
            no_mesh_error,
            refine,
            no_refine,
            budget,
            view,
            inputs,
            from_state,
            save_state,
            format,
            out,
        } => {
            let (mut simulation, text) = model.load()?;
            let file_name = model.name();
            let is_free = is_repeated(simulation.document());
            let is_wanted = verify.is_some() || simulation.document().simulation.verify;
            if is_wanted && inputs.is_some() {
                let reason = "error: a run with --inputs cannot be verified: simulation.verify = true asks for it";
                return Err(Stop::Bad(format!("{reason}; add --set simulation.verify=false")));
            }
            if is_wanted && from_state.is_some() {
                let reason = "error: a run with --from-state cannot be verified: simulation.verify = true asks for it";
                return Err(Stop::Bad(format!("{reason}; add --set simulation.verify=false")));
            }
            let named = stages::named(&simulation, &model.file, is_wanted)?;
            if let (Some(path), Some(named)) = (&from_state, &named) {
                return Err(stages::named_twice(path, named));
            }
            let from = from_state.as_deref().map(|path| stages::read(path, &simulation)).transpose()?;
            let table = inputs.as_deref().map(|path| Inputs::read(path, &mut simulation)).transpose()?;
            let accuracy = verify.flatten().unwrap_or(verify::ACCURACY);
            let overrides = simulation.document().remaining(&model.overrides);
            let wish = Wish { file_name: &file_name, text: &text, overrides: &overrides, accuracy };
            let plan = progress::plan(&simulation, from.as_ref())?;
            let film = view.then(|| Film::new(&simulation, plan.count));
            let (directory, wish) = (model.directory(out), is_wanted.then_some(wish));
            let read = [model.input()].into_iter().chain(inputs.iter().map(|path| (INPUTS, path.as_path())));
            let states = from_state.iter().chain(&named).map(|path| (stages::STATE, path.as_path()));
            let read: Vec<_> = read.chain(states).collect();
            output::spare(&read, save_state.as_slice())?;
            let (inputs, settings, save) = (table.as_ref(), &*model.overrides, save_state.as_deref());
            let order = run::Order {
                inputs,
                from,
                save,
                plan,
                read: &read,
                settings,
                wish,
                is_alone: no_mesh_error,
                is_repeated: refine || is_free && !no_refine,
                budget,
                film,
                format,
            };
            run::run(simulation, &directory, order)
        }
        Command::Tune { file, files, inputs, output, budget } => {
            tune::tune((&file, files.reach()), inputs.as_deref(), output, budget)
        }
        Command::Check { model, resolved: true, .. } => {
            let (simulation, text) = model.load()?;
            check::resolved(&text, &simulation.document().remaining(&model.overrides))
        }
        Command::Check { model, draw, view, .. } => {
            let view = view.unwrap_or_default();
            let picture = draw.as_deref().map(|path| picture::Target::of(path, view)).transpose()?;
            output::spare(&[model.input()], draw.as_slice())?;
            let (simulation, _) = model.load()?;
            check::check(simulation, &model.name(), picture)
        }
        Command::Modes { model, wishes, out } => {
            let (simulation, _) = model.load()?;
            modes::modes(simulation, wishes, &model.directory(out), &[model.input()])
        }
        Command::Linearize { model, wishes } => linearize::linearize(&model, &wishes, program),
        Command::Reduce { model, wishes } => reduce::reduce(&model, &wishes, program),
        Command::Campbell { model, wishes } => campbell::campbell(&model, &wishes),
        Command::View { model, modes, watch: true, .. } => watch::watch(&model, modes.map(modes::count_or_default)),
        Command::View { model, other, output, modes, live, no_refine, .. } => {
            let (other, modes) = (other.as_deref(), modes.map(modes::count_or_default));
            view::view(view::Order { model: &model, other, output, modes, live, no_refine, program })
        }
        Command::Export { model, vtk, every, no_refine } => vtk::export(&model, &vtk, every, no_refine),
        Command::Pack { file, files, output, fmi, library, no_refine, inputs, binaries } => {
            let libraries = export::Libraries { own: library.as_deref(), others: binaries, program };
            let meshes = export::Meshes { no_refine, inputs: inputs.as_deref() };
            export::pack(fmi, (&file, files.reach()), &output, meshes, libraries)
        }
        Command::Header { file, files, output, prefix, no_refine, inputs } => {
            let meshes = export::Meshes { no_refine, inputs: inputs.as_deref() };
            export::header((&file, files.reach()), &output, meshes, prefix.as_deref())
        }
        Command::Demo => demo::demo(),
        Command::Completions { shell } => shell::completions(shell),
        Command::Man { folder } => shell::manual(&folder),
    }
}

/// The page of a film.
fn page(film: &Film) -> Result<String, Stop> {
    film.page(None).map_err(|reason| unwritten(&reason))
}

/// The message about a page that cannot be written.
fn unwritten(reason: &dyn std::fmt::Display) -> Stop {
    Stop::Failed(format!("error: cannot write the page: {reason}"))
}
