//! FMU states (FMI 2.0, section 2.1.8): all that an instance is, as a plain copy.

use super::{Control, Instance};
use crate::fmi::{Model, error::Error, lifecycle::Call};

/// A copy of an instance: model, mode, times and logging.
pub struct FmuState<M: Model> {
    pub(super) guid: String,
    pub(super) control: Control,
    pub(super) model: M::Snapshot,
}

impl<M: Model> Instance<M> {
    /// A copy of everything (section 2.1.8).
    ///
    /// # Errors
    /// The mode does not allow it.
    pub fn state(&self) -> Result<FmuState<M>, Error> {
        self.check(Call::GetFMUstate)?;
        Ok(FmuState { guid: self.model.about().guid.clone(), control: self.control, model: self.model.snapshot() })
    }

    /// Goes back to a copy, mode, times and logging included; also after a failed step (section 2.1.8).
    ///
    /// # Errors
    /// The mode does not allow it, or the copy is of another model or of an instance of the other kind.
    pub fn set_state(&mut self, state: &FmuState<M>) -> Result<(), Error> {
        self.check(Call::SetFMUstate)?;
        let own = &self.model.about().guid;
        if state.guid != *own {
            return Err(Error::ForeignState { theirs: state.guid.clone(), own: own.clone() });
        }
        self.fits(state.control.mode)?;
        self.model.restore(&state.model);
        self.control = state.control;
        let (mode, time) = (self.mode(), self.time());
        self.event(|| format!("back to a state {mode} at t = {time} s"));
        Ok(())
    }
}
