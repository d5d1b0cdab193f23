//! Natural modes as text: their tables as CSV, and how a mode goes on in words.

use crate::matrices;
use crate::numbers::{shortest, significant};
use ancf14::model::modes::{DampedMode, Kind, Mode, Modes};

/// How a mode goes on, in a few words.
pub fn pace(mode: &Mode) -> String {
    match mode.kind {
        Kind::Vibration => format!("{} Hz", digits(mode.angular_frequency() / std::f64::consts::TAU)),
        Kind::Free => "free".to_owned(),
        Kind::Unstable => format!("unstable, grows with rate {} 1/s", digits(mode.growth_rate())),
    }
}

/// The kind of a mode in a table.
pub fn word(mode: &Mode) -> &'static str {
    match mode.kind {
        Kind::Vibration => "vibration",
        Kind::Free => "free",
        Kind::Unstable => "unstable",
    }
}

/// Six significant digits, without an exponent where that is as short.
pub fn digits(value: f64) -> String {
    significant(value, 6)
}

/// The text of modes.csv: a row a mode.
pub fn list(found: &Modes) -> String {
    let mut text =
        "mode,kind,frequency,angular_frequency,growth_rate,eigenvalue,modal_mass,damping_ratio,mesh_error,shear,moves\n"
            .to_owned();
    for (number, mode) in found.modes.iter().enumerate() {
        let (kind, omega) = (word(mode), mode.angular_frequency());
        let frequency = omega / std::f64::consts::TAU;
        let numbers = [frequency, omega, mode.growth_rate(), mode.eigenvalue, mode.modal_mass, mode.damping_ratio];
        let (numbers, error) = (numbers.map(shortest).join(","), mode.mesh_error.map(shortest).unwrap_or_default());
        text.push_str(&format!(
            "{},{kind},{numbers},{error},{},\"{}\"\n",
            number + 1,
            mode.shear.map(shortest).unwrap_or_default(),
            mode.moves
        ));
    }
    text
}

/// The text of damped_modes.csv: a row a mode.
pub fn damped_list(found: &[DampedMode]) -> String {
    let mut text = "mode,kind,frequency,damped_frequency,damping_ratio,real,imaginary,moves\n".to_owned();
    for (number, mode) in found.iter().enumerate() {
        let [real, imaginary] = mode.value;
        let tau = std::f64::consts::TAU;
        let numbers = [mode.natural_frequency / tau, imaginary / tau, mode.damping_ratio, real, imaginary];
        let (kind, numbers) = (matrices::word(mode.kind), numbers.map(shortest).join(","));
        text.push_str(&format!("{},{kind},{numbers},\"{}\"\n", number + 1, mode.moves));
    }
    text
}

/// The text of shapes.csv: a row for each place of each mode.
pub fn shapes(found: &Modes) -> String {
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
