//! A rope without mass over any number of wheels (MECHANICS 3.15): its spans are straight, its tension follows from its
//! length, and it never pushes.
//!
//! `line.rs` has the straight line between two wheels, `tensions.rs` the tensions of all spans. Sums over a system are
//! in `system/ropes.rs`.

pub mod line;
pub mod tensions;

use self::line::{Line, Wheel};
use self::tensions::{Change, Elasticity, Grip, Hold, MOST_SPANS, MOST_WHEELS, Stretch, Tension, Tensions};
use crate::mechanics::geometry::pose::{Pose, VECTORS};
use crate::mechanics::geometry::pose_pair::PairVector;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::marker::pose_gradient::PoseGradient;
use crate::mechanics::marker::relative_coordinate::near;
use crate::mechanics::marker::{Marker, own_velocity};
use std::ops::Range;

/// Numbers that a rope remembers for each of its wheels: how far both its angles are from those as drawn, and the rope
/// that has passed the grip before the stretch of this number; and the strain of that stretch beyond the one as drawn.
pub const REMEMBERED: usize = 4;

/// A wheel or an end of a rope.
#[derive(Clone, Debug, PartialEq)]
pub struct Seat {
    /// Name of the surface, or of the end.
    pub name: String,
    /// Its center, with x along its axis.
    pub marker: Marker,
    /// Its size and turn.
    pub wheel: Wheel,
    /// Angles as drawn at which the rope reaches and leaves it, rad.
    pub drawn: [f64; 2],
    /// The coordinates that it depends on, by their index among the parts of the rope; none: it cannot move by itself.
    pub part: Option<usize>,
}

/// A rope.
#[derive(Clone, Debug, PartialEq)]
pub struct Rope {
    /// Name in the model file.
    pub name: String,
    /// Its first end, its wheels in the order of the rope, its last end.
    pub seats: Vec<Seat>,
    /// The coordinates that it depends on, each once.
    pub parts: Vec<Range<usize>>,
    /// Its elasticity.
    pub elasticity: Elasticity,
    /// How its sheaves hold it; none: it runs freely over them.
    pub hold: Option<Hold>,
    /// Strain as drawn.
    pub strain: f64,
    /// Free length of each stretch as drawn, m.
    pub free: Vec<f64>,
    /// The first number that it remembers.
    pub memory: usize,
}

/// How a rope lies at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Laid {
    /// Lengths of the spans, m.
    pub lengths: [f64; MOST_SPANS],
    /// Angles at which it reaches and leaves each wheel, rad, continued over turns.
    pub angles: [[f64; 2]; MOST_WHEELS],
}

/// The tensions of a rope in a passage of the system.
#[derive(Clone, Copy, Debug)]
pub struct Pull {
    /// How it lies at the end.
    pub laid: Laid,
    /// Strains at the start of a step, before the step.
    pub start: [f64; MOST_SPANS],
    /// Change of the lengths of spans and of the arcs with them over a step, m: what the tensions work along.
    pub ways: [f64; MOST_SPANS],
    /// The stretches at the end.
    pub tensions: Tensions,
    /// Tension of each stretch, over a step its mean.
    pub pulls: [Tension; MOST_SPANS],
    stretches: [Stretch; MOST_SPANS],
    grips: [Option<Grip>; MOST_WHEELS],
}

/// Time ahead in which an instant sees whether a rope slides on, s: too short for the rope to move.
const AHEAD: f64 = 1e-6;

impl Pull {
    /// Lets the grips slide that slide on at the rates `change`: at its end a step that slid has the tensions of both
    /// sides at their bound.
    fn slide_on(&mut self, count: usize, change: &Change) {
        let (mut stretches, mut grips) = (self.stretches, self.grips);
        for (k, own) in stretches[..count].iter_mut().enumerate() {
            own.length += AHEAD * change.lengths[k];
        }
        for (k, own) in grips[..=count].iter_mut().enumerate() {
            if let Some(own) = own {
                own.way += AHEAD * change.ways[k];
                own.wrap += AHEAD * change.wraps[k];
            }
        }
        self.tensions.move_as(&Tensions::of(&stretches[..count], &grips[..=count]));
    }
}

impl Rope {
    /// Number of its spans.
    pub fn spans(&self) -> usize {
        self.seats.len() - 1
    }

    /// Number of its stretches.
    pub fn stretches(&self) -> usize {
        if self.hold.is_some() { self.spans() } else { 1 }
    }

    /// How many numbers it remembers.
    pub fn remembered(&self) -> usize {
        REMEMBERED * self.seats.len()
    }

    /// The stretch that a span belongs to.
    pub fn stretch_of(&self, span: usize) -> usize {
        if self.hold.is_some() { span } else { 0 }
    }

