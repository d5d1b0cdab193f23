//! `modes`: natural frequencies and shapes about the initial state, as a table, as CSV files and as a picture.

use super::folder::Folder;
use super::output::Input;
use super::{Stop, complain, failed, page, say, start, voice};
use ancf14::fmi::Model;
use ancf14::model::accuracy::percent;
use ancf14::model::entries::simulation::Analysis;
use ancf14::model::linear::PoleKind;
use ancf14::model::modes::{DampedMode, Kind, Mode, Modes};
use ancf14::model::refinement::modes::RefinedModes;
use ancf14::model::simulation::Simulation;
use ancf14_report::modes::{digits, pace, word};
use ancf14_report::numbers::significant;
use ancf14_report::{matrices, modes, shapes};
use ancf14_view::Film;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::Path;

/// What is asked for.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct Wishes {
    /// Number of lowest modes [default: 10]
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    count: Option<u16>,
    /// Time of the equilibrium, s; only for a static analysis [default: the start]
    #[arg(long, value_name = "T", value_parser = time, allow_negative_numbers = true)]
    time: Option<f64>,
    /// Also write modes.html, a page with the vibrating shapes
    #[arg(long)]
    view: bool,
    /// Find the modes with damping instead, exactly: frequency, damped frequency, damping ratio, and whether a mode
    /// vibrates or fades without a vibration; damped_modes.csv
    #[arg(long, conflicts_with = "view")]
    damped: bool,
}

/// Significant digits of a damping ratio, which is of first order.
const RATIO_DIGITS: usize = 4;
/// Round-off of a damping ratio, and an error of a mesh that nobody asks the size of.
const SMALL_RATIO: f64 = 1e-12;
const SMALL_ERROR: f64 = 1e-6;
/// A share of shear that nobody asks the size of.
const SMALL_SHEAR: f64 = 1e-5;
/// Modes that are found where no number is given.
const COUNT: u16 = 10;
/// The page in which the shapes swing.
const PAGE: &str = "modes.html";
/// The modes with damping.
const DAMPED: &str = "damped_modes.csv";
/// What is always written.
const FILES: [&str; 3] = ["modes.csv", "shapes.csv", "modes.svg"];

/// The number of modes that `--modes` asks for.
pub fn count_or_default(count: Option<u16>) -> u16 {
    count.unwrap_or(COUNT)
}

/// A number of modes as an argument.
pub fn count(text: &str) -> Result<u16, String> {
    let count = text.parse().ok().filter(|count| *count >= 1);
    count.ok_or_else(|| format!("a whole number from 1 to {} was expected", u16::MAX))
}

fn time(text: &str) -> Result<f64, String> {
    let time = text.parse().ok().filter(|time: &f64| time.is_finite() && *time >= 0.0);
    time.ok_or_else(|| "a time from 0 on was expected, in s".to_owned())
}

