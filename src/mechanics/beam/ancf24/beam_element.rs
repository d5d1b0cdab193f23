//! What ANCF24 answers to the system.

use super::coordinates::{AXIS_PLACES, ELEMENT, Interpolation, NODE, Y_PLACES, Z_PLACES};
use super::element::Element;
use super::frame::SectionFrame;
use super::station::Station;
use super::{damping, section};
use crate::math::quadrature::{GAUSS_POINTS, GAUSS_WEIGHTS};
use crate::math::rotation::carry;
use crate::math::vectors::{add_vec3, vec3};
use crate::math::{Mat3, Vec3, hermite};
use crate::mechanics::beam::balance::{Balance, Instant};
use crate::mechanics::beam::configuration::{BeamConfiguration, Passage, TimeStep};
use crate::mechanics::beam::element::BeamElement;
use crate::mechanics::beam::line_load::{ElementForces, LOAD_POINTS, LineLoad};
use crate::mechanics::beam::resultants::{SectionShape, SectionStrains};
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerJacobian, MarkerMatrix, MarkerVector};
use crate::mechanics::geometry::pose::Pose;
use std::ops::Range;

/// Smallest `1 + a·b` of directions at an element's ends: 143 degrees between them, as for ANCF14. Linear between them,
/// a section would have less than a third of its size in the middle.
const SMALLEST_COSINE: f64 = 0.2;

/// Where `r_y` and `r_z` of an interior section come from.
fn sources(xi: f64) -> [[(usize, f64); 2]; 2] {
    [Y_PLACES, Z_PLACES].map(|[first, second]| [(first, 1.0 - xi), (second, xi)])
}

impl Element {
    /// The triad at `xi`.
    fn frame(&self, c: &BeamConfiguration, xi: f64) -> SectionFrame {
        section::frame(&Interpolation::new(xi, self.length).directors(self.own(c.q)))
    }

    /// Adds the force of a step whose middle is `c`, damping included.
    fn add_force_over_step(&self, c: &BeamConfiguration, step: &TimeStep, forces: &mut [f64]) {
        let forces = self.own_mut(forces);
        self.add_gradient(self.own(c.q), Some(self.own(step.increment)), forces);
        if self.properties.damping != 0.0 {
            self.add_damping_over_step(c, step, forces);
        }
    }

    /// Adds the viscous force of a step whose middle is `c` to `forces` (24).
    fn add_damping_over_step(&self, c: &BeamConfiguration, step: &TimeStep, forces: &mut [f64]) {
        let places = [self.own(step.start.q), self.own(c.q), self.own(step.end.q)];
        damping::add_force_over_step(self, places, step.duration, forces);
    }

    fn own_mut<'a>(&self, vector: &'a mut [f64]) -> &'a mut [f64] {
        &mut vector[self.start..self.start + ELEMENT]
    }
}

impl BeamElement for Element {
    fn coordinates(&self) -> Range<usize> {
        self.start..self.start + ELEMENT
    }

