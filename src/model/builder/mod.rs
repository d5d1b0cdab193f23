//! From the typed file to the system: `validate` has checked it, or does so here after a change of parameters.
//!
//! A file a kind of part; what may change while the system runs is in tune.rs.

mod contacts;
mod fluids;
mod foundations;
mod heat;
mod joints;
mod origin;
mod parts;
mod ropes;
mod switches;
mod tune;

pub use tune::{aim, retune, switches, undirected};

use super::expression::function::Function;
use super::file::document::Document;
use super::file::entries::output::{self, OutputSpec};
use super::file::entries::simulation::Total;
use super::file::number::Number;
use super::file::reader::anchor::{Along, Anchor, Spot};
use super::shape::Lines;
use super::text::diagnostic::{Diagnostic, Diagnostics};
use super::text::names::Kind;
use super::validate;
use crate::math::bounds::Bounds;
use crate::math::jet::Jet;
use crate::math::rotation::nearest_rotation;
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::input::signal::{Pieces, Signal, TimeBounds};
use crate::mechanics::marker::Marker;
use crate::mechanics::state::State;
use crate::mechanics::state::energy_account::EnergyAccount;
use crate::mechanics::system::System;
use crate::mechanics::system::builder::SystemBuilder;
use crate::solve::step::mobility::set_mobilities;
use std::sync::Arc;

/// The system as drawn.
#[derive(Clone, Debug)]
pub struct Built {
    /// The system.
    pub system: System,
    /// Its state as drawn, velocities as given.
    pub state: State,
}

/// Whether the parameters of now make a system, as far as that can be seen without building it.
///
/// # Errors
/// Every mistake that the geometry shows, in file order.
pub fn check(document: &Document) -> Result<(), Diagnostics> {
    let (_, mistakes) = validate::examine(document);
    if mistakes.is_empty() { Ok(()) } else { Err(Diagnostics(mistakes)) }
}

/// Builds the system with the parameters of now, as drawn; `start` is the time of its state, s.
///
/// # Errors
/// Every mistake that the geometry shows, in file order.
pub fn build(document: &Document, start: f64) -> Result<Built, Diagnostics> {
    let (lines, mistakes) = validate::examine(document);
    if !mistakes.is_empty() {
        return Err(Diagnostics(mistakes));
    }
    let origin = origin::of(document, &lines);
    // A run that begins later begins with the same joints: what has moved until then has moved away from the drawing.
    let system = SystemBuilder::new(start).drawn_at(document.drawn_at(0.0));
    let mut builder =
        Builder { document, lines: &lines, origin, system, mistakes: Vec::new(), joint_switches: Vec::new() };
    for (number, beam) in document.beams.iter().enumerate() {
        builder.add_beam(beam, lines.line(number).expect("without mistakes every beam is drawn"));
    }
    document.bodies.iter().for_each(|body| builder.add_body(body));
    document.frames.iter().for_each(|frame| builder.add_frame(frame));
    let springs = document.springs_in_system(&document.numbers, 1.0);
    springs.for_each(|(name, action, strength)| builder.add_spring(name, action, strength));
    document.joints.iter().for_each(|joint| builder.add_joint(joint));
    builder.join_springs();
    document.drives.iter().for_each(|drive| builder.add_drive(drive));
    document.winches.iter().for_each(|winch| builder.add_winch(winch));
    document.actuators.iter().for_each(|actuator| builder.add_actuator(actuator));
    document.locks.iter().for_each(|lock| builder.add_lock(lock));
    document.gears.iter().for_each(|gear| builder.add_gear(gear));
    document.contacts.iter().enumerate().for_each(|(number, contact)| builder.add_contact(number, contact));
    document.foundations.iter().for_each(|foundation| builder.add_foundation(foundation));
    document.ropes.iter().for_each(|rope| builder.add_rope(rope));
    document.loads.iter().for_each(|load| builder.add_load(load));
    document.outputs.iter().for_each(|output| builder.add_sensors(output));
    if !builder.mistakes.is_empty() {
        return Err(Diagnostics(builder.mistakes));
    }
    let (mut system, mut state) = builder.system.finish(vector(document, document.model.gravity));
    system.origin = origin;
    system.fluids = fluids::fluids(document, &lines, &system);
    state.balance.account = document.simulation.totals.contains(&Total::Work).then(EnergyAccount::default);
    // The size of the mechanism is known now.
    tune::set_springs(document, &mut system);
    set_mobilities(&mut system, &state, document.largest_step());
    Ok(Built { system, state })
}

fn vector(document: &Document, numbers: [Number; 3]) -> Vec3 {
    Vec3::from(document.vector(numbers))
}

/// The rotation that rows of the file mean, as columns: as written they are orthonormal to some digits.
fn nearest_axes(document: &Document, rows: [[Number; 3]; 3]) -> Mat3 {
    nearest_rotation(&Mat3::from_columns(&rows.map(|row| vector(document, row))))
}

/// A number that may vary along a beam, at the arc length `s`, m.
fn function_value(document: &Document, number: Number, s: f64) -> f64 {
    let function = document.function(number);
    if function.is_constant() { document.value(number) } else { function.value(s) }
}

fn signal(document: &Document, number: Number) -> Signal {
    signal_from(document, number, 0.0)
}

/// The function of time that a number of the file is, counted from `origin`.
fn signal_from(document: &Document, number: Number, origin: f64) -> Signal {
    function_signal(document, document.function(number), origin)
}

