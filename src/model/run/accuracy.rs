//! How far the results are off because of the lengths of the steps: the error that the state carries along, as each
//! result shows it.

use super::correction::{self, Remainder};
use super::neighbor::Neighbor;
use super::scale::{self, Measures, Span};
use super::spell::Spell;
use super::step_setting::Setting;
use crate::math::{elementary::log10, histogram::Histogram};
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::model::file::quantity::Quantity;
use crate::model::variables::Table;
use crate::solve::step::response::Responder;
use crate::solve::step::spare::Spare;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Results are looked at again after this many steps: what a look costs is little beside them.
const STEPS: u64 = 8;
/// The first looks come after each step, so that short runs are looked at too.
const FIRST_STEPS: u64 = 8;
/// Share of its range that a reader expects a result to be right to.
const EXPECTED: f64 = 0.005;
/// The same for the error of a force or a strain because of the mesh.
const EXPECTED_OF_FORCES: f64 = 0.01;
/// Share of the looks in which a force, a strain or an acceleration may be off by more: it jumps where the motion only
/// bends.
const ROUGH_SHARE: f64 = 0.05;
/// An error below this share is told as that: of a model at rest it is round-off.
const LEAST_TOLD: f64 = 1e-6;
/// How fast the mesh error of positions and energies of a motion falls with the length of the elements. The elements
/// have order 4; vibrations that a mesh does not resolve lower it.
pub const ORDER: i32 = 3;
/// Order of the linear twist: the mesh error of no result falls faster where torsion counts.
pub const ORDER_OF_TWIST: i32 = 2;
/// How fast the mesh error of velocities, strains and forces falls.
const ORDER_OF_RATES: i32 = 2;
/// The result of a path by arc length that tells its load.
const PARAMETER: &str = "path.parameter";
/// The share that a proposed step is chosen for.
const PROPOSED: f64 = 0.002;

/// The results that are followed; they never change.
#[derive(Debug)]
pub struct Columns {
    columns: Vec<Column>,
    /// In the order of first mention.
    families: Vec<Family>,
    /// The first results of all rotation vectors.
    rotations: Vec<usize>,
}

/// A result that is followed.
#[derive(Clone, Copy, Debug)]
struct Column {
    /// Its number among the results.
    result: usize,
    family: usize,
    /// Counts from zero, not from its lowest value: kinetic and elastic energy.
    from_zero: bool,
}

/// All components of an output, or all energies.
#[derive(Debug)]
struct Family {
    name: String,
    unit: String,
    /// It may be off by more in some looks: [`Quantity::is_rough`].
    is_rough: bool,
    /// Each four of its results are a unit quaternion.
    is_quaternion: bool,
    /// It jumps along a beam: its error is the mean of its columns, of which one may be on either side of a jump.
    jumps: bool,
    /// It is told of; energies that are not among the results only say what is large.
    is_shown: bool,
    /// How fast the error that a mesh causes falls with the length of the elements.
    order: i32,
}

/// How far two runs of a model are apart.
#[derive(Clone, Debug, Default)]
pub struct Differences {
    /// Differences of each family: the largest one among its columns for each row.
    families: Vec<Histogram>,
    /// The same of the rows that follow each other.
    spells: Vec<Spell>,
    largest: Vec<f64>,
    /// The row of the other run; scratch memory.
    other: Vec<f64>,
}

/// Scratch memory of a look.
#[derive(Debug, Default)]
pub struct Looker {
    neighbor: Neighbor,
    largest: Vec<f64>,
    ranges: Vec<f64>,
}

/// What has been seen of the results so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// Lowest and highest value of each column.
    ranges: Vec<[f64; 2]>,
    /// The errors of each family, of each look the largest one among its columns.
    errors: Vec<Histogram>,
    /// Steps at the last look.
    looked: u64,
    /// What is left in results that are corrected.
    remainder: Remainder,
}

/// A family of results and its estimated error.
#[derive(Clone, Debug, PartialEq)]
pub struct Inexact {
    /// Name of the family, for instance `tip.velocity`.
    pub name: String,
    /// Its largest error so far, as a share of its range.
    pub error: f64,
    /// It is a force, a strain or an acceleration, which converges more slowly than the motion.
    pub is_rough: bool,
}

