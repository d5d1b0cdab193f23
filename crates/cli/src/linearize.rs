//! `linearize`: the matrices of a mechanism about a state, as a file for control toolboxes, and its poles as a table.

use super::linear_file::{Packing, Target};
use super::{ModelArguments, Stop, complain, failed, output, say, start, voice};
use ancf14::fmi::Model;
use ancf14::model::entries::simulation::{Analysis, Initial, Steps};
use ancf14::model::linear::{Linear, Pole, PoleKind, Signal};
use ancf14::model::simulation::Simulation;
use ancf14::model::simulation::pole_check::STEPS;
use ancf14::model::steady::{Frame, Spin, Steady};
use ancf14_report::bode;
use ancf14_report::matrices::{System, word};
use ancf14_report::numbers::significant;
use ancf14_report::poles;
use ancf14_report::sampled;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

/// What is asked for.
#[derive(clap::Args, Clone, Debug)]
pub struct Wishes {
    #[command(flatten)]
    place: Place,
    /// Print the softest N poles as a table [default of N: 20]; without --output it is printed anyway
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true, value_parser = super::modes::count)]
    poles: Option<Option<u16>>,
    /// Compare the softest vibration with a run of 20 periods that begins with it
    #[arg(long, conflicts_with = "steady")]
    check: bool,
    /// Draw Bode's diagram of the responses of the outputs to the inputs, as SVG
    #[arg(long, value_name = "FILE")]
    bode: Option<PathBuf>,
    /// Its frequencies, Hz, as in 0.1:100 [default: about the softest vibrations]
    #[arg(long, value_name = "FROM:TO", value_parser = frequencies, requires = "bode")]
    frequencies: Option<[f64; 2]>,
    /// Draw the softest poles in the complex plane, as SVG: as many as --poles says
    #[arg(long, value_name = "FILE")]
    pole_map: Option<PathBuf>,
    /// Write the matrices of discrete time, with inputs that are held for this time, s
    #[arg(long, value_name = "STEP", value_parser = held, requires = "output")]
    discrete: Option<f64>,
    /// The file: .npz for numpy and python-control, .mat for MATLAB and Octave, .json, .mo for Modelica, or .fmu for a
    /// small FMU
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    packing: Packing,
}

/// Where a mechanism is linearized, from which inputs to which outputs.
#[derive(clap::Args, Clone, Debug)]
pub struct Place {
    /// The state: equilibrium, start, or a time of the run, s [default: start, of which simulation.initial decides
    /// whether it is an equilibrium]
    #[arg(long, value_name = "STATE", value_parser = at, default_value = "start", hide_default_value = true, allow_negative_numbers = true)]
    at: At,
    /// Linearize about the steady rotation that a drive makes instead, DRIVE=SPEED in rad/s; functions of time act with
    /// their values at the start
    #[arg(long, value_name = "DRIVE=SPEED", value_parser = steady, conflicts_with = "at")]
    steady: Option<Turn>,
    /// Leave gravity out of a steady rotation
    #[arg(long, requires = "steady")]
    without_gravity: bool,
    /// Inputs of the linear system, separated by commas: inputs of the model by name, vectors as a whole, and the
    /// motion of a drive as NAME.acceleration [default: all inputs of the model]
    #[arg(long, value_name = "NAMES", value_parser = names)]
    inputs: Option<Names>,
    /// Its outputs, separated by commas: columns of results by name, vectors as a whole [default: all outputs of the
    /// model]
    #[arg(long, value_name = "NAMES", value_parser = names)]
    outputs: Option<Names>,
}

/// The state that a mechanism is linearized about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum At {
    /// The equilibrium next to the drawing.
    Equilibrium,
    /// The start of the run.
    Start,
    /// A time of the run, s.
    Time(f64),
}

/// A drive and its rate, rad/s.
#[derive(Clone, Debug, PartialEq)]
struct Turn(String, f64);

/// Names that were separated by commas.
#[derive(Clone, Debug)]
struct Names(Vec<String>);

/// Poles of the table where no number is given.
const POLES: u16 = 20;
/// Significant digits of frequencies, and of damping ratios.
const DIGITS: usize = 6;
const RATIO_DIGITS: usize = 4;

