//! Force and moments of a section as its neighborhood tells them: smoother than what the section itself tells, and of a
//! higher order.
//!
//! An element of ANCF14 has the mean and the slope of its curvature right, but not its values at the ends, where
//! outputs mostly are: under a load across the beam they are off by `q l²/12`, at all nodes alike, so that nothing
//! jumps. The bend that neighbors show makes up for it (strain_fit.rs).
//!
//! The axial force has only its mean over an element right: neighbors share the stretch of the node between them, which
//! bends the line inside both. Its smooth values are those of a parabola with the means of three elements.

use super::strain_fit::{Line, Neighborhood, StrainFit, bend, mean, rise};
use crate::mechanics::beam::Beam;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::system::System;

/// What a neighborhood tells of a section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmoothForces {
    /// Axial force, N.
    pub axial: f64,
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
            sum.axial += share * self.smooth_axial(beam, element - beam.first_element, &neighborhood, c, x);
            for (sum, moment) in sum.moment.iter_mut().zip(forces.moment) {
                *sum += share * moment;
            }
        }
        Some(sum)
    }

    /// Axial force at `x` from the middle of element `number` of `beam`, m, in N: the parabola whose means over three
    /// elements are theirs. At the last element before an end it is the parabola of its neighbor, and a straight line
    /// where there are two elements only.
    fn smooth_axial(&self, beam: &Beam, number: usize, own: &Neighborhood, c: &Configuration, x: f64) -> f64 {
        let force = |fit: &StrainFit| fit.force();
        let [before, after] = own.differences(|before, after| rise(before, after, force));
        let second = |neighborhood: Neighborhood| neighborhood.second_difference(force);
        // A secant is the slope midway between the middles of both elements.
        let away = |neighbor: &Option<StrainFit>| 0.5 * neighbor.map_or(0.0, |fit| fit.length() + own.own.length());
        let (slope, bend) = match (before, after) {
            (Some(before), Some(after)) => (0.5 * (before + after), second(*own)),
            (Some(before), None) => {
                let bend = Neighborhood::of(self, beam, number - 1, c).map_or(0.0, second);
                (before + bend * away(&own.before), bend)
            }
            (None, Some(after)) => {
                let bend = Neighborhood::of(self, beam, number + 1, c).map_or(0.0, second);
                (after - bend * away(&own.after), bend)
            }
            (None, None) => (own.own.force().slope, 0.0),
        };
        let length = own.own.length();
        own.own.force().mean + slope * x + bend * (x * x - length * length / 12.0)
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

/// A quantity that elements have as a line, with the bend that neighbors show, at `x` from the middle of the element,
/// m.
fn smooth(neighborhood: &Neighborhood, quantity: impl Fn(&StrainFit) -> Line + Copy, x: f64) -> f64 {
    let own = &neighborhood.own;
    let bend = mean(neighborhood.differences(|before, after| bend(before, after, quantity)));
    quantity(own).at(x) + bend * (x * x - own.length() * own.length() / 12.0)
}
