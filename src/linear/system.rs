//! A linear system and its exact steps: `dz/dt = A z + B v`, `y = C z + D v`, with inputs that change linearly in time.

use super::matrix::Matrix;

/// Lengths of steps whose matrices are kept.
const KEPT: usize = 4;
/// Terms of the series beyond the first one; they end below round-off for a norm of [`SERIES_NORM`].
const TERMS: u32 = 13;
/// Largest norm for which the series is summed.
const SERIES_NORM: f64 = 0.5;
/// Most doublings of a step: the norm of `A` times a step is below 2 to this power.
const DOUBLINGS: i32 = 200;
/// Bits of a step's length that its matrices keep.
const BITS: u32 = 30;
/// Largest norm of `A` times the rest of the length: the next order of the rest is below round-off.
const REST: f64 = 1e-8;
/// Rounds of balancing; the first few do nearly all of it.
const ROUNDS: usize = 20;

/// The matrices of a linear system, with those of its last steps.
#[derive(Clone, Debug)]
pub struct System {
    a: Matrix,
    b: Matrix,
    c: Matrix,
    d: Matrix,
    /// The units that the states are counted in.
    units: Vec<f64>,
    /// The norm of `A`.
    norm: f64,
    /// The matrices of steps, the latest first.
    steps: Vec<Step>,
}

/// The matrices of a step: `z⁺ = A z + B v + S v'` with the inputs `v` at its start and their rates `v'`.
#[derive(Clone, Debug)]
struct Step {
    length: f64,
    a: Matrix,
    b: Matrix,
    s: Matrix,
}

/// A step: its state at the start, its inputs there, their rates, its length.
#[derive(Clone, Copy, Debug)]
pub struct Stride<'a> {
    pub state: &'a [f64],
    pub inputs: &'a [f64],
    pub rates: &'a [f64],
    pub length: f64,
}

/// A result at an instant.
#[derive(Clone, Copy, Debug)]
pub enum Unknown {
    /// The derivative of a state by time.
    Rate(usize),
    /// An output.
    Output(usize),
}

/// A value that results follow from.
#[derive(Clone, Copy, Debug)]
pub enum Known {
    /// A state.
    State(usize),
    /// An input.
    Input(usize),
}

impl System {
    /// The system of four matrices that fit; none: in coordinates of like size its numbers are not finite. The state
    /// has other units then, powers of two of the given ones.
    pub fn new(mut a: Matrix, mut b: Matrix, mut c: Matrix, d: Matrix) -> Option<Self> {
        let units = balance(&mut a, &mut b, &mut c);
        let norm = a.norm();
        let is_finite = norm.is_finite() && [&b, &c, &d].into_iter().all(Matrix::is_finite);
        is_finite.then_some(Self { a, b, c, d, units, norm, steps: Vec::new() })
    }

    /// Number of states.
    pub fn order(&self) -> usize {
        self.a.rows
    }

    /// The unit that a state is counted in here, a power of two of that of the given matrices.
    pub fn unit(&self, state: usize) -> f64 {
        self.units[state]
    }

    /// Whether states, or their derivatives, are numbers in the units of the given matrices too.
    pub fn are_finite(&self, states: &[f64]) -> bool {
        states.iter().zip(&self.units).all(|(state, unit)| (state * unit).is_finite())
    }

    /// The derivative at an instant of a rate of a state or of an output with respect to a state or an input.
    pub fn slope(&self, of: Unknown, with_respect_to: Known) -> f64 {
        match (of, with_respect_to) {
            (Unknown::Rate(row), Known::State(column)) => {
                self.a.at(row, column) * (self.units[row] / self.units[column])
            }
            (Unknown::Rate(row), Known::Input(column)) => self.b.at(row, column) * self.units[row],
            (Unknown::Output(row), Known::State(column)) => self.c.at(row, column) / self.units[column],
            (Unknown::Output(row), Known::Input(column)) => self.d.at(row, column),
        }
    }

