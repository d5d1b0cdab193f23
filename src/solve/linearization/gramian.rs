//! Gramians of a stable system in its own modes, as factors `W = L Lᵀ`.
//!
//! Coordinates of the modes have `Λ W + W Λ* = −G G*`, so that every entry of `W` is known:
//! `Wᵢⱼ = −gᵢ·gⱼ*/(λᵢ + λⱼ*)`. What is left of such a matrix after a step of Cholesky's factorization is another one,
//! with the rows `gᵢ − lᵢ gₖ/lₖ` (Gohberg, Kailath, Olshevsky 1995). The factorization with pivots, stopped at
//! round-off, takes few steps, forms no `W`, and keeps the small singular values that a factor of a computed `W`
//! would lose.

use crate::solve::linear::dense::{Complex, Dense};
use std::f64::consts::FRAC_1_SQRT_2;

/// A pivot below this share of the first one is round-off: the root of it belongs to a Hankel singular value.
const LEAST: f64 = 1e-32;

/// `Σ aₖ bₖ*`.
fn product(a: &[Complex], b: &[Complex]) -> Complex {
    a.iter().zip(b).map(|(a, b)| a * b.conj()).sum()
}

/// The columns of `L` with `Λ L L* + L L* Λ* = −G G*`, for the poles `poles` with negative real parts and the rows
/// `gains` of `G`.
pub fn factor(poles: &[Complex], gains: &[Vec<Complex>]) -> Vec<Vec<Complex>> {
    let mut gains = gains.to_vec();
    let mut is_open = vec![true; poles.len()];
    let mut columns: Vec<Vec<Complex>> = Vec::new();
    let mut first = 0.0;
    while columns.len() < poles.len() {
        let square = |own: usize| -product(&gains[own], &gains[own]).re / (2.0 * poles[own].re);
        let open = (0..poles.len()).filter(|own| is_open[*own]).map(|own| (square(own), own));
        let Some((pivot, chosen)) = open.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        first = f64::max(first, pivot);
        if pivot.is_nan() || pivot <= LEAST * first {
            break;
        }
        let root = pivot.sqrt();
        let (own, pole) = (gains[chosen].clone(), poles[chosen]);
        let mut column = vec![Complex::from(0.0); poles.len()];
        for (number, gain) in gains.iter_mut().enumerate().filter(|(number, _)| is_open[*number]) {
            let entry = -product(gain, &own) / (poles[number] + pole.conj());
            column[number] = entry / root;
            gain.iter_mut().zip(&own).for_each(|(gain, own)| *gain -= entry / pivot * own);
        }
        is_open[chosen] = false;
        columns.push(column);
    }
    columns
}

/// A real factor of the same Gramian in real coordinates, of which each belongs to a real pole, or two to a pair:
/// `√2 Re ζ` and `√2 Im ζ`. `partners` has of each pole the number of its conjugate, its own of a real one; coordinates
/// stand at the numbers of the poles, and of a pair those of the one with the positive imaginary part come first.
pub fn real(columns: &[Vec<Complex>], poles: &[Complex], partners: &[usize]) -> Dense {
    let rows = poles.len();
    let mut factor = Dense::zeros(rows, 2 * columns.len());
    for (number, column) in columns.iter().enumerate() {
        for row in 0..rows {
            // The unitary matrix (ζ + ζ')/√2, (ζ − ζ')/(i √2).
            let (own, other) = (column[row], column[partners[row]]);
            let value = if partners[row] == row {
                own
            } else if poles[row].im > 0.0 {
                (own + other) * FRAC_1_SQRT_2
            } else {
                (own - other) * Complex::new(0.0, FRAC_1_SQRT_2)
            };
            factor.column_mut(2 * number)[row] = value.re;
            factor.column_mut(2 * number + 1)[row] = value.im;
        }
    }
    factor
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The factor has the closed entries, of two inputs and poles of both kinds.
    #[test]
    fn factors_have_the_entries_of_the_gramian() {
        let poles = [[-1.0, 3.0], [-1.0, -3.0], [-0.5, 0.0], [-20.0, 0.0]].map(|[re, im]| Complex::new(re, im));
        let gains =
            [[[1.0, 0.5], [0.2, 0.0]], [[1.0, -0.5], [0.2, 0.0]], [[2.0, 0.0], [-1.0, 0.0]], [[0.3, 0.0], [4.0, 0.0]]];
        let gains = gains.map(|own| own.map(|[re, im]| Complex::new(re, im)).to_vec());
        let columns = factor(&poles, &gains);
        for row in 0..4 {
            for column in 0..4 {
                let found: Complex = columns.iter().map(|own| own[row] * own[column].conj()).sum();
                let exact = -product(&gains[row], &gains[column]) / (poles[row] + poles[column].conj());
                assert!((found - exact).norm() < 1e-14, "{row} {column}: {found} {exact}");
            }
        }
        // Both real parts, too: L Lᵀ of a pair is that of √2 Re ζ and √2 Im ζ.
        let own = real(&columns, &poles, &[1, 0, 2, 3]);
        let square: f64 = (0..own.columns).map(|column| own.at(0, column).powi(2) + own.at(1, column).powi(2)).sum();
        let whole: f64 = columns.iter().map(|own| own[0].norm_sqr()).sum();
        assert!((square - 2.0 * whole).abs() < 1e-14, "{square} {whole}");
    }
}
