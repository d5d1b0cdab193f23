//! The energy of a run against the work of all that acts from outside: gravity, loads, drives, moving frames and
//! dampers.
//!
//! Kinetic and elastic energy may change by that work only. What they change by beyond it, the drift, is the
//! integrator's: some thousandths of the energy where the step resolves the motion, and without bound where it does
//! not. Every internal step is accounted for, so that nothing hides between two rows of the results.

use super::energy_account::{EnergyAccount, Work};
use serde::{Deserialize, Serialize};

/// Share of the largest energy by which the energy may drift. The midpoint rules keep it within some thousandths where
/// the step resolves the motion.
const BAND: f64 = 0.02;

/// Share of the largest energy that numerical damping may take unnoticed: it is there to take what the step does not
/// resolve.
const DAMPED_BAND: f64 = 0.05;

/// Steps after which a drift that was beyond its band is judged: of the first, tiny energy of a smooth or a sudden
/// start nearly all may come from nowhere or go, and does not matter once the motion has grown. A drift counts if it is
/// large beside the energy by then, or at the end of the run; a loss to numerical damping if it has been so in all
/// these steps.
const LASTING: u32 = 200;

/// Share of the energy that has passed through the system by which the sums of the work may be off: the middle or the
/// ends of a step stand for all of it.
const THROUGHPUT: f64 = 5e-3;

/// The same for a loss where the integrator damps by itself: what dampers take is then counted at the smaller of the
/// powers at both ends of a step.
const DAMPED_THROUGHPUT: f64 = 0.1;

/// Share of the work of a single step by which it may be off, and what is left of that allowance after another step: a
/// motion that grows many times within some steps, from nearly nothing, has an error of that size, which does not
/// matter once it has grown.
const SINGLE_STEP: f64 = 0.5;
const FADING: f64 = 0.98;

/// Steps that a jump of velocities takes until forces are those of the motion again: the midpoint rules have half of it
/// left after one.
const JUMP_STEPS: u32 = 4;

/// Share of the work of lifting the whole system by its size that is round-off: of a system that hangs at rest nothing
/// else moves.
pub const LIFT_ROUND_OFF: f64 = 1e-9;

/// Energy that a molecule has by its warmth, J: what a system has below it is the round-off of nothing.
const THERMAL: f64 = 4e-21;

/// Kinetic and elastic energy of a state, J.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Energies {
    /// `vᵀ M v / 2`.
    pub kinetic: f64,
    /// Strain energy of beams and energy of springs.
    pub elastic: f64,
}

/// What the integrator may take out of the energy by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Losses {
    /// Nothing.
    None,
    /// What the step does not resolve; the work of dampers is known as the step takes their forces.
    Numerical,
    /// What the step does not resolve; the work of dampers is known by their power at the ends of the step.
    NumericalAtInstants,
}

/// The account of a run, as plain data.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    /// Energies at the end of the last step; none before the first step, and after a change of stiffnesses.
    pub last: Option<Energies>,
    /// Power of what acts from outside, and of dampers, which take it, at the end of the last step, W; of integrators
    /// that take forces at instants.
    pub power: [f64; 2],
    /// By what the energy has changed beyond the work, J.
    drift: f64,
    /// Sum of the sizes of the work of all steps, J.
    throughput: f64,
    /// By how much the work may be off where it is known by its power at the ends of steps, J.
    doubt: f64,
    /// Largest work of a single step, J, fading from step to step.
    peak: f64,
    /// Largest sum of kinetic and elastic energy so far, J.
    largest: f64,
    /// How many of the next steps are left out of the account.
    skipped: u32,
    /// In how many of the next steps a drive's jump is still at work.
    struck: u32,
    /// Steps in a row, up to the last one, for which the loss to numerical damping has been beyond its band.
    damped_steps: u32,
    /// A drift that was beyond its band, no loss to numerical damping, and is still to be judged.
    suspect: Option<Suspect>,
    /// Where the drift had first lasted.
    alarm: Option<Alarm>,
    /// The work by its origin; none: nobody asks for it.
    pub account: Option<EnergyAccount>,
}

/// A drift that cannot be the step's usual error.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Alarm {
    /// When the drift left its band, s.
    pub time: f64,
    /// The drift then, J.
    pub drift: f64,
    /// The largest energy until then, J.
    pub largest: f64,
}

