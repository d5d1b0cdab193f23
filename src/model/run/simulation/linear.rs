//! The linear system about the state that a simulation has reached, as plain data: what `ancf14 linearize` writes.

use super::given::{Asked, is_part_of};
use super::{Simulation, failure, wrong};
use crate::fmi::Failure;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::rotation::Rotation;
use crate::model::file::entries::simulation::Analysis;
use crate::model::variables::{Moment, Source};
use crate::solve::linear::dense::Dense;
use crate::solve::linearization::Linearization;
use crate::solve::linearization::base::{BALANCED, Base};
use crate::solve::linearization::independent::Selection;
use crate::solve::linearization::poles::{self, MOST_STATES};
use crate::solve::linearization::second_order::SecondOrder;
use crate::solve::linearization::state_space::{Reduction, StateSpace};
use crate::solve::linearization::steady::Frame;
use crate::solve::step::response::Response;

pub use crate::solve::linear::dense::Dense as Matrix;
pub use crate::solve::linearization::poles::{Pole, PoleKind};

/// Largest number of states of the matrices, which are dense: beyond, they have gigabytes.
const MOST: usize = 6000;

/// A state, an input or an output of a linear system.
#[derive(Clone, Debug, PartialEq)]
pub struct Signal {
    /// Its name: of outputs that of the column of results.
    pub name: String,
    /// Its unit, empty where there is none.
    pub unit: String,
    /// Its value in the state that the system is linearized about; of states their change, 0.
    pub value: f64,
}

/// A steady rotation that a linear system is about.
#[derive(Clone, Debug, PartialEq)]
pub struct Steady {
    /// The name of the drive.
    pub drive: String,
    /// Its rate, rad/s.
    pub speed: f64,
    /// The axes that the states are counted along: those in which the matrices stay the same.
    pub frame: Frame,
}

/// Numbers by which a linear system estimates its own error. Outputs with one unit are taken together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Amplitude {
    /// Its motions.
    pub motions: Vec<Motion>,
}

/// A motion of the states, and what it does to the outputs: to those of each unit a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Its amplitude is the size of the sum of the states times these complex numbers.
    pub weights: [Vec<f64>; 2],
    /// The change of the outputs over the amplitude.
    pub linear: Vec<f64>,
    /// The part of their nonlinear change that is alike for both signs, over the square of the amplitude.
    pub even: Vec<f64>,
    /// The other part, over the third power of the amplitude.
    pub odd: Vec<f64>,
}

/// `dx/dt = A x + B (u − u₀)`, `y − y₀ = C x + D (u − u₀)` about a state.
#[derive(Clone, Debug)]
pub struct Linear {
    /// Changes of independent coordinates, then their rates, then value and rate of each input that prescribes a
    /// motion.
    pub states: Vec<Signal>,
    /// Inputs.
    pub inputs: Vec<Signal>,
    /// Outputs.
    pub outputs: Vec<Signal>,
    /// `A`.
    pub a: Matrix,
    /// `B`.
    pub b: Matrix,
    /// `C`.
    pub c: Matrix,
    /// `D`.
    pub d: Matrix,
    /// The time of the state, s.
    pub time: f64,
    /// Warnings about the state.
    pub warnings: Vec<String>,
    /// The steady rotation that it is about; none: a state.
    pub steady: Option<Steady>,
    /// Numbers by which it estimates its own error; none: they were not measured, see [`Self::measure_amplitude`].
    pub amplitude: Option<Amplitude>,
    base: Base,
    selection: Selection,
}

