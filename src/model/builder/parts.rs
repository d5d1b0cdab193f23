//! Beams, bodies, frames and loads of the file as parts of the system.

use super::{Builder, nearest_axes, presence, signal, signal_from, tune, vector};
use crate::math::Mat3;
use crate::mechanics::beam::ancf14::natural::Prestress;
use crate::mechanics::beam::centerline::Centerline;
use crate::mechanics::beam::design::BeamDesign;
use crate::mechanics::body::rigid_body::BodyDesign;
use crate::mechanics::force::load::{self, Direction, LoadGuide, Site};
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::input::guide::FrameGuide;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::body::{BodySpec, Inertia};
use crate::model::file::entries::curve::Line;
use crate::model::file::entries::frame::{FrameSpec, Orientation};
use crate::model::file::entries::load::{LoadSpec, Target};
use crate::model::file::number::Number;
use crate::model::shape::sections;

impl Builder<'_> {
    pub(super) fn add_beam(&mut self, beam: &BeamSpec, line: &Centerline) {
        let document = self.document;
        let is_paid_out = document.winches.iter().any(|winch| document.beams[winch.beam].name == beam.name);
        let written = &document.sections[beam.section];
        let length = line.spans.iter().map(|span| span.length).sum();
        let is_straight = beam.line.as_ref().is_some_and(Line::is_straight_without_stress);
        let least = sections::least_rigidity(document, beam, line);
        let number = self.system.add_beam(&BeamDesign {
            name: beam.name.clone(),
            line: line.moved(&-self.origin),
            y_axis: vector(document, beam.y_axis),
            pretwist: document.value(beam.pretwist),
            material: sections::material(document, beam).expect("the reader asks for a material"),
            section: sections::at_start(document, written).with_least_rigidity(least),
            profile: sections::along(document, written, length).map(|own| own.with_least_rigidity(least)),
            // The mass that a winch moves through the mesh carries no rotary inertia.
            rotary_inertia: beam.rotary_inertia && !is_paid_out,
            mass_damping: sections::damping(document, beam).map_or(0.0, |[_, mass]| mass),
            tension_damping: beam.tension_damping.map_or(0.0, |number| document.value(number)),
            prestress: Prestress {
                tension: beam.pretension.map_or(0.0, |number| document.value(number)),
                curvature: beam.free_curvature.map_or_else(
                    || is_straight.then_some([0.0; 2]),
                    |numbers| Some(numbers.map(|number| document.value(number))),
                ),
                torsion: beam
                    .free_torsion
                    .map_or_else(|| is_straight.then_some(0.0), |number| Some(document.value(number))),
            },
            elements: beam.formulation,
            velocity: vector(document, beam.velocity),
            angular_velocity: vector(document, beam.angular_velocity),
        });
        self.heat(number, beam, line);
        if let Some(element) = self.system.impossible_element(number) {
            let message = format!("beam {} is bent or pretwisted too sharply for a solid section", beam.name);
            let label = format!("element {element}, counted from 0, has fibers without length");
            let help =
                "element = \"ancf24\" has a solid section: take a slimmer one, more elements, or element = \"ancf14\"";
            self.mistakes.push(document.diagnostic(beam.place, &message, &label, help));
        }
    }

    pub(super) fn add_body(&mut self, body: &BodySpec) {
        let document = self.document;
        let inertia = match body.inertia {
            Inertia::Principal(numbers) => Mat3::from_diagonal(&vector(document, numbers)),
            Inertia::Tensor(numbers) => {
                let [xx, yy, zz, xy, yz, zx] = numbers.map(|number| document.value(number));
                Mat3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz)
            }
        };
        let axes = body.axes.map_or_else(Mat3::identity, |rows| nearest_axes(document, rows));
        self.system.add_body(&BodyDesign {
            name: body.name.clone(),
            mass: document.value(body.mass),
            position: self.position(body.position),
            inertia,
            axes,
            velocity: vector(document, body.velocity),
            angular_velocity: vector(document, body.angular_velocity),
        });
    }

    pub(super) fn add_frame(&mut self, frame: &FrameSpec) {
        let document = self.document;
        let (guide, target) = match frame.orientation {
            Orientation::Rotation(rotation) if !frame.input => {
                let [x, y, z] = frame.position;
                let place =
                    [(x, 0), (y, 1), (z, 2)].map(|(number, axis)| signal_from(document, number, self.origin[axis]));
                let rotation = rotation.map(|number| signal(document, number));
                (FrameGuide::Signals { place, rotation }, Pose::default())
            }
            orientation => {
                let axes = tune::axes(orientation, |number| document.value(number));
                let place = self.position(frame.position);
                (FrameGuide::Host, Pose { place, axes: axes.unwrap_or_else(Mat3::identity) })
            }
        };
        self.system.add_frame(&frame.name, guide, target);
    }

    pub(super) fn add_load(&mut self, written: &LoadSpec) {
        let site = match &written.target {
            Target::At(anchor) => {
                let marker = self.anchored(anchor);
                self.stiffen_below(&marker);
                // A force at the section acts on the axis alone.
                let is_zero = |number: &Number| {
                    let function = self.document.function(*number);
                    function.is_constant() && function.value(0.0) == 0.0
                };
                if written.input || !written.moment.iter().all(is_zero) {
                    self.system.stiffen(&marker);
                }
                Site::Point(marker)
            }
            Target::On(beam) => self.system.along(*beam),
            Target::Moving { beam, station } => {
                self.system.moving_along(*beam, signal(self.document, *station), presence(self.document, *station))
            }
        };
        let signals = |numbers: [Number; 3]| numbers.map(|number| signal(self.document, number));
        self.system.add_load(load::Load {
            name: written.name.clone(),
            site,
            guide: if written.input {
                LoadGuide::Host
            } else {
                LoadGuide::Signals { force: signals(written.force), moment: signals(written.moment) }
            },
            direction: if written.follower { Direction::Follower } else { Direction::Global },
        });
    }
}
