//! One run of a model, and its repetition with finer steps and meshes until the accuracy is reached.
//!
//! The rows of a repetition go to a file of their own, which takes the place of the rows before it when the repetition
//! has come to its end: whatever ends the program, the folder has the whole rows of the last run that was complete.

use super::folder::Folder;
use super::inputs::Inputs;
use super::keeper::{Keeper, Signal, interrupted, kept};
use super::output::trouble;
use super::progress::{Plan, bar};
use super::rows::{Rows, Shared, locked};
use super::{Stop, complain, failed, say, stages, start};
use ancf14::fmi::Model;
use ancf14::model::ranges::Ranges;
use ancf14::model::refinement::Refinement;
use ancf14::model::rows;
use ancf14::model::simulation::{Beginning, Simulation};
use ancf14_report::results::Results;
use ancf14_view::Film;
use std::fs;
use std::io;

/// The rows of a repetition while it goes on.
pub const NEXT: &str = "results.next.csv";

/// A run with what it leaves.
pub struct Attempt {
    pub simulation: Simulation,
    pub results: Results,
    pub ranges: Ranges,
    pub rows: Shared,
    /// A page that shows the mechanism move.
    pub film: Option<Film>,
    /// Warnings that are not told yet: a repetition may do without them.
    pub held: Vec<String>,
}

/// The inputs and rows that all runs of a model have in common.
#[derive(Clone, Copy)]
pub struct Script<'a> {
    /// A table of inputs; none: the start values of the file.
    pub inputs: Option<&'a Inputs>,
    /// The state of another run that they begin with.
    pub from: Option<&'a Beginning>,
    /// Their rows.
    pub plan: Plan,
}

/// The reason why a run ends early.
pub enum End {
    Model(Stop),
    Write(io::Error),
    Signal(Signal),
}

impl Attempt {
    /// Simulates. With a `refinement` the warnings of the run are held; those about its start are told, unless it
    /// `repeats` a run that has told them.
    pub fn run(
        &mut self,
        Script { inputs, from, plan: Plan { begin, rows: [first, last], count } }: Script<'_>,
        mut refinement: Option<&mut Refinement>,
        keeper: &Keeper,
        repeats: bool,
    ) -> Result<(), End> {
        let Self { simulation, results, ranges, rows, film, held } = self;
        let holds = refinement.is_some();
        let bar = bar(count);
        let mut record = |row: u64, time: f64, simulation: &mut Simulation| {
            if let Some(refinement) = &mut refinement {
                refinement.look(simulation);
            }
            locked(rows).push(time, &results.record(time, simulation)).map_err(End::Write)?;
            results.include_between(|reference| simulation.extremes_between_rows(reference));
            // The row first: of equal values it is the one that is told.
            ranges.include(time, simulation.results());
            ranges.include_between(simulation.between_rows());
            simulation.begin_row();
            film.iter_mut().for_each(|film| film.look(row, simulation));
            Ok(())
        };
        simulation.look_at_all_steps();
        // The bar appears with the first row.
        if let Some(inputs) = inputs {
            inputs.start(simulation, begin).map_err(|failure| End::Model(failed(simulation, &failure)))?;
        }
        match from {
            Some(beginning) => stages::start(simulation, beginning).map_err(End::Model)?,
            None if repeats => {
                simulation.initialize(begin).map_err(|failure| End::Model(failed(simulation, &failure)))?;
                simulation.take_warnings();
            }
            None => start(simulation).map_err(End::Model)?,
        }
        record(0, begin, simulation)?;
        let outcome = (first..=last).try_for_each(|row| {
            keeper.signal().map_or(Ok(()), |signal| Err(End::Signal(signal)))?;
            let time = rows::time(simulation.about(), row, last);
            let advanced = match inputs {
                Some(inputs) => inputs.advance(simulation, time),
                None => simulation.advance(time),
            };
            for warning in simulation.take_warnings() {
                if holds {
                    held.push(warning);
                } else {
                    bar.suspend(|| complain(&format!("warning: {warning}")));
                }
            }
            advanced.map_err(|failure| End::Model(failed(simulation, &failure)))?;
            record(row - first + 1, time, simulation)?;
            bar.set_message(format!("t = {time:.4} s"));
            bar.inc(1);
            Ok(())
        });
        bar.finish_and_clear();
        outcome
    }

