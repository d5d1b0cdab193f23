//! An elastic foundation along a beam (MECHANICS 3.14): a force per undeformed length on its axis that follows its
//! displacement `u = A_fᵀ (r − r_drawn)` from the position as drawn, in the axes `A_f` of the foundation.
//!
//! On both sides `f = −k u − c u̇` along each axis. On one side it pushes along a direction `d` alone:
//! `f = max(k p − c u̇, 0)` where `p = −u` along `d` is not negative. Over a step it is the mean over the way of `u`,
//! so that the work of the elastic part is the change of its energy.

use super::law::{Law, LawForce};
use crate::math::quadrature::{FOUR_POINTS, FOUR_WEIGHTS};
use crate::math::{Mat3, Vec3, hermite};
use crate::mechanics::beam::ancf14::coordinates::{ELEMENT, SHAPE_PLACES, interpolate};
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::marker::configuration::{Configuration, Passage};

/// Parts of an element in which a side that starts or ends to push is looked for.
const PARTS: usize = 8;
/// Halvings that find such a point to round-off of its position.
const HALVINGS: usize = 52;
/// Most ends of pieces of an element: one in each part, at both ends of a step, and the two ends of the foundation.
const ENDS: usize = 2 * PARTS + 2;

/// How hard a foundation is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bedding {
    /// It acts on both sides, along each of its axes.
    Sided {
        /// N/m².
        stiffness: [f64; 3],
        /// N s/m².
        damping: [f64; 3],
    },
    /// It pushes along a direction, the first of its axes, and never pulls.
    Pushing {
        /// N/m².
        stiffness: f64,
        /// N s/m².
        damping: f64,
    },
}

/// An element on a foundation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bed {
    /// Its number.
    pub element: usize,
    /// The part of it that the foundation supports, 0 to 1.
    pub within: [f64; 2],
    /// `X_a` as drawn.
    pub drawn: [Vec3; 4],
    /// Axes of the foundation at the four Gauss points, as columns.
    pub axes: [Mat3; 4],
}

/// An elastic foundation.
#[derive(Clone, Debug, PartialEq)]
pub struct Foundation {
    /// Name in the model file.
    pub name: String,
    /// Its elements.
    pub beds: Vec<Bed>,
    /// How hard it is.
    pub bedding: Bedding,
}

/// The force of a foundation at a point of integration.
#[derive(Clone, Copy, Debug)]
pub struct Bearing {
    /// Position in the element, 0 to 1.
    pub xi: f64,
    /// Weights of the element's positions and slopes.
    pub weights: [f64; 4],
    /// Force on the beam in global axes, N.
    pub force: Vec3,
    /// Minus its derivative with respect to the position at the instant, or twice that at the end of a step, N/m.
    pub stiffness: Mat3,
    /// Minus its derivative with respect to the velocity at the instant; over a step 0, N s/m.
    pub damping: Mat3,
    /// Energy that the damping takes over the step, J.
    pub dissipated: f64,
    /// Elastic energy at the instant or at the end of the step, J.
    pub energy: f64,
}

/// The force per length along an axis of a foundation.
#[derive(Clone, Copy, Debug, Default)]
struct Along {
    /// Against the displacement, N/m.
    force: f64,
    /// Its derivative with respect to the displacement, over a step twice that by its end, N/m².
    stiffness: f64,
    /// Its derivative with respect to the rate at the instant, N s/m².
    damping: f64,
    /// J/m.
    dissipated: f64,
    /// J/m.
    energy: f64,
}

/// How a point moves along an axis.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// A displacement (m), its rate (m/s) and what the rate changes by with the displacement (1/s).
    At(f64, f64, f64),
    /// Displacements at the ends of a step of this duration, s.
    Over([f64; 2], f64),
}

impl Bedding {
    /// Axes along which it acts.
    fn count(&self) -> usize {
        if matches!(self, Self::Pushing { .. }) { 1 } else { 3 }
    }

    /// Whether it has damping.
    pub fn is_damped(&self) -> bool {
        match self {
            Self::Sided { damping, .. } => damping.iter().any(|own| *own != 0.0),
            Self::Pushing { damping, .. } => *damping != 0.0,
        }
    }

    fn along(&self, axis: usize, way: Way) -> Along {
        match *self {
            Self::Sided { stiffness, damping } => linear(stiffness[axis], damping[axis], way),
            Self::Pushing { stiffness, damping } => pushing(stiffness, damping, way),
        }
    }
}

