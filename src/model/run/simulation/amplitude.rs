//! How nonlinear motions are: the numbers by which a linear system estimates its own error.
//!
//! Nonlinear runs measure it. Each begins in the state that the system is about, with the velocities of a vibration,
//! and takes one period. Coordinates that start unmoved need no correction. A beam that is displaced along a linear
//! shape would be stretched; a beam that is struck finds its own way. Runs with the amplitudes `±a` and `±a/2` tell the
//! parts of outputs that grow with the second and third power. Errors of steps are linear, and cancel. A fifth run,
//! without a vibration, has the effects of functions of time, which are subtracted. Equilibria with other values
//! measure forces, and motions that a host prescribes.

use super::given::Given;
use super::linear::{Amplitude, Linear, Motion, Pole, PoleKind, Signal};
use super::solver::Solver;
use super::{Simulation, Snapshot};
use crate::fmi::{Model, Value};
use crate::math::elementary::{hypot, ln};
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::variation::Variation;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::levels;
use crate::solve::linear::dense::Complex;
use crate::solve::linear::eigen::Eigen;
use crate::solve::modes::subspace::dot;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Amplitude of the first runs, over the size of the mechanism or rad.
const AMPLITUDE: f64 = 0.05;
/// The largest share of the third power that is measured; beyond, the next powers count.
const LARGEST: f64 = 0.03;
/// Factor that amplitudes become smaller by, and how often at most: thin clamped strips are nonlinear from their
/// thickness on.
const SMALLER: f64 = 0.25;
const MOST_TRIES: usize = 7;
/// Vibrations that are measured, the softest ones. Others are taken for as nonlinear as the nearest one.
const MOST_VIBRATIONS: usize = 8;
/// Vibrations that are tried, the softest ones: some cannot be measured.
const MOST_ATTEMPTS: usize = 2 * MOST_VIBRATIONS;
/// Largest distance of a pole of the reduced system from that of the whole one which it stands for.
const SAME: f64 = 0.1;
/// Vibrations with poles so near to each other are told apart by the outputs: those of round beams in two planes.
const NEAR: f64 = 1e-3;
/// Rows of a period, and internal steps between two of them.
const ROWS: usize = 24;
const STEPS: f64 = 5.0;
/// Changes of outputs up to this share of their size are round-off.
const ROUND_OFF: f64 = 1e-13;
/// The equilibrium where a run begins is the one of the linear system up to this distance.
const THERE: f64 = 1e-6;

const NO_RUNS: &str = "a nonlinear run cannot begin in the equilibrium that the system is about";

/// Sizes of the parts of a motion's outputs, for each unit, and of the outputs that they are changes of.
#[derive(Clone, Debug, Default)]
struct Parts {
    size: Vec<f64>,
    linear: Vec<f64>,
    even: Vec<f64>,
    odd: Vec<f64>,
}

impl Parts {
    /// Those of rows of outputs at the amplitudes `1`, `−1`, `1/2`, `−1/2`, about rows without a motion. Functions of
    /// time may move the latter.
    fn new(runs: &[Vec<Vec<f64>>; 4], about: &[Vec<f64>], kinds: &[usize], count: usize) -> Self {
        let zeros = || vec![0.0; count];
        let mut parts = Self { size: zeros(), linear: zeros(), even: zeros(), odd: zeros() };
        let [up, down, half_up, half_down] = runs;
        for row in 0..up.len() {
            let mut squares = vec![[0.0; 3]; count];
            for (output, (about, kind)) in about[row].iter().zip(kinds).enumerate() {
                parts.size[*kind] = parts.size[*kind].max(about.abs());
                let [up, down] = [up, down].map(|run| run[row][output] - about);
                let [half_up, half_down] = [half_up, half_down].map(|run| run[row][output] - about);
                let (whole, half) = ((up - down) / 2.0, (half_up - half_down) / 2.0);
                // whole = l + o, half = l/2 + o/8.
                let odd = (whole - 2.0 * half) * (4.0 / 3.0);
                let own = [whole - odd, (up + down) / 2.0, odd];
                squares[*kind].iter_mut().zip(own).for_each(|(sum, own)| *sum += own * own);
            }
            for (kind, [linear, even, odd]) in squares.into_iter().enumerate() {
                let all = [(&mut parts.linear, linear), (&mut parts.even, even), (&mut parts.odd, odd)];
                all.into_iter().for_each(|(list, square)| list[kind] = list[kind].max(square.sqrt()));
            }
        }
        parts
    }

