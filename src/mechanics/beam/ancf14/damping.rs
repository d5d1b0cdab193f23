//! Kelvin-Voigt damping: `stress = E (strain + c rate)` with `c` in s, as the dissipation `c/2 Σ W D rate²`, W, over
//! the strains of the energy at its own quadrature points (MECHANICS 3.8): `D = EA` for the axial strain of the axial
//! points, `E Iz`, `E Iy`, `G Jt` for `g1`, `g2`, `tau` of the bending points. The axial strain is the one of the
//! energy: `|r'|/J0 − 1` for small strain, Green's otherwise.
//!
//! The rigidities are constant: products of strains and rates, which the full integral of Green's strain over the
//! section has, are left out; they are of the order of the strain beside what is kept. Where torsion is suppressed, the
//! Saint-Venant rigidity is the one that suppresses it. The strains are those of the linear twist, whatever the
//! element's is: the internal coordinate of the quadratic one has no rate of its own.
//!
//! Over a step the rate is the change of the strains over its length: a rigid motion, however fast, is not damped at
//! all.

use super::coordinates::{
    ELEMENT, ElementMatrix, ElementVector, add_slope_force, add_spread, complete, slopes, spread,
};
use super::element::{Element, Evaluation};
use super::kinematics::corotated::COROTATED;
use super::kinematics::strain_derivatives::{Couplings, Forces, Gradients};
use super::over_step::{Coupling, STRAINS};
use super::strain::{Resultants, Rigidities};
use nalgebra::{SMatrix, SVector};

/// One number per strain of an element.
pub type StrainVector = SVector<f64, STRAINS>;
/// A column per strain of an element, of one number per coordinate.
type StrainColumns = SMatrix<f64, ELEMENT, STRAINS>;

/// Viscous force at the velocities `velocity` of the coordinates, 14×1: `Jᵀ c W D J v`.
pub fn force(evaluation: &Evaluation, velocity: &ElementVector) -> ElementVector {
    let rates = evaluation.element.strain_rates_with(evaluation, velocity.as_slice(), 0.0);
    force_of_rates(evaluation, &rates)
}

/// Viscous force at the rates `rates` of the strains, 14×1: `Jᵀ c W D rates`.
pub fn force_of_rates(evaluation: &Evaluation, rates: &[f64; STRAINS]) -> ElementVector {
    let (element, kinematics) = (evaluation.element, &evaluation.kinematics);
    let resultants = viscous(element, &StrainVector::from(*rates));
    let forces = Forces::new(evaluation, &of_sections(&resultants), &[0.0; 3]);
    let mut sum = kinematics.shape.gradient(&forces.factors(element).gradient(element, kinematics));
    for (m, slope) in evaluation.slopes.iter().enumerate() {
        let by_slope = slope.strain_p(element.stiffness.strain) * resultants[m];
        add_slope_force(&element.axial[m].shape_x, &by_slope, &mut sum);
    }
    sum
}

/// [`force`], and `by_q` times its derivative with respect to the coordinates plus `by_v` times that with respect to
/// the velocities, 14×14: `by_q (Hess · resultants + Jᵀ c W D ∂(J v)/∂q) + by_v Jᵀ c W D J`.
pub fn force_and_tangent(
    evaluation: &Evaluation,
    velocity: &ElementVector,
    [by_q, by_v]: [f64; 2],
) -> (ElementVector, ElementMatrix) {
    let gradients = Gradients::new(evaluation.element, &evaluation.kinematics);
    let strains_q = strains_with(evaluation, &gradients);
    let resultants = viscous(evaluation.element, &strains_q.tr_mul(velocity));
    let changes = rates_q(evaluation, &gradients, velocity) * by_q + strains_q * by_v;
    let tangent = stress_hessian_with(evaluation, &gradients, &resultants) * by_q
        + weighted(&strains_q, evaluation.element) * changes.transpose();
    (strains_q * resultants, tangent)
}

