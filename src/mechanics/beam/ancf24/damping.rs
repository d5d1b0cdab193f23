//! Kelvin-Voigt damping: `stress = C (strain + c rate)` with `c` in s, over all strains of the energy, at its own
//! fibers.
//!
//! Strains are quadratic in the coordinates: over a step their rate is the change of the strains over its length, and a
//! rigid motion, however fast, is not damped at all.

use super::element::Element;

/// Adds the viscous force over a step of length `h` from the coordinates `start` to `end` (24 each), with `middle`
/// between them, to `forces`: `∂strain(middle)ᵀ c C (strain(end) − strain(start))/h`.
pub fn add_force_over_step(element: &Element, [start, middle, end]: [&[f64]; 3], h: f64, forces: &mut [f64]) {
    add_over_step(element, [start, middle, end], h, forces, None);
}

/// [`add_force_over_step`], and adds `scale` times twice its derivative by the coordinates at the end of the step to
/// `block`, 24×24.
pub fn add_force_and_tangent_over_step(
    element: &Element,
    places: [&[f64]; 3],
    h: f64,
    scale: f64,
    forces: &mut [f64],
    block: &mut [f64],
) {
    add_over_step(element, places, h, forces, Some((scale, block)));
}

fn add_over_step(
    element: &Element,
    places: [&[f64]; 3],
    h: f64,
    forces: &mut [f64],
    mut tangent: Option<(f64, &mut [f64])>,
) {
    let viscosity = element.properties.damping;
    for station in &element.stations {
        let [start, middle, end] = places.map(|q| station.interpolation.directors(q));
        // The change of the products between both ends is their rate at the middle.
        let rates = station.strain_rates(&middle, &((end - start) / h));
        let stresses = station.stresses(&rates.map(|rate| rate * viscosity));
        station.interpolation.spread(&station.forces(&middle, &stresses), forces);
        if let Some((scale, block)) = &mut tangent {
            let matrix = station.stiffness(&middle, &stresses, &end, 2.0 * viscosity / h);
            station.interpolation.add_spread(&matrix, *scale, block);
        }
    }
}

/// Adds the viscous force at the velocities `velocity` (24) to `forces`.
pub fn add_force(element: &Element, q: &[f64], velocity: &[f64], forces: &mut [f64]) {
    add_at_instant(element, q, velocity, forces, None);
}

/// [`add_force`], and adds `scale` times its derivative by the coordinates to `block`, 24×24.
pub fn add_force_and_tangent(
    element: &Element,
    q: &[f64],
    velocity: &[f64],
    scale: f64,
    forces: &mut [f64],
    block: &mut [f64],
) {
    add_at_instant(element, q, velocity, forces, Some((scale, block)));
}

fn add_at_instant(
    element: &Element,
    q: &[f64],
    velocity: &[f64],
    forces: &mut [f64],
    mut tangent: Option<(f64, &mut [f64])>,
) {
    let viscosity = element.properties.damping;
    for station in &element.stations {
        let [here, rate] = [q, velocity].map(|q| station.interpolation.directors(q));
        let rates = station.strain_rates(&here, &rate);
        let stresses = station.stresses(&rates.map(|rate| rate * viscosity));
        station.interpolation.spread(&station.forces(&here, &stresses), forces);
        if let Some((scale, block)) = &mut tangent {
            let matrix = station.stiffness(&here, &stresses, &rate, viscosity);
            station.interpolation.add_spread(&matrix, *scale, block);
        }
    }
}

/// Adds `factor` times the derivative of [`add_force`] by the velocities to `block`, 24×24.
pub fn add_force_v(element: &Element, q: &[f64], factor: f64, block: &mut [f64]) {
    for station in &element.stations {
        let here = station.interpolation.directors(q);
        let matrix = station.stiffness(&here, &Default::default(), &here, element.properties.damping);
        station.interpolation.add_spread(&matrix, factor, block);
    }
}
