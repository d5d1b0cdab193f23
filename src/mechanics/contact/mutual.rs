//! Contact of a beam with another beam, or with its own coils.
//!
//! A point of one beam touches the nearest point of the other one's axis, at a distance `L`. Points of both beams do
//! so, with half of the force each: the answer does not depend on which of them is named first. Over a step the nearest
//! point moves along the axis from `s₀` to `s₁`. The force acts on the one that is in their middle `s̄`, whose slope is
//! `t`. The arm `D` from there changes `D·D/2` and `D·t`, and with the means of both ends
//!
//! `α (D̄·ΔD) + β (t̄·ΔD + D̄·Δt) = L₁ − L₀`, `α = 2/(L₀ + L₁)`
//!
//! holds exactly for the one `β` that solves it. It is of second order in the step, and 0 where the point does not move
//! along the axis. The force thus works as much as its energy changes. It has neither a resultant nor a moment, since
//! turns of everything change neither `D·D` nor `D·t`.

use super::axis::{Axis, Nearest, Strand};
use super::law::{Law, Pressure};
use super::pieces::{Gap, Lying, each_point};
use crate::math::{Mat3, Vec3, hermite};
use crate::mechanics::beam::ancf14::coordinates::interpolate;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use std::f64::consts::PI;

/// Share of the force on the points of each of both beams.
const HALF: f64 = 0.5;
/// Changes of `D·t` over the distance of both axes below which `β` is round-off, and as good as 0.
const SMALL: f64 = 1e-4;
/// Length that a beam may have over its arc length: more than the checks of a step let pass.
const STRETCH: f64 = 4.0;
/// Reaches of an element within which the nearest points of a step are. Those of an instant are within one; over a step
/// the nearest point may move on by as much as a half of the element.
const SLACK: f64 = 1.5;
/// Share of the distance of both axes that is the core of a beam: nothing may run through it.
const CORE: f64 = 0.5;
/// Projections to and fro that find the nearest points of two beams that cross.
const PROJECTIONS: usize = 12;
/// Smallest distance that has a direction, m.
const NO_DISTANCE: f64 = 1e-300;

/// Vectors of two elements that touch: positions and slopes of the ends of both.
pub const VECTORS: usize = 8;

/// Contact of a beam with another one, or with itself.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamContact {
    /// Name in the model file.
    pub name: String,
    /// Its position among the contacts of the model file.
    pub number: usize,
    /// The beam that touches, and the one that it touches.
    pub strands: [Strand; 2],
    /// Its normal force.
    pub law: Law,
}

/// A point of an element that touches another element.
#[derive(Clone, Copy, Debug)]
pub struct Meeting {
    /// The elements of the point and of what it touches, from 0 within their beams.
    pub elements: [usize; 2],
    /// The strand that the point is of; the other one is touched.
    pub side: usize,
    /// Positions in both elements, 0 to 1.
    pub xi: [f64; 2],
    /// Length that it stands for, m.
    pub length: f64,
    /// Size of the normal force, N.
    pub pressing: f64,
    /// How far the surfaces are inside each other, m.
    pub penetration: f64,
    /// Energy that the step takes, J.
    pub dissipated: f64,
    /// Energy of the penetration at the instant or at the end of the step, J.
    pub energy: f64,
    /// Direction of the force on the element of the point.
    pub push: Vec3,
    /// Direction of the force on the slope of the element that is touched, m; 0 at an instant.
    pub twist: Vec3,
    /// How the distance depends on the vectors of both elements: over a step along the secant.
    pub rows: [Vec3; VECTORS],
    /// Derivative of the force with respect to the rate of the penetration at an instant, N s/m.
    pub by_rate: f64,
    last: Last,
}

/// Parts of the derivative of the force: the distance at the instant or at the end of the step.
#[derive(Clone, Copy, Debug)]
struct Last {
    /// Derivative of the force by the penetration, N/m: over a step twice that at its end.
    slope: f64,
    normal: Vec3,
    /// How the arm depends on the vectors.
    weights: [f64; VECTORS],
    /// `(I − n nᵀ)` times the force over the distance, N/m.
    across: Mat3,
    /// How what moves the nearest point along the axis depends on the vectors.
    along: [Vec3; VECTORS],
    /// The force over the distance and over the bend, N/m.
    by_along: f64,
}

impl Meeting {
    /// The internal force of the vector `row` of both elements, N.
    pub fn force(&self, row: usize) -> Vec3 {
        self.rows[row] * -self.pressing
    }

    /// Its derivative with respect to the vector `column`: twice that by the end of a step.
    pub fn stiffness(&self, row: usize, column: usize) -> Mat3 {
        let Last { slope, normal, weights, across, along, by_along } = &self.last;
        let by_pressure = self.rows[row] * normal.transpose() * (slope * weights[column]);
        let by_turn = along[row] * along[column].transpose() * *by_along - across * (weights[row] * weights[column]);
        by_pressure + by_turn
    }

