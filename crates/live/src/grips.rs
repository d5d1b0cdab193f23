//! The points of a mechanism that can be dragged: each has a load whose force the page gives, and an output of its
//! position and velocity. All are part of the model file that is simulated, so that the solver treats a drag like the
//! input of any host.

use ancf14::model::view::{Scene, Solid};
use serde::Serialize;
use std::fmt::Write;

/// At most so many points, of all beams together and of all bodies together.
const MOST: usize = 48;

/// A point that can be dragged.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Grip {
    /// The beam on which it is, as a number in the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    beam: Option<usize>,
    /// The body on which it is.
    #[serde(skip_serializing_if = "Option::is_none")]
    body: Option<usize>,
    /// `NAME@0.5` or a body.
    pub at: String,
    /// Offset from a body's center of mass, m, body axes.
    #[serde(skip)]
    offset: [f64; 3],
}

/// The points of a scene: nodes of beams, and the center and the faces of bodies.
pub fn grips(scene: &Scene) -> Vec<Grip> {
    let nodes: usize = scene.beams.iter().map(|beam| beam.nodes.len()).sum();
    // Both ends of each beam, and as many of its other nodes as there is room for.
    let every = nodes.div_ceil(MOST).max(1);
    let on_beams = scene.beams.iter().enumerate().flat_map(|(number, beam)| {
        let last = beam.nodes.len().saturating_sub(1);
        let chosen = beam.nodes.iter().enumerate().filter(move |(node, _)| node % every == 0 || *node == last);
        chosen.map(move |(_, station)| Grip {
            beam: Some(number),
            body: None,
            at: format!("{}@{:?}", beam.name, beam.fractions[*station]),
            offset: [0.0; 3],
        })
    });
    let all_sides = scene.bodies.len() * 7 <= MOST;
    let on_bodies = scene.bodies.iter().enumerate().flat_map(|(number, body)| {
        let half = match body.solid {
            Solid::Box(edges) => edges.map(|edge| edge / 2.0),
            Solid::Cylinder { axis, radius, length } => {
                [0, 1, 2].map(|side| if side == axis { length / 2.0 } else { radius })
            }
        };
        let sides = (0..6).map(move |side| {
            let mut offset = [0.0; 3];
            offset[side / 2] = if side % 2 == 0 { half[side / 2] } else { -half[side / 2] };
            offset
        });
        let offsets = std::iter::once([0.0; 3]).chain(sides.filter(move |_| all_sides));
        offsets.map(move |offset| Grip { beam: None, body: Some(number), at: body.name.clone(), offset })
    });
    on_beams.chain(on_bodies).collect()
}

/// A prefix of names that nothing in the model file has.
pub fn prefix(text: &str) -> String {
    let mut prefix = String::from("grip_");
    while text.contains(&prefix) {
        prefix.push('_');
    }
    prefix
}

/// The model file with a load and an output at each point.
pub fn with_grips(text: &str, prefix: &str, grips: &[Grip]) -> String {
    let mut all = text.to_owned();
    for (number, Grip { at, offset, .. }) in grips.iter().enumerate() {
        // A name may have quotes in it: a JSON string is a string of TOML.
        let mut at = serde_json::Value::from(at.as_str()).to_string();
        if *offset != [0.0; 3] {
            let point = format!("{prefix}point_{number}");
            let _ = write!(all, "\n[point.{point}]\non = {at}\noffset = {offset:?}\n");
            at = format!("\"{point}\"");
        }
        let _ = write!(
            all,
            "\n[load.{prefix}{number}]\nat = {at}\nforce = [0, 0, 0]\ninput = true\n\n[output.{prefix}place_{number}]\nat = {at}\nquantities = [\"position\", \"velocity\"]\n"
        );
    }
    all
}
