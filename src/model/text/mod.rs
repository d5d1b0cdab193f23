//! The text of a model file: a tree of values, each with its place in the text, and messages that underline such
//! places.

pub mod csv;
pub mod diagnostic;
pub(super) mod disk;
pub(super) mod folder;
pub mod names;
pub mod source;
pub(super) mod syntax;
pub(super) mod tree;
