//! Loads along an element (MECHANICS 3.5): generalized force and its derivative, summed over the bending points.

use super::coordinates::{ElementMatrix, ElementVector, SHAPE_PLACES, spread};
use super::element::Element;
use super::kinematics::section_point::SectionPoint;
use crate::math::{Vec3, hermite};
use crate::mechanics::beam::configuration::BeamConfiguration;
use crate::mechanics::beam::element::BeamElement;
use crate::mechanics::beam::line_load::LineLoad;

impl Element {
    /// `Σ_g w_g (r_qᵀ f + φ_qᵀ m)`. Of a force that does not turn it is `Σ_g w_g N_a(ξ_g) f`, as of the weight.
    pub(super) fn line_force(&self, c: &BeamConfiguration, load: &LineLoad) -> ElementVector {
        if load.is_constant() {
            let mut weights = [0.0; 4];
            for (xi, share) in self.shares() {
                let shape = hermite::shape(xi, self.length);
                weights.iter_mut().zip(shape).for_each(|(sum, weight)| *sum += share * weight);
            }
            return spread(&weights, &load.force);
        }
        let (kinematics, mut sum) = (self.kinematics(c), ElementVector::zeros());
        for (xi, share) in self.shares() {
            let point = SectionPoint::new(c, self, &kinematics, xi);
            let [force, moment] = load.on(share, &point.pose(c).axes);
            sum += spread(&point.shape, &force);
            if moment != Vec3::zeros() {
                sum += point.turn_q(c).tr_mul(&moment);
            }
        }
        sum
    }

    /// Derivative of [`Self::line_force`]. What turns with a section changes by `dφ × f`, `dφ = φ_q dq`.
    pub(super) fn line_stiffness(&self, c: &BeamConfiguration, load: &LineLoad) -> ElementMatrix {
        let (kinematics, mut sum) = (self.kinematics(c), ElementMatrix::zeros());
        for (xi, share) in self.shares() {
            let point = SectionPoint::new(c, self, &kinematics, xi);
            let [force, moment] = load.on(share, &point.pose(c).axes);
            if moment != Vec3::zeros() {
                sum += point.moment_stiffness(c, &moment);
            }
            if !load.follows {
                continue;
            }
            let turn_q = point.turn_q(c);
            let force_q = -force.cross_matrix() * turn_q;
            for (weight, place) in point.shape.iter().zip(SHAPE_PLACES) {
                let mut rows = sum.fixed_rows_mut::<3>(place);
                rows += force_q * *weight;
            }
            if moment != Vec3::zeros() {
                sum += turn_q.tr_mul(&(-moment.cross_matrix() * turn_q));
            }
        }
        sum
    }

    /// The bending points with their shares of the arc length, m.
    fn shares(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.load_points().into_iter()
    }
}
