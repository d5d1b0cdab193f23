//! Linear systems with fewer states: balanced truncation, whose error has a bound, and truncation of modes with static
//! correction.
//!
//! Poles at 0, and poles that do not fade, have no Gramians. They are split off first and kept as they are; the stable
//! rest is reduced. `‖G − G_r‖∞ ≤ 2 Σ σ` over the Hankel singular values that are left out (Enns 1984, Glover 1984).
//! Balanced matrices know the damping of a mode up to the round-off of the stiffest one. Modes that hardly fade, and
//! count, are therefore kept as they are too.
//! Outputs and inputs are measured by the responses to sudden changes, so that neither units matter nor how high the
//! peaks of vibrations are that hardly fade: a small share of such a peak may be far more than what motions show.

use super::gramian::{factor, real};
use super::modal::{Modes, norm, pairs};
use super::split::{Origin, Refusal, Whole, split};
use super::state_space::StateSpace;
use crate::math::elementary::{exp, ln};
use crate::solve::linear::dense::{Complex, Dense};

/// An output whose response is below this share of that of another one with the same unit has none.
const SILENT: f64 = 1e-9;
/// A mode with a smaller damping ratio hardly fades.
const LIGHT: f64 = 1e-3;
/// Frequencies at which responses are compared, besides those of the poles.
const GRID: usize = 400;
/// Factor by which they reach beyond the least and the largest pole.
const BEYOND: f64 = 100.0;

/// How states are left out here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Those that inputs move and outputs see least.
    Balanced,
    /// Modes with the smallest peaks, whose static responses stay.
    Modal,
}

/// How many states stay.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Size {
    /// The fewest that keep this error, as a share of the response to a sudden change of an input.
    Error(f64),
    /// So many, those included that are always kept.
    Order(usize),
}

/// A reduced system.
#[derive(Clone, Debug)]
pub struct Truncated {
    /// The matrices.
    pub matrices: StateSpace,
    /// The origin of each state.
    pub origins: Vec<Origin>,
    /// Number of states that are kept exactly: of poles that do not fade.
    pub kept: usize,
    /// The bound of the error at any frequency, over the response to a sudden change of an input; none: the method has
    /// none.
    pub bound: Option<f64>,
    /// The largest error that the responses show, over the same.
    pub error: f64,
}

/// Reduces `system`.
///
/// # Errors
/// Eigenvalues do not converge, or too many poles do not fade.
pub fn reduce(system: &Whole, size: Size, rule: Rule) -> Result<Truncated, Refusal> {
    let Whole { matrices: whole, kinds, .. } = system;
    let (fixed, origins, rest) = split(system)?;
    let found = rest.a.eigensystem()?;
    let (lasting, fading) = pairs(&found);
    let lasting = Modes::new(&lasting, &rest.b, &rest.c);
    let mut modes = Modes::new(&fading, &rest.b, &rest.c);
    let kept = fixed.a.rows + lasting.poles.len();
    if let Size::Order(order) = size
        && order < kept
    {
        return Err(Refusal::Kept(kept));
    }
    let grid = grid(&modes.poles);
    let units = units(&modes, &whole.d, kinds);
    modes.scale([&units[0], &units[1]]);
    let mut own_d = Dense::zeros(whole.d.rows, whole.d.columns);

    let (StateSpace { a, b, c, .. }, exact, bound, error) = match rule {
        Rule::Balanced => {
            let Balanced { matrices, exact, bound, error } = balance(&modes, size, kept, &grid)?;
            (matrices, exact, Some(bound), error)
        }
        Rule::Modal => {
            let (chosen, error, correction) = choose(&modes, size, kept, &grid);
            own_d = correction;
            (together(&[modes.real(&chosen)], &own_d), chosen.len(), None, error)
        }
    };
    let [outputs, inputs] = &units;
    let mut parts = vec![[fixed.a, fixed.b, fixed.c], lasting.real(&(0..lasting.poles.len()).collect::<Vec<_>>())];
    let mut own = [a, b, c];
    for (input, unit) in inputs.iter().enumerate() {
        own[1].column_mut(input).iter_mut().for_each(|value| *value /= unit);
        own_d.column_mut(input).iter_mut().for_each(|value| *value /= unit);
    }
    for values in [&mut own[2].values, &mut own_d.values] {
        values.iter_mut().zip(outputs.iter().cycle()).for_each(|(value, unit)| *value *= unit);
    }
    own_d.values.iter_mut().zip(&whole.d.values).for_each(|(own, whole)| *own += whole);
    let mut all = origins;
    all.extend(vec![Origin::Mode; lasting.poles.len() + exact]);
    all.extend(vec![Origin::Balanced; own[0].rows - exact]);
    parts.push(own);
    let kept = if bound.is_some() { kept + exact } else { kept };
    Ok(Truncated { matrices: together(&parts, &own_d), origins: all, kept, bound, error })
}