/// `∂(J v)/∂q`, 14×12: a column a strain, what its gradient changes by along the velocities.
fn rates_q(evaluation: &Evaluation, gradients: &Gradients, velocity: &ElementVector) -> StrainColumns {
    let (element, shape) = (evaluation.element, &evaluation.kinematics.shape);
    let mut columns = StrainColumns::zeros();
    let slope_rates = slopes(&element.axial[1].shape_x, velocity.as_slice());
    for (m, slope) in evaluation.slopes.iter().enumerate() {
        let weights = &element.axial[m].shape_x;
        let change = slope.strain_pp(element.stiffness.strain) * slope_rates[m];
        columns.set_column(m, &spread(weights, &change));
    }
    let change = shape.along(velocity.as_slice());
    let way_back = shape.way_back_change(velocity.as_slice(), &change);
    for (g, changes) in gradients.strain_changes(evaluation, &change).iter().enumerate() {
        for (i, (by_shape, moving)) in gradients.strains(evaluation, g).iter().zip(changes).enumerate() {
            let column = shape.gradient(moving) + shape.gradient_change(by_shape, &way_back);
            columns.set_column(first_strain(g) + i, &column);
        }
    }
    columns
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
pub fn strains_q(evaluation: &Evaluation) -> StrainColumns {
    strains_with(evaluation, &Gradients::new(evaluation.element, &evaluation.kinematics))
}

fn strains_with(evaluation: &Evaluation, gradients: &Gradients) -> StrainColumns {
    let (element, shape) = (evaluation.element, &evaluation.kinematics.shape);
    let mut columns = StrainColumns::zeros();
    for (m, slope) in evaluation.slopes.iter().enumerate() {
        columns.set_column(m, &spread(&element.axial[m].shape_x, &slope.strain_p(element.stiffness.strain)));
    }
    for g in 0..3 {
        for (i, by_shape) in gradients.strains(evaluation, g).iter().enumerate() {
            columns.set_column(first_strain(g) + i, &shape.gradient(by_shape));
        }
    }
    columns
}

/// `Σ_i resultants_i ∂²strain_i/∂q²`, 14×14.
pub fn stress_hessian(evaluation: &Evaluation, resultants: &StrainVector) -> ElementMatrix {
    stress_hessian_with(evaluation, &Gradients::new(evaluation.element, &evaluation.kinematics), resultants)
}

fn stress_hessian_with(evaluation: &Evaluation, gradients: &Gradients, resultants: &StrainVector) -> ElementMatrix {
    let (element, of_sections) = (evaluation.element, of_sections(resultants));
    let forces = Forces::new(evaluation, &of_sections, &[0.0; 3]);
    let mut second = [[0.0; COROTATED]; COROTATED];
    gradients.add_frozen(&forces.factors(element), element, &mut second);
    let frozen = [Rigidities::default(); 3];
    gradients.add_couplings(&Couplings::new(evaluation, &of_sections, &frozen, 0.0), &mut second);
    let mut all = ElementMatrix::zeros();
    let sum = &mut all.data.0;
    evaluation.kinematics.shape.set_hessian(&gradients.sum(&forces), &mut second, 1.0, sum);
    for (m, slope) in evaluation.slopes.iter().enumerate() {
        let by_slope = slope.strain_pp(element.stiffness.strain) * resultants[m];
        add_spread(&element.axial[m].shape_x, &by_slope, sum);
    }
    complete(sum);
    all
}

/// Those of `resultants` that belong to the bending points; nothing of the axial strain.
fn of_sections(resultants: &StrainVector) -> [Resultants; 3] {
    std::array::from_fn(|g| resultants.fixed_rows::<3>(first_strain(g)).push(0.0))
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

/// `columns` times the symmetric matrix of the viscosities of `element`.
fn weighted(columns: &StrainColumns, element: &Element) -> StrainColumns {
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
