//! The file as a plain tree in file order, every key and value with its place. From here on nobody sees the TOML crate.

use super::diagnostic::{Place, Report};
use super::syntax;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A key and its value.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// Where the key is written.
    pub key_place: Place,
    /// The value.
    pub item: Item,
}

/// A value and its place.
#[derive(Clone, Debug)]
pub struct Item {
    /// Where it is written.
    pub place: Place,
    /// What it is.
    pub node: Node,
}

/// A value.
#[derive(Clone, Debug)]
pub enum Node {
    /// A string.
    Text(String),
    /// A whole number.
    Integer(i64),
    /// A number that is not written as a whole one.
    Float(f64),
    /// true or false.
    Boolean(bool),
    /// A date or a time: the format has none.
    Date,
    /// A list.
    Array(Vec<Item>),
    /// A table, in file order.
    Table(Vec<Entry>),
    /// A component that an override left out: the default.
    Missing,
}

impl Node {
    /// What it is, for messages.
    pub fn describe(&self) -> String {
        match self {
            Self::Text(_) => "a string".to_owned(),
            Self::Integer(_) | Self::Float(_) => "a number".to_owned(),
            Self::Boolean(value) => format!("{value}"),
            Self::Date => "a date".to_owned(),
            Self::Array(items) => format!("a list of {}", items.len()),
            Self::Table(_) => "a table".to_owned(),
            Self::Missing => "nothing".to_owned(),
        }
    }
}

/// Reads file number `source`; syntax errors go to the report. None if what was read is not worth looking at.
pub fn parse(text: &str, source: usize, report: &mut Report<'_>) -> Option<Vec<Entry>> {
    let (table, errors) = DeTable::parse_recoverable(text);
    // What is nested too deeply is said without its place.
    let within = |range: Range<usize>| Place { source, start: range.start, end: range.end };
    let place = |error: &toml::de::Error| within(error.span().unwrap_or_else(|| syntax::most_dotted(text)));
    let mut errors: Vec<_> = errors.iter().map(|error| (place(error), error.message())).collect();
    errors.sort_by_key(|(place, _)| *place);
    let mut broken_line = None;
    let mut repeated: Vec<Range<usize>> = Vec::new();
    for (place, message) in errors {
        // What stands in a section that is given twice is not another mistake.
        if repeated.iter().any(|section| section.contains(&place.start)) {
            continue;
        }
        if message.starts_with("duplicate key") {
            let key = report.source.slice(place).to_owned();
            repeated.extend(section_of(text, place.start));
            report.error(place, &format!("`{key}` is given twice"), "the second one", "");
            continue;
        }
        // The second mistake of a line is mostly the first one once more.
        let line = report.source.line(place);
        if broken_line.replace(line) == Some(line) {
            continue;
        }
        let mistake = syntax::explain(message, text, place.start..place.end);
        report.error(within(mistake.range), &mistake.message, &mistake.label, mistake.help);
        if mistake.is_last {
            break;
        }
    }
    if broken_line.is_some() {
        return None;
    }
    let mut tree = convert_table(table.into_inner(), source, 0, report);
    remove(&mut tree, &repeated);
    Some(tree)
}

/// The bytes of the section whose header has the byte `at`; none: it is not in a header.
fn section_of(text: &str, at: usize) -> Option<Range<usize>> {
    let begin = text[..at].rfind('\n').map_or(0, |end| end + 1);
    if !text[begin..].trim_start().starts_with('[') {
        return None;
    }
    let next = text[at..].match_indices('\n').map(|(end, _)| at + end + 1);
    let end = next.into_iter().find(|start| text[*start..].trim_start_matches([' ', '\t']).starts_with('['));
    Some(at + 1..end.unwrap_or(text.len()))
}

/// Removes what stands in sections that are given twice: the parser adds it to the first one.
fn remove(entries: &mut Vec<Entry>, sections: &[Range<usize>]) {
    entries.retain(|entry| !sections.iter().any(|section| section.contains(&entry.key_place.start)));
    for entry in entries {
        if let Node::Table(inner) = &mut entry.item.node {
            remove(inner, sections);
        }
    }
}

/// Reads the value of override `source`, which stands `offset` bytes after the start of its text.
///
/// What is no TOML value is a word or an expression: a shell has taken its quotes away.
pub fn parse_override(value: &str, source: usize, offset: usize, report: &mut Report<'_>) -> Item {
    match DeValue::parse(value) {
        Ok(parsed) => convert(parsed, source, offset, report),
        Err(_) => {
            let place = Place { source, start: offset, end: offset + value.len() };
            check_characters(value, place, report);
            Item { place, node: Node::Text(value.to_owned()) }
        }
    }
}

/// Reports characters that XML cannot hold: strings of the file stand in the description of the FMU and in pictures.
fn check_characters(text: &str, place: Place, report: &mut Report<'_>) {
    if let Some(character) = text.chars().find(|character| !is_xml(*character)) {
        let message =
            format!("a string contains the character U+{:04X}, which an FMU cannot hold", u32::from(character));
        report.error(place, &message, "in this string", "remove it");
    }
}

/// Whether XML 1.0 allows a character (section 2.2).
fn is_xml(character: char) -> bool {
    match character {
        '\t' | '\n' | '\r' => true,
        '\u{fffe}' | '\u{ffff}' => false,
        _ => character >= ' ',
    }
}

fn convert_table(table: DeTable<'_>, source: usize, offset: usize, report: &mut Report<'_>) -> Vec<Entry> {
    let mut entries = Vec::with_capacity(table.len());
    for (key, value) in table {
        let span = key.span();
        let key_place = Place { source, start: span.start + offset, end: span.end + offset };
        let item = convert(value, source, offset, report);
        entries.push(Entry { key: key.into_inner().into_owned(), key_place, item });
    }
    entries.sort_by_key(|entry| entry.key_place);
    entries
}

fn convert(value: Spanned<DeValue<'_>>, source: usize, offset: usize, report: &mut Report<'_>) -> Item {
    let span = value.span();
    let place = Place { source, start: span.start + offset, end: span.end + offset };
    let node = match value.into_inner() {
        DeValue::String(text) => {
            check_characters(&text, place, report);
            Node::Text(text.into_owned())
        }
        DeValue::Integer(number) => match i64::from_str_radix(number.as_str(), number.radix()) {
            Ok(number) => Node::Integer(number),
            Err(_) => {
                report.error(place, "the number is too large", "", "write large numbers with an exponent: 1e20");
                Node::Integer(1)
            }
        },
        DeValue::Float(number) => match number.as_str().parse::<f64>() {
            Ok(number) if number.is_finite() => Node::Float(number),
            _ => {
                report.error(place, "the number is not finite", "a finite number was expected", "");
                Node::Float(1.0)
            }
        },
        DeValue::Boolean(value) => Node::Boolean(value),
        DeValue::Datetime(_) => Node::Date,
        DeValue::Array(items) => {
            Node::Array(items.into_iter().map(|item| convert(item, source, offset, report)).collect())
        }
        DeValue::Table(table) => Node::Table(convert_table(table, source, offset, report)),
    };
    Item { place, node }
}
