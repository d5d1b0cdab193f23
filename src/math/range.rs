//! Intervals of real numbers, with the operations that bounds of functions need: `[a, b] + [c, d] = [a + c, b + d]`,
//! and so on. An operation that has no value for some of the numbers gives all numbers.

use crate::math::elementary::{cos, pow, sin};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Range {
    /// The smallest one.
    pub low: f64,
    /// The largest one.
    pub high: f64,
}

impl Range {
    /// All numbers.
    pub const EVERYTHING: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// One number.
    pub fn point(value: f64) -> Self {
        Self { low: value, high: value }.or_everything()
    }

    /// From the smallest to the largest of some numbers; not-a-number gives everything.
    pub fn of(values: &[f64]) -> Self {
        if values.iter().any(|value| value.is_nan()) {
            return Self::EVERYTHING;
        }
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        Self { low, high: values.iter().copied().fold(f64::NEG_INFINITY, f64::max) }
    }

    fn or_everything(self) -> Self {
        if self.low.is_nan() || self.high.is_nan() { Self::EVERYTHING } else { self }
    }

    /// Whether it is one number.
    pub fn is_point(self) -> bool {
        self.low == self.high
    }

    /// Whether both ends are finite.
    pub fn is_finite(self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// `high - low`.
    pub fn width(self) -> f64 {
        if self.is_point() { 0.0 } else { self.high - self.low }
    }

    /// The largest absolute value.
    pub fn largest(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// The absolute values.
    pub fn size(self) -> Self {
        let (a, b) = (self.low.abs(), self.high.abs());
        let low = if self.low <= 0.0 && self.high >= 0.0 { 0.0 } else { a.min(b) };
        Self { low, high: a.max(b) }
    }

    /// The smallest interval with both.
    pub fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The part of it that is in `limits`, which it overlaps.
    pub fn within(self, limits: Self) -> Self {
        Self { low: self.low.clamp(limits.low, limits.high), high: self.high.clamp(limits.low, limits.high) }
    }

    /// The values of a function that rises.
    pub fn rising(self, function: impl Fn(f64) -> f64) -> Self {
        Self { low: function(self.low), high: function(self.high) }.or_everything()
    }

    /// Square roots.
    pub fn root(self) -> Self {
        self.rising(f64::sqrt)
    }

    /// The power with a whole exponent that is not negative.
    pub fn power(self, exponent: i32) -> Self {
        let base = if exponent % 2 == 0 { self.size() } else { self };
        base.rising(|x| x.powi(exponent))
    }

    /// The power with any exponent, as [`pow`] has it.
    pub fn to_power(self, exponent: f64) -> Self {
        let is_whole = exponent.fract() == 0.0;
        let is_even = is_whole && exponent % 2.0 == 0.0;
        if exponent == 0.0 {
            return Self::point(1.0);
        }
        if self.low < 0.0 && !is_whole || exponent < 0.0 && self.low <= 0.0 && self.high >= 0.0 {
            return Self::EVERYTHING;
        }
        let base = if is_even { self.size() } else { self };
        Self::of(&[pow(base.low, exponent), pow(base.high, exponent)])
    }

    /// Sines.
    pub fn sin(self) -> Self {
        self.wave(sin, std::f64::consts::FRAC_PI_2)
    }

    /// Cosines.
    pub fn cos(self) -> Self {
        self.wave(cos, 0.0)
    }

    /// The values of a function of period 2 pi that is largest, 1, at `crest`, and smallest, -1, half a period later.
    fn wave(self, function: fn(f64) -> f64, crest: f64) -> Self {
        use std::f64::consts::{PI, TAU};
        if !self.is_finite() || self.width() >= TAU {
            return Self { low: -1.0, high: 1.0 };
        }
        let passes = |at: f64| ((self.high - at) / TAU).floor() > ((self.low - at) / TAU).floor();
        let mut found = Self::of(&[function(self.low), function(self.high)]);
        if passes(crest) {
            found.high = 1.0;
        }
        if passes(crest + PI) {
            found.low = -1.0;
        }
        found
    }
}

impl Neg for Range {
    type Output = Self;

    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Add for Range {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        Self { low: self.low + b.low, high: self.high + b.high }.or_everything()
    }
}

impl Sub for Range {
    type Output = Self;

    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Range {
    type Output = Self;

    fn mul(self, b: Self) -> Self {
        // 0 times an end that is not finite is 0: the end is not reached.
        let times = |x: f64, y: f64| if x == 0.0 || y == 0.0 { 0.0 } else { x * y };
        let all = [times(self.low, b.low), times(self.low, b.high), times(self.high, b.low), times(self.high, b.high)];
        Self::of(&all)
    }
}

impl Div for Range {
    type Output = Self;

    fn div(self, b: Self) -> Self {
        if b.low <= 0.0 && b.high >= 0.0 {
            return Self::EVERYTHING;
        }
        let all = [self.low / b.low, self.low / b.high, self.high / b.low, self.high / b.high];
        Self::of(&all)
    }
}
