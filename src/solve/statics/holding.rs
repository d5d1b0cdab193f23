//! Free motions that take no load and cost no energy, as the spin of a cable between two ball joints: the statics hold
//! a coordinate of each where it is.
//!
//! The tangent of such a motion `v` is singular, `K v = 0`. A stiffness on the diagonal of a coordinate `i` that `v`
//! changes makes it regular: `(K + k eᵢ eᵢᵀ) x = r`. Multiplied by `vᵀ` this is `k vᵢ xᵢ = vᵀ r`: where the residual
//! does no work in the motion, coordinate `i` keeps its value and `x` solves `K x = r`. The residual has no term of
//! `k`, so that Newton converges to equilibria of the mechanism as it is, and to none where a load acts along the
//! motion (MECHANICS 7.13).

use super::Statics;
use super::equilibrium::{Equilibrium, Tangent};
use crate::error::{Error, decimal};
use crate::mechanics::state::{HeldCoordinate, State};
use crate::mechanics::system::System;
use crate::solve::newton::Problem;

/// The stiffness of a held coordinate over that of its own in the matrix: far above the round-off of a factorization,
/// and so soft that a load far below all others makes corrections above the tolerance.
const SOFT: f64 = 1e-6;
/// Most motions that are held; each of them takes a factorization to find.
const MOST: usize = 200;
/// Components of a free motion below this share of the largest are round-off, which soft directions of slender beams
/// amplify.
const NOTABLE: f64 = 1e-5;
/// Work in a free motion below this share of the sum of its terms' sizes is round-off of these.
const CANCELED: f64 = 1e-6;
/// Work below this share of the largest stiffness of the matrix is round-off of the forces of stiff parts.
const ROUND_OFF: f64 = 1e-14;
/// How far the response of a held coordinate to its own stiffness may be from 1, which is the share of the motion's
/// stiffness in the sum: the stress that Newton leaves in stiff parts may be a hundredth of the sum.
const STIFF: f64 = 0.05;
/// Held motions that a message names.
const NAMED: usize = 3;

/// Whether the solver may hold free motions, and what it has met.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Holding {
    pub(super) is_allowed: bool,
    /// A matrix was singular.
    pub(super) has_met_free: bool,
    /// A free motion takes a load, or a constraint is redundant: smaller loads do not help.
    pub(super) is_hopeless: bool,
}

impl Statics {
    /// Runs `search` without holding free motions, then, where it has failed for one, with. `search` must begin anew
    /// from the state that it is given.
    pub(super) fn search_holding(
        &mut self,
        system: &System,
        from: &State,
        next: &mut State,
        search: impl Fn(&mut Self, &System, &mut State) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.holding = Holding { has_met_free: !from.held.is_empty(), ..Holding::default() };
        let Err(reason) = search(self, system, next) else { return Ok(()) };
        let is_number = matches!(reason, Error::NotFinite { .. });
        if !self.holding.has_met_free || is_number {
            return Err(reason);
        }
        let tried = next.statistics;
        next.clone_from(from);
        next.statistics = tried;
        self.holding.is_allowed = true;
        let outcome = search(self, system, next);
        let is_hopeless = self.holding.is_hopeless;
        self.holding = Holding::default();
        // The first reason may be an iteration that a load along a free motion has kept from converging.
        outcome.map_err(|second| if is_hopeless { second } else { reason })
    }

    /// Holds a coordinate of each free motion of `state` under what acts now.
    ///
    /// # Errors
    /// A constraint is redundant, or a load acts along a free motion.
    pub(super) fn hold_free_motions(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        self.hold_unloaded(system, state, time)?;
        self.assemble_current(system, state, time);
        self.kkt.factorize(system, time)?;
        self.check_unloaded(system, state, time)
    }

    /// Holds a coordinate of each free motion of `state`, along which no load acts.
    ///
    /// # Errors
    /// A constraint is redundant.
    pub(super) fn hold_unloaded(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        state.held.clear();
        self.assemble_current(system, state, time);
        self.choose_held(system, state, time)
    }

    /// Holds free motions of `state`, an equilibrium, whose matrix at Newton's last iterate is set: no load acts along
    /// them.
    ///
    /// # Errors
    /// A constraint is redundant, or Newton does not come back with the motions held.
    pub(super) fn make_unique(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        if !matches!(self.kkt.check_unique(system, time), Err(Error::Singular { .. })) {
            return Ok(());
        }
        self.choose_held(system, state, time)?;
        // A solution with a singular matrix has the stress of corrections that are anything.
        self.iterate(system, state, time, Tangent::Exact)
    }

    /// Adds coordinates to those that `state` holds until the matrix that is set is regular with them.
    fn choose_held(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        let singular = |what| Error::Singular { time, what };
        while let Some(index) = self.kkt.find_free_unknown(system).map_err(singular)? {
            let is_held = state.held.iter().any(|held| held.index == index);
            if is_held || state.held.len() == MOST {
                let slot = system.describe_unknown(index);
                return Err(singular(match is_held {
                    true => format!(
                        "{slot} can move freely, and forces turn with it, so that none of its positions is an \
                         equilibrium by itself; hold it by a joint, or let the forces keep their directions"
                    ),
                    false => format!("{slot} and more than {MOST} others can move freely; hold them by joints"),
                }));
            }
            let stiffness = SOFT / self.kkt.scale(index).powi(2);
            state.held.push(HeldCoordinate { index, stiffness });
            self.kkt.stiffen(index, stiffness);
        }
        Ok(())
    }

