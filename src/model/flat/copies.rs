//! `[copy.NAME]` and `[include.NAME]`: how often, with which names and numbers, and where.

use super::instance::Flattener;
use super::motion::Motion;
use super::scalar::Scalar;
use super::scope::{Scope, StandIn, entries_of};
use super::tables::{COPY, INCLUDE, PARAMETERS, names_of};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::{Kind, SECTIONS, is_legal, is_reserved, suggestion};
use crate::model::text::tree::{Entry, Item, Node};
use std::f64::consts::TAU;

/// The keys of a copy besides its sections.
const KEYS: [&str; 5] = ["count", "over", "index", "turn", "move"];
/// The keys of an include.
const OF_INCLUDE: [&str; 4] = ["file", "set", "turn", "move"];
/// The keys of a turn.
const OF_TURN: [&str; 3] = ["axis", "angle", "center"];
/// More copies of one thing than this are a mistake.
const MOST: f64 = 10_000.0;
/// What an include counts as in numbers and words.
const VALUES_OF_INCLUDE: usize = 100;
/// Copies in copies, and includes in includes.
const DEEPEST: usize = 20;
/// The name of the index where the file does not say one.
const INDEX: &str = "k";

/// Relative round-off of an angle that an expression gives.
const ROUND_OFF: f64 = 1e-9;

/// What differs from copy to copy besides the index.
type Row = Vec<StandIn>;

