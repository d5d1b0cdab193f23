//! The state that a run leaves in a file, and the run that goes on from it or begins with it.
//!
//! The bytes are those of a saved state, behind what tells whether it fits: the parts of the mechanism with their names, where these are drawn, and a hash of the
//! model file. From the same file a run goes on as if it had never ended. From another file with the same parts it begins there: coordinates and velocities are those
//! of the state, and loads, drives, switches and stiffnesses those of the file.

use super::runner::{Runner, Solver, percent};
use super::saved::Snapshot;
use super::{Accuracy, Simulation, Watch, failure, wrong};
use crate::error::Error;
use crate::fmi::instance::serialized::{ROOM, content, seal};
use crate::fmi::{Failure, Model};
use crate::mechanics::input::switch::Hold;
use crate::mechanics::state::State;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::builder;
use crate::model::file::document::Document;
use crate::solve::dynamics::start;
use crate::solve::step::response::Responder;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The keys that say how long a run is and which rows it writes: the motion does not depend on them.
const ROWS: [&str; 2] = ["simulation.stop", "simulation.output_step"];

/// What a state is of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Label {
    /// Time, s.
    time: f64,
    /// A hash of the model file and of its overrides, but for [`ROWS`].
    file: String,
    /// Parts and what connects them, each with its name: all that has a place in the state.
    parts: Vec<String>,
    /// Coordinates as drawn.
    drawn: Vec<f64>,
}

/// A state that a run has left.
#[derive(Clone, Debug)]
pub struct Kept {
    label: Label,
    snapshot: Vec<u8>,
}

impl Kept {
    /// The state that [`Simulation::keep`] wrote.
    ///
    /// # Errors
    /// The bytes are not such a state, or damaged.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let (label, snapshot): (Label, &[u8]) =
            postcard::take_from_bytes(content(bytes)?).map_err(|reason| reason.to_string())?;
        Ok(Self { label, snapshot: snapshot.to_vec() })
    }

    /// The time at which it was taken, s.
    pub fn time(&self) -> f64 {
        self.label.time
    }
}

impl Simulation {
    /// The bytes of the state that is reached, for [`Kept::read`].
    pub fn keep(&self) -> Vec<u8> {
        let label = postcard::to_extend(&self.label(self.time()), vec![0; ROOM]);
        seal(self.save().write(label.expect("a Vec takes every byte, and all lengths are known")))
    }

    fn label(&self, time: f64) -> Label {
        let document = &*self.document;
        let overrides = document.remaining(&self.overrides);
        let lasting = overrides.into_iter().filter(|(key, _)| !ROWS.contains(&key.as_str()));
        let mut text = document.text().to_owned();
        lasting.for_each(|(key, value)| text.push_str(&format!("\n{key}={value}")));
        let drawn = builder::build(document, document.drawn_at(0.0)).map_or(Vec::new(), |built| built.state.q);
        Label {
            time,
            file: uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_URL, text.as_bytes()).to_string(),
            parts: parts(self),
            drawn,
        }
    }

    /// Whether this simulation can go on from a state or begin with it.
    ///
    /// # Errors
    /// It cannot: the state is of a mechanism with other parts, in words.
    pub fn fits(&self, kept: &Kept) -> Result<(), String> {
        let (own, theirs) = (self.label(kept.time()), &kept.label);
        let missing = theirs.parts.iter().find(|part| !own.parts.contains(part));
        let added = own.parts.iter().find(|part| !theirs.parts.contains(part));
        let difference = match (missing, added) {
            (Some(part), _) => format!("the state has {part}, which the model does not have"),
            (None, Some(part)) => format!("the model has {part}, which the state does not have"),
            (None, None) if own.parts != theirs.parts => String::from("the parts stand in another order"),
            (None, None) if own.drawn != theirs.drawn => String::from("the parts are drawn elsewhere"),
            (None, None) => return Ok(()),
        };
        Err(format!(
            "the state is of another mechanism: {difference}; beams with their elements, bodies, frames, joints, drives, locks, gears and springs must be the same, and drawn alike"
        ))
    }

    /// Goes on from a state, or begins with it, instead of [`Model::initialize`].
    ///
    /// # Errors
    /// It is of another mechanism, or the joints and drives of this one do not hold there.
    pub fn begin_from(&mut self, kept: &Kept) -> Result<(), Failure> {
        self.fits(kept).map_err(wrong)?;
        if self.label(kept.time()).file == kept.label.file {
            let snapshot = Snapshot::read(&self.document, self.results.len(), &kept.snapshot).map_err(wrong)?;
            self.go_back_to(&snapshot);
            return Ok(());
        }
        let state = Snapshot::state_in(&kept.snapshot).map_err(wrong)?;
        let (document, start) = (Arc::clone(&self.document), kept.time());
        let built = builder::build(&document, start).map_err(|mistakes| wrong(mistakes.to_string()))?;
        let mut runner = Runner::new(built, &document, start);
        let origin = runner.system.origin;
        builder::aim(&document, &origin, |number| self.inputs.line(number), [start; 2], &mut runner.state.targets);
        let warnings = runner.begin_at(&document, &state, self.table.needs_response());
        self.warnings.extend(warnings.map_err(|error| failure(&error))?);
        let before = std::mem::replace(&mut self.runner, runner);
        self.forget_step();
        self.watch = Watch::new(&document);
        self.accuracy = Accuracy::default();
        self.forget_mesh_errors();
        let outcome = self.measure();
        if outcome.is_err() {
            self.runner = before;
        }
        outcome
    }
}