    /// Whether the motion is of first order in the outputs of a unit.
    fn is_seen(&self, kind: usize) -> bool {
        self.linear[kind] > self.even[kind] + self.odd[kind]
    }

    /// Whether outputs of a unit move, by more than round-off.
    fn moves(&self, kind: usize) -> bool {
        self.linear[kind] + self.even[kind] + self.odd[kind] > ROUND_OFF * self.size[kind]
    }

    /// Whether any output moves.
    fn move_any(&self) -> bool {
        (0..self.linear.len()).any(|kind| self.moves(kind))
    }

    /// The largest share of the third power; none: it is not a number, or no output moves to first order.
    fn largest(&self) -> Option<f64> {
        let seen = (0..self.linear.len()).filter(|kind| self.is_seen(*kind));
        seen.map(|kind| self.odd[kind] / self.linear[kind]).reduce(f64::max).filter(|share| share.is_finite())
    }
}

/// A vibration of the reduced system, or a motion that fades, with its pole.
#[derive(Debug)]
struct Own {
    pole: [f64; 2],
    motion: Motion,
}

impl Own {
    /// How far a constant unit of an input moves the outputs in this motion.
    fn response(&self, linear: &Linear, input: usize) -> f64 {
        let moved = self.motion.weights.each_ref().map(|weights| dot(weights, linear.b.column(input)));
        size(moved) / size(self.pole) * self.motion.linear.iter().sum::<f64>()
    }
}

impl Linear {
    /// Measures by nonlinear runs what [`Self::amplitude`] has. This system is a reduction of `whole`.
    ///
    /// # Errors
    /// The reason why nothing is measured, as half a sentence.
    pub fn measure_amplitude(&mut self, whole: &Self, simulation: &Simulation) -> Result<(), String> {
        self.amplitude = None;
        self.amplitude = Some(measured(self, whole, simulation)?);
        Ok(())
    }
}