/// A spring and a damper on both sides.
fn linear(stiffness: f64, damping: f64, way: Way) -> Along {
    match way {
        Way::At(u, rate, rate_by_u) => Along {
            force: stiffness * u + damping * rate,
            stiffness: stiffness + damping * rate_by_u,
            damping,
            dissipated: 0.0,
            energy: 0.5 * stiffness * u * u,
        },
        Way::Over([start, end], duration) => {
            let rate = (end - start) / duration;
            Along {
                force: 0.5 * stiffness * (start + end) + damping * rate,
                stiffness: stiffness + 2.0 * damping / duration,
                damping: 0.0,
                dissipated: damping * rate * (end - start),
                energy: 0.5 * stiffness * end * end,
            }
        }
    }
}

/// The same where it pushes against negative displacements alone. A beam as drawn touches it.
fn pushing(stiffness: f64, damping: f64, way: Way) -> Along {
    match way {
        Way::At(u, rate, rate_by_u) => {
            if u > 0.0 {
                return Along::default();
            }
            let (force, energy) = (stiffness * u + damping * rate, 0.5 * stiffness * u * u);
            if force > 0.0 {
                // It never pulls, and still stores what it was pressed by.
                return Along { energy, ..Along::default() };
            }
            Along { force, stiffness: stiffness + damping * rate_by_u, damping, dissipated: 0.0, energy }
        }
        Way::Over([start, end], duration) => {
            let law = Law::OneSided { sign: -1.0, stiffness, damping };
            let rate = (end - start) / duration;
            let LawForce { elastic, viscous, by_x, by_v } = law.over(start, end, rate);
            let own = Along { energy: law.energy(end), ..Along::default() };
            if elastic + viscous > 0.0 {
                // It never pulls: the damper takes what the spring gives.
                return Along { dissipated: -elastic * (end - start), ..own };
            }
            Along {
                force: elastic + viscous,
                stiffness: 2.0 * (by_x + by_v / duration),
                dissipated: viscous * (end - start),
                ..own
            }
        }
    }
}

impl Foundation {
    /// Its part under element `number`; none: it does not support it.
    pub fn bed(&self, number: usize) -> Option<&Bed> {
        let first = self.beds.first()?.element;
        self.beds.get(number.checked_sub(first)?)
    }

    /// Calls `take` with the force at each point of integration of `bed` up to `end` (0 to 1) at `c`, through which the
    /// system passes as `passage` says.
    pub fn each_bearing(
        &self,
        bed: &Bed,
        element: &AnyElement,
        (c, passage): (&Configuration, &Passage),
        end: f64,
        take: &mut dyn FnMut(&Bearing),
    ) {
        let own = element.coordinates();
        let at = |c: &Configuration| moved(&c.beams.q[own.clone()], &bed.drawn);
        let (ends, velocity, rate_by_u) = match passage {
            Passage::Step(step) => ([at(step.start), at(step.end)], [Vec3::zeros(); 4], 0.0),
            Passage::Rest | Passage::Corrected(_) => ([at(c); 2], [Vec3::zeros(); 4], 0.0),
            Passage::Instant { velocity, velocity_by_q, .. } => {
                ([at(c); 2], moved(&velocity[own.clone()], &[Vec3::zeros(); 4]), *velocity_by_q)
            }
        };
        let within = [bed.within[0], bed.within[1].min(end)];
        if within[0] >= within[1] {
            return;
        }
        let (pieces, count) = match self.bedding {
            Bedding::Sided { .. } => both_ends(within),
            Bedding::Pushing { .. } => pieces(within, element.length(), &bed.axes[0].column(0).into_owned(), &ends),
        };
        for piece in pieces[..count].windows(2).filter(|piece| piece[1] > piece[0]) {
            for (point, share) in FOUR_POINTS.iter().zip(FOUR_WEIGHTS) {
                let xi = piece[0] + (piece[1] - piece[0]) * point;
                let length = share * (piece[1] - piece[0]) * element.length();
                let weights = hermite::shape(xi, element.length());
                let points = ends.map(|own| weighted(&weights, &own));
                let axes = bed.axes_at(xi);
                let (mut found, rate) = (Bearing::at(xi, weights), weighted(&weights, &velocity));
                for axis in 0..self.bedding.count() {
                    let direction: Vec3 = axes.column(axis).into();
                    let [start, end] = points.map(|point| direction.dot(&point));
                    let way = match passage {
                        Passage::Step(step) => Way::Over([start, end], step.duration),
                        _ => Way::At(end, direction.dot(&rate), rate_by_u),
                    };
                    found.add(&self.bedding.along(axis, way), &direction, length);
                }
                take(&found);
            }
        }
    }
}

impl Bed {
    /// The axes at `xi`: the cubic polynomial through those of the Gauss points.
    fn axes_at(&self, xi: f64) -> Mat3 {
        if self.axes[1..].iter().all(|own| *own == self.axes[0]) {
            return self.axes[0];
        }
        let mut sum = Mat3::zeros();
        for (k, own) in self.axes.iter().enumerate() {
            let others = FOUR_POINTS.iter().enumerate().filter(|(other, _)| *other != k);
            sum += own * others.map(|(_, point)| (xi - point) / (FOUR_POINTS[k] - point)).product::<f64>();
        }
        sum
    }
}

