//! Kelvin-Voigt damping: `stress = E (strain + c rate)` with `c` in s, as the dissipation `c/2 Σ W D rate²`, W, over the strains of the
//! energy at its own quadrature points (MECHANICS 3.8): `D = EA` for the axial strain of the axial points, `E Iz`, `E Iy`, `G Jt` for `g1`, `g2`,
//! `tau` of the bending points. The axial strain is the one of the energy: `|r'|/J0 − 1` for small strain, Green's otherwise.
//!
//! The rigidities are constant: products of strains and rates, which the full integral of Green's strain over the section
//! has, are left out; they are of the order of the strain beside what is kept. Where torsion is suppressed, the Saint-Venant
//! rigidity is the one that suppresses it. The strains are those of the linear twist, whatever the element's is: the internal coordinate of
//! the quadratic one has no rate of its own.
//!
//! Over a step the rate is the change of the strains over its length: a rigid motion, however fast, is not damped at all.

use super::coordinates::{ELEMENT, ElementMatrix, ElementVector, add_spread, complete, spread};
use super::element::{Element, Evaluation};
use super::kinematics::corotated::COROTATED;
use super::kinematics::strain_derivatives::{Couplings, Forces, Gradients};
use super::over_step::{Coupling, STRAINS};
use super::strain::{Resultants, Rigidities, Strain};
use nalgebra::{SMatrix, SVector};

/// One number per strain of an element.
pub type StrainVector = SVector<f64, STRAINS>;

/// Viscous force at the velocities `velocity` of the coordinates, 14×1: `Jᵀ c W D J v`.
pub fn force(evaluation: &Evaluation, velocity: &ElementVector) -> ElementVector {
    let strains_q = strains_q(evaluation);
    strains_q * resultants(evaluation, &strains_q, velocity)
}

/// Viscous force at the rates `rates` of the strains, 14×1: `Jᵀ c W D rates`.
pub fn force_of_rates(evaluation: &Evaluation, rates: &[f64; STRAINS]) -> ElementVector {
    strains_q(evaluation) * viscous(evaluation.element, &StrainVector::from(*rates))
}

/// Derivative of [`force`] by the coordinates, 14×14: `Hess · resultants + Jᵀ c W D ∂(J v)/∂q`, a row of the last `vᵀ Hess(strain)`.
pub fn force_q(evaluation: &Evaluation, velocity: &ElementVector) -> ElementMatrix {
    let strains_q = strains_q(evaluation);
    let mut rates_q = SMatrix::<f64, ELEMENT, STRAINS>::zeros();
    for i in 0..STRAINS {
        rates_q.set_column(i, &(stress_hessian(evaluation, &StrainVector::ith(i, 1.0)) * velocity));
    }
    stress_hessian(evaluation, &resultants(evaluation, &strains_q, velocity))
        + weighted(&strains_q, evaluation.element) * rates_q.transpose()
}

/// Derivative of [`force`] by the velocities, 14×14: `Jᵀ c W D J`.
pub fn force_v(evaluation: &Evaluation) -> ElementMatrix {
    let strains_q = strains_q(evaluation);
    weighted(&strains_q, evaluation.element) * strains_q.transpose()
}

/// Strains of an element, undeformed values taken off, 1, 1/m, rad/m.
pub fn strains(evaluation: &Evaluation) -> StrainVector {
    let mut all = StrainVector::zeros();
    for (m, strain) in evaluation.axial_strains().into_iter().enumerate() {
        all[m] = strain;
    }
    for (g, strains) in evaluation.strains.iter().enumerate() {
        all.fixed_rows_mut::<3>(first_strain(g)).copy_from(&strains.fixed_rows::<3>(0));
    }
    all
}

/// `∂strains/∂q`, 14×12: a column a strain, `Jᵀ`.
pub fn strains_q(evaluation: &Evaluation) -> SMatrix<f64, ELEMENT, STRAINS> {
    let mut columns = SMatrix::<f64, ELEMENT, STRAINS>::zeros();
    for (m, slope) in evaluation.slopes.iter().enumerate() {
        let strain_p = match evaluation.element.stiffness.strain {
            Strain::Small => slope.engineering_strain_p(),
            Strain::Large | Strain::LargeTruncated => slope.green_strain_p(),
        };
        columns.set_column(m, &spread(&evaluation.element.axial[m].shape_x, &strain_p));
    }
    let gradients = Gradients::new(evaluation.element, &evaluation.kinematics);
    for g in 0..3 {
        for (i, by_shape) in gradients.strains(evaluation, g).iter().enumerate() {
            columns.set_column(first_strain(g) + i, &evaluation.kinematics.shape.gradient(by_shape));
        }
    }
    columns
}

