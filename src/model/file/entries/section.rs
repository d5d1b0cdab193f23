//! `[section.NAME]`: a cross-section, as a shape, as integrals, as a shape with some integrals given, or as rigidities;
//! any number may vary along the beam.

use super::Parts;
use super::damping::{DAMPING_FREQUENCIES, DAMPING_RATIOS, Damping, MASS_DAMPING, MATERIAL_DAMPING};
use super::immersion::{ADDED_MASS, CONTENTS_DENSITY, DRAG, DRAG_AREA_WORDS, Immersion, OUTER_DIAMETER};
use super::material::EXPANSION;
use crate::model::expression::function::Function;
use crate::model::file::number::{Number, Numbers};
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Rule, words_of};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::word("shape", &words_of(&SHAPES), "the outline; without one, integrals or rigidities"),
    Key::number(&[&WIDTH]),
    Key::number(&[&HEIGHT]),
    Key::number(&[&RADIUS]),
    Key::number(&[&INNER]),
    Key::number(&[&OUTER]),
    Key::number(&[&AREA]),
    Key::number(&[&SECOND_MOMENT_Y]),
    Key::number(&[&SECOND_MOMENT_Z]),
    Key::number(&[&TORSION_CONSTANT]),
    Key::number(&[&POLAR_MOMENT]),
    Key::list(&[&FOURTH_MOMENTS], "3"),
    Key::number(&[&PRODUCT_MOMENT]),
    Key::number(&[&WALL]),
    Key::number(&[&WEB]),
    Key::number(&[&FLANGE]),
    Key::number(&[&SECTION_TURN]),
    Key::number(&[&AXIAL_RIGIDITY]),
    Key::number(&[&BENDING_RIGIDITY_Y]),
    Key::number(&[&BENDING_RIGIDITY_Z]),
    Key::number(&[&BENDING_COUPLING]),
    Key::list(&[&TENSION_CENTER], "2"),
    Key::number(&[&TORSION_RIGIDITY]),
    Key::number(&[&LINE_DENSITY]),
    Key::number(&[&POLAR_INERTIA]),
    Key::number(&[&INERTIA_Y]),
    Key::number(&[&INERTIA_Z]),
    Key::number(&[&EXPANSION]),
    Key::number(&[&MATERIAL_DAMPING]),
    Key::number(&[&MASS_DAMPING]),
    Key::list(&[&DAMPING_RATIOS], "2"),
    Key::list(&[&DAMPING_FREQUENCIES], "2"),
    Key::number(&[&OUTER_DIAMETER]),
    Key::list(&[&DRAG], "2"),
    Key::word("drag_area", &DRAG_AREA_WORDS, "the area per length that the drag along the beam counts with"),
    Key::list(&[&ADDED_MASS], "2"),
    Key::number(&[&CONTENTS_DENSITY]),
];

const WIDTH: Rule = Rule::new("width", "width of the section along its y", "m").above(0.0).along_beam();
const HEIGHT: Rule = Rule::new("height", "height of the section along its z", "m").above(0.0).along_beam();
const RADIUS: Rule = Rule::new("radius", "radius of the section", "m").above(0.0).along_beam();
const INNER: Rule = Rule::new("inner", "inner radius of the section", "m").from(0.0).along_beam();
const OUTER: Rule = Rule::new("outer", "outer radius of the section", "m").above(0.0).along_beam();
const WALL: Rule = Rule::new("wall", "thickness of the walls of the section", "m").above(0.0).along_beam();
const WEB: Rule = Rule::new("web", "thickness of the web of the section", "m").above(0.0).along_beam();
const FLANGE: Rule = Rule::new("flange", "thickness of the flanges of the section", "m").above(0.0).along_beam();
const AREA: Rule = Rule::new("area", "area of the section", "m2").above(0.0).along_beam();
const SECOND_MOMENT_Y: Rule =
    Rule::new("second_moment_y", "second moment of area, integral of z^2", "m4").above(0.0).along_beam();
const SECOND_MOMENT_Z: Rule =
    Rule::new("second_moment_z", "second moment of area, integral of y^2", "m4").above(0.0).along_beam();
const TORSION_CONSTANT: Rule =
    Rule::new("torsion_constant", "Saint-Venant torsion constant", "m4").above(0.0).along_beam();
const PRODUCT_MOMENT: Rule = Rule::new("product_moment", "product of area, integral of y z", "m4").along_beam();
const POLAR_MOMENT: Rule = Rule::new("polar_moment", "polar second moment of area", "m4").above(0.0).along_beam();
const FOURTH_MOMENTS: Rule =
    Rule::new("fourth_moments", "fourth moment of area (yyyy, yyzz, zzzz)", "m6").from(0.0).along_beam();
