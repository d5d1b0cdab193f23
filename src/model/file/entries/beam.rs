//! `[beam.NAME]`: a beam and how it is divided and formulated; its line is in curve.rs.

use super::Parts;
use super::body::ANGULAR_VELOCITY;
use super::curve::{FROM, Line, SPACINGS, TO};
use super::section::SectionSpec;
use crate::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use crate::mechanics::beam::ancf14::strain::Strain;
use crate::mechanics::beam::ancf24::law::Shear;
use crate::mechanics::beam::design::{Elements, Torsion};
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::input::{RAMPED, make_input};
use crate::model::file::schema::{Key, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("material", Role::Name("material"), "the material; none where the section has rigidities"),
    Key::name("section", Role::Name("section"), "the cross-section"),
    Key::global(&[&FROM], Role::Position),
    Key::global(&[&TO], Role::Position),
    Key::name(
        "curve",
        Role::Curve,
        "the line of a curved beam, instead of `from` and `to`: a table of expressions, points, or surfaces that it \
         is tight over",
    ),
    Key::name("lay", Role::Number, "{ length = 410 }: a line of this length, drawn as it hangs from `from` to `to`"),
    Key::word("spacing", &words_of(&SPACINGS), "how elements share a curve"),
    Key::global(&[&Y_AXIS], Role::Direction),
    Key::number(&[&PRETWIST]),
    Key::number(&[&ELEMENTS]),
    Key::word("element", &words_of(&ELEMENT_WORDS), "the formulation of the elements"),
    Key::word("strain", &words_of(&STRAINS), "the strain measure"),
    Key::word("twist", &words_of(&TWISTS), "the twist along an element"),
    Key::flag("torsion", "false: no torsion"),
    Key::flag("ancf24_poisson", "true: the full material law of ancf24"),
    Key::word("ancf24_shear", &words_of(&SHEARS), "the transverse shear moduli of ancf24"),
    Key::flag("rotary_inertia", "false: sections have no inertia against turns of the tangent"),
    Key::number(&[&PRETENSION]),
    Key::list(&[&FREE_CURVATURE], "2"),
    Key::number(&[&FREE_TORSION]),
    Key::number(&[&TENSION_DAMPING]),
    Key::number(&[&TEMPERATURE]),
    Key::list(&[&TEMPERATURE_GRADIENT], "2"),
    Key::flag("temperature_input", "true: the host gives both temperatures"),
    Key::global(&[&VELOCITY], Role::Direction),
    Key::global(&[&ANGULAR_VELOCITY], Role::Direction),
];

const Y_AXIS: Rule = Rule::new("y_axis", "direction of the section's y at the start, global", "");
/// More elements than this are a slip of the finger.
const MOST_ELEMENTS: f64 = 1e5;
/// The program begins with so many elements at least: most beams are right to 1 % then (docs/accuracy.md).
pub const FEWEST_ELEMENTS: f64 = 8.0;
const ELEMENTS: Rule = Rule::new("elements", "number of elements", "").from(1.0).to(MOST_ELEMENTS).count();
const PRETWIST: Rule = Rule::new("pretwist", "additional turn of the section from start to end", "rad");
const PRETENSION: Rule = Rule::new("pretension", "axial force of the beam as drawn, tension positive", "N");
const FREE_CURVATURE: Rule =
    Rule::new("free_curvature", "curvature of the beam without stress, about the section's y and z", "1/m");
const FREE_TORSION: Rule = Rule::new("free_torsion", "torsion of the beam without stress", "rad/m");
const TENSION_DAMPING: Rule =
    Rule::new("tension_damping", "damping of the axial strain, beyond that of the material", "s").from(0.0).tunable();
const TEMPERATURE: Rule =
    Rule::new("temperature", "temperature of the beam, above that at which it is as drawn", "K").along_in_time();
const TEMPERATURE_GRADIENT: Rule =
    Rule::new("temperature_gradient", "gradient of the temperature along the section's y and z", "K/m").along_in_time();
const VELOCITY: Rule = Rule::new("velocity", "initial velocity of the start, global axes", "m/s");

