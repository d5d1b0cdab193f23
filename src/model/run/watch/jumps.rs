//! Whether axial forces, and what is read from them, are asked for beside a node where the axial force jumps
//! (axial_jump.rs).

use crate::error::decimal;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::output::axial_jump::AxialJump;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::file::quantity::Quantity;
use crate::model::variables::Table;
use serde::{Deserialize, Serialize};

/// A jump below this share of what is read does not matter: the part of it that is read is less than half.
const NOTABLE: f64 = 0.15;
/// What is read is compared with this share of the forces that the beam carries there at least: what is far smaller
/// does not matter.
const SMALL: f64 = 0.1;
/// Looks after which a jump is judged, if the run does not end before: at a start all forces are small.
const LASTING: u32 = 200;

/// What has been seen of jumps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct JumpWatch {
    /// Of all quantities that are read at points, in the order of the table.
    readings: Vec<Reading>,
    /// Looks since the first jump that is still to be judged.
    looks: u32,
    warned: bool,
}

/// What was read of a quantity beside jumps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Reading {
    /// The largest value, as an axial force, N.
    largest: f64,
    /// The largest force that the beam carries there in any direction, N.
    carried: f64,
    /// The largest jump, N, with its node, and when it was there; 0: there is none.
    jump: f64,
    node: usize,
    time: f64,
}

impl Reading {
    fn include(&mut self, quantity: Quantity, system: &System, state: &State, c: &Configuration, sensor: usize) {
        let sensor = &system.sensors[sensor];
        let Some(AxialJump { node, jump, axial, carried }) = system.axial_jump_near(c, sensor) else { return };
        let size = match quantity {
            Quantity::Stress => sensor.stress_as_force(system, c).unwrap_or(axial),
            _ => axial,
        };
        (self.largest, self.carried) = (self.largest.max(size), self.carried.max(carried));
        if jump.abs() > self.jump.abs() {
            (self.jump, self.node, self.time) = (jump, node, state.instant());
        }
    }

    fn is_notable(&self) -> bool {
        self.jump.abs() > NOTABLE * self.largest.max(SMALL * self.carried)
    }
}

impl JumpWatch {
    /// Looks at a new state, and warns of a jump that has been there for long.
    pub fn look(&mut self, system: &System, state: &State, table: &Table, frames: &mut FrameCache) -> Option<String> {
        if self.warned || !quantities(table).any(|own| own.is_some()) {
            return None;
        }
        let c = frames.of(system, state);
        for (place, (quantity, sensors)) in table.points().enumerate() {
            if place == self.readings.len() {
                self.readings.push(Reading::default());
            }
            if is_read_from_axial_force(quantity) {
                sensors.for_each(|sensor| self.readings[place].include(quantity, system, state, &c, sensor));
            }
        }
        if self.readings.iter().any(Reading::is_notable) {
            self.looks += 1;
        }
        if self.looks >= LASTING { self.judge(system, table) } else { None }
    }

    /// Judges the jumps by the forces that the run has come to.
    pub fn judge(&mut self, system: &System, table: &Table) -> Option<String> {
        self.looks = 0;
        let mut readings = quantities(table).zip(&self.readings).filter(|_| !self.warned);
        let (quantity, Reading { jump, node, time, .. }) =
            readings.find_map(|(quantity, reading)| Some((quantity?, reading)).filter(|_| reading.is_notable()))?;
        self.warned = true;
        Some(format!(
            "an output of {} is within one element of {}, where the axial force jumps by about {jump:.1e} N at t = {} s: elements spread a jump over both \
             sides, so that values there are off by up to half of it; read them an element further away",
            quantity.row().word,
            system.describe_node(*node),
            decimal(*time)
        ))
    }
}

/// The quantities that are read at points, in the order of the table; none for those without an axial force.
fn quantities(table: &Table) -> impl Iterator<Item = Option<Quantity>> + '_ {
    table.points().map(|(quantity, _)| Some(quantity).filter(|own| is_read_from_axial_force(*own)))
}

fn is_read_from_axial_force(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::SectionForce | Quantity::Stress | Quantity::AxialStrain)
}
