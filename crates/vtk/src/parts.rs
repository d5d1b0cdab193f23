//! The parts of a mechanism at an instant, as points, lines and polygons with what is known there.

use super::polydata::{Array, Cells, PolyData};
use super::solids::surface;
use ancf14::model::view::{BeamLook, LoadLook, Profile, RESULTS, Recording, Scene};

/// What was recorded of the last instant.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a>(pub &'a Recording);

/// A kind of part: the name of its files, whether a mechanism has it, and what it is at an instant.
type Kind = (&'static str, fn(&Scene) -> bool, fn(Instant<'_>) -> PolyData);

/// Corners of a shape in its own axes, m, and its faces.
type Shape = (Vec<[f64; 3]>, Vec<Vec<usize>>);

/// All kinds.
pub const KINDS: [Kind; 10] = [
    ("beams", |scene| !scene.beams.is_empty(), beams),
    ("bodies", |scene| !scene.bodies.is_empty(), bodies),
    ("joints", |scene| !scene.joints.is_empty(), joints),
    ("loads", |scene| scene.loads.iter().any(|load| !load.is_line), loads),
    ("line_loads", |scene| scene.loads.iter().any(|load| load.is_line), line_loads),
    ("springs", |scene| !scene.springs.is_empty(), springs),
    ("ropes", |scene| !scene.ropes.is_empty(), ropes),
    ("frames", |scene| !scene.frames.is_empty(), frames),
    ("outputs", |scene| !scene.points.is_empty(), outputs),
    ("surfaces", |scene| !scene.surfaces.is_empty(), surfaces),
];

/// Names of the axes of sections, bodies, joints and frames.
const AXES: [&str; 3] = ["axis_x", "axis_y", "axis_z"];

impl<'a> Instant<'a> {
    fn scene(self) -> &'a Scene {
        &self.0.scene
    }

    /// The numbers of a track.
    fn track(self, name: &str) -> Option<&'a [f64]> {
        let track = self.0.tracks.iter().find(|track| track.name == name)?;
        let width = track.components * track.things;
        track.values.get(track.values.len().checked_sub(width)?..)
    }

    /// Vectors of a track.
    fn vectors(self, name: &str) -> &'a [[f64; 3]] {
        self.track(name).unwrap_or_default().as_chunks().0
    }

    /// Places of a track, global, m.
    fn places(self, name: &str) -> Vec<[f64; 3]> {
        let origin = self.scene().origin;
        self.vectors(name).iter().map(|place| [0, 1, 2].map(|axis| origin[axis] + place[axis])).collect()
    }

    /// Axes of a track of quaternions.
    fn axes(self, name: &str) -> Vec<[[f64; 3]; 3]> {
        self.track(name).unwrap_or_default().as_chunks().0.iter().map(axes).collect()
    }
}