const SECTION_TURN: Rule = Rule::new("turn", "turn of the section about the tangent", "rad").along_beam();
const AXIAL_RIGIDITY: Rule = Rule::new("EA", "axial rigidity", "N").above(0.0).along_beam();
const BENDING_RIGIDITY_Y: Rule = Rule::new("EI_y", "bending rigidity about y", "N.m2").from(0.0).along_beam();
const BENDING_RIGIDITY_Z: Rule = Rule::new("EI_z", "bending rigidity about z", "N.m2").from(0.0).along_beam();
const BENDING_COUPLING: Rule =
    Rule::new("EI_yz", "bending rigidity between y and z, integral of E y z", "N.m2").along_beam();
const TENSION_CENTER: Rule =
    Rule::new("tension_center", "tension center of the section along its y and z, from the axis of the beam", "m")
        .along_beam();
const TORSION_RIGIDITY: Rule = Rule::new("GJ", "torsion rigidity", "N.m2").from(0.0).along_beam();
const LINE_DENSITY: Rule = Rule::new("line_density", "mass per length", "kg/m").above(0.0).along_beam();
const POLAR_INERTIA: Rule =
    Rule::new("polar_inertia", "polar moment of inertia per length", "kg.m").above(0.0).along_beam();
const INERTIA_Y: Rule =
    Rule::new("inertia_y", "rotary inertia: moment of inertia per length about y", "kg.m").from(0.0).along_beam();
const INERTIA_Z: Rule =
    Rule::new("inertia_z", "rotary inertia: moment of inertia per length about z", "kg.m").from(0.0).along_beam();

/// A section `[section.NAME]`.
#[derive(Clone, Debug)]
pub struct SectionSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The outline.
    pub shape: Shape,
    /// Area, m²; always there for a general section, as the next three are.
    pub area: Option<Number>,
    /// `∫ z² dA`, m⁴.
    pub second_moment_y: Option<Number>,
    /// `∫ y² dA`, m⁴.
    pub second_moment_z: Option<Number>,
    /// Saint-Venant's torsion constant, m⁴.
    pub torsion_constant: Option<Number>,
    /// `∫ y z dA`, m⁴; default: of the shape, 0 for a general section.
    pub product_moment: Option<Number>,
    /// `∫ (y² + z²) dA` for spin inertia and Wagner term, m⁴; default: the sum of the second moments.
    pub polar_moment: Option<Number>,
    /// `∫ y⁴ dA`, `∫ y² z² dA`, `∫ z⁴ dA`, m⁶; default: of the shape; for a general section of a rectangle with the
    /// same area and second moments.
    pub fourth_moments: Option<[Number; 3]>,
    /// Turn about the tangent, rad.
    pub turn: Option<Number>,
    /// How water acts on it.
    pub immersion: Immersion,
}

/// An outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Width along the section's y, height along its z, m.
    Rectangle {
        /// Along y, m.
        width: Number,
        /// Along z, m.
        height: Number,
    },
    /// A full circle.
    Circle {
        /// Radius, m.
        radius: Number,
    },
    /// A circular tube.
    Tube {
        /// Inner radius, m.
        inner: Number,
        /// Outer radius, m.
        outer: Number,
    },
    /// A full ellipse.
    Ellipse {
        /// Along y, m.
        width: Number,
        /// Along z, m.
        height: Number,
    },
    /// Walls of one thickness: a box or an angle.
    Walls {
        /// Which of them.
        kind: Walls,
        /// Along y, m.
        width: Number,
        /// Along z, m.
        height: Number,
        /// Thickness, m.
        wall: Number,
    },
    /// A web with flanges: I, channel, tee.
    Flanged {
        /// Which of them.
        kind: Flanged,
        /// Of the flanges, along y, m.
        width: Number,
        /// Of the whole, along z, m.
        height: Number,
        /// Thickness of the web, m.
        web: Number,
        /// Thickness of the flanges, m.
        flange: Number,
    },
    /// No outline: integrals only.
    General,
    /// Neither outline nor material: what the two together make.
    Rigidities(Rigidities),
}

/// Outlines with walls of one thickness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walls {
    /// A hollow rectangle.
    Box,
    /// An L.
    Angle,
}

/// Outlines with a web.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flanged {
    /// Two flanges, across both sides of the web.
    I,
    /// Two flanges, on one side of the web.
    Channel,
    /// One flange.
    Tee,
}

