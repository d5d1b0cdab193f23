//! What an element's energy resolves of its strains, by least squares: curvatures and axial force as straight lines of
//! its length, torsion as a constant with linear twist, else as a line too.
//!
//! Where nodes have the right places and slopes, mean and slope of the curvature are right, and so is the mean torsion.
//! What the beam has beyond them shows in the differences between neighbors: with `c` half the second derivative of the
//! curvature along the beam, `(slope₁ − slope₀)/(l₀ + l₁)` of two of them, the part that the line leaves out is
//! `c (x² − l²/12)`, x from the middle of the element.

use crate::math::quadrature::{GAUSS_POINTS, GAUSS_WEIGHTS, LOBATTO_POINTS, LOBATTO_WEIGHTS};
use crate::mechanics::beam::Beam;
use crate::mechanics::beam::ancf14;
use crate::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use crate::mechanics::beam::ancf14::relief::Relief;
use crate::mechanics::beam::ancf14::strain::Strain;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::beam::resultants::{SectionForces, SectionStrains};
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;

/// A quantity along an element.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Line {
    /// Its mean.
    pub mean: f64,
    /// What it changes by, per length.
    pub slope: f64,
}

impl Line {
    /// The line at `x` from the middle of the element, m.
    pub fn at(&self, x: f64) -> f64 {
        self.mean + self.slope * x
    }
}

/// The strains of an element of ANCF14.
#[derive(Clone, Copy, Debug)]
pub struct StrainFit<'a> {
    /// The element.
    pub element: &'a ancf14::element::Element,
    /// Curvature about z, the negative one about y (1/m), and torsion (rad/m), undeformed values taken off.
    pub strains: [Line; 3],
    /// `E Iz`, `E Iy` and `G Jt`, where they vary those of the middle, N m².
    pub rigidities: [f64; 3],
    /// Axial strain `|r'|/J0 − 1` at both ends and in the middle, in their order, 1.
    pub elongations: [f64; 3],
    /// Axial force at both ends and in the middle, in their order, N.
    pub forces: [f64; 3],
    /// Strain energy, J.
    pub energy: f64,
    /// Strains without stress that it has followed; none: all its strains are stress.
    pub relief: Option<Relief>,
}

impl<'a> StrainFit<'a> {
    /// Of element `number` of `beam`, counted from the beam's start; none of ANCF24.
    pub fn of(system: &'a System, beam: &Beam, number: usize, c: &Configuration<'a>) -> Option<Self> {
        match &system.mesh.elements[beam.first_element + number] {
            AnyElement::Ancf14(element) => Some(Self::new(element, c)),
            AnyElement::PaidOut(_) | AnyElement::Ancf24(_) => None,
        }
    }

    fn new(element: &'a ancf14::element::Element, c: &Configuration<'a>) -> Self {
        let evaluation = element.evaluation(&c.beams);
        let all = evaluation.section_strains();
        let [first, _, last] = &all;
        let apart = (GAUSS_POINTS[2] - GAUSS_POINTS[0]) * element.length;
        // Least squares over the Gauss points, with their weights.
        let strains = [0, 1, 2].map(|k| Line {
            mean: all.iter().zip(GAUSS_WEIGHTS).map(|(strains, weight)| weight * strains[k]).sum(),
            slope: (last[k] - first[k]) / apart,
        });
        let stiffness = &element.stiffness;
        // About axes through the tension center: bending about others stretches the axis, which relaxes.
        let [y, z] = element.eccentricities.as_ref().map_or([0.0; 2], |own| own[1].first);
        let relaxed = |bending: f64, moment: f64| bending - moment * moment / stiffness.axial;
        let rigidities = [relaxed(stiffness.bending_z, y), relaxed(stiffness.bending_y, z), stiffness.torsion];
        let mut fit = Self {
            element,
            strains,
            rigidities,
            elongations: [0.0; 3],
            forces: [0.0; 3],
            energy: evaluation.energy(),
            relief: evaluation.relief(),
        };
        let strains = evaluation.axial_strains();
        fit.elongations = strains.map(|strain| match stiffness.strain {
            Strain::Small => strain,
            // Green's strain as an elongation.
            Strain::Large | Strain::LargeTruncated => (1.0 + 2.0 * strain).max(0.0).sqrt() - 1.0,
        });
        fit.forces = [0, 1, 2].map(|m| {
            let x = (LOBATTO_POINTS[m] - 0.5) * element.length;
            fit.section_forces(x, &fit.section_strains(fit.elongations[m], [0, 1, 2].map(|k| fit.strains[k].at(x))))
                .axial
        });
        fit
    }

