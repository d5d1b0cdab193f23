//! Runs that are repeated with finer steps and meshes until they are accurate, and looked at between rows.

use super::Simulation;
use crate::model::refinement::{Found, Outcome, Refinement};

impl Simulation {
    /// Prepares the simulation, before [`Self::initialize`], to be repeated with finer steps and meshes until its
    /// results are accurate; none where the model file gives both. The further runs together cost `budget` times the
    /// first run at most. [`Self::look`] takes the rows of each run, the start first, and
    /// [`Self::repeated`] decides after [`Self::finish`].
    pub fn refine(&mut self, budget: Option<f64>) -> Option<Refinement> {
        Refinement::of(self.mechanism_mut(), budget)
    }

    /// Lets ranges along beams include the steps between rows, of the runs that begin from now on.
    pub fn look_at_all_steps(&mut self) {
        self.mechanism_mut().look_at_all_steps();
    }

    /// A row has been told: the extremes of ranges along beams begin anew.
    pub fn begin_row(&mut self) {
        self.mechanism_mut().begin_row();
    }

    /// Shows the row that is reached to `refinement`.
    pub fn look(&self, refinement: &mut Refinement) {
        refinement.look(self.model());
    }

    /// The same model with finer steps and meshes, to be initialized and run as this one was; none where the results
    /// are accurate, or cannot be with this budget.
    pub fn repeated(&self, refinement: &mut Refinement) -> Option<Self> {
        let next = refinement.judge(self.model())?;
        Some(Self::of(*next, Vec::new()))
    }

    /// The same model with twice the elements, to be begun anew, where this first run has failed; none where that does
    /// not help, or is not for the program to choose.
    pub fn rescued(&self, refinement: &mut Refinement) -> Option<Self> {
        let next = refinement.rescue(self.model())?;
        Some(Self::of(*next, Vec::new()))
    }

    /// The numbers that the file must say for a run like this one, the last one that counts.
    pub fn found(&self, refinement: &Refinement) -> Found {
        refinement.found(self.model())
    }

    /// Sums up the runs so far.
    pub fn outcome(&self, refinement: &Refinement) -> Outcome {
        refinement.outcome(self.model())
    }
}