impl Flattener<'_> {
    /// All copies of a `[copy.NAME]`.
    pub fn fill_copies(&mut self, outer: &Scope<'_>, copy: &Entry) {
        let Some(body) = entries_of(&copy.item) else {
            return self.expect_section(outer, copy, "[copy.NAME]");
        };
        let title = format!("[copy.{}]", copy.key);
        let sections = SECTIONS.iter().map(|(word, _)| *word);
        let known: Vec<&str> = KEYS.into_iter().chain([COPY, INCLUDE, PARAMETERS]).chain(sections).collect();
        if !self.are_known(outer, &title, body, &known) || !self.is_shallow(outer, copy.key_place) {
            return;
        }
        let Some(index) = self.index(outer, body) else { return };
        let Some(rows) = self.rows(outer, copy, body, &index) else { return };
        let mut first = None;
        let (count, mut before) = (rows.len(), None);
        for (number, row) in rows.into_iter().enumerate() {
            // Copies without parts count too: they take time.
            if !self.spend(0, 1, copy.key_place) {
                return;
            }
            let k = (number + 1).to_string();
            let own = StandIn { name: index.clone(), text: k.clone(), written: k.clone() };
            let values = std::iter::once(own).chain(row).collect();
            let indices = outer.indices.iter().cloned().chain([k.clone()]).collect();
            let note = self.note(outer, &format!("in copy {k} of {}", copy.key));
            let scope = Scope {
                parent: Some(outer),
                body,
                is_file: false,
                prefix: outer.prefix.clone(),
                indices,
                values,
                set: &[],
                motion: Motion::none(),
                note,
                depth: outer.depth + 1,
            };
            let Some((own, angle)) = self.motion(&scope, body, Some(even_share(number, count))) else { return };
            if let (Some(angle), Some(before)) = (angle, before) {
                self.suspect(body, &title, angle - before, count);
            }
            before = angle;
            if number == 0 {
                first = Some(own.clone());
            } else if number == 1 && own != Motion::none() && first.as_ref() == Some(&own) {
                let moved = body.iter().find(|entry| entry.key == "turn" || entry.key == "move");
                let place = moved.map_or(copy.key_place, |entry| entry.key_place);
                let message = format!("`turn` and `move` put all copies of {} at the same place", copy.key);
                let help = format!(
                    "write them with the index: angle = \"2*pi*({index} - 1)/6\", move = [\"0.1*({index} - 1)\", 0, 0]"
                );
                return self.error(outer, place, &message, &format!("the same for every {index}"), &help);
            }
            let motion = outer.motion.after(&own);
            self.fill(&Scope { motion, ..scope });
        }
    }

    /// The file of an `[include.NAME]`.
    pub fn fill_file(&mut self, outer: &Scope<'_>, include: &Entry) {
        let Some(keys) = entries_of(&include.item) else {
            return self.expect_section(outer, include, "[include.NAME]");
        };
        let title = format!("[include.{}]", include.key);
        if !self.are_known(outer, &title, keys, &OF_INCLUDE) || !self.is_shallow(outer, include.key_place) {
            return;
        }
        if !is_legal(&include.key) {
            let help = "a name is a letter, then letters, digits and _";
            return self.error(outer, include.key_place, &format!("`{}` is not a valid name", include.key), "", help);
        }
        // Files without parts count too: they take time.
        if !self.spend(0, VALUES_OF_INCLUDE, include.key_place) {
            return;
        }
        let library = self.library;
        let named = keys.iter().find(|entry| entry.key == "file");
        let Some((shown, body)) = named.and_then(|entry| library.file(entry.item.place)) else {
            let place = named.map_or(include.key_place, |entry| entry.item.place);
            return self.error(outer, place, &format!("{title} needs the name of a file"), "", "file = \"blade.toml\"");
        };
        let set = match keys.iter().find(|entry| entry.key == "set") {
            None => &[][..],
            Some(set) => match entries_of(&set.item) {
                Some(set) => set,
                None => return self.expect_section(outer, set, "{ length = 3 }"),
            },
        };
        for entry in set {
            if !names_of(body, PARAMETERS).any(|name| name == entry.key) {
                let message = format!("{shown} has no parameter `{}`", entry.key);
                let label = suggestion(&entry.key, names_of(body, PARAMETERS));
                self.error(outer, entry.key_place, &message, &label, "");
            }
        }
        if body.iter().all(|entry| entry.key != "format") {
            let message = format!("the file {shown} does not say its format");
            let place = named.map_or(include.key_place, |entry| entry.item.place);
            self.error(outer, place, &message, "", "the first line of every model file is: format = 1");
        }
        let Some((own, angle)) = self.motion(outer, keys, None) else { return };
        if let Some(angle) = angle {
            self.suspect(keys, &title, angle, 1);
        }
        let name = outer.flat_name(&include.key);
        let note = self.note(outer, &format!("included as {name}"));
        self.fill(&Scope {
            parent: Some(outer),
            body,
            is_file: true,
            prefix: format!("{name}_"),
            indices: Vec::new(),
            values: Vec::new(),
            set,
            motion: outer.motion.after(&own),
            note,
            depth: outer.depth + 1,
        });
    }

    /// Whether a section has known keys only; the others are reported.
    fn are_known(&mut self, scope: &Scope<'_>, title: &str, keys: &[Entry], known: &[&str]) -> bool {
        let unknown = keys.iter().filter(|entry| !known.contains(&entry.key.as_str()));
        let mut are_known = true;
        for entry in unknown {
            let message = format!("unknown key `{}` in {title}", entry.key);
            let label = suggestion(&entry.key, known.iter().copied());
            self.error(scope, entry.key_place, &message, &label, &format!("known here: {}", known.join(", ")));
            are_known = false;
        }
        are_known
    }

    fn is_shallow(&mut self, scope: &Scope<'_>, place: Place) -> bool {
        if scope.depth >= DEEPEST {
            let label = format!("at most {DEEPEST} are allowed");
            self.error(scope, place, "too many copies and includes stand in one another", &label, "");
            // There may be a million others.
            self.stop();
        }
        scope.depth < DEEPEST
    }

    fn note(&mut self, outer: &Scope<'_>, words: &str) -> usize {
        let note = match self.notes[outer.note].as_str() {
            "" => words.to_owned(),
            around => format!("{words}, {around}"),
        };
        self.notes.push(note);
        self.notes.len() - 1
    }

    /// The name of the index.
    fn index(&mut self, outer: &Scope<'_>, body: &[Entry]) -> Option<String> {
        let entry = body.iter().find(|entry| entry.key == "index");
        let (name, place) = match entry.map(|entry| (&entry.item.node, entry.item.place)) {
            None => (INDEX, None),
            Some((Node::Text(name), place)) => (name.as_str(), Some(place)),
            Some((other, place)) => {
                let message = format!("`index` is {}", other.describe());
                self.error(outer, place, &message, "a name in quotes was expected", "");
                return None;
            }
        };
        let counted = body.iter().find(|entry| entry.key == "count" || entry.key == "over");
        let place = place.or_else(|| counted.map(|entry| entry.key_place)).unwrap_or(Place::file(0..0));
        self.is_free(outer, body, name, place).then(|| name.to_owned())
    }

    /// Whether a name can stand for a number of the copies: it means nothing else there.
    fn is_free(&mut self, outer: &Scope<'_>, body: &[Entry], name: &str, place: Place) -> bool {
        let message = if !is_legal(name) || is_reserved(Kind::Parameter, name) {
            format!("`{name}` cannot be the name of a number")
        } else if outer.meaning(name).is_some() || names_of(body, PARAMETERS).any(|known| known == name) {
            format!("`{name}` is the name of another number already")
        } else {
            return true;
        };
        self.error(outer, place, &message, "", "choose another name; that of the index is set by index = \"j\"");
        false
    }

    /// What differs from copy to copy, a row each.
    fn rows(&mut self, outer: &Scope<'_>, copy: &Entry, body: &[Entry], index: &str) -> Option<Vec<Row>> {
        let [count, over] = ["count", "over"].map(|key| body.iter().find(|entry| entry.key == key));
        match (count, over) {
            (Some(count), None) => {
                let value = self.number(outer, &count.item)?;
                if value.fract() != 0.0 || !(0.0..=MOST).contains(&value) {
                    let message = format!("the count of {} is {value}", copy.key);
                    let label = format!("a whole number from 0 to {MOST} was expected");
                    self.error(outer, count.item.place, &message, &label, "");
                    return None;
                }
                Some(vec![Row::new(); value as usize])
            }
            (None, Some(over)) => self.list(outer, body, &over.item, index),
            (Some(_), Some(over)) => {
                let message = format!("`count` and `over` cannot both be given in [copy.{}]", copy.key);
                self.error(outer, over.key_place, &message, "the list says how many", "");
                None
            }
            (None, None) => {
                let message = format!("[copy.{}] does not say how many copies there are", copy.key);
                self.error(
                    outer,
                    copy.key_place,
                    &message,
                    "missing here",
                    "count = 6, or over = [{ x = 0.1 }, { x = 0.3 }]",
                );
                None
            }
        }
    }

    /// The rows of `over`.
    fn list(&mut self, outer: &Scope<'_>, body: &[Entry], item: &Item, index: &str) -> Option<Vec<Row>> {
        let expected = "a list like [{ x = 0.1, y = 2 }, { x = 0.3, y = 4 }] was expected";
        let Node::Array(items) = &item.node else {
            self.error(outer, item.place, &format!("`over` is {}", item.node.describe()), expected, "");
            return None;
        };
        let mut rows = Vec::new();
        let mut names: Option<Vec<&str>> = None;
        for item in items {
            let Some(entries) = entries_of(item) else {
                self.error(outer, item.place, &format!("a row of `over` is {}", item.node.describe()), expected, "");
                return None;
            };
            let own: Vec<&str> = entries.iter().map(|entry| entry.key.as_str()).collect();
            if let Some(names) = &names {
                if names.len() != own.len() || !own.iter().all(|name| names.contains(name)) {
                    let label = format!("{} were expected, as in the first row", names.join(", "));
                    self.error(outer, item.place, "the rows of `over` have different names", &label, "");
                    return None;
                }
            } else {
                for entry in entries {
                    if entry.key == index || !self.is_free(outer, body, &entry.key, entry.key_place) {
                        let message = format!("`{}` is the index of these copies", entry.key);
                        self.error(outer, entry.key_place, &message, "another name was expected", "");
                        return None;
                    }
                }
                names = Some(own);
            }
            let mut row = Row::new();
            for entry in entries {
                let written = match &entry.item.node {
                    Node::Integer(value) => value.to_string(),
                    Node::Float(value) => format!("{value:?}"),
                    Node::Text(text) => text.clone(),
                    other => {
                        let message = format!("`{}` is {}", entry.key, other.describe());
                        let label = "a number, an expression or a name in quotes was expected";
                        self.error(outer, entry.item.place, &message, label, "");
                        return None;
                    }
                };
                let text = match &entry.item.node {
                    Node::Text(text) => self.expression(outer, text),
                    _ => written.clone(),
                };
                row.push(StandIn { name: entry.key.clone(), text, written });
            }
            if !self.spend(0, row.len(), item.place) {
                return None;
            }
            rows.push(row);
        }
        Some(rows)
    }

    /// The motion by `turn` and `move`, and the angle of the turn, rad, where it is known; none: a mistake, which is
    /// reported. A turn without an angle is by `share`.
    fn motion(&mut self, scope: &Scope<'_>, keys: &[Entry], share: Option<f64>) -> Option<(Motion, Option<f64>)> {
        let (mut motion, mut known) = (Motion::none(), None);
        if let Some(turn) = keys.iter().find(|entry| entry.key == "turn") {
            let Some(entries) = entries_of(&turn.item) else {
                let message = format!("`turn` is {}", turn.item.node.describe());
                let label = "{ axis = [0, 0, 1], angle = \"2*pi*(k - 1)/6\" } was expected";
                self.error(scope, turn.item.place, &message, label, "");
                return None;
            };
            if !self.are_known(scope, "`turn`", entries, &OF_TURN) {
                return None;
            }
            let key = |key: &str| entries.iter().find(|entry| entry.key == key).map(|entry| &entry.item);
            let (Some(axis), true) = (key("axis"), share.is_some() || key("angle").is_some()) else {
                let (message, label) = match share {
                    Some(_) => ("`turn` needs an axis", "`axis` was expected"),
                    None => ("`turn` needs an axis and an angle", "`axis` and `angle` were expected"),
                };
                self.error(scope, turn.key_place, message, label, "");
                return None;
            };
            let place = axis.place;
            let axis = self.vector(scope, axis)?;
            let [Scalar::Number(x), Scalar::Number(y), Scalar::Number(z)] = axis else {
                self.error(scope, place, "the axis of a turn depends on parameters", "numbers were expected", "");
                return None;
            };
            let angle = match key("angle") {
                None => Scalar::Number(share.unwrap_or_default()),
                Some(written) => {
                    let Some(angle) = Scalar::of(&self.numbers(scope, written)) else {
                        let message = format!("`angle` is {}", written.node.describe());
                        let label = "a number, or an expression in quotes, was expected";
                        self.error(scope, written.place, &message, label, "");
                        return None;
                    };
                    if let Scalar::Number(angle) = angle {
                        known = Some(angle);
                    }
                    angle
                }
            };
            let center = match key("center") {
                Some(center) => self.vector(scope, center)?,
                None => [0, 1, 2].map(|_| Scalar::Number(0.0)),
            };
            let Some(turned) = Motion::turned([x, y, z], &angle, &center) else {
                self.error(scope, place, "the axis of a turn has no direction", "", "");
                return None;
            };
            motion = turned;
        }
        if let Some(shift) = keys.iter().find(|entry| entry.key == "move") {
            motion = Motion::shifted(self.vector(scope, &shift.item)?).after(&motion);
        }
        Some((motion, known))
    }

    /// Remarks that an angle, of an include or from each of `count` copies to the next, is one in degrees: it is more
    /// than a whole turn, or `count` of it are 360.
    fn suspect(&mut self, keys: &[Entry], title: &str, angle: f64, count: usize) {
        let angle = angle.abs();
        let is_share = count > 1 && (angle * count as f64 - 360.0).abs() <= ROUND_OFF * 360.0;
        if angle <= TAU * (1.0 + ROUND_OFF) && !is_share {
            return;
        }
        let Some(turn) = keys.iter().find(|entry| entry.key == "turn") else { return };
        // Of an expression with an index, 60 may be 59.99999999999999.
        let round = angle.round();
        let shown = if (angle - round).abs() <= ROUND_OFF * angle { round } else { angle };
        let (what, remedy) = match count {
            1 => ("turns", ""),
            _ => ("turns from copy to copy", "; without `angle`, the copies are spread evenly over a whole turn"),
        };
        let text = format!(
            "{title} {what} by {shown} rad, {:.1} turns. Angles are in radians: {shown} degrees are \"{shown}*pi/180\"{remedy}",
            angle / TAU
        );
        self.remark(turn.key_place, text);
    }

    fn vector(&mut self, scope: &Scope<'_>, item: &Item) -> Option<[Scalar; 3]> {
        let numbers = self.numbers(scope, item);
        let list = if let Node::Array(items) = &numbers.node { items.as_slice() } else { &[] };
        if let [x, y, z] = list
            && let [Some(x), Some(y), Some(z)] = [x, y, z].map(Scalar::of)
        {
            return Some([x, y, z]);
        }
        let message = format!("this is {}", item.node.describe());
        self.error(scope, item.place, &message, "a list of 3 numbers was expected", "");
        None
    }
}

/// The angle of copy `number`, from 0, of `count` copies that are spread evenly over a whole turn, rad.
fn even_share(number: usize, count: usize) -> f64 {
    TAU * number as f64 / count as f64
}
