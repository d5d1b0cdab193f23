//! Joints that slide along beams: where they are.

use super::System;
use crate::error::Error;
use crate::mechanics::constraint::joint::Joint;
use crate::mechanics::constraint::slide::Slide;
use crate::mechanics::geometry::pose::PLACE;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::{Marker, own_velocity};

/// How far beyond an end of its beam something may slide, over the size of the system: round-off.
const ROUND_OFF: f64 = 1e-9;

impl System {
    /// The first entry of each joint that slides along a beam.
    pub fn slides(&self) -> impl Iterator<Item = (&Joint, &Slide)> {
        let slides = self.joints.iter().filter_map(|joint| joint.slide.as_ref().map(|slide| (joint, slide)));
        slides.filter(|(_, slide)| slide.is_first())
    }

    /// Gives each joint that slides the next number of `memory`, for its station, which is as drawn.
    pub(super) fn set_stations(&mut self, memory: &mut Vec<f64>) {
        for slide in self.joints.iter_mut().filter_map(|joint| joint.slide.as_mut()) {
            if slide.is_first() {
                memory.push(slide.way.drawn);
            }
            slide.memory = memory.len() - 1;
        }
    }

    /// Remembers the station of everything that slides, at `c`.
    pub(super) fn remember_stations(&self, c: &Configuration, memory: &mut [f64]) {
        for (joint, slide) in self.slides() {
            let before = memory[slide.memory];
            memory[slide.memory] = slide.way.station(&slide.way.nearest(c, &joint.b.pose(c).place, before));
        }
    }

    /// How far along its beam the joint with the first entry `number` has slid from where it is drawn, by the arc
    /// length as drawn, m, and how fast it slides while the coordinates change by `velocity`, m/s.
    pub fn way_slid(&self, number: usize, c: &Configuration, velocity: &[f64]) -> Option<[f64; 2]> {
        let joint = &self.joints[number];
        let slide = joint.slide.as_ref()?;
        let nearest = slide.nearest(c, &joint.b.pose(c).place);
        let (beam, _) = self.beam_of(slide.element);
        let length: f64 = self.mesh.elements[beam.element_range()].iter().map(|element| element.length()).sum();
        let speed = |marker: &Marker| {
            let own = own_velocity(c, marker, velocity);
            (marker.pose_q(c).times(&own) + marker.pose_t(c)[0].vectors()).column(PLACE).into_owned()
        };
        let apart = speed(&joint.b) - speed(&nearest.marker());
        let rate = apart.dot(&nearest.slope) / nearest.slope.norm_squared();
        Some([(slide.way.station(&nearest) - slide.way.drawn) * length, rate])
    }

    /// Checks that nothing has slid off its beam.
    ///
    /// # Errors
    /// A joint is beyond an end of its beam.
    pub(super) fn check_slides(&self, c: &Configuration, time: f64) -> Result<(), Error> {
        for (joint, slide) in self.slides() {
            let nearest = slide.nearest(c, &joint.b.pose(c).place);
            if nearest.beyond > ROUND_OFF * self.size {
                let (beam, _) = self.beam_of(slide.element);
                return Err(Error::SlidOff { time, joint: joint.name.clone(), beam: beam.name.clone() });
            }
        }
        Ok(())
    }
}
