//! Numbers that the file leaves to the program, for those who want to write them down.

use crate::mechanics::force::law::Law;
use crate::model::file::entries::actuator::Action;
use crate::model::file::entries::friction::Growth;
use crate::model::file::entries::joint::Coordinate;
use crate::model::run::simulation::Simulation;

/// A number that the program has chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Derived {
    /// Its key, with the name of its section.
    pub key: String,
    /// The value.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
}

/// The stiffnesses of dry friction that the file does not give.
pub fn derived_numbers(simulation: &Simulation) -> Vec<Derived> {
    let frictions = simulation.document().frictions.iter().filter(|own| matches!(own.growth, Growth::Sticking(None)));
    let derived = frictions.filter_map(|own| {
        let spring = simulation.system().springs.iter().find(|spring| spring.name == own.name)?;
        let dry = spring.law.as_ref().and_then(Law::dry).filter(|dry| dry.limit > 0.0)?;
        let is_angle = matches!(own.action, Action::Joint { coordinate: Coordinate::Angle, .. });
        let unit = if is_angle { "N.m/rad" } else { "N/m" };
        Some(Derived { key: format!("{}.friction_stiffness", own.name), value: dry.stiffness(), unit })
    });
    derived.collect()
}
