//! What never changes of a picture: names, sections, solids, which sign stands for what.

use super::profile::{Profile, Solid};
use super::rope_line;
use super::stations::{Stations, ranges};
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::Beam;
use crate::mechanics::fluid::medium::Medium;
use crate::mechanics::fluid::waves::Component;
use crate::mechanics::force::load::Site;
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::file::entries::joint::JointKind;
use crate::model::file::entries::load;
use crate::model::file::entries::output::Target;
use crate::model::file::entries::simulation::Analysis;
use crate::model::file::entries::surface::{Mesh, Shape, SurfaceSpec};
use crate::model::file::reader::anchor::Spot;
use std::ops::Range;

/// The mechanism as a picture needs it.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Name of the model.
    pub name: String,
    /// One sentence on it; may be empty.
    pub description: String,
    /// Whether the time is that of a motion; of a static analysis it only orders the equilibria.
    pub is_dynamic: bool,
    /// Gravity, m/s².
    pub gravity: [f64; 3],
    /// What all places are counted from, global, m: the middle of a system that is far from the global origin, so that
    /// single precision is enough for them.
    pub origin: [f64; 3],
    /// Largest extent as drawn, m.
    pub size: f64,
    /// Beams in file order.
    pub beams: Vec<BeamLook>,
    /// Bodies in file order.
    pub bodies: Vec<BodyLook>,
    /// Names of the moving frames.
    pub frames: Vec<String>,
    /// Joints in file order.
    pub joints: Vec<JointLook>,
    /// Names of the springs between two points.
    pub springs: Vec<String>,
    /// Loads in file order.
    pub loads: Vec<LoadLook>,
    /// Names of the outputs that look at a point.
    pub points: Vec<String>,
    /// Surfaces in file order.
    pub surfaces: Vec<SurfaceLook>,
    /// Ropes in file order.
    pub ropes: Vec<RopeLook>,
    /// The water; none: the mechanism is dry.
    pub water: Option<WaterLook>,
}

/// A surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceLook {
    /// Its name.
    pub name: String,
    /// Its polygons.
    pub mesh: Mesh,
    /// Whether it is the bottom of the water.
    pub is_bottom: bool,
}

/// A rope.
#[derive(Clone, Debug, PartialEq)]
pub struct RopeLook {
    /// Its name.
    pub name: String,
    /// Its radius, m.
    pub radius: f64,
    /// Its points among those of all ropes.
    pub points: Range<usize>,
}

/// The water: whoever draws it computes its surface at any time.
#[derive(Clone, Debug, PartialEq)]
pub struct WaterLook {
    /// Height of still water above the scene's origin, m.
    pub surface: f64,
    /// The bottom; none: the water is without end.
    pub bottom: Option<BottomLook>,
    /// Time in which the waves grow, s.
    pub ramp: f64,
    /// Its waves, which travel as at the global origin.
    pub waves: Vec<Component>,
}

/// The bottom of the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BottomLook {
    /// Its height at the scene's origin, m.
    pub height: f64,
    /// Its rise per length along x and along y.
    pub slope: [f64; 2],
}

impl WaterLook {
    fn new(medium: &Medium) -> Self {
        let origin = Vec3::zeros();
        let bottom = medium.bottom(&origin).map(|height| BottomLook { height, slope: medium.slope });
        Self {
            surface: medium.surface - medium.origin.z,
            bottom,
            ramp: medium.ramp,
            waves: medium.waves.components.clone(),
        }
    }
}

/// A beam.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamLook {
    /// Its name.
    pub name: String,
    /// Its section.
    pub profile: Profile,
    /// How many times as large as `profile` sections are, along y and z, at each station; empty where all are alike.
    pub sizes: Vec<[f64; 2]>,
    /// Whether its stress is known: not of a section that is given by its integrals alone.
    pub has_stress: bool,
    /// Its stations among those of all beams.
    pub stations: Range<usize>,
    /// Fraction of its length at each station.
    pub fractions: Vec<f64>,
    /// Which stations are nodes, counted in the beam.
    pub nodes: Vec<usize>,
    /// Places of the stations as drawn, from the scene's origin, m.
    pub places: Vec<[f64; 3]>,
    /// Orientations of the stations as drawn, quaternions `w x y z`.
    pub turns: Vec<[f64; 4]>,
}

