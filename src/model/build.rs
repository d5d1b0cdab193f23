//! From the typed file to the machine: geometry.rs has checked it, or does so here after a change of parameters.

use super::diagnostic::Diagnostics;
use super::document::Document;
use super::entries::anchor::{Anchor, Spot};
use super::entries::beam::Beam;
use super::entries::joint::{Joint, JointKind};
use super::entries::load::{Load, Target};
use super::entries::material::Lateral;
use super::entries::output;
use super::entries::section::{self, Shape};
use super::geometry;
use super::number::Number;
use crate::math::{Mat3, Vec3};
use crate::mechanics::assembly::{Assembly, BeamDesign, Torsion};
use crate::mechanics::joint::primitive::Primitive;
use crate::mechanics::joint::{self, revolute, spherical, weld};
use crate::mechanics::load::{self, Direction, Signal};
use crate::mechanics::marker::Marker;
use crate::mechanics::material::Material;
use crate::mechanics::pose::Pose;
use crate::mechanics::section::{Outline, Section};
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use std::sync::Arc;

/// The machine as drawn.
#[derive(Clone, Debug)]
pub struct Built {
    /// The machine.
    pub system: System,
    /// Its state as drawn, velocities as given.
    pub state: State,
}

/// Builds the machine with the parameters of now; `start` is the time of the drawing, s.
///
/// # Errors
/// Every mistake that the geometry shows, in file order.
pub fn build(document: &Document, start: f64) -> Result<Built, Diagnostics> {
    let mistakes = geometry::mistakes(document);
    if !mistakes.is_empty() {
        return Err(Diagnostics(mistakes));
    }
    let mut builder = Builder { document, assembly: Assembly::new(start) };
    for beam in &document.beams {
        builder.add_beam(beam);
    }
    for joint in &document.joints {
        builder.add_joint(joint);
    }
    for load in &document.loads {
        builder.add_load(load);
    }
    for output in &document.outputs {
        let output::Target::At(at) = &output.target else { continue };
        if let Some((beam, fraction)) = builder.point(at) {
            builder.assembly.add_sensor(beam, fraction);
        }
    }
    let (system, state) = builder.assembly.finish(vector(document, document.model.gravity));
    Ok(Built { system, state })
}

/// Brings gravity and loads of a built machine to the parameters of now.
pub fn retune(document: &Document, system: &mut System) {
    system.gravity = vector(document, document.model.gravity);
    for (load, written) in system.loads.iter_mut().zip(&document.loads) {
        load.force = written.force.map(|number| signal(document, number));
        load.moment = written.moment.map(|number| signal(document, number));
    }
}

fn vector(document: &Document, numbers: [Number; 3]) -> Vec3 {
    Vec3::from(document.vector(numbers))
}

fn signal(document: &Document, number: Number) -> Signal {
    let function = document.function(number);
    if function.is_constant() {
        return Signal::Constant(function.value(0.0));
    }
    Signal::Function(Arc::new(move |time| function.jet(time)))
}

/// Builds what [`geometry::mistakes`] has found sound.
struct Builder<'a> {
    document: &'a Document,
    assembly: Assembly,
}

