//! A mechanism as drawn: lines, points and arrows with names, for pictures.

use super::rope_line;
use crate::math::Vec3;
use crate::model::file::document::Document;
use crate::model::file::entries::actuator::Action;
use crate::model::file::entries::{load, output};
use crate::model::file::number::Number;
use crate::model::file::reader::anchor::{Anchor, Spot};
use crate::model::shape::Lines;
use crate::model::text::names::Kind;

/// Everything that a picture of a mechanism shows. Global axes, m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Beams, springs, ropes and rigid arms.
    pub lines: Vec<Line>,
    /// Bodies, frames, points, joints, drives, actuators and outputs.
    pub marks: Vec<Mark>,
    /// Loads, drives of distances, actuators between two points, and the axes of joints.
    pub arrows: Vec<Arrow>,
}

/// A line with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Name of the beam or spring; an arm has none.
    pub name: String,
    /// What it is.
    pub kind: LineKind,
    /// What it runs through, as straight pieces: where it is curved many of them.
    pub points: Vec<[f64; 3]>,
    /// The nodes of a beam.
    pub nodes: Vec<[f64; 3]>,
}

/// What a line stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineKind {
    /// A beam.
    Beam,
    /// A spring.
    Spring,
    /// A face of a surface; the first one of it has its name.
    Face,
    /// What is rigid between the place of a joint, or a point of the file, and the body, the frame or the place on a
    /// beam that it is tied to.
    Arm,
}

/// A point with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Name of the thing.
    pub name: String,
    /// What it is.
    pub kind: MarkKind,
    /// Where it is.
    pub at: [f64; 3],
}

/// What a mark stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkKind {
    /// A joint of which one side is the ground.
    Support,
    /// A joint between two things that move.
    Joint,
    /// The center of mass of a body.
    Body,
    /// A frame, as it is at t = 0.
    Frame,
    /// A point of the file.
    Point,
    /// A drive of an angle, at its joint.
    Drive,
    /// A position where something is measured.
    Output,
}

/// A direction with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// Name of the load, drive or joint.
    pub name: String,
    /// What it is.
    pub kind: ArrowKind,
    /// Where it acts.
    pub at: [f64; 3],
    /// Where it points; only the direction counts.
    pub direction: [f64; 3],
}

/// What an arrow stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArrowKind {
    /// A force at a point.
    Force,
    /// A moment at a point, by its axis.
    Moment,
    /// The axis of a joint.
    Axis,
    /// A drive of a distance, along the axis of its joint.
    Drive,
}

impl Drawing {
    /// The mechanism of a file; without what is too far away to be drawn.
    pub fn new(document: &Document) -> Self {
        let mut drawing = Self::complete(document);
        let is_near = |point: &[f64; 3]| point.iter().all(|value| value.abs() <= FARTHEST);
        drawing.lines.retain(|line| line.points.iter().chain(&line.nodes).all(is_near));
        drawing.marks.retain(|mark| is_near(&mark.at));
        drawing.arrows.retain(|arrow| is_near(&arrow.at) && arrow.direction.iter().all(|value| value.is_finite()));
        drawing
    }

    /// The mechanism of a file.
    fn complete(document: &Document) -> Self {
        let mut artist = Artist { document, lines: Lines::of(document), drawing: Self::default() };
        artist.draw_beams();
        artist.draw_points();
        artist.draw_springs();
        artist.draw_ropes();
        artist.draw_bodies_and_frames();
        artist.draw_joints();
        artist.draw_drives();
        artist.draw_actuators();
        artist.draw_loads();
        artist.draw_outputs();
        artist.draw_surfaces();
        artist.drawing
    }
}

/// Draws the mechanism of a file, kind after kind.
struct Artist<'a> {
    document: &'a Document,
    lines: Lines,
    drawing: Drawing,
}

