//! Runge and Kutta's rule of order 4.

use std::ops::{Add, Mul};

/// The state a step of length `step` further on, of what changes by `slope`.
pub fn runge_kutta<T, const N: usize>(state: &[T; N], step: f64, slope: impl Fn(&[T; N]) -> [T; N]) -> [T; N]
where
    T: Copy + Add<Output = T> + Mul<f64, Output = T>,
{
    let moved = |slope: &[T; N], by: f64| -> [T; N] { std::array::from_fn(|k| state[k] + slope[k] * by) };
    let first = slope(state);
    let second = slope(&moved(&first, 0.5 * step));
    let third = slope(&moved(&second, 0.5 * step));
    let fourth = slope(&moved(&third, step));
    std::array::from_fn(|k| state[k] + (first[k] + second[k] * 2.0 + third[k] * 2.0 + fourth[k]) * (step / 6.0))
}
