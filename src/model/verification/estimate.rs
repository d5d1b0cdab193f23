//! From the differences of levels to the error of the first run.
//!
//! A run whose error is of order p differs by `(1 - 2^-p) e` from one with half the step or length, so that `e = d / (1 - 2^-p)`. With
//! three levels p is observed, as `log2(d_coarse / d_fine)`; it should be 2 in the step, 4 in the element's length, and 2 where linear
//! twist limits (1 for what is read off the torsion, which linear twist has constant in an element). Where it is far below 2, levels are too far apart for any formula, and the differences give a bound.

use super::tally::{Pair, Tally};

/// `1/(1 - 2^-p)` for order 2. For order 4, and for linear twist, whose error is gone in the finer mesh, it is on the safe side by a
/// quarter and a third.
const RICHARDSON: f64 = 4.0 / 3.0;
/// In place of it where the order is not reached: between 1, of oscillations whose phases no level resolves, and 2, of order 1.
const BOUND: f64 = 1.5;
/// Observed orders from here on are taken for 2 or more: an order between 1.5 and 2 changes an estimate by a sixth.
const LEAST_ORDER: f64 = 1.5;
/// Differences below this share of a column's size are round-off: results hold some 13 digits, and sums of many steps a few fewer.
const ROUND_OFF: f64 = 1e-12;

/// What limits the accuracy of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The time step: order 2.
    Step,
    /// The length of the elements: order 4.
    Elements,
    /// The linear twist: order 2 in the length of the elements.
    Twist,
}

impl Limit {
    /// Its word in the table.
    pub fn word(self) -> &'static str {
        match self {
            Self::Step => "step",
            Self::Elements => "elements",
            Self::Twist => "twist",
        }
    }

    /// The order by which its error falls, by theory.
    pub fn known_order(self, column: &str) -> f64 {
        match self {
            Self::Twist if reads_torsion(column) => 1.0,
            Self::Step | Self::Twist => 2.0,
            Self::Elements => 4.0,
        }
    }
}

/// Whether a column, by its name, is read off the torsion at a point, which linear twist has constant in an element.
fn reads_torsion(column: &str) -> bool {
    let quantity = column.split(['.', '[']).nth(1);
    matches!(quantity, Some("torsion" | "section_moment" | "stress"))
}

/// How fast an error falls from level to level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    /// Observed with three levels.
    Observed(f64),
    /// Of theory: there are two levels only, or their differences are round-off.
    Assumed(f64),
}

impl Order {
    fn of(pair: Pair, known: f64, round_off: f64) -> Self {
        match pair {
            Pair { coarse: Some(coarse), fine: Some(fine) } if fine > round_off => {
                Self::Observed((coarse.max(round_off) / fine).log2())
            }
            _ => Self::Assumed(known),
        }
    }

    /// Its number.
    pub fn value(self) -> f64 {
        let (Self::Observed(order) | Self::Assumed(order)) = self;
        order
    }

    /// Whether Richardson's formula holds. Of linear twist it does at any order: the finer mesh has none of its error.
    pub fn is_reached(self) -> bool {
        match self {
            Self::Observed(order) => order >= LEAST_ORDER,
            Self::Assumed(_) => true,
        }
    }

    /// The error over the difference to the finer level.
    fn factor(self) -> f64 {
        if self.is_reached() { RICHARDSON } else { BOUND }
    }
}

/// What an estimate is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// The levels converge: an estimate by Richardson's formula.
    Estimate,
    /// They do not with the known order: a bound from their differences.
    Bound,
    /// The column is exact to round-off, or zero by symmetry.
    RoundOff,
}

impl Trust {
    /// Its word in the table.
    pub fn word(self) -> &'static str {
        match self {
            Self::Estimate => "estimate",
            Self::Bound => "bound",
            Self::RoundOff => "round-off",
        }
    }
}

/// The error of one column, in the column's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The part of the step, at the row where both parts together are largest.
    pub step: f64,
    /// The part of the mesh there.
    pub mesh: f64,
    /// The time of that row, s.
    pub time: f64,
    /// The larger one of the parts.
    pub limit: Limit,
    /// Of the larger one.
    pub order: Order,
    /// What it is worth.
    pub trust: Trust,
}

impl Estimate {
    /// Of the column of this name, which is compared with `scale`, in its unit; 0: it is zero by symmetry.
    pub fn of(column: &str, tally: &Tally, scale: f64) -> Self {
        let Orders { step: step_order, mesh: mesh_order, mesh_limit } = Orders::of(column, tally, scale);
        let (step, mesh) = (step_order.factor() * tally.worst.step, mesh_order.factor() * tally.worst.mesh);
        let (limit, order) = if step >= mesh { (Limit::Step, step_order) } else { (mesh_limit, mesh_order) };
        let trust = match order.is_reached() {
            _ if scale == 0.0 || step + mesh <= round_off(tally, scale) => Trust::RoundOff,
            true => Trust::Estimate,
            false => Trust::Bound,
        };
        Self { step, mesh, time: tally.worst.time, limit, order, trust }
    }

    /// Both parts, as if they had the same sign.
    pub fn error(&self) -> f64 {
        self.step + self.mesh
    }
}

/// The largest parts of a column's error over all rows, with the orders by which they fall: those observed, up to those of theory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts {
    /// Of the step, and its order.
    pub step: (f64, f64),
    /// Of linear twist, and its order.
    pub twist: (f64, f64),
    /// Of the elements otherwise, and its order.
    pub elements: (f64, f64),
}

impl Parts {
    /// Of the column of this name, which is compared with `scale`, in its unit.
    pub fn of(column: &str, tally: &Tally, scale: f64) -> Self {
        let part = |pair: Pair, limit: Limit| {
            let known = limit.known_order(column);
            let order = Order::of(pair, known, round_off(tally, scale));
            (order.factor() * pair.fine.unwrap_or(0.0), order.value().clamp(SLOWEST, known))
        };
        Self {
            step: part(tally.step, Limit::Step),
            twist: (tally.twist.unwrap_or(0.0), Limit::Twist.known_order(column)),
            elements: part(tally.elements, Limit::Elements),
        }
    }
}

/// The lowest order that is reckoned with: what falls more slowly does not fall.
const SLOWEST: f64 = 1e-3;

/// The orders of both parts.
struct Orders {
    step: Order,
    mesh: Order,
    /// Whether twist or elements make the larger part of the mesh's error.
    mesh_limit: Limit,
}

impl Orders {
    fn of(column: &str, tally: &Tally, scale: f64) -> Self {
        let round_off = round_off(tally, scale);
        let step = Order::of(tally.step, Limit::Step.known_order(column), round_off);
        let is_twist = tally.twist > tally.elements.fine;
        let mesh_limit = if is_twist { Limit::Twist } else { Limit::Elements };
        let known = mesh_limit.known_order(column);
        let mesh = if is_twist { Order::Assumed(known) } else { Order::of(tally.elements, known, round_off) };
        Self { step, mesh, mesh_limit }
    }
}

fn round_off(tally: &Tally, scale: f64) -> f64 {
    ROUND_OFF * tally.size().max(scale)
}