    fn is_possible(&self) -> bool {
        self.stations.iter().all(Station::is_possible)
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn is_damped(&self) -> bool {
        self.properties.damping != 0.0
    }

    fn set_damping(&mut self, damping: f64, _tension_damping: f64) {
        self.properties.damping = damping;
    }

    fn axis_point(&self, xi: f64, q: &[f64]) -> Vec3 {
        let own = self.own(q);
        let shape = hermite::shape(xi, self.length);
        AXIS_PLACES.into_iter().zip(shape).map(|(place, weight)| vec3(own, place) * weight).sum()
    }

    fn axis_q(&self, xi: f64) -> ByCoordinates {
        let mut axis_q = ByCoordinates::zeros();
        for (place, weight) in AXIS_PLACES.into_iter().zip(hermite::shape(xi, self.length)) {
            axis_q.fixed_columns_mut::<3>(place).copy_from(&Mat3::from_diagonal_element(weight));
        }
        axis_q
    }

    fn add_weight(&self, gravity: &Vec3, factor: f64, forces: &mut [f64]) {
        for (place, weight) in AXIS_PLACES.into_iter().zip(self.weight(gravity)) {
            add_vec3(forces, self.start + place, &(weight * factor));
        }
    }

    fn add_mass(&self, factor: f64, block: &mut [f64]) {
        self.mass.add(factor, block);
    }

    fn add_mass_times(&self, factor: f64, vector: &[f64], product: &mut [f64]) {
        let own = self.own(vector);
        let scaled: [f64; ELEMENT] = std::array::from_fn(|index| factor * own[index]);
        self.mass.add_times(&scaled, self.own_mut(product));
    }

    fn mass_form(&self, vector: &[f64]) -> f64 {
        let own = self.own(vector);
        let mut product = [0.0; ELEMENT];
        self.mass.add_times(own, &mut product);
        own.iter().zip(&product).map(|(value, product)| value * product).sum()
    }

    fn weight_form(&self, gravity: &Vec3, q: &[f64]) -> f64 {
        let own = self.own(q);
        AXIS_PLACES.into_iter().zip(self.weight(gravity)).map(|(place, weight)| vec3(own, place).dot(&weight)).sum()
    }

    fn energy(&self, c: &BeamConfiguration) -> f64 {
        self.energy(self.own(c.q))
    }

    fn add_gradient(&self, c: &BeamConfiguration, passage: &Passage, forces: &mut [f64]) {
        match passage {
            Passage::Step(step) => self.add_force_over_step(c, step, forces),
            _ => self.add_gradient(self.own(c.q), None, self.own_mut(forces)),
        }
    }

    fn add_gradient_and_set_hessian(
        &self,
        c: &BeamConfiguration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        block.fill(0.0);
        let (here, forces) = (self.own(c.q), self.own_mut(forces));
        let Passage::Step(step) = passage else {
            return self.add_gradient_and_hessian(here, None, scale, forces, block);
        };
        self.add_gradient_and_hessian(here, Some(self.own(step.increment)), scale, forces, block);
        if self.properties.damping != 0.0 {
            let places = [self.own(step.start.q), here, self.own(step.end.q)];
            damping::add_force_and_tangent_over_step(self, places, step.duration, scale, forces, block);
        }
    }

    fn finish_step(
        &self,
        c: &BeamConfiguration,
        step: &TimeStep,
        forces: &mut [f64],
        _strain_rates: &mut [f64],
    ) -> [f64; 3] {
        self.add_force_over_step(c, step, forces);
        let mut viscous = [0.0; ELEMENT];
        if self.properties.damping != 0.0 {
            self.add_damping_over_step(c, step, &mut viscous);
        }
        let taken = viscous.iter().zip(self.own(step.increment)).map(|(force, change)| force * change).sum();
        [self.energy(self.own(step.end.q)), taken, 0.0]
    }

    fn add_damping(&self, c: &BeamConfiguration, velocity: &[f64], _strain_rates: Option<&[f64]>, forces: &mut [f64]) {
        damping::add_force(self, self.own(c.q), self.own(velocity), self.own_mut(forces));
    }

    fn add_damping_and_tangent(
        &self,
        c: &BeamConfiguration,
        velocity: &[f64],
        [by_q, by_v]: [f64; 2],
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        let q = self.own(c.q);
        damping::add_force_and_tangent(self, q, self.own(velocity), by_q, self.own_mut(forces), block);
        damping::add_force_v(self, q, by_v, block);
    }

    fn energy_and_viscous_power(&self, c: &BeamConfiguration, velocity: &[f64]) -> [f64; 2] {
        let (q, velocity, mut viscous) = (self.own(c.q), self.own(velocity), [0.0; ELEMENT]);
        if self.properties.damping != 0.0 {
            damping::add_force(self, q, velocity, &mut viscous);
        }
        [self.energy(q), viscous.iter().zip(velocity).map(|(force, velocity)| force * velocity).sum()]
    }

    fn balance(&self, c: &BeamConfiguration, instant: &Instant, inside: &ElementForces) -> Balance {
        self.balance_with(c, instant, inside)
    }

    fn load_points(&self) -> [(f64, f64); LOAD_POINTS] {
        // Three points, as of ANCF14: a constant load then acts as the weight does.
        [0, 1, 2].map(|g| (GAUSS_POINTS[g], GAUSS_WEIGHTS[g] * self.length))
    }

    fn line_force(&self, c: &BeamConfiguration, load: &LineLoad) -> ElementForces {
        let mut sum = MarkerVector::zeros();
        for (xi, share) in self.load_points() {
            let jacobian = self.section_jacobian(c, xi);
            let [force, moment] = load.on(share, &self.section_pose(c, xi).axes);
            sum += jacobian.place_q.tr_mul(&force) + jacobian.turn_q.tr_mul(&moment);
        }
        sum.into()
    }

    fn add_line_stiffness(&self, c: &BeamConfiguration, load: &LineLoad, factor: f64, block: &mut [f64]) {
        let mut sum = MarkerMatrix::zeros();
        for (xi, share) in self.load_points() {
            let [force, moment] = load.on(share, &self.section_pose(c, xi).axes);
            self.add_section_moment_stiffness(c, xi, &moment, &mut sum);
            if load.follows {
                let MarkerJacobian { place_q, turn_q } = self.section_jacobian(c, xi);
                let turned = |own: &Vec3| -own.cross_matrix() * turn_q;
                sum += place_q.tr_mul(&turned(&force)) + turn_q.tr_mul(&turned(&moment));
            }
        }
        block.iter_mut().zip(sum.as_slice()).for_each(|(target, value)| *target += factor * value);
    }

    fn section_pose(&self, c: &BeamConfiguration, xi: f64) -> Pose {
        Pose { place: self.axis_point(xi, c.q), axes: self.frame(c, xi).axes }
    }

    fn section_jacobian(&self, c: &BeamConfiguration, xi: f64) -> MarkerJacobian {
        let [y, z] = sources(xi);
        MarkerJacobian { place_q: self.axis_q(xi), turn_q: self.frame(c, xi).turn_q([&y, &z]) }
    }

    fn add_section_moment_stiffness(&self, c: &BeamConfiguration, xi: f64, moment: &Vec3, sum: &mut MarkerMatrix) {
        let [y, z] = sources(xi);
        self.frame(c, xi).add_moment_stiffness(moment, [&y, &z], sum);
    }

    fn section_shape(&self, c: &BeamConfiguration, xi: f64) -> SectionShape {
        section::shape(self, self.own(c.q), xi)
    }

    fn section_strains(&self, c: &BeamConfiguration, xi: f64, drawn: &SectionShape) -> SectionStrains {
        let now = section::shape(self, self.own(c.q), xi);
        let j0 = drawn.stretch;
        SectionStrains {
            axial: now.stretch / j0 - 1.0,
            curvature: [0, 1].map(|i| now.curvature[i] / j0 - drawn.curvature[i] / j0),
            torsion: now.torsion / j0 - drawn.torsion / j0,
        }
    }

    fn twist(&self, c: &BeamConfiguration, xi: f64) -> f64 {
        section::twist(self, self.own(c.q), xi)
    }

    fn distortion(&self, c: &BeamConfiguration) -> Option<&'static str> {
        let own = self.own(c.q);
        let [first, second] = [0, NODE].map(|node| SectionFrame::of_node(&own[node..]).axes);
        let [t_0, t_1] = [&first, &second].map(|axes| axes.column(0).into_owned());
        let is_far = |cosine: f64| cosine.is_nan() || 1.0 + cosine < SMALLEST_COSINE;
        if is_far(t_0.dot(&t_1)) {
            return Some("bent");
        }
        let carried = carry(&t_0, &t_1, &first.column(1).into_owned());
        is_far(carried.dot(&second.column(1))).then_some("twisted")
    }
}
