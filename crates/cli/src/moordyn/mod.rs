//! `new --from-moordyn`: a model file from an input file of MoorDyn.
//!
//! Lines become beams between joints without moments, coupled points and bodies are carried by frames that a host moves, the bottom
//! becomes `[seabed]`. Whatever has no counterpart is told.

mod deck;
mod ends;
mod lines;
mod text;

use self::deck::Deck;
use self::ends::Ends;
use self::text::{Text, shown};

/// A model file, and what it leaves out of the input file, a sentence each.
#[derive(Debug)]
pub struct Converted {
    /// The model file.
    pub text: String,
    /// Remarks on input that it does not carry over, or carries over in another way.
    pub notes: Vec<String>,
}

/// Options that have no counterpart because another solver needs none of them.
const OF_THE_SOLVER: [&str; 24] = [
    "writelog",
    "writeunits",
    "echo",
    "dtm",
    "cfl",
    "dtout",
    "dtic",
    "tmaxic",
    "tmax",
    "threshic",
    "fileic",
    "cdscaleic",
    "icdfac",
    "icgendynamic",
    "tscheme",
    "disableouttime",
    "disableouttimes",
    "outlist",
    "inertialf",
    "inertialf_rampt",
    "outswitch",
    "fricdamp",
    "statdynfricscale",
    "icdt",
];
/// Options that are carried over.
const CARRIED: [&str; 14] = [
    "g",
    "gravity",
    "wtrdnsty",
    "rhow",
    "wtrdpth",
    "depth",
    "kbot",
    "kb",
    "cbot",
    "cb",
    "frictioncoefficient",
    "mu_kt",
    "mu_ka",
    "mc",
];
/// Values that MoorDyn takes where the file has none.
const GRAVITY: f64 = 9.80665;
const DENSITY: f64 = 1025.0;
const BOTTOM: [f64; 2] = [3e6, 3e5];

/// The model `title` of the input file `from` with the text `input`.
///
/// # Errors
/// The input cannot be read, as a sentence with its line.
pub fn convert(title: &str, from: &str, input: &str) -> Result<Converted, String> {
    let deck = Deck::read(input)?;
    let mut out = Text::default();
    let mut ends = Ends::read(&deck)?;
    lines::find_vessel(&deck, &mut ends)?;
    write_surroundings(&deck, title, &ends, &mut out)?;
    lines::write_sections(&deck, &mut out)?;
    ends.write(&mut out);
    lines::write_rods(&deck, &ends, &mut out)?;
    lines::write_lines(&deck, &ends, &mut out)?;
    note_rest(&deck, &mut out);
    out.section("simulation");
    out.key("initial", "\"equilibrium\"", "the vessel at its position above, without waves");
    out.key("stop", "60", "s");
    out.key("step", "0.05", "s");
    Ok(out.finish(from))
}

/// Writes model, water and seabed.
fn write_surroundings(deck: &Deck, title: &str, ends: &Ends, out: &mut Text) -> Result<(), String> {
    out.section("model");
    out.key("name", &format!("\"{title}\""), "");
    let gravity = deck.option(&["g", "gravity"])?.unwrap_or(GRAVITY).abs();
    out.key("gravity", &format!("[0, 0, {}]", shown(-gravity)), "m/s2");
    out.section("water");
    out.key("density", &shown(deck.option(&["wtrdnsty", "rhow"])?.unwrap_or(DENSITY)), "kg/m3");
    let depth = match deck.option(&["wtrdpth", "depth"])? {
        Some(depth) => Some(depth.abs()),
        None => {
            out.note("The file has no WtrDpth: the bottom of the water is taken to be at its lowest point.");
            ends.lowest().map(|lowest| -lowest)
        }
    };
    let Some(depth) = depth.filter(|depth| *depth > 0.0) else { return Ok(()) };
    out.key("depth", &shown(depth), "m");
    out.section("seabed");
    let bottom = [deck.option(&["kbot", "kb"])?, deck.option(&["cbot", "cb"])?];
    let [stiffness, damping] = [0, 1].map(|at| bottom[at].unwrap_or(BOTTOM[at]));
    out.key("stiffness", &shown(stiffness), "Pa/m");
    out.key("damping", &shown(damping), "Pa s/m");
    out.key("contact", "\"axis\"", "as MoorDyn has it; \"outside\" is half a diameter below the axis");
    let both = deck.option(&["frictioncoefficient"])?;
    let [across, along] = [deck.option(&["mu_kt"])?.or(both), deck.option(&["mu_ka"])?.or(both)];
    match [along, across].map(|own| own.unwrap_or(0.0)) {
        [0.0, 0.0] => {}
        [along, across] if along == across => out.key("friction", &shown(along), ""),
        [along, across] => out.key("friction", &format!("[{}, {}]", shown(along), shown(across)), "along, across"),
    }
    Ok(())
}

/// Tells what is left.
fn note_rest(deck: &Deck, out: &mut Text) {
    for (section, name) in [("control", "CONTROL"), ("failure", "FAILURE")] {
        if let [first, ..] = deck.rows(section) {
            let hint = match section {
                "failure" => "a joint with `active` lets go",
                _ => "a winch, [winch.NAME], works outside of the water only",
            };
            out.note(&format!("The section {name} (line {}) is not carried over: {hint}.", first.line));
        }
    }
    for (title, line) in &deck.unknown {
        out.note(&format!("The section {title} (line {line}) is not known, and not carried over."));
    }
    let known: Vec<&str> = OF_THE_SOLVER.iter().chain(&CARRIED).copied().collect();
    for (key, value) in deck.other_options(&known) {
        if ["0", "0.0", "-", "false"].contains(&value.to_lowercase().as_str()) {
            continue;
        }
        let hint = match key {
            "wavekin" | "wavekinfile" => ": give waves as [wave.NAME]",
            "currents" | "currentsfile" | "current" => ": give `current` in [water]",
            _ => "",
        };
        out.note(&format!("The option {key} = {value} is not carried over{hint}."));
    }
}
