//! `[lock.NAME]`: keeps a free coordinate of a joint where it stands, while it is engaged.

use super::Parts;
use super::actuator::{Action, on_joint};
use super::joint::Coordinate;
use super::switch::{ACTIVE, SwitchSpec};
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Role, words_of};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("joint", Role::Name("joint"), "the joint that it acts on"),
    Key::word("coordinate", &words_of(&Coordinate::WORDS), "the coordinate of the joint"),
    Key::number(&[&ACTIVE]),
    Key::flag("input", "true: the host gives `active`"),
];

/// A section `[lock.NAME]`.
#[derive(Clone, Debug)]
pub struct LockSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Place in the list of joints.
    pub joint: usize,
    /// The coordinate of the joint: the joint has it.
    pub coordinate: Coordinate,
    /// What engages and releases it.
    pub switch: SwitchSpec,
}

impl LockSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let (action, coordinate) = on_joint(&mut reader, &parts.joints, "the joint that the lock acts on");
        let switch = SwitchSpec::read_or_engaged(&mut reader);
        // Without the joint its coordinate means nothing.
        if coordinate.is_none() {
            reader.abandon();
            return None;
        }
        let place = reader.place;
        reader.finish();
        let Action::Joint { joint, coordinate } = action? else { return None };
        Some(Self { name: name.to_owned(), place, joint, coordinate, switch })
    }
}
