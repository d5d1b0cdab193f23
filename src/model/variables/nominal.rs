//! The order of magnitude of inputs and results, FMI's `nominal`: what a host compares a value with. A mechanism as
//! drawn gives a length `L`, its largest extent, and a mass `M`; with gravity `g` also a time, `T = √(L/g)`. A quantity
//! of kg^a m^b s^c is then of the order `M^a L^b T^c`: its weight for forces, the speed of a fall from its height for
//! velocities.

use crate::fmi::Value;
use crate::fmi::variable::{Causality, Exponents, Variable};
use crate::math::elementary::log10;
use crate::mechanics::system::System;

/// Gravity below which a fall over the extent takes longer than any run, m/s². The denominator is at least that: the
/// compiler computes the quotient before it tests whether there is gravity, and hosts may trap a division by 0.
const LEAST_GRAVITY: f64 = 1e-30;

/// What a mechanism is measured by.
#[derive(Clone, Copy, Debug)]
pub struct Scales {
    /// Largest extent as drawn, m.
    length: f64,
    /// Mass of everything, kg.
    mass: f64,
    /// Time of a fall over the extent, s; none: there is no gravity.
    time: Option<f64>,
}

impl Scales {
    /// What `system` is measured by.
    pub fn of(system: &System) -> Self {
        let gravity = system.gravity.norm();
        let time = (gravity > 0.0).then(|| (system.size / gravity.max(LEAST_GRAVITY)).sqrt());
        Self { length: system.size, mass: system.mass, time }
    }

    /// The order of magnitude of a variable; none where the mechanism says nothing: of parameters, counts, angles,
    /// strains and stresses, and without gravity of all that has to do with time.
    pub fn nominal(&self, variable: &Variable) -> Option<f64> {
        let measured = matches!(variable.causality, Causality::Input | Causality::Output);
        let Value::Real(_) = variable.start else { return None };
        let Exponents { kg, m, s, kelvin, .. } = variable.quantity.exponents.filter(|_| measured)?;
        // Stresses follow from sections, which are far smaller than the mechanism.
        let is_stress = kg > 0 && m < 0;
        // A time is the parameter of a static path, which has nothing to do with a fall.
        let is_time = [kg, m, s] == [0, 0, 1];
        if [kg, m, s] == [0; 3] || kelvin != 0 || is_stress || is_time {
            return None;
        }
        let time = if s == 0 { 1.0 } else { self.time? };
        let size = self.mass.powi(kg) * self.length.powi(m) * time.powi(s);
        // A power of ten: the last digits of a square root mean nothing.
        (size.is_finite() && size > 0.0).then(|| format!("1e{}", log10(size).round()).parse().ok()).flatten()
    }
}
