//! What a run took, and the warning where that was far more than its step asks for.

pub use crate::mechanics::state::Statistics;
use crate::model::file::document::Document;
use crate::model::file::entries::simulation::{Analysis, Steps};

/// A run is warned of when so many steps were rejected that they are a tenth of the steps that simulation.step asks
/// for, or when halving has added half as many steps again.
const REJECTED: f64 = 10.0;
const REJECTED_SHARE: f64 = 0.1;
const STEPS_SHARE: f64 = 1.5;

/// The warning about a run of which many steps were rejected: it took `statistics` for a motion of `duration` s, with
/// `rows` rows of results.
pub fn rejections(document: &Document, statistics: &Statistics, duration: f64, rows: u64) -> Option<String> {
    // An equilibrium has no motion; what it takes to find it is its own affair. Where the solver chooses the steps, it
    // rejects some to choose them.
    if document.simulation.analysis == Analysis::Static || matches!(document.simulation.steps, Steps::ForAccuracy(_)) {
        return None;
    }
    let (steps, rejected) = (statistics.steps as f64, statistics.rejected as f64);
    let asked = duration / document.largest_step();
    let asked = asked.round().max(rows as f64 - 1.0);
    let are_many = rejected >= REJECTED && rejected > REJECTED_SHARE * asked;
    (are_many || steps > STEPS_SHARE * asked + REJECTED).then(|| {
        format!(
            "{rejected} steps were rejected, and {steps} steps were needed instead of {asked}: the motion is too fast for \
             simulation.step, or a load, drive or frame jumps or grows without bound; compare with a smaller simulation.step"
        )
    })
}
