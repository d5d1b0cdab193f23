//! Derivatives of the last communication step: of its results by its inputs, and by time.
//!
//! They are asked for whenever the standard allows it, also where there is no last step: no result depends on an input
//! then, and what does not follow from the motion changes as in an internal step on trial.

use super::plan::Plan;
use super::solver::Solver;
use super::{Simulation, failure, wrong};
use crate::error::Error;
use crate::fmi::Failure;
use crate::math::Vec3;
use crate::math::elementary::hypot;
use crate::mechanics::input::host_motion::Targets;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::builder;
use crate::model::file::document::Document;
use crate::model::file::entries::drive::Motion;
use crate::model::file::entries::frame::Orientation;
use crate::model::file::number::Number;
use crate::model::variables::Moment;
use crate::model::variables::inputs::Inputs;
use crate::solve::sensitivity::mover::Step;
use crate::solve::sensitivity::{self, Sensitivity};
use crate::solve::step::linearized::Linearized;
use crate::solve::step::response::{Responder, Response};
use std::sync::Arc;

/// The communication step that led to the present state; the system's backup is the state at its start.
#[derive(Clone, Debug, Default)]
pub(super) struct LastStep {
    /// There is one.
    pub known: bool,
    /// Its inputs, with their derivatives by time.
    pub inputs: Inputs,
    /// Its end as the host said it, s.
    pub end: f64,
    /// Where the host ended it, s; infinite: at its end.
    pub stop: f64,
    /// The settings of the file during it, where a tunable parameter has been set since; else empty.
    pub settings: Vec<f64>,
}

/// What has been computed of the present state and its last step, where it has been asked for.
#[derive(Debug, Default)]
pub(super) struct Derived {
    /// Derivatives of all results by all inputs of the last step, a column an input.
    jacobian: Option<Vec<f64>>,
    /// Derivatives by time of the results that follow from positions and velocities.
    rates: Option<Vec<f64>>,
    /// Difference quotients of all results over the last communication step, of equilibria over the last increment.
    quotients: Option<Vec<f64>>,
    /// Derivatives of the values of all variables at the start by one of them, each with its value reference.
    pub(super) starts: Vec<(usize, Vec<f64>)>,
}

impl Derived {
    /// A tunable parameter was set: what is to come is another motion, the last step is the same.
    pub fn forget_rates(&mut self) {
        self.rates = None;
    }
}

/// The inputs of a communication step, one of which may be changed.
struct Given<'a> {
    document: &'a Document,
    inputs: &'a Inputs,
    /// See [`System::origin`].
    origin: Vec3,
    /// Begin and end, s.
    span: [f64; 2],
    /// See [`sensitivity::Inputs::unit`].
    units: Vec<f64>,
    /// The parts of quaternions of length 0, which say nothing, and so do those around them; switches.
    silent: Vec<Number>,
}

impl<'a> Given<'a> {
    fn new(document: &'a Document, inputs: &'a Inputs, span: [f64; 2], system: &System) -> Self {
        let size = system.size;
        // Forces are linear in loads and temperatures that the host gives: any change will do.
        let mut units = vec![f64::INFINITY; inputs.count()];
        let mut set = |number: Number, unit: f64| {
            if let Some(place) = inputs.place(number) {
                units[place] = unit;
            }
        };
        let drives = document.drives.iter().map(|drive| (drive.motion, if drive.is_angle() { 1.0 } else { size }));
        let winches = document.winches.iter().map(|winch| (winch.motion, size));
        for (motion, unit) in drives.chain(winches) {
            match motion {
                Motion::Value(number) => set(number, unit),
                Motion::Rate(number) => set(number, unit / (span[1] - span[0])),
            }
        }
        for frame in &document.frames {
            frame.position.into_iter().for_each(|number| set(number, size));
            match frame.orientation {
                Orientation::Rotation(numbers) => numbers.into_iter().for_each(|number| set(number, 1.0)),
                Orientation::Quaternion(numbers) => {
                    // Only its direction counts.
                    let at_end = |number| inputs.line(number).0 + inputs.line(number).1 * (span[1] - span[0]);
                    let length = numbers.map(at_end).into_iter().fold(0.0, hypot);
                    numbers.into_iter().for_each(|number| set(number, length));
                }
            }
        }
        let undirected = builder::undirected(document, |number| inputs.line(number), span);
        let mut silent: Vec<Number> = undirected.flat_map(|(_, numbers)| numbers).collect();
        // A switch is engaged or not: a small change changes nothing.
        silent.extend(builder::switches(document).flatten().filter(|switch| switch.input).map(|switch| switch.active));
        silent.iter().for_each(|number| set(*number, 1.0));
        Self { document, inputs, origin: system.origin, span, units, silent }
    }
}

