//! The state that a run leaves in a file, and the run that continues from it or begins with it.
//!
//! The bytes are those of a saved state, behind a label that tells whether it fits: the parts of the mechanism with
//! their names, where these are drawn, and a hash of the model file. A run of the same file continues as if the first
//! one had not ended. A run of another file with the same parts begins there: coordinates and velocities are those of
//! the state, and loads, drives, switches and stiffnesses those of the file.

use super::runner::Runner;
use super::saved::Snapshot;
use super::{Simulation, failure, wrong};
use crate::error::Error;
use crate::fmi::instance::serialized::{Flaw, Magic, ROOM, content, seal};
use crate::fmi::{Failure, Model};
use crate::mechanics::input::switch::Hold;
use crate::mechanics::marker::relative_coordinate::{Measure, RelativeCoordinate};
use crate::mechanics::state::place::Counterparts;
use crate::mechanics::state::{State, Statistics};
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::builder::{self, Built};
use crate::model::file::document::Document;
use crate::model::file::entries::joint::JointSpec;
use crate::model::file::entries::simulation::Analysis;
use crate::model::text::names::Kind;
use crate::solve::dynamics::start;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// First bytes of every file with a state that a run left.
const MAGIC: Magic = *b"ancf14rs";

/// The keys that say how long a run is and which rows it writes. Another value does not make another model, although
/// equilibria are found row by row, and steps that the solver chooses depend on the length of the run.
const ROWS: [&str; 2] = ["simulation.stop", "simulation.output_step"];

/// What a state is of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Label {
    /// Time, s.
    time: f64,
    /// A hash of the model file and of its overrides, but for [`ROWS`].
    file: String,
    /// Parts and what connects them, each with its name: all that has the same place in the states of two models.
    parts: Vec<String>,
    /// Coordinates as drawn, and the origin that they are counted from.
    drawn: Vec<f64>,
    /// The relative coordinates: of an angle, which continues over turns, what it is between. Of others, which the
    /// coordinates give, nothing.
    angles: Vec<String>,
    /// The sensors, whose rotation vectors continue over turns: what they are on, and who looks.
    sensors: Vec<String>,
    /// The names of the switches.
    switches: Vec<String>,
    /// The names of forces that remember.
    memories: Vec<String>,
}

/// A state that a run has left.
#[derive(Clone, Debug)]
pub struct Kept {
    label: Label,
    state: State,
    snapshot: Vec<u8>,
}

/// A state that a simulation can begin with.
#[derive(Clone, Debug)]
pub struct Beginning {
    kept: Kept,
    continues: bool,
    counterparts: Counterparts,
    /// Joints whose angles the other model does not have, by their names.
    unknown: Vec<String>,
}

impl Kept {
    /// The state that [`Simulation::keep`] wrote.
    ///
    /// # Errors
    /// The bytes are not such a state, or damaged: in words that follow the name of their file.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let content = content(&MAGIC, bytes).map_err(|flaw| match flaw {
            Flaw::Foreign(_) => String::from("it does not begin as such a file does"),
            Flaw::Layout(_) => String::from("another version of the program has written it"),
            Flaw::Length(written, there) => format!("it has {there} bytes behind its header instead of {written}"),
            Flaw::Checksum => String::from("its checksum is wrong, the file is damaged"),
        })?;
        let (label, snapshot): (Label, &[u8]) =
            postcard::take_from_bytes(content).map_err(|reason| format!("its label cannot be read: {reason}"))?;
        let state = Snapshot::state_in(snapshot)?;
        if !state.is_finite() {
            return Err(String::from("it has numbers that are not finite"));
        }
        if state.time != label.time {
            return Err(format!("its label has t = {} s, its state t = {} s", label.time, state.time));
        }
        Ok(Self { label, state, snapshot: snapshot.to_vec() })
    }

    /// The time at which it was taken, s.
    pub fn time(&self) -> f64 {
        self.label.time
    }
}

impl Beginning {
    /// The time at which the run begins, s.
    pub fn time(&self) -> f64 {
        self.kept.time()
    }

    /// The counts of the run that is continued; of another model's run none.
    pub fn counts(&self) -> Statistics {
        if self.continues { self.kept.state.statistics } else { Statistics::default() }
    }

    /// Whether the run continues the one that left the state: the model file and its overrides are the same.
    pub fn continues(&self) -> bool {
        self.continues
    }
}

impl Simulation {
    /// The bytes of the state that is reached, for [`Kept::read`].
    ///
    /// # Errors
    /// Parameters that were set since the start make a mechanism that cannot be drawn.
    pub fn keep(&self) -> Result<Vec<u8>, Failure> {
        let label = self.label(&self.drawing().map_err(wrong)?, self.time());
        let bytes = postcard::to_extend(&label, vec![0; ROOM]);
        Ok(seal(&MAGIC, self.save().write(bytes.expect("a Vec takes every byte, and all lengths are known"))))
    }