impl Bearing {
    fn at(xi: f64, weights: [f64; 4]) -> Self {
        let (force, stiffness, damping) = (Vec3::zeros(), Mat3::zeros(), Mat3::zeros());
        Self { xi, weights, force, stiffness, damping, dissipated: 0.0, energy: 0.0 }
    }

    fn add(&mut self, own: &Along, direction: &Vec3, length: f64) {
        let onto = direction * direction.transpose() * length;
        self.force -= direction * (own.force * length);
        self.stiffness += onto * own.stiffness;
        self.damping += onto * own.damping;
        self.dissipated += own.dissipated * length;
        self.energy += own.energy * length;
    }

    /// Adds `factor` times the derivative of the internal force, `by_position` (N/m), to the column-major block of the
    /// element.
    pub fn add_to(&self, by_position: &Mat3, factor: f64, block: &mut [f64]) {
        let (target, _) = block.as_chunks_mut::<ELEMENT>();
        for (by, column) in self.weights.iter().zip(SHAPE_PLACES) {
            for (weight, row) in self.weights.iter().zip(SHAPE_PLACES) {
                let own = by_position * (factor * weight * by);
                for j in 0..3 {
                    (0..3).for_each(|i| target[column + j][row + i] += own[(i, j)]);
                }
            }
        }
    }

    /// Position of the point with the coordinates `q` of its element, m.
    pub fn position(&self, q: &[f64]) -> Vec3 {
        interpolate(&self.weights, q)
    }
}

/// `X_a` of `q` less those of `drawn`.
fn moved(q: &[f64], drawn: &[Vec3; 4]) -> [Vec3; 4] {
    let mut found = SHAPE_PLACES.map(|start| Vec3::new(q[start], q[start + 1], q[start + 2]));
    found.iter_mut().zip(drawn).for_each(|(own, drawn)| *own -= drawn);
    found
}

fn weighted(weights: &[f64; 4], shapes: &[Vec3; 4]) -> Vec3 {
    shapes[0] * weights[0] + shapes[1] * weights[1] + shapes[2] * weights[2] + shapes[3] * weights[3]
}

/// One piece.
fn both_ends(within: [f64; 2]) -> ([f64; ENDS], usize) {
    let mut ends = [0.0; ENDS];
    ends[..2].copy_from_slice(&within);
    (ends, 2)
}

/// The ends of the pieces of `within` where displacements along `direction`, of which `states` has the `X_a`, keep
/// their sign at both ends of a step, and how many ends these are: four Gauss points a piece are exact then without
/// damping.
fn pieces(within: [f64; 2], length: f64, direction: &Vec3, states: &[[Vec3; 4]; 2]) -> ([f64; ENDS], usize) {
    let (mut ends, mut count) = both_ends(within);
    let states = if states[0] == states[1] { &states[1..] } else { &states[..] };
    for own in states {
        let along = own.map(|own| own.dot(direction));
        let value =
            |xi: f64| hermite::shape(xi, length).iter().zip(along).map(|(weight, own)| weight * own).sum::<f64>();
        let end_of = |part: usize| within[0] + (within[1] - within[0]) * (part as f64 / PARTS as f64);
        for part in 0..PARTS {
            let [mut low, mut high] = [end_of(part), end_of(part + 1)];
            let is_free = value(low) > 0.0;
            if is_free == (value(high) > 0.0) {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if (value(middle) > 0.0) == is_free { low = middle } else { high = middle }
            }
            ends[count] = high;
            count += 1;
        }
    }
    ends[..count].sort_by(f64::total_cmp);
    (ends, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A side that lifts off fast enough that its damper would pull has no force, and still stores what it was pressed
    /// by: 1000 N/m² by 0.01 m.
    #[test]
    fn a_side_that_lifts_off_keeps_its_energy() {
        let own = pushing(1e3, 10.0, Way::At(-0.01, 2.0, 0.0));
        assert_eq!((own.force, own.stiffness), (0.0, 0.0));
        assert!((own.energy - 0.05).abs() < 1e-15, "{}", own.energy);
    }

    /// Over a step too the force never pulls: the spring pushes by 10 N/m at the mean, and the damper would
    /// pull by 20.
    #[test]
    fn a_side_that_lifts_off_over_a_step_does_not_pull() {
        let own = pushing(1e3, 1.0, Way::Over([-0.02, 0.0], 1e-3));
        assert_eq!(own.force, 0.0);
        let slow = pushing(1e3, 0.1, Way::Over([-0.02, 0.0], 1e-3));
        assert!((slow.force + 8.0).abs() < 1e-12, "{}", slow.force);
    }
}