impl sensitivity::Inputs for Given<'_> {
    fn count(&self) -> usize {
        self.units.len()
    }

    fn unit(&self, number: usize) -> f64 {
        self.units[number]
    }

    fn aim(&self, number: usize, change: f64, targets: &mut Targets) {
        let changed = self.inputs.number(number);
        let line = |number: Number| {
            let (value, slope) = self.inputs.line(number);
            let moves = number == changed && !self.silent.contains(&number);
            if moves { (value + change, slope) } else { (value, slope) }
        };
        let end = targets.end;
        builder::aim(self.document, &self.origin, line, self.span, targets);
        targets.end = end;
    }
}

impl Simulation {
    /// The derivative of result number `result` at the end of the last step by input number `input` of that step; 0
    /// where there is none, for a result does not change with an input before a step is taken.
    pub(super) fn partial_derivative(&mut self, result: usize, input: usize) -> Result<f64, Failure> {
        if !self.last.known {
            return Ok(0.0);
        }
        if self.derived.jacobian.is_none() {
            self.derived.jacobian = Some(self.jacobian().map_err(|error| failure(&error))?);
        }
        let jacobian = self.derived.jacobian.as_deref().unwrap_or_default();
        finite(jacobian[input * self.results.len() + result])
    }

    /// The derivative of result number `result` by time, 1/s of its unit: exact where it follows from positions and
    /// velocities, else the difference quotient of the last communication step, or of the next internal one if none
    /// has been taken; 0 where that one cannot be taken.
    pub(super) fn rate(&mut self, result: usize) -> f64 {
        let moves = !matches!(self.runner.solver, Solver::Statics(_));
        if moves && self.table.follows_from_motion(result) {
            if self.derived.rates.is_none() {
                self.derived.rates = Some(self.rates().unwrap_or_default());
            }
            // None where the system has no accelerations now.
            let rate = self.derived.rates.as_deref().unwrap_or_default().get(result);
            if let Some(rate) = rate.filter(|rate| rate.is_finite()) {
                return *rate;
            }
        }
        if self.derived.quotients.is_none() {
            self.derived.quotients = Some(self.quotients().unwrap_or_default());
        }
        let rate = self.derived.quotients.as_deref().unwrap_or_default().get(result);
        rate.copied().filter(|rate| rate.is_finite()).unwrap_or_default()
    }

    /// Derivatives by time of all results, at their accelerations and multipliers: along the motion.
    fn rates(&self) -> Result<Vec<f64>, Error> {
        let (system, state) = (&*self.runner.settled(&self.document), &self.runner.state);
        let mut response = Response::default();
        self.runner.solver.respond(&mut Responder::new(system), system, state, &mut response)?;
        let (mut frames, mut values) = (FrameCache::default(), Vec::new());
        let fibers = self.table.fibers(&Moment { system, state, response: &response, fibers: &[] }, &mut frames);
        let mut sum = vec![0.0; self.results.len()];
        sensitivity::along_motion(system, state, &response.acceleration, |state, weight| {
            let moment = Moment { system, state, response: &response, fibers: &fibers };
            self.table.measure(&moment, &mut frames, &mut values);
            add_weighted(&mut sum, &values, weight);
        });
        Ok(sum)
    }

