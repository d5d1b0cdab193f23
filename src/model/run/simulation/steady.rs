//! Linear systems about a steady rotation of the mechanism, which a drive makes.

use super::linear::{Linear, warning_of_friction};
use super::{Simulation, failure, wrong};
use crate::fmi::Failure;
use crate::math::Mat3;
use crate::mechanics::input::guide::Drive;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::rotation::Rotation;
use crate::solve::dynamics::start::find_equilibrium;
use crate::solve::linearization::Linearization;
use crate::solve::linearization::base::Base;
use crate::solve::linearization::independent::{Independent, Selection};
use crate::solve::linearization::steady::{self, Unsteady};
use std::borrow::Cow;
use std::f64::consts::TAU;

pub use super::linear::Steady;
pub use crate::solve::linearization::steady::Frame;

/// Softest modes in which the linear systems at two angles must be the same.
const MODES: usize = 16;

/// A drive that turns steadily, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Spin {
    /// The name of the drive.
    pub drive: String,
    /// Its rate, rad/s.
    pub speed: f64,
    /// Gravity is left out.
    pub is_weightless: bool,
}

/// A mechanism that a drive can turn, and its states of steady rotation.
pub(super) struct Rotor<'a> {
    pub system: Cow<'a, System>,
    name: &'a str,
    /// The rotation by 1 rad/s.
    unit: Rotation,
    /// The equilibrium at rest, or the state as drawn.
    at_rest: State,
}

/// A relative equilibrium with what linear systems about it need.
pub(super) struct Turning {
    pub rotation: Rotation,
    pub state: State,
    /// The base now, and after a turn.
    pub bases: [Base; 2],
}

impl<'a> Rotor<'a> {
    /// The part of `simulation` that the drive `name` turns.
    ///
    /// # Errors
    /// It is no drive that turns the mechanism about a fixed axis, or the motion is periodic.
    pub fn new(simulation: &'a Simulation, name: &'a str, is_weightless: bool) -> Result<Self, Failure> {
        if !simulation.runner.is_initialized() {
            return Err(wrong(String::from("the model is not initialized")));
        }
        let own = simulation.system();
        let Some(drive) = own.drives.iter().position(|drive| drive.name == name) else {
            let known: Vec<&str> = own.drives.iter().map(|drive| drive.name.as_str()).collect();
            let known = if known.is_empty() { String::from("none") } else { known.join(", ") };
            return Err(wrong(format!("the model has no drive `{name}`; its drives are: {known}")));
        };
        if let Some(what) = own.part_against_steady_rotation() {
            return Err(wrong(format!(
                "a mechanism with {what} does not turn steadily here; remove it from the model"
            )));
        }
        let mut state = simulation.state().clone();
        state.stop();
        let unit = own.rotation(&state, drive, 1.0).map_err(|reason| wrong(reason.of_drive(name)))?;
        if let Some(across) = own.gravity_across(&unit).filter(|_| !is_weightless) {
            return Err(wrong(format!(
                "gravity is not along the axis of drive {name}: {across:.3} m/s2 of it turn with respect to the \
                 mechanism, and the motion is periodic, not steady. Leave it out with --without-gravity"
            )));
        }
        let mut system = Cow::Borrowed(own);
        if is_weightless {
            system.to_mut().gravity.fill(0.0);
        }
        let mut at_rest = state.clone();
        let tolerance = simulation.document.value(simulation.document.simulation.tolerance);
        // A mechanism that only the rotation holds has no equilibrium at rest.
        if find_equilibrium(&system, &mut at_rest, state.time, tolerance).is_err() {
            at_rest = state;
        }
        Ok(Self { system, name, unit, at_rest })
    }

