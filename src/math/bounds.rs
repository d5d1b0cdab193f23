//! Bounds of a function and its first two derivatives over an interval of its variable: interval arithmetic, carried
//! through every operation as [`Jet`] carries values.
//!
//! The ends of the bounds are rounded as the function itself is: where the function is a chain of monotone operations,
//! they enclose the computed values, not only the exact ones.

use super::jet::Jet;
use super::range::Range;
use crate::math::elementary::{acos, asin, atan, atan2, cosh, exp, ln, log10, pow, sinh, tan, tanh};

/// Bounds of a function over an interval.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// Of `f`.
    pub value: Range,
    /// Of `f'`, where it exists.
    pub first: Range,
    /// Of `f''`, where it exists.
    pub second: Range,
    /// Whether `f` or one of its derivatives may jump in the interval.
    pub switches: bool,
    /// Whether `f` depends on numbers other than its variable.
    pub follows: bool,
}

impl Bounds {
    /// A number that does not change.
    pub fn constant(value: f64) -> Self {
        Self { value: Range::point(value), ..Self::default() }
    }

    /// The variable itself, over an interval.
    pub fn variable(interval: Range) -> Self {
        Self { value: interval, first: Range::point(1.0), ..Self::default() }
    }

    /// A number of which nothing is known, but that it does not change with the variable.
    pub fn unknown() -> Self {
        Self { value: Range::EVERYTHING, follows: true, ..Self::default() }
    }

    /// A smooth function of which nothing is known.
    pub fn unbounded(self) -> Self {
        let Self { switches, follows, .. } = self;
        Self { value: Range::EVERYTHING, first: Range::EVERYTHING, second: Range::EVERYTHING, switches, follows }
    }

    /// Whether it is one number over the whole interval.
    pub fn is_constant(self) -> bool {
        // A corner between two neighboring numbers may have the same value at both.
        self.value.is_point() && !self.switches && !self.follows
    }

    fn is_steady(self) -> bool {
        self.first == Range::default() && self.second == Range::default()
    }

    /// `g(f)` from the bounds of `g`, `g_f` and `g_ff`.
    pub fn chain(self, g: Range, g_f: Range, g_ff: Range) -> Self {
        if self.is_steady() {
            return Self { value: g, ..self };
        }
        let first = g_f * self.first;
        let second = g_f * self.second + g_ff * self.first.power(2);
        Self { value: g, first, second, ..self }
    }

    /// `g(f)` from the bounds of `g` over those of `f`.
    pub fn into_function(self, g: Self) -> Self {
        if g.is_constant() {
            return Self::constant(g.value.low);
        }
        let (switches, follows) = (self.switches || g.switches, self.follows || g.follows);
        Self { switches, follows, ..self.chain(g.value, g.first, g.second) }
    }

    /// A result with the marks of two arguments.
    fn marked(self, a: Self, b: Self) -> Self {
        Self { switches: self.switches || a.switches || b.switches, follows: a.follows || b.follows, ..self }
    }

    /// Either of the two, with a switch in between.
    pub fn either(self, other: Self) -> Self {
        let (value, first) = (self.value.hull(other.value), self.first.hull(other.first));
        Self {
            value,
            first,
            second: self.second.hull(other.second),
            switches: true,
            follows: self.follows || other.follows,
        }
    }

    /// A truth, 1 or 0, of two numbers; none: it is not the same over the whole interval. Two smooth numbers that may
    /// be equal and never cross are taken as unequal.
    fn truth(outcome: Option<bool>, a: Self, b: Self) -> Self {
        match outcome {
            Some(holds) => Self::constant(f64::from(u8::from(holds))),
            // A comparison of other numbers switches at times that nobody knows.
            None if a.follows || b.follows => {
                let value = Range { low: 0.0, high: 1.0 };
                Self { value, switches: a.switches || b.switches, follows: true, ..Self::default() }
            }
            None => Self { value: Range { low: 0.0, high: 1.0 }, switches: true, ..Self::default() },
        }
    }

    /// `a < b`.
    pub fn less(a: Self, b: Self) -> Self {
        let holds = a.value.high < b.value.low;
        let fails = a.value.low >= b.value.high;
        Self::truth((holds || fails).then_some(holds), a, b)
    }

