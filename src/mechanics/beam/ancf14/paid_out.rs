//! An element of a beam that is paid out or hauled in: its free length is a multiple of the one as drawn (MECHANICS
//! 3.11).
//!
//! All elements of the beam grow by the same factor, so that the material passes through the mesh: at the coordinate
//! `x` of the mesh with the speed `c = (lambda'/lambda)(X − x)`, where `X` is the end that is not at the winch. At a
//! given instant the element is an ANCF14 element of another free length.

use super::balance::Passing;
use super::coordinates::{ELEMENT, ElementVector};
use super::damping;
use super::element::{Element, Evaluation};
use super::over_step::{Added, EndStrains, STRAINS};
use super::payout::{Extent, Payout};
use super::section;
use super::strain::Strain;
use super::transport::Transport;
use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::mechanics::beam::balance::{Balance, Instant};
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
    pub(super) drawn: Element,
    payout: Payout,
    pub(super) transport: Transport,
    /// Distance of its start from the end that is not at the winch, m as drawn.
    pub(super) distance: f64,
}

impl PaidOut {
    /// The element `drawn`, which begins at `begin` m along its beam, paid out by `payout`. Its section is the same
    /// everywhere.
    pub fn new(mut drawn: Element, begin: f64, payout: Payout) -> Self {
        // A pretension is in the strains of its points already; without the box no copy asks for memory.
        drawn.prestress = None;
        let distance = payout.far_end - begin;
        let transport = Transport::new(drawn.inertia.line_density, drawn.length, distance);
        Self { drawn, payout, transport, distance }
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

    /// Viscous force of the material with the rates `all` of strains of the system, or with the velocities `velocity`.
    fn viscous_force(&self, c: &BeamConfiguration, velocity: &[f64], all: Option<&[f64]>) -> ElementVector {
        let element = self.at(c);
        let here = element.linear_evaluation(c);
        damping::force_of_rates(&here, &self.known_rates(&here, c, velocity, all))
    }

    /// Its own of the rates `all` of strains of the system, or those with the velocities `velocity`.
    fn known_rates(
        &self,
        here: &Evaluation,
        c: &BeamConfiguration,
        velocity: &[f64],
        all: Option<&[f64]>,
    ) -> [f64; STRAINS] {
        match all {
            Some(all) => *here.element.own_rates(all),
            None => self.rates(here, c, velocity),
        }
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
        self.drawn.add(&self.viscous_force(c, velocity, strain_rates), forces);
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

    fn balance(&self, c: &BeamConfiguration, instant: &Instant, inside: &ElementForces) -> Balance {
        let mut acting = -ElementVector::from_column_slice(&inside[..ELEMENT]);
        let mut extent = self.extent(c.drives);
        if instant.moves {
            acting += self.passing_inertia(c, instant.velocity, 1.0);
        } else {
            extent = Extent { ratio: extent.ratio, ..Extent::default() };
        }
        if self.is_damped() {
            acting += self.viscous_force(c, instant.velocity, instant.strain_rates);
        }
        let passing = Passing { extent, distance: self.distance };
        self.at(c).balance_of(c, instant, acting, Some(&passing))
    }

    fn load_points(&self) -> [(f64, f64); LOAD_POINTS] {
        self.drawn.load_points()
    }

    fn line_force(&self, c: &BeamConfiguration, load: &LineLoad) -> ElementForces {
        let ratio = self.extent(c.drives).ratio;
        BeamElement::line_force(&self.drawn, c, load).map(|own| ratio * own)
    }

    fn add_line_stiffness(&self, c: &BeamConfiguration, load: &LineLoad, factor: f64, block: &mut [f64]) {
        self.drawn.add_line_stiffness(c, load, factor * self.extent(c.drives).ratio, block);
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

    fn section_turn(&self, c: &BeamConfiguration, xi: f64, torque: &dyn Fn(f64) -> f64) -> f64 {
        let (element, extent) = (self.at(c), self.extent(c.drives).ratio);
        // The length on which the torque turns sections is the free one.
        element.section_turn(c, xi, &|xi| extent * torque(xi))
    }

    fn strains_under(&self, xi: f64, forces: &SectionForces, near: [&SectionStrains; 2]) -> Option<SectionStrains> {
        self.drawn.strains_under(xi, forces, near)
    }

    fn linear_strains_under(&self, xi: f64, forces: &SectionForces, near: &SectionStrains) -> Option<SectionStrains> {
        self.drawn.linear_strains_under(xi, forces, near)
    }

    fn viscous_strains(&self, c: &BeamConfiguration, xi: f64, instant: &Instant) -> SectionStrains {
        let element = self.at(c);
        let rates = self.known_rates(&element.linear_evaluation(c), c, instant.velocity, instant.strain_rates);
        section::viscous(&element, xi, &rates)
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