/// Frequencies at which responses are compared, rad/s.
pub(super) fn grid(poles: &[Complex]) -> Vec<f64> {
    let sizes = || poles.iter().map(|pole| pole.norm());
    let (least, largest) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    if largest == 0.0 {
        return vec![0.0];
    }
    let [from, to] = [ln(least / BEYOND), ln(largest * BEYOND)];
    let mut grid: Vec<f64> =
        (0..GRID).map(|number| exp(from + (to - from) * number as f64 / (GRID - 1) as f64)).collect();
    grid.push(0.0);
    grid.extend(poles.iter().map(|pole| pole.im).filter(|swing| *swing > 0.0));
    grid
}

/// The responses of outputs to sudden changes of inputs, and then of inputs in these: what both are measured in. Such a
/// response is at most the sum of what it moves each mode by, `|C x| |yᵀ B| / |λ|`, and at most twice that for a time.
pub(super) fn units(modes: &Modes, d: &Dense, kinds: &[usize]) -> [Vec<f64>; 2] {
    let mut largest = Dense::zeros(d.rows, d.columns);
    largest.values.iter_mut().zip(&d.values).for_each(|(own, d)| *own = d.abs());
    for ((pole, seen), moved) in modes.poles.iter().zip(&modes.seen).zip(&modes.moved) {
        for (column, moved) in moved.iter().enumerate() {
            let parts = seen.iter().map(|seen| (seen * moved / pole).norm());
            largest.column_mut(column).iter_mut().zip(parts).for_each(|(own, part)| *own += part);
        }
    }
    let or_one = |value: f64| if value > 0.0 { value } else { 1.0 };
    let own = |row: usize| (0..d.columns).map(|column| largest.at(row, column)).fold(0.0, f64::max);
    let outputs: Vec<f64> = (0..d.rows)
        .map(|row| {
            let alike = (0..d.rows).filter(|other| kinds[*other] == kinds[row]).map(own).fold(0.0, f64::max);
            or_one(if own(row) < SILENT * alike { alike } else { own(row) })
        })
        .collect();
    let inputs = (0..d.columns).map(|column| {
        let own = largest.column(column).iter().zip(&outputs).map(|(value, unit)| value / unit);
        1.0 / or_one(own.fold(0.0, f64::max))
    });
    let inputs = inputs.collect();
    [outputs, inputs]
}

/// The factors of both Gramians, and the Hankel singular values with their vectors.
struct Hankel {
    reachable: Dense,
    observable: Dense,
    u: Dense,
    singular: Vec<f64>,
    v: Dense,
}

impl Hankel {
    fn new(modes: &Modes) -> Result<Self, Refusal> {
        let partners: Vec<usize> = (0..modes.poles.len()).map(|number| modes.partner(number)).collect();
        let conjugate = |values: &[Complex]| values.iter().map(Complex::conj).collect::<Vec<_>>();
        let reachable = real(&factor(&modes.poles, &modes.moved), &modes.poles, &partners);
        let seen: Vec<Vec<Complex>> = modes.seen.iter().map(|own| conjugate(own)).collect();
        let observable = real(&factor(&conjugate(&modes.poles), &seen), &modes.poles, &partners);
        let is_empty = reachable.columns == 0 || observable.columns == 0;
        let (u, singular, v) = match is_empty {
            true => (Dense::zeros(0, 0), Vec::new(), Dense::zeros(0, 0)),
            false => observable.transposed().product(&reachable).singular()?,
        };
        Ok(Self { reachable, observable, u, singular, v })
    }

