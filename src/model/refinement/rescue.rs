//! A first run that fails on a mesh of the program: it begins anew on finer ones.
//!
//! Elements that are too long to bend around what they touch find no equilibrium, or distort. Nobody has chosen them,
//! so that nobody should be asked to choose others.

use super::{FINER, LEAST_COST, Refinement};
use crate::model::run::levels;
use crate::model::run::simulation::Simulation;

/// How often the elements of a run that fails are doubled at most.
const MOST_RESCUES: u32 = 3;
/// Most elements of a run that begins anew with more: the search for an equilibrium that is not found has no other bound.
const MOST_ELEMENTS: usize = 1000;

impl Refinement {
    /// The run that begins anew with twice the elements, not initialized; `simulation` is the first one, or the last
    /// one that this call has returned, and has failed. None where a run has come to its end already, where the file
    /// gives the meshes, and where it would take more than half a minute.
    pub fn rescue(&mut self, simulation: &Simulation) -> Option<Box<Simulation>> {
        let (cost, [finer, _]) = (simulation.cost(), FINER);
        self.costs[1] += cost;
        let is_cheap = self.costs[1] + finer * cost <= LEAST_COST && simulation.elements() <= MOST_ELEMENTS;
        if self.runs > 0 || self.rescues == MOST_RESCUES || !is_cheap || !self.chosen.contains(&true) {
            return None;
        }
        let next = simulation.begun_anew(levels::finer(simulation.document(), &self.chosen, finer)?).ok()?;
        self.rescues += 1;
        self.forget_rows();
        self.rows.iter_mut().for_each(Vec::clear);
        Some(Box::new(next))
    }
}
