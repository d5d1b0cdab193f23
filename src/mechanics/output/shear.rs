//! The share of shear in a small motion: beams here do not shear, and this says how much that leaves out.
//!
//! A motion bends a beam by moments `M = EI κ`, whose change along the beam is the shear force `V = dM/ds`. Under it a
//! section of the shear stiffness `k G A` would give by the energy `½ ∫ V²/(k G A) ds` (Cowper 1966 has the factors
//! `k`).

use super::strain_fit::StrainFit;
use crate::mechanics::beam::Beam;
use crate::mechanics::beam::section::{Outline, Section};
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;

/// How far the motion goes for a difference, as [`System::motion_size`] measures.
const REACH: f64 = 1e-5;

impl System {
    /// `∫ V²/(k G A) ds` of all beams in the small motion `motion` about `state`: twice the energy of the shear that is
    /// left out, J; none: a beam has sections whose shear stiffness is not known. Chains, which do not bend, have none.
    pub fn shear_form(&self, state: &State, motion: &[f64]) -> Option<f64> {
        let size = self.motion_size(motion);
        if size == 0.0 || !size.is_finite() {
            return None;
        }
        let reach = REACH / size;
        let slopes = [reach, -reach].map(|reach| {
            let q: Vec<f64> = state.q.iter().zip(motion).map(|(value, change)| value + reach * change).collect();
            self.slopes_of_moments(state, &q)
        });
        let [ahead, behind] = &slopes;
        let elements = self.beams.iter().flat_map(|beam| (0..beam.elements()).map(move |number| (beam, number)));
        let forms = elements.zip(ahead.iter().zip(behind)).map(|((beam, number), (ahead, behind))| {
            let stiffness = self.shear_stiffness(beam, number)?;
            let force = [0, 1].map(|axis| (ahead[axis] - behind[axis]) / (2.0 * reach));
            let length = self.mesh.elements[beam.first_element + number].ancf14().map_or(0.0, |own| own.length);
            Some(length * (force[0] * force[0] + force[1] * force[1]) / stiffness)
        });
        forms.sum()
    }

    /// How the moments about z and y change along each element at `q`, N.
    fn slopes_of_moments(&self, state: &State, q: &[f64]) -> Vec<[f64; 2]> {
        let mut frames = FrameCache::default();
        let c = frames.at(self, q, state, &state.prescribed);
        let elements = self.beams.iter().flat_map(|beam| (0..beam.elements()).map(move |number| (beam, number)));
        let slopes = elements.map(|(beam, number)| {
            let fit = StrainFit::of(self, beam, number, &c);
            fit.map_or([0.0; 2], |fit| [0, 1].map(|axis| fit.rigidities[axis] * fit.strains[axis].slope))
        });
        slopes.collect()
    }

    /// `k G A` of an element of `beam`, N, infinite of a chain; none: it is not known.
    fn shear_stiffness(&self, beam: &Beam, number: usize) -> Option<f64> {
        let element = self.mesh.elements[beam.first_element + number].ancf14()?;
        let section: Section = beam.section_at((number as f64 + 0.5) / beam.elements() as f64);
        if section.limp.bending {
            return Some(f64::INFINITY);
        }
        if section.limp.torsion {
            return None;
        }
        let modulus = element.stiffness.torsion / section.torsion_constant;
        let poisson = 0.5 * beam.young / modulus - 1.0;
        let stiffness = factor(&section.outline, poisson)? * modulus * section.area;
        (stiffness.is_finite() && stiffness > 0.0).then_some(stiffness)
    }
}

/// Cowper's factor of the shear stiffness for Poisson's ratio `poisson`; none: it is not known.
fn factor(outline: &Outline, poisson: f64) -> Option<f64> {
    match outline {
        Outline::Rectangle { .. } => Some(10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson)),
        Outline::Circle { .. } | Outline::Ellipse { .. } => Some(6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson)),
        Outline::Tube { inner, outer } => {
            let square = (inner / outer).powi(2);
            let whole = (1.0 + square).powi(2);
            let bound = (7.0 + 6.0 * poisson) * whole + (20.0 + 12.0 * poisson) * square;
            Some(6.0 * (1.0 + poisson) * whole / bound)
        }
        Outline::Walls { .. } | Outline::General => None,
    }
}
