//! Is a surface where the file draws it, does it move with its part, and does it leave the mechanism alone? A surface
//! that stays behind its part, or that turns the other way, would be believed in every picture.

use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::model::document::Document;
use ancf14::model::drawing::{Drawing, LineKind};
use ancf14::model::entries::surface::Mesh;
use ancf14::model::simulation::Simulation;
use ancf14::model::view::Recording;
use approx::assert_relative_eq;
use nalgebra::{Quaternion, UnitQuaternion};
use std::f64::consts::PI;

/// A table turns about z at 2 rad/s, starting from 0.5 rad; a ball falls freely.
const MODEL: &str = r#"format = 1
[model]
name = "Surfaces"
gravity = [0, 0, -10]
[frame.table]
position = [1, 0, 0]
rotation = [0, 0, "0.5 + 2*t"]
[body.ball]
mass = 2
position = [0, 0, 3]
inertia = [0.1, 0.1, 0.1]
[output.fall]
at = "ball"
quantities = ["position"]
[simulation]
stop = 0.5
step = 0.01
"#;

const SURFACES: &str = r#"
[surface.floor]
shape = "plane"
offset = [0, 0, -1]
normal = [0, 0, 2]
[surface.drum]
on = "table"
shape = "cylinder"
offset = [0.2, 0, 0]
axis = [1, 0, 0]
radius = 0.1
length = 0.4
[surface.skin]
on = "ball"
shape = "sphere"
radius = 0.25
"#;

fn loaded(text: &str) -> Simulation {
    Simulation::load("surfaces.toml", text, &[]).unwrap()
}

fn with_surfaces() -> String {
    format!("{MODEL}{SURFACES}")
}

/// Place of each surface, and its first axis, at the instant that was recorded last.
fn poses(recording: &Recording) -> Vec<(Vec3, Vec3)> {
    let last = |name: &str| {
        let track = recording.tracks.iter().find(|track| track.name == name).unwrap();
        track.values[track.values.len() - track.things * track.components..].to_vec()
    };
    let (places, turns) = (last("surface.place"), last("surface.turn"));
    let axis =
        |turn: &[f64]| UnitQuaternion::from_quaternion(Quaternion::new(turn[0], turn[1], turn[2], turn[3])) * Vec3::x();
    places.chunks(3).zip(turns.chunks(4)).map(|(place, turn)| (Vec3::from_column_slice(place), axis(turn))).collect()
}

/// As drawn the directions are those of the file. After half a second the table has turned by 1 rad and the ball has
/// fallen by 1.25 m, `g t²/2`, which the midpoint rule hits exactly. Tolerance: round-off of 50 steps.
#[test]
fn surfaces_move_with_their_parts() {
    let mut simulation = loaded(&with_surfaces());
    let mut recording = Recording::new(&simulation);
    simulation.initialize(0.0).unwrap();
    recording.record(&simulation);
    let at_table = |angle: f64| Vec3::new(1.0 + 0.2 * angle.cos(), 0.2 * angle.sin(), 0.0);
    let origin = Vec3::from(recording.scene.origin);
    let check = |poses: &[(Vec3, Vec3)], places: [Vec3; 3], axis: Vec3| {
        for ((place, _), expected) in poses.iter().zip(places) {
            assert_relative_eq!(*place + origin, expected, epsilon = 1e-10);
        }
        assert_relative_eq!(poses[0].1, Vec3::z(), epsilon = 1e-12);
        assert_relative_eq!(poses[1].1, axis, epsilon = 1e-10);
    };
    let floor = Vec3::new(0.0, 0.0, -1.0);
    check(&poses(&recording), [floor, at_table(0.5), Vec3::new(0.0, 0.0, 3.0)], Vec3::x());
    simulation.advance(0.5).unwrap();
    recording.record(&simulation);
    let turned = Vec3::new(1.0_f64.cos(), 1.0_f64.sin(), 0.0);
    check(&poses(&recording), [floor, at_table(1.5), Vec3::new(0.0, 0.0, 1.75)], turned);
}

/// Nothing touches a surface: results are bit-identical to those of the model without surfaces.
#[test]
fn surfaces_change_no_result() {
    let end = |text: &str| {
        let mut simulation = loaded(text);
        simulation.initialize(0.0).unwrap();
        simulation.advance(0.5).unwrap();
        let position = simulation.variables().iter().position(|variable| variable.name == "fall.position[3]").unwrap();
        simulation.value(position).number().to_bits()
    };
    assert_eq!(end(MODEL), end(&with_surfaces()));
}