fn measured(linear: &Linear, whole: &Linear, simulation: &Simulation) -> Result<Amplitude, &'static str> {
    if whole.steady.is_some() {
        return Err("the system is about a steady rotation, where it is not measured");
    }
    if !whole.is_still() {
        return Err("the mechanism moves in the state that the system is about, or its forces do not balance there");
    }
    let units: Vec<&str> = linear.outputs.iter().map(|own| own.unit.as_str()).collect();
    let firsts: Vec<usize> = (0..units.len()).filter(|own| !units[..*own].contains(&units[*own])).collect();
    let kind = |unit: &&str| firsts.iter().position(|first| units[*first] == *unit);
    let kinds: Vec<usize> = units.iter().filter_map(kind).collect();
    let mut gauge = Gauge::new(simulation, linear, kinds, firsts.len()).ok_or(NO_RUNS)?;

    let is_kept = |own: &Signal| whole.states.iter().any(|other| other.name == own.name);
    let kept: Vec<bool> = linear.states.iter().map(is_kept).collect();
    let mut vibrations = vibrations(linear, &kept, &gauge).ok_or("the poles of the reduced system are not found")?;
    let poles = whole.poles(simulation).map_err(|_| "the poles of the whole system are not found")?;
    let mut found = gauge.strike_all(&vibrations, &poles);
    let own: Vec<Option<Parts>> = vibrations.iter().map(|own| nearest(own.pole, &found).cloned()).collect();
    let largest = |kind: usize| vibrations.iter().map(|own| own.motion.linear[kind]).fold(0.0, f64::max);
    let largest: Vec<f64> = (0..gauge.count).map(largest).collect();
    for (own, parts) in vibrations.iter_mut().zip(own) {
        if let Some(parts) = parts {
            own.motion.raise(&parts, &largest);
        }
    }
    // Nothing holds a motion without stiffness against a force.
    let is_held = kept.iter().filter(|kept| **kept).count() == whole.integrators();
    for (input, name) in linear.inputs.iter().enumerate().filter(|_| is_held) {
        let Some((_, parts)) = gauge.push(simulation, whole, input, &name.name) else { continue };
        let part = |own: &Own| own.response(linear, input);
        let Some(own) = vibrations.iter_mut().max_by(|a, b| part(a).total_cmp(&part(b))) else { continue };
        own.motion.raise(&parts, &largest);
        found.push((own.pole, parts));
    }
    let mut all: Vec<Motion> = vibrations.into_iter().map(|own| own.motion).collect();
    for state in (0..kept.len()).filter(|state| kept[*state]) {
        let (motion, parts) = gauge.kept(simulation, linear, state);
        all.push(motion);
        found.extend(parts.map(|parts| ([0.0; 2], parts)));
    }
    // Outputs that move to second order only would have a share of 1 at any amplitude.
    let seen: Vec<usize> = (0..gauge.count).filter(|kind| found.iter().any(|(_, own)| own.is_seen(*kind))).collect();
    for list in all.iter_mut().flat_map(|own| [&mut own.linear, &mut own.even, &mut own.odd]) {
        *list = seen.iter().map(|kind| list[*kind]).collect();
    }
    let lists = all.iter().flat_map(|own| own.weights.iter().chain([&own.linear, &own.even, &own.odd]));
    if seen.is_empty() {
        return Err("no motion was measured that moves an output in proportion to its amplitude");
    }
    if lists.flatten().any(|value| !value.is_finite()) {
        return Err("a number of the motions is too large");
    }
    Ok(Amplitude { motions: all })
}

impl Motion {
    /// Raises the nonlinear parts to those of a motion that was measured, at its own amplitude. It is told by the
    /// outputs that it moves most, over the `largest` of all motions.
    fn raise(&mut self, parts: &Parts, largest: &[f64]) {
        let share = |kind: &usize| self.linear[*kind] / largest[*kind];
        let kinds = (0..largest.len()).filter(|kind| parts.is_seen(*kind) && largest[*kind] > 0.0);
        let Some(kind) = kinds.max_by(|a, b| share(a).total_cmp(&share(b))) else { return };
        let factor = self.linear[kind] / parts.linear[kind];
        for own in 0..largest.len() {
            // Outputs that stand still, as velocities of equilibria, take the share of the others.
            let (from, part) = match parts.moves(own) {
                true => (own, 1.0),
                false => (kind, self.linear[own] / self.linear[kind]),
            };
            self.even[own] = self.even[own].max(part * parts.even[from] * factor.powi(2));
            self.odd[own] = self.odd[own].max(part * parts.odd[from] * factor.powi(3));
        }
    }
}

