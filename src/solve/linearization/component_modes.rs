//! Linear systems with fewer states by component mode synthesis (Craig and Bampton 1968).
//!
//! Independent coordinates obey `M ξ'' + D ξ' + K ξ = F u`. Motions that inputs prescribe, `z`, move them by the
//! static response `Ψ z`, and `ξ = Ψ z + V p`. The columns of `V` are the motions without stiffness, the softest
//! vibrations `φ` with all prescribed motions held, and the static responses to all inputs that these lack. Galerkin's
//! projection `Vᵀ M V`, `Vᵀ D V`, `Vᵀ K V` keeps symmetric matrices symmetric and positive ones positive: what is
//! stable stays so. All coordinates but those of motions without stiffness have a mass of 1.
//!
//! The static response to a prescribed acceleration is that to the inertia forces of `Ψ`, and that to a rate the one to
//! its damping forces: the terms `1/s²`, `1/s` and 1 of each response about `s = 0` are exact.

use super::modal::{Modes, norm, pairs};
use super::second_order::{Rounded, SecondOrder, cleaned};
use super::split::{Origin, Refusal, Whole, pivots, split};
use super::state_space::StateSpace;
use super::truncation::{Size, Truncated, grid, units};
use crate::solve::linear::Singular;
use crate::solve::linear::dense::{Complex, Dense};
use crate::solve::modes::subspace::dot;

/// Largest part of the stiffness that is not symmetric, over the stiffness of the modes: what Newton leaves of forces
/// makes 3e-5 for a crane. The motion of such a part grows less than a damping ratio of half of it fades.
const SYMMETRIC: f64 = 1e-4;
/// Strain energy of a static response, over its own, below which the other vectors have it already.
const FOLLOWS: f64 = 1e-14;
/// A mode whose static responses are below this share of those of the largest one is none of the inputs and outputs.
const SILENT: f64 = 1e-9;
/// Poles that differ by less than this share are the same.
const SAME: f64 = 1e-6;
/// Factor by which the shift of the stiffness is raised, and how often at most.
const RAISE: f64 = 16.0;
const MOST_SHIFTS: usize = 60;

/// Reduces `whole`, whose independent coordinates have the equations `own`.
///
/// # Errors
/// The stiffness is not symmetric, eigenvalues do not converge, or more states are kept than are wanted.
pub fn reduce(whole: &Whole, own: &SecondOrder, size: Size) -> Result<Truncated, Refusal> {
    let equations = Equations::new(whole, own)?;
    let relative = equations.relative(whole);
    let scale = Scale::new(&relative)?;
    let first = equations.kept(&scale.lasting);
    let order = equations.order(&first, &whole.matrices.c, &scale.units);
    let build = |count: usize| {
        let chosen: Vec<usize> = first.iter().chain(&order[..count]).copied().collect();
        equations.project(whole, &chosen)
    };
    let (mut count, mut found) = (0, build(0)?);
    let least = found.origins.len();
    match size {
        Size::Order(wanted) if wanted < least => return Err(Refusal::Held(least)),
        Size::Order(wanted) => {
            // Modes may have static responses that are no states then.
            while count < order.len() && found.origins.len() + 2 <= wanted {
                count = order.len().min(count + (wanted - found.origins.len()) / 2);
                found = build(count)?;
            }
            found.error = scale.error(whole, &found.matrices)?;
        }
        Size::Error(wanted) => loop {
            found.error = scale.error(whole, &found.matrices)?;
            if found.error <= wanted || count == order.len() {
                break;
            }
            count += 1;
            found = build(count)?;
        },
    }
    found.kept = whole.zeros + scale.lasting.len();
    Ok(found)
}

/// The scale of errors: the fading part of the whole system, and the units of its outputs and inputs.
struct Scale {
    modes: Modes,
    grid: Vec<f64>,
    units: [Vec<f64>; 2],
    /// The poles of motions that do not fade.
    lasting: Vec<Complex>,
}

impl Scale {
    fn new(whole: &Whole) -> Result<Self, Refusal> {
        let [mut modes, lasting] = modes(whole)?;
        let units = units(&modes, &whole.matrices.d, &whole.kinds);
        modes.scale([&units[0], &units[1]]);
        Ok(Self { grid: grid(&modes.poles), modes, units, lasting: lasting.poles })
    }