impl Columns {
    /// Those of `table`; `are_equilibria`: nothing moves.
    pub fn new(table: &Table, are_equilibria: bool) -> Self {
        let (mut columns, mut families) = (Vec::new(), Vec::<Family>::new());
        let (quantities, is_shown) = (table.quantities_of_results(), table.shown_results());
        let mut known = BTreeMap::new();
        for (result, ((own, unit), quantity)) in table.results.iter().zip(&quantities).enumerate() {
            let quantity = *quantity;
            let name = scale::family(own);
            // The share that slides jumps from 0 to 1, on every mesh at another load.
            let is_followed = quantity.is_some() || matches!(name, scale::ENERGY | PARAMETER);
            if !is_followed || quantity == Some(Quantity::Sliding) {
                continue;
            }
            let from_zero = scale::counts_from_zero(own);
            // The energy of weight in an equilibrium says how high z = 0 lies, and its range may be round-off: the
            // elastic energy alone has a scale.
            if are_equilibria && name == scale::ENERGY && !from_zero {
                continue;
            }
            let family = *known.entry(name).or_insert_with(|| {
                let is_rough = quantity.is_some_and(Quantity::is_rough);
                let is_quaternion = quantity == Some(Quantity::Quaternion);
                // Ranges over time are shown without a variable.
                let is_shown = quantity.is_some() || is_shown[result];
                let order = if quantity.is_none_or(Quantity::is_configuration) { ORDER } else { ORDER_OF_RATES };
                families.push(Family {
                    name: name.to_owned(),
                    unit: unit.clone(),
                    is_rough,
                    is_quaternion,
                    jumps: quantity.is_some_and(Quantity::jumps_along_beam),
                    is_shown,
                    order,
                });
                families.len() - 1
            });
            columns.push(Column { result, family, from_zero });
        }
        let rotations = columns.iter().filter(|column| quantities[column.result] == Some(Quantity::Rotation));
        let rotations = rotations.step_by(3).map(|column| column.result).collect();
        Self { columns, families, rotations }
    }

    /// Replaces rotation vectors of `other` by those of `own` plus the turn from one to the other.
    pub fn compare_turns(&self, own: &[f64], other: &mut [f64]) {
        scale::compare_turns(&self.rotations, own, other);
    }

    /// Sets `largest` to the largest of the errors of each family's results, or to their mean where it jumps.
    fn find_largest(&self, error: impl Fn(usize) -> f64, largest: &mut Vec<f64>) {
        self.find_largest_of_columns(|_, column| error(column.result), largest);
        for (number, largest) in largest.iter_mut().enumerate().filter(|(number, _)| self.families[*number].jumps) {
            let own = self.columns.iter().filter(|column| column.family == number);
            let (sum, count) = own.fold((0.0, 0.0), |(sum, count), own| (sum + error(own.result), count + 1.0));
            *largest = if sum.is_nan() { f64::INFINITY } else { sum / count };
        }
    }

    /// Sets `largest` to the largest size of each family's columns.
    fn find_largest_of_columns(&self, size: impl Fn(usize, &Column) -> f64, largest: &mut Vec<f64>) {
        largest.clear();
        largest.resize(self.families.len(), 0.0);
        for (number, column) in self.columns.iter().enumerate() {
            let (size, worst) = (size(number, column), &mut largest[column.family]);
            *worst = if size.is_nan() { f64::INFINITY } else { size.max(*worst) };
        }
    }
}

impl Differences {
    /// Includes a row of both runs.
    pub fn include(&mut self, columns: &Columns, own: &[f64], other: &[f64]) {
        let Self { families, spells, largest, other: row } = self;
        row.clear();
        row.extend_from_slice(other);
        columns.compare_turns(own, row);
        columns.find_largest(|result| (own[result] - row[result]).abs(), largest);
        families.resize(largest.len(), Histogram::default());
        families.iter_mut().zip(&*largest).for_each(|(differences, largest)| differences.add(*largest));
        spells.resize(largest.len(), Spell::default());
        spells.iter_mut().zip(largest).for_each(|(spell, largest)| spell.add(*largest));
    }

