//! The ground of a copy or an included file: its own origin, which moves along, and what is tied to it.

use super::instance::Flattener;
use super::motion::Motion;
use super::scope::{Found, Scope};
use super::tables::PLACES;
use crate::model::text::tree::{Entry, Item, Node};

/// The word for the ground.
const GROUND: &str = "ground";
/// Sections with ends at points, of which the ground is the origin. Joints are where their parts are.
const WITH_ENDS: [&str; 2] = ["spring", "actuator"];

impl Flattener<'_> {
    /// Gives the ends at the ground, of `thing` of `section`, points of their own where the copy has moved the origin.
    /// `keys` are those of the original.
    pub fn fill_grounds<'e>(
        &mut self,
        scope: &Scope<'_>,
        (section, thing): (&str, &str),
        keys: impl Iterator<Item = &'e Entry>,
        entries: &mut [Entry],
    ) {
        if !WITH_ENDS.contains(&section) {
            return;
        }
        for (written, entry) in keys.zip(entries) {
            let (Node::Text(text), "a" | "b") = (&written.item.node, written.key.as_str()) else { continue };
            let Some(origin) = ground(scope, text).and_then(Motion::origin) else { continue };
            let name = free_name(scope, thing);
            let (place, key_place) = (entry.item.place, entry.key_place);
            let item = |node| Item { node, place };
            let offset = item(Node::Array(origin.iter().map(|part| item(part.node())).collect()));
            let offset = Entry { key: String::from("offset"), key_place, item: offset };
            let key = scope.flat_name(&name);
            let point = Entry { key: key.clone(), key_place, item: item(Node::Table(vec![offset])) };
            let points = Entry { key: String::from("point"), key_place, item: item(Node::Table(Vec::new())) };
            if self.spend(1, 0, key_place) {
                self.push(scope, &points, point);
                entry.item.node = Node::Text(key);
            }
        }
    }

    /// Whether a point is on a part that is not of its own copy, nor the ground.
    pub fn is_tied_outside<'e>(scope: &Scope<'_>, keys: impl Iterator<Item = &'e Entry>) -> bool {
        carrier(keys).is_some_and(|name| {
            let own = scope.flat_name(name);
            !matches!(scope.find(Some(PLACES), name, &[]), Found::Name(flat) if flat == own)
        })
    }

    /// Whether a point is on a frame.
    pub fn is_tied_to_frame<'e>(scope: &Scope<'_>, keys: impl Iterator<Item = &'e Entry>) -> bool {
        carrier(keys).is_some_and(|name| is_frame(scope, name))
    }
}

/// The motion of the ground that `text` means: of the file or the copy where the word stands; none: it means something
/// else.
fn ground<'p>(scope: &'p Scope<'p>, text: &str) -> Option<&'p Motion> {
    match scope.row(text) {
        Some((written, outside)) => ground(outside, written),
        None => (text == GROUND).then_some(&scope.motion),
    }
}

/// Whether a name means a frame, that of a row of a list included.
fn is_frame<'p>(scope: &'p Scope<'p>, name: &str) -> bool {
    match scope.row(name) {
        Some((written, outside)) => is_frame(outside, written),
        None => matches!(scope.find(Some("frame"), name, &[]), Found::Name(_)),
    }
}

/// A name for the ground of `thing` that nothing here has.
fn free_name(scope: &Scope<'_>, thing: &str) -> String {
    let mut name = format!("{thing}_{GROUND}");
    while !matches!(scope.find(None, &name, &[]), Found::Unknown) {
        name.push('_');
    }
    name
}

/// The name of the part that a point is on; none: it is on the ground.
fn carrier<'e>(mut keys: impl Iterator<Item = &'e Entry>) -> Option<&'e str> {
    let on = keys.find(|entry| entry.key == "on")?;
    let Node::Text(text) = &on.item.node else { return None };
    let name = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next().unwrap_or(text);
    (name != GROUND).then_some(name)
}
