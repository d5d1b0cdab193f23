//! `[output.NAME]`: what is measured at a point of a beam.

use super::anchor::Anchor;
use crate::model::diagnostic::Place;
use crate::model::names::suggestion;
use crate::model::quantity::{LATER, QUANTITIES, Quantity};
use crate::model::reader::{Reader, listing};
use crate::model::tree::{Item, Node};

/// A section `[output.NAME]`.
#[derive(Clone, Debug)]
pub struct Output {
    /// Its name: the first part of the names of its variables.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The point.
    pub at: Anchor,
    /// What is measured, in the order of the file.
    pub quantities: Vec<Quantity>,
}

impl Output {
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>) -> Option<Self> {
        let available = "available: `at`, a point of a beam";
        let whole = reader.has("on");
        reader.unavailable("on", available);
        reader.unavailable("stations", available);
        let at = if whole { None } else { Anchor::read_beam_point(&mut reader, "at") };
        let quantities = match reader.take("quantities") {
            None => {
                reader.missing("quantities", "a list like [\"position\", \"twist\"]");
                Vec::new()
            }
            Some(entry) => quantities(&mut reader, &entry.item),
        };
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, at: at?, quantities })
    }
}

fn quantities(reader: &mut Reader<'_, '_>, item: &Item) -> Vec<Quantity> {
    let known = || QUANTITIES.iter().map(|row| row.word);
    let items = match &item.node {
        Node::Array(items) if !items.is_empty() => items,
        _ => {
            reader.context.wrong_type("quantities", item, "a list of at least one word");
            return Vec::new();
        }
    };
    let mut quantities = Vec::new();
    for item in items {
        let Node::Text(word) = &item.node else {
            reader.context.wrong_type("quantities", item, "a word in quotes");
            continue;
        };
        let report = &mut reader.context.report;
        match QUANTITIES.iter().find(|row| row.word == word) {
            Some(row) if quantities.contains(&row.quantity) => {
                report.error(item.place, &format!("quantity \"{word}\" is listed twice"), "the second one", "");
            }
            Some(row) => quantities.push(row.quantity),
            None if LATER.contains(&word.as_str()) => {
                let message = format!("quantity \"{word}\" is not available in this version");
                report.error(item.place, &message, "", &format!("available: {}", listing(known())));
            }
            None => {
                let message = format!("unknown quantity \"{word}\"");
                let near = suggestion(word, known());
                report.error(item.place, &message, &near, &format!("known here: {}", listing(known())));
            }
        }
    }
    quantities
}
