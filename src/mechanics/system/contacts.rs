//! Contact of beams with surfaces in a system: forces, tangent, energy, what steps may not do.

use super::System;
use super::tangent_layout::TangentLayout;
use crate::error::{Error, Inside};
use crate::math::blocks::Blocks;
use crate::math::vectors::add_vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::ancf14::coordinates::{ELEMENT, SHAPE_PLACES};
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::contact::Contact;
use crate::mechanics::contact::grip::{Cells, Grip, Pressing, REMEMBERED};
use crate::mechanics::contact::touch::Touch;
use crate::mechanics::geometry::pose::axis_place;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};
use crate::mechanics::state::State;
use nalgebra::SMatrix;

/// The tangent of an element that touches a body.
struct BodyTangent {
    element: [f64; ELEMENT * ELEMENT],
    by_body: [f64; ELEMENT * BODY],
    by_element: [f64; ELEMENT * BODY],
    body: [f64; BODY * BODY],
}

impl Default for BodyTangent {
    fn default() -> Self {
        Self {
            element: [0.0; ELEMENT * ELEMENT],
            by_body: [0.0; ELEMENT * BODY],
            by_element: [0.0; ELEMENT * BODY],
            body: [0.0; BODY * BODY],
        }
    }
}

/// Energies of contact over a step, J.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ContactEnergy {
    /// Elastic energy at the end.
    pub elastic: f64,
    /// Energy that moving frames give.
    pub by_frames: f64,
    /// Energy that damping and friction take.
    pub dissipated: f64,
}

impl System {
    /// Whether beams may touch surfaces or each other.
    pub fn has_contacts(&self) -> bool {
        !self.contacts.is_empty() || !self.beam_contacts.is_empty()
    }