/// The motions of all states but those `kept`, which poles at 0 belong to.
fn vibrations(linear: &Linear, kept: &[bool], gauge: &Gauge) -> Option<Vec<Own>> {
    let own: Vec<usize> = (0..kept.len()).filter(|state| !kept[*state]).collect();
    if own.is_empty() {
        return Some(Vec::new());
    }
    let a = linear.a.columns_at(own.iter().copied()).rows_of(&own);
    let c = linear.c.columns_at(own.iter().copied());
    let found = a.eigensystem().ok()?;
    let motion = |Eigen { value, right, left }: &Eigen| {
        let mut weights = [vec![0.0; kept.len()], vec![0.0; kept.len()]];
        for (state, weight) in own.iter().zip(left) {
            (weights[0][*state], weights[1][*state]) = (weight.re, weight.im);
        }
        // A pair moves the outputs by twice the real part of its first vector.
        let factor = if value.im > 0.0 { 2.0 } else { 1.0 };
        let sizes = (0..c.rows).map(|row| {
            let sum: Complex = right.iter().enumerate().map(|(state, value)| value * c.at(row, state)).sum();
            factor * sum.norm()
        });
        let (linear, none) = (gauge.sizes(sizes), vec![0.0; gauge.count]);
        Own { pole: [value.re, value.im], motion: Motion { weights, linear, even: none.clone(), odd: none } }
    };
    let mut all: Vec<Own> = found.iter().filter(|own| own.value.im >= 0.0).map(motion).collect();
    all.sort_by(|a, b| size(a.pole).total_cmp(&size(b.pole)));
    Some(all)
}

fn size([real, imaginary]: [f64; 2]) -> f64 {
    hypot(real, imaginary)
}

/// The parts that were measured at the pole next to `pole`, by the ratio of frequencies.
fn nearest(pole: [f64; 2], found: &[([f64; 2], Parts)]) -> Option<&Parts> {
    let apart = |own: &[f64; 2]| ln(size(*own) / size(pole)).abs();
    found.iter().min_by(|(a, _), (b, _)| apart(a).total_cmp(&apart(b))).map(|(_, parts)| parts)
}

/// Measures motions.
#[derive(Debug)]
struct Gauge {
    /// The results that are outputs, and the unit of each by its number, of `count` ones.
    results: Vec<usize>,
    kinds: Vec<usize>,
    count: usize,
    /// The value of each output where all begins.
    about: Vec<f64>,
    /// A run of its own, and the state that it begins with.
    run: Simulation,
    start: Snapshot,
}

impl Gauge {
    /// None: there are no runs in time, or they begin in another state.
    fn new(simulation: &Simulation, linear: &Linear, kinds: Vec<usize>, count: usize) -> Option<Self> {
        let names: Vec<String> = linear.outputs.iter().map(|own| own.name.clone()).collect();
        let is_static = simulation.document.simulation.analysis == Analysis::Static;
        let changes = [("simulation.analysis", "dynamic"), ("simulation.initial", "equilibrium")];
        let mut run = twin(simulation, if is_static { &changes } else { &[] })?;
        run.initialize(simulation.about.start).ok()?;
        if !is_static {
            run.go_back_to(&simulation.snapshot());
        }
        let (own, base) = (&run.runner.state, linear.base_state());
        let apart: Vec<f64> = own.q.iter().zip(&base.q).map(|(own, base)| own - base).collect();
        let fits = own.q.len() == base.q.len() && run.system().correction_size(&apart).0 <= THERE;
        if !fits || matches!(run.runner.solver, Solver::Statics(_) | Solver::None) {
            return None;
        }
        // Runs take given steps, also where the solver of the file chooses its own.
        if let Some(pacing) = &mut run.runner.pacing {
            pacing.is_given = true;
            run.runner.solver = Solver::new(&run.document, &run.runner.system, run.runner.pacing).ok()?;
            run.runner.pacing = None;
        }
        let results = run.linear_outputs(Some(&names)).ok()?;
        run.read_results().ok()?;
        let about = results.iter().map(|number| run.results[*number]).collect();
        let start = run.snapshot();
        Some(Self { results, kinds, count, about, run, start })
    }

    /// The sizes of outputs, for each unit.
    fn sizes(&self, outputs: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut squares = vec![0.0; self.count];
        outputs.zip(&self.kinds).for_each(|(own, kind)| squares[*kind] += own * own);
        squares.into_iter().map(f64::sqrt).collect()
    }

