//! An element of a beam that is paid out or hauled in: its free length is a multiple of the one as drawn (MECHANICS
//! 3.11).
//!
//! All elements of the beam grow by the same factor, so that the material passes through the mesh: at the coordinate
//! `x` of the mesh with the speed `c = (lambda'/lambda)(X − x)`, where `X` is the end that is not at the winch. At a
//! given instant the element is an ANCF14 element of another free length.

use super::coordinates::{ELEMENT, SHAPE_PLACES};
use super::damping;
use super::element::{Element, Evaluation};
use super::over_step::{Added, EndStrains, STRAINS};
use super::payout::{Extent, Payout};
use super::strain::Strain;
use super::transport::Transport;
use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::math::vectors::vec3;
use crate::mechanics::beam::configuration::{BeamConfiguration, Passage, TimeStep};
use crate::mechanics::beam::element::BeamElement;
use crate::mechanics::beam::line_load::{ElementForces, LOAD_POINTS, LineLoad};
use crate::mechanics::beam::resultants::{SectionForces, SectionShape, SectionStrains};
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerJacobian, MarkerMatrix};
use crate::mechanics::geometry::pose::Pose;
use std::ops::Range;

/// The part of axial strains, at the free length of the middle of a step, that comes from its growth, 1.
#[derive(Clone, Copy, Debug)]
struct Growth {
    /// From the start to the end.
    change: [f64; 3],
    /// In the mean of both.
    mean: [f64; 3],
}

/// An ANCF14 element that is paid out.
#[derive(Clone, Debug, PartialEq)]
pub struct PaidOut {
    /// As drawn.
    drawn: Element,
    payout: Payout,
    transport: Transport,
}

impl PaidOut {
    /// The element `drawn`, which begins at `begin` m along its beam, paid out by `payout`. Its section is the same
    /// everywhere.
    pub fn new(mut drawn: Element, begin: f64, payout: Payout) -> Self {
        // A pretension is in the strains of its points already; without the box no copy asks for memory.
        drawn.prestress = None;
        let transport = Transport::new(drawn.inertia.line_density, drawn.length, payout.far_end - begin);
        Self { drawn, payout, transport }
    }

    /// As drawn.
    pub fn drawn(&self) -> &Element {
        &self.drawn
    }

    /// How long it is at `drives`.
    pub fn extent(&self, drives: &[Jet]) -> Extent {
        self.payout.extent(drives)
    }

    /// The element that this one is at `c`.
    fn at(&self, c: &BeamConfiguration) -> Element {
        self.paid_out_to(c.drives)
    }

    /// The element that this one is with the values `drives` of the drives.
    fn paid_out_to(&self, drives: &[Jet]) -> Element {
        let extent = self.extent(drives).ratio;
        let mut element = self.drawn.clone();
        for point in &mut element.axial {
            point.weight *= extent;
            point.reference_stretch *= extent;
            point.reference_square *= extent * extent;
            point.torsion_by_twist /= extent;
        }
        for point in &mut element.bending {
            point.weight *= extent;
            point.reference_stretch *= extent;
            point.torsion_by_twist /= extent;
        }
        // Curvature and torsion without load are those as drawn, per free length.
        element.reference_twist *= extent;
        element
    }

    /// The section that as drawn is `drawn` at the free length of `c`, without load.
    fn free(&self, c: &BeamConfiguration, drawn: &SectionShape) -> SectionShape {
        let extent = self.extent(c.drives).ratio;
        let SectionShape { stretch, curvature, torsion } = drawn;
        SectionShape {
            stretch: stretch * extent,
            curvature: curvature.map(|own| own * extent),
            torsion: torsion * extent,
        }
    }

    /// Adds `factor` times `matrix`, that of a line, times the coordinates `vector` to `sum`.
    fn add_line(&self, matrix: &[[f64; 4]; 4], factor: f64, vector: &[f64], sum: &mut [f64]) {
        let (own, sum) = (self.drawn.own(vector), &mut sum[self.coordinates()]);
        for (row, products) in SHAPE_PLACES.into_iter().zip(matrix) {
            for (column, product) in SHAPE_PLACES.into_iter().zip(products) {
                (0..3).for_each(|axis| sum[row + axis] += factor * product * own[column + axis]);
            }
        }
    }