/// The volume that polygons enclose, m³.
fn volume(mesh: &Mesh) -> f64 {
    let corner = |corner: usize| Vec3::from(mesh.corners[corner]);
    let triangles = mesh.faces.iter().flat_map(|face| face[1..].windows(2).map(|pair| [face[0], pair[0], pair[1]]));
    triangles.map(|all| all.map(corner)).map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum()
}

/// The volume that polygons enclose, by the divergence theorem: negative if their corners run clockwise as seen from
/// outside. A prism of 24 sides has `12 r² sin(2π/24)` of the area of its circle; the rings of the sphere leave out
/// 2.6 % of it. A cylinder has no ends, whose share of `∮ x·n dA/3` is a third.
#[test]
fn meshes_enclose_their_volume() {
    let document = Document::parse("surfaces.toml", &with_surfaces(), &[]).unwrap();
    let scene = Recording::new(&loaded(&with_surfaces())).scene;
    let volume = |number: usize| volume(&scene.surfaces[number].mesh);
    let area = 12.0 * (PI / 12.0).sin() * 0.1_f64.powi(2);
    assert_relative_eq!(volume(1), 2.0 / 3.0 * area * 0.4, epsilon = 1e-15);
    let share = volume(2) / (4.0 / 3.0 * PI * 0.25_f64.powi(3));
    assert!((0.96..0.985).contains(&share), "{share}");
    let drawing = Drawing::new(&document);
    let named: Vec<_> =
        drawing.lines.iter().filter(|line| line.kind == LineKind::Face && !line.name.is_empty()).collect();
    assert_eq!(named.iter().map(|line| line.name.as_str()).collect::<Vec<_>>(), ["floor", "drum", "skin"]);
    // The first corner of the first face of the drum: at its end and on its wall, drawn in global axes.
    let corner = Vec3::from(named[1].points[0]) - Vec3::new(1.0 + 0.2 * 0.5_f64.cos(), 0.2 * 0.5_f64.sin(), 0.0);
    assert_relative_eq!(corner.x, -0.2, epsilon = 1e-12);
    assert_relative_eq!(corner.norm(), 0.2_f64.hypot(0.1), epsilon = 1e-12);
}

/// Rings, boxes and cones are closed, and a box has its edges in rows: the prism of 24 sides has `12 sin(2π/24)` of the
/// squared radius, and what runs around a ring has that share of `2 R` times its section.
#[test]
fn meshes_of_closed_shapes() {
    let text = format!(
        "{MODEL}[surface.eye]\nshape = \"ring\"\naxis = [0, 1, 0]\nradius = 0.3\nwire = 0.05\n\
         [surface.block]\non = \"table\"\nshape = \"box\"\nsize = [0.1, 0.2, 0.4]\n\
         edges = [[0, 0.6, 0.8], [1, 0, 0], [0, 0.8, -0.6]]\n\
         [surface.spike]\nshape = \"cone\"\naxis = [0, 0, 1]\nradius = 0.2\nend_radius = 0.1\nlength = 0.6\n"
    );
    let mut recording = Recording::new(&loaded(&text));
    recording.record(&loaded(&text));
    let volumes: Vec<f64> = recording.scene.surfaces.iter().map(|own| volume(&own.mesh)).collect();
    let round = 12.0 * (PI / 12.0).sin();
    let exact = [2.0 * 0.3 * round * round * 0.05 * 0.05, 0.008, round * 0.6 / 3.0 * (0.04 + 0.02 + 0.01)];
    for (found, exact) in volumes.iter().zip(exact) {
        assert_relative_eq!(*found, exact, epsilon = 1e-15);
    }
    assert_relative_eq!(poses(&recording)[1].1, Vec3::new(0.0, 0.6, 0.8), epsilon = 1e-12);
}

/// A copy that is turned by a right angle about z and moved has the offset and the normal of a plane on the ground
/// turned, of which the offset moves along.
#[test]
fn copies_turn_their_surfaces() {
    let text = format!(
        "{MODEL}[copy.wall]\ncount = 1\nturn = {{ axis = [0, 0, 1], angle = \"pi/2\" }}\nmove = [0, 0, 5]\n\
         [copy.wall.surface.side]\nshape = \"plane\"\noffset = [2, 0, 0]\nnormal = [-1, 0, 0]\n"
    );
    let mut recording = Recording::new(&loaded(&text));
    recording.record(&loaded(&text));
    let poses = poses(&recording);
    assert_relative_eq!(poses[0].0 + Vec3::from(recording.scene.origin), Vec3::new(0.0, 2.0, 5.0), epsilon = 1e-12);
    assert_relative_eq!(poses[0].1, Vec3::new(0.0, -1.0, 0.0), epsilon = 1e-12);
}
