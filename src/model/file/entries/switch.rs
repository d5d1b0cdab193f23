//! `active`: what engages and releases a joint, a lock or a drive, a key of each of them.

use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::input::{SWITCHED, make_input};
use crate::model::file::schema::Rule;

pub(super) const ACTIVE: Rule =
    Rule::new("active", "engaged where it is at least 0.5, else released", "").from(0.0).to(1.0).in_time();

/// What engages and releases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwitchSpec {
    /// Engaged where it is at least a half; may change in time.
    pub active: Number,
    /// true: the host gives it; the number is the start value.
    pub input: bool,
}

impl SwitchSpec {
    /// Reads `active`, which the host gives if `input` is true; none: it is not there.
    pub(super) fn read(reader: &mut Reader<'_, '_>, input: bool) -> Option<Self> {
        if input {
            let active = reader.number_or(&ACTIVE, 1.0);
            make_input(reader.context, active);
            reader.context.numbers.slots[active.0].meta.description.push_str(&format!(", {SWITCHED}"));
            return Some(Self { active, input });
        }
        reader.optional(&ACTIVE).map(|active| Self { active, input })
    }

    /// Reads `active` and `input` of what is engaged throughout where neither is there.
    pub(super) fn read_or_engaged(reader: &mut Reader<'_, '_>) -> Self {
        let input = reader.boolean("input", false);
        let written = Self::read(reader, input);
        written.unwrap_or_else(|| Self { active: reader.number_or(&ACTIVE, 1.0), input })
    }
}
