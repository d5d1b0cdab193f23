//! What ANCF14 answers to the system.

use super::coordinates::{ELEMENT, ElementVector, SHAPE_PLACES, interpolate};
use super::element::{Element, Evaluation};
use super::energy::quadratic_twist::{self, Twist};
use super::kinematics::Holonomy;
use super::kinematics::section_point::SectionPoint;
use super::over_step::{EndStrains, STRAINS};
use super::{damping, section};
use crate::math::jet::Jet;
use crate::math::{Vec3, hermite};
use crate::mechanics::beam::balance::{Balance, Instant};
use crate::mechanics::beam::configuration::{BeamConfiguration, Passage, TimeStep};
use crate::mechanics::beam::element::BeamElement;
use crate::mechanics::beam::line_load::{ElementForces, LOAD_POINTS, LineLoad, MOST_COORDINATES};
use crate::mechanics::beam::resultants::{SectionForces, SectionShape, SectionStrains};
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerJacobian, MarkerMatrix};
use crate::mechanics::geometry::pose::Pose;
use std::ops::Range;

/// Smallest `1 + t_0·t_1` of an element's ends: 143 degrees between them, near the singularity of the minimal rotation
/// (MECHANICS 2.6).
const SMALLEST_COSINE: f64 = 0.2;
/// Largest change of the holonomy angle in a step, rad: the branch is safe below pi (MECHANICS 2.6).
const LARGEST_TWIST_CHANGE: f64 = 2.0;

impl Element {
    /// The numbers of the frames of its nodes.
    pub fn frame_numbers(&self) -> [usize; 2] {
        [self.place.frame, self.place.frame + 1]
    }

    pub(in crate::mechanics) fn add(&self, values: &ElementVector, sum: &mut [f64]) {
        let own = &mut sum[self.place.start..self.place.start + ELEMENT];
        own.iter_mut().zip(values).for_each(|(target, value)| *target += value);
    }

    /// What `with` makes of the element as `passage` says.
    #[inline]
    fn passing<R>(&self, c: &BeamConfiguration, passage: &Passage, with: impl FnOnce(&Evaluation) -> R) -> R {
        match passage {
            Passage::Rest | Passage::Instant { .. } => with(&self.evaluation(c)),
            Passage::Corrected(correction) => {
                let mut here = self.evaluation(c);
                here.set_correction(self.own(correction));
                with(&here)
            }
            Passage::Step(step) => self.over_step(c, &self.end_strains(step.end), step, with),
        }
    }

    /// Adds the gradient of `evaluation`, and sets `block` to `scale` times its Hessian.
    pub(super) fn add_gradient_and_hessian_of(
        &self,
        evaluation: &Evaluation,
        scale: f64,
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        let (columns, _) = block.as_chunks_mut::<ELEMENT>();
        let columns = columns.first_chunk_mut::<ELEMENT>().expect("a block has a column a coordinate");
        self.add(&evaluation.gradient_and_set_hessian(scale, columns), forces);
    }

    /// Viscous force of the material with the rates `all` of strains of the system, or with the velocities `velocity`.
    fn viscous_force(&self, c: &BeamConfiguration, velocity: &[f64], all: Option<&[f64]>) -> ElementVector {
        let here = self.linear_evaluation(c);
        damping::force_of_rates(&here, &self.known_rates(&here, velocity, all))
    }

    /// Its own of the rates `all` of strains of the system, or those with the velocities `velocity`.
    fn known_rates(&self, here: &Evaluation, velocity: &[f64], all: Option<&[f64]>) -> [f64; STRAINS] {
        match all {
            Some(all) => *self.own_rates(all),
            None => self.strain_rates_with(here, self.own(velocity), 0.0),
        }
    }

    /// Internal coordinate of the quadratic twist, rad; 0 for linear twist.
    fn bubble(&self, c: &BeamConfiguration) -> f64 {
        match self.stiffness.twist {
            Twist::Linear => 0.0,
            Twist::Quadratic => self.evaluation(c).bubble,
        }
    }
}

