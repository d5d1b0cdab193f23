//! Coordinates of joints in expressions: `hinge.angle`, `hinge.angle_rate`, `slide.distance`, `slide.distance_rate`.

use crate::model::text::names::{Kind, Names, suggestion};

/// What may be read of a joint, in the order of the numbers.
pub const KEYS: [&str; 4] = ["angle", "angle_rate", "distance", "distance_rate"];

/// The number of the reading `name.key`.
///
/// # Errors
/// There is none: a message and a label.
pub(super) fn lookup(names: &Names, name: &str, key: &str) -> Result<usize, [String; 2]> {
    let Some(named) = names.find_among(name, &[Kind::Joint]).filter(|named| named.kind == Kind::Joint) else {
        let message = format!("`{name}.{key}`: no joint is named `{name}`");
        return Err([message, suggestion(name, names.of(Kind::Joint))]);
    };
    match KEYS.iter().position(|own| *own == key) {
        Some(place) => Ok(named.index * KEYS.len() + place),
        None => {
            let message = format!("a joint has no `{key}` in an expression");
            Err([message, String::from("angle, angle_rate, distance or distance_rate was expected")])
        }
    }
}
