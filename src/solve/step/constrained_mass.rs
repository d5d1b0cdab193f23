//! `[M Gᵀ; G 0][v; ν] = [f; g]` with the constant mass matrix `M`, by what conditions see of it: `S ν = G M⁻¹ f − g`
//! with `S = G M⁻¹ Gᵀ`, then `v = M⁻¹ (f − Gᵀ ν)`.
//!
//! `M⁻¹` is factorized once (mass_factor.rs), and what `S` needs of it is known then: how the coordinates that joints
//! hold on to follow forces on each other. `S` has a row a condition, however long the beams are. Nothing else is kept
//! from one system to the next.

use crate::math::blocks::Blocks;
use crate::mechanics::constraint::joint::{Joint, JointGradient, MOST_CONDITIONS};
use crate::mechanics::system::System;
use crate::solve::linear::cholesky::{Cholesky, dot};
use crate::solve::linear::mass_factor::MassFactor;
use crate::solve::linear::{BACKWARD_ERROR, Singular};
use std::ops::Range;

/// Most conditions: `S` is full, and its factorization grows with their third power. Bodies on ball joints at the tip
/// of a beam take fewer instructions a step than the general way with 51 conditions, more with 69.
pub const MOST_ROWS: usize = 60;

/// Share of the largest velocities that a motion of this energy may have, below which terms of a condition are taken as
/// round-off of other ones.
const SMALLEST_SHARE: f64 = 1e-3;

/// A column of `G`, or of what follows from it: of one joint.
type Column = [f64; MOST_CONDITIONS];

/// A coordinate that joints hold on to.
#[derive(Clone, Copy, Debug)]
struct Held {
    unknown: usize,
    /// The held coordinates of its chain along the same axis: the first one, and how many.
    first: usize,
    count: usize,
    /// Where its column of `M⁻¹` begins among the mobilities, and the root of its diagonal.
    mobility: usize,
    root: f64,
}

/// The conditions of a joint.
#[derive(Clone, Debug)]
struct Grip {
    rows: Range<usize>,
    /// The coordinates of both sides: [`ConstrainedMass::sides`].
    sides: [Range<usize>; 2],
    /// The joints before it, itself included, that hold on to the same chains.
    coupled: Vec<usize>,
}

impl Grip {
    /// Calls `column` with each column of `gradient` and its held coordinate.
    #[inline]
    fn each_column(&self, sides: &[usize], gradient: &JointGradient, mut column: impl FnMut(&Column, usize)) {
        for (range, matrix) in self.sides.iter().zip([&gradient.a, &gradient.b]) {
            let (columns, _) = matrix.as_slice().as_chunks::<MOST_CONDITIONS>();
            for (values, number) in columns.iter().zip(&sides[range.clone()]) {
                column(values, *number);
            }
        }
    }
}

/// The factors, and scratch memory.
#[derive(Debug)]
pub struct ConstrainedMass {
    mass: MassFactor,
    held: Vec<Held>,
    grips: Vec<Grip>,
    /// Held coordinates, side after side.
    sides: Vec<usize>,
    mobilities: Vec<f64>,
    /// `M⁻¹ Gᵀ`, of each held coordinate a column a joint.
    followers: Vec<Column>,
    schur: Cholesky,
    /// Held velocities without and with the conditions.
    free: Vec<f64>,
    moved: Vec<f64>,
    /// What the conditions lack, and their multipliers; the former is scratch memory of the factorization too.
    lacking: Vec<f64>,
    multipliers: Vec<f64>,
}

