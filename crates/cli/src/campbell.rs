//! `campbell`: the vibrations of a mechanism that turns, by its speed: a table, a CSV file, Campbell's diagram.

use super::{ModelArguments, Stop, complain, failed, output, say, start, voice};
use ancf14::fmi::Model;
use ancf14::model::campbell::{Campbell, Critical, Point, Sweep, Whirl};
use ancf14::model::steady::Frame;
use ancf14_report::campbell::{csv, excitation, frame, svg, word};
use ancf14_report::numbers::{significant, trimmed};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::path::PathBuf;

/// The arguments of `campbell`.
#[derive(clap::Args, Clone, Debug)]
pub struct Wishes {
    /// The drive that turns the mechanism [default: the only drive]
    #[arg(long, value_name = "NAME")]
    drive: Option<String>,
    /// Its speeds, rad/s: FIRST:LAST:STEP, or a list separated by commas
    #[arg(long, value_name = "SPEEDS", value_parser = speeds, allow_hyphen_values = true)]
    speeds: Speeds,
    /// Number of modes that are followed, the softest ones of the first speed
    #[arg(short = 'n', long, value_name = "N", default_value_t = COUNT, value_parser = super::modes::count)]
    count: u16,
    /// Leave gravity out
    #[arg(long)]
    without_gravity: bool,
    /// The table: speed, mode, frequency, damping ratio, real part, direction of whirl
    #[arg(short, long, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    /// The diagram: forward whirl solid, backward dashed, unstable thick
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
}

/// Speeds in the order of the sweep, rad/s.
#[derive(Clone, Debug)]
struct Speeds(Vec<f64>);

const COUNT: u16 = 8;
/// Most speeds of a range.
const MOST: f64 = 10_000.0;
/// Significant digits of frequencies and speeds, and of damping ratios.
const DIGITS: usize = 6;
const RATIO_DIGITS: usize = 4;

fn speeds(text: &str) -> Result<Speeds, String> {
    let expected =
        || "FIRST:LAST:STEP or speeds separated by commas were expected, in rad/s, as in 0:1500:50".to_owned();
    let numbers = |separator: char| {
        let numbers: Option<Vec<f64>> =
            text.split(separator).map(|part| part.trim().parse().ok().filter(|own: &f64| own.is_finite())).collect();
        numbers.ok_or_else(expected)
    };
    if !text.contains(':') {
        let list = numbers(',')?;
        return match list.windows(2).all(|pair| pair[0] < pair[1]) {
            true => Ok(Speeds(list)),
            false => Err("the speeds must rise from one to the next".to_owned()),
        };
    }
    let range = numbers(':')?;
    let [first, last, step] = range[..] else { return Err(expected()) };
    let count = ((last - first) / step).round();
    if !(step > 0.0 && last >= first && count <= MOST) {
        return Err(format!("a range rises from FIRST to LAST in at most {MOST} steps"));
    }
    // The last one is there, also where steps do not divide the range.
    let mut all: Vec<f64> = (0..=count as usize).map(|number| first + number as f64 * step).collect();
    all.retain(|speed| *speed < last - 1e-9 * step);
    all.push(last);
    Ok(Speeds(all))
}

/// Finds the vibrations, and writes what is asked for.
pub fn campbell(model: &ModelArguments, wishes: &Wishes) -> Result<(), Stop> {
    let outputs: Vec<PathBuf> = wishes.output.iter().chain(&wishes.plot).cloned().collect();
    output::spare(&[model.input()], &outputs)?;
    outputs.iter().try_for_each(|path| output::try_out(path))?;
    let (mut simulation, _) = model.load()?;
    start(&mut simulation)?;
    let drive = match &wishes.drive {
        Some(drive) => drive.clone(),
        None => match &simulation.system().drives[..] {
            [only] => only.name.clone(),
            drives => {
                let names: Vec<&str> = drives.iter().map(|drive| drive.name.as_str()).collect();
                let names = if names.is_empty() { String::from("none") } else { names.join(", ") };
                return Err(Stop::Bad(format!(
                    "error: --drive says which drive turns the mechanism; the model has: {names}"
                )));
            }
        },
    };
    let speeds = wishes.speeds.0.clone();
    let sweep = Sweep { drive, speeds, is_weightless: wishes.without_gravity, count: usize::from(wishes.count) };
    let found = simulation.refined_campbell(&sweep).map_err(|failure| failed(&simulation, &failure))?;
    found.warnings.iter().for_each(|warning| complain(&format!("warning: {warning}")));
    if let Some(path) = &wishes.output {
        output::write(path, csv(&found).as_bytes())?;
    }
    if let Some(path) = &wishes.plot {
        let picture = svg(&found, &simulation.about().name)
            .map_err(|reason| Stop::Failed(format!("error: cannot draw the diagram: {reason}")))?;
        output::write(path, picture.as_bytes())?;
    }
    if voice::is_json() {
        voice::deliver(document(&found));
        return Ok(());
    }
    say(&table(&found))?;
    say(&conclusion(&found))?;
    let written: Vec<String> = outputs.iter().map(|path| path.display().to_string()).collect();
    if written.is_empty() { Ok(()) } else { say(&written.join(", ")) }
}

