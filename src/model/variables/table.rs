//! The variable table of a model: parameters as the file has them, then results in the order of results.csv.
//! One row has the FMI variable and what it is read from.

use super::dependencies::{self, Found, Givens};
use super::inputs::Inputs;
use super::measure::{ACCOUNT, Measure, OF_AIR, OF_WATER};
use super::nominal::Scales;
use super::reading::{
    Moment, of_connection, of_part, push_contact, push_foundation, push_joint, push_point, push_rope, push_total,
    push_wrench,
};
use crate::fmi::Value;
use crate::fmi::variable::{Causality, Variability, Variable};
use crate::math::Vec3;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::output::joint_loads::JointLoads;
use crate::mechanics::output::section_loads::SectionLoads;
use crate::mechanics::output::section_stress::WorstFiber;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::energy::Part;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::file::document::Document;
use crate::model::file::entries::output::{OutputSpec, Target};
use crate::model::file::entries::simulation::{Analysis, Total};
use crate::model::file::quantity::Quantity;
use crate::model::file::reader::anchor::{Anchor, Spot};
use crate::model::file::unit;
use crate::model::text::names::Kind;
use std::ops::Range;

/// What a row is read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Parameter of this number in the file.
    Parameter(usize),
    /// Input of this index among the inputs.
    Input(usize),
    /// Result of this number.
    Result(usize),
}

/// The result that counts motions along a path.
const UNSTABLE_MOTIONS: &str = "path.unstable_motions";

/// The variable table, and where each row's value comes from.
#[derive(Clone, Debug)]
pub struct Table {
    /// The rows; a variable's value reference is its index.
    pub variables: Vec<Variable>,
    /// Sources of the rows.
    pub sources: Vec<Source>,
    /// What the results are made of: also those that the file does not ask for, because errors are compared with the
    /// energies.
    pub measures: Vec<Measure>,
    /// Name and unit of each result.
    pub results: Vec<(String, String)>,
    /// The measures of forces and moments that a moving observer sees, by their indices in the list, with the sensor
    /// that the observer looks at.
    seen: Vec<(usize, usize)>,
    /// The first spring of the system that belongs to a joint: those before it are the springs, friction and stops of
    /// the file.
    first_of_joints: usize,
    /// Whether all states are equilibria, in which nothing moves, whatever frames and drives do.
    is_at_rest: bool,
}

impl Table {
    /// Of a model file.
    pub fn new(document: &Document) -> Self {
        let mut table = Self {
            variables: Vec::new(),
            sources: Vec::new(),
            measures: Vec::new(),
            results: Vec::new(),
            seen: Vec::new(),
            first_of_joints: document.springs.len() + document.frictions.len() + document.stops.len(),
            is_at_rest: document.simulation.analysis == Analysis::Static,
        };
        let inputs = Inputs::new(document);
        for (index, parameter) in document.parameters().iter().enumerate() {
            let input = inputs.place(parameter.number).map(Source::Input);
            let found_from = parameter.is_calculated().then(|| dependencies::of_calculated(document, index));
            let variable = Variable { found_from, ..parameter.variable.clone() };
            table.push(variable, input.unwrap_or(Source::Parameter(index)));
        }
        let givens = Givens::new(document);
        let mut sensor = 0;
        for output in &document.outputs {
            let sensors = output.sensors();
            for quantity in &output.quantities {
                let first = table.variables.len();
                table.push_quantity(document, output, *quantity, sensor..sensor + sensors);
                let found = match output.observer {
                    Some(_) => givens.of_seen(*quantity, &output.target),
                    None => givens.of(*quantity, &output.target),
                };
                table.find_from(first, &givens, found);
            }
            sensor += sensors;
        }
        let totals = table.variables.len();
        let has = |total: Total| document.simulation.totals.contains(&total);
        let shown = has(Total::Energy);
        for (name, meaning) in [
            ("energy.kinetic", "Kinetic energy"),
            ("energy.elastic", "Strain energy of beams and energy of springs"),
            ("energy.gravity", "Potential energy of gravity, zero at the origin"),
            ("energy.total", "Sum of kinetic, elastic and gravity energy"),
        ] {
            table.push_total(shown, name, 1, "J", meaning);
        }
        table.measures.push(Measure::Energy);
        if has(Total::Work) {
            let of_air = document.air.is_some().then_some(&OF_AIR);
            let of_fluids = document.water.as_ref().map(|_| &OF_WATER).or(of_air);
            let rows = ACCOUNT.iter().chain(of_fluids);
            rows.for_each(|(name, meaning)| table.push_result(name, 1, "J", meaning));
            table.measures.push(Measure::Account(of_fluids.is_some()));
        }
        let (shown, about_origin) = (has(Total::Momentum), "Angular momentum about the origin, in global axes");
        table.push_total(shown, "momentum.linear", 3, "kg.m/s", "Linear momentum in global axes");
        table.push_total(shown, "momentum.angular", 3, "kg.m2/s", about_origin);
        table.measures.push(Measure::Momentum);
        if document.follows_arc_length() {
            let parameter = "Parameter of the path of equilibria: the t of expressions";
            table.push_result("path.parameter", 1, "s", parameter);
            let motions = "Independent motions that release energy; 0: the equilibrium is stable";
            table.push_result(UNSTABLE_MOTIONS, 1, "", motions);
            table.measures.push(Measure::Path);
        }
        table.find_from(totals, &givens, givens.of_energies());
        let shown = has(Total::Statistics);
        for (name, meaning) in [
            ("statistics.steps", "Accepted internal steps since the start"),
            ("statistics.iterations", "Newton iterations since the start, those of rejected steps included"),
            ("statistics.rejected", "Rejected internal steps since the start"),
        ] {
            table.push_total(shown, name, 1, "", meaning);
        }
        table.measures.push(Measure::Statistics);
        table
    }

