//! `[surface.NAME]`: a rigid surface that is fixed to the ground, a body or a frame. Beams touch it where a
//! `[contact.NAME]` says so.

use super::Parts;
use crate::math::elementary::sin_cos;
use crate::math::rotation::{triad_along, triad_of};
use crate::math::{Mat3, Vec3};
use crate::model::file::number::{Number, Numbers};
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::{Allowed, Anchor, Spot};
use crate::model::file::schema::{Key, PLACES, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;
use std::f64::consts::{PI, TAU};

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("on", Role::Name(PLACES), "the body or frame that it is fixed to, or the ground, by default"),
    Key::word("shape", &words_of(&SHAPES), "the shape"),
    Key::global(&[&OFFSET], Role::Offset),
    Key::global(&[&NORMAL], Role::Direction),
    Key::global(&[&AXIS], Role::Direction),
    Key::number(&[&RADIUS]),
    Key::number(&[&LENGTH, &CONE_LENGTH]),
    Key::number(&[&GROOVE]),
    Key::number(&[&WIRE]),
    Key::list(&[&SIZE], "3"),
    Key::global(&[&EDGES], Role::Axes),
    Key::number(&[&END_RADIUS]),
    Key::flag("inside", "true: beams touch the cylinder or the sphere from inside"),
];

const OFFSET: Rule = Rule::new(
    "offset",
    "point of the plane, center of the sphere, middle of any other shape, in the axes of what it is on",
    "m",
);
const NORMAL: Rule = Rule::new("normal", "normal of the plane as drawn, global, towards what may touch it", "");
const AXIS: Rule = Rule::new(
    "axis",
    "axis of the cylinder, sheave, ring or cone as drawn, global; of a cone from `radius` to `end_radius`",
    "",
);
const RADIUS: Rule = Rule::new(
    "radius",
    "radius of the surface; of a sheave to the bottom of its groove, of a ring to the middle of its wire, of a cone at \
     the start of its axis",
    "m",
)
.above(0.0);
const LENGTH: Rule =
    Rule::new("length", "length of the cylinder; without it, the cylinder has no ends", "m").above(0.0);
const CONE_LENGTH: Rule = Rule::new("length", "length of the cone along its axis", "m").above(0.0);
const WIRE: Rule = Rule::new("wire", "radius of the wire of a ring, less than that of the ring", "m").above(0.0);
const SIZE: Rule = Rule::new("size", "extents of the box along its edges", "m").above(0.0);
const EDGES: Rule =
    Rule::new("edges", "directions of the edges of the box as drawn, global, one per row; by default the axes", "");
const END_RADIUS: Rule = Rule::new("end_radius", "radius of the cone at the end of its axis; 0: a tip", "m").from(0.0);
const GROOVE: Rule =
    Rule::new("groove", "radius of the groove of a sheave, in a section along its axis", "m").above(0.0);

/// A section `[surface.NAME]`.
#[derive(Clone, Debug)]
pub struct SurfaceSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The ground, a body or a frame.
    pub on: Spot,
    /// A point of the plane, the center of the sphere, the middle of any other shape: relative to `on`, in the axes of
    /// that, m; none: of the bottom.
    pub offset: Option<[Number; 3]>,
    /// The shape.
    pub shape: Shape,
}

/// A shape of a surface; directions are global, as drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A plane with this normal.
    Plane([Number; 3]),
    /// The outside of a cylinder, or its inside.
    Cylinder {
        /// Its direction.
        axis: [Number; 3],
        /// m.
        radius: Number,
        /// Half to each side of the middle, m; none: it has no ends.
        length: Option<Number>,
        /// Beams touch it from inside.
        inside: bool,
    },
    /// The outside of a sphere, or its inside.
    Sphere {
        /// m.
        radius: Number,
        /// Beams touch it from inside.
        inside: bool,
    },
    /// A wheel with a round groove in its rim.
    Sheave {
        /// Its direction.
        axis: [Number; 3],
        /// Radius to the bottom of the groove, m.
        radius: Number,
        /// Radius of the groove, m.
        groove: Number,
    },
    /// A wire that is bent to a circle.
    Ring {
        /// The direction of its axis.
        axis: [Number; 3],
        /// Radius to the middle of the wire, m.
        radius: Number,
        /// Radius of the wire, m.
        wire: Number,
    },
    /// A box.
    Box {
        /// Its extents, m.
        size: [Number; 3],
        /// Their directions, one per row; none: the global axes.
        edges: Option<[[Number; 3]; 3]>,
    },
    /// A cone with flat ends, or with a tip.
    Cone {
        /// Its direction.
        axis: [Number; 3],
        /// Radii at its start and at its end, m.
        radii: [Number; 2],
        /// m.
        length: Number,
    },
    /// The bottom of the water, below the origin at a depth.
    Bottom {
        /// Height of the still water, m.
        surface: Number,
        /// m.
        depth: Number,
        /// Rise per length along x and y.
        slope: [Number; 2],
    },
}

