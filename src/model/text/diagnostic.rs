//! What is wrong with a model file, and where: the offending text underlined in its line, what was expected, what to try.

use std::fmt;

/// Where a text stands: bytes of the file or of an override.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// 0: the file; k: the k-th override.
    pub source: usize,
    /// First byte.
    pub start: usize,
    /// Byte after the last.
    pub end: usize,
}

impl Place {
    /// Bytes of the file.
    pub fn file(range: std::ops::Range<usize>) -> Self {
        Self { source: 0, start: range.start, end: range.end }
    }

    /// From the beginning of this place to the end of `last`, if both are of one text; else this place.
    pub fn to(self, last: Self) -> Self {
        let end = if last.source == self.source { last.end.max(self.end) } else { self.end };
        Self { end, ..self }
    }
}

/// The texts that a model is made of: the file and the overrides, as the messages quote them.
#[derive(Clone, Debug)]
pub struct Source {
    file_name: String,
    texts: Vec<String>,
}

/// How an override begins in a message.
pub const OVERRIDE: &str = "--set ";

impl Source {
    /// The file, and overrides as key and value.
    pub fn new(file_name: &str, text: &str, overrides: &[(String, String)]) -> Self {
        let quoted = overrides.iter().map(|(key, value)| format!("{OVERRIDE}{key}={value}"));
        Self { file_name: file_name.to_owned(), texts: std::iter::once(text.to_owned()).chain(quoted).collect() }
    }

    /// The text at a place; empty if the place is none of this source.
    pub fn slice(&self, place: Place) -> &str {
        self.texts.get(place.source).and_then(|text| text.get(place.start..place.end)).unwrap_or("")
    }

    /// The end of the file: where something is missing.
    pub fn end(&self) -> Place {
        let end = self.texts.first().map_or(0, |text| text.trim_end().len());
        Place::file(end..end)
    }

    /// Number of the line of a place of the file, from 1.
    pub fn line(&self, place: Place) -> usize {
        self.texts.first().and_then(|text| text.get(..place.start)).map_or(1, |before| before.matches('\n').count() + 1)
    }

    /// The place of a part of a string value: `range` counts in the decoded string. The whole value where that cannot be said.
    pub fn inside(&self, place: Place, decoded: &str, range: std::ops::Range<usize>) -> Place {
        let raw = self.slice(place);
        let quotes = ["", "\"", "'", "\"\"\"", "'''"];
        let fits = |quote: &&&str| {
            raw.strip_prefix(**quote).and_then(|raw| raw.strip_suffix(**quote)).is_some_and(|inner| inner == decoded)
        };
        match quotes.iter().find(fits) {
            Some(quote) => Place {
                source: place.source,
                start: place.start + quote.len() + range.start,
                end: place.start + quote.len() + range.end,
            },
            None => place,
        }
    }
}

/// One mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, in one line.
    pub message: String,
    /// Where it is wrong: the order of the report.
    pub place: Place,
    location: String,
    line_number: Option<usize>,
    line: String,
    underline: (usize, usize),
    label: String,
    help: String,
}

impl Diagnostic {
    /// A mistake at `place`; `label` stands behind the underlining, `help` below; both may be empty.
    pub fn new(source: &Source, place: Place, message: &str, label: &str, help: &str) -> Self {
        let text = source.texts.get(place.source).map_or("", String::as_str);
        let start = boundary(text, place.start);
        let end = boundary(text, place.end).max(start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[line_start..].find('\n').map_or(text.len(), |at| line_start + at);
        let line = text[line_start..line_end].trim_end_matches('\r');
        let (from, to) = ((start - line_start).min(line.len()), (end - line_start).min(line.len()));
        let (line_number, location) = if place.source == 0 {
            let number = text[..line_start].matches('\n').count() + 1;
            let column = line[..from].chars().count() + 1;
            (Some(number), format!("{}:{number}:{column}", source.file_name))
        } else {
            (None, "on the command line".to_owned())
        };
        let (line, underline) = excerpt(line, from, to);
        let [message, label, help] = [message, label, help].map(|text| printable(&shortened(text)));
        Self { message, place, location, line_number, line, underline, label, help }
    }
}

impl Diagnostic {
    /// The line of the file that it is about, from 1; none: it is about an override.
    pub fn line(&self) -> Option<usize> {
        self.line_number
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
        writeln!(f, "{gutter}--> {}", self.location)?;
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
        Diagnostics(self.list)
    }
}