/// The axes that a unit quaternion `w x y z` turns x, y and z into.
fn axes(&[w, x, y, z]: &[f64; 4]) -> [[f64; 3]; 3] {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// Axes as three arrays.
fn directions(axes: &[[[f64; 3]; 3]]) -> impl Iterator<Item = Array> {
    AXES.iter()
        .enumerate()
        .map(|(number, name)| Array::reals(name, "", 3, axes.iter().flat_map(|own| own[number]).collect()))
}

/// Extent of the section at each station of a beam to both sides of its axis, along y and z, m.
fn half_sizes(beam: &BeamLook) -> impl Iterator<Item = [f64; 2]> {
    let [y, z] = match beam.profile {
        Profile::Rectangle { width, height } => [width / 2.0, height / 2.0],
        Profile::Ellipse { y, z } => [y, z],
        Profile::Tube { outer, .. } => [outer; 2],
    };
    (0..beam.fractions.len()).map(move |station| {
        let [along_y, along_z] = beam.sizes.get(station).copied().unwrap_or([1.0; 2]);
        [y * along_y, z * along_z]
    })
}

/// Beams as lines through their stations, a line for each smooth piece.
fn beams(at: Instant<'_>) -> PolyData {
    let scene = at.scene();
    let points = at.places("station.place");
    let drawn = scene.beams.iter().flat_map(|beam| &beam.places);
    let displacement = at
        .vectors("station.place")
        .iter()
        .zip(drawn)
        .flat_map(|(now, before)| [0, 1, 2].map(|axis| now[axis] - before[axis]));
    let sizes: Vec<[f64; 2]> = scene.beams.iter().flat_map(half_sizes).collect();
    let fractions = scene.beams.iter().flat_map(|beam| beam.fractions.iter().copied());
    let mut on_points = vec![
        Array::reals("displacement", "m", 3, displacement.collect()),
        Array::reals("fraction", "", 1, fractions.collect()),
        Array::reals("half_size", "m", 2, sizes.concat()),
        // A circle of the same area as the ellipse of these semi-axes.
        Array::reals("radius", "m", 1, sizes.iter().map(|[y, z]| (y * z).sqrt()).collect()),
    ];
    on_points.extend(directions(&at.axes("station.turn")));
    for result in RESULTS {
        let mut values = at.track(result.word).unwrap_or_default().to_vec();
        if result.word == "stress" {
            for beam in scene.beams.iter().filter(|beam| !beam.has_stress) {
                values.get_mut(beam.stations.clone()).into_iter().for_each(|own| own.fill(f64::NAN));
            }
        }
        on_points.push(Array::reals(result.word, result.unit, 1, values));
    }
    let pieces: Vec<(usize, Vec<usize>)> = scene
        .beams
        .iter()
        .enumerate()
        .flat_map(|(number, beam)| pieces(beam).map(move |piece| (number, piece)))
        .collect();
    let owners: Vec<usize> = pieces.iter().map(|(number, _)| *number).collect();
    let names = owners.iter().map(|number| scene.beams[*number].name.clone()).collect();
    PolyData {
        points,
        cells: Cells::Lines(pieces.into_iter().map(|(_, piece)| piece).collect()),
        on_points,
        on_cells: vec![Array::counts("beam", owners), Array::names(names)],
    }
}

/// The smooth pieces of a beam: at a corner there are two stations at one fraction.
fn pieces(beam: &BeamLook) -> impl Iterator<Item = Vec<usize>> {
    let mut begin = beam.stations.start;
    beam.fractions.chunk_by(|before, after| before < after).map(move |piece| {
        let own = begin..begin + piece.len();
        begin = own.end;
        own.collect()
    })
}

/// Bodies as boxes and cylinders of their inertia.
fn bodies(at: Instant<'_>) -> PolyData {
    let bodies = &at.scene().bodies;
    let shapes = bodies.iter().map(|body| surface(body.solid)).collect();
    let names = bodies.iter().map(|body| &body.name).collect();
    let (mut all, owners) = polygons(at, "body", shapes, names);
    let masses = owners.iter().map(|number| bodies[*number].mass).collect();
    all.on_cells.push(Array::reals("mass", "kg", 1, masses));
    all
}

/// Surfaces as their polygons.
fn surfaces(at: Instant<'_>) -> PolyData {
    let all = &at.scene().surfaces;
    let shapes = all.iter().map(|own| (own.mesh.corners.clone(), own.mesh.faces.clone())).collect();
    polygons(at, "surface", shapes, all.iter().map(|own| &own.name).collect()).0
}

/// The corners and the faces of shapes where the tracks of `word` have them, and which shape each face is of.
fn polygons(at: Instant<'_>, word: &'static str, shapes: Vec<Shape>, names: Vec<&String>) -> (PolyData, Vec<usize>) {
    let (mut points, mut polygons, mut owners) = (Vec::new(), Vec::new(), Vec::new());
    let poses = at.places(&format!("{word}.place")).into_iter().zip(at.axes(&format!("{word}.turn")));
    for (number, ((corners, faces), (place, axes))) in shapes.into_iter().zip(poses).enumerate() {
        let first = points.len();
        polygons
            .extend(faces.into_iter().map(|face| face.into_iter().map(|corner| first + corner).collect::<Vec<_>>()));
        owners.resize(polygons.len(), number);
        let turned = |corner: [f64; 3]| {
            [0, 1, 2].map(|k| place[k] + (0..3).map(|axis| axes[axis][k] * corner[axis]).sum::<f64>())
        };
        points.extend(corners.into_iter().map(turned));
    }
    let names = owners.iter().map(|number| names[*number].clone()).collect();
    let on_cells = vec![Array::counts(word, owners.clone()), Array::names(names)];
    (PolyData { points, cells: Cells::Polygons(polygons), on_points: Vec::new(), on_cells }, owners)
}

/// Named points.
fn points(points: Vec<[f64; 3]>, names: Vec<String>, arrays: impl IntoIterator<Item = Array>) -> PolyData {
    let on_points = [Array::names(names)].into_iter().chain(arrays).collect();
    PolyData { points, cells: Cells::Points, on_points, on_cells: Vec::new() }
}

/// Joints as points, with the load on side b where it is known.
fn joints(at: Instant<'_>) -> PolyData {
    let names = at.scene().joints.iter().map(|joint| joint.name.clone()).collect();
    let load = |track: &str, name: &'static str, unit: &'static str| {
        Some(Array::reals(name, unit, 3, at.track(track)?.to_vec()))
    };
    let loads = [load("joint.force", "force", "N"), load("joint.moment", "moment", "N.m")];
    points(at.places("joint.place"), names, directions(&at.axes("joint.turn")).chain(loads.into_iter().flatten()))
}

/// Loads at a point.
fn loads(at: Instant<'_>) -> PolyData {
    loaded(at, ["N", "N.m"], |load| !load.is_line)
}

/// Loads along a beam: points of it with the load per length.
fn line_loads(at: Instant<'_>) -> PolyData {
    loaded(at, ["N/m", "N"], |load| load.is_line)
}

fn loaded(at: Instant<'_>, units: [&'static str; 2], is_wanted: impl Fn(&LoadLook) -> bool) -> PolyData {
    let places = at.places("load.place");
    // A load that acts nowhere has no arrows.
    let is_there = |load: &&LoadLook| load.arrows.end <= places.len();
    let wanted: Vec<&LoadLook> = at.scene().loads.iter().filter(|load| is_wanted(load)).filter(is_there).collect();
    let own = |vectors: &[[f64; 3]]| -> Vec<[f64; 3]> {
        wanted.iter().flat_map(|load| &vectors[load.arrows.clone()]).copied().collect()
    };
    let names = wanted.iter().flat_map(|load| load.arrows.clone().map(|_| load.name.clone())).collect();
    let array = |name: &'static str, unit: &'static str, track: &str| {
        Array::reals(name, unit, 3, own(at.vectors(track)).concat())
    };
    let arrays = [array("force", units[0], "load.force"), array("moment", units[1], "load.moment")];
    points(own(&places), names, arrays)
}