    /// The same with respect to the rate of the vector, at an instant.
    pub fn damping(&self, row: usize, column: usize) -> Mat3 {
        let Last { normal, weights, .. } = &self.last;
        self.rows[row] * normal.transpose() * (self.by_rate * weights[column])
    }
}

impl BeamContact {
    /// Distance of the axes at which the surfaces touch, m.
    pub fn distance(&self) -> f64 {
        self.strands[0].radius + self.strands[1].radius
    }

    /// Whether a beam touches its own coils.
    pub fn is_own(&self) -> bool {
        self.strands[0].elements == self.strands[1].elements
    }

    /// Number of pairs of elements that may touch.
    pub fn pairs(&self) -> usize {
        let [first, second] = [0, 1].map(|side| self.strands[side].count());
        if self.is_own() { (first.max(2) - 1) * (first.max(2) - 2) / 2 } else { first * second }
    }

    /// The number of the pair of an element of the first strand and one of the second: of its own, the first one comes
    /// before the second.
    pub fn pair(&self, first: usize, second: usize) -> usize {
        if !self.is_own() {
            return first * self.strands[1].count() + second;
        }
        // Those before have n − 2, n − 3 ... partners behind their neighbor.
        let partners = self.strands[0].count() - 2;
        first * partners - first * first.saturating_sub(1) / 2 + second - first - 2
    }

    /// Whether two elements may touch: not neighbors in the same beam.
    fn may_touch(&self, element: usize, other: usize) -> bool {
        !self.is_own() || element.abs_diff(other) > 1
    }

    /// Whether two arc lengths of the same beam are so near to each other that it had to bend within its thickness.
    fn is_near(&self, one: f64, other: f64) -> bool {
        self.is_own() && (one - other).abs() < PI * self.strands[0].radius
    }

    /// Calls `take` with each point that touches at `c`, through which the system passes as `passage` says.
    pub fn each_meeting(&self, c: &Configuration, passage: &Passage, take: &mut dyn FnMut(&Meeting)) {
        match passage {
            Passage::Step(step) => self.each_near(&[step.start, step.end], false, &mut |side, elements| {
                self.meet_over(side, elements, [step.start, step.end], step.duration, take);
            }),
            Passage::Rest | Passage::Corrected(_) => self.each_near(&[c], false, &mut |side, elements| {
                self.meet_at(side, elements, c, None, take);
            }),
            Passage::Instant { velocity, velocity_by_q, .. } => self.each_near(&[c], false, &mut |side, elements| {
                self.meet_at(side, elements, c, Some((velocity, *velocity_by_q)), take);
            }),
        }
    }

    /// Calls `take` with the side and the elements of each pair whose points may touch at one of `ends`, or on the way
    /// between them if it is `sweeping`: by balls around the elements. Elements within reach of a ball that is far away
    /// are left out at once.
    fn each_near(&self, ends: &[&Configuration], sweeping: bool, take: &mut dyn FnMut(usize, [usize; 2])) {
        let sides = if self.is_own() { 1 } else { 2 };
        for side in 0..sides {
            let [own, other] = [&self.strands[side], &self.strands[1 - side]];
            for element in 0..own.count() {
                let mut next = 0;
                while next < other.count() {
                    let (clear, reach) = self.clearance([own, other], [element, next], ends, sweeping);
                    if clear < if ends.len() > 1 { SLACK * reach } else { reach } {
                        if self.may_touch(element, next) {
                            take(side, [element, next]);
                        }
                        next += 1;
                        continue;
                    }
                    // A motion on the way counts at both ends, and there and back.
                    let stretch = if sweeping { 3.0 * STRETCH } else { STRETCH };
                    let bound = other.arc(next, 0.5) + clear / stretch;
                    next += 1;
                    while next < other.count() && other.starts[next + 1] < bound {
                        next += 1;
                    }
                }
            }
        }
    }

    /// How far the middle of an element is from the surface of a ball around another one, m, and the reach of the
    /// element itself.
    #[inline(never)]
    fn clearance(
        &self,
        [own, other]: [&Strand; 2],
        [element, next]: [usize; 2],
        ends: &[&Configuration],
        sweeping: bool,
    ) -> (f64, f64) {
        let (mut clear, mut reach, mut ways) = (f64::INFINITY, 0.0_f64, [Vec3::zeros(); 2]);
        for (way, c) in ways.iter_mut().zip(ends) {
            let [first, second] = [own.elements.start + element, other.elements.start + next]
                .map(|number| Lying::of(&c.mesh.elements[number], c));
            *way = first.point(0.5) - second.point(0.5);
            clear = clear.min(way.norm() - self.distance() - first.reach());
            reach = reach.max(second.reach());
        }
        let moved = if sweeping { (ways[1] - ways[0]).norm() } else { 0.0 };
        (clear - moved, reach)
    }

