//! Temperatures of beams: which beam has which, and what they are at an instant.

use super::System;
use crate::mechanics::beam::Beam;
use crate::mechanics::input::heat::Heat;
use crate::mechanics::input::host_motion::Targets;

impl System {
    /// Sets `heats` to the temperatures at `time`, s; `targets` has what a host gives.
    pub fn set_heats(&self, time: f64, targets: &Targets, heats: &mut Vec<Heat>) {
        heats.clear();
        heats.extend(self.heats.iter().map(|heat| heat.at(time, targets)));
    }

    /// The beam whose temperature is not defined at `time`, s, by its name.
    pub(super) fn undefined_heat(&self, time: f64) -> Option<&str> {
        let number = self.heats.iter().position(|heat| !heat.signals().all(|signal| signal.at(time).is_finite()))?;
        let is_heated = |beam: &&Beam| {
            self.mesh.elements[beam.element_range()].iter().any(|element| {
                element.ancf14().is_some_and(|element| element.heating.is_some_and(|heating| heating.number == number))
            })
        };
        self.beams.iter().find(is_heated).map(|beam| beam.name.as_str())
    }
}
