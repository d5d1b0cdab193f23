//! The texts that a model is made of, and places in them; of a text that was resolved from copies and includes, also
//! where each part of it comes from.

use std::sync::Arc;

/// Where a text stands: bytes of the file or of an override.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// 0: the file; k: the k-th override; behind the overrides: included files.
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

/// The texts that a model is made of: the file, the overrides as the messages quote them, and included files.
#[derive(Clone, Debug)]
pub struct Source {
    file_name: String,
    texts: Vec<String>,
    /// The names of the included files: their texts are the last ones.
    included: Vec<String>,
    /// What is probably a mistake in how it was resolved, each with file and line.
    remarks: Vec<String>,
    /// What the text of the file was resolved from; none: it is as written.
    origin: Option<Arc<Origin>>,
}

/// Where a resolved text comes from.
#[derive(Clone, Debug)]
struct Origin {
    source: Source,
    spans: Vec<Span>,
    /// What messages say of a copy: `in copy 7 of spokes`.
    notes: Vec<String>,
    /// Which of the overrides the text has in it already.
    applied: Vec<bool>,
}

/// A part of a resolved text.
#[derive(Clone, Debug)]
pub struct Span {
    /// Its bytes in the resolved text.
    pub range: std::ops::Range<usize>,
    /// Where it is written.
    pub place: Place,
    /// The number of its note.
    pub note: usize,
}

/// A place as messages tell it.
#[derive(Debug)]
pub struct Told<'s> {
    /// The texts as written.
    pub source: &'s Source,
    /// The place in them.
    pub place: Place,
    /// Which copy it is in; empty: in none.
    pub note: &'s str,
}

impl Source {
    /// The file, and overrides as key and value.
    pub fn new(file_name: &str, text: &str, overrides: &[(String, String)]) -> Self {
        let quoted = overrides.iter().map(|(key, value)| format!("{key}={value}"));
        let texts = std::iter::once(text.to_owned()).chain(quoted).collect();
        Self { file_name: file_name.to_owned(), texts, included: Vec::new(), remarks: Vec::new(), origin: None }
    }

    /// Adds an included file; returns its number.
    pub fn include(&mut self, file_name: &str, text: &str) -> usize {
        self.included.push(file_name.to_owned());
        self.texts.push(text.to_owned());
        self.texts.len() - 1
    }

    /// The same model with the text that this source was resolved to. `spans` are in the order of the text, outer ones
    /// before inner ones.
    #[must_use]
    pub fn resolved(self, text: &str, spans: Vec<Span>, notes: Vec<String>, applied: Vec<bool>) -> Self {
        let mut texts = self.texts.clone();
        texts[0] = text.to_owned();
        texts.truncate(texts.len() - self.included.len());
        let file_name = self.file_name.clone();
        let origin = Some(Arc::new(Origin { source: self, spans, notes, applied }));
        Self { file_name, texts, included: Vec::new(), remarks: Vec::new(), origin }
    }

    /// The same with these remarks.
    #[must_use]
    pub fn with_remarks(self, remarks: Vec<String>) -> Self {
        Self { remarks, ..self }
    }

    /// What is probably a mistake in how it was resolved, each with file and line.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// Text number `source`.
    pub fn text(&self, source: usize) -> &str {
        self.texts.get(source).map_or("", String::as_str)
    }

    /// The name of the file whose text has this number; none: it is an override.
    pub fn file_name(&self, source: usize) -> Option<&str> {
        let first = self.texts.len() - self.included.len();
        match source {
            0 => Some(&self.file_name),
            _ => source.checked_sub(first).and_then(|at| self.included.get(at)).map(String::as_str),
        }
    }

    /// Whether the text has override number `override_`, from 0, in it already.
    pub fn has_applied(&self, number: usize) -> bool {
        self.origin.as_ref().is_some_and(|origin| origin.applied.get(number) == Some(&true))
    }

    /// A place as messages tell it: where it is written.
    pub fn told(&self, place: Place) -> Told<'_> {
        let Some(origin) = self.origin.as_deref() else { return Told { source: self, place, note: "" } };
        let source = &origin.source;
        let as_written = |place| Told { source, place, note: "" };
        if place.source > 0 {
            return as_written(place);
        }
        if place == self.end() {
            return as_written(source.end());
        }
        // Spans are nested or apart: the last one that begins here or before and does not end before is the innermost
        // one.
        let before = origin.spans.partition_point(|span| span.range.start <= place.start);
        let Some(span) = origin.spans[..before].iter().rev().find(|span| span.range.end >= place.end) else {
            return as_written(Place::file(0..0));
        };
        let is_same = self.text(0).get(span.range.clone()) == Some(source.slice(span.place));
        let inner = Place {
            start: span.place.start + (place.start - span.range.start),
            end: span.place.start + (place.end - span.range.start),
            ..span.place
        };
        Told { place: if is_same { inner } else { span.place }, ..as_written(span.place) }
            .noted(&origin.notes[span.note])
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

    /// Number of the line of a place of a file, from 1.
    pub fn line(&self, place: Place) -> usize {
        let told = self.told(place);
        let text = told.source.text(told.place.source);
        text.get(..told.place.start).map_or(1, |before| before.matches('\n').count() + 1)
    }

    /// Where something is written, for messages: `m.toml, line 7`, or the override.
    pub fn line_of(&self, place: Place) -> String {
        let told = self.told(place);
        match told.source.file_name(told.place.source) {
            Some(file_name) => format!("{file_name}, line {}", self.line(place)),
            None => told.source.text(told.place.source).to_owned(),
        }
    }

    /// The place of a part of a string value: `range` counts in the decoded string. The whole value where that cannot
    /// be said.
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

impl<'s> Told<'s> {
    fn noted(self, note: &'s str) -> Self {
        Self { note, ..self }
    }
}
