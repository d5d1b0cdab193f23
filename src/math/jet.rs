//! A number with its first two derivatives by one variable, `(f, f', f'')`: the chain rule, carried through every
//! operation.
//!
//! Chain rule: `g(f)' = g_f f'`, `g(f)'' = g_f f'' + g_ff f'²`. Where `f` does not change (`f' = f'' = 0`) the result
//! does not either, also where `g_f` is infinite: `sqrt(0)` is a constant.

use crate::math::elementary::{acos, asin, atan, atan2, cosh, exp, ln, log10, pow, sin_cos, sinh, tan, tanh};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Value, first and second derivative by the variable of an expression.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Jet {
    /// `f`.
    pub value: f64,
    /// `f'`.
    pub first: f64,
    /// `f''`.
    pub second: f64,
}

impl Jet {
    /// A number that does not change.
    pub fn constant(value: f64) -> Self {
        Self { value, first: 0.0, second: 0.0 }
    }

    /// The variable itself.
    pub fn variable(value: f64) -> Self {
        Self { value, first: 1.0, second: 0.0 }
    }

    /// Whether value and first derivative are finite: a kink of the second one does no harm.
    pub fn is_finite(self) -> bool {
        self.value.is_finite() && self.first.is_finite()
    }

    fn is_constant(self) -> bool {
        self.first == 0.0 && self.second == 0.0
    }

    /// `g(f)` from `g`, `g_f` and `g_ff` at `f`.
    pub fn chain(self, g: f64, g_f: f64, g_ff: f64) -> Self {
        if self.is_constant() {
            return Self::constant(g);
        }
        Self { value: g, first: g_f * self.first, second: g_f * self.second + g_ff * self.first * self.first }
    }

    /// `f^p`. A constant exponent keeps negative bases with integer exponents; a varying one needs a positive base.
    pub fn power(self, p: Self) -> Self {
        let value = pow(self.value, p.value);
        if p.is_constant() {
            let n = p.value;
            // A vanishing coefficient wins over an infinite power: the second derivative of x^1 at 0 is 0.
            let term = |coefficient: f64, exponent: f64| {
                if coefficient == 0.0 { 0.0 } else { coefficient * pow(self.value, exponent) }
            };
            return self.chain(value, term(n, n - 1.0), term(n * (n - 1.0), n - 2.0));
        }
        if self.is_constant() {
            // 0^t is 0 for every positive t, and so are its derivatives.
            let log = if value == 0.0 { 0.0 } else { ln(self.value) };
            return p.chain(value, value * log, value * log * log);
        }
        (p * self.ln()).exp().with_value(value)
    }

    /// The angle of the point `(x, self)`, in (-π, π].
    pub fn atan2(self, x: Self) -> Self {
        let y = self;
        let square = x.value * x.value + y.value * y.value;
        let value = atan2(y.value, x.value);
        if x.is_constant() && y.is_constant() {
            return Self::constant(value);
        }
        let first = (x.value * y.first - y.value * x.first) / square;
        let turn = x.value * y.second - y.value * x.second;
        let stretch = x.value * x.first + y.value * y.first;
        Self { value, first, second: (turn - 2.0 * stretch * first) / square }
    }

    /// The smaller of two, with its derivatives; of equals the first; NaN if one is NaN.
    pub fn min(self, other: Self) -> Self {
        if other.value < self.value || other.value.is_nan() { other } else { self }
    }

    /// The larger of two, with its derivatives; of equals the first; NaN if one is NaN.
    pub fn max(self, other: Self) -> Self {
        if other.value > self.value || other.value.is_nan() { other } else { self }
    }

    /// `f - p floor(f / p)`: the remainder with the sign of `p`.
    pub fn modulo(self, p: Self) -> Self {
        let count = (self.value / p.value).floor();
        self - Self::constant(count) * p
    }

    /// The largest whole number that is not above `f`.
    pub fn floor(self) -> Self {
        Self::constant(self.value.floor())
    }

    /// The smallest whole number that is not below `f`.
    pub fn ceil(self) -> Self {
        Self::constant(self.value.ceil())
    }

    /// `3 u² - 2 u³` with `u = (f - from) / (to - from)`, 0 up to `from`, 1 beyond `to`; NaN unless `from < to`.
    pub fn smoothstep(self, from: Self, to: Self) -> Self {
        if from.value.partial_cmp(&to.value) != Some(Ordering::Less) {
            return Self::constant(f64::NAN);
        }
        let u = (self - from) / (to - from);
        if u.value <= 0.0 {
            Self::constant(0.0)
        } else if u.value >= 1.0 {
            Self::constant(1.0)
        } else {
            u * u * (Self::constant(3.0) - u - u)
        }
    }

