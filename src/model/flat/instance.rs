//! Fills the flat model: every part of a file or a copy with the names and numbers that it has there.

use super::library::Library;
use super::names::{Name, operand, replaced};
use super::print::{Section, print};
use super::scalar::Scalar;
use super::scope::{Found, Meaning, Scope, entries_of};
use super::tables::{COPY, FUNCTION, INCLUDE, PARAMETERS, Role, role};
use crate::model::expression::{Variable, compile};
use crate::model::file::entries::contact::ITSELF;
use crate::model::file::entries::{SINGLE, keys_of};
use crate::model::text::diagnostic::{Place, Report, Source};
use crate::model::text::names::{SECTIONS, suggestion};
use crate::model::text::source::Span;
use crate::model::text::tree::{Entry, Item, Node};
use std::collections::{BTreeMap, BTreeSet};

/// More parts than this are a mistake in a count.
const MOST_PARTS: usize = 10_000;
/// More values than this, of all parts, are one too.
const MOST_VALUES: usize = 1_000_000;
/// Parameters that follow from one another, for a count.
const DEPTH: usize = 50;

/// The flat model while it is filled.
#[derive(Debug)]
pub(super) struct Flattener<'a> {
    /// The mistakes so far.
    pub report: Report<'a>,
    pub library: &'a Library,
    /// What messages say of copies, by number.
    pub notes: Vec<String>,
    /// The parameters that decide what there is, with their values: as an earlier pass found them, and as this one
    /// does.
    pub known: BTreeMap<String, f64>,
    pub decisive: BTreeMap<String, f64>,
    /// What is legal and probably a mistake, and where it is written.
    pub remarks: Vec<(Place, String)>,
    values: Vec<Entry>,
    sections: Vec<Section>,
    parts: usize,
    spent: usize,
    is_full: bool,
    told: BTreeSet<Place>,
}

impl<'a> Flattener<'a> {
    pub fn new(report: Report<'a>, library: &'a Library, known: BTreeMap<String, f64>) -> Self {
        Self {
            report,
            library,
            notes: vec![String::new()],
            known,
            decisive: BTreeMap::new(),
            remarks: Vec::new(),
            values: Vec::new(),
            sections: Vec::new(),
            parts: 0,
            spent: 0,
            is_full: false,
            told: BTreeSet::new(),
        }
    }

    /// The text of the flat model, and where its parts come from.
    pub fn print(&self, source: &Source) -> (String, Vec<Span>) {
        print(source, &self.values, &self.sections)
    }

    /// Reports a mistake, once at each place: further copies have the same one.
    pub fn error(&mut self, scope: &Scope<'_>, place: Place, message: &str, label: &str, help: &str) {
        if self.told.insert(place) {
            let note = &self.notes[scope.note];
            let message = if note.is_empty() { message.to_owned() } else { format!("{message}, {note}") };
            self.report.error(place, &message, label, help);
        }
    }

    /// Remarks something, once at each place.
    pub fn remark(&mut self, place: Place, text: String) {
        if self.remarks.iter().all(|(told, _)| *told != place) {
            self.remarks.push((place, text));
        }
    }

    /// Counts parts and values; false beyond the limit, which is reported.
    pub fn spend(&mut self, parts: usize, values: usize, place: Place) -> bool {
        self.parts += parts;
        self.spent += values;
        let is_over = self.parts > MOST_PARTS || self.spent > MOST_VALUES;
        if is_over && !self.is_full {
            let label = format!("the limit is {MOST_PARTS} parts with {MOST_VALUES} numbers and words");
            self.report.error(place, "the copies make too many parts", &label, "take a smaller count");
        }
        self.is_full |= is_over;
        !self.is_full
    }

    /// Leaves out everything that is not filled in yet: a mistake is reported that would come again and again.
    pub fn stop(&mut self) {
        self.is_full = true;
    }

