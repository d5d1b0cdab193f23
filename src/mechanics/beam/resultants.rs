//! What is told of a section: its strains, the force and moments that it transmits, the largest stress on its outline.
//!
//! Signs as in docs/language/outputs.md: forces and moments are what the part towards the beam's end exerts on the part
//! towards its start. The fiber at (y, z) has the strain `axial + z curvature_y − y curvature_z`.

use super::section::Outline;

/// A section with whatever strains it has; as drawn it is what strains are counted from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionShape {
    /// `|r'|` by the element's length, 1.
    pub stretch: f64,
    /// Curvature about y and about z by the element's length, 1/m.
    pub curvature: [f64; 2],
    /// Torsion by the element's length, rad/m.
    pub torsion: f64,
}

/// Strains of a section, undeformed values taken off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionStrains {
    /// Axial strain `|r'|/J0 − 1`, 1.
    pub axial: f64,
    /// Curvature about y and about z, 1/m.
    pub curvature: [f64; 2],
    /// Torsion, rad/m.
    pub torsion: f64,
}

/// Force and moments of a section. They come from the elastic energy alone: viscous stress of a damped beam is not in
/// them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionForces {
    /// Axial force along the tangent, tension positive, N.
    pub axial: f64,
    /// Torque and moments about y and z, section axes, N m.
    pub moment: [f64; 3],
}

/// The point of a section that bears the largest stress of one state, and how its stress changes around that state: the
/// largest stress itself has kinks where another point takes over.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fiber {
    /// y and z, m.
    place: [f64; 2],
    /// `∂s/∂σ` and `∂s/∂τ` of `s = sqrt(σ² + 3 τ²)`, 1; 0 where there is no stress.
    slopes: [f64; 2],
}

impl Fiber {
    /// The one that bears most; arguments as of [`largest_stress`].
    pub fn worst(outline: &Outline, young: f64, torque: f64, strains: &SectionStrains) -> Option<Self> {
        let place = outline.farthest_point(strains.axial, &strains.curvature)?;
        // Without stress both slopes are 0.
        let stress = largest_stress(outline, young, torque, strains)?.max(f64::MIN_POSITIVE);
        let fiber = Self { place, slopes: [0.0; 2] };
        let normal = young * fiber.strain(strains);
        let shear = torque / outline.torsion_modulus()?;
        Some(Self { slopes: [normal / stress, 3.0 * (shear / stress)], ..fiber })
    }

    /// Its stress near that state, to first order in `σ` and `τ`, Pa.
    pub fn stress(&self, outline: &Outline, young: f64, torque: f64, strains: &SectionStrains) -> Option<f64> {
        let [by_normal, by_shear] = self.slopes;
        Some(by_normal * young * self.strain(strains) + by_shear * torque / outline.torsion_modulus()?)
    }

    fn strain(&self, strains: &SectionStrains) -> f64 {
        let ([y, z], [about_y, about_z]) = (self.place, strains.curvature);
        strains.axial + z * about_y - y * about_z
    }
}

/// Largest von Mises stress `sqrt(σ² + 3 τ²)` over `outline`, Pa; none if the outline is not known.
///
/// `σ = young · (fiber strain)`, linear over the section: squares of curvature and torsion are left out. `τ` is the
/// largest shear that the Saint-Venant torque `torque`, N m, makes in the shape itself, also where its torsion constant
/// is given differently. Circles and tubes have it all along the outline; for a rectangle, whose corners bear `σ` and
/// the middles of whose long sides `τ`, it is taken everywhere: an upper bound.
pub fn largest_stress(outline: &Outline, young: f64, torque: f64, strains: &SectionStrains) -> Option<f64> {
    let normal = young * outline.largest_strain(strains.axial, &strains.curvature)?;
    let shear = torque / outline.torsion_modulus()?;
    Some((normal * normal + 3.0 * shear * shear).sqrt())
}