    /// `leftᵀ matrix right` of the coordinates of a line.
    fn line_form(&self, left: &[f64], matrix: &[[f64; 4]; 4], right: &[f64]) -> f64 {
        let (left, right) = (self.drawn.own(left), self.drawn.own(right));
        let mut sum = 0.0;
        for (row, products) in SHAPE_PLACES.into_iter().zip(matrix) {
            for (column, product) in SHAPE_PLACES.into_iter().zip(products) {
                sum += product * (0..3).map(|axis| left[row + axis] * right[column + axis]).sum::<f64>();
            }
        }
        sum
    }

    /// Adds the inertia of what passes through the mesh, beyond that of the mesh's own acceleration; over a step less
    /// `lambda' M v`, which the momentum of the mesh changes by as its mass grows.
    pub fn add_transport(&self, c: &BeamConfiguration, passage: &Passage, forces: &mut [f64]) {
        let extent = self.extent(c.drives);
        let (velocity, scale) = match passage {
            Passage::Rest | Passage::Corrected(_) => return,
            Passage::Instant { velocity, .. } => (*velocity, 1.0),
            Passage::Step(step) => (step.increment, 1.0 / step.duration),
        };
        self.add_line(&self.transport.first, 2.0 * extent.ratio * extent.rate * scale, velocity, forces);
        self.add_line(&self.transport.by_q(&extent), 1.0, c.q, forces);
        if matches!(passage, Passage::Step(_)) {
            self.drawn.add_mass_times(-extent.ratio * extent.rate * scale, velocity, forces);
        }
    }

