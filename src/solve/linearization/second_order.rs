//! The equations of motion in independent coordinates: `M ξ'' + D ξ' + K ξ` against forces and prescribed motions.
//!
//! Where nothing moves, the matrices are `Zᵀ M Z`, `Zᵀ D Z`, `Zᵀ K Z` of those of the mechanism, which keep their
//! symmetry in each digit. Soft motions of stiff parts would lose it in products of `M` with accelerations, as which
//! the matrices about other states are found.

use super::Linearization;
use super::base::Base;
use super::independent::Selection;
use super::state_space::StateSpace;
use crate::error::Error;
use crate::math::blocks::Blocks;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::linear::dense::Dense;

/// Values below this share of what cancels in them are 0.
const ROUND_OFF: f64 = 1e-9;

/// The matrices of second order.
#[derive(Clone, Debug)]
pub struct SecondOrder {
    /// `M`.
    pub mass: Dense,
    /// `K`.
    pub stiffness: Rounded,
    /// `D`.
    pub damping: Rounded,
}

impl SecondOrder {
    /// Those about `base` in the coordinates `selection`, whose equations of first order are `matrices`.
    ///
    /// # Errors
    /// The constraints are redundant.
    pub fn new(system: &System, base: &Base, selection: &Selection, matrices: &StateSpace) -> Result<Self, Error> {
        let state = &base.state;
        let mut frames = FrameCache::default();
        frames.set(system, &state.q, &state.triads);
        let at = MassAt::new(&state.prescribed.drives, &frames).wet(&state.q, state.time);
        let shapes = &selection.shapes;
        let momenta = along(shapes, |shape, target| system.mass_times(at, shape, target));
        let mass = shapes.transposed().product(&momenta).symmetric_part();
        if base.is_still {
            let Linearization { by_q, by_v, by_spin, .. } = Linearization::new(system, base)?;
            let [stiffness, damping] = [&[&by_q][..], &[&by_v, &by_spin]].map(|parts| congruence(parts, shapes));
            return Ok(Self { mass, stiffness, damping });
        }
        let free = mass.rows;
        let forces = |first: usize| {
            let own: Vec<usize> = (free..2 * free).collect();
            let accelerations = matrices.a.columns_at(first..first + free).rows_of(&own);
            let Rounded { value, size } = Rounded::product(&mass, &accelerations);
            Rounded { value: Dense::zeros(free, free).minus(&value), size }
        };
        Ok(Self { stiffness: forces(0), damping: forces(free), mass })
    }
}

/// `-Zᵀ (sum of parts) Z` with the columns `Z`.
fn congruence(parts: &[&Blocks], shapes: &Dense) -> Rounded {
    let forces = along(shapes, |shape, target| parts.iter().for_each(|part| part.multiply_add(shape, target)));
    let value = shapes.transposed().product(&forces);
    let sizes: Vec<Blocks> = parts.iter().map(|part| part.sizes()).collect();
    let forces = along(&shapes.sizes(), |shape, target| sizes.iter().for_each(|part| part.multiply_add(shape, target)));
    let size = shapes.sizes().transposed().product(&forces);
    Rounded { value: Dense::zeros(value.rows, value.columns).minus(&value), size }
}

/// The results of `add` for each column.
fn along(shapes: &Dense, mut add: impl FnMut(&[f64], &mut [f64])) -> Dense {
    let mut own = Dense::zeros(shapes.rows, shapes.columns);
    (0..shapes.columns).for_each(|column| add(shapes.column(column), own.column_mut(column)));
    own
}

/// A matrix, and of each entry the size of the terms that add up to it.
#[derive(Clone, Debug)]
pub struct Rounded {
    /// The matrix.
    pub value: Dense,
    /// The sizes.
    pub size: Dense,
}

impl Rounded {
    /// A matrix that is given.
    pub fn new(value: Dense) -> Self {
        Self { size: value.sizes(), value }
    }

    /// `left right`.
    pub fn product(left: &Dense, right: &Dense) -> Self {
        Self { value: left.product(right), size: left.sizes().product(&right.sizes()) }
    }

    /// `self + factor left right`.
    pub fn plus(mut self, factor: f64, left: &Self, right: &Dense) -> Self {
        let (value, size) = (left.value.product(right), left.size.product(&right.sizes()));
        self.value.values.iter_mut().zip(&value.values).for_each(|(own, value)| *own += factor * value);
        self.size.values.iter_mut().zip(&size.values).for_each(|(own, size)| *own += size);
        self
    }

    /// The matrix, in which entries are 0 that are round-off.
    pub fn clean(mut self) -> Dense {
        self.value.values.iter_mut().zip(&self.size.values).for_each(|(own, size)| *own = cleaned(*own, *size));
        self.value
    }

    /// Forces in coordinates of this stiffness, in which entries are 0 that are round-off of the largest one.
    pub fn forces(mut self, stiffness: &Dense) -> Dense {
        let scales: Vec<f64> = (0..stiffness.rows).map(|own| stiffness.at(own, own).abs().sqrt()).collect();
        for column in 0..self.value.columns {
            let sizes = self.size.column(column).iter().zip(&scales).map(|(size, scale)| size / scale);
            let largest = sizes.fold(0.0, f64::max);
            let own = self.value.column_mut(column).iter_mut().zip(&scales);
            own.for_each(|(value, scale)| *value = cleaned(*value, largest * scale));
        }
        self.value
    }
}

/// A value that is a sum of terms of this size; 0 if it is their round-off.
pub fn cleaned(value: f64, size: f64) -> f64 {
    if value.abs() <= ROUND_OFF * size { 0.0 } else { value }
}
