//! Derivatives over one internal step: of its unknowns, of the state after it, and of what is projected at its end.

use super::mover::{Mover, Step};
use super::{Inputs, STENCIL};
use crate::error::Error;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::variation::Variation;
use crate::solve::linear::Singular;
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::linearized::{Linearized, Span};

/// Most solves with one tangent: the second takes out what the tangent leaves out, the third what is left of that.
const SOLVES: usize = 3;
/// A correction this small leaves its square, relative to the whole: round-off.
const SMALL_CORRECTION: f64 = 1e-6;

/// Scratch memory.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    pub mover: Mover,
    /// Right-hand side of a linear system at a changed state, and the difference of several.
    pub right: Vec<f64>,
    pub sum: Vec<f64>,
    unknowns: Vec<f64>,
    moved_unknowns: Vec<f64>,
    /// Derivatives of the unknowns.
    change: Vec<f64>,
    /// Derivative of `Gᵀ s` at constant `s`.
    constraint_forces: Vec<f64>,
    /// `ν`: the momentum that constraints do not allow, before it was steadied.
    constraint_momenta: Vec<f64>,
    gradients: Vec<JointGradient>,
    gradients_after: Vec<JointGradient>,
    pub arrived: State,
    pub variation: Variation,
}

impl Scratch {
    /// For systems of `size` unknowns.
    pub fn new(size: usize) -> Self {
        let list = || vec![0.0; size];
        Self { change: list(), right: list(), sum: list(), constraint_forces: list(), ..Self::default() }
    }
}

/// An internal step of `step` that ended at the state `after`.
pub(super) struct Pass<'a, I, N> {
    pub integrator: &'a mut I,
    pub system: &'a System,
    pub step: &'a Step<'a, N>,
    /// The state that the unknowns of the integrator depend on.
    pub from: &'a State,
    pub after: &'a State,
    pub span: Span,
    /// `[M Gᵀ; G 0]` at the end of the step.
    pub flow: &'a mut Kkt,
    pub scratch: &'a mut Scratch,
}

