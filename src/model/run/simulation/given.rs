//! The inputs of a linear system: those that a host gives, and the motions of drives.

use super::{Simulation, wrong};
use crate::fmi::Failure;
use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::math::rotation::{rotation_matrix, rotation_matrix_jet};
use crate::mechanics::geometry::pose::{Pose, angular_velocity};
use crate::mechanics::input::prescribed::MovingPose;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::model::builder;
use crate::model::file::document::Document;
use crate::model::file::entries::drive::Motion;
use crate::model::file::entries::frame::Orientation;
use crate::model::file::number::Number;
use crate::model::variables::Source;
use crate::model::variables::inputs::Inputs;
use crate::solve::linearization;
use crate::solve::linearization::state_space::change_drive;

/// The change that an input makes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    /// A number that a host gives: a load, an effort, a temperature.
    Number(Number),
    /// The motion of a drive, by its number in the system.
    Drive(usize),
    /// The position of a frame along an axis.
    Position { frame: usize, axis: usize },
    /// The orientation of a frame: the turn, about fixed axes, with a unit of a component of its rotation vector.
    Rotation { frame: usize, turn: Vec3 },
}

/// An input of a linear system.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Given {
    /// Its name and unit.
    pub name: String,
    pub unit: String,
    /// Its value now: of a motion its acceleration.
    pub value: f64,
    /// Value and rate of a motion, which are states: names, units, values now.
    pub states: Option<[(String, String, f64); 2]>,
    /// The variable of a host that it stands for; empty: none.
    pub variable: String,
    change: Change,
}

impl Given {
    fn motion(part: &str, [value, rate, acceleration]: [&str; 3], unit: &str, jet: Jet, change: Change) -> Self {
        let name = |word: &str| format!("{part}.{word}");
        let states = [(name(value), unit.to_owned(), jet.value), (name(rate), format!("{unit}/s"), jet.first)];
        let (name, unit) = (name(acceleration), format!("{unit}/s2"));
        Self { name, unit, value: jet.second, states: Some(states), variable: String::new(), change }
    }

    /// Whether a host gives the rate of a motion instead of its value.
    pub fn is_rate(&self, document: &Document) -> bool {
        let Change::Drive(drive) = self.change else { return false };
        matches!(document.motions().nth(drive), Some((Motion::Rate(_), _)))
    }

    /// Whether somebody who asks for `name` means it: by its name, by that of the variable of a host, or by either
    /// without the component.
    pub fn is_called(&self, name: &str) -> bool {
        [&self.name, &self.variable].into_iter().any(|own| is_part_of(own, name))
    }
}

/// Whether `name` is `wanted` or one of its components.
pub(super) fn is_part_of(name: &str, wanted: &str) -> bool {
    name == wanted || name.strip_prefix(wanted).is_some_and(|rest| rest.starts_with('['))
}

/// Inputs that act on states.
pub(super) struct Asked<'a> {
    pub document: &'a Document,
    pub inputs: &'a Inputs,
    pub given: Vec<Given>,
    pub system: &'a System,
}

impl linearization::Inputs for Asked<'_> {
    fn count(&self) -> usize {
        self.given.len()
    }

    fn is_motion(&self, number: usize) -> bool {
        self.given[number].states.is_some()
    }

    fn change(&self, number: usize, order: usize, by: f64, state: &mut State) {
        match self.given[number].change {
            Change::Number(changed) => {
                let line = |number: Number| {
                    let (value, _) = self.inputs.line(number);
                    (if number == changed { value + by } else { value }, 0.0)
                };
                let time = state.instant();
                builder::aim(self.document, &self.system.origin, line, [time, time], &mut state.targets);
                for (heat, guide) in state.prescribed.heats.iter_mut().zip(&self.system.heats) {
                    *heat = guide.start(time, &state.targets);
                }
            }
            Change::Drive(drive) => change_drive(&mut state.prescribed, drive, order, by),
            Change::Position { frame, axis } => {
                pose_of(&mut state.prescribed.frames[frame], order).place[axis] += by;
            }
            Change::Rotation { frame, turn } => {
                let frame = &mut state.prescribed.frames[frame];
                let axes = frame.pose.axes;
                match order {
                    0 => frame.pose.axes = rotation_matrix(&(turn * by)) * axes,
                    _ => pose_of(frame, order).axes += turn.cross_matrix() * axes * by,
                }
            }
        }
    }
}

fn pose_of(frame: &mut MovingPose, order: usize) -> &mut Pose {
    [&mut frame.pose, &mut frame.velocity, &mut frame.acceleration].into_iter().nth(order).expect("three derivatives")
}