    /// The largest difference of the responses. Poles that agree are the same: the round-off of one that hardly fades
    /// may be more than its damping.
    fn error(&self, whole: &Whole, matrices: &StateSpace) -> Result<f64, Refusal> {
        let Whole { zeros, slowest, integrators, kinds, .. } = whole;
        let (zeros, slowest, integrators, kinds) = (*zeros, *slowest, *integrators, kinds.clone());
        let [mut own, lasting] = modes(&Whole { matrices: matrices.clone(), zeros, slowest, integrators, kinds })?;
        let nearest = |pole: &Complex, others: &[Complex]| {
            let apart = |other: &Complex| (other - pole).norm();
            let others = others.iter().copied().filter(|other| apart(other) < SAME * pole.norm());
            others.min_by(|a, b| apart(a).total_cmp(&apart(b)))
        };
        if lasting.poles.len() != self.lasting.len() {
            return Ok(f64::INFINITY);
        }
        for pole in &mut own.poles {
            *pole = nearest(pole, &self.modes.poles).unwrap_or(*pole);
        }
        own.scale([&self.units[0], &self.units[1]]);
        let [outputs, inputs] = self.units.each_ref().map(Vec::len);
        let errors = self.grid.iter().map(|omega| {
            let [whole, small] = [&self.modes, &own].map(|modes| modes.response(*omega, outputs * inputs));
            norm(&whole.iter().zip(small).map(|(whole, small)| whole - small).collect::<Vec<_>>(), outputs)
        });
        Ok(errors.fold(0.0, f64::max))
    }
}

/// The modes that fade, and those that do not and whose poles are not 0.
fn modes(whole: &Whole) -> Result<[Modes; 2], Refusal> {
    let (_, _, rest) = split(whole)?;
    let found = rest.a.eigensystem()?;
    let (lasting, fading) = pairs(&found);
    Ok([fading, lasting].map(|own| Modes::new(&own, &rest.b, &rest.c)))
}

/// The equations of second order, and their vibrations with all prescribed motions held.
struct Equations {
    mass: Dense,
    stiffness: Dense,
    damping: Rounded,
    /// Motions without stiffness, in units of the coordinates `held`.
    rigid: Dense,
    held: Vec<usize>,
    /// Static responses to the values of prescribed motions.
    follows: Dense,
    /// Forces by values and rates of prescribed motions that [`Self::follows`] leaves, and by inputs.
    values: Dense,
    rates: Dense,
    inputs: Dense,
    /// Static responses to these, and to the damping of the motions without stiffness.
    responses: Dense,
    /// Squares of frequencies, and shapes with a mass of 1.
    squares: Vec<f64>,
    shapes: Dense,
}

impl Equations {
    fn new(whole: &Whole, SecondOrder { mass, stiffness, damping }: &SecondOrder) -> Result<Self, Refusal> {
        let StateSpace { a, b, .. } = &whole.matrices;
        let free = mass.rows;
        let own: Vec<usize> = (free..2 * free).collect();
        let accelerations = a.rows_of(&own);
        let forces =
            |columns: &mut dyn Iterator<Item = usize>| Rounded::product(mass, &accelerations.columns_at(columns));
        let conservative = stiffness.value.symmetric_part();
        let (squares, shapes) = vibrations(&conservative, mass, whole.slowest)?;
        let count = still(&squares, &shapes, damping, whole.zeros - whole.integrators);
        let rigid = shapes.columns_at(0..count);
        let momenta = mass.product(&rigid);
        // Motions without stiffness take their share of a force by their acceleration; they are given a stiffness.
        let stiff = momenta.product(&momenta.transposed());
        let scale = squares.get(count).copied().unwrap_or(1.0).abs();
        let mut held = conservative;
        held.values.iter_mut().zip(&stiff.values).for_each(|(own, stiff)| *own += scale * stiff);
        let solve = |forces: &Dense| {
            let taken = momenta.product(&rigid.transposed().product(forces));
            solution(&held, forces.clone().minus(&taken))
        };
        let motions = whole.integrators / 2;
        let by = |order: usize| forces(&mut (0..motions).map(|motion| 2 * (free + motion) + order));
        let follows = solve(&by(0).value);
        // The input of a prescribed motion is its acceleration: the column with 1 in the row of its rate.
        let moved = b.rows_of(&(0..motions).map(|motion| 2 * (free + motion) + 1).collect::<Vec<_>>());
        let inputs = Rounded::product(mass, &b.rows_of(&own));
        let inputs = inputs.plus(-1.0, &Rounded::new(mass.clone()), &follows.product(&moved)).forces(&held);
        let values = by(0).plus(-1.0, stiffness, &follows).forces(&held);
        let rates = by(1).plus(-1.0, damping, &follows).forces(&held);
        let dragged = Rounded::new(Dense::zeros(free, count)).plus(-1.0, damping, &rigid).forces(&held);
        let responses = solve(&inputs.clone().beside(&rates).beside(&dragged));
        let (rigid, held) = in_coordinates(&rigid);
        let shapes = shapes.columns_at(count..squares.len());
        let (mass, stiffness, damping) = (mass.clone(), stiffness.value.clone(), damping.clone());
        let squares = squares[count..].to_vec();
        Ok(Self { mass, stiffness, damping, rigid, held, follows, values, rates, inputs, responses, squares, shapes })
    }

