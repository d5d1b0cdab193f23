//! Second derivatives that have to do with the stretch of the axial points: they act on all coordinates of an element, in space
//! (MECHANICS 8). Densities are those of axial.rs.

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
            let second = axial::large::hessian(&point.stiffness, evaluation.green[m], evaluation.mean_torsion[m]);
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

/// What the second derivatives by the Green strains of the axial points are made of.
#[derive(Clone, Copy, Debug)]
pub struct Large<'a> {
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

impl Large<'_> {
    /// Adds `scale` times all second derivatives by the Green strains of the axial points to `sum`, without the rows and columns of `r_0`.
    #[inline]
    pub fn add_hessian(&self, scale: f64, sum: &mut ElementColumns) {
        let (element, shape) = (self.evaluation.element, &self.evaluation.kinematics.shape);
        self.add_eccentric(scale, sum);
        let (mut bubble_q, mut bubble_end) = (ElementVector::zeros(), ElementVector::zeros());
        for (m, point) in element.axial.iter().enumerate() {
            let slope = &self.evaluation.slopes[m];
            let density =
                axial::large::hessian(&point.stiffness, self.evaluation.green[m], self.evaluation.mean_torsion[m])
                    * point.weight;
            // By this Green strain, of the gradient by the corotated shape.
            let mut by_green = self.gradients.sum(&self.forces(m, density[(0, 1)] * point.torsion_by_twist));
            let green_p = slope.green_strain_p();
            // Over a step the Green strain also depends on the increment: d(|Δr'|²/8J0²) by the end's coordinates, twice.
            let by_end = green_p + slope.green_strain_increment();
            if let Some(condensation) = self.condensation {
                let share = condensation.by_green[m];
                condensation.condense_row(share, &mut by_green);
                bubble_q += spread(&point.shape_x, &(green_p * share));
                bubble_end += spread(&point.shape_x, &(by_end * share));
            }
            let by_middle = shape.gradient(&by_green) * scale;
            let turned = self.evaluation.turn_from_end.as_ref().map_or(by_middle, |turn| turn.of_end(&by_middle));
            add_between([&by_middle, &turned], &point.shape_x, [&green_p, &by_end], sum);
            let stiffening = self.evaluation.added.axial_stiffening * point.stiffness.axial * point.weight;
            let stiffness = density[(0, 0)] + stiffening;
            let force = self.evaluation.green_force(m, self.resultants) - stiffness * self.evaluation.added.excess[m];
            let mut block = green_p * by_end.transpose() * stiffness + slope.green_strain_pp() * force;
            if let Some(changes) = &self.evaluation.added.axial_rate_changes {
                block += green_p * changes[m].transpose();
            }
            add_spread(&point.shape_x, &(block * scale), sum);
        }
        if let Some(condensation) = self.condensation {
            add_product(-scale / condensation.by_b, &bubble_q, &bubble_end, sum);
        }
    }

    /// Adds `scale` times the second derivatives by the axial strains of the bending points, which a tension center off the axis has.
    fn add_eccentric(&self, scale: f64, sum: &mut ElementColumns) {
        let element = self.evaluation.element;
        for (g, own) in element.eccentricities.iter().flat_map(|all| all.iter().enumerate()) {
            let point = &element.bending[g];
            let (mut by_q, mut by_end) = (ElementVector::zeros(), ElementVector::zeros());
            for (m, share) in point.from_axial.into_iter().enumerate() {
                let (shape_x, slope) = (&element.axial[m].shape_x, &self.evaluation.slopes[m]);
                let green_p = slope.green_strain_p();
                by_q += spread(shape_x, &(green_p * share));
                by_end += spread(shape_x, &((green_p + slope.green_strain_increment()) * share));
            }
            let factor = scale * point.weight * eccentricity::axial(own, &self.evaluation.strains[g]);
            add_product(factor, &by_q, &by_end, sum);
        }
    }

    /// Derivatives of what the energy has by the Green strain of axial point `m`, by the strains of the bending points; `by_twist` is
    /// the one by `T`, N m.
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
