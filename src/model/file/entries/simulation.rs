//! `[simulation]`: what is computed, how long, how finely, by which method.

use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::word("analysis", &words_of(&ANALYSES), "a motion, or equilibria"),
    Key::word("follow", &words_of(&FOLLOWS), "what equilibria are followed by"),
    Key::name(
        "branches",
        Role::Number,
        "the branch points at which a path goes over to the other one: a list of whole numbers",
    ),
    Key::word("initial", &words_of(&INITIALS), "the state at the start"),
    Key::number(&[&PRELOAD]),
    Key::word("from_state", &[], "a file with the state of another run, instead of `initial`"),
    Key::number(&[&STOP]),
    Key::number(&[&STEP]),
    Key::number(&[&ACCURACY]),
    Key::number(&[&LONGEST_STEP]),
    Key::number(&[&OUTPUT_STEP]),
    Key::word("integrator", &words_of(&INTEGRATORS), "the time integration"),
    Key::number(&[&CONSERVED_RADIUS, &SPECTRAL_RADIUS]),
    Key::number(&[&TOLERANCE]),
    Key::number(&[&ITERATIONS]),
    Key::flag("verify", "true: `ancf14 run` estimates the errors of its results"),
    Key::flag("mesh_error", "true: FMUs and programs in C find the mesh error of a motion"),
    Key::flag("correction", "true: results without their estimated time-step error"),
    Key::word("totals", &words_of(&TOTALS), "the results of the whole mechanism: a list of words"),
];

const STOP: Rule = Rule::new("stop", "end of the simulation", "s").above(0.0);
const PRELOAD: Rule =
    Rule::new("preload", "duration of the static path that leads to the initial equilibrium", "s").from(0.0);
const STEP: Rule = Rule::new("step", "largest internal step", "s").above(0.0);
const ACCURACY: Rule = Rule::new("accuracy", "error of a motion because of its steps, as a share of its range", "")
    .from(FINEST_ACCURACY)
    .to(COARSEST_ACCURACY);
const LONGEST_STEP: Rule =
    Rule::new("longest_step", "longest internal step that the solver may choose", "s").above(0.0);
/// Range of `accuracy`: below, round-off is more; above, the steps of a motion say nothing of it.
pub const FINEST_ACCURACY: f64 = 1e-9;
/// The other end of that range.
pub const COARSEST_ACCURACY: f64 = 0.1;
const OUTPUT_STEP: Rule = Rule::new("output_step", "time between two rows of results", "s").above(0.0);
const TOLERANCE: Rule = Rule::new("tolerance", "bound of the last Newton increment", "").from(1e-14).to(1e-3);
const ITERATIONS: Rule =
    Rule::new("iterations", "most Newton iterations of a step, which takes what they leave", "").from(1.0).to(15.0);
const CONSERVED_RADIUS: Rule =
    Rule::new("spectral_radius", "share of the fastest oscillations that a step keeps", "").from(0.6).to(1.0);
const SPECTRAL_RADIUS: Rule =
    Rule::new("spectral_radius", "share of the fastest oscillations that a step keeps", "").from(0.0).to(1.0);

/// The section `[simulation]`.
#[derive(Clone, Debug)]
pub struct SimulationSpec {
    /// Where the section begins.
    pub place: Place,
    /// Motion, or a row of equilibria.
    pub analysis: Analysis,
    /// What a row of equilibria is followed by.
    pub follow: Follow,
    /// Time integration.
    pub integrator: IntegratorSpec,
    /// Where the state comes from at the start.
    pub initial: Initial,
    /// The file with the state of another run that this one begins with, and where it is named; none: it begins as
    /// `initial` says.
    pub from_state: Option<(String, Place)>,
    /// Duration of the static path that leads to the initial equilibrium, s; none: that equilibrium is found at once.
    pub preload: Option<Number>,
    /// End, s.
    pub stop: Number,
    /// What the internal steps follow from.
    pub steps: Steps,
    /// The longest step of those that the solver chooses for a motion, s; none: they are as long as rows and errors let
    /// them be.
    pub longest_step: Option<Number>,
    /// The file leaves the steps of a motion to the program: it has neither their length nor their accuracy.
    pub leaves_steps: bool,
    /// Time between two rows of results, s; see
    /// [`Document::output_step`](crate::model::document::Document::output_step).
    pub output_step: Option<Number>,
    /// Bound of the last Newton increment.
    pub tolerance: Number,
    /// Most iterations of a step, which takes what they leave; none: as many as it needs.
    pub iterations: Option<usize>,
    /// Whether `run` estimates the errors of its results.
    pub verify: bool,
    /// Whether units and programs in C find the mesh error of a motion.
    pub mesh_error: bool,
    /// Whether the time-step error is taken out of the results of a motion.
    pub correction: bool,
    /// The results of the whole mechanism that stand behind those of the outputs.
    pub totals: Vec<Total>,
}

