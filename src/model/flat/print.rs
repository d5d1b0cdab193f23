//! The flat model as the text of a file, and where each part of it comes from.

use crate::model::text::source::{Place, Source, Span};
use crate::model::text::tree::{Entry, Item, Node};

/// A section of the flat model.
#[derive(Clone, Debug)]
pub(super) struct Section {
    /// Its word.
    pub key: String,
    /// Where the word is written.
    pub key_place: Place,
    /// Its entries, each with the number of its note.
    pub entries: Vec<(Entry, usize)>,
}

/// Lists of lists longer than this have a line for each inner list.
const ONE_LINE: usize = 4;

/// Writes text and keeps where it comes from.
struct Printer<'s> {
    source: &'s Source,
    text: String,
    spans: Vec<Span>,
    note: usize,
}

/// The text of the values that stand in no section, and of the sections.
pub(super) fn print(source: &Source, values: &[Entry], sections: &[Section]) -> (String, Vec<Span>) {
    let mut printer = Printer { source, text: String::new(), spans: Vec::new(), note: 0 };
    values.iter().for_each(|entry| printer.line(entry));
    for section in sections {
        printer.section(section);
    }
    (printer.text, printer.spans)
}

impl Printer<'_> {
    fn section(&mut self, section: &Section) {
        let is_named = section.key != "parameters";
        let is_table = |entry: &Entry| is_named && matches!(entry.item.node, Node::Table(_));
        let plain: Vec<_> = section.entries.iter().filter(|(entry, _)| !is_table(entry)).collect();
        if !plain.is_empty() || section.entries.is_empty() {
            self.header(section, None);
            for (entry, note) in plain {
                self.note = *note;
                self.line(entry);
            }
        }
        for (entry, note) in section.entries.iter().filter(|(entry, _)| is_table(entry)) {
            self.note = *note;
            self.header(section, Some(entry));
            if let Node::Table(inner) = &entry.item.node {
                inner.iter().for_each(|entry| self.line(entry));
            }
        }
        self.note = 0;
    }

    fn header(&mut self, section: &Section, thing: Option<&Entry>) {
        self.text.push_str("\n[");
        self.key(&section.key, section.key_place);
        if let Some(thing) = thing {
            self.text.push('.');
            self.key(&thing.key, thing.key_place);
        }
        self.text.push_str("]\n");
    }

    fn line(&mut self, entry: &Entry) {
        self.key(&entry.key, entry.key_place);
        self.text.push_str(" = ");
        self.value(&entry.item);
        self.text.push('\n');
    }

    fn key(&mut self, key: &str, place: Place) {
        let at = self.open(place);
        let is_bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
        if is_bare {
            self.text.push_str(key)
        } else {
            self.quoted(key)
        }
        self.close(at);
    }

    /// Begins a part that comes from `place`; outer parts begin first.
    fn open(&mut self, place: Place) -> usize {
        let start = self.text.len();
        self.spans.push(Span { range: start..start, place, note: self.note });
        self.spans.len() - 1
    }

    fn close(&mut self, at: usize) {
        self.spans[at].range.end = self.text.len();
    }

    fn value(&mut self, item: &Item) {
        let at = self.open(item.place);
        match &item.node {
            Node::Text(text) => self.quoted(text),
            Node::Integer(value) => self.text.push_str(&value.to_string()),
            Node::Float(value) => self.text.push_str(&format!("{value:?}")),
            Node::Boolean(value) => self.text.push_str(&value.to_string()),
            Node::Date => {
                let date = self.source.slice(item.place).to_owned();
                self.text.push_str(&date);
            }
            Node::Array(items) => {
                let has_lines = items.len() > ONE_LINE && matches!(items[0].node, Node::Array(_) | Node::Table(_));
                let (first, next) = if has_lines { ("[\n    ", ",\n    ") } else { ("[", ", ") };
                for (k, item) in items.iter().enumerate() {
                    self.text.push_str(if k == 0 { first } else { next });
                    self.value(item);
                }
                self.text.push_str(match (items.is_empty(), has_lines) {
                    (true, _) => "[]",
                    (false, true) => ",\n]",
                    (false, false) => "]",
                });
            }
            Node::Table(entries) => {
                for (k, entry) in entries.iter().enumerate() {
                    self.text.push_str(if k == 0 { "{ " } else { ", " });
                    self.key(&entry.key, entry.key_place);
                    self.text.push_str(" = ");
                    self.value(&entry.item);
                }
                self.text.push_str(if entries.is_empty() { "{}" } else { " }" });
            }
            Node::Missing => self.text.push_str("\"\""),
        }
        self.close(at);
    }

    fn quoted(&mut self, text: &str) {
        self.text.push('"');
        for c in text.chars() {
            match c {
                '"' => self.text.push_str("\\\""),
                '\\' => self.text.push_str("\\\\"),
                '\n' => self.text.push_str("\\n"),
                '\t' => self.text.push_str("\\t"),
                c if c < ' ' || c == '\u{7f}' => self.text.push_str(&format!("\\u{:04X}", u32::from(c))),
                c => self.text.push(c),
            }
        }
        self.text.push('"');
    }
}