    /// The seat of grip `grip` as [`Grip`] counts them; none: there is none.
    fn seat_of(&self, grip: usize) -> Option<usize> {
        let last = self.seats.len() - 1;
        let seat = match self.hold {
            Some(_) => grip,
            None if grip == 0 => 0,
            None => last,
        };
        let is_wheel = self.seats[seat].wheel.radius > 0.0;
        is_wheel.then_some(seat)
    }

    /// The grip at a seat.
    fn grip_at(&self, seat: usize) -> Option<usize> {
        if self.seats[seat].wheel.radius == 0.0 {
            return None;
        }
        let last = self.seats.len() - 1;
        match self.hold {
            Some(_) => Some(seat),
            None if seat == 0 => Some(0),
            None if seat == last => Some(1),
            None => None,
        }
    }

    /// Which numbers of the memory belong to a seat.
    fn remembered_of(&self, seat: usize) -> usize {
        self.memory + REMEMBERED * seat
    }

    fn is_end(&self, seat: usize) -> bool {
        seat == 0 || seat + 1 == self.seats.len()
    }

    /// The poses of both sides of a span; of a point the position alone counts.
    pub fn poses(&self, span: usize, c: &Configuration) -> [Pose; 2] {
        [span, span + 1].map(|seat| {
            let Seat { marker, wheel, .. } = &self.seats[seat];
            if wheel.radius > 0.0 { marker.pose(c) } else { marker.placed(c) }
        })
    }

    /// How [`Self::poses`] move.
    pub fn poses_q(&self, span: usize, c: &Configuration) -> [PoseGradient; 2] {
        [span, span + 1].map(|seat| {
            let Seat { marker, wheel, .. } = &self.seats[seat];
            if wheel.radius > 0.0 { marker.pose_q(c) } else { marker.placed_q(c) }
        })
    }

    /// The wheels of a span.
    pub fn wheels(&self, span: usize) -> [Wheel; 2] {
        [span, span + 1].map(|seat| self.seats[seat].wheel)
    }

    /// The line of a span; none: it is impossible.
    pub fn line(&self, span: usize, c: &Configuration) -> Option<Line> {
        let [a, b] = self.poses(span, c);
        Line::between(self.wheels(span), &line::products(&a, &b))
    }

    /// The derivative of the reach of a span by the vectors of both poses; none: the span is impossible.
    pub fn reach_x(&self, span: usize, c: &Configuration) -> Option<PairVector> {
        let [a, b] = self.poses(span, c);
        Some(line::by_poses(&a, &b, &self.line(span, c)?.reach_by))
    }

    /// The first span that is impossible at `c`: one of its wheels is inside the other.
    pub fn impossible_span(&self, c: &Configuration) -> Option<usize> {
        (0..self.spans()).find(|span| {
            let [a, b] = self.poses(*span, c);
            line::stretched(self.wheels(*span), &line::products(&a, &b)).is_none()
        })
    }

    /// How it lies at `c`; none: a span is impossible.
    pub fn laid(&self, c: &Configuration) -> Option<Laid> {
        let mut found = Laid { lengths: [0.0; MOST_SPANS], angles: [[0.0; 2]; MOST_WHEELS] };
        for span in 0..self.spans() {
            let [a, b] = self.poses(span, c);
            let (length, [leaves, reaches]) = line::stretched(self.wheels(span), &line::products(&a, &b))?;
            found.lengths[span] = length;
            found.angles[span][1] = self.continued(span, 1, leaves, c);
            found.angles[span + 1][0] = self.continued(span + 1, 0, reaches, c);
        }
        Some(found)
    }

    /// An angle of a seat, continued from the last accepted state.
    fn continued(&self, seat: usize, side: usize, angle: f64, c: &Configuration) -> f64 {
        near(angle, self.remembered_angle(seat, side, c))
    }

    fn remembered_angle(&self, seat: usize, side: usize, c: &Configuration) -> f64 {
        self.seats[seat].drawn[side] + c.memory[self.remembered_of(seat) + side]
    }

    /// The way of a wheel under the rope from the angles of its seat, m.
    fn way(&self, seat: usize, [reaches, leaves]: [f64; 2]) -> f64 {
        let middle = match seat {
            0 => leaves,
            _ if self.is_end(seat) => reaches,
            _ => 0.5 * (reaches + leaves),
        };
        self.seats[seat].wheel.signed() * middle
    }

    /// Share of an angle of a seat in [`Self::way`].
    fn share(&self, seat: usize) -> f64 {
        if self.is_end(seat) { 1.0 } else { 0.5 }
    }

    /// Wrap angle of a sheave, rad.
    pub fn wrap(&self, seat: usize, laid: &Laid) -> f64 {
        let [reaches, leaves] = laid.angles[seat];
        self.seats[seat].wheel.turn * (leaves - reaches)
    }

