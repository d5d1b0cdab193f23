//! Reads one section: every key that is asked for is known, what is left over at the end is a mistake.

pub mod anchor;
pub mod input;
mod lists;
pub mod readings;
mod references;

use self::anchor::Anchor;
use super::number::{Meta, Number, Numbers, Slot, Written};
use super::schema::{Key, Rule};
use crate::model::expression::function::{Formula, Piece};
use crate::model::expression::program::{Body, Called, FUNCTIONS, MORE_FUNCTIONS};
use crate::model::expression::{Callee, ExpressionError, Program, ReadingLookup, Scope, Variable, compile_in};
use crate::model::text::diagnostic::{Place, Report};
use crate::model::text::names::{FUNCTION, KEY, Kind, Names, instead, meant, suggestion, suggestion_for};
use crate::model::text::syntax;
use crate::model::text::tree::{Entry, Item, Node};
use std::sync::Arc;

/// The names of numbers that the language has.
const CONSTANTS: [&str; 2] = ["pi", "e"];

/// What all sections are read with.
#[derive(Debug)]
pub struct Context<'a> {
    /// The mistakes so far.
    pub report: Report<'a>,
    /// The numbers so far.
    pub numbers: Numbers,
    /// All names of the file.
    pub names: Names,
    /// What the points of the file are tied to, in their order; none where that is wrong.
    pub carriers: Vec<Option<Anchor>>,
    /// Whether the frames of the file move, in their order.
    pub moving_frames: Vec<bool>,
    /// Whether the program chooses the elements of the beams of the file, in their order.
    pub free_meshes: Vec<bool>,
    /// The functions of the file, by their names.
    pub functions: Vec<(String, Callee)>,
}

impl Context<'_> {
    /// Compiles an expression that stands at `place`.
    pub fn program(&mut self, text: &str, place: Place, variable: Variable) -> Option<Program> {
        let variables = [variable.word(), variable.rate()];
        let lookup = |name: &str, key: &str| readings::lookup(&self.names, name, key);
        let reading: Option<&ReadingLookup<'_>> = (variable == Variable::Control).then_some(&lookup);
        let result = self.compiled(text, variables, None, reading);
        self.told(text, place, variables, result)
    }

    /// Compiles the expression of a function of the file.
    pub fn function_program(&mut self, text: &str, place: Place, function: &str, argument: &str) -> Option<Program> {
        let result = self.compiled(text, [argument, ""], Some(function), None);
        self.told(text, place, [argument, ""], result)
    }

    /// Tells the names of all functions that the expression of a function may call.
    pub fn find_calls(&self, text: &str, argument: &str, tell: &dyn Fn(&str)) {
        let function = |name: &str| {
            tell(name);
            let body = Body::Expression(Program::constant(0.0));
            Some(Callee::Sound(Arc::new(Called { name: name.to_owned(), body })))
        };
        let parameter = |name: &str| self.numbers.parameter(name);
        let scope = Scope {
            variable: argument,
            rate: "",
            parameter: &parameter,
            function: &function,
            inside: None,
            reading: None,
        };
        // What is wrong is said when the expression is compiled.
        drop(compile_in(text, scope));
    }

    fn compiled(
        &self,
        text: &str,
        [variable, rate]: [&str; 2],
        inside: Option<&str>,
        reading: Option<&ReadingLookup<'_>>,
    ) -> Result<Program, ExpressionError> {
        let known = |name: &str| self.functions.iter().find(|(known, _)| known == name);
        let function = |name: &str| known(name).map(|(_, callee)| callee.clone());
        let parameter = |name: &str| self.numbers.parameter(name);
        compile_in(text, Scope { variable, rate, parameter: &parameter, function: &function, inside, reading })
    }

    /// The program; a mistake is reported.
    fn told(
        &mut self,
        text: &str,
        place: Place,
        variables: [&str; 2],
        result: Result<Program, ExpressionError>,
    ) -> Option<Program> {
        match result {
            Ok(program) => Some(program),
            Err(error) if error.is_reported => None,
            Err(error) => {
                if let Some([number, name]) = syntax::factors(text)
                    && (variables.contains(&name)
                        || CONSTANTS.contains(&name)
                        || self.numbers.parameter(name).is_some())
                {
                    let label = format!("\"{number}*{name}\" was expected");
                    self.report.error(place, "a product is written with *", &label, "");
                    return None;
                }
                if syntax::has_unit(text) {
                    self.report.error(place, "numbers are written without units", "this one has a unit", syntax::UNITS);
                    return None;
                }
                let unknown = error.unknown.as_deref().filter(|_| !self.report.is_full());
                let near = unknown.map_or(String::new(), |name| {
                    let functions = FUNCTIONS.iter().chain(&MORE_FUNCTIONS).map(|(name, _)| *name);
                    let own = self.names.of(Kind::Parameter).chain(self.names.of(Kind::Function));
                    suggestion_for(FUNCTION, name, own.chain(functions).chain(["pi"]))
                });
                let place = self.report.source.inside(place, text, error.range);
                self.report.error(place, &error.message, &error.label, &near);
                None
            }
        }
    }

    /// Reports a value of the wrong type.
    pub fn wrong_type(&mut self, name: &str, item: &Item, expected: &str) {
        let message = format!("`{name}` is {}", item.node.describe());
        self.report.error(item.place, &message, &format!("{expected} was expected"), "");
    }
}