    /// Adds `scale` times the derivative of [`Self::add_transport`]; over a step twice that by the coordinates at its
    /// end.
    pub fn add_transport_tangent(&self, c: &BeamConfiguration, passage: &Passage, scale: f64, block: &mut [f64]) {
        let extent = self.extent(c.drives);
        let by_velocity = match passage {
            Passage::Rest | Passage::Corrected(_) => return,
            Passage::Instant { velocity_by_q, .. } => *velocity_by_q,
            Passage::Step(step) => 2.0 / step.duration,
        };
        let (by_q, gyroscopic) = (self.transport.by_q(&extent), 2.0 * extent.ratio * extent.rate * by_velocity);
        for (b, column) in SHAPE_PLACES.into_iter().enumerate() {
            for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
                let value = scale * (by_q[a][b] + gyroscopic * self.transport.first[a][b]);
                (0..3).for_each(|axis| block[(column + axis) * ELEMENT + row + axis] += value);
            }
        }
        if matches!(passage, Passage::Step(_)) {
            self.drawn.add_mass(-scale * extent.ratio * extent.rate * by_velocity, block);
        }
    }

    /// Kinetic energy that the velocity of the material has beyond that of the mesh, J.
    pub fn transport_energy(&self, c: &BeamConfiguration, velocity: &[f64]) -> f64 {
        let Extent { ratio, rate, .. } = self.extent(c.drives);
        let linear = self.line_form(velocity, &self.transport.first, c.q);
        let square = self.line_form(c.q, &self.transport.square, c.q);
        ratio * rate * (linear + 0.5 * rate * square)
    }

    /// Linear momentum (kg m/s) and angular momentum about the origin (kg m²/s) that the material has beyond those of
    /// the mesh.
    pub fn transport_momentum(&self, c: &BeamConfiguration) -> [Vec3; 2] {
        let (Extent { ratio, rate, .. }, own) = (self.extent(c.drives), self.drawn.own(c.q));
        let (mut linear, mut angular) = (Vec3::zeros(), Vec3::zeros());
        for (a, (row, products)) in SHAPE_PLACES.into_iter().zip(&self.transport.first).enumerate() {
            for (column, product) in SHAPE_PLACES.into_iter().zip(products) {
                let (place, moved) = (vec3(own, row), vec3(own, column) * (ratio * rate * product));
                angular += place.cross(&moved);
                // The shape functions of the places add up to 1.
                linear += if a % 2 == 0 { moved } else { Vec3::zeros() };
            }
        }
        [linear, angular]
    }

    /// The part of the axial strains over `step`, whose middle is `c`, that comes from the growth of the free length,
    /// at the free length of the middle. No material is strained by it.
    fn growth(&self, c: &BeamConfiguration, step: &TimeStep) -> Growth {
        let [before, now, after] = [step.start, c, step.end].map(|c| self.extent(c.drives).ratio);
        let power = self.power();
        let strain = |ratio: f64| (ratio.powi(power) - 1.0) / f64::from(power);
        let (ends, start) = ([before / now, after / now].map(strain), &step.starts[self.drawn.place.branch]);
        // Strains at the start are at the length of the middle.
        let to_start = (now / before).powi(power);
        let stretches = [0, 1, 2].map(|m| to_start * self.stretch_power(m, start.axial_strain(m)));
        Growth {
            change: stretches.map(|own| own * (ends[1] - ends[0])),
            mean: stretches.map(|own| own * 0.5 * (ends[0] + ends[1])),
        }
    }

    /// The power of the stretch that the axial strain is made of: `(stretch^power − 1)/power`, 1 or, for Green's
    /// strain, 2.
    fn power(&self) -> i32 {
        match self.drawn.stiffness.strain {
            Strain::Small => 1,
            Strain::Large | Strain::LargeTruncated => 2,
        }
    }

    /// The stretch of axial point `m`, where its strain is `strain`, to the power of [`Self::power`]: `−lambda'/lambda`
    /// times this is the rate of the strain at coordinates that stand still.
    fn stretch_power(&self, m: usize, strain: f64) -> f64 {
        1.0 + f64::from(self.power()) * (strain + self.drawn.axial[m].natural)
    }

    /// Rates of the strains of `evaluation`, at `c`, with the velocities `velocity` of the system, but for what the
    /// free length grows by.
    fn rates(&self, evaluation: &Evaluation, c: &BeamConfiguration, velocity: &[f64]) -> [f64; STRAINS] {
        let mut rates = evaluation.element.strain_rates(evaluation, self.drawn.own(velocity));
        for (m, strain) in evaluation.axial_strains().into_iter().enumerate() {
            rates[m] -= self.extent(c.drives).rate * self.stretch_power(m, strain);
        }
        rates
    }

    /// The element that this one is at `c`, where axial strains over a step are the means of those of the material at
    /// both ends.
    fn over(&self, c: &BeamConfiguration, passage: &Passage) -> Element {
        let mut element = self.at(c);
        if let Passage::Step(step) = passage {
            // The free length of the middle is not the mean of those of both ends: the difference is small for a
            // length, and large beside the strain of a stiff rope.
            for (point, mean) in element.axial.iter_mut().zip(self.growth(c, step).mean) {
                point.natural += mean;
            }
        }
        element
    }

    /// What `with` makes of `element`, which [`Self::over`] has given, as `passage` says. All strains of a step but the
    /// axial ones are those at the free length of its middle.
    fn passing<R>(
        &self,
        element: &Element,
        c: &BeamConfiguration,
        passage: &Passage,
        with: impl FnOnce(&Evaluation) -> R,
    ) -> R {
        let Passage::Step(step) = passage else { return with(&element.evaluation(c)) };
        let (mut end, Growth { change, mean }) = (element.evaluation(step.end), self.growth(c, step));
        // For the rates: those of the start have no mean taken off.
        end.take_off_axial([0, 1, 2].map(|m| change[m] - mean[m]));
        element.over_step(c, &EndStrains::new(&end), step, with)
    }

    /// Energy that the winch has given over a step whose middle is `c`, with its `added` resultants, J: the elastic
    /// energy that another free length has at the coordinates of both ends, less the work of inertia, of the added
    /// resultants and of the means of the strains against the growth. The energy of the weight and the change of
    /// [`Self::transport_energy`] are not in it.
    fn given(&self, c: &BeamConfiguration, step: &TimeStep, added: &Added) -> f64 {
        let middle = self.at(c);
        let elastic =
            (self.energy(step.end) - middle.energy(step.end)) + (middle.energy(step.start) - self.energy(step.start));
        let extent = self.extent(c.drives);
        let by_velocity = 2.0 * extent.ratio * extent.rate / step.duration;
        let worked = by_velocity * self.line_form(step.increment, &self.transport.first, step.increment)
            + self.line_form(step.increment, &self.transport.by_q(&extent), c.q);
        // Of the force of the growing mass, which the momentum has, half is in the kinetic energy of the mesh.
        let growing = 0.25 * by_velocity * self.drawn.mass_form(step.increment);
        let (Growth { change, mean }, rigidities) = (self.growth(c, step), middle.rigidities());
        let by_strain = |m: usize| {
            let whole = change[m] + step.duration * added.rates[m];
            rigidities[m] * mean[m] * whole - added.axial[m] * change[m]
        };
        elastic - worked + growing + [0, 1, 2].map(by_strain).iter().sum::<f64>()
    }

    /// Energy that the winch has given to the weight over a step, in the field `gravity` (m/s²), J; positions count
    /// from `origin`.
    pub fn lifted(&self, c: &BeamConfiguration, step: &TimeStep, (gravity, origin): (&Vec3, &Vec3)) -> f64 {
        let [before, now, after] = [step.start, c, step.end].map(|c| self.extent(c.drives).ratio);
        let at_origin = self.drawn.inertia.line_density * self.drawn.length * gravity.dot(origin);
        let form = |c: &BeamConfiguration| self.drawn.weight_form(gravity, c.q) + at_origin;
        (before - now) * form(step.start) + (now - after) * form(step.end)
    }
}

