//! Temperatures of beams of the file: the same along a beam, or at the points of each element, or given by a host.

use super::{Builder, function_signal, signal};
use crate::mechanics::beam::centerline::Centerline;
use crate::mechanics::input::heat::Heat;
use crate::mechanics::input::heat_guide::{HeatAlong, HeatGuide};
use crate::mechanics::input::signal::Signal;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::number::Number;
use crate::model::shape::heat::{self, Places};
use crate::model::shape::sections;

impl Builder<'_> {
    /// Lets the temperature of a beam act, number `number` of the system.
    pub(super) fn heat(&mut self, number: usize, beam: &BeamSpec, line: &Centerline) {
        if !beam.is_heated() {
            return;
        }
        let document = self.document;
        let written = [beam.temperature].into_iter().chain(beam.gradients());
        let varies = written.flatten().any(|number| document.function(number).has_rate());
        let guides = if beam.temperature_input {
            vec![self.system.hosted_heat(given(beam, |number| document.value(number)))]
        } else if varies {
            heat::places(line).map(|places| along(document, beam, &places)).collect()
        } else {
            let own = |number: Option<Number>| number.map_or(Signal::Constant(0.0), |number| signal(document, number));
            vec![HeatGuide::Uniform { temperature: own(beam.temperature), gradient: beam.gradients().map(own) }]
        };
        self.system.heat(number, guides, sections::expansion(document, beam).unwrap_or_default());
    }
}

/// The temperature at the points of an element.
fn along(document: &Document, beam: &BeamSpec, places: &Places) -> HeatGuide {
    let at = |number: Option<Number>, s: f64| match number {
        Some(number) => function_signal(document, document.function(number).at_rate(s), 0.0),
        None => Signal::Constant(0.0),
    };
    HeatGuide::Along(Box::new(HeatAlong {
        temperature: places.axial.map(|s| at(beam.temperature, s)),
        gradient: places.bending.map(|s| beam.gradients().map(|number| at(number, s))),
    }))
}

/// A temperature that a host gives, with the values of its numbers.
pub(super) fn given(beam: &BeamSpec, value: impl Fn(Number) -> f64) -> Heat {
    let own = |number: Option<Number>| number.map_or(0.0, &value);
    Heat::uniform(own(beam.temperature), beam.gradients().map(own))
}
