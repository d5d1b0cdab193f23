//! A linear system in coordinates of its modes: responses, and the real block form.

use crate::solve::linear::dense::{Complex, Dense};
use crate::solve::linear::eigen::Eigen;
use nalgebra::DMatrix;
use std::f64::consts::SQRT_2;

/// A pole whose damping ratio is below this does not fade: round-off decides whether it is stable.
const FADES: f64 = 1e-9;
/// Conjugate eigenvalues differ by less than this share.
const ROUND_OFF: f64 = 1e-9;

/// A system in coordinates of its modes: `λ`, `C x`, `yᵀ B`.
#[derive(Debug)]
pub struct Modes {
    /// Their poles; of a pair that with the positive imaginary part first, the other one next to it.
    pub poles: Vec<Complex>,
    /// `C x`: for each mode a list of outputs.
    pub seen: Vec<Vec<Complex>>,
    /// `yᵀ B`: for each mode a list of inputs.
    pub moved: Vec<Vec<Complex>>,
}

impl Modes {
    /// Those `found` of a system with these matrices.
    pub fn new(found: &[&Eigen], b: &Dense, c: &Dense) -> Self {
        let row = |matrix: &Dense, row: usize, vector: &[Complex]| -> Complex {
            vector.iter().enumerate().map(|(column, value)| value * matrix.at(row, column)).sum()
        };
        let transposed = b.transposed();
        Self {
            poles: found.iter().map(|own| own.value).collect(),
            seen: found.iter().map(|own| (0..c.rows).map(|number| row(c, number, &own.right)).collect()).collect(),
            moved: found
                .iter()
                .map(|own| (0..b.columns).map(|number| row(&transposed, number, &own.left)).collect())
                .collect(),
        }
    }

    /// Measures outputs and inputs in other units.
    pub fn scale(&mut self, [outputs, inputs]: [&[f64]; 2]) {
        for (lists, units, invert) in [(&mut self.seen, outputs, true), (&mut self.moved, inputs, false)] {
            for own in lists.iter_mut() {
                for (value, unit) in own.iter_mut().zip(units) {
                    let unit = if invert { 1.0 / *unit } else { *unit };
                    *value *= unit;
                }
            }
        }
    }

    /// Those `chosen`, whose pairs are whole, and the others.
    pub fn divided(&self, chosen: &[usize]) -> [Self; 2] {
        [true, false].map(|wanted| {
            let own = (0..self.poles.len()).filter(|number| chosen.contains(number) == wanted);
            let own: Vec<usize> = own.collect();
            let of = |lists: &[Vec<Complex>]| own.iter().map(|number| lists[*number].clone()).collect();
            Self {
                poles: own.iter().map(|number| self.poles[*number]).collect(),
                seen: of(&self.seen),
                moved: of(&self.moved),
            }
        })
    }

    /// The largest response of a mode alone to a vibration of all inputs.
    pub fn height(&self, number: usize) -> f64 {
        length(&self.seen[number]) * length(&self.moved[number]) / -self.poles[number].re
    }

    /// Chooses the coordinates in which inputs move a mode as outputs see it, over `scale` squared.
    pub fn balance(&mut self, scale: f64) {
        for (seen, moved) in self.seen.iter_mut().zip(&mut self.moved) {
            let factor = (length(seen) / length(moved)).sqrt() / scale;
            seen.iter_mut().for_each(|value| *value /= factor);
            moved.iter_mut().for_each(|value| *value *= factor);
        }
    }

    /// Adds `factor/(iω − λ)` of mode `number` to a response, column after column; and, where `corrected`, `factor/λ`.
    pub fn add(&self, number: usize, omega: f64, corrected: bool, sum: &mut [Complex]) {
        let pole = self.poles[number];
        let fixed = if corrected { pole.inv() } else { Complex::from(0.0) };
        let gain = (Complex::new(0.0, omega) - pole).inv() + fixed;
        let outputs = self.seen[number].len();
        for (moved, sums) in self.moved[number].iter().zip(sum.chunks_exact_mut(outputs.max(1))) {
            sums.iter_mut().zip(&self.seen[number]).for_each(|(sum, seen)| *sum += seen * moved * gain);
        }
    }

