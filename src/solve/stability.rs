//! Whether an equilibrium is stable: whether the softest motion that the constraints allow takes energy, by the lowest eigenvalue of
//! stiffness against mass. Followed along a static path, its sign changes where the path buckles.
//!
//! The block of subspace.rs goes through the factorization that Newton leaves, and goes on from the last equilibrium's motions, so
//! that a sweep or two tell. That factorization is of the iterate before the last; what seems to change is asked of the equilibrium itself. Beyond a change of sign it goes through `K + μ M`, with `μ` beyond the most unstable motion known: only
//! what has become stiff again is then called stable again.

use super::kkt::Kkt;
use super::modes::{self, Kind};
use super::subspace::Subspace;
use crate::mechanics::sensor::Snapshot;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// Vectors: two motions that become unstable at once, as a round strut's, and two to keep the others away.
const BLOCK: usize = 4;
/// Most sweeps for an equilibrium.
const MOST_SWEEPS: usize = 20;
/// Error of a vector at which its eigenvalue, which has the square of it, is known.
const ACCURATE: f64 = 1e-2;
/// Error up to which a vector tells anything.
const ROUGH: f64 = 0.1;
/// `μ` as a multiple of the most unstable eigenvalue known.
const SHIFT_BEYOND: f64 = 2.0;

/// What is known of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// Its time, s.
    pub time: f64,
    /// Lowest eigenvalue, 1/s².
    pub lowest: f64,
    /// How many vectors of the block are unstable motions.
    pub unstable: usize,
    /// The vector of the lowest eigenvalue in the block.
    vector: usize,
}

/// Follows the softest motions along a path of equilibria. Scratch memory, but for remarks that are not taken yet.
#[derive(Debug, Default)]
pub struct Stability {
    block: Subspace,
    known: Option<Judgement>,
    remarks: Vec<String>,
}

impl Stability {
    /// What is known of the last equilibrium judged.
    pub fn known(&self) -> Option<Judgement> {
        self.known
    }

    /// Judges the equilibrium of `time`, s, whose factorization `kkt` has, without a path that leads to it.
    pub fn begin(&mut self, system: &System, kkt: &mut Kkt, time: f64) {
        self.block = Subspace::new(system, BLOCK.min(system.coordinates().saturating_sub(system.constraints())));
        self.go_on(system, kkt, time, None);
    }

    /// Judges the equilibrium of `time`, s, whose factorization `kkt` has (afterwards perhaps another one), next to one of which
    /// `before` is known.
    pub fn go_on(&mut self, system: &System, kkt: &mut Kkt, time: f64, before: Option<Judgement>) {
        let shift = before.map_or(0.0, |before| f64::max(-SHIFT_BEYOND * before.lowest, 0.0));
        self.known = self.judgement(system, kkt, time, shift);
    }

    /// Whether the last equilibrium judged is unstable and the one of `before` is not, or the other way round.
    pub fn differs(&self, before: Option<Judgement>) -> bool {
        self.known.zip(before).is_some_and(|(now, before)| (now.unstable == 0) != (before.unstable == 0))
    }

    /// Remarks what has changed on the way to `state`, the last equilibrium judged; of the first one, without `before`, only that it
    /// is unstable.
    pub fn remark(&mut self, system: &System, state: &State, before: Option<Judgement>) {
        let Some(now) = self.known else { return };
        let moved = self.moved(system, state, now.vector);
        let Some(before) = before else {
            if now.unstable > 0 {
                self.remarks.push(format!(
                    "the equilibrium of t = {} s is unstable: what would leave it moves most at {moved}; a small imperfection shows the \
                     stable ones",
                    now.time
                ));
            }
            return;
        };
        if !self.differs(Some(before)) {
            return;
        }
        let critical = before.time + (now.time - before.time) * before.lowest / (before.lowest - now.lowest);
        let when = format!("between t = {} s and {} s, by interpolation at t = {critical:.6} s", before.time, now.time);
        let ways = if now.unstable > 1 { format!(", in {} ways at once", now.unstable) } else { String::new() };
        self.remarks.push(if now.unstable == 0 {
            format!("the equilibrium becomes stable again {when}")
        } else {
            format!(
                "the equilibrium becomes unstable {when}{ways}: what buckles moves most at {moved}; the equilibria found beyond are \
                 unstable, a small imperfection shows the buckled ones"
            )
        });
    }

    /// What there is to be told, once.
    pub fn take_remarks(&mut self) -> Vec<String> {
        std::mem::take(&mut self.remarks)
    }

    /// What vector `vector` of the block moves most at `state`.
    fn moved(&self, system: &System, state: &State, vector: usize) -> String {
        let mut snapshot = Snapshot::default();
        system.most_moved(&snapshot.of(system, state), &self.block.vectors()[vector]).what
    }

    /// Sweeps until the lowest eigenvalue is known, through `K + shift M`; none where that gives no solutions.
    fn judgement(&mut self, system: &System, kkt: &mut Kkt, time: f64, shift: f64) -> Option<Judgement> {
        if shift > 0.0 {
            system.add_mass(shift, &mut kkt.blocks);
            kkt.factorize(system, time).ok()?;
        }
        let mut known = None;
        for _ in 0..MOST_SWEEPS {
            let ritz = self.block.sweep(system, kkt).ok()?;
            let vectors = self.block.vectors();
            let told = ritz.iter().enumerate().filter(|(_, ritz)| ritz.error < ROUGH);
            let values = told.map(|(vector, ritz)| (vector, 1.0 / ritz.inverse - shift, ritz.error));
            let unstable = values
                .clone()
                .filter(|own| modes::kind(&kkt.blocks, &vectors[own.0], own.1, 0.0) == Kind::Unstable)
                .count();
            let lowest = values.min_by(|a, b| a.1.total_cmp(&b.1));
            known = lowest.map(|(vector, lowest, _)| Judgement { time, lowest, vector, unstable });
            if lowest.is_some_and(|(_, _, error)| error < ACCURATE) {
                break;
            }
        }
        known
    }
}
