//! A model file as typed data: [`document::Document`], whose [`entries`] the `reader` reads key by key.

mod collisions;
mod disk;
pub mod document;
pub mod entries;
pub mod number;
mod objections;
pub mod parameter;
mod parts;
pub mod quantity;
pub mod range;
pub(super) mod reader;
mod released;
pub(super) mod schema;
mod settings;
mod timing;
pub mod unit;

pub use disk::{content, piped, text};
