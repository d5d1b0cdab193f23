//! The reference of a machine, by refinement: it is accepted, family by family, as far as its two finest levels agree.

use super::family::Family;
use super::machine::{Machine, Setting};
use super::run::{End, Record};
use super::warning;

/// Levels of refinement, the first two of which are always run: where two levels do not agree to the end, the next one
/// is tried.
const LEVELS: [u32; 3] = [4, 8, 16];
/// How near the two finest levels must be, of the family's scale: a fifth of what is called right, so that the
/// reference is no part of the judgement.
pub const AGREEMENT: f64 = 2e-3;
/// The fewest rows behind the start that are worth a comparison.
const FEWEST_ROWS: usize = 4;
/// Internal steps times elements of a level, above which it is too dear for a campaign.
const DEAREST: f64 = 600_000.0;

/// What a machine does, as far as is known.
#[derive(Debug)]
pub struct Reference {
    /// The finest level.
    pub record: Record,
    /// Families, each with the number of its first rows in which the reference is known; 0: nothing is.
    pub families: Vec<(Family, usize)>,
    /// Rows that a complete run has.
    pub rows: usize,
}

impl Reference {
    /// Runs levels until two agree.
    ///
    /// # Errors
    /// Nothing is known: the sentence says why.
    pub fn new(machine: &Machine) -> Result<Self, String> {
        let mut coarser: Option<Record> = None;
        let mut best: Option<Self> = None;
        for (place, level) in LEVELS.into_iter().enumerate() {
            let setting = Setting::Finer(level);
            let text = machine.text(setting).ok_or("a joint names a node that a finer mesh does not have")?;
            if place > 1 && price(machine, setting, &text) > DEAREST {
                break;
            }
            let record = Record::new(machine, setting, &text);
            if let Some(coarser) = coarser.replace(record.clone()) {
                let reference = Self::of(machine, &coarser, record);
                let is_known = reference.families.iter().all(|(_, rows)| *rows >= reference.rows);
                let is_better = best.as_ref().is_none_or(|best| reference.known() >= best.known());
                best = if is_better { Some(reference) } else { best };
                if is_known {
                    break;
                }
            }
        }
        match best {
            Some(best) if best.known() > 0 => Ok(best),
            Some(best) => Err(best.objection()),
            None => Err(String::from("there are not two levels")),
        }
    }

    /// Why nothing is known.
    fn objection(&self) -> String {
        let Record { end, warnings, .. } = &self.record;
        match (end, warnings.iter().find(|warning| warning::doubts_the_steps(std::slice::from_ref(warning)))) {
            (End::Refused(reason) | End::Panicked(reason), _) => format!("the finest level ended: {reason}"),
            (End::Endless, _) => String::from("the finest level has no end"),
            (End::Complete, Some(warning)) => format!("the finest level warns: {warning}"),
            (End::Complete, None) => String::from("the two finest levels differ from the start"),
        }
    }

    /// The reference of two levels.
    fn of(machine: &Machine, coarse: &Record, record: Record) -> Self {
        let rows = ((machine.stop() - machine.start) / machine.output_step() - 1e-9).ceil() as usize + 1;
        let trusted =
            if warning::doubts_the_steps(&record.warnings) { 0 } else { record.rows.len().min(coarse.rows.len()) };
        let known = |family: Family| {
            let rows = agreeing(&family, coarse, &record, trusted);
            (family, if rows > FEWEST_ROWS { rows } else { 0 })
        };
        let families = Family::all(&record.columns).into_iter().map(known).collect();
        Self { families, rows, record }
    }

    /// Rows that are known, of all families.
    fn known(&self) -> usize {
        self.families.iter().map(|(_, rows)| rows).sum()
    }

    /// Share of all results that is known.
    pub fn share(&self) -> f64 {
        self.known() as f64 / (self.families.len() * self.rows) as f64
    }
}

/// How many of the first `most` rows agree. The scale is that of these rows: what happens behind them, where nobody
/// knows it, must not hide what happens before.
fn agreeing(family: &Family, coarse: &Record, fine: &Record, most: usize) -> usize {
    let mut rows = most;
    loop {
        if rows == 0 {
            return 0;
        }
        let bound = AGREEMENT * family.scale(fine, rows);
        let (mut off, mut agreeing) = (0, 0);
        for (count, ((_, own), (_, other))) in (1..).zip(coarse.rows.iter().zip(&fine.rows).take(rows)) {
            // A difference that is no number is off, too.
            let difference = family.difference(own, other);
            off += usize::from(difference > bound || difference.is_nan());
            if off as f64 <= family.share() * f64::from(count) {
                agreeing = count as usize;
            }
        }
        if agreeing == rows {
            return rows;
        }
        rows = agreeing;
    }
}

/// What a run costs, in steps times elements.
fn price(machine: &Machine, setting: Setting, text: &str) -> f64 {
    let elements: u32 = super::edit::meshes(text).into_iter().map(|(_, elements)| elements).sum();
    (machine.stop() - machine.start) / setting.step(machine) * f64::from(elements + 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn agreeing_rows(coarse: &[f64], fine: &[f64]) -> usize {
        let record =
            |values: &[f64]| Record::sample(&[("tip.velocity[1]", "m/s")], values.iter().map(|value| vec![*value]));
        let (coarse, fine) = (record(coarse), record(fine));
        let family = Family::all(&fine.columns).remove(0);
        agreeing(&family, &coarse, &fine, fine.rows.len())
    }

    /// Two levels agree until they part, and what is large behind that hides no difference before it.
    #[test]
    fn levels_agree_until_they_part() {
        assert_eq!(agreeing_rows(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.001, 2.001, 3.001]), 4);
        assert_eq!(agreeing_rows(&[0.0, 1.0, 2.0, 3.0, 4.0], &[0.0, 1.0, 2.0, 3.1, 4.0]), 3);
        assert_eq!(agreeing_rows(&[0.0, 1.0, 1.1, 0.0], &[0.0, 1.0, 1.0, 1e6]), 2);
        assert_eq!(agreeing_rows(&[0.0, 1.0, f64::NAN], &[0.0, 1.0, 1.0]), 2);
    }
}
