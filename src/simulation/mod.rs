//! The front door for programs: a model file that runs, with names for its variables and typed errors.
//!
//! [`Simulation`] is an [`Instance`] of a model, the same that a host of an FMU holds: what may be set when, and within
//! which range, is decided there. The functions in C of `src/ffi/front.rs` stand on this type.

mod error;
mod refine;
mod results;
mod variable;

use std::{fmt, path::Path};

pub use self::{
    error::Error,
    results::Results,
    variable::{Kind, Variable, VariableId},
};
use crate::fmi::instance::{FmuState, Instance};
use crate::fmi::lifecycle::{Call, Mode};
use crate::fmi::variable::Variable as Row;
use crate::fmi::{About, Model, Value};
use crate::model::file::{Folder, Reach};
use crate::model::linear::Linear;
use crate::model::modes::Modes;
use crate::model::simulation::{Halt, Placement};
use crate::model::{self, effort, file, names, notes};
use crate::packed::Packed;

/// A model file that runs: load it, set parameters, initialize, advance, read results. All numbers are in SI units and
/// radians.
///
/// A failed call leaves the values as they were. After a failed step, a saved state or [`Self::reset`] goes on.
pub struct Simulation {
    instance: Instance<Packed>,
    /// What is to be told besides what the instance has logged.
    warnings: Vec<String>,
    /// Rows of results so far, the start included.
    rows: u64,
}

/// A state of a simulation to go back to: [`Simulation::save`].
pub struct SavedState(FmuState<Packed>);

impl fmt::Debug for Simulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("name", &self.about().name)
            .field("time", &self.time())
            .finish_non_exhaustive()
    }
}

impl fmt::Debug for SavedState {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SavedState").finish_non_exhaustive()
    }
}

