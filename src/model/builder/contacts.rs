//! Contacts of the file as parts of the system.

use super::Builder;
use crate::math::Vec3;
use crate::mechanics::contact::cone::Cone;
use crate::mechanics::contact::grip::Friction;
use crate::mechanics::contact::law::Law;
use crate::mechanics::contact::shape::Shape;
use crate::mechanics::contact::{Contact, Ground, Surface};
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::file::entries::contact::{Bed, ContactSpec};
use crate::model::file::entries::surface::{self, SurfaceSpec};
use crate::model::file::number::Number;
use crate::model::shape::contacts::contact_radius;
use crate::model::shape::sections;

/// Default stiffness of a contact with something round, over `EA/R²`: the surface then gives by a quarter of the axial
/// strain under the beam's own pull.
const ROUND_SHARE: f64 = 4.0;
/// Radii of the beam over which its axial stiffness is spread in the default stiffness of a contact with a plane.
const FLAT_RADII: f64 = 20.0;
/// Smallest share of the coefficients of friction along and across a beam: the ellipse of their limits has a width.
const LEAST_SHARE: f64 = 1e-3;

impl Builder<'_> {
    pub(super) fn add_contact(&mut self, number: usize, written: &ContactSpec) {
        for (beam, surface) in pairs(self.document, written) {
            let spec = &self.document.surfaces[surface];
            let surface = Surface { name: spec.name.clone(), ..self.surface(spec) };
            let elements = self.system.elements_of(beam);
            let radius = match written.bed {
                Some(Bed { at_axis: true, .. }) => 0.0,
                _ => contact_radius(self.document, written, beam),
            };
            let ground = match written.bed {
                Some(Bed { friction_in_statics, .. }) => Ground::Seabed { first: friction_in_statics },
                None => Ground::Rigid,
            };
            let law = law(self.document, written, beam, &surface.shape);
            let friction = friction(self.document, written, (&law, beam), 0);
            let name = written.name.clone();
            self.system.add_contact(Contact { name, number, surface, elements, radius, law, friction, ground });
        }
        for pair in written.beam_pairs() {
            let radius = |beam| contact_radius(self.document, written, beam);
            let strands = [(pair.0, radius(pair.0)), (pair.1, radius(pair.1))];
            let law = law_of_pair(self.document, written, pair);
            self.system.add_beam_contact((written.name.clone(), number), strands, law);
        }
    }

    pub(super) fn surface(&self, spec: &SurfaceSpec) -> Surface {
        let document = self.document;
        let carrier = self.carrier(spec.on);
        let axes = self.system.drawn(&carrier).axes.tr_mul(&spec.axes(&document.numbers));
        let marker = carrier.carried(&spec.offset(&document.numbers), &axes);
        let shape = match spec.shape {
            surface::Shape::Plane(_) | surface::Shape::Bottom { .. } => Shape::Plane,
            surface::Shape::Cylinder { radius, length, inside, .. } => Shape::Cylinder {
                radius: document.value(radius),
                half_length: length.map_or(f64::INFINITY, |length| 0.5 * document.value(length)),
                inside,
            },
            surface::Shape::Sphere { radius, inside } => Shape::Sphere { radius: document.value(radius), inside },
            surface::Shape::Sheave { radius, groove, .. } => {
                Shape::Sheave { radius: document.value(radius), groove: document.value(groove) }
            }
            surface::Shape::Ring { radius, wire, .. } => {
                Shape::Ring { radius: document.value(radius), wire: document.value(wire) }
            }
            surface::Shape::Box { size, .. } => Shape::Box { half: Vec3::from(document.vector(size)) * 0.5 },
            surface::Shape::Cone { radii, length, .. } => Shape::Cone(Cone {
                radii: radii.map(|radius| document.value(radius)),
                half_length: 0.5 * document.value(length),
            }),
        };
        Surface { name: String::new(), marker, shape }
    }
}

/// The beams and surfaces that touch each other, by their numbers: the bottom of the water does not act on beams
/// without a diameter, as water does not.
fn pairs<'a>(document: &'a Document, written: &'a ContactSpec) -> impl Iterator<Item = (usize, usize)> + 'a {
    written.pairs().filter(|(beam, _)| written.bed.is_none() || diameter(document, *beam) > 0.0)
}

/// The diameter of a beam on the bottom of the water, m.
fn diameter(document: &Document, beam: usize) -> f64 {
    let section = &document.sections[document.beams[beam].section];
    sections::outer_diameter(section, |number| document.value(number)).unwrap_or(0.0)
}