impl ConstrainedMass {
    /// For `system`, whose mass matrix is in `blocks`. None where there are too many conditions, or gears, or where
    /// something has no mass.
    pub fn new(system: &System, blocks: &Blocks) -> Option<Self> {
        let count = system.constraints();
        // The two sides of a gear would be two grips of one condition.
        if count > MOST_ROWS || system.joints.iter().any(Joint::shares_conditions) {
            return None;
        }
        let mass = MassFactor::new(system.coordinates(), blocks).ok()?;
        let ranges = |joint: &Joint| [joint.a.coordinates(&system.mesh), joint.b.coordinates(&system.mesh)];
        let mut is_held = vec![false; system.coordinates()];
        system.joints.iter().flat_map(ranges).for_each(|range| is_held[range].fill(true));
        let (mut held, mut mobilities, mut numbers) = (Vec::new(), Vec::new(), vec![0; system.coordinates()]);
        let mut unit = vec![0.0; system.coordinates()];
        for chain in &mass.chains {
            let own: Vec<usize> = chain.unknowns.iter().copied().filter(|unknown| is_held[*unknown]).collect();
            let begin = mobilities.len();
            for unknown in &own {
                unit[*unknown] = 1.0;
                chain.solve(&mut unit);
                mobilities.extend(own.iter().map(|other| unit[*other]));
                chain.unknowns.iter().for_each(|unknown| unit[*unknown] = 0.0);
            }
            for axis in 0..chain.width {
                let first = held.len();
                for (place, unknown) in own.iter().enumerate() {
                    let (unknown, mobility) = (unknown + axis, begin + place * own.len());
                    numbers[unknown] = held.len();
                    let root = mobilities[mobility + place].sqrt();
                    held.push(Held { unknown, first, count: own.len(), mobility, root });
                }
            }
        }
        let (mut grips, mut sides, mut row): (Vec<Grip>, Vec<usize>, usize) = (Vec::new(), Vec::new(), 0);
        for joint in &system.joints {
            let own = ranges(joint).map(|range| {
                let begin = sides.len();
                sides.extend(range.map(|unknown| numbers[unknown]));
                begin..sides.len()
            });
            grips.push(Grip { rows: row..row + joint.rows(), sides: own, coupled: Vec::new() });
            row += joint.rows();
        }
        // Of each chain and axis, by its first held coordinate, the joints that hold on to it.
        let mut holders: Vec<Vec<usize>> = vec![Vec::new(); held.len()];
        for (number, grip) in grips.iter_mut().enumerate() {
            for side in grip.sides.clone().into_iter().flatten() {
                holders[held[sides[side]].first].push(number);
            }
            let own = grip.sides.clone().into_iter().flatten();
            grip.coupled = own.flat_map(|side| &holders[held[sides[side]].first]).copied().collect();
            grip.coupled.sort_unstable();
            grip.coupled.dedup();
        }
        Some(Self {
            followers: vec![Column::default(); held.len() * grips.len()],
            free: vec![0.0; held.len()],
            moved: vec![0.0; held.len()],
            schur: Cholesky::new((0..count).map(|_| count - 1)),
            lacking: vec![0.0; count],
            multipliers: vec![0.0; count],
            mass,
            held,
            grips,
            sides,
            mobilities,
        })
    }

    /// Solves for the right-hand side `right` in place; `gradients` are those of the conditions, `vector` is scratch
    /// memory, as long as the coordinates.
    ///
    /// # Errors
    /// Conditions depend on each other, or nearly, or the solution is not accurate; `right` is as it was.
    pub fn solve(
        &mut self,
        system: &System,
        gradients: &[JointGradient],
        right: &mut [f64],
        vector: &mut [f64],
    ) -> Result<(), Singular> {
        self.set_schur(gradients);
        self.schur.factorize(&mut self.lacking)?;
        let (forces, conditions) = right.split_at_mut(vector.len());
        self.begin(forces, vector);
        // Twice the kinetic energy, without and then with the conditions.
        let free_square = dot(vector, forces);
        self.correct(gradients, conditions);
        self.move_held();
        // For the digits that the first correction cost.
        self.correct(gradients, conditions);
        vector.copy_from_slice(forces);
        self.add_reactions(system, gradients, vector);
        for (moved, held) in self.moved.iter_mut().zip(&self.held) {
            *moved = vector[held.unknown];
        }
        let square = dot(vector, forces) - dot(conditions, &self.multipliers);
        if !self.is_accurate(gradients, conditions, free_square.max(square)) {
            return Err(Singular);
        }
        forces.copy_from_slice(vector);
        conditions.copy_from_slice(&self.multipliers);
        Ok(())
    }

    /// Changes a solution of [`Self::solve`], with the same `gradients`, as forces change by `forces`: turns these into
    /// the change of the velocities, and adds that of the multipliers to `multipliers`. `vector` is scratch memory, as
    /// long as the coordinates.
    pub fn solve_change(
        &mut self,
        system: &System,
        gradients: &[JointGradient],
        forces: &mut [f64],
        multipliers: &mut [f64],
        vector: &mut [f64],
    ) {
        self.begin(forces, vector);
        // `G v` is to stay.
        self.correct_to(gradients, |_| 0.0);
        self.add_reactions(system, gradients, forces);
        multipliers.iter_mut().zip(&self.multipliers).for_each(|(sum, own)| *sum += own);
    }

    /// Sets `change` to the least change of `velocity`, in the kinetic energy, with which the conditions make `rates`
    /// of it, but for the last digits; `gradients` are those that
    /// [`Self::solve`] was called with last.
    ///
    /// # Errors
    /// The change is not finite.
    pub fn correct_velocity(
        &mut self,
        system: &System,
        gradients: &[JointGradient],
        rates: &[f64],
        velocity: &[f64],
        change: &mut [f64],
    ) -> Result<(), Singular> {
        for (moved, held) in self.moved.iter_mut().zip(&self.held) {
            *moved = velocity[held.unknown];
        }
        self.multipliers.fill(0.0);
        self.correct(gradients, rates);
        change.fill(0.0);
        self.add_reactions(system, gradients, change);
        if change.iter().all(|value| value.is_finite()) { Ok(()) } else { Err(Singular) }
    }

    /// Sets `vector` to the velocities without conditions, and the held ones to theirs.
    fn begin(&mut self, forces: &[f64], vector: &mut [f64]) {
        vector.copy_from_slice(forces);
        self.mass.solve(vector);
        for (free, held) in self.free.iter_mut().zip(&self.held) {
            *free = vector[held.unknown];
        }
        self.multipliers.fill(0.0);
        self.moved.copy_from_slice(&self.free);
    }