/// A section `[beam.NAME]`.
#[derive(Clone, Debug)]
pub struct BeamSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Place in the list of materials; none: the section has rigidities.
    pub material: Option<usize>,
    /// Place in the list of sections.
    pub section: usize,
    /// The line it follows; none: it is wrong, and reported.
    pub line: Option<Line>,
    /// Direction of the section's y at the start, to be made perpendicular to the tangent.
    pub y_axis: [Number; 3],
    /// Number of elements.
    pub elements: Number,
    /// The file leaves that number to the program.
    pub is_meshed_by_program: bool,
    /// How its elements are formulated.
    pub formulation: Elements,
    /// Additional turn of the section from start to end, rad.
    pub pretwist: Number,
    /// Whether sections have an inertia against turns of the tangent.
    pub rotary_inertia: bool,
    /// Axial force as drawn, N.
    pub pretension: Option<Number>,
    /// Curvatures about y and z without stress, 1/m.
    pub free_curvature: Option<[Number; 2]>,
    /// Torsion without stress, rad/m.
    pub free_torsion: Option<Number>,
    /// Damping of the axial strain beyond that of the material, s.
    pub tension_damping: Option<Number>,
    /// Temperature above that as drawn, K.
    pub temperature: Option<Number>,
    /// Its gradient along y and z of the section, K/m.
    pub temperature_gradient: Option<[Number; 2]>,
    /// true: the host gives both; the numbers are start values.
    pub temperature_input: bool,
    /// Initial velocity of the start, m/s.
    pub velocity: [Number; 3],
    /// Initial angular velocity, rad/s.
    pub angular_velocity: [Number; 3],
}

/// The words of `strain`.
const STRAINS: [(&str, Strain); 3] =
    [("large", Strain::Large), ("large_truncated", Strain::LargeTruncated), ("small", Strain::Small)];

/// The words of `twist`.
const TWISTS: [(&str, Twist); 2] = [("linear", Twist::Linear), ("quadratic", Twist::Quadratic)];

/// The words of `ancf24_shear`.
const SHEARS: [(&str, Shear); 2] = [("section", Shear::Section), ("continuum", Shear::Continuum)];

/// The words of `element`.
const ELEMENT_WORDS: [(&str, Word); 2] = [("ancf14", Word::Ancf14), ("ancf24", Word::Ancf24)];

#[derive(Clone, Copy)]
enum Word {
    Ancf14,
    Ancf24,
}

/// Reads how the elements of a beam are formulated, with the strain `strain` unless another one is written, and with
/// quadratic twist where the mesh `is_meshed_by_program`: linear twist is often most of a mesh error. Keys of the
/// other formulation are mistakes; those of the file go with its `element`, where an override gives another one.
fn formulation(reader: &mut Reader<'_, '_>, strain: Strain, is_meshed_by_program: bool) -> Elements {
    let is_overridden = reader.is_overridden("element");
    let foreign = |reader: &mut Reader<'_, '_>, keys: &[&str], own: &str, other: &str| {
        for key in keys {
            if is_overridden {
                reader.set_aside(key);
            }
            let message = format!("`{key}` belongs to element = \"{own}\"");
            reader.refuse(key, &message, &format!("element = \"{other}\" has none: remove it"));
        }
    };
    let own14 = [
        "strain",
        "twist",
        "torsion",
        "rotary_inertia",
        "lay",
        "pretension",
        "free_curvature",
        "free_torsion",
        "tension_damping",
        "temperature",
        "temperature_gradient",
        "temperature_input",
    ];
    let own24 = ["ancf24_poisson", "ancf24_shear"];
    match reader.word("element", &ELEMENT_WORDS, Some(Word::Ancf14)).unwrap_or(Word::Ancf14) {
        Word::Ancf14 => {
            foreign(reader, &own24, "ancf24", "ancf14");
            let strain = reader.word("strain", &STRAINS, Some(strain)).unwrap_or(strain);
            let torsion = if reader.boolean("torsion", true) { Torsion::Free } else { Torsion::Suppressed };
            let is_fine = is_meshed_by_program && torsion == Torsion::Free;
            let twist = if is_fine { Twist::Quadratic } else { Twist::Linear };
            Elements::Ancf14 { strain, twist: reader.word("twist", &TWISTS, Some(twist)).unwrap_or(twist), torsion }
        }
        Word::Ancf24 => {
            foreign(reader, &own14, "ancf14", "ancf24");
            Elements::Ancf24 {
                poisson: reader.boolean("ancf24_poisson", false),
                shear: reader.word("ancf24_shear", &SHEARS, Some(Shear::Section)).unwrap_or(Shear::Section),
            }
        }
    }
}

