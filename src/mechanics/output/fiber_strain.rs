//! How far fibers of sections strain, and by how much the law of large strain then departs from rigidities: forces and
//! moments in proportion to elongation and curvature.
//!
//! The law is linear between Green's strain and its stress (MECHANICS 3.2b). A beam of a rectangular section that is
//! bent without an axial force has the moment `EI κ (1 − 1.2 ε²)`, `ε` the strain of its outermost fibers, and without
//! bending the axial force is `EA ε (1 + 1.5 ε)`. The size of a section is that of the rectangle with its rigidities.

use super::strain_fit::StrainFit;
use crate::mechanics::beam::ancf14::strain::Strain;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;

/// Strain of fibers from which the law is worth a word: bending differs from its rigidities by 0.8 % there.
pub const NOTABLE: f64 = 0.08;

/// Strains of the fibers of an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FiberStrain {
    /// Number of the element in the system.
    pub element: usize,
    /// Largest strain of a fiber by bending, 1.
    pub bending: f64,
    /// Largest axial strain in size, 1.
    pub axial: f64,
}

impl FiberStrain {
    /// Of element `element`, fitted by `fit`; zero where its law is linear.
    pub fn new(element: usize, fit: &StrainFit) -> Self {
        if fit.element.stiffness.strain == Strain::Small {
            return Self { element, ..Self::default() };
        }
        let half = 0.5 * fit.length();
        let fiber = |k: usize| {
            let curvature = fit.strains[k].at(-half).abs().max(fit.strains[k].at(half).abs());
            // Half of the rectangle's side: I = A side²/12.
            curvature * (3.0 * fit.rigidities[k] / fit.element.stiffness.axial).sqrt()
        };
        let axial = fit.elongations.iter().fold(0.0, |most, own| own.abs().max(most));
        Self { element, bending: fiber(0) + fiber(1), axial }
    }

    /// Largest strain of a fiber, 1.
    pub fn largest(&self) -> f64 {
        self.bending + self.axial
    }

    /// By how much bending moments and axial forces differ from the rigidities' own, as shares of them.
    pub fn departure(&self) -> [f64; 2] {
        [1.25 * self.bending * self.bending, 1.5 * self.axial]
    }
}

impl System {
    /// The law of large strain as a cause of a path that breaks off at `c`, in words that continue a sentence; empty
    /// where no fiber strains far.
    pub fn doubt_of_strain(&self, c: &Configuration) -> String {
        let fibers = self.mesh_error(c).fibers;
        if fibers.largest() < NOTABLE {
            return String::new();
        }
        format!(
            ", or the cause is the law of strain = \"large\" in beam {}, whose fibers strain by about {:.0} %: take strain = \"small\" for it, which keeps \
             forces and moments in proportion to elongation and curvature",
            self.beam_of(fibers.element).0.name,
            100.0 * fibers.largest()
        )
    }
}