    /// Turns `vector`, forces, into velocities with the multipliers found.
    fn add_reactions(&self, system: &System, gradients: &[JointGradient], vector: &mut [f64]) {
        system.add_constraint_forces(gradients, &self.multipliers, -1.0, vector);
        self.mass.solve(vector);
    }

    /// Sets the followers and `S`.
    fn set_schur(&mut self, gradients: &[JointGradient]) {
        let Self { held, grips, sides, mobilities, followers, schur, .. } = self;
        let joints = grips.len();
        followers.fill(Column::default());
        for (joint, (grip, gradient)) in grips.iter().zip(gradients).enumerate() {
            grip.each_column(sides, gradient, |values, number| {
                let Held { first, count, mobility, .. } = held[number];
                for (other, mobility) in mobilities[mobility..mobility + count].iter().enumerate() {
                    add_times(*mobility, values, &mut followers[(first + other) * joints + joint]);
                }
            });
        }
        schur.clear();
        for (grip, gradient) in grips.iter().zip(gradients) {
            for other in &grip.coupled {
                let mut block = [Column::default(); MOST_CONDITIONS];
                grip.each_column(sides, gradient, |values, number| {
                    let follower = &followers[number * joints + other];
                    for (column, entry) in block.iter_mut().zip(follower) {
                        add_times(*entry, values, column);
                    }
                });
                for (column, values) in grips[*other].rows.clone().zip(&block) {
                    // From the diagonal on.
                    let skipped = (column + 1).saturating_sub(grip.rows.start + 1);
                    let begin = (grip.rows.start + skipped) - column;
                    let target = &mut schur.column_mut(column)[begin..grip.rows.end - column];
                    target.copy_from_slice(&values[skipped..grip.rows.len()]);
                }
            }
            if gradient.is_released {
                // Their multipliers are 0, by an equation of their own.
                grip.rows.clone().for_each(|row| schur.column_mut(row)[0] = 1.0);
            }
        }
    }

    /// Corrects the multipliers by what the conditions lack.
    fn correct(&mut self, gradients: &[JointGradient], conditions: &[f64]) {
        self.correct_to(gradients, |row| conditions[row]);
    }

    /// Corrects the multipliers by what the conditions lack to be `wanted`.
    fn correct_to(&mut self, gradients: &[JointGradient], wanted: impl Fn(usize) -> f64) {
        self.lack(gradients, wanted);
        self.schur.solve(&mut self.lacking);
        for (multiplier, correction) in self.multipliers.iter_mut().zip(&self.lacking) {
            *multiplier += correction;
        }
    }

    /// Sets the held velocities to those with the multipliers found.
    fn move_held(&mut self) {
        let Self { grips, free, moved, multipliers, followers, .. } = self;
        moved.copy_from_slice(free);
        for (joint, grip) in grips.iter().enumerate() {
            let mut own = Column::default();
            own[..grip.rows.len()].copy_from_slice(&multipliers[grip.rows.clone()]);
            for (moved, follower) in moved.iter_mut().zip(followers[joint..].iter().step_by(grips.len())) {
                *moved -= (0..MOST_CONDITIONS).map(|row| follower[row] * own[row]).sum::<f64>();
            }
        }
    }

    /// Sets what is lacking to `G v − g` of the held velocities, with the `wanted` `g`.
    fn lack(&mut self, gradients: &[JointGradient], wanted: impl Fn(usize) -> f64) {
        for (grip, gradient) in self.grips.iter().zip(gradients) {
            let mut sum = Column::default();
            grip.each_column(&self.sides, gradient, |values, number| add_times(self.moved[number], values, &mut sum));
            for (row, sum) in grip.rows.clone().zip(&sum) {
                self.lacking[row] = sum - wanted(row);
            }
        }
    }

    /// Whether `G v − g` of the held velocities is round-off of its terms, with and without the conditions, or of those
    /// that any motion with the kinetic energy `square`/2 may have: the velocity of a coordinate is at most the root of
    /// its mobility times that of `square`.
    fn is_accurate(&mut self, gradients: &[JointGradient], conditions: &[f64], square: f64) -> bool {
        self.lack(gradients, |row| conditions[row]);
        let least = SMALLEST_SHARE * square.sqrt();
        self.grips.iter().zip(gradients).all(|(grip, gradient)| {
            let mut terms = Column::default();
            grip.each_column(&self.sides, gradient, |values, number| {
                let size = self.moved[number].abs() + self.free[number].abs() + least * self.held[number].root;
                add_times(size, &values.map(f64::abs), &mut terms);
            });
            let mut rows = grip.rows.clone().zip(&terms);
            rows.all(|(row, terms)| self.lacking[row].abs() <= BACKWARD_ERROR * (terms + conditions[row].abs()))
        })
    }
}

/// `sum += factor column`.
#[inline]
fn add_times(factor: f64, column: &Column, sum: &mut Column) {
    (0..MOST_CONDITIONS).for_each(|row| sum[row] += factor * column[row]);
}