impl BeamElement for PaidOut {
    fn coordinates(&self) -> Range<usize> {
        self.drawn.coordinates()
    }

    fn length(&self) -> f64 {
        self.drawn.length
    }

    fn is_damped(&self) -> bool {
        self.drawn.is_damped()
    }

    fn set_damping(&mut self, damping: f64, tension_damping: f64) {
        self.drawn.set_damping(damping, tension_damping);
    }

    fn axis_point(&self, xi: f64, q: &[f64]) -> Vec3 {
        self.drawn.axis_point(xi, q)
    }

    fn axis_q(&self, xi: f64) -> ByCoordinates {
        self.drawn.axis_q(xi)
    }

    fn extent(&self, drives: &[Jet]) -> f64 {
        Self::extent(self, drives).ratio
    }

    fn add_weight(&self, gravity: &Vec3, factor: f64, forces: &mut [f64]) {
        self.drawn.add_weight(gravity, factor, forces);
    }

    fn add_mass(&self, factor: f64, block: &mut [f64]) {
        self.drawn.add_mass(factor, block);
    }

    fn add_mass_times(&self, factor: f64, vector: &[f64], product: &mut [f64]) {
        self.drawn.add_mass_times(factor, vector, product);
    }

    fn mass_form(&self, vector: &[f64]) -> f64 {
        self.drawn.mass_form(vector)
    }

    fn weight_form(&self, gravity: &Vec3, q: &[f64]) -> f64 {
        self.drawn.weight_form(gravity, q)
    }

    fn energy(&self, c: &BeamConfiguration) -> f64 {
        self.at(c).energy(c)
    }

    fn add_gradient(&self, c: &BeamConfiguration, passage: &Passage, forces: &mut [f64]) {
        let element = self.over(c, passage);
        element.add(&self.passing(&element, c, passage, |here| here.gradient()), forces);
        self.add_transport(c, passage, forces);
    }

    fn add_gradient_and_set_hessian(
        &self,
        c: &BeamConfiguration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        let element = self.over(c, passage);
        self.passing(&element, c, passage, |here| element.add_gradient_and_hessian_of(here, scale, forces, block));
        self.add_transport(c, passage, forces);
        self.add_transport_tangent(c, passage, scale, block);
    }

    fn finish_step(
        &self,
        c: &BeamConfiguration,
        step: &TimeStep,
        forces: &mut [f64],
        strain_rates: &mut [f64],
    ) -> [f64; 3] {
        let passage = Passage::Step(*step);
        let element = self.over(c, &passage);
        let [taken, given] = self.passing(&element, c, &passage, |middle| {
            element.add(&middle.gradient(), forces);
            *element.own_rates_mut(strain_rates) = middle.added.rates;
            [middle.added.taken(&element, step.duration), self.given(c, step, &middle.added)]
        });
        self.add_transport(c, &passage, forces);
        [self.energy(step.end), taken, given]
    }

