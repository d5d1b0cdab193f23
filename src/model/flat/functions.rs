//! `[function.NAME]` in the flat model: expressions with the names that they have there, and tables in place of their
//! files.

use super::data::file_of;
use super::instance::Flattener;
use super::scope::Scope;
use crate::model::text::tree::{Entry, Item, Node};

/// The argument of a function that does not name it.
const ARGUMENT: &str = "x";

impl Flattener<'_> {
    /// A function with its keys.
    pub fn fill_function<'e>(
        &mut self,
        scope: &Scope<'_>,
        section: &Entry,
        thing: &Entry,
        keys: impl Iterator<Item = &'e Entry> + Clone,
    ) {
        let argument = keys.clone().find(|entry| entry.key == "argument").map(|entry| &entry.item);
        let (argument, place) = match argument {
            Some(Item { node: Node::Text(argument), place }) => (argument.as_str(), *place),
            _ => (ARGUMENT, thing.key_place),
        };
        let has_value = keys.clone().any(|entry| entry.key == "value");
        if has_value && scope.meaning(argument).is_some() {
            let message = format!("`{argument}` is both the argument of the function {} and a number", thing.key);
            return self.error(scope, place, &message, "", "name the argument differently: argument = \"u\"");
        }
        let file = file_of(thing).and_then(|(_, place, _)| self.library.table(place));
        let mut weight = 1;
        let mut entries = Vec::new();
        for entry in keys {
            let item = match (entry.key.as_str(), &entry.item.node, file) {
                ("value", Node::Text(text), _) => {
                    Item { node: Node::Text(self.expression_of(scope, text, argument)), ..entry.item }
                }
                ("file", _, Some(rows)) => {
                    entries.push(Entry { key: "table".to_owned(), item: rows.clone(), ..*entry });
                    continue;
                }
                // It has done its work.
                ("column", _, Some(_)) => continue,
                _ => entry.item.clone(),
            };
            entries.push(Entry { item, ..entry.clone() });
        }
        for entry in &entries {
            weight += if let Node::Array(rows) = &entry.item.node { rows.len() } else { 1 };
        }
        let item = Item { node: Node::Table(entries), ..thing.item };
        let entry = Entry { key: scope.flat_name(&thing.key), key_place: thing.key_place, item };
        self.push_of(weight, scope, section, entry);
    }
}
