//! Memory for the frames of the nodes at a state, which every configuration needs.

use super::System;
use crate::mechanics::beam::ancf14::frame::NodeFrame;
use crate::mechanics::beam::configuration::Configuration;
use crate::mechanics::state::State;

/// A state with the frames of its nodes: what sensors read.
#[derive(Clone, Debug, Default)]
pub struct FrameCache {
    frames: Vec<NodeFrame>,
}

impl FrameCache {
    /// Computes the frames of `state` and returns its configuration.
    pub fn of<'a>(&'a mut self, system: &'a System, state: &'a State) -> Configuration<'a> {
        system.frames(&state.q, &state.triads, &mut self.frames);
        system.configuration(&state.q, &self.frames, state, &state.prescribed)
    }
}
