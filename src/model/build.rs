//! From the typed file to the machine: the mistakes that only geometry shows are found here.

use super::diagnostic::{Diagnostic, Place};
use super::document::Document;
use super::entries::anchor::{Along, Anchor, Spot};
use super::entries::beam::Beam;
use super::entries::joint::{Joint, JointKind};
use super::entries::load::{Load, Target};
use super::entries::material::Lateral;
use super::entries::section::{self, Shape};
use super::number::Number;
use crate::math::{Mat3, Vec3};
use crate::mechanics::assembly::{Assembly, BeamDesign, Torsion};
use crate::mechanics::joint::primitive::Primitive;
use crate::mechanics::joint::{self, revolute, spherical, weld};
use crate::mechanics::load::{self, Direction, Signal};
use crate::mechanics::marker::{Marker, Pose};
use crate::mechanics::material::Material;
use crate::mechanics::section::Section;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use std::sync::Arc;

/// Sine of the smallest angle between a beam and its `y_axis`: one degree.
const SMALLEST_SINE: f64 = 0.017_452_4;

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
pub fn build(document: &Document, start: f64) -> Result<Built, Vec<Diagnostic>> {
    let mut builder = Builder { document, assembly: Assembly::default(), mistakes: Vec::new() };
    for beam in &document.beams {
        builder.add_beam(beam);
    }
    // Points cannot be found on beams that are wrong themselves.
    if builder.mistakes.is_empty() {
        for joint in &document.joints {
            builder.add_joint(joint);
        }
        for load in &document.loads {
            builder.add_load(load);
        }
        for output in &document.outputs {
            if let Some((beam, fraction)) = builder.point(&output.at) {
                builder.assembly.add_sensor(beam, fraction);
            }
        }
    }
    let Builder { assembly, mut mistakes, .. } = builder;
    if !mistakes.is_empty() {
        mistakes.sort_by_key(|mistake| mistake.place);
        return Err(mistakes);
    }
    let (system, state) = assembly.finish(vector(document, document.model.gravity), start);
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
    Signal::Function(Arc::new(move |time| function.value(time)))
}

struct Builder<'a> {
    document: &'a Document,
    assembly: Assembly,
    mistakes: Vec<Diagnostic>,
}

impl Builder<'_> {
    fn mistake(&mut self, place: Place, message: &str, label: &str, help: &str) {
        self.mistakes.push(self.document.diagnostic(place, message, label, help));
    }

    fn add_beam(&mut self, beam: &Beam) {
        let document = self.document;
        let (from, to) = (vector(document, beam.from), vector(document, beam.to));
        let y_axis = vector(document, beam.y_axis);
        let span = to - from;
        if span.norm() == 0.0 || !span.norm().is_finite() {
            let message = format!("beam {} has the length {}", beam.name, span.norm());
            self.mistake(document.place(beam.to[0]), &message, "`to` must differ from `from`", "");
            return;
        }
        let sine = span.cross(&y_axis).norm() / (span.norm() * y_axis.norm());
        // A y_axis of length 0 gives NaN, which is a mistake too.
        if sine.is_nan() || sine < SMALLEST_SINE {
            let message = format!("the y_axis of beam {} is along the beam", beam.name);
            let place = document.place(beam.y_axis[0]);
            let help = format!("give {} a y_axis that is more than 1 degree off its direction", beam.name);
            self.mistake(place, &message, "the section's y must be across the beam", &help);
            return;
        }
        let material = &document.materials[beam.material];
        let young = document.value(material.young);
        let shear = match material.lateral {
            Lateral::Poisson(poisson) => Material::shear_from_poisson(young, document.value(poisson)),
            Lateral::Shear(shear) => document.value(shear),
        };
        self.assembly.add_beam(&BeamDesign {
            name: beam.name.clone(),
            from,
            to,
            y_axis,
            pretwist: document.value(beam.pretwist),
            elements: document.value(beam.elements) as usize,
            material: Material { young, shear, density: document.value(material.density) },
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
        }
    }

    /// Beam and fraction of its length; none for the ground, or after a mistake.
    fn point(&mut self, anchor: &Anchor) -> Option<(usize, f64)> {
        let Spot::Beam { beam, along } = anchor.spot else { return None };
        let document = self.document;
        let elements = document.value(document.beams[beam].elements);
        let fraction = match along {
            Along::Start => 0.0,
            Along::End => 1.0,
            Along::Fraction(number) => document.value(number),
            Along::Node(node) => {
                if node as f64 > elements {
                    let name = &document.beams[beam].name;
                    let message = format!("beam {name} has no node {node}");
                    let label = format!("{elements} elements have the nodes 0 to {elements}");
                    self.mistake(anchor.place, &message, &label, "");
                    return None;
                }
                node as f64 / elements
            }
        };
        Some((beam, fraction))
    }

    /// The node that an anchor names; none for the ground, or after a mistake.
    fn node(&mut self, anchor: &Anchor) -> Option<usize> {
        let (beam, fraction) = self.point(anchor)?;
        let node = self.assembly.node_at(beam, fraction);
        if node.is_none() {
            let beam = &self.document.beams[beam];
            let elements = self.document.value(beam.elements);
            let below = (fraction * elements).floor();
            let message = format!("there is no node of beam {} at the fraction {fraction}", beam.name);
            let label = format!("the nearest nodes are at {} and {}", below / elements, (below + 1.0) / elements);
            let fits: Vec<String> = (1..=100)
                .filter(|count| {
                    let place = fraction * f64::from(*count);
                    (place - place.round()).abs() <= 1e-9
                })
                .take(5)
                .map(|count| count.to_string())
                .collect();
            let help = match fits.is_empty() {
                true => String::from("joints hold on to nodes: no count up to 100 has one there"),
                false => format!("joints hold on to nodes; with elements = {} there is one there", fits.join(", ")),
            };
            self.mistake(anchor.place, &message, &label, &help);
        }
        node
    }

    fn add_joint(&mut self, written: &Joint) {
        let document = self.document;
        let before = self.mistakes.len();
        let (node_a, node_b) = (self.node(&written.a), self.node(&written.b));
        if self.mistakes.len() > before {
            return;
        }
        if node_a.is_some() && node_a == node_b {
            let message = format!("joint {} joins a point to itself", written.name);
            self.mistake(written.b.place, &message, "another point was expected", "");
            return;
        }
        let Some(own) = node_b.or(node_a) else { return };
        let at_node = Marker::Node { node: own, offset: Vec3::zeros(), axes: Mat3::identity() };
        let place = written.at.map_or_else(|| self.assembly.drawn(&at_node).place, |at| vector(document, at));
        let axes = match written.axis {
            None => Mat3::identity(),
            Some(numbers) => {
                let axis = vector(document, numbers);
                if axis.norm() == 0.0 || !axis.norm().is_finite() {
                    let message = format!("the axis of joint {} has no direction", written.name);
                    self.mistake(document.place(numbers[0]), &message, "a vector other than zero was expected", "");
                    return;
                }
                triad_along(&axis)
            }
        };
        let side = |node: Option<usize>| {
            node.map_or(Marker::Ground(Pose { place, axes }), |node| self.assembly.marker_on_node(node, &place, &axes))
        };
        let primitives: &'static [Primitive] = match written.kind {
            JointKind::Weld => weld::PRIMITIVES,
            JointKind::Spherical => spherical::PRIMITIVES,
            JointKind::Revolute => revolute::PRIMITIVES,
        };
        let joint = joint::Joint { name: written.name.clone(), a: side(node_a), b: side(node_b), primitives };
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
