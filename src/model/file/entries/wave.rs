//! `[wave.NAME]`: waves of one direction; those of all sections act together.

use super::Parts;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Rule, words_of};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::word("type", &words_of(&TYPES), "one regular wave, or the spectrum of an irregular sea"),
    Key::number(&[&DIRECTION]),
    Key::number(&[&HEIGHT]),
    Key::number(&[&PERIOD]),
    Key::number(&[&PHASE]),
    Key::number(&[&SIGNIFICANT_HEIGHT]),
    Key::number(&[&PEAK_PERIOD]),
    Key::number(&[&PEAKEDNESS]),
    Key::number(&[&COMPONENTS]),
    Key::number(&[&SEED]),
];

const DIRECTION: Rule = Rule::new("direction", "direction in which the waves travel, from x towards y", "rad");
const HEIGHT: Rule = Rule::new("height", "height of the wave from crest to trough", "m").from(0.0);
const PERIOD: Rule = Rule::new("period", "period of the wave", "s").above(0.0);
const PHASE: Rule = Rule::new("phase", "phase of the wave at the origin and t = 0, 0: a crest", "rad");
const SIGNIFICANT_HEIGHT: Rule = Rule::new("significant_height", "significant height of the sea", "m").from(0.0);
const PEAK_PERIOD: Rule = Rule::new("peak_period", "period of the peak of the spectrum", "s").above(0.0);
const PEAKEDNESS: Rule =
    Rule::new("peakedness", "peak enhancement factor gamma of the spectrum", "").from(1.0).to(20.0);
/// More components than this take longer than the rest of a run.
const COMPONENTS: Rule = Rule::new("components", "number of components of the sea", "").from(1.0).to(2000.0).count();
const SEED: Rule = Rule::new("seed", "seed of frequencies and phases", "").from(0.0).to(1e9).count();

/// Default of `peakedness`: the mean of the measurements.
const USUAL_PEAKEDNESS: f64 = 3.3;
/// Default of `components`.
const USUAL_COMPONENTS: usize = 200;

#[derive(Clone, Copy)]
enum Word {
    Airy,
    Jonswap,
    PiersonMoskowitz,
}

/// The words of `type`.
const TYPES: [(&str, Word); 3] =
    [("airy", Word::Airy), ("jonswap", Word::Jonswap), ("pierson_moskowitz", Word::PiersonMoskowitz)];

/// A section `[wave.NAME]`.
#[derive(Clone, Debug)]
pub struct WaveSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Direction in which it travels, rad.
    pub direction: Number,
    /// Its components.
    pub sea: Sea,
}

/// The components of waves.
#[derive(Clone, Copy, Debug)]
pub enum Sea {
    /// One component.
    Regular {
        /// Crest to trough, m.
        height: Number,
        /// s.
        period: Number,
        /// rad.
        phase: Number,
    },
    /// The components of a spectrum.
    Irregular {
        /// Significant height, m.
        height: Number,
        /// Peak period, s.
        period: Number,
        /// Peakedness; none: 1, Pierson and Moskowitz's.
        peakedness: Option<Number>,
        /// Number of components.
        components: usize,
        /// Seed.
        seed: usize,
    },
}

impl WaveSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let place = reader.place;
        let Some(word) = reader.word("type", &TYPES, None) else {
            reader.abandon();
            return None;
        };
        let direction = reader.number_or(&DIRECTION, 0.0);
        let sea = match word {
            Word::Airy => Sea::Regular {
                height: reader.number(&HEIGHT),
                period: reader.number(&PERIOD),
                phase: reader.number_or(&PHASE, 0.0),
            },
            Word::Jonswap | Word::PiersonMoskowitz => Sea::Irregular {
                height: reader.number(&SIGNIFICANT_HEIGHT),
                period: reader.number(&PEAK_PERIOD),
                peakedness: matches!(word, Word::Jonswap).then(|| reader.number_or(&PEAKEDNESS, USUAL_PEAKEDNESS)),
                components: reader.count_or(&COMPONENTS, USUAL_COMPONENTS),
                seed: reader.count_or(&SEED, 1),
            },
        };
        reader.finish();
        Some(Self { name: name.to_owned(), place, direction, sea })
    }
}