/// A section while it is read.
#[derive(Debug)]
pub struct Reader<'c, 'a> {
    /// Report, numbers and names of the whole file.
    pub context: &'c mut Context<'a>,
    /// `[material.steel]`, for messages.
    pub title: String,
    /// Where the section's name stands.
    pub place: Place,
    prefix: String,
    entries: Vec<Entry>,
    /// The keys that it may have: the reader must ask for no other one; empty: it has no table.
    keys: &'static [Key],
    known: Vec<&'static str>,
    missing: Vec<(String, String)>,
    /// Whether its numbers are parameters: those of tables in a section are not.
    lists: bool,
}

impl<'c, 'a> Reader<'c, 'a> {
    /// Begins with a section of these keys; `prefix` comes before the names of its numbers: `steel.`.
    pub fn new(
        context: &'c mut Context<'a>,
        keys: &'static [Key],
        title: String,
        prefix: String,
        place: Place,
        entries: Vec<Entry>,
    ) -> Self {
        Self { context, title, place, prefix, entries, keys, known: Vec::new(), missing: Vec::new(), lists: true }
    }

    /// A table that a key gives, read as a section of its own; its numbers are no parameters. None: the key is not
    /// there, or gives something else, which is reported.
    pub fn inner(&mut self, key: &'static str, expected: &str) -> Option<Reader<'_, 'a>> {
        let entry = self.take(key)?;
        let name = format!("{}{key}", self.prefix);
        match entry.item.node {
            Node::Table(entries) => {
                let inner =
                    Reader::new(self.context, &[], format!("`{name}`"), format!("{name}."), entry.key_place, entries);
                Some(Reader { lists: false, ..inner })
            }
            _ => {
                self.context.wrong_type(&name, &entry.item, expected);
                None
            }
        }
    }

    /// The place in the file that makes an entry a parameter: an override alone does not.
    fn listed(&self, entry: &Entry) -> Option<usize> {
        (self.lists && entry.key_place.source == 0).then_some(entry.key_place.start)
    }

    /// Takes a key out of the section.
    pub fn take(&mut self, key: &'static str) -> Option<Entry> {
        self.know(key);
        self.entries.iter().position(|entry| entry.key == key).map(|at| self.entries.remove(at))
    }

    /// Whether a key is there; it is still to be read.
    pub fn has(&mut self, key: &'static str) -> bool {
        self.know(key);
        self.entries.iter().any(|entry| entry.key == key)
    }

