//! The text of a model file while it is written.

use super::Converted;
use std::fmt::Write;

/// Columns of a key with its value before the comment.
const WIDTH: usize = 34;
/// Columns of a comment above the first section.
const COLUMNS: usize = 100;

/// A model file that is written.
#[derive(Debug, Default)]
pub struct Text {
    body: String,
    notes: Vec<String>,
}

impl Text {
    /// Begins a section.
    pub fn section(&mut self, name: &str) {
        let _ = write!(self.body, "\n[{name}]\n");
    }

    /// Writes a key with its value and a comment, which may be empty.
    pub fn key(&mut self, key: &str, value: &str, comment: &str) {
        let pair = format!("{key} = {value}");
        let _ = match comment {
            "" => writeln!(self.body, "{pair}"),
            _ => writeln!(self.body, "{pair:<WIDTH$} # {comment}"),
        };
    }

    /// Says what is not carried over, once.
    pub fn note(&mut self, text: &str) {
        if !self.notes.iter().any(|own| own == text) {
            self.notes.push(text.to_owned());
        }
    }

    /// The file, with what it says of the input file `from` at its top.
    pub fn finish(self, from: &str) -> Converted {
        let mut text = format!("# Made from {from}, an input file of MoorDyn. Units are SI, angles are in radians.\n");
        for note in &self.notes {
            let mut line = String::from("# -");
            for word in note.split_whitespace() {
                if line.len() + word.len() >= COLUMNS {
                    let _ = writeln!(text, "{line}");
                    line = String::from("#  ");
                }
                line.push(' ');
                line.push_str(word);
            }
            let _ = writeln!(text, "{line}");
        }
        let _ = write!(text, "format = 1\n{}", self.body);
        Converted { text, notes: self.notes }
    }
}

/// A number for a model file.
pub fn shown(value: f64) -> String {
    match value.abs() {
        0.0 => String::from("0"),
        size if !(1e-4..1e6).contains(&size) => format!("{value:e}"),
        _ => format!("{value}"),
    }
}

/// A vector for a model file.
pub fn listed(values: [f64; 3]) -> String {
    format!("[{}]", values.map(shown).join(", "))
}

/// A name for a model file, made of one of MoorDyn.
pub fn name(word: &str) -> String {
    let plain: String = word.chars().map(|own| if own.is_ascii_alphanumeric() { own } else { '_' }).collect();
    if plain.starts_with(|own: char| own.is_ascii_alphabetic()) { plain } else { format!("n{plain}") }
}
