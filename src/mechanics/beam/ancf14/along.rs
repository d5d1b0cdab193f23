//! The section along an element, where it is not the same everywhere or its principal axes are not the axes of the
//! element's sections.

use super::rotary_inertia::MassMoments;
use super::strain::{Eccentricity, Stiffness};
use crate::math::elementary::sin_cos;
use std::fmt;
use std::sync::Arc;

/// The section of an element at one position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionAt {
    /// Stiffness against bending in the principal axes, and against all else.
    pub stiffness: Stiffness,
    /// `ρA`, kg/m, and `ρIp`, kg m.
    pub densities: [f64; 2],
    /// Second moments of mass in the axes of this section.
    pub mass_moments: MassMoments,
    /// Angle about the tangent from the axes of the interpolated section to those of this section, rad.
    pub turn: f64,
    /// From there to the principal axes, rad.
    pub principal: f64,
    /// Odd moments about the axis; none where the tension center is on it.
    pub eccentricity: Option<Eccentricity>,
}

impl SectionAt {
    /// The moments of mass in the axes of the interpolated section, kg m.
    pub fn turned_moments(&self) -> MassMoments {
        let (yy, zz, yz) = (self.mass_moments[0], self.mass_moments[1], self.mass_moments[2]);
        if self.turn == 0.0 {
            return self.mass_moments;
        }
        let (sin, cos) = sin_cos(self.turn);
        [
            cos * cos * yy - 2.0 * cos * sin * yz + sin * sin * zz,
            sin * sin * yy + 2.0 * cos * sin * yz + cos * cos * zz,
            cos * sin * (yy - zz) + (cos * cos - sin * sin) * yz,
        ]
    }
}

/// Sections by the position in an element, 0 to 1.
#[derive(Clone)]
pub struct Along(Arc<dyn Fn(f64) -> SectionAt + Send + Sync>);

impl Along {
    /// Of a function of the position.
    pub fn new(section: impl Fn(f64) -> SectionAt + Send + Sync + 'static) -> Self {
        Self(Arc::new(section))
    }

    /// The section at `xi`.
    pub fn at(&self, xi: f64) -> SectionAt {
        (self.0)(xi)
    }
}

impl fmt::Debug for Along {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Along").field(&self.at(0.5)).finish()
    }
}

/// Two of them are the same if they are one function.
impl PartialEq for Along {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