    /// Strains of a section with the axial strain `axial`, of strains in the order of [`Self::strains`].
    pub fn section_strains(&self, axial: f64, [about_z, minus_about_y, torsion]: [f64; 3]) -> SectionStrains {
        SectionStrains { axial, curvature: [-minus_about_y, about_z], torsion }
    }

    /// Force and moments of the section at `x` from the middle of the element, m, at the strains `strains`.
    pub fn section_forces(&self, x: f64, strains: &SectionStrains) -> SectionForces {
        ancf14::section::forces_at(self.element, x / self.length() + 0.5, strains)
    }

    /// Its length, m.
    pub fn length(&self) -> f64 {
        self.element.length
    }

    /// Whether the energy resolves strain `k` as a line, not as a constant.
    pub fn is_line(&self, k: usize) -> bool {
        k < 2 || self.element.stiffness.twist == Twist::Quadratic
    }

    /// Axial force as a line, N and N/m: the mean over the element, and what the ends differ by.
    pub fn force(&self) -> Line {
        let mean = self.forces.iter().zip(LOBATTO_WEIGHTS).map(|(force, weight)| weight * force).sum();
        Line { mean, slope: (self.forces[2] - self.forces[0]) / self.length() }
    }
}

/// An element with its neighbors across nodes at which nothing acts: only there do their strains continue each other.
#[derive(Clone, Copy, Debug)]
pub struct Neighborhood<'a> {
    /// The element before.
    pub before: Option<StrainFit<'a>>,
    /// The element itself.
    pub own: StrainFit<'a>,
    /// The element after.
    pub after: Option<StrainFit<'a>>,
}

impl<'a> Neighborhood<'a> {
    /// What `difference` makes of the two elements at each end.
    pub fn differences(&self, difference: impl Fn(&StrainFit, &StrainFit) -> f64) -> [Option<f64>; 2] {
        let Self { before, own, after } = self;
        [before.as_ref().map(|before| difference(before, own)), after.as_ref().map(|after| difference(own, after))]
    }
}

/// Half the second derivative of a quantity along the beam, by its lines in two neighbors.
pub fn bend(before: &StrainFit, after: &StrainFit, quantity: impl Fn(&StrainFit) -> Line) -> f64 {
    (quantity(after).slope - quantity(before).slope) / (before.length() + after.length())
}

/// The first derivative of a quantity along the beam, by its means in two neighbors.
pub fn rise(before: &StrainFit, after: &StrainFit, quantity: impl Fn(&StrainFit) -> Line) -> f64 {
    2.0 * (quantity(after).mean - quantity(before).mean) / (before.length() + after.length())
}

/// The mean of what is known, or 0.
pub fn mean(values: [Option<f64>; 2]) -> f64 {
    match values {
        [Some(before), Some(after)] => 0.5 * (before + after),
        [Some(one), None] | [None, Some(one)] => one,
        [None, None] => 0.0,
    }
}

impl System {
    /// Whether nothing acts at end `end` of the elements of `beam` and the beam goes on there.
    pub fn is_open(&self, beam: &Beam, end: usize) -> bool {
        0 < end && end < beam.elements() && beam.corners.binary_search(&end).is_err() && !self.is_held(beam.node(end))
    }

    /// Whether something acts at an inner end of element `number` of `beam`, or of a neighbor: the axial force may jump
    /// there, and these elements show both sides of the jump, however short they are: the stretch of a node is one
    /// number.
    pub fn is_beside_jump(&self, beam: &Beam, number: usize) -> bool {
        let mut ends = number.saturating_sub(1)..=number + 2;
        ends.any(|end| 0 < end && end < beam.elements() && !self.is_open(beam, end))
    }
}
