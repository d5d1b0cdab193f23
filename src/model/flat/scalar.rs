//! Numbers of a copy that is turned or moved: known ones, or expressions where parameters or time are in them.

use crate::math::elementary::sin_cos;
use crate::model::expression::{LENGTH, Variable, compile};
use crate::model::text::tree::{Item, Node};

/// A number that is known, or an expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Scalar {
    /// A known number.
    Number(f64),
    /// An expression.
    Text(String),
}

/// What is left of `cos(pi/2)` by rounding, and how far `cos(0)` is off at most.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

impl Scalar {
    /// The number that an item of a list is; none: it is something else.
    pub fn of(item: &Item) -> Option<Self> {
        match &item.node {
            Node::Integer(value) => Some(Self::Number(*value as f64)),
            Node::Float(value) => Some(Self::Number(*value)),
            Node::Text(text) => Some(Self::parse(text)),
            _ => None,
        }
    }

    /// An expression; a number if it has no name in it.
    pub fn parse(text: &str) -> Self {
        constant(text).map_or_else(|| Self::Text(text.to_owned()), Self::Number)
    }

    /// As a value of the file.
    pub fn node(&self) -> Node {
        match self {
            // Adding zero turns -0 into 0.
            Self::Number(value) => Node::Float(value + 0.0),
            Self::Text(text) => Node::Text(text.clone()),
        }
    }

    fn text(&self) -> String {
        match self {
            Self::Number(value) if *value < 0.0 => format!("({value:?})"),
            Self::Number(value) => format!("{value:?}"),
            Self::Text(text) => format!("({text})"),
        }
    }

    /// Whether it is this number.
    fn is(&self, value: f64) -> bool {
        *self == Self::Number(value)
    }

    pub fn plus(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => Self::Number(a + b),
            _ if self.is(0.0) => other.clone(),
            _ if other.is(0.0) => self.clone(),
            (a, Self::Number(b)) if *b < 0.0 => Self::joined(&a.bare(), " - ", &format!("{:?}", -b)),
            (a, b) => Self::joined(&a.bare(), " + ", &b.bare()),
        }
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&Self::Number(-1.0).times(other))
    }

    pub fn times(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => Self::Number(a * b),
            _ if self.is(0.0) || other.is(0.0) => Self::Number(0.0),
            _ if self.is(1.0) => other.clone(),
            _ if other.is(1.0) => self.clone(),
            (Self::Number(a), text) if *a == -1.0 => Self::joined("", "-", &text.text()),
            (a, b) => Self::joined(&a.text(), "*", &b.text()),
        }
    }

    /// A term of a sum: a sum needs no parentheses in a sum, but a comparison does.
    fn bare(&self) -> String {
        match self {
            Self::Text(text) if is_sum(text) => text.clone(),
            _ => self.text(),
        }
    }

    /// Two texts with an operator between them; beyond the longest expression it grows no further, and the reader
    /// refuses it.
    fn joined(a: &str, operator: &str, b: &str) -> Self {
        match a.len() + b.len() > 2 * LENGTH {
            true => Self::Text(a.to_owned()),
            false => Self::Text(format!("{a}{operator}{b}")),
        }
    }

    /// The sine and the cosine of an angle.
    pub fn sin_cos(&self) -> [Self; 2] {
        match self {
            Self::Number(angle) => {
                let (sin, cos) = sin_cos(*angle);
                [sin, cos].map(|value| {
                    let whole = value.round();
                    Self::Number(if (value - whole).abs() < ROUNDING { whole } else { value })
                })
            }
            Self::Text(angle) => [Self::Text(format!("sin({angle})")), Self::Text(format!("cos({angle})"))],
        }
    }
}

/// Whether an expression has neither a comparison nor a logical operator in it.
fn is_sum(text: &str) -> bool {
    !text.contains(['<', '>', '=', '!'])
        && !text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|word| word == "and" || word == "or")
}

/// The value of an expression without names; none: it has some, or is wrong.
pub(super) fn constant(text: &str) -> Option<f64> {
    let program = compile(text, Variable::None, &|_| None).ok()?;
    Some(program.value(0.0, |_| f64::NAN)).filter(|value| value.is_finite())
}