fn at(text: &str) -> Result<At, String> {
    match text {
        "equilibrium" => Ok(At::Equilibrium),
        "start" => Ok(At::Start),
        _ => {
            let time = text.parse().ok().filter(|time: &f64| time.is_finite() && *time >= 0.0);
            time.map(At::Time).ok_or_else(|| "equilibrium, start or a time from 0 on, in s, was expected".to_owned())
        }
    }
}

fn frequencies(text: &str) -> Result<[f64; 2], String> {
    let ends = text.split_once(':').and_then(|(from, to)| Some([from.trim().parse().ok()?, to.trim().parse().ok()?]));
    let ends = ends.filter(|[from, to]: &[f64; 2]| *from > 0.0 && from < to && to.is_finite());
    ends.ok_or_else(|| "two frequencies above 0 in Hz were expected, the lower one first, as in 0.1:100".to_owned())
}

fn held(text: &str) -> Result<f64, String> {
    let step = text.parse().ok().filter(|step: &f64| step.is_finite() && *step > 0.0);
    step.ok_or_else(|| "a time above 0 was expected, in s, as in 0.01".to_owned())
}

fn steady(text: &str) -> Result<Turn, String> {
    let parts = text.rsplit_once('=').and_then(|(drive, speed)| Some((drive, speed.trim().parse::<f64>().ok()?)));
    let parts = parts.filter(|(drive, speed)| !drive.trim().is_empty() && speed.is_finite());
    let (drive, speed) = parts.ok_or("a drive and its speed in rad/s were expected, as in motor=100")?;
    Ok(Turn(drive.trim().to_owned(), speed))
}

/// Splits at commas that are not in brackets: `shape.position[1,2]` is one name.
fn names(text: &str) -> Result<Names, String> {
    let mut names = vec![String::new()];
    let mut depth = 0_i32;
    for letter in text.chars() {
        depth += i32::from(letter == '[') - i32::from(letter == ']');
        match names.last_mut() {
            Some(last) if letter != ',' || depth > 0 => last.push(letter),
            _ => names.push(String::new()),
        }
    }
    Ok(Names(names.iter().map(|name| name.trim().to_owned()).filter(|name| !name.is_empty()).collect()))
}

/// The model, which begins where it is to be linearized.
fn load(model: &ModelArguments, at: At) -> Result<Simulation, Stop> {
    let (simulation, _) = model.load()?;
    let settings = &simulation.document().simulation;
    let begins_there = settings.analysis == Analysis::Static || settings.initial == Initial::Equilibrium;
    if at != At::Equilibrium || begins_there {
        return Ok(simulation);
    }
    model.load_with(&[("simulation.initial", "equilibrium")])
}

/// The model, started, and its linear system.
pub fn find(model: &ModelArguments, place: &Place) -> Result<(Simulation, Linear), Stop> {
    let mut simulation = load(model, place.at)?;
    let stop = simulation.about().stop;
    if let At::Time(time) = place.at
        && time > stop
    {
        return Err(Stop::Bad(format!("error: --at {time} is after the end of the run: simulation.stop is {stop} s")));
    }
    start(&mut simulation)?;
    if let At::Time(time) = place.at
        && time > 0.0
    {
        let advanced = simulation.advance(time);
        simulation.take_warnings().iter().for_each(|warning| complain(&format!("warning: {warning}")));
        advanced.map_err(|failure| failed(&simulation, &failure))?;
    }
    let asked = |names: &Option<Names>| names.as_ref().map(|names| names.0.clone());
    let (asked_inputs, asked_outputs) = (asked(&place.inputs), asked(&place.outputs));
    let found = match &place.steady {
        None => simulation.linearize(asked_inputs.as_deref(), asked_outputs.as_deref()),
        Some(Turn(drive, speed)) => {
            let spin = Spin { drive: drive.clone(), speed: *speed, is_weightless: place.without_gravity };
            simulation.linearize_steady(&spin, asked_inputs.as_deref(), asked_outputs.as_deref())
        }
    };
    let found = found.map_err(|failure| failed(&simulation, &failure))?;
    found.warnings.iter().for_each(|warning| complain(&format!("warning: {warning}")));
    Ok((simulation, found))
}

