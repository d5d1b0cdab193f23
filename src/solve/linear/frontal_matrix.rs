//! The dense matrix of one front: its pivots eliminated, and solved with.
//!
//! Columns lie one after the other: first the rows of the pivots, then those of the border, filled up with zeros to
//! whole lanes. Eliminated, a column of a pivot holds `L` below its diagonal, the inverse of the pivot on it, `U`
//! above; a column of the border `U`, and what is left for the parent. Columns of pivots stay; of those of the border,
//! `U` is kept in columns of its own.

use super::Singular;

/// Rows of the border that are worked on at a time.
const LANES: usize = 8;

/// Pivots that are eliminated at a time where their number is not usual.
const PANEL: usize = 4;

/// Numbers of pivots and of border rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shape {
    /// Unknowns that are eliminated.
    pub pivots: usize,
    /// Unknowns that stay.
    pub border: usize,
}

impl Shape {
    /// Distance of neighboring columns.
    pub fn stride(self) -> usize {
        self.pivots + self.border.next_multiple_of(LANES)
    }

    /// Number of values in the columns of the pivots.
    pub fn own(self) -> usize {
        self.stride() * self.pivots
    }

    /// Number of values in the columns of the border.
    pub fn right(self) -> usize {
        self.stride() * self.border
    }

    /// Number of values of the factors: the columns of the pivots, then `U` in those of the border.
    pub fn factors(self) -> usize {
        self.own() + self.pivots * self.border
    }

    /// Number of values that are left for the parent.
    pub fn rest(self) -> usize {
        self.border * self.border
    }
}

/// Eliminates the pivots of a front, whose columns are `own`, those of the border `right`, with partial pivoting among
/// them: the row whose entry, times its weight in `weights`, is largest. `rows` get the row of each pivot at the time
/// of its choice.
///
/// # Errors
/// A pivot is zero or not finite.
pub fn eliminate(
    shape: Shape,
    own: &mut [f64],
    right: &mut [f64],
    weights: &mut [f64],
    rows: &mut [u16],
) -> Result<(), Singular> {
    match shape.pivots {
        6 => eliminate_sized::<6>(shape, own, right, weights, rows),
        7 => eliminate_sized::<7>(shape, own, right, weights, rows),
        8 => eliminate_sized::<8>(shape, own, right, weights, rows),
        9 => eliminate_sized::<9>(shape, own, right, weights, rows),
        10 => eliminate_sized::<10>(shape, own, right, weights, rows),
        11 => eliminate_sized::<11>(shape, own, right, weights, rows),
        12 => eliminate_sized::<12>(shape, own, right, weights, rows),
        13 => eliminate_sized::<13>(shape, own, right, weights, rows),
        _ => eliminate_panels(shape, own, right, weights, rows),
    }
}

/// With a number of pivots that the compiler knows and may unroll: column by column, each with all pivots before it.
fn eliminate_sized<const PIVOTS: usize>(
    shape: Shape,
    own: &mut [f64],
    right: &mut [f64],
    weights: &mut [f64],
    rows: &mut [u16],
) -> Result<(), Singular> {
    let stride = shape.stride();
    for number in 0..PIVOTS {
        let (before, rest) = own.split_at_mut(number * stride);
        let (column, later) = rest.split_at_mut(stride);
        reduce::<PIVOTS>(PIVOTS, before, column);
        let best = number + best_row(&column[number..PIVOTS], &weights[number..])?;
        rows[number] = short(best);
        if best != number {
            weights.swap(number, best);
            column.swap(number, best);
            // In later columns too, at once: whole lanes of what has just been written would have to wait when they are
            // read.
            for columns in [before, later, &mut *right] {
                columns.chunks_exact_mut(stride).for_each(|column| column.swap(number, best));
            }
        }
        let inverse = 1.0 / column[number];
        column[number] = inverse;
        column[number + 1..].iter_mut().for_each(|value| *value *= inverse);
    }
    for column in right.chunks_exact_mut(stride) {
        reduce::<PIVOTS>(PIVOTS, own, column);
    }
    Ok(())
}