    fn know(&mut self, key: &'static str) {
        let is_listed = self.keys.is_empty() || self.keys.iter().any(|own| own.word == key);
        debug_assert!(is_listed, "{} reads `{key}`, which its table of keys does not have", self.title);
        if !self.known.contains(&key) {
            self.known.push(key);
        }
    }

    /// A key is missing: reported at the end, unless it is only mistyped.
    pub fn missing(&mut self, key: &str, help: &str) {
        self.missing.push((key.to_owned(), help.to_owned()));
    }

    /// Reports every key that is missing and every key that nobody asked for.
    pub fn finish(mut self) {
        let help = format!("known here: {}", self.known.join(", "));
        for entry in std::mem::take(&mut self.entries) {
            let message = format!("unknown key `{}` in {}", entry.key, self.title);
            let meant = meant(KEY, &entry.key, self.known.iter().copied());
            self.missing.retain(|(key, _)| Some(key.as_str()) != meant);
            let label = meant.map_or(String::new(), |key| format!("did you mean `{key}`?"));
            self.context.report.error(entry.key_place, &message, &label, &help);
        }
        self.abandon();
    }

    /// Reports what is missing; without it nobody knows which of the other keys belong here.
    pub fn abandon(self) {
        for (key, help) in &self.missing {
            let message = format!("{} needs the key `{key}`", self.title);
            self.context.report.error(self.place, &message, "missing here", help);
        }
    }

    /// Reports a key of the format that has no meaning in this very section; `label` stands behind the underlining.
    pub fn refuse(&mut self, key: &str, message: &str, label: &str) {
        if let Some(at) = self.entries.iter().position(|entry| entry.key == key) {
            let entry = self.entries.remove(at);
            self.context.report.error(entry.key_place, message, label, "");
        }
    }

    /// Whether an override gives the value of a key.
    pub fn is_overridden(&self, key: &str) -> bool {
        self.place_of(key).source > 0
    }

    /// Leaves out a key unless an override gives it: one that an override of another key has robbed of its meaning.
    pub fn set_aside(&mut self, key: &str) {
        if !self.is_overridden(key) {
            self.entries.retain(|entry| entry.key != key);
        }
    }

    /// Where the value of a key stands; the section's name where it does not.
    pub fn place_of(&self, key: &str) -> Place {
        self.entries.iter().find(|entry| entry.key == key).map_or(self.place, |entry| entry.item.place)
    }

    /// The text that a key gives; it is still to be read.
    pub fn text_of(&self, key: &str) -> Option<&str> {
        self.entries.iter().find(|entry| entry.key == key).and_then(|entry| match &entry.item.node {
            Node::Text(text) => Some(text.as_str()),
            _ => None,
        })
    }

    /// The texts of a list, as far as they are texts.
    pub fn texts_of(&self, key: &str) -> Vec<String> {
        let entry = self.entries.iter().find(|entry| entry.key == key);
        let items = entry.map_or(&[][..], |entry| match &entry.item.node {
            Node::Array(items) => items,
            _ => &[],
        });
        let text = |item: &Item| if let Node::Text(text) = &item.node { Some(text.clone()) } else { None };
        items.iter().filter_map(text).collect()
    }

    /// A key that cannot stand together with another one that is there.
    pub fn exclude(&mut self, key: &'static str, other: &str) {
        if let Some(entry) = self.take(key) {
            let message = format!("`{key}` and `{other}` cannot both be given in {}", self.title);
            self.context.report.error(entry.key_place, &message, &format!("either this or `{other}`"), "");
        }
    }

    /// A number that must be there.
    pub fn number(&mut self, rule: &Rule) -> Number {
        self.optional(rule).unwrap_or_else(|| {
            self.missing(rule.key, &format!("{}{}", rule.meaning, unit_words(rule)));
            self.default(rule, None, Written::Broken)
        })
    }

    /// A number, or its default.
    pub fn number_or(&mut self, rule: &Rule, default: f64) -> Number {
        self.optional(rule).unwrap_or_else(|| self.default(rule, None, Written::Plain(default)))
    }