impl Artist<'_> {
    fn point(&self, anchor: Anchor) -> Option<[f64; 3]> {
        self.lines.place(self.document, anchor).map(<[f64; 3]>::from)
    }

    /// The position of a joint, by its index.
    fn joint(&self, index: usize) -> Option<[f64; 3]> {
        let joint = self.document.joints.get(index)?;
        let at = joint.at.map(|at| self.document.vector(at));
        at.or_else(|| [joint.b, joint.a].into_iter().find_map(|side| self.point(side)))
    }

    fn mark(&mut self, name: &str, kind: MarkKind, at: Option<[f64; 3]>) {
        self.drawing.marks.extend(at.map(|at| Mark { name: name.to_owned(), kind, at }));
    }

    fn arrow(&mut self, name: &str, kind: ArrowKind, at: [f64; 3], direction: [f64; 3]) {
        self.drawing.arrows.push(Arrow { name: name.to_owned(), kind, at, direction });
    }

    fn line(&mut self, name: &str, kind: LineKind, points: Vec<[f64; 3]>, nodes: Vec<[f64; 3]>) {
        self.drawing.lines.push(Line { name: name.to_owned(), kind, points, nodes });
    }

    fn draw_beams(&mut self) {
        for (number, beam) in self.document.beams.iter().enumerate() {
            let Some(line) = self.lines.line(number) else { continue };
            let points = line.outline(BETWEEN_NODES).into_iter().map(<[f64; 3]>::from).collect();
            let nodes = line.nodes.iter().map(|node| node.place.into()).collect();
            self.line(&beam.name, LineKind::Beam, points, nodes);
        }
    }

    fn draw_points(&mut self) {
        for (number, written) in self.document.points.iter().enumerate() {
            let Some(at) = self.point(Anchor { point: Some(number), ..written.on }) else { continue };
            self.mark(&written.name, MarkKind::Point, Some(at));
            // The ground is everywhere.
            if let Some(from) = self.point(written.on).filter(|from| *from != at) {
                self.line("", LineKind::Arm, vec![from, at], Vec::new());
            }
        }
    }

    fn draw_springs(&mut self) {
        for (spring, ends) in self.document.springs.iter().filter_map(|spring| Some((spring, spring.ends()?))) {
            // A spring's ground is the origin.
            let points = ends.map(|end| self.point(end).unwrap_or([0.0; 3])).to_vec();
            self.line(&spring.name, LineKind::Spring, points, Vec::new());
        }
    }

    fn draw_ropes(&mut self) {
        for rope in &self.document.ropes {
            let points = rope_line::points(self.document, &self.lines, rope).unwrap_or_default();
            for (number, piece) in points.windows(2).enumerate() {
                let name = if number == 0 { &rope.name } else { "" };
                self.line(name, LineKind::Spring, piece.iter().map(|point| (*point).into()).collect(), Vec::new());
            }
        }
    }

    fn draw_bodies_and_frames(&mut self) {
        let document = self.document;
        for body in &document.bodies {
            self.mark(&body.name, MarkKind::Body, Some(document.vector(body.position)));
        }
        for frame in &document.frames {
            self.mark(&frame.name, MarkKind::Frame, Some(document.vector(frame.position)));
        }
    }

    fn draw_joints(&mut self) {
        for (index, joint) in self.document.joints.iter().enumerate() {
            let Some(at) = self.joint(index) else { continue };
            let grounded = joint.a.spot == Spot::Ground || joint.b.spot == Spot::Ground;
            let kind = if grounded { MarkKind::Support } else { MarkKind::Joint };
            self.mark(&joint.name, kind, Some(at));
            for end in [joint.a, joint.b].map(|side| self.point(side)).into_iter().flatten().filter(|end| *end != at) {
                self.line("", LineKind::Arm, vec![at, end], Vec::new());
            }
            for axis in [joint.axis, joint.axis2].into_iter().flatten() {
                self.arrow(&joint.name, ArrowKind::Axis, at, self.document.vector(axis));
            }
        }
    }

    /// Drives, and the locks of joints.
    fn draw_drives(&mut self) {
        for drive in &self.document.drives {
            let Some(at) = self.joint(drive.joint) else { continue };
            match self.document.joints[drive.joint].axis.filter(|_| !drive.is_angle()) {
                Some(axis) => self.arrow(&drive.name, ArrowKind::Drive, at, self.document.vector(axis)),
                None => self.mark(&drive.name, MarkKind::Drive, Some(at)),
            }
        }
        for lock in &self.document.locks {
            self.mark(&lock.name, MarkKind::Joint, self.joint(lock.joint));
        }
    }

    fn draw_actuators(&mut self) {
        for actuator in &self.document.actuators {
            match actuator.action {
                Action::Joint { joint, .. } => self.mark(&actuator.name, MarkKind::Drive, self.joint(joint)),
                Action::Between { a, b } => {
                    let Some((from, at)) = self.point(a).zip(self.point(b)) else { continue };
                    let direction = [0, 1, 2].map(|axis| at[axis] - from[axis]);
                    self.arrow(&actuator.name, ArrowKind::Drive, at, direction);
                }
            }
        }
    }

    /// Loads; one that begins at zero as it first acts.
    fn draw_loads(&mut self) {
        for load in &self.document.loads {
            let places = match load.target {
                load::Target::At(anchor) => self.point(anchor).into_iter().collect(),
                load::Target::Moving { beam, station } => {
                    let at = self.document.function(station).value(0.0).clamp(0.0, 1.0);
                    self.lines.line(beam).map(|line| line.place(at).into()).into_iter().collect()
                }
                load::Target::On(beam) => {
                    let line = self.lines.line(beam);
                    line.map_or(Vec::new(), |line| LINE_LOAD.map(|fraction| line.place(fraction).into()).to_vec())
                }
            };
            for (kind, numbers) in [(ArrowKind::Force, load.force), (ArrowKind::Moment, load.moment)] {
                let direction = direction(self.document, numbers);
                if direction == [0.0; 3] {
                    continue;
                }
                for (k, at) in places.iter().enumerate() {
                    self.arrow(if k == 0 { &load.name } else { "" }, kind, *at, direction);
                }
            }
        }
    }

    fn draw_surfaces(&mut self) {
        let document = self.document;
        let points = self.drawing.lines.iter().flat_map(|line| &line.points);
        let all = points.chain(self.drawing.marks.iter().map(|mark| &mark.at));
        let size = 2.0 * all.flatten().fold(0.0, |size: f64, value| size.max(value.abs()));
        for surface in &document.surfaces {
            let offset = surface.offset(&document.numbers);
            let Some(center) = self.lines.carried(document, surface.on, offset) else { continue };
            let axes = surface.axes(&document.numbers);
            let mesh = surface.mesh(&document.numbers, size);
            let corner = |corner: &usize| (center + axes * Vec3::from(mesh.corners[*corner])).into();
            for (number, face) in mesh.faces.iter().enumerate() {
                let name = if number == 0 { &surface.name } else { "" };
                self.line(name, LineKind::Face, face.iter().chain(face.first()).map(corner).collect(), Vec::new());
            }
        }
    }

    fn draw_outputs(&mut self) {
        let document = self.document;
        let acting: Vec<_> = document.acting().collect();
        for output in &document.outputs {
            let at = match output.target {
                output::Target::At(anchor) => self.point(anchor),
                output::Target::Connection(Kind::Joint, number) => self.joint(number),
                output::Target::Connection(kind, number) => {
                    let found = acting.iter().find(|own| (own.kind, own.index) == (kind, number));
                    found.and_then(|own| match own.action {
                        Action::Joint { joint, .. } => self.joint(joint),
                        Action::Between { b, .. } => self.point(b),
                    })
                }
                output::Target::Whole(Kind::Body, number) => {
                    document.bodies.get(number).map(|body| document.vector(body.position))
                }
                // The whole beam: its name stands at the middle.
                output::Target::On { beam, .. } | output::Target::Whole(_, beam) => {
                    self.lines.line(beam).map(|line| line.place(0.5).into())
                }
            };
            self.mark(&output.name, MarkKind::Output, at);
        }
    }
}

/// Points of a curved element between its nodes.
const BETWEEN_NODES: usize = 7;
/// Fractions of a beam at which a load along it is drawn.
const LINE_LOAD: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// A position farther away than this, m, is a slip of the pen: squares of it must not overflow.
const FARTHEST: f64 = 1e100;
/// Instants at which it is asked whether a load acts.
const INSTANTS: u32 = 1000;
/// A load this small, of its largest value, does not act: it may be the round-off of nothing.
const ROUND_OFF: f64 = 1e-9;

/// A load as it first acts; zero if it never does.
fn direction(document: &Document, numbers: [Number; 3]) -> [f64; 3] {
    let functions = numbers.map(|number| document.function(number));
    let stop = document.value(document.simulation.stop);
    let values = || {
        let times = (0..=INSTANTS).map(|k| stop * f64::from(k) / f64::from(INSTANTS));
        let values = times.map(|time| functions.each_ref().map(|function| function.value(time)));
        values.filter(|value| value.iter().all(|value| value.is_finite()))
    };
    let size = |value: &[f64; 3]| value.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
    let largest = values().map(|value| size(&value)).fold(0.0, f64::max);
    values().find(|value| size(value) > ROUND_OFF * largest).unwrap_or_default()
}