impl Simulation {
    /// The inputs that a host gives, and after them the motions of drives that functions of time prescribe; `state` is
    /// the one that they are changed from. How many the first ones are.
    pub(super) fn givens(&self, state: &State) -> (Vec<Given>, usize) {
        let (document, table) = (&*self.document, &*self.table);
        let mut all = Vec::new();
        let mut motions = Vec::new();
        for (number, drive) in self.runner.system.drives.iter().enumerate() {
            let is_angle = document.drives.get(number).is_some_and(|drive| drive.is_angle());
            let unit = if is_angle { "rad" } else { "m" };
            let words = ["value", "rate", "acceleration"];
            let jet = state.prescribed.drives[number];
            motions.push(Some(Given::motion(&drive.name, words, unit, jet, Change::Drive(number))));
        }
        let switches: Vec<Number> =
            builder::switches(document).flatten().filter(|own| own.input).map(|own| own.active).collect();
        let rows = table.variables.iter().zip(&table.sources);
        for (variable, index) in rows.filter_map(|(variable, source)| match source {
            Source::Input(index) => Some((variable, *index)),
            _ => None,
        }) {
            let number = self.inputs.number(index);
            if switches.contains(&number) {
                continue;
            }
            let drive = document.motions().position(|(motion, is_input)| is_input && motion.number() == number);
            let given = match drive {
                Some(drive) => motions[drive].take(),
                None => match of_frame(document, state, number, &self.inputs) {
                    Some(given) => given,
                    None => Some(Given {
                        name: variable.name.clone(),
                        unit: variable.quantity.unit.clone(),
                        value: self.inputs.value(index),
                        states: None,
                        variable: String::new(),
                        change: Change::Number(number),
                    }),
                },
            };
            all.extend(given.map(|given| Given { variable: variable.name.clone(), ..given }));
        }
        let count = all.len();
        all.extend(motions.into_iter().flatten());
        (all, count)
    }

    /// Those of all `givens` that are called `wanted`; none: the first `count`.
    pub(super) fn chosen((all, count): (Vec<Given>, usize), wanted: Option<&[String]>) -> Result<Vec<Given>, Failure> {
        let Some(wanted) = wanted else { return Ok(all.into_iter().take(count).collect()) };
        let mut chosen: Vec<Given> = Vec::new();
        for name in wanted {
            let mut found = all.iter().filter(|own| own.is_called(name)).peekable();
            if found.peek().is_none() {
                let known: Vec<&str> = all.iter().map(|own| own.name.as_str()).collect();
                let known = if known.is_empty() { String::from("none") } else { known.join(", ") };
                return Err(wrong(format!(
                    "the linear system has no input `{name}`; its inputs are: {known}. A load, an actuator or a drive \
                     becomes one with input = true in the model file; an actuator of its own with input = true \
                     disturbs a joint that a controller holds"
                )));
            }
            for given in found {
                if !chosen.contains(given) {
                    chosen.push(given.clone());
                }
            }
        }
        Ok(chosen)
    }
}

/// The motion of a frame that a host's `number` is a part of; the inner none: it cannot be an input here.
fn of_frame(document: &Document, state: &State, number: Number, inputs: &Inputs) -> Option<Option<Given>> {
    let index = document.frames.iter().position(|frame| frame.input && frame.numbers().any(|own| own == number))?;
    let (frame, motion) = (&document.frames[index], &state.prescribed.frames[index]);
    if let Some(axis) = frame.position.iter().position(|own| *own == number) {
        let part = [&motion.pose, &motion.velocity, &motion.acceleration].map(|pose| pose.place[axis]);
        let jet = Jet { value: inputs.line(number).0, first: part[1], second: part[2] };
        let words = ["position", "velocity", "acceleration"].map(|word| format!("{word}[{}]", axis + 1));
        let words = words.each_ref().map(String::as_str);
        return Some(Some(Given::motion(&frame.name, words, "m", jet, Change::Position { frame: index, axis })));
    }
    let Orientation::Rotation(numbers) = frame.orientation else { return Some(None) };
    let axis = numbers.iter().position(|own| *own == number)?;
    // The turn of a frame that turns does not follow from one component alone.
    if motion.velocity.axes != Pose::zero().axes {
        return Some(None);
    }
    let vector = numbers.map(|number| inputs.line(number).0);
    let jets =
        std::array::from_fn(|own| Jet { value: vector[own], first: if own == axis { 1.0 } else { 0.0 }, second: 0.0 });
    let [axes, axes_rate, _] = rotation_matrix_jet(&jets);
    let [pose, rate] = [axes, axes_rate].map(|axes| Pose { axes, ..Pose::zero() });
    let turn = angular_velocity(&pose, &rate);
    let words = ["rotation", "rotation_rate", "rotation_acceleration"].map(|word| format!("{word}[{}]", axis + 1));
    let words = words.each_ref().map(String::as_str);
    let jet = Jet::constant(vector[axis]);
    Some(Some(Given::motion(&frame.name, words, "rad", jet, Change::Rotation { frame: index, turn })))
}
