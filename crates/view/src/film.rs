//! A simulation as the page will show it: recorded row by row, thinned out where there are too many, written in the
//! end.

use super::block::{Effort, doubles};
use super::charts::Charts;
use super::format::{self, Data, FORMAT};
use super::live::Live;
use super::page;
use super::second::Shown;
use ancf14::error::decimal;
use ancf14::fmi::Model;
use ancf14::model::modes::Modes;
use ancf14::model::simulation::Simulation;
use ancf14::model::view::{Recording, Swing};

/// Instants of the picture times stations of all beams: some 3 MB of page.
const MOST_POSES: u64 = 240_000;
/// Instants of the picture: more than this no eye can tell apart.
const MOST_INSTANTS: u64 = 2_000;
/// Instants of the charts times columns: some 3 MB of page.
const MOST_VALUES: u64 = 400_000;

/// What was recorded.
#[derive(Debug)]
pub struct Film {
    recording: Recording,
    charts: Charts,
    swings: Vec<Swing>,
    notes: Vec<String>,
    last_row: u64,
    /// One row in so many is in the picture, and in the charts.
    every: [u64; 2],
}

impl Film {
    /// Of a simulation that has just been loaded and will have the rows 0 to `last_row`.
    pub fn new(simulation: &Simulation, last_row: u64) -> Self {
        let (recording, charts) = (Recording::new(simulation), Charts::new(simulation.variables()));
        let rows = last_row + 1;
        let most = |limit: u64, width: usize| (limit / (width as u64).max(1)).max(2);
        let instants = most(MOST_POSES, recording.stations()).min(MOST_INSTANTS);
        let every = [instants, most(MOST_VALUES, charts.width())].map(|most| rows.div_ceil(most));
        Self { recording, charts, swings: Vec::new(), notes: Vec::new(), last_row, every }
    }

    /// The mechanism as drawn, without charts: `simulation` has just been loaded.
    pub fn drawn(simulation: &Simulation) -> Self {
        let mut recording = Recording::new(simulation);
        recording.record(simulation);
        Self { recording, charts: Charts::new(&[]), swings: Vec::new(), notes: Vec::new(), last_row: 0, every: [1; 2] }
    }

    /// Looks at row `row`, which the simulation has reached.
    pub fn look(&mut self, row: u64, simulation: &Simulation) {
        let is_due = |every: u64| row.is_multiple_of(every) || row == self.last_row;
        let [shown, charted] = self.every.map(is_due);
        if shown {
            self.recording.record(simulation);
        }
        if charted {
            self.charts.record(simulation);
        }
    }

    /// Adds natural modes about the state of the last look.
    pub fn add_modes(&mut self, simulation: &Simulation, found: &Modes) {
        self.swings = self.recording.swings(simulation, found);
    }

    /// Adds something that the page says.
    pub fn note(&mut self, text: &str) {
        self.notes.push(text.to_owned());
    }

    /// The page; with the solver, if it brings one.
    ///
    /// # Errors
    /// Its numbers cannot be written as JSON.
    pub fn page(&self, live: Option<&Live>) -> Result<String, serde_json::Error> {
        page::html(&self.shown()?, None, live)
    }

    /// The run as a page has it.
    ///
    /// # Errors
    /// Its numbers cannot be written as JSON.
    pub fn shown(&self) -> Result<Shown, serde_json::Error> {
        Ok(Shown {
            name: self.recording.scene.name.clone(),
            instants: self.instants(),
            json: self.data(Effort::Small)?,
        })
    }

    /// The data of the page, as JSON.
    ///
    /// # Errors
    /// Its numbers cannot be written as JSON.
    pub fn data(&self, effort: Effort) -> Result<String, serde_json::Error> {
        let Self { recording, charts, swings, .. } = self;
        let rows = self.last_row + 1;
        let thinned = |what: &str, every: u64, count: usize| {
            let text = format!("To keep the page small, {what} one row of results in {every}: {count} of {rows}.");
            (every > 1).then_some(text)
        };
        let [shown, charted] = self.every;
        let thinned = [
            thinned("the picture has", shown, recording.times.len()),
            thinned("the charts have", charted, charts.count()),
        ];
        let data = Data {
            format: FORMAT,
            program: format!("ancf14 {}", env!("CARGO_PKG_VERSION")),
            scene: format::scene(&recording.scene),
            notes: self.notes.iter().cloned().chain(thinned.into_iter().flatten()).collect(),
            times: doubles(&recording.times, effort),
            instants: recording.times.len(),
            tracks: format::tracks(recording, effort),
            charts: charts.charted(recording, effort),
            modes: swings.iter().map(format::mode).collect(),
        };
        serde_json::to_string(&data)
    }

    /// Instants in the picture.
    pub fn instants(&self) -> usize {
        self.recording.times.len()
    }
}

/// What the page says of a run that failed at `time`, s.
pub fn ended_early(time: f64, message: &str) -> String {
    let reason = message.lines().next().unwrap_or(message).trim_start_matches("error: ");
    format!("The run ended early, at t = {} s: {reason}", decimal(time))
}