impl<I: Linearized, N: Inputs> Pass<'_, I, N> {
    /// Factorizes the tangent of the step, and that of the projection at its end; `before` is the state before the
    /// step.
    pub fn prepare(&mut self, before: &State) -> Result<(), Error> {
        let Self { integrator, system, from, after, span, flow, .. } = self;
        let Scratch { unknowns, moved_unknowns, constraint_momenta, gradients_after, mover, .. } = &mut *self.scratch;
        integrator.unknowns(after, unknowns);
        integrator.factorize(system, from, *span, unknowns)?;
        moved_unknowns.resize(unknowns.len(), 0.0);
        if I::PROJECTS {
            let configuration = mover.gradients_at(system, after, gradients_after);
            flow.blocks.clear();
            system.add_mass(MassAt::from(&configuration), 1.0, &mut flow.blocks);
            flow.set_constraints(system, gradients_after, gradients_after, 1.0);
            flow.factorize(system, span.end)?;
            // P = M v + Gᵀ ν before the momentum was steadied.
            constraint_momenta.clear();
            constraint_momenta.extend(
                after
                    .constraint_momenta
                    .iter()
                    .zip(&before.constraint_momenta)
                    .map(|(after, before)| 2.0 * after - before),
            );
        }
        Ok(())
    }

    /// Takes `variation`, how the state depends on input `number`, from the start of the step to its end.
    pub fn differentiate(&mut self, number: usize, variation: &mut Variation) -> Result<(), Error> {
        self.differentiate_unknowns(number, variation)?;
        self.differentiate_end(number, variation);
        if I::PROJECTS {
            self.project()?;
        }
        std::mem::swap(variation, &mut self.scratch.variation);
        Ok(())
    }

    /// Sets the derivatives of the unknowns: `R_z dz = −R_s ds − R_u du`.
    fn differentiate_unknowns(&mut self, number: usize, own: &Variation) -> Result<(), Error> {
        let Self { integrator, system, step, from, span, .. } = self;
        let Scratch { unknowns, moved_unknowns, change, right, sum, mover, .. } = &mut *self.scratch;
        change.fill(0.0);
        for solve in 0..SOLVES {
            let unit = step.reach(system, number, own, change, span.step);
            sum.fill(0.0);
            for (offset, weight) in STENCIL {
                let by = offset * unit;
                let moved = mover.move_from(system, step, number, from, own, by);
                set_moved(moved_unknowns, unknowns, change, by);
                integrator.balance(system, moved, *span, moved_unknowns, right);
                add_scaled(sum, right, weight / unit);
            }
            integrator.solve(sum).map_err(inaccurate(*span))?;
            add_scaled(change, sum, 1.0);
            if solve > 0 && system.correction_size(sum).0 <= SMALL_CORRECTION * system.correction_size(change).0 {
                break;
            }
        }
        Ok(())
    }

    /// Sets the derivatives of the end before its projection: `ds' = F_z dz + F_s ds + F_u du`; in `sum` and
    /// `constraint_forces` it gathers what
    /// [`Self::project`] asks for.
    fn differentiate_end(&mut self, number: usize, own: &Variation) {
        let Self { integrator, system, step, from, after, span, .. } = self;
        let Self { scratch: Scratch { unknowns, moved_unknowns, change, right, sum, constraint_forces, .. }, .. } =
            self;
        let Self { scratch: Scratch { constraint_momenta, gradients, mover, arrived, variation, .. }, .. } = self;
        let coordinates = system.coordinates();
        let has_changing_mass = !system.winches.is_empty() || system.has_following_inertia();
        let unit = step.reach(system, number, own, change, span.step);
        variation.set_zero(after);
        sum.fill(0.0);
        constraint_forces.fill(0.0);
        for (offset, weight) in STENCIL {
            let (by, weight) = (offset * unit, weight / unit);
            let moved = mover.move_from(system, step, number, from, own, by);
            set_moved(moved_unknowns, unknowns, change, by);
            integrator.conclude(system, moved, *span, moved_unknowns, arrived);
            variation.add_between(system, weight, after, arrived);
            if I::PROJECTS {
                let (forces, rates) = right.split_at_mut(coordinates);
                let configuration = mover.gradients_at(system, arrived, gradients);
                system.constraint_rates(&configuration, rates);
                system.add_constraint_rates(gradients, &after.velocity, rates);
                forces.fill(0.0);
                if has_changing_mass {
                    // dP = M dv + dM v.
                    system.mass_times(MassAt::from(&configuration), &after.velocity, forces);
                    add_scaled(&mut constraint_forces[..coordinates], forces, weight);
                }
                system.add_constraint_forces(gradients, constraint_momenta, 1.0, forces);
                add_scaled(sum, right, -weight);
                system.add_constraint_forces(
                    gradients,
                    &after.constraint_momenta,
                    weight,
                    &mut constraint_forces[..coordinates],
                );
            }
        }
    }

    /// Projects the derivatives of the end: `[M Gᵀ; G 0][dv; dν] = [dP − dGᵀ ν; −d(g_t + G v)]`, then
    /// `dP = M dv + Gᵀ ds + dGᵀ s` with the steadied `s`.
    fn project(&mut self) -> Result<(), Error> {
        let Self { system, after, span, flow, .. } = self;
        let Scratch { sum, constraint_forces, gradients_after, mover, variation, .. } = &mut *self.scratch;
        let coordinates = system.coordinates();
        add_scaled(sum, &variation.lists.momentum, 1.0);
        flow.solve_again(sum).map_err(inaccurate(*span))?;
        let (velocity, own_now) = sum.split_at(coordinates);
        variation.lists.velocity.copy_from_slice(velocity);
        for (lead, velocity) in variation.lists.velocity_lead.iter_mut().zip(velocity) {
            *lead -= 0.5 * velocity;
        }
        for (own, own_now) in variation.lists.constraint_momenta.iter_mut().zip(own_now) {
            *own = 0.5 * (*own + own_now);
        }
        let mass = MassAt::new(&after.prescribed.drives, mover.mass_frames(system, after));
        system.mass_times(mass, velocity, &mut variation.lists.momentum);
        system.add_constraint_forces(
            gradients_after,
            &variation.lists.constraint_momenta,
            1.0,
            &mut variation.lists.momentum,
        );
        add_scaled(&mut variation.lists.momentum, &constraint_forces[..coordinates], 1.0);
        Ok(())
    }
}

fn inaccurate(span: Span) -> impl Fn(Singular) -> Error {
    move |Singular| Error::Singular { time: span.end, what: String::from("the derivatives of a step") }
}

/// `target += factor values`.
pub(super) fn add_scaled(target: &mut [f64], values: &[f64], factor: f64) {
    for (target, value) in target.iter_mut().zip(values) {
        *target += factor * value;
    }
}

/// `moved = values + by change`.
pub(super) fn set_moved(moved: &mut [f64], values: &[f64], change: &[f64], by: f64) {
    for ((moved, value), change) in moved.iter_mut().zip(values).zip(change) {
        *moved = value + by * change;
    }
}
