//! What is probably meant where a file is not valid TOML: units behind numbers, decimal commas, expressions without quotes.

use std::ops::Range;

/// A slice that is repeated in a hint is not longer than this, bytes.
const SHORT: usize = 40;

/// What to try after a syntax error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hint {
    /// Nothing comes to mind.
    None,
    /// This.
    Text(String),
    /// A list has no end: what follows is read as a part of it, and is worth no message.
    Unclosed,
}

impl Hint {
    /// As a message shows it.
    pub fn text(&self) -> &str {
        match self {
            Self::None => "",
            Self::Text(text) => text,
            Self::Unclosed => "the list above has no closing `]`, or a comma is missing at the end of its line",
        }
    }
}

/// What to try after a syntax error with this message at these bytes of `text`.
pub fn hint(message: &str, text: &str, range: Range<usize>) -> Hint {
    let start = range.start;
    let (before, slice) = (text.get(..start).unwrap_or(""), text.get(range).unwrap_or(""));
    if message.contains("must be quoted") {
        return unquoted(slice.trim());
    }
    let after = text.get(start..).unwrap_or("");
    let comma = |text: &str| text.strip_prefix(',').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    if message.contains("unexpected key or value") && before.ends_with(|c: char| c.is_ascii_digit()) && comma(after) {
        return Hint::Text(String::from("a decimal number has a point: 0.02, not 0,02"));
    }
    let line = before.rsplit('\n').next().unwrap_or("");
    if message.contains("missing comma") && line.trim().is_empty() { Hint::Unclosed } else { Hint::None }
}

/// What is probably meant by a value that is no TOML value.
fn unquoted(slice: &str) -> Hint {
    let numbers = |text: &str| text.split_whitespace().all(|word| word.parse::<f64>().is_ok());
    if slice.contains(' ') && numbers(slice) {
        return Hint::Text(String::from("commas separate the numbers of a list: [1, 0, 0]"));
    }
    if has_unit(slice) {
        return Hint::Text(String::from("a number stands without its unit, in SI units: 0.02 for 20 mm"));
    }
    let is_expression = slice.contains(['+', '-', '*', '/', '^', '(']);
    match is_expression && slice.len() <= SHORT && !slice.contains('"') {
        true => Hint::Text(format!("an expression stands in quotes: \"{slice}\"")),
        false => Hint::None,
    }
}

/// Whether a text is a number and a unit behind it: `20 mm`, `7.85e3 kg/m3`.
pub fn has_unit(text: &str) -> bool {
    let is_letter = |c: char| c.is_alphabetic() || c == '\u{b0}' || c == '%';
    let text = text.trim();
    let (number, unit) = match text.split_once(char::is_whitespace) {
        Some((number, unit)) => (number, unit.trim_start()),
        None => text.split_at(text.find(|c: char| is_letter(c) && !matches!(c, 'e' | 'E')).unwrap_or(text.len())),
    };
    let is_plain =
        |c: char| is_letter(c) || c.is_ascii_digit() || matches!(c, '/' | '.' | '^' | '*' | '\u{b2}' | '\u{b3}');
    number.parse::<f64>().is_ok() && unit.starts_with(is_letter) && unit.chars().all(is_plain)
}

/// The line with the longest dotted key.
pub fn most_dotted(text: &str) -> Range<usize> {
    let mut start = 0;
    let mut found = (0, 0..0);
    for line in text.split_inclusive('\n') {
        let key = line.split(['=', '#', '"', '\'']).next().unwrap_or("").trim_end();
        let dots = key.matches('.').count();
        if dots > found.0 {
            found = (dots, start..start + key.len());
        }
        start += line.len();
    }
    found.1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_recognized() {
        for text in ["20 mm", "20mm", "7.85e3 kg/m3", "90 deg", "-1.5 m", "30°", "2 %"] {
            assert!(has_unit(text), "{text}");
        }
        for text in ["20", "1e3", "2*t", "1 0 0", "mm", "steel", "", "1 - t"] {
            assert!(!has_unit(text), "{text}");
        }
    }

    #[test]
    fn the_longest_key_is_found() {
        assert_eq!(most_dotted("a.b = 1\nx.y.z = 1.2\n"), 8..13);
        assert_eq!(most_dotted("[a.b.c.d]\nx.y.z = 1.2"), 0..9);
    }
}
