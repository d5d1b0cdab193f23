//! Joints between places that do not meet: the distance becomes a rigid arm.

use super::Note;
use crate::math::Vec3;
use crate::model::file::document::Document;
use crate::model::file::entries::body::{BodySpec, Inertia};
use crate::model::file::entries::joint::{JointKind, JointSpec};
use crate::model::file::reader::anchor::{Along, Anchor, Spot};
use crate::model::shape::{Lines, shown};

/// Distance over the size of the mechanism from which places do not meet: positions that are written with six digits
/// do.
const APART: f64 = 1e-6;
/// Distance from the center of mass, over the largest radius of gyration, within which a joint is on its body: the tip
/// of a slender cone, the farthest point of a common solid, is at 3.9.
const ON_BODY: f64 = 4.0;

/// Names joints without `at` whose sides are apart.
pub fn silent_arms(document: &Document, lines: &Lines) -> Vec<Note> {
    let size = size(document, lines);
    document.joints.iter().filter_map(|joint| silent_arm(document, lines, joint, size)).collect()
}

fn silent_arm(document: &Document, lines: &Lines, joint: &JointSpec, size: f64) -> Option<Note> {
    if joint.at.is_some() {
        return None;
    }
    let [a, b] = [lines.place(document, joint.a)?, lines.place(document, joint.b)?];
    let way = a - b;
    let axis = joint.axis.map(|axis| Vec3::from(document.vector(axis)).normalize());
    let gap = match (joint.kind, axis) {
        // What slides may be anywhere along its way.
        (JointKind::Prismatic | JointKind::Cylindrical | JointKind::Inline, Some(axis)) => way - axis * axis.dot(&way),
        (JointKind::Inplane, Some(normal)) => normal * normal.dot(&way),
        _ => way,
    };
    let length = gap.norm();
    if length.is_nan() || length <= APART * size {
        return None;
    }
    // The joint is at b, and the arm on a. A weld is the same for both.
    let reaches = |side: Anchor| body(document, side).is_some_and(|body| length <= ON_BODY * gyration(document, body));
    if reaches(joint.a) || matches!(joint.kind, JointKind::Weld | JointKind::Slide) && reaches(joint.b) {
        return None;
    }
    if [joint.a, joint.b].into_iter().any(|side| is_platform(document, lines, side, APART * size)) {
        return None;
    }
    let place = |place: Vec3| format!("[{}, {}, {}]", shown(place[0]), shown(place[1]), shown(place[2]));
    let [first, second] = [joint.a, joint.b].map(|side| name(document, side));
    if joint.kind == JointKind::Slide {
        let text = format!(
            "joint {} slides on {first}, which is drawn at [{}, {}, {}], and {second} is drawn at {}. The \
             distance, {} m, becomes a rigid arm on {second}. Draw {second} there. \
             If the arm is meant, put a [point.NAME] on {second} where it slides, and take that as b",
            joint.name,
            a[0],
            a[1],
            a[2],
            place(b),
            shown(length)
        );
        return Some(Note { place: joint.place, text });
    }
    let text = format!(
        "joint {} joins places that do not meet: {first} is drawn at {}, and {second} at {}. The distance, {} m, becomes a rigid arm on {first}. Draw the parts so that \
         they meet. If the arm is meant, say where the joint is: at = {}",
        joint.name,
        place(a),
        place(b),
        shown(length),
        place(b)
    );
    Some(Note { place: joint.place, text })
}

/// The body that an anchor is, by its center of mass.
fn body(document: &Document, side: Anchor) -> Option<&BodySpec> {
    match (side.spot, side.point) {
        (Spot::Body(body), None) => document.bodies.get(body),
        _ => None,
    }
}

/// Whether an anchor is a frame that holds things at several places: it is a platform, and reaches all of them.
fn is_platform(document: &Document, lines: &Lines, side: Anchor, apart: f64) -> bool {
    let (Spot::Frame(_), None) = (side.spot, side.point) else { return false };
    let held = |joint: &JointSpec| {
        let is_it = |anchor: Anchor| anchor.spot == side.spot && anchor.point.is_none();
        let other = match (is_it(joint.a), is_it(joint.b)) {
            (true, false) => joint.b,
            (false, true) => joint.a,
            _ => return None,
        };
        lines.place(document, other)
    };
    let mut places = document.joints.iter().filter_map(held);
    places.next().is_some_and(|first| places.any(|place| (place - first).norm() > apart))
}

/// The largest radius of gyration of a body, m.
fn gyration(document: &Document, body: &BodySpec) -> f64 {
    let diagonal = match body.inertia {
        Inertia::Principal(numbers) => numbers,
        Inertia::Tensor([xx, yy, zz, ..]) => [xx, yy, zz],
    };
    let largest = diagonal.into_iter().map(|number| document.value(number)).fold(0.0, f64::max);
    (largest / document.value(body.mass)).sqrt()
}

/// The extent of the mechanism as drawn, m.
fn size(document: &Document, lines: &Lines) -> f64 {
    let nodes = (0..document.beams.len()).filter_map(|beam| lines.line(beam)).flat_map(|line| &line.nodes);
    let bodies = document.bodies.iter().map(|body| Vec3::from(document.vector(body.position)));
    let frames = document.frames.iter().map(|frame| Vec3::from(document.vector(frame.position)));
    let places = nodes.map(|node| node.place).chain(bodies).chain(frames);
    let nowhere = [Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)];
    let [low, high] = places.fold(nowhere, |[low, high], place| [low.inf(&place), high.sup(&place)]);
    (high - low).norm()
}

/// `arm.end`, as the file names it.
fn name(document: &Document, side: Anchor) -> String {
    if let Some(point) = side.point.and_then(|point| document.points.get(point)) {
        return point.name.clone();
    }
    let of_beam = |beam: usize, behind: &str| format!("{}{behind}", document.beams[beam].name);
    match side.spot {
        Spot::Ground => String::from("ground"),
        Spot::Beam { beam, along: Along::Start } => of_beam(beam, ".start"),
        Spot::Beam { beam, along: Along::End } => of_beam(beam, ".end"),
        Spot::Beam { beam, along: Along::Fraction(number) } => of_beam(beam, &format!("@{}", document.value(number))),
        Spot::Beam { beam, along: Along::Node(node) } => of_beam(beam, &format!(".node[{node}]")),
        Spot::Body(body) => document.bodies[body].name.clone(),
        Spot::Frame(frame) => document.frames[frame].name.clone(),
    }
}