    /// The difference of family `number` that at most the share `left_out` of the rows exceeds, and no rows that follow
    /// each other do; none: there are no rows.
    fn of(&self, number: usize, left_out: f64) -> Option<f64> {
        Some(self.families.get(number)?.exceeded_by(left_out).max(self.spells[number].lasting()))
    }
}

impl Family {
    /// The share of its errors that may be larger than the one that is told.
    fn left_out(&self) -> f64 {
        if self.is_rough { ROUGH_SHARE } else { 0.0 }
    }
}

impl Accuracy {
    /// Includes `results` in the ranges.
    pub fn include(&mut self, columns: &Columns, results: &[f64]) {
        self.ranges.resize(columns.columns.len(), [f64::INFINITY, f64::NEG_INFINITY]);
        for (column, [low, high]) in columns.columns.iter().zip(&mut self.ranges) {
            (*low, *high) = (low.min(results[column.result]), high.max(results[column.result]));
        }
    }

    /// Whether the errors are to be looked at after `steps` steps.
    pub fn is_due(&self, steps: u64) -> bool {
        steps <= FIRST_STEPS || steps >= self.looked.saturating_add(STEPS)
    }

    /// Looks at the errors of the `results` of `state`, as computed, which have been included; `responder` is there if
    /// results ask for a response, `spare` is scratch memory. `corrects`: they will be corrected.
    pub fn look(
        &mut self,
        (columns, table): (&Columns, &Table),
        (system, state): (&System, &State),
        responder: Option<&mut Responder>,
        (results, corrects): (&[f64], bool),
        (looker, spare): (&mut Looker, Spare),
    ) {
        let Looker { neighbor, largest, ranges } = looker;
        let Some((moved, multiple)) = neighbor.measure(table, (system, state), responder, spare) else { return };
        self.looked = state.statistics.steps;
        columns.compare_turns(results, moved);
        columns.find_largest(|result| (moved[result] - results[result]).abs() / multiple, largest);
        self.errors.resize(columns.families.len(), Histogram::default());
        self.errors.iter_mut().zip(&*largest).for_each(|(errors, largest)| errors.add(*largest));
        if corrects {
            self.find_ranges(columns, ranges);
            let families = largest.iter().zip(&*ranges).map(|(error, range)| [*error, *range]);
            self.remainder.include(system, &state.time_error, families);
        }
    }

    /// Takes the error out of those of the `results` of `state`, as computed, that are not rough; arguments are those
    /// of [`Self::look`].
    pub fn correct(
        &self,
        (columns, table): (&Columns, &Table),
        motion: (&System, &State),
        responder: Option<&mut Responder>,
        results: &mut [f64],
        (looker, spare): (&mut Looker, Spare),
    ) {
        let Looker { neighbor, largest, ranges } = looker;
        let Some((moved, multiple)) = neighbor.measure(table, motion, responder, spare) else { return };
        let error = |result: usize, computed: f64| (moved[result] - computed) / multiple;
        columns.find_largest(|result| error(result, results[result]).abs(), largest);
        self.find_ranges(columns, ranges);
        for Column { result, family, .. } in &columns.columns {
            if !columns.families[*family].is_rough && largest[*family].is_finite() {
                results[*result] +=
                    correction::share(largest[*family], ranges[*family]) * error(*result, results[*result]);
            }
        }
        let quaternions = columns.columns.iter().filter(|column| columns.families[column.family].is_quaternion);
        for Column { result, .. } in quaternions.step_by(4) {
            correction::normalize(&mut results[*result..result + 4]);
        }
    }

    /// Sets `ranges` to the largest range of each family's results so far.
    fn find_ranges(&self, columns: &Columns, ranges: &mut Vec<f64>) {
        let range = |number: usize, _: &Column| self.ranges.get(number).map_or(0.0, |[low, high]| high - low);
        columns.find_largest_of_columns(range, ranges);
    }

