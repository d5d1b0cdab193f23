//! States of a simulation to go back to: a plain copy, and the bytes of one.
//!
//! Bytes hold numbers only: the settings of the file, the host's inputs, the state. The system is built from the file
//! again.

use super::Simulation;
use super::derivatives::{Derived, LastStep};
use super::solver::Solver;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::model::builder;
use crate::model::file::document::Document;
use crate::model::run::accuracy::Accuracy;
use crate::model::run::watch::Watch;
use crate::model::variables::inputs::Inputs;
use crate::solve::step::response::Responder;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::sync::Arc;

/// What changes between two calls of a host.
#[derive(Clone, Debug)]
pub struct Snapshot {
    document: Arc<Document>,
    drawn: Arc<Document>,
    system: Arc<System>,
    stale: bool,
    state: State,
    drawn_at: f64,
    start: f64,
    step: f64,
    initialization: Arc<()>,
    initialized: bool,
    watch: Watch,
    accuracy: Accuracy,
    inputs: Inputs,
    results: Vec<f64>,
    /// The last step and the state at its start, where there is one.
    last: Option<(LastStep, State)>,
}

/// A snapshot as numbers.
#[derive(Serialize, Deserialize)]
struct Saved<'a> {
    /// Settings of the file now.
    settings: Vec<f64>,
    /// Settings of the file when the system was built.
    drawn: Vec<f64>,
    /// Values and derivatives of the inputs.
    inputs: [Cow<'a, [f64]>; 2],
    state: Cow<'a, State>,
    /// The instant of the drawing, start of the grid and internal step, s.
    grid: [f64; 3],
    initialized: bool,
    watch: Cow<'a, Watch>,
    accuracy: Cow<'a, Accuracy>,
    results: Cow<'a, [f64]>,
    last: Option<SavedStep<'a>>,
}

/// The last communication step as numbers.
#[derive(Serialize, Deserialize)]
struct SavedStep<'a> {
    start: Cow<'a, State>,
    inputs: [Cow<'a, [f64]>; 2],
    end: f64,
    stop: f64,
    settings: Cow<'a, [f64]>,
}

impl<'a> Saved<'a> {
    /// The numbers in these bytes, all of them.
    fn read(bytes: &'a [u8]) -> Result<Self, String> {
        let (saved, rest): (Self, _) =
            postcard::take_from_bytes(bytes).map_err(|reason| format!("the state cannot be read: {reason}"))?;
        match rest.len() {
            0 => Ok(saved),
            more => Err(format!("{more} bytes are left behind the state")),
        }
    }
}

impl Snapshot {
    /// Its bytes, behind `bytes`.
    pub fn write(&self, bytes: Vec<u8>) -> Vec<u8> {
        let [values, slopes] = self.inputs.parts();
        let saved = Saved {
            settings: self.document.settings(),
            drawn: self.drawn.settings(),
            inputs: [values.into(), slopes.into()],
            state: Cow::Borrowed(&self.state),
            grid: [self.drawn_at, self.start, self.step],
            initialized: self.initialized,
            watch: Cow::Borrowed(&self.watch),
            accuracy: Cow::Borrowed(&self.accuracy),
            results: Cow::Borrowed(&self.results),
            last: self.last.as_ref().map(|(last, start)| SavedStep {
                start: Cow::Borrowed(start),
                inputs: last.inputs.parts().map(Cow::Borrowed),
                end: last.end,
                stop: last.stop,
                settings: Cow::Borrowed(&last.settings),
            }),
        };
        postcard::to_extend(&saved, bytes).expect("a Vec takes every byte, and all lengths are known")
    }

    /// The state in these bytes, which may be of any mechanism and have any numbers.
    ///
    /// # Errors
    /// They are not a state, or more than one.
    pub(super) fn state_in(bytes: &[u8]) -> Result<State, String> {
        Ok(Saved::read(bytes)?.state.into_owned())
    }

