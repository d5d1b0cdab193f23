//! Force and moments of a section as its neighborhood tells them: smoother than what the section itself tells, and of a higher order.
//!
//! An element of ANCF14 has the mean and the slope of its curvature right, but not its values at the ends, where outputs mostly are: under a load across the
//! beam they are off by `q l²/12`, at all nodes alike, so that nothing jumps. The bend that neighbors show makes up for it (strain_fit.rs).

use super::strain_fit::{Line, Neighborhood, StrainFit, bend, mean, rise};
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::system::System;

/// What a neighborhood tells of a section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmoothForces {
    /// Axial force, N.
    pub axial: f64,
    /// Shear force, N: how the bending moment changes. What is axial force here is shear round a corner.
    pub shear: f64,
    /// Torque and moments about y and z, section axes, N m.
    pub moment: [f64; 3],
}

impl System {
    /// Force and moments at `sensor`, at an inner node the mean of both elements'; none off the beams of ANCF14.
    pub fn smooth_forces(&self, c: &Configuration, sensor: &Sensor) -> Option<SmoothForces> {
        let (beam, _) = sensor.on_beam?;
        let (beam, axial) = (&self.beams[beam], sensor.strains(c).axial);
        let share = 1.0 / sensor.places().count() as f64;
        let mut sum = SmoothForces::default();
        for (element, xi) in sensor.places() {
            let neighborhood = Neighborhood::of(self, beam, element - beam.first_element, c)?;
            let x = (xi - 0.5) * neighborhood.own.length();
            let strains = [0, 1, 2].map(|k| smooth_strain(&neighborhood, k, x));
            let strains = neighborhood.own.section_strains(axial, strains);
            let forces = neighborhood.own.section_forces(x, &strains);
            sum.axial += share * smooth(&neighborhood, |fit| fit.force(), x);
            let StrainFit { strains: [about_z, about_y, _], rigidities: [for_z, for_y, _], .. } = neighborhood.own;
            sum.shear += share * (for_z * about_z.slope).hypot(for_y * about_y.slope);
            for (sum, moment) in sum.moment.iter_mut().zip(forces.moment) {
                *sum += share * moment;
            }
        }
        Some(sum)
    }
}

/// Strain `k` at `x` from the middle of the element, m.
fn smooth_strain(neighborhood: &Neighborhood, k: usize, x: f64) -> f64 {
    let line = |fit: &StrainFit| fit.strains[k];
    if neighborhood.own.is_line(k) {
        smooth(neighborhood, line, x)
    } else {
        // Of a constant the mean is right.
        let slope = mean(neighborhood.differences(|before, after| rise(before, after, line)));
        neighborhood.own.strains[k].mean + slope * x
    }
}

/// A quantity that elements have as a line, with the bend that neighbors show, at `x` from the middle of the element, m.
fn smooth(neighborhood: &Neighborhood, quantity: impl Fn(&StrainFit) -> Line + Copy, x: f64) -> f64 {
    let own = &neighborhood.own;
    let bend = mean(neighborhood.differences(|before, after| bend(before, after, quantity)));
    quantity(own).at(x) + bend * (x * x - own.length() * own.length() / 12.0)
}
