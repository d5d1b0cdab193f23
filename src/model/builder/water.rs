//! The water of the file, with the elements that it acts on.

use super::function_value;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::profile::inside;
use crate::mechanics::body::in_water::WetBody;
use crate::mechanics::system::System;
use crate::mechanics::water::medium::{Current, Medium};
use crate::mechanics::water::waves::{Component, Waves, wave_number};
use crate::mechanics::water::wet_section::{WetSection, WetSections};
use crate::mechanics::water::{Water, Wetted, spectrum};
use crate::model::file::document::Document;
use crate::model::file::entries::immersion::{DragArea, Immersion};
use crate::model::file::entries::section::SectionSpec;
use crate::model::file::entries::water::WaterSpec;
use crate::model::file::entries::wave::Sea;
use crate::model::file::number::Number;
use crate::model::shape::Lines;
use crate::model::shape::sections::outer_diameter;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// The water around the beams of `system`, whose state counts positions from its origin; none: the file has none.
pub(super) fn water(document: &Document, lines: &Lines, system: &System) -> Option<Box<Water>> {
    let written = document.water.as_ref()?;
    let mut wetted = Vec::new();
    for ((number, beam), own) in document.beams.iter().enumerate().zip(&system.beams) {
        let section = document.sections.get(beam.section)?;
        let length: f64 = lines.line(number)?.spans.iter().map(|span| span.length).sum();
        let at = |fraction: f64| wet_section(document, written, section, fraction * length);
        if at(0.0).radius == 0.0 && at(1.0).radius == 0.0 {
            continue;
        }
        let is_alike = section.varying(&document.numbers).is_empty();
        for (local, element) in own.element_range().enumerate() {
            let fractions = [own.division.fraction(local)?, own.division.fraction(local + 1)?];
            let sections = match is_alike {
                true => WetSections::Alike(at(0.0)),
                false => WetSections::Along([0.0, 0.5, 1.0].map(|xi| at(inside(fractions, xi)))),
            };
            wetted.push(Wetted { element, sections });
        }
    }
    Some(Box::new(Water { medium: medium(document, written, system.origin), wetted }))
}

/// The bodies of `system` that water acts on.
pub(super) fn floating(document: &Document, system: &System) -> Vec<WetBody> {
    let Some(water) = &document.water else { return Vec::new() };
    let density = document.value(water.density);
    let bodies = document.bodies.iter().zip(&system.bodies).enumerate();
    let wet = bodies.filter_map(|(number, (written, own))| {
        let vector = |numbers: Option<[Number; 3]>| numbers.map_or([0.0; 3], |numbers| document.vector(numbers));
        let volume = document.value(written.volume);
        // Directors are principal axes, which need not be those of the file.
        let turned = |own_axes: [f64; 3]| own.axes * Mat3::from_diagonal(&own_axes.into()) * own.axes.transpose();
        let drag = turned(vector(written.drag_areas).map(|area| 0.5 * density * area));
        let added = turned(vector(written.added_mass));
        let is_wet = volume > 0.0;
        is_wet.then_some(WetBody { body: number, start: own.start, volume, displaced: density * volume, drag, added })
    });
    wet.collect()
}

fn medium(document: &Document, written: &WaterSpec, origin: Vec3) -> Medium {
    let value = |number| document.value(number);
    let functions = written.current.map(|number| document.function(number));
    let current = match functions.iter().all(|own| own.is_constant()) {
        true => Current::Uniform(Vec3::from(written.current.map(value))),
        false => Current::Profile(Arc::new(move |z, time| Vec3::from_fn(|i, _| functions[i].with_rate(z, time)[0]))),
    };
    Medium {
        density: value(written.density),
        surface: value(written.surface),
        depth: written.depth.map(value),
        slope: document.slope_of_bottom(),
        current,
        waves: Waves { components: components(document, written), stretching: written.stretching },
        ramp: value(written.ramp),
        origin,
    }
}

/// The components of all waves of the file.
fn components(document: &Document, water: &WaterSpec) -> Vec<Component> {
    let value = |number| document.value(number);
    let (gravity, depth) = (-value(document.model.gravity[2]), water.depth.map(value));
    let mut all = Vec::new();
    for wave in &document.waves {
        let (sin, cos) = value(wave.direction).sin_cos();
        let own = match wave.sea {
            Sea::Regular { height, period, phase } => vec![[0.5 * value(height), TAU / value(period), value(phase)]],
            Sea::Irregular { height, period, peakedness, components, seed } => {
                let peakedness = peakedness.map_or(1.0, value);
                spectrum::components(value(height), value(period), peakedness, components, seed as u64)
            }
        };
        all.extend(own.into_iter().map(|[amplitude, frequency, phase]| Component {
            amplitude,
            frequency,
            number: wave_number(frequency, gravity, depth),
            direction: [cos, sin],
            phase,
        }));
    }
    all
}

/// The section at the arc length `s`, m.
fn wet_section(document: &Document, water: &WaterSpec, section: &SectionSpec, s: f64) -> WetSection {
    let value = |number: Number| function_value(document, number, s);
    let density = document.value(water.density);
    let Immersion { drag, drag_area, added_mass, .. } = section.immersion;
    let diameter = outer_diameter(section, value).unwrap_or(0.0);
    let displaced = density * PI / 4.0 * diameter * diameter;
    let along = match drag_area {
        Some(DragArea::Circumference) => PI * diameter,
        Some(DragArea::Diameter) | None => diameter,
    };
    let pair = |numbers: Option<[Number; 2]>| numbers.map_or([0.0; 2], |numbers| numbers.map(value));
    let [drag_n, drag_t] = pair(drag);
    WetSection {
        radius: 0.5 * diameter,
        displaced,
        drag: [0.5 * density * diameter * drag_n, 0.5 * density * along * drag_t],
        added: pair(added_mass).map(|coefficient| coefficient * displaced),
    }
}