    /// Difference quotients of all results over the last communication step, or over the next internal one. Forces
    /// between two units make masters that extrapolate along derivatives at an instant, or over a short internal
    /// step, unstable: these see vibrations that no communication step resolves. Tunable parameters that were set
    /// since the results were read act on the next step, and on both ends of its quotients: their jump is no
    /// derivative.
    fn quotients(&mut self) -> Result<Vec<f64>, Error> {
        let (system, (state, response)) = if self.last.known {
            (Arc::clone(&self.runner.system), self.runner.before_quotient(self.last.end, self.last.stop)?)
        } else {
            let next = self.runner.after_next_part(&self.document)?;
            (self.runner.settled(&self.document), next)
        };
        let (mut frames, mut now, mut values) = (FrameCache::default(), Vec::new(), Vec::new());
        // Those of the last step are told already, where they are not corrected.
        if self.last.known && !self.document.simulation.correction {
            now.clone_from(&self.results);
        } else {
            let mut own = Response::default();
            self.runner.solver.respond(&mut Responder::new(&system), &system, &self.runner.state, &mut own)?;
            let moment = Moment { system: &system, state: &self.runner.state, response: &own, fibers: &[] };
            self.table.measure(&moment, &mut frames, &mut now);
        }
        let moment = Moment { system: &system, state: &state, response: &response, fibers: &[] };
        self.table.measure(&moment, &mut frames, &mut values);
        let passed = self.runner.state.time - state.time;
        Ok(now.iter().zip(&values).map(|(now, other)| (now - other) / passed).collect())
    }

    /// Derivatives of all results with respect to all inputs over the last communication step, a column an input.
    fn jacobian(&mut self) -> Result<Vec<f64>, Error> {
        let Self { runner, last, document, table, results, .. } = self;
        let span = [runner.backup.time, last.end];
        let given = Given::new(document, &last.inputs, span, &runner.system);
        let plan = runner.plan_until(span[0], span[1], last.stop)?;
        let (system, state) = (&runner.system, &runner.state);
        let moves = !matches!(runner.solver, Solver::Statics(_));
        let step = Step { start: &runner.backup, inputs: &given, moves };
        let mut response = Response::default();
        let responds = table.needs_response();
        if responds {
            runner.solver.respond(&mut Responder::new(system), system, state, &mut response)?;
        } else {
            response.set_at_rest(state);
        }
        let end = (state, responds.then_some(&response));
        let (mut sensitivity, after) = match &mut runner.solver {
            Solver::None => Err(Error::NotInitialized),
            Solver::Midpoint(midpoint) => differentiate(midpoint.as_mut(), system, step, plan, end),
            Solver::GeneralizedAlpha(alpha) => differentiate(alpha.as_mut(), system, step, plan, end),
            Solver::Statics(statics) => differentiate(statics.as_mut(), system, step, plan, end),
        }?;
        let (mut frames, mut values, mut columns) = (FrameCache::default(), Vec::new(), Vec::new());
        let fibers = table.fibers(&Moment { system, state: &after, response: &response, fibers: &[] }, &mut frames);
        for number in 0..last.inputs.count() {
            let mut sum = vec![0.0; results.len()];
            sensitivity.look(system, step, (&after, &response), number, |state, response, weight| {
                table.measure(&Moment { system, state, response, fibers: &fibers }, &mut frames, &mut values);
                add_weighted(&mut sum, &values, weight);
            });
            columns.extend_from_slice(&sum);
        }
        Ok(columns)
    }
}

fn add_weighted(sum: &mut [f64], values: &[f64], weight: f64) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += weight * value;
    }
}

/// A derivative that is a number.
pub(super) fn finite(derivative: f64) -> Result<f64, Failure> {
    match derivative.is_finite() {
        true => Ok(derivative),
        false => Err(wrong(format!("the derivative is {derivative}: there is none, or it is too large for a number"))),
    }
}

/// Repeats the step that led to `state` and differentiates it, with the `response` there if results ask for it. Returns
/// the derivatives with the state that they are of. Not inlined: all integrators together would take their stack side
/// by side.
#[inline(never)]
fn differentiate<I: Linearized>(
    integrator: &mut I,
    system: &System,
    step: Step<'_, Given<'_>>,
    plan: Plan,
    (state, response): (&State, Option<&Response>),
) -> Result<(Sensitivity, State), Error> {
    let mut sensitivity = Sensitivity::new(system, step.start, step.inputs);
    let mut after = state.clone();
    sensitivity
        .of_step(integrator, system, step, &mut after, |integrator, state| plan.march(integrator, system, state))?;
    if let Some(response) = response {
        sensitivity.of_response::<I>(system, step, &after, response)?;
    }
    Ok((sensitivity, after))
}