impl Simulation {
    /// The linear system about the state that is reached, from `inputs` to `outputs`, each by its name or by that of a
    /// vector; none: all that a host gives, all quantities of outputs.
    ///
    /// # Errors
    /// A name is not known, nothing can move, or the mechanism is too large.
    pub fn linearize(&self, inputs: Option<&[String]>, outputs: Option<&[String]>) -> Result<Linear, Failure> {
        let system = self.system();
        let base = self.linear_base(system)?;
        let linearization = Linearization::new(system, &base).map_err(|error| failure(&error))?;
        let selection = self.select(system, &linearization, &base)?;
        let warnings = warnings(system, &base);
        self.linear_about(system, (base, linearization, selection), None, (inputs, outputs), warnings)
    }

    /// The linear system about `base` in the coordinates `selection`; of a steady rotation `steady`.
    pub(super) fn linear_about(
        &self,
        system: &System,
        (base, linearization, selection): (Base, Linearization, Selection),
        steady: Option<(Steady, &Rotation)>,
        (inputs, outputs): (Option<&[String]>, Option<&[String]>),
        warnings: Vec<String>,
    ) -> Result<Linear, Failure> {
        let given = Self::chosen(self.givens(&base.state), inputs)?;
        let results = self.linear_outputs(outputs)?;
        let asked = Asked { document: &self.document, inputs: &self.inputs, given, system };
        let mut table = (*self.table).clone();
        // Rates count, also of a model whose results are equilibria.
        table.take_motion();
        let (mut frames, mut values) = (FrameCache::default(), Vec::new());
        let fibers =
            table.fibers(&Moment { system, state: &base.state, response: &base.response, fibers: &[] }, &mut frames);
        let mut read = |state: &State, response: &Response, target: &mut [f64]| {
            table.measure(&Moment { system, state, response, fibers: &fibers }, &mut frames, &mut values);
            target.iter_mut().zip(&results).for_each(|(target, number)| *target = values[*number]);
        };
        let mut present = vec![0.0; results.len()];
        read(&base.state, &base.response, &mut present);
        let mut reduction = Reduction::new((system, &base, &asked), linearization, &selection);
        if let Some((Steady { frame: Frame::Turning, .. }, rotation)) = &steady {
            reduction = reduction.seen_from(rotation);
        }
        let StateSpace { a, b, c, d } = reduction.matrices(results.len(), read).map_err(|error| failure(&error))?;
        let outputs = results.iter().zip(present).map(|(number, value)| {
            let (name, unit) = &self.table.results[*number];
            Signal { name: name.clone(), unit: unit.clone(), value }
        });
        let signals = asked.given.iter();
        let linear = Linear {
            states: states(system, &selection, &asked),
            inputs: signals
                .map(|own| Signal { name: own.name.clone(), unit: own.unit.clone(), value: own.value })
                .collect(),
            outputs: outputs.collect(),
            time: base.state.time,
            warnings,
            steady: steady.map(|(steady, _)| steady),
            a,
            b,
            c,
            d,
            amplitude: None,
            base,
            selection,
        };
        match [&linear.a, &linear.b, &linear.c, &linear.d].iter().all(|own| own.values.iter().all(|v| v.is_finite())) {
            true => Ok(linear),
            false => Err(wrong(String::from(
                "the linear system is not finite: an output or a law of the mechanism has no derivative in this \
                 state; linearize about another one",
            ))),
        }
    }

    /// The poles of the mechanism about the state that is reached, with that state: as those of [`Self::linearize`],
    /// but at rest and without dry friction, as the natural modes.
    pub(in crate::model) fn poles_at_rest(&self) -> Result<(Vec<Pole>, Base), Failure> {
        let own;
        let system = match self.system().has_dry_friction() {
            true => {
                own = self.system().without_dry_friction();
                &own
            }
            false => self.system(),
        };
        let mut state = self.state().clone();
        state.velocity.fill(0.0);
        state.prescribed.stop();
        let mut base = Base::new(system, &state).map_err(|error| failure(&error))?;
        base.response.acceleration.fill(0.0);
        base.is_still = true;
        let linearization = Linearization::new(system, &base).map_err(|error| failure(&error))?;
        let selection = self.select(system, &linearization, &base)?;
        check_poles(2 * selection.chosen.len())?;
        let asked = Asked { document: &self.document, inputs: &self.inputs, given: Vec::new(), system };
        let mut reduction = Reduction::new((system, &base, &asked), linearization, &selection);
        let matrices = reduction.matrices(0, |_, _, _| ()).map_err(|error| failure(&error))?;
        let found = poles::poles(system, &base, &selection, &matrices.a).map_err(|_| not_found())?;
        Ok((found, base))
    }