    /// The parts of the softest `vibrations`, with their poles: those that poles of the whole system stand for.
    fn strike_all(&mut self, vibrations: &[Own], whole: &[Pole]) -> Vec<([f64; 2], Parts)> {
        let whole: Vec<&Pole> = whole.iter().filter(|own| own.kind == PoleKind::Oscillating).collect();
        let mut found = Vec::new();
        for own in vibrations.iter().filter(|own| own.pole[1] > 0.0).take(MOST_ATTEMPTS) {
            let apart = |other: &&Pole| hypot(other.value[0] - own.pole[0], other.value[1] - own.pole[1]);
            let least = whole.iter().map(apart).fold(f64::INFINITY, f64::min);
            let most = f64::min(SAME * size(own.pole), least + NEAR * size(own.pole));
            let alike = whole.iter().filter(|other| apart(other) <= most);
            let parts = alike.filter_map(|pole| self.strike(pole)).max_by(|a, b| a.0.total_cmp(&b.0));
            found.extend(parts.map(|(_, parts)| (own.pole, parts)));
            if found.len() == MOST_VIBRATIONS {
                break;
            }
        }
        found
    }

    /// The parts of the vibration with `pole`, and how large outputs are over its amplitude; none: they cannot be
    /// measured.
    fn strike(&mut self, pole: &Pole) -> Option<(f64, Parts)> {
        let mut amplitude = AMPLITUDE;
        let about = self.vibrate(pole, 0.0)?;
        for _ in 0..MOST_TRIES {
            let runs = [1.0, -1.0, 0.5, -0.5].map(|factor| self.vibrate(pole, factor * amplitude));
            if let [Some(up), Some(down), Some(half_up), Some(half_down)] = runs {
                let parts = Parts::new(&[up, down, half_up, half_down], &about, &self.kinds, self.count);
                if !parts.move_any() {
                    return None;
                }
                if let Some(share) = parts.largest()
                    && share <= LARGEST
                {
                    return Some((parts.linear.iter().sum::<f64>() / amplitude, parts));
                }
            }
            amplitude *= SMALLER;
        }
        None
    }

    /// Rows of outputs over a period of a run that begins with the velocities of a vibration.
    fn vibrate(&mut self, pole: &Pole, amplitude: f64) -> Option<Vec<Vec<f64>>> {
        let run = &mut self.run;
        run.restore(&self.start);
        let system = Arc::clone(&run.runner.system);
        let (mut change, mut frames) = (Variation::default(), FrameCache::default());
        let state = &mut run.runner.state;
        change.set_zero(state);
        let factor = amplitude * pole.natural_frequency() / system.correction_size(&pole.shape).0;
        change.lists.velocity.iter_mut().zip(&pole.shape).for_each(|(own, shape)| *own = factor * shape);
        change.apply(&system, 1.0, state, &mut frames);
        run.runner.set_motion("the velocities of the mode", &mut Vec::new()).ok()?;
        let interval = TAU / pole.value[1] / ROWS as f64;
        run.runner.step = interval / STEPS;
        let begin = run.runner.state.time;
        run.runner.start = begin;
        let mut rows = Vec::new();
        for row in 1..=ROWS {
            run.advance(begin + row as f64 * interval).ok()?;
            rows.push(self.results.iter().map(|number| run.results[*number]).collect());
        }
        run.take_warnings();
        Some(rows)
    }

    /// The motion of a state that a pole at 0 belongs to, and its parts; no parts: the motion counts as linear.
    fn kept(&self, simulation: &Simulation, linear: &Linear, state: usize) -> (Motion, Option<Parts>) {
        let mut weights = [vec![0.0; linear.states.len()], vec![0.0; linear.states.len()]];
        weights[0][state] = 1.0;
        let scaled = |list: &[f64], factor: f64| list.iter().map(|own| own / factor).collect::<Vec<f64>>();
        let Some((reach, parts)) = self.move_input(simulation, &linear.states[state].name) else {
            let (linear, none) = (self.sizes(linear.c.column(state).iter().copied()), vec![0.0; self.count]);
            return (Motion { weights, linear, even: none.clone(), odd: none }, None);
        };
        let own = [(&parts.linear, 1), (&parts.even, 2), (&parts.odd, 3)];
        let [linear, even, odd] = own.map(|(list, power)| scaled(list, reach.powi(power)));
        (Motion { weights, linear, even, odd }, Some(parts))
    }

