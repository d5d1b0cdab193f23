//! The response of a linear system by the frequency of its inputs: `C (iω − A)⁻¹ B + D`.
//!
//! The poles at 0 are split off, as in a reduction; the rest is a sum over modes, so that stiff modes leave no
//! round-off in the response of soft ones.

use super::modal::{Modes, pairs};
use super::split::{Refusal, Whole, split};
use crate::math::elementary::{exp, ln};
use crate::solve::linear::dense::{Complex, Dense};
use crate::solve::linear::eigen::Eigen;
use nalgebra::DMatrix;

/// Frequencies between both ends, equally spaced in their logarithms.
const GRID: usize = 300;
/// Frequencies about each pole, in units of its damping: a peak has its height and its width.
const ABOUT: [f64; 9] = [-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0];
/// Where no range is asked for: this factor below the softest vibration and above the last one.
const BEYOND: f64 = 10.0;
/// The last vibration is the one of this number.
const LAST: usize = 8;

/// Responses at frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct Responses {
    /// The frequencies, rad/s, ascending.
    pub frequencies: Vec<f64>,
    /// At each, the responses of all outputs to the first input, then to the next one: real and imaginary part.
    pub values: Vec<Vec<[f64; 2]>>,
}

/// The responses of `system` between two frequencies, rad/s; none: about its softest vibrations.
///
/// # Errors
/// Eigenvalues do not converge.
pub fn responses(system: &Whole, range: Option<[f64; 2]>) -> Result<Responses, Refusal> {
    let d = &system.matrices.d;
    let (fixed, _, rest) = split(system)?;
    let found = rest.a.eigensystem()?;
    let (lasting, fading) = pairs(&found);
    let all: Vec<&Eigen> = lasting.into_iter().chain(fading).collect();
    let modes = Modes::new(&all, &rest.b, &rest.c);
    let frequencies = frequencies(&modes.poles, range);
    let values = frequencies.iter().map(|omega| {
        let mut sum = modes.response(*omega, d.values.len());
        add_fixed([&fixed.a, &fixed.b, &fixed.c], *omega, &mut sum);
        sum.iter().zip(&d.values).map(|(own, direct)| [own.re + direct, own.im]).collect()
    });
    Ok(Responses { values: values.collect(), frequencies })
}

/// Adds the response of the poles at 0, which have no modes.
fn add_fixed([a, b, c]: [&Dense; 3], omega: f64, sum: &mut [Complex]) {
    if a.rows == 0 {
        return;
    }
    let complex = |matrix: &Dense| {
        DMatrix::from_iterator(matrix.rows, matrix.columns, matrix.values.iter().map(|own| Complex::from(*own)))
    };
    let shifted = DMatrix::from_diagonal_element(a.rows, a.rows, Complex::new(0.0, omega)) - complex(a);
    // A pole at 0 responds to no frequency above 0 without end.
    if let Some(states) = shifted.lu().solve(&complex(b)) {
        sum.iter_mut().zip((complex(c) * states).iter()).for_each(|(sum, own)| *sum += own);
    }
}

/// The frequencies that are looked at, rad/s.
fn frequencies(poles: &[Complex], range: Option<[f64; 2]>) -> Vec<f64> {
    let mut sizes: Vec<f64> = poles.iter().filter(|pole| pole.im > 0.0).map(|pole| pole.norm()).collect();
    sizes.sort_by(f64::total_cmp);
    let ends = match sizes[..] {
        [] => [1.0 / BEYOND, BEYOND],
        [softest, ..] => [softest / BEYOND, sizes[sizes.len().min(LAST) - 1] * BEYOND.sqrt()],
    };
    let [from, to] = range.unwrap_or(ends);
    let at = |number: usize| match number {
        0 => from,
        _ if number == GRID - 1 => to,
        _ => exp(ln(from) + (ln(to) - ln(from)) * (number as f64 / (GRID - 1) as f64)),
    };
    let mut all: Vec<f64> = (0..GRID).map(at).collect();
    let vibrations = poles.iter().filter(|pole| pole.im > 0.0 && pole.re != 0.0);
    all.extend(vibrations.flat_map(|pole| ABOUT.map(|times| pole.im + times * pole.re.abs())));
    all.retain(|omega| *omega >= from && *omega <= to);
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}
