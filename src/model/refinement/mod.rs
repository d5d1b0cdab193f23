//! A run that reaches its accuracy by itself: the model runs again with finer steps and meshes, until two runs agree.
//!
//! The first run has the steps that the solver chooses, and the mesh as written or an automatic one. If its estimates
//! promise the accuracy, it is the only one. Otherwise everything that the file leaves to the program becomes finer at
//! once, steps and meshes: two runs that agree though one of the two stayed as it was tell nothing about that one. The
//! rows of both runs are compared, each quantity on its scale, and the difference is the measurement: with steps `k`
//! times as fine and an order `p`, the finer run is off by `1/(k^p - 1)` of it. Numbers that the file gives are kept.
//!
//! The [`Refinement`] decides; its caller runs the models, writes rows and shows them to [`Refinement::look`].

mod found;
pub mod modes;
mod nearest;
mod order;
mod rescue;
mod words;

pub use self::found::Found;
use self::nearest::Nearest;
use self::order::Coarse;
use super::run::accuracy::{Differences, Inexact};
use super::run::levels;
use super::run::rows;
use super::run::simulation::Simulation;
use super::run::simulation::critical::CRITICAL;
use crate::fmi::Model;
use crate::math::elementary::pow;
use crate::model::file::document::Document;
use crate::model::file::entries::simulation::{Analysis, Follow};

/// The cost of all runs after the first one at most, over that of the first one, unless another budget is asked for:
/// two repetitions with twice the steps and up to twice the elements.
const BUDGET: f64 = 20.0;
/// The cost that they may always have then, in steps times elements: half a minute. A first run that takes a second is
/// no reason to leave results inexact.
const LEAST_COST: f64 = 3e6;
/// Most parts of a step in the next run: estimates are not trusted further.
const MOST_PARTS: u32 = 4;
/// How much finer the mesh becomes: where it is suspected, and where it only follows the steps.
const FINER: [f64; 2] = [2.0, 1.5];
/// Share of the accuracy that the next run aims at, so that it does not just miss it.
const AIM: f64 = 0.4;
/// The order in the steps that is reckoned with before one is observed: vibrations that the steps do not resolve lower
/// the second order.
const FIRST_ORDER: f64 = 1.3;
/// Orders in the steps: of configurations; and of velocities, strains and forces, until the differences fall as fast as
/// `STEADY` in the ratio of the steps.
const ORDER: f64 = 2.0;
const ORDER_OF_RATES: f64 = 1.0;
const STEADY: f64 = 1.5;
/// Orders in the length of the elements, of configurations and of the others.
const ORDER_OF_MESH: f64 = 3.0;
const ORDER_OF_MESH_OF_RATES: f64 = 2.0;
/// An error on a mesh is at least so many times that on one twice as fine, for all that is observed: less is noise.
const LEAST_GAIN: f64 = 1.5;
/// A second difference that is more than this share of the first one has not fallen,
const FALLEN: f64 = 0.7;
/// and where it is more than this many times what a reader expects, the motion itself is sensitive.
const SENSITIVE: f64 = 10.0;
/// A mesh error that is not known is taken for so many times what a reader expects.
const UNKNOWN: f64 = 10.0;
/// Most numbers that are kept of a run for the comparison: 160 MB.
const MOST_NUMBERS: f64 = 2e7;

/// How the repetition of a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// The accuracy is reached.
    Reached,
    /// The next run would cost more than what is left of the budget.
    Budget,
    /// Two refinements in a row did not bring the runs nearer to each other.
    Sensitive,
    /// The same for forces, strains or accelerations alone: the motion is right, and a vibration in them is not.
    Ringing,
    /// The next run failed, for this reason; the one before counts.
    Failed(String),
}

/// The result of all runs of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// How many runs count.
    pub runs: u32,
    /// Elements of the last one.
    pub elements: usize,
    /// Whether the program chooses the elements of a beam.
    pub chooses_mesh: bool,
    /// Whether the file gives the steps of a motion: their error stays, and the runs leave it out.
    pub keeps_steps: bool,
    /// Whether it is a motion, not a row of equilibria.
    pub is_motion: bool,
    /// Whether each run is compared with a finer mesh row by row, the only one too.
    pub is_path: bool,
    /// The largest error of a family, as a share of what it is compared with, and its name; none: nothing is judged.
    pub worst: Option<Inexact>,
    /// How it ended.
    pub end: End,
    /// The budget, over the cost of the first run.
    pub budget: f64,
}

