//! A stand-in for the simulation: one mass on a spring, so that the FMI half can be built and tested end to end.

use crate::fmi::{
    About, Failure, LogCategory, Model, Value,
    variable::{Causality, Quantity, Variability, Variable},
};

/// A mass on a spring, pulled by a force.
#[derive(Clone, Debug)]
pub struct Simulation {
    about: About,
    variables: Vec<Variable>,
    values: [f64; 5],
    state: State,
}

/// What changes in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    start: f64,
    time: f64,
    position: f64,
    velocity: f64,
    steps: i32,
    initialized: bool,
}

/// Places in the variable table.
const YOUNG: usize = 0;
const GRAVITY: usize = 1;
const STEP: usize = 2;
const FORCE: usize = 3;
const HALF_YOUNG: usize = 4;
const POSITION: usize = 5;
const VELOCITY: usize = 6;
const STEPS: usize = 7;
const TIME: usize = 8;

fn row(name: &str, causality: Causality, variability: Variability, start: Value, quantity: Quantity) -> Variable {
    Variable {
        name: name.to_owned(),
        description: format!("Stand-in: {name}"),
        causality,
        variability,
        start,
        min: None,
        max: None,
        quantity,
        display_unit: None,
    }
}

impl Simulation {
    /// Reads the model file.
    ///
    /// # Errors
    /// It is no TOML, or has no parameter `young`.
    pub fn load(file_name: &str, text: &str, overrides: &[(String, String)]) -> Result<Self, Failure> {
        let failure = |message| Failure { message, category: LogCategory::StatusError };
        let table: toml::Table = text.parse().map_err(|e| failure(format!("{file_name}: {e}")))?;
        let young = table
            .get("parameters")
            .and_then(|parameters| parameters.get("young")?.as_float())
            .ok_or_else(|| failure(format!("{file_name}: parameters.young is missing")))?;
        let name = table.get("model").and_then(|model| model.get("name")?.as_str()).unwrap_or("Oscillator").to_owned();
        let mut variables = vec![
            row("young", Causality::Parameter, Variability::Fixed, Value::Real(young), Quantity::new("", "")),
            row(
                "gravity[3]",
                Causality::Parameter,
                Variability::Tunable,
                Value::Real(-9.81),
                Quantity::new("Acceleration", "m/s2"),
            ),
            row(
                "simulation.step",
                Causality::Parameter,
                Variability::Fixed,
                Value::Real(1e-3),
                Quantity::new("Time", "s"),
            ),
            row(
                "tip.force[3]",
                Causality::Input,
                Variability::Continuous,
                Value::Real(0.0),
                Quantity::new("Force", "N"),
            ),
            row(
                "half_young",
                Causality::CalculatedParameter,
                Variability::Fixed,
                Value::Real(0.0),
                Quantity::new("", ""),
            ),
            row(
                "P.position[3]",
                Causality::Output,
                Variability::Continuous,
                Value::Real(0.1),
                Quantity::new("Position", "m"),
            ),
            row(
                "P.velocity[3]",
                Causality::Output,
                Variability::Continuous,
                Value::Real(0.0),
                Quantity::new("Velocity", "m/s"),
            ),
            row("statistics.steps", Causality::Output, Variability::Discrete, Value::Integer(0), Quantity::new("", "")),
            row("time", Causality::Independent, Variability::Continuous, Value::Real(0.0), Quantity::new("Time", "s")),
        ];
        variables[YOUNG].min = Some(0.0);
        variables[STEP].min = Some(1e-9);
        variables[POSITION].display_unit = Some("mm".to_owned());
        let guid = uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_OID, text.as_bytes());
        let about = About {
            identifier: name.clone(),
            name,
            description: "A mass on a spring, a stand-in for the beams".to_owned(),
            guid: format!("{{{guid}}}"),
            stop: 0.1,
            output_step: 0.01,
        };
        let mut simulation = Self { about, variables, values: [0.0; 5], state: State::default() };
        simulation.reset();
        for (key, value) in overrides {
            let place = simulation.variables.iter().position(|variable| variable.name == *key);
            let number = value.parse().map_err(|e| failure(format!("{key} = {value}: {e}")))?;
            simulation.set_value(place.ok_or_else(|| failure(format!("no key {key}")))?, Value::Real(number))?;
        }
        Ok(simulation)
    }
}

impl Model for Simulation {
    type Snapshot = (State, [f64; 5]);

    fn about(&self) -> &About {
        &self.about
    }

    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn value(&self, reference: usize) -> Value {
        match reference {
            HALF_YOUNG => Value::Real(self.values[YOUNG] / 2.0),
            POSITION => Value::Real(self.state.position),
            VELOCITY => Value::Real(self.state.velocity),
            STEPS => Value::Integer(self.state.steps),
            TIME => Value::Real(self.state.time),
            place => Value::Real(self.values[place]),
        }
    }

    fn set_value(&mut self, reference: usize, value: Value) -> Result<(), Failure> {
        self.values[reference] = value.number();
        Ok(())
    }

    fn initialize(&mut self, start: f64) -> Result<(), Failure> {
        self.state = State { start, time: start, position: 0.1, velocity: 0.0, steps: 0, initialized: true };
        Ok(())
    }

    fn time(&self) -> f64 {
        self.state.time
    }

    fn advance(&mut self, end: f64) -> Result<(), Failure> {
        let step = self.values[STEP];
        let place = ((end - self.state.start) / step).round();
        let end = if (self.state.start + place * step - end).abs() < 1e-9 * step {
            self.state.start + place * step
        } else {
            end
        };
        let on_grid = (self.state.time - self.state.start) / step;
        let count = ((end - self.state.time) / step - 1e-6).ceil();
        let whole = (on_grid - on_grid.round()).abs() < 1e-6 && end == self.state.start + place * step;
        let h = if whole { step } else { (end - self.state.time) / count };
        for _ in 0..count as usize {
            let force = self.values[FORCE] + self.values[GRAVITY] - self.values[YOUNG] * 1e-9 * self.state.position;
            self.state.velocity += h * force;
            self.state.position += h * self.state.velocity;
            self.state.steps += 1;
        }
        self.state.time = end;
        Ok(())
    }

    fn take_warnings(&mut self) -> Vec<String> {
        Vec::new()
    }

    fn reset(&mut self) {
        for place in 0..5 {
            self.values[place] = self.variables[place].start.number();
        }
        self.state = State { position: 0.1, ..State::default() };
    }

    fn snapshot(&self) -> Self::Snapshot {
        (self.state, self.values)
    }

    fn restore(&mut self, snapshot: &Self::Snapshot) {
        (self.state, self.values) = *snapshot;
    }
}
