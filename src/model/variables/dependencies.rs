//! What initial values are found from: which inputs and parameters a host must know first.
//!
//! A master that sees how little that is finds no loop between two units that start from their drawings. What is said
//! here is never less than the truth, and may be more: an equilibrium is found from everything.

use crate::model::builder;
use crate::model::file::document::Document;
use crate::model::file::entries::output::Target;
use crate::model::file::entries::simulation::{Analysis, Initial};
use crate::model::file::number::{Number, Written};
use crate::model::file::quantity::Quantity;
use crate::model::file::reader::anchor::{Anchor, Spot};
use crate::model::text::names::Kind;
use std::collections::BTreeMap;

/// What an initial value is found from, besides the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// Every input.
    All,
    /// Temperatures alone, which strains are without stress by: else it is as drawn.
    Drawing,
    /// Where frames and drives are, how fast, and temperatures: not the loads.
    Motion,
    /// Where this frame is.
    Frame(usize),
    /// Where frames are, and temperatures: of a joint, a bushing or a spring, which a frame may have displaced.
    Frames,
}

/// The inputs of a file, by value references.
#[derive(Clone, Debug)]
pub struct Givens {
    /// All parameters that can be set.
    parameters: Vec<usize>,
    /// Components of loads and efforts of actuators.
    loads: Vec<usize>,
    /// Values and rates of drives, and switches.
    drives: Vec<usize>,
    /// Of each frame.
    frames: Vec<Vec<usize>>,
    /// Temperatures.
    heats: Vec<usize>,
    /// The system begins as drawn, and moves.
    as_drawn: bool,
}

impl Givens {
    /// Of a file, whose parameters and inputs are the first rows of the variable table.
    pub fn new(document: &Document) -> Self {
        let rows = || document.parameters().iter().enumerate();
        let inputs: BTreeMap<usize, usize> =
            rows().filter(|(_, row)| row.is_input()).map(|(at, row)| (row.number.0, at)).collect();
        let input = |number: Number| inputs.get(&number.0).copied();
        let simulation = &document.simulation;
        Self {
            parameters: rows().filter(|(_, row)| !row.is_input() && !row.is_calculated()).map(|(at, _)| at).collect(),
            loads: document
                .loads
                .iter()
                .flat_map(|load| [load.force, load.moment].concat())
                .chain(document.actuators.iter().map(|actuator| actuator.effort))
                .filter_map(input)
                .collect(),
            drives: document
                .motions()
                .map(|(motion, _)| motion.number())
                .chain(builder::switches(document).flatten().map(|switch| switch.active))
                .filter_map(input)
                .collect(),
            frames: document.frames.iter().map(|frame| frame.numbers().filter_map(input).collect()).collect(),
            heats: document
                .beams
                .iter()
                .flat_map(|beam| [beam.temperature].into_iter().chain(beam.gradients()).flatten())
                .filter_map(input)
                .collect(),
            as_drawn: simulation.analysis == Analysis::Dynamic && simulation.initial == Initial::AsDrawn,
        }
    }

    /// What the initial value of a quantity at `target` is found from.
    pub fn of(&self, quantity: Quantity, target: &Target) -> Found {
        use Quantity::*;
        match (quantity, target) {
            (
                Position | Displacement | Rotation | Quaternion | Tilt,
                Target::At(Anchor { spot: Spot::Frame(frame), .. }),
            ) => Found::Frame(*frame),
            _ if !self.as_drawn => Found::All,
            (quantity, _) if quantity.is_acceleration() || quantity.is_of_section() => Found::All,
            (ReactionForce | ReactionMoment | AppliedForce | AppliedMoment | Effort | Power, _) => Found::All,
            // The ends of a rope are where frames and drives are.
            (_, Target::Connection(Kind::Rope, _)) => Found::Motion,
            (
                Drag | ContactPressure | Velocity | AngularVelocity | AngleRate | DistanceRate | Force | KineticEnergy,
                _,
            ) => Found::Motion,
            (Angle | Distance | Energy, _) => Found::Frames,
            _ => Found::Drawing,
        }
    }

    /// What the initial value of a quantity at `target` is found from that somebody sees who moves: also from where
    /// that one is.
    pub fn of_seen(&self, quantity: Quantity, target: &Target) -> Found {
        match self.of(quantity, target) {
            Found::Drawing | Found::Frame(_) | Found::Frames if self.as_drawn => Found::Motion,
            Found::Drawing | Found::Frame(_) | Found::Frames => Found::All,
            found => found,
        }
    }

    /// The energies and momenta of the start.
    pub fn of_energies(&self) -> Found {
        if self.as_drawn { Found::Motion } else { Found::All }
    }

    /// Value references of what is needed, ascending; none: everything is.
    pub fn needed(&self, found: Found) -> Option<Vec<usize>> {
        let frames = || self.frames.iter().flatten();
        let inputs: Vec<usize> = match found {
            Found::All => return None,
            Found::Drawing => self.heats.clone(),
            Found::Motion => self.drives.iter().chain(frames()).chain(&self.heats).copied().collect(),
            Found::Frame(frame) => self.frames[frame].clone(),
            Found::Frames => frames().chain(&self.heats).copied().collect(),
        };
        if inputs.len() == self.loads.len() + self.drives.len() + frames().count() + self.heats.len() {
            return None;
        }
        let mut needed = [self.parameters.clone(), inputs].concat();
        needed.sort_unstable();
        Some(needed)
    }
}

/// The parameters that calculated parameter `index` follows from, by their value references, ascending.
pub fn of_calculated(document: &Document, index: usize) -> Vec<usize> {
    let numbers = &document.numbers;
    let (mut open, mut seen) = (vec![document.parameters()[index].number.0], Vec::new());
    while let Some(place) = open.pop() {
        if seen.contains(&place) {
            continue;
        }
        seen.push(place);
        if let Written::Formula(formula) = &numbers.slots[place].written {
            open.extend(formula.parameters());
        }
    }
    let rows = document.parameters().iter().enumerate();
    rows.filter(|(_, row)| seen.contains(&row.number.0) && !row.is_calculated()).map(|(at, _)| at).collect()
}