    /// Fills in everything that a file or a copy has.
    pub fn fill(&mut self, scope: &Scope<'_>) {
        for entry in scope.body {
            if self.is_full {
                return;
            }
            let Some(things) = entries_of(&entry.item) else {
                self.fill_value(scope, entry);
                continue;
            };
            match entry.key.as_str() {
                COPY => things.iter().for_each(|copy| self.fill_copies(scope, copy)),
                INCLUDE => things.iter().for_each(|include| self.fill_file(scope, include)),
                PARAMETERS => {
                    for parameter in things {
                        self.fill_parameter(scope, entry, parameter);
                    }
                }
                word if SECTIONS.iter().any(|(section, _)| *section == word) => {
                    for thing in things {
                        self.fill_thing(scope, entry, thing);
                    }
                }
                _ => self.fill_single(scope, entry, things),
            }
        }
    }

    /// A value in no section: the format of a file. Those of a copy are read elsewhere.
    fn fill_value(&mut self, scope: &Scope<'_>, entry: &Entry) {
        if scope.parent.is_none() {
            match entry.key == COPY || entry.key == INCLUDE {
                true => self.expect_section(scope, entry, &format!("[{}.NAME]", entry.key)),
                false => self.values.push(entry.clone()),
            }
        } else if scope.is_file && entry.key != "format" {
            self.expect_section(scope, entry, "[section.NAME]");
        } else if scope.is_file && !matches!(entry.item.node, Node::Integer(1)) {
            self.error(scope, entry.item.place, "this version reads format 1 only", "format = 1 was expected", "");
        }
    }

    pub fn expect_section(&mut self, scope: &Scope<'_>, entry: &Entry, title: &str) {
        let message = format!("`{}` is {}", entry.key, entry.item.node.describe());
        self.error(scope, entry.item.place, &message, &format!("a section {title} was expected"), "");
    }

    /// `[model]`, `[simulation]`, or a section that the reader does not know.
    fn fill_single(&mut self, scope: &Scope<'_>, entry: &Entry, inner: &[Entry]) {
        if scope.parent.is_some() {
            if !scope.is_file {
                // The keys of a copy are checked where it begins.
                return;
            }
            let message = format!("an included file has a section [{}]", entry.key);
            let help = match SINGLE.contains(&entry.key.as_str()) {
                true => "only the model file itself has it",
                false => "",
            };
            let label = "parts, parameters, copies and includes were expected";
            return self.error(scope, entry.key_place, &message, label, help);
        }
        let is_known = SINGLE.contains(&entry.key.as_str());
        for inner in inner {
            let is_number = is_known && role(&entry.key, &inner.key, false) != Role::Word;
            let item = if is_number { self.numbers(scope, &inner.item) } else { inner.item.clone() };
            self.push(scope, entry, Entry { item, ..inner.clone() });
        }
        if inner.is_empty() {
            self.section(entry);
        }
    }

    fn section(&mut self, entry: &Entry) -> &mut Section {
        let at = self.sections.iter().position(|section| section.key == entry.key).unwrap_or_else(|| {
            let section = Section { key: entry.key.clone(), key_place: entry.key_place, entries: Vec::new() };
            self.sections.push(section);
            self.sections.len() - 1
        });
        &mut self.sections[at]
    }

    pub fn push(&mut self, scope: &Scope<'_>, section: &Entry, entry: Entry) {
        let weight = weight(&entry.item);
        self.push_of(weight, scope, section, entry);
    }

    /// Adds an entry that counts as this many values.
    pub fn push_of(&mut self, weight: usize, scope: &Scope<'_>, section: &Entry, entry: Entry) {
        if self.spend(0, weight, entry.key_place) {
            let note = scope.note;
            self.section(section).entries.push((entry, note));
        }
    }

    fn fill_parameter(&mut self, scope: &Scope<'_>, section: &Entry, parameter: &Entry) {
        let key = scope.flat_name(&parameter.key);
        // Its number stands wherever it is used: changed later, it would not change what there is.
        if self.known.contains_key(&key) {
            return;
        }
        let set = scope.set.iter().find(|entry| entry.key == parameter.key).zip(scope.parent);
        let given = set.map(|(set, outside)| self.numbers(outside, &set.item));
        let item = match (&parameter.item.node, given) {
            (Node::Table(inner), given) => {
                let inner = inner.iter().map(|part| match (part.key.as_str(), &given) {
                    ("value", Some(given)) => Entry { item: given.clone(), ..part.clone() },
                    ("value" | "min" | "max", _) => Entry { item: self.numbers(scope, &part.item), ..part.clone() },
                    _ => part.clone(),
                });
                Item { node: Node::Table(inner.collect()), ..parameter.item }
            }
            (_, Some(given)) => given,
            (_, None) => self.numbers(scope, &parameter.item),
        };
        if self.spend(1, 0, parameter.key_place) {
            self.push(scope, section, Entry { key, key_place: parameter.key_place, item });
        }
    }

