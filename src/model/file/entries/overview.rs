//! `[model]`: name, description, who made it when and under which terms, gravity.

use crate::fmi::Credits;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Rule};
use crate::model::text::names::identifier;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::word("name", &[], "the name of the model"),
    Key::word("description", &[], "one sentence about it"),
    Key::word("author", &[], "who made it"),
    Key::word("version", &[], "its version"),
    Key::word("license", &[], "its license"),
    Key::word("copyright", &[], "its copyright"),
    Key::word("date", &[], "when it was made"),
    Key::list(&[&GRAVITY], "3"),
];

const GRAVITY: Rule = Rule::new("gravity", "acceleration of gravity in global axes", "m/s2").tunable();

/// The section `[model]`.
#[derive(Clone, Debug)]
pub struct ModelSpec {
    /// Free text: FMI's modelName.
    pub name: String,
    /// The name as a C identifier: FMI's modelIdentifier.
    pub identifier: String,
    /// One sentence; may be empty.
    pub description: String,
    /// Who made it, when, and under which terms; free texts but for the date.
    pub credits: Credits,
    /// Acceleration of gravity, global axes, m/s².
    pub gravity: [Number; 3],
}

impl ModelSpec {
    pub(in crate::model) fn read(mut reader: Reader<'_, '_>) -> Self {
        let written = reader.has("name");
        let name = match reader.text("name") {
            Some((name, place)) => {
                if name.trim().is_empty() {
                    reader.context.report.error(place, "the model's name is empty", "a name was expected", "");
                }
                name
            }
            None => {
                if !written {
                    reader.missing("name", "a string: the name of the model");
                }
                String::new()
            }
        };
        let description = reader.text("description").map_or(String::new(), |(text, _)| text);
        let mut text = |key| reader.text(key).map(|(text, _)| text);
        let [author, version, license, copyright] = ["author", "version", "license", "copyright"].map(&mut text);
        let date = date(&mut reader);
        let credits = Credits { author, version, license, copyright, date };
        let gravity = reader.vector_or(&GRAVITY, [0.0; 3]);
        reader.finish();
        Self { identifier: identifier(&name), name, description, credits, gravity }
    }
}

/// The date of the file as FMI writes dates; a day alone is its beginning.
fn date(reader: &mut Reader<'_, '_>) -> Option<String> {
    let (text, place) = reader.text("date")?;
    let whole = if text.contains('T') { text.clone() } else { format!("{text}T00:00:00Z") };
    if is_date(&whole) {
        return Some(whole);
    }
    let message = format!("`date` is \"{text}\"");
    reader.context.report.error(
        place,
        &message,
        "a day like \"2026-03-31\" or \"2026-03-31T12:00:00Z\" was expected",
        "",
    );
    None
}

/// `2026-03-31T12:00:00Z`: digits where digits belong, months, days and times that there can be.
fn is_date(text: &str) -> bool {
    let pattern = text.bytes().map(|byte| if byte.is_ascii_digit() { b'0' } else { byte });
    if !pattern.eq(*b"0000-00-00T00:00:00Z") {
        return false;
    }
    let two = |at: usize| text[at..at + 2].parse::<u32>().unwrap_or(u32::MAX);
    (1..=12).contains(&two(5)) && (1..=31).contains(&two(8)) && two(11) < 24 && two(14) < 60 && two(17) < 60
}