    /// `a <= b`.
    pub fn at_most(a: Self, b: Self) -> Self {
        let holds = a.value.high <= b.value.low;
        let fails = a.value.low > b.value.high;
        Self::truth((holds || fails).then_some(holds), a, b)
    }

    /// `a == b`: instants at which smooth numbers are equal do not count.
    pub fn equal(a: Self, b: Self) -> Self {
        if a.is_constant() && b.is_constant() {
            return Self::truth(Some(a.value == b.value), a, b);
        }
        let apart = a.value.high < b.value.low || a.value.low > b.value.high;
        let passes = !a.switches && !b.switches && !a.follows && !b.follows;
        Self::truth((apart || passes).then_some(false), a, b)
    }

    /// `1 - a` of a truth.
    pub fn complement(self) -> Self {
        let Range { low, high } = self.value;
        Self { value: Range { low: 1.0 - high, high: 1.0 - low }, ..self }
    }

    /// Whether it is not 0; none: it is not the same over the whole interval. Instants at which a smooth number is 0 do
    /// not count.
    fn is_true(self) -> Option<bool> {
        let Range { low, high } = self.value;
        let passes = low < 0.0 && high > 0.0 && !self.switches && !self.follows;
        if low > 0.0 || high < 0.0 || passes { Some(true) } else { (low == 0.0 && high == 0.0).then_some(false) }
    }

