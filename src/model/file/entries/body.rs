//! `[body.NAME]`: a rigid body.

use super::Parts;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Role, Rule};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::number(&[&MASS]),
    Key::global(&[&CENTER], Role::Position),
    Key::list(&[&PRINCIPAL_INERTIA, &INERTIA], "3 or 6"),
    Key::global(&[&AXES], Role::Axes),
    Key::global(&[&BODY_VELOCITY], Role::Direction),
    Key::global(&[&ANGULAR_VELOCITY], Role::Direction),
    Key::number(&[&VOLUME]),
    Key::list(&[&DRAG_AREAS], "3"),
    Key::list(&[&ADDED_MASS], "3"),
];

const MASS: Rule = Rule::new("mass", "mass", "kg").above(0.0);
const CENTER: Rule = Rule::new("position", "center of mass as drawn, global", "m");
const PRINCIPAL_INERTIA: Rule =
    Rule::new("inertia", "moment of inertia about the center of mass, body axes", "kg.m2").above(0.0);
const INERTIA: Rule =
    Rule::new("inertia", "tensor of inertia about the center of mass, body axes (xx, yy, zz, xy, yz, zx)", "kg.m2");
const AXES: Rule = Rule::new("axes", "body axes as drawn, global, one per row", "");
const BODY_VELOCITY: Rule = Rule::new("velocity", "initial velocity of the center of mass, global axes", "m/s");
pub(super) const ANGULAR_VELOCITY: Rule =
    Rule::new("angular_velocity", "initial angular velocity, global axes", "rad/s");

const VOLUME: Rule = Rule::new("volume", "volume that the body displaces; 0: no fluid acts", "m3").from(0.0);
const DRAG_AREAS: Rule = Rule::new("drag_areas", "drag coefficient times area along each body axis", "m2").from(0.0);
const ADDED_MASS: Rule =
    Rule::new("added_mass", "mass of water that moves with the body along each body axis", "kg").from(0.0);

/// A section `[body.NAME]`.
#[derive(Clone, Debug)]
pub struct BodySpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Mass, kg.
    pub mass: Number,
    /// Center of mass as drawn, global, m.
    pub position: [Number; 3],
    /// Inertia about the center of mass, kg m².
    pub inertia: Inertia,
    /// Body axes as drawn, global, one per row; default: the global axes.
    pub axes: Option<[[Number; 3]; 3]>,
    /// Initial velocity of the center of mass, global, m/s.
    pub velocity: [Number; 3],
    /// Initial angular velocity, global, rad/s.
    pub angular_velocity: [Number; 3],
    /// Displaced volume, m³.
    pub volume: Number,
    /// Drag coefficient times area along each body axis, m².
    pub drag_areas: Option<[Number; 3]>,
    /// Mass of water that moves with it along each body axis, kg.
    pub added_mass: Option<[Number; 3]>,
}

/// Inertia about the center of mass in body axes, kg m².
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inertia {
    /// The body axes are principal axes: a moment about each.
    Principal([Number; 3]),
    /// The components xx, yy, zz, xy, yz, zx of the tensor: xy is minus the integral of x y dm.
    Tensor([Number; 6]),
}

impl BodySpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let mass = reader.number(&MASS);
        let position = reader.vector(&CENTER);
        let inertia = Inertia::read(&mut reader);
        let axes = reader.table(&AXES);
        let velocity = reader.vector_or(&BODY_VELOCITY, [0.0; 3]);
        let angular_velocity = reader.vector_or(&ANGULAR_VELOCITY, [0.0; 3]);
        let volume = reader.number_or(&VOLUME, 0.0);
        let (drag_areas, added_mass) = (reader.optional_vector(&DRAG_AREAS), reader.optional_vector(&ADDED_MASS));
        let (name, place) = (name.to_owned(), reader.place);
        reader.finish();
        Some(Self {
            name,
            place,
            mass,
            position,
            inertia,
            axes,
            velocity,
            angular_velocity,
            volume,
            drag_areas,
            added_mass,
        })
    }
}

impl Inertia {
    fn read(reader: &mut Reader<'_, '_>) -> Self {
        let expected = "a list of 3 or 6";
        match reader.length_of(INERTIA.key) {
            Some(6) => Self::Tensor(reader.list(&INERTIA, expected)),
            _ => Self::Principal(reader.list(&PRINCIPAL_INERTIA, expected)),
        }
    }
}