/// The normal force of a beam on a surface of this shape.
fn law(document: &Document, written: &ContactSpec, beam: usize, shape: &Shape) -> Law {
    if written.bed.is_some() {
        let on_diameter = |number: Number| document.value(number) * diameter(document, beam);
        let stiffness = written.stiffness.map_or(0.0, on_diameter);
        return Law { stiffness, damping: 0.0, viscosity: on_diameter(written.damping) };
    }
    let stiffness = written.stiffness.map_or_else(
        || {
            let own = &document.beams[beam];
            let section = sections::at_start(document, &document.sections[own.section]);
            let (axial, radius) = (axial_stiffness(document, beam), contact_radius(document, written, beam));
            match *shape {
                Shape::Cylinder { radius, .. } | Shape::Sphere { radius, .. } | Shape::Sheave { radius, .. } => {
                    ROUND_SHARE * axial / (radius * radius)
                }
                // Thin beams bend around the wire of a ring, and around a cone about as around its middle.
                Shape::Ring { .. } | Shape::Cone(_) => ROUND_SHARE * axial / (shape.radius() * shape.radius()),
                Shape::Plane | Shape::Box { .. } if radius > 0.0 => axial / (FLAT_RADII * radius).powi(2),
                // A line without thickness has its gyration alone.
                Shape::Plane | Shape::Box { .. } => {
                    axial / section.gyration().max(f64::MIN_POSITIVE).powi(2) / FLAT_RADII.powi(2)
                }
            }
        },
        |stiffness| document.value(stiffness),
    );
    Law { stiffness, damping: document.value(written.damping), viscosity: 0.0 }
}

/// The normal force of two beams on each other. By default both are as stiff as on a cylinder as large as the distance
/// of their axes.
fn law_of_pair(document: &Document, written: &ContactSpec, pair: (usize, usize)) -> Law {
    let beams = [pair.0, pair.1];
    let stiffness = written.stiffness.map_or_else(
        || {
            let distance: f64 = beams.into_iter().map(|beam| contact_radius(document, written, beam)).sum();
            let axial = beams.into_iter().map(|beam| axial_stiffness(document, beam)).fold(f64::INFINITY, f64::min);
            ROUND_SHARE * axial / (distance * distance).max(f64::MIN_POSITIVE)
        },
        |stiffness| document.value(stiffness),
    );
    Law { stiffness, damping: document.value(written.damping), viscosity: 0.0 }
}

/// `EA` at the start of a beam, N.
fn axial_stiffness(document: &Document, beam: usize) -> f64 {
    let own = &document.beams[beam];
    let young = sections::material(document, own).map_or(0.0, |material| material.young);
    young * sections::at_start(document, &document.sections[own.section]).area
}

/// The friction of `beam` in a contact with the normal force `law`; `memory` is the first number that it remembers.
fn friction(document: &Document, written: &ContactSpec, (law, beam): (&Law, usize), memory: usize) -> Option<Friction> {
    let along = document.value(written.friction?);
    let stiffness = written.friction_stiffness.map(|stiffness| document.value(stiffness));
    let Some(bed) = written.bed else {
        let stiffness = stiffness.unwrap_or(law.stiffness);
        return Some(Friction { coefficient: along, shares: [1.0; 2], stiffness, memory });
    };
    let across = bed.across.map_or(along, |number| document.value(number));
    let coefficient = along.max(across);
    let share = |own: f64| if coefficient > 0.0 { (own / coefficient).max(LEAST_SHARE) } else { 1.0 };
    Some(Friction {
        coefficient,
        shares: [along, across].map(share),
        stiffness: stiffness.map_or(law.stiffness, |own| own * diameter(document, beam)),
        memory,
    })
}

/// Sets stiffness, damping and friction of contacts to those of now.
pub(super) fn retune(document: &Document, system: &mut System) {
    let pairs = document.contacts.iter().flat_map(|written| pairs(document, written).map(move |pair| (written, pair)));
    for (contact, (written, (beam, _))) in system.contacts.iter_mut().zip(pairs) {
        contact.law = law(document, written, beam, &contact.surface.shape);
        let memory = contact.friction.map_or(0, |own| own.memory);
        contact.friction = friction(document, written, (&contact.law, beam), memory);
    }
    let pairs = document.contacts.iter().flat_map(|own| own.beam_pairs().into_iter().map(move |pair| (own, pair)));
    for (contact, (written, pair)) in system.beam_contacts.iter_mut().zip(pairs) {
        contact.law = law_of_pair(document, written, pair);
    }
}