impl Simulation {
    /// Loads the model file at `path`.
    ///
    /// # Errors
    /// The file cannot be read, or everything that is wrong with it, each mistake with its place.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::open_with(path, &[])
    }

    /// Loads the model file at `path` with changed numbers or words, as by `--set` of the command line:
    /// `&[("arm.elements", "16"), ("arm.strain", "small")]`.
    ///
    /// # Errors
    /// As [`Self::open`], or an override is wrong.
    pub fn open_with(path: impl AsRef<Path>, overrides: &[(&str, &str)]) -> Result<Self, Error> {
        Self::open_reaching(path, Reach::Inside, overrides)
    }

    /// Loads the model file at `path`, as [`Self::open_with`] does; where `reach` allows it, the model includes files
    /// and reads tables from outside of its folder.
    ///
    /// # Errors
    /// As [`Self::open_with`].
    pub fn open_reaching(path: impl AsRef<Path>, reach: Reach, overrides: &[(&str, &str)]) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = file::text(path).map_err(|reason| Error::Unreadable { reason })?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::from_text_in(folder, reach, &path.display().to_string(), &text, overrides)
    }

    /// Loads a model from its text, as [`Self::from_text_with`] does, which names files in `folder`, and elsewhere
    /// where `reach` allows it.
    ///
    /// # Errors
    /// As [`Self::from_text_with`].
    pub fn from_text_in(
        folder: &Path,
        reach: Reach,
        name: &str,
        text: &str,
        overrides: &[(&str, &str)],
    ) -> Result<Self, Error> {
        Self::load(Some(Folder::new(folder, reach)), name, text, overrides)
    }

    /// Loads a model from its text; `name` is what messages call the file.
    ///
    /// # Errors
    /// Everything that is wrong with the text, each mistake with its place.
    pub fn from_text(name: &str, text: &str) -> Result<Self, Error> {
        Self::from_text_with(name, text, &[])
    }

    /// Loads a model from its text with changed numbers or words, as [`Self::open_with`] does.
    ///
    /// # Errors
    /// As [`Self::from_text`], or an override is wrong.
    pub fn from_text_with(name: &str, text: &str, overrides: &[(&str, &str)]) -> Result<Self, Error> {
        Self::load(None, name, text, overrides)
    }

    fn load(folder: Option<Folder<'_>>, name: &str, text: &str, overrides: &[(&str, &str)]) -> Result<Self, Error> {
        let overrides: Vec<(String, String)> =
            overrides.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
        let mut model = model::simulation::Simulation::load_in(folder, name, text, &overrides)
            .map_err(|failure| Error::Mistakes { mistakes: failure.message, line: failure.line })?;
        model.heed_mesh_error();
        let warnings = notes::notes(model.document());
        Ok(Self::of(model, warnings))
    }

    /// The type of the instance is that of FMUs: the library has its functions once.
    fn of(model: model::simulation::Simulation, warnings: Vec<String>) -> Self {
        Self { instance: Instance::new(Packed::Mechanism(Box::new(model)), false), warnings, rows: 0 }
    }

    /// The name of the model.
    pub fn name(&self) -> &str {
        &self.about().name
    }

    /// The time at which a run ends, by the model file, s.
    pub fn stop_time(&self) -> f64 {
        self.about().stop
    }

    /// The time between two rows of results, by the model file, s.
    pub fn output_step(&self) -> f64 {
        self.about().output_step
    }

    /// All variables: parameters, inputs and outputs.
    pub fn variables(&self) -> impl ExactSizeIterator<Item = Variable<'_>> {
        self.table().iter().enumerate().map(|(index, row)| Variable::new(index, row))
    }

    /// The variable called `name`.
    ///
    /// # Errors
    /// There is none; the nearest name is suggested.
    pub fn find(&self, name: &str) -> Result<VariableId, Error> {
        let table = self.table();
        table.iter().position(|row| row.name == name).map(VariableId).ok_or_else(|| {
            let near = names::nearest(name, table.iter().map(|row| row.name.as_str()));
            let hint = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
            Error::UnknownVariable { name: name.to_owned(), hint }
        })
    }

    /// Variable number `index` of [`Self::variables`].
    ///
    /// # Errors
    /// There are fewer.
    pub fn variable(&self, index: usize) -> Result<Variable<'_>, Error> {
        let table = self.table();
        let row = table.get(index).ok_or(Error::UnknownIndex { index, count: table.len() })?;
        Ok(Variable::new(index, row))
    }

    /// The value of the variable called `name`, in its SI unit.
    ///
    /// # Errors
    /// No variable has this name, or it is an output and the simulation is not initialized.
    pub fn value(&self, name: &str) -> Result<f64, Error> {
        self.value_of(self.find(name)?)
    }

    /// As [`Self::value`], without a search.
    ///
    /// # Errors
    /// The variable is an output, and the simulation is not initialized; or `id` is of another model, which has more
    /// variables.
    pub fn value_of(&self, id: VariableId) -> Result<f64, Error> {
        let kind = self.variable(id.index())?.kind;
        match self.instance.mode() {
            Mode::Instantiated | Mode::Initialization if kind == Kind::Output => Err(Error::NotInitialized),
            Mode::Fatal => Err(Error::Fault { message: String::from("an earlier call failed") }),
            _ => Ok(self.instance.model().value(id.index()).number()),
        }
    }

    /// Sets the variable called `name`, in its SI unit: a parameter before the simulation is initialized, a tunable
    /// parameter or an input at any time. An input keeps its value until it is set again.
    ///
    /// # Errors
    /// No variable has this name, it cannot be set now, or the value is out of its range; the old value stays.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), Error> {
        self.set_value_of(self.find(name)?, value)
    }

    /// As [`Self::set`], without a search.
    ///
    /// # Errors
    /// As [`Self::set`], or `id` is of another model, which has more variables.
    pub fn set_value_of(&mut self, id: VariableId, value: f64) -> Result<(), Error> {
        let Variable { name, .. } = self.variable(id.index())?;
        let outcome = match (self.row(id).start, u32::try_from(id.index())) {
            (_, Err(_)) => return Err(Error::UnknownIndex { index: id.index(), count: self.table().len() }),
            (Value::Real(_), Ok(reference)) => self.instance.set_real(&[reference], &[value]),
            (Value::Integer(_), Ok(reference)) => match whole(value) {
                Some(value) => self.instance.set_integer(&[reference], &[value]),
                None => {
                    let reason = format!("variable {name} is a whole number and cannot be {value}; set a whole number");
                    return Err(Error::Refused { reason });
                }
            },
        };
        outcome.map_err(|error| Error::of_value(error, self.time()))
    }

    /// Builds the mechanism from the parameters as set, and finds its initial state, at t = 0 or at the time of the
    /// state that the model begins with: from here on there are results.
    ///
    /// # Errors
    /// The parameters do not make a mechanism, or it has no initial state: other values can be tried. Or it is
    /// initialized already.
    pub fn initialize(&mut self) -> Result<(), Error> {
        let entered = match self.instance.mode() {
            Mode::Initialization => Ok(()), // the last attempt has failed
            _ => self.instance.enter_initialization_mode(),
        };
        entered
            .and_then(|()| self.instance.exit_initialization_mode())
            .map_err(|error| Error::of(error, self.time()))?;
        self.rows = 1;
        Ok(())
    }

    /// Asks for the mesh error of motions, before [`Self::initialize`]: the model runs once more beside this run, with
    /// half the elements. `placement` says where, for instance on a thread. [`Self::finish`] waits for it, and warns
    /// where the mesh is too coarse. Results do not change. [`Self::restore`], and parameters that are set during the
    /// run, leave the error unknown. `mesh_error = true` in the model file asks for it within each step of this run.
    /// The answer halts the run beside, from any thread, where nobody waits for the error any more.
    pub fn ask_for_mesh_error(&mut self, placement: Placement) -> Halt {
        self.mechanism_mut().ask_for_mesh_error(placement)
    }

    /// Restricts the warnings about errors of the steps and the mesh, which [`Self::finish`] gives, to these results:
    /// `tip.position`, or a component of it.
    ///
    /// # Errors
    /// There is no such result; the nearest name is suggested.
    pub fn judge_only(&mut self, names: &[&str]) -> Result<(), Error> {
        for name in names {
            let is_known = self.table().iter().any(|row| row.name.split('[').next() == name.split('[').next());
            if !is_known {
                self.find(name)?;
            }
        }
        self.mechanism_mut().judge_only(names);
        Ok(())
    }

    /// Advances to `time`, s. The internal steps are those of the model file: where `time` is a multiple of
    /// `simulation.step`, results have the bits of `ancf14 run`.
    ///
    /// # Errors
    /// The simulation is not initialized, `time` is before the time reached or not finite, or a step cannot be
    /// computed.
    pub fn advance(&mut self, time: f64) -> Result<(), Error> {
        let from = self.time();
        if self.instance.mode() == Mode::Step && !(time.is_finite() && time >= from) {
            return Err(Error::Time { from, to: time });
        }
        self.instance.advance(time).map_err(|error| Error::of(error, from))?;
        self.rows += 1;
        Ok(())
    }

    /// The time reached, s.
    pub fn time(&self) -> f64 {
        self.instance.time()
    }

    /// Ends the run, so that [`Self::take_warnings`] has those about the run as a whole: how far results are off
    /// because of the length of the steps, and of the mesh. Values can still be read.
    ///
    /// # Errors
    /// The simulation is not initialized, or the run has ended already.
    pub fn finish(&mut self) -> Result<(), Error> {
        self.instance.terminate().map_err(|error| Error::of(error, self.time()))?;
        let model = self.model();
        let statistics = &model.state().statistics;
        let duration = self.time() - model.about().start;
        self.warnings.extend(effort::rejections(model.document(), statistics, duration, self.rows));
        Ok(())
    }

    /// Goes back to the model as it was loaded, parameters and inputs included.
    ///
    /// # Errors
    /// An internal fault has happened.
    pub fn reset(&mut self) -> Result<(), Error> {
        self.instance.reset().map_err(|error| Error::of(error, self.time()))
    }

    /// A copy of all that changes: parameters, inputs, time and motion.
    ///
    /// # Errors
    /// An internal fault has happened.
    pub fn save(&self) -> Result<SavedState, Error> {
        self.instance.state().map(SavedState).map_err(|error| Error::of(error, self.time()))
    }

    /// Goes back to a copy, also after a failed step: what follows has the same bits each time.
    ///
    /// # Errors
    /// The copy is of another model, or an internal fault has happened.
    pub fn restore(&mut self, state: &SavedState) -> Result<(), Error> {
        self.instance.set_state(&state.0).map_err(|error| Error::of(error, self.time()))
    }

    /// The bytes of a copy, which [`Self::read_state`] of any process reads.
    ///
    /// # Errors
    /// An internal fault has happened.
    pub fn write_state(&self, state: &SavedState) -> Result<Vec<u8>, Error> {
        let bytes = self.instance.serialize(Call::SerializeFMUstate, &state.0);
        bytes.map_err(|error| Error::of(error, self.time()))
    }

    /// The copy that [`Self::write_state`] wrote, in this process or another.
    ///
    /// # Errors
    /// The bytes are damaged, or of another model or version, or an internal fault has happened.
    pub fn read_state(&self, bytes: &[u8]) -> Result<SavedState, Error> {
        self.instance.deserialize(bytes).map(SavedState).map_err(|error| Error::of(error, self.time()))
    }

    /// The model behind the variables: what drawings, pages and FMU files are made from.
    pub fn model(&self) -> &model::simulation::Simulation {
        match self.instance.model() {
            Packed::Mechanism(model) => model,
            Packed::Linear(_) => unreachable!("a simulation is of a mechanism"),
        }
    }

    fn mechanism_mut(&mut self) -> &mut model::simulation::Simulation {
        match self.instance.model_mut() {
            Packed::Mechanism(model) => model,
            Packed::Linear(_) => unreachable!("a simulation is of a mechanism"),
        }
    }

    /// Natural frequencies and shapes about the state that is reached: the `count` lowest ones. About the start or an
    /// equilibrium, the elements that the file leaves to the program are so many that frequencies are right to 0.5 %,
    /// and the shapes are those of that mesh; given ones are warned of where they are too few for that.
    ///
    /// # Errors
    /// The simulation is not initialized, or the modes are not found.
    pub fn modes(&self, count: usize) -> Result<Modes, Error> {
        match self.is_initialized() {
            true => {
                let found = self.model().refined_modes(count);
                found.map(|found| found.modes).map_err(|failure| Error::Failed { reason: failure.message })
            }
            false => Err(Error::NotInitialized),
        }
    }

    /// The linear system about the state that is reached: exact matrices from `inputs` to `outputs`, each by its name
    /// or by that of a vector; none: all inputs of the model, all quantities of its outputs.
    ///
    /// # Errors
    /// The simulation is not initialized, a name is not known, or nothing can move.
    pub fn linearize(&self, inputs: Option<&[String]>, outputs: Option<&[String]>) -> Result<Linear, Error> {
        match self.is_initialized() {
            true => {
                self.model().linearize(inputs, outputs).map_err(|failure| Error::Failed { reason: failure.message })
            }
            false => Err(Error::NotInitialized),
        }
    }

    /// The warnings since the last call of this function, a sentence each: of legal models that are hardly ever meant,
    /// of results that should not be trusted.
    pub fn take_warnings(&mut self) -> Vec<String> {
        let told = self.instance.take_entries().into_iter().map(|entry| entry.message);
        self.warnings.drain(..).chain(told).collect()
    }

    /// Whether there are results.
    pub fn is_initialized(&self) -> bool {
        !matches!(self.instance.mode(), Mode::Instantiated | Mode::Initialization)
    }

    /// Makes the simulation unusable, after a caught panic.
    pub(crate) fn give_up(&mut self) {
        self.instance.give_up();
    }

    fn about(&self) -> &About {
        self.instance.model().about()
    }

    fn table(&self) -> &[Row] {
        self.instance.model().variables()
    }

    /// The row of a variable of this model.
    fn row(&self, id: VariableId) -> &Row {
        &self.table()[id.index()]
    }

    fn outputs(&self) -> Vec<VariableId> {
        self.variables().filter(|variable| variable.kind == Kind::Output).map(|variable| variable.id).collect()
    }
}

/// The whole number that `value` is; none: it is not one, or too large for a count.
fn whole(value: f64) -> Option<i32> {
    let number = value as i32;
    (f64::from(number) == value).then_some(number)
}