    /// Length of rope between the marks of the wheels of a span, m.
    fn reach(&self, span: usize, laid: &Laid) -> f64 {
        let [a, b] = self.wheels(span);
        laid.lengths[span] + a.signed() * laid.angles[span][1] - b.signed() * laid.angles[span + 1][0]
    }

    /// Lengths of the stretches, m.
    fn stretch_lengths(&self, laid: &Laid) -> [f64; MOST_SPANS] {
        let mut lengths = [0.0; MOST_SPANS];
        for span in 0..self.spans() {
            lengths[self.stretch_of(span)] += self.reach(span, laid);
        }
        for grip in 0..=self.stretches() {
            let Some(seat) = self.seat_of(grip) else { continue };
            let way = self.way(seat, laid.angles[seat]);
            if let Some(before) = grip.checked_sub(1) {
                lengths[before] += way;
            }
            if grip < self.stretches() {
                lengths[grip] -= way;
            }
        }
        lengths
    }

    /// Length along spans and arcs, m.
    pub fn length(&self, laid: &Laid) -> f64 {
        self.stretch_lengths(laid)[..self.stretches()].iter().sum()
    }

    /// The tensions as `passage` says; none: a span is impossible.
    pub fn pull(&self, c: &Configuration, passage: &Passage) -> Option<Pull> {
        let (before, laid) = match passage {
            Passage::Step(step) => (Some(self.laid(step.start)?), self.laid(step.end)?),
            _ => (None, self.laid(c)?),
        };
        let count = self.stretches();
        let lengths = self.stretch_lengths(&laid);
        let mut stretches = [Stretch::default(); MOST_SPANS];
        let passed = |grip: usize| c.memory[self.remembered_of(grip) + 2];
        for (k, own) in stretches[..count].iter_mut().enumerate() {
            let strain = self.strain + c.memory[self.remembered_of(k) + 3];
            *own = Stretch { free: self.free[k] + passed(k) - passed(k + 1), strain, length: lengths[k] };
        }
        let mut grips = [None; MOST_WHEELS];
        for (grip, own) in grips[..=count].iter_mut().enumerate() {
            let Some(seat) = self.seat_of(grip) else { continue };
            let from = match &before {
                Some(before) => before.angles[seat],
                None => [0, 1].map(|side| self.remembered_angle(seat, side, c)),
            };
            let way = self.way(seat, laid.angles[seat]) - self.way(seat, from);
            let hold = if self.is_end(seat) { Hold::Stick } else { self.hold.unwrap_or_default() };
            *own = Some(Grip { hold, way, wrap: self.wrap(seat, &laid) });
        }
        let tensions = Tensions::of(&stretches[..count], &grips[..=count]);
        let (mut start, mut ways) = ([0.0; MOST_SPANS], [0.0; MOST_SPANS]);
        if let Some(before) = &before {
            let lengths = self.stretch_lengths(before);
            (0..count).for_each(|k| start[k] = lengths[k] / stretches[k].free - 1.0);
            for span in 0..self.spans() {
                ways[self.stretch_of(span)] += self.reach(span, &laid) - self.reach(span, before);
            }
        }
        let mut own = Pull { laid, start, ways, tensions, pulls: [Tension::default(); MOST_SPANS], stretches, grips };
        self.set_pulls(&mut own, c, passage);
        Some(own)
    }

    /// Energy that drums give over a step with the rope that they pay out, J: it comes with its tension.
    pub fn given_by_drums(&self, own: &Pull) -> f64 {
        let count = self.stretches();
        let stiffness = self.elasticity.stiffness;
        let per_length = |k: usize| {
            let [start, end] = [own.start[k], own.tensions.strains[k]].map(|strain| strain.max(0.0));
            let mean = 0.5 * (start + end);
            let before = own.stretches[k].strain.max(0.0);
            stiffness * (mean * (before - mean) + 0.25 * (start * start + end * end))
        };
        // The tables have no grip where an end is a point.
        let of = |grip: usize, k: usize| own.tensions.passed[grip] * own.grips[grip].map_or(0.0, |_| per_length(k));
        of(0, 0) - of(count, count - 1)
    }

    fn set_pulls(&self, own: &mut Pull, c: &Configuration, passage: &Passage) {
        let count = self.stretches();
        let rates = match passage {
            Passage::Instant { velocity, .. } if self.elasticity.damping != 0.0 => {
                let change = self.change(c, velocity);
                own.slide_on(count, &change);
                own.tensions.strains_by(&own.stretches[..count], &own.grips[..=count], &change)
            }
            _ => [0.0; MOST_SPANS],
        };
        for (k, rate) in rates.iter().enumerate().take(count) {
            let end = own.tensions.strains[k];
            own.pulls[k] = match passage {
                Passage::Step(step) => self.elasticity.tension_over([own.start[k], end], step.duration),
                _ => self.elasticity.tension_at(end, *rate),
            };
        }
    }

