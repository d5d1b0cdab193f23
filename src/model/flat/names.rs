//! The names in an expression, and what stands for them in the flat model.

use super::scalar::constant;
use crate::model::expression::LENGTH;

/// A name in an expression.
#[derive(Clone, Copy, Debug)]
pub(super) enum Name<'t> {
    /// That of a number.
    Number(&'t str),
    /// That of a function: a parenthesis follows.
    Called(&'t str),
    /// That of a part, of which a coordinate follows: `hinge.angle`.
    Part(&'t str),
}

impl<'t> Name<'t> {
    /// The name of a number; none: that of a function.
    pub fn number(self) -> Option<&'t str> {
        match self {
            Self::Number(name) => Some(name),
            Self::Called(_) | Self::Part(_) => None,
        }
    }
}

/// A text in the place of a name of an expression.
pub(super) fn operand(text: &str) -> String {
    let is_plain = text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '.');
    match constant(text) {
        // A count prints as one.
        Some(value) if is_plain && value.fract() == 0.0 && value.abs() < 1e15 => format!("{value}"),
        _ if is_plain => text.to_owned(),
        _ => format!("({text})"),
    }
}

/// An expression with some of its names replaced; it grows no longer than the reader takes.
pub(super) fn replaced(
    text: &str,
    stand_in: &mut dyn FnMut(Name<'_>) -> Result<Option<String>, ()>,
) -> Result<String, ()> {
    let mut result = String::with_capacity(text.len());
    let mut rest = text;
    let is_inside = |c: char| c.is_ascii_alphanumeric() || c == '_';
    while let Some(c) = rest.chars().next() {
        if result.len() > LENGTH {
            result.push_str(rest);
            return Ok(result);
        }
        let length = if c.is_ascii_digit() || c == '.' {
            number_length(rest)
        } else if c.is_ascii_alphabetic() || c == '_' {
            rest.find(|c| !is_inside(c)).unwrap_or(rest.len())
        } else {
            c.len_utf8()
        };
        let (token, behind) = rest.split_at(length);
        let is_called = behind.trim_start().starts_with('(');
        let key = behind.strip_prefix('.').filter(|key| key.starts_with(|c: char| c.is_ascii_alphabetic()));
        let name = c.is_ascii_alphabetic().then_some(match (is_called, key) {
            (true, _) => Name::Called(token),
            (false, Some(_)) => Name::Part(token),
            (false, None) => Name::Number(token),
        });
        match name.map_or(Ok(None), &mut *stand_in)? {
            Some(text) => result.push_str(&text),
            None => result.push_str(token),
        }
        rest = behind;
        if let (Some(Name::Part(_)), Some(key)) = (name, key) {
            // Not a number without digits, and what is behind it.
            let length = 1 + key.find(|c| !is_inside(c)).unwrap_or(key.len());
            result.push_str(&rest[..length]);
            rest = &rest[length..];
        }
    }
    Ok(result)
}

/// The length of the number that a text begins with: the e of `1e3` is not a name.
fn number_length(text: &str) -> usize {
    let mantissa = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let Some(exponent) = text[mantissa..].strip_prefix(['e', 'E']) else { return mantissa };
    let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let count = digits.len() - digits.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    if count == 0 { mantissa } else { mantissa + 1 + (exponent.len() - digits.len()) + count }
}
