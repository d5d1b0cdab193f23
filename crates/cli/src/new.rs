//! `new`: a commented model file to start from.

use super::voice::{print, say};
use super::{Stop, moordyn, output};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A model that runs as it is.
struct Template {
    name: &'static str,
    about: &'static str,
    text: &'static str,
    /// What differs from that text: a template runs without a warning, where an example may show one.
    changes: &'static [[&'static str; 2]],
}

/// All of them, the simplest first.
const TEMPLATES: [Template; 9] = [
    Template {
        name: "beam",
        about: "a clamped beam with a force at its end",
        text: include_str!("../templates/beam.toml"),
        changes: &[],
    },
    Template {
        name: "pendulum",
        about: "two flexible beams hinged to each other",
        text: include_str!("../../../models/pendulum.toml"),
        changes: &[
            ["quantities = [\"axial_strain\", \"curvature\"]", "quantities = [\"position\"]"],
            ["step = 2e-3", "step = 1e-3"],
        ],
    },
    Template {
        name: "cable",
        about: "a slack cable between two masts, in gusts of wind",
        text: include_str!("../templates/cable.toml"),
        changes: &[],
    },
    Template {
        name: "rotor",
        about: "an unbalanced disk on a flexible shaft, run up through its critical speed",
        text: include_str!("../templates/rotor.toml"),
        changes: &[],
    },
    Template {
        name: "linkage",
        about: "a four-bar linkage of flexible bars, with a drive",
        text: include_str!("../../../models/four_bar.toml"),
        changes: &[
            ["rate = \"speed\"", "rate = \"speed*smoothstep(0, 2, t)\""],
            ["driven at constant speed;", "started smoothly, then driven at constant speed;"],
            ["\nstep = 4e-3", "\nstep = 2e-3"],
        ],
    },
    Template {
        name: "robot",
        about: "a flexible arm moved by two motors",
        text: include_str!("../../../models/robot.toml"),
        changes: &[],
    },
    Template {
        name: "crane",
        about: "a boom with a load on a rope, whose foot a host drives",
        text: include_str!("../../../models/crane.toml"),
        changes: &[],
    },
    Template {
        name: "spring",
        about: "a helical spring, curved as drawn, pulled along its axis",
        text: include_str!("../../../models/helical_spring.toml"),
        changes: &[],
    },
    Template {
        name: "wheel",
        about: "a bicycle wheel: spokes by copies, equilibrium under a load",
        text: include_str!("../../../models/bicycle_wheel.toml"),
        changes: &[
            ["elements = \"2*spokes\"", "elements = \"4*spokes\""],
            ["rim.node[2*k - 2]", "rim.node[4*k - 4]"],
            ["rim.node[3*spokes/2]", "rim.node[3*spokes]"],
            ["rim.node[spokes/2]", "rim.node[spokes]"],
        ],
    },
];

/// Lists the templates.
pub fn list() -> Result<(), Stop> {
    let width = TEMPLATES.iter().map(|template| template.name.len()).max().unwrap_or(0);
    TEMPLATES.iter().try_for_each(|template| print(&format!("{:<width$}  {}", template.name, template.about)))
}

/// Writes the model file `name` from the template `from`. A file that is there is kept.
pub fn new(name: &Path, from: &str) -> Result<(), Stop> {
    let bad = |message: String| Err(Stop::Bad(format!("error: {message}")));
    let Some(template) = TEMPLATES.iter().find(|template| template.name == from) else {
        let names = TEMPLATES.map(|template| template.name).join(", ");
        return bad(format!("there is no template `{from}`; the templates are {names}"));
    };
    let (file, title) = file_of(name)?;
    let changed = template.changes.iter().fold(template.text.to_owned(), |text, [old, new]| text.replace(old, new));
    let mut text = named(&changed, &title, &file);
    if !text.starts_with('#') {
        let about = template.about;
        let about = about[..1].to_uppercase() + &about[1..];
        text.insert_str(0, &format!("# {about}. Units are SI, angles are in radians.\n"));
    }
    output::write(&file, text.as_bytes())?;
    say(&format!("{0} written from the template {from}; next: ancf14 view {0}", file.display()))
}

/// Writes the model file `name` from the input file `from` of MoorDyn. A file that is there is kept.
pub fn converted(name: &Path, from: &Path) -> Result<(), Stop> {
    let (file, title) = file_of(name)?;
    let shown = from.display();
    let input = std::fs::read(from).map_err(|error| Stop::Bad(format!("error: cannot read {shown}: {error}")))?;
    // Comments may have signs of any encoding.
    let input = String::from_utf8_lossy(&input);
    let own = from.file_name().unwrap_or(from.as_os_str()).to_string_lossy();
    let made = moordyn::convert(&title, &own, &input)
        .map_err(|message| Stop::Bad(format!("error: {shown} cannot be converted: {message}")))?;
    output::write(&file, made.text.as_bytes())?;
    made.notes.iter().try_for_each(|note| say(&format!("not the same: {note}")))?;
    say(&format!("{0} written from {shown}; next: ancf14 view {0}", file.display()))
}

/// The file of a model that is to be written, and the name of the model.
fn file_of(name: &Path) -> Result<(PathBuf, String), Stop> {
    let bad = |message: String| Err(Stop::Bad(format!("error: {message}")));
    let file = match name.extension() {
        Some(ending) if ending == "toml" => name.to_owned(),
        _ => PathBuf::from(format!("{}.toml", name.display())),
    };
    if file.exists() {
        return bad(format!("{} exists; choose another name", file.display()));
    }
    match title(file.file_stem().unwrap_or(OsStr::new(""))) {
        Some(title) => Ok((file, title)),
        None => bad(format!("{} is no name for a model; give one with a letter, as crane", name.display())),
    }
}

/// The name of the model in a file: `slack_cable` to `SlackCable`. None: there is no letter in it.
fn title(stem: &OsStr) -> Option<String> {
    let stem = stem.to_str()?;
    let words = stem.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let title: String = words.map(|word| word[..1].to_ascii_uppercase() + &word[1..]).collect();
    title.starts_with(|letter: char| letter.is_ascii_alphabetic()).then_some(title)
}

/// A template with the name of the model, and of the file where it speaks of itself.
fn named(text: &str, title: &str, file: &Path) -> String {
    let name = |line: &str| line.starts_with("name = \"");
    let mut is_named = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        if name(line) && !is_named {
            is_named = true;
            lines.push(format!("name = \"{title}\""));
        } else if let Some((before, after)) = line.split_once("models/") {
            let rest = after.find(".toml").map_or(after, |end| &after[end + 5..]);
            lines.push(format!("{before}{}{rest}", file.display()));
        } else if !line.contains("tests/references") {
            lines.push(line.to_owned());
        }
    }
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A change of a text that is not in it would be lost.
    #[test]
    fn every_change_of_a_template_is_made() {
        for template in &TEMPLATES {
            for [old, _] in template.changes {
                assert!(template.text.contains(old), "{}: {old}", template.name);
            }
        }
    }
}