    /// The state that the linear system is about: of an equilibrium nothing moves.
    fn linear_base(&self, system: &System) -> Result<Base, Failure> {
        if !self.runner.is_initialized() {
            return Err(wrong(String::from("the model is not initialized")));
        }
        let mut state = self.state().clone();
        if self.document.simulation.analysis == Analysis::Static {
            state.velocity.fill(0.0);
            state.prescribed.stop();
        }
        let winch = system.winches.iter().any(|winch| state.prescribed.drives[winch.drive].first != 0.0);
        if winch {
            return Err(wrong(String::from(
                "a winch is moving: the mass that it pays out changes, and the linear system with it; linearize where \
                 it stands still",
            )));
        }
        Base::new(system, &state).map_err(|error| failure(&error))
    }

    pub(super) fn select(
        &self,
        system: &System,
        linearization: &Linearization,
        base: &Base,
    ) -> Result<Selection, Failure> {
        let selection = linearization.select(system, base).ok_or_else(|| {
            wrong(String::from("nothing can move: the constraints leave no degree of freedom to linearize"))
        })?;
        let states = 2 * selection.chosen.len();
        if states > MOST {
            return Err(wrong(format!(
                "the linear system would have {states} states, and its dense matrices at most {MOST}; take fewer \
                 elements"
            )));
        }
        Ok(selection)
    }

    /// The numbers of the results that `wanted` names; none: all quantities of outputs.
    pub(super) fn linear_outputs(&self, wanted: Option<&[String]>) -> Result<Vec<usize>, Failure> {
        let Some(wanted) = wanted else {
            let is_shown = self.table.shown_results();
            let numbers = self.table.quantities().flat_map(|(_, numbers)| numbers);
            return Ok(numbers.filter(|number| is_shown[*number]).collect());
        };
        let is_followed = |name: &str| !["statistics.", "work.", "path."].iter().any(|total| name.starts_with(total));
        let shown = self.table.sources.iter().filter_map(|source| match source {
            Source::Result(number) if is_followed(self.table.result_name(*number)) => Some(*number),
            _ => None,
        });
        let shown: Vec<usize> = shown.collect();
        let mut chosen = Vec::new();
        for name in wanted {
            let mut found = shown.iter().filter(|number| is_part_of(self.table.result_name(**number), name)).peekable();
            if found.peek().is_none() {
                let known: Vec<&str> = shown.iter().map(|number| self.table.result_name(*number)).collect();
                return Err(wrong(format!(
                    "the linear system has no output `{name}`; its outputs are: {}",
                    known.join(", ")
                )));
            }
            chosen.extend(found.copied().filter(|number| !chosen.contains(number)).collect::<Vec<_>>());
        }
        Ok(chosen)
    }
}

impl Linear {
    /// The poles, by rising `|λ|`; of a pair that with the positive imaginary part. Those of the two integrators of
    /// inputs that prescribe a motion are left out.
    ///
    /// # Errors
    /// There are too many states, or the poles do not converge.
    pub fn poles(&self, simulation: &Simulation) -> Result<Vec<Pole>, Failure> {
        let own = 2 * self.selection.chosen.len();
        check_poles(own)?;
        let mut a = Dense::zeros(own, own);
        (0..own).for_each(|number| a.column_mut(number).copy_from_slice(&self.a.column(number)[..own]));
        poles::poles(simulation.system(), &self.base, &self.selection, &a).map_err(|_| not_found())
    }

