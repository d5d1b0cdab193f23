//! Keys of sections: what they hold, and for numbers the meaning, the unit, the allowed range, and whether they may
//! change while the model runs.
//!
//! Each section has the table of its keys in its own file; copies, overrides and docs/language/reference.md follow from
//! it.

use super::range::{Limit, Range};
use crate::model::expression::Variable;

/// The rule for a numeric key.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// The key as written in the file.
    pub key: &'static str,
    /// What the number is.
    pub meaning: &'static str,
    /// Unit label; empty: dimensionless.
    pub unit: &'static str,
    /// Allowed values.
    pub range: Range,
    /// A count.
    pub integer: bool,
    /// The solver takes a change between two steps.
    pub tunable: bool,
    /// What it may depend on: t, along a curve s, of a temperature both, in the law of a spring x and v.
    pub variable: Variable,
}

impl Rule {
    /// A rule for any finite number, which is fixed while the model runs.
    pub(super) const fn new(key: &'static str, meaning: &'static str, unit: &'static str) -> Self {
        Self { key, meaning, unit, range: Range::ALL, integer: false, tunable: false, variable: Variable::None }
    }

    pub(super) const fn above(mut self, limit: f64) -> Self {
        self.range.lower = Some(Limit { value: limit, included: false });
        self
    }

    pub(super) const fn below(mut self, limit: f64) -> Self {
        self.range.upper = Some(Limit { value: limit, included: false });
        self
    }

    pub(super) const fn from(mut self, limit: f64) -> Self {
        self.range.lower = Some(Limit { value: limit, included: true });
        self
    }

    pub(super) const fn to(mut self, limit: f64) -> Self {
        self.range.upper = Some(Limit { value: limit, included: true });
        self
    }

    pub(super) const fn count(mut self) -> Self {
        self.integer = true;
        self
    }

    pub(super) const fn tunable(mut self) -> Self {
        self.tunable = true;
        self
    }

    pub(super) const fn in_time(mut self) -> Self {
        self.variable = Variable::Time;
        self
    }

    pub(super) const fn in_control(mut self) -> Self {
        self.variable = Variable::Control;
        self
    }

    pub(super) const fn over_elongation(mut self) -> Self {
        self.variable = Variable::Elongation;
        self
    }

    pub(super) const fn over_coordinate(mut self) -> Self {
        self.variable = Variable::Followed;
        self
    }

    pub(super) const fn along_beam(mut self) -> Self {
        self.variable = Variable::Curve;
        self
    }

    pub(super) const fn in_flow(mut self) -> Self {
        self.variable = Variable::Height;
        self
    }

    pub(super) const fn along_in_time(mut self) -> Self {
        self.variable = Variable::AlongInTime;
        self
    }
}

/// A key of a section: the one place that tells the format of it.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// As written in the file.
    pub word: &'static str,
    /// The role of its value, which says how a copy changes it.
    pub role: Role,
    /// How many numbers it holds, in words; empty: one.
    pub count: &'static str,
    /// The rules of its numbers: several where the other keys of the section decide which of them applies.
    pub rules: &'static [&'static Rule],
    /// The words that it takes.
    pub words: &'static [&'static str],
    /// The meaning of a key that does not hold numbers.
    pub meaning: &'static str,
}

/// What a key holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Words of the format, free text, `true` or `false`: the same in every copy.
    Word,
    /// Numbers that a turn does not change.
    Number,
    /// A position, global.
    Position,
    /// The offset of a point: a position where it is on the ground, a direction on a frame, else numbers in the axes of
    /// what it is on.
    Offset,
    /// A direction, a velocity, a force: global components.
    Direction,
    /// Three values along the global axes as drawn where it is a list, else a number.
    AlongAxes,
    /// Three directions, global.
    Axes,
    /// The table of a curve.
    Curve,
    /// The name of a thing of a section, or of a place or a point of it; a position where it is a list.
    Name(&'static str),
    /// The name of a thing of a section (or of one of several, with ` or ` between them), or a list of such names.
    Names(&'static str),
    /// The name of a part or a point of it, whatever it is.
    Part,
}

/// The word for all sections of places, which an `a`, a `b`, an `on` or an `in` can refer to.
pub const PLACES: &str = "place";

impl Key {
    /// Numbers that a turn does not change.
    pub(super) const fn number(rules: &'static [&'static Rule]) -> Self {
        Self { word: rules[0].key, role: Role::Number, count: "", rules, words: &[], meaning: "" }
    }

    /// A list of numbers that a turn does not change.
    pub(super) const fn list(rules: &'static [&'static Rule], count: &'static str) -> Self {
        Self { count, ..Self::number(rules) }
    }

    /// Numbers that turn or move with a copy.
    pub(super) const fn global(rules: &'static [&'static Rule], role: Role) -> Self {
        let count = if matches!(role, Role::Axes) { "3 rows of 3" } else { "3" };
        Self { role, count, ..Self::number(rules) }
    }

    /// A number, or three along the global axes as drawn.
    pub(super) const fn on_axes(rules: &'static [&'static Rule]) -> Self {
        Self { role: Role::AlongAxes, count: "1 or 3", ..Self::number(rules) }
    }

    /// A word of the format, a text, `true` or `false`.
    pub(super) const fn word(word: &'static str, words: &'static [&'static str], meaning: &'static str) -> Self {
        Self { word, role: Role::Word, count: "", rules: &[], words, meaning }
    }

    /// The name of something in the file.
    pub(super) const fn name(word: &'static str, role: Role, meaning: &'static str) -> Self {
        Self { word, role, count: "", rules: &[], words: &[], meaning }
    }

    /// `true` or `false`.
    pub(super) const fn flag(word: &'static str, meaning: &'static str) -> Self {
        Self::word(word, &["true", "false"], meaning)
    }
}

/// The words of a table of words and their values.
pub(super) const fn words_of<T: Copy, const N: usize>(table: &[(&'static str, T); N]) -> [&'static str; N] {
    let mut words = [""; N];
    let mut at = 0;
    while at < N {
        words[at] = table[at].0;
        at += 1;
    }
    words
}
