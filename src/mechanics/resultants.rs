//! Section forces, the derivatives of the energy per undeformed length by the strains of a section, and the stress on its outline.
//!
//! Signs as in docs/model-file.md: what the part towards the beam's end exerts on the part towards its start, with
//! `g1` the curvature about z and `−g2` the curvature about y. The fibre at (y, z) has the strain `axial + z curvature_y − y curvature_z`.
//! Both come from the elastic energy alone: viscous stress of a damped beam is not in them.

use super::beam::strain::{Stiffness, Strain, Strains};
use super::beam::{axial, bending, fourth_moments, torsion};
use super::section::Outline;
use super::sensor::SectionStrains;

/// Force and moments of a section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionForces {
    /// Axial force along the tangent, tension positive, N.
    pub axial: f64,
    /// Torque and moments about y and z, section axes, N m.
    pub moment: [f64; 3],
}

/// Force and moments at the strains `strains`, couplings of large strain included.
pub fn section_forces(stiffness: &Stiffness, strains: &SectionStrains) -> SectionForces {
    let of_energy = strains_of_energy(stiffness, strains);
    let by_strain = bending::gradient(stiffness, &of_energy)
        + torsion::gradient(stiffness, &of_energy)
        + fourth_moments::gradient(stiffness, &of_energy);
    let [by_axial, by_torsion] = match stiffness.strain {
        Strain::Small => [axial::small::force(stiffness, strains.axial), 0.0],
        Strain::Large | Strain::LargeTruncated => {
            axial::large::gradient(stiffness, of_energy[3], strains.torsion).into()
        }
    };
    // By the elongation: Green's strain grows by |r'| with it.
    let stretch = match stiffness.strain {
        Strain::Small => 1.0,
        Strain::Large | Strain::LargeTruncated => 1.0 + strains.axial,
    };
    SectionForces {
        axial: (by_axial + by_strain[3]) * stretch,
        moment: [by_torsion + by_strain[2], -by_strain[1], by_strain[0]],
    }
}

/// Largest von Mises stress `sqrt(σ² + 3 τ²)` over `outline`, Pa; none if the outline is not known.
///
/// `σ = young · (fibre strain)`, linear over the section: squares of curvature and torsion are left out. `τ` is the largest shear that
/// the Saint-Venant torque makes in the shape itself, also where its torsion constant is given differently. Circles and tubes have it
/// all along the outline; for a rectangle, whose corners bear `σ` and the middles of whose long sides `τ`, it is taken everywhere: an upper bound.
pub fn largest_stress(outline: &Outline, young: f64, stiffness: &Stiffness, strains: &SectionStrains) -> Option<f64> {
    let normal = young * (strains.axial.abs() + outline.bending_strain(&strains.curvature)?);
    let torque = torsion::gradient(stiffness, &strains_of_energy(stiffness, strains))[2];
    let shear = torque / outline.torsion_modulus()?;
    Some((normal * normal + 3.0 * shear * shear).sqrt())
}

/// The same strains in the order and with the signs of the energy densities; the axial one is Green's where the energy's is.
fn strains_of_energy(stiffness: &Stiffness, strains: &SectionStrains) -> Strains {
    let [about_y, about_z] = strains.curvature;
    let axial = match stiffness.strain {
        Strain::Small => strains.axial,
        Strain::Large | Strain::LargeTruncated => strains.axial + 0.5 * strains.axial * strains.axial,
    };
    Strains::new(about_z, -about_y, strains.torsion, axial)
}