    fn fill_thing(&mut self, scope: &Scope<'_>, section: &Entry, thing: &Entry) {
        let Some(keys) = entries_of(&thing.item) else {
            // The reader says what is wrong.
            return self.push(scope, section, thing.clone());
        };
        let condition = keys.iter().find(|entry| entry.key == "when").filter(|_| scope.depth > 0);
        if condition.is_some_and(|condition| self.number(scope, &condition.item).is_none_or(|value| value == 0.0)) {
            return;
        }
        if !self.spend(1, 0, thing.key_place) {
            return;
        }
        let keys = keys.iter().filter(|entry| condition.is_none() || entry.key != "when");
        if section.key == FUNCTION {
            return self.fill_function(scope, section, thing, keys);
        }
        let mut entries = Vec::new();
        for entry in keys.clone() {
            let is_list = matches!(entry.item.node, Node::Array(_));
            let item = match (role(&section.key, &entry.key, is_list), &entry.item.node) {
                (Role::Word, _) => entry.item.clone(),
                (Role::Name(kind), Node::Text(name)) => self.named(scope, Some(kind), name, &entry.item),
                (Role::Names(kind), _) => self.all_named(scope, kind, &entry.item),
                (Role::Curve, Node::Table(keys)) => {
                    let filled = keys.iter().map(|key| {
                        let is_over = key.key == "over";
                        let names = is_over.then(|| self.all_named(scope, "surface", &key.item));
                        Entry { item: names.unwrap_or_else(|| self.numbers(scope, &key.item)), ..key.clone() }
                    });
                    Item { node: Node::Table(filled.collect()), ..entry.item }
                }
                (Role::Part, Node::Text(name)) => self.named(scope, None, name, &entry.item),
                _ => self.numbers(scope, &entry.item),
            };
            entries.push(Entry { item, ..entry.clone() });
        }
        let has_offset = keys_of(&section.key).iter().any(|key| key.role == Role::Offset);
        let on_frame = has_offset && Self::is_tied_to_frame(scope, keys.clone());
        self.fill_grounds(scope, (&section.key, &thing.key), keys.clone(), &mut entries);
        if has_offset && scope.motion.moves() && Self::is_tied_outside(scope, keys) {
            let message =
                format!("the {} `{}` moves with its copy, and what it is on does not", section.key, thing.key);
            let label = "put that part into the copy, or give the offset of each copy by expressions, without `turn` and `move`";
            self.error(scope, thing.key_place, &message, label, "");
        }
        if let Err((place, message, label)) = scope.motion.apply(&section.key, thing.key_place, on_frame, &mut entries)
        {
            self.error(scope, place, message, label, "");
        }
        let item = Item { node: Node::Table(entries), ..thing.item };
        self.push(scope, section, Entry { key: scope.flat_name(&thing.key), key_place: thing.key_place, item });
    }

    /// A name, or a list of names, of things of `section`; anything else is left for the reader to refuse.
    fn all_named(&mut self, scope: &Scope<'_>, section: &str, item: &Item) -> Item {
        match &item.node {
            Node::Text(name) => self.named(scope, Some(section), name, item),
            Node::Array(items) => {
                let named = items.iter().map(|item| self.all_named(scope, section, item));
                Item { node: Node::Array(named.collect()), ..*item }
            }
            _ => item.clone(),
        }
    }

    fn named(&mut self, scope: &Scope<'_>, section: Option<&str>, name: &str, item: &Item) -> Item {
        let text = self.reference(scope, section, name, item.place).unwrap_or_else(|| name.to_owned());
        Item { node: Node::Text(text), ..*item }
    }