/// A drift beyond its band that is still to be judged.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Suspect {
    /// Where it left its band.
    first: Alarm,
    /// Steps since then.
    steps: u32,
    /// The largest drift beyond its band since then, J.
    most: f64,
}

impl EnergyBalance {
    /// Accounts for a step to `time`, s, over which what acts from outside did `work`, J, and at whose end the system
    /// has `energies`. `noise` is what round-off may add up to, J; `losses` what the integrator may take.
    pub fn account(&mut self, time: f64, work: f64, energies: Energies, noise: f64, losses: Losses) {
        let total = energies.kinetic + energies.elastic;
        let before = self.last.map_or(total, |last| last.kinetic + last.elastic);
        self.last = Some(energies);
        if self.skipped > 0 {
            self.skipped -= 1;
            self.largest = self.largest.max(total);
            return;
        }
        self.drift += total - before - work;
        self.throughput += work.abs();
        self.peak = (FADING * self.peak).max(work.abs());
        self.largest = self.largest.max(total).max(before);
        let damps = losses != Losses::None && self.drift < 0.0;
        let (share, passed) = match losses {
            Losses::Numerical if damps => (DAMPED_BAND, THROUGHPUT),
            Losses::NumericalAtInstants if damps => (DAMPED_BAND, DAMPED_THROUGHPUT),
            _ => (BAND, THROUGHPUT),
        };
        let known = share * self.largest + passed * self.throughput + SINGLE_STEP * self.peak;
        let band = known + self.doubt + noise + THERMAL;
        let is_beyond = self.drift.abs() > band;
        let now = Alarm { time, drift: self.drift, largest: self.largest };
        self.damped_steps = if damps && is_beyond { self.damped_steps.saturating_add(1) } else { 0 };
        if self.damped_steps >= LASTING {
            self.alarm = self.alarm.or(Some(now));
        }
        if let Some(suspect) = &mut self.suspect {
            suspect.steps += 1;
            if is_beyond && !damps {
                suspect.most = suspect.most.max(self.drift.abs());
            }
        } else if is_beyond && !damps {
            self.suspect = Some(Suspect { first: now, steps: 0, most: self.drift.abs() });
        }
        if self.suspect.is_some_and(|suspect| suspect.steps >= LASTING) {
            self.alarm = self.at_end();
            self.suspect = None;
        }
    }

    /// The work of a step of `step` s by the power at its start and `power` at its end, W, J. Where the power jumps, as
    /// of a drive that stops at once, the work may be anything between those of the two.
    pub fn work_by_power(&mut self, power: f64, step: f64) -> f64 {
        self.doubt += 0.5 * step * (power - self.power[0]).abs();
        0.5 * step * (self.power[0] + power)
    }

    /// Doubts the work of a step, of which two estimates differ by `difference`, J.
    pub fn add_doubt(&mut self, difference: f64) {
        self.doubt += difference.abs();
    }

    /// Takes the next steps out of the account: velocities jump with a drive at the end of the first, and what the
    /// drive does at an instant is no power. The forces of the steps behind it make up for it.
    pub fn skip_jump(&mut self) {
        self.skipped = JUMP_STEPS;
    }

    /// Says that a drive's rate jumps at the end of the step that is accounted for next.
    pub fn strike(&mut self) {
        self.struck = JUMP_STEPS;
    }

    /// Adds the `work` of a step to the account by origin, if somebody asks for it; the energy of the system, of
    /// gravity too, has gone from `start` to `end`, J.
    pub fn add_work(&mut self, work: &Work, [start, end]: [f64; 2]) {
        let is_struck = self.struck > 0;
        self.struck = self.struck.saturating_sub(1);
        let Some(account) = &mut self.account else { return };
        account.work.add(work, 1.0);
        // What a drive does when its rate jumps is no power, but its work.
        *(if is_struck { &mut account.work.drives } else { &mut account.drift }) += end - start - work.sum();
        account.energy = Some(end);
    }

    /// By what the energy has changed so far beyond the work, J: what the integrator adds or takes.
    pub fn drift(&self) -> f64 {
        self.drift
    }

    /// The alarm, if there has been one.
    pub fn alarm(&self) -> Option<Alarm> {
        self.alarm
    }

