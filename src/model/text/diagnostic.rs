//! What is wrong with a model file, and where: the offending text underlined in its line, what was expected, what to
//! try.

pub use super::source::{Place, Source};
use std::collections::BTreeMap;
use std::fmt;

/// One mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, in one line.
    pub message: String,
    /// Where it is wrong: the order of the report.
    pub place: Place,
    /// Where its text comes from: copies of one text have one origin.
    origin: Place,
    /// Which copy it is in; empty: in none.
    note: String,
    /// How many more copies have a mistake at the same place.
    others: usize,
    location: String,
    line_number: Option<usize>,
    column: Option<usize>,
    line: String,
    underline: (usize, usize),
    label: String,
    help: String,
}

impl Diagnostic {
    /// A mistake at `place`; `label` stands behind the underlining, `help` below; both may be empty.
    pub fn new(source: &Source, place: Place, message: &str, label: &str, help: &str) -> Self {
        let told = source.told(place);
        let text = told.source.text(told.place.source);
        let start = boundary(text, told.place.start);
        let end = boundary(text, told.place.end).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[line_start..].find('\n').map_or(text.len(), |at| line_start + at);
        let line = text[line_start..line_end].trim_end_matches('\r');
        let (from, to) = ((start - line_start).min(line.len()), (end - line_start).min(line.len()));
        let (line_number, column, location) = match told.source.file_name(told.place.source) {
            Some(file_name) => {
                let number = text[..line_start].matches('\n').count() + 1;
                let column = line[..from].chars().count() + 1;
                (Some(number), Some(column), format!("{file_name}:{number}:{column}"))
            }
            None => (None, None, "in the changes to the model file".to_owned()),
        };
        let (origin, note) = (told.place, told.note.to_owned());
        let (line, underline) = excerpt(line, from, to);
        let [message, label, help] = [message, label, help].map(|text| printable(&shortened(text)));
        Self { message, place, origin, note, others: 0, location, line_number, column, line, underline, label, help }
    }
}

impl Diagnostic {
    /// The line of the file that it is about, from 1; none: it is about an override.
    pub fn line(&self) -> Option<usize> {
        self.line_number
    }

    /// The column of that line at which the wrong text begins, in characters from 1.
    pub fn column(&self) -> Option<usize> {
        self.column
    }

    /// The file with line and column, or that it is in the changes to the file: an override of the command line, of a
    /// program or of a host.
    pub fn location(&self) -> &str {
        &self.location
    }

    /// The line as it is shown.
    pub fn excerpt(&self) -> &str {
        &self.line
    }

    /// What stands behind the underlining; may be empty.
    pub fn label(&self) -> &str {
        &self.label
    }

    /// What to try; may be empty.
    pub fn help(&self) -> &str {
        &self.help
    }
}

/// The next character boundary at or below `at`.
fn boundary(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Columns of a line that are shown; longer lines are cut around the underlined text.
const WIDTH: usize = 120;

/// The line as shown, tabs as four spaces and what cannot be printed replaced, and the columns that are underlined.
fn excerpt(line: &str, from: usize, to: usize) -> (String, (usize, usize)) {
    let skipped = line[..from].chars().count().saturating_sub(WIDTH / 2);
    let first = if skipped == 0 { 0 } else { line.char_indices().nth(skipped).map_or(0, |(at, _)| at) };
    let mut shown = String::from(if first > 0 { "…" } else { "" });
    let mut column = usize::from(first > 0);
    let (mut start, mut end) = (None, column);
    for (at, c) in line.char_indices().filter(|(at, _)| *at >= first) {
        if at >= from && start.is_none() {
            start = Some(column);
        }
        if column > WIDTH {
            shown.push('…');
            break;
        }
        match c {
            '\t' => shown.push_str("    "),
            c if c.is_control() => shown.push('\u{fffd}'),
            c => shown.push(c),
        }
        column += columns(c);
        if at < to {
            end = column;
        }
    }
    let start = start.unwrap_or(column);
    (shown, (start, end.max(start + 1)))
}

/// Columns that a character takes on a terminal.
fn columns(c: char) -> usize {
    match u32::from(c) {
        0x09 => 4,
        0x300..=0x36f | 0x200b..=0x200f | 0xfe00..=0xfe0f => 0,
        0x1100..=0x115f | 0x2e80..=0xa4cf | 0xac00..=0xd7a3 | 0xf900..=0xfaff | 0xfe30..=0xfe6f => 2,
        0xff00..=0xff60 | 0xffe0..=0xffe6 | 0x1f300..=0x1faff | 0x20000..=0x3fffd => 2,
        _ => 1,
    }
}

/// Characters of a message, a label or a help that are shown: names of the file in it may be of any length.
const LONGEST: usize = 1000;

/// The beginning and the end of a text that is too long to read.
fn shortened(text: &str) -> String {
    let count = text.chars().count();
    if count <= LONGEST {
        return text.to_owned();
    }
    let half = LONGEST / 2;
    text.chars().take(half).chain([' ', '…', ' ']).chain(text.chars().skip(count - half)).collect()
}

/// Text of a file in a message: control characters could garble a terminal.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { '\u{fffd}' } else { c }).collect()
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.line_number.map_or(String::new(), |number| number.to_string());
        let gutter = " ".repeat(number.len());
        writeln!(f, "error: {}", self.message)?;
        write!(f, "{gutter}--> {}", self.location)?;
        if !self.note.is_empty() {
            write!(f, ", {}", self.note)?;
        }
        match self.others {
            0 => writeln!(f)?,
            1 => writeln!(f, " (and in another copy)")?,
            others => writeln!(f, " (and in {others} other copies)")?,
        }
        writeln!(f, "{gutter} |")?;
        writeln!(f, "{number} | {}", self.line)?;
        let (start, end) = self.underline;
        let underlined = format!("{}{} {}", " ".repeat(start), "^".repeat(end - start), self.label);
        write!(f, "{gutter} | {}", underlined.trim_end())?;
        if !self.help.is_empty() {
            write!(f, "\n{gutter} = help: {}", self.help)?;
        }
        Ok(())
    }
}

