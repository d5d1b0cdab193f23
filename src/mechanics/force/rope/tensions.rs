//! The tensions of a rope, and how it slips over its sheaves (MECHANICS 3.15).
//!
//! A stretch is rope of one tension: a span, or all spans between two grips. Its length `λ` holds its spans, the arcs
//! on wheels without friction, and half of each arc on the grips at its ends. With the free length `S` its tension is
//! `T = EA (λ/S − 1)`, never negative. A grip is a sheave with friction, or a drum. The free rope `z` that passes it
//! from the stretch before it to the one behind it follows from the turn of the wheel while it sticks. It slips where
//! the ratio of both tensions would exceed `exp(μθ)`, and holds that ratio then.

use crate::math::elementary::exp;
use crate::mechanics::force::law::{Law, LawForce};

/// Most wheels of a rope.
pub const MOST_WHEELS: usize = 18;
/// Most spans, and most stretches.
pub const MOST_SPANS: usize = MOST_WHEELS - 1;

/// Most changes between sticking and sliding for each grip before the last one stands.
const MOST_SWEEPS: usize = 3;
/// Most iterations of the ratios of tensions.
const MOST_ITERATIONS: usize = 20;
/// Change of the rope that passed, over its length, that ends them: the next one would be round-off.
const CONVERGED: f64 = 1e-12;
/// Share of its slope that a slack stretch keeps: between two of them it would be left open how much each one gives.
const OF_SLACK: f64 = 1e-3;
/// Share by which a ratio of tensions may exceed its bound: round-off.
const ROUND_OFF: f64 = 1e-9;

/// A rope's elasticity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elasticity {
    /// Tension over strain, N.
    pub stiffness: f64,
    /// Tension over the rate of the strain, N s.
    pub damping: f64,
}

/// A tension, N.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tension {
    /// Its value; never negative.
    pub value: f64,
    /// Its derivative with respect to the strain.
    pub by_strain: f64,
    /// Its derivative with respect to the rate of the strain, N s.
    pub by_rate: f64,
}

impl Tension {
    fn of(force: &LawForce) -> Self {
        let value = force.elastic + force.viscous;
        // It never pushes: its damper takes what the rope gives.
        if value > 0.0 { Self { value, by_strain: force.by_x, by_rate: force.by_v } } else { Self::default() }
    }
}

/// How a grip holds the rope.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hold {
    /// It never slips.
    #[default]
    Stick,
    /// Friction with this coefficient.
    Friction(f64),
}

/// A stretch.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stretch {
    /// Free length before the step, m.
    pub free: f64,
    /// Strain before it.
    pub strain: f64,
    /// Length at its end, m.
    pub length: f64,
}

/// A grip, by its number between the stretches: grip `k` stands before stretch `k` and behind stretch `k − 1`; a drum
/// at an end of the rope has one of them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Grip {
    /// How it holds the rope.
    pub hold: Hold,
    /// Way of its surface along the rope, m: against the sense of the rope, as `−z` of a rope that sticks.
    pub way: f64,
    /// Wrap angle, rad.
    pub wrap: f64,
}

/// The tensions of all stretches.
#[derive(Clone, Copy, Debug)]
pub struct Tensions {
    /// Number of stretches.
    pub count: usize,
    /// Free lengths, m.
    pub free: [f64; MOST_SPANS],
    /// Strains.
    pub strains: [f64; MOST_SPANS],
    /// Free rope that passed each grip, m; grips as [`Grip`] counts them.
    pub passed: [f64; MOST_WHEELS],
    /// Slip over each grip, m.
    pub slips: [f64; MOST_WHEELS],
    /// The action of each grip.
    moves: [Move; MOST_WHEELS],
}

/// The action of a grip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Move {
    /// There is none, or it sticks.
    #[default]
    Sticks,
    /// The rope slips forward: the stretch behind it pulls more.
    Forward,
    /// The rope slips backward.
    Backward,
}

/// How a strain depends on what a rope is drawn over.
#[derive(Clone, Copy, Debug, Default)]
pub struct Change {
    /// Change of the lengths of stretches, m.
    pub lengths: [f64; MOST_SPANS],
    /// Change of the ways of grips, m.
    pub ways: [f64; MOST_WHEELS],
    /// Change of the wrap angles, rad.
    pub wraps: [f64; MOST_WHEELS],
}

/// A tridiagonal system in the rope that passes each grip: rows `before, own, behind`.
struct Chain {
    rows: [[f64; 3]; MOST_WHEELS],
    right: [f64; MOST_WHEELS],
}