    /// How far the families range, each with its largest size.
    fn spans(&self, columns: &Columns) -> Vec<Span> {
        let mut spans = vec![Span::default(); columns.families.len()];
        for (column, [low, high]) in columns.columns.iter().zip(&self.ranges) {
            let size = low.abs().max(high.abs());
            spans[column.family].include(if column.from_zero { size } else { high - low }, size);
        }
        spans
    }

    /// The largest range of an energy so far, J.
    pub fn energy(&self, columns: &Columns) -> f64 {
        let energies =
            columns.families.iter().zip(self.spans(columns)).filter(|(family, _)| family.name == scale::ENERGY);
        energies.map(|(_, span)| span.range).fold(0.0, f64::max)
    }

    /// All families of results with their errors because of the lengths of the steps; none of quantities that are zero.
    /// `corrects`: those that are not rough are told as corrected.
    pub fn errors(&self, columns: &Columns, measures: &Measures, corrects: bool) -> Vec<Inexact> {
        let error = |number: usize, family: &Family| {
            let error = self.errors.get(number)?.exceeded_by(family.left_out());
            Some(if corrects && !family.is_rough { self.remainder.of(number, error) } else { error })
        };
        self.shares(columns, measures, error)
    }

    /// All families of results with the largest of the `errors` of their results; none of quantities that are zero.
    pub fn errors_of_mesh(&self, columns: &Columns, measures: &Measures, errors: &[f64]) -> Vec<Inexact> {
        let mut largest = Vec::new();
        columns.find_largest(|result| errors[result], &mut largest);
        self.shares(columns, measures, |number, _| Some(largest[number]))
    }

    /// All families of results with their errors because of the mesh, from the differences of this run and one whose
    /// elements are `ratio` times as long; `limit`: no order is higher.
    pub fn errors_beside(
        &self,
        columns: &Columns,
        measures: &Measures,
        differences: &Differences,
        (ratio, limit): (f64, i32),
    ) -> Vec<Inexact> {
        let error = |number: usize, family: &Family| {
            let difference = differences.families.get(number)?.exceeded_by(family.left_out());
            Some(difference / (ratio.powi(family.order.min(limit)) - 1.0).abs())
        };
        self.shares(columns, measures, error)
    }

    /// All families of results with the difference of this run and another one, each over the `divisor` of families
    /// that are configurations (positions, angles, energies) or not.
    pub fn errors_of_pair(
        &self,
        columns: &Columns,
        measures: &Measures,
        (differences, is_motion): (&Differences, bool),
        divisor: impl Fn(&str, bool) -> f64,
    ) -> Vec<Inexact> {
        let error = |number: usize, family: &Family| {
            // Results of equilibria do not jump.
            let left_out = if is_motion { family.left_out() } else { 0.0 };
            let difference = differences.of(number, left_out)?;
            Some(difference / divisor(&family.name, family.order == ORDER))
        };
        self.shares(columns, measures, error)
    }

    /// All families of results with their errors, given in their units by number and family, as shares of their ranges;
    /// none of quantities that are zero.
    fn shares(
        &self,
        columns: &Columns,
        measures: &Measures,
        error: impl Fn(usize, &Family) -> Option<f64>,
    ) -> Vec<Inexact> {
        let scales = self.scales(columns, measures);
        let shown = columns.families.iter().zip(scales).enumerate().filter(|(_, (family, _))| family.is_shown);
        let found = shown.filter_map(|(number, (family, scale))| {
            let error = error(number, family)? / scale;
            let Family { name, is_rough, .. } = family;
            (scale > 0.0).then(|| Inexact { name: name.clone(), error, is_rough: *is_rough })
        });
        found.collect()
    }

    /// The names of the families that are zero but for round-off.
    pub fn zeros(&self, columns: &Columns, measures: &Measures) -> Vec<String> {
        let scales = self.scales(columns, measures);
        let zeros = columns.families.iter().zip(scales).filter(|(_, scale)| *scale == 0.0);
        zeros.map(|(family, _)| family.name.clone()).collect()
    }

