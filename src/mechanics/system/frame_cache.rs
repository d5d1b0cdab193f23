//! Memory for the frames of the nodes, which every configuration needs: they are computed there alone.

use super::System;
use crate::mechanics::beam::ancf14::frame::NodeFrame;
use crate::mechanics::geometry::triad::Triad;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::state::State;

/// The frames of all nodes that have one, at the coordinates that were asked for last.
#[derive(Clone, Debug, Default)]
pub struct FrameCache {
    pub(super) frames: Vec<NodeFrame>,
}

impl FrameCache {
    /// Computes the frames at `q`, relative to the reference `triads`.
    pub fn set(&mut self, system: &System, q: &[f64], triads: &[Triad]) {
        system.mesh.set_frames(q, triads, &mut self.frames);
    }

    /// The frames as they are now.
    pub fn frames(&self) -> &[NodeFrame] {
        &self.frames
    }

    /// Computes the frames of `state` and returns its configuration.
    pub fn of<'a>(&'a mut self, system: &'a System, state: &'a State) -> Configuration<'a> {
        self.at(system, &state.q, state, &state.prescribed)
    }

    /// [`Self::at`] with the frames numbered `numbers` alone: the configuration is good for what depends on no others.
    pub fn at_frames<'a>(
        &'a mut self,
        system: &'a System,
        numbers: &[usize],
        q: &'a [f64],
        state: &'a State,
        prescribed: &'a Prescribed,
    ) -> Configuration<'a> {
        system.mesh.set_frames_of(numbers, q, &state.triads, &mut self.frames);
        system.configuration(q, self, state, prescribed)
    }

    /// Computes the frames at `q` and returns the configuration that `q` and `prescribed` describe, after the accepted
    /// `state`.
    pub fn at<'a>(
        &'a mut self,
        system: &'a System,
        q: &'a [f64],
        state: &'a State,
        prescribed: &'a Prescribed,
    ) -> Configuration<'a> {
        self.set(system, q, &state.triads);
        system.configuration(q, self, state, prescribed)
    }
}
