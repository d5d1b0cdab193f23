//! What names and numbers mean at a place of the file: inside copies the index is a number and names are those of the
//! same copy; inside an included file names have the prefix of the include.

use super::motion::Motion;
use super::tables::{FUNCTION, INCLUDE, PARAMETERS, PLACES, bodies, has, is_among, names_of, table};
use crate::model::text::names::{Kind, SECTIONS};
use crate::model::text::tree::{Entry, Item, Node};

/// A copy, an included file, or the model file itself.
#[derive(Debug)]
pub(super) struct Scope<'p> {
    /// What it stands in; none: the model file.
    pub parent: Option<&'p Scope<'p>>,
    /// What it has: the sections of the file, or those of the copy.
    pub body: &'p [Entry],
    /// Whether it is a file: names are looked for no further.
    pub is_file: bool,
    /// What its names begin with.
    pub prefix: String,
    /// Which copy it is of each `copy` that it stands in, in its file, the outermost first.
    pub indices: Vec<String>,
    /// What stands for names: indices, and names of lists.
    pub values: Vec<StandIn>,
    /// What the `include` sets of the parameters of its file.
    pub set: &'p [Entry],
    /// Where it is.
    pub motion: Motion,
    /// The number of what messages say of it.
    pub note: usize,
    /// How many copies and files it stands in.
    pub depth: usize,
}

/// A text that stands for a name.
#[derive(Clone, Debug)]
pub(super) struct StandIn {
    pub name: String,
    /// In expressions: with the names of the flat model.
    pub text: String,
    /// As written, with the names of the scope around: where it is the name of a part.
    pub written: String,
}

