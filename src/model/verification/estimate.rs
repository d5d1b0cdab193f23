//! From the differences of levels to the error of the first run.
//!
//! A run whose error is of order p differs by `(1 - 2^-p) e` from one with half the step or length, so that
//! `e = d / (1 - 2^-p)`. With three levels p is observed, as `log2(d_coarse / d_fine)`; it should be 2 in the step, 4
//! in the element's length, and 2 where linear twist limits (1 for what is read off the torsion, which linear twist has
//! constant in an element). Where it is far below 2, levels are too far apart for any formula, and the differences give
//! a bound.

use super::tally::{Pair, Tally};
use crate::math::elementary::log2;

/// `1/(1 - 2^-p)` for order 2. For order 4, and for linear twist, whose error is gone in the finer mesh, it is on the
/// safe side by a quarter and a third.
const RICHARDSON: f64 = 4.0 / 3.0;
/// In place of it where the order is not reached: between 1, of oscillations whose phases no level resolves, and 2, of
/// order 1.
const BOUND: f64 = 1.5;
/// Observed orders from here on are taken for 2 or more: an order between 1.5 and 2 changes an estimate by a sixth.
const LEAST_ORDER: f64 = 1.5;
/// Differences below this share of a column's size are round-off: results hold some 13 digits, and sums of many steps a
/// few fewer.
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
            // Two runs that do not differ at all are one and the same.
            Pair { coarse: Some(coarse), fine: Some(fine) } if fine > round_off && coarse > 0.0 => {
                Self::Observed(log2(coarse.max(round_off) / fine))
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

/// The largest parts of a column's error over all rows, with the orders by which they fall: those observed, up to those
/// of theory.
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

#[cfg(test)]
mod tests {
    use super::super::tally::Sample;
    use super::*;

    /// What levels whose errors are those of the step and of the mesh, given by `step(h)` and `mesh(l)` times a signal,
    /// tell.
    fn tally(step: impl Fn(f64) -> f64, mesh: impl Fn(f64) -> f64) -> Tally {
        let mut tally = Tally::default();
        for k in 0..=200 {
            let time = 0.01 * f64::from(k);
            // The errors grow in time and pass through zero, together.
            let (signal, grown) = ((3.0 * time).sin(), time * (7.0 * time).cos());
            let at = |h: f64, l: f64| signal + grown * (step(h) + mesh(l));
            let sample = Sample {
                own: at(1.0, 1.0),
                half_step: Some(at(0.5, 1.0)),
                double_step: Some(at(2.0, 1.0)),
                quadratic: Some(at(1.0, 1.0)),
                double_elements: Some(at(1.0, 0.5)),
                half_elements: Some(at(1.0, 2.0)),
            };
            tally.add(time, sample);
        }
        tally
    }

    /// The largest size of the growth in [`tally`].
    fn largest() -> f64 {
        (0..=200).map(|k| 0.01 * f64::from(k)).map(|time| (time * (7.0 * time).cos()).abs()).fold(0.0, f64::max)
    }

    /// Errors of the known orders are found to what Richardson's factor for order 2 adds to one of order 4, a quarter;
    /// the observed orders are those put in.
    #[test]
    fn known_orders_give_the_error() {
        let only_step = Estimate::of("tip.velocity", &tally(|h| 1e-3 * h * h, |_| 0.0), 2.0);
        assert!((only_step.error() / (1e-3 * largest()) - 1.0).abs() < 1e-9, "{only_step:?}");
        assert!(matches!(only_step.order, Order::Observed(order) if (order - 2.0).abs() < 1e-6));
        assert_eq!((only_step.limit, only_step.trust), (Limit::Step, Trust::Estimate));

        let only_mesh = Estimate::of("tip.velocity", &tally(|_| 0.0, |l| 1e-3 * l.powi(4)), 2.0);
        assert!((only_mesh.error() / (1e-3 * largest()) - 1.25).abs() < 1e-9, "{only_mesh:?}");
        assert!(matches!(only_mesh.order, Order::Observed(order) if (order - 4.0).abs() < 1e-6));
        assert_eq!((only_mesh.limit, only_mesh.trust), (Limit::Elements, Trust::Estimate));
    }

    /// Parts of opposite signs do not cancel: they will not in another case.
    #[test]
    fn parts_do_not_cancel() {
        let both = Estimate::of("tip.velocity", &tally(|h| 1e-3 * h * h, |l| -1e-3 * l * l), 2.0);
        assert!((both.error() / (2e-3 * largest()) - 1.0).abs() < 1e-9, "{both:?}");
    }

    /// Levels that do not fall by order 2 give a bound: order 1, which has twice the difference for its error, is not
    /// underestimated by more than a quarter, and noise that does not fall at all is not lost.
    #[test]
    fn other_orders_give_a_bound() {
        for (order, truth) in [(1.0, 1.0), (0.5, 1.0), (0.0, 0.0)] {
            let slow = Estimate::of("tip.velocity", &tally(|h: f64| 1e-3 * h.powf(order), |_| 0.0), 2.0);
            if truth == 0.0 {
                assert_eq!(slow.trust, Trust::RoundOff, "a constant has no differences");
                continue;
            }
            assert_eq!(slow.trust, Trust::Bound, "{slow:?}");
            let ratio = slow.error() / (1e-3 * largest());
            assert!((1.0 / 3.0..=2.0).contains(&ratio), "order {order}: {ratio}");
        }
    }

    /// What is zero by symmetry, or exact to round-off, has no error, and no order is observed in its noise.
    #[test]
    fn noise_is_no_error() {
        let noise = tally(|h| 1e-15 * h, |_| 0.0);
        assert_eq!(Estimate::of("tip.velocity", &noise, 2.0).trust, Trust::RoundOff);
        let symmetric = tally(|h| 1e-3 * h * h, |_| 0.0);
        assert_eq!(Estimate::of("tip.velocity", &symmetric, 0.0).trust, Trust::RoundOff);
    }

    /// Without a third level the order is that of theory.
    #[test]
    fn two_levels_assume_the_order() {
        let mut tally = Tally::default();
        tally.add(0.0, Sample { own: 1.0, half_step: Some(1.03), ..Sample::default() });
        let estimate = Estimate::of("tip.velocity", &tally, 1.0);
        assert_eq!(estimate.order, Order::Assumed(2.0));
        assert!((estimate.error() - 0.04).abs() < 1e-12);
    }
}
