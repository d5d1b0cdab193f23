//! Points that are watched.

use super::SystemBuilder;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::observer::Observer;
use crate::mechanics::marker::sensor::{Facing, Sensor};

impl SystemBuilder {
    /// Adds a sensor on the section of beam `beam` at `fraction` and returns its number.
    pub fn add_sensor(&mut self, beam: usize, fraction: f64) -> usize {
        self.watch(self.section_at(beam, fraction), Some((beam, fraction)))
    }

    /// Adds a sensor on `marker` and returns its number; `on_beam` is the beam and the fraction of its length where it
    /// is a point of one.
    pub fn watch(&mut self, marker: Marker, on_beam: Option<(usize, f64)>) -> usize {
        let sensor = Sensor::new(&self.system.beams, &self.configuration(), marker, on_beam);
        self.system.sensors.push(sensor);
        self.system.sensors.len() - 1
    }

    /// Number of sensors so far.
    pub fn sensors(&self) -> usize {
        self.system.sensors.len()
    }

    /// Lets sensor `number` measure the side `facing` of its section.
    pub fn face(&mut self, number: usize, facing: Facing) {
        self.system.sensors[number].facing = facing;
    }

    /// Lets an observer who moves with `marker` look at sensor `number`.
    pub fn observe(&mut self, number: usize, marker: Marker) {
        let observer = Observer::new(&self.configuration(), marker);
        self.system.sensors[number].observer = Some(observer);
    }
}
