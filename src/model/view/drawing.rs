//! A mechanism as drawn: lines, points and arrows with names, for pictures.

use crate::model::file::document::Document;
use crate::model::file::entries::actuator::Action;
use crate::model::file::entries::joint::JointSpec;
use crate::model::file::entries::{load, output};
use crate::model::file::number::Number;
use crate::model::file::reader::anchor::{Anchor, Spot};
use crate::model::shape::Lines;
use crate::model::text::names::Kind;

/// Everything that a picture of a mechanism shows. Global axes, m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Beams, springs and rigid arms.
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
    /// What is rigid between the place of a joint, or a point of the file, and the body, the frame or the place on a beam that it is tied to.
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
    /// A place where something is measured.
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

    /// The mechanism of a file. A load that begins at zero is drawn as it first acts.
    fn complete(document: &Document) -> Self {
        let mut drawing = Self::default();
        let lines = Lines::of(document);
        let point = |anchor: Anchor| lines.place(document, anchor).map(<[f64; 3]>::from);
        for (number, beam) in document.beams.iter().enumerate() {
            let Some(line) = lines.line(number) else { continue };
            let points = line.outline(BETWEEN_NODES).into_iter().map(<[f64; 3]>::from).collect();
            let nodes = line.nodes.iter().map(|node| node.place.into()).collect();
            drawing.lines.push(Line { name: beam.name.clone(), kind: LineKind::Beam, points, nodes });
        }
        for (number, written) in document.points.iter().enumerate() {
            let Anchor { place, spot, .. } = written.on;
            let Some(at) = point(Anchor { place, spot, point: Some(number) }) else { continue };
            drawing.marks.push(Mark { name: written.name.clone(), kind: MarkKind::Point, at });
            // The ground is everywhere.
            if let Some(from) = point(written.on).filter(|from| *from != at) {
                let line = Line { name: String::new(), kind: LineKind::Arm, points: vec![from, at], nodes: Vec::new() };
                drawing.lines.push(line);
            }
        }
        for (spring, ends) in document.springs.iter().filter_map(|spring| Some((spring, spring.ends()?))) {
            // A spring's ground is the origin.
            let points = ends.map(|end| point(end).unwrap_or([0.0; 3])).to_vec();
            drawing.lines.push(Line { name: spring.name.clone(), kind: LineKind::Spring, points, nodes: Vec::new() });
        }
        for body in &document.bodies {
            let at = document.vector(body.position);
            drawing.marks.push(Mark { name: body.name.clone(), kind: MarkKind::Body, at });
        }
        for frame in &document.frames {
            let at = document.vector(frame.position);
            drawing.marks.push(Mark { name: frame.name.clone(), kind: MarkKind::Frame, at });
        }
        for joint in &document.joints {
            let Some(at) = place(document, &lines, joint) else { continue };
            let grounded = joint.a.spot == Spot::Ground || joint.b.spot == Spot::Ground;
            let kind = if grounded { MarkKind::Support } else { MarkKind::Joint };
            drawing.marks.push(Mark { name: joint.name.clone(), kind, at });
            for end in [joint.a, joint.b].into_iter().filter_map(point).filter(|end| *end != at) {
                let line = Line { name: String::new(), kind: LineKind::Arm, points: vec![at, end], nodes: Vec::new() };
                drawing.lines.push(line);
            }
            for axis in [joint.axis, joint.axis2].into_iter().flatten() {
                let direction = document.vector(axis);
                drawing.arrows.push(Arrow { name: joint.name.clone(), kind: ArrowKind::Axis, at, direction });
            }
        }
        for drive in &document.drives {
            let Some(joint) = document.joints.get(drive.joint) else { continue };
            let Some(at) = place(document, &lines, joint) else { continue };
            let name = drive.name.clone();
            match joint.axis.filter(|_| !drive.is_angle()) {
                Some(axis) => {
                    let direction = document.vector(axis);
                    drawing.arrows.push(Arrow { name, kind: ArrowKind::Drive, at, direction });
                }
                None => drawing.marks.push(Mark { name, kind: MarkKind::Drive, at }),
            }
        }
        for lock in &document.locks {
            let at = document.joints.get(lock.joint).and_then(|joint| place(document, &lines, joint));
            drawing.marks.extend(at.map(|at| Mark { name: lock.name.clone(), kind: MarkKind::Joint, at }));
        }
        for actuator in &document.actuators {
            let name = actuator.name.clone();
            match &actuator.action {
                Action::Joint { joint, .. } => {
                    let at = document.joints.get(*joint).and_then(|joint| place(document, &lines, joint));
                    drawing.marks.extend(at.map(|at| Mark { name, kind: MarkKind::Drive, at }));
                }
                Action::Between { a, b } => {
                    let Some((from, at)) = point(*a).zip(point(*b)) else { continue };
                    let direction = [0, 1, 2].map(|axis| at[axis] - from[axis]);
                    drawing.arrows.push(Arrow { name, kind: ArrowKind::Drive, at, direction });
                }
            }
        }
        for load in &document.loads {
            let places = match load.target {
                load::Target::At(anchor) => point(anchor).into_iter().collect(),
                load::Target::On(beam) => {
                    let line = lines.line(beam);
                    line.map_or(Vec::new(), |line| LINE_LOAD.map(|fraction| line.place(fraction).into()).to_vec())
                }
            };
            for (kind, numbers) in [(ArrowKind::Force, load.force), (ArrowKind::Moment, load.moment)] {
                let direction = direction(document, numbers);
                if direction == [0.0; 3] {
                    continue;
                }
                for (k, at) in places.iter().enumerate() {
                    let name = if k == 0 { load.name.clone() } else { String::new() };
                    drawing.arrows.push(Arrow { name, kind, at: *at, direction });
                }
            }
        }
        for output in &document.outputs {
            let joint = |joint: usize| document.joints.get(joint).and_then(|joint| place(document, &lines, joint));
            let acting = |action: Action| match action {
                Action::Joint { joint: number, .. } => joint(number),
                Action::Between { b, .. } => point(b),
            };
            let at = match output.target {
                output::Target::At(anchor) => point(anchor),
                output::Target::Connection(Kind::Joint, number) => joint(number),
                output::Target::Connection(kind, number) => {
                    let mut all = document.acting();
                    all.find(|own| (own.kind, own.index) == (kind, number)).and_then(|own| acting(own.action))
                }
                output::Target::Whole(Kind::Body, number) => {
                    document.bodies.get(number).map(|body| document.vector(body.position))
                }
                // The whole beam: its name stands at the middle.
                output::Target::On { beam, .. } | output::Target::Whole(_, beam) => {
                    lines.line(beam).map(|line| line.place(0.5).into())
                }
            };
            drawing.marks.extend(at.map(|at| Mark { name: output.name.clone(), kind: MarkKind::Output, at }));
        }
        drawing
    }
}

/// Points of a curved element between its nodes.
const BETWEEN_NODES: usize = 7;
/// Fractions of a beam at which a load along it is drawn.
const LINE_LOAD: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];

/// A place farther away than this, m, is a slip of the pen: squares of it must not overflow.
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

/// Where a joint is as drawn.
fn place(document: &Document, lines: &Lines, joint: &JointSpec) -> Option<[f64; 3]> {
    let at = joint.at.map(|at| document.vector(at));
    at.or_else(|| [joint.b, joint.a].into_iter().find_map(|side| lines.place(document, side)).map(<[f64; 3]>::from))
}
