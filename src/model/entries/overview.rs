//! `[model]`: name, description, gravity.

use crate::model::names::identifier;
use crate::model::number::Number;
use crate::model::reader::Reader;
use crate::model::schema;

/// The section `[model]`.
#[derive(Clone, Debug)]
pub struct Model {
    /// Free text: FMI's modelName.
    pub name: String,
    /// The name as a C identifier: FMI's modelIdentifier.
    pub identifier: String,
    /// One sentence; may be empty.
    pub description: String,
    /// Acceleration of gravity, global axes, m/s².
    pub gravity: [Number; 3],
}

impl Model {
    pub(in crate::model) fn read(mut reader: Reader<'_, '_>) -> Self {
        let written = reader.has("name");
        let name = match reader.text("name") {
            Some((name, place)) => {
                if name.trim().is_empty() {
                    reader.context.report.error(place, "the model's name is empty", "a name was expected", "");
                }
                name
            }
            None => {
                if !written {
                    reader.missing("name", "a string: the name of the model");
                }
                String::new()
            }
        };
        let description = reader.text("description").map_or(String::new(), |(text, _)| text);
        let gravity = reader.vector_or(&schema::GRAVITY, [0.0; 3]);
        reader.finish();
        Self { identifier: identifier(&name), name, description, gravity }
    }
}