/// Results of the whole mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Total {
    /// Kinetic, elastic, gravity and total energy.
    Energy,
    /// Work by its origin, of a motion.
    Work,
    /// Linear and angular momentum.
    Momentum,
    /// Steps, iterations, rejected steps.
    Statistics,
}

/// What is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Analysis {
    /// Motion in time.
    Dynamic,
    /// An equilibrium at every time.
    Static,
}

/// What a row of equilibria is followed by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Follow {
    /// Time: functions of `t` say what acts at each.
    Time,
    /// The arc length of their path, on which `t` may turn back.
    ArcLength {
        /// The branch points at which the run goes over to the path that crosses, from 1; negative: in the opposite
        /// direction.
        branches: Vec<i64>,
    },
}

/// What the lengths of internal steps follow from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// Steps of this length, s, but for those that end earlier.
    Fixed(Number),
    /// The error that a motion may have because of its steps, as a share of its range.
    ForAccuracy(Number),
}

impl Steps {
    /// The number that the file or a host may set.
    pub fn number(self) -> Number {
        let (Self::Fixed(number) | Self::ForAccuracy(number)) = self;
        number
    }
}

/// Time integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IntegratorSpec {
    /// Midpoint rule that keeps momenta, and the energy of all that the step resolves.
    Conserving {
        /// Share of the fastest oscillations that a step keeps, 0.6 to 1.
        spectral_radius: Number,
    },
    /// Generalized-alpha, with numerical damping.
    GeneralizedAlpha {
        /// Share of the fastest oscillations that a step keeps, 0 to 1.
        spectral_radius: Number,
    },
}

/// Where the state comes from at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Initial {
    /// As drawn in the file.
    AsDrawn,
    /// The static equilibrium at the start, at rest.
    Equilibrium,
    /// The steady rotation that a drive makes.
    Steady,
}

const ANALYSES: [(&str, Analysis); 2] = [("dynamic", Analysis::Dynamic), ("static", Analysis::Static)];
const FOLLOWS: [(&str, bool); 2] = [("time", false), ("arc_length", true)];
const INTEGRATORS: [(&str, Word); 2] =
    [("conserving", Word::Conserving), ("generalized_alpha", Word::GeneralizedAlpha)];
const TOTALS: [(&str, Total); 4] = [
    ("energy", Total::Energy),
    ("work", Total::Work),
    ("momentum", Total::Momentum),
    ("statistics", Total::Statistics),
];
/// Those of a file that names none.
const USUAL_TOTALS: [Total; 3] = [Total::Energy, Total::Momentum, Total::Statistics];
const INITIALS: [(&str, Initial); 3] =
    [("as_drawn", Initial::AsDrawn), ("equilibrium", Initial::Equilibrium), ("steady", Initial::Steady)];

/// A word of `integrator`.
#[derive(Clone, Copy)]
enum Word {
    Conserving,
    GeneralizedAlpha,
}

/// Default of `accuracy`.
const USUAL_ACCURACY: f64 = 1e-3;
/// Default of `tolerance`.
const USUAL_TOLERANCE: f64 = 1e-8;
/// Default of `spectral_radius` for `conserving`: what is far too fast for the step is down to a tenth after 22 of
/// them, and a strain with 60 steps a period, whose phase errs by 1e-3, has a damping ratio of 6e-6.
const CONSERVED: f64 = 0.9;
/// Default of `spectral_radius` for `generalized_alpha`: the fastest oscillations lose a fifth a step. With 0.9 a body
/// that turns by 0.12 rad a step gains energy without bound; with 0.8 it loses 1 % in 1,500 steps.
const USUAL_RADIUS: f64 = 0.8;