    /// The snapshot that these bytes are of; `document` is the file it is a state of, with any settings, `results`
    /// their number.
    ///
    /// # Errors
    /// They are no state of this file.
    pub(super) fn read(document: &Document, results: usize, bytes: &[u8]) -> Result<Self, String> {
        let saved = Saved::read(bytes)?;
        let drawn = Arc::new(document.with_settings(&saved.drawn)?);
        drawn.check()?;
        let document = match saved.settings == saved.drawn {
            true => Arc::clone(&drawn),
            false => Arc::new(document.with_settings(&saved.settings)?),
        };
        let [drawn_at, start, step] = saved.grid;
        let mut built = builder::build(&drawn, drawn_at).map_err(|mistakes| mistakes.to_string())?;
        // Tunable parameters that were set after the last step wait for the next one.
        let stepped = saved.last.as_ref().map_or(&[][..], |last| &last.settings);
        let stale = saved.initialized && !stepped.is_empty();
        if stale {
            builder::retune(&document.with_settings(stepped)?, &mut built.system);
        } else if saved.initialized {
            builder::retune(&document, &mut built.system);
        }
        let state = saved.state.into_owned();
        let [values, slopes] = saved.inputs;
        let mut inputs = Inputs::new(&document);
        let mut fits = state.has_the_shape_of(&built.state) && inputs.set_parts([&values, &slopes]);
        fits &= state.path.is_none() || document.follows_arc_length();
        fits &= saved.results.len() == results && step > 0.0 && saved.grid.iter().all(|time| time.is_finite());
        let last = saved.last.map(|SavedStep { start, inputs: [values, slopes], end, stop, settings }| {
            let mut last = LastStep { known: true, inputs: inputs.clone(), end, stop, settings: settings.into_owned() };
            fits &= start.has_the_shape_of(&built.state) && last.inputs.set_parts([&values, &slopes]);
            (last, start.into_owned())
        });
        if !fits {
            return Err(String::from("the state belongs to a mechanism of another shape than that of the model file"));
        }
        Ok(Self {
            document,
            drawn,
            system: Arc::new(built.system),
            stale,
            state,
            drawn_at,
            start,
            step,
            initialization: Arc::new(()),
            initialized: saved.initialized,
            watch: saved.watch.into_owned(),
            accuracy: saved.accuracy.into_owned(),
            inputs,
            results: saved.results.into_owned(),
            last,
        })
    }
}

impl Simulation {
    /// A copy of what changes between two calls.
    pub(super) fn save(&self) -> Snapshot {
        let runner = &self.runner;
        Snapshot {
            document: Arc::clone(&self.document),
            drawn: Arc::clone(&runner.drawn),
            system: Arc::clone(&runner.system),
            stale: runner.stale,
            state: runner.state.clone(),
            drawn_at: runner.drawn_at,
            start: runner.start,
            step: runner.step,
            initialization: Arc::clone(&runner.initialization),
            initialized: runner.is_initialized(),
            watch: self.watch.clone(),
            accuracy: self.accuracy.clone(),
            inputs: self.inputs.clone(),
            results: self.results.clone(),
            last: self.last.known.then(|| (self.last.clone(), runner.backup.clone())),
        }
    }

    /// Goes back to a copy.
    pub(super) fn go_back_to(&mut self, snapshot: &Snapshot) {
        self.lose_companion("a saved state was restored");
        let runner = &mut self.runner;
        self.document = Arc::clone(&snapshot.document);
        runner.drawn = Arc::clone(&snapshot.drawn);
        runner.system = Arc::clone(&snapshot.system);
        runner.stale = snapshot.stale;
        runner.state.clone_from(&snapshot.state);
        (runner.drawn_at, runner.start, runner.step) = (snapshot.drawn_at, snapshot.start, snapshot.step);
        runner.pacing = runner.drawn.pacing(runner.start);
        self.results.clone_from(&snapshot.results);
        self.watch.clone_from(&snapshot.watch);
        self.accuracy.clone_from(&snapshot.accuracy);
        self.peak = None;
        self.inputs.copy_from(&snapshot.inputs);
        self.derived = Derived::default();
        self.under_way = None;
        self.last.known = snapshot.last.is_some();
        if let Some((last, start)) = &snapshot.last {
            self.last.inputs.copy_from(&last.inputs);
            (self.last.end, self.last.stop) = (last.end, last.stop);
            self.last.settings.clone_from(&last.settings);
            runner.backup.clone_from(start);
        }
        if let Solver::Statics(statics) = &mut runner.solver {
            statics.forget();
        }
        // The solver has the shape and the tolerance of its initialization, which may be another one, or another
        // instance's.
        if !Arc::ptr_eq(&runner.initialization, &snapshot.initialization) {
            runner.initialization = Arc::clone(&snapshot.initialization);
            runner.solver = match snapshot.initialized {
                false => Solver::None,
                // It was made once, of the same numbers.
                true => Solver::new(&runner.drawn, &runner.system, runner.pacing).unwrap_or(Solver::None),
            };
            // The response is of the state, and only results ask for it: a snapshot has them.
            runner.responder = match snapshot.initialized && self.table.needs_response() {
                false => None,
                true => Some(Box::new(Responder::new(&runner.system))),
            };
        }
    }
}