impl BeamElement for Element {
    fn coordinates(&self) -> Range<usize> {
        self.place.start..self.place.start + ELEMENT
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn is_damped(&self) -> bool {
        self.stiffness.damping != 0.0 || self.tension_damping != 0.0
    }

    fn set_damping(&mut self, damping: f64, tension_damping: f64) {
        self.stiffness.damping = damping;
        self.tension_damping = tension_damping;
    }

    fn axis_point(&self, xi: f64, q: &[f64]) -> Vec3 {
        interpolate(&hermite::shape(xi, self.length), self.own(q))
    }

    fn axis_q(&self, xi: f64) -> ByCoordinates {
        let mut axis_q = ByCoordinates::zeros();
        for (weight, place) in hermite::shape(xi, self.length).into_iter().zip(SHAPE_PLACES) {
            (0..3).for_each(|axis| axis_q[(axis, place + axis)] = weight);
        }
        axis_q
    }

    fn add_weight(&self, gravity: &Vec3, factor: f64, forces: &mut [f64]) {
        self.add(&(self.weight(gravity) * factor), forces);
    }

    fn add_mass(&self, factor: f64, block: &mut [f64]) {
        self.inertia.mass.add(factor, block);
    }

    fn add_mass_times(&self, factor: f64, vector: &[f64], product: &mut [f64]) {
        self.add(&(self.inertia.mass.times(self.own(vector)) * factor), product);
    }

    fn mass_form(&self, vector: &[f64]) -> f64 {
        let own = self.own(vector);
        own.iter().zip(&self.inertia.mass.times(own)).map(|(value, product)| value * product).sum()
    }

    fn weight_form(&self, gravity: &Vec3, q: &[f64]) -> f64 {
        self.own(q).iter().zip(&self.weight(gravity)).map(|(q, weight)| q * weight).sum()
    }

    fn energy(&self, c: &BeamConfiguration) -> f64 {
        self.evaluation(c).energy()
    }

    fn add_gradient(&self, c: &BeamConfiguration, passage: &Passage, forces: &mut [f64]) {
        self.add(&self.passing(c, passage, |here| here.gradient()), forces);
    }

    fn add_gradient_and_set_hessian(
        &self,
        c: &BeamConfiguration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        self.passing(c, passage, |here| self.add_gradient_and_hessian_of(here, scale, forces, block));
    }

    fn finish_step(
        &self,
        c: &BeamConfiguration,
        step: &TimeStep,
        forces: &mut [f64],
        strain_rates: &mut [f64],
    ) -> [f64; 3] {
        let end = self.evaluation(step.end);
        self.over_step(c, &EndStrains::new(&end), step, |middle| {
            self.add(&middle.gradient(), forces);
            *self.own_rates_mut(strain_rates) = middle.added.rates;
            let heat = if self.heating.is_some() { self.work_of_heat(middle, step) } else { 0.0 };
            [end.energy(), middle.added.taken(self, step.duration), heat]
        })
    }

    fn begin_step(
        &self,
        c: &BeamConfiguration,
        _middle: &[Jet],
        velocity: &[f64],
        starts: &mut [EndStrains],
        strain_rates: Option<&mut [f64]>,
    ) {
        let Some(all) = strain_rates else {
            starts[self.place.branch] = self.end_strains(c);
            return;
        };
        let evaluation = self.evaluation(c);
        starts[self.place.branch] = EndStrains::new(&evaluation);
        *self.own_rates_mut(all) = self.strain_rates(&evaluation, self.own(velocity));
    }

    fn set_strain_rates(&self, c: &BeamConfiguration, velocity: &[f64], strain_rates: &mut [f64]) {
        *self.own_rates_mut(strain_rates) = self.strain_rates(&self.evaluation(c), self.own(velocity));
    }

    fn add_damping(&self, c: &BeamConfiguration, velocity: &[f64], strain_rates: Option<&[f64]>, forces: &mut [f64]) {
        self.add(&self.viscous_force(c, velocity, strain_rates), forces);
    }

    fn add_damping_and_tangent(
        &self,
        c: &BeamConfiguration,
        velocity: &[f64],
        scales: [f64; 2],
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        let velocity = ElementVector::from_column_slice(self.own(velocity));
        let (force, tangent) = damping::force_and_tangent(&self.linear_evaluation(c), &velocity, scales);
        self.add(&force, forces);
        block.iter_mut().zip(tangent.as_slice()).for_each(|(target, value)| *target += value);
    }

    fn add_damped_gradient_and_set_hessian(
        &self,
        c: &BeamConfiguration,
        (velocity, velocity_by_q): (&[f64], f64),
        scale: f64,
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        if self.stiffness.twist == Twist::Quadratic {
            // The strains of the damping are those of the linear twist.
            self.add_gradient_and_set_hessian(c, &Passage::Rest, scale, forces, block);
            return self.add_damping_and_tangent(c, velocity, [scale, scale * velocity_by_q], forces, block);
        }
        let mut here = self.evaluation(c);
        here.set_damping(self.own(velocity), velocity_by_q);
        self.add_gradient_and_hessian_of(&here, scale, forces, block);
    }

    fn energy_and_viscous_power(&self, c: &BeamConfiguration, velocity: &[f64]) -> [f64; 2] {
        let here = self.evaluation(c);
        let power = match self.stiffness.twist {
            _ if !self.is_damped() => 0.0,
            Twist::Linear => here.viscous_power(self.own(velocity)),
            Twist::Quadratic => self.linear_evaluation(c).viscous_power(self.own(velocity)),
        };
        [here.energy(), power]
    }

    fn balance(&self, c: &BeamConfiguration, instant: &Instant, inside: &ElementForces) -> Balance {
        let mut acting = -ElementVector::from_column_slice(&inside[..ELEMENT]);
        if self.is_damped() {
            acting += self.viscous_force(c, instant.velocity, instant.strain_rates);
        }
        self.balance_of(c, instant, acting, None)
    }

    fn load_points(&self) -> [(f64, f64); LOAD_POINTS] {
        // Of the arc length, as mass and weight are: not `w l J0`, the length of the interpolated curve, which strains
        // have.
        [0, 1, 2].map(|g| (self.bending[g].xi, self.bending[g].weight / self.bending[g].reference_stretch))
    }

    fn line_force(&self, c: &BeamConfiguration, load: &LineLoad) -> ElementForces {
        let mut forces = [0.0; MOST_COORDINATES];
        forces[..ELEMENT].copy_from_slice(self.line_force(c, load).as_slice());
        forces
    }

    fn add_line_stiffness(&self, c: &BeamConfiguration, load: &LineLoad, factor: f64, block: &mut [f64]) {
        let stiffness = self.line_stiffness(c, load);
        block.iter_mut().zip(stiffness.as_slice()).for_each(|(target, value)| *target += factor * value);
    }

    fn section_pose(&self, c: &BeamConfiguration, xi: f64) -> Pose {
        SectionPoint::new(c, self, &self.kinematics(c), xi).pose(c)
    }

    fn section_jacobian(&self, c: &BeamConfiguration, xi: f64) -> MarkerJacobian {
        let kinematics = self.kinematics(c);
        let point = SectionPoint::new(c, self, &kinematics, xi);
        let (mut place_q, mut turn_q) = (ByCoordinates::zeros(), ByCoordinates::zeros());
        place_q.fixed_columns_mut::<ELEMENT>(0).copy_from(&point.place_q());
        turn_q.fixed_columns_mut::<ELEMENT>(0).copy_from(&point.turn_q(c));
        MarkerJacobian { place_q, turn_q }
    }

    fn add_section_moment_stiffness(&self, c: &BeamConfiguration, xi: f64, moment: &Vec3, sum: &mut MarkerMatrix) {
        let mut own = sum.fixed_view_mut::<ELEMENT, ELEMENT>(0, 0);
        own += SectionPoint::new(c, self, &self.kinematics(c), xi).moment_stiffness(c, moment);
    }

    fn relaxed_turn(&self, c: &BeamConfiguration, xi: f64) -> f64 {
        self.bubble(c) * quadratic_twist::shape(xi)
    }

    fn relaxed_spin(&self, c: &BeamConfiguration, xi: f64, velocity: &[f64]) -> f64 {
        match self.stiffness.twist {
            Twist::Linear => 0.0,
            Twist::Quadratic => {
                let bubble_q = self.evaluation(c).bubble_q();
                let products = bubble_q.iter().zip(self.own(velocity)).map(|(by_q, velocity)| by_q * velocity);
                quadratic_twist::shape(xi) * products.sum::<f64>()
            }
        }
    }

    fn section_turn(&self, c: &BeamConfiguration, xi: f64, torque: &dyn Fn(f64) -> f64) -> f64 {
        match self.stiffness.twist {
            Twist::Linear => section::turn_of_torque(self, xi, torque),
            Twist::Quadratic => self.relaxed_turn(c, xi),
        }
    }

    fn section_shape(&self, c: &BeamConfiguration, xi: f64) -> SectionShape {
        section::shape(self, c, &self.kinematics(c), xi, self.bubble(c))
    }

    fn section_strains(&self, c: &BeamConfiguration, xi: f64, drawn: &SectionShape) -> SectionStrains {
        section::strains(self, c, xi, drawn)
    }

    fn strains_under(&self, xi: f64, forces: &SectionForces, near: [&SectionStrains; 2]) -> Option<SectionStrains> {
        section::strains_under(self, xi, forces, near)
    }

    fn linear_strains_under(&self, xi: f64, forces: &SectionForces, near: &SectionStrains) -> Option<SectionStrains> {
        section::linear_strains_under(self, xi, forces, near)
    }

    fn viscous_strains(&self, c: &BeamConfiguration, xi: f64, instant: &Instant) -> SectionStrains {
        let rates = self.known_rates(&self.linear_evaluation(c), instant.velocity, instant.strain_rates);
        section::viscous(self, xi, &rates)
    }

    fn twist(&self, c: &BeamConfiguration, xi: f64) -> f64 {
        let linear = xi * (self.kinematics(c).twist - self.reference_twist);
        // At the ends the quadratic part vanishes.
        if xi == 1.0 { linear } else { linear + self.relaxed_turn(c, xi) }
    }

    fn largest_torsion(&self, c: &BeamConfiguration) -> f64 {
        self.evaluation(c).largest_torsion()
    }

    fn distortion(&self, c: &BeamConfiguration) -> Option<&'static str> {
        let [first, second] = self.frames(c);
        if 1.0 + first.t.dot(&second.t) < SMALLEST_COSINE {
            return Some("bent");
        }
        let previous = c.holonomy[self.place.branch];
        let holonomy = Holonomy::new(first, second, previous);
        ((holonomy.angle - previous).abs() > LARGEST_TWIST_CHANGE).then_some("twisted")
    }
}
