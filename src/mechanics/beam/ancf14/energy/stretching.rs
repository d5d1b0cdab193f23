//! Second derivatives that have to do with the stretch of the axial points: they act on all coordinates of an element,
//! in space (MECHANICS 8). Densities are those of axial.rs.

use super::quadratic_twist::Condensation;
use super::{axial, eccentricity};
use crate::mechanics::beam::ancf14::coordinates::{
    ElementColumns, ElementVector, add_between, add_product, add_spread, spread,
};
use crate::mechanics::beam::ancf14::element::Evaluation;
use crate::mechanics::beam::ancf14::kinematics::strain_derivatives::{Forces, Gradients};
use crate::mechanics::beam::ancf14::strain::{Resultants, Rigidities, Strain};

/// `∂²U/∂T²` of the axial points, N m: what Wagner's term has.
#[inline]
pub fn torque_by_twist(evaluation: &Evaluation) -> f64 {
    let element = evaluation.element;
    let mut sum = 0.0;
    if element.stiffness.strain != Strain::Small {
        for (m, point) in element.axial.iter().enumerate() {
            let second = axial::large::hessian(&point.stiffness, evaluation.seen[m], evaluation.mean_torsion[m]);
            sum += point.weight * second[(1, 1)] * point.torsion_by_twist.powi(2);
        }
    }
    sum
}

/// Adds `scale` times the small-strain part to `sum`, without the rows and columns of `r_0`.
#[inline]
pub fn add_small_hessian(evaluation: &Evaluation, scale: f64, sum: &mut ElementColumns) {
    let element = evaluation.element;
    for (m, point) in element.axial.iter().enumerate() {
        let stiffness = point.weight * point.stiffness.axial * (1.0 + evaluation.added.axial_stiffening);
        let force = evaluation.engineering_force(m) - stiffness * evaluation.added.excess[m];
        let mut hessian = axial::small::hessian(&evaluation.slopes[m], force, stiffness);
        if let Some(changes) = &evaluation.added.axial_rate_changes {
            hessian += evaluation.slopes[m].engineering_strain_p() * changes[m].transpose();
        }
        add_spread(&point.shape_x, &(hessian * scale), sum);
    }
}

/// What the second derivatives by the strains of the axial points are made of, where bending points see them: of large
/// strain, or with a tension center off the axis.
#[derive(Clone, Copy, Debug)]
pub struct Coupled<'a> {
    /// Where they are taken.
    pub evaluation: &'a Evaluation<'a>,
    /// First derivatives by the strains of the bending points.
    pub resultants: &'a [Resultants; 3],
    /// Second derivatives by the strains of the bending points.
    pub rigidities: &'a [Rigidities; 3],
    /// Derivatives of the curvatures.
    pub gradients: &'a Gradients<'a>,
    /// Of the quadratic twist.
    pub condensation: Option<&'a Condensation>,
}

impl Coupled<'_> {
    /// Adds `scale` times all second derivatives by the strains of the axial points to `sum`, without the rows and
    /// columns of `r_0`.
    #[inline]
    pub fn add_hessian(&self, scale: f64, sum: &mut ElementColumns) {
        let (element, shape) = (self.evaluation.element, &self.evaluation.kinematics.shape);
        let strain = element.stiffness.strain;
        self.add_eccentric(scale, sum);
        let (mut bubble_q, mut bubble_end) = (ElementVector::zeros(), ElementVector::zeros());
        for (m, point) in element.axial.iter().enumerate() {
            let slope = &self.evaluation.slopes[m];
            let density =
                axial::large::hessian(&point.stiffness, self.evaluation.seen[m], self.evaluation.mean_torsion[m])
                    * point.weight;
            // By this strain, of the gradient by the corotated shape.
            let mut by_strain = self.gradients.sum(&self.forces(m, density[(0, 1)] * point.torsion_by_twist));
            // Over a step the strain also depends on the increment.
            let (strain_p, by_end) = (slope.strain_mean_p(strain), slope.strain_end(strain));
            if let Some(condensation) = self.condensation {
                let share = condensation.by_axial[m];
                condensation.condense_row(share, &mut by_strain);
                bubble_q += spread(&point.shape_x, &(strain_p * share));
                bubble_end += spread(&point.shape_x, &(by_end * share));
            }
            let by_middle = shape.gradient(&by_strain) * scale;
            let turned = self.evaluation.turn_from_end.as_ref().map_or(by_middle, |turn| turn.of_end(&by_middle));
            add_between([&by_middle, &turned], &point.shape_x, [&strain_p, &by_end], sum);
            let stiffening = self.evaluation.added.axial_stiffening * point.stiffness.axial * point.weight;
            let stiffness = density[(0, 0)] + stiffening;
            let force = self.evaluation.strain_force(m, self.resultants) - stiffness * self.evaluation.added.excess[m];
            let mut block = slope.force_hessian(strain, force, stiffness);
            if let Some(changes) = &self.evaluation.added.axial_rate_changes {
                block += strain_p * changes[m].transpose();
            }
            add_spread(&point.shape_x, &(block * scale), sum);
        }
        if let Some(condensation) = self.condensation {
            add_product(-scale / condensation.by_b, &bubble_q, &bubble_end, sum);
        }
    }

    /// Adds `scale` times the second derivatives by the axial strains of the bending points, which a tension center off
    /// the axis has.
    fn add_eccentric(&self, scale: f64, sum: &mut ElementColumns) {
        let element = self.evaluation.element;
        let strain = element.stiffness.strain;
        if strain == Strain::Small {
            // Linear in the axial strain.
            return;
        }
        for (g, own) in element.eccentricities.iter().flat_map(|all| all.iter().enumerate()) {
            let point = &element.bending[g];
            let (mut by_q, mut by_end) = (ElementVector::zeros(), ElementVector::zeros());
            for (m, share) in point.from_axial.into_iter().enumerate() {
                let (shape_x, slope) = (&element.axial[m].shape_x, &self.evaluation.slopes[m]);
                by_q += spread(shape_x, &(slope.strain_mean_p(strain) * share));
                by_end += spread(shape_x, &(slope.strain_end(strain) * share));
            }
            let factor = scale * point.weight * eccentricity::axial(strain, own, &self.evaluation.strains[g]);
            add_product(factor, &by_q, &by_end, sum);
        }
    }

    /// Derivatives of what the energy has by the strain of axial point `m`, by the strains of the bending points;
    /// `by_twist` is the one by `T`, N m.
    #[inline]
    fn forces(&self, m: usize, by_twist: f64) -> Forces {
        let mut forces = Forces { twist: by_twist, ..Forces::default() };
        for (g, point) in self.evaluation.element.bending.iter().enumerate() {
            let moments = self.rigidities[g].with_axial.map(|rigidity| rigidity * point.from_axial[m]);
            forces.add_moments(self.evaluation, g, moments);
        }
        forces
    }
}
