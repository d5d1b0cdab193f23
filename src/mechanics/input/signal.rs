//! Numbers that may depend on time.

use crate::math::integral::integral;
use crate::math::jet::Jet;
use std::fmt;
use std::sync::Arc;

/// A number that may depend on time.
#[derive(Clone)]
pub enum Signal {
    /// Always the same.
    Constant(f64),
    /// A function of time, s, with its first two derivatives.
    Function(Arc<dyn Fn(f64) -> Jet + Send + Sync>),
    /// A function of time, s, in pieces.
    Pieces(Arc<Pieces>),
}

/// A function of time in pieces.
pub struct Pieces {
    /// The function with its first two derivatives; where two pieces meet, that of the piece that begins there.
    pub jet: Box<dyn Fn(f64) -> Jet + Send + Sync>,
    /// The times at which pieces meet, ascending, s.
    pub breaks: Vec<f64>,
}

impl Signal {
    /// Its value at `time`, s.
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Function(function) => function(time).value,
            Self::Pieces(pieces) => (pieces.jet)(time).value,
        }
    }

    /// Its value and first two derivatives at `time`, s.
    pub fn jet(&self, time: f64) -> Jet {
        match self {
            Self::Constant(value) => Jet::constant(*value),
            Self::Function(function) => function(time),
            Self::Pieces(pieces) => (pieces.jet)(time),
        }
    }

    /// The times at which its pieces meet, ascending, s.
    pub fn breaks(&self) -> &[f64] {
        match self {
            Self::Constant(_) | Self::Function(_) => &[],
            Self::Pieces(pieces) => &pieces.breaks,
        }
    }

    /// Its integral from `from` to `to`, s: piece by piece, because a quadrature rule may step over a short piece.
    pub fn integral(&self, from: f64, to: f64) -> f64 {
        let value = |time: f64| self.at(time);
        let inner = self.breaks().iter().copied().filter(|time| from < *time && *time < to);
        let (sum, last) = inner.fold((0.0, from), |(sum, last), time| (sum + integral(&value, last, time), time));
        sum + integral(&value, last, to)
    }

    /// By how much its value jumps at `time`, s, one of its breaks.
    pub fn jump(&self, time: f64) -> f64 {
        self.at(time) - self.at(time.next_down())
    }
}

impl fmt::Debug for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "{value}"),
            Self::Function(_) | Self::Pieces(..) => write!(f, "f(t)"),
        }
    }
}
