//! The data of a page, as JSON: the words of docs/viewer/data.md. viewer/src/format.ts is the same from the other
//! side.

use super::block::{Effort, Quantized, quantized};
use super::charts::Charted;
use ancf14::model::modes::Kind;
use ancf14::model::view::{
    BeamLook, Profile, RESULTS, Recording, RopeLook, Scene, Solid, SurfaceLook, Swing, Track, WaterLook, Wave,
};
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Rises with every change that an older page would misread.
pub const FORMAT: u32 = 1;

/// All of it.
#[derive(Debug, Serialize)]
pub struct Data {
    pub format: u32,
    pub program: String,
    pub scene: Value,
    /// What whoever reads the page should know: that it has been thinned out, that the run ended early.
    pub notes: Vec<String>,
    /// The instants, as doubles in text.
    pub times: String,
    pub instants: usize,
    pub tracks: BTreeMap<&'static str, Quantized>,
    pub charts: Charted,
    pub modes: Vec<Value>,
}

/// The tracks of a recording; zeros instead of results that are round-off.
pub fn tracks(recording: &Recording, effort: Effort) -> BTreeMap<&'static str, Quantized> {
    let zeros = recording.zero_results();
    let shown = |track: &Track| match zeros.contains(&track.name) {
        true => quantized(&Track { values: vec![0.0; track.values.len()], ..*track }, effort),
        false => quantized(track, effort),
    };
    let has_things = |track: &&Track| track.things > 0;
    recording.tracks.iter().filter(has_things).map(|track| (track.name, shown(track))).collect()
}

/// What never changes.
pub fn scene(scene: &Scene) -> Value {
    let bodies = scene.bodies.iter().map(|body| {
        let solid = match body.solid {
            Solid::Box(edges) => json!({ "shape": "box", "edges": edges }),
            Solid::Cylinder { axis, radius, length } => {
                json!({ "shape": "cylinder", "axis": axis, "radius": radius, "length": length })
            }
        };
        json!({ "name": body.name, "mass": body.mass, "solid": solid })
    });
    let joints = scene.joints.iter().map(|joint| {
        json!({ "name": joint.name, "kind": joint.kind, "grounded": joint.is_grounded, "axis": joint.has_axis })
    });
    let loads = scene
        .loads
        .iter()
        .map(|load| json!({ "name": load.name, "line": load.is_line, "arrows": [load.arrows.start, load.arrows.end] }));
    let results = RESULTS.map(|result| json!({ "word": result.word, "unit": result.unit, "meaning": result.meaning }));
    let mut all = json!({
        "name": scene.name,
        "description": scene.description,
        "dynamic": scene.is_dynamic,
        "gravity": scene.gravity,
        "origin": scene.origin,
        "size": scene.size,
        "beams": scene.beams.iter().map(beam).collect::<Vec<_>>(),
        "bodies": bodies.collect::<Vec<_>>(),
        "frames": scene.frames,
        "joints": joints.collect::<Vec<_>>(),
        "springs": scene.springs,
        "loads": loads.collect::<Vec<_>>(),
        "points": scene.points,
        "results": results,
    });
    if !scene.surfaces.is_empty() {
        all["surfaces"] = scene.surfaces.iter().map(surface).collect();
    }
    if !scene.ropes.is_empty() {
        let rope = |own: &RopeLook| json!({ "name": own.name, "radius": own.radius, "points": [own.points.start, own.points.end] });
        all["ropes"] = scene.ropes.iter().map(rope).collect();
    }
    if let Some(water) = &scene.water {
        all["water"] = sea(water);
    }
    all
}

fn surface(surface: &SurfaceLook) -> Value {
    let mut all = json!({ "name": surface.name, "corners": surface.mesh.corners, "faces": surface.mesh.faces });
    if surface.is_bottom {
        all["bottom"] = json!(true);
    }
    all
}

fn sea(water: &WaterLook) -> Value {
    let wave = |own: &Wave| {
        let [x, y] = own.direction;
        [own.amplitude, own.frequency, own.number, x, y, own.phase]
    };
    let mut all = json!({ "surface": water.surface, "ramp": water.ramp });
    if !water.waves.is_empty() {
        all["waves"] = json!(water.waves.iter().map(wave).collect::<Vec<_>>());
    }
    if let Some(bottom) = &water.bottom {
        all["bottom"] = json!({ "height": bottom.height, "slope": bottom.slope });
    }
    all
}

fn beam(beam: &BeamLook) -> Value {
    let profile = match beam.profile {
        Profile::Rectangle { width, height } => json!({ "shape": "rectangle", "width": width, "height": height }),
        Profile::Ellipse { y, z } => json!({ "shape": "ellipse", "y": y, "z": z }),
        Profile::Tube { inner, outer } => json!({ "shape": "tube", "inner": inner, "outer": outer }),
    };
    let places = Track { name: "place", components: 3, things: beam.places.len(), values: beam.places.concat() };
    let turns = Track { name: "turn", components: 4, things: beam.turns.len(), values: beam.turns.concat() };
    let mut all = json!({
        "name": beam.name,
        "profile": profile,
        "stress": beam.has_stress,
        "stations": [beam.stations.start, beam.stations.end],
        "fractions": beam.fractions,
        "nodes": beam.nodes,
        "drawn": { "place": quantized(&places, Effort::Small), "turn": quantized(&turns, Effort::Small) },
    });
    if !beam.sizes.is_empty() {
        all["sizes"] = json!(beam.sizes);
    }
    all
}

/// A natural mode.
pub fn mode(swing: &Swing) -> Value {
    let kind = match swing.kind {
        Kind::Vibration => "vibration",
        Kind::Free => "free",
        Kind::Unstable => "unstable",
    };
    let motion = |pairs: &[([f64; 3], [f64; 3])]| {
        let (places, turns): (Vec<_>, Vec<_>) = pairs.iter().copied().unzip();
        json!({ "place": quantized(&vectors_of(&places), Effort::Small), "turn": quantized(&vectors_of(&turns), Effort::Small) })
    };
    let places: BTreeMap<&str, Quantized> =
        swing.places.iter().map(|(name, vectors)| (*name, quantized(&vectors_of(vectors), Effort::Small))).collect();
    json!({
        "kind": kind,
        "frequency": swing.angular_frequency / std::f64::consts::TAU,
        "growth": swing.growth_rate,
        "moves": swing.moves,
        "stations": motion(&swing.stations),
        "bodies": motion(&swing.bodies),
        "places": places,
    })
}

/// Vectors of one instant.
fn vectors_of(vectors: &[[f64; 3]]) -> Track {
    Track { name: "vectors", components: 3, things: vectors.len(), values: vectors.concat() }
}
