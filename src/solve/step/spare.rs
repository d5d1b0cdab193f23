//! Memory that a solver needs within its steps only: between two steps others may use it.

use crate::mechanics::state::State;
use crate::mechanics::system::frame_cache::FrameCache;

/// Such memory. Nothing in it outlives a step, and whoever borrows it overwrites it.
#[derive(Debug)]
pub struct Spare<'a> {
    /// A state; empty, or one of the same system.
    pub state: &'a mut State,
    /// Frames of nodes.
    pub frames: &'a mut FrameCache,
}
