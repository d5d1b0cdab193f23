//! Reads lists of numbers: vectors, longer lists, tables. Each component is a number of its own. And lists of words.

use super::{Reader, listing, unit_words};
use crate::model::file::number::{Number, Written};
use crate::model::file::schema::Rule;
use crate::model::text::names::suggestion;
use crate::model::text::tree::{Entry, Item, Node};

/// What a vector is.
const VECTOR: &str = "a list of 3";

impl Reader<'_, '_> {
    /// Three numbers that must be there.
    pub fn vector(&mut self, rule: &Rule) -> [Number; 3] {
        self.list(rule, VECTOR)
    }

    /// Three numbers, or their default.
    pub fn vector_or(&mut self, rule: &Rule, default: [f64; 3]) -> [Number; 3] {
        match self.take(rule.key) {
            Some(entry) => self.components(rule, &entry, VECTOR, Some(default)),
            None => std::array::from_fn(|i| self.default(rule, Some(i + 1), Written::Plain(default[i]))),
        }
    }

    /// Three numbers, or one that is all three, or their default.
    pub fn uniform_or_vector(&mut self, rule: &Rule, default: [f64; 3]) -> [Number; 3] {
        let is_one = self.has(rule.key) && self.length_of(rule.key).is_none();
        if is_one { [self.number(rule); 3] } else { self.vector_or(rule, default) }
    }

    /// Three numbers that may be left out.
    pub fn optional_vector(&mut self, rule: &Rule) -> Option<[Number; 3]> {
        let entry = self.take(rule.key)?;
        Some(self.components(rule, &entry, VECTOR, None))
    }

    /// Two numbers, or their default.
    pub fn pair_or(&mut self, rule: &Rule, default: [f64; 2]) -> [Number; 2] {
        match self.take(rule.key) {
            Some(entry) => self.components(rule, &entry, "a list of 2", Some(default)),
            None => std::array::from_fn(|i| self.default(rule, Some(i + 1), Written::Plain(default[i]))),
        }
    }

    /// Two numbers that may be left out.
    pub fn optional_pair(&mut self, rule: &Rule) -> Option<[Number; 2]> {
        let entry = self.take(rule.key)?;
        Some(self.components(rule, &entry, "a list of 2", None))
    }

    /// Numbers that must be there; `expected` says how many: `a list of 3 or 6`.
    pub fn list<const N: usize>(&mut self, rule: &Rule, expected: &str) -> [Number; N] {
        match self.take(rule.key) {
            Some(entry) => self.components(rule, &entry, expected, None),
            None => {
                self.missing(rule.key, &format!("{}: {expected}{}", rule.meaning, unit_words(rule)));
                self.broken(rule)
            }
        }
    }

    /// How many components the list has that a key gives; none: it gives none.
    pub fn length_of(&self, key: &str) -> Option<usize> {
        self.entries.iter().find(|entry| entry.key == key).and_then(|entry| match &entry.item.node {
            Node::Array(items) => Some(items.len()),
            _ => None,
        })
    }

    /// Three rows of three numbers that may be left out. A table: none of its numbers is a parameter.
    pub fn table(&mut self, rule: &Rule) -> Option<[[Number; 3]; 3]> {
        let entry = self.take(rule.key)?;
        let rows = match three(&entry.item) {
            Some(rows) => self.rows(rule, rows),
            None => {
                let name = format!("{}{}", self.prefix, rule.key);
                self.context.wrong_type(&name, &entry.item, "a list of 3 rows of 3 numbers");
                return None;
            }
        };
        rows.try_into().ok()
    }

    /// Any number of rows of three numbers that may be left out. None of the numbers is a parameter.
    pub fn points(&mut self, rule: &Rule) -> Option<Vec<[Number; 3]>> {
        let entry = self.take(rule.key)?;
        match &entry.item.node {
            Node::Array(rows) => Some(self.rows(rule, rows)),
            _ => {
                let name = format!("{}{}", self.prefix, rule.key);
                self.context.wrong_type(&name, &entry.item, "a list of points, [x, y, z] each,");
                None
            }
        }
    }

