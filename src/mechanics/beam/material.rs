//! Linear elastic, isotropic material.

/// Stiffness and density of a beam's material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus E, Pa.
    pub young: f64,
    /// Shear modulus G, Pa.
    pub shear: f64,
    /// Density ρ, kg/m³.
    pub density: f64,
    /// Kelvin-Voigt damping, s: `stress = E (strain + damping · rate)`.
    pub damping: f64,
}

impl Material {
    /// `G = E / (2 (1 + ν))`, Pa.
    pub fn shear_from_poisson(young: f64, poisson: f64) -> f64 {
        young / (2.0 * (1.0 + poisson))
    }
}