    /// How many states are values and rates of inputs that prescribe a motion.
    pub(super) fn integrators(&self) -> usize {
        self.states.len() - 2 * self.selection.chosen.len()
    }

    /// The equations of motion in the independent coordinates.
    pub(super) fn second_order(&self, simulation: &Simulation, matrices: &StateSpace) -> Result<SecondOrder, Failure> {
        let found = SecondOrder::new(simulation.system(), &self.base, &self.selection, matrices);
        found.map_err(|error| failure(&error))
    }

    /// Whether nothing moves in the state that the system is about, and all forces balance.
    pub(super) fn is_still(&self) -> bool {
        self.base.is_still
    }

    /// The largest static response of the coordinates to a unit of an input. Positions count over the size of the
    /// mechanism. It is infinite, or not a number, where nothing holds a motion.
    pub(super) fn static_reach(&self, simulation: &Simulation, input: usize) -> f64 {
        let (free, own) = (self.selection.chosen.len(), (0..2 * self.selection.chosen.len()).collect::<Vec<_>>());
        let held = self.a.columns_at(0..2 * free).rows_of(&own).solve(&self.b.columns_at([input]).rows_of(&own));
        let moved = self.selection.shapes.times(&held.column(0)[..free]);
        simulation.system().correction_size(&moved).0
    }

    /// The state that the system is about.
    pub(super) fn base_state(&self) -> &State {
        &self.base.state
    }

    /// Whether nothing moves in the state that the system is about.
    pub fn is_at_rest(&self) -> bool {
        self.base.is_at_rest
    }
}

pub(super) fn check_poles(states: usize) -> Result<(), Failure> {
    if states <= MOST_STATES {
        return Ok(());
    }
    Err(wrong(format!(
        "poles are found of at most {MOST_STATES} states, and this mechanism has {states}; take fewer elements"
    )))
}

pub(super) fn not_found() -> Failure {
    wrong(String::from("the poles of the linear system are not found: their iteration does not converge"))
}

fn states(system: &System, selection: &Selection, asked: &Asked) -> Vec<Signal> {
    let coordinates = selection.names(system).into_iter().zip(selection.units(system));
    let signal = |name: String, unit: &str| Signal { name, unit: unit.to_owned(), value: 0.0 };
    let mut states: Vec<Signal> = coordinates.clone().map(|(name, unit)| signal(name, unit)).collect();
    states.extend(coordinates.map(|(name, unit)| signal(format!("{name}.rate"), &format!("{unit}/s"))));
    let motions = asked.given.iter().filter_map(|given| given.states.as_ref()).flatten();
    states.extend(motions.map(|(name, unit, _)| signal(name.clone(), unit)));
    states
}

/// Warnings about the state that the linear system is about.
fn warnings(system: &System, base: &Base) -> Vec<String> {
    let mut warnings = Vec::new();
    if base.imbalance.is_nan() || base.imbalance > BALANCED {
        warnings.push(format!(
            "the mechanism is at rest, but not in equilibrium, which is about {:.1e} of its size away: it would leave \
             this state by itself, and the linear system leaves that motion out. Linearize about the equilibrium: --at \
             equilibrium",
            base.imbalance
        ));
    }
    if !base.is_at_rest {
        warnings.push(String::from(
            "the mechanism moves in this state: the matrices are those of the instant. The poles tell stability and \
             frequencies only if the motion is steady and the matrices do not change with it; a run in time shows \
             whether they do",
        ));
    }
    warnings.extend(warning_of_friction(system));
    warnings
}

/// A warning if there is dry friction.
pub(super) fn warning_of_friction(system: &System) -> Option<String> {
    system.has_dry_friction().then(|| {
        String::from(
            "dry friction enters with the slope that it has in this state, the stiffness of sticking where it holds: \
             the linear system is right for motions that do not slide; for others give the joint viscous friction",
        )
    })
}
