//! What a system asks of an element: ANCF14 and ANCF24 answer alike, each in its own folder.

use super::ancf14::over_step::EndStrains;
use super::balance::{Balance, Instant};
use super::configuration::{BeamConfiguration, Passage, Purpose, TimeStep};
use super::line_load::{ElementForces, LOAD_POINTS, LineLoad};
use super::resultants::{SectionForces, SectionShape, SectionStrains};
use super::{ancf14, ancf24};
use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerJacobian, MarkerMatrix};
use crate::mechanics::geometry::pose::Pose;
use std::ops::{Deref, DerefMut, Range};

/// An element of a beam; it never changes but for its damping.
#[expect(
    clippy::large_enum_variant,
    reason = "elements of ANCF14 are read in order, the others keep their numbers elsewhere"
)]
#[derive(Clone, Debug, PartialEq)]
pub enum AnyElement {
    /// Center-line and twist.
    Ancf14(ancf14::element::Element),
    /// One of ANCF14 that is paid out. Its numbers are in a box, as those of ANCF24: they would make all elements
    /// larger.
    PaidOut(Box<ancf14::paid_out::PaidOut>),
    /// Center-line and gradients of the section.
    Ancf24(Box<ancf24::element::Element>),
}

/// What an element answers. Vectors of coordinates are those of the whole system, blocks are its own, column-major.
pub trait BeamElement {
    /// Its coordinates.
    fn coordinates(&self) -> Range<usize>;

    /// Whether its undeformed shape is one that its energy has a meaning for.
    fn is_possible(&self) -> bool {
        true
    }

    /// Undeformed length, m.
    fn length(&self) -> f64;

    /// Whether its material or its tension is damped.
    fn is_damped(&self) -> bool;

    /// Sets what multiplies the strain rate in the material's viscous stress, and what multiplies that of the axial
    /// strain more, s.
    fn set_damping(&mut self, damping: f64, tension_damping: f64);

    /// The place `xi` (0 to 1) of the axis, of what `q` interpolates: positions, or displacements, m.
    fn axis_point(&self, xi: f64, q: &[f64]) -> Vec3;

    /// Derivative of [`Self::axis_point`] with respect to its own coordinates.
    fn axis_q(&self, xi: f64) -> ByCoordinates;

    /// Free length with the values `drives` of the drives, over that as drawn: what mass and weight are multiplied
    /// with.
    fn extent(&self, _drives: &[Jet]) -> f64 {
        1.0
    }

    /// Adds `factor` times the weight as drawn in the field `gravity`, m/s².
    fn add_weight(&self, gravity: &Vec3, factor: f64, forces: &mut [f64]);

    /// Adds `factor` times the mass matrix as drawn.
    fn add_mass(&self, factor: f64, block: &mut [f64]);

    /// `vectorᵀ M vector`: twice the kinetic energy, J.
    fn mass_form(&self, vector: &[f64]) -> f64;

    /// Work of the weight in the field `gravity` (m/s²) at `q` against that at the origin, J.
    fn weight_form(&self, gravity: &Vec3, q: &[f64]) -> f64;

    /// Adds `factor` times the product of the mass matrix with `vector`.
    fn add_mass_times(&self, factor: f64, vector: &[f64], product: &mut [f64]);

    /// Strain energy, J.
    fn energy(&self, c: &BeamConfiguration) -> f64;

    /// Adds the gradient of the strain energy; over a step the force of MECHANICS 7.6, the material's damping included.
    fn add_gradient(&self, c: &BeamConfiguration, passage: &Passage, forces: &mut [f64]);

    /// [`Self::add_gradient`], and sets `block` to `scale` times the Hessian; over a step to twice the derivative by
    /// the coordinates at its end.
    fn add_gradient_and_set_hessian(
        &self,
        c: &BeamConfiguration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        block: &mut [f64],
    );

    /// Adds the force over a step to `forces` and sets `strain_rates`, those of the whole system, to the rates over it.
    /// Returns the elastic energy at the end of the step, what the material's damping has taken over it, and what heat
    /// or a winch has given, J.
    fn finish_step(
        &self,
        c: &BeamConfiguration,
        step: &TimeStep,
        forces: &mut [f64],
        strain_rates: &mut [f64],
    ) -> [f64; 3];