/// A function of time, counted from `origin`.
fn function_signal(document: &Document, function: Function, origin: f64) -> Signal {
    if function.is_constant() {
        return Signal::Constant(function.value(0.0) - origin);
    }
    let span = document.span();
    let breaks = function.breaks(span);
    let function = Arc::new(function);
    let bounds = (!function.switches_too_often(span)).then(|| {
        let peak = function.bounded(|bounded| bounded.peak(span));
        let own = function.clone();
        let bounds = move |interval| own.over(interval) - Bounds::constant(origin);
        TimeBounds { bounds: Box::new(bounds), peak }
    });
    pieces(function, origin, breaks, bounds)
}

/// Whether a station, a number of the file, is on its beam: 1 between 0 and 1, 0 at both, else -1.
fn presence(document: &Document, station: Number) -> Signal {
    let function = document.function(station);
    let is_on = |station: Jet| station.sign().min((Jet::constant(1.0) - station).sign());
    if function.is_constant() {
        return Signal::Constant(is_on(Jet::constant(function.value(0.0))).value);
    }
    let span = document.span();
    let breaks = function.breaks(span);
    let function = Arc::new(function);
    let own = function.clone();
    // The very operations of `is_on`: both then switch at the same number.
    let bounds = move |interval| {
        let station = own.over(interval);
        station.sign().min((Bounds::constant(1.0) - station).sign())
    };
    Signal::Pieces(Arc::new(Pieces {
        jet: Box::new(move |time| is_on(function.jet(time))),
        breaks,
        undefined: Box::new(|_| None),
        bounds: Some(TimeBounds { bounds: Box::new(bounds), peak: 1.0 }),
    }))
}

/// The function of time that a number of the file is, with `breaks` of its own.
fn signal_with(document: &Document, number: Number, breaks: Vec<f64>) -> Signal {
    let function = document.function(number);
    if function.is_constant() {
        return Signal::Constant(function.value(0.0));
    }
    pieces(Arc::new(function), 0.0, breaks, None)
}

fn pieces(function: Arc<Function>, origin: f64, breaks: Vec<f64>, bounds: Option<TimeBounds>) -> Signal {
    let own = function.clone();
    let jet = move |time| {
        let jet = own.jet(time);
        Jet { value: jet.value - origin, ..jet }
    };
    let undefined = move |time| function.undefined(time).map(|reason| reason.to_string());
    Signal::Pieces(Arc::new(Pieces { jet: Box::new(jet), breaks, undefined: Box::new(undefined), bounds }))
}

/// Builds what [`validate::examine`] has found sound.
struct Builder<'a> {
    document: &'a Document,
    lines: &'a Lines,
    /// See [`System::origin`].
    origin: Vec3,
    system: SystemBuilder,
    /// What only the start time shows to be wrong.
    mistakes: Vec<Diagnostic>,
    /// The switches of joints, by their indices in the file; none: the joint always holds.
    joint_switches: Vec<Option<usize>>,
}

impl Builder<'_> {
    /// The fraction of its length at which a point of a beam is.
    fn fraction(&self, beam: usize, along: Along) -> f64 {
        self.lines.fraction(self.document, beam, along).expect("without mistakes every point is on its beam")
    }

    /// A position of the file, as the state has it, m.
    fn position(&self, numbers: [Number; 3]) -> Vec3 {
        vector(self.document, numbers) - self.origin
    }

    /// What an anchor names, with its own axes: a section, a body, a frame, the ground, or a point that is tied to one
    /// of these.
    fn anchored(&self, anchor: &Anchor) -> Marker {
        let carrier = self.carrier(anchor.spot);
        let Some(point) = anchor.point.map(|point| &self.document.points[point]) else { return carrier };
        let axes = point.axes.map_or_else(Mat3::identity, |rows| {
            self.system.drawn(&carrier).axes.tr_mul(&nearest_axes(self.document, rows))
        });
        carrier.carried(&vector(self.document, point.offset), &axes)
    }

    /// Makes the section rigid at which an arm begins: a force at the end of the arm has a moment there, which acts on
    /// all of the section.
    fn stiffen_below(&mut self, marker: &Marker) {
        if marker.arm() != Vec3::zeros() {
            self.system.stiffen(marker);
        }
    }

    /// What can carry a point, with its own axes.
    fn carrier(&self, spot: Spot) -> Marker {
        match spot {
            Spot::Ground => Marker::Ground(Pose { place: Vec3::zeros() - self.origin, ..Pose::default() }),
            Spot::Beam { beam, along } => self.system.section_at(beam, self.fraction(beam, along)),
            Spot::Body(body) => self.system.body(body),
            Spot::Frame(frame) => self.system.frame(frame),
        }
    }

    /// What an output looks at: a point for each station; joints and drives are looked at without one, unless somebody
    /// looks who moves. Adds [`OutputSpec::sensors`] sensors.
    fn add_sensors(&mut self, output: &OutputSpec) {
        let observer = output.observer.as_ref().map(|observer| self.anchored(&observer.anchor));
        let first = self.system.sensors();
        match &output.target {
            output::Target::At(anchor) => {
                match (anchor.spot, anchor.point) {
                    (Spot::Beam { beam, along }, None) => self.system.add_sensor(beam, self.fraction(beam, along)),
                    _ => self.system.watch(self.anchored(anchor), None),
                };
            }
            output::Target::On { beam, stations } => {
                for station in 0..*stations {
                    self.system.add_sensor(*beam, station as f64 / (stations - 1) as f64);
                }
            }
            output::Target::Connection(Kind::Joint, _) => {
                observer.iter().for_each(|marker| {
                    self.system.watch(*marker, None);
                });
            }
            output::Target::Connection(..) | output::Target::Whole(..) => {}
        }
        (first..self.system.sensors()).for_each(|sensor| self.system.face(sensor, output.side));
        if let Some(marker) = observer {
            (first..self.system.sensors()).for_each(|sensor| self.system.observe(sensor, marker));
        }
    }
}
