//! The sections of a file, one module each: the typed data, and how it is read.

pub mod actuator;
pub mod beam;
pub mod body;
pub mod curve;
pub mod damping;
pub mod drive;
pub mod frame;
pub mod friction;
pub mod function;
pub mod gear;
pub mod joint;
pub mod load;
pub mod lock;
pub mod material;
mod namesakes;
pub mod output;
pub mod overview;
pub mod parameters;
pub mod point;
pub mod reading;
pub mod section;
pub mod simulation;
pub mod spring;
pub mod stop;
pub mod switch;
pub mod winch;

pub use super::reader::anchor;

use crate::model::file::schema::Key;

/// The sections of the format with their keys, in the order of its reference.
pub const SECTIONS: [(&str, &[Key]); 20] = [
    ("model", overview::KEYS),
    ("function", function::KEYS),
    ("material", material::KEYS),
    ("section", section::KEYS),
    ("beam", beam::KEYS),
    ("body", body::KEYS),
    ("frame", frame::KEYS),
    ("point", point::KEYS),
    ("joint", joint::KEYS),
    ("drive", drive::KEYS),
    ("actuator", actuator::KEYS),
    ("winch", winch::KEYS),
    ("gear", gear::KEYS),
    ("spring", spring::KEYS),
    ("friction", friction::KEYS),
    ("stop", stop::KEYS),
    ("lock", lock::KEYS),
    ("load", load::KEYS),
    ("output", output::KEYS),
    ("simulation", simulation::KEYS),
];

/// The keys of a section.
pub fn keys_of(section: &str) -> &'static [Key] {
    SECTIONS.iter().find(|(word, _)| *word == section).map_or(&[], |(_, keys)| keys)
}