/// With any number of pivots: some of them at a time, each lot taken out of all columns to its right.
fn eliminate_panels(
    shape: Shape,
    own: &mut [f64],
    right: &mut [f64],
    weights: &mut [f64],
    rows: &mut [u16],
) -> Result<(), Singular> {
    let mut done = 0;
    while done < shape.pivots {
        let width = PANEL.min(shape.pivots - done);
        match width {
            1 => eliminate_panel::<1>(shape, done, [&mut *own, &mut *right], weights, rows)?,
            2 => eliminate_panel::<2>(shape, done, [&mut *own, &mut *right], weights, rows)?,
            3 => eliminate_panel::<3>(shape, done, [&mut *own, &mut *right], weights, rows)?,
            _ => eliminate_panel::<PANEL>(shape, done, [&mut *own, &mut *right], weights, rows)?,
        }
        done += width;
    }
    Ok(())
}

/// Eliminates the pivots from `done` on, as many as the panel has.
fn eliminate_panel<const WIDTH: usize>(
    shape: Shape,
    done: usize,
    [own, right]: [&mut [f64]; 2],
    weights: &mut [f64],
    rows: &mut [u16],
) -> Result<(), Singular> {
    let (stride, end) = (shape.stride(), done + WIDTH);
    let (before, rest) = own.split_at_mut(done * stride);
    let (panel, ahead) = rest.split_at_mut(WIDTH * stride);
    let rows = &mut rows[done..end];
    let mut exchanged = false;
    for (own, row) in rows.iter_mut().enumerate() {
        let number = done + own;
        let (left, later) = panel.split_at_mut(own * stride);
        let (column, later) = later.split_at_mut(stride);
        let best = number + best_row(&column[number..shape.pivots], &weights[number..])?;
        *row = short(best);
        if best != number {
            exchanged = true;
            weights.swap(number, best);
            column.swap(number, best);
            for columns in [&mut *before, left, &mut *later] {
                columns.chunks_exact_mut(stride).for_each(|column| column.swap(number, best));
            }
        }
        let inverse = 1.0 / column[number];
        column[number] = inverse;
        column[number + 1..].iter_mut().for_each(|value| *value *= inverse);
        for other in later.chunks_exact_mut(stride) {
            let factor = other[number];
            for (target, entry) in other[number + 1..].iter_mut().zip(&column[number + 1..]) {
                *target -= factor * entry;
            }
        }
    }
    let mut lower = [&[] as &[f64]; WIDTH];
    let mut corner = [[0.0; WIDTH]; WIDTH];
    for (own, column) in panel.chunks_exact(stride).enumerate() {
        corner[own].copy_from_slice(&column[done..end]);
        lower[own] = &column[end..];
    }
    for column in ahead.chunks_exact_mut(stride).chain(right.chunks_exact_mut(stride)) {
        if exchanged {
            rows.iter().enumerate().for_each(|(own, row)| column.swap(done + own, usize::from(*row)));
        }
        let Some((factors, below)) = column[done..].split_first_chunk_mut::<WIDTH>() else { continue };
        for own in 0..WIDTH {
            (0..own).for_each(|before| factors[own] -= factors[before] * corner[before][own]);
        }
        let lower = lower.map(|entries| &entries[..below.len()]);
        for row in 0..below.len() {
            let mut value = below[row];
            (0..WIDTH).for_each(|own| value -= factors[own] * lower[own][row]);
            below[row] = value;
        }
    }
    Ok(())
}

/// The number of a row of a front, of which there are some hundreds at most.
fn short(row: usize) -> u16 {
    row as u16
}

/// The row of the largest entry, each times its weight.
///
/// # Errors
/// All are zero, or the largest is not finite.
fn best_row(column: &[f64], weights: &[f64]) -> Result<usize, Singular> {
    let (mut best, mut largest) = (0, 0.0);
    for (row, (value, weight)) in column.iter().zip(weights).enumerate() {
        let size = value.abs() * weight;
        if size > largest {
            (best, largest) = (row, size);
        }
    }
    if largest > 0.0 && largest.is_finite() { Ok(best) } else { Err(Singular) }
}

