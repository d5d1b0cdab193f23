//! The part of a linear system whose poles are at 0, and the rest.
//!
//! Values and rates of prescribed motions integrate inputs: with their states last, `A = [[A_o, A_z], [0, J]]`, and the
//! columns of `[X; 1]` with `A_o X - X J = -A_z` are invariant. `J` is nilpotent, so that `X` is found column by
//! column, to the last digits. Rigid motions have no such form: their space is that of the smallest singular values.

use super::state_space::StateSpace;
use crate::solve::linear::Singular;
use crate::solve::linear::dense::{Dense, PivotedQr};

/// Entries below this share of what cancels in them are 0 in the equations of poles at 0.
const ROUND_OFF: f64 = 1e-9;

/// The system that is to be reduced.
#[derive(Clone, Debug)]
pub struct Whole {
    /// Its matrices.
    pub matrices: StateSpace,
    /// Number of poles at 0.
    pub zeros: usize,
    /// The size of the first one that is not, rad/s.
    pub slowest: f64,
    /// Number of states, the last ones, that integrate inputs: poles at 0, too.
    pub integrators: usize,
    /// The number, for each output, of the first one with the same unit.
    pub kinds: Vec<usize>,
}

/// Why a system is not reduced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Refusal {
    /// Eigenvalues do not converge.
    NotFound,
    /// More states have poles that do not fade than are wanted.
    Kept(usize),
    /// More states have poles that do not fade, or are static responses, than are wanted.
    Held(usize),
    /// The stiffness has a part that is not symmetric, of this share.
    Asymmetric(f64),
}

impl From<Singular> for Refusal {
    fn from(_: Singular) -> Self {
        Self::NotFound
    }
}

/// A state of a reduced system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A state of the whole system, which a pole at 0 belongs to.
    State(usize),
    /// A coordinate of a mode.
    Mode,
    /// The rate of such a coordinate, where it is a state too.
    ModeRate,
    /// A coordinate of a static response.
    Static,
    /// Its rate.
    StaticRate,
    /// A balanced state.
    Balanced,
}

/// The part of the poles at 0 in states of the whole system, with these, and the rest.
pub fn split(system: &Whole) -> Result<(StateSpace, Vec<Origin>, StateSpace), Refusal> {
    let Whole { matrices: whole, zeros, slowest, integrators, .. } = system;
    let own = whole.a.rows - integrators;
    let (first, last): (Vec<usize>, Vec<usize>) = ((0..own).collect(), (own..whole.a.rows).collect());
    // The states that integrate inputs are inputs of the others.
    let inputs = whole.b.columns;
    let others = StateSpace {
        a: whole.a.columns_at(0..own).rows_of(&first),
        b: whole.b.rows_of(&first).beside(&whole.a.columns_at(own..whole.a.rows).rows_of(&first)),
        c: whole.c.columns_at(0..own),
        d: whole.d.clone().beside(&Dense::zeros(whole.d.rows, *integrators)),
    };
    let (rigid, held, rest) = split_rigid(&others, zeros - integrators, *slowest)?;
    let of = |matrix: &Dense| [matrix.columns_at(0..inputs), matrix.columns_at(inputs..inputs + integrators)];
    let ([rigid_b, rigid_z], [rest_b, rest_z]) = (of(&rigid.b), of(&rest.b));
    let chain = whole.a.columns_at(own..whole.a.rows).rows_of(&last);
    let moved = whole.b.rows_of(&last);
    let follow = followers(&rest.a, &rest_z, &chain)?;
    let (count, free) = (held.len() + integrators, held.len());
    let mut a = Dense::zeros(count, count);
    for column in 0..count {
        let target = a.column_mut(column);
        if column < free {
            target[..free].copy_from_slice(rigid.a.column(column));
        } else {
            target[..free].copy_from_slice(rigid_z.column(column - free));
            target[free..].copy_from_slice(chain.column(column - free));
        }
    }
    let seen = rest.c.product(&follow);
    let mut c = whole.c.columns_at(own..whole.a.rows);
    c.values.iter_mut().zip(&seen.values).for_each(|(own, seen)| *own += seen);
    let fixed = StateSpace {
        a,
        b: rigid_b.transposed().beside(&moved.transposed()).transposed(),
        c: rigid.c.beside(&c),
        d: Dense::zeros(whole.d.rows, inputs),
    };
    let rest = StateSpace { b: rest_b.minus(&follow.product(&moved)), d: whole.d.clone(), ..rest };
    let origins = held.into_iter().chain(last).map(Origin::State).collect();
    Ok((fixed, origins, rest))
}

