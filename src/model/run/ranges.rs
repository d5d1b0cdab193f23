//! Ranges over time of quantities along beams, `summary = "range"` of an output: minimum, maximum and mean of each
//! component at each station.
//!
//! The mean is that of the straight lines from row to row, whatever their distances. Extremes include steps
//! between the rows.

use super::between::LowAndHigh;
use crate::error::decimal;
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::file::entries::output::{OutputSpec, Target};
use crate::model::file::quantity::Quantity;
use crate::model::variables::Table;

/// A row at most so many output steps before the begin of a range belongs to it: the round-off of its time.
const ROUNDING: f64 = 1e-9;

/// All ranges of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ranges {
    /// A range for each quantity, in the order of the file.
    pub list: Vec<Range>,
}

/// The range over time of a quantity along a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// `riser.section_moment`.
    pub name: String,
    /// Unit label; empty: dimensionless.
    pub unit: String,
    /// The quantity in words, with its axes.
    pub meaning: String,
    /// Number of its components.
    pub components: usize,
    /// Undeformed arc lengths of the stations from the start of the beam, m.
    pub stations: Vec<f64>,
    /// The number of its first result; the components of the stations follow.
    first: usize,
    /// When it begins, s.
    begin: f64,
    /// The times of the first and the last row that count, s.
    rows: Option<[f64; 2]>,
    spans: Vec<Span>,
}

/// The values of a component at a station so far; of an empty one none is finite.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    minimum: [f64; 2],
    maximum: [f64; 2],
    integral: f64,
    last: f64,
}

/// The range of a component at a station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Envelope {
    /// The lowest value, and the time, s, at which it appears first.
    pub minimum: [f64; 2],
    /// The highest value, and the time, s, at which it appears first.
    pub maximum: [f64; 2],
    /// The mean over time.
    pub mean: f64,
}

impl Ranges {
    /// The ranges that the outputs of a file ask for, before the first row.
    pub(super) fn new(document: &Document, system: &System, table: &Table) -> Self {
        let mut list = Vec::new();
        for output in &document.outputs {
            let (Some(from), Target::On { beam, stations }) = (output.range, output.target) else { continue };
            let elements = &system.mesh.elements[system.beams[beam].element_range()];
            let length: f64 = elements.iter().map(|element| element.length()).sum();
            // The sum has round-off: 0.5 m instead of 0.5000000000000001 m.
            let arc = |station: usize| decimal(length * station as f64 / (stations - 1) as f64);
            let begin = document.value(from) - ROUNDING * document.output_step();
            let range =
                |quantity: &Quantity| Range::new(output, *quantity, begin, (0..stations).map(arc).collect(), table);
            list.extend(output.quantities.iter().filter_map(range));
        }
        Self { list }
    }

    /// Includes the extremes of all results at steps since the last row; empty: there are none.
    pub fn include_between(&mut self, extremes: &[LowAndHigh]) {
        self.list.iter_mut().for_each(|range| range.include_between(extremes));
    }

    /// Includes a row of all `results` at `time`, s, later than all before.
    pub fn include(&mut self, time: f64, results: &[f64]) {
        self.list.iter_mut().filter(|range| time >= range.begin).for_each(|range| range.include(time, results));
    }
}

impl Range {
    fn new(output: &OutputSpec, quantity: Quantity, begin: f64, stations: Vec<f64>, table: &Table) -> Option<Self> {
        let row = quantity.row();
        let name = format!("{}.{}", output.name, row.word);
        let is_own = |own: &str| own.strip_prefix(&*name).is_some_and(|index| index.starts_with('['));
        let first = table.results.iter().position(|(own, _)| is_own(own))?;
        let nothing = Span { minimum: [f64::INFINITY; 2], maximum: [f64::NEG_INFINITY; 2], integral: 0.0, last: 0.0 };
        Some(Self {
            unit: table.results[first].1.clone(),
            meaning: output.meaning(quantity),
            components: row.components,
            spans: vec![nothing; stations.len() * row.components],
            name,
            stations,
            first,
            begin,
            rows: None,
        })
    }

    fn include_between(&mut self, extremes: &[LowAndHigh]) {
        for (span, [low, high]) in self.spans.iter_mut().zip(extremes.iter().skip(self.first)) {
            if low[0] < span.minimum[0] && low[1] >= self.begin {
                span.minimum = *low;
            }
            if high[0] > span.maximum[0] && high[1] >= self.begin {
                span.maximum = *high;
            }
        }
    }

    fn include(&mut self, time: f64, results: &[f64]) {
        let [start, last] = self.rows.unwrap_or([time; 2]);
        for (span, value) in self.spans.iter_mut().zip(&results[self.first..]) {
            let before = if self.rows.is_some() { span.last } else { *value };
            span.integral += 0.5 * (time - last) * (before + value);
            span.last = *value;
            if *value < span.minimum[0] {
                span.minimum = [*value, time];
            }
            if *value > span.maximum[0] {
                span.maximum = [*value, time];
            }
        }
        self.rows = Some([start, time]);
    }

    /// What each station has come to, component by component; empty before the first row that counts.
    pub fn envelopes(&self) -> impl Iterator<Item = Envelope> + '_ {
        let duration = self.rows.map(|[start, last]| last - start);
        duration.into_iter().flat_map(|duration| {
            self.spans.iter().map(move |&Span { minimum, maximum, integral, last }| {
                let mean = if duration > 0.0 { integral / duration } else { last };
                // Round-off may take the mean of equal values beyond them.
                Envelope { minimum, maximum, mean: mean.clamp(minimum[0], maximum[0]) }
            })
        })
    }
}
