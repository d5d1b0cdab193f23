//! Numbers that may depend on time.

use crate::math::bounds::Bounds;
use crate::math::integral::integral;
use crate::math::jet::Jet;
use crate::math::range::Range;
use crate::math::resolution::Sight;
use crate::math::switches::Bounded;
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
    /// Why it has no value at a time, s, in words; none: no reason is known.
    pub undefined: Box<dyn Fn(f64) -> Option<String> + Send + Sync>,
    /// What is known of it between two times; none: nothing is.
    pub bounds: Option<TimeBounds>,
}

/// What is known of a function between two times.
pub struct TimeBounds {
    /// Bounds over an interval of time, s.
    pub bounds: Box<dyn Fn(Range) -> Bounds + Send + Sync>,
    /// A large absolute value of the function: values far below it are no pulses.
    pub peak: f64,
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

    /// Whether `time`, s, is one of its breaks.
    pub fn breaks_at(&self, time: f64) -> bool {
        let breaks = self.breaks();
        breaks.get(breaks.partition_point(|own| *own < time)) == Some(&time)
    }

    /// The function with its bounds, and its largest value; none: no bounds are known.
    fn bounded(&self) -> Option<(Bounded<'_>, f64)> {
        let Self::Pieces(pieces) = self else { return None };
        let TimeBounds { bounds, peak } = pieces.bounds.as_ref()?;
        Some((Bounded { jet: &pieces.jet, bounds }, *peak))
    }

    /// The first time after `from` up to `to`, s, at which it switches; pieces that meet at its breaks count too.
    pub fn first_switch(&self, range: [f64; 2]) -> Option<f64> {
        self.bounded()?.0.first_switch(range)
    }

    /// The end of a step from `from` on the way to `to`, s, that sees as much as `sight` of the function: of a load.
    pub fn seen_until(&self, range: [f64; 2], sight: Sight) -> f64 {
        self.bounded().map_or(range[1], |(bounded, peak)| bounded.seen_until(range, peak, sight))
    }

    /// The same of a position, of which only changes count.
    pub fn motion_seen_until(&self, range: [f64; 2], sight: Sight) -> f64 {
        let Some((Bounded { jet, bounds }, peak)) = self.bounded() else { return range[1] };
        let start = jet(range[0]).value;
        let change = |time: f64| {
            let jet = jet(time);
            Jet { value: jet.value - start, ..jet }
        };
        let bounds = |interval: Range| bounds(interval) - Bounds::constant(start);
        Bounded { jet: &change, bounds: &bounds }.seen_until(range, peak, sight)
    }

    /// Why it has no finite value at `time`, s, in words; none: it has one, or no reason is known.
    pub fn undefined(&self, time: f64) -> Option<String> {
        match self {
            Self::Pieces(pieces) if !self.jet(time).is_finite() => (pieces.undefined)(time),
            Self::Constant(_) | Self::Function(_) | Self::Pieces(_) => None,
        }
    }

    /// Its integral from `from` to `to`, s: piece by piece, because a quadrature rule may step over a short piece.
    pub fn integral(&self, from: f64, to: f64) -> f64 {
        let value = |time: f64| self.at(time);
        let breaks = self.breaks();
        let first = breaks.partition_point(|time| *time <= from);
        let inner = breaks[first..].iter().copied().take_while(|time| *time < to);
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
