//! A section inside an element, as a point to hold on to (MECHANICS 2.13, 2.17).

use super::Kinematics;
use super::corotated::COROTATED;
use super::strain_derivatives::{Factors, Gradients};
use crate::math::elementary::sin_cos;
use crate::math::rotation::{carry, half_turn, half_turn_by_first, half_turn_by_second, normal_projector};
use crate::math::{Mat3, Vec3, hermite, quadrature};
use crate::mechanics::beam::ancf14::coordinates::{
    ELEMENT, ElementMatrix, ElementVector, P, SHAPE_PLACES, complete, interpolate,
};
use crate::mechanics::beam::ancf14::element::Element;
use crate::mechanics::beam::configuration::BeamConfiguration;
use crate::mechanics::geometry::pose::Pose;
use nalgebra::SMatrix;

/// A vector by the element's coordinates, 3×14.
pub type ByElement = SMatrix<f64, 3, ELEMENT>;

/// A section inside an element.
pub struct SectionPoint<'a> {
    element: &'a Element,
    xi: f64,
    kinematics: &'a Kinematics<'a>,
    /// Weights of `X_a` in the place of the section.
    pub shape: [f64; 4],
    shape_x: [f64; 4],
    /// `l A_h(ξ)`, m.
    collocation: [f64; 3],
    stretch: f64,
    t: Vec3,
    /// `kb(t_0, t)`.
    k: Vec3,
}

impl<'a> SectionPoint<'a> {
    /// At the place `xi` (0 to 1) of `element`, whose `kinematics` are those at `c`.
    pub fn new(c: &BeamConfiguration<'a>, element: &'a Element, kinematics: &'a Kinematics<'a>, xi: f64) -> Self {
        let shape_x = hermite::shape_x(xi, element.length);
        let p = interpolate(&shape_x, element.own(c.q));
        let stretch = p.norm();
        let t = p / stretch;
        Self {
            element,
            xi,
            kinematics,
            shape: hermite::shape(xi, element.length),
            shape_x,
            collocation: quadrature::collocation(xi).map(|a| a * element.length),
            stretch,
            t,
            k: half_turn(&c.frames[element.place.frame].t, &t),
        }
    }

    /// Position and section axes.
    pub fn pose(&self, c: &BeamConfiguration) -> Pose {
        let q = self.element.own(c.q);
        let [first, _] = self.element.frames(c);
        let u = carry(&first.t, &self.t, &first.u);
        let v = self.t.cross(&u);
        let (sin, cos) = sin_cos(self.kinematics.alpha_at(q, self.xi, &self.collocation));
        let axes = Mat3::from_columns(&[self.t, u * cos + v * sin, v * cos - u * sin]);
        Pose { place: interpolate(&self.shape, q), axes }
    }

    /// `factor` times the angle α of the section here, as a weighted sum (2.13).
    fn angle(&self, factor: f64) -> Factors {
        let rates = [0, 1, 2].map(|g| self.xi * self.element.rate_weights[g] - self.collocation[g]);
        Factors { points: rates.map(|rate| [0.0, 0.0, factor * rate]), twist: factor * self.xi, alpha: factor }
    }

    /// Spin about the tangent by the coordinates, 1×14 as a column: `dα + s_0·dt_0 − kb(t_0, t)·(dt_0 + dt)` (2.17).
    fn spin_q(&self, c: &BeamConfiguration) -> ElementVector {
        let [first, _] = self.element.frames(c);
        let mut spin = self.kinematics.shape.gradient(&self.angle(1.0).gradient(self.element, self.kinematics));
        let mut slope = spin.fixed_rows_mut::<3>(P);
        slope -= (first.k + self.k) / first.stretch;
        for (weight, place) in self.shape_x.iter().zip(SHAPE_PLACES) {
            let mut rows = spin.fixed_rows_mut::<3>(place);
            rows -= self.k * (weight / self.stretch);
        }
        spin
    }

    /// Derivative of the position by the coordinates of the element.
    pub fn place_q(&self) -> ByElement {
        let mut place_q = ByElement::zeros();
        for (weight, place) in self.shape.iter().zip(SHAPE_PLACES) {
            place_q.fixed_columns_mut::<3>(place).copy_from(&(Mat3::identity() * *weight));
        }
        place_q
    }

    /// Derivative of the turn, in space, by the coordinates of the element.
    pub fn turn_q(&self, c: &BeamConfiguration) -> ByElement {
        let mut turn_q = self.t * self.spin_q(c).transpose();
        let tilt = self.t.cross_matrix() / self.stretch;
        for (weight, place) in self.shape_x.iter().zip(SHAPE_PLACES) {
            let mut columns = turn_q.fixed_columns_mut::<3>(place);
            columns += tilt * *weight;
        }
        turn_q
    }

    /// `∂(turn_qᵀ m)/∂q`, 14×14, of a moment frozen in space; a force at an interior point has none: places are linear
    /// in q.
    pub fn moment_stiffness(&self, c: &BeamConfiguration, moment: &Vec3) -> ElementMatrix {
        let (element, kinematics) = (self.element, self.kinematics);
        let [first, _] = element.frames(c);
        let along = moment.dot(&self.t);
        let t_p = normal_projector(&self.t) / self.stretch;
        let tilt = moment.cross(&self.t) / self.stretch;
        let tilt_p = (moment.cross_matrix() * t_p - tilt * self.t.transpose()) / self.stretch;
        // Second derivatives of the spin's exact part, α.
        let angle = self.angle(along);
        let (mut second, mut sum) = ([[0.0; COROTATED]; COROTATED], ElementMatrix::zeros());
        Gradients::new(element, kinematics).add_frozen(&angle, element, &mut second);
        let by_shape = angle.gradient(element, kinematics);
        kinematics.shape.set_hessian(&by_shape, &mut second, 1.0, &mut sum.data.0);
        complete(&mut sum.data.0);
        // Its inexact part, −(k_0 + kb)·dp_0/|p_0| − kb·dp/|p|.
        let k_t0 = half_turn_by_first(&first.t, &self.t, &self.k);
        let k_t = half_turn_by_second(&first.t, &self.t, &self.k);
        let (l0, l) = (first.stretch, self.stretch);
        let mut base = sum.fixed_view_mut::<3, 3>(P, P);
        base -=
            ((first.k_p() + k_t0 * first.t_p()) / l0 - (first.k + self.k) * first.t.transpose() / (l0 * l0)) * along;
        let base_by_p = k_t * t_p * (along / l0);
        let p_by_base = k_t0 * first.t_p() * (along / l);
        let p_by_p = tilt_p - (k_t * t_p / l - self.k * self.t.transpose() / (l * l)) * along;
        for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
            let mut view = sum.fixed_view_mut::<3, 3>(P, row);
            view -= base_by_p * self.shape_x[a];
            let mut view = sum.fixed_view_mut::<3, 3>(row, P);
            view -= p_by_base * self.shape_x[a];
            for (b, column) in SHAPE_PLACES.into_iter().enumerate() {
                let mut view = sum.fixed_view_mut::<3, 3>(row, column);
                view += p_by_p * (self.shape_x[a] * self.shape_x[b]);
            }
        }
        let spin = self.spin_q(c);
        let across = t_p * moment;
        for (weight, place) in self.shape_x.iter().zip(SHAPE_PLACES) {
            let mut columns = sum.fixed_columns_mut::<3>(place);
            columns += spin * across.transpose() * *weight;
        }
        sum
    }
}
