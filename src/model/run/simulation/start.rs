//! The start: builds the system from the parameters as set and finds its initial state.

use super::runner::Runner;
use super::{Simulation, failure, wrong};
use crate::error::Error;
use crate::fmi::Failure;
use crate::model::builder;
use crate::model::file::entries::frame::FrameSpec;
use crate::model::file::number::Number;
use std::sync::Arc;

/// Why there is no initial state.
#[derive(Debug)]
pub(super) enum NoStart {
    /// The values make no model, or not one that is assembled as drawn.
    Refused(Failure),
    /// The model has no state that the solver can find.
    NotFound(Failure),
}

impl NoStart {
    /// The sentence, without the kind.
    pub fn into_failure(self) -> Failure {
        match self {
            Self::Refused(failure) | Self::NotFound(failure) => failure,
        }
    }
}

impl From<Failure> for NoStart {
    fn from(failure: Failure) -> Self {
        Self::Refused(failure)
    }
}

impl From<Error> for NoStart {
    fn from(error: Error) -> Self {
        match error {
            Error::NotAssembled { .. }
            | Error::DrawnInBeam(_)
            | Error::DrawnInSurface(_)
            | Error::DriveNotAtZero { .. }
            | Error::WinchNotAtZero { .. }
            | Error::FrameNotAsDrawn { .. } => Self::Refused(failure(&error)),
            _ => Self::NotFound(failure(&error)),
        }
    }
}

impl Simulation {
    /// Builds the model from the parameters as set and finds its initial state at `start`, s.
    ///
    /// # Errors
    /// The parameters do not make a model, or no initial state exists; the state before stays.
    pub(super) fn find_start(&mut self, start: f64) -> Result<(), NoStart> {
        self.warn_of_quaternions([start; 2]);
        let starts = self.starts();
        if starts.iter().any(|(number, value)| self.document.value(*number) != *value) {
            let document = Arc::make_mut(&mut self.document);
            starts.iter().for_each(|(number, value)| document.set_start(*number, *value));
        }
        self.document.check().map_err(wrong)?;
        if let Some(first) = self.first_state.clone() {
            return Ok(self.begin_with_first(&first, start)?);
        }
        let document = &self.document;
        let mut runner = match self.runner.if_drawn(document, start) {
            Some(runner) => runner,
            None => {
                let built = builder::build(document, document.drawn_at(start))
                    .map_err(|mistakes| wrong(mistakes.to_string()))?;
                Runner::new(built, document, start)
            }
        };
        runner.take_course(&self.runner);
        let origin = runner.system.origin;
        builder::aim(document, &origin, |number| self.inputs.line(number), [start; 2], &mut runner.state.targets);
        if !self.start_along_guide(&mut runner, start)? {
            let warnings = runner.find_initial_state(&self.document, self.table.needs_response())?;
            self.warnings.extend(warnings);
        }
        self.begin_with(runner).map_err(NoStart::NotFound)?;
        self.start_companion();
        Ok(())
    }

    /// Where inputs are at the start, but for those of frames: the file draws these, and a host that begins elsewhere
    /// moves them there.
    fn starts(&self) -> Vec<(Number, f64)> {
        let drawn: Vec<Number> = self.document.frames.iter().flat_map(FrameSpec::numbers).collect();
        self.inputs.iter().filter(|(number, _)| !drawn.contains(number)).collect()
    }
}
