//! Whether vibrations have the damping ratios that a material asks for. Damping in proportion to mass acts on the
//! masses of beams only: a vibration whose kinetic energy is mostly that of bodies has less.

use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::file::entries::damping::Damping;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::simulation::Simulation;
use crate::model::shape::sections;
use crate::solve::modes::damping::{damping_ratios, material_rates};
use crate::solve::modes::{Kind, Mode, modes};
use std::f64::consts::TAU;

/// The lowest modes, which are looked at.
const MODES: usize = 6;
/// How far beyond the two frequencies of a material a mode may be, as a factor, to be one of those that its ratios are
/// for.
const BEYOND: f64 = 1.25;
/// Share of the asked ratio below which it is missed.
const MISSED: f64 = 0.5;
/// Share of its energy that a mode has in the damped beams at least: else it is not a vibration of theirs.
const OF_BEAMS: f64 = 0.5;

/// Tells the mode that misses the damping ratio of a material most, by bodies that move along.
pub fn missed_ratio(simulation: &Simulation) -> Option<String> {
    let document = simulation.document();
    let written = document.beams.iter().map(|beam| sections::written_damping(document, beam));
    let asked: Vec<(usize, Damping)> = written
        .enumerate()
        .filter_map(|(beam, damping)| Some((beam, damping?)))
        .filter(|(_, damping)| matches!(damping, Damping::Ratios { .. }))
        .collect();
    if asked.is_empty() || document.bodies.is_empty() || document.simulation.analysis != Analysis::Dynamic {
        return None;
    }
    let (system, state) = (simulation.system(), simulation.state());
    let found = modes(system, state, MODES).ok()?.modes;
    let ratios = damping_ratios(system, state, &found);
    // With a damping of 1 s in these beams alone: their strain energy in each mode, as `xᵀ K x`.
    let mut unit = system.clone();
    for (number, beam) in unit.beams.iter().enumerate() {
        let damping = f64::from(u8::from(asked.iter().any(|(own, _)| *own == number)));
        unit.mesh.elements[beam.element_range()].iter_mut().for_each(|element| element.set_damping(damping, 0.0));
    }
    let strains = material_rates(&unit, state, &found);
    let value = |number| document.value(number);
    // The least of the ratios that are asked for at this frequency, with its material.
    let wanted = |mode: &Mode| {
        let omega = mode.eigenvalue.sqrt();
        let of_beam = |(_, damping): &(usize, Damping)| {
            let Damping::Ratios { ratios, frequencies } = damping else { return None };
            let [low, high] = frequencies.map(|frequency| TAU * value(frequency));
            let [stiffness, mass] = damping.coefficients(value);
            let ratio = 0.5 * (stiffness * omega + mass / omega);
            (low <= BEYOND * omega && omega <= BEYOND * high).then_some((ratio, ratios[0]))
        };
        asked.iter().filter_map(of_beam).min_by(|a, b| a.0.total_cmp(&b.0))
    };
    let missed = found.iter().zip(&ratios).zip(&strains).enumerate().filter_map(|(number, ((mode, ratio), strain))| {
        if mode.kind != Kind::Vibration || *strain < OF_BEAMS * mode.eigenvalue {
            return None;
        }
        let (wanted, place) = wanted(mode)?;
        (*ratio < MISSED * wanted).then_some((number, mode, *ratio, wanted, place, *strain))
    });
    let (number, mode, ratio, wanted, place, strain) = missed.min_by(|a, b| (a.2 / a.3).total_cmp(&(b.2 / b.3)))?;
    let omega = mode.eigenvalue.sqrt();
    let mut cache = FrameCache::default();
    cache.set(system, &state.q, &state.triads);
    let elements = asked.iter().flat_map(|(beam, _)| system.beams[*beam].element_range());
    let kinetic: f64 = elements.map(|element| system.element_mass_form(element, cache.frames(), &mode.shape)).sum();
    Some(format!(
        "{}: {} is missed: mode {}, at {} Hz, has a damping ratio of {}, and {} is asked for at this frequency. Damping in proportion to mass acts on the masses of \
         beams, which have {} % of the kinetic energy of this mode; bodies have the rest. Take damping = {} instead, which acts on the strains of beams and gives this \
         ratio at this frequency, or dampers of joints; `ancf14 modes` lists the damping ratios",
        document.origin(document.place(place)),
        document.name(place),
        number + 1,
        short(omega / TAU),
        short(ratio),
        short(wanted),
        short(100.0 * kinetic),
        short(2.0 * omega * wanted / strain)
    ))
}

/// The nearest number of three digits, for messages.
fn short(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
