//! The mass matrix of a system. It is constant but for what winches pay out and for the part of the rotary inertia that
//! follows the sections (MECHANICS 3.3b), which has velocity terms of its own.

use super::System;
use super::fluids::FluidAt;
use super::frame_cache::FrameCache;
use super::tangent_layout::TangentLayout;
use crate::math::blocks::Blocks;
use crate::math::jet::Jet;
use crate::mechanics::beam::ancf14::element::Element;
use crate::mechanics::beam::ancf14::frame::NodeFrame;
use crate::mechanics::beam::ancf14::rotary_inertia::RotaryInertia;
use crate::mechanics::beam::element::{AnyElement, BeamElement};
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::state::State;

/// The values that the mass matrix depends on.
#[derive(Clone, Copy, Debug)]
pub struct MassAt<'a> {
    /// Values of the drives, for winches; none: as drawn.
    pub drives: &'a [Jet],
    /// Frames of the nodes, for rotary inertia; none: the constant part of the matrix alone.
    pub frames: &'a [NodeFrame],
    /// Where beams are in the fluid that moves with them; none: without it.
    pub fluids: Option<FluidAt<'a>>,
}

impl<'a> MassAt<'a> {
    /// The constant part, with winches as drawn.
    pub const CONSTANT: MassAt<'static> = MassAt { drives: &[], frames: &[], fluids: None };

    /// The mass matrix at the frames of `cache`.
    pub fn new(drives: &'a [Jet], cache: &'a FrameCache) -> Self {
        Self { drives, frames: &cache.frames, fluids: None }
    }

    /// The same with the added mass of beams in water at the coordinates `q` and `time`, s.
    #[must_use]
    pub fn wet(self, q: &'a [f64], time: f64) -> Self {
        Self { fluids: Some(FluidAt { q, time, seen: &[] }), ..self }
    }

    /// The same in the middle of a step that looks at the water once, as `excitation` has it.
    #[must_use]
    pub fn wet_in(self, q: &'a [f64], excitation: &'a Excitation) -> Self {
        Self { fluids: Some(FluidAt { q, time: excitation.time, seen: &excitation.seen }), ..self }
    }
}

impl<'a> From<&Configuration<'a>> for MassAt<'a> {
    fn from(c: &Configuration<'a>) -> Self {
        Self { drives: c.beams.drives, frames: c.beams.frames, fluids: None }
    }
}

/// An element with rotary inertia that follows its sections, at the frames of its nodes.
#[derive(Clone, Copy)]
struct Following<'a> {
    element: &'a Element,
    rotary: &'a RotaryInertia,
    frames: [&'a NodeFrame; 2],
}

impl<'a> Following<'a> {
    fn new(element: &'a AnyElement, frames: &'a [NodeFrame]) -> Option<Self> {
        let AnyElement::Ancf14(element) = element else { return None };
        let (rotary, [first, second]) = (element.inertia.rotary.as_deref()?, element.frame_numbers());
        Some(Self { element, rotary, frames: [frames.get(first)?, frames.get(second)?] })
    }

    /// Its own numbers of those of the system.
    fn own_mut<'l>(&self, list: &'l mut [f64]) -> &'l mut [f64] {
        &mut list[self.element.coordinates()]
    }
}

/// The rotary inertia of an element that follows its sections; what a winch pays out has none.
fn following_part(element: &AnyElement) -> Option<&RotaryInertia> {
    if let AnyElement::Ancf14(own) = element { own.inertia.rotary.as_deref() } else { None }
}

impl System {
    /// Whether the mass matrix depends on the coordinates: sections whose rotary inertia is not the same about all axes
    /// across the tangent.
    pub fn has_following_inertia(&self) -> bool {
        self.mesh.elements.iter().any(|element| following_part(element).is_some())
    }

