//! The state that a model begins with: `simulation.from_state` names the file of one that another run has left.
//!
//! It is read with the model file, and its mistakes are those of the file. In an FMU it is among the resources.

use super::kept::Kept;
use super::{Simulation, guid, wrong};
use crate::error::decimal;
use crate::fmi::Failure;
use std::sync::Arc;

/// What reads the file of a state, by its name in the model file; the reason where that fails, as a sentence.
pub type ReadState<'r> = &'r dyn Fn(&str) -> Result<Vec<u8>, String>;

/// The state that a model begins with.
#[derive(Clone, Debug)]
pub struct FirstState {
    /// The file as the model file names it.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
    kept: Kept,
}

impl Simulation {
    /// The state that the model begins with; none: it begins as drawn, or at an equilibrium.
    pub fn first_state(&self) -> Option<&FirstState> {
        self.first_state.as_deref()
    }

    /// Reads the state that the file names.
    pub(super) fn read_first_state(&mut self, read: ReadState<'_>) -> Result<(), Failure> {
        let document = Arc::clone(&self.document);
        let Some((name, place)) = &document.simulation.from_state else { return Ok(()) };
        let refused = |message: String, label: &str, help: &str| {
            let mistake = document.diagnostic(*place, &message, label, help);
            Err(Failure { line: mistake.line(), ..wrong(mistake.to_string()) })
        };
        let bytes = match read(name) {
            Ok(bytes) => bytes,
            Err(reason) => return refused(reason, "", "paths are relative to the folder of this file"),
        };
        let kept = match Kept::read(&bytes) {
            Ok(kept) => kept,
            Err(problem) => {
                let help = "write it with `ancf14 run --save-state` of this version of the program";
                return refused(format!("`{name}` is not the state of a run"), &problem, help);
            }
        };
        let (begin, stop) = (kept.time(), document.value(document.simulation.stop));
        if let Err(problem) = self.fit_to_begin(kept.clone()) {
            return refused(format!("the model cannot begin with `{name}`"), "", &problem);
        }
        if begin >= stop {
            let message = format!("the state is at t = {} s, and the run ends at {stop} s", decimal(begin));
            return refused(message, "", "set simulation.stop to a later time");
        }
        self.about.start = begin;
        self.about.guid = guid::with_state(&self.about.guid, &bytes);
        self.first_state = Some(Arc::new(FirstState { name: name.clone(), bytes, kept }));
        Ok(())
    }

    /// Begins with the state `first` at `start`, s.
    pub(super) fn begin_with_first(&mut self, first: &FirstState, start: f64) -> Result<(), Failure> {
        let time = first.kept.time();
        if start != time {
            return Err(wrong(format!(
                "the model begins with the state of {} at t = {} s, and cannot start at t = {} s: let the host start at that time, as modelDescription.xml says",
                first.name,
                decimal(time),
                decimal(start)
            )));
        }
        // Parameters may have been set since the file was read.
        let beginning = self
            .fit_to_begin(first.kept.clone())
            .map_err(|problem| wrong(format!("the model cannot begin with {}: {problem}", first.name)))?;
        self.begin_from(&beginning)
    }
}
