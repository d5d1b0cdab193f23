//! The water and the air of the file, with the elements and bodies that they act on.

use super::function_value;
use crate::math::elementary::sin_cos;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::profile::inside;
use crate::mechanics::fluid::medium::{Current, Medium, Side};
use crate::mechanics::fluid::waves::{Component, Waves, wave_number};
use crate::mechanics::fluid::wet_body::WetBody;
use crate::mechanics::fluid::wet_section::{WetSection, WetSections};
use crate::mechanics::fluid::{Fluid, Wetted, spectrum};
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::file::entries::air::AirSpec;
use crate::model::file::entries::immersion::{DragArea, Immersion};
use crate::model::file::entries::section::SectionSpec;
use crate::model::file::entries::water::WaterSpec;
use crate::model::file::entries::wave::Sea;
use crate::model::file::number::Number;
use crate::model::shape::Lines;
use crate::model::shape::sections::outer_diameter;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// The fluids around the beams and bodies of `system`, whose state counts positions from its origin: water, then air.
pub(super) fn fluids(document: &Document, lines: &Lines, system: &System) -> Vec<Fluid> {
    let water = document.water.as_ref().map(|own| water(document, own, system.origin));
    let air = document.air.as_ref().map(|own| air(document, own, system.origin));
    let media = water.into_iter().chain(air);
    let with_parts = media.map(|medium| Fluid {
        wetted: wetted(document, lines, system, &medium),
        bodies: bodies(document, system, &medium),
        medium,
    });
    with_parts.collect()
}

/// The elements that a fluid acts on.
fn wetted(document: &Document, lines: &Lines, system: &System, medium: &Medium) -> Vec<Wetted> {
    let mut wetted = Vec::new();
    for ((number, beam), own) in document.beams.iter().enumerate().zip(&system.beams) {
        let Some(section) = document.sections.get(beam.section) else { continue };
        let Some(line) = lines.line(number) else { continue };
        let length: f64 = line.spans.iter().map(|span| span.length).sum();
        let at = |fraction: f64| wet_section(document, medium.density, section, fraction * length);
        let is_blown = || section.immersion.meets_air();
        if at(0.0).radius == 0.0 && at(1.0).radius == 0.0 || medium.side == Side::Above && !is_blown() {
            continue;
        }
        let is_alike = section.varying(&document.numbers).is_empty();
        for (local, element) in own.element_range().enumerate() {
            let ends = [local, local + 1].map(|node| own.division.fraction(node));
            let [Some(from), Some(to)] = ends else { continue };
            let sections = match is_alike {
                true => WetSections::Alike(at(0.0)),
                false => WetSections::Along([0.0, 0.5, 1.0].map(|xi| at(inside([from, to], xi)))),
            };
            wetted.push(Wetted { element, sections });
        }
    }
    wetted
}

/// The bodies of `system` that a fluid acts on.
fn bodies(document: &Document, system: &System, medium: &Medium) -> Vec<WetBody> {
    let density = medium.density;
    let bodies = document.bodies.iter().zip(&system.bodies).enumerate();
    let wet = bodies.filter_map(|(number, (written, own))| {
        let vector = |numbers: Option<[Number; 3]>| numbers.map_or([0.0; 3], |numbers| document.vector(numbers));
        let volume = document.value(written.volume);
        // Directors are principal axes, which need not be those of the file.
        let turned = |own_axes: [f64; 3]| own.axes * Mat3::from_diagonal(&own_axes.into()) * own.axes.transpose();
        let drag = turned(vector(written.drag_areas).map(|area| 0.5 * density * area));
        let added = turned(vector(written.added_mass).map(|own| own * share_of_added_mass(document, medium)));
        let is_wet = volume > 0.0;
        is_wet.then_some(WetBody { body: number, start: own.start, volume, displaced: density * volume, drag, added })
    });
    wet.collect()
}

/// The added mass of a body is written for water, or for air where there is no water.
fn share_of_added_mass(document: &Document, medium: &Medium) -> f64 {
    match &document.water {
        Some(water) => medium.density / document.value(water.density),
        None => 1.0,
    }
}

fn water(document: &Document, written: &WaterSpec, origin: Vec3) -> Medium {
    let value = |number| document.value(number);
    Medium {
        side: Side::Below,
        density: value(written.density),
        surface: value(written.surface),
        depth: written.depth.map(value),
        slope: document.slope_of_bottom(),
        current: current(document, written.current),
        waves: Waves { components: components(document, written), stretching: written.stretching },
        ramp: value(written.ramp),
        origin,
    }
}

/// Air reaches down to still water, or as far as anything does.
fn air(document: &Document, written: &AirSpec, origin: Vec3) -> Medium {
    let value = |number| document.value(number);
    Medium {
        side: Side::Above,
        density: value(written.density),
        surface: document.water.as_ref().map_or(f64::NEG_INFINITY, |water| value(water.surface)),
        depth: None,
        slope: [0.0; 2],
        current: current(document, written.wind),
        waves: Waves::default(),
        ramp: value(written.ramp),
        origin,
    }
}

/// A velocity by the height and the time.
fn current(document: &Document, written: [Number; 3]) -> Current {
    let functions = written.map(|number| document.function(number));
    match functions.iter().all(|own| own.is_constant()) {
        true => Current::Uniform(Vec3::from(written.map(|number| document.value(number)))),
        false => Current::Profile(Arc::new(move |z, time| Vec3::from_fn(|i, _| functions[i].with_rate(z, time)[0]))),
    }
}

/// The components of all waves of the file.
fn components(document: &Document, water: &WaterSpec) -> Vec<Component> {
    let value = |number| document.value(number);
    let (gravity, depth) = (-value(document.model.gravity[2]), water.depth.map(value));
    let mut all = Vec::new();
    for wave in &document.waves {
        let (sin, cos) = sin_cos(value(wave.direction));
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
fn wet_section(document: &Document, density: f64, section: &SectionSpec, s: f64) -> WetSection {
    let value = |number: Number| function_value(document, number, s);
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