/// What a name in an expression means.
pub(super) enum Meaning<'s> {
    /// A text that stands for it.
    Text(String),
    /// A parameter with its new name and, unless it is one of an included file, its value and the scope to read that
    /// in.
    Parameter(String, Option<(&'s Item, &'s Scope<'s>)>),
}

/// What the name of a part, a material or a section means.
pub(super) enum Found {
    /// The name in the flat model.
    Name(String),
    /// No part has this name here.
    Unknown,
    /// It is a part of copies: which one?
    Copies,
    /// More indices than the part has copies around it.
    TooMany(usize),
}

impl<'p> Scope<'p> {
    /// The model file.
    pub fn file(body: &'p [Entry]) -> Self {
        Self {
            parent: None,
            body,
            is_file: true,
            prefix: String::new(),
            indices: Vec::new(),
            values: Vec::new(),
            set: &[],
            motion: Motion::none(),
            note: 0,
            depth: 0,
        }
    }

    /// The name that a thing of this scope has in the flat model.
    pub fn flat_name(&self, name: &str) -> String {
        self.name_of_copy(name, &self.indices)
    }

    fn name_of_copy(&self, name: &str, indices: &[String]) -> String {
        let mut flat = format!("{}{name}", self.prefix);
        for index in indices {
            flat.push('_');
            flat.push_str(index);
        }
        flat
    }

    /// This scope and those around it, up to its file.
    fn chain(&'p self) -> impl Iterator<Item = &'p Scope<'p>> {
        let mut next = Some(self);
        std::iter::from_fn(move || {
            let scope = next?;
            next = if scope.is_file { None } else { scope.parent };
            Some(scope)
        })
    }

    /// What stands for a name in this very scope.
    fn stand_in(&self, name: &str) -> Option<&StandIn> {
        self.values.iter().rev().find(|own| own.name == name)
    }

    /// The text of a list of copies that a name stands for, as written, and the scope that it is written in.
    pub fn row(&'p self, name: &str) -> Option<(&'p str, &'p Scope<'p>)> {
        self.chain().find_map(|scope| Some((scope.stand_in(name)?.written.as_str(), scope.parent?)))
    }

    /// What a name in an expression means; none: it is none of copies, includes or parameters.
    pub fn meaning(&'p self, name: &str) -> Option<Meaning<'p>> {
        for scope in self.chain() {
            if let Some(own) = scope.stand_in(name) {
                return Some(Meaning::Text(own.text.clone()));
            }
            let own =
                table(scope.body, PARAMETERS).and_then(|parameters| parameters.iter().find(|entry| entry.key == name));
            if let Some(entry) = own {
                let set = scope.set.iter().find(|entry| entry.key == name).zip(scope.parent);
                let value = set.map_or((&entry.item, scope), |(set, outside)| (&set.item, outside));
                return Some(Meaning::Parameter(scope.flat_name(name), Some(value)));
            }
            if let Some((include, rest)) = included(scope.body, name) {
                return Some(Meaning::Parameter(format!("{}_{rest}", scope.flat_name(include)), None));
            }
        }
        None
    }

    /// The flat name of a function that an expression calls; none: the file has no such function here.
    pub fn function(&'p self, name: &str) -> Option<String> {
        match self.find(Some(FUNCTION), name, &[]) {
            Found::Name(flat) => Some(flat),
            Found::Unknown | Found::Copies | Found::TooMany(_) => None,
        }
    }

    /// The flat name of a joint whose coordinate stands in an expression; none: the file has no such joint here.
    pub fn part(&'p self, name: &str) -> Option<String> {
        match self.find(Some("joint"), name, &[]) {
            Found::Name(flat) => Some(flat),
            Found::Unknown | Found::Copies | Found::TooMany(_) => None,
        }
    }

    /// What the name of a thing means: of a part, or of a thing of `section`; `indices` say which copy.
    pub fn find(&'p self, section: Option<&str>, name: &str, indices: &[String]) -> Found {
        let mut is_in_copies = false;
        for scope in self.chain() {
            let Some(depth) = depth_of(scope.body, section, name) else { continue };
            if depth > indices.len() {
                is_in_copies |= is_below(scope.body, section, name);
                continue;
            }
            let all = scope.indices.len() + depth;
            let Some(kept) = all.checked_sub(indices.len()) else { return Found::TooMany(all) };
            let full: Vec<String> = scope.indices[..kept].iter().chain(indices).cloned().collect();
            return Found::Name(match included(scope.body, name) {
                Some((include, rest)) if !has(scope.body, section, name) => {
                    format!("{}_{rest}", scope.name_of_copy(include, &full))
                }
                _ => scope.name_of_copy(name, &full),
            });
        }
        if is_in_copies { Found::Copies } else { Found::Unknown }
    }

    /// Names of things that references can mean, for suggestions.
    pub fn known(&'p self, section: Option<&str>) -> Vec<&'p str> {
        let words = SECTIONS.iter().filter(|(word, kind)| match section {
            Some(PLACES) => kind.is_place(),
            Some(sections) => is_among(sections, word),
            None => !matches!(kind, Kind::Function | Kind::Material | Kind::Section),
        });
        let words: Vec<&str> = words.map(|(word, _)| *word).collect();
        let mut known = Vec::new();
        for scope in self.chain() {
            words.iter().for_each(|word| known.extend(names_of(scope.body, word)));
        }
        known
    }
}

/// The include whose things have names like this one, and the rest of the name: the longest that fits.
fn included<'b, 'n>(body: &'b [Entry], name: &'n str) -> Option<(&'b str, &'n str)> {
    let fits = |include: &&str| name.strip_prefix(*include).is_some_and(|rest| rest.len() > 1 && rest.starts_with('_'));
    let include = names_of(body, INCLUDE).filter(fits).max_by_key(|include| include.len())?;
    Some((include, &name[include.len() + 1..]))
}

/// In how many copies below `body` a thing is; none: it is in none and not in `body`.
fn depth_of(body: &[Entry], section: Option<&str>, name: &str) -> Option<usize> {
    if has(body, section, name) || included(body, name).is_some() {
        return Some(0);
    }
    bodies(body).find_map(|inner| depth_of(inner, section, name)).map(|depth| depth + 1)
}

/// Whether a copy below `body` has a thing of this very name: a name with the prefix of an include may be one of the
/// flat model.
fn is_below(body: &[Entry], section: Option<&str>, name: &str) -> bool {
    bodies(body).any(|inner| has(inner, section, name) || is_below(inner, section, name))
}

/// The entries of a table; none: it is something else.
pub(super) fn entries_of(item: &Item) -> Option<&[Entry]> {
    match &item.node {
        Node::Table(entries) => Some(entries),
        _ => None,
    }
}
