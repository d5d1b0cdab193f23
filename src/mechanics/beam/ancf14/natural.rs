//! Strains at which an element has no stress: those as drawn, unless the beam is drawn under stress, and those of heat.
//!
//! Heat and tension are strains that are taken off those of the geometry: `e = e(q) − e_0`. A stress-free curvature or
//! torsion takes the place of the one as drawn.

use crate::math::elementary::sin_cos;
use crate::mechanics::input::heat::{Heat, POINTS};

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

/// An element's prestress, with what it is beyond the drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prestressed {
    /// As given.
    pub given: Prestress,
    /// Curvatures `gamma_1`, `gamma_2` (1/m) and torsion (rad/m) without stress minus those as drawn, at the bending
    /// points.
    pub beyond: [[f64; 3]; POINTS],
}

/// How an element expands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Heating {
    /// Number of the temperature.
    pub number: usize,
    /// Thermal expansion, 1/K.
    pub expansion: f64,
}

/// Strains without stress of an element, in the axes of its sections.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Natural {
    /// Axial strain at the axial points, 1.
    pub axial: [f64; POINTS],
    /// Curvature about z and the negative one about y at the bending points, 1/m: in the order of the energy.
    pub curvature: [[f64; 2]; POINTS],
}

impl Natural {
    /// The fiber at (y, z) expands by `α (T + y T_y + z T_z)`.
    pub(super) fn of_heat(expansion: f64, heat: &Heat) -> Self {
        Self {
            axial: heat.temperature.map(|temperature| expansion * temperature),
            curvature: heat.gradient.map(|[y, z]| [-expansion * y, -expansion * z]),
        }
    }

    /// The mean of two.
    pub fn mean(&self, other: &Self) -> Self {
        let mean = |a: f64, b: f64| 0.5 * (a + b);
        Self {
            axial: std::array::from_fn(|m| mean(self.axial[m], other.axial[m])),
            curvature: std::array::from_fn(|g| [0, 1].map(|i| mean(self.curvature[g][i], other.curvature[g][i]))),
        }
    }
}

/// The curvatures `g1`, `g2` about axes that are turned by `angle`, rad.
pub fn curvature_about([g1, g2]: [f64; 2], angle: f64) -> [f64; 2] {
    if angle == 0.0 {
        return [g1, g2];
    }
    let (sin, cos) = sin_cos(angle);
    [cos * g1 + sin * g2, cos * g2 - sin * g1]
}
