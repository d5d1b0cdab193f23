//! Numbers as formulas: `0.5*pi*(1 - cos(pi*t/T))`, compiled once, evaluated with exact first and second derivatives.
//!
//! Known are `+ - * / ^`, comparisons (1 where they hold, else 0), `and`, `or`, parentheses, the functions of
//! [`program::FUNCTIONS`] and
//! [`program::MORE_FUNCTIONS`], `pi`, `e`, the parameters and functions of the file, and `t` or
//! `s` where the place allows it. `^` binds tightest and from the right, above the unary minus, as in mathematics:
//! `-2^2 = -4`, `2^3^2 = 512`.

mod breaks;
pub mod function;
mod over;
mod parser;
pub mod program;
pub mod table;
#[cfg(test)]
mod tests;

pub use crate::math::jet::Jet;
pub use parser::{Callee, ExpressionError, LENGTH, ReadingLookup, Scope, compile, compile_in};
pub use program::Program;

/// What a name in an expression may stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// No variable: the number does not change.
    None,
    /// `t`, time.
    Time,
    /// `s`, the curve parameter.
    Curve,
    /// `t`, time, with the arc length `s` of a beam as a second variable.
    AlongInTime,
    /// `t`, time, and coordinates of joints with their rates.
    Control,
    /// `x`, the elongation of a spring, with its rate `v` as a second variable.
    Elongation,
    /// `x`, the coordinate that a gear with a law follows.
    Followed,
    /// `z`, a height, with time `t` as a second variable.
    Height,
}

impl Variable {
    /// How it is written.
    pub fn word(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Time | Self::Control | Self::AlongInTime => "t",
            Self::Curve => "s",
            Self::Elongation | Self::Followed => "x",
            Self::Height => "z",
        }
    }

    /// How its rate, or the second variable in the place of a rate, is written, where an expression may use it.
    pub fn rate(self) -> &'static str {
        match self {
            Self::Elongation => "v",
            Self::AlongInTime => "s",
            Self::Height => "t",
            Self::None | Self::Time | Self::Curve | Self::Control | Self::Followed => "",
        }
    }
}