/// The repetition of a run.
#[derive(Debug)]
pub struct Refinement {
    budget: Option<f64>,
    /// Costs of the first run, and of all after it, in steps times elements.
    costs: [f64; 2],
    runs: u32,
    /// How many runs have failed before the first one that counts.
    rescues: u32,
    /// Equilibria have no steps, and their meshes are divided in two.
    is_motion: bool,
    /// Whether the program chooses the steps.
    chooses_steps: bool,
    /// Whether the program chooses the elements of each beam.
    chosen: Vec<bool>,
    /// Rows of the run before, and of the one that goes on.
    rows: [Vec<f64>; 2],
    differences: Differences,
    /// The comparison of paths by arc length, instead of one with the rows of the run before.
    nearest: Option<Nearest>,
    /// The first run beside one with fewer elements.
    coarse: Coarse,
    /// When the equilibria of the run become unstable, s.
    critical: Option<f64>,
    /// Differences of the last two pairs of runs, not divided.
    distances: Vec<Inexact>,
    /// The factors by which the steps and the meshes of the run that goes on are finer than those before.
    ratios: [f64; 2],
    /// The steps of the first run over those of the last run that counts.
    divided: f64,
    /// The estimates of the first run of each family because of the steps and of the mesh, as far as they have fallen
    /// since.
    estimates: [Vec<Inexact>; 2],
    /// Expected errors because of the steps and of the mesh, over what a reader expects.
    parts: [f64; 2],
    /// The largest error of the last run.
    worst: Option<Inexact>,
    end: Option<End>,
}

/// Whether the file leaves the elements of a beam or the steps of a motion to the program: its run is repeated without
/// being asked for that.
pub fn is_repeated(document: &Document) -> bool {
    leaves_mesh(document) || document.simulation.leaves_steps
}

/// Whether the file leaves the elements of a beam to the program.
pub fn leaves_mesh(document: &Document) -> bool {
    document.beams.iter().any(|beam| beam.is_meshed_by_program)
}

impl Refinement {
    /// Prepares `simulation`, which is not initialized yet, to be repeated; none where the file gives everything, or
    /// where its results are too many to be kept. `budget` is what the further runs may cost, over the cost of the
    /// first one; none: 20 times that, and half a minute in any case.
    pub fn of(simulation: &mut Simulation, budget: Option<f64>) -> Option<Self> {
        let document = simulation.document();
        let is_motion = document.simulation.analysis == Analysis::Dynamic;
        let is_path = document.simulation.follow != Follow::Time;
        let chooses_steps = is_motion && document.pacing(0.0).is_some();
        let chosen: Vec<bool> = document.beams.iter().map(|beam| beam.is_meshed_by_program).collect();
        let numbers = (rows::last(simulation.about())? + 1) as f64 * simulation.results().len() as f64;
        if !(chooses_steps || chosen.contains(&true)) || numbers > MOST_NUMBERS || simulation.first_state().is_some() {
            return None;
        }
        simulation.note_steps();
        if is_path {
            simulation.leave_mesh_error();
        }
        Some(Self {
            budget,
            costs: [0.0; 2],
            runs: 0,
            rescues: 0,
            is_motion,
            chooses_steps,
            chosen,
            rows: [Vec::new(), Vec::new()],
            differences: Differences::default(),
            nearest: is_path.then(Nearest::default),
            coarse: Coarse::default(),
            critical: None,
            distances: Vec::new(),
            ratios: [1.0; 2],
            divided: 1.0,
            estimates: [Vec::new(), Vec::new()],
            parts: [0.0; 2],
            worst: None,
            end: None,
        })
    }

    /// Looks at a row of the run that goes on. Rows come in their order, the start first.
    pub fn look(&mut self, simulation: &Simulation) {
        if let Some(nearest) = &mut self.nearest {
            nearest.look(simulation, &mut self.differences);
            return;
        }
        let [before, own] = &mut self.rows;
        let results = simulation.results();
        if let Some(other) = before.get(own.len()..own.len() + results.len()) {
            simulation.compare(other, &mut self.differences);
        }
        own.extend_from_slice(results);
    }