    /// 1 if neither of the two is 0.
    pub fn and(a: Self, b: Self) -> Self {
        let outcome = match (a.is_true(), b.is_true()) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        };
        Self::truth(outcome, a, b)
    }

    /// 1 unless both are 0.
    pub fn or(a: Self, b: Self) -> Self {
        let outcome = match (a.is_true(), b.is_true()) {
            (Some(true), _) | (_, Some(true)) => Some(true),
            (Some(false), Some(false)) => Some(false),
            _ => None,
        };
        Self::truth(outcome, a, b)
    }

    /// `a` where `condition` is not 0, else `b`.
    pub fn choice(condition: Self, a: Self, b: Self) -> Self {
        match condition.is_true() {
            Some(true) => a,
            Some(false) => b,
            None => {
                let either = a.either(b);
                let switches = !condition.follows || condition.switches || a.switches || b.switches;
                Self { switches, follows: either.follows || condition.follows, ..either }
            }
        }
    }

    /// The smaller one.
    pub fn min(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        // Two that meet at an end of the interval may have their corner there.
        let is_equal = a == b && self.is_constant() && other.is_constant();
        if a.high < b.low || is_equal {
            self
        } else if b.high < a.low {
            other
        } else {
            let value = Range { low: a.low.min(b.low), high: a.high.min(b.high) };
            Self { value, ..self.crossing(other) }
        }
    }

    /// The larger one.
    pub fn max(self, other: Self) -> Self {
        -(-self).min(-other)
    }

    /// Either of two that may cross.
    fn crossing(self, other: Self) -> Self {
        let either = self.either(other);
        // Numbers that the variable does not change cross at times that nobody knows.
        Self { switches: !either.follows || self.switches || other.switches, ..either }
    }

    /// `|f|`.
    pub fn abs(self) -> Self {
        Self { value: self.value.size(), ..self.max(-self) }
    }

    /// -1, 0 or 1 by the sign.
    pub fn sign(self) -> Self {
        let Range { low, high } = self.value;
        let sign = |x: f64| if x == 0.0 { 0.0 } else { x.signum() };
        self.stepped(Range { low: sign(low), high: sign(high) })
    }

    /// The largest whole number that is not above it.
    pub fn floor(self) -> Self {
        let Range { low, high } = self.value;
        self.stepped(Range { low: low.floor(), high: high.floor() })
    }

    /// The smallest whole number that is not below it.
    pub fn ceil(self) -> Self {
        let Range { low, high } = self.value;
        self.stepped(Range { low: low.ceil(), high: high.ceil() })
    }

    /// A function with steps, whose bounds are `value`.
    fn stepped(self, value: Range) -> Self {
        if value.is_point() && value.low.is_finite() {
            return Self::constant(value.low);
        }
        let Self { switches, follows, .. } = self;
        Self { value, switches: switches || !follows, follows, ..Self::default() }
    }

    /// `f - p floor(f / p)`.
    pub fn modulo(self, p: Self) -> Self {
        let count = (self / p).floor();
        let rest = self - count * p;
        // Between 0 and `p`, wherever it jumps.
        if p.value.low > 0.0 {
            Self { value: rest.value.within(Range { low: 0.0, high: p.value.high }), ..rest }
        } else {
            rest
        }
    }

    /// `3 u² - 2 u³` with `u = (f - from) / (to - from)`, 0 up to `from`, 1 beyond `to`.
    pub fn smoothstep(self, from: Self, to: Self) -> Self {
        if from.value.high >= to.value.low {
            return self.unbounded().marked(from, to);
        }
        let u = (self - from) / (to - from);
        if u.value.high <= 0.0 {
            return Self::constant(0.0);
        }
        if u.value.low >= 1.0 {
            return Self::constant(1.0);
        }
        let at = |u: f64| Jet::variable(u).smoothstep(Jet::constant(0.0), Jet::constant(1.0)).value;
        let inside = u.value.within(Range { low: 0.0, high: 1.0 });
        let slope = |u: f64| 6.0 * u * (1.0 - u);
        let slopes = [slope(inside.low), slope(inside.high)];
        let steepest = if inside.low <= 0.5 && 0.5 <= inside.high { 1.5 } else { slopes[0].max(slopes[1]) };
        let bends = Range { low: 6.0 - 12.0 * inside.high, high: 6.0 - 12.0 * inside.low };
        let value = Range { low: at(inside.low), high: at(inside.high) };
        let bends = if inside == u.value { bends } else { bends.hull(Range::default()) };
        u.chain(value, Range { low: slopes[0].min(slopes[1]), high: steepest }, bends)
    }

    /// `f^p`.
    pub fn power(self, p: Self) -> Self {
        if p.value.is_point() && !p.follows {
            let n = p.value.low;
            let term = |factor: f64, exponent: f64| {
                if factor == 0.0 { Range::default() } else { Range::point(factor) * self.value.to_power(exponent) }
            };
            let (value, slope) = (self.value.to_power(n), term(n, n - 1.0));
            return self.chain(value, slope, term(n * (n - 1.0), n - 2.0));
        }
        if self.value.low <= 0.0 {
            return self.unbounded().marked(p, p);
        }
        let found = (p * self.ln()).exp();
        let ends = [self.value.low, self.value.high].map(|base| [pow(base, p.value.low), pow(base, p.value.high)]);
        Self { value: Range::of(ends.as_flattened()), ..found }
    }

    /// The angle of the point `(x, self)`.
    pub fn atan2(self, x: Self) -> Self {
        let y = self;
        let is_behind = y.is_constant() && x.value.high < 0.0;
        if x.value.low <= 0.0 && y.value.low <= 0.0 && y.value.high >= 0.0 && !is_behind {
            // It may jump by a turn, behind the origin.
            let found = y.unbounded().marked(x, x);
            let value = Range { low: -std::f64::consts::PI, high: std::f64::consts::PI };
            return Self { value, switches: found.switches || !found.follows, ..found };
        }
        let corners = [x.value.low, x.value.high].map(|x| [atan2(y.value.low, x), atan2(y.value.high, x)]);
        let square = x.value.power(2) + y.value.power(2);
        let first = (x.value * y.first - y.value * x.first) / square;
        let turn = x.value * y.second - y.value * x.second;
        let stretch = x.value * x.first + y.value * y.first;
        let second = (turn - Range::point(2.0) * stretch * first) / square;
        Self { value: Range::of(corners.as_flattened()), first, second, ..Self::default() }.marked(x, y)
    }

    /// `sin f`.
    pub fn sin(self) -> Self {
        let (sin, cos) = (self.value.sin(), self.value.cos());
        self.chain(sin, cos, -sin)
    }

    /// `cos f`.
    pub fn cos(self) -> Self {
        let (sin, cos) = (self.value.sin(), self.value.cos());
        self.chain(cos, -sin, -cos)
    }

    /// `tan f`.
    pub fn tan(self) -> Self {
        let cos = self.value.cos();
        if cos.low <= 0.0 && cos.high >= 0.0 {
            return self.unbounded();
        }
        let tan = self.value.rising(tan);
        let slope = Range::point(1.0) + tan.power(2);
        self.chain(tan, slope, Range::point(2.0) * tan * slope)
    }

    /// `asin f`.
    pub fn asin(self) -> Self {
        let square = Range::point(1.0) - self.value.power(2);
        let slope = Range::point(1.0) / square.root();
        self.chain(self.value.rising(asin), slope, self.value * slope / square)
    }

    /// `acos f`.
    pub fn acos(self) -> Self {
        let square = Range::point(1.0) - self.value.power(2);
        let slope = -(Range::point(1.0) / square.root());
        self.chain(-self.value.rising(|x| -acos(x)), slope, self.value * slope / square)
    }

    /// `atan f`.
    pub fn atan(self) -> Self {
        let slope = Range::point(1.0) / (Range::point(1.0) + self.value.power(2));
        self.chain(self.value.rising(atan), slope, Range::point(-2.0) * self.value * slope.power(2))
    }

    /// `sinh f`.
    pub fn sinh(self) -> Self {
        let (sinh, cosh) = (self.value.rising(sinh), self.value.size().rising(cosh));
        self.chain(sinh, cosh, sinh)
    }

    /// `cosh f`.
    pub fn cosh(self) -> Self {
        let (sinh, cosh) = (self.value.rising(sinh), self.value.size().rising(cosh));
        self.chain(cosh, sinh, cosh)
    }

    /// `tanh f`.
    pub fn tanh(self) -> Self {
        let tanh = self.value.rising(tanh);
        let slope = Range::point(1.0) / self.value.size().rising(cosh).power(2);
        self.chain(tanh, slope, Range::point(-2.0) * tanh * slope)
    }

    /// `exp f`.
    pub fn exp(self) -> Self {
        let exp = self.value.rising(exp);
        self.chain(exp, exp, exp)
    }

    /// `ln f`.
    pub fn ln(self) -> Self {
        let slope = Range::point(1.0) / self.value;
        self.chain(self.value.rising(ln), slope, -slope.power(2))
    }

    /// `log10 f`.
    pub fn log10(self) -> Self {
        let slope = Range::point(std::f64::consts::LOG10_E) / self.value;
        self.chain(self.value.rising(log10), slope, -(slope / self.value))
    }

    /// `sqrt f`.
    pub fn sqrt(self) -> Self {
        let root = self.value.root();
        let slope = Range::point(0.5) / root;
        self.chain(root, slope, Range::point(-0.5) * slope / self.value)
    }
}