    /// The alarm of a run that ends now: the one that there has been, or a drift that has not been judged yet.
    pub fn at_end(&self) -> Option<Alarm> {
        self.alarm.or_else(|| {
            let Suspect { first, most, .. } = self.suspect?;
            // Energy that came from nowhere is no measure of it.
            let band = BAND * (self.largest - most) + THROUGHPUT * self.throughput;
            (most > band).then_some(first)
        })
    }

    /// Forgets the energies of the last step: stiffnesses have been set from outside, which is no step's doing.
    pub fn forget_last(&mut self) {
        self.last = None;
        if let Some(account) = &mut self.account {
            account.energy = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn energies(kinetic: f64) -> Energies {
        Energies { kinetic, elastic: 0.0 }
    }

    /// Energy that work accounts for raises no alarm, however much; a hundredth of it beyond the band does.
    #[test]
    fn only_drift_raises_an_alarm() {
        let mut balance = EnergyBalance { last: Some(energies(1.0)), ..EnergyBalance::default() };
        balance.account(1.0, 9.0, energies(10.0), 0.0, Losses::None);
        assert_eq!(balance.alarm(), None);
        // The allowance for that one step fades.
        (0..1000).for_each(|_| balance.account(1.5, 0.0, energies(10.0), 0.0, Losses::None));
        balance.account(2.0, 0.0, energies(10.0 + 0.19), 0.0, Losses::None);
        assert_eq!(balance.at_end(), None);
        balance.account(3.0, 0.0, energies(10.0 + 0.35), 0.0, Losses::None);
        assert_eq!(balance.alarm(), None);
        assert!(balance.at_end().is_some_and(|alarm| alarm.time == 3.0 && (alarm.drift - 0.35).abs() < 1e-12));
        (0..2 * LASTING).for_each(|_| balance.account(4.0, 0.0, energies(10.0), 0.0, Losses::None));
        assert!(balance.alarm().is_some_and(|alarm| alarm.time == 3.0));
    }

    /// Of a smooth start all of the first energy may come from nowhere: it is nothing beside that of the motion.
    #[test]
    fn a_small_beginning_raises_no_alarm() {
        let mut balance = EnergyBalance { last: Some(energies(0.0)), ..EnergyBalance::default() };
        (0..10).for_each(|number| balance.account(1e-3, 0.0, energies(1e-12 * f64::from(number)), 0.0, Losses::None));
        assert!(balance.at_end().is_some());
        balance.account(1.0, 675.0, energies(675.0), 0.0, Losses::None);
        (0..1000).for_each(|_| balance.account(2.0, 0.0, energies(675.0), 0.0, Losses::None));
        assert_eq!(balance.at_end(), None);
    }

    /// A power that jumps from one end of a step to the other says nothing of the work between: energy that does not
    /// follow it is not lost. Energy that falls without any power is.
    #[test]
    fn work_by_jumping_power_is_doubted() {
        for (power, kinetic, alarms) in [(400.0, 1.0, false), (0.0, 0.8, true)] {
            let mut balance = EnergyBalance { last: Some(energies(1.0)), ..EnergyBalance::default() };
            let work = balance.work_by_power(power, 1e-3);
            balance.account(1.0, work, energies(kinetic), 0.0, Losses::NumericalAtInstants);
            for _ in 0..2 * LASTING {
                balance.account(2.0, 0.0, energies(kinetic), 0.0, Losses::NumericalAtInstants);
            }
            assert_eq!(balance.alarm().is_some(), alarms, "{power} {kinetic}");
        }
    }

    /// A loss may be twice as large and more where the integrator damps, but not without bound.
    #[test]
    fn numerical_damping_may_take_a_share() {
        use Losses::{None, Numerical, NumericalAtInstants};
        for (losses, kinetic, alarms) in
            [(Numerical, 0.96, false), (NumericalAtInstants, 0.96, false), (None, 0.96, true), (Numerical, 0.9, true)]
        {
            let mut balance = EnergyBalance { last: Some(energies(1.0)), ..EnergyBalance::default() };
            balance.account(0.5, 0.0, energies(1.0), 0.0, losses);
            (0..2 * LASTING).for_each(|_| balance.account(1.0, 0.0, energies(kinetic), 0.0, losses));
            assert_eq!(balance.alarm().is_some(), alarms, "{losses:?} {kinetic}");
        }
    }
}