    /// The size of states in their units here at which the first output reaches its order of magnitude.
    pub fn size(&self, outputs: impl Iterator<Item = f64>) -> f64 {
        let row = |row: usize| (0..self.order()).map(|column| self.c.at(row, column).abs()).fold(0.0, f64::max);
        outputs.enumerate().map(|(number, size)| size / row(number)).fold(f64::INFINITY, f64::min)
    }

    /// Takes a step, to `target`; false: it is too long for its matrices to be finite. Allocates nothing where the
    /// length is one of the last ones.
    pub fn step(&mut self, stride: Stride<'_>, [target, ends, rest]: [&mut Vec<f64>; 3]) -> bool {
        let Stride { state, inputs, rates, length } = stride;
        let Some(rounded) = self.prepare(length) else { return false };
        let Step { a, b, s, .. } = &self.steps[0];
        target.fill(0.0);
        a.add_to(state, 1.0, target);
        b.add_to(inputs, 1.0, target);
        s.add_to(rates, 1.0, target);
        let more = length - rounded;
        if more != 0.0 {
            ends.iter_mut().zip(inputs.iter().zip(rates)).for_each(|(end, (at, rate))| *end = at + rate * rounded);
            self.rate(target, ends, rest);
            target.iter_mut().zip(rest.iter()).for_each(|(target, rate)| *target += more * rate);
        }
        true
    }

    /// The derivative of the state by time.
    pub fn rate(&self, state: &[f64], inputs: &[f64], target: &mut [f64]) {
        target.fill(0.0);
        self.a.add_to(state, 1.0, target);
        self.b.add_to(inputs, 1.0, target);
    }

    /// Output number `row`, without its offset.
    pub fn output(&self, row: usize, state: &[f64], inputs: &[f64]) -> f64 {
        self.c.row_times(row, state) + self.d.row_times(row, inputs)
    }

    /// The derivative of the state at the end of a step by input `column` during it; none: the step is too long.
    pub fn sensitivity(&mut self, column: usize, length: f64) -> Option<Vec<f64>> {
        let rounded = self.prepare(length)?;
        let mut change = self.steps[0].b.column(column).to_vec();
        let mut rest = self.b.column(column).to_vec();
        self.a.add_to(&change, 1.0, &mut rest);
        change.iter_mut().zip(rest).for_each(|(change, rate)| *change += (length - rounded) * rate);
        Some(change)
    }

    /// The matrices `A` and `B` of a step with inputs that are held, `z⁺ = A z + B v`, in the units of the given
    /// matrices; none: a number is not finite.
    pub fn held(&self, length: f64) -> Option<[Matrix; 2]> {
        let Step { mut a, mut b, .. } = Step::new(&self.a, &self.b, self.norm, length)?;
        for (row, unit) in self.units.iter().enumerate() {
            (0..a.columns).for_each(|column| *a.at_mut(row, column) *= unit / self.units[column]);
            (0..b.columns).for_each(|column| *b.at_mut(row, column) *= unit);
        }
        (a.is_finite() && b.is_finite()).then_some([a, b])
    }

    /// Makes the matrices of a step the first ones; returns their length, to which its round-off belongs not.
    fn prepare(&mut self, length: f64) -> Option<f64> {
        let rounded = self.rounded(length);
        match self.steps.iter().position(|step| step.length == rounded) {
            Some(0) => (),
            Some(number) => self.steps[..=number].rotate_right(1),
            None => {
                let step = Step::new(&self.a, &self.b, self.norm, rounded)?;
                self.steps.truncate(KEPT - 1);
                self.steps.insert(0, step);
            }
        }
        Some(rounded)
    }