    /// The number of states that stay beside `kept` ones, and the bound of the error.
    fn order(&self, size: Size, kept: usize) -> (usize, f64) {
        // Sums from the end on: of each order the bound.
        let mut bounds = vec![0.0; self.singular.len() + 1];
        for order in (0..self.singular.len()).rev() {
            bounds[order] = bounds[order + 1] + 2.0 * self.singular[order];
        }
        let most = self.singular.iter().filter(|own| **own > f64::EPSILON * self.singular[0]).count();
        let order = match size {
            Size::Order(order) => (order - kept).min(most),
            Size::Error(error) => bounds.iter().position(|bound| *bound <= error).unwrap_or(most).min(most),
        };
        (order, bounds[order])
    }

    /// Matrices that take states to the first `order` balanced ones, and back. States are measured by `scale`.
    fn projection(&self, order: usize, scale: f64) -> [Dense; 2] {
        let count = self.reachable.rows;
        let (mut left, mut right) = (Dense::zeros(count, order), Dense::zeros(count, order));
        for (own, singular) in self.singular.iter().enumerate().take(order) {
            let root = singular.sqrt();
            let parts = [
                (&mut right, self.reachable.times(self.v.column(own)), scale / root),
                (&mut left, self.observable.times(self.u.column(own)), 1.0 / (root * scale)),
            ];
            for (target, values, factor) in parts {
                target.column_mut(own).iter_mut().zip(values).for_each(|(target, value)| *target = value * factor);
            }
        }
        [left.transposed(), right]
    }
}

/// A system by balanced truncation.
struct Balanced {
    /// Its matrices; `D` is 0.
    matrices: StateSpace,
    /// Number of its first states, which are coordinates of modes.
    exact: usize,
    /// The bound of the error.
    bound: f64,
    /// The largest error that responses show.
    error: f64,
}

/// Balanced truncation. Modes that hardly fade stay as they are if the states that are left out count less.
fn balance(modes: &Modes, size: Size, kept: usize, grid: &[f64]) -> Result<Balanced, Refusal> {
    let whole = Hankel::new(modes)?;
    let (order, _) = whole.order(size, kept);
    let largest = whole.singular.first().copied().unwrap_or(1.0);
    let light = light(modes, whole.singular.get(order).copied().unwrap_or(0.0), order);
    let [mut exact, rest] = modes.divided(&light);
    // White noise of size 1 on an input moves the first state to 1/√2, however little it fades: numbers that users add
    // to covariances of states would otherwise have to follow the damping.
    let scale = (2.0 * largest).sqrt();
    exact.balance(scale);
    let hankel = if light.is_empty() { whole } else { Hankel::new(&rest)? };
    let (order, bound) = hankel.order(size, kept + light.len());
    let [left, right] = hankel.projection(order, scale);
    let [a, b, c] = rest.real(&(0..rest.poles.len()).collect::<Vec<_>>());
    let reduced = [left.product(&a).product(&right), left.product(&b), c.product(&right)];
    let own = reduced[0].eigensystem()?;
    let own = Modes::new(&own.iter().collect::<Vec<_>>(), &reduced[1], &reduced[2]);
    let (outputs, inputs) = (c.rows, b.columns);
    let errors = grid.iter().map(|omega| {
        let [whole, small] = [&rest, &own].map(|modes| modes.response(*omega, outputs * inputs));
        let lack: Vec<Complex> = whole.iter().zip(small).map(|(whole, small)| whole - small).collect();
        norm(&lack, outputs)
    });
    let error = errors.fold(0.0, f64::max);
    let parts = [exact.real(&(0..light.len()).collect::<Vec<_>>()), reduced];
    Ok(Balanced { matrices: together(&parts, &Dense::zeros(outputs, inputs)), exact: light.len(), bound, error })
}

