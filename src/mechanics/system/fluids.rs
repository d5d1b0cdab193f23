//! Fluids in the equations of a system (MECHANICS 11): its forces, and the mass that moves with beams.

use super::System;
use super::tangent_layout::TangentLayout;
use crate::math::Vec3;
use crate::math::blocks::Blocks;
use crate::math::vectors::{add_vec3, vec3};
use crate::mechanics::beam::ancf14::coordinates::ELEMENT;
use crate::mechanics::beam::ancf14::element::Element;
use crate::mechanics::beam::ancf14::fluid_load::{ByCoordinates, Moving, Surroundings};
use crate::mechanics::beam::element::{AnyElement, BeamElement};
use crate::mechanics::fluid::flow::Seen;
use crate::mechanics::fluid::medium::{Medium, Side};
use crate::mechanics::fluid::{Fluid, Wetted};
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::{Configuration, Passage};

/// Where beams are in fluids: what the added mass depends on.
#[derive(Clone, Copy, Debug)]
pub struct FluidAt<'a> {
    /// All coordinates.
    pub q: &'a [f64],
    /// Time, s.
    pub time: f64,
    /// As of [`Excitation::seen`].
    pub seen: &'a [[Seen; 4]],
}

impl<'a> FluidAt<'a> {
    fn surroundings(self, own: &InFluid<'a>) -> Surroundings<'a> {
        let (medium, sections, seen) = (own.medium, &own.wetted.sections, own.seen_in(self.seen));
        Surroundings { medium, sections, gravity: Vec3::zeros(), time: self.time, share: 1.0, seen, is_still: false }
    }
}

/// An element in a fluid.
struct InFluid<'a> {
    medium: &'a Medium,
    wetted: &'a Wetted,
    element: &'a Element,
    /// Its number among those in this fluid.
    number: usize,
}