    /// A number that may be left out.
    pub fn optional(&mut self, rule: &Rule) -> Option<Number> {
        let entry = self.take(rule.key)?;
        let name = format!("{}{}", self.prefix, rule.key);
        Some(self.scalar(rule, name, &entry.item, self.listed(&entry), None))
    }

    /// A count that shapes the table of variables: a whole number in the file, no parameter and no expression.
    pub fn count_or(&mut self, rule: &Rule, default: usize) -> usize {
        let Some(entry) = self.take(rule.key) else { return default };
        let name = format!("{}{}", self.prefix, rule.key);
        let Node::Integer(count) = entry.item.node else {
            self.context.wrong_type(&name, &entry.item, "a whole number");
            return default;
        };
        if let Some(objection) = Meta::of(rule, name.clone()).objection(count as f64) {
            let message = format!("`{name}` {objection}");
            self.context.report.error(entry.item.place, &message, &format!("this is {count}"), "");
            return default;
        }
        usize::try_from(count).unwrap_or(default)
    }

    /// A number that is not written in the file.
    fn default(&mut self, rule: &Rule, component: Option<usize>, written: Written) -> Number {
        let index = component.map_or(String::new(), |i| format!("[{i}]"));
        let meta = Meta::of(rule, format!("{}{}{index}", self.prefix, rule.key));
        self.context.numbers.push(Slot { meta, place: self.place, listed: None, written })
    }

    fn scalar(
        &mut self,
        rule: &Rule,
        name: String,
        item: &Item,
        listed: Option<usize>,
        default: Option<f64>,
    ) -> Number {
        let variable = rule.variable;
        let written = match &item.node {
            Node::Integer(value) => Written::Plain(*value as f64),
            Node::Float(value) => Written::Plain(*value),
            Node::Text(text) => match self.context.program(text, item.place, variable) {
                Some(program) => Written::Formula(Formula::single(program)),
                None => Written::Broken,
            },
            Node::Array(pieces) if variable != Variable::None => match self.pieces(&name, item, pieces, variable) {
                Some(formula) => Written::Formula(formula),
                None => Written::Broken,
            },
            Node::Missing if default.is_some() => Written::Plain(default.unwrap_or_default()),
            Node::Missing => {
                let message = format!("`{name}` has no value");
                self.context.report.error(item.place, &message, "the other components must be given too", "");
                Written::Broken
            }
            _ => {
                self.context.wrong_type(&name, item, "a number, or an expression in quotes,");
                Written::Broken
            }
        };
        let meta = Meta::of(rule, name);
        self.context.numbers.push(Slot { meta, place: item.place, listed, written })
    }

    /// `[{ until = .., is = .. }, { is = .. }]`.
    fn pieces(&mut self, name: &str, item: &Item, items: &[Item], variable: Variable) -> Option<Formula> {
        let mut pieces = Vec::new();
        let mut sound = !items.is_empty();
        if items.is_empty() {
            self.context.wrong_type(name, item, "a number, an expression, or a list of pieces");
        } else if items.iter().all(|item| matches!(item.node, Node::Integer(_) | Node::Float(_))) {
            let message = format!("`{name}` is a list of {} numbers", items.len());
            let help = "it is one number; pieces are written [{ until = 1, is = 2 }, { is = 3 }]";
            self.context.report.error(item.place, &message, "one number, or an expression, was expected", help);
            return None;
        }
        for (k, item) in items.iter().enumerate() {
            let Node::Table(entries) = &item.node else {
                let expected = format!("a piece like {{ until = 1, is = \"{}\" }}", variable.word());
                self.context.wrong_type(name, item, &expected);
                sound = false;
                continue;
            };
            let mut until = None;
            let mut is = None;
            for entry in entries {
                match entry.key.as_str() {
                    "until" => until = Some(self.piece_value(name, &entry.item, Variable::None)),
                    "is" => is = Some(self.piece_value(name, &entry.item, variable)),
                    _ => {
                        let message = format!("unknown key `{}` in a piece of `{name}`", entry.key);
                        let label = suggestion(&entry.key, ["until", "is"]);
                        self.context.report.error(entry.key_place, &message, &label, "known here: until, is");
                        sound = false;
                    }
                }
            }
            let last = k + 1 == items.len();
            let complaint = match (is.is_some(), until.is_some(), last) {
                (false, _, _) => Some("a piece needs its value, `is`"),
                (_, false, false) => Some("every piece but the last needs `until`"),
                (_, true, true) => Some("the last piece must not have `until`: it applies to all later times"),
                _ => None,
            };
            if let Some(complaint) = complaint {
                let help = format!("{name} = [{{ until = 1, is = \"{}\" }}, {{ is = 1 }}]", variable.word());
                self.context.report.error(item.place, complaint, "", &help);
            }
            let broken = complaint.is_some() || matches!(is, Some(None)) || matches!(until, Some(None));
            sound &= !broken;
            if let (false, Some(Some(is))) = (broken, is) {
                pieces.push(Piece { until: until.flatten(), is });
            }
        }
        sound.then(|| Formula::piecewise(pieces))
    }

