//! How much strain energy a mesh leaves out: an estimate in the manner of Zienkiewicz and Zhu, from one state.
//!
//! The strains of each element are compared with smooth ones, which go through the means of both neighbors at the node
//! between them and bend as the slopes of neighbors do; the energy of the difference is what the elements cannot
//! follow. With `d` half of a jump at either end and `b` the part that a line leaves out (strain_fit.rs), at its ends
//! `c l²/6`, it is `EI/2 l ((d₀² + d₀ d₁ + d₁²)/3 + b²/5)`. In equilibrium under loads that share is by how much
//! displacements are off, of their own size.
//!
//! Only nodes at which nothing acts are compared: elsewhere strains may jump. An element without such a node bends at
//! least as the load across it does, its weight and the axial force times the curvature: `EI κ'' = q + N κ` inside it,
//! while the element has 0. A taut one takes the load as a string, `κ = q/N`.

use super::beam_scale::BeamScale;
use super::fiber_strain::FiberStrain;
use super::strain_fit::{Line, Neighborhood, StrainFit, bend, mean, rise};
use crate::math::Vec3;
use crate::math::quadrature::{LOBATTO_POINTS, LOBATTO_WEIGHTS};
use crate::mechanics::beam::Beam;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;
use serde::{Deserialize, Serialize};

/// Strains below this are round-off, or what Newton may leave.
const NO_STRAIN: f64 = 1e-8;

/// What beams do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Deformation {
    /// They bend.
    Bending,
    /// They twist.
    Torsion,
    /// They stretch.
    Stretching,
}

/// The element that leaves out most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Its number in the system.
    pub element: usize,
    /// What it leaves out most of.
    pub deformation: Deformation,
    /// The energy that it leaves out, J.
    energy: f64,
}

/// The strain energy of a state, and what its mesh leaves out.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshError {
    /// Strain energy of all beams, J.
    pub energy: f64,
    /// What the energy is of strains that are round-off, J.
    pub round_off: f64,
    /// What the mesh leaves out, J.
    pub left_out: f64,
    /// The element that leaves out most; none where nothing is left out.
    pub worst: Option<Worst>,
    /// What a strain of 1 amounts to.
    pub of_unit_strain: BeamScale,
    /// What the beams have relieved of their strains without stress.
    pub relieved: BeamScale,
    /// Of the element whose fibers strain most under a law of large strain.
    pub fibers: FiberStrain,
}

impl System {
    /// What the mesh leaves out of the state that `c` is.
    pub fn mesh_error(&self, c: &Configuration) -> MeshError {
        let mut error = MeshError::default();
        for beam in &self.beams {
            let length: f64 = beam.element_range().map(|element| self.mesh.elements[element].length()).sum();
            let (mut before, mut next) = (None, StrainFit::of(self, beam, 0, c));
            for number in 0..beam.elements() {
                let Some(own) = next else {
                    // Of ANCF24 only the energy is known.
                    error.energy += self.mesh.elements[beam.first_element + number].energy(&c.beams);
                    continue;
                };
                let goes_on = number + 1 < beam.elements();
                next = if goes_on { StrainFit::of(self, beam, number + 1, c) } else { None };
                let is_open = self.is_open(beam, number + 1);
                let neighborhood = Neighborhood { before, own, after: next.filter(|_| is_open) };
                self.account((beam, length), number, &neighborhood, c, &mut error);
                before = is_open.then_some(own);
            }
        }
        error
    }