impl SimulationSpec {
    pub(in crate::model) fn read(mut reader: Reader<'_, '_>) -> Self {
        let analysis = reader.word("analysis", &ANALYSES, Some(Analysis::Dynamic)).unwrap_or(Analysis::Dynamic);
        let follow = follow(&mut reader, analysis);
        let initial_place = reader.place_of("initial");
        let initial = reader.word("initial", &INITIALS, Some(Initial::AsDrawn));
        if initial != Some(Initial::Equilibrium) || analysis == Analysis::Static {
            let message = "`preload` belongs to a motion that begins at an equilibrium";
            reader.refuse(
                PRELOAD.key,
                message,
                "remove it, or set initial = \"equilibrium\" and analysis = \"dynamic\"",
            );
        }
        let preload = reader.optional(&PRELOAD);
        let from_state = reader.text("from_state");
        if from_state.is_some() && matches!(initial, Some(Initial::Equilibrium | Initial::Steady)) {
            let message = "`initial` and `from_state` both say what the motion begins with";
            let label = "remove it: the motion begins with the state";
            reader.context.report.error(initial_place, message, label, "");
        }
        let stop = reader.number(&STOP);
        let step = reader.optional(&STEP);
        let output_step = reader.optional(&OUTPUT_STEP);
        let integrator = integrator(&mut reader);
        let tolerance = reader.number_or(&TOLERANCE, USUAL_TOLERANCE);
        let is_estimated = matches!(integrator, IntegratorSpec::Conserving { .. });
        let iterations = iterations(&mut reader, analysis == Analysis::Dynamic && is_estimated, step.is_some());
        let has_state = from_state.is_some();
        let [verify, mesh_error, correction] = errors(&mut reader, analysis, &follow, has_state, is_estimated);
        let totals = totals(&mut reader, analysis);
        let longest_step = longest_step(&mut reader, analysis, step.is_some());
        let leaves_steps = analysis == Analysis::Dynamic && step.is_none() && !reader.has(ACCURACY.key);
        let steps = steps(&mut reader, step, analysis == Analysis::Dynamic && !is_estimated);
        let place = reader.place;
        // The two that a host may always change are parameters also where the file does not write them; the two that
        // only fill the default experiment are none.
        let slots = &mut reader.context.numbers.slots;
        for number in [steps.number(), tolerance] {
            slots[number.0].listed.get_or_insert(usize::MAX);
        }
        if analysis == Analysis::Static && matches!(steps, Steps::ForAccuracy(_)) {
            // Equilibria have no use for it.
            slots[steps.number().0].listed = None;
        }
        for number in [Some(stop), output_step].into_iter().flatten() {
            slots[number.0].listed = None;
        }
        reader.finish();
        let initial = initial.unwrap_or(Initial::AsDrawn);
        Self {
            place,
            analysis,
            follow,
            integrator,
            initial,
            from_state,
            preload,
            stop,
            steps,
            longest_step,
            leaves_steps,
            output_step,
            tolerance,
            iterations,
            verify,
            mesh_error,
            correction,
            totals,
        }
    }
}

/// Reads `verify`, `mesh_error` and `correction`, which not every analysis has.
fn errors(
    reader: &mut Reader<'_, '_>,
    analysis: Analysis,
    follow: &Follow,
    has_state: bool,
    is_estimated: bool,
) -> [bool; 3] {
    if *follow != Follow::Time {
        let message = "`verify` cannot compare paths: the same equilibrium has another arc length with every mesh";
        reader.refuse("verify", message, "remove it, and compare with a run of a finer mesh");
    }
    if has_state {
        let message = "`verify` needs a run that begins as drawn or at an equilibrium: a state fits one mesh";
        reader.refuse("verify", message, "remove it, or remove `from_state`");
    }
    let verify = reader.boolean("verify", false);
    if analysis == Analysis::Static {
        let message = "`mesh_error` belongs to a motion: equilibria tell their mesh error without it";
        reader.refuse("mesh_error", message, "remove it, or set analysis = \"dynamic\"");
    }
    if has_state {
        let message = "`mesh_error` needs a run that begins as drawn or at an equilibrium: a state fits one mesh";
        reader.refuse("mesh_error", message, "remove it, or remove `from_state`");
    }
    let mesh_error = reader.boolean("mesh_error", false);
    if analysis == Analysis::Static || !is_estimated {
        let message =
            "`correction` belongs to a motion with integrator = \"conserving\", which estimates its time-step error";
        reader.refuse(
            "correction",
            message,
            "remove it, or set analysis = \"dynamic\" and integrator = \"conserving\"",
        );
    }
    [verify, mesh_error, reader.boolean("correction", false)]
}