    fn begin_step(
        &self,
        c: &BeamConfiguration,
        middle: &[Jet],
        velocity: &[f64],
        starts: &mut [EndStrains],
        strain_rates: Option<&mut [f64]>,
    ) {
        starts[self.drawn.place.branch] = self.paid_out_to(middle).end_strains(c);
        if let Some(all) = strain_rates {
            let element = self.at(c);
            *element.own_rates_mut(all) = self.rates(&element.evaluation(c), c, velocity);
        }
    }

    /// Those of changes, in which the free length stays what it is.
    fn set_strain_rates(&self, c: &BeamConfiguration, velocity: &[f64], strain_rates: &mut [f64]) {
        self.at(c).set_strain_rates(c, velocity, strain_rates);
    }

    fn add_damping(&self, c: &BeamConfiguration, velocity: &[f64], strain_rates: Option<&[f64]>, forces: &mut [f64]) {
        let element = self.at(c);
        let here = element.linear_evaluation(c);
        let rates = match strain_rates {
            Some(all) => *element.own_rates(all),
            None => self.rates(&here, c, velocity),
        };
        element.add(&damping::force_of_rates(&here, &rates), forces);
    }

    /// Not at the rates of what grows: `generalized_alpha`, which asks for this, does not support winches.
    fn add_damping_and_tangent(
        &self,
        c: &BeamConfiguration,
        velocity: &[f64],
        scales: [f64; 2],
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        self.at(c).add_damping_and_tangent(c, velocity, scales, forces, block);
    }

    /// Not of what grows, as [`Self::add_damping_and_tangent`].
    fn energy_and_viscous_power(&self, c: &BeamConfiguration, velocity: &[f64]) -> [f64; 2] {
        self.at(c).energy_and_viscous_power(c, velocity)
    }

    fn load_points(&self) -> [(f64, f64); LOAD_POINTS] {
        self.drawn.load_points()
    }

    /// Per length as drawn, as [`Self::load_points`] are.
    fn line_force(&self, c: &BeamConfiguration, load: &LineLoad) -> ElementForces {
        BeamElement::line_force(&self.drawn, c, load)
    }

    fn add_line_stiffness(&self, c: &BeamConfiguration, load: &LineLoad, factor: f64, block: &mut [f64]) {
        self.drawn.add_line_stiffness(c, load, factor, block);
    }

    fn section_pose(&self, c: &BeamConfiguration, xi: f64) -> Pose {
        self.drawn.section_pose(c, xi)
    }

    fn section_jacobian(&self, c: &BeamConfiguration, xi: f64) -> MarkerJacobian {
        self.drawn.section_jacobian(c, xi)
    }

    fn add_section_moment_stiffness(&self, c: &BeamConfiguration, xi: f64, moment: &Vec3, sum: &mut MarkerMatrix) {
        self.drawn.add_section_moment_stiffness(c, xi, moment, sum);
    }

    fn relaxed_turn(&self, c: &BeamConfiguration, xi: f64) -> f64 {
        self.at(c).relaxed_turn(c, xi)
    }

    fn relaxed_spin(&self, c: &BeamConfiguration, xi: f64, velocity: &[f64]) -> f64 {
        self.at(c).relaxed_spin(c, xi, velocity)
    }

    fn section_shape(&self, c: &BeamConfiguration, xi: f64) -> SectionShape {
        self.at(c).section_shape(c, xi)
    }

    fn section_strains(&self, c: &BeamConfiguration, xi: f64, drawn: &SectionShape) -> SectionStrains {
        self.at(c).section_strains(c, xi, &self.free(c, drawn))
    }

    fn section_forces(&self, c: &BeamConfiguration, xi: f64, drawn: &SectionShape) -> SectionForces {
        self.at(c).section_forces(c, xi, &self.free(c, drawn))
    }

    fn torsion_rigidity(&self, xi: f64) -> f64 {
        self.drawn.torsion_rigidity(xi)
    }

    fn twist(&self, c: &BeamConfiguration, xi: f64) -> f64 {
        self.at(c).twist(c, xi)
    }

    fn largest_torsion(&self, c: &BeamConfiguration) -> f64 {
        self.at(c).largest_torsion(c)
    }

    fn distortion(&self, c: &BeamConfiguration) -> Option<&'static str> {
        self.drawn.distortion(c)
    }
}
