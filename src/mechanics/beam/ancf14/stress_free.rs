//! Elements that are under stress where they are drawn, or expand with heat.

use super::element::Element;
use super::natural::{Natural, Prestress};
use super::section::turned;
use crate::mechanics::beam::configuration::BeamConfiguration;
use crate::mechanics::beam::resultants::SectionShape;

impl Element {
    /// Strains by heat at `c`.
    #[inline(always)]
    pub fn natural(&self, c: &BeamConfiguration) -> Natural {
        match (&self.heating, c.heats) {
            (Some(heating), heats) => Natural::of_heat(heating.expansion, &heats[heating.number]),
            (None, _) => Natural::default(),
        }
    }

    /// Makes it stress free at `prestress` instead of as drawn.
    pub fn prestressed(mut self, prestress: &Prestress) -> Self {
        for point in &mut self.axial {
            point.natural = -prestress.tension / point.stiffness.axial;
        }
        for point in &mut self.bending {
            if let Some([about_y, about_z]) = prestress.curvature {
                let natural = Natural { axial: 0.0, curvature: [about_z, -about_y] };
                [point.reference[0], point.reference[1]] = natural.curvature_about(point.principal - point.turn);
            }
            point.reference[2] = prestress.torsion.unwrap_or(point.reference[2]);
        }
        if let Some(torsion) = prestress.torsion {
            self.axial.iter_mut().for_each(|point| point.reference_torsion = torsion);
        }
        self.prestress = (*prestress != Prestress::default()).then(|| Box::new(*prestress));
        self
    }

    /// Curvatures about y and z and torsion without stress, beyond those of a section that as drawn is `drawn` and is turned by `turn`, rad, 1/m and rad/m.
    pub fn unstressed_beyond(&self, c: &BeamConfiguration, drawn: &SectionShape, turn: f64) -> ([f64; 2], f64) {
        let [g1, g2] = self.natural(c).curvature;
        let (mut curvature, mut torsion) = ([-g2, g1], 0.0);
        if let Some(prestress) = &self.prestress {
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
}
