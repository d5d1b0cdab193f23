//! Elements that are under stress where they are drawn, or expand with heat.

use super::element::Element;
use super::natural::{Natural, Prestress, Prestressed, curvature_about};
use super::section::turned;
use crate::math::quadrature::{GAUSS_POINTS, lagrange};
use crate::mechanics::beam::configuration::BeamConfiguration;
use crate::mechanics::beam::resultants::SectionShape;

impl Element {
    /// Strains by heat at `c`.
    #[inline]
    pub fn natural(&self, c: &BeamConfiguration) -> Natural {
        match (&self.heating, c.heats) {
            (Some(heating), heats) => Natural::of_heat(heating.expansion, &heats[heating.number]),
            (None, _) => Natural::default(),
        }
    }

    /// Whether it is written that it is straight when free of stress, in both planes.
    pub fn is_straight_without_stress(&self) -> bool {
        self.prestress.as_deref().is_some_and(|own| own.given.curvature == Some([0.0; 2]))
    }

    /// Makes it stress free at `prestress` instead of as drawn.
    pub fn prestressed(mut self, prestress: &Prestress) -> Self {
        for point in &mut self.axial {
            point.natural = -prestress.tension / point.stiffness.axial;
        }
        let drawn = self.bending.each_ref().map(|point| point.reference);
        for point in &mut self.bending {
            if let Some([about_y, about_z]) = prestress.curvature {
                let free = curvature_about([about_z, -about_y], point.principal - point.turn);
                [point.reference[0], point.reference[1]] = free;
            }
            point.reference[2] = prestress.torsion.unwrap_or(point.reference[2]);
        }
        if let Some(torsion) = prestress.torsion {
            self.axial.iter_mut().for_each(|point| point.reference_torsion = torsion);
        }
        let beyond = std::array::from_fn(|g| std::array::from_fn(|k| self.bending[g].reference[k] - drawn[g][k]));
        self.prestress =
            (*prestress != Prestress::default()).then(|| Box::new(Prestressed { given: *prestress, beyond }));
        self
    }

    /// Curvatures about y and z and torsion without stress at `xi`, beyond those of a section that as drawn is `drawn`
    /// and is turned by `turn`, rad, 1/m and rad/m.
    pub fn unstressed_beyond(
        &self,
        c: &BeamConfiguration,
        xi: f64,
        drawn: &SectionShape,
        turn: f64,
    ) -> ([f64; 2], f64) {
        let (mut curvature, mut torsion) = (self.curvature_of_heat(c, xi), 0.0);
        if let Some(Prestressed { given: prestress, .. }) = self.prestress.as_deref() {
            if let Some(free) = prestress.curvature {
                let as_drawn = turned(drawn.curvature.map(|curvature| curvature / drawn.stretch), turn);
                (0..2).for_each(|i| curvature[i] += free[i] - as_drawn[i]);
            }
            if let Some(free) = prestress.torsion {
                torsion = free - self.reference_twist / (self.length * drawn.stretch);
            }
        }
        (curvature, torsion)
    }

    /// Curvatures about y and z by heat at `xi`, 1/m: the quadratic through those of the bending points.
    fn curvature_of_heat(&self, c: &BeamConfiguration, xi: f64) -> [f64; 2] {
        let points = self.natural(c).curvature;
        // The same at all points: without the round-off of weights.
        if points.iter().all(|point| *point == points[0]) {
            let [g1, g2] = points[0];
            return [-g2, g1];
        }
        let weights = lagrange(&GAUSS_POINTS, xi);
        let at = |i: usize| points.iter().zip(weights).map(|(point, weight)| weight * point[i]).sum::<f64>();
        [-at(1), at(0)]
    }
}
