//! Quantities that are zero but for round-off: pictures show them as zero, because noise is not a curve.

use super::recorder::{Recording, Track};
use super::stations::RESULTS;
use crate::model::run::scale::{Measures, Span, family};
use std::collections::BTreeMap;

/// All values of one column, with its name and unit.
pub type Values<'a> = (&'a str, &'a str, &'a [f64]);

impl Recording {
    /// Whether each of these columns is a component of a quantity that is zero but for the round-off of the others; the
    /// estimates of errors use the same rule. At a single instant none is: nothing tells how large it gets.
    pub fn are_zero(&self, columns: &[Values<'_>]) -> Vec<bool> {
        if self.times.len() < 2 { vec![false; columns.len()] } else { are_zero(&self.measures, columns) }
    }

    /// The results at stations that are zero but for round-off.
    pub fn zero_results(&self) -> Vec<&'static str> {
        let track = |word: &str| self.tracks.iter().find(|track| track.name == word);
        let told = RESULTS.iter().filter_map(|result| Some((result, track(result.word)?)));
        let (names, columns): (Vec<_>, Vec<Values<'_>>) =
            told.map(|(result, Track { values, .. })| (result.word, (result.word, result.unit, &**values))).unzip();
        names.into_iter().zip(self.are_zero(&columns)).filter(|(_, is_zero)| *is_zero).map(|(name, _)| name).collect()
    }
}

/// Whether each column is zero in a system with these measures.
fn are_zero(measures: &Measures, columns: &[Values<'_>]) -> Vec<bool> {
    let mut spans: BTreeMap<&str, (&str, Span)> = BTreeMap::new();
    for (name, unit, values) in columns {
        let [low, high] = values
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(*value), high.max(*value)]);
        // A column without values, or with infinite ones, is left as it is.
        let range = if low <= high { high - low } else { f64::INFINITY };
        spans.entry(family(name)).or_insert((unit, Span::default())).1.include(range, low.abs().max(high.abs()));
    }
    let quantities: Vec<_> = spans.iter().map(|(name, (unit, span))| (*name, *unit, *span)).collect();
    let scales: BTreeMap<&str, f64> = spans.keys().copied().zip(measures.scales(&quantities)).collect();
    columns.iter().map(|(name, ..)| scales[family(name)] == 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::run::scale::Beams;

    /// A machine of 1 m at rest for 1 s under 1 kJ: velocities of 1e-14 m/s are round-off of 1 m/s, and so is a lateral
    /// force of 1e-5 N next to 1 kN. A velocity of 1 µm/s and a component of a velocity that moves are not.
    #[test]
    fn noise_is_told_from_small_values() {
        let measures = Measures { size: 1.0, duration: 1.0, energy: 1e3, gravity: 9.81, beams: Beams::default() };
        let noise = [1e-14, -2e-14, 1.5e-14];
        let columns: [Values<'_>; 6] = [
            ("rest.velocity[1]", "m/s", &noise),
            ("creep.velocity[1]", "m/s", &[0.0, 1e-6]),
            ("creep.velocity[2]", "m/s", &noise),
            ("root.force_x", "N", &[1e3, 1e3]),
            ("root.force_y", "N", &[1e-5, -1e-5]),
            ("root.force_z", "N", &[0.0, 0.1]),
        ];
        assert_eq!(are_zero(&measures, &columns), [true, false, false, false, true, false]);
    }
}