impl Chain {
    fn identity() -> Self {
        Self { rows: [[0.0, 1.0, 0.0]; MOST_WHEELS], right: [0.0; MOST_WHEELS] }
    }

    /// Solves the first `count` rows.
    fn solve(mut self, count: usize) -> [f64; MOST_WHEELS] {
        for k in 1..count {
            let factor = self.rows[k][0] / self.rows[k - 1][1];
            self.rows[k][1] -= factor * self.rows[k - 1][2];
            self.right[k] -= factor * self.right[k - 1];
        }
        let mut found = [0.0; MOST_WHEELS];
        for k in (0..count).rev() {
            let behind = if k + 1 < count { self.rows[k][2] * found[k + 1] } else { 0.0 };
            found[k] = (self.right[k] - behind) / self.rows[k][1];
        }
        found
    }
}

impl Elasticity {
    fn law(&self) -> Law {
        Law::OneSided { sign: 1.0, stiffness: self.stiffness, damping: self.damping }
    }

    /// Tension at a strain and its rate.
    pub fn tension_at(&self, strain: f64, rate: f64) -> Tension {
        Tension::of(&self.law().at(strain, rate))
    }

    /// Mean tension over the way from the strain `start` to `end` in `duration` s; it changes with the strain `end`.
    pub fn tension_over(&self, [start, end]: [f64; 2], duration: f64) -> Tension {
        let own = Tension::of(&self.law().over(start, end, (end - start) / duration));
        Tension { by_strain: own.by_strain + own.by_rate / duration, ..own }
    }

    /// Elastic energy of a stretch, J.
    pub fn energy(&self, free: f64, strain: f64) -> f64 {
        0.5 * self.stiffness * free * strain.max(0.0).powi(2)
    }
}

impl Tensions {
    /// Finds the tensions of `stretches` between `grips`, of which there is one more; none where its entry is none.
    pub fn of(stretches: &[Stretch], grips: &[Option<Grip>]) -> Self {
        let count = stretches.len();
        let mut own = Self {
            count,
            free: [1.0; MOST_SPANS],
            strains: [0.0; MOST_SPANS],
            passed: [0.0; MOST_WHEELS],
            slips: [0.0; MOST_WHEELS],
            moves: [Move::Sticks; MOST_WHEELS],
        };
        for (k, grip) in grips.iter().enumerate() {
            let Some(grip) = grip else { continue };
            own.passed[k] = -grip.way / own.drawn_out(k, stretches);
            if grip.hold == Hold::Friction(0.0) {
                own.moves[k] = Move::Forward;
            }
        }
        for _ in 0..MOST_SWEEPS * grips.len() {
            own.settle(stretches, grips);
            if !own.switch(stretches, grips) {
                break;
            }
        }
        own
    }

    /// One plus the mean strain before the step of the stretches at grip `k`.
    fn drawn_out(&self, k: usize, stretches: &[Stretch]) -> f64 {
        let strain = |stretch: Option<&Stretch>| stretch.map(|own| own.strain.max(0.0));
        let (before, behind) = (strain(k.checked_sub(1).and_then(|k| stretches.get(k))), strain(stretches.get(k)));
        1.0 + match (before, behind) {
            (Some(before), Some(behind)) => 0.5 * (before + behind),
            (one, other) => one.or(other).unwrap_or(0.0),
        }
    }

    /// Sets free lengths and strains by the rope that passed.
    fn set_strains(&mut self, stretches: &[Stretch]) {
        for (k, stretch) in stretches.iter().enumerate() {
            self.free[k] = stretch.free + self.passed[k] - self.passed[k + 1];
            self.strains[k] = stretch.length / self.free[k] - 1.0;
        }
    }

    /// Lets the rope pass until both tensions of each grip that slides have their ratio.
    fn settle(&mut self, stretches: &[Stretch], grips: &[Option<Grip>]) {
        self.set_strains(stretches);
        if self.moves.iter().all(|own| *own == Move::Sticks) {
            return;
        }
        let whole: f64 = stretches.iter().map(|own| own.length).sum();
        for _ in 0..MOST_ITERATIONS {
            let mut chain = self.chain(stretches, grips);
            for (k, grip) in grips.iter().enumerate() {
                let Some([before, behind]) = self.factors(k, grip.as_ref()) else { continue };
                let tension = |k: usize| self.strains[k].max(0.0);
                chain.right[k] = before * tension(k - 1) - behind * tension(k);
            }
            let change = chain.solve(grips.len());
            let largest = change.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
            self.passed.iter_mut().zip(change).for_each(|(passed, change)| *passed += change);
            self.set_strains(stretches);
            if largest <= CONVERGED * whole {
                break;
            }
        }
    }