impl Builder<'_> {
    fn add_beam(&mut self, beam: &Beam) {
        let document = self.document;
        let material = &document.materials[beam.material];
        let young = document.value(material.young);
        let shear = match material.lateral {
            Lateral::Poisson(poisson) => Material::shear_from_poisson(young, document.value(poisson)),
            Lateral::Shear(shear) => document.value(shear),
        };
        self.assembly.add_beam(&BeamDesign {
            name: beam.name.clone(),
            from: vector(document, beam.from),
            to: vector(document, beam.to),
            y_axis: vector(document, beam.y_axis),
            pretwist: document.value(beam.pretwist),
            elements: document.value(beam.elements) as usize,
            material: Material { young, shear, density: document.value(material.density), damping: 0.0 },
            section: self.section(&document.sections[beam.section]),
            strain: beam.strain,
            torsion: if beam.torsion { Torsion::Free } else { Torsion::Suppressed },
            velocity: vector(document, beam.velocity),
            angular_velocity: vector(document, beam.angular_velocity),
        });
    }

    /// Integrals of the shape, those that are written instead of the shape's own.
    fn section(&self, written: &section::Section) -> Section {
        let value = |number| self.document.value(number);
        let given = |number: Option<Number>, own: f64| number.map_or(own, value);
        let shape = match written.shape {
            Shape::Rectangle { width, height } => Section::rectangle(value(width), value(height)),
            Shape::Circle { radius } => Section::circle(value(radius)),
            Shape::Tube { inner, outer } => Section::tube(value(inner), value(outer)),
            Shape::General => Section {
                area: 0.0,
                second_moment_y: 0.0,
                second_moment_z: 0.0,
                torsion_constant: 0.0,
                polar_moment: 0.0,
                fourth_moments: [0.0; 3],
                outline: Outline::General,
            },
        };
        let second_moment_y = given(written.second_moment_y, shape.second_moment_y);
        let second_moment_z = given(written.second_moment_z, shape.second_moment_z);
        Section {
            area: given(written.area, shape.area),
            second_moment_y,
            second_moment_z,
            torsion_constant: given(written.torsion_constant, shape.torsion_constant),
            polar_moment: given(written.polar_moment, second_moment_y + second_moment_z),
            fourth_moments: written
                .fourth_moments
                .map_or(shape.fourth_moments, |numbers| self.document.vector(numbers)),
            outline: shape.outline,
        }
    }

    /// Beam and fraction of its length; none for the ground.
    fn point(&self, anchor: &Anchor) -> Option<(usize, f64)> {
        let Spot::Beam { beam, along } = anchor.spot else { return None };
        let elements = self.document.value(self.document.beams[beam].elements);
        Some((beam, along.fraction(self.document, elements)))
    }

    /// The node that an anchor names; none for the ground.
    fn node(&self, anchor: &Anchor) -> Option<usize> {
        self.point(anchor).and_then(|(beam, fraction)| self.assembly.node_at(beam, fraction))
    }

    fn add_joint(&mut self, written: &Joint) {
        let document = self.document;
        let (node_a, node_b) = (self.node(&written.a), self.node(&written.b));
        let Some(own) = node_b.or(node_a) else { return };
        let at_node = Marker::Node { node: own, offset: Vec3::zeros(), axes: Mat3::identity() };
        let place = written.at.map_or_else(|| self.assembly.drawn(&at_node).place, |at| vector(document, at));
        let axes = written.axis.map_or_else(Mat3::identity, |axis| triad_along(&vector(document, axis)));
        let pose = Pose { place, axes };
        let side = |node: Option<usize>| {
            node.map_or(Marker::Ground(pose), |node| self.assembly.tied(&self.assembly.node(node), &pose))
        };
        let primitives: &'static [Primitive] = match written.kind {
            JointKind::Weld => weld::PRIMITIVES,
            JointKind::Spherical => spherical::PRIMITIVES,
            JointKind::Revolute => revolute::PRIMITIVES,
            _ => return,
        };
        let joint = joint::Joint {
            name: format!("joint {}", written.name),
            a: side(node_a),
            b: side(node_b),
            primitives,
            drive: None,
        };
        self.assembly.add_joint(joint);
    }

    fn add_load(&mut self, written: &Load) {
        let points = match &written.target {
            Target::At(anchor) => {
                let Some((beam, fraction)) = self.point(anchor) else { return };
                vec![(self.assembly.section_at(beam, fraction), 1.0)]
            }
            Target::On(beam) => self.assembly.sections_of(*beam),
        };
        let signals = |numbers: [Number; 3]| numbers.map(|number| signal(self.document, number));
        self.assembly.add_load(load::Load {
            name: written.name.clone(),
            points,
            force: signals(written.force),
            moment: signals(written.moment),
            direction: if written.follower { Direction::Follower } else { Direction::Global },
        });
    }
}

/// A triad whose first axis is along `axis`; the others are as near to the global axes as can be.
fn triad_along(axis: &Vec3) -> Mat3 {
    let first = axis.normalize();
    let least = first.iamin();
    let second = (Vec3::ith(least, 1.0) - first * first[least]).normalize();
    Mat3::from_columns(&[first, second, first.cross(&second)])
}
