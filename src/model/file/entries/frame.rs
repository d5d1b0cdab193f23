//! `[frame.NAME]`: a frame whose motion is prescribed, by expressions in t or by the host.

use super::Parts;
use crate::math::Vec3;
use crate::math::rotation::quaternion_of;
use crate::model::file::number::{Meta, Number, Slot, Written};
use crate::model::file::reader::Reader;
use crate::model::file::reader::input::{REACHED, make_input, make_start};
use crate::model::file::schema::{Key, Role, Rule};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::global(&[&FRAME_POSITION], Role::Position),
    Key::global(&[&FRAME_ROTATION], Role::Direction),
    Key::word(
        "input",
        &["true", "false", "quaternion", "rotation"],
        "true: the host gives the position and the orientation",
    ),
];

const FRAME_POSITION: Rule = Rule::new("position", "place of the frame, global", "m").in_time();
const FRAME_ROTATION: Rule = Rule::new("rotation", "rotation vector of the frame, global axes", "rad").in_time();
/// In the place of a rotation that the host gives.
const QUATERNION: Rule = Rule::new("quaternion", "orientation of the frame", "");

/// A section `[frame.NAME]`.
#[derive(Clone, Debug)]
pub struct FrameSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Its position, global, m; may change in time.
    pub position: [Number; 3],
    /// Its orientation.
    pub orientation: Orientation,
    /// true: the host gives position and orientation; the numbers are start values.
    pub input: bool,
}

/// How the orientation of a frame is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientation {
    /// Rotation vector from the global axes, rad; may change in time, or is an input.
    Rotation([Number; 3]),
    /// Quaternion w x y z from the global axes: inputs, which need not be of length 1.
    Quaternion([Number; 4]),
}

/// What a host gives of an orientation, a word of `input`.
#[derive(Clone, Copy, PartialEq)]
enum Word {
    Quaternion,
    Rotation,
}

const INPUTS: [(&str, Word); 2] = [("quaternion", Word::Quaternion), ("rotation", Word::Rotation)];

impl FrameSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let position = reader.vector(&FRAME_POSITION);
        let rotation = reader.vector_or(&FRAME_ROTATION, [0.0; 3]);
        // The word true is the older one, and means the same as "quaternion".
        let given = match reader.text_of("input") {
            Some(_) => reader.word("input", &INPUTS, None),
            None => reader.boolean("input", false).then_some(Word::Quaternion),
        };
        if given.is_some() {
            give(&mut reader, position, &format!("Position of frame {name} along global"), REACHED);
        }
        let orientation = match given {
            Some(Word::Quaternion) => Orientation::Quaternion(quaternion(&mut reader, name, rotation)),
            Some(Word::Rotation) => {
                let meaning = format!("Rotation vector of frame {name} along global");
                give(&mut reader, rotation, &meaning, &format!("{REACHED}, along the shortest arc"));
                Orientation::Rotation(rotation)
            }
            None => Orientation::Rotation(rotation),
        };
        let place = reader.place;
        let frame = Self { name: name.to_owned(), place, position, orientation, input: given.is_some() };
        let changes = |number: Number| reader.context.numbers.changes_in_time(number);
        let moves = frame.input || frame.numbers().any(changes);
        reader.context.moving_frames.push(moves);
        reader.finish();
        Some(frame)
    }
}

impl FrameSpec {
    /// The numbers of its position and its orientation.
    pub fn numbers(&self) -> impl Iterator<Item = Number> {
        let turn = match &self.orientation {
            Orientation::Rotation(numbers) => &numbers[..],
            Orientation::Quaternion(numbers) => numbers,
        };
        self.position.iter().chain(turn).copied()
    }
}

/// Makes the components of a vector inputs: `meaning` x, `becomes`.
fn give(reader: &mut Reader<'_, '_>, numbers: [Number; 3], meaning: &str, becomes: &str) {
    for (number, axis) in numbers.into_iter().zip(["x", "y", "z"]) {
        make_input(reader.context, number);
        reader.context.numbers.slots[number.0].meta.description = format!("{meaning} {axis}, {becomes}");
    }
}

/// The inputs that a host gives instead of the rotation vector, which is where they start.
fn quaternion(reader: &mut Reader<'_, '_>, name: &str, rotation: [Number; 3]) -> [Number; 4] {
    let context = &mut reader.context;
    let vector = rotation.map(|number| {
        make_start(context, number);
        match context.numbers.slots[number.0].written {
            Written::Plain(value) => value,
            Written::Formula(_) | Written::Broken => 0.0,
        }
    });
    let start = quaternion_of(&Vec3::from(vector));
    let parts = [("w", start.w), ("x", start.i), ("y", start.j), ("z", start.k)];
    let first = context.numbers.slots[rotation[0].0].clone();
    for number in rotation {
        context.numbers.slots[number.0].listed = None;
    }
    std::array::from_fn(|k| {
        let (word, value) = parts[k];
        let mut meta = Meta::of(&QUATERNION, format!("{name}.quaternion[{}]", k + 1));
        meta.description = format!(
            "Quaternion {word} of the orientation of frame {name}, {REACHED}, along the shortest arc; \
             its length does not matter"
        );
        let written = Written::Plain(value);
        let number = context.numbers.push(Slot { meta, place: first.place, listed: first.listed, written });
        make_input(context, number);
        number
    })
}