/// `X` of `a X - X chain = -driven`, with a nilpotent `chain`: how the states of `a` follow those of the chain.
fn followers(a: &Dense, driven: &Dense, chain: &Dense) -> Result<Dense, Refusal> {
    let mut found = Dense::zeros(a.rows, chain.columns);
    let mut waiting: Vec<usize> = (0..chain.columns).collect();
    while !waiting.is_empty() {
        let is_ready = |own: &usize| waiting.iter().all(|other| chain.at(*other, *own) == 0.0);
        let ready: Vec<usize> = waiting.iter().copied().filter(is_ready).collect();
        if ready.is_empty() {
            return Err(Refusal::NotFound);
        }
        let right = found.product(&chain.columns_at(ready.iter().copied()));
        let solved = a.solve(&right.minus(&driven.columns_at(ready.iter().copied())));
        for (number, own) in ready.iter().enumerate() {
            found.column_mut(*own).copy_from_slice(solved.column(number));
        }
        waiting.retain(|own| !ready.contains(own));
    }
    Ok(found)
}

/// The part of `zeros` rigid motions in states of the whole system, with these, and the rest. Its smallest pole is the
/// `slowest`, rad/s.
fn split_rigid(
    whole: &StateSpace,
    zeros: usize,
    slowest: f64,
) -> Result<(StateSpace, Vec<usize>, StateSpace), Refusal> {
    let StateSpace { a, b, c, d } = whole;
    let states = a.rows;
    let none = Dense::zeros(d.rows, d.columns);
    if zeros == 0 {
        let fixed =
            StateSpace { a: Dense::zeros(0, 0), b: Dense::zeros(0, b.columns), c: Dense::zeros(c.rows, 0), d: none };
        return Ok((fixed, Vec::new(), whole.clone()));
    }
    let mut balanced = a.clone();
    let scales = balanced.balance();
    let mut right = balanced.space_near_zero(zeros, slowest)?;
    let mut left = balanced.transposed().space_near_zero(zeros, slowest)?;
    for number in 0..zeros {
        right.column_mut(number).iter_mut().zip(&scales).for_each(|(value, scale)| *value *= scale);
        left.column_mut(number).iter_mut().zip(&scales).for_each(|(value, scale)| *value /= scale);
    }
    // A unit of one of these states at a time.
    let held = pivots(&right);
    let right = right.transposed();
    let right = right.rows_of(&(0..zeros).collect::<Vec<_>>()).transposed();
    let right = right.rows_of(&held).transposed().solve(&right.transposed()).transposed();
    let left = left.transposed().product(&right).solve(&left.transposed());
    let mut own = a.rows_of(&held).product(&right);
    for (row, held) in held.iter().enumerate() {
        for column in 0..zeros {
            let canceled: f64 = (0..states).map(|state| (a.at(*held, state) * right.at(state, column)).abs()).sum();
            let value = &mut own.column_mut(column)[row];
            if value.abs() <= ROUND_OFF * canceled {
                *value = 0.0;
            }
        }
    }
    let fixed = StateSpace { a: own, b: left.product(b), c: c.product(&right), d: none };

    // The rest: what the left vectors do not see, told by the states that they see least.
    let seen = pivots(&left.transposed());
    let others: Vec<usize> = (0..states).filter(|state| !seen.contains(state)).collect();
    let transposed = left.transposed();
    let shares = transposed.rows_of(&seen).transposed().solve(&transposed.rows_of(&others).transposed());
    let mut basis = Dense::zeros(states, others.len());
    for (column, state) in others.iter().enumerate() {
        basis.column_mut(column)[*state] = 1.0;
        for (row, dependent) in seen.iter().enumerate() {
            basis.column_mut(column)[*dependent] = -shares.at(row, column);
        }
    }
    let mut moved = b.clone();
    let common = right.product(&fixed.b);
    moved.values.iter_mut().zip(&common.values).for_each(|(own, common)| *own -= common);
    let rest = StateSpace {
        a: a.rows_of(&others).product(&basis),
        b: moved.rows_of(&others),
        c: c.product(&basis),
        d: d.clone(),
    };
    Ok((fixed, held, rest))
}

/// The rows that tell the columns of `matrix` best, ascending.
pub fn pivots(matrix: &Dense) -> Vec<usize> {
    let mut rows = PivotedQr::new(matrix.transposed(), 0.0).order[..matrix.columns].to_vec();
    rows.sort_unstable();
    rows
}
