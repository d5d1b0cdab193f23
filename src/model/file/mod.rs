//! A model file as typed data: [`document::Document`], whose [`entries`] the `reader` reads key by key.

mod collisions;
pub mod document;
pub mod entries;
mod many_results;
pub mod number;
mod objections;
pub(super) mod overrides;
pub mod parameter;
mod parts;
pub mod quantity;
mod quantity_families;
pub mod range;
pub(super) mod reader;
mod released;
pub mod schema;
mod settings;
mod timing;
pub mod unit;

pub use super::text::disk::{content, piped, text};
pub use super::text::folder::{Folder, Reach};