    fn with_value(self, value: f64) -> Self {
        Self { value, ..self }
    }

    /// `sin f`.
    pub fn sin(self) -> Self {
        let (sin, cos) = sin_cos(self.value);
        self.chain(sin, cos, -sin)
    }

    /// `cos f`.
    pub fn cos(self) -> Self {
        let (sin, cos) = sin_cos(self.value);
        self.chain(cos, -sin, -cos)
    }

    /// `tan f`.
    pub fn tan(self) -> Self {
        let tan = tan(self.value);
        let slope = 1.0 + tan * tan;
        self.chain(tan, slope, 2.0 * tan * slope)
    }

    /// `asin f`, NaN outside [-1, 1].
    pub fn asin(self) -> Self {
        let square = (1.0 - self.value) * (1.0 + self.value);
        let slope = 1.0 / square.sqrt();
        self.chain(asin(self.value), slope, self.value * slope / square)
    }

    /// `acos f`, NaN outside [-1, 1].
    pub fn acos(self) -> Self {
        let square = (1.0 - self.value) * (1.0 + self.value);
        let slope = -1.0 / square.sqrt();
        self.chain(acos(self.value), slope, self.value * slope / square)
    }

    /// `atan f`.
    pub fn atan(self) -> Self {
        let slope = 1.0 / (1.0 + self.value * self.value);
        self.chain(atan(self.value), slope, -2.0 * self.value * slope * slope)
    }

    /// `sinh f`.
    pub fn sinh(self) -> Self {
        let (sinh, cosh) = (sinh(self.value), cosh(self.value));
        self.chain(sinh, cosh, sinh)
    }

    /// `cosh f`.
    pub fn cosh(self) -> Self {
        let (sinh, cosh) = (sinh(self.value), cosh(self.value));
        self.chain(cosh, sinh, cosh)
    }

    /// `tanh f`.
    pub fn tanh(self) -> Self {
        let tanh = tanh(self.value);
        let cosh = cosh(self.value);
        let slope = 1.0 / (cosh * cosh);
        self.chain(tanh, slope, -2.0 * tanh * slope)
    }

    /// `exp f`.
    pub fn exp(self) -> Self {
        let exp = exp(self.value);
        self.chain(exp, exp, exp)
    }

    /// `ln f`, NaN below 0.
    pub fn ln(self) -> Self {
        let slope = 1.0 / self.value;
        self.chain(ln(self.value), slope, -slope * slope)
    }

    /// `log10 f`, NaN below 0.
    pub fn log10(self) -> Self {
        let slope = std::f64::consts::LOG10_E / self.value;
        self.chain(log10(self.value), slope, -slope / self.value)
    }

    /// `sqrt f`, NaN below 0.
    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        let slope = 0.5 / root;
        self.chain(root, slope, -0.5 * slope / self.value)
    }

    /// `|f|`; at the kink the derivative is 0.
    pub fn abs(self) -> Self {
        self.chain(self.value.abs(), sign(self.value), 0.0)
    }

    /// -1, 0 or 1 by the sign of `f`.
    pub fn sign(self) -> Self {
        Self::constant(sign(self.value))
    }
}

/// -1, 0, 1 or NaN; unlike `f64::signum` it is 0 at 0.
fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        Self { value: self.value + b.value, first: self.first + b.first, second: self.second + b.second }
    }
}

impl Sub for Jet {
    type Output = Self;

    fn sub(self, b: Self) -> Self {
        Self { value: self.value - b.value, first: self.first - b.first, second: self.second - b.second }
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, b: Self) -> Self {
        Self {
            value: self.value * b.value,
            first: self.first * b.value + self.value * b.first,
            second: self.second * b.value + 2.0 * self.first * b.first + self.value * b.second,
        }
    }
}

impl Div for Jet {
    type Output = Self;

    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        if self.is_constant() && b.is_constant() {
            return Self::constant(value);
        }
        let first = (self.first - value * b.first) / b.value;
        Self { value, first, second: (self.second - 2.0 * first * b.first - value * b.second) / b.value }
    }
}

impl Neg for Jet {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, first: -self.first, second: -self.second }
    }
}