impl Diagnostics {
    /// The line of the first mistake in the file, from 1; none: all mistakes are in overrides.
    pub fn line(&self) -> Option<usize> {
        self.0.iter().find_map(Diagnostic::line)
    }
}

/// Mistakes that are shown: nobody reads more.
const MOST: usize = 100;

/// All mistakes of a file, in the order of the file, then those of the overrides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, diagnostic) in self.0.iter().take(MOST).enumerate() {
            if k > 0 {
                write!(f, "\n\n")?;
            }
            write!(f, "{diagnostic}")?;
        }
        match self.0.len().checked_sub(MOST) {
            None | Some(0) => Ok(()),
            Some(rest) => write!(f, "\n\nerror: there are {rest} mistakes more"),
        }
    }
}

impl std::error::Error for Diagnostics {}

/// The mistakes without those that further copies of a part have at the same place of the original.
pub fn told_once(list: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let mut kept: Vec<Diagnostic> = Vec::new();
    let mut places: BTreeMap<Place, (usize, Vec<String>)> = BTreeMap::new();
    for diagnostic in list {
        if diagnostic.note.is_empty() {
            kept.push(diagnostic);
            continue;
        }
        let (first, notes) = places.entry(diagnostic.origin).or_insert_with(|| (kept.len(), Vec::new()));
        if notes.first().is_none_or(|note| *note == diagnostic.note) {
            notes.push(diagnostic.note.clone());
            notes.truncate(1);
            kept.push(diagnostic);
        } else if notes.last() != Some(&diagnostic.note) {
            kept[*first].others += 1;
            notes.push(diagnostic.note);
        }
    }
    kept
}

/// Collects the mistakes while a file is read.
#[derive(Debug)]
pub struct Report<'a> {
    /// The texts that places refer to.
    pub source: &'a Source,
    list: Vec<Diagnostic>,
}

impl<'a> Report<'a> {
    /// Nothing wrong yet.
    pub fn new(source: &'a Source) -> Self {
        Self { source, list: Vec::new() }
    }

    /// One more mistake; see [`Diagnostic::new`].
    pub fn error(&mut self, place: Place, message: &str, label: &str, help: &str) {
        self.list.push(Diagnostic::new(self.source, place, message, label, help));
    }

    /// More mistakes.
    pub fn extend(&mut self, mistakes: Vec<Diagnostic>) {
        self.list.extend(mistakes);
    }

    /// Whether there are more mistakes than are shown: to look for near names is a waste of time.
    pub fn is_full(&self) -> bool {
        self.list.len() >= MOST
    }

    /// Whether there is no mistake so far.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// All of them, in the order of the file.
    pub fn finish(mut self) -> Diagnostics {
        self.list.sort_by_key(|diagnostic| diagnostic.place);
        Diagnostics(told_once(self.list))
    }
}