    /// The whole system with coordinates relative to [`Self::follows`]: its poles at 0 of prescribed motions stand
    /// alone, and no round-off of stiff parts enters the responses that errors are measured by.
    fn relative(&self, whole: &Whole) -> Whole {
        let mut own = whole.clone();
        let (free, motions) = (self.mass.rows, whole.integrators / 2);
        let forces = self.values.clone().beside(&self.rates).beside(&self.inputs);
        let forces = self.mass.solve(&forces);
        let rows = free..2 * free;
        for motion in 0..motions {
            for order in 0..2 {
                let target = own.matrices.a.column_mut(2 * (free + motion) + order);
                target[rows.clone()].copy_from_slice(forces.column(order * motions + motion));
            }
        }
        for input in 0..self.inputs.columns {
            own.matrices.b.column_mut(input)[rows.clone()].copy_from_slice(forces.column(2 * motions + input));
        }
        own.matrices.c = whole.matrices.c.columns_at(0..2 * free).beside(&self.outputs_of_motions(whole));
        own
    }

    /// The columns of `C` of values and rates of prescribed motions, with what follows them.
    fn outputs_of_motions(&self, whole: &Whole) -> Dense {
        let (c, free) = (&whole.matrices.c, self.mass.rows);
        let mut own = Dense { rows: c.rows, ..Dense::default() };
        for state in 0..whole.integrators {
            let first = free * (state % 2);
            let part = Rounded::new(c.columns_at(first..first + free));
            let given = Rounded::new(c.columns_at([2 * free + state]));
            own = own.beside(&given.plus(1.0, &part, &self.follows.columns_at([state / 2])).clean());
        }
        own
    }

    /// The vibrations that do not fade, by their poles: each the nearest one of those that are left.
    fn kept(&self, lasting: &[Complex]) -> Vec<usize> {
        let mut kept: Vec<usize> = (0..self.squares.len()).filter(|own| self.squares[*own] < 0.0).collect();
        for pole in lasting.iter().filter(|pole| pole.im > 0.0) {
            let apart = |own: &usize| (self.squares[*own] - pole.norm_sqr()).abs();
            let others = (0..self.squares.len()).filter(|own| !kept.contains(own));
            kept.extend(others.min_by(|a, b| apart(a).total_cmp(&apart(b))));
        }
        kept
    }

    /// The vibrations besides `first`, the softest ones first; those that no input moves or no output sees come last.
    fn order(&self, first: &[usize], c: &Dense, [outputs, inputs]: &[Vec<f64>; 2]) -> Vec<usize> {
        let seen = c.columns_at(0..self.mass.rows).product(&self.shapes);
        let moved = self.shapes.transposed().product(&self.inputs);
        let share = |own: usize| {
            let seen = seen.column(own).iter().zip(outputs).map(|(value, unit)| (value / unit).abs());
            let moved = (0..moved.columns).map(|input| (moved.at(own, input) * inputs[input]).abs());
            seen.fold(0.0, f64::max) * moved.fold(0.0, f64::max) / self.squares[own].abs()
        };
        let shares: Vec<f64> = (0..self.squares.len()).map(share).collect();
        let largest = shares.iter().copied().fold(0.0, f64::max);
        let others = (0..shares.len()).filter(|own| !first.contains(own));
        let (mut heard, silent): (Vec<usize>, Vec<usize>) = others.partition(|own| shares[*own] > SILENT * largest);
        heard.extend(silent);
        heard
    }

