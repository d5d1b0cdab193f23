//! The strains of a bending point: the curvatures of the carried frame about the axes of the section (MECHANICS 2.16),
//! torsion and stretching.

use super::energy::quadratic_twist;
use super::kinematics::points::BendingPoint;
use super::natural::curvature_about;
use super::strain::Strains;
use crate::math::elementary::sin_cos;

impl BendingPoint {
    /// `cos/J0` and `sin/J0` of the angle of the section, which `alpha` and the internal coordinate `bubble` of the
    /// quadratic twist make, rad.
    #[inline]
    pub fn turn(&self, alpha: f64, bubble: f64) -> [f64; 2] {
        let (sin, cos) = sin_cos(alpha + self.principal + bubble * quadratic_twist::shape(self.xi));
        [cos / self.reference_stretch, sin / self.reference_stretch]
    }

    /// `gammahat` and the strains, where the carried frame has the `curvatures` and the section is turned by `turn`;
    /// `twist` is that of the element, `natural` are the curvatures without stress here.
    #[inline]
    pub fn strains(
        &self,
        ([kappa1, kappa2], twist): ([f64; 2], f64),
        bubble: f64,
        [cos, sin]: [f64; 2],
        natural: [f64; 2],
        green: &[f64; 3],
    ) -> ([f64; 2], Strains) {
        let gammahat = [cos * kappa1 + sin * kappa2, cos * kappa2 - sin * kappa1];
        let twist_xi = twist + bubble * quadratic_twist::shape_xi(self.xi);
        let natural = curvature_about(natural, self.principal - self.turn);
        let strains = Strains::new(
            gammahat[0] - self.reference[0] - natural[0],
            gammahat[1] - self.reference[1] - natural[1],
            twist_xi * self.torsion_by_twist - self.reference[2],
            self.from_axial.iter().zip(green).map(|(weight, e)| weight * e).sum(),
        );
        (gammahat, strains)
    }
}