/// Reads the temperature, its gradient, and whether the host gives them.
fn temperature(reader: &mut Reader<'_, '_>) -> (Option<Number>, Option<[Number; 2]>, bool) {
    let input = reader.boolean("temperature_input", false);
    let temperature = match input {
        true => Some(reader.number_or(&TEMPERATURE, 0.0)),
        false => reader.optional(&TEMPERATURE),
    };
    let gradient = reader.optional_pair(&TEMPERATURE_GRADIENT);
    if input {
        for number in temperature.into_iter().chain(gradient.into_iter().flatten()) {
            make_input(reader.context, number);
            reader.context.numbers.slots[number.0].meta.description.push_str(&format!(", {RAMPED}"));
        }
    }
    (temperature, gradient, input)
}

impl BeamSpec {
    /// Whether it has a temperature.
    pub fn is_heated(&self) -> bool {
        self.temperature.is_some() || self.temperature_gradient.is_some()
    }

    /// The gradients of its temperature along y and z of the section, K/m.
    pub fn gradients(&self) -> [Option<Number>; 2] {
        self.temperature_gradient.map_or([None; 2], |numbers| numbers.map(Some))
    }

    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        // The first ones stand in for what is reported: the beam must keep its index in the list.
        let section = reader.reference("section", Kind::Section).unwrap_or(0);
        let has_material = parts.sections.get(section).is_some_and(SectionSpec::has_material);
        let material = if has_material {
            let label = "the section has rigidities, which a material is part of: remove it";
            reader.refuse("material", "`material` does not belong to a beam with rigidities", label);
            None
        } else {
            Some(reader.reference("material", Kind::Material).unwrap_or(0))
        };
        if reader.has("lay") {
            for key in [FREE_CURVATURE.key, FREE_TORSION.key] {
                let message = format!("`{key}` does not belong to a beam with `lay`");
                reader.refuse(key, &message, "a line that is laid is straight when free of stress: remove it");
            }
        }
        let line = Line::read(&mut reader);
        let y_axis = reader.vector_or(&Y_AXIS, [0.0, 1.0, 0.0]);
        let is_meshed_by_program = !reader.has(ELEMENTS.key);
        let elements = reader.number_or(&ELEMENTS, FEWEST_ELEMENTS);
        // Hosts may set it also where the file does not give it.
        reader.context.numbers.slots[elements.0].listed.get_or_insert(usize::MAX);
        reader.context.free_meshes.push(is_meshed_by_program);
        // Rigidities are what they say they are: moments in proportion to curvatures. Of a section that is known the
        // fibers' strain is.
        let strain = if has_material { Strain::Small } else { Strain::Large };
        let formulation = formulation(&mut reader, strain, is_meshed_by_program);
        let pretwist = reader.number_or(&PRETWIST, 0.0);
        let rotary_inertia = reader.boolean("rotary_inertia", true);
        let pretension = reader.optional(&PRETENSION);
        let free_curvature = reader.optional_pair(&FREE_CURVATURE);
        let free_torsion = reader.optional(&FREE_TORSION);
        let tension_damping = reader.optional(&TENSION_DAMPING);
        let (temperature, temperature_gradient, temperature_input) = temperature(&mut reader);
        let velocity = reader.vector_or(&VELOCITY, [0.0; 3]);
        let angular_velocity = reader.vector_or(&ANGULAR_VELOCITY, [0.0; 3]);
        let place = reader.place;
        reader.finish();
        Some(Self {
            name: name.to_owned(),
            place,
            material,
            section,
            line,
            y_axis,
            elements,
            is_meshed_by_program,
            formulation,
            pretwist,
            rotary_inertia,
            pretension,
            free_curvature,
            free_torsion,
            tension_damping,
            temperature,
            temperature_gradient,
            temperature_input,
            velocity,
            angular_velocity,
        })
    }
}