    /// Judges the run that has come to its end, with its conclusion; returns the next one, not initialized, unless the
    /// accuracy is reached or cannot be.
    pub fn judge(&mut self, simulation: &Simulation) -> Option<Box<Simulation>> {
        if self.end.is_some() {
            return None;
        }
        self.runs += 1;
        let rows = self.nearest.as_ref().map_or(0, |nearest| nearest.rows);
        let cost = simulation.cost() + simulation.cost_of_finer(rows);
        match self.runs {
            1 => self.costs = [cost.max(1.0), 0.0],
            _ => self.costs[1] += cost,
        }
        self.divided *= self.ratios[0];
        let excess = match (&self.nearest, self.runs) {
            (Some(_), _) => self.judge_path(simulation),
            (None, 1) => self.judge_first(simulation),
            (None, _) => self.judge_pair(simulation),
        };
        if excess <= 1.0 {
            self.end = Some(End::Reached);
        }
        if self.end.is_some() {
            return None;
        }
        let next = self.next(simulation, cost);
        if next.is_some() {
            let [before, own] = &mut self.rows;
            std::mem::swap(before, own);
            own.clear();
            self.forget_rows();
        }
        next
    }

    /// Forgets how far the rows so far are from those of another run.
    fn forget_rows(&mut self) {
        self.differences = Differences::default();
        self.nearest = self.nearest.take().map(|_| Nearest::default());
    }

    /// Takes back the run that was to come: it failed, and the one before it counts.
    pub fn fail(&mut self, reason: String) {
        self.end = Some(End::Failed(reason));
    }

    /// Sums up the runs so far.
    pub fn outcome(&self, simulation: &Simulation) -> Outcome {
        Outcome {
            runs: self.runs,
            elements: simulation.elements(),
            chooses_mesh: self.chosen.contains(&true),
            keeps_steps: self.keeps_steps(),
            is_motion: self.is_motion,
            is_path: self.nearest.is_some(),
            worst: self.worst.clone(),
            end: self.end.clone().unwrap_or(End::Reached),
            budget: self.allowed() / self.costs[0].max(1.0),
        }
    }

    /// Whether the steps of a motion are given.
    fn keeps_steps(&self) -> bool {
        self.is_motion && !self.chooses_steps
    }

    /// The estimates of the first run, over those that a reader expects.
    fn judge_first(&mut self, simulation: &Simulation) -> f64 {
        let [mut steps, mesh] = simulation.judged_errors();
        if self.keeps_steps() {
            steps.clear();
        }
        self.coarse = Coarse::of(simulation.mesh_distances().cloned());
        let largest = |errors: &[Inexact], excess: fn(&Inexact) -> f64| errors.iter().map(excess).fold(0.0, f64::max);
        self.parts = [largest(&steps, Inexact::excess_of_steps), largest(&mesh, Inexact::excess)];
        self.estimates = [steps.clone(), mesh.clone()];
        if !self.chosen.contains(&true) {
            self.worst = steps.into_iter().max_by(|a, b| a.error.total_cmp(&b.error));
            return self.parts[0];
        }
        let of_mesh = |own: &Inexact| mesh.iter().find(|other| other.name == own.name);
        let sums = steps.iter().map(|own| {
            let of_mesh = of_mesh(own).map_or(0.0, |other| other.error);
            Inexact { error: own.error + of_mesh, ..own.clone() }
        });
        self.worst = sums.chain(mesh.iter().cloned()).max_by(|a, b| a.error.total_cmp(&b.error));
        self.critical = simulation.critical_time();
        let is_steady = mesh.iter().all(|own| own.name != CRITICAL || own.excess() <= 1.0);
        if simulation.is_at_rest() && is_steady {
            return 0.0;
        }
        // Without a comparison nothing is known of the mesh, and a doubt of it is settled by another one.
        if mesh.is_empty() || simulation.doubts_mesh() {
            self.parts[1] = self.parts[1].max(UNKNOWN);
            return f64::INFINITY;
        }
        // As the run would warn: what is warned of is repeated.
        let both = steps.iter().map(|own| own.excess_of_steps() + of_mesh(own).map_or(0.0, Inexact::excess));
        both.fold(self.parts[1], f64::max)
    }