/// A body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyLook {
    /// Its name.
    pub name: String,
    /// Its mass, kg.
    pub mass: f64,
    /// What stands for it.
    pub solid: Solid,
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointLook {
    /// Its name.
    pub name: String,
    /// Its word in the file.
    pub kind: &'static str,
    /// Whether one side is the ground.
    pub is_grounded: bool,
    /// Whether it has an axis, the first one of its orientation.
    pub has_axis: bool,
}

/// A load.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadLook {
    /// Its name.
    pub name: String,
    /// Whether it is spread over a beam: per length.
    pub is_line: bool,
    /// Its arrows among those of all loads.
    pub arrows: Range<usize>,
}

/// A load along a beam is shown by at most so many arrows.
const LINE_ARROWS: usize = 9;

/// What is looked at at each instant, in the order of the scene.
#[derive(Clone, Debug)]
pub(super) struct Watched {
    /// Of each beam.
    pub beams: Vec<Stations>,
    /// The joints that have a place: number in the file and both sides.
    pub joints: Vec<(usize, [Marker; 2])>,
    /// The springs between two points.
    pub springs: Vec<[Marker; 2]>,
    /// The arrows of loads: number of the load and where.
    pub arrows: Vec<(usize, Marker)>,
    /// The sensors of outputs at points.
    pub points: Vec<usize>,
    /// The surfaces, x along their normal or axis.
    pub surfaces: Vec<Marker>,
}

impl Watched {
    pub(super) fn new(document: &Document, system: &System, c: &Configuration, beams: Vec<Stations>) -> Self {
        let joints = system.joint_parts.iter().enumerate().filter_map(|(number, parts)| {
            let sides_of = |coordinate: usize| {
                [system.relative_coordinates[coordinate].a, system.relative_coordinates[coordinate].b]
            };
            let conditions = parts.joint.map(|joint| {
                let joint = &system.joints[joint];
                // A slide is drawn where it is.
                [if joint.slide.is_some() { joint.b } else { joint.a }, joint.b]
            });
            let springs = || parts.springs.first().map(|spring| sides_of(system.springs[*spring].coordinate));
            conditions.or_else(springs).map(|sides| (number, sides))
        });
        let springs = system.springs.iter().zip(&document.springs).filter(|(_, written)| written.ends().is_some());
        let springs = springs.map(|(spring, _)| {
            [system.relative_coordinates[spring.coordinate].a, system.relative_coordinates[spring.coordinate].b]
        });
        let arrows = system.loads.iter().enumerate().flat_map(|(number, load)| {
            let markers = load.markers(&system.mesh);
            // One of a moving load, which is looked up where it is.
            let arrows = if matches!(load.site, Site::Moving(_)) { 1 } else { LINE_ARROWS };
            let every = markers.len().div_ceil(arrows).max(1);
            markers.into_iter().skip(every / 2).step_by(every).map(move |marker| (number, marker))
        });
        let mut sensor = 0;
        let mut points = Vec::new();
        for output in &document.outputs {
            if matches!(output.target, Target::At(_)) {
                points.push(sensor);
            }
            sensor += output.sensors();
        }
        let surfaces = document.surfaces.iter().map(|surface| on(surface, document, system, c)).collect();
        Self { joints: joints.collect(), springs: springs.collect(), arrows: arrows.collect(), points, surfaces, beams }
    }
}

/// Where a surface is, fixed to its part as drawn: in the configuration `c`.
fn on(surface: &SurfaceSpec, document: &Document, system: &System, c: &Configuration) -> Marker {
    let part = match surface.on {
        Spot::Body(body) => system.bodies[body].marker(),
        Spot::Frame(frame) => Marker::Frame { frame, offset: Vec3::zeros(), axes: Mat3::identity() },
        Spot::Ground | Spot::Beam { .. } => {
            Marker::Ground(Pose { place: Vec3::zeros() - system.origin, ..Pose::default() })
        }
    };
    let axes = part.pose(c).axes.tr_mul(&surface.axes(&document.numbers));
    part.carried(&surface.offset(&document.numbers), &axes)
}

