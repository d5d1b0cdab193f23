//! A beam as drawn: its line, section and material, and the formulation of its elements.

use super::ancf14::along::{Along, SectionAt};
use super::ancf14::energy::quadratic_twist::Twist;
use super::ancf14::natural::Prestress;
use super::ancf14::strain::{Eccentricity, Stiffness, Strain};
use super::ancf24::element::Properties;
use super::ancf24::law::{Shear, law};
use super::ancf24::station::Fibers;
use super::centerline::Centerline;
use super::material::Material;
use super::profile::Profile;
use super::section::Section;
use crate::math::Vec3;

/// Saint-Venant stiffness is multiplied by this where torsion is suppressed (MECHANICS 3.6).
const SUPPRESSED_TORSION: f64 = 1e4;

/// Whether a beam may twist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Torsion {
    /// It may.
    Free,
    /// The section follows the Bishop frame, the paper's "torsional effects disregarded".
    Suppressed,
}

/// The formulation of a beam's elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Elements {
    /// Center-line and twist.
    Ancf14 {
        /// Strain measure.
        strain: Strain,
        /// How the twist runs inside an element.
        twist: Twist,
        /// Whether it may twist.
        torsion: Torsion,
    },
    /// Center-line and gradients of the section.
    Ancf24 {
        /// Whether strains across follow those along: the full material law.
        poisson: bool,
        /// Transverse shear moduli.
        shear: Shear,
    },
}

/// A beam as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamDesign {
    /// Name in the model file.
    pub name: String,
    /// Its nodes and elements.
    pub line: Centerline,
    /// Direction of the section's y at the start; made perpendicular to the tangent, then carried along without twist.
    pub y_axis: Vec3,
    /// Additional turn of the section from start to end, rad.
    pub pretwist: f64,
    /// Material.
    pub material: Material,
    /// Cross-section; where it varies that of the start.
    pub section: Section,
    /// The section along the beam; none where it is the same everywhere.
    pub profile: Option<Profile>,
    /// Whether its sections have an inertia against turns of the tangent.
    pub rotary_inertia: bool,
    /// Damping in proportion to mass: force over mass and velocity, 1/s.
    pub mass_damping: f64,
    /// Damping of the axial strain beyond that of the material, s.
    pub tension_damping: f64,
    /// How it is under stress as drawn.
    pub prestress: Prestress,
    /// How its elements are formulated.
    pub elements: Elements,
    /// Initial velocity of the start, m/s.
    pub velocity: Vec3,
    /// Initial angular velocity about the start, rad/s.
    pub angular_velocity: Vec3,
}

impl BeamDesign {
    /// The section at a fraction of the length, 0 to 1.
    pub fn section_at(&self, fraction: f64) -> Section {
        self.profile.as_ref().map_or(self.section, |profile| profile.at(fraction))
    }

    /// `ρA`, kg/m, and `ρIp`, kg m.
    pub fn densities(&self) -> [f64; 2] {
        self.section.densities(&self.material)
    }

    /// `[∫ρ y² dA, ∫ρ z² dA, ∫ρ y z dA]`, kg m.
    pub fn mass_moments(&self) -> [f64; 3] {
        if self.rotary_inertia { self.section.mass_moments(&self.material) } else { [0.0; 3] }
    }

    /// Stiffness of an ANCF14 section.
    pub fn stiffness(&self, strain: Strain, twist: Twist, torsion: Torsion) -> Stiffness {
        stiffness(&self.material, &self.section, strain, twist, torsion)
    }

    /// The sections of an ANCF14 element between two `fractions` of the length; none where they are those of
    /// [`Self::stiffness`] and [`Self::densities`].
    pub fn along(&self, fractions: [f64; 2], strain: Strain, twist: Twist, torsion: Torsion) -> Option<Along> {
        let (profile, material) = (self.profile.clone()?, self.material);
        let rotary_inertia = self.rotary_inertia;
        let turns = fractions.map(|fraction| profile.at(fraction).twist);
        Some(Along::new(move |xi| {
            let section = profile.inside(fractions, xi);
            let (principal, _) = section.principal_axes();
            SectionAt {
                stiffness: stiffness(&material, &section, strain, twist, torsion),
                densities: section.densities(&material),
                mass_moments: if rotary_inertia { section.mass_moments(&material) } else { [0.0; 3] },
                // Nodes turn as the section does; between them the turn of the element is a straight line.
                turn: section.twist - (turns[0] + (turns[1] - turns[0]) * xi),
                principal,
                eccentricity: section.odd_moments().map(|(first, third)| Eccentricity {
                    first: first.map(|moment| material.young * moment),
                    third: match strain {
                        Strain::Small => [0.0; 4],
                        _ => third.map(|moment| material.young * moment),
                    },
                }),
            }
        }))
    }
    /// What ANCF24 elements have in common.
    pub fn properties(&self, poisson: bool, shear: Shear) -> Properties {
        let (material, section) = (&self.material, &self.section);
        let moments = [section.second_moment_z, section.second_moment_y];
        // The spin's inertia is the polar moment's, where that is given differently, shared as the second moments are.
        let share = material.density * section.polar_moment / (moments[0] + moments[1]);
        Properties {
            law: law(material, section, poisson, shear),
            fibers: Fibers {
                area: section.area,
                y: (section.second_moment_z / section.area).sqrt(),
                z: (section.second_moment_y / section.area).sqrt(),
            },
            line_density: material.density * section.area,
            section_inertia: moments.map(|moment| share * moment),
            damping: material.damping,
        }
    }

    /// Twist rate above which the energy of the section is negative and has no lower bound, rad/m:
    /// `tau_c = sqrt(4 G Jt/(E (Ip²/A − ∫ r⁴ dA)))` (MECHANICS, trap 9). The truncated energy leaves `∫ r⁴ dA` out; a
    /// section whose fourth moments are given too small has the same defect. Infinite where there is no such rate.
    pub fn twist_limit(&self) -> f64 {
        let (material, section) = (&self.material, &self.section);
        let stiffening = match self.elements {
            Elements::Ancf14 { strain: Strain::LargeTruncated, torsion: Torsion::Free, .. } => {
                -section.polar_moment.powi(2) / section.area
            }
            Elements::Ancf14 { strain: Strain::Large, torsion: Torsion::Free, .. } => section.twist_stiffening(),
            _ => 0.0,
        };
        if stiffening < 0.0 {
            (4.0 * material.shear * section.torsion_constant / (-material.young * stiffening)).sqrt()
        } else {
            f64::INFINITY
        }
    }
}

/// Stiffness of an ANCF14 section, in its principal axes.
fn stiffness(material: &Material, section: &Section, strain: Strain, twist: Twist, torsion: Torsion) -> Stiffness {
    let (_, [about_y, about_z]) = section.principal_axes();
    let torsion_factor = match torsion {
        Torsion::Free => 1.0,
        Torsion::Suppressed => SUPPRESSED_TORSION,
    };
    let couples = strain != Strain::Small && torsion == Torsion::Free;
    Stiffness {
        strain,
        twist,
        axial: material.young * section.area,
        bending_y: material.young * about_y,
        bending_z: material.young * about_z,
        torsion: material.shear * section.torsion_constant * torsion_factor,
        wagner: if couples { material.young * section.polar_moment } else { 0.0 },
        fourth: match strain {
            Strain::Large => section.fourth_moments.map(|moment| material.young * moment),
            _ => [0.0; 3],
        },
        damping: material.damping,
    }
}
