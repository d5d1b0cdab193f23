//! Winches: beams that are paid out, and their share in energies and momenta (MECHANICS 3.11).

use super::System;
use crate::error::Error;
use crate::math::Vec3;
use crate::mechanics::beam::ancf14::paid_out::PaidOut;
use crate::mechanics::beam::ancf14::payout::SMALLEST_EXTENT;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::{Configuration, TimeStep};

/// A beam that is paid out.
#[derive(Clone, Debug)]
pub struct Winch {
    /// The beam.
    pub beam: usize,
    /// Number of the drive that says how much, m.
    pub drive: usize,
    /// Length of the beam as drawn, m.
    pub length: f64,
}

impl System {
    /// The elements of all beams that are paid out.
    fn paid_out(&self) -> impl Iterator<Item = &PaidOut> + '_ {
        let elements = |winch: &Winch| &self.mesh.elements[self.beams[winch.beam].element_range()];
        self.winches.iter().flat_map(elements).filter_map(AnyElement::paid_out)
    }

    /// Kinetic energy that the velocities of the material have beyond those of the mesh, J.
    pub fn transport_energy(&self, c: &Configuration, velocity: &[f64]) -> f64 {
        let energy = |element: &PaidOut| element.transport_energy(&c.beams, velocity);
        if is_at_rest(velocity) { 0.0 } else { self.paid_out().map(energy).sum() }
    }

    /// Linear (kg m/s) and angular momentum (kg m²/s) about the origin: `sum`, those of the mesh, with what passes
    /// through it.
    pub fn with_transport(&self, mut sum: [Vec3; 2], c: &Configuration, velocity: &[f64]) -> [Vec3; 2] {
        if is_at_rest(velocity) {
            return sum;
        }
        for element in self.paid_out() {
            let [linear, angular] = element.transport_momentum(&c.beams);
            sum[0] += linear;
            sum[1] += angular + self.origin.cross(&linear);
        }
        sum
    }

    /// Energy that winches have given to the weight of beams over a step whose middle is `c`, J.
    pub(super) fn lifted_by_winches(&self, c: &Configuration, step: &TimeStep, gravity: &Vec3) -> f64 {
        let step = step.of_beams();
        self.paid_out().map(|element| element.lifted(&c.beams, &step, (gravity, &self.origin))).sum()
    }

    /// Power of loads by the velocity of material past the mesh, W.
    pub(super) fn passing_power_of_loads(&self, c: &Configuration, excitation: &Excitation) -> f64 {
        if self.winches.is_empty() {
            return 0.0;
        }
        self.loads.iter().zip(&excitation.wrenches).map(|(load, wrench)| load.passing_power(c, wrench)).sum()
    }

    /// Length of the slope of node `node` without load, 1.
    pub(super) fn free_slope(&self, node: usize, c: &Configuration) -> f64 {
        let is_own = |winch: &&Winch| self.beams[winch.beam].node_range().contains(&node);
        let element = |winch: &Winch| &self.mesh.elements[self.beams[winch.beam].first_element];
        self.winches.iter().find(is_own).map_or(1.0, |winch| element(winch).extent(c.beams.drives))
    }

    /// Checks that winches at the end `c` of a step or increment leave something of their beams.
    ///
    /// # Errors
    /// One does not.
    pub(super) fn check_winches(&self, c: &Configuration, time: f64) -> Result<(), Error> {
        for winch in &self.winches {
            let paid = c.beams.drives.get(winch.drive).map_or(0.0, |drive| drive.value);
            let (left, least) = (winch.length + paid, SMALLEST_EXTENT * winch.length);
            if left < least {
                let winch = self.drives[winch.drive].name.clone();
                return Err(Error::HauledIn { time, winch, left, least });
            }
        }
        Ok(())
    }
}

/// Whether the velocities are those of an equilibrium: the winches of a static analysis have rates, but move nothing.
pub(super) fn is_at_rest(velocity: &[f64]) -> bool {
    velocity.iter().all(|value| *value == 0.0)
}
