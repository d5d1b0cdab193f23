//! A run as a page has it, and the second run of a page that compares two.

use super::format::FORMAT;
use serde_json::Value;

/// What stands before and after the data in a page.
const BEGIN: &str = "<script type=\"application/json\" id=\"data\">";
const END: &str = "</script>";

/// The data in a page, as JSON; none if the text is not a page with data.
pub fn data(page: &str) -> Option<&str> {
    let (_, rest) = page.split_once(BEGIN)?;
    rest.split_once(END).map(|(data, _)| data)
}

/// The data of a run, of which a page is made.
#[derive(Clone, Debug)]
pub struct Shown {
    /// Name of the model.
    pub name: String,
    /// Instants in the picture.
    pub instants: usize,
    /// Everything, as JSON.
    pub(crate) json: String,
}

/// A second run, which a page shows as a ghost of the first one.
#[derive(Clone, Debug)]
pub struct Second {
    /// What the page calls the two runs.
    pub names: [String; 2],
    /// Its data.
    pub run: Shown,
}

impl Shown {
    /// The run that a page shows, the first one of two; none if the text is not a page with data that this version
    /// reads.
    pub fn of_page(page: &str) -> Option<Self> {
        let json = data(page)?;
        let found: Value = serde_json::from_str(json).ok()?;
        if found["format"] != FORMAT {
            return None;
        }
        let name = found["scene"]["name"].as_str()?.to_owned();
        let instants = usize::try_from(found["instants"].as_u64()?).ok()?;
        Some(Self { name, instants, json: json.to_owned() })
    }
}

impl Second {
    /// The second run as the page has it, in JSON.
    pub(crate) fn json(&self) -> Result<String, serde_json::Error> {
        Ok(format!(r#"{{"names":{},"data":{}}}"#, serde_json::to_string(&self.names)?, self.run.json))
    }
}

#[cfg(test)]
mod tests {
    use super::super::block::{Effort, doubles, quantized};
    use super::*;
    use ancf14::model::view::Track;
    use serde_json::json;

    /// viewer/test/second.json has what this side writes of a second run; viewer/test/comparison.test.ts reads it.
    #[test]
    fn the_other_side_reads_a_second_run() {
        let track = Track { name: "body.place", components: 3, things: 1, values: vec![0.0, 1.0, 2.0, 4.0, 5.0, 6.0] };
        let small = Effort::Small;
        let solid = json!({ "shape": "box", "edges": [1.0, 1.0, 1.0] });
        let json = json!({
            "format": FORMAT, "program": "ancf14", "notes": ["a note"], "times": doubles(&[0.5, 2.0], small), "instants": 2, "modes": [],
            "scene": { "name": "Box", "origin": [1.0, 2.0, 3.0], "size": 1.0, "beams": [], "bodies": [{ "name": "box", "mass": 1.0, "solid": solid }] },
            "tracks": { "body.place": quantized(&track, small) },
            "charts": {
                "count": 2, "times": doubles(&[0.5, 2.0], small), "columns": [{ "name": "box.x", "unit": "m", "data": doubles(&[0.0, 4.0], small) }],
                "groups": [{ "name": "box.x", "unit": "m", "columns": [0] }],
            },
        });
        let run = Shown { name: "Box".to_owned(), instants: 2, json: json.to_string() };
        let second = Second { names: ["first.toml".to_owned(), "second.toml, steel.young = 1e11".to_owned()], run };
        let written: Value = serde_json::from_str(&second.json().unwrap()).unwrap();
        let text = format!("{}\n", serde_json::to_string_pretty(&written).unwrap());
        assert_eq!(text, include_str!("../../../viewer/test/second.json"), "{text}");
    }
}