/// The key that the lengths of steps follow from: `step`, which some integrators need, or `accuracy`.
fn steps(reader: &mut Reader<'_, '_>, step: Option<Number>, must_be_given: bool) -> Steps {
    match step {
        Some(step) => {
            reader.refuse("accuracy", "accuracy and step exclude each other", "leave out one of the two");
            Steps::Fixed(step)
        }
        None => {
            if must_be_given {
                reader.missing(STEP.key, "only integrator = \"conserving\" chooses its steps by itself");
            }
            Steps::ForAccuracy(reader.number_or(&ACCURACY, USUAL_ACCURACY))
        }
    }
}

/// Reads the longest step of those that the solver chooses.
fn longest_step(reader: &mut Reader<'_, '_>, analysis: Analysis, has_step: bool) -> Option<Number> {
    if analysis == Analysis::Static {
        reader.refuse(
            LONGEST_STEP.key,
            "`longest_step` belongs to a motion",
            "remove it: `step` bounds the increments",
        );
    } else if has_step {
        let message = "`longest_step` belongs to steps that the solver chooses, and `step` gives them";
        reader.refuse(LONGEST_STEP.key, message, "leave out one of the two");
    }
    reader.optional(&LONGEST_STEP)
}

/// Reads the bound on the iterations of steps that are given.
fn iterations(reader: &mut Reader<'_, '_>, is_conserving: bool, has_step: bool) -> Option<usize> {
    if !is_conserving {
        let message = "`iterations` belongs to a motion with integrator = \"conserving\"";
        reader.refuse(ITERATIONS.key, message, "remove it");
    } else if !has_step {
        let message = "`iterations` belongs to steps of a given length, and the solver chooses those of this motion";
        reader.refuse(ITERATIONS.key, message, "give the length of the steps, `step`");
    }
    Some(reader.count_or(&ITERATIONS, 0)).filter(|most| *most > 0)
}

/// What a row of equilibria is followed by.
fn follow(reader: &mut Reader<'_, '_>, analysis: Analysis) -> Follow {
    if analysis == Analysis::Dynamic {
        reader.refuse("follow", "`follow` belongs to a static analysis", "remove it, or set analysis = \"static\"");
    }
    let by_length = reader.word("follow", &FOLLOWS, Some(false)).unwrap_or(false);
    if !by_length {
        let message = "`branches` belongs to a path that is followed by its arc length";
        reader.refuse("branches", message, "remove it, or set follow = \"arc_length\"");
    }
    let branches = reader.whole_numbers("branches");
    if by_length { Follow::ArcLength { branches } } else { Follow::Time }
}

fn integrator(reader: &mut Reader<'_, '_>) -> IntegratorSpec {
    let default = (!reader.has("integrator")).then_some(Word::Conserving);
    match reader.word("integrator", &INTEGRATORS, default) {
        Some(Word::Conserving) => {
            IntegratorSpec::Conserving { spectral_radius: reader.number_or(&CONSERVED_RADIUS, CONSERVED) }
        }
        Some(Word::GeneralizedAlpha) => {
            IntegratorSpec::GeneralizedAlpha { spectral_radius: reader.number_or(&SPECTRAL_RADIUS, USUAL_RADIUS) }
        }
        // A mistake: whether the number belongs to the integrator that was meant is unknown.
        None => IntegratorSpec::Conserving { spectral_radius: reader.number_or(&SPECTRAL_RADIUS, CONSERVED) },
    }
}

/// The results of the whole mechanism.
fn totals(reader: &mut Reader<'_, '_>, analysis: Analysis) -> Vec<Total> {
    let place = reader.place_of("totals");
    let totals = reader.words("totals", &TOTALS, &USUAL_TOTALS);
    if analysis == Analysis::Static && totals.contains(&Total::Work) {
        let label = "\"work\" is the sum over the steps of a motion: remove it";
        reader.context.report.error(place, "a static analysis has no work among its totals", label, "");
    }
    totals
}