/// A section without a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigidities {
    /// N.
    pub axial: Number,
    /// About y and about z, N m².
    pub bending: [Number; 2],
    /// `∫ E y z dA`, N m².
    pub coupling: Option<Number>,
    /// Where axial forces act without bending, along y and z from the axis, m; the bending rigidities are about axes
    /// through it.
    pub tension_center: Option<[Number; 2]>,
    /// N m².
    pub torsion: Number,
    /// Mass per length, kg/m.
    pub line_density: Number,
    /// Polar mass moment of inertia per length, kg m; default: as if mass and stiffness were spread alike.
    pub polar_inertia: Option<Number>,
    /// Mass moments of inertia per length about y and about z, kg m; default: 0.
    pub inertia: [Option<Number>; 2],
    /// Thermal expansion, 1/K.
    pub expansion: Option<Number>,
    /// As of a material.
    pub damping: Damping,
}

#[derive(Clone, Copy)]
enum Word {
    Rectangle,
    Circle,
    Tube,
    Ellipse,
    Walls(Walls),
    Flanged(Flanged),
    General,
    Rigidities,
}

/// The words of `shape`.
const SHAPES: [(&str, Word); 11] = [
    ("rectangle", Word::Rectangle),
    ("circle", Word::Circle),
    ("tube", Word::Tube),
    ("ellipse", Word::Ellipse),
    ("box", Word::Walls(Walls::Box)),
    ("angle", Word::Walls(Walls::Angle)),
    ("i", Word::Flanged(Flanged::I)),
    ("channel", Word::Flanged(Flanged::Channel)),
    ("tee", Word::Flanged(Flanged::Tee)),
    ("general", Word::General),
    ("rigidities", Word::Rigidities),
];

impl SectionSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let place = reader.place;
        // Without the shape nobody knows which keys belong here.
        let Some(word) = reader.word("shape", &SHAPES, None) else {
            reader.abandon();
            return None;
        };
        let shape = shape(word, &mut reader);
        let mut integral = |rule| match word {
            Word::General => Some(reader.number(rule)),
            Word::Rigidities => None,
            _ => reader.optional(rule),
        };
        let area = integral(&AREA);
        let second_moment_y = integral(&SECOND_MOMENT_Y);
        let second_moment_z = integral(&SECOND_MOMENT_Z);
        let torsion_constant = integral(&TORSION_CONSTANT);
        let (product_moment, polar_moment, fourth_moments) = match word {
            Word::Rigidities => (None, None, None),
            _ => (
                reader.optional(&PRODUCT_MOMENT),
                reader.optional(&POLAR_MOMENT),
                reader.optional_vector(&FOURTH_MOMENTS),
            ),
        };
        let turn = reader.optional(&SECTION_TURN);
        let immersion = Immersion::read(&mut reader, matches!(word, Word::Tube));
        reader.finish();
        let name = name.to_owned();
        Some(Self {
            name,
            place,
            shape,
            area,
            second_moment_y,
            second_moment_z,
            torsion_constant,
            product_moment,
            polar_moment,
            fourth_moments,
            turn,
            immersion,
        })
    }

    /// Whether it has a material of its own.
    pub fn has_material(&self) -> bool {
        matches!(self.shape, Shape::Rigidities(_))
    }

    /// The damping of a section that has a material of its own.
    pub fn damping(&self) -> Option<Damping> {
        if let Shape::Rigidities(Rigidities { damping, .. }) = self.shape { Some(damping) } else { None }
    }

    /// All numbers that are written.
    pub fn numbers(&self) -> Vec<Number> {
        let mut all = match self.shape {
            Shape::Rectangle { width, height } | Shape::Ellipse { width, height } => vec![width, height],
            Shape::Circle { radius } => vec![radius],
            Shape::Tube { inner, outer } => vec![inner, outer],
            Shape::Walls { width, height, wall, .. } => vec![width, height, wall],
            Shape::Flanged { width, height, web, flange, .. } => vec![width, height, web, flange],
            Shape::General => Vec::new(),
            Shape::Rigidities(Rigidities {
                axial,
                bending: [y, z],
                coupling,
                tension_center,
                torsion,
                line_density,
                polar_inertia,
                inertia,
                ..
            }) => {
                let optional = coupling.into_iter().chain(polar_inertia).chain(inertia.into_iter().flatten());
                let optional = optional.chain(tension_center.into_iter().flatten());
                [axial, y, z, torsion, line_density].into_iter().chain(optional).collect()
            }
        };
        all.extend(self.area.into_iter().chain(self.second_moment_y).chain(self.second_moment_z));
        all.extend(self.torsion_constant.into_iter().chain(self.product_moment).chain(self.polar_moment));
        all.extend(self.fourth_moments.into_iter().flatten().chain(self.turn));
        all.extend(self.immersion.numbers());
        all
    }

    /// Those of its numbers that vary along the beam, as functions of the arc length from its start, m.
    pub fn varying(&self, numbers: &Numbers) -> Vec<(Number, Function)> {
        let functions = self.numbers().into_iter().map(|number| (number, numbers.function(number)));
        functions.filter(|(_, function)| !function.is_constant()).collect()
    }

    /// What no single number can be wrong about, with the values that `value` gives: walls leave room for each other,
    /// stiffness is positive.
    pub(in crate::model) fn objection(&self, value: impl Fn(Number) -> f64) -> Option<(Number, String)> {
        let below = |small: Number, factor: f64, large: Number, what: &str| {
            (factor * value(small) >= value(large))
                .then(|| (small, format!("must be less than {what}, {}", value(large) / factor)))
        };
        let positive = |product: Option<Number>, [y, z]: [Option<Number>; 2], name: &str| {
            let (product, limit) = (product?, (value(y?) * value(z?)).sqrt());
            let text = || {
                (
                    product,
                    format!("must be less than the square root of the product of both {name}, {limit:.4e}, in size"),
                )
            };
            (value(product).abs() >= limit).then(text)
        };
        match self.shape {
            Shape::Tube { inner, outer } => below(inner, 1.0, outer, "the outer radius"),
            Shape::Walls { kind, width, height, wall } => {
                let (factor, shares) = match kind {
                    Walls::Box => (2.0, ["half the width", "half the height"]),
                    Walls::Angle => (1.0, ["the width", "the height"]),
                };
                below(wall, factor, width, shares[0]).or_else(|| below(wall, factor, height, shares[1]))
            }
            Shape::Flanged { kind, width, height, web, flange } => {
                let (factor, share) = if kind == Flanged::Tee { (1.0, "the height") } else { (2.0, "half the height") };
                below(web, 1.0, width, "the width").or_else(|| below(flange, factor, height, share))
            }
            Shape::Rigidities(Rigidities { coupling, bending, .. }) => {
                positive(coupling, bending.map(Some), "bending rigidities")
            }
            Shape::General => {
                positive(self.product_moment, [self.second_moment_y, self.second_moment_z], "second moments")
            }
            Shape::Rectangle { .. } | Shape::Circle { .. } | Shape::Ellipse { .. } => None,
        }
    }
}

