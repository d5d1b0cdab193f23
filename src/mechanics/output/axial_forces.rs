//! How far a beam is pulled and pushed along its axis, by the strains of its elements.

use super::strain_fit::StrainFit;
use crate::math::quadrature::LOBATTO_WEIGHTS;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;

/// Axial strain that is round-off, or what Newton may leave.
const NO_STRAIN: f64 = 1e-8;

impl System {
    /// The smallest and the largest mean axial force over an element of beam `beam`, N, and 0 between them; round-off
    /// is 0, and elements of ANCF24 are left out.
    pub fn axial_forces(&self, beam: usize, c: &Configuration) -> [f64; 2] {
        let beam = &self.beams[beam];
        let means = (0..beam.elements()).filter_map(|number| {
            let fit = StrainFit::of(self, beam, number, c)?;
            let mean: f64 = LOBATTO_WEIGHTS.iter().zip(fit.forces).map(|(weight, force)| weight * force).sum();
            (mean.abs() > NO_STRAIN * fit.element.stiffness.axial).then_some(mean)
        });
        means.fold([0.0; 2], |[smallest, largest], mean| [f64::min(smallest, mean), f64::max(largest, mean)])
    }
}
