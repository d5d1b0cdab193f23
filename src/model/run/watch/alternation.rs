//! Whether forces or accelerations alternate from step to step: that is how an integrator shows a vibration which is
//! far too fast for its steps, and no physics.
//!
//! It can be seen where a host, or a row of results, asks for every single step: what a vibration looks like at every
//! fifth step says nothing.

use crate::error::decimal;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::scale::Beams;
use crate::model::variables::Table;
use serde::{Deserialize, Serialize};

/// Share of the largest value by which a result must alternate: less does not matter, section forces and reactions are
/// not known better.
const SHARE: f64 = 0.05;
/// So many steps in a row. Vibrations that a step just resolves, with three steps a period or more, turn the other way
/// within some.
const STEPS: u32 = 10;
/// A result is compared with this share of the largest of its unit at least: what is far smaller does not matter.
const SMALL: f64 = 0.1;
/// The same of what other forces, the energy, the size and the mass of the system make of that unit: below it is their
/// round-off.
const ROUND_OFF: f64 = 1e-6;
/// Communication points after which results that have alternated are judged, if the run does not end before: what
/// alternates at a start, when all values are small, does not matter once they have grown.
const LASTING: u32 = 200;

/// What has been seen of forces and accelerations.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AlternationWatch {
    is_static: bool,
    /// Internal steps until the last communication point.
    steps: u64,
    /// Communication points in a row, up to the last one, that were a step apart.
    points: u32,
    /// Largest force, moment and acceleration so far.
    largest: [f64; 3],
    /// Largest energy so far, J.
    energy: f64,
    /// Of each component, in the order of the table.
    tracks: Vec<Track>,
    /// What has alternated most and is still to be judged.
    suspect: Option<Suspect>,
    warned: bool,
}

/// A result that has alternated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Suspect {
    /// Its number.
    number: usize,
    amplitude: f64,
    /// What it was compared with.
    scale: f64,
    time: f64,
    /// Communication points since the first result that has alternated.
    points: u32,
}

/// The last values of a component.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Track {
    /// At the last point and at the one before.
    values: [f64; 2],
    /// A quarter of the second difference of the last three: the amplitude of what alternates, with its sign.
    amplitude: f64,
    /// Steps in a row for which it has alternated.
    count: u32,
    largest: f64,
}

impl Track {
    /// Takes a new value, `points` steps in a row behind the first, and counts it where it alternates by more than
    /// `bound`.
    fn add(&mut self, value: f64, points: u32, bound: f64) {
        let [last, before] = self.values;
        let amplitude = if points >= 2 { 0.25 * (value - 2.0 * last + before) } else { 0.0 };
        let goes_on = amplitude * self.amplitude < 0.0 && amplitude.abs() > bound;
        self.count = if goes_on { self.count.saturating_add(1) } else { 0 };
        (self.values, self.amplitude) = ([value, last], amplitude);
    }
}

impl Suspect {
    fn share(&self) -> f64 {
        if self.scale > 0.0 { self.amplitude / self.scale } else { 0.0 }
    }
}

impl AlternationWatch {
    /// Of a run of this analysis.
    pub fn new(analysis: Analysis) -> Self {
        Self { is_static: analysis == Analysis::Static, ..Self::default() }
    }

    /// Looks at the `results` of a new state; `beams` is what their quantities amount to.
    pub fn look(
        &mut self,
        system: &System,
        state: &State,
        (table, results): (&Table, &[f64]),
        beams: &Beams,
    ) -> Option<String> {
        let is_next = state.statistics.steps == self.steps.wrapping_add(1);
        self.steps = state.statistics.steps;
        self.points = if is_next { self.points.saturating_add(1) } else { 0 };
        // A sequence of equilibria has no vibrations: its loads may alternate.
        if self.warned || self.is_static {
            return None;
        }
        for (kind, numbers) in forces(table) {
            let values = results[numbers].iter();
            self.largest[kind] = values.fold(self.largest[kind], |largest, value| largest.max(value.abs()));
        }
        let energy = state.balance.last.map_or(0.0, |last| last.kinetic + last.elastic);
        self.energy = self.energy.max(energy);
        let least = self.least(system, beams);
        let mut first = 0;
        for (kind, numbers) in forces(table) {
            let end = first + numbers.len();
            if self.tracks.len() < end {
                self.tracks.resize(end, Track::default());
            }
            let tracks = &mut self.tracks[first..end];
            for (track, number) in tracks.iter_mut().zip(numbers.clone()) {
                track.largest = track.largest.max(results[number].abs());
            }
            let scale = tracks.iter().fold(least[kind], |largest, track| largest.max(track.largest));
            for (track, number) in tracks.iter_mut().zip(numbers) {
                track.add(results[number], self.points, SHARE * scale);
                let amplitude = track.amplitude.abs();
                let suspect = self.suspect.unwrap_or_default();
                if track.count >= STEPS && amplitude / scale > suspect.share() {
                    let time = state.instant();
                    self.suspect = Some(Suspect { number, amplitude, scale, time, points: suspect.points });
                }
            }
            first = end;
        }
        let suspect = self.suspect.as_mut()?;
        suspect.points += 1;
        if suspect.points >= LASTING { self.judge(system, table, beams) } else { None }
    }

    /// Judges what has alternated by the largest values that the run has come to; arguments are those of
    /// [`Self::look`].
    pub fn judge(&mut self, system: &System, table: &Table, beams: &Beams) -> Option<String> {
        let Suspect { number, amplitude, time, .. } = self.suspect.take()?;
        let least = self.least(system, beams);
        let mut first = 0;
        let mut scale = 0.0_f64;
        for (kind, numbers) in forces(table) {
            let end = first + numbers.len();
            if numbers.contains(&number) {
                scale = self.tracks[first..end].iter().fold(least[kind], |largest, track| largest.max(track.largest));
            }
            first = end;
        }
        let share = amplitude / scale;
        if share.is_nan() || share <= SHARE {
            return None;
        }
        self.warned = true;
        Some(format!(
            "{} alternates from step to step, by {:.0} % of its largest value at t = {} s and more than {:.0} % for {STEPS} steps: the steps do not resolve a vibration that \
             is far too fast for them, and forces are not to be trusted; take smaller steps (simulation.step or simulation.accuracy), a smaller spectral_radius, or material damping",
            table.result_name(number),
            100.0 * share,
            decimal(time),
            100.0 * SHARE
        ))
    }

    /// The least that forces (N), moments (N m) and accelerations (m/s²) are compared with.
    fn least(&self, system: &System, beams: &Beams) -> [f64; 3] {
        let [force, moment, acceleration] = self.largest;
        // What heat and prestress would cause is there, and cancels.
        let (force, moment) = (force.max(beams.relieved.force), moment.max(beams.relieved.moment));
        let of_others = [
            (moment.max(self.energy) / system.size).max(system.mass * acceleration).max(force),
            (force * system.size).max(moment).max(self.energy),
            (force / system.mass).max(system.gravity.norm()),
        ];
        // Without mass or size there is nothing to be compared with.
        let finite = of_others.map(|other| if other.is_finite() { other } else { 0.0 });
        std::array::from_fn(|kind| (SMALL * self.largest[kind]).max(ROUND_OFF * finite[kind]))
    }
}

/// The results that are forces (0), moments (1) and accelerations (2), quantity by quantity, by their numbers.
fn forces(table: &Table) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> + '_ {
    table.quantities().filter_map(|(unit, numbers)| {
        let kind = ["N", "N.m", "m/s2"].iter().position(|own| *own == unit)?;
        Some((kind, numbers))
    })
}
