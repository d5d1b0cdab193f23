//! Elements whose section is not the same everywhere.

use super::along::{Along, SectionAt};
use super::element::{Element, Evaluation};
use super::frame::NodeFrame;
use super::inertia::Inertia;
use super::rotary_inertia::MassMoments;
use super::strain::{Stiffness, Strain, Strains};
use crate::math::elementary::sin_cos;
use crate::math::quadrature::{FIVE_POINTS, FIVE_WEIGHTS, LOBATTO_POINTS};
use std::sync::Arc;

impl Element {
    /// The same element with the sections `along`; arguments else as of [`Self::new`].
    pub fn with_sections(mut self, along: Along, reference: &[f64], frames: [&NodeFrame; 2], holonomy: f64) -> Self {
        self.stiffness = along.at(0.5).stiffness;
        for (point, xi) in self.axial.iter_mut().zip(LOBATTO_POINTS) {
            Arc::make_mut(&mut point.rule).stiffness = along.at(xi).stiffness.at_axial_point();
        }
        let eccentricities = self.bending.each_ref().map(|point| along.at(point.xi).eccentricity);
        let is_eccentric = eccentricities.iter().any(Option::is_some);
        // The tension center may be on the axis at one point and off it at the next.
        self.eccentricities = is_eccentric.then(|| Box::new(eccentricities.map(Option::unwrap_or_default)));
        for point in &mut self.bending {
            let here = along.at(point.xi);
            let rule = Arc::make_mut(&mut point.rule);
            rule.stiffness = here.stiffness.at_bending_point();
            (rule.principal, rule.turn) = (here.turn + here.principal, here.turn);
        }
        // Five points are exact to order 10, where the shape functions' products have 6.
        let mut stations = FIVE_POINTS.map(|xi| along.at(xi).densities);
        for (densities, weight) in stations.iter_mut().zip(FIVE_WEIGHTS) {
            densities.iter_mut().for_each(|density| *density *= weight * self.length);
        }
        let mut inertia = Inertia::of_stations(stations, self.length);
        let moments = FIVE_POINTS.map(|xi| along.at(xi).turned_moments());
        if moments.iter().flatten().any(|moment| *moment != 0.0) {
            inertia.add_rotary(moments, self.length);
        }
        self.inertia = Arc::new(inertia);
        self.along = Some(along);
        self.set_reference(reference, frames, holonomy);
        self
    }

    /// The same element, whose sections are alike, with their rotary inertia.
    #[must_use]
    pub fn with_rotary_inertia(mut self, moments: MassMoments) -> Self {
        if moments.iter().any(|moment| *moment != 0.0) {
            Arc::make_mut(&mut self.inertia).add_rotary([moments; 5], self.length);
        }
        self
    }

    /// The section at `xi`.
    pub fn section_at(&self, xi: f64) -> SectionAt {
        match &self.along {
            Some(along) => {
                let here = along.at(xi);
                // Damping may have been set since.
                SectionAt { stiffness: Stiffness { damping: self.stiffness.damping, ..here.stiffness }, ..here }
            }
            None => {
                let (stiffness, densities) = (self.stiffness, [self.inertia.line_density, 0.0]);
                SectionAt {
                    stiffness,
                    densities,
                    mass_moments: [0.0; 3],
                    turn: 0.0,
                    principal: 0.0,
                    eccentricity: None,
                }
            }
        }
    }
}

impl Evaluation<'_> {
    /// Mean torsion per unit length, undeformed value taken off, rad/m; the largest of the bending points in size.
    pub fn largest_torsion(&self) -> f64 {
        self.strains
            .iter()
            .fold(0.0, |largest, strains| if strains[2].abs() > f64::abs(largest) { strains[2] } else { largest })
    }

    /// Green strains at the axial points (engineering strains for small strain), 1.
    pub fn axial_strains(&self) -> [f64; 3] {
        [self.axial_strain(0), self.axial_strain(1), self.axial_strain(2)]
    }

    /// Green strain at axial point `m` (engineering strain for small strain), 1.
    #[inline]
    pub fn axial_strain(&self, m: usize) -> f64 {
        match self.element.stiffness.strain {
            Strain::Small => self.slopes[m].engineering_strain(),
            _ => self.seen[m],
        }
    }

    /// Takes `strains` off the axial strains.
    pub(super) fn take_off_axial(&mut self, strains: [f64; 3]) {
        for (m, strain) in strains.into_iter().enumerate() {
            match self.element.stiffness.strain {
                Strain::Small => self.slopes[m].natural += strain,
                Strain::Large | Strain::LargeTruncated => self.seen[m] -= strain,
            }
        }
    }

    /// Strains of the bending points in the axes of their sections, which need not be the principal ones.
    pub fn section_strains(&self) -> [Strains; 3] {
        std::array::from_fn(|g| {
            let point = &self.element.bending[g];
            let (principal, mut strains) = (point.principal - point.turn, self.strains[g]);
            if principal != 0.0 {
                let ((sin, cos), [g1, g2]) = (sin_cos(principal), [strains[0], strains[1]]);
                (strains[0], strains[1]) = (cos * g1 - sin * g2, cos * g2 + sin * g1);
            }
            strains
        })
    }
}