/// Centers of a section that stay on the axis of its beam, and what to do instead.
const ON_AXIS: [(&str, &str, &str); 3] = [
    ("center_of_mass", "center of mass", MASS_ELSEWHERE),
    ("mass_center", "center of mass", MASS_ELSEWHERE),
    (
        "shear_center",
        "shear center",
        "draw the beam through the shear centers, and give the `tension_center` from there",
    ),
];
const MASS_ELSEWHERE: &str = "weld bodies to points with an `offset` on the beam instead";

fn shape(word: Word, reader: &mut Reader<'_, '_>) -> Shape {
    if let Word::Rigidities = word {
        for (key, what, label) in ON_AXIS {
            reader.refuse(key, &format!("the {what} of a section is on the axis of its beam"), label);
        }
    }
    let mut number = |rule| reader.number(rule);
    match word {
        Word::Rectangle => Shape::Rectangle { width: number(&WIDTH), height: number(&HEIGHT) },
        Word::Circle => Shape::Circle { radius: number(&RADIUS) },
        Word::Tube => Shape::Tube { inner: number(&INNER), outer: number(&OUTER) },
        Word::Ellipse => Shape::Ellipse { width: number(&WIDTH), height: number(&HEIGHT) },
        Word::Walls(kind) => Shape::Walls { kind, width: number(&WIDTH), height: number(&HEIGHT), wall: number(&WALL) },
        Word::Flanged(kind) => Shape::Flanged {
            kind,
            width: number(&WIDTH),
            height: number(&HEIGHT),
            web: number(&WEB),
            flange: number(&FLANGE),
        },
        Word::General => Shape::General,
        Word::Rigidities => Shape::Rigidities(Rigidities {
            axial: number(&AXIAL_RIGIDITY),
            bending: [number(&BENDING_RIGIDITY_Y), number(&BENDING_RIGIDITY_Z)],
            torsion: number(&TORSION_RIGIDITY),
            line_density: number(&LINE_DENSITY),
            coupling: reader.optional(&BENDING_COUPLING),
            tension_center: reader.optional_pair(&TENSION_CENTER),
            polar_inertia: reader.optional(&POLAR_INERTIA),
            inertia: [&INERTIA_Y, &INERTIA_Z].map(|rule| reader.optional(rule)),
            expansion: reader.optional(&EXPANSION),
            damping: Damping::read(reader),
        }),
    }
}