    /// Sets what a step from `c` with the velocities `velocity` starts with: its own of `starts`, and of
    /// `strain_rates`, those of the whole system, the rates there; none: they are known. `middle` has the values of the
    /// drives in the middle of the step.
    fn begin_step(
        &self,
        _c: &BeamConfiguration,
        _middle: &[Jet],
        _velocity: &[f64],
        _starts: &mut [EndStrains],
        _strain_rates: Option<&mut [f64]>,
    ) {
    }

    /// Sets its own of `strain_rates`, those of the whole system, to the rates at `c` with the velocities `velocity`.
    fn set_strain_rates(&self, _c: &BeamConfiguration, _velocity: &[f64], _strain_rates: &mut [f64]) {}

    /// Adds the viscous forces of the material at an instant, with the velocities `velocity`, or with the rates of
    /// strains of the whole system where they are given and the element has such.
    fn add_damping(&self, c: &BeamConfiguration, velocity: &[f64], strain_rates: Option<&[f64]>, forces: &mut [f64]);

    /// [`Self::add_damping`] with the velocities, and adds its derivatives with respect to the coordinates and to the
    /// velocities, times `scales`, to `block`.
    fn add_damping_and_tangent(
        &self,
        c: &BeamConfiguration,
        velocity: &[f64],
        scales: [f64; 2],
        forces: &mut [f64],
        block: &mut [f64],
    );

    /// [`Self::add_gradient_and_set_hessian`] and [`Self::add_damping_and_tangent`] at an instant with the velocities
    /// `velocity`, which change by `velocity_by_q` with the coordinates, 1/s, for Newton's iteration: the block need
    /// not be exact.
    fn add_damped_gradient_and_set_hessian(
        &self,
        c: &BeamConfiguration,
        (velocity, velocity_by_q): (&[f64], f64),
        scale: f64,
        forces: &mut [f64],
        block: &mut [f64],
    ) {
        let passage = Passage::Instant { velocity, velocity_by_q, strain_rates: None, purpose: Purpose::Iteration };
        self.add_gradient_and_set_hessian(c, &passage, scale, forces, block);
        self.add_damping_and_tangent(c, velocity, [scale, scale * velocity_by_q], forces, block);
    }

    /// Strain energy, J, and what the damping of the material takes with the velocities `velocity`, W.
    fn energy_and_viscous_power(&self, c: &BeamConfiguration, velocity: &[f64]) -> [f64; 2];

    /// The balance at `instant`; `inside` is the generalized force of all that acts between the nodes but for inertia
    /// and weight.
    fn balance(&self, c: &BeamConfiguration, instant: &Instant, inside: &ElementForces) -> Balance;

    /// Positions (0 to 1) with shares of the length as drawn (m) at which a load per length acts.
    fn load_points(&self) -> [(f64, f64); LOAD_POINTS];

    /// Generalized force of a load along the whole element, in its own coordinates.
    fn line_force(&self, c: &BeamConfiguration, load: &LineLoad) -> ElementForces;

    /// Adds `factor` times the derivative of [`Self::line_force`] with respect to its coordinates to `block`.
    fn add_line_stiffness(&self, c: &BeamConfiguration, load: &LineLoad, factor: f64, block: &mut [f64]);

    /// Place and axes of the section at `xi`, as loads and springs hold on to it.
    fn section_pose(&self, c: &BeamConfiguration, xi: f64) -> Pose;

    /// How [`Self::section_pose`] moves with the element's coordinates.
    fn section_jacobian(&self, c: &BeamConfiguration, xi: f64) -> MarkerJacobian;

    /// Adds `∂(turn_qᵀ m)/∂q` of [`Self::section_jacobian`] at a moment (N m) frozen in space to `sum`; a force has
    /// none, positions are linear in q.
    fn add_section_moment_stiffness(&self, c: &BeamConfiguration, xi: f64, moment: &Vec3, sum: &mut MarkerMatrix);