    /// A list of words, which may be empty; `default` where there is none.
    pub fn words<T: Copy + PartialEq>(
        &mut self,
        key: &'static str,
        words: &[(&'static str, T)],
        default: &[T],
    ) -> Vec<T> {
        let Some(entry) = self.take(key) else { return default.to_vec() };
        let name = format!("{}{key}", self.prefix);
        let Node::Array(items) = &entry.item.node else {
            self.context.wrong_type(&name, &entry.item, "a list of words");
            return default.to_vec();
        };
        let known = || words.iter().map(|(word, _)| *word);
        let mut found: Vec<T> = Vec::new();
        for item in items {
            let Node::Text(word) = &item.node else {
                self.context.wrong_type(&name, item, "a word in quotes");
                continue;
            };
            let report = &mut self.context.report;
            match words.iter().find(|(known, _)| known == word) {
                None => {
                    let (message, help) =
                        (format!("unknown word \"{word}\""), format!("known here: {}", listing(known())));
                    report.error(item.place, &message, &suggestion(word, known()), &help);
                }
                Some((_, value)) if found.contains(value) => {
                    report.error(item.place, &format!("\"{word}\" is listed twice"), "the second one", "");
                }
                Some((_, value)) => found.push(*value),
            }
        }
        found
    }

    /// A list of whole numbers other than 0, which may be empty; none where there is none.
    pub fn whole_numbers(&mut self, key: &'static str) -> Vec<i64> {
        let Some(entry) = self.take(key) else { return Vec::new() };
        let name = format!("{}{key}", self.prefix);
        let Node::Array(items) = &entry.item.node else {
            self.context.wrong_type(&name, &entry.item, "a list of whole numbers");
            return Vec::new();
        };
        let mut found = Vec::new();
        for item in items {
            match item.node {
                Node::Integer(0) => {
                    let message = format!("`{name}` has a 0, and counting begins at 1");
                    self.context.report.error(item.place, &message, "this one", "");
                }
                Node::Integer(number) => found.push(number),
                _ => self.context.wrong_type(&name, item, "a whole number"),
            }
        }
        found
    }

    /// The rows that are rows of three numbers; the others are reported.
    fn rows(&mut self, rule: &Rule, rows: &[Item]) -> Vec<[Number; 3]> {
        let mut table = Vec::new();
        for (i, row) in rows.iter().enumerate() {
            let name = format!("{}{}[{}]", self.prefix, rule.key, i + 1);
            let Some(items) = three(row) else {
                self.context.wrong_type(&name, row, "a row of 3 numbers");
                continue;
            };
            table.push(std::array::from_fn(|j| {
                let name = format!("{}{}[{},{}]", self.prefix, rule.key, i + 1, j + 1);
                self.scalar(rule, name, &items[j], None, None)
            }));
        }
        table
    }

    fn components<const N: usize>(
        &mut self,
        rule: &Rule,
        entry: &Entry,
        expected: &str,
        default: Option<[f64; N]>,
    ) -> [Number; N] {
        let name = format!("{}{}", self.prefix, rule.key);
        match &entry.item.node {
            Node::Array(items) if items.len() == N => std::array::from_fn(|i| {
                let name = format!("{name}[{}]", i + 1);
                self.scalar(rule, name, &items[i], self.listed(entry), default.map(|default| default[i]))
            }),
            _ => {
                self.context.wrong_type(&name, &entry.item, &format!("{expected} numbers"));
                self.broken(rule)
            }
        }
    }

    /// Stand-ins for numbers that are reported.
    fn broken<const N: usize>(&mut self, rule: &Rule) -> [Number; N] {
        std::array::from_fn(|i| self.default(rule, Some(i + 1), Written::Broken))
    }
}

fn three(item: &Item) -> Option<&[Item; 3]> {
    match &item.node {
        Node::Array(items) => items.as_slice().try_into().ok(),
        _ => None,
    }
}
