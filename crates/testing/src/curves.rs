//! A model file as a run of curves, and the reference curves beside it: what the benchmarks compare.

use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

/// Columns over time.
pub struct Curves {
    names: Vec<String>,
    pub time: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

impl Curves {
    /// The names of all columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The column of a name.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let place = self.names.iter().position(|own| own == name).unwrap_or_else(|| panic!("no column {name}"));
        self.rows.iter().map(|row| row[place]).collect()
    }

    /// The last value of a column.
    pub fn last(&self, name: &str) -> f64 {
        self.column(name)[self.time.len() - 1]
    }

    /// Of a reference file: lines with # are remarks; what is not there is not-a-number.
    pub fn read(text: &str) -> Self {
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let names = lines.next().unwrap().split(',').map(str::to_owned).collect();
        let number = |text: &str| if text.is_empty() { f64::NAN } else { text.parse().unwrap() };
        let numbers = |line: &str| line.split(',').map(number).collect::<Vec<f64>>();
        let rows: Vec<Vec<f64>> = lines.map(numbers).collect();
        Self { names, time: rows.iter().map(|row| row[0]).collect(), rows }
    }

    /// A model file, run with overrides to its stop time, a row per output step.
    pub fn run(text: &str, overrides: &[(&str, &str)]) -> Self {
        Self::record(&mut load(text, overrides))
    }

    /// An initialized simulation, run to its stop time, a row per output step.
    pub fn record(simulation: &mut Simulation) -> Self {
        let (stop, step) = (simulation.about().stop, simulation.about().output_step);
        let mut curves = Self::start(simulation);
        for number in 1..=(stop / step).round() as u32 {
            let time = f64::from(number) * step;
            simulation.advance(time).unwrap_or_else(|failure| panic!("{}", failure.message));
            curves.time.push(time);
            curves.rows.push(Self::row(simulation));
        }
        curves
    }

    /// The one row of a simulation at its start.
    pub fn start(simulation: &Simulation) -> Self {
        let names = simulation.variables().iter().map(|variable| variable.name.clone()).collect();
        Self { names, time: vec![simulation.time()], rows: vec![Self::row(simulation)] }
    }

    fn row(simulation: &Simulation) -> Vec<f64> {
        (0..simulation.variables().len()).map(|reference| simulation.value(reference).number()).collect()
    }

    /// Largest difference between `own` and `reference`, both at the output times, up to the time `until`.
    pub fn difference(&self, own: &[f64], reference: &[f64], until: f64) -> f64 {
        let rows = self.time.iter().zip(own.iter().zip(reference)).filter(|(time, _)| **time <= until + 1e-9);
        rows.map(|(_, (own, reference))| (own - reference).abs()).fold(0.0, f64::max)
    }
}

/// A model file with overrides, initialized.
pub fn load(text: &str, overrides: &[(&str, &str)]) -> Simulation {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    let mut simulation =
        Simulation::load("model.toml", text, &overrides).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation
}

/// Largest size of a curve.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| f64::max(largest, value.abs()))
}
