//! What a joint of the model file consists of in the system.

/// The parts that a joint of the model file consists of, by their numbers in the system.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct JointParts {
    /// The conditions; a bushing has none.
    pub joint: Option<usize>,
    /// What measures its angle.
    pub angle: Option<usize>,
    /// What measures its distance.
    pub distance: Option<usize>,
    /// Springs and dampers.
    pub springs: Vec<usize>,
    /// Drives.
    pub drives: Vec<usize>,
    /// Locks.
    pub locks: Vec<usize>,
    /// Actuators.
    pub actuators: Vec<usize>,
    /// Gears, and whether this joint is the second side of each.
    pub gears: Vec<(usize, bool)>,
}
