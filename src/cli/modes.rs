//! `modes`: natural frequencies and shapes about the initial state, as a table, as CSV files and as a picture.

use super::folder::Folder;
use super::output::Input;
use super::results::shortest;
use super::view::Film;
use super::{Stop, complain, failed, say, shapes, start};
use ancf14::fmi::Model;
use ancf14::model::entries::simulation::Analysis;
use ancf14::model::modes::{Kind, Mode, Modes};
use ancf14::model::simulation::Simulation;
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
}

/// Modes that are found where no number is given.
pub const COUNT: u16 = 10;
/// The page in which the shapes swing.
const PAGE: &str = "modes.html";
/// What is always written.
const FILES: [&str; 3] = ["modes.csv", "shapes.csv", "modes.svg"];

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
            "error: --time is for analysis = \"static\"; other modes are those of the start".to_owned(),
        ));
    }
    let stop = simulation.about().stop;
    if let Some(time) = wishes.time.filter(|time| *time > stop) {
        return Err(Stop::Bad(format!(
            "error: --time {time} is after the end of the analysis: simulation.stop is {stop} s"
        )));
    }
    let mut folder = Folder::open(directory)?;
    let names = FILES.iter().chain(wishes.view.then_some(&PAGE)).map(|name| (*name).to_owned());
    folder.claim("modes", &simulation.about().guid, &names.collect::<Vec<_>>(), inputs)?;
    let film = wishes.view.then(|| Film::new(&simulation, 0));
    start(&mut simulation)?;
    if let Some(time) = wishes.time.filter(|time| *time > 0.0) {
        let advanced = simulation.advance(time);
        simulation.take_warnings().iter().for_each(|warning| complain(&format!("warning: {warning}")));
        advanced.map_err(|failure| failed(&simulation, &failure))?;
    }
    let found = simulation.modes(usize::from(wishes.count.unwrap_or(COUNT)));
    let found = found.map_err(|failure| failed(&simulation, &failure))?;
    if let Some(count) = wishes.count.filter(|count| usize::from(*count) > found.modes.len()) {
        complain(&format!("warning: {count} modes were asked for, but the mechanism has only {}", found.modes.len()));
    }
    found.warnings.iter().for_each(|warning| complain(&format!("warning: {warning}")));
    let texts = [modes_csv(&found), shapes_csv(&found), shapes::svg(&found, &simulation.about().name)];
    for (name, text) in FILES.iter().zip(texts) {
        folder.write(name, &text)?;
    }
    if let Some(mut film) = film {
        film.look(0, &simulation);
        film.add_modes(&simulation, &found);
        folder.write(PAGE, &film.page()?)?;
    }
    say(&table(&found))?;
    if wishes.view {
        say(&format!("open {} in a browser to see them swing", folder.file(PAGE).display()))?;
    }
    say(&format!("modes.csv, shapes.csv and modes.svg in {}", directory.display()))
}

/// How a mode goes on, in a few words.
pub fn pace(mode: &Mode) -> String {
    match mode.kind {
        Kind::Vibration => format!("{} Hz", digits(mode.angular_frequency() / std::f64::consts::TAU)),
        Kind::Free => "free".to_owned(),
        Kind::Unstable => format!("unstable, grows with rate {} 1/s", digits(mode.growth_rate())),
    }
}

/// Six significant digits, without an exponent where that is as short.
fn digits(value: f64) -> String {
    let before = value.abs().log10().floor().clamp(-300.0, 300.0) as i32 + 1;
    if (-3..=9).contains(&before) {
        format!("{value:.*}", (6 - before).max(0) as usize)
    } else {
        format!("{value:.5e}")
    }
}

fn table(found: &Modes) -> String {
    let mut rows = vec![["mode", "frequency Hz", "rad/s", "moves most"].map(str::to_owned)];
    for (number, mode) in found.modes.iter().enumerate() {
        let omega = mode.angular_frequency();
        let [frequency, omega] = match mode.kind {
            Kind::Vibration => [digits(omega / std::f64::consts::TAU), digits(omega)],
            Kind::Free | Kind::Unstable => [pace(mode), String::new()],
        };
        rows.push([(number + 1).to_string(), frequency, omega, mode.moves.clone()]);
    }
    super::check::aligned(&rows).trim_end().to_owned()
}

fn modes_csv(found: &Modes) -> String {
    let mut text = "mode,kind,frequency,angular_frequency,growth_rate,eigenvalue,modal_mass,moves\n".to_owned();
    for (number, mode) in found.modes.iter().enumerate() {
        let kind = match mode.kind {
            Kind::Vibration => "vibration",
            Kind::Free => "free",
            Kind::Unstable => "unstable",
        };
        let omega = mode.angular_frequency();
        let numbers = [omega / std::f64::consts::TAU, omega, mode.growth_rate(), mode.eigenvalue, mode.modal_mass];
        let numbers = numbers.map(shortest).join(",");
        text.push_str(&format!("{},{kind},{numbers},\"{}\"\n", number + 1, mode.moves));
    }
    text
}

fn shapes_csv(found: &Modes) -> String {
    let vector = |name: &str| [1, 2, 3].map(|axis| format!("{name}[{axis}]")).join(",");
    let mut text = format!("mode,place,{},{},{}\n", vector("position"), vector("displacement"), vector("turn"));
    for (number, mode) in found.modes.iter().enumerate() {
        for (place, motion) in found.places.iter().zip(&mode.motions) {
            let vectors = [place.position, motion.displacement, motion.turn];
            let numbers: Vec<_> = vectors.iter().flatten().map(|value| shortest(*value)).collect();
            text.push_str(&format!("{},{},{}\n", number + 1, place.name, numbers.join(",")));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of a table have six digits, whatever their size.
    #[test]
    fn six_digits_are_shown() {
        for (value, text) in [
            (9.0609999, "9.06100"),
            (56.932, "56.9320"),
            (123456.7, "123457"),
            (1.5e-7, "1.50000e-7"),
            (0.0123, "0.0123000"),
        ] {
            assert_eq!(digits(value), text);
        }
    }
}