impl<'a> InFluid<'a> {
    /// As it is seen once a step, of all elements in water with waves; none: it is looked at where the force is taken.
    fn seen_in(&self, seen: &'a [[Seen; 4]]) -> Option<&'a [Seen; 4]> {
        if self.medium.has_waves() { seen.get(self.number) } else { None }
    }

    /// Its surroundings as the system passes through; in equilibria there are no waves.
    fn passed(&self, excitation: &'a Excitation, passage: &Passage) -> Surroundings<'a> {
        let is_still = matches!(passage, Passage::Rest | Passage::Corrected(_));
        Surroundings { is_still, ..self.surroundings(excitation) }
    }

    fn surroundings(&self, excitation: &'a Excitation) -> Surroundings<'a> {
        let Excitation { gravity, time, drag: share, .. } = *excitation;
        let (medium, sections, seen) = (self.medium, &self.wetted.sections, self.seen_in(&excitation.seen));
        Surroundings { medium, sections, gravity, time, share, seen, is_still: false }
    }
}

impl System {
    /// The water, if the file has any.
    pub fn water(&self) -> Option<&Fluid> {
        self.fluids.iter().find(|fluid| fluid.medium.side == Side::Below)
    }

    /// The elements in fluids.
    fn wetted(&self) -> impl Iterator<Item = InFluid<'_>> {
        self.fluids.iter().flat_map(move |fluid| {
            fluid.wetted.iter().enumerate().filter_map(move |(number, wetted)| {
                let AnyElement::Ancf14(element) = &self.mesh.elements[wetted.element] else { return None };
                Some(InFluid { medium: &fluid.medium, wetted, element, number })
            })
        })
    }

    /// The elements that a fluid moves with.
    fn with_added_mass(&self) -> impl Iterator<Item = InFluid<'_>> {
        self.wetted().filter(|own| own.wetted.sections.has_added_mass())
    }

    /// Looks at the water once for a step, where it has waves: at `time`, s, and the coordinates `q`.
    pub fn look_at_waves(&self, q: &[f64], time: f64, excitation: &mut Excitation) {
        excitation.seen.clear();
        for InFluid { medium, element, .. } in self.wetted().filter(|own| own.medium.has_waves()) {
            let mut seen = [Seen::default(); 4];
            element.look(medium, q, time, &mut seen);
            excitation.seen.push(seen);
        }
    }

    /// Whether water with waves acts on it.
    pub fn has_waves(&self) -> bool {
        self.fluids.iter().any(|fluid| fluid.medium.has_waves())
    }

    /// Adds `factor` times the forces of fluids, internal minus external, as `passage` says.
    pub fn add_fluid(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        factor: f64,
        forces: &mut [f64],
    ) {
        if self.fluids.is_empty() {
            return;
        }
        let of_beams = passage.of_beams();
        for own in self.wetted() {
            let element = own.element;
            let moving = Moving::new(element, &c.beams, &of_beams);
            element.add_fluid(&own.passed(excitation, passage), &moving, -factor, &mut forces[element.coordinates()]);
        }
        self.each_wet_body(c, passage, excitation, |own, found| {
            add_vec3(forces, own.start, &(found.force * -factor));
        });
    }

    /// Adds `factor` times the forces of fluids, internal minus external, on beams with these coordinates,
    /// velocities and accelerations.
    pub fn add_fluid_at(
        &self,
        (q, velocity, acceleration): (&[f64], &[f64], &[f64]),
        excitation: &Excitation,
        factor: f64,
        forces: &mut [f64],
    ) {
        self.add_fluid_on_bodies_at((q, velocity, acceleration), excitation, factor, forces);
        for own in self.wetted() {
            let element = own.element;
            let moving = Moving::with(element, q, velocity, acceleration);
            element.add_fluid(&own.surroundings(excitation), &moving, -factor, &mut forces[element.coordinates()]);
        }
    }

    /// [`Self::add_fluid`] over a step, with the work of fluids as the coordinates change by `increment`, J.
    pub(super) fn add_fluid_with_work(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        increment: &[f64],
        forces: &mut [f64],
    ) -> f64 {
        let (of_beams, mut work) = (passage.of_beams(), 0.0);
        for own in self.wetted() {
            let element = own.element;
            let moving = Moving::new(element, &c.beams, &of_beams);
            let mut force = [0.0; ELEMENT];
            element.add_fluid(&own.surroundings(excitation), &moving, 1.0, &mut force);
            for ((sum, force), change) in
                forces[element.coordinates()].iter_mut().zip(force).zip(element.own(increment))
            {
                *sum -= force;
                work += force * change;
            }
        }
        self.each_wet_body(c, passage, excitation, |own, found| {
            add_vec3(forces, own.start, &-found.force);
            work += found.force.dot(&vec3(increment, own.start));
        });
        work
    }

    /// [`Self::add_fluid`], and adds `scale` times its derivative with respect to the coordinates to the blocks of
    /// elements in `tangent`; over a step twice that with respect to the coordinates at its end.
    #[inline(never)]
    pub(super) fn add_fluid_and_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        if self.fluids.is_empty() {
            return;
        }
        let (layout, of_beams) = (TangentLayout::of(self), passage.of_beams());
        let by = ByCoordinates::of(&of_beams);
        for own in self.wetted() {
            let element = own.element;
            let moving = Moving::new(element, &c.beams, &of_beams);
            let block = tangent.block_mut(layout.element(own.wetted.element));
            let surroundings = own.passed(excitation, passage);
            let forces = &mut forces[element.coordinates()];
            element.add_fluid_and_tangent(&surroundings, (&moving, by), [-1.0, -scale], forces, block);
        }
        self.add_fluid_on_bodies_and_tangent(c, passage, excitation, scale, forces, tangent);
    }

    /// Adds `factor` times the derivative of the forces of fluids with respect to the velocities to the blocks of
    /// elements in `tangent`.
    pub(super) fn add_fluid_damping(
        &self,
        c: &Configuration,
        velocity: &[f64],
        excitation: &Excitation,
        factor: f64,
        tangent: &mut Blocks,
    ) {
        let (layout, passage) = (TangentLayout::of(self), Passage::with_velocity(velocity).of_beams());
        for own in self.wetted() {
            let element = own.element;
            let moving = Moving::new(element, &c.beams, &passage);
            let block = tangent.block_mut(layout.element(own.wetted.element));
            element.add_fluid_damping(&own.surroundings(excitation), &moving, -factor, block);
        }
        self.add_fluid_damping_of_bodies(c, velocity, excitation, factor, tangent);
    }

