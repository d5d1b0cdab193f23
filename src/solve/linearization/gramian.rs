//! Gramians of a stable system in its own modes, as factors `W = L Lᵀ`.
//!
//! Coordinates of the modes have `Λ W + W Λ* = −G G*`, so that every entry of `W` is known:
//! `Wᵢⱼ = −gᵢ·gⱼ*/(λᵢ + λⱼ*)`. What is left of such a matrix after a step of Cholesky's factorization is another one,
//! with the rows `gᵢ − lᵢ gₖ/lₖ` (Gohberg, Kailath, Olshevsky 1995). The factorization with pivots, stopped at
//! round-off, takes few steps, forms no `W`, and keeps the small singular values that a factor of a computed `W`
//! would lose.

use crate::solve::linear::dense::Dense;

/// A complex number, real and imaginary part.
pub type Complex = [f64; 2];

/// A pivot below this share of the first one is round-off: the root of it belongs to a Hankel singular value.
const LEAST: f64 = 1e-32;

/// `a b`.
pub fn times(a: Complex, b: Complex) -> Complex {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// `a/b`.
pub fn over(a: Complex, b: Complex) -> Complex {
    let size = b[0] * b[0] + b[1] * b[1];
    [(a[0] * b[0] + a[1] * b[1]) / size, (a[1] * b[0] - a[0] * b[1]) / size]
}

/// `Σ aₖ bₖ*`.
fn product(a: &[Complex], b: &[Complex]) -> Complex {
    a.iter().zip(b).fold([0.0; 2], |sum, (a, b)| {
        let own = times(*a, [b[0], -b[1]]);
        [sum[0] + own[0], sum[1] + own[1]]
    })
}

/// The columns of `L` with `Λ L L* + L L* Λ* = −G G*`, for the poles `poles` with negative real parts and the rows
/// `gains` of `G`.
pub fn factor(poles: &[Complex], gains: &[Vec<Complex>]) -> Vec<Vec<Complex>> {
    let mut gains = gains.to_vec();
    let mut is_open = vec![true; poles.len()];
    let mut columns: Vec<Vec<Complex>> = Vec::new();
    let mut first = 0.0;
    while columns.len() < poles.len() {
        let square = |own: usize| -product(&gains[own], &gains[own])[0] / (2.0 * poles[own][0]);
        let open = (0..poles.len()).filter(|own| is_open[*own]).map(|own| (square(own), own));
        let Some((pivot, chosen)) = open.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        first = f64::max(first, pivot);
        if pivot.is_nan() || pivot <= LEAST * first {
            break;
        }
        let root = pivot.sqrt();
        let (own, pole) = (gains[chosen].clone(), poles[chosen]);
        let mut column = vec![[0.0; 2]; poles.len()];
        for (number, gain) in gains.iter_mut().enumerate().filter(|(number, _)| is_open[*number]) {
            let sum = [-(poles[number][0] + pole[0]), -(poles[number][1] - pole[1])];
            let entry = over(product(gain, &own), sum);
            column[number] = [entry[0] / root, entry[1] / root];
            let share = [entry[0] / pivot, entry[1] / pivot];
            for (gain, own) in gain.iter_mut().zip(&own) {
                let part = times(share, *own);
                *gain = [gain[0] - part[0], gain[1] - part[1]];
            }
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
            let root = std::f64::consts::FRAC_1_SQRT_2;
            let value = if partners[row] == row {
                own
            } else if poles[row][1] > 0.0 {
                [root * (own[0] + other[0]), root * (own[1] + other[1])]
            } else {
                [root * (other[1] - own[1]), root * (own[0] - other[0])]
            };
            factor.column_mut(2 * number)[row] = value[0];
            factor.column_mut(2 * number + 1)[row] = value[1];
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
        let poles = [[-1.0, 3.0], [-1.0, -3.0], [-0.5, 0.0], [-20.0, 0.0]];
        let gains: Vec<Vec<Complex>> = vec![
            vec![[1.0, 0.5], [0.2, 0.0]],
            vec![[1.0, -0.5], [0.2, 0.0]],
            vec![[2.0, 0.0], [-1.0, 0.0]],
            vec![[0.3, 0.0], [4.0, 0.0]],
        ];
        let columns = factor(&poles, &gains);
        for row in 0..4 {
            for column in 0..4 {
                let sum = columns.iter().fold([0.0; 2], |sum, own| {
                    let part = times(own[row], [own[column][0], -own[column][1]]);
                    [sum[0] + part[0], sum[1] + part[1]]
                });
                let poles = [poles[row][0] + poles[column][0], poles[row][1] - poles[column][1]];
                let exact = over(product(&gains[row], &gains[column]), [-poles[0], -poles[1]]);
                assert!(f64::hypot(sum[0] - exact[0], sum[1] - exact[1]) < 1e-14, "{row} {column}: {sum:?} {exact:?}");
            }
        }
        // Both real parts, too: L Lᵀ of a pair is that of √2 Re ζ and √2 Im ζ.
        let own = real(&columns, &poles, &[1, 0, 2, 3]);
        let square: f64 = (0..own.columns).map(|column| own.at(0, column).powi(2) + own.at(1, column).powi(2)).sum();
        let whole: f64 = columns.iter().map(|own| own[0][0].powi(2) + own[0][1].powi(2)).sum();
        assert!((square - 2.0 * whole).abs() < 1e-14, "{square} {whole}");
    }
}