    /// The length whose matrices are taken for a step: hosts that add up their times ask for many that differ by
    /// round-off. The choice depends on nothing but this length, so that results do not depend on earlier steps.
    fn rounded(&self, length: f64) -> f64 {
        let dropped = f64::MANTISSA_DIGITS - 1 - BITS;
        let rounded = f64::from_bits((length.to_bits() + (1 << (dropped - 1))) & (u64::MAX << dropped));
        if rounded.is_finite() && self.norm * (length - rounded).abs() <= REST { rounded } else { length }
    }
}

impl Step {
    /// Sums the series of a short step and doubles it; none: a number is not finite. Not inlined: it is rare, and
    /// callers that are not have little stack.
    #[inline(never)]
    fn new(a: &Matrix, b: &Matrix, norm: f64, length: f64) -> Option<Self> {
        let (mut short, mut doublings) = (length, 0);
        while norm * short > SERIES_NORM {
            short *= 0.5;
            doublings += 1;
            if doublings > DOUBLINGS {
                return None;
            }
        }
        // The functions φ₂, φ₁ and φ₀ of the matrix, φ₀ its exponential: φₖ(x) = x φₖ₊₁(x) + 1/k!.
        let own = a.clone().scaled(short);
        let one = Matrix::identity(a.rows);
        let mut sum = one.clone();
        for term in (3..TERMS + 3).rev() {
            sum = own.times(&sum).scaled(1.0 / f64::from(term));
            sum.add(1.0, &one);
        }
        let second = sum.scaled(0.5);
        let next = |phi: &Matrix| {
            let mut product = own.times(phi);
            product.add(1.0, &one);
            product
        };
        let first = next(&second);
        let mut step = Self {
            length,
            a: next(&first),
            b: first.times(b).scaled(short),
            s: second.times(b).scaled(short).scaled(short),
        };
        for _ in 0..doublings {
            let mut s = step.a.times(&step.s);
            s.add(1.0, &step.s);
            s.add(short, &step.b);
            let mut b = step.a.times(&step.b);
            b.add(1.0, &step.b);
            let a = step.a.times(&step.a);
            step = Self { length, a, b, s };
            short *= 2.0;
        }
        let is_finite = [&step.a, &step.b, &step.s].into_iter().all(Matrix::is_finite);
        is_finite.then_some(step)
    }
}

/// Counts the states in units, powers of two, that make rows and columns of `A` alike (Parlett and Reinsch 1969):
/// without round-off, and with far fewer doublings for a mechanism whose rates are much larger than its motions.
/// Returns the units.
fn balance(a: &mut Matrix, b: &mut Matrix, c: &mut Matrix) -> Vec<f64> {
    let order = a.rows;
    let mut units = vec![1.0; order];
    for _ in 0..ROUNDS {
        let mut is_done = true;
        for (number, unit) in units.iter_mut().enumerate() {
            let others = || (0..order).filter(|other| *other != number);
            let column: f64 = others().map(|other| a.at(other, number).abs()).sum();
            let row: f64 = others().map(|other| a.at(number, other).abs()).sum();
            if !(column > 0.0 && row > 0.0 && column.is_finite() && row.is_finite()) {
                continue;
            }
            let (mut factor, mut grown) = (1.0, column);
            while grown < row / 2.0 && factor < 1e150 {
                (factor, grown) = (factor * 2.0, grown * 4.0);
            }
            while grown > row * 2.0 && factor > 1e-150 {
                (factor, grown) = (factor / 2.0, grown / 4.0);
            }
            if (grown + row) / factor < 0.95 * (column + row) {
                is_done = false;
                *unit *= factor;
                for other in 0..order {
                    *a.at_mut(other, number) *= factor;
                }
                for other in 0..order {
                    *a.at_mut(number, other) /= factor;
                }
                (0..c.rows).for_each(|other| *c.at_mut(other, number) *= factor);
                (0..b.columns).for_each(|other| *b.at_mut(number, other) /= factor);
            }
        }
        if is_done {
            break;
        }
    }
    units
}