    /// The factors of the tensions before and behind a grip that slides, which are equal times these.
    fn factors(&self, k: usize, grip: Option<&Grip>) -> Option<[f64; 2]> {
        let Hold::Friction(coefficient) = grip?.hold else { return None };
        let ratio = exp(coefficient * grip?.wrap.max(0.0));
        match self.moves[k] {
            Move::Sticks => None,
            Move::Forward => Some([ratio, 1.0]),
            Move::Backward => Some([1.0, ratio]),
        }
    }

    /// The derivative of `behind · ε_k − before · ε_{k−1}` by the rope that passes, where a grip slides; that of the
    /// rope itself where it sticks.
    fn chain(&self, stretches: &[Stretch], grips: &[Option<Grip>]) -> Chain {
        let mut chain = Chain::identity();
        // Strains fall with more rope in a stretch.
        let fall = |k: usize| {
            let share = if self.strains[k] < 0.0 { OF_SLACK } else { 1.0 };
            share * stretches[k].length / (self.free[k] * self.free[k])
        };
        for (k, grip) in grips.iter().enumerate() {
            let Some([before, behind]) = self.factors(k, grip.as_ref()) else { continue };
            let (first, second) = (before * fall(k - 1), behind * fall(k));
            chain.rows[k] = [first, -(first + second), second];
        }
        chain
    }

    /// Lets grips begin and end to slide; returns whether one did.
    fn switch(&mut self, stretches: &[Stretch], grips: &[Option<Grip>]) -> bool {
        let mut has_changed = false;
        for (k, grip) in grips.iter().enumerate() {
            let Some(grip) = grip else { continue };
            self.slips[k] = self.passed[k] * self.drawn_out(k, stretches) + grip.way;
            let Hold::Friction(coefficient) = grip.hold else { continue };
            if coefficient == 0.0 {
                continue;
            }
            let [before, behind] = [k - 1, k].map(|k| self.strains[k].max(0.0));
            let ratio = exp(coefficient * grip.wrap.max(0.0)) * (1.0 + ROUND_OFF);
            let next = match self.moves[k] {
                Move::Sticks if behind > ratio * before => Move::Forward,
                Move::Sticks if before > ratio * behind => Move::Backward,
                Move::Forward if self.slips[k] < 0.0 => Move::Sticks,
                Move::Backward if self.slips[k] > 0.0 => Move::Sticks,
                same => same,
            };
            if next != self.moves[k] {
                has_changed = true;
                self.moves[k] = next;
                if next == Move::Sticks {
                    self.passed[k] = -grip.way / self.drawn_out(k, stretches);
                }
            }
        }
        has_changed
    }

    /// Lets the same grips slide as in `other`.
    pub fn move_as(&mut self, other: &Self) {
        self.moves = other.moves;
    }

    /// How the strains change with `change`.
    pub fn strains_by(&self, stretches: &[Stretch], grips: &[Option<Grip>], change: &Change) -> [f64; MOST_SPANS] {
        let mut chain = self.chain(stretches, grips);
        let by_length = |k: usize| change.lengths[k] / self.free[k];
        for (k, grip) in grips.iter().enumerate() {
            let Some(own) = grip else { continue };
            let Some([before, behind]) = self.factors(k, Some(own)) else {
                chain.right[k] = -change.ways[k] / self.drawn_out(k, stretches);
                continue;
            };
            let taut = |k: usize| if self.strains[k] < 0.0 { OF_SLACK } else { 1.0 };
            let Hold::Friction(coefficient) = own.hold else { continue };
            let wrap = if own.wrap > 0.0 { coefficient * change.wraps[k] } else { 0.0 };
            let [by_before, by_behind] = match self.moves[k] {
                Move::Forward => [before * wrap * self.strains[k - 1].max(0.0), 0.0],
                _ => [0.0, behind * wrap * self.strains[k].max(0.0)],
            };
            chain.right[k] =
                before * taut(k - 1) * by_length(k - 1) + by_before - behind * taut(k) * by_length(k) - by_behind;
        }
        let passed = chain.solve(grips.len());
        let mut found = [0.0; MOST_SPANS];
        for k in 0..self.count {
            let fall = stretches[k].length / (self.free[k] * self.free[k]);
            found[k] = by_length(k) - fall * (passed[k] - passed[k + 1]);
        }
        found
    }
}