    /// Checks that what acts on `state`, whose matrix is set and factorized, does no work in the motions that it holds.
    ///
    /// # Errors
    /// A load acts along one: it is named.
    fn check_unloaded(&mut self, system: &System, state: &State, time: f64) -> Result<(), Error> {
        let forces = self.right[..system.coordinates()].to_vec();
        let unit = |index: usize| if system.is_place(index) { system.size } else { 1.0 };
        let stiffest = self.kkt.blocks.layout().iter().enumerate().flat_map(|(number, block)| {
            let own = block.row == block.column && block.row < system.coordinates();
            let values = self.kkt.blocks.block(number);
            let diagonal = (0..if own { block.rows.min(block.columns) } else { 0 }).map(|k| k * block.rows + k);
            diagonal.enumerate().map(|(k, slot)| values[slot].abs() * unit(block.row + k).powi(2)).collect::<Vec<_>>()
        });
        let floor = ROUND_OFF * stiffest.fold(0.0, f64::max);
        for held in &state.held {
            let motion = self.motion_of(system, *held, time)?;
            let size = |(index, value): (usize, &f64)| value.abs() / unit(index);
            let largest = motion.iter().enumerate().map(size).fold(0.0, f64::max);
            let notable = motion.iter().enumerate().filter(|own| size(*own) > NOTABLE * largest);
            let terms = notable.map(|(index, value)| value * forces[index]);
            let (work, sum) = terms.fold((0.0, 0.0), |(work, sum): (f64, f64), term| (work + term, sum + term.abs()));
            if work.abs() > CANCELED * sum && work.abs() > floor * largest {
                let slot = system.describe_unknown(held.index);
                let work = work.abs() / motion[held.index];
                let (load, unit) = if system.is_place(held.index) { ("force", "N") } else { ("moment", "N m") };
                let what = format!(
                    "{slot} can move freely, and a {load} of {} {unit} acts along this motion; hold it by a joint",
                    decimal(f64::from(work as f32))
                );
                return Err(Error::Singular { time, what });
            }
        }
        Ok(())
    }

    /// The free motion that a held coordinate stands for, in which it changes by 1 and the others that are held stand
    /// still. The matrix is set and factorized.
    fn motion_of(&mut self, system: &System, held: HeldCoordinate, time: f64) -> Result<Vec<f64>, Error> {
        let mut motion = vec![0.0; system.coordinates() + system.constraints()];
        motion[held.index] = held.stiffness;
        self.kkt.solve_more(system, &mut motion, time)?;
        motion.truncate(system.coordinates());
        Ok(motion)
    }

    /// Lets go of coordinates of the equilibrium `state` that a stiffness holds by now, as that of gravity holds a
    /// pendulum.
    pub(super) fn release_held(&mut self, system: &System, state: &mut State) {
        if state.held.is_empty() || self.linearize(system, state).is_err() {
            return;
        }
        let mut held = std::mem::take(&mut state.held);
        held.retain(|held| {
            let motion = self.motion_of(system, *held, state.time);
            motion.is_ok_and(|motion| (motion[held.index] - 1.0).abs() < STIFF)
        });
        state.held = held;
    }

    /// Remarks which free motions are held at `state` that were not at `before`.
    pub(super) fn remark_held(&mut self, system: &System, before: &State, state: &State) {
        let is_new = |held: &&HeldCoordinate| before.held.iter().all(|other| other.index != held.index);
        let new = state.held.iter().filter(is_new).map(|held| held.index);
        let new: Vec<usize> = new.filter(|index| !system.is_hidden_spin(*index)).collect();
        // The directions in which a body turns have one name.
        let mut all: Vec<String> = Vec::new();
        for name in new.iter().map(|index| system.describe_unknown(*index)) {
            if !all.contains(&name) {
                all.push(name);
            }
        }
        let others = all.len().saturating_sub(NAMED);
        let mut names: Vec<String> = all.into_iter().take(NAMED).collect();
        if others > 0 {
            names.push(format!("{others} more"));
        }
        let Some(last) = names.pop() else { return };
        let (list, held) = if names.is_empty() {
            (last, "a free motion takes no load and costs no energy, and is held where it is")
        } else {
            (
                format!("{} and {last}", names.join(", ")),
                "free motions take no load and cost no energy, and are held where they are",
            )
        };
        self.stability.add_remark(format!(
            "{held}: {list}. The equilibrium does not depend on it; where it should, hold it by a joint with fewer degrees of freedom or by a spring"
        ));
    }

    /// Sets matrix and balance at `state` under what acts now.
    fn assemble_current(&mut self, system: &System, state: &State, time: f64) {
        let given = (&self.current, &self.current_motion);
        Equilibrium::near(system, state, time, given, &mut self.scratch).linearize(&mut self.kkt, &mut self.right);
    }
}