    /// Contacts with the elements that may touch, by their numbers.
    fn contact_elements(&self) -> impl Iterator<Item = (&Contact, usize, &AnyElement)> + '_ {
        self.contacts.iter().flat_map(|contact| {
            let elements = self.mesh.elements[contact.elements.clone()].iter().enumerate();
            elements.map(move |(number, element)| (contact, contact.elements.start + number, element))
        })
    }

    /// Contacts with bodies, and the elements that may touch them: each pair has two blocks of the tangent.
    pub(super) fn contact_pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let contacts = self.contacts.iter().filter_map(|contact| Some((contact.body()?, contact)));
        contacts.flat_map(|(body, contact)| contact.elements.clone().map(move |element| (body, element)))
    }

    /// Adds the forces of contact, internal minus external, at `c` as `passage` says.
    #[inline(never)]
    pub(super) fn add_contact_forces(&self, c: &Configuration, passage: &Passage, forces: &mut [f64]) {
        for (contact, number, element) in self.contact_elements() {
            let (start, body, mut cells) = (element.coordinates().start, contact.body(), Cells::default());
            contact.each_touch(element, c, passage, |touch| {
                Pressing::add(&mut cells, touch);
                add_force(touch, start, body, 1.0, forces);
            });
            contact.each_grip(number, element, c, passage, &cells, |grip| add_friction(grip, start, body, forces));
        }
        self.add_beam_contact_forces(c, passage, 1.0, forces);
    }

    /// Adds `factor` times the normal forces alone.
    pub(super) fn add_normal_forces(&self, c: &Configuration, passage: &Passage, factor: f64, forces: &mut [f64]) {
        for (contact, _, element) in self.contact_elements() {
            let (start, body) = (element.coordinates().start, contact.body());
            contact.each_touch(element, c, passage, |touch| add_force(touch, start, body, factor, forces));
        }
        self.add_beam_contact_forces(c, passage, factor, forces);
    }

    /// [`Self::add_contact_forces`], and adds `scale` times their derivative to the blocks of elements and bodies, and
    /// sets those between them; over a step twice the derivative by the coordinates at its end.
    #[inline(never)]
    pub(super) fn add_contacts_and_set_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        let layout = TangentLayout::of(self);
        let mut pairs = layout.contact_pairs();
        // Derivatives of friction are those by the end, normal forces have them twice already.
        let twice = if matches!(passage, Passage::Step(_)) { 2.0 } else { 1.0 };
        for (contact, number, element) in self.contact_elements() {
            let (first, body, mut cells) = (element.coordinates().start, contact.body(), Cells::default());
            let Some(start) = body else {
                let block = tangent.block_mut(layout.element(number));
                contact.each_touch(element, c, passage, |touch| {
                    Pressing::add(&mut cells, touch);
                    add_force(touch, first, body, 1.0, forces);
                    add_to_element(touch, scale, block);
                });
                contact.each_grip(number, element, c, passage, &cells, |grip| {
                    add_friction(grip, first, body, forces);
                    add_product(&grip.by_element, &grip.by_end(), scale * twice, block);
                });
                continue;
            };
            let blocks = [(); 2].map(|()| pairs.next().expect("a contact with a body has two blocks an element"));
            blocks.into_iter().for_each(|block| tangent.block_mut(block).fill(0.0));
            let mut own: Option<BodyTangent> = None;
            contact.each_touch(element, c, passage, |touch| {
                let BodyTangent { element, by_body, by_element, body: of_body } = own.get_or_insert_default();
                Pressing::add(&mut cells, touch);
                add_force(touch, first, body, 1.0, forces);
                add_to_element(touch, scale, element);
                add_with_body(touch, scale, by_body, by_element, of_body);
            });
            let Some(mut own) = own else { continue };
            contact.each_grip(number, element, c, passage, &cells, |grip| {
                let (by_end, by_body_end, factor) = (grip.by_end(), grip.by_body_end(), scale * twice);
                add_friction(grip, first, body, forces);
                add_product(&grip.by_element, &by_end, factor, &mut own.element);
                add_product(&grip.by_element, &by_body_end, factor, &mut own.by_body);
                add_product(&grip.by_body, &by_end, factor, &mut own.by_element);
                add_product(&grip.by_body, &by_body_end, factor, &mut own.body);
            });
            let body = self.bodies.iter().position(|own| own.start == start).expect("the body is of this system");
            let parts: [(usize, &[f64]); 4] = [
                (layout.element(number), &own.element),
                (blocks[0], &own.by_body),
                (blocks[1], &own.by_element),
                (layout.body(body), &own.body),
            ];
            for (block, part) in parts {
                tangent.block_mut(block).iter_mut().zip(part).for_each(|(sum, value)| *sum += value);
            }
        }
    }

    /// Adds `factor` times the derivative of the normal forces with respect to the velocities, at an instant with the
    /// velocities `velocity`, to the first blocks of `tangent`.
    pub(super) fn add_contact_damping(&self, c: &Configuration, velocity: &[f64], factor: f64, tangent: &mut Blocks) {
        let layout = TangentLayout::of(self);
        let (mut pairs, passage) = (layout.contact_pairs(), Passage::with_velocity(velocity));
        for (contact, number, element) in self.contact_elements() {
            let body = contact.body().map(|start| {
                let body = self.bodies.iter().position(|own| own.start == start).expect("the body is of this system");
                let mut next = || pairs.next().expect("a contact with a body has two blocks an element");
                ([next(), next()], layout.body(body))
            });
            contact.each_touch(element, c, &passage, |touch| {
                if touch.damping == Mat3::zeros() {
                    return;
                }
                let own = Touch { force: Vec3::zeros(), stiffness: touch.damping, ..*touch };
                add_to_element(&own, factor, tangent.block_mut(layout.element(number)));
                if let Some(([by_body, by_element], of_body)) = body {
                    let [mut one, mut other] = [[0.0; ELEMENT * BODY], [0.0; ELEMENT * BODY]];
                    add_with_body(&own, factor, &mut one, &mut other, tangent.block_mut(of_body));
                    for (block, part) in [(by_body, &one), (by_element, &other)] {
                        tangent.block_mut(block).iter_mut().zip(part).for_each(|(sum, value)| *sum += value);
                    }
                }
            });
        }
    }

    /// Energy of all penetrations at `c`, J.
    pub(super) fn contact_energy(&self, c: &Configuration) -> f64 {
        let mut sum = 0.0;
        for (contact, _, element) in self.contact_elements() {
            contact.each_touch(element, c, &Passage::Rest, |touch| sum += touch.energy);
        }
        sum + self.beam_contact_energy(c)
    }

    /// Adds the forces of contact over `step`, whose middle is `c`. Returns what they do to the energies.
    pub(super) fn finish_contacts(&self, c: &Configuration, step: &TimeStep, forces: &mut [f64]) -> ContactEnergy {
        let mut found = ContactEnergy::default();
        if !self.has_contacts() {
            return found;
        }
        let passage = Passage::Step(*step);
        found.dissipated = self.finish_beam_contacts(c, step, forces);
        found.elastic = self.contact_energy(step.end);
        for (contact, number, element) in self.contact_elements() {
            let (first, body, mut cells) = (element.coordinates().start, contact.body(), Cells::default());
            let [start, end] = [step.start, step.end].map(|c| contact.carrier(c));
            let moves = body.is_none() && start != end;
            contact.each_touch(element, c, &passage, |touch| {
                Pressing::add(&mut cells, touch);
                add_force(touch, first, body, 1.0, forces);
                found.dissipated += touch.dissipated;
                if moves {
                    found.by_frames -= touch.work_on_carrier(&(end.place - start.place), &(end.axes - start.axes));
                }
            });
            contact.each_grip(number, element, c, &passage, &cells, |grip| {
                add_friction(grip, first, body, forces);
                found.dissipated += grip.force.dot(&grip.slip);
                found.by_frames += grip.force.dot(&grip.by_frame);
            });
        }
        found
    }

    /// Sets what cells remember at the end of what `passage` says.
    pub(super) fn remember_grips(&self, c: &Configuration, passage: &Passage, memory: &mut [f64]) {
        for (contact, number, element) in self.contact_elements() {
            let Some(friction) = contact.friction else { continue };
            let first = friction.memory + REMEMBERED * (number - contact.elements.start);
            let mut cells = Cells::default();
            contact.each_touch(element, c, passage, |touch| Pressing::add(&mut cells, touch));
            // Cells that do not touch remember nothing.
            memory[first..first + REMEMBERED].fill(0.0);
            contact.each_grip(number, element, c, passage, &cells, |grip| {
                memory[first + 3 * grip.cell..][..3].copy_from_slice(grip.displaced.as_slice());
            });
        }
    }

    /// Checks that no beam has run through a surface over a step or increment from `state` to `c`.
    ///
    /// # Errors
    /// One has: it might leave on the other side.
    pub fn check_contacts(&self, c: &Configuration, state: &State, time: f64) -> Result<(), Error> {
        if !self.has_contacts() {
            return Ok(());
        }
        let before = Configuration { accepted: (&state.q, &state.prescribed), ..*c }.accepted();
        self.check_beam_contacts([&before, c], time)?;
        let found = self.contact_elements().find(|(own, _, element)| own.is_run_through(element, [&before, c]));
        let Some((contact, number, _)) = found else { return Ok(()) };
        let (beam, element) = self.beam_of(number);
        let (beam, surface) = (beam.name.clone(), contact.surface.name.clone());
        let inside = Inside { beam, element, surface, radius: contact.surface.shape.radius() };
        Err(Error::RunThrough { time, inside })
    }

    /// Calls `take` with the position in element `number`, and with force (N) and moment (N m) on it in global axes, of
    /// each point that touches a surface.
    pub fn each_touch_of(
        &self,
        number: usize,
        c: &Configuration,
        passage: &Passage,
        take: &mut dyn FnMut(f64, [Vec3; 2]),
    ) {
        for contact in self.contacts.iter().filter(|contact| contact.elements.contains(&number)) {
            let (element, mut cells) = (&self.mesh.elements[number], Cells::default());
            contact.each_touch(element, c, passage, |touch| {
                Pressing::add(&mut cells, touch);
                take(touch.xi, [touch.in_space(), Vec3::zeros()]);
            });
            contact.each_grip(number, element, c, passage, &cells, |grip| take(grip.xi, grip.in_space()));
        }
    }
}