    fn push(&mut self, variable: Variable, source: Source) {
        self.variables.push(variable);
        self.sources.push(source);
    }

    /// Says of all rows from `first` on what their initial values are found from.
    fn find_from(&mut self, first: usize, givens: &Givens, found: Found) {
        let needed = givens.needed(found);
        self.variables[first..].iter_mut().for_each(|variable| variable.found_from.clone_from(&needed));
    }

    /// Gives inputs and results the orders of magnitude that the system has as drawn.
    pub fn scale(&mut self, system: &System) {
        let scales = Scales::of(system);
        self.variables.iter_mut().for_each(|variable| variable.nominal = scales.nominal(variable));
    }

    /// Rows of a quantity of an output whose sensors are `sensors`.
    fn push_quantity(&mut self, document: &Document, output: &OutputSpec, quantity: Quantity, sensors: Range<usize>) {
        let row = quantity.row();
        let unit = output.unit(quantity, document);
        let name = format!("{}.{}", output.name, row.word);
        let meaning = format!("{}: {}", output.name, output.meaning(quantity));
        if output.observer.is_some() && quantity.is_transmitted() {
            self.seen.push((self.measures.len(), sensors.start));
        }
        let measure = match output.target {
            Target::At(Anchor { spot: Spot::Frame(frame), point: None, .. }) if quantity.is_transmitted() => {
                Measure::Frame(frame, quantity)
            }
            Target::At(_) => Measure::Sensors(sensors, quantity),
            // In the order of their building.
            Target::Connection(Kind::Friction, number) => {
                Measure::Connection(Kind::Spring, document.springs.len() + number, quantity)
            }
            Target::Connection(Kind::Stop, number) => {
                let first = document.springs.len() + document.frictions.len();
                Measure::Connection(Kind::Spring, first + number, quantity)
            }
            Target::Connection(Kind::Rope, number) => {
                let rope = &document.ropes[number];
                let count = match quantity {
                    Quantity::Tension | Quantity::SpanLength => rope.over.len() + 1,
                    Quantity::WrapAngle | Quantity::Slip => rope.over.len(),
                    _ => 1,
                };
                self.push_result(&name, count, unit, &meaning);
                self.measures.push(Measure::Rope(number, quantity, count));
                return;
            }
            Target::Connection(kind, number) => Measure::Connection(kind, number, quantity),
            Target::Whole(Kind::Beam, beam) => Measure::Whole(Part::Beam(beam), quantity),
            Target::Whole(_, body) => Measure::Whole(Part::Body(body), quantity),
            Target::On { stations, .. } => {
                for station in 1..=stations {
                    for component in 1..=row.components {
                        let (index, part) = match row.components {
                            1 => (format!("[{station}]"), String::new()),
                            _ => (format!("[{station},{component}]"), format!(", component {component}")),
                        };
                        let meaning = format!("{meaning}, station {station} of {stations} from start to end{part}");
                        self.push_total(output.range.is_none(), &format!("{name}{index}"), 1, unit, &meaning);
                    }
                }
                self.measures.push(Measure::Sensors(sensors, quantity));
                return;
            }
        };
        self.push_result(&name, row.components, unit, &meaning);
        self.measures.push(measure);
    }