impl Shape {
    /// The radius of what ropes and belts run around; none: they run around no such shape.
    pub fn winding_radius(&self) -> Option<Number> {
        match *self {
            Self::Cylinder { radius, inside: false, .. } | Self::Sheave { radius, .. } => Some(radius),
            _ => None,
        }
    }

    /// The radius around which beams bend that touch it, m; none: it is flat, or they do not. That of a ring is the
    /// radius of its wire, that of a cone the radius in its middle.
    pub fn bending_radius(&self, value: impl Fn(Number) -> f64) -> Option<f64> {
        match *self {
            Self::Ring { wire, .. } => Some(value(wire)),
            Self::Cone { radii: [start, end], .. } => Some(0.5 * (value(start) + value(end))),
            _ => self.winding_radius().map(value),
        }
    }
}

#[derive(Clone, Copy)]
enum Word {
    Plane,
    Cylinder,
    Sphere,
    Sheave,
    Ring,
    Box,
    Cone,
}

impl Shape {
    fn read(word: Word, reader: &mut Reader<'_, '_>) -> Self {
        match word {
            Word::Plane => Self::Plane(reader.vector(&NORMAL)),
            Word::Cylinder => {
                let (axis, radius) = (reader.vector(&AXIS), reader.number(&RADIUS));
                let (length, inside) = (reader.optional(&LENGTH), reader.boolean("inside", false));
                Self::Cylinder { axis, radius, length, inside }
            }
            Word::Sphere => Self::Sphere { radius: reader.number(&RADIUS), inside: reader.boolean("inside", false) },
            Word::Sheave => {
                let axis = reader.vector(&AXIS);
                Self::Sheave { axis, radius: reader.number(&RADIUS), groove: reader.number(&GROOVE) }
            }
            Word::Ring => {
                let axis = reader.vector(&AXIS);
                Self::Ring { axis, radius: reader.number(&RADIUS), wire: reader.number(&WIRE) }
            }
            Word::Box => Self::Box { size: reader.vector(&SIZE), edges: reader.table(&EDGES) },
            Word::Cone => {
                let axis = reader.vector(&AXIS);
                let radii = [reader.number(&RADIUS), reader.number(&END_RADIUS)];
                Self::Cone { axis, radii, length: reader.number(&CONE_LENGTH) }
            }
        }
    }
}

const SHAPES: [(&str, Word); 7] = [
    ("plane", Word::Plane),
    ("cylinder", Word::Cylinder),
    ("sphere", Word::Sphere),
    ("sheave", Word::Sheave),
    ("ring", Word::Ring),
    ("box", Word::Box),
    ("cone", Word::Cone),
];

/// Parts that a surface can be fixed to.
const CARRIERS: Allowed = Allowed { kinds: &[Kind::Body, Kind::Frame], ground: true, forms: "ground, BODY or FRAME" };

impl SurfaceSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let place = reader.place;
        let on = match reader.has("on") {
            true => Anchor::read(&mut reader, "on", &CARRIERS).map(|anchor| anchor.spot),
            false => Some(Spot::Ground),
        };
        let word = reader.word("shape", &SHAPES, None);
        let offset = Some(reader.vector_or(&OFFSET, [0.0; 3]));
        // Without the shape nobody knows which keys belong here.
        let Some(word) = word else {
            reader.abandon();
            return None;
        };
        let shape = Shape::read(word, &mut reader);
        reader.finish();
        Some(Self { name: name.to_owned(), place, on: on?, offset, shape })
    }

    /// Its axes as drawn, global: the first one is along its normal or axis.
    pub fn axes(&self, numbers: &Numbers) -> Mat3 {
        if let Shape::Bottom { slope, .. } = self.shape {
            let [along_x, along_y] = slope.map(|number| numbers.value(number));
            return triad_along(&Vec3::new(-along_x, -along_y, 1.0));
        }
        let vector = |direction: [Number; 3]| Vec3::from(direction.map(|number| numbers.value(number)));
        if let Shape::Box { edges: Some(rows), .. } = self.shape {
            let [first, second, _] = rows.map(vector);
            return triad_of(&first, &second);
        }
        self.direction().map_or_else(Mat3::identity, |direction| triad_along(&vector(direction)))
    }

    /// The direction of its normal or axis, global, as drawn; of a sphere and a box none.
    fn direction(&self) -> Option<[Number; 3]> {
        match self.shape {
            Shape::Plane(direction)
            | Shape::Cylinder { axis: direction, .. }
            | Shape::Sheave { axis: direction, .. }
            | Shape::Ring { axis: direction, .. }
            | Shape::Cone { axis: direction, .. } => Some(direction),
            Shape::Sphere { .. } | Shape::Box { .. } | Shape::Bottom { .. } => None,
        }
    }

    /// Its position relative to what it is on, in the axes of that, m.
    pub fn offset(&self, numbers: &Numbers) -> Vec3 {
        let value = |number: Number| numbers.value(number);
        match (self.shape, self.offset) {
            (Shape::Bottom { surface, depth, .. }, _) => Vec3::new(0.0, 0.0, value(surface) - value(depth)),
            (_, Some(offset)) => Vec3::from(offset.map(value)),
            (_, None) => Vec3::zeros(),
        }
    }

    /// A normal or an axis without a direction, a ring without a hole.
    pub(super) fn objection(&self, value: impl Fn(Number) -> f64) -> Option<(Number, String)> {
        if let Shape::Ring { radius, wire, .. } = self.shape
            && value(wire) >= value(radius)
        {
            let text = format!("must be less than `radius`, which is {} m: the ring has no hole", value(radius));
            return Some((wire, text));
        }
        let direction = self.direction()?;
        let is_zero = direction.iter().all(|number| value(*number) == 0.0);
        is_zero.then(|| (direction[0], String::from("must have a direction: one of its components must not be 0")))
    }
}