    /// The distance to the path of the finer mesh, over the one that a reader expects.
    fn judge_path(&mut self, simulation: &Simulation) -> f64 {
        let left_out = |is_configuration: bool| {
            let order = if is_configuration { ORDER_OF_MESH } else { ORDER_OF_MESH_OF_RATES };
            1.0 - pow(0.5_f64, order)
        };
        let mut errors = simulation.distances(&self.differences, |_, is_configuration| left_out(is_configuration));
        if !self.nearest.as_ref().is_some_and(Nearest::is_complete) {
            let name = String::from("path.parameter");
            errors.push(Inexact { name, error: f64::INFINITY, is_rough: false });
        }
        if self.nearest.as_ref().is_some_and(Nearest::hides_instability) {
            errors.extend(Inexact::of_critical([None, Some(1.0)], ORDER));
        }
        let before = std::mem::replace(&mut self.distances, errors.clone());
        let excess = |all: &[Inexact]| all.iter().map(Inexact::excess).fold(0.0, f64::max);
        let (own, own_before) = (excess(&errors), excess(&before));
        if self.runs > 2 && own > FALLEN * own_before && own > SENSITIVE {
            self.end = Some(End::Sensitive);
        }
        self.parts = [0.0, own];
        self.worst = errors.into_iter().max_by(|a, b| a.error.total_cmp(&b.error));
        own
    }

    /// The difference from the run before, over the one that a reader expects.
    fn judge_pair(&mut self, simulation: &Simulation) -> f64 {
        let distances = simulation.distances(&self.differences, |_, _| 1.0);
        let [steps, mesh] = self.ratios;
        let before = std::mem::take(&mut self.distances);
        let has_fallen = |name: &str| {
            let [old, new] = [&before, &distances].map(|all| all.iter().find(|own| own.name == name));
            old.zip(new).is_some_and(|(old, new)| old.error >= new.error * pow(steps, STEADY))
        };
        // Equilibria have no other error, so that three runs show how it falls: slowly, as where a load is inside an
        // element.
        let observed = |name: &str| {
            let [old, new] = [&before, &distances].map(|all| all.iter().find(|own| own.name == name));
            let fallen = old.zip(new).filter(|_| !self.is_motion).map(|(old, new)| old.error / new.error);
            fallen.filter(|fallen| fallen.is_finite()).map_or(f64::INFINITY, |fallen| fallen.max(LEAST_GAIN))
        };
        let divisor = |name: &str, is_configuration: bool| {
            let order = if is_configuration || has_fallen(name) { ORDER } else { ORDER_OF_RATES };
            let of_mesh = if is_configuration { ORDER_OF_MESH } else { ORDER_OF_MESH_OF_RATES };
            let gain = |of_mesh: f64| [pow(steps, order), pow(mesh, of_mesh).min(observed(name))];
            let by_mesh = self.plain_shares(name, gain(of_mesh))[1];
            let apart = distances.iter().find(|own| own.name == name).map_or(0.0, |own| own.error * by_mesh);
            let gains = gain(self.coarse.order(name, apart, mesh).min(of_mesh));
            let [of_steps, of_mesh] = self.shares(name, gains);
            // The error over each part of the difference.
            let left = |share: f64, gain: f64| if share > 0.0 { share / (gain - 1.0) } else { 0.0 };
            1.0 / (left(of_steps, gains[0]) + left(of_mesh, gains[1]))
        };
        let mut errors = simulation.distances(&self.differences, divisor);
        let critical = [std::mem::replace(&mut self.critical, simulation.critical_time()), self.critical];
        errors.extend(Inexact::of_critical(critical, pow(mesh, ORDER_OF_MESH)).filter(|_| mesh > 1.0));
        let by_mesh = |own: &Inexact| {
            let share = self.plain_shares(&own.name, [pow(steps, FIRST_ORDER), pow(mesh, ORDER_OF_MESH_OF_RATES)])[1];
            Inexact { error: own.error * share, ..own.clone() }
        };
        let coarse = Coarse::of(Some((mesh, distances.iter().map(by_mesh).collect())));
        let excess = |all: &[Inexact]| all.iter().map(Inexact::excess).fold(0.0, f64::max);
        let (own, apart, apart_before) = (excess(&errors), excess(&distances), excess(&before));
        if self.runs > 2 && apart > FALLEN * apart_before && apart > SENSITIVE {
            let mut of_motion = errors.iter().filter(|own| !own.is_rough).peekable();
            let is_motion_right = of_motion.peek().is_some() && of_motion.all(|own| own.excess() <= 1.0);
            self.end = Some(if is_motion_right { End::Ringing } else { End::Sensitive });
        }
        // Both parts after this refinement, brought to the error that is measured.
        let falls = [pow(steps, FIRST_ORDER), pow(mesh, ORDER_OF_MESH_OF_RATES)];
        let expected = [self.parts[0] / falls[0], self.parts[1] / falls[1]];
        let share = own / expected[0].max(expected[1]).max(f64::MIN_POSITIVE);
        self.parts = expected.map(|part| part * share);
        for (estimates, fall) in self.estimates.iter_mut().zip(falls) {
            estimates.iter_mut().for_each(|own| own.error /= fall);
        }
        self.worst = errors.into_iter().max_by(|a, b| a.error.total_cmp(&b.error));
        self.distances = distances;
        self.coarse = coarse;
        own
    }