    /// The relative equilibrium with `speed` rad/s, from the one that is `known` with its speed.
    ///
    /// # Errors
    /// There is none, or the motion is periodic.
    pub fn turning(&self, speed: f64, known: Option<&Turning>) -> Result<Turning, Failure> {
        let rotation = self.unit.with_speed(speed);
        let (from, mut state) = match known {
            Some(known) => (known.rotation.speed, known.state.clone()),
            None => (0.0, self.at_rest.clone()),
        };
        steady::find(&self.system, &rotation, from, &mut state).map_err(|error| {
            let reason = failure(&error).message;
            wrong(format!(
                "no steady rotation of drive {} with {speed} rad/s is found: {reason}. A smaller speed, or a mechanism \
                 that is held in all other directions, may have one",
                self.name
            ))
        })?;
        let bases = steady::bases(&self.system, &rotation, &state).map_err(|reason| match reason {
            Unsteady::NotFound(error) => failure(&error),
            Unsteady::Periodic(distance) => self.periodic(&format!(
                "after a turn by 37 degrees the equations of motion do not hold any more, and the equilibrium is \
                 {distance:.1e} of the size of the mechanism away"
            )),
        })?;
        Ok(Turning { rotation, state, bases })
    }

    /// The coordinates of the linear system about `turning`, and the frame in which it is the same at all angles.
    ///
    /// # Errors
    /// There is none.
    pub fn frame(&self, turning: &Turning) -> Result<(Selection, Frame), Failure> {
        let found = steady::frame(&self.system, &turning.rotation, &turning.bases, MODES);
        match found.map_err(|error| failure(&error))? {
            Some((selection, Some(frame))) => Ok((selection, frame)),
            Some((_, None)) => Err(self.periodic(
                "the linear system at 0 degrees is not that at 37 degrees, neither in the fixed frame nor in the one \
                 that turns: neither the rotor nor its support is round",
            )),
            None => {
                Err(wrong(String::from("nothing can move: the constraints leave no degree of freedom to linearize")))
            }
        }
    }

    /// The coordinates `known` about `base`.
    ///
    /// # Errors
    /// They are not independent there.
    pub fn selection(&self, base: &Base, known: &[Independent]) -> Result<Selection, Failure> {
        let linearization = Linearization::new(&self.system, base).map_err(|error| failure(&error))?;
        let found = linearization.select_along(&self.system, base, &Mat3::identity(), Some(known));
        found.ok_or_else(|| {
            wrong(format!(
                "the coordinates that are independent at the first speed of drive {} are not at all others; take fewer \
                 speeds",
                self.name
            ))
        })
    }

    fn periodic(&self, reason: &str) -> Failure {
        wrong(format!(
            "the motion that drive {} makes is periodic, not steady, and has no poles: {reason}. A run in time shows \
             its vibrations",
            self.name
        ))
    }
}

impl Simulation {
    /// The name of a drive that turns by more than a revolution in the run, as far as functions of time tell.
    pub fn turning_drive(&self) -> Option<&str> {
        let (system, state, stop) = (self.system(), self.state(), self.about.stop);
        let turns = |(number, drive): &(usize, &Drive)| {
            let coordinate = drive.coordinate.map(|coordinate| &system.relative_coordinates[coordinate]);
            coordinate.is_some_and(|own| matches!(own.measure, Measure::Angle(_)))
                && [state.time, stop].into_iter().any(|time| {
                    let motion = system.prescribe_start(time, &state.prescribed, &state.targets);
                    (motion.drives[*number].first * stop).abs() > TAU
                })
        };
        system.drives.iter().enumerate().find(turns).map(|(_, drive)| drive.name.as_str())
    }

    /// The linear system about the steady rotation `spin`, as [`Self::linearize`]: functions of time act with their
    /// values of now.
    ///
    /// # Errors
    /// The mechanism does not turn steadily, or as there.
    pub fn linearize_steady(
        &self,
        spin: &Spin,
        inputs: Option<&[String]>,
        outputs: Option<&[String]>,
    ) -> Result<Linear, Failure> {
        let rotor = Rotor::new(self, &spin.drive, spin.is_weightless)?;
        let turning = rotor.turning(spin.speed, None)?;
        let (selection, frame) = rotor.frame(&turning)?;
        let Turning { rotation, bases: [base, _], .. } = turning;
        let linearization = Linearization::new(&rotor.system, &base).map_err(|error| failure(&error))?;
        let warnings = warning_of_friction(&rotor.system).into_iter().collect();
        let steady = Steady { drive: spin.drive.clone(), speed: spin.speed, frame };
        let about = (base, linearization, selection);
        self.linear_about(&rotor.system, about, Some((steady, &rotation)), (inputs, outputs), warnings)
    }
}