    /// The system in the vibrations `chosen`.
    fn project(&self, whole: &Whole, chosen: &[usize]) -> Result<Truncated, Refusal> {
        let StateSpace { b, d, .. } = &whole.matrices;
        let (free, integrators) = (self.mass.rows, whole.integrators);
        let modes = self.shapes.columns_at(chosen.iter().copied());
        let statics = self.lacking(&modes);
        let basis = self.rigid.clone().beside(&modes).beside(&statics);
        let count = basis.columns;
        let across = basis.transposed();
        let mut masses = Dense::zeros(count, count);
        (0..count).for_each(|own| masses.column_mut(own)[own] = 1.0);
        let own = self.rigid.transposed().product(&self.mass.product(&self.rigid));
        (0..own.columns).for_each(|column| masses.column_mut(column)[..own.rows].copy_from_slice(own.column(column)));
        let stiffness = self.symmetric_stiffness(&across.product(&self.stiffness.product(&basis)))?;
        let damping = self.projected_damping(&basis);
        let held = Dense::zeros(count, 2 * count).minus(&stiffness.beside(&damping));
        let given = (0..integrators / 2).flat_map(|motion| [(&self.values, motion), (&self.rates, motion)]);
        let given = given.map(|(forces, motion)| forces.column(motion)).collect::<Vec<_>>().concat();
        let given = Dense { rows: free, columns: integrators, values: given };
        let forces = masses.solve(&held.beside(&across.product(&given.beside(&self.inputs))));
        let states = 2 * count + integrators;
        let (mut a, mut own_b) = (Dense::zeros(states, states), Dense::zeros(states, b.columns));
        for state in 0..states {
            a.column_mut(state)[count..2 * count].copy_from_slice(forces.column(state));
        }
        (0..count).for_each(|own| a.column_mut(count + own)[own] = 1.0);
        (2 * count..states).step_by(2).for_each(|value| a.column_mut(value + 1)[value] = 1.0);
        for input in 0..b.columns {
            let target = own_b.column_mut(input);
            target[count..2 * count].copy_from_slice(forces.column(states + input));
            target[2 * count..].copy_from_slice(&b.column(input)[2 * free..]);
        }
        let many = std::iter::repeat_n::<Origin>;
        let held = |first: usize| self.held.iter().map(move |own| Origin::State(first + own));
        let values = held(0).chain(many(Origin::Mode, modes.columns)).chain(many(Origin::Static, statics.columns));
        let rates = held(free).chain(many(Origin::ModeRate, modes.columns));
        let rates = rates.chain(many(Origin::StaticRate, statics.columns));
        let origins = values.chain(rates).chain((2 * free..2 * free + integrators).map(Origin::State)).collect();
        let matrices = StateSpace { a, b: own_b, c: self.outputs(whole, &basis), d: d.clone() };
        Ok(Truncated { matrices, origins, kept: 0, bound: None, error: 0.0 })
    }

    /// `C` in the coordinates of `basis` and in values and rates of prescribed motions.
    fn outputs(&self, whole: &Whole, basis: &Dense) -> Dense {
        let (c, free) = (&whole.matrices.c, self.mass.rows);
        let parts = [c.columns_at(0..free), c.columns_at(free..2 * free)];
        let mut own = Dense { rows: c.rows, ..Dense::default() };
        for part in &parts {
            // Differences along motions without stiffness may leave round-off, such as accelerations.
            let none = Rounded::new(Dense::zeros(c.rows, self.rigid.columns));
            let rigid = none.plus(1.0, &Rounded::new(part.clone()), &self.rigid).clean();
            own = own.beside(&rigid).beside(&part.product(&basis.columns_at(self.rigid.columns..basis.columns)));
        }
        own.beside(&self.outputs_of_motions(whole))
    }

    /// The damping of a basis, in which motions without stiffness have no round-off.
    fn projected_damping(&self, basis: &Dense) -> Dense {
        let project = |matrix: &Dense, basis: &Dense| basis.transposed().product(&matrix.product(basis));
        let mut own = project(&self.damping.value, basis);
        let sizes = project(&self.damping.size, &basis.sizes());
        for column in 0..own.columns {
            let rows = if column < self.rigid.columns { own.rows } else { self.rigid.columns };
            for row in 0..rows {
                let value = &mut own.column_mut(column)[row];
                *value = cleaned(*value, sizes.at(row, column));
            }
        }
        own
    }