/// Sizes of the sections at `fractions` of a beam, over those at its start; none where all are alike.
fn sizes(beam: &Beam, fractions: &[f64]) -> Vec<[f64; 2]> {
    if beam.profile.is_none() {
        return Vec::new();
    }
    let start = Profile::new(&beam.section).size();
    let size = |fraction: &f64| Profile::new(&beam.section_at(*fraction)).size();
    fractions.iter().map(size).map(|size| [0, 1].map(|axis| size[axis] / start[axis])).collect()
}

impl Scene {
    pub(super) fn new(document: &Document, system: &System, watched: &Watched) -> Self {
        let beams = system.beams.iter().zip(&watched.beams).zip(ranges(&watched.beams));
        let beams = beams.map(|((beam, own), stations)| {
            let profile = Profile::new(&beam.section);
            let (places, turns) = own.drawn().unzip();
            BeamLook {
                name: beam.name.clone(),
                profile,
                sizes: sizes(beam, &own.fractions),
                has_stress: beam.section.outline.torsion_modulus().is_some(),
                stations,
                fractions: own.fractions.clone(),
                nodes: own.nodes.clone(),
                places,
                turns,
            }
        });
        let bodies = system.bodies.iter();
        let bodies = bodies.map(|body| BodyLook { name: body.name.clone(), mass: body.mass, solid: Solid::new(body) });
        let joints = watched.joints.iter().map(|(number, _)| {
            let written = &document.joints[*number];
            JointLook {
                name: written.name.clone(),
                kind: word(written.kind),
                is_grounded: [written.a, written.b].iter().any(|side| side.spot == Spot::Ground),
                has_axis: written.axis.is_some(),
            }
        });
        let loads = document.loads.iter().enumerate().map(|(number, written)| {
            let arrow = |place: usize| watched.arrows.get(place).is_some_and(|(load, _)| *load == number);
            let mut places = (0..watched.arrows.len()).filter(|place| arrow(*place));
            let begin = places.next().unwrap_or(0);
            let end = places.next_back().unwrap_or(begin) + 1;
            LoadLook {
                name: written.name.clone(),
                is_line: matches!(written.target, load::Target::On(_)),
                arrows: begin..end,
            }
        });
        let points = document.outputs.iter().filter(|output| matches!(output.target, Target::At(_)));
        let springs = document.springs.iter().filter(|spring| spring.ends().is_some());
        let surfaces = document.surfaces.iter().map(|surface| SurfaceLook {
            name: surface.name.clone(),
            mesh: surface.mesh(&document.numbers, system.size),
            is_bottom: matches!(surface.shape, Shape::Bottom { .. }),
        });
        let mut first = 0;
        let ropes = system.ropes.iter().zip(&document.ropes).map(|(rope, written)| {
            let points = first..first + rope_line::moving_points(rope);
            first = points.end;
            RopeLook { name: rope.name.clone(), radius: document.value(written.radius), points }
        });
        Self {
            name: document.model.name.clone(),
            description: document.model.description.clone(),
            is_dynamic: document.simulation.analysis == Analysis::Dynamic,
            gravity: system.gravity.into(),
            origin: system.global(Vec3::zeros()).into(),
            size: system.size,
            beams: beams.collect(),
            bodies: bodies.collect(),
            frames: document.frames.iter().map(|frame| frame.name.clone()).collect(),
            joints: joints.collect(),
            springs: springs.map(|spring| spring.name.clone()).collect(),
            loads: loads.collect(),
            points: points.map(|output| output.name.clone()).collect(),
            surfaces: surfaces.collect(),
            ropes: ropes.collect(),
            water: system.water().map(|water| WaterLook::new(&water.medium)),
        }
    }
}

fn word(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Weld => "weld",
        JointKind::Spherical => "spherical",
        JointKind::Revolute => "revolute",
        JointKind::Cylindrical => "cylindrical",
        JointKind::Prismatic => "prismatic",
        JointKind::Universal => "universal",
        JointKind::Inline => "inline",
        JointKind::Inplane => "inplane",
        JointKind::Slide => "slide",
        JointKind::Bushing => "bushing",
    }
}
