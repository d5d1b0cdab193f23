//! What the page asks for, and what it is told of a model.

use ancf14::fmi::variable::{Causality, Variable};
use ancf14::fmi::{About, Failure, Model, Value};
use ancf14::model::document::Document;
use ancf14::model::simulation::Simulation;
use ancf14::model::{builder, rows};
use serde::{Deserialize, Serialize};

/// A model and its settings.
#[derive(Clone, Debug, Deserialize)]
pub struct Request {
    /// The model file as messages call it.
    pub file: String,
    /// Its text, without copies and includes.
    pub text: String,
    /// Keys and values of `--set`.
    pub overrides: Vec<(String, String)>,
    /// How many natural modes about the initial state the page shows.
    pub modes: Option<u16>,
}

/// A model that can be simulated, as the page is told of it.
#[derive(Debug, Serialize)]
pub struct Description {
    /// Number of the last row of results.
    rows: u64,
    /// Everything that can be set.
    controls: Vec<Control>,
}

/// A number that can be set.
#[derive(Debug, Serialize)]
struct Control {
    name: String,
    unit: String,
    meaning: String,
    value: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max: Option<f64>,
    integer: bool,
}

impl Request {
    /// Reads a request.
    ///
    /// # Errors
    /// It is none.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        serde_json::from_slice(bytes)
            .map_err(|reason| format!("error: the request of the page cannot be read: {reason}"))
    }

    /// Reads and builds the model.
    ///
    /// # Errors
    /// Everything that is wrong with it, as text with the lines underlined.
    pub fn load(&self) -> Result<(Simulation, u64), String> {
        let Self { file, text, overrides, .. } = self;
        let simulation = Simulation::load(file, text, overrides).map_err(|Failure { message, .. }| {
            let mistakes = Document::parse_in(None, file, text, overrides)
                .and_then(|document| builder::build(&document, 0.0).map(drop))
                .err();
            mistakes.map_or(message, |mistakes| mistakes.to_string())
        })?;
        let About { stop, output_step, .. } = simulation.about();
        let last = rows::last(simulation.about()).ok_or_else(|| {
            let (wanted, most) = (stop / output_step, rows::MOST);
            format!(
                "error: the run would have {wanted:.1e} rows of results, at most {most:.0e} are possible; give a larger simulation.output_step"
            )
        })?;
        Ok((simulation, last))
    }
}

impl Description {
    /// Of a simulation with rows 0 to `rows`.
    pub fn new(simulation: &Simulation, rows: u64) -> Self {
        let variables = simulation.variables().iter();
        let settable =
            variables.filter(|variable| matches!(variable.causality, Causality::Parameter | Causality::Input));
        let mut controls: Vec<Control> = settable.map(control).collect();
        // The end of a run belongs to the host of an FMU; here it is set like every other number.
        controls.push(Control {
            name: String::from(STOP),
            unit: String::from("s"),
            meaning: String::from("End of the run"),
            value: simulation.about().stop,
            min: Some(0.0),
            max: None,
            integer: false,
        });
        Self { rows, controls }
    }
}

/// The key of the end of a run.
const STOP: &str = "simulation.stop";

fn control(variable: &Variable) -> Control {
    let (value, integer) = match variable.start {
        Value::Real(value) => (value, false),
        Value::Integer(value) => (f64::from(value), true),
    };
    Control {
        name: variable.name.clone(),
        unit: variable.quantity.unit.clone(),
        meaning: variable.description.clone(),
        value,
        min: variable.min,
        max: variable.max,
        integer,
    }
}