/// Springs between two points as lines.
fn springs(at: Instant<'_>) -> PolyData {
    let ends = [at.places("spring.a"), at.places("spring.b")];
    let count = ends[0].len();
    let lines = (0..count).map(|number| vec![number, count + number]).collect();
    let names = Array::names(at.scene().springs.clone());
    PolyData { points: ends.concat(), cells: Cells::Lines(lines), on_points: Vec::new(), on_cells: vec![names] }
}

/// Ropes as lines over their sheaves.
fn ropes(at: Instant<'_>) -> PolyData {
    let ropes = &at.scene().ropes;
    let lines = ropes.iter().map(|rope| rope.points.clone().collect()).collect();
    let names = Array::names(ropes.iter().map(|rope| rope.name.clone()).collect());
    PolyData {
        points: at.places("rope.place"),
        cells: Cells::Lines(lines),
        on_points: Vec::new(),
        on_cells: vec![names],
    }
}

/// Moving frames as points with their axes.
fn frames(at: Instant<'_>) -> PolyData {
    points(at.places("frame.place"), at.scene().frames.clone(), directions(&at.axes("frame.turn")))
}

/// Points at which something is measured.
fn outputs(at: Instant<'_>) -> PolyData {
    points(at.places("point.place"), at.scene().points.clone(), [])
}