/// Modes that hardly fade, and whose own Hankel singular values, half of their peaks, are above `limit`: at most `most`
/// of them, whole pairs, in their order.
fn light(modes: &Modes, limit: f64, most: usize) -> Vec<usize> {
    let is_light = |own: &usize| {
        let pole = modes.poles[*own];
        pole.im > 0.0 && -pole.re < LIGHT * pole.norm() && modes.height(*own) / 2.0 > limit
    };
    let mut found: Vec<usize> = (0..modes.poles.len()).filter(is_light).collect();
    found.sort_by(|a, b| modes.height(*b).total_cmp(&modes.height(*a)));
    found.truncate(most / 2);
    found.sort_unstable();
    found.into_iter().flat_map(|own| [own, modes.partner(own)]).collect()
}

/// The modes with the largest peaks, the error that responses show, and the static responses of the others.
fn choose(modes: &Modes, size: Size, kept: usize, grid: &[f64]) -> (Vec<usize>, f64, Dense) {
    let [outputs, inputs] = [&modes.seen, &modes.moved].map(|lists| lists.first().map_or(0, Vec::len));
    let mut order: Vec<usize> = (0..modes.poles.len()).filter(|own| modes.poles[*own].im >= 0.0).collect();
    order.sort_by(|a, b| modes.height(*b).total_cmp(&modes.height(*a)));
    let whole = |own: usize| if modes.partner(own) == own { vec![own] } else { vec![own, modes.partner(own)] };
    // The lacks with all modes left out.
    let mut lacks = vec![vec![Complex::from(0.0); outputs * inputs]; grid.len()];
    let add = |lacks: &mut Vec<Vec<Complex>>, own: usize, sign: f64| {
        for number in whole(own) {
            for (omega, lack) in grid.iter().zip(lacks.iter_mut()) {
                let mut part = vec![Complex::from(0.0); lack.len()];
                modes.add(number, *omega, true, &mut part);
                lack.iter_mut().zip(part).for_each(|(own, part)| *own += part * sign);
            }
        }
    };
    let error = |lacks: &[Vec<Complex>]| lacks.iter().map(|own| norm(own, outputs)).fold(0.0, f64::max);
    order.iter().for_each(|own| add(&mut lacks, *own, 1.0));
    let (mut chosen, mut found) = (Vec::new(), error(&lacks));
    for own in &order {
        let is_enough = match size {
            Size::Order(order) => kept + chosen.len() + whole(*own).len() > order,
            Size::Error(wanted) => found <= wanted,
        };
        if is_enough {
            break;
        }
        chosen.extend(whole(*own));
        add(&mut lacks, *own, -1.0);
        found = error(&lacks);
    }
    let mut correction = Dense::zeros(outputs, inputs);
    for number in (0..modes.poles.len()).filter(|number| !chosen.contains(number)) {
        for (input, moved) in modes.moved[number].iter().enumerate() {
            for (output, seen) in modes.seen[number].iter().enumerate() {
                correction.column_mut(input)[output] -= (seen * moved / modes.poles[number]).re;
            }
        }
    }
    (chosen, found, correction)
}

/// The system of independent parts, `A`, `B`, `C` each.
fn together(parts: &[[Dense; 3]], d: &Dense) -> StateSpace {
    let states = parts.iter().map(|[a, _, _]| a.rows).sum();
    let [mut a, mut b, mut c] =
        [Dense::zeros(states, states), Dense::zeros(states, d.columns), Dense::zeros(d.rows, states)];
    let mut first = 0;
    for [own_a, own_b, own_c] in parts {
        let count = own_a.rows;
        for column in 0..count {
            a.column_mut(first + column)[first..first + count].copy_from_slice(own_a.column(column));
            c.column_mut(first + column).copy_from_slice(own_c.column(column));
        }
        for column in 0..d.columns {
            b.column_mut(column)[first..first + count].copy_from_slice(own_b.column(column));
        }
        first += count;
    }
    StateSpace { a, b, c, d: d.clone() }
}
