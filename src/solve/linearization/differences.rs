//! Derivatives that have no closed form: of rotary inertia that follows the sections, and of the rates of constraints.
//! Both follow the coordinates gently, without the stiffness of beams, so that differences of fourth order with these
//! steps leave out about 1e-12 of them.

use super::base::Base;
use crate::math::blocks::{Block, Blocks};
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::variation::Variation;
use crate::solve::sensitivity::STENCIL;

/// Largest change of a slope or an angle; of a position over the shortest element.
const REACH: f64 = 1e-3;
/// Nodes of a beam so far apart have no element in common.
const APART: usize = 3;

/// The length that changes of positions are compared with: that of the shortest element, m.
pub(super) fn shortest(system: &System) -> f64 {
    let lengths = system.mesh.elements.iter().map(|element| element.length());
    lengths.fold(system.size, f64::min)
}

/// Evaluates functions of a state along changes of it.
struct Mover<'a> {
    system: &'a System,
    base: &'a Base,
    change: Variation,
    moved: State,
    frames: FrameCache,
}

impl<'a> Mover<'a> {
    fn new(system: &'a System, base: &'a Base) -> Self {
        let mut change = Variation::default();
        change.set_zero(&base.state);
        Self { system, base, change, moved: State::default(), frames: FrameCache::default() }
    }

    /// Sets `sum` to the derivative of `function` along [`Self::change`], by differences of the step `unit`.
    fn along(
        &mut self,
        unit: f64,
        sum: &mut [f64],
        mut function: impl FnMut(&System, &Configuration, &State, &mut [f64]),
    ) {
        let Self { system, base, change, moved, frames } = self;
        let mut values = vec![0.0; sum.len()];
        sum.fill(0.0);
        for (offset, weight) in STENCIL {
            moved.clone_from(&base.state);
            change.apply(system, offset * unit, moved, frames);
            function(system, &frames.of(system, moved), moved, &mut values);
            sum.iter_mut().zip(&values).for_each(|(sum, value)| *sum += weight / unit * value);
        }
    }
}

/// Adds the derivatives to `by_q`, `by_velocity` and the rates of constraints to `rates_by_q`.
pub(super) fn push(system: &System, base: &Base, [by_q, by_velocity, rates_by_q]: [&mut Blocks; 3]) {
    let mut mover = Mover::new(system, base);
    if system.has_following_inertia() {
        push_inertia(&mut mover, by_q, by_velocity);
    }
    push_constraints(&mut mover, by_q, by_velocity, rates_by_q);
}

/// The derivatives of the forces of inertia: of nodes that have no element in common at once.
fn push_inertia(mover: &mut Mover, by_q: &mut Blocks, by_velocity: &mut Blocks) {
    let (system, base) = (mover.system, mover.base);
    let mut sum = vec![0.0; system.coordinates()];
    let longest = system.mesh.nodes.iter().map(|node| node.coordinates().len()).max().unwrap_or(0);
    for color in 0..APART {
        for local in 0..longest {
            let nodes = system.mesh.nodes.iter().enumerate().skip(color).step_by(APART);
            let nodes = nodes.filter(|(_, node)| local < node.coordinates().len());
            let columns: Vec<(usize, usize)> =
                nodes.map(|(number, node)| (number, node.coordinates().start + local)).collect();
            // A mass matrix that follows the sections does not depend on where they are.
            if columns.iter().any(|(_, column)| !system.is_place(*column)) {
                columns.iter().for_each(|(_, column)| mover.change.lists.q[*column] = 1.0);
                mover.along(REACH, &mut sum, |system, c, state, forces| {
                    system.inertia_forces(c, &state.velocity, &base.response.acceleration, forces);
                });
                columns.iter().for_each(|(_, column)| mover.change.lists.q[*column] = 0.0);
                columns.iter().for_each(|own| push_column(system, by_q, *own, &sum));
            }
            columns.iter().for_each(|(_, column)| mover.change.lists.velocity[*column] = 1.0);
            // Quadratic in the velocities: any step will do.
            mover.along(1.0, &mut sum, |system, c, state, forces| system.rotary_forces(c, &state.velocity, forces));
            columns.iter().for_each(|(_, column)| mover.change.lists.velocity[*column] = 0.0);
            columns.iter().for_each(|own| push_column(system, by_velocity, *own, &sum));
        }
    }
}

/// Appends minus the part of `sum` at node `number` and its neighbors as the column `column`.
fn push_column(system: &System, blocks: &mut Blocks, (number, column): (usize, usize), sum: &[f64]) {
    let nodes = &system.mesh.nodes;
    let first = nodes[number.saturating_sub(1)].coordinates().start;
    let rows = first..nodes[(number + 1).min(nodes.len() - 1)].coordinates().end;
    let number = blocks.push(Block { row: rows.start, column, rows: rows.len(), columns: 1 });
    blocks.block_mut(number).iter_mut().zip(&sum[rows]).for_each(|(own, value)| *own = -value);
}

/// The derivatives of `−(γ + G a)` with respect to the coordinates and velocities, and of `G v + g_t` with respect to
/// the coordinates.
fn push_constraints(mover: &mut Mover, by_q: &mut Blocks, by_velocity: &mut Blocks, rates_by_q: &mut Blocks) {
    let (system, base) = (mover.system, mover.base);
    let (first, conditions) = (system.coordinates(), system.constraints());
    let length = shortest(system);
    let mut seen = vec![false; first];
    let sides = system.joints.iter().flat_map(|joint| [&joint.a, &joint.b]);
    sides.for_each(|side| seen[side.coordinates(&system.mesh)].fill(true));
    let column = |blocks: &mut Blocks, row: usize, column: usize, values: &[f64]| {
        let number = blocks.push(Block { row, column, rows: values.len(), columns: 1 });
        blocks.block_mut(number).copy_from_slice(values);
    };
    let (mut both, mut gradients) = (vec![0.0; 2 * conditions], Vec::new());
    for index in (0..first).filter(|index| seen[*index]) {
        let unit = if system.is_place(index) { REACH * length } else { REACH };
        mover.change.lists.q[index] = 1.0;
        mover.along(unit, &mut both, |system, c, state, both| {
            let (accelerations, rates) = both.split_at_mut(conditions);
            system.constraint_gradients(c, &mut gradients);
            set_accelerations(system, c, state, &base.response.acceleration, &gradients, accelerations);
            system.constraint_rates(c, rates);
            system.add_constraint_rates(&gradients, &state.velocity, rates);
        });
        mover.change.lists.q[index] = 0.0;
        let (accelerations, rates) = both.split_at(conditions);
        column(by_q, first, index, accelerations);
        column(rates_by_q, 0, index, rates);
        mover.change.lists.velocity[index] = 1.0;
        let own = &mut both[..conditions];
        // Quadratic in the velocities.
        mover.along(1.0, own, |system, c, state, accelerations| {
            system.constraint_accelerations(c, &state.velocity, accelerations);
            accelerations.iter_mut().for_each(|value| *value = -*value);
        });
        mover.change.lists.velocity[index] = 0.0;
        column(by_velocity, first, index, own);
    }
}

/// `−(γ + G a)`.
fn set_accelerations(
    system: &System,
    c: &Configuration,
    state: &State,
    acceleration: &[f64],
    gradients: &[JointGradient],
    target: &mut [f64],
) {
    system.constraint_accelerations(c, &state.velocity, target);
    system.add_constraint_rates(gradients, acceleration, target);
    target.iter_mut().for_each(|value| *value = -*value);
}
