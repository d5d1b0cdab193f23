//! Keys that name other things of the file.

use super::{Reader, either};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::{Kind, suggestion};
use crate::model::text::tree::{Item, Node};

impl Reader<'_, '_> {
    /// The name of another thing of the file: its index among its kind; none: a mistake, which is reported.
    pub fn reference(&mut self, key: &'static str, kind: Kind) -> Option<usize> {
        self.reference_among(key, &[kind]).map(|(_, index)| index)
    }

    /// The name of another thing of the file, of one of these kinds: its kind and its index among it; none: a mistake,
    /// which is reported.
    pub fn reference_among(&mut self, key: &'static str, kinds: &[Kind]) -> Option<(Kind, usize)> {
        let known = self.has(key);
        let words = either(&kinds.iter().map(|kind| kind.word()).collect::<Vec<_>>());
        let Some((name, place)) = self.text(key) else {
            if !known {
                self.missing(key, &format!("the name of a {words}"));
            }
            return None;
        };
        self.find(&name, place, kinds)
    }

    /// The name of another thing of the file, or a list of names: their indices in their kind; none: a mistake, which
    /// is reported.
    pub fn references(&mut self, key: &'static str, kind: Kind) -> Option<Vec<usize>> {
        let found = self.references_among(key, &[kind], None)?;
        Some(found.into_iter().flatten().map(|(_, index)| index).collect())
    }

    /// The same of several kinds, each with its kind; none in the list: the `word` that stands for no name.
    pub fn references_among(
        &mut self,
        key: &'static str,
        kinds: &[Kind],
        word: Option<&str>,
    ) -> Option<Vec<Option<(Kind, usize)>>> {
        let words = either(&kinds.iter().map(|kind| kind.word()).collect::<Vec<_>>());
        let Some(entry) = self.take(key) else {
            self.missing(key, &format!("the name of a {words}, or a list of names"));
            return None;
        };
        let items = match entry.item.node {
            Node::Array(items) if !items.is_empty() => items,
            node => vec![Item { node, place: entry.item.place }],
        };
        let mut found = Vec::new();
        for item in items {
            let Node::Text(name) = &item.node else {
                self.context.wrong_type(key, &item, &format!("the name of a {words} in quotes"));
                return None;
            };
            let named = if word == Some(name) { None } else { Some(self.find(name, item.place, kinds)?) };
            if found.contains(&named) {
                self.context.report.error(item.place, &format!("`{name}` is listed twice"), "the second one", "");
                return None;
            }
            found.push(named);
        }
        Some(found)
    }

    /// The thing of this name, of one of these kinds.
    fn find(&mut self, name: &str, place: Place, kinds: &[Kind]) -> Option<(Kind, usize)> {
        let words = either(&kinds.iter().map(|kind| kind.word()).collect::<Vec<_>>());
        let message = match self.context.names.find_among(name, kinds) {
            Some(named) if kinds.contains(&named.kind) => return Some((named.kind, named.index)),
            _ if self.context.names.is_unclear(name) => return None,
            Some(named) => format!("`{name}` is a {}", named.kind.word()),
            None => format!("unknown {words} `{name}`"),
        };
        let is_full = self.context.report.is_full();
        let names: Vec<_> = kinds.iter().flat_map(|kind| self.context.names.of(*kind)).collect();
        let near = if is_full { String::new() } else { suggestion(name, names.iter().copied()) };
        let label = if near.is_empty() { format!("the name of a {words} was expected") } else { near };
        let help = if names.is_empty() { String::new() } else { format!("known: {}", names.join(", ")) };
        self.context.report.error(place, &message, &label, &help);
        None
    }
}
