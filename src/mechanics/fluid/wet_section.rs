//! How a section resists the flow, per undeformed length.

use crate::math::quadrature::{LOBATTO_POINTS, lagrange};

/// A section in fluid; its coefficients have the density of the fluid in them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WetSection {
    /// Radius outside, m.
    pub radius: f64,
    /// Displaced fluid `ρ A`, kg/m.
    pub displaced: f64,
    /// Drag over the square of the velocity across the beam, `ρ D C_n / 2`, and along it, `ρ S C_t / 2`, kg/m².
    pub drag: [f64; 2],
    /// Added mass across the beam, `ρ A Ca_n`, and along it, `ρ A Ca_t`, kg/m.
    pub added: [f64; 2],
}

impl WetSection {
    /// The numbers in one order.
    fn numbers(&self) -> [f64; 6] {
        [self.radius, self.displaced, self.drag[0], self.drag[1], self.added[0], self.added[1]]
    }

    /// The sum of three sections with these weights.
    fn weighted(sections: &[Self; 3], weights: [f64; 3]) -> Self {
        let mut sums = [0.0; 6];
        for (section, weight) in sections.iter().zip(weights) {
            sums.iter_mut().zip(section.numbers()).for_each(|(sum, number)| *sum += weight * number);
        }
        let [radius, displaced, drag_n, drag_t, added_n, added_t] = sums;
        Self { radius, displaced, drag: [drag_n, drag_t], added: [added_n, added_t] }
    }
}

/// The sections of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WetSections {
    /// The same everywhere.
    Alike(WetSection),
    /// Those of both ends and of the middle, with a parabola through them: exact for the area of a cone.
    Along([WetSection; 3]),
}

impl WetSections {
    /// The section at `xi`.
    pub fn at(&self, xi: f64) -> WetSection {
        match self {
            Self::Alike(section) => *section,
            Self::Along(sections) => WetSection::weighted(sections, lagrange(&LOBATTO_POINTS, xi)),
        }
    }

    /// The sections that are known.
    fn each(&self) -> &[WetSection] {
        match self {
            Self::Alike(section) => std::slice::from_ref(section),
            Self::Along(sections) => sections,
        }
    }

    /// Whether the flow drags it along.
    pub fn is_dragged(&self) -> bool {
        self.each().iter().any(|section| section.drag != [0.0; 2])
    }

    /// Whether fluid moves with it.
    pub fn has_added_mass(&self) -> bool {
        self.each().iter().any(|section| section.added != [0.0; 2])
    }
}
