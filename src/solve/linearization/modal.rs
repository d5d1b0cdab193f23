//! A linear system in coordinates of its modes: responses, and the real block form.

use super::gramian::{Complex, over, times};
use crate::solve::linear::dense::{Dense, Eigen};
use std::f64::consts::SQRT_2;

/// A pole whose damping ratio is below this does not fade: round-off decides whether it is stable.
const FADES: f64 = 1e-9;
/// Conjugate eigenvalues differ by less than this share.
const ROUND_OFF: f64 = 1e-9;
/// Iterations for the largest singular value of a response.
const POWERS: usize = 40;

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
        let row = |matrix: &Dense, row: usize, vector: &[Complex]| {
            let own = vector.iter().enumerate();
            own.fold([0.0; 2], |sum, (column, value)| {
                let factor = matrix.at(row, column);
                [sum[0] + factor * value[0], sum[1] + factor * value[1]]
            })
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
                    let unit = if invert { 1.0 / unit } else { *unit };
                    *value = value.map(|part| part * unit);
                }
            }
        }
    }

    /// Adds `factor/(iω − λ)` of mode `number` to a response, column after column; and, where `corrected`, `factor/λ`.
    pub fn add(&self, number: usize, omega: f64, corrected: bool, sum: &mut [Complex]) {
        let pole = self.poles[number];
        let mut gain = over([1.0, 0.0], [-pole[0], omega - pole[1]]);
        if corrected {
            let fixed = over([1.0, 0.0], pole);
            gain = [gain[0] + fixed[0], gain[1] + fixed[1]];
        }
        let outputs = self.seen[number].len();
        for (input, moved) in self.moved[number].iter().enumerate() {
            let own = times(*moved, gain);
            for (output, seen) in self.seen[number].iter().enumerate() {
                let part = times(*seen, own);
                let target = &mut sum[input * outputs + output];
                *target = [target[0] + part[0], target[1] + part[1]];
            }
        }
    }

    /// The response at `omega` without `D`.
    pub fn response(&self, omega: f64, count: usize) -> Vec<Complex> {
        let mut sum = vec![[0.0; 2]; count];
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
            let [decay, swing] = self.poles[*number];
            a.column_mut(row)[row] = decay;
            if swing != 0.0 {
                let other = chosen.iter().position(|own| *own == self.partner(*number)).unwrap_or(row);
                // The first coordinate of a pair is √2 Re ζ, the second one √2 Im ζ.
                a.column_mut(other)[row] = -swing;
            }
            let part = usize::from(swing < 0.0);
            let of_pair = if swing < 0.0 { self.partner(*number) } else { *number };
            let factor = if swing == 0.0 { 1.0 } else { SQRT_2 };
            let sign = if swing < 0.0 { -1.0 } else { 1.0 };
            for input in 0..inputs {
                b.column_mut(input)[row] = factor * self.moved[of_pair][input][part];
            }
            for output in 0..outputs {
                c.column_mut(row)[output] = sign * factor * self.seen[of_pair][output][part];
            }
        }
        [a, b, c]
    }

    /// The number of the conjugate mode: pairs stand next to each other.
    pub fn partner(&self, number: usize) -> usize {
        match self.poles[number][1] {
            swing if swing > 0.0 => number + 1,
            swing if swing < 0.0 => number - 1,
            _ => number,
        }
    }
}

/// The modes that last and those that fade; of a pair the one with the positive imaginary part first.
pub fn pairs(found: &[Eigen]) -> (Vec<&Eigen>, Vec<&Eigen>) {
    let (mut lasting, mut fading) = (Vec::new(), Vec::new());
    let mut order: Vec<&Eigen> = found.iter().filter(|own| own.value[1] >= 0.0).collect();
    order.sort_by(|a, b| a.size().total_cmp(&b.size()));
    for own in order {
        let target = if own.value[0] < -FADES * own.size() { &mut fading } else { &mut lasting };
        target.push(own);
        if own.value[1] > 0.0 {
            let distance = |other: &&Eigen| {
                let same = own.right.iter().zip(&other.right);
                let apart = same.map(|(a, b)| f64::hypot(a[0] - b[0], a[1] + b[1])).sum::<f64>();
                let value = f64::hypot(own.value[0] - other.value[0], own.value[1] + other.value[1]);
                (value / own.size(), apart)
            };
            let conjugates = found.iter().filter(|other| other.value[1] < 0.0);
            let conjugate = conjugates.min_by(|a, b| {
                let ([a, b], [c, d]) = (<[f64; 2]>::from(distance(a)), <[f64; 2]>::from(distance(b)));
                (a > ROUND_OFF).cmp(&(c > ROUND_OFF)).then(b.total_cmp(&d))
            });
            target.extend(conjugate);
        }
    }
    (lasting, fading)
}

/// The largest singular value of a response with so many rows.
pub fn norm(response: &[Complex], rows: usize) -> f64 {
    let columns = response.len() / rows.max(1);
    let mut vector: Vec<Complex> = vec![[1.0, 0.0]; columns];
    let mut found = 0.0;
    // A response to one input, or of one output, has one singular value.
    for _ in 0..if rows.min(columns) > 1 { POWERS } else { 2 } {
        let mut image = vec![[0.0; 2]; rows];
        for (column, factor) in response.chunks_exact(rows.max(1)).zip(&vector) {
            for (image, value) in image.iter_mut().zip(column) {
                let part = times(*value, *factor);
                *image = [image[0] + part[0], image[1] + part[1]];
            }
        }
        let back = response.chunks_exact(rows.max(1)).map(|column| {
            column.iter().zip(&image).fold([0.0; 2], |sum, (value, image)| {
                let part = times([value[0], -value[1]], *image);
                [sum[0] + part[0], sum[1] + part[1]]
            })
        });
        let back: Vec<Complex> = back.collect();
        let length = |vector: &[Complex]| vector.iter().flatten().map(|part| part * part).sum::<f64>().sqrt();
        let size = length(&back);
        if size == 0.0 {
            return found;
        }
        found = length(&image) / length(&vector);
        vector = back.iter().map(|value| value.map(|part| part / size)).collect();
    }
    found
}
