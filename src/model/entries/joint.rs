//! `[joint.NAME]`: holds two points together, all but some relative motions.

use super::anchor::{Anchor, Spot};
use crate::model::diagnostic::Place;
use crate::model::number::Number;
use crate::model::reader::Reader;
use crate::model::schema;

/// A section `[joint.NAME]`.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it leaves free.
    pub kind: JointKind,
    /// The first side: an axis is fixed in it.
    pub a: Anchor,
    /// The second side.
    pub b: Anchor,
    /// Its place as drawn, global, m; default: that of b, of a where b is the ground.
    pub at: Option<[Number; 3]>,
    /// Its axis as drawn, global; there exactly where the kind has one.
    pub axis: Option<[Number; 3]>,
}

/// What a joint leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Nothing.
    Weld,
    /// All turns.
    Spherical,
    /// The turn about its axis.
    Revolute,
}

/// The kinds: word, kind.
const KINDS: [(&str, JointKind); 3] =
    [("weld", JointKind::Weld), ("spherical", JointKind::Spherical), ("revolute", JointKind::Revolute)];

/// Kinds of the format that this version does not build.
const LATER: [&str; 6] = ["cylindrical", "prismatic", "universal", "inline", "inplane", "bushing"];

impl JointKind {
    /// Whether the joint has an axis.
    pub fn has_axis(self) -> bool {
        self == Self::Revolute
    }
}

impl Joint {
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>) -> Option<Self> {
        let kind = reader.word("type", &KINDS, &LATER, None);
        let a = Anchor::read(&mut reader, "a");
        let b = Anchor::read(&mut reader, "b");
        let at = reader.optional_vector(&schema::AT);
        // Without the kind nobody knows which keys belong here.
        let Some(kind) = kind else {
            reader.abandon();
            return None;
        };
        if let (Some(Spot::Ground), Some(Anchor { spot: Spot::Ground, place })) = (a.map(|a| a.spot), b) {
            let message = format!("{} joins the ground to itself", reader.title);
            reader.context.report.error(place, &message, "one side must be a beam", "");
        }
        let axis = if kind.has_axis() {
            Some(reader.vector(&schema::AXIS))
        } else {
            if let Some(entry) = reader.take("axis") {
                let message = format!("{} has no axis", reader.title);
                reader.context.report.error(entry.key_place, &message, "revolute joints have one", "");
            }
            None
        };
        for key in ["stiffness", "damping"] {
            reader.unavailable(key, "available: joints without a spring and a damper");
        }
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, kind, a: a?, b: b?, at, axis })
    }
}