    /// Adds what `neighborhood` tells of element `number` of `beam`, which has this length, m.
    fn account(
        &self,
        (beam, length_of_beam): (&Beam, f64),
        number: usize,
        neighborhood: &Neighborhood,
        c: &Configuration,
        error: &mut MeshError,
    ) {
        let element = beam.first_element + number;
        let own = &neighborhood.own;
        let fibers = FiberStrain::new(element, own);
        if fibers.largest() > error.fibers.largest() {
            error.fibers = fibers;
        }
        let length = own.length();
        error.energy += own.energy;
        error.of_unit_strain.add(&BeamScale::of_unit_strain(own, beam.young, self.size));
        if let Some(relieved) = BeamScale::relieved(own, beam.young, length_of_beam) {
            error.relieved.add(&relieved);
        }
        error.round_off += 0.5 * own.element.stiffness.axial * length * NO_STRAIN * NO_STRAIN;
        let is_alone = neighborhood.before.is_none() && neighborhood.after.is_none();
        let bending = match is_alone {
            true => self.bent_by_load(own, c),
            false => left_out(neighborhood, 0) + left_out(neighborhood, 1),
        };
        let stretching = match self.is_beside_jump(beam, number) {
            true => 0.0,
            false => left_out_of_stretching(neighborhood),
        };
        let parts = [
            (Deformation::Bending, bending),
            (Deformation::Torsion, left_out(neighborhood, 2)),
            (Deformation::Stretching, stretching),
        ];
        for (deformation, energy) in parts {
            error.left_out += energy;
            if energy > error.worst.map_or(0.0, |worst| worst.energy) {
                error.worst = Some(Worst { element, deformation, energy });
            }
        }
    }

    /// Energy of the bending inside an element that the loads across it ask for beyond a line, J.
    fn bent_by_load(&self, own: &StrainFit, c: &Configuration) -> f64 {
        let length = own.length();
        let [first, second] = own.element.frames(&c.beams);
        let chord = (first.t + second.t).try_normalize(0.0).unwrap_or_else(Vec3::zeros);
        let weight = self.gravity * own.element.inertia.line_density;
        let across = (weight - chord * weight.dot(&chord)).norm();
        let square = |line: &Line| line.mean * line.mean + (line.slope * length).powi(2) / 12.0;
        let curvature = (square(&own.strains[0]) + square(&own.strains[1])).sqrt();
        let rigidity = own.rigidities[0].min(own.rigidities[1]);
        let force = own.force().mean;
        // A taut element bends within its bending length at its ends only, and hangs as a string between: its curvature
        // is the load over the tension there.
        let stiffness = 12.0 * rigidity / (length * length) + force.max(0.0);
        let beyond = (across + force.abs() * curvature) / stiffness;
        0.5 * rigidity * length * beyond * beyond / 5.0
    }

    /// The ends of element `number` in fractions of the length of `beam`.
    pub fn ends_of(beam: &Beam, number: usize) -> [f64; 2] {
        [number, number + 1].map(|end| beam.division.fraction(end).unwrap_or(1.0))
    }
}

/// Energy of strain `k` that an element leaves out, J.
fn left_out(neighborhood: &Neighborhood, k: usize) -> f64 {
    let own = &neighborhood.own;
    let length = own.length();
    let line = |fit: &StrainFit| if fit.is_line(k) { fit.strains[k] } else { Line { slope: 0.0, ..fit.strains[k] } };
    let jump = |before: &StrainFit, after: &StrainFit| {
        line(after).at(-0.5 * after.length()) - line(before).at(0.5 * before.length())
    };
    let [first, second] = neighborhood.differences(jump).map(|jump| 0.5 * jump.unwrap_or(0.0));
    // At its first end the smooth strain is half a jump below the element's own, at its second end above.
    let jumps = (first * first - first * second + second * second) / 3.0;
    // Squares: bends that alternate do not cancel.
    let bends = neighborhood.differences(|before, after| bend(before, after, line).powi(2));
    let beyond = mean(bends) * (length * length / 6.0).powi(2) / 5.0;
    0.5 * own.rigidities[k] * length * (jumps + beyond)
}

/// Energy of stretching that an element leaves out, J: its axial force against the line that the means of neighbors
/// make.
fn left_out_of_stretching(neighborhood: &Neighborhood) -> f64 {
    let own = &neighborhood.own;
    let (length, force) = (own.length(), own.force());
    let slope = match neighborhood.differences(|before, after| rise(before, after, |fit| fit.force())) {
        [None, None] => force.slope,
        slopes => mean(slopes),
    };
    let squares = own.forces.iter().zip(LOBATTO_POINTS).zip(LOBATTO_WEIGHTS).map(|((own, xi), weight)| {
        let off = own - force.mean - slope * (xi - 0.5) * length;
        weight * off * off
    });
    let square: f64 = squares.sum();
    0.5 * length * square / own.element.stiffness.axial
}
