//! The table of results: every row becomes text, and the plots keep of the rows as much as they show.

use crate::arrays::{Array, npz};
use crate::column::Name;
use crate::extremes::{Extremes, Peak, ZERO};
use crate::numbers::shortest;
use crate::trace::Trace;
use ancf14::error::decimal;
use ancf14::fmi::variable::{Causality, Variable};
use ancf14::fmi::{Model, Value};
use std::collections::BTreeMap;
use std::fmt::Write;

/// One column of the results.
#[derive(Debug)]
pub struct Column {
    /// Place in the variable table.
    reference: usize,
    /// Name of the variable.
    pub name: String,
    /// Unit label; empty: dimensionless.
    pub unit: String,
    /// Its values over time.
    pub trace: Trace,
    /// The lowest and the highest value at steps between the rows.
    between: Option<[Peak; 2]>,
}

impl Column {
    /// The lowest and the highest value, and how far they lie beyond those of the rows, as a share of the range. One of
    /// the rows stays unless one between them lies clearly further out. `noise`: values closer together differ by
    /// round-off only.
    fn extremes(&self, noise: f64) -> ([Option<Peak>; 2], f64) {
        let Some(points) = self.trace.extremes() else { return ([None; 2], 0.0) };
        let [low, high] = points.map(|(time, value)| Peak { value, time: decimal(time) });
        let Some([lower, higher]) = self.between else { return ([Some(low), Some(high)], 0.0) };
        let out = [low.value - lower.value, higher.value - high.value].map(|out| out.max(0.0));
        let range = high.value - low.value + out[0] + out[1];
        let margin = f64::max(CLEARLY * range, noise);
        let further = |row: Peak, between: Peak, out: f64| Some(if out > margin { between } else { row });
        let beyond = if range > margin { out[0].max(out[1]) / range } else { 0.0 };
        ([further(low, lower, out[0]), further(high, higher, out[1])], beyond)
    }
}

#[cfg(test)]
impl Column {
    /// A column of no variable.
    pub fn of(name: &str, unit: &str, trace: Trace) -> Self {
        Self { reference: 0, name: name.to_owned(), unit: unit.to_owned(), trace, between: None }
    }
}

/// A row: its time, s, and the values in the order of the columns.
pub type Row = (f64, Vec<f64>);

/// The results so far.
#[derive(Debug)]
pub struct Results {
    /// The outputs, in the order of the variable table.
    pub columns: Vec<Column>,
    /// How many rows there are.
    pub count: u64,
    /// Rows at equally spaced instants, for shapes.
    snapshots: Vec<Row>,
    last: Option<Row>,
    /// Number of the last row of a run that comes to its end.
    pub last_row: u64,
    /// All rows, if somebody wants them.
    kept: Option<Kept>,
    /// Quantities that are zero but for round-off, `tip.velocity`; all energies are `energy`. Plots show them as zero.
    pub zeros: Vec<String>,
}

/// All rows, column by column.
#[derive(Debug, Default)]
struct Kept {
    time: Vec<f64>,
    columns: Vec<Vec<f64>>,
    /// Whether the values of a column are whole numbers.
    are_whole: Vec<bool>,
}

/// Intervals of time that all traces together keep: some 200 MB.
const INTERVALS: usize = 6_000_000;
/// Of one trace: as fine as a plot can show, and still a curve.
const FINEST: usize = 8192;
const COARSEST: usize = 256;
/// A value between rows is an extreme if it lies beyond those of the rows by this share of the range: the same number
/// is in results.csv otherwise.
const CLEARLY: f64 = 1e-3;
/// Snapshots are equally spaced, with so many intervals between them.
const SNAPSHOTS: u64 = 6;

impl Results {
    /// No row yet. Row 0 is the start, `last_row` the end.
    pub fn new(variables: &[Variable], last_row: u64) -> Self {
        let outputs = || variables.iter().enumerate().filter(|(_, variable)| variable.causality == Causality::Output);
        let room = (INTERVALS / outputs().count().max(1)).clamp(COARSEST, FINEST) / 2 * 2;
        let column = |(reference, variable): (usize, &Variable)| Column {
            reference,
            name: variable.name.clone(),
            unit: variable.quantity.unit.clone(),
            trace: Trace::new(room),
            between: None,
        };
        let columns = outputs().map(column).collect();
        Self { columns, count: 0, snapshots: Vec::new(), last: None, last_row, kept: None, zeros: Vec::new() }
    }

    /// Keeps all rows from now on, for `npz`.
    pub fn keep(&mut self) {
        let count = self.columns.len();
        self.kept = Some(Kept { time: Vec::new(), columns: vec![Vec::new(); count], are_whole: vec![false; count] });
    }

    /// Whether all rows are kept.
    pub fn is_kept(&self) -> bool {
        self.kept.is_some()
    }

    /// The bytes of results.npz, with the numbers of results.csv: an array for each column, `time` among them, and the
    /// texts `columns` and `units`, in the order of results.csv. None if the rows were not kept.
    ///
    /// # Errors
    /// The archive does not take an entry; the text says why.
    pub fn npz(&self) -> Option<Result<Vec<u8>, String>> {
        let Kept { time, columns, are_whole } = self.kept.as_ref()?;
        let own = || self.columns.iter();
        let names = std::iter::once("time").chain(own().map(|column| &*column.name)).collect();
        let units = std::iter::once("s").chain(own().map(|column| &*column.unit)).collect();
        let values = columns.iter().zip(are_whole).map(|(values, is_whole)| match is_whole {
            // They were whole numbers of 32 bits.
            true => Array::Integers(values.iter().map(|value| *value as i32).collect()),
            false => Array::Reals(values),
        });
        let mut arrays =
            vec![("columns", Array::Words(names)), ("units", Array::Words(units)), ("time", Array::Reals(time))];
        arrays.extend(own().map(|column| &*column.name).zip(values));
        Some(npz(&arrays).map_err(|reason| reason.to_string()))
    }

