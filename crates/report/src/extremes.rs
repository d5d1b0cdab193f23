//! The lowest and the highest value of each column of a run, and which columns a short table shows.

use crate::column::Name;
use serde::Serialize;

/// An extreme value of a column.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Peak {
    /// The value, in the unit of the column.
    pub value: f64,
    /// When it is reached for the first time, s.
    pub time: f64,
}

/// What a column of results came to; of a column without a finite value there is nothing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Extremes {
    /// Its name in results.csv.
    pub name: String,
    /// Unit label; empty: dimensionless.
    pub unit: String,
    /// The lowest value.
    pub minimum: Option<Peak>,
    /// The highest value.
    pub maximum: Option<Peak>,
    /// The value at the end.
    pub last: Option<f64>,
    /// How far they lie beyond those of the rows, as a share of the range.
    #[serde(skip)]
    pub beyond_rows: f64,
}

/// A component that stays below this share of the largest one of its quantity is zero but for round-off.
pub(crate) const ZERO: f64 = 1e-9;
/// The same of a quantity, as a share of the largest one of its unit.
const ROUND_OFF: f64 = 1e-13;

impl Extremes {
    /// How far it ranges.
    fn range(&self) -> f64 {
        self.minimum.zip(self.maximum).map_or(0.0, |(low, high)| high.value - low.value)
    }

    /// Its largest value, without its sign.
    fn size(&self) -> f64 {
        self.minimum.zip(self.maximum).map_or(0.0, |(low, high)| low.value.abs().max(high.value.abs()))
    }

    /// Whether it ranges further than another one; of two that stand still, whether it is larger.
    fn is_livelier(&self, other: &Self) -> bool {
        (self.range(), self.size()) > (other.range(), other.size())
    }
}

/// Places of the columns that a table of at most `most` lines shows, in their order. Each quantity of an output gets
/// the component that ranges the furthest, of a beam at the station where it does; then the second ones come, as far as
/// there is room. Energies, momenta, counts and components that are zero are left out.
pub fn chosen(columns: &[Extremes], most: usize) -> Vec<usize> {
    // A line for each component, along a beam too, with the column that stands for it.
    let mut lines: Vec<(Name<'_>, usize)> = Vec::new();
    for (place, own) in columns.iter().enumerate() {
        let name = Name::of(&own.name);
        if name.is_total() {
            continue;
        }
        let is_same = |line: &Name<'_>| line.quantity == name.quantity && line.component == name.component;
        match lines.iter_mut().find(|(line, _)| is_same(line)) {
            Some((_, column)) if own.is_livelier(&columns[*column]) => *column = place,
            Some(_) => {}
            None => lines.push((name, place)),
        }
    }
    let rank = |(name, place): &(Name<'_>, usize)| {
        let own = &columns[*place];
        let siblings = || lines.iter().filter(|(other, _)| other.quantity == name.quantity);
        let largest = siblings().map(|(_, other)| columns[*other].size()).fold(0.0, f64::max);
        let is_before =
            |other: &usize| columns[*other].is_livelier(own) || (!own.is_livelier(&columns[*other]) && other < place);
        let before = siblings().filter(|(_, other)| is_before(other)).count();
        let of_unit = lines.iter().map(|(_, other)| &columns[*other]).filter(|other| other.unit == own.unit);
        let largest_of_unit = of_unit.map(Extremes::size).fold(0.0, f64::max);
        // Zero itself is a result.
        let is_round_off = own.size() > 0.0 && own.size() < ROUND_OFF * largest_of_unit;
        (!is_round_off && (before == 0 || own.size() > ZERO * largest)).then_some((before, *place))
    };
    let mut ranked: Vec<(usize, usize)> = lines.iter().filter_map(rank).collect();
    ranked.sort_unstable();
    let mut places: Vec<usize> = ranked.into_iter().take(most).map(|(_, column)| column).collect();
    places.sort_unstable();
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, low: f64, high: f64) -> Extremes {
        let peak = |value: f64, time: f64| Some(Peak { value, time });
        Extremes {
            name: name.to_owned(),
            unit: String::new(),
            minimum: peak(low, 0.0),
            maximum: peak(high, 1.0),
            last: Some(high),
            beyond_rows: 0.0,
        }
    }

    /// Every quantity is there before a second component of any; what moves comes before what is merely large, and
    /// round-off does not come at all.
    #[test]
    fn a_short_table_has_something_of_everything() {
        let columns = [
            column("tip.position[1]", 4.99, 5.0),
            column("tip.position[2]", -1e-17, 1e-16),
            column("tip.position[3]", -0.2, 0.0),
            column("blade.stress[1]", 0.0, 3e8),
            column("blade.stress[2]", 0.0, 4e8),
            column("blade.velocity[1,3]", 0.0, 0.0),
            column("blade.velocity[2,3]", -1.0, 1.0),
            column("motor.effort", 2.0, 2.0),
            column("hinge.distance", -1e-16, 2e-16),
            column("foot.position[1]", 0.0, 0.0),
            column("foot.position[2]", 0.0, 0.0),
            column("energy.total", 0.0, 100.0),
            column("work.water", 0.0, 100.0),
            column("statistics.steps", 0.0, 1000.0),
        ];
        assert_eq!(chosen(&columns, 4), [2, 4, 6, 7]);
        assert_eq!(chosen(&columns, 100), [0, 2, 4, 6, 7, 9]);
        assert_eq!(chosen(&columns, 2), [2, 4]);
        assert_eq!(chosen(&columns[11..], 10), [0; 0]);
    }
}