    /// The shares that steps and mesh have in the difference of a family, where the errors of the run before are
    /// `gains` times those of this one: as the estimates of the first run stand to each other, but a tenth at least.
    fn shares(&self, name: &str, gains: [f64; 2]) -> [f64; 2] {
        let [of_steps, of_mesh] = self.plain_shares(name, gains);
        if of_steps == 0.0 || of_mesh == 0.0 {
            return [of_steps, of_mesh];
        }
        let of_steps = of_steps.clamp(0.1, 0.9);
        [of_steps, 1.0 - of_steps]
    }

    /// The same, however small; 0 of one that stayed as it was.
    fn plain_shares(&self, name: &str, gains: [f64; 2]) -> [f64; 2] {
        if gains[0] == 1.0 || gains[1] == 1.0 {
            return gains.map(|gain| if gain > 1.0 { 1.0 } else { 0.0 });
        }
        let part = |number: usize| {
            let own = self.estimates[number].iter().find(|own| own.name == name)?;
            Some(own.error.min(1.0) * (1.0 - 1.0 / gains[number]))
        };
        let of_steps = match (part(0), part(1)) {
            (Some(steps), Some(mesh)) if steps + mesh > 0.0 => steps / (steps + mesh),
            _ => 0.5,
        };
        // Estimates of 0 are round-off, not steps that stayed.
        let of_steps = of_steps.clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON);
        [of_steps, 1.0 - of_steps]
    }

    /// The cost that all runs after the first one may have.
    fn allowed(&self) -> f64 {
        self.budget.map_or_else(|| f64::max(BUDGET * self.costs[0], LEAST_COST), |times| times * self.costs[0])
    }

    /// The next run, if the budget has room for it.
    fn next(&mut self, simulation: &Simulation, cost: f64) -> Option<Box<Simulation>> {
        let left = self.allowed() - self.costs[1];
        let wish = pow(self.parts[0].min(1e3) / AIM, 1.0 / FIRST_ORDER).ceil();
        let wished = if self.chooses_steps { (wish as u32).clamp(2, MOST_PARTS) } else { 1 };
        let fewest = wished.min(2);
        let chooses_mesh = self.chosen.contains(&true);
        // The part that is suspected less follows.
        let is_suspected = self.parts[1] > AIM && self.parts[1] > AIM * self.parts[0];
        let meshes: &[f64] = match (chooses_mesh, is_suspected) {
            (false, _) => &[1.0],
            // The elements of equilibria are divided in two.
            (true, _) if !self.is_motion => &FINER[..1],
            (true, true) => &FINER,
            (true, false) => &FINER[1..],
        };
        let choices = (fewest..=wished).rev().flat_map(|parts| meshes.iter().map(move |finer| (parts, *finer)));
        let Some((parts, finer)) = choices.into_iter().find(|(parts, finer)| cost * f64::from(*parts) * finer <= left)
        else {
            self.end = Some(End::Budget);
            return None;
        };
        let document = simulation.document();
        let changes = if chooses_mesh { levels::finer(document, &self.chosen, finer) } else { Some(Vec::new()) };
        let Some(changes) = changes else {
            self.end = Some(End::Failed(String::from("a beam has no finer mesh")));
            return None;
        };
        self.ratios = [f64::from(parts), finer];
        let repeated = match self.is_motion || self.nearest.is_some() {
            true => simulation.repeated(changes, self.chooses_steps.then_some(parts)),
            false => simulation.repeated_at_rest(changes),
        };
        match repeated {
            Ok(next) => Some(Box::new(next)),
            Err(failure) => {
                self.end = Some(End::Failed(failure.message));
                None
            }
        }
    }
}
