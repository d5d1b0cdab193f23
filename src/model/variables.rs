//! The variable table of a model: parameters as the file has them, then results in the order of results.csv.
//! One row has the FMI variable and what it is read from.

use super::document::Document;
use super::entries::anchor::Spot;
use super::entries::output::{Output, Target};
use super::quantity::Quantity;
use super::unit;
use crate::fmi::Value;
use crate::fmi::variable::{Causality, Variability, Variable};
use crate::math::Vec3;
use crate::mechanics::sensor::Snapshot;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// What a row is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Parameter of this number in the file.
    Parameter(usize),
    /// Result of this number.
    Result(usize),
}

/// What the results are made of, in their order.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// A quantity of the point of an output, by the number of its sensor.
    Point(usize, Quantity),
    /// Kinetic, elastic, gravity and total energy.
    Energy,
    /// Linear and angular momentum.
    Momentum,
    /// Steps, iterations, rejected steps.
    Statistics,
}

/// The variable table, and where each row's value comes from.
#[derive(Clone, Debug)]
pub struct Table {
    /// The rows; a variable's value reference is its place.
    pub variables: Vec<Variable>,
    /// Sources of the rows.
    pub sources: Vec<Source>,
    /// What the results are made of.
    pub measures: Vec<Measure>,
    /// Number of the first energy among the results.
    energy: usize,
}

impl Table {
    /// Of a model file.
    pub fn new(document: &Document) -> Self {
        let mut table = Self { variables: Vec::new(), sources: Vec::new(), measures: Vec::new(), energy: 0 };
        for (index, parameter) in document.parameters().iter().enumerate() {
            table.push(parameter.variable.clone(), Source::Parameter(index));
        }
        let at_points = |output: &&Output| match output.target {
            Target::At(anchor) => matches!(anchor.spot, Spot::Beam { .. }),
            Target::Joint(_) | Target::Drive(_) | Target::On { .. } => false,
        };
        for (sensor, output) in document.outputs.iter().filter(at_points).enumerate() {
            for quantity in output.quantities.iter().filter(|quantity| is_measured(**quantity)) {
                let row = quantity.row();
                let name = format!("{}.{}", output.name, row.word);
                let meaning = format!("{}: {}", output.name, row.meaning);
                table.push_result(&name, row.components, row.unit, &meaning);
                table.measures.push(Measure::Point(sensor, *quantity));
            }
        }
        table.energy = table.results();
        for (name, meaning) in [
            ("energy.kinetic", "Kinetic energy"),
            ("energy.elastic", "Strain energy of all beams"),
            ("energy.gravity", "Potential energy of gravity, zero at the origin"),
            ("energy.total", "Sum of kinetic, elastic and gravity energy"),
        ] {
            table.push_result(name, 1, "J", meaning);
        }
        table.measures.push(Measure::Energy);
        table.push_result("momentum.linear", 3, "kg.m/s", "Linear momentum in global axes");
        table.push_result("momentum.angular", 3, "kg.m2/s", "Angular momentum about the origin, in global axes");
        table.measures.push(Measure::Momentum);
        for (name, meaning) in [
            ("statistics.steps", "Accepted internal steps since the start"),
            ("statistics.iterations", "Newton iterations since the start, those of rejected steps included"),
            ("statistics.rejected", "Rejected internal steps since the start"),
        ] {
            table.push_result(name, 1, "", meaning);
        }
        table.measures.push(Measure::Statistics);
        table
    }

    fn push(&mut self, variable: Variable, source: Source) {
        self.variables.push(variable);
        self.sources.push(source);
    }

    /// Number of results so far.
    fn results(&self) -> usize {
        self.sources.iter().filter(|source| matches!(source, Source::Result(_))).count()
    }

    /// Rows of one quantity: `name`, or `name[1]` and so on.
    fn push_result(&mut self, name: &str, components: usize, unit: &str, meaning: &str) {
        let start = if name.starts_with("statistics.") { Value::Integer(0) } else { Value::Real(0.0) };
        for component in 1..=components {
            let number = self.results();
            let variable = match components {
                1 => result(name, unit, meaning.to_owned(), start),
                _ => {
                    let name = format!("{name}[{component}]");
                    result(&name, unit, format!("{meaning}, component {component}"), start)
                }
            };
            self.push(variable, Source::Result(number));
        }
    }

    /// Kinetic, elastic, gravity and total energy among the results, J.
    pub fn energies(&self, results: &[f64]) -> [f64; 4] {
        std::array::from_fn(|part| results[self.energy + part])
    }

    /// Writes all results of `state` into `values`.
    pub fn measure(&self, system: &System, state: &State, snapshot: &mut Snapshot, values: &mut Vec<f64>) {
        let configuration = snapshot.of(system, state);
        values.clear();
        for measure in &self.measures {
            match measure {
                Measure::Point(number, quantity) => {
                    let sensor = &system.sensors[*number];
                    let rotation = &state.rotations[*number];
                    let vector = |v: Vec3| [v[0], v[1], v[2]];
                    let place = || sensor.marker.pose(&configuration).place;
                    let motion = || sensor.motion(&configuration, &state.velocity);
                    let strains = || sensor.strains(system, &configuration);
                    match quantity {
                        Quantity::Position => values.extend(vector(place())),
                        Quantity::Displacement => values.extend(vector(place() - sensor.drawn.place)),
                        Quantity::Velocity => values.extend(vector(motion().0)),
                        Quantity::Rotation => values.extend(vector(*rotation)),
                        Quantity::Quaternion => values.extend(sensor.quaternion(rotation)),
                        Quantity::AngularVelocity => values.extend(vector(motion().1)),
                        Quantity::Twist => values.push(sensor.twist(system, &configuration)),
                        Quantity::AxialStrain => values.push(strains().axial),
                        Quantity::Curvature => values.extend(strains().curvature),
                        Quantity::Torsion => values.push(strains().torsion),
                        _ => {}
                    }
                }
                Measure::Energy => {
                    let parts = [
                        system.kinetic_energy(&state.velocity),
                        system.elastic_energy(&configuration),
                        system.gravity_energy(&state.q),
                    ];
                    values.extend(parts);
                    values.push(parts.iter().sum());
                }
                Measure::Momentum => {
                    let (linear, angular) = system.momentum(&state.q, &state.momentum);
                    values.extend(linear.iter().chain(angular.iter()));
                }
                Measure::Statistics => {
                    let counts = &state.statistics;
                    // Counts are far below 2^53: exact.
                    values.extend([counts.steps, counts.iterations, counts.rejected].map(|count| count as f64));
                }
            }
        }
    }
}

/// Whether the machine can be asked for it.
fn is_measured(quantity: Quantity) -> bool {
    !matches!(
        quantity,
        Quantity::Acceleration
            | Quantity::SectionForce
            | Quantity::SectionMoment
            | Quantity::Stress
            | Quantity::ReactionForce
            | Quantity::ReactionMoment
            | Quantity::Angle
            | Quantity::Distance
            | Quantity::Effort
    )
}

fn result(name: &str, unit: &str, description: String, start: Value) -> Variable {
    Variable {
        name: name.to_owned(),
        description,
        causality: Causality::Output,
        variability: match start {
            Value::Integer(_) => Variability::Discrete,
            Value::Real(_) => Variability::Continuous,
        },
        start,
        min: None,
        max: None,
        quantity: unit::quantity(unit),
        display_unit: None,
    }
}