    /// The system as it is drawn for a run from 0: the parts of two models are compared in their drawings.
    fn drawing(&self) -> Result<Built, String> {
        let document = &*self.document;
        builder::build(document, document.drawn_at(0.0)).map_err(|mistakes| mistakes.to_string())
    }

    fn label(&self, drawing: &Built, time: f64) -> Label {
        let (document, Built { system, state }) = (&*self.document, drawing);
        let mut overrides = document.remaining(&self.overrides);
        overrides.retain(|(key, _)| !ROWS.contains(&key.as_str()));
        // Their order makes no difference.
        overrides.sort_by(|(one, _), (other, _)| one.cmp(other));
        let mut text = document.text().to_owned();
        overrides.iter().for_each(|(key, value)| text.push_str(&format!("\n{key}={value}")));
        Label {
            time,
            file: uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_URL, text.as_bytes()).to_string(),
            parts: parts(document, system),
            drawn: state.q.iter().chain(&system.origin).copied().collect(),
            angles: system.relative_coordinates.iter().map(|own| angle(document, system, own)).collect(),
            sensors: system
                .sensors
                .iter()
                .map(|sensor| format!("{:?} {:?} {:?}", sensor.marker.bare(), sensor.on_beam, sensor.observer))
                .collect(),
            switches: system.switches.iter().map(|switch| switch.name.clone()).collect(),
            memories: system.memories().collect(),
        }
    }

    /// How this simulation continues from a state or begins with it.
    ///
    /// # Errors
    /// It cannot: the state belongs to a mechanism with other parts, in words.
    pub fn fit(&self, kept: Kept) -> Result<Beginning, String> {
        self.fit_as(kept, true)
    }

    /// How this simulation begins with a state, also with one that a run of the same file has left.
    ///
    /// # Errors
    /// As [`Self::fit`].
    pub(super) fn fit_to_begin(&self, kept: Kept) -> Result<Beginning, String> {
        self.fit_as(kept, false)
    }

    fn fit_as(&self, kept: Kept, may_continue: bool) -> Result<Beginning, String> {
        let drawing = self.drawing()?;
        let (own, theirs) = (self.label(&drawing, kept.time()), &kept.label);
        own.check_parts(theirs)?;
        let lengths = [&theirs.angles, &theirs.sensors, &theirs.switches, &theirs.memories].map(Vec::len);
        if !kept.state.has_the_place_of(&drawing.state, lengths) {
            return Err(String::from(
                "the lists of the state do not have the lengths that its mechanism needs. Write the state again",
            ));
        }
        let continues = may_continue && own.file == theirs.file;
        if !continues && kept.state.path.is_some() {
            return Err(String::from(
                "the state is at an arc length of a path, not at a time, and only the same model with the same overrides can continue it. For another model, \
                 write the state with simulation.follow = \"time\"",
            ));
        }
        let counterparts = Counterparts {
            relative_values: counterparts(&own.angles, &theirs.angles),
            rotations: counterparts(&own.sensors, &theirs.sensors),
            holds: counterparts(&own.switches, &theirs.switches),
            memory: counterparts(&own.memories, &theirs.memories),
        };
        let coordinates =
            drawing.system.relative_coordinates.iter().zip(&own.angles).zip(&counterparts.relative_values);
        let without = coordinates.filter(|((_, angle), number)| !angle.is_empty() && number.is_none());
        let joints = without.filter_map(|((own, _), _)| joint_of(&self.document, &drawing.system, own));
        let mut unknown: Vec<String> = joints.map(|joint| joint.name.clone()).collect();
        unknown.sort();
        unknown.dedup();
        Ok(Beginning { continues, counterparts, unknown, kept })
    }

    /// Continues from a state, or begins with it, instead of [`Model::initialize`].
    ///
    /// # Errors
    /// The joints and drives of this model do not hold there.
    pub fn begin_from(&mut self, beginning: &Beginning) -> Result<(), Failure> {
        let Beginning { kept, continues, unknown, .. } = beginning;
        if *continues {
            let snapshot = Snapshot::read(&self.document, self.results.len(), &kept.snapshot).map_err(wrong)?;
            self.go_back_to(&snapshot);
            return Ok(());
        }
        self.check()?;
        let start = kept.time();
        self.warn_of_quaternions([start; 2]);
        // Inputs do not change the drawing: it must be that of the state.
        let built = self.drawing().map_err(wrong)?;
        let document = Arc::clone(&self.document);
        let mut runner = Runner::new(built, &document, start);
        let origin = runner.system.origin;
        builder::aim(&document, &origin, |number| self.inputs.line(number), [start; 2], &mut runner.state.targets);
        let warnings = runner.begin_at(&document, beginning, self.table.needs_response());
        self.warnings.extend(warnings.map_err(|error| failure(&error))?);
        let without = |name: &String| {
            format!(
                "the state does not have the angle of joint {name}, which is taken within half a turn of the drawing"
            )
        };
        self.warnings.extend(unknown.iter().map(without));
        self.begin_with(runner)
    }
}

