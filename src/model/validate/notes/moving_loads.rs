//! Loads that move along a beam, but are hardly ever on it.

use super::Note;
use crate::model::file::document::Document;
use crate::model::file::entries::load::Target;

/// Samples of a station.
const SAMPLES: u32 = 10_000;
/// Share of the run below which a load is hardly ever on its beam.
const LEAST_SHARE: f64 = 0.1;

/// Names the loads whose stations are no fractions of the length.
pub fn absent_loads(document: &Document) -> Vec<Note> {
    let stop = document.value(document.simulation.stop);
    let note = |target: &Target| {
        let Target::Moving { station, .. } = *target else { return None };
        let function = document.function(station);
        let at = |sample: u32| function.value(stop * f64::from(sample) / f64::from(SAMPLES));
        let on = (0..=SAMPLES).filter(|sample| (0.0..=1.0).contains(&at(*sample))).count();
        let share = on as f64 / f64::from(SAMPLES + 1);
        let text = format!(
            "is between 0 and 1, on the beam, for {:.1} % of the run alone. A station is a fraction of \
             the length of the beam: divide a way in m by it",
            100.0 * share
        );
        (share < LEAST_SHARE).then(|| Note::of(document, station, &text))
    };
    document.loads.iter().filter_map(|load| note(&load.target)).collect()
}