    /// Adds `factor` times the added mass matrix to the blocks of elements in `tangent`.
    pub(super) fn add_added_mass(&self, at: FluidAt, factor: f64, tangent: &mut Blocks) {
        let layout = TangentLayout::of(self);
        for own in self.with_added_mass() {
            let (element, moving) = (own.element, Moving::at_rest(own.element, at.q));
            let block = tangent.block_mut(layout.element(own.wetted.element));
            element.add_added_mass(&at.surroundings(&own), &moving, factor, block);
        }
        self.add_added_mass_of_bodies(at, factor, tangent);
    }

    /// Adds the product of the added mass matrix with `vector` to `product`; returns `vectorᵀ M_a vector`.
    pub fn add_added_mass_times(&self, at: FluidAt, vector: &[f64], product: &mut [f64]) -> f64 {
        let mut form = 0.0;
        for own in self.with_added_mass() {
            let element = own.element;
            let moving = Moving::at_rest(element, at.q);
            let product = &mut product[element.coordinates()];
            form += element.add_added_mass_times(&at.surroundings(&own), &moving, vector, product);
        }
        form + self.add_added_mass_of_bodies_times(at, vector, product)
    }

    /// Whether water or air acts on it.
    pub fn is_in_fluid(&self) -> bool {
        !self.fluids.is_empty()
    }

    /// Calls `with` with the element of this number in each fluid that may reach it at `q`, as it moves with these
    /// velocities and accelerations, or at rest.
    pub fn in_fluids(
        &self,
        element: usize,
        (q, motion): (&[f64], Option<[&[f64]; 2]>),
        excitation: &Excitation,
        mut with: impl FnMut(&Element, &Surroundings, &Moving),
    ) {
        let AnyElement::Ancf14(own) = &self.mesh.elements[element] else { return };
        let moving = match motion {
            Some([velocity, acceleration]) => Moving::with(own, q, velocity, acceleration),
            None => Moving::at_rest(own, q),
        };
        let &Excitation { gravity, time, drag: share, .. } = excitation;
        let is_still = motion.is_none();
        for fluid in &self.fluids {
            let Some(wetted) = fluid.of(element) else { continue };
            let (medium, sections) = (&fluid.medium, &wetted.sections);
            let around = Surroundings { medium, sections, gravity, time, share, seen: None, is_still };
            with(own, &around, &moving);
        }
    }

    /// Velocity of the water or the air at `position`, of the state, and `time`, s, in m/s; 0 where there is neither.
    pub fn flow_at(&self, position: &Vec3, time: f64) -> Vec3 {
        let is_there = |medium: &Medium| medium.side == Side::Above || position.z <= medium.height(position, time);
        let mut media = self.fluids.iter().map(|fluid| &fluid.medium);
        media.find(|medium| is_there(medium)).map_or_else(Vec3::zeros, |medium| medium.flow(position, time).velocity)
    }

    /// Drag per length, N/m, on the section at this position of this element at `c`, with the velocities `velocity`
    /// and at `time`, s; 0 where no fluid reaches it.
    pub fn drag_at(&self, (element, xi): (usize, f64), c: &Configuration, velocity: &[f64], time: f64) -> Vec3 {
        let (moving, mut sum) = ((c.beams.q, Some([velocity, velocity])), Vec3::zeros());
        let alone = fluids_alone(self.gravity, time);
        self.in_fluids(element, moving, &alone, |own, fluid, moving| sum += own.drag_at(fluid, moving, xi));
        sum
    }
}

impl System {
    /// Force of the pressure of the still water on the section at this position of this element at `c`, N: the part of
    /// the effective tension that the wall does not carry. 0 above the water.
    pub fn outer_pressure(&self, (element, xi): (usize, f64), position: &Vec3) -> f64 {
        let Some(water) = self.water() else { return 0.0 };
        let Some(wetted) = water.of(element) else { return 0.0 };
        let depth = water.medium.surface - self.origin.z - position.z;
        wetted.sections.at(xi).displaced * self.gravity.norm() * depth.max(0.0)
    }
}

/// The fluids that act at an instant, without loads.
pub fn fluids_alone(gravity: Vec3, time: f64) -> Excitation {
    Excitation { time, gravity, drag: 1.0, ..Excitation::default() }
}
