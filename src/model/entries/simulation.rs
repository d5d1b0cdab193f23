//! `[simulation]`: what is computed, how long, how finely, by which method.

use crate::model::diagnostic::Place;
use crate::model::number::Number;
use crate::model::reader::Reader;
use crate::model::schema;

/// The section `[simulation]`.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// Where the section begins.
    pub place: Place,
    /// Motion, or a row of equilibria.
    pub analysis: Analysis,
    /// Time integration.
    pub integrator: Integrator,
    /// Where the state comes from at the start.
    pub initial: Initial,
    /// End, s.
    pub stop: Number,
    /// Largest internal step, s.
    pub step: Number,
    /// Time between two rows of results, s; default: the step.
    pub output_step: Number,
    /// Bound of the last Newton increment.
    pub tolerance: Number,
}

/// What is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Analysis {
    /// Motion in time.
    Dynamic,
    /// An equilibrium at every time.
    Static,
}

/// Time integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// Midpoint rule that keeps the energy.
    Conserving,
    /// The paper's variational midpoint rule.
    Variational,
}

/// Where the state comes from at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Initial {
    /// As drawn in the file.
    AsDrawn,
}

const ANALYSES: [(&str, Analysis); 2] = [("dynamic", Analysis::Dynamic), ("static", Analysis::Static)];
const INTEGRATORS: [(&str, Integrator); 2] =
    [("conserving", Integrator::Conserving), ("variational", Integrator::Variational)];
const INITIALS: [(&str, Initial); 1] = [("as_drawn", Initial::AsDrawn)];

/// Default of `tolerance`.
const TOLERANCE: f64 = 1e-8;

impl Simulation {
    pub(in crate::model) fn read(mut reader: Reader<'_, '_>) -> Self {
        let analysis = reader.word("analysis", &ANALYSES, &[], Some(Analysis::Dynamic)).unwrap_or(Analysis::Dynamic);
        let initial = reader.word("initial", &INITIALS, &["equilibrium"], Some(Initial::AsDrawn));
        let stop = reader.number(&schema::STOP);
        let step = reader.number(&schema::STEP);
        let output_step = reader.optional(&schema::OUTPUT_STEP).unwrap_or(step);
        let integrator = reader.word("integrator", &INTEGRATORS, &["generalized_alpha"], Some(Integrator::Conserving));
        reader.unavailable("spectral_radius", "it belongs to the integrator generalized_alpha, which is not available");
        let tolerance = reader.number_or(&schema::TOLERANCE, TOLERANCE);
        let place = reader.place;
        // The two that a host may always change are parameters also where the file does not write them; the two that only
        // fill the default experiment are none.
        let slots = &mut reader.context.numbers.slots;
        for number in [step, tolerance] {
            slots[number.0].listed.get_or_insert(usize::MAX);
        }
        for number in [stop, output_step].into_iter().filter(|number| *number != step) {
            slots[number.0].listed = None;
        }
        reader.finish();
        let initial = initial.unwrap_or(Initial::AsDrawn);
        let integrator = integrator.unwrap_or(Integrator::Conserving);
        Self { place, analysis, integrator, initial, stop, step, output_step, tolerance }
    }
}