/// A row for each mode.
fn table(found: &Campbell) -> String {
    let ends = [found.speeds.first(), found.speeds.last()].map(|speed| trimmed(speed.copied().unwrap_or(0.0), DIGITS));
    let [first, last] = ends.each_ref().map(|speed| format!("Hz at {speed} rad/s"));
    let head = ["mode", "direction", &first, &last, "damping ratio", "critical rad/s", "moves most"];
    let mut rows = vec![head.map(str::to_owned)];
    for (mode, points) in found.modes.iter().enumerate() {
        let [Some(begin), Some(end)] = [points.first(), points.last()] else { continue };
        let own = found.critical.iter().filter(|own| own.mode == mode);
        let critical: Vec<String> = own.map(|own| significant(own.speed, DIGITS)).collect();
        let hertz = |point: &Point| significant(point.frequency() / TAU, DIGITS);
        let direction = if end.whirl == Whirl::None { "" } else { word(end.whirl) };
        rows.push([
            (mode + 1).to_string(),
            direction.to_owned(),
            hertz(begin),
            hertz(end),
            significant(end.damping_ratio(), RATIO_DIGITS),
            critical.join(", "),
            found.moves[mode].clone(),
        ]);
    }
    super::check::aligned(&rows).trim_end().to_owned()
}

/// The frame, critical speeds and the limit of stability, as sentences.
fn conclusion(found: &Campbell) -> String {
    let mut lines = vec![match found.frame {
        Frame::Fixed => String::from("frequencies in the fixed frame"),
        Frame::Turning => String::from("frequencies in the frame that turns"),
    }];
    for own in &found.critical {
        let Critical { speed, mode, whirl, .. } = own;
        let whirl = if *whirl == Whirl::None { String::new() } else { format!(", {}", word(*whirl)) };
        let (speed, by) = (significant(*speed, DIGITS), excitation(found, own));
        lines.push(format!("critical speed {speed} rad/s: mode {}{whirl}, excited by {by}", mode + 1));
    }
    lines.push(match found.stability_limit {
        None => String::from("stable at all speeds"),
        Some(speed) if Some(&speed) == found.speeds.first() => format!("unstable from {speed} rad/s on"),
        Some(speed) => format!("unstable from {} rad/s on", significant(speed, DIGITS)),
    });
    lines.join("\n")
}

/// Everything for programs.
fn document(found: &Campbell) -> Value {
    let point = |point: &Point| {
        json!({
            "frequency": point.frequency() / TAU,
            "damping_ratio": point.damping_ratio(),
            "real": point.value[0],
            "imaginary": point.value[1],
            "direction": word(point.whirl),
            "unstable": point.is_unstable,
        })
    };
    let critical = |own: &Critical| {
        json!({
            "speed": own.speed,
            "mode": own.mode + 1,
            "direction": word(own.whirl),
            "excited_by": excitation(found, own),
        })
    };
    json!({
        "drive": found.drive,
        "frame": frame(found.frame),
        "speeds": found.speeds,
        "modes": found.modes.iter().map(|own| own.iter().map(point).collect::<Vec<_>>()).collect::<Vec<_>>(),
        "moves": found.moves,
        "critical_speeds": found.critical.iter().map(critical).collect::<Vec<_>>(),
        "stability_limit": found.stability_limit,
    })
}
