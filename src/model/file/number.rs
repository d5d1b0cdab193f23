//! The flat list of every number of a file: what was written, what it must satisfy, and its value with the parameters
//! resolved.

use super::range::Range;
use super::schema::Rule;
use crate::model::expression::Variable;
use crate::model::expression::function::{Formula, Function};
use crate::model::expression::program::Undefined;
use crate::model::text::diagnostic::{Place, Report};

/// A number of the file: its index in the flat list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Number(pub(in crate::model) usize);

/// What is known of a number besides its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Meta {
    /// `steel.young`, `tip.force[1]`.
    pub name: String,
    /// What it is, as a sentence.
    pub description: String,
    /// Unit label; empty: dimensionless.
    pub unit: String,
    /// Unit that a host shows.
    pub display: Option<String>,
    /// Allowed values.
    pub range: Range,
    /// A count.
    pub integer: bool,
    /// The solver takes a change between two steps.
    pub tunable: bool,
    /// The host gives it, from one communication step to the next.
    pub input: bool,
    /// What it may depend on.
    pub variable: Variable,
}

impl Meta {
    /// What a rule says of the number `name`.
    pub(super) fn of(rule: &Rule, name: String) -> Self {
        Self {
            description: description(rule.meaning, &name),
            name,
            unit: rule.unit.to_owned(),
            display: None,
            range: rule.range,
            integer: rule.integer,
            tunable: rule.tunable,
            input: false,
            variable: rule.variable,
        }
    }

    /// Why `value` is not allowed; none: it is.
    pub fn objection(&self, value: f64) -> Option<String> {
        if !value.is_finite() {
            Some("must be a finite number".to_owned())
        } else if self.integer && value.fract() != 0.0 {
            Some("must be a whole number".to_owned())
        } else if !self.range.contains(value) {
            Some(format!("must be {}", self.range.words()))
        } else {
            None
        }
    }
}

/// `steel: Young's modulus`, `arm: start of the beam, component 2`: whose number it is, its meaning, and which
/// component the name says. What belongs to the whole file is a sentence of its own.
fn description(meaning: &str, name: &str) -> String {
    let component = name.strip_suffix(']').and_then(|name| name.rsplit_once('['));
    let component = component.map_or(String::new(), |(_, index)| format!(", component {index}"));
    match name.rsplit_once('.') {
        Some((part, _)) if part != "simulation" => format!("{part}: {meaning}{component}"),
        _ => {
            let (first, rest) = meaning.split_at(meaning.chars().next().map_or(0, char::len_utf8));
            format!("{}{rest}{component}", first.to_uppercase())
        }
    }
}

/// A number as written.
#[derive(Clone, Debug, PartialEq)]
pub enum Written {
    /// A plain number.
    Plain(f64),
    /// An expression, or pieces.
    Formula(Formula),
    /// What was written is wrong and reported.
    Broken,
}

/// One number of the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Slot {
    /// Name, unit, range.
    pub meta: Meta,
    /// Where it is written; the section's name for a default.
    pub place: Place,
    /// Where the file makes it a parameter: the order of the table of parameters. None: it is no parameter.
    pub listed: Option<usize>,
    /// What was written.
    pub written: Written,
}

/// Names of a cycle that a message shows.
const SHOWN: usize = 10;

/// The flat list. The entries of `[parameters]` come first, in file order: only they are used by expressions.
#[derive(Clone, Debug, Default)]
pub struct Numbers {
    /// The numbers.
    pub slots: Vec<Slot>,
    /// Their values; of a number that changes in time the value at 0.
    pub values: Vec<f64>,
    /// How many of them are entries of `[parameters]`.
    pub named: usize,
    /// The entries of [parameters] in an order in which each uses only earlier ones.
    order: Vec<usize>,
}

impl Numbers {
    /// One more number.
    pub fn push(&mut self, slot: Slot) -> Number {
        self.values.push(f64::NAN);
        self.slots.push(slot);
        Number(self.slots.len() - 1)
    }

    /// The number of `[parameters]` with this name.
    pub fn parameter(&self, name: &str) -> Option<usize> {
        self.slots[..self.named].iter().position(|slot| slot.meta.name == name)
    }

    /// The value of a number, parameters resolved; of one that changes in time the value at 0.
    pub fn value(&self, number: Number) -> f64 {
        self.values[number.0]
    }

    /// A number of the list, ready for evaluation at any time.
    pub fn function(&self, number: Number) -> Function {
        match &self.slots[number.0].written {
            Written::Formula(formula) => formula.bound(|place| self.values[place]),
            Written::Plain(_) | Written::Broken => Function::constant(self.values[number.0]),
        }
    }