    /// Concludes a run that has come to its end; this may wait for its comparison run. The warnings are held.
    pub fn conclude(&mut self) {
        self.simulation.conclude();
        self.held.append(&mut self.simulation.take_warnings());
    }

    /// Tells the warnings that are held.
    pub fn tell(&mut self) {
        self.held.drain(..).for_each(|warning| complain(&format!("warning: {warning}")));
    }

    /// Repeats a run that has come to its end until `refinement` is content; the last complete run is here then. The
    /// rows of a run that goes on are in `folder`.
    ///
    /// # Errors
    /// A signal came, or rows cannot be written; the last complete run is here all the same.
    pub fn repeat(
        &mut self,
        script: Script<'_>,
        refinement: &mut Refinement,
        folder: &Folder,
        keeper: &Keeper,
    ) -> Result<(), End> {
        self.conclude();
        while let Some(simulation) = refinement.judge(&self.simulation) {
            match self.replace(*simulation, script, refinement, (folder, keeper))? {
                Ok(()) => self.conclude(),
                Err((_, stop)) => refinement.fail(stop.reason()),
            }
        }
        self.held.extend(refinement.outcome(&self.simulation).warning());
        Ok(())
    }

    /// Begins anew on finer meshes where the first run has failed with `failure` on a mesh of the program; where all
    /// fail, the first one stays.
    ///
    /// # Errors
    /// All fail, or as of [`Self::repeat`].
    pub fn rescue(
        &mut self,
        failure: Stop,
        script: Script<'_>,
        refinement: &mut Refinement,
        (folder, keeper): (&Folder, &Keeper),
    ) -> Result<(), End> {
        let mut next = refinement.rescue(&self.simulation);
        while let Some(simulation) = next {
            match self.replace(*simulation, script, refinement, (folder, keeper))? {
                Ok(()) => {
                    let elements = self.simulation.elements();
                    let reason = failure.reason();
                    let reason = reason.split(": ").next().unwrap_or_default();
                    let told = format!("the run failed with fewer elements ({reason}), and began anew with {elements}");
                    return say(&told).map_err(End::Model);
                }
                Err((failed, _)) => next = refinement.rescue(&failed),
            }
        }
        Err(End::Model(failure))
    }

    /// Runs `simulation`, and takes its place where that comes to its end; else what has failed, and why.
    fn replace(
        &mut self,
        simulation: Simulation,
        script: Script<'_>,
        refinement: &mut Refinement,
        (folder, keeper): (&Folder, &Keeper),
    ) -> Result<Result<(), (Simulation, Stop)>, End> {
        let mut results = Results::new(simulation.variables(), script.plan.count);
        if self.results.is_kept() {
            results.keep();
        }
        let (film, ranges) =
            (self.film.as_ref().map(|_| Film::new(&simulation, script.plan.count)), simulation.ranges());
        let rows = Rows::shared(folder.file(NEXT));
        let mut next = Self { simulation, results, ranges, rows, film, held: Vec::new() };
        locked(&self.rows).finish().map_err(End::Write)?;
        let outcome = next.run(script, Some(refinement), keeper, true);
        let finished = locked(&next.rows).finish();
        if let Err(end) = outcome {
            // It may have no row.
            let _ = fs::remove_file(folder.file(NEXT));
            return match end {
                End::Model(stop) => Ok(Err((next.simulation, stop))),
                end => Err(end),
            };
        }
        finished.map_err(End::Write)?;
        let own = locked(&self.rows).path.clone();
        fs::rename(folder.file(NEXT), &own).map_err(End::Write)?;
        locked(&next.rows).path = own;
        *self = next;
        Ok(Ok(()))
    }
}

impl End {
    /// The message, with the place of the rows so far.
    pub fn stop(self, rows: &Rows) -> Stop {
        let kept = rows.reached.map_or(String::new(), |reached| format!("\n{}", kept(reached, rows)));
        match self {
            Self::Model(Stop::Failed(message)) => Stop::Failed(format!("{message}{kept}")),
            Self::Model(stop) => stop,
            Self::Write(reason) => trouble(&rows.path, &reason),
            Self::Signal(signal) => {
                Stop::Interrupted(format!("error: {}{kept}", interrupted(signal)), signal.exit_code())
            }
        }
    }
}
