//! The small FMU of a linear system: its file, its unit, and what its page says of where it comes from.

use crate::error::Error;
use ancf14::fmi::variable::{Causality, Variable};
use ancf14::fmi::{About, Model};
use ancf14::linear::{Amplitude, File, MOST_KINDS, MOST_STATES, Matrix, Signal, Unit};
use ancf14::model::linear::{self, Linear, Motion, Pole};
use ancf14::model::simulation::Simulation;
use ancf14::model::steady::{Frame, Steady};

/// The error of a reduction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reduction {
    /// States of the whole system.
    pub whole: usize,
    /// States that are kept exactly.
    pub kept: usize,
    /// The bound of the error over the response to a sudden change of an input; none: the method has none.
    pub bound: Option<f64>,
    /// The largest error that responses show, over the same.
    pub error: f64,
}

/// Where a linear system comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// The name of the mechanism.
    pub model: String,
    /// The state that the system is about.
    pub state: String,
    /// States.
    pub order: usize,
    /// None: it has all states.
    pub reduction: Option<Reduction>,
    /// Its poles, those with the positive imaginary part of pairs; empty: they are not known.
    pub poles: Vec<[f64; 2]>,
    /// Warnings about that state.
    pub warnings: Vec<String>,
}

/// A linear system as an FMU has it.
#[derive(Clone, Debug)]
pub struct Small {
    /// The unit: names, GUID and variables.
    pub unit: Unit,
    /// The text of its file.
    pub text: String,
    /// Where it comes from.
    pub origin: Origin,
}

impl Small {
    /// The unit of a linear system of `simulation`, with its poles.
    ///
    /// # Errors
    /// It has too many states or numbers that are too large, or its matrices are those of one position of a mechanism
    /// that turns.
    pub fn new(
        simulation: &Simulation,
        linear: &Linear,
        poles: &[Pole],
        reduction: Option<Reduction>,
    ) -> Result<Self, Error> {
        let order = linear.states.len();
        if order > MOST_STATES {
            return Err(Error::States { order });
        }
        if let Some(Steady { drive, frame: Frame::Turning, .. }) = &linear.steady {
            return Err(Error::Turns { drive: drive.clone() });
        }
        let model = simulation.about();
        let state = match &linear.steady {
            None => format!("the state at t = {} s", linear.time),
            Some(Steady { drive, speed, .. }) => format!("the steady rotation of {drive} with {speed} rad/s"),
        };
        let about = About {
            name: format!("{}, linear", model.name),
            identifier: format!("{}_linear", model.identifier),
            description: format!("Linear system of {} about {state}, for small motions", model.name),
            guid: String::new(),
            start: 0.0,
            stop: model.stop - model.start,
            ..model.clone()
        };
        let signals = |signals: &[linear::Signal], causality: Causality| {
            signals.iter().map(|own| signal(simulation, own, causality)).collect()
        };
        let [a, b, c, d] = [&linear.a, &linear.b, &linear.c, &linear.d].map(|own| Matrix {
            rows: own.rows,
            columns: own.columns,
            values: own.values.clone(),
        });
        let inputs = signals(&linear.inputs, Causality::Input);
        let outputs = signals(&linear.outputs, Causality::Output);
        let states = linear.states.iter().map(meaning).collect();
        let amplitude = linear.amplitude.as_ref().map(amplitude);
        let file = File { about, inputs, outputs, states, a, b, c, d, amplitude };
        let text = file.text();
        let unit = Unit::load("the linear system", &text).map_err(|failure| Error::Linear(failure.message))?;
        let poles = poles.iter().map(|pole| pole.value).collect();
        let warnings = linear.warnings.clone();
        let origin = Origin { model: model.name.clone(), state, order, reduction, poles, warnings };
        Ok(Self { unit, text, origin })
    }
}

/// The warning of a unit that cannot estimate its own error, for the reason given.
pub fn without_amplitude(reason: &str) -> String {
    format!(
        "the FMU has no amplitude_error: {reason}; compare it with the FMU of the mechanism at the largest amplitude"
    )
}

/// How nonlinear motions are, as the file has it.
fn amplitude(linear::Amplitude { motions }: &linear::Amplitude) -> Amplitude {
    let kinds = kinds(motions);
    let matrix = |own: fn(&Motion) -> &[f64], columns: &[usize]| {
        let column = |column: &usize| motions.iter().map(move |motion| own(motion)[*column]).collect::<Vec<_>>();
        Matrix { rows: motions.len(), columns: columns.len(), values: columns.iter().flat_map(column).collect() }
    };
    let states: Vec<usize> = (0..motions.first().map_or(0, |motion| motion.weights[0].len())).collect();
    Amplitude {
        real: matrix(|own| &own.weights[0], &states),
        imaginary: matrix(|own| &own.weights[1], &states),
        linear: matrix(|own| &own.linear, &kinds),
        even: matrix(|own| &own.even, &kinds),
        odd: matrix(|own| &own.odd, &kinds),
    }
}

/// The units of outputs that the file has room for, by their numbers. They have the largest nonlinear parts, over the
/// linear ones.
fn kinds(motions: &[Motion]) -> Vec<usize> {
    let share = |kind: usize| {
        let shares = motions.iter().map(|own| (own.even[kind] + own.odd[kind]) / own.linear[kind]);
        shares.fold(0.0, f64::max)
    };
    let mut kinds: Vec<usize> = (0..motions.first().map_or(0, |motion| motion.linear.len())).collect();
    kinds.sort_by(|a, b| share(*b).total_cmp(&share(*a)));
    kinds.truncate(MOST_KINDS);
    kinds.sort_unstable();
    kinds
}

/// The meaning of a state.
fn meaning(own: &linear::Signal) -> String {
    let linear::Signal { name, unit, .. } = own;
    if unit.is_empty() { name.clone() } else { format!("{name}, {unit}") }
}

/// An input or an output as the variable table of the mechanism knows it.
fn signal(simulation: &Simulation, own: &linear::Signal, causality: Causality) -> Signal {
    let linear::Signal { name, unit, value } = own.clone();
    let is_own = |variable: &&Variable| variable.causality == causality && variable.name == name;
    let known = simulation.variables().iter().find(is_own);
    let Some(known) = known else {
        let description = match name.split_once('.').filter(|(_, word)| word.contains("acceleration")) {
            Some((part, _)) if causality == Causality::Input => format!(
                "Acceleration of {part}, from which its motion follows; it begins with the position and the rate that \
                 {part} has in the state that the system is about"
            ),
            _ => String::new(),
        };
        return Signal { name, unit, description, value, ..Signal::default() };
    };
    Signal {
        name,
        unit,
        description: known.description.clone(),
        value,
        min: known.min,
        max: known.max,
        nominal: known.nominal,
        display_unit: known.display_unit.clone(),
    }
}
