//! What forces and strains of beams are compared with where they are nearly none: those that their strains amount to.

use super::strain_fit::StrainFit;
use serde::{Deserialize, Serialize};

/// A load at its end bends a cantilever as far as a uniform moment `M` does if it is `1.5 M` over the length.
const END_LOAD: f64 = 1.5;

/// The size of each kind of quantity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BeamScale {
    /// Strain energy of all beams, J.
    pub energy: f64,
    /// Largest force, N.
    pub force: f64,
    /// Largest moment, N m.
    pub moment: f64,
    /// Largest stress, Pa.
    pub stress: f64,
    /// Largest strain of a fiber, 1.
    pub strain: f64,
    /// Largest curvature or torsion, 1/m or rad/m.
    pub curvature: f64,
}

impl BeamScale {
    /// What a strain of 1 would amount to in an element of Young's modulus `young`, Pa, fitted by `fit`, in a system of
    /// this `size`, m.
    pub fn of_unit_strain(fit: &StrainFit, young: f64, size: f64) -> Self {
        let axial = fit.element.stiffness.axial;
        let rigidity = fit.rigidities.iter().fold(0.0, |most: f64, own| own.max(most));
        Self {
            energy: 0.5 * axial * fit.length(),
            force: axial,
            moment: rigidity / size,
            stress: young,
            strain: 1.0,
            curvature: 1.0 / size,
        }
    }

    /// What an element of Young's modulus `young`, Pa, of a beam of this `length`, m, has relieved of its strains
    /// without stress; nothing where it has none.
    pub fn relieved(fit: &StrainFit, young: f64, length: f64) -> Option<Self> {
        let relief = fit.relief?;
        // The half side of a rectangle with the same rigidities: I = A side²/12.
        let radius = (3.0 * fit.rigidities[0].max(fit.rigidities[1]) / fit.element.stiffness.axial).sqrt();
        let strain = relief.strain + radius * relief.curvature;
        Some(Self {
            energy: relief.energy,
            force: relief.force.max(END_LOAD * relief.moment / length),
            moment: relief.moment,
            stress: young * strain,
            strain,
            curvature: relief.curvature,
        })
    }

    /// Adds another element.
    pub fn add(&mut self, other: &Self) {
        let energy = self.energy + other.energy;
        self.include(other);
        self.energy = energy;
    }

    /// Takes the larger one of each.
    pub fn include(&mut self, other: &Self) {
        self.energy = self.energy.max(other.energy);
        self.force = self.force.max(other.force);
        self.moment = self.moment.max(other.moment);
        self.stress = self.stress.max(other.stress);
        self.strain = self.strain.max(other.strain);
        self.curvature = self.curvature.max(other.curvature);
    }

    /// The size of what has this unit; 0: it is no quantity of beams.
    pub fn of(&self, unit: &str) -> f64 {
        match unit {
            "J" => self.energy,
            "N" => self.force,
            "N.m" => self.moment,
            "Pa" => self.stress,
            "" => self.strain,
            "1/m" | "rad/m" => self.curvature,
            _ => 0.0,
        }
    }
}