/// `Σ_i resultants_i ∂²strain_i/∂q²`, 14×14.
pub fn stress_hessian(evaluation: &Evaluation, resultants: &StrainVector) -> ElementMatrix {
    let of_sections: [Resultants; 3] = std::array::from_fn(|g| resultants.fixed_rows::<3>(first_strain(g)).push(0.0));
    let (element, kinematics) = (evaluation.element, &evaluation.kinematics);
    let (forces, gradients) = (Forces::new(evaluation, &of_sections, &[0.0; 3]), Gradients::new(element, kinematics));
    let mut second = [[0.0; COROTATED]; COROTATED];
    gradients.add_frozen(&forces.factors(element), element, &mut second);
    let frozen = [Rigidities::default(); 3];
    let couplings = Couplings::new(evaluation, &of_sections, &frozen, 0.0);
    gradients.add_couplings(&couplings, &mut second);
    let mut all = ElementMatrix::zeros();
    let sum = &mut all.data.0;
    kinematics.shape.set_hessian(&gradients.sum(&forces), &mut second, 1.0, sum);
    for (m, slope) in evaluation.slopes.iter().enumerate() {
        let strain_pp = match evaluation.element.stiffness.strain {
            Strain::Small => slope.engineering_strain_pp(),
            Strain::Large | Strain::LargeTruncated => slope.green_strain_pp(),
        };
        add_spread(&evaluation.element.axial[m].shape_x, &(strain_pp * resultants[m]), sum);
    }
    complete(sum);
    all
}

/// Where the strains of bending point `g` start.
fn first_strain(g: usize) -> usize {
    3 + 3 * g
}

/// `c W D` of each strain: viscous resultant, quadrature weight included, over the rate of its strain.
fn viscosities(element: &Element) -> StrainVector {
    let (all, tension) = (element.stiffness.damping, element.stiffness.damping + element.tension_damping);
    let mut viscosities = StrainVector::from(element.rigidities());
    viscosities.iter_mut().enumerate().for_each(|(i, rigidity)| *rigidity *= if i < 3 { tension } else { all });
    viscosities
}

/// What couples an axial strain with a curvature in the viscous resultants: the numbers of both, and the viscosity.
fn cross_viscosities(element: &Element) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
    element.couplings().map(|Coupling { axial, point, curvature, rigidity }| {
        (axial, first_strain(point) + curvature, rigidity * element.stiffness.damping)
    })
}

/// Viscous resultants at the rates `rates` of the strains.
fn viscous(element: &Element, rates: &StrainVector) -> StrainVector {
    let mut all = viscosities(element).component_mul(rates);
    for (i, j, viscosity) in cross_viscosities(element) {
        all[i] += viscosity * rates[j];
        all[j] += viscosity * rates[i];
    }
    all
}

/// Viscous resultants at the velocities `velocity`.
fn resultants(
    evaluation: &Evaluation,
    strains_q: &SMatrix<f64, ELEMENT, STRAINS>,
    velocity: &ElementVector,
) -> StrainVector {
    viscous(evaluation.element, &strains_q.tr_mul(velocity))
}

/// `columns` times the symmetric matrix of the viscosities of `element`.
fn weighted(columns: &SMatrix<f64, ELEMENT, STRAINS>, element: &Element) -> SMatrix<f64, ELEMENT, STRAINS> {
    let mut scaled = *columns;
    for (mut column, factor) in scaled.column_iter_mut().zip(&viscosities(element)) {
        column *= *factor;
    }
    for (i, j, viscosity) in cross_viscosities(element) {
        let (by_i, by_j) = (columns.column(i) * viscosity, columns.column(j) * viscosity);
        let mut target = scaled.column_mut(i);
        target += by_j;
        let mut target = scaled.column_mut(j);
        target += by_i;
    }
    scaled
}