impl Touch {
    /// Work of the force that the beam exerts on the carrier while its position and axes change, J.
    fn work_on_carrier(&self, moved: &Vec3, axes: &Mat3) -> f64 {
        self.force.dot(&axes.tr_mul(&self.arms.arm)) - self.in_space().dot(moved)
    }
}

/// Adds `factor` times the internal force of a point of the element whose coordinates begin at `start`, and of the body
/// that carries the surface.
fn add_force(touch: &Touch, start: usize, body: Option<usize>, factor: f64, forces: &mut [f64]) {
    let force = touch.in_space() * factor;
    for (weight, first) in touch.weights.iter().zip(SHAPE_PLACES) {
        add_vec3(forces, start + first, &(force * -weight));
    }
    let Some(body) = body else { return };
    add_vec3(forces, body, &force);
    for director in 0..3 {
        add_vec3(forces, body + axis_place(director), &(touch.arms.arm * (-factor * touch.force[director])));
    }
}

/// Adds the internal force of friction of the element whose coordinates begin at `start`, and of the body.
fn add_friction(grip: &Grip, start: usize, body: Option<usize>, forces: &mut [f64]) {
    let mut add = |first: usize, own: &[f64]| {
        forces[first..first + own.len()].iter_mut().zip(own).for_each(|(sum, value)| *sum += value);
    };
    add(start, grip.by_element.tr_mul(&grip.force).as_slice());
    if let Some(body) = body {
        add(body, grip.by_body.tr_mul(&grip.force).as_slice());
    }
}