/// Linearizes, and writes what is asked for.
pub fn linearize(model: &ModelArguments, wishes: &Wishes, program: Option<&Path>) -> Result<(), Stop> {
    let file = wishes.output.as_deref();
    let target = file.map(|path| Target::new(path, &wishes.packing, model.input(), program)).transpose()?;
    if let Some(target) = target.as_ref().filter(|target| wishes.discrete.is_some() && !target.may_be_sampled()) {
        return Err(Stop::Bad(format!(
            "error: --discrete is for files of matrices, and {} is a system of continuous time; leave --discrete out, or \
             write a file that ends in .npz, .mat or .json",
            target.path().display()
        )));
    }
    let pictures = [("--bode", &wishes.bode), ("--pole-map", &wishes.pole_map)];
    let pictures: Vec<(&str, &PathBuf)> =
        pictures.into_iter().filter_map(|(option, path)| Some((option, path.as_ref()?))).collect();
    for (number, (option, path)) in pictures.iter().enumerate() {
        let other = pictures[..number].iter().find(|(_, other)| other == path).map(|(other, _)| *other);
        if let Some(other) = other.or((file == Some(path.as_path())).then_some("--output")) {
            return Err(Stop::Bad(format!("error: {option} and {other} name the same file; give two names")));
        }
        output::spare(&[model.input()], std::slice::from_ref(*path))?;
        output::try_out(path)?;
    }
    let (simulation, found) = find(model, &wishes.place)?;
    let prints = wishes.poles.is_some() || wishes.output.is_none();
    let count = usize::from(wishes.poles.flatten().unwrap_or(POLES));
    let poles = match found.poles(&simulation) {
        Ok(poles) => poles,
        Err(failure) if prints => return Err(failed(&simulation, &failure)),
        Err(failure) => {
            complain(&format!("warning: {}: the file has no poles", failure.message));
            Vec::new()
        }
    };
    let name = simulation.about().name.clone();
    if let Some(target) = target {
        let sampled = wishes.discrete.map(|step| sample(&found, step)).transpose()?;
        let (linear, step) = (sampled.as_ref().unwrap_or(&found), wishes.discrete);
        let system = System { linear, poles: &poles, model: &name, version: env!("CARGO_PKG_VERSION"), step };
        target.write(&simulation, &system, None)?;
    }
    if let Some(path) = &wishes.bode {
        let range = wishes.frequencies.map(|ends| ends.map(|hertz| TAU * hertz));
        let responses = found.responses(&simulation, range).map_err(|failure| failed(&simulation, &failure))?;
        let picture = bode::svg(&found, &responses, &name);
        let picture = picture.map_err(|reason| Stop::Failed(format!("error: cannot draw the diagram: {reason}")))?;
        output::write(path, picture.as_bytes())?;
    }
    if let Some(path) = &wishes.pole_map {
        let picture = poles::svg(&poles[..count.min(poles.len())], &name);
        let picture = picture.map_err(|reason| Stop::Failed(format!("error: cannot draw the poles: {reason}")))?;
        output::write(path, picture.as_bytes())?;
    }
    let checked = if wishes.check { Some(check(model, wishes.place.at, &found, &poles)?) } else { None };
    if voice::is_json() {
        let mut document = document(&found, &poles);
        if let Some(checked) = checked {
            document["check"] = json!({ "pole": checked.pole, "run": checked.run, "difference": checked.difference() });
        }
        voice::deliver(document);
        return Ok(());
    }
    if prints {
        say(&table(&poles, count))?;
    }
    if let Some(checked) = checked {
        let [pole, run] = [checked.pole, checked.run]
            .map(|[real, imaginary]| format!("{} ± {}i", significant(real, DIGITS), significant(imaginary, DIGITS)));
        say(&format!(
            "check: the softest vibration has the pole {pole} rad/s, and a run shows {run}, a difference of {:.1e}",
            checked.difference()
        ))?;
    }
    let Linear { states, inputs, outputs, time, steady, .. } = &found;
    let place = match steady {
        None => format!("at t = {time} s"),
        Some(Steady { drive, speed, frame }) => format!(
            "about the rotation of {drive} with {speed} rad/s, {}",
            match frame {
                Frame::Fixed => "in the fixed frame",
                Frame::Turning => "in the frame that turns with it",
            }
        ),
    };
    let counts = format!("{} states, {} inputs, {} outputs {place}", states.len(), inputs.len(), outputs.len());
    match &wishes.output {
        Some(path) => say(&format!("{counts}: {}", path.display())),
        None => say(&counts),
    }
}

