//! What is probably meant where a file is not valid TOML: units behind numbers, decimal commas, expressions without
//! quotes.

use std::ops::Range;

/// A slice that is repeated in a message is not longer than this, bytes.
const SHORT: usize = 40;

/// What a file that is not valid TOML probably means, for a message.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// What is wrong.
    pub message: String,
    /// What belongs at the underlined place.
    pub label: String,
    /// More about it.
    pub help: &'static str,
    /// The place, bytes of the file.
    pub range: Range<usize>,
    /// Whether what follows is read wrongly and is worth no message.
    pub is_last: bool,
}

/// The help where a number has a unit.
pub const UNITS: &str = "numbers are in SI units: 0.02 for 20 mm, pi/6 for 30 degrees";

/// What a syntax error with this message at these bytes of `text` is to somebody who does not know TOML.
pub fn explain(message: &str, text: &str, range: Range<usize>) -> Mistake {
    let start = range.start;
    let (before, slice) = (text.get(..start).unwrap_or(""), text.get(range.clone()).unwrap_or(""));
    let mistake = |message: &str, label: &str, range: Range<usize>| Mistake {
        message: message.to_owned(),
        label: label.to_owned(),
        help: "",
        range,
        is_last: false,
    };
    let line = before.rsplit('\n').next().unwrap_or("");
    let is_at_line_start = message.contains("missing comma") && line.trim().is_empty();
    if (is_at_line_start || message.contains("unclosed array"))
        && let Some(open) = open_bracket(before)
    {
        let help = "or a comma is missing at the end of one of its lines";
        let unclosed = mistake("a list has no closing `]`", "it begins here", open..open + 1);
        return Mistake { help, is_last: true, ..unclosed };
    }
    if message.contains("must be quoted") {
        if let Some(unquoted) = unquoted(slice, &range) {
            return unquoted;
        }
        if slice.trim().is_empty() && line.trim_end().ends_with('=') {
            return mistake("a key has no value", "a value was expected", range);
        }
    }
    // TOML reads the first factor of a product as a number and stops behind it.
    let first = before.len() - before.trim_end_matches(|c: char| c.is_ascii_digit() || c == '.').len();
    let whole = start - first..range.end;
    if message.contains("invalid")
        && slice.contains(['*', '/', '^', '('])
        && let Some(unquoted) = unquoted(text.get(whole.clone()).unwrap_or(""), &whole)
    {
        return unquoted;
    }
    let after = text.get(start..).unwrap_or("");
    let digits = |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let decimals = after.strip_prefix(',').map_or(0, digits);
    if message.contains("unexpected key or value") && before.ends_with(|c: char| c.is_ascii_digit()) && decimals > 0 {
        let number = before.rsplit([' ', '=', '\t', '\n']).next().unwrap_or("");
        let label = format!("{number}.{} was expected", &after[1..=decimals]);
        return mistake("a decimal number has a point, not a comma", &label, start..start + 1 + decimals);
    }
    mistake(&format!("not valid TOML: {message}"), "", range)
}

/// What is probably meant by a value that is no TOML value.
fn unquoted(value: &str, range: &Range<usize>) -> Option<Mistake> {
    let slice = value.trim();
    let mistake = |message: &str, label: String, help| {
        Some(Mistake { message: message.to_owned(), label, help, range: range.clone(), is_last: false })
    };
    let words: Vec<&str> = slice.split_whitespace().collect();
    if words.len() > 1 && words.iter().all(|word| word.parse::<f64>().is_ok()) {
        let list = format!("{} was expected", words.join(", "));
        return mistake("the numbers of a list are separated by commas", list, "");
    }
    if has_unit(slice) {
        return mistake("numbers are written without units", String::from("this one has a unit"), UNITS);
    }
    let quoted = || format!("\"{slice}\" was expected");
    if slice.is_empty() || slice.len() > SHORT || slice.contains(['"', '\'', '=', '[', ']', '{', '}']) {
        return None;
    }
    if slice.contains(['+', '-', '*', '/', '^', '(']) {
        return mistake("an expression must be in quotes", quoted(), "");
    }
    let is_word = |text: &str| text.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '@'));
    match slice.starts_with(char::is_alphabetic) && is_word(slice) {
        true => mistake("names, words and expressions must be in quotes", quoted(), ""),
        false => None,
    }
}

/// The innermost `[` that no `]` closes: no bracket of a string or a comment counts.
fn open_bracket(text: &str) -> Option<usize> {
    let mut open = Vec::new();
    let mut inside = None;
    for (at, character) in text.char_indices() {
        match (inside, character) {
            (_, '\n') => inside = None,
            (Some(end), _) if end == character => inside = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => inside = Some(character),
            (None, '#') => inside = Some('\n'),
            (None, '[') => open.push(at),
            (None, ']') => drop(open.pop()),
            (None, _) => {}
        }
    }
    open.pop()
}

/// A number and a name behind it, of which somebody may mean the product: `2t`, `2 pi`.
pub fn factors(text: &str) -> Option<[&str; 2]> {
    let is_of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let text = text.trim();
    let begin = text.find(|c: char| c.is_ascii_alphabetic() || c == '_')?;
    let (number, name) = (text[..begin].trim_end(), &text[begin..]);
    (number.parse::<f64>().is_ok() && name.chars().all(is_of_name)).then_some([number, name])
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
    fn factors_are_recognized() {
        for (text, expected) in [("2t", ["2", "t"]), ("-0.5 pi", ["-0.5", "pi"]), ("2e", ["2", "e"])] {
            assert_eq!(factors(text), Some(expected), "{text}");
        }
        for text in ["t", "2*t", "2t*t", "20", "two t", ""] {
            assert_eq!(factors(text), None, "{text}");
        }
    }

    #[test]
    fn the_open_bracket_is_found() {
        assert_eq!(open_bracket("[a]\nx = [1, 0"), Some(8));
        assert_eq!(open_bracket("x = [[1], [2, \"]\" # ]"), Some(10));
        assert_eq!(open_bracket("x = [[1], [2]\n"), Some(4));
        assert_eq!(open_bracket("[a]\nx = [1]"), None);
    }

    #[test]
    fn the_longest_key_is_found() {
        assert_eq!(most_dotted("a.b = 1\nx.y.z = 1.2\n"), 8..13);
        assert_eq!(most_dotted("[a.b.c.d]\nx.y.z = 1.2"), 0..9);
    }
}