    /// The response at `omega` without `D`.
    pub fn response(&self, omega: f64, count: usize) -> Vec<Complex> {
        let mut sum = vec![Complex::from(0.0); count];
        (0..self.poles.len()).for_each(|number| self.add(number, omega, false, &mut sum));
        sum
    }

    /// The real block form of the modes `chosen`, whose pairs are whole: `A`, `B`, `C`.
    pub fn real(&self, chosen: &[usize]) -> [Dense; 3] {
        let count = chosen.len();
        let [outputs, inputs] = [&self.seen, &self.moved].map(|lists| lists.first().map_or(0, Vec::len));
        let [mut a, mut b, mut c] =
            [Dense::zeros(count, count), Dense::zeros(count, inputs), Dense::zeros(outputs, count)];
        for (row, number) in chosen.iter().enumerate() {
            let Complex { re: decay, im: swing } = self.poles[*number];
            a.column_mut(row)[row] = decay;
            if swing != 0.0 {
                let other = chosen.iter().position(|own| *own == self.partner(*number)).unwrap_or(row);
                // The first coordinate of a pair is √2 Re ζ, the second one √2 Im ζ.
                a.column_mut(other)[row] = -swing;
            }
            // Of a pair both follow from the vectors of the first one.
            let (first, factor, is_second) = match swing {
                swing if swing < 0.0 => (self.partner(*number), SQRT_2, true),
                swing if swing > 0.0 => (*number, SQRT_2, false),
                _ => (*number, 1.0, false),
            };
            for (input, moved) in self.moved[first].iter().enumerate() {
                b.column_mut(input)[row] = factor * if is_second { moved.im } else { moved.re };
            }
            for (output, seen) in self.seen[first].iter().enumerate() {
                c.column_mut(row)[output] = factor * if is_second { -seen.im } else { seen.re };
            }
        }
        [a, b, c]
    }

    /// The number of the conjugate mode: pairs stand next to each other.
    pub fn partner(&self, number: usize) -> usize {
        match self.poles[number].im {
            swing if swing > 0.0 => number + 1,
            swing if swing < 0.0 => number - 1,
            _ => number,
        }
    }
}

fn length(vector: &[Complex]) -> f64 {
    vector.iter().map(Complex::norm_sqr).sum::<f64>().sqrt()
}

/// The modes that last and those that fade; of a pair the one with the positive imaginary part first.
pub fn pairs(found: &[Eigen]) -> (Vec<&Eigen>, Vec<&Eigen>) {
    let (mut lasting, mut fading) = (Vec::new(), Vec::new());
    let mut order: Vec<&Eigen> = found.iter().filter(|own| own.value.im >= 0.0).collect();
    order.sort_by(|a, b| a.size().total_cmp(&b.size()));
    for own in order {
        let target = if own.value.re < -FADES * own.size() { &mut fading } else { &mut lasting };
        target.push(own);
        if own.value.im > 0.0 {
            let distance = |other: &Eigen| {
                let vectors = own.right.iter().zip(&other.right);
                let apart: f64 = vectors.map(|(own, other)| (own - other.conj()).norm()).sum();
                ((own.value - other.value.conj()).norm() > ROUND_OFF * own.size(), apart)
            };
            let conjugates = found.iter().filter(|other| other.value.im < 0.0).map(|other| (distance(other), other));
            let conjugate = conjugates.min_by(|(a, _), (b, _)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
            let conjugate = conjugate.map(|(_, other)| other);
            target.extend(conjugate);
        }
    }
    (lasting, fading)
}

/// The largest singular value of a response with so many rows; infinite where a number of it is not finite.
pub fn norm(response: &[Complex], rows: usize) -> f64 {
    if response.iter().any(|value| !value.is_finite()) {
        return f64::INFINITY;
    }
    let columns = response.len() / rows.max(1);
    if rows == 0 || columns == 0 {
        return 0.0;
    }
    DMatrix::from_column_slice(rows, columns, response).singular_values().iter().copied().fold(0.0, f64::max)
}
