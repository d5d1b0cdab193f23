//! One ANCF24 element: its stations, and the energy by the 24 coordinates.

use super::coordinates::{Directors, ELEMENT, Interpolation};
use super::inertia::Mass;
use super::station::{Fibers, Station};
use super::strain::VoigtMatrix;
use crate::math::quadrature::{FIVE_POINTS, FIVE_WEIGHTS};
use crate::math::{Vec3, hermite};

/// What a beam's elements have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// Stresses by strains in the section's axes, Pa.
    pub law: VoigtMatrix,
    /// The fibers of its section.
    pub fibers: Fibers,
    /// `ρA`, kg/m.
    pub line_density: f64,
    /// `ρ ∫ y² dA`, `ρ ∫ z² dA`, kg m.
    pub section_inertia: [f64; 2],
    /// Kelvin-Voigt damping: what multiplies the strain rate, s; 0: none.
    pub damping: f64,
}

/// One element of a beam; never changes but for its damping.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// First coordinate of its first node; those of the second node follow.
    pub start: usize,
    /// Undeformed length l, m.
    pub length: f64,
    /// What it has in common with the others of its beam.
    pub properties: Properties,
    /// Where the energy is evaluated: five Gauss points along the axis, 2 × 2 fibers each.
    pub stations: Vec<Station>,
    /// Undeformed coordinates (24).
    pub reference: [f64; ELEMENT],
    /// Constant mass matrix.
    pub mass: Mass,
}

impl Element {
    /// An element that is stress free at the coordinates `reference` (24).
    pub fn new(start: usize, length: f64, properties: Properties, reference: &[f64; ELEMENT]) -> Self {
        let Properties { law, fibers, line_density, section_inertia, .. } = &properties;
        let station = |(xi, weight): (f64, f64)| Station::new(xi, length, reference, fibers, law, weight * length);
        Self {
            start,
            length,
            properties,
            stations: FIVE_POINTS.into_iter().zip(FIVE_WEIGHTS).map(station).collect(),
            reference: *reference,
            mass: Mass::new(*line_density, *section_inertia, length),
        }
    }

    /// Its coordinates (24) among those `q` of the whole system.
    pub fn own<'a>(&self, q: &'a [f64]) -> &'a [f64] {
        &q[self.start..self.start + ELEMENT]
    }

    /// Generalized weight in the gravity field `gravity` (m/s²) on the four vectors of the axis: the others have none.
    pub fn weight(&self, gravity: &Vec3) -> [Vec3; 4] {
        hermite::integrals(self.length).map(|integral| gravity * (self.properties.line_density * integral))
    }

    /// Strain energy at its coordinates `q` (24), J.
    pub fn energy(&self, q: &[f64]) -> f64 {
        let energy = |station: &Station| {
            let directors = station.interpolation.directors(q);
            let strains = station.strains(&directors, &Directors::zeros());
            let stresses = station.stresses(&strains);
            strains.iter().zip(&stresses).map(|(strain, stress)| 0.5 * strain.dot(stress)).sum::<f64>()
        };
        self.stations.iter().map(energy).sum()
    }

    /// Adds `∂U/∂q` to `forces` (24); with the `increment` (24) over a step whose middle is `q`, the strains are the
    /// mean of both ends', so that the force works as much as the energy changes (MECHANICS 7.6; here that is so for
    /// all strains).
    pub fn add_gradient(&self, q: &[f64], increment: Option<&[f64]>, forces: &mut [f64]) {
        for station in &self.stations {
            let [directors, change] = directors(&station.interpolation, q, increment);
            let stresses = station.stresses(&station.strains(&directors, &change));
            station.interpolation.spread(&station.forces(&directors, &stresses), forces);
        }
    }

    /// [`Self::add_gradient`], and adds `scale` times the Hessian to the column-major `block`, 24×24; over a step twice
    /// the derivative by the coordinates at its end (slightly unsymmetric).
    pub fn add_gradient_and_hessian(
        &self,
        q: &[f64],
        increment: Option<&[f64]>,
        scale: f64,
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        for station in &self.stations {
            let [directors, change] = directors(&station.interpolation, q, increment);
            let stresses = station.stresses(&station.strains(&directors, &change));
            station.interpolation.spread(&station.forces(&directors, &stresses), forces);
            let end = directors + change * 0.5;
            let hessian = station.stiffness(&directors, &stresses, &end, 1.0);
            station.interpolation.add_spread(&hessian, scale, block);
        }
    }
}

/// Directors at the coordinates `q`, and what they change by over a step.
fn directors(interpolation: &Interpolation, q: &[f64], increment: Option<&[f64]>) -> [Directors; 2] {
    let change = increment.map_or_else(Directors::zeros, |increment| interpolation.directors(increment));
    [interpolation.directors(q), change]
}