    /// The parts of the motion whose value is the state `name`, and by how much it moved. None: no host gives this
    /// value, or equilibria are not found. A host that gives a rate does not move the value of an equilibrium.
    fn move_input(&self, simulation: &Simulation, name: &str) -> Option<(f64, Parts)> {
        let (givens, _) = simulation.givens(&self.run.runner.state);
        let is_own = |given: &&Given| given.states.as_ref().is_some_and(|[value, _]| value.0 == name);
        let given = givens.iter().find(is_own).filter(|given| !given.is_rate(&simulation.document))?;
        let reference = simulation.table.variables.iter().position(|own| own.name == given.variable)?;
        let [(_, unit, _), _] = given.states.as_ref()?;
        self.hold_all(simulation, reference, AMPLITUDE * if unit == "m" { simulation.system().size } else { 1.0 })
    }

    /// The parts of the equilibria with other values of a force, and by how much it changed. The force is the input
    /// `name` of the whole system, number `input`. None: it prescribes a motion, or equilibria are not found.
    fn push(&self, simulation: &Simulation, whole: &Linear, input: usize, name: &str) -> Option<(f64, Parts)> {
        let (givens, _) = simulation.givens(&self.run.runner.state);
        let given = givens.iter().find(|given| given.name == name && given.states.is_none())?;
        let reference = simulation.table.variables.iter().position(|own| own.name == given.variable)?;
        let reach = whole.static_reach(simulation, input);
        if reach > 0.0 { self.hold_all(simulation, reference, AMPLITUDE / reach) } else { None }
    }

    /// The parts of the equilibria with changes of an input by `reach` and less; none: no output moves.
    fn hold_all(&self, simulation: &Simulation, reference: usize, mut reach: f64) -> Option<(f64, Parts)> {
        let about = [self.about.clone()];
        for _ in 0..MOST_TRIES {
            let rows = [1.0, -1.0, 0.5, -0.5].map(|factor| self.hold(simulation, reference, factor * reach));
            if let [Some(up), Some(down), Some(half_up), Some(half_down)] = rows {
                let rows = [up, down, half_up, half_down].map(|row| vec![row]);
                let parts = Parts::new(&rows, &about, &self.kinds, self.count);
                match parts.largest() {
                    Some(share) if share > LARGEST => (),
                    _ => return parts.move_any().then_some((reach, parts)),
                }
            }
            reach *= SMALLER;
        }
        None
    }

    /// The outputs in equilibrium with another value of an input.
    fn hold(&self, simulation: &Simulation, reference: usize, by: f64) -> Option<Vec<f64>> {
        // Another time has other loads.
        if simulation.time() != simulation.about.start {
            return None;
        }
        let mut run = twin(simulation, &[("simulation.initial", "equilibrium")])?;
        let Value::Real(value) = simulation.value(reference) else { return None };
        run.set_value(reference, Value::Real(value + by)).ok()?;
        run.initialize(simulation.about.start).ok()?;
        Some(self.results.iter().map(|number| run.results[*number]).collect())
    }
}

/// The same model, not initialized, with these changes of its file.
fn twin(simulation: &Simulation, changes: &[(&str, &str)]) -> Option<Simulation> {
    let changes = changes.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let document = levels::changed(&simulation.document, &simulation.overrides, changes)?;
    let mut twin = Simulation::of(document, simulation.overrides.clone()).ok()?;
    twin.inputs.copy_from(&simulation.inputs);
    twin.first_state.clone_from(&simulation.first_state);
    Some(twin)
}