impl Runner {
    /// Begins with the coordinates and velocities of a state of the same parts, and with what acts now. Returns what
    /// the user should know of it.
    fn begin_at(
        &mut self,
        document: &Document,
        Beginning { kept: Kept { state: from, .. }, counterparts, .. }: &Beginning,
        responds: bool,
    ) -> Result<Vec<String>, Error> {
        let Self { system, state, .. } = self;
        state.time = from.time;
        state.prescribed.holds = system.holds_at(state.time, &state.targets).map(Hold::drawn).collect();
        state.take_place_of(from, counterparts);
        system.set_heats(state.time, &state.targets, &mut state.prescribed.heats);
        let mut frames = FrameCache::default();
        frames.of(system, state);
        // Angles and sensors that the other run did not have are where the parts are.
        system.carry_references(state, &frames);
        state.targets.depart(state.time, &state.prescribed);
        state.targets.departure.step = 0.0;
        if system.switches_at(state, state.time) {
            system.switch(state, state.time);
        }
        let mut warnings = self.set_up(document, responds)?;
        let given = "the velocities of the state";
        match document.simulation.analysis {
            Analysis::Dynamic => {
                warnings.extend(self.system.jumps(self.start, document.value(document.simulation.stop)));
                self.set_motion(given, &mut warnings)?;
                start::check_paid_out(&self.system, from, &self.state)?;
            }
            Analysis::Static => self.find_equilibrium(given, &mut warnings)?,
        }
        start::check_assembled(&self.system, &self.state)?;
        Ok(warnings)
    }
}

impl Label {
    /// Whether another one, of a state, has the same parts, drawn in the same position.
    fn check_parts(&self, theirs: &Self) -> Result<(), String> {
        let missing = theirs.parts.iter().find(|part| !self.parts.contains(part));
        let added = self.parts.iter().find(|part| !theirs.parts.contains(part));
        let difference = match (missing, added) {
            (Some(part), _) => format!("the state has {part}, which the model does not have"),
            (None, Some(part)) => format!("the model has {part}, which the state does not have"),
            (None, None) if self.parts != theirs.parts => String::from("the parts are in a different order"),
            (None, None) if self.drawn != theirs.drawn => String::from("the parts are drawn elsewhere"),
            (None, None) => return Ok(()),
        };
        Err(format!(
            "the state belongs to a different mechanism: {difference}. Use a model with the same beams, elements, bodies, frames, joints, drives, locks, gears, \
             springs, friction and stops, drawn in the same place"
        ))
    }
}

/// Where labels are among others; none of those that say nothing.
fn counterparts(own: &[String], theirs: &[String]) -> Vec<Option<usize>> {
    let place = |label: &String| theirs.iter().position(|other| other == label).filter(|_| !label.is_empty());
    own.iter().map(place).collect()
}

/// The joint of the file whose sides a relative coordinate is between.
fn joint_of<'a>(document: &'a Document, system: &System, own: &RelativeCoordinate) -> Option<&'a JointSpec> {
    let has_sides = |joint: usize| system.joints[joint].a == own.a && system.joints[joint].b == own.b;
    let mut joints = document.joints.iter().zip(&system.joint_parts);
    joints.find(|(_, parts)| parts.joint.is_some_and(has_sides)).map(|(joint, _)| joint)
}

/// What an angle is between, and about which axis as drawn. Two angles for which it is the same have the same turns.
/// Nothing of other relative coordinates.
fn angle(document: &Document, system: &System, own: &RelativeCoordinate) -> String {
    match own.measure {
        Measure::Angle(_) => {
            let axis = joint_of(document, system, own).and_then(|joint| joint.axis).map(|axis| document.vector(axis));
            format!("{:?} about {axis:?} against {:?}", own.b.bare(), own.a.bare())
        }
        Measure::Distance(_) | Measure::Length | Measure::Rotation(_) => String::new(),
    }
}