    fn piece_value(&mut self, name: &str, item: &Item, variable: Variable) -> Option<Program> {
        match &item.node {
            Node::Integer(value) => Some(Program::constant(*value as f64)),
            Node::Float(value) => Some(Program::constant(*value)),
            Node::Text(text) => self.context.program(text, item.place, variable),
            _ => {
                self.context.wrong_type(name, item, "a number, or an expression in quotes,");
                None
            }
        }
    }

    /// A word out of a table.
    pub fn word<T: Copy>(&mut self, key: &'static str, words: &[(&'static str, T)], default: Option<T>) -> Option<T> {
        let Some(entry) = self.take(key) else {
            if default.is_none() {
                self.missing(key, &format!("one of {}", listing(words.iter().map(|(word, _)| *word))));
            }
            return default;
        };
        let name = format!("{}{key}", self.prefix);
        let listing = listing(words.iter().map(|(word, _)| *word));
        let Node::Text(word) = &entry.item.node else {
            self.context.wrong_type(&name, &entry.item, &listing);
            return default;
        };
        if let Some((_, value)) = words.iter().find(|(known, _)| known == word) {
            return Some(*value);
        }
        let message = format!("unknown {key} \"{word}\"");
        let near = suggestion_for(key, word, words.iter().map(|(word, _)| *word));
        let known = format!("known here: {listing}");
        self.context.report.error(entry.item.place, &message, &near, instead(key, word).unwrap_or(&known));
        default
    }

    /// true or false, or its default.
    pub fn boolean(&mut self, key: &'static str, default: bool) -> bool {
        match self.take(key) {
            None => default,
            Some(Entry { item: Item { node: Node::Boolean(value), .. }, .. }) => value,
            Some(entry) => {
                self.context.wrong_type(key, &entry.item, "true or false");
                default
            }
        }
    }

    /// A text with its place.
    pub fn text(&mut self, key: &'static str) -> Option<(String, Place)> {
        let entry = self.take(key)?;
        match entry.item.node {
            Node::Text(text) => Some((text, entry.item.place)),
            _ => {
                self.context.wrong_type(key, &entry.item, "a string");
                None
            }
        }
    }
}

fn unit_words(rule: &Rule) -> String {
    if rule.unit.is_empty() { String::new() } else { format!(", in {}", rule.unit) }
}

/// `"small", "large" or "large_truncated"`.
pub fn listing<'s>(words: impl Iterator<Item = &'s str>) -> String {
    let quoted: Vec<_> = words.map(|word| format!("\"{word}\"")).collect();
    either(&quoted.iter().map(String::as_str).collect::<Vec<_>>())
}

/// `a joint, a drive or a frame`.
pub fn either(words: &[&str]) -> String {
    match words.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        Some((last, _)) => (*last).to_owned(),
        None => String::new(),
    }
}
