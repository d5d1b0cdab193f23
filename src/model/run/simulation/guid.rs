//! The GUID of a model.

use crate::fmi::variable::Variable;
use crate::model::variables::Table;

/// A name-based hash of the file, of its overrides and of what a host knows variables by: what its XML and the model
/// must agree on. It has no number that was computed: the last bits of a sine depend on the processor and on the C
/// library.
pub(super) fn guid(text: &str, overrides: &[(String, String)], table: &Table) -> String {
    let mut content = format!("ancf14 {}\n{text}\n", env!("CARGO_PKG_VERSION"));
    for (key, value) in overrides {
        content.push_str(&format!("{key}={value}\n"));
    }
    let mut content = content.into_bytes();
    for Variable { name, causality, variability, quantity, .. } in &table.variables {
        content.extend([*causality as u8, *variability as u8]);
        for text in [name, &quantity.unit] {
            content.extend(text.as_bytes());
            content.push(0);
        }
    }
    format!("{{{}}}", uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_URL, &content))
}

/// The GUID of a model that begins with a state: of other bytes it is another one.
pub(super) fn with_state(guid: &str, state: &[u8]) -> String {
    let content = [guid.as_bytes(), state].concat();
    format!("{{{}}}", uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_URL, &content))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi::Value;
    use crate::model::file::document::Document;

    /// Two processors, or two C libraries, may give a start value different last bits; the file is the same all the
    /// same.
    #[test]
    fn regression_start_values_are_not_in_the_guid() {
        let text = include_str!("../../../../models/crane.toml");
        let document = Document::parse("crane.toml", text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        let mut table = Table::new(&document);
        let here = guid(text, &[], &table);
        for variable in &mut table.variables {
            if let Value::Real(start) = &mut variable.start {
                *start = start.next_up();
            }
        }
        assert_eq!(guid(text, &[], &table), here);
        table.variables[0].name.push('_');
        assert_ne!(guid(text, &[], &table), here);
        assert_ne!(
            guid(text, &[(String::from("foot.position[1]"), String::from("1"))], &table),
            guid(text, &[], &table)
        );
    }
}
