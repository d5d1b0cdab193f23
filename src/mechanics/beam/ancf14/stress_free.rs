//! Strains at which an element has no stress: those as drawn, unless the beam is drawn under stress, and those of heat.
//!
//! Heat and tension are strains that are taken off those of the geometry: `e = e(q) − e_0`. A stress-free curvature or torsion takes the place of the one as
//! drawn.

use super::element::Element;
use crate::mechanics::beam::configuration::BeamConfiguration;
use crate::mechanics::beam::resultants::SectionShape;
use crate::mechanics::input::heat::Heat;

/// How a beam is under stress where it is drawn; nothing: not at all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Prestress {
    /// Axial force as drawn, N.
    pub tension: f64,
    /// Curvatures about y and z without stress, 1/m; none: those as drawn.
    pub curvature: Option<[f64; 2]>,
    /// Torsion without stress, rad/m; none: as drawn.
    pub torsion: Option<f64>,
}

/// How an element expands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heating {
    /// Number of the temperature.
    pub number: usize,
    /// Thermal expansion, 1/K.
    pub expansion: f64,
}

/// Strains without stress, in the axes of a section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Natural {
    /// Axial strain, 1.
    pub axial: f64,
    /// Curvature about z and the negative one about y, 1/m: in the order of the energy.
    pub curvature: [f64; 2],
}

impl Natural {
    /// The fiber at (y, z) expands by `α (T + y T_y + z T_z)`.
    fn of_heat(expansion: f64, heat: &Heat) -> Self {
        let [y, z] = heat.gradient;
        Self { axial: expansion * heat.temperature, curvature: [-expansion * y, -expansion * z] }
    }

    /// The mean of two.
    pub fn mean(&self, other: &Self) -> Self {
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        Self {
            axial: mean(self.axial, other.axial),
            curvature: [0, 1].map(|i| mean(self.curvature[i], other.curvature[i])),
        }
    }

    /// Its curvatures about axes that are turned by `angle`, rad.
    pub fn curvature_about(&self, angle: f64) -> [f64; 2] {
        if angle == 0.0 {
            return self.curvature;
        }
        let ((sin, cos), [g1, g2]) = (angle.sin_cos(), self.curvature);
        [cos * g1 + sin * g2, cos * g2 - sin * g1]
    }
}

impl Element {
    /// Strains by heat at `c`.
    #[inline]
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
                [point.reference[0], point.reference[1]] = natural.curvature_about(point.principal);
            }
            point.reference[2] = prestress.torsion.unwrap_or(point.reference[2]);
        }
        if let Some(torsion) = prestress.torsion {
            self.axial.iter_mut().for_each(|point| point.reference_torsion = torsion);
        }
        self.prestress = (*prestress != Prestress::default()).then(|| Box::new(*prestress));
        self
    }

    /// Curvatures about y and z and torsion without stress, beyond those of a section that as drawn is `drawn`, 1/m and rad/m.
    pub fn unstressed_beyond(&self, c: &BeamConfiguration, drawn: &SectionShape) -> ([f64; 2], f64) {
        let [g1, g2] = self.natural(c).curvature;
        let (mut curvature, mut torsion) = ([-g2, g1], 0.0);
        if let Some(prestress) = &self.prestress {
            if let Some(free) = prestress.curvature {
                (0..2).for_each(|i| curvature[i] += free[i] - drawn.curvature[i] / drawn.stretch);
            }
            if let Some(free) = prestress.torsion {
                torsion = free - self.reference_twist / (self.length * drawn.stretch);
            }
        }
        (curvature, torsion)
    }
}