impl Runner {
    /// Begins with the coordinates and velocities of `from`, a state of the same parts, and with what acts now. Returns what the user should know of it.
    fn begin_at(&mut self, document: &Document, from: &State, responds: bool) -> Result<Vec<String>, Error> {
        let Self { system, state, solver, pacing, .. } = self;
        state.prescribed.holds = system.holds_at(state.time, &state.targets).map(Hold::drawn).collect();
        state.take_place_of(from);
        let mut frames = FrameCache::default();
        frames.of(system, state);
        // Angles and sensors that the other run did not have are where the parts are.
        system.carry_references(state, &frames);
        state.targets.depart(state.time, &state.prescribed);
        state.targets.departure.step = 0.0;
        if system.switches_at(state, state.time) {
            system.switch(state, state.time);
        }
        *solver = Solver::new(document, system, *pacing)?;
        self.responder = responds.then(|| Box::new(Responder::new(system)));
        let mut warnings = system.too_fine_meshes();
        let changed = match solver {
            Solver::Midpoint(midpoint) => start::set_motion(system, midpoint, state)?,
            Solver::GeneralizedAlpha(alpha) => {
                warnings.extend(alpha.objection(system));
                start::set_motion(system, alpha, state)?
            }
            Solver::Statics(statics) => {
                state.velocity.fill(0.0);
                state.targets.straight = true;
                statics.find(system, state, state.time)?;
                statics.begin_path(system, state)?;
                warnings.extend(statics.take_remarks());
                0.0
            }
            Solver::None => 0.0,
        };
        start::check_assembled(system, state)?;
        if changed > 0.0 {
            warnings.push(format!(
                "the velocities of the state do not fit the joints and drives of this model: they were changed to the nearest that do, a change of {} of their kinetic energy",
                percent(changed)
            ));
        }
        Ok(warnings)
    }
}

/// What has a place in the state, in its order.
fn parts(simulation: &Simulation) -> Vec<String> {
    let (document, system) = (&*simulation.document, &*simulation.runner.system);
    let beams = system.beams.iter().map(|beam| format!("beam {} with {} elements", beam.name, beam.elements()));
    let named = |what: &'static str, names: Vec<&String>| {
        names.into_iter().map(move |name| format!("{what} {name}")).collect::<Vec<_>>()
    };
    beams
        .chain(named("body", document.bodies.iter().map(|own| &own.name).collect()))
        .chain(named("frame", document.frames.iter().map(|own| &own.name).collect()))
        .chain(named("joint", document.joints.iter().map(|own| &own.name).collect()))
        .chain(named("drive", document.drives.iter().map(|own| &own.name).collect()))
        .chain(named("lock", document.locks.iter().map(|own| &own.name).collect()))
        .chain(named("gear", document.gears.iter().map(|own| &own.name).collect()))
        .chain(named("spring", document.springs.iter().map(|own| &own.name).collect()))
        .chain(named("friction", document.frictions.iter().map(|own| &own.name).collect()))
        .chain(named("stop", document.stops.iter().map(|own| &own.name).collect()))
        .collect()
}
