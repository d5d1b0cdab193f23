//! A simulation, its variables, steps and saved states.

use crate::campbell::FoundCampbell;
use crate::linear::LinearSystem;
use crate::models::{self, FoundModes};
use crate::refusal::{located, refusal};
use crate::run::{self, Outcome};
use ancf14::error::decimal;
use ancf14::fmi::{Model, Value};
use ancf14::model::campbell::Sweep;
use ancf14::model::entries::simulation::{Analysis, Initial};
use ancf14::model::reduced::{Method, Size};
use ancf14::model::refinement::{is_repeated, leaves_mesh};
use ancf14::model::rows;
use ancf14::model::simulation::Halt;
use ancf14::model::steady::Spin;
use ancf14::{Error, Kind, Reach};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;

/// A model that runs.
#[pyclass]
pub struct Simulation {
    /// None: a run has taken it.
    simulation: Option<ancf14::Simulation>,
    /// Halts the comparison run, if there is one.
    halt: Halt,
}

/// A variable: name, unit, description, kind, value, bounds, whether it is a whole number. Outputs have no value before
/// the simulation is initialized.
type Row = (String, String, String, &'static str, Option<f64>, (Option<f64>, Option<f64>), bool);

#[pymethods]
impl Simulation {
    #[new]
    fn new(
        py: Python<'_>,
        name: &str,
        text: &str,
        overrides: Vec<(String, String)>,
        folder: Option<PathBuf>,
        allow_outside: bool,
    ) -> PyResult<Self> {
        let overrides: Vec<(&str, &str)> =
            overrides.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
        let reach = if allow_outside { Reach::Anywhere } else { Reach::Inside };
        let simulation = py.detach(|| match &folder {
            Some(folder) => ancf14::Simulation::from_text_in(folder, reach, name, text, &overrides),
            None => ancf14::Simulation::from_text_with(name, text, &overrides),
        });
        Ok(Self { simulation: Some(simulation.map_err(|error| refusal(&error))?), halt: Halt::default() })
    }

    /// The name of the model.
    fn name(&self) -> PyResult<String> {
        Ok(self.get()?.name().to_owned())
    }

    fn variables(&self) -> PyResult<Vec<Row>> {
        let simulation = self.get()?;
        let row = |variable: ancf14::Variable<'_>| {
            let kind = match variable.kind {
                Kind::Parameter => "parameter",
                Kind::Tunable => "tunable",
                Kind::Calculated => "calculated",
                Kind::Input => "input",
                Kind::Output => "output",
            };
            let [least, most] = variable.bounds;
            let is_whole = matches!(simulation.model().variables()[variable.id.index()].start, Value::Integer(_));
            let [name, unit, description] = [variable.name, variable.unit, variable.description].map(str::to_owned);
            (name, unit, description, kind, simulation.value_of(variable.id).ok(), (least, most), is_whole)
        };
        Ok(simulation.variables().map(row).collect())
    }

    /// The times of the rows of a whole run, s, as the rows have them: functions of inputs are called with these.
    fn times(&self) -> PyResult<Vec<f64>> {
        let simulation = self.get()?;
        let about = simulation.model().about();
        let rows = simulation.stop_time() / simulation.output_step();
        let last = rows::last(about).ok_or(Error::TooManyRows { rows }).map_err(|error| refusal(&error))?;
        Ok((0..=last).map(|row| decimal(rows::time(about, row, last))).collect())
    }

    fn value(&self, name: &str) -> PyResult<f64> {
        self.get()?.value(name).map_err(|error| refusal(&error))
    }

    fn set(&mut self, name: &str, value: f64) -> PyResult<()> {
        self.get_mut()?.set(name, value).map_err(|error| refusal(&error))
    }

    fn initialize(&mut self, py: Python<'_>) -> PyResult<()> {
        let simulation = self.get_mut()?;
        py.detach(|| simulation.initialize()).map_err(|error| located(simulation, &error))
    }

    fn advance(&mut self, py: Python<'_>, time: f64) -> PyResult<()> {
        let simulation = self.get_mut()?;
        py.detach(|| simulation.advance(time)).map_err(|error| located(simulation, &error))
    }

    fn finish(&mut self) -> PyResult<()> {
        self.get_mut()?.finish().map_err(|error| refusal(&error))
    }

    fn reset(&mut self) -> PyResult<()> {
        self.get_mut()?.reset().map_err(|error| refusal(&error))
    }

    /// The time reached, s.
    fn time(&self) -> PyResult<f64> {
        Ok(self.get()?.time())
    }

    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let simulation = self.get()?;
        let bytes = simulation.save().and_then(|state| simulation.write_state(&state));
        Ok(PyBytes::new(py, &bytes.map_err(|error| refusal(&error))?))
    }

    fn restore(&mut self, bytes: &[u8]) -> PyResult<()> {
        let simulation = self.get_mut()?;
        let state = simulation.read_state(bytes).map_err(|error| refusal(&error))?;
        simulation.restore(&state).map_err(|error| refusal(&error))
    }

    fn take_warnings(&mut self) -> PyResult<Vec<String>> {
        Ok(self.get_mut()?.take_warnings())
    }

    /// The lowest natural modes about the state that is reached.
    fn modes(&self, py: Python<'_>, count: usize) -> PyResult<FoundModes> {
        let simulation = self.get()?;
        let found = py.detach(|| simulation.modes(count)).map_err(|error| located(simulation, &error))?;
        Ok(models::modes(&found))
    }

    /// Whether the simulation begins at an equilibrium.
    fn begins_at_equilibrium(&self) -> PyResult<bool> {
        let settings = &self.get()?.model().document().simulation;
        Ok(settings.analysis == Analysis::Static || settings.initial == Initial::Equilibrium)
    }

    /// The linear system about the state that is reached.
    fn linearize(
        &self,
        py: Python<'_>,
        inputs: Option<Vec<String>>,
        outputs: Option<Vec<String>>,
        steady: Option<(String, f64, bool)>,
    ) -> PyResult<LinearSystem> {
        let simulation = self.get()?;
        let found = py.detach(|| {
            let linear = match steady {
                None => simulation.linearize(inputs.as_deref(), outputs.as_deref()),
                Some((drive, speed, is_weightless)) => {
                    let spin = Spin { drive, speed, is_weightless };
                    let found = simulation.model().linearize_steady(&spin, inputs.as_deref(), outputs.as_deref());
                    found.map_err(|failure| Error::Failed { reason: failure.message })
                }
            }?;
            let poles = linear.poles(simulation.model()).map_err(|failure| failure.message);
            Ok((linear, poles))
        });
        let (linear, poles) = found.map_err(|error| located(simulation, &error))?;
        Ok(LinearSystem::new(linear, poles, simulation.model().about().name.clone()))
    }

    /// `system` with fewer states: by the `error`, else by their number.
    fn reduce(
        &self,
        py: Python<'_>,
        system: &LinearSystem,
        error: Option<f64>,
        order: usize,
        method: &str,
    ) -> PyResult<LinearSystem> {
        let simulation = self.get()?;
        let size = error.map_or(Size::Order(order), Size::Error);
        let method = match method {
            "modal" => Method::Modal,
            "craig-bampton" => Method::CraigBampton,
            _ => Method::Balanced,
        };
        let found = py.detach(|| system.reduced(simulation.model(), size, method));
        found.map_err(|reason| located(simulation, &Error::Failed { reason }))
    }

    /// The vibrations by the speed of a drive.
    fn campbell(
        &self,
        py: Python<'_>,
        drive: String,
        speeds: Vec<f64>,
        count: usize,
        is_weightless: bool,
    ) -> PyResult<FoundCampbell> {
        let simulation = self.get()?;
        let sweep = Sweep { drive, speeds, is_weightless, count };
        let found = py.detach(|| simulation.model().refined_campbell(&sweep));
        let found = found.map_err(|failure| Error::Failed { reason: failure.message });
        let found = found.map_err(|error| located(simulation, &error))?;
        Ok(FoundCampbell::new(found, simulation.model().about().name.clone()))
    }

    /// The drawing of the mechanism, SVG.
    fn drawing(&self) -> PyResult<String> {
        Ok(models::drawing(self.get()?.model()))
    }

    /// The bytes of an FMU of the model.
    fn pack<'py>(&self, py: Python<'py>, library: PathBuf, fmi: u8) -> PyResult<Bound<'py, PyBytes>> {
        let model = self.get()?.model();
        let bytes = py.detach(|| models::fmu(model, None, library, fmi)).map_err(PyRuntimeError::new_err)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// The bytes of an FMU of a linear system of the model, and warnings.
    fn pack_linear<'py>(
        &self,
        py: Python<'py>,
        system: &LinearSystem,
        library: PathBuf,
        fmi: u8,
    ) -> PyResult<(Bound<'py, PyBytes>, Vec<String>)> {
        let model = self.get()?.model();
        let fmu = || {
            let (small, warning) = system.small(model)?;
            Ok((models::fmu(model, Some(&small), library, fmi)?, Vec::from_iter(warning)))
        };
        let (bytes, warnings) = py.detach(fmu).map_err(PyRuntimeError::new_err::<String>)?;
        Ok((PyBytes::new(py, &bytes), warnings))
    }

    /// Whether the file leaves the steps or the elements of a beam to the program, so that a run is repeated.
    fn is_repeated(&self) -> PyResult<bool> {
        Ok(is_repeated(self.get()?.model().document()))
    }

    /// Whether the file leaves the elements of a beam to the program.
    fn leaves_mesh(&self) -> PyResult<bool> {
        Ok(leaves_mesh(self.get()?.model().document()))
    }

    /// Warns of the errors of these results only.
    fn judge_only(&mut self, names: Vec<String>) -> PyResult<()> {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        self.get_mut()?.judge_only(&names).map_err(|error| refusal(&error))
    }

    /// Asks for the mesh error of motions, which a run tells at its end.
    fn ask_for_mesh_error(&mut self) -> PyResult<()> {
        self.halt = self.get_mut()?.ask_for_mesh_error(ancf14_cli::background::start);
        Ok(())
    }

    /// Runs to the row `last`, or to the end, and takes the simulation away. The inputs called `names` have the values
    /// `inputs` from row to row: all of the first row, then all of the second one. With `film` there is a page that
    /// shows the mechanism move. `refinement` says whether the run is repeated with finer steps and meshes until it is
    /// accurate (none: if the file leaves the elements of a beam to the program), and what that may cost.
    #[pyo3(signature = (names, inputs, film=false, last=None, refinement=(Some(false), None)))]
    fn run(
        &mut self,
        py: Python<'_>,
        names: Vec<String>,
        inputs: Vec<f64>,
        film: bool,
        last: Option<u64>,
        refinement: (Option<bool>, Option<f64>),
    ) -> PyResult<Outcome> {
        let simulation = self.simulation.take().ok_or_else(taken)?;
        run::run(py, (simulation, &self.halt), &names, inputs, (film, last), refinement)
    }
}

impl Simulation {
    fn get(&self) -> PyResult<&ancf14::Simulation> {
        self.simulation.as_ref().ok_or_else(taken)
    }

    fn get_mut(&mut self) -> PyResult<&mut ancf14::Simulation> {
        self.simulation.as_mut().ok_or_else(taken)
    }
}

fn taken() -> PyErr {
    PyRuntimeError::new_err("a run has taken this simulation; load the model again")
}