/// A surface as flat polygons in its own axes, m: x is along its normal or its axis, and the corners of a face run
/// anticlockwise as seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners.
    pub corners: Vec<[f64; 3]>,
    /// The corners of each face.
    pub faces: Vec<Vec<usize>>,
}

/// Sides of what is round: enough for the eye.
const SIDES: usize = 24;
/// Rings of a sphere from pole to pole.
const RINGS: usize = 13;

impl SurfaceSpec {
    /// The surface for pictures; what has no ends is as large as `size`, m.
    pub fn mesh(&self, numbers: &Numbers, size: f64) -> Mesh {
        let value = |number: Number| numbers.value(number);
        match self.shape {
            Shape::Plane(_) | Shape::Bottom { .. } => {
                let half = 0.5 * size;
                let corners = vec![[0.0, -half, -half], [0.0, half, -half], [0.0, half, half], [0.0, -half, half]];
                Mesh { corners, faces: vec![vec![0, 1, 2, 3]] }
            }
            Shape::Cylinder { radius, length, .. } => {
                let half = 0.5 * length.map_or(size, value);
                rings([-half, half].map(|x| [x, value(radius)]))
            }
            Shape::Sphere { radius, .. } => rings((0..RINGS).map(|ring| {
                let (sine, cosine) = sin_cos(PI * ring as f64 / (RINGS - 1) as f64);
                [-cosine, sine].map(|part| part * value(radius))
            })),
            Shape::Sheave { radius, groove, .. } => {
                let (radius, groove) = (value(radius), value(groove));
                rings((0..RINGS).map(|ring| {
                    let (sine, cosine) = sin_cos(PI * ring as f64 / (RINGS - 1) as f64);
                    [-cosine * groove, radius + groove * (1.0 - sine)]
                }))
            }
            Shape::Ring { radius, wire, .. } => rings((0..=SIDES).map(|ring| {
                let (sine, cosine) = sin_cos(TAU * ring as f64 / SIDES as f64);
                [sine * value(wire), value(radius) + cosine * value(wire)]
            })),
            Shape::Box { size, .. } => block(size.map(|number| 0.5 * value(number))),
            Shape::Cone { radii, length, .. } => {
                let (half, [start, end]) = (0.5 * value(length), radii.map(value));
                rings([[-half, 0.0], [-half, start], [half, end], [half, 0.0]])
            }
        }
    }
}

/// A box that reaches as far as `half` from its middle.
fn block(half: [f64; 3]) -> Mesh {
    let corner = |number: usize| [0, 1, 2].map(|axis| if number >> axis & 1 == 1 { half[axis] } else { -half[axis] });
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    Mesh { corners: (0..8).map(corner).collect(), faces: faces.map(Vec::from).to_vec() }
}

/// The surface through rings about x, of which each has its position along x and its radius.
fn rings(rings: impl IntoIterator<Item = [f64; 2]>) -> Mesh {
    let mut mesh = Mesh::default();
    for [x, radius] in rings {
        let first = mesh.corners.len();
        for side in 0..SIDES {
            let (sine, cosine) = sin_cos(TAU * side as f64 / SIDES as f64);
            mesh.corners.push([x, radius * cosine, radius * sine]);
            if let Some(before) = first.checked_sub(SIDES) {
                let next = (side + 1) % SIDES;
                mesh.faces.push(vec![before + side, before + next, first + next, first + side]);
            }
        }
    }
    mesh
}