/// Adds `factor` times `rowsᵀ columns` to a column-major block.
fn add_product<const ROWS: usize, const COLUMNS: usize>(
    rows: &SMatrix<f64, 3, ROWS>,
    columns: &SMatrix<f64, 3, COLUMNS>,
    factor: f64,
    block: &mut [f64],
) {
    let product = rows.tr_mul(columns);
    block.iter_mut().zip(product.as_slice()).for_each(|(sum, value)| *sum += factor * value);
}

/// Adds `scale` times `∂f/∂X` of the element to its block.
fn add_to_element(touch: &Touch, scale: f64, block: &mut [f64]) {
    let own = touch.arms.axes * touch.stiffness * touch.arms.end_axes.transpose();
    for (by, column) in touch.weights.iter().zip(SHAPE_PLACES) {
        for (weight, row) in touch.weights.iter().zip(SHAPE_PLACES) {
            add_block(block, ELEMENT, [row, column], &(own * (scale * weight * by)));
        }
    }
}

/// Adds `scale` times the derivatives of the forces on the element by the coordinates of the body, on the body by those
/// of the element, and on the body by its own.
fn add_with_body(touch: &Touch, scale: f64, by_body: &mut [f64], by_element: &mut [f64], of_body: &mut [f64]) {
    let Touch { force, stiffness, ref arms, .. } = *touch;
    let (rows, columns) = (arms.axes * stiffness, stiffness * arms.end_axes.transpose());
    let by_point = arms.axes * columns;
    for (weight, first) in touch.weights.iter().zip(SHAPE_PLACES) {
        let factor = scale * weight;
        add_block(by_body, ELEMENT, [first, 0], &(by_point * -factor));
        add_block(by_element, BODY, [0, first], &(by_point * -factor));
        for director in 0..3 {
            let turned = Mat3::identity() * force[director];
            let by_director = rows.column(director) * arms.end_arm.transpose() - turned;
            add_block(by_body, ELEMENT, [first, axis_place(director)], &(by_director * factor));
            let on_director = arms.arm * columns.row(director) - turned;
            add_block(by_element, BODY, [axis_place(director), first], &(on_director * factor));
        }
    }
    add_block(of_body, BODY, [0, 0], &(by_point * scale));
    for director in 0..3 {
        let turned = Mat3::identity() * force[director];
        let by_director = turned - rows.column(director) * arms.end_arm.transpose();
        add_block(of_body, BODY, [0, axis_place(director)], &(by_director * scale));
        let on_director = turned - arms.arm * columns.row(director);
        add_block(of_body, BODY, [axis_place(director), 0], &(on_director * scale));
        for other in 0..3 {
            let own = arms.arm * arms.end_arm.transpose() * (scale * stiffness[(director, other)]);
            add_block(of_body, BODY, [axis_place(director), axis_place(other)], &own);
        }
    }
}

/// Adds a matrix to a column-major block of `rows` rows, with its corner at `row` and `column`.
pub(super) fn add_block(block: &mut [f64], rows: usize, [row, column]: [usize; 2], own: &Mat3) {
    for (number, values) in own.column_iter().enumerate() {
        let first = (column + number) * rows + row;
        block[first..first + 3].iter_mut().zip(values.iter()).for_each(|(sum, value)| *sum += value);
    }
}