    /// `spoke[k+1].start` as a name of the flat model; none: a mistake, which is reported.
    fn reference(&mut self, scope: &Scope<'_>, section: Option<&str>, text: &str, place: Place) -> Option<String> {
        let length = text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len());
        let (name, mut rest) = text.split_at(length);
        if let Some((written, outside)) = scope.row(name)
            && written.starts_with(|c: char| c.is_ascii_alphabetic())
        {
            return self.reference(outside, section, &format!("{written}{rest}"), place);
        }
        let mut indices = Vec::new();
        while let Some((inner, behind)) = bracket(rest) {
            indices.push(self.whole(scope, inner, place)?.to_string());
            rest = behind;
        }
        let flat = match scope.find(section, name, &indices) {
            Found::Name(flat) => flat,
            Found::Unknown if indices.is_empty() && ["ground", ITSELF, ""].contains(&name) => name.to_owned(),
            Found::Unknown if indices.is_empty() => scope_prefix(scope, name),
            Found::Unknown => {
                let label = suggestion(name, scope.known(section));
                self.error(scope, place, &format!("no copy has a part named `{name}`"), &label, "");
                return None;
            }
            Found::Copies => {
                let message = format!("`{name}` is a part of copies");
                self.error(scope, place, &message, &format!("which one? {name}[1] is that of the first copy"), "");
                return None;
            }
            Found::TooMany(most) => {
                let message = format!("`{name}` has {} indices here", indices.len());
                let label = format!("at most {most} expected: one for each `copy` around it");
                self.error(scope, place, &message, &label, "");
                return None;
            }
        };
        let rest = if let Some((inner, behind)) = rest.strip_prefix(".node").and_then(bracket) {
            let is_plain = inner.chars().all(|c| c.is_ascii_digit());
            let node = if is_plain { inner.to_owned() } else { self.whole(scope, inner, place)?.to_string() };
            format!(".node[{node}]{behind}")
        } else if let Some(fraction) = rest.strip_prefix('@') {
            format!("@{}", self.expression(scope, fraction))
        } else {
            rest.to_owned()
        };
        Some(format!("{flat}{rest}"))
    }

    /// A value with all expressions in it as they are in this scope.
    pub fn numbers(&self, scope: &Scope<'_>, item: &Item) -> Item {
        let node = match &item.node {
            Node::Text(text) => Node::Text(self.expression(scope, text)),
            Node::Array(items) => Node::Array(items.iter().map(|item| self.numbers(scope, item)).collect()),
            Node::Table(entries) => {
                let entry = |entry: &Entry| Entry { item: self.numbers(scope, &entry.item), ..entry.clone() };
                Node::Table(entries.iter().map(entry).collect())
            }
            other => other.clone(),
        };
        Item { node, ..*item }
    }

    /// An expression with the names and numbers of this scope.
    pub fn expression(&self, scope: &Scope<'_>, text: &str) -> String {
        self.expression_of(scope, text, "")
    }

    /// An expression with the names and numbers of this scope, of the function with this argument; empty: of none.
    pub fn expression_of(&self, scope: &Scope<'_>, text: &str, argument: &str) -> String {
        let result = replaced(text, &mut |name| {
            let name = match name {
                Name::Called(name) => return Ok(scope.function(name)),
                Name::Part(name) => return Ok(scope.part(name)),
                Name::Number(name) if name == argument => return Ok(None),
                Name::Number(name) => name,
            };
            Ok(match scope.meaning(name) {
                Some(Meaning::Text(text)) => Some(operand(&text)),
                Some(Meaning::Parameter(flat, _)) => match self.known.get(&flat) {
                    Some(value) => Some(operand(&format!("{value:?}"))),
                    None => Some(flat),
                },
                None => None,
            })
        });
        result.unwrap_or_else(|()| text.to_owned())
    }

    /// The value of a number that decides what there is; none: a mistake, which is reported.
    pub fn number(&mut self, scope: &Scope<'_>, item: &Item) -> Option<f64> {
        match &item.node {
            Node::Integer(value) => Some(*value as f64),
            Node::Float(value) => Some(*value),
            Node::Text(text) => self.evaluate(scope, text, item.place, DEPTH),
            _ => {
                let message = format!("this is {}", item.node.describe());
                self.error(scope, item.place, &message, "a number, or an expression in quotes, was expected", "");
                None
            }
        }
    }

    /// The value of an expression of whole numbers, for an index.
    fn whole(&mut self, scope: &Scope<'_>, text: &str, place: Place) -> Option<i64> {
        let value = self.evaluate(scope, text, place, DEPTH)?;
        if value.fract() != 0.0 || value.abs() > 1e9 {
            self.error(scope, place, &format!("the index `{text}` is {value}"), "a whole number was expected", "");
            return None;
        }
        Some(value as i64)
    }

    fn evaluate(&mut self, scope: &Scope<'_>, text: &str, place: Place, depth: usize) -> Option<f64> {
        let result = replaced(text, &mut |name| match name.number().and_then(|name| scope.meaning(name)) {
            Some(Meaning::Text(text)) => Ok(Some(operand(&text))),
            Some(Meaning::Parameter(flat, Some((item, home)))) => {
                let value = self.parameter(&flat, item, home, place, depth).ok_or(())?;
                Ok(Some(operand(&format!("{value:?}"))))
            }
            Some(Meaning::Parameter(..)) | None => Ok(None),
        });
        let result = result.ok()?;
        match compile(&result, Variable::None, &|_| None) {
            Ok(program) => {
                let value = program.value(0.0, |_| f64::NAN);
                if !value.is_finite() {
                    self.error(scope, place, &format!("`{text}` is {value}"), "a finite number was expected", "");
                }
                Some(value).filter(|value| value.is_finite())
            }
            Err(error) => {
                let help = "indices, names of lists and parameters of the same file are known here";
                self.error(scope, place, &error.message, "in this expression", help);
                None
            }
        }
    }

    /// The value of a parameter that decides what there is.
    fn parameter(&mut self, flat: &str, item: &Item, home: &Scope<'_>, place: Place, depth: usize) -> Option<f64> {
        if let Some(value) = self.decisive.get(flat) {
            return Some(*value);
        }
        let Some(depth) = depth.checked_sub(1) else {
            self.error(home, place, &format!("the parameter `{flat}` needs itself"), "for this number", "");
            return None;
        };
        let inner = match &item.node {
            Node::Table(keys) => keys.iter().find(|entry| entry.key == "value").map(|entry| &entry.item),
            _ => Some(item),
        };
        let value = match inner.map(|item| (&item.node, item.place)) {
            Some((Node::Integer(value), _)) => *value as f64,
            Some((Node::Float(value), _)) => *value,
            Some((Node::Text(text), place)) => self.evaluate(home, text, place, depth)?,
            _ => {
                self.error(home, item.place, &format!("the parameter `{flat}` is not a number"), "", "");
                return None;
            }
        };
        let bound = |key: &str| match &item.node {
            Node::Table(keys) => keys.iter().find(|entry| entry.key == key).and_then(|entry| Scalar::of(&entry.item)),
            _ => None,
        };
        for (key, words) in [("min", "at least"), ("max", "at most")] {
            if let Some(Scalar::Number(limit)) = bound(key)
                && (if key == "min" { value < limit } else { value > limit })
            {
                let place = inner.map_or(place, |item| item.place);
                let message = format!("`{flat}` must be {words} {limit}");
                self.error(home, place, &message, &format!("this is {value}"), "");
                return None;
            }
        }
        self.decisive.insert(flat.to_owned(), value);
        Some(value)
    }
}

/// A name that nothing in its file has: in an included file it stays inside.
fn scope_prefix(scope: &Scope<'_>, name: &str) -> String {
    format!("{}{name}", scope.prefix)
}

/// `[k+1].start` to `k+1` and `.start`.
fn bracket(text: &str) -> Option<(&str, &str)> {
    let inner = text.strip_prefix('[')?;
    let mut open = 0_usize;
    for (at, c) in inner.char_indices() {
        match c {
            '[' => open += 1,
            ']' if open == 0 => return Some((&inner[..at], &inner[at + 1..])),
            ']' => open -= 1,
            _ => {}
        }
    }
    None
}

/// How much a value counts of [`MOST_VALUES`].
fn weight(item: &Item) -> usize {
    match &item.node {
        Node::Text(text) => 1 + text.len() / 16,
        Node::Array(items) => 1 + items.iter().map(weight).sum::<usize>(),
        Node::Table(entries) => 1 + entries.iter().map(|entry| weight(&entry.item)).sum::<usize>(),
        _ => 1,
    }
}
