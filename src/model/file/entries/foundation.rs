//! `[foundation.NAME]`: an elastic foundation along a beam.

use super::Parts;
use crate::mechanics::force::foundation::Bedding;
use crate::model::file::number::{Number, Numbers};
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("on", Role::Name("beam"), "the beam that it supports"),
    Key::list(&[&OVER], "2"),
    Key::word("axes", &words_of(&AXES), "the axes of `stiffness` and `damping`"),
    Key::on_axes(&[&STIFFNESS, &PUSHING_STIFFNESS]),
    Key::on_axes(&[&DAMPING, &PUSHING_DAMPING]),
    Key::global(&[&PUSHES], Role::Direction),
];

const OVER: Rule =
    Rule::new("over", "the part of the beam that it supports, by fractions of its length; by default all of it", "")
        .from(0.0)
        .to(1.0);
const STIFFNESS: Rule =
    Rule::new("stiffness", "force per length and displacement along each axis", "N/m2").from(0.0).tunable();
const DAMPING: Rule =
    Rule::new("damping", "force per length and velocity along each axis", "N.s/m2").from(0.0).tunable();
const PUSHING_STIFFNESS: Rule =
    Rule::new("stiffness", "force per length and displacement against `pushes`", "N/m2").from(0.0).tunable();
const PUSHING_DAMPING: Rule =
    Rule::new("damping", "force per length and velocity while it pushes", "N.s/m2").from(0.0).tunable();
const PUSHES: Rule = Rule::new(
    "pushes",
    "the only direction in which it pushes the beam, and never pulls; by default on both sides",
    "",
);

/// The axes of a foundation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// The global ones.
    Global,
    /// Those of the sections as drawn.
    Section,
}

const AXES: [(&str, Axes); 2] = [("global", Axes::Global), ("section", Axes::Section)];

/// A section `[foundation.NAME]`.
#[derive(Clone, Debug)]
pub struct FoundationSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The beam, by its number.
    pub beam: usize,
    /// The part of the beam by fractions of its length; none: all of it.
    pub over: Option<[Number; 2]>,
    /// How it acts.
    pub action: Action,
}

/// How a foundation acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// It acts on both sides along three axes.
    Sided {
        /// Its axes.
        axes: Axes,
        /// N/m².
        stiffness: [Number; 3],
        /// N s/m².
        damping: [Number; 3],
    },
    /// It pushes along a direction and never pulls.
    Pushing {
        /// The direction, global.
        direction: [Number; 3],
        /// N/m².
        stiffness: Number,
        /// N s/m².
        damping: Number,
    },
}

impl FoundationSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let beam = reader.reference("on", Kind::Beam);
        let over = reader.optional_pair(&OVER);
        let action = if reader.has("pushes") {
            let message = "`axes` belongs to a foundation that acts on both sides";
            reader.refuse("axes", message, "with `pushes` it acts along that direction alone");
            let direction = reader.vector(&PUSHES);
            let stiffness = reader.number(&PUSHING_STIFFNESS);
            Action::Pushing { direction, stiffness, damping: reader.number_or(&PUSHING_DAMPING, 0.0) }
        } else {
            let axes = reader.word("axes", &AXES, Some(Axes::Global)).unwrap_or(Axes::Global);
            let stiffness = reader.vector(&STIFFNESS);
            Action::Sided { axes, stiffness, damping: reader.vector_or(&DAMPING, [0.0; 3]) }
        };
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, beam: beam?, over, action })
    }

    /// How hard it is.
    pub fn bedding(&self, numbers: &Numbers) -> Bedding {
        match self.action {
            Action::Sided { stiffness, damping, .. } => {
                let [stiffness, damping] = [stiffness, damping].map(|own| own.map(|number| numbers.value(number)));
                Bedding::Sided { stiffness, damping }
            }
            Action::Pushing { stiffness, damping, .. } => {
                Bedding::Pushing { stiffness: numbers.value(stiffness), damping: numbers.value(damping) }
            }
        }
    }

    /// Both ends of the part of the beam, by fractions of its length.
    pub fn fractions(&self, numbers: &Numbers) -> [f64; 2] {
        self.over.map_or([0.0, 1.0], |over| over.map(|number| numbers.value(number)))
    }

    /// A reason why its numbers do not go together, with the number to blame.
    pub(super) fn objection(&self, numbers: &Numbers) -> Option<(Number, String)> {
        if let Some(over) = self.over {
            let [begin, end] = self.fractions(numbers);
            if begin >= end {
                let text = format!("must be above {begin}, where the foundation begins: it supports nothing");
                return Some((over[1], text));
            }
        }
        match self.action {
            Action::Pushing { direction, .. } if direction.iter().all(|own| numbers.value(*own) == 0.0) => {
                Some((direction[0], String::from("must have a direction: one of its components must not be 0")))
            }
            _ => None,
        }
    }
}