    /// Gap between the surfaces at `point`, at the arc length `own`, and near the arc length `middle` of `axis`, m;
    /// infinite where both are the same part of a beam.
    fn gap(&self, axis: &Axis, middle: f64, point: &Vec3, own: f64) -> f64 {
        let found = axis.nearest(point, middle);
        if self.is_near(own, found.s) { f64::INFINITY } else { found.distance - self.distance() }
    }

    /// The points of `elements` that touch over a step.
    #[inline(never)]
    fn meet_over(
        &self,
        side: usize,
        elements: [usize; 2],
        ends: [&Configuration; 2],
        duration: f64,
        take: &mut dyn FnMut(&Meeting),
    ) {
        let [own, other] = [&self.strands[side], &self.strands[1 - side]];
        let lying = ends.map(|c| Lying::of(&c.mesh.elements[own.elements.start + elements[0]], c));
        let axes = ends.map(|c| Axis::of(other, c));
        let middle = other.arc(elements[1], 0.5);
        let gap = |end: usize, xi: f64| self.gap(&axes[end], middle, &lying[end].point(xi), own.arc(elements[0], xi));
        let gaps: [Gap; 2] = [&|xi| gap(0, xi), &|xi| gap(1, xi)];
        each_point(&gaps, &[], lying[1].length, &mut |_, xi, share| {
            let points = lying.map(|own| own.point(xi));
            let last = axes[1].nearest(&points[1], middle);
            let first = axes[0].nearest(&points[0], last.s);
            let mean = HALF * (first.s + last.s);
            let (element, eta) = other.at(mean);
            if element != elements[1] || self.is_near(own.arc(elements[0], xi), mean) {
                return;
            }
            let [from, to] = [0, 1].map(|end| axes[end].point(element, eta));
            let penetrations = [first, last].map(|own| self.distance() - own.distance);
            let Pressure { force, slope, elastic } = self.law.over(penetrations, duration);
            if force == 0.0 && slope == 0.0 {
                return;
            }
            let share = HALF * share;
            let [push, twist] =
                self.secant([&first, &last], [points[0] - from[0], points[1] - to[0]], [from[1], to[1]]);
            let lengths = [lying[1].length, other.starts[element + 1] - other.starts[element]];
            take(&Meeting {
                elements,
                side,
                xi: [xi, eta],
                length: share,
                pressing: share * force,
                penetration: penetrations[1],
                dissipated: share * (force - elastic) * (penetrations[1] - penetrations[0]),
                energy: share * self.law.energy(penetrations[1]),
                push,
                twist,
                rows: rows(lengths, [xi, eta], &push, &twist),
                by_rate: 0.0,
                last: self.last(&last, lengths, [xi, eta], [2.0 * share * slope, share * force], other.is_end(last.s)),
            });
        });
    }

    /// The directions of the force on the point and on the slope of what it touches, along which the distance changes
    /// from one end of a step to the other: `α D̄ + β t̄` and `β D̄`, from the arms `D` and slopes `t` of both ends.
    fn secant(&self, [first, last]: [&Nearest; 2], arms: [Vec3; 2], slopes: [Vec3; 2]) -> [Vec3; 2] {
        let alpha = 2.0 / (first.distance + last.distance).max(NO_DISTANCE);
        let (arm, slope) = ((arms[0] + arms[1]) * HALF, (slopes[0] + slopes[1]) * HALF);
        let left = last.distance - first.distance - alpha * arm.dot(&(arms[1] - arms[0]));
        let along = arms[1].dot(&slopes[1]) - arms[0].dot(&slopes[0]);
        let beta = left * along / (along * along + (SMALL * self.distance()).powi(2));
        [arm * alpha + slope * beta, arm * beta]
    }