    /// Adds a row; returns its text for results.csv, with the header before the first one.
    pub fn record(&mut self, time: f64, model: &impl Model) -> String {
        let mut text =
            if self.count == 0 { header(self.columns.iter().map(|column| &*column.name)) } else { String::new() };
        let mut values = Vec::with_capacity(self.columns.len());
        text.push_str(&shortest(decimal(time)));
        for column in &mut self.columns {
            let value = model.value(column.reference);
            push(&mut text, value);
            column.trace.push(time, value.number());
            values.push(value.number());
            if let Some(kept) = &mut self.kept {
                kept.columns[values.len() - 1].push(value.number());
                kept.are_whole[values.len() - 1] = matches!(value, Value::Integer(_));
            }
        }
        text.push('\n');
        self.kept.iter_mut().for_each(|kept| kept.time.push(decimal(time)));
        let is_snapshot = (0..=SNAPSHOTS).any(|k| (k * self.last_row + SNAPSHOTS / 2) / SNAPSHOTS == self.count);
        if is_snapshot {
            self.snapshots.push((time, values.clone()));
        }
        self.last = Some((time, values));
        self.count += 1;
        text
    }

    /// Includes what the variables came to at steps since the last row: `between` tells the lowest and the highest value
    /// of the variable with this value reference, each with its time, s.
    pub fn include_between(&mut self, between: impl Fn(usize) -> Option<[[f64; 2]; 2]>) {
        for column in &mut self.columns {
            let Some(new) = between(column.reference) else { continue };
            let [low, high] = new.map(|[value, time]| Peak { value, time: decimal(time) });
            let between = column.between.get_or_insert([low, high]);
            if low.value < between[0].value {
                between[0] = low;
            }
            if high.value > between[1].value {
                between[1] = high;
            }
        }
    }

    /// Time of the last row, s.
    pub fn reached(&self) -> Option<f64> {
        self.last.as_ref().map(|(time, _)| *time)
    }

    /// The last value of a column, by its name.
    pub fn last(&self, name: &str) -> Option<f64> {
        let column = self.columns.iter().position(|column| column.name == name)?;
        self.last.as_ref().map(|(_, values)| values[column])
    }

    /// What each column came to.
    pub fn extremes(&self) -> Vec<Extremes> {
        let noise = self.noise();
        let last = |place: usize| self.last.as_ref().map(|(_, values)| values[place]);
        let extremes = |(place, column): (usize, &Column)| {
            let ([minimum, maximum], beyond_rows) = column.extremes(noise[Name::of(&column.name).quantity]);
            let last = last(place).filter(|value| value.is_finite());
            Extremes { name: column.name.clone(), unit: column.unit.clone(), minimum, maximum, last, beyond_rows }
        };
        self.columns.iter().enumerate().map(extremes).collect()
    }

    /// Of each quantity, the differences that are round-off: a small share of its largest value, or all.
    fn noise(&self) -> BTreeMap<&str, f64> {
        let mut noise: BTreeMap<&str, f64> = BTreeMap::new();
        for column in &self.columns {
            let own = noise.entry(Name::of(&column.name).quantity).or_default();
            let points = column.trace.extremes().into_iter().flatten();
            *own = points.fold(*own, |own, (_, value)| own.max(ZERO * value.abs()));
        }
        let zeros = self.zeros.iter().map(|zero| (&**zero, f64::INFINITY));
        noise.extend(zeros);
        noise
    }

    /// Rows at equally spaced instants, and the last one.
    pub fn snapshots(&self) -> impl Iterator<Item = &Row> {
        let taken = self.snapshots.last().map(|(time, _)| *time);
        self.snapshots.iter().chain(self.last.as_ref().filter(move |(time, _)| Some(*time) != taken))
    }
}

/// The first line of results.csv.
fn header<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let mut text = String::from("time");
    for name in names {
        // A name with two indices has a comma in it.
        let quote = if name.contains(',') { "\"" } else { "" };
        // Writing into a String cannot fail.
        let _ = write!(text, ",{quote}{name}{quote}");
    }
    text.push('\n');
    text
}

/// Adds a value to a row of results.csv.
fn push(text: &mut String, value: Value) {
    // Writing into a String cannot fail.
    let _ = match value {
        Value::Real(value) => write!(text, ",{}", shortest(value)),
        Value::Integer(value) => write!(text, ",{value}"),
    };
}

/// The whole of results.csv, from rows that a program has gathered: the names of the columns, and rows of a time, s,
/// and a value for each column.
pub fn table<'a>(names: impl Iterator<Item = &'a str>, rows: impl Iterator<Item = (f64, Vec<Value>)>) -> String {
    let mut text = header(names);
    for (time, values) in rows {
        text.push_str(&shortest(decimal(time)));
        values.into_iter().for_each(|value| push(&mut text, value));
        text.push('\n');
    }
    text
}
