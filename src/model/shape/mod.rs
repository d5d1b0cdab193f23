//! Makes the shapes of parts from the file: the lines of beams, their sections, the places of their temperatures.

mod carriers;
pub mod contacts;
pub mod heat;
pub mod lines;
mod over;
mod places;
pub mod sections;

pub use self::lines::{Lines, division, fits};

use super::file::document::Document;
use super::file::number::Number;
use crate::math::Vec3;

/// Three numbers; none if one of them is wrong.
pub fn vector(document: &Document, numbers: [Number; 3]) -> Option<Vec3> {
    let vector = Vec3::from(document.vector(numbers));
    vector.iter().all(|value| value.is_finite()).then_some(vector)
}

/// A number with as many digits as tell it from its neighbors in a message.
pub fn shown(value: f64) -> String {
    // Through the text of six digits: 2.0325, not 2.0325000000000002.
    let text = format!("{value:.5e}");
    let Ok(value) = text.parse::<f64>() else { return text };
    let is_plain = value == 0.0 || !value.is_finite() || (1e-5..1e9).contains(&value.abs());
    if is_plain { (value + 0.0).to_string() } else { format!("{value:e}") }
}