/// The system whose inputs are held for `step`.
fn sample(found: &Linear, step: f64) -> Result<Linear, Stop> {
    sampled::held(found, step).ok_or_else(|| {
        Stop::Failed(format!(
            "error: with steps of {step} s the matrices have numbers that are not finite; take a shorter --discrete"
        ))
    })
}

/// A pole, and what a run shows of it.
struct Checked {
    pole: [f64; 2],
    run: [f64; 2],
}

impl Checked {
    /// The distance of both over the size of the pole.
    fn difference(&self) -> f64 {
        let [real, imaginary] = self.pole;
        f64::hypot(self.run[0] - real, self.run[1] - imaginary) / real.hypot(imaginary)
    }
}

/// Lets a run of its own begin with the softest vibration.
fn check(model: &ModelArguments, at: At, found: &Linear, poles: &[Pole]) -> Result<Checked, Stop> {
    if !found.is_at_rest() {
        return Err(Stop::Bad("error: --check is for a state at rest; take --at equilibrium".to_owned()));
    }
    let softest = poles.iter().find(|pole| pole.kind == PoleKind::Oscillating);
    let Some(pole) = softest else {
        return Err(Stop::Bad("error: --check compares a vibration with a run, and no pole is one".to_owned()));
    };
    let step = TAU / pole.value[1] / STEPS;
    let mut simulation = load(model, at)?;
    let settings = &simulation.document().simulation;
    if settings.analysis == Analysis::Dynamic && matches!(settings.steps, Steps::Fixed(_)) {
        let step = format!("{step:e}");
        let changes = [("simulation.step", step.as_str()), ("simulation.initial", "equilibrium")];
        simulation = model.load_with(if at == At::Equilibrium { &changes } else { &changes[..1] })?;
    }
    let start = simulation.about().start;
    let initialized = simulation.initialize(start);
    initialized.map_err(|failure| failed(&simulation, &failure))?;
    let run = simulation.observe_pole(pole).map_err(|failure| failed(&simulation, &failure))?;
    Ok(Checked { pole: pole.value, run })
}

/// The poles and names for programs.
fn document(found: &Linear, poles: &[Pole]) -> Value {
    let names = |signals: &[Signal]| signals.iter().map(|signal| signal.name.clone()).collect::<Vec<_>>();
    let pole = |pole: &Pole| {
        let [real, imaginary] = pole.value;
        json!({
            "kind": word(pole.kind),
            "real": real,
            "imaginary": imaginary,
            "frequency": pole.natural_frequency() / TAU,
            "damped_frequency": imaginary / TAU,
            "damping_ratio": pole.damping_ratio(),
        })
    };
    json!({
        "time": found.time,
        "states": names(&found.states),
        "inputs": names(&found.inputs),
        "outputs": names(&found.outputs),
        "poles": poles.iter().map(pole).collect::<Vec<_>>(),
    })
}

/// The softest `count` poles as a table.
fn table(poles: &[Pole], count: usize) -> String {
    let head = ["pole", "frequency Hz", "damped Hz", "damping ratio", "real 1/s", "kind"];
    let mut rows = vec![head.map(str::to_owned)];
    for (number, pole) in poles.iter().take(count).enumerate() {
        let [real, imaginary] = pole.value;
        let cells = match pole.kind {
            PoleKind::Rigid => [String::new(), String::new(), String::new(), String::new()],
            _ => [
                significant(pole.natural_frequency() / TAU, DIGITS),
                significant(imaginary / TAU, DIGITS),
                significant(pole.damping_ratio(), RATIO_DIGITS),
                significant(real, DIGITS),
            ],
        };
        let [frequency, damped, ratio, real] = cells;
        rows.push([(number + 1).to_string(), frequency, damped, ratio, real, word(pole.kind).to_owned()]);
    }
    super::check::aligned(&rows).trim_end().to_owned()
}