    /// Orders the parameters by their use of each other; a cycle is reported.
    pub fn sort(&mut self, report: &mut Report<'_>) {
        let uses = |place: usize| match &self.slots[place].written {
            Written::Formula(formula) => formula.parameters().collect(),
            _ => Vec::new(),
        };
        let uses: Vec<Vec<usize>> = (0..self.named).map(uses).collect();
        let mut done = vec![false; self.named];
        // Sweeps instead of recursion: a chain of any length is safe. The file order needs one sweep.
        loop {
            let before = self.order.len();
            for place in 0..self.named {
                if !done[place] && uses[place].iter().all(|used| done[*used]) {
                    done[place] = true;
                    self.order.push(place);
                }
            }
            if self.order.len() == before {
                break;
            }
        }
        let Some(first) = done.iter().position(|done| !done) else { return };
        for slot in done.iter().zip(&mut self.slots).filter(|(done, _)| !**done).map(|(_, slot)| slot) {
            slot.written = match &slot.written {
                Written::Formula(_) => Written::Broken,
                other => other.clone(),
            };
        }
        let (names, at) = self.cycle(first, &uses, &done);
        let message = format!("the parameters {names} need each other");
        report.error(self.slots[at].place, &message, "part of a cycle", "give one of them as a number");
    }

    /// A cycle that can be reached from `start`, as text, and one of its members.
    fn cycle(&self, start: usize, uses: &[Vec<usize>], done: &[bool]) -> (String, usize) {
        let mut path = vec![start];
        loop {
            let last = path[path.len() - 1];
            let next = uses[last].iter().copied().find(|used| !done[*used]);
            let next = next.expect("what is not done uses something that is not done");
            if let Some(begin) = path.iter().position(|place| *place == next) {
                let cycle = path[begin..].iter().chain([&next]);
                let mut names: Vec<_> = cycle.map(|place| self.slots[*place].meta.name.as_str()).collect();
                if names.len() > SHOWN {
                    names.splice(SHOWN / 2..names.len() - SHOWN / 2, ["..."]);
                }
                let at = path[begin..].iter().copied().min().unwrap_or(next);
                return (names.join(" -> "), at);
            }
            path.push(next);
        }
    }

    /// Computes every value from what is written.
    pub fn resolve(&mut self) {
        for k in 0..self.order.len() {
            self.resolve_one(self.order[k]);
        }
        for place in self.named..self.slots.len() {
            self.resolve_one(place);
        }
    }

    fn resolve_one(&mut self, place: usize) {
        let values = &self.values;
        self.values[place] = match &self.slots[place].written {
            Written::Plain(value) => *value,
            Written::Formula(formula) => formula.bound(|used| values[used]).value(0.0),
            Written::Broken => f64::NAN,
        };
    }

    /// Numbers that are not what they must be, each with the reason. A number that changes in time is asked only
    /// whether its pieces ascend.
    pub fn objections(&self) -> Vec<(Number, String)> {
        let mut list = Vec::new();
        for (place, slot) in self.slots.iter().enumerate() {
            if !self.is_sound(place) {
                continue;
            }
            let objection = match &slot.written {
                Written::Formula(formula) if !formula.is_constant() => {
                    formula.bound(|used| self.values[used]).objection()
                }
                _ => slot.meta.objection(self.values[place]),
            };
            list.extend(objection.map(|objection| (Number(place), objection)));
        }
        list
    }

    /// Numbers that ask a table for a value that it does not have, each with the time, s, where that is known before a
    /// run to `stop` s.
    pub fn undefined(&self, stop: f64) -> Vec<(Number, f64, Undefined)> {
        let sound = (0..self.slots.len()).filter(|place| self.is_sound(*place));
        let found = sound.filter_map(|place| {
            let Written::Formula(formula) = &self.slots[place].written else { return None };
            if !formula.may_be_undefined() {
                return None;
            }
            let end = match self.slots[place].meta.variable {
                Variable::Time | Variable::Control => stop,
                Variable::AlongInTime if !formula.has_rate() => stop,
                Variable::None => 0.0,
                // The curve is looked at where it is drawn, a temperature along the beam, laws of springs and gears
                // where they go, currents where beams are.
                Variable::Curve
                | Variable::Height
                | Variable::AlongInTime
                | Variable::Elongation
                | Variable::Followed => return None,
            };
            let (time, undefined) = formula.undefined_between([0.0, end], |used| self.values[used])?;
            Some((Number(place), time, undefined))
        });
        found.collect()
    }

    /// Whether a number is written as a function of time.
    pub fn changes_in_time(&self, number: Number) -> bool {
        matches!(&self.slots[number.0].written, Written::Formula(formula) if !formula.is_constant())
    }

    /// Whether everything that a number is made of is finite: otherwise the mistake is reported where it begins.
    pub fn is_sound(&self, place: usize) -> bool {
        match &self.slots[place].written {
            Written::Plain(_) => true,
            Written::Formula(formula) => formula.parameters().all(|used| self.values[used].is_finite()),
            Written::Broken => false,
        }
    }

    /// Parameters that feed numbers which the solver takes between two steps, and only these, are tunable.
    pub fn spread_tunable(&mut self) {
        let mut used = vec![false; self.named];
        let mut tunable = vec![true; self.named];
        let rest = (self.named..self.slots.len()).chain(self.order.iter().rev().copied());
        for place in rest {
            if place < self.named {
                self.slots[place].meta.tunable = used[place] && tunable[place];
            }
            let takes = self.slots[place].meta.tunable;
            // An entry of [parameters] that feeds nothing says nothing about those it uses.
            let counts = place >= self.named || used[place];
            if let (Written::Formula(formula), true) = (&self.slots[place].written, counts) {
                for parameter in formula.parameters() {
                    used[parameter] = true;
                    tunable[parameter] &= takes;
                }
            }
        }
    }
}