    /// Turn of the section about its tangent from [`Self::section_pose`] to what the strains make of it, rad, for
    /// outputs.
    fn relaxed_turn(&self, _c: &BeamConfiguration, _xi: f64) -> f64 {
        0.0
    }

    /// Rate of [`Self::relaxed_turn`] at the velocities of the coordinates, rad/s.
    fn relaxed_spin(&self, _c: &BeamConfiguration, _xi: f64, _velocity: &[f64]) -> f64 {
        0.0
    }

    /// Turn of the section about its tangent from [`Self::section_pose`] to what the torque makes of it, rad; `torque`
    /// is what sections of the element transmit by equilibrium, N m (MECHANICS 3.12).
    fn section_turn(&self, c: &BeamConfiguration, xi: f64, _torque: &dyn Fn(f64) -> f64) -> f64 {
        self.relaxed_turn(c, xi)
    }

    /// The section at `xi` with whatever strains it has.
    fn section_shape(&self, c: &BeamConfiguration, xi: f64) -> SectionShape;

    /// Strains of the section at `xi`, which as drawn is `drawn`.
    fn section_strains(&self, c: &BeamConfiguration, xi: f64, drawn: &SectionShape) -> SectionStrains;

    /// Strains of the section at `xi` whose elastic stress, with the viscous one of the strains `near[0]`, bears
    /// `forces`, near `near[1]`, those that its coordinates make; none: the element knows its stress from its
    /// coordinates only.
    fn strains_under(&self, _xi: f64, _forces: &SectionForces, _near: [&SectionStrains; 2]) -> Option<SectionStrains> {
        None
    }

    /// Strains at which a section of linear law at `xi` would bear `forces`: Young's modulus times the strains of its
    /// fibers is the stress of beam theory, `N/A + M z/I`, whatever the law of the beam. `near` as in
    /// [`Self::strains_under`], and none likewise.
    fn linear_strains_under(
        &self,
        _xi: f64,
        _forces: &SectionForces,
        _near: &SectionStrains,
    ) -> Option<SectionStrains> {
        None
    }

    /// Strains whose elastic forces would be the viscous ones of the section at `xi`, at `instant`.
    fn viscous_strains(&self, _c: &BeamConfiguration, _xi: f64, _instant: &Instant) -> SectionStrains {
        SectionStrains::default()
    }

    /// Material twist from its first node to `xi`, undeformed value taken off, rad.
    fn twist(&self, c: &BeamConfiguration, xi: f64) -> f64;

    /// Largest torsion that the energy is evaluated at, undeformed value taken off, rad/m; asked where the energy bears
    /// only so much.
    fn largest_torsion(&self, _c: &BeamConfiguration) -> f64 {
        0.0
    }

    /// How it is deformed beyond what its formulation can follow in a step, in a word, if it is (MECHANICS 2.6).
    fn distortion(&self, c: &BeamConfiguration) -> Option<&'static str>;
}

impl AnyElement {
    /// The element of ANCF14, as drawn; none of ANCF24.
    pub fn ancf14(&self) -> Option<&ancf14::element::Element> {
        match self {
            Self::Ancf14(element) => Some(element),
            Self::PaidOut(element) => Some(element.drawn()),
            Self::Ancf24(_) => None,
        }
    }

    /// The element, if it is paid out.
    pub fn paid_out(&self) -> Option<&ancf14::paid_out::PaidOut> {
        match self {
            Self::PaidOut(element) => Some(element),
            Self::Ancf14(_) | Self::Ancf24(_) => None,
        }
    }
}

impl Deref for AnyElement {
    type Target = dyn BeamElement;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Ancf14(element) => element,
            Self::PaidOut(element) => &**element,
            Self::Ancf24(element) => &**element,
        }
    }
}

impl DerefMut for AnyElement {
    fn deref_mut(&mut self) -> &mut Self::Target {
        match self {
            Self::Ancf14(element) => element,
            Self::PaidOut(element) => &mut **element,
            Self::Ancf24(element) => &mut **element,
        }
    }
}
