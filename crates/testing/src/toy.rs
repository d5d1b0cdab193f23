//! A model of one line, `x' = gain * force`, with traps: it can be told to fail or to panic, and counts what it is
//! asked.

use ancf14::fmi::{
    About, Credits, Failure, LogCategory, Model, Value,
    variable::{Causality, Quantity, Variability, Variable},
};
use serde::{Deserialize, Serialize};

/// Places in the variable table.
pub const GAIN: u32 = 0;
pub const LENGTH: u32 = 1;
pub const FORCE: u32 = 2;
pub const AREA: u32 = 3;
pub const POSITION: u32 = 4;
pub const COUNT: u32 = 5;
pub const CELLS: u32 = 6;
pub const TIME: u32 = 7;

/// A force that the model itself refuses, though it is within the bounds.
pub const REFUSED_FORCE: f64 = -777.0;
/// No step goes beyond this time.
pub const FARTHEST: f64 = 1e6;
/// A shorter step is left to the next one.
pub const SHORTEST_STEP: f64 = 1e-9;
/// Longest part of a step, s.
pub const PART: f64 = 0.25;
/// A length within its bounds that makes no model.
pub const UNFIT_LENGTH: f64 = 14.0;
/// A length without an initial state.
pub const IMPOSSIBLE_LENGTH: f64 = 13.0;

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plain {
    gain: f64,
    length: f64,
    force: f64,
    slope: f64,
    cells: i32,
    time: f64,
    position: f64,
    count: i32,
}

/// What the next step does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Trap {
    None,
    FailBeyond(f64),
    PanicBeyond(f64),
}

#[derive(Debug)]
pub struct Toy {
    about: About,
    variables: Vec<Variable>,
    plain: Plain,
    pub trap: Trap,
    pub initializations: usize,
    /// End of the step that is taken part by part, s.
    under_way: Option<f64>,
    warnings: Vec<String>,
}

const START: Plain =
    Plain { gain: 2.0, length: 1.5, force: 0.0, slope: 0.0, cells: 4, time: 0.0, position: 0.0, count: 0 };

pub fn about() -> About {
    About {
        name: "Toy & \"friends\"".to_owned(),
        identifier: "Toy".to_owned(),
        description: "One line: x' = gain * force, a < b".to_owned(),
        guid: "{00000000-0000-0000-0000-000000000001}".to_owned(),
        start: 0.0,
        stop: 2.0,
        output_step: 0.1,
        tolerance: 1e-6,
        credits: Credits { author: Some("A. Uthor & Co".to_owned()), ..Credits::default() },
    }
}

pub fn variables() -> Vec<Variable> {
    use Causality::{CalculatedParameter, Independent, Input, Output, Parameter};
    use Variability::{Continuous, Discrete, Fixed, Tunable};
    let row = |name: &str, causality, variability, start, quantity| Variable {
        name: name.to_owned(),
        description: format!("The {name} of the toy"),
        causality,
        variability,
        start,
        min: None,
        max: None,
        quantity,
        nominal: None,
        display_unit: None,
        found_from: None,
        derivative_of: None,
        follows_from: Vec::new(),
    };
    let real = Value::Real;
    vec![
        Variable {
            min: Some(0.0),
            max: Some(10.0),
            ..row("gain", Parameter, Tunable, real(2.0), Quantity::new("", "m/(N.s)"))
        },
        row("body.length", Parameter, Fixed, real(1.5), Quantity::new("Length", "m")),
        row("tip.force[1]", Input, Continuous, real(0.0), Quantity::new("Force", "N")),
        Variable {
            found_from: Some(vec![LENGTH as usize]),
            ..row("area", CalculatedParameter, Fixed, real(0.0), Quantity::new("Area", "m2"))
        },
        Variable {
            display_unit: Some("mm".to_owned()),
            ..row("tip.position[1]", Output, Continuous, real(0.0), Quantity::new("Position", "m"))
        },
        row("statistics.steps", Output, Discrete, Value::Integer(0), Quantity::new("", "")),
        Variable {
            min: Some(1.0),
            max: Some(100.0),
            ..row("body.cells", Parameter, Fixed, Value::Integer(4), Quantity::new("", ""))
        },
        row("time", Independent, Continuous, real(0.0), Quantity::new("Time", "s")),
    ]
}

pub fn toy() -> Toy {
    Toy {
        about: about(),
        variables: variables(),
        plain: START,
        trap: Trap::None,
        initializations: 0,
        under_way: None,
        warnings: Vec::new(),
    }
}

impl Toy {
    /// All that changes.
    pub fn plain(&self) -> Plain {
        self.plain
    }

    /// Makes another model of it.
    pub fn rename(&mut self, guid: &str) {
        self.about.guid = guid.to_owned();
    }
}

fn failure(message: &str) -> Failure {
    Failure { message: message.to_owned(), category: LogCategory::NonlinearSystems, line: None }
}

impl Model for Toy {
    type Snapshot = Plain;