    /// The symmetric part of the stiffness of a basis, 0 for the motions without stiffness.
    fn symmetric_stiffness(&self, projected: &Dense) -> Result<Dense, Refusal> {
        let rigid = self.rigid.columns;
        let mut own = projected.symmetric_part();
        let mut largest = 0.0_f64;
        for column in 0..own.columns {
            for row in 0..own.rows {
                if row < rigid || column < rigid {
                    own.column_mut(column)[row] = 0.0;
                    continue;
                }
                let size = (projected.at(row, row) * projected.at(column, column)).abs().sqrt();
                largest = largest.max((projected.at(row, column) - projected.at(column, row)).abs() / size);
            }
        }
        if largest <= SYMMETRIC { Ok(own) } else { Err(Refusal::Asymmetric(largest)) }
    }

    /// The part of the static responses besides `modes`, orthogonal and with a mass of 1.
    fn lacking(&self, modes: &Dense) -> Dense {
        let mut found: Vec<Vec<f64>> = Vec::new();
        let energy = |shape: &[f64]| dot(shape, &self.stiffness.times(shape)).abs();
        for number in 0..self.responses.columns {
            let mut own = self.responses.column(number).to_vec();
            let whole = energy(&own);
            for _ in 0..2 {
                let momentum = self.mass.times(&own);
                let others = (0..modes.columns).map(|mode| modes.column(mode)).chain(found.iter().map(Vec::as_slice));
                let shares: Vec<(f64, &[f64])> = others.map(|other| (dot(other, &momentum), other)).collect();
                for (share, other) in shares {
                    own.iter_mut().zip(other).for_each(|(own, other)| *own -= share * other);
                }
            }
            let mass = dot(&own, &self.mass.times(&own));
            if energy(&own) > FOLLOWS * whole && mass > 0.0 {
                own.iter_mut().for_each(|value| *value /= mass.sqrt());
                found.push(own);
            }
        }
        Dense { rows: self.mass.rows, columns: found.len(), values: found.concat() }
    }
}

/// Vibrations with the stiffness as it is, by rising sizes of the squares of their frequencies.
fn vibrations(stiffness: &Dense, mass: &Dense, slowest: f64) -> Result<(Vec<f64>, Dense), Refusal> {
    let mut shift = slowest * slowest;
    for _ in 0..MOST_SHIFTS {
        match stiffness.vibrations(mass, shift) {
            Ok((squares, shapes)) => {
                let mut order: Vec<usize> = (0..squares.len()).collect();
                order.sort_by(|a, b| squares[*a].abs().total_cmp(&squares[*b].abs()));
                return Ok((order.iter().map(|own| squares[*own]).collect(), shapes.columns_at(order)));
            }
            Err(Singular) => shift *= RAISE,
        }
    }
    Err(Refusal::NotFound)
}

/// How many of the softest vibrations have no stiffness: two of the `poles` at 0 of each, one where it is damped.
fn still(squares: &[f64], shapes: &Dense, damping: &Rounded, poles: usize) -> usize {
    let is_damped = |own: &usize| {
        let shape = shapes.column(*own);
        let size: Vec<f64> = shape.iter().map(|value| value.abs()).collect();
        cleaned(dot(shape, &damping.value.times(shape)), dot(&size, &damping.size.times(&size))) != 0.0
    };
    let fits = |count: &usize| 2 * count == poles + (0..*count).filter(is_damped).count();
    (poles.div_ceil(2)..=poles.min(squares.len())).find(fits).unwrap_or(poles.div_ceil(2))
}

/// `matrix⁻¹ right`, in coordinates of like stiffness.
fn solution(matrix: &Dense, mut right: Dense) -> Dense {
    let scales: Vec<f64> = (0..matrix.rows).map(|own| matrix.at(own, own).abs().sqrt().recip()).collect();
    let scales: Vec<f64> = scales.iter().map(|scale| if scale.is_finite() { *scale } else { 1.0 }).collect();
    let mut scaled = matrix.clone();
    for (column, scale) in scales.iter().enumerate() {
        scaled.column_mut(column).iter_mut().zip(&scales).for_each(|(value, own)| *value *= scale * own);
    }
    let scale = |own: &mut Dense| {
        for column in 0..own.columns {
            own.column_mut(column).iter_mut().zip(&scales).for_each(|(value, scale)| *value *= scale);
        }
    };
    scale(&mut right);
    let mut found = scaled.solve(&right);
    scale(&mut found);
    found
}

/// The same motions in units of as many coordinates, with these.
fn in_coordinates(motions: &Dense) -> (Dense, Vec<usize>) {
    if motions.columns == 0 {
        return (motions.clone(), Vec::new());
    }
    let held = pivots(motions);
    (motions.rows_of(&held).transposed().solve(&motions.transposed()).transposed(), held)
}
