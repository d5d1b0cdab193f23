//! A simulation as it goes: files of each instant, and in the end their lists.

use super::parts::{Instant, KINDS};
use super::polydata::collection;
use ancf14::error::decimal;
use ancf14::model::simulation::Simulation;
use ancf14::model::view::Recording;

/// A file: its name and its bytes.
pub type File = (String, Vec<u8>);

/// What is written of a simulation.
#[derive(Debug)]
pub struct Export {
    recording: Recording,
    /// Digits of a number of an instant.
    digits: usize,
    /// The instants so far, s.
    times: Vec<f64>,
}

impl Export {
    /// Prepares the export of a simulation that has just been loaded, with `instants` instants.
    pub fn new(simulation: &Simulation, instants: u64) -> Self {
        let digits = instants.saturating_sub(1).to_string().len();
        Self { recording: Recording::new(simulation), digits, times: Vec::new() }
    }

    /// The files of the instant that the simulation has reached.
    pub fn look(&mut self, simulation: &Simulation) -> Vec<File> {
        self.recording.record(simulation);
        self.recording.keep_last();
        let number = self.times.len();
        let time = self.recording.times.last().map_or(0.0, |time| decimal(*time));
        self.times.push(time);
        let at = Instant(&self.recording);
        self.kinds().map(|(kind, data)| (self.name(kind, number), data(at).file(time))).collect()
    }

    /// The lists of the files so far, one of each kind.
    pub fn lists(&self) -> Vec<File> {
        let list = |kind: &str| {
            let files = self.times.iter().enumerate().map(|(number, time)| (self.name(kind, number), *time));
            (format!("{kind}.pvd"), collection(&files.collect::<Vec<_>>()))
        };
        self.kinds().map(|(kind, _)| list(kind)).collect()
    }

    /// The names of all files when there are `instants`.
    pub fn names(&self, instants: u64) -> Vec<String> {
        let names =
            |kind| (0..instants).map(move |number| self.name(kind, number as usize)).chain([format!("{kind}.pvd")]);
        self.kinds().flat_map(|(kind, _)| names(kind)).collect()
    }

    /// The kinds of parts that the mechanism has.
    pub fn parts(&self) -> Vec<&'static str> {
        self.kinds().map(|(kind, _)| kind).collect()
    }

    /// Instants so far.
    pub fn instants(&self) -> usize {
        self.times.len()
    }

    fn kinds(&self) -> impl Iterator<Item = (&'static str, fn(Instant<'_>) -> super::polydata::PolyData)> {
        let scene = &self.recording.scene;
        KINDS.iter().filter(|(_, is_there, _)| is_there(scene)).map(|(kind, _, data)| (*kind, *data))
    }

    fn name(&self, kind: &str, number: usize) -> String {
        format!("{kind}_{number:0digits$}.vtp", digits = self.digits)
    }
}
