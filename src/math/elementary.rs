//! Elementary functions that give the same bits on every computer.
//!
//! Those of the standard library are the C library's: its versions differ in the last digit, and glibc chooses among
//! several by the processor. These are written in Rust, of operations that are exact or rounded as IEEE 754 says. So
//! are square roots and absolute values, which stay methods.
//!
//! Angles are in rad.

pub use libm::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cbrt, cos, cosh, exp, exp2, hypot, log2, log10, pow, sin, sinh, tan,
    tanh,
};

/// Sine and cosine.
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// `exp(x) − 1`, accurate near 0.
#[inline]
pub fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// Natural logarithm.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// `ln(1 + x)`, accurate near 0.
#[inline]
pub fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}