/// What has a position in the state, in its order.
fn parts(document: &Document, system: &System) -> Vec<String> {
    let beams = system.beams.iter().map(|beam| format!("beam {} with {} elements", beam.name, beam.elements()));
    let winches = document.winches.iter().map(|own| {
        let (beam, end) = (&document.beams[own.beam].name, if own.at_end { "end" } else { "start" });
        format!("winch {} at {beam}.{end}", own.name)
    });
    let named = |kind: Kind| {
        document.each().filter(move |own| own.0 == kind).map(move |(_, name, _)| format!("{} {name}", kind.word()))
    };
    let before = [Kind::Body, Kind::Frame, Kind::Joint, Kind::Drive];
    let behind = [Kind::Lock, Kind::Gear, Kind::Spring, Kind::Friction, Kind::Stop];
    beams.chain(before.into_iter().flat_map(named)).chain(winches).chain(behind.into_iter().flat_map(named)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::jet::Jet;
    use crate::mechanics::geometry::pose::Pose;
    use crate::mechanics::input::prescribed::MovingPose;

    /// A rod on a hinge.
    const MODEL: &str = r#"format = 1
[model]
name = "Rod"
[material.steel]
young = 210e9
poisson = 0.3
density = 7850
[section.rod]
shape = "circle"
radius = 0.005
[beam.rod]
material = "steel"
section = "rod"
from = [0, 0, 0]
to = [0.3, 0, 0]
elements = 2
[joint.hinge]
type = "revolute"
a = "ground"
b = "rod.start"
axis = [0, 1, 0]
[output.tip]
at = "rod.end"
quantities = ["rotation"]
[simulation]
stop = 1
step = 1e-3
"#;

    fn begun() -> Simulation {
        let mut simulation = Simulation::load("m.toml", MODEL, &[]).unwrap();
        simulation.initialize(0.0).unwrap();
        simulation
    }

    fn problem(bytes: &[u8]) -> String {
        let outcome = Kept::read(bytes).and_then(|kept| begun().fit(kept));
        outcome.err().unwrap_or_default()
    }

    /// A file with the right checksum may have any numbers in it: lists of other lengths and numbers that are not
    /// finite are refused, before the run of the same or of another model.
    #[test]
    fn flawed_states_are_refused() {
        assert_eq!(problem(&begun().keep().unwrap()), "");
        let flawed = |flaw: fn(&mut State)| {
            let mut simulation = begun();
            flaw(&mut simulation.runner.state);
            problem(&simulation.keep().unwrap())
        };
        let lengths: [fn(&mut State); 9] = [
            |state| state.q.push(0.0),
            |state| state.velocity.clear(),
            |state| state.triads.truncate(1),
            |state| state.holonomy.push(0.0),
            |state| state.relative_values.clear(),
            |state| state.rotations.clear(),
            |state| state.prescribed.holds.push(Hold::drawn(true)),
            |state| state.prescribed.drives.push(Jet::constant(0.0)),
            |state| state.prescribed.frames.push(MovingPose::at_rest(Pose::default())),
        ];
        for (number, flaw) in lengths.into_iter().enumerate() {
            let problem = flawed(flaw);
            assert!(problem.contains("the lists of the state do not have the lengths"), "{number}: {problem}");
        }
        let numbers: [fn(&mut State); 6] = [
            |state| state.q[0] = f64::NAN,
            |state| state.velocity[3] = f64::INFINITY,
            |state| state.momentum[1] = f64::NAN,
            |state| state.triads[1].u[2] = f64::NAN,
            |state| state.relative_values[0] = f64::NAN,
            |state| state.rotations[0][1] = f64::NAN,
        ];
        for (number, flaw) in numbers.into_iter().enumerate() {
            let problem = flawed(flaw);
            assert!(problem.contains("not finite"), "{number}: {problem}");
        }
    }

    /// Bytes behind the state, and a label with another time.
    #[test]
    fn states_must_be_what_their_label_says() {
        let simulation = begun();
        let more = seal(&MAGIC, [&simulation.keep().unwrap()[..], &[0]].concat());
        assert!(problem(&more).contains("1 bytes are left behind the state"), "{}", problem(&more));
        let label = simulation.label(&simulation.drawing().unwrap(), 0.5);
        let bytes = postcard::to_extend(&label, vec![0; ROOM]).unwrap();
        let other = problem(&seal(&MAGIC, simulation.save().write(bytes)));
        assert!(other.contains("its label has t = 0.5 s, its state t = 0 s"), "{other}");
    }

    /// An FMU state is another kind of file, although its state is the same.
    #[test]
    fn states_of_fmus_are_refused() {
        let mut bytes = begun().keep().unwrap();
        bytes[..8].copy_from_slice(b"ancf14st");
        assert!(problem(&bytes).contains("it does not begin as such a file does"));
    }
}
