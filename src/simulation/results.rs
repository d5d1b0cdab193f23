//! The results of a whole run, column by column.

use super::{Error, Simulation, VariableId};
use crate::model::rows;

/// A table of results: one row every `simulation.output_step` of the model file, the first at the start, the last at
/// the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Results {
    time: Vec<f64>,
    columns: Vec<(String, Vec<f64>)>,
}

impl Results {
    /// The times of the rows, s.
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// The values of a variable that was asked for, a row each; none: it was not.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|(own, _)| own == name).map(|(_, values)| values.as_slice())
    }

    /// All columns with their names, in the order in which they were asked for.
    pub fn columns(&self) -> impl Iterator<Item = (&str, &[f64])> {
        self.columns.iter().map(|(name, values)| (name.as_str(), values.as_slice()))
    }
}

impl Simulation {
    /// Runs to the stop time of the model file, from the time that is reached, as `ancf14 run` does; initializes first,
    /// if that has not been done. Calls `each` at the start, and after every `simulation.output_step`: to read results,
    /// to set inputs.
    ///
    /// # Errors
    /// The first one of the run or of `each`, which ends the run.
    pub fn run(&mut self, mut each: impl FnMut(&mut Self) -> Result<(), Error>) -> Result<(), Error> {
        self.run_while(|simulation| each(simulation).map(|()| true))
    }

    /// Runs as [`Self::run`] does, while `each` answers true. A run that is stopped early is not finished: it can go
    /// on.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub fn run_while(&mut self, mut each: impl FnMut(&mut Self) -> Result<bool, Error>) -> Result<(), Error> {
        let [stop, step] = [self.stop_time(), self.output_step()];
        let last = rows::last(self.about()).ok_or(Error::TooManyRows { rows: stop / step })?;
        if !self.is_initialized() {
            self.initialize()?;
        }
        if !each(self)? {
            return Ok(());
        }
        for row in 1..=last {
            let time = rows::time(self.about(), row, last);
            if time > self.time() {
                self.advance(time)?;
                if !each(self)? {
                    return Ok(());
                }
            }
        }
        self.finish()
    }

    /// Runs as [`Self::run`] does, and gathers the variables called `names`; all outputs, if `names` is empty.
    ///
    /// # Errors
    /// As [`Self::run`], or a name is unknown.
    pub fn record(&mut self, names: &[&str]) -> Result<Results, Error> {
        let ids: Vec<VariableId> = match names {
            [] => self.outputs(),
            names => names.iter().map(|name| self.find(name)).collect::<Result<_, _>>()?,
        };
        let name = |id: &VariableId| self.row(*id).name.clone();
        let mut columns: Vec<(String, Vec<f64>)> = ids.iter().map(|id| (name(id), Vec::new())).collect();
        let mut time = Vec::new();
        self.run(|simulation| {
            time.push(simulation.time());
            for (id, (_, values)) in ids.iter().zip(&mut columns) {
                values.push(simulation.value_of(*id)?);
            }
            Ok(())
        })?;
        Ok(Results { time, columns })
    }
}