    fn about(&self) -> &About {
        &self.about
    }

    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn value(&self, reference: usize) -> Value {
        let plain = &self.plain;
        match u32::try_from(reference).unwrap() {
            GAIN => Value::Real(plain.gain),
            LENGTH => Value::Real(plain.length),
            FORCE => Value::Real(plain.force),
            AREA => Value::Real(plain.length.powi(2)),
            POSITION => Value::Real(plain.position),
            COUNT => Value::Integer(plain.count),
            CELLS => Value::Integer(plain.cells),
            TIME => Value::Real(plain.time),
            other => panic!("the toy has no variable {other}"),
        }
    }

    fn set_value(&mut self, reference: usize, value: Value) -> Result<(), Failure> {
        match (u32::try_from(reference).unwrap(), value) {
            (FORCE, Value::Real(REFUSED_FORCE)) => return Err(failure("the toy does not like this force")),
            (GAIN, Value::Real(number)) => self.plain.gain = number,
            (LENGTH, Value::Real(number)) => self.plain.length = number,
            (FORCE, Value::Real(number)) => self.plain.force = number,
            (CELLS, Value::Integer(number)) => self.plain.cells = number,
            other => panic!("the caller should have refused {other:?}"),
        }
        Ok(())
    }

    fn set_input_derivative(&mut self, _reference: usize, derivative: f64) {
        self.plain.slope = derivative;
    }

    fn check(&self) -> Result<(), Failure> {
        if self.plain.length == UNFIT_LENGTH { Err(failure("that length fits nothing")) } else { Ok(()) }
    }

    fn initialize(&mut self, start: f64) -> Result<(), Failure> {
        self.initializations += 1;
        if self.plain.length == IMPOSSIBLE_LENGTH {
            return Err(failure("no initial state with this length"));
        }
        if self.plain.gain == 0.0 {
            self.warnings.push("a gain of 0 moves nothing".to_owned());
        }
        self.plain = Plain { time: start, position: self.plain.length, count: 0, ..self.plain };
        Ok(())
    }

    fn time(&self) -> f64 {
        self.plain.time
    }

    fn shortest_step(&self) -> f64 {
        SHORTEST_STEP
    }

    fn accept_step(&self, end: f64) -> Result<(), Failure> {
        if end > FARTHEST { Err(failure("that is too far")) } else { Ok(()) }
    }

    fn advance(&mut self, end: f64) -> Result<(), Failure> {
        match self.trap {
            Trap::FailBeyond(limit) if end > limit => return Err(failure("no equilibrium at t = 1 s")),
            Trap::PanicBeyond(limit) if end > limit => panic!("the toy broke at {end} s"),
            _ => (),
        }
        let step = end - self.plain.time;
        if step < SHORTEST_STEP {
            self.plain.slope = 0.0;
            return Ok(());
        }
        self.plain.position += self.plain.gain * (self.plain.force + 0.5 * self.plain.slope * step) * step;
        self.plain.slope = 0.0;
        self.plain.time = end;
        self.plain.count += 1;
        Ok(())
    }

    fn begin_step(&mut self, end: f64) -> Result<(), Failure> {
        self.under_way = Some(end);
        Ok(())
    }

    fn take_part(&mut self) -> Result<bool, Failure> {
        let Some(end) = self.under_way else { return Ok(true) };
        let next = end.min(self.plain.time + PART);
        let slope = self.plain.slope;
        self.advance(next).inspect_err(|_| self.under_way = None)?;
        self.plain.slope = slope;
        let arrived = next == end;
        if arrived {
            self.end_step()?;
        }
        Ok(arrived)
    }

    fn look_between(&mut self) -> Result<(), Failure> {
        Ok(())
    }

    fn end_step(&mut self) -> Result<(), Failure> {
        self.under_way = None;
        self.plain.slope = 0.0;
        Ok(())
    }

    fn output_derivative(&mut self, reference: usize) -> Result<f64, Failure> {
        match reference as u32 {
            POSITION => Ok(self.plain.gain * self.plain.force),
            _ => Err(failure("no derivative")),
        }
    }

    fn partial_derivative(&mut self, _output: usize, _input: usize) -> Result<f64, Failure> {
        match self.plain.count {
            0 => Ok(0.0),
            _ => Ok(self.plain.gain),
        }
    }

    fn initial_derivative(&mut self, unknown: usize, known: usize) -> Result<f64, Failure> {
        match (unknown as u32, known as u32) {
            (POSITION, LENGTH) => Ok(1.0),
            (AREA, LENGTH) => Ok(2.0 * self.plain.length),
            _ => Ok(0.0),
        }
    }

    fn set_tolerance(&mut self, _tolerance: f64) -> Option<f64> {
        None
    }

    fn conclude(&mut self) {}

    fn take_warnings(&mut self) -> Vec<String> {
        std::mem::take(&mut self.warnings)
    }

    fn reset(&mut self) {
        self.plain = START;
    }

    fn snapshot(&self) -> Plain {
        self.plain
    }

    fn restore(&mut self, snapshot: &Plain) {
        self.plain = *snapshot;
    }

    fn write(&self, snapshot: &Plain, bytes: Vec<u8>) -> Vec<u8> {
        postcard::to_extend(snapshot, bytes).expect("a Vec takes every byte")
    }

    fn read(&self, bytes: &[u8]) -> Result<Plain, Failure> {
        postcard::from_bytes(bytes).map_err(|_| failure("no snapshot of a toy"))
    }
}
