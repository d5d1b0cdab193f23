//! Looks into the sections of a file and of copies.

use crate::model::file::entries::keys_of;
pub use crate::model::file::schema::{PLACES, Role};
use crate::model::text::names::{Kind, SECTIONS};
use crate::model::text::tree::{Entry, Node};

/// The section of copies.
pub const COPY: &str = "copy";
/// The section of included files.
pub const INCLUDE: &str = "include";
/// The section of functions.
pub const FUNCTION: &str = "function";
/// The section of named numbers.
pub const PARAMETERS: &str = "parameters";

/// The entries of the section `key`.
pub fn table<'b>(body: &'b [Entry], key: &str) -> Option<&'b [Entry]> {
    body.iter().find(|entry| entry.key == key).and_then(|entry| match &entry.item.node {
        Node::Table(entries) => Some(entries.as_slice()),
        _ => None,
    })
}

/// The names of the things in the section `key`.
pub fn names_of<'b>(body: &'b [Entry], key: &str) -> impl Iterator<Item = &'b str> {
    table(body, key).unwrap_or_default().iter().map(|entry| entry.key.as_str())
}

/// The role of a key of a section: of a key that is not known, numbers.
pub fn role(section: &str, key: &str, is_list: bool) -> Role {
    match keys_of(section).iter().find(|own| own.word == key).map(|own| own.role) {
        Some(Role::Name(_) | Role::Part) if is_list => Role::Position,
        Some(role) => role,
        None => Role::Number,
    }
}

/// Whether `body` has a thing of this name: in `section`, or a part.
pub fn has(body: &[Entry], section: Option<&str>, name: &str) -> bool {
    let is_wanted = |(word, kind): &&(&str, Kind)| match section {
        Some(PLACES) => kind.is_place(),
        Some(sections) => is_among(sections, word),
        None => !matches!(kind, Kind::Function | Kind::Material | Kind::Section | Kind::Load | Kind::Output),
    };
    SECTIONS.iter().filter(is_wanted).any(|(word, _)| names_of(body, word).any(|known| known == name))
}

/// Whether a word is one of `sections`: a word, or several with `or` between them.
pub fn is_among(sections: &str, word: &str) -> bool {
    sections.split(" or ").any(|own| own == word)
}

/// What the copies of `body` have.
pub fn bodies(body: &[Entry]) -> impl Iterator<Item = &[Entry]> {
    table(body, COPY).unwrap_or_default().iter().filter_map(|entry| match &entry.item.node {
        Node::Table(entries) => Some(entries.as_slice()),
        _ => None,
    })
}
