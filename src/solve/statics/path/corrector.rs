//! The equilibrium in the plane across the tangent of a path, as Newton sees it: the parameter is one unknown more, the
//! plane one equation more.
//!
//! Their row and column border the matrix: `[K −b; τᵀ] [x; p] = [r; 0]`, where `b` is the derivative of the balance by
//! the parameter. Both parts of `x = K⁻¹ r + p K⁻¹ b` come from one factorization.

use super::super::Scratch;
use super::super::equilibrium::{Equilibrium, Tangent, undefined_law};
use super::scalar_product;
use crate::error::Error;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::state::path_point::PathPoint;
use crate::mechanics::system::System;
use crate::solve::newton::Problem;
use crate::solve::newton::kkt::Kkt;

/// Change of the parameter for the derivative by it, over 1 or its size: what the central difference leaves out is 1e-8
/// of its third derivative.
const REACH: f64 = 1e-4;

/// The border of the matrix; scratch memory.
#[derive(Debug, Default)]
pub(super) struct Border {
    /// Derivatives of the unknowns by the parameter.
    pub response: Vec<f64>,
    other: Vec<f64>,
    change: Vec<f64>,
}

/// An equilibrium in the plane that is `length` along the tangent of the path from `from`, the point of `state`.
pub(super) struct Across<'a> {
    pub system: &'a System,
    pub state: &'a State,
    pub from: &'a PathPoint,
    pub length: f64,
    pub parameter: f64,
    pub excitation: &'a mut Excitation,
    pub motion: &'a mut Prescribed,
    pub border: &'a mut Border,
    pub scratch: &'a mut Scratch,
}

impl Across<'_> {
    /// Sets excitation and motion to those of `parameter`.
    pub fn set_given(&mut self, parameter: f64) {
        self.system.excite(parameter, &self.state.targets, self.excitation);
        self.system.prescribe(self.state, parameter, self.motion);
        self.motion.stop();
    }

    /// Sets the response to the parameter at the current unknowns, where the matrix has been factorized.
    ///
    /// # Errors
    /// The balance is not finite around the parameter, or the equations are singular.
    pub fn find_border(&mut self, kkt: &mut Kkt) -> Result<(), Error> {
        let mut response = std::mem::take(&mut self.border.response);
        let mut other = std::mem::take(&mut self.border.other);
        let reach = REACH * f64::max(1.0, self.parameter.abs());
        let is_finite = |list: &[f64]| list.iter().all(|value| value.is_finite());
        let mut span = 2.0 * reach;
        self.balance(self.parameter + reach, &mut response);
        self.balance(self.parameter - reach, &mut other);
        if !is_finite(&other) {
            // As of a root at the start of the path.
            span = reach;
            self.balance(self.parameter, &mut other);
        } else if !is_finite(&response) {
            span = reach;
            self.balance(self.parameter, &mut response);
        }
        for (value, other) in response.iter_mut().zip(&other) {
            *value = (*value - other) / span;
        }
        let outcome = if is_finite(&response) {
            kkt.solve_more(self.system, &mut response, self.parameter)
        } else {
            let what = self.system.describe_not_finite(self.parameter);
            Err(Error::NotFinite { time: self.parameter, what })
        };
        self.set_given(self.parameter);
        (self.border.response, self.border.other) = (response, other);
        outcome
    }

    /// Sets `right` to minus the residual at `parameter`.
    fn balance(&mut self, parameter: f64, right: &mut Vec<f64>) {
        self.set_given(parameter);
        let (system, state) = (self.system, self.state);
        right.resize(system.coordinates() + system.constraints(), 0.0);
        let scratch = &mut *self.scratch;
        let configuration = scratch.frames.at(system, &scratch.q, state, self.motion);
        system.forces(&configuration, &Passage::Rest, self.excitation, &mut scratch.forces);
        system.constraint_gradients(&configuration, &mut scratch.gradients);
        self.equilibrium().balance(right);
    }

    /// The equilibrium under what is given.
    fn equilibrium(&mut self) -> Equilibrium<'_> {
        let Self { system, state, parameter, excitation, motion, scratch, .. } = self;
        // Close to limit points the exact tangent converges from farther away.
        Equilibrium {
            system,
            state,
            time: *parameter,
            excitation,
            motion,
            scratch,
            tangent: Tangent::Exact,
            first: None,
        }
    }
}

impl Problem for Across<'_> {
    fn undefined_law(&self) -> Option<String> {
        undefined_law(self.system, self.state, self.scratch, self.motion)
    }

    fn linearize(&mut self, kkt: &mut Kkt, right: &mut [f64]) -> f64 {
        self.set_given(self.parameter);
        self.equilibrium().linearize(kkt, right)
    }

    fn extend(&mut self, kkt: &mut Kkt, correction: &mut [f64]) -> Result<f64, Error> {
        self.find_border(kkt)?;
        let (system, from, count) = (self.system, self.from, self.state.q.len());
        let Border { response, change, .. } = &mut *self.border;
        let (slopes, growth) = (&from.tangent[..count], from.growth());
        change.clear();
        change.extend(self.scratch.q.iter().zip(&self.state.q).map(|(q, start)| q - start));
        change.push(self.parameter - from.parameter);
        let gone = scalar_product(system, &from.tangent, change);
        let along = system.mean_product(slopes, &correction[..count]);
        let rate = growth + system.mean_product(slopes, &response[..count]);
        let by = (self.length - gone - along) / rate;
        if !by.is_finite() {
            let what = String::from("has no direction across which Newton could look for it");
            return Err(Error::PathLost { parameter: from.parameter, what });
        }
        for (value, response) in correction.iter_mut().zip(&*response) {
            *value += by * response;
        }
        self.parameter += by;
        Ok(by.abs())
    }

    fn correct(&mut self, correction: &[f64]) {
        self.equilibrium().correct(correction);
    }
}