/// Takes the pivots, whose columns are `before`, out of a column.
#[inline(always)]
fn reduce<const PIVOTS: usize>(pivots: usize, before: &[f64], column: &mut [f64]) {
    let stride = column.len();
    let (upper, border) = column.split_at_mut(pivots);
    if PIVOTS > 0 {
        // At most a number that the compiler knows: it unrolls this.
        for number in 0..PIVOTS {
            let Some(lower) = before.get(number * stride..number * stride + PIVOTS) else { break };
            for row in number + 1..PIVOTS {
                upper[row] -= upper[number] * lower[row];
            }
        }
    } else {
        for (number, lower) in before.chunks_exact(stride).enumerate() {
            let value = upper[number];
            for (target, entry) in upper[number + 1..].iter_mut().zip(&lower[number + 1..pivots]) {
                *target -= value * entry;
            }
        }
    }
    for (place, target) in border.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let first = pivots + place * LANES;
        let mut sum = *target;
        for (value, lower) in upper.iter().zip(before.chunks_exact(stride)) {
            for (sum, entry) in sum.iter_mut().zip(&lower[first..first + LANES]) {
                *sum -= value * entry;
            }
        }
        *target = sum;
    }
}

/// Solves with `L`: `column` has the right sides of the pivots, then zeros; afterwards what they become, and what they
/// leave on the border.
pub fn solve_lower(shape: Shape, factors: &[f64], rows: &[u16], column: &mut [f64]) {
    for (number, row) in rows.iter().map(|row| usize::from(*row)).enumerate() {
        if row != number {
            column.swap(number, row);
        }
    }
    match shape.pivots {
        7 => reduce::<7>(7, &factors[..shape.own()], column),
        pivots => reduce::<0>(pivots, &factors[..shape.own()], column),
    }
}

/// Solves with `U`: `column` has the right sides of the pivots, then the solution on the border; afterwards the whole
/// solution.
pub fn solve_upper(shape: Shape, factors: &[f64], column: &mut [f64]) {
    match shape.pivots {
        7 => solve_upper_sized::<7>(shape, factors, column),
        _ => solve_upper_sized::<0>(shape, factors, column),
    }
}

fn solve_upper_sized<const PIVOTS: usize>(shape: Shape, factors: &[f64], column: &mut [f64]) {
    let pivots = if PIVOTS > 0 { PIVOTS } else { shape.pivots };
    let stride = shape.stride();
    let (column, border) = column.split_at_mut(pivots);
    let (own, right) = factors.split_at(pivots * stride);
    for (value, upper) in border.iter().zip(right.chunks_exact(pivots)) {
        for (sum, entry) in column.iter_mut().zip(upper) {
            *sum -= value * entry;
        }
    }
    for number in (0..pivots).rev() {
        let upper = &own[number * stride..number * stride + pivots];
        column[number] *= upper[number];
        let value = column[number];
        for row in 0..number {
            column[row] -= value * upper[row];
        }
    }
}

/// Solves with the transpose of `U`: `column` has the right sides of the pivots, then zeros; afterwards what they
/// become, and what they leave on the border.
pub fn solve_upper_transposed(shape: Shape, factors: &[f64], column: &mut [f64]) {
    let (own, right) = factors.split_at(shape.own());
    let (column, border) = column.split_at_mut(shape.pivots);
    for number in 0..shape.pivots {
        let upper = &own[number * shape.stride()..][..shape.pivots];
        column[number] = (column[number] - dot(&column[..number], upper)) * upper[number];
    }
    for (value, upper) in border.iter_mut().zip(right.chunks_exact(shape.pivots)) {
        *value = -dot(column, upper);
    }
}

/// Solves with the transpose of `L`: `column` has the right sides of the pivots, then the solution on the border;
/// afterwards the whole solution.
pub fn solve_lower_transposed(shape: Shape, factors: &[f64], rows: &[u16], column: &mut [f64]) {
    for number in (0..shape.pivots).rev() {
        let lower = &factors[number * shape.stride()..][..column.len()];
        column[number] -= dot(&column[number + 1..], &lower[number + 1..]);
    }
    for (number, row) in rows.iter().map(|row| usize::from(*row)).enumerate().rev() {
        column.swap(number, row);
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