    /// What the errors of the families are compared with; 0: the family is zero.
    fn scales(&self, columns: &Columns, measures: &Measures) -> Vec<f64> {
        let spans = self.spans(columns);
        let families = columns.families.iter().zip(spans);
        let quantities: Vec<_> = families.map(|(family, span)| (&*family.name, &*family.unit, span)).collect();
        measures.scales(&quantities)
    }
}

impl Inexact {
    /// The warning about a run whose results are off by more than a reader expects; `setting` is the one of its steps.
    pub fn warning(&self, setting: Setting) -> Option<String> {
        let Self { name, error, .. } = self;
        if *error > 1.0 {
            return Some(format!(
                "the error of {name} because of the length of the steps is not known: its estimate has grown beyond the range of {name}, as it does where small differences grow or \
                 the phase of an oscillation is lost; run again with a tenth of {} and compare, or use --verify",
                setting.name()
            ));
        }
        let remedy = format!(
            "take a smaller {} for about {} where the motion is smooth",
            setting.proposed(PROPOSED / error),
            percent(PROPOSED)
        );
        (self.excess_of_steps() > 1.0).then(|| {
            format!(
                "{name} is off by {} of its range because of the length of the steps, as estimated during the run; {remedy}",
                self.size(),
            )
        })
    }

    /// The warning about a run whose results are off by more than a reader expects because of both its steps and its
    /// mesh, whose error is `mesh`.
    pub fn warning_with_mesh(&self, mesh: &Self, setting: Setting) -> String {
        let sum = Self { error: self.error + mesh.error, ..self.clone() };
        format!(
            "{} is off by {} of its range because of the length of the steps and the mesh together, as estimated during the run. Take a smaller {} and more elements; --verify \
             names the numbers",
            self.name,
            sum.size(),
            setting.name()
        )
    }

    /// Its error because of the steps over what a reader expects.
    pub fn excess_of_steps(&self) -> f64 {
        self.error / EXPECTED
    }

    /// Its error because of the mesh over what a reader expects.
    pub fn excess(&self) -> f64 {
        self.error / if self.is_rough { EXPECTED_OF_FORCES } else { EXPECTED }
    }

    /// The warning about a run whose results are off by more than a reader expects because of the mesh, as `seen_from`
    /// another one; `twists`: a beam has linear twist.
    pub fn warning_of_mesh(&self, seen_from: &str, twists: bool) -> Option<String> {
        let or_twist = if twists { ", or twist = \"quadratic\"" } else { "" };
        (self.excess() > 1.0).then(|| {
            format!(
                "{} is off by {} of its range because of the mesh, as estimated from {seen_from}. Take more elements{or_twist}; --verify names the beams and the numbers",
                self.name,
                self.size()
            )
        })
    }

    /// Its error in words: `about 0.17 %`; one beyond the whole range says no more than that.
    pub fn size(&self) -> String {
        match self.error {
            error if error > 1.0 => String::from("more than 100 %"),
            error if error < LEAST_TOLD => at_most(error),
            error => format!("about {}", percent(error)),
        }
    }
}

/// A share in percent, with two digits; one that is far below all that matters as less than that.
pub fn at_most(share: f64) -> String {
    if share < LEAST_TOLD { format!("less than {}", percent(LEAST_TOLD)) } else { percent(share) }
}

/// A share in percent, with two digits.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    let digits = if percent == 0.0 { 0 } else { (1 - log10(percent).floor() as i32).clamp(0, 6) as usize };
    format!("{percent:.digits$} %")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An error of 2 % asks for a step of a third, for a tenth of it; one beyond the whole range for no number.
    #[test]
    fn the_remedy_follows_from_the_error() {
        let warning = |error: f64| {
            Inexact { name: String::from("tip.velocity"), error, is_rough: false }.warning(Setting::Step(1e-3))
        };
        assert_eq!(warning(0.004), None);
        let found = warning(0.02).unwrap();
        assert!(
            found.ends_with("take a smaller simulation.step: 3.2e-4 s for about 0.20 % where the motion is smooth"),
            "{found}"
        );
        let found = warning(1e9).unwrap();
        assert!(
            found.contains("is not known") && found.contains("a tenth of simulation.step") && !found.contains('%'),
            "{found}"
        );
    }
}