impl std::ops::Neg for Bounds {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, first: -self.first, second: -self.second, ..self }
    }
}

impl std::ops::Add for Bounds {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        let (value, first) = (self.value + b.value, self.first + b.first);
        Self { value, first, second: self.second + b.second, ..Self::default() }.marked(self, b)
    }
}

impl std::ops::Sub for Bounds {
    type Output = Self;

    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl std::ops::Mul for Bounds {
    type Output = Self;

    fn mul(self, b: Self) -> Self {
        let is_zero = |factor: Self| factor.value == Range::default() && factor.is_constant();
        // Switches of the other factor do nothing.
        if is_zero(self) && b.value.is_finite() || is_zero(b) && self.value.is_finite() {
            return Self::constant(0.0);
        }
        let first = self.first * b.value + self.value * b.first;
        let cross = Range::point(2.0) * self.first * b.first;
        let second = self.second * b.value + cross + self.value * b.second;
        Self { value: self.value * b.value, first, second, ..Self::default() }.marked(self, b)
    }
}

impl std::ops::Div for Bounds {
    type Output = Self;

    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        if self.is_steady() && b.is_steady() {
            return Self { value, ..Self::default() }.marked(self, b);
        }
        let first = (self.first - value * b.first) / b.value;
        let second = (self.second - Range::point(2.0) * first * b.first - value * b.second) / b.value;
        Self { value, first, second, ..Self::default() }.marked(self, b)
    }
}