    /// The quantities that are read from sensors, with the sensors.
    pub fn points(&self) -> impl Iterator<Item = (Quantity, Range<usize>)> + '_ {
        self.measures.iter().filter_map(|measure| match measure {
            Measure::Sensors(sensors, quantity) => Some((*quantity, sensors.clone())),
            _ => None,
        })
    }

    /// Whether accelerations or multipliers are among what results are read from.
    pub fn needs_response(&self) -> bool {
        self.measures.iter().any(|measure| match measure {
            Measure::Sensors(_, quantity) => quantity.is_acceleration() || quantity.is_of_section(),
            Measure::Frame(..) | Measure::Connection(Kind::Gear, ..) => true,
            Measure::Connection(Kind::Contact | Kind::Foundation, ..) => false,
            // An effort is given, and a spring follows from positions and velocities.
            Measure::Connection(Kind::Actuator | Kind::Spring, _, quantity) => quantity.is_acceleration(),
            Measure::Connection(.., quantity) => {
                quantity.is_transmitted()
                    || quantity.is_acceleration()
                    || matches!(quantity, Quantity::Effort | Quantity::Power)
            }
            Measure::Rope(..) | Measure::Whole(..) | Measure::Energy | Measure::Account(_) => false,
            Measure::Momentum | Measure::Path | Measure::Statistics => false,
        })
    }

    /// Whether a result follows from positions and velocities: not from accelerations, multipliers or momenta, nor is
    /// it a count.
    pub fn follows_from_motion(&self, result: usize) -> bool {
        self.measure_of(result).is_some_and(|measure| match measure {
            Measure::Sensors(_, quantity) | Measure::Connection(Kind::Spring, _, quantity) => {
                !quantity.is_acceleration() && !quantity.is_of_section()
            }
            Measure::Connection(Kind::Contact | Kind::Foundation, ..) => true,
            Measure::Frame(..) | Measure::Connection(Kind::Gear, ..) => false,
            Measure::Connection(.., quantity) => quantity.is_coordinate(),
            Measure::Rope(..) | Measure::Whole(..) | Measure::Energy => true,
            Measure::Account(_) | Measure::Momentum | Measure::Path | Measure::Statistics => false,
        })
    }

    /// The quantity that each result belongs to; none: an energy, a momentum, a count.
    pub fn quantities_of_results(&self) -> Vec<Option<Quantity>> {
        let each = self.measures.iter().flat_map(|measure| std::iter::repeat_n(measure.quantity(), measure.results()));
        let mut quantities: Vec<_> = each.collect();
        quantities.resize(self.results.len(), None);
        quantities
    }

    /// The fibers of all sensors that bear most at a moment, for [`Moment::fibers`]; none where no stress is told.
    pub fn fibers(&self, moment: &Moment, snapshot: &mut FrameCache) -> Vec<WorstFiber> {
        let tells_stress = |measure: &Measure| matches!(measure, Measure::Sensors(_, Quantity::Stress));
        if !self.measures.iter().any(tells_stress) {
            return Vec::new();
        }
        let Moment { system, state, response, .. } = *moment;
        let configuration = snapshot.of(system, state);
        let passage = self.passage(state);
        let joints = JointLoads::new((system, state), (&configuration, &passage), &response.multipliers);
        let loads = SectionLoads { joints: &joints, acceleration: &response.acceleration };
        system.sensors.iter().map(|sensor| sensor.worst_fiber(&loads).unwrap_or_default()).collect()
    }

    /// Lets rates count in the results of a model whose states are equilibria: they are those of motions about them.
    pub fn take_motion(&mut self) {
        self.is_at_rest = false;
    }

    /// How the system passes through `state`.
    pub fn passage<'a>(&self, state: &'a State) -> Passage<'a> {
        if self.is_at_rest { Passage::Rest } else { Passage::of(state) }
    }

    /// What result `result` is a part of.
    fn measure_of(&self, result: usize) -> Option<&Measure> {
        let mut end = 0;
        self.measures.iter().find(|measure| {
            end += measure.results();
            result < end
        })
    }

    /// The quantities of outputs, each with its unit and the numbers of its results.
    pub fn quantities(&self) -> impl Iterator<Item = (&str, Range<usize>)> + '_ {
        let mut end = 0;
        self.measures.iter().filter_map(move |measure| {
            let numbers = end..end + measure.results();
            end = numbers.end;
            let is_always_there = matches!(measure, Measure::Energy | Measure::Momentum | Measure::Statistics);
            let is_of_output = !is_always_there && !matches!(measure, Measure::Account(_) | Measure::Path);
            is_of_output.then(|| (self.results[numbers.start].1.as_str(), numbers))
        })
    }

    /// The name of a result.
    pub fn result_name(&self, result: usize) -> &str {
        &self.results[result].0
    }

    /// Whether each result is a variable: those of the whole mechanism may be left out, and ranges over time are none.
    pub fn shown_results(&self) -> Vec<bool> {
        let mut is_shown = vec![false; self.results.len()];
        for source in &self.sources {
            if let Source::Result(result) = source {
                is_shown[*result] = true;
            }
        }
        is_shown
    }

    /// Rows of one quantity: `name`, or `name[1]` and so on.
    fn push_result(&mut self, name: &str, components: usize, unit: &str, meaning: &str) {
        self.push_total(true, name, components, unit, meaning);
    }

    /// Rows of one quantity, or only results without rows.
    fn push_total(&mut self, is_shown: bool, name: &str, components: usize, unit: &str, meaning: &str) {
        let is_count = name.starts_with("statistics.") || name == UNSTABLE_MOTIONS;
        let start = if is_count { Value::Integer(0) } else { Value::Real(0.0) };
        for component in 1..=components {
            let number = self.results.len();
            let (name, meaning) = match components {
                1 => (name.to_owned(), meaning.to_owned()),
                _ => (format!("{name}[{component}]"), format!("{meaning}, component {component}")),
            };
            if is_shown {
                self.push(result(&name, unit, meaning, start), Source::Result(number));
            }
            self.results.push((name, unit.to_owned()));
        }
    }

    /// Writes all results of a moment into `values`.
    pub fn measure(&self, moment: &Moment, snapshot: &mut FrameCache, values: &mut Vec<f64>) {
        let Moment { system, state, response, .. } = *moment;
        let configuration = snapshot.of(system, state);
        let passage = self.passage(state);
        let loads = JointLoads::new((system, state), (&configuration, &passage), &response.multipliers);
        values.clear();
        let mut seen = self.seen.iter().peekable();
        for (place, measure) in self.measures.iter().enumerate() {
            let first = values.len();
            match measure {
                Measure::Sensors(sensors, quantity) => {
                    for sensor in sensors.clone() {
                        push_point(values, moment, &loads, sensor, *quantity);
                    }
                }
                Measure::Frame(frame, quantity) => push_wrench(values, loads.frame_reaction(*frame), *quantity),
                Measure::Connection(Kind::Joint, number, quantity) => {
                    push_joint(values, *number, *quantity, moment, &loads, self.first_of_joints);
                }
                Measure::Connection(Kind::Contact, number, quantity) => {
                    push_contact(values, *number, *quantity, moment, &loads);
                }
                Measure::Connection(Kind::Foundation, number, quantity) => {
                    push_foundation(values, *number, *quantity, moment, &loads);
                }
                Measure::Rope(number, quantity, _) => push_rope(values, *number, *quantity, moment, &loads),
                Measure::Connection(kind, number, quantity) => {
                    values.push(of_connection(*kind, *number, *quantity, moment, &loads));
                }
                Measure::Whole(part, quantity) => values.push(of_part(*part, *quantity, moment, &configuration)),
                total => push_total(values, total, moment, &configuration),
            }
            if let Some((_, sensor)) = seen.next_if(|(measure, _)| *measure == place)
                && let Some(observer) = &system.sensors[*sensor].observer
            {
                let turned = observer.turn(&configuration, &Vec3::from_column_slice(&values[first..first + 3]));
                values[first..first + 3].copy_from_slice(turned.as_slice());
            }
        }
    }
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
        nominal: None,
        display_unit: None,
        found_from: None,
        derivative_of: None,
        follows_from: Vec::new(),
    }
}
