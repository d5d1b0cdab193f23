//! What the results are made of, and how many each has.

use crate::mechanics::system::energy::Part;
use crate::model::file::quantity::Quantity;
use crate::model::text::names::Kind;
use std::ops::Range;

/// What the results are made of, in their order.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// A quantity at sensors: one of a point, several of a whole beam.
    Sensors(Range<usize>, Quantity),
    /// What a moving frame must supply, by its number.
    Frame(usize, Quantity),
    /// A quantity of a connection, by its kind and its index among that kind. Friction and stops are springs, by
    /// their indices in the system: they are built in the order of the file, one kind after the other.
    Connection(Kind, usize, Quantity),
    /// A quantity of a rope, by its index, and how many spans or sheaves it has.
    Rope(usize, Quantity, usize),
    /// A quantity of a whole beam or body.
    Whole(Part, Quantity),
    /// Kinetic, elastic, gravity and total energy.
    Energy,
    /// Work of loads, actuators and drives, and energy that dampers and the integrator take; `true`: of water and air,
    /// too.
    Account(bool),
    /// Linear and angular momentum.
    Momentum,
    /// Parameter of a path of equilibria, and motions that release energy.
    Path,
    /// Steps, iterations, rejected steps.
    Statistics,
}

/// The results of an account of energy.
pub(super) const ACCOUNT: [(&str, &str); 5] = [
    ("work.loads", "Work of loads since the start"),
    ("work.actuators", "Work of actuators since the start"),
    ("work.drives", "Work of drives and moving frames since the start"),
    (
        "work.dissipated",
        "Energy that dampers, friction, stops, engaging locks and material damping have taken since the start",
    ),
    ("work.drift", "Energy that the integrator has added since the start; it has taken what is negative"),
];

/// The result that a mechanism in water has besides.
pub(super) const OF_WATER: (&str, &str) = (
    "work.water",
    "Work of water and air since the start: of buoyancy, drag and inertia, that of the added mass included",
);

/// The same of one in air alone; with water it counts there.
pub(super) const OF_AIR: (&str, &str) =
    ("work.air", "Work of air since the start: of its drag, its inertia and its buoyancy");

/// Whether a result of this name is one of the account of energy.
pub fn is_of_account(name: &str) -> bool {
    ACCOUNT.iter().chain([&OF_WATER, &OF_AIR]).any(|(own, _)| *own == name)
}

impl Measure {
    /// Number of its results.
    pub fn results(&self) -> usize {
        match self {
            Self::Sensors(sensors, quantity) => sensors.len() * quantity.row().components,
            Self::Frame(_, quantity) | Self::Connection(.., quantity) | Self::Whole(_, quantity) => {
                quantity.row().components
            }
            Self::Rope(.., count) => *count,
            Self::Energy => 4,
            Self::Account(in_fluid) => ACCOUNT.len() + usize::from(*in_fluid),
            Self::Momentum => 6,
            Self::Path => 2,
            Self::Statistics => 3,
        }
    }

    /// The quantity of an output; none: an energy, a momentum, a count.
    pub fn quantity(&self) -> Option<Quantity> {
        match self {
            Self::Sensors(_, quantity)
            | Self::Frame(_, quantity)
            | Self::Connection(.., quantity)
            | Self::Rope(_, quantity, _)
            | Self::Whole(_, quantity) => Some(*quantity),
            Self::Energy | Self::Account(_) | Self::Momentum | Self::Path | Self::Statistics => None,
        }
    }
}