/// Finds the modes and writes everything into `directory`.
pub fn modes(mut simulation: Simulation, wishes: Wishes, directory: &Path, inputs: &[Input<'_>]) -> Result<(), Stop> {
    if wishes.time.is_some() && simulation.document().simulation.analysis != Analysis::Static {
        return Err(Stop::Bad(
            "error: --time is for analysis = \"static\"; other modes are those of the start. ancf14 linearize --at \
             finds the vibrations about a time of a motion"
                .to_owned(),
        ));
    }
    let stop = simulation.about().stop;
    if let Some(time) = wishes.time.filter(|time| *time > stop) {
        return Err(Stop::Bad(format!(
            "error: --time {time} is after the end of the analysis: simulation.stop is {stop} s"
        )));
    }
    let mut folder = Folder::open(directory)?;
    if wishes.damped {
        folder.claim("modes", &simulation.about().guid, &[DAMPED.to_owned()], inputs)?;
        arrive(&mut simulation, wishes)?;
        // Their frequencies need the mesh that those without damping need.
        let refined = simulation.refined_modes(usize::from(wishes.count.unwrap_or(COUNT))).ok();
        let warning = refined.as_ref().and_then(RefinedModes::warning);
        warning.iter().for_each(|warning| complain(&format!("warning: {warning}")));
        let simulation = refined.and_then(|refined| refined.simulation).map_or(simulation, |finer| *finer);
        return damped(&simulation, wishes, &mut folder, directory);
    }
    let names = FILES.iter().chain(wishes.view.then_some(&PAGE)).map(|name| (*name).to_owned());
    folder.claim("modes", &simulation.about().guid, &names.collect::<Vec<_>>(), inputs)?;
    arrive(&mut simulation, wishes)?;
    let refined = simulation.refined_modes(usize::from(wishes.count.unwrap_or(COUNT)));
    let refined = refined.map_err(|failure| failed(&simulation, &failure))?;
    let line = refined.line();
    let (simulation, found) = (refined.simulation.map_or(simulation, |finer| *finer), refined.modes);
    if let Some(count) = wishes.count.filter(|count| usize::from(*count) > found.modes.len()) {
        complain(&format!("warning: {count} modes were asked for, but the mechanism has only {}", found.modes.len()));
    }
    found.warnings.iter().for_each(|warning| complain(&format!("warning: {warning}")));
    let texts = [modes::list(&found), modes::shapes(&found), shapes::svg(&found, &simulation.about().name)];
    for (name, text) in FILES.iter().zip(texts) {
        folder.write(name, &text)?;
    }
    if wishes.view {
        let mut film = Film::new(&simulation, 0);
        film.look(0, &simulation);
        film.add_modes(&simulation, &found);
        folder.write(PAGE, &page(&film)?)?;
    }
    if voice::is_json() {
        voice::deliver(document(&found));
        return Ok(());
    }
    say(&table(&found))?;
    if let Some(line) = line {
        say(&line)?;
    }
    note_turning(&simulation)?;
    if wishes.view {
        say(&format!("open {} in a browser to see them swing", folder.file(PAGE).display()))?;
    }
    say(&format!("modes.csv, shapes.csv and modes.svg in {}", directory.display()))
}

/// Takes the simulation to the state that is asked for.
fn arrive(simulation: &mut Simulation, wishes: Wishes) -> Result<(), Stop> {
    start(simulation)?;
    if let Some(time) = wishes.time.filter(|time| *time > 0.0) {
        let advanced = simulation.advance(time);
        simulation.take_warnings().iter().for_each(|warning| complain(&format!("warning: {warning}")));
        advanced.map_err(|failure| failed(simulation, &failure))?;
    }
    Ok(())
}

/// Says what the modes leave out where a drive turns the mechanism.
fn note_turning(simulation: &Simulation) -> Result<(), Stop> {
    let Some(drive) = simulation.turning_drive() else { return Ok(()) };
    say(&format!(
        "note: these are the modes at rest. Drive {drive} turns the mechanism: ancf14 campbell --drive {drive} gives the \
         frequencies by its speed"
    ))
}

/// Finds the modes with damping, and writes them.
fn damped(simulation: &Simulation, wishes: Wishes, folder: &mut Folder, directory: &Path) -> Result<(), Stop> {
    let found = simulation.damped_modes(usize::from(wishes.count.unwrap_or(COUNT)));
    let (found, all) = found.map_err(|failure| failed(simulation, &failure))?;
    if let Some(count) = wishes.count.filter(|count| usize::from(*count) > all) {
        complain(&format!("warning: {count} modes were asked for, but the mechanism has only {all}"));
    }
    if simulation.system().has_dry_friction() {
        complain("warning: dry friction is left out of the modes: what it takes depends on the amplitude");
    }
    folder.write(DAMPED, modes::damped_list(&found))?;
    if voice::is_json() {
        let mode = |mode: &DampedMode| {
            let [real, imaginary] = mode.value;
            json!({
                "kind": matrices::word(mode.kind),
                "real": real,
                "imaginary": imaginary,
                "frequency": mode.natural_frequency / TAU,
                "damped_frequency": imaginary / TAU,
                "damping_ratio": mode.damping_ratio,
                "moves": mode.moves,
            })
        };
        voice::deliver(json!({ "damped_modes": found.iter().map(mode).collect::<Vec<_>>() }));
        return Ok(());
    }
    let head = ["mode", "frequency Hz", "damped Hz", "damping ratio", "kind", "moves most"];
    let mut rows = vec![head.map(str::to_owned)];
    for (number, mode) in found.iter().enumerate() {
        let [frequency, damped, ratio] = match mode.kind {
            PoleKind::Rigid => [const { String::new() }; 3],
            _ => [
                digits(mode.natural_frequency / TAU),
                digits(mode.value[1] / TAU),
                significant(mode.damping_ratio, RATIO_DIGITS),
            ],
        };
        let kind = matrices::word(mode.kind).to_owned();
        rows.push([(number + 1).to_string(), frequency, damped, ratio, kind, mode.moves.clone()]);
    }
    say(super::check::aligned(&rows).trim_end())?;
    note_turning(simulation)?;
    say(&format!("{DAMPED} in {}", directory.display()))
}

/// The modes for programs.
fn document(found: &Modes) -> Value {
    let mode = |mode: &Mode| {
        let omega = mode.angular_frequency();
        json!({
            "kind": word(mode),
            "frequency": omega / TAU,
            "angular_frequency": omega,
            "growth_rate": mode.growth_rate(),
            "eigenvalue": mode.eigenvalue,
            "modal_mass": mode.modal_mass,
            "damping_ratio": mode.damping_ratio,
            "mesh_error": mode.mesh_error,
            "shear": mode.shear,
            "moves": mode.moves,
        })
    };
    json!({ "modes": found.modes.iter().map(mode).collect::<Vec<_>>() })
}

fn table(found: &Modes) -> String {
    let mut rows = vec![
        ["mode", "frequency Hz", "rad/s", "damping ratio", "mesh error", "shear", "moves most"].map(str::to_owned),
    ];
    for (number, mode) in found.modes.iter().enumerate() {
        let omega = mode.angular_frequency();
        let [frequency, omega, ratio] = match mode.kind {
            Kind::Vibration => {
                let ratio = if mode.damping_ratio.abs() < SMALL_RATIO { 0.0 } else { mode.damping_ratio };
                [digits(omega / TAU), digits(omega), significant(ratio, RATIO_DIGITS)]
            }
            Kind::Free | Kind::Unstable => [pace(mode), String::new(), String::new()],
        };
        let error = mode.mesh_error.map(|error| match error {
            _ if error > 1.0 => String::from("not known"),
            _ if error < SMALL_ERROR => format!("below {}", percent(SMALL_ERROR)),
            _ => percent(error),
        });
        let shear = mode.shear.map(|shear| match shear {
            _ if shear < SMALL_SHEAR => format!("below {}", percent(SMALL_SHEAR)),
            _ => percent(shear),
        });
        let [number, error] = [(number + 1).to_string(), error.unwrap_or_default()];
        rows.push([number, frequency, omega, ratio, error, shear.unwrap_or_default(), mode.moves.clone()]);
    }
    super::check::aligned(&rows).trim_end().to_owned()
}