    /// The points of `elements` that touch at an instant, with the velocities of all coordinates and how these change
    /// with the coordinates, 1/s.
    #[inline(never)]
    fn meet_at(
        &self,
        side: usize,
        elements: [usize; 2],
        c: &Configuration,
        motion: Option<(&[f64], f64)>,
        take: &mut dyn FnMut(&Meeting),
    ) {
        let [own, other] = [&self.strands[side], &self.strands[1 - side]];
        let [first, second] = [0, 1].map(|number| {
            let strand = [own, other][number];
            &c.mesh.elements[strand.elements.start + elements[number]]
        });
        let (lying, axis) = (Lying::of(first, c), Axis::of(other, c));
        let middle = other.arc(elements[1], 0.5);
        let gap: Gap = &|xi| self.gap(&axis, middle, &lying.point(xi), own.arc(elements[0], xi));
        each_point(&[gap], &[], lying.length, &mut |_, xi, share| {
            let found = axis.nearest(&lying.point(xi), middle);
            let (element, eta) = other.at(found.s);
            if element != elements[1] || self.is_near(own.arc(elements[0], xi), found.s) {
                return;
            }
            let lengths = [lying.length, second.length()];
            let normal = found.arm / found.distance.max(NO_DISTANCE);
            let penetration = self.distance() - found.distance;
            let (velocity, velocity_by_q) = motion.unwrap_or((&[], 0.0));
            let rate = match motion {
                Some(_) if self.law.is_damped() => {
                    let rate = |number: usize, xi: f64| {
                        let own = &velocity[[first, second][number].coordinates()];
                        interpolate(&hermite::shape(xi, lengths[number]), own)
                    };
                    -normal.dot(&(rate(0, xi) - rate(1, eta)))
                }
                _ => 0.0,
            };
            let by_rate = self.law.by_rate(penetration, rate);
            let Pressure { force, slope, .. } = self.law.at(penetration, rate);
            let share = HALF * share;
            let slope = share * (slope + velocity_by_q * by_rate);
            take(&Meeting {
                elements,
                side,
                xi: [xi, eta],
                length: share,
                pressing: share * force,
                penetration,
                dissipated: 0.0,
                energy: share * self.law.energy(penetration),
                push: normal,
                twist: Vec3::zeros(),
                rows: rows(lengths, [xi, eta], &normal, &Vec3::zeros()),
                by_rate: share * by_rate,
                last: self.last(&found, lengths, [xi, eta], [slope, share * force], other.is_end(found.s)),
            });
        });
    }

    /// The parts of the derivative of the force of a point. At an `is_end` the nearest point does not move along.
    fn last(&self, nearest: &Nearest, lengths: [f64; 2], xi: [f64; 2], [slope, force]: [f64; 2], is_end: bool) -> Last {
        let distance = nearest.distance.max(NO_DISTANCE);
        let normal = nearest.arm / distance;
        let [own, other] = [0, 1].map(|number| hermite::shape(xi[number], lengths[number]));
        let turning = hermite::shape_x(xi[1], lengths[1]);
        let weights = std::array::from_fn(|k| if k < 4 { own[k] } else { -other[k - 4] });
        let along = std::array::from_fn(|k| {
            let by_slope = if k < 4 { Vec3::zeros() } else { nearest.arm * turning[k - 4] };
            nearest.slope * weights[k] + by_slope
        });
        let across = (Mat3::identity() - normal * normal.transpose()) * (force / distance);
        let by_along = if is_end || nearest.bend <= 0.0 { 0.0 } else { force / (distance * nearest.bend) };
        Last { slope, normal, weights, across, along, by_along }
    }

    /// The first elements, of each strand, of which one has run through the core of the other between two
    /// configurations.
    pub fn run_through(&self, ends: [&Configuration; 2]) -> Option<[usize; 2]> {
        let mut found = None;
        self.each_near(&ends, true, &mut |side, elements| {
            if found.is_none() && side == 0 && self.runs_through(elements, ends) {
                found = Some(elements);
            }
        });
        found
    }

    /// Whether the nearest points of two elements run through each other's core.
    #[inline(never)]
    fn runs_through(&self, elements: [usize; 2], ends: [&Configuration; 2]) -> bool {
        let arms = ends.map(|c| {
            let axes = [0, 1].map(|side| Axis::of(&self.strands[side], c));
            let mut s = [0, 1].map(|side| self.strands[side].arc(elements[side], 0.5));
            let mut arm = Vec3::zeros();
            for _ in 0..PROJECTIONS {
                for side in [1, 0] {
                    let (element, xi) = self.strands[1 - side].at(s[1 - side]);
                    let found = axes[side].nearest(&axes[1 - side].point(element, xi)[0], s[side]);
                    s[side] = found.s;
                    arm = found.arm;
                }
            }
            (arm, self.is_near(s[0], s[1]))
        });
        let [(first, is_near), (last, is_still)] = arms;
        let way = last - first;
        let share = (-first.dot(&way) / way.norm_squared().max(NO_DISTANCE)).clamp(0.0, 1.0);
        !is_near && !is_still && (first + way * share).norm() < CORE * self.distance()
    }
}

/// How the distance depends on the vectors of both elements, by the directions of the force on the point and on the
/// slope of what it touches.
fn rows(lengths: [f64; 2], xi: [f64; 2], push: &Vec3, twist: &Vec3) -> [Vec3; VECTORS] {
    let [own, other] = [0, 1].map(|number| hermite::shape(xi[number], lengths[number]));
    let turning = hermite::shape_x(xi[1], lengths[1]);
    std::array::from_fn(|k| if k < 4 { push * own[k] } else { twist * turning[k - 4] - push * other[k - 4] })
}