    /// Rates of the stretches and grips at an instant.
    fn change(&self, c: &Configuration, velocity: &[f64]) -> Change {
        let mut change = Change::default();
        for span in 0..self.spans() {
            let Some(line) = self.line(span, c) else { continue };
            let [a, b] = self.poses(span, c);
            let rate = |weights: &line::Products| {
                let by_poses = line::by_poses(&a, &b, weights);
                self.pose_rates(span, c, velocity).dot(&by_poses)
            };
            self.add_change(span, rate(&line.reach_by), line.angles_by.each_ref().map(rate), &mut change);
        }
        change
    }

    /// How fast the poses of both sides of a span change.
    fn pose_rates(&self, span: usize, c: &Configuration, velocity: &[f64]) -> PairVector {
        let mut rates = PairVector::zeros();
        for (side, pose_q) in self.poses_q(span, c).iter().enumerate() {
            let marker = &self.seats[span + side].marker;
            let own = pose_q.times(&own_velocity(c, marker, velocity)) + marker.pose_t(c)[0].vectors();
            rates.fixed_columns_mut::<VECTORS>(VECTORS * side).copy_from(&own);
        }
        rates
    }

    /// Adds what a change of the reach of a span and of its two angles does to stretches and grips.
    fn add_change(&self, span: usize, reach: f64, angles: [f64; 2], change: &mut Change) {
        change.lengths[self.stretch_of(span)] += reach;
        // It leaves the first wheel and reaches the second one.
        for (seat, angle, sign) in [(span, angles[0], 1.0), (span + 1, angles[1], -1.0)] {
            let Some(grip) = self.grip_at(seat) else { continue };
            let wheel = &self.seats[seat].wheel;
            let way = wheel.signed() * self.share(seat) * angle;
            change.ways[grip] += way;
            change.wraps[grip] += if self.is_end(seat) { 0.0 } else { sign * wheel.turn * angle };
            if let Some(before) = grip.checked_sub(1) {
                change.lengths[before] += way;
            }
            if grip < self.stretches() {
                change.lengths[grip] -= way;
            }
        }
    }

    /// How the strains of all stretches change with the reach of a span and with its two angles.
    pub fn strains_by_span(&self, own: &Pull, span: usize) -> [[f64; MOST_SPANS]; 3] {
        let count = self.stretches();
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|[reach, leaves, reaches]| {
            // The angles of points, and those on wheels without a grip, do nothing.
            let is_idle = |seat: usize, angle: f64| angle != 0.0 && self.grip_at(seat).is_none();
            if is_idle(span, leaves) || is_idle(span + 1, reaches) {
                return [0.0; MOST_SPANS];
            }
            let mut change = Change::default();
            self.add_change(span, reach, [leaves, reaches], &mut change);
            own.tensions.strains_by(&own.stretches[..count], &own.grips[..=count], &change)
        })
    }

    /// Elastic energy with these tensions, J.
    pub fn energy(&self, own: &Pull) -> f64 {
        let Tensions { free, strains, .. } = &own.tensions;
        (0..self.stretches()).map(|k| self.elasticity.energy(free[k], strains[k])).sum()
    }

    /// Elastic energy at the start of a step with these tensions, J.
    pub fn energy_at_start(&self, own: &Pull) -> f64 {
        (0..self.stretches()).map(|k| self.elasticity.energy(own.stretches[k].free, own.start[k])).sum()
    }

    /// Sets what it remembers to the end of a passage with these tensions.
    pub fn remember(&self, own: &Pull, memory: &mut [f64]) {
        for (seat, Seat { drawn, .. }) in self.seats.iter().enumerate() {
            let first = self.remembered_of(seat);
            (0..2).for_each(|side| memory[first + side] = own.laid.angles[seat][side] - drawn[side]);
        }
        for grip in 0..=self.stretches() {
            memory[self.remembered_of(grip) + 2] += own.tensions.passed[grip];
        }
        for k in 0..self.stretches() {
            memory[self.remembered_of(k) + 3] = own.tensions.strains[k] - self.strain;
        }
    }

    /// How far the rope has slipped over a sheave since it was drawn, m, forward positive.
    pub fn slipped(&self, seat: usize, own: &Pull, c: &Configuration) -> f64 {
        let Some(grip) = self.grip_at(seat) else { return 0.0 };
        let passed = c.memory[self.remembered_of(grip) + 2] + own.tensions.passed[grip];
        passed + self.way(seat, own.laid.angles[seat]) - self.way(seat, self.seats[seat].drawn)
    }
}