    fn following<'a>(&'a self, frames: &'a [NodeFrame]) -> impl Iterator<Item = (usize, Following<'a>)> {
        let elements = self.mesh.elements.iter().enumerate();
        elements.filter_map(|(number, element)| Some((number, Following::new(element, frames)?)))
    }

    /// The frames that the mass matrix depends on, by their numbers.
    pub fn mass_frames(&self) -> Vec<usize> {
        let mut frames: Vec<usize> = Vec::new();
        for element in &self.mesh.elements {
            if let AnyElement::Ancf14(own) = element
                && following_part(element).is_some()
            {
                frames.extend(own.frame_numbers());
            }
        }
        frames.dedup();
        frames
    }

    /// Adds a constant mass matrix that is at least as large as that of any state: the rotary inertia that follows
    /// sections along one axis acts along all of them.
    pub fn add_mass_bound(&self, tangent: &mut Blocks) {
        self.add_mass(MassAt::CONSTANT, 1.0, tangent);
        let layout = TangentLayout::of(self);
        for (number, element) in self.mesh.elements.iter().enumerate() {
            if let Some(rotary) = following_part(element) {
                rotary.add_everywhere(tangent.block_mut(layout.element(number)));
            }
        }
    }

    /// `product = (N − M) vector` with the bound `N` of [`Self::add_mass_bound`].
    pub fn mass_below_bound_times(&self, at: MassAt, vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for (_, own) in self.following(at.frames) {
            own.rotary.add_lacking_times(own.frames, own.element.own(vector), own.own_mut(product));
        }
    }

    /// Adds `factor` times the mass matrix to the blocks of elements and bodies in `tangent`.
    pub fn add_mass(&self, at: MassAt, factor: f64, tangent: &mut Blocks) {
        let layout = TangentLayout::of(self);
        for number in 0..self.mesh.elements.len() {
            self.add_element_mass(number, at, factor, tangent.block_mut(layout.element(number)));
        }
        for (number, body) in self.bodies.iter().enumerate() {
            let block = tangent.block_mut(layout.body(number));
            for local in 0..BODY {
                block[local * BODY + local] += factor * body.inertia(local);
            }
        }
        if let Some(fluids) = at.fluids {
            self.add_added_mass(fluids, factor, tangent);
        }
    }

    /// `product = M vector`, with the mass matrix of [`Self::add_mass`].
    pub fn mass_times(&self, at: MassAt, vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for number in 0..self.mesh.elements.len() {
            self.add_element_mass_times(number, at, 1.0, vector, product);
        }
        for body in &self.bodies {
            for local in 0..BODY {
                product[body.start + local] = body.inertia(local) * vector[body.start + local];
            }
        }
        if let Some(fluids) = at.fluids {
            self.add_added_mass_times(fluids, vector, product);
        }
    }

    /// Adds `factor` times the mass matrix of the element with this number to its own `block`.
    #[inline]
    pub(super) fn add_element_mass(&self, number: usize, at: MassAt, factor: f64, block: &mut [f64]) {
        let element = &self.mesh.elements[number];
        element.add_mass(factor * element.extent(at.drives), block);
        if let Some(own) = Following::new(element, at.frames) {
            own.rotary.add(own.frames, factor, block);
        }
    }

    /// Adds `factor` times the product of the mass matrix of the element with this number with `vector`.
    #[inline]
    pub(super) fn add_element_mass_times(
        &self,
        number: usize,
        at: MassAt,
        factor: f64,
        vector: &[f64],
        product: &mut [f64],
    ) {
        let element = &self.mesh.elements[number];
        element.add_mass_times(factor * element.extent(at.drives), vector, product);
        if let Some(own) = Following::new(element, at.frames) {
            own.rotary.add_times(own.frames, factor, own.element.own(vector), own.own_mut(product));
        }
    }

    /// `vectorᵀ M vector` of the element with this number, with the mass as drawn of what is paid out.
    pub fn element_mass_form(&self, number: usize, frames: &[NodeFrame], vector: &[f64]) -> f64 {
        let element = &self.mesh.elements[number];
        let form = element.mass_form(vector);
        Following::new(element, frames).map_or(form, |own| form + own.rotary.form(own.frames, own.element.own(vector)))
    }

    /// Sets the momentum of `state` to that of its velocities, `M v`.
    pub fn set_momentum(&self, state: &mut State) {
        let mut cache = FrameCache::default();
        if self.has_following_inertia() {
            cache.set(self, &state.q, &state.triads);
        }
        let lists = &mut state.lists;
        self.mass_times(MassAt::new(&state.prescribed.drives, &cache), &lists.velocity, &mut lists.momentum);
    }

    /// Adds the velocity terms of the rotary inertia to the left-hand side of the equations: `−∂T/∂q`, and at an
    /// instant `dM/dt v`, which a step has in its momentum.
    pub(super) fn add_rotary_forces(&self, c: &Configuration, passage: &Passage, forces: &mut [f64]) {
        for (_, own) in self.following(c.beams.frames) {
            match passage {
                Passage::Rest | Passage::Corrected(_) => {}
                Passage::Instant { velocity, .. } => {
                    let velocity = own.element.own(velocity);
                    own.element.add(&own.rotary.rate_times(own.frames, velocity), forces);
                    own.rotary.add_gradient(own.frames, -1.0, velocity, own.own_mut(forces));
                }
                Passage::Step(step) => {
                    let (factor, increment) = (-1.0 / (step.duration * step.duration), own.element.own(step.increment));
                    own.rotary.add_gradient(own.frames, factor, increment, own.own_mut(forces));
                }
            }
        }
    }

    /// Adds `scale` times the gyroscopic part of the derivative of [`Self::add_rotary_forces`] and of the momentum;
    /// over a step twice that with respect to the coordinates at its end. What is left out is small for Newton.
    pub(super) fn add_rotary_tangent(&self, c: &Configuration, passage: &Passage, scale: f64, tangent: &mut Blocks) {
        let (vector, factor) = match passage {
            Passage::Rest | Passage::Corrected(_) => return,
            Passage::Instant { velocity, velocity_by_q, .. } => (*velocity, scale * velocity_by_q),
            Passage::Step(step) => (step.increment, 2.0 * scale / (step.duration * step.duration)),
        };
        let layout = TangentLayout::of(self);
        for (number, own) in self.following(c.beams.frames) {
            let block = tangent.block_mut(layout.element(number));
            own.rotary.add_gyroscopic(own.frames, own.element.own(vector), factor, block);
        }
    }

    /// Sets `forces` to the velocity terms of the rotary inertia at an instant.
    pub fn rotary_forces(&self, c: &Configuration, velocity: &[f64], forces: &mut [f64]) {
        forces.fill(0.0);
        self.add_rotary_forces(c, &Passage::with_velocity(velocity), forces);
    }

    /// Sets `forces` to what depends on the coordinates through the masses alone: `M a`, the velocity terms of the
    /// rotary inertia at an instant, and damping in proportion to mass.
    pub fn inertia_forces(&self, c: &Configuration, velocity: &[f64], acceleration: &[f64], forces: &mut [f64]) {
        let passage = Passage::with_velocity(velocity);
        self.mass_times(MassAt::from(c), acceleration, forces);
        self.add_rotary_forces(c, &passage, forces);
        self.add_mass_damping(c, &passage, forces);
    }
}
