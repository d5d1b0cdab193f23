//! Does `ancf14 view` show what the solver computes? Stations must be where outputs at the same points are, and bear
//! what outputs there tell; signs must be where joints, springs and bodies are; shapes of modes must be those of
//! `ancf14 modes`. A picture from other places would be believed all the same.

use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14::model::view::{RESULTS, Recording, Track};

/// A curved, pretwisted beam that is bent and twisted by its weight, by a follower load, and by a body on its end; a
/// strip of two straight pieces hangs on it, with a corner between them.
const MODEL: &str = r#"format = 1
[model]
name = "Picture"
gravity = [0, 0, -9.81]
[material.soft]
young = 2e8
poisson = 0.3
density = 1200
[section.strip]
shape = "rectangle"
width = 0.03
height = 0.01
[section.tube]
shape = "tube"
inner = 0.008
outer = 0.01
[beam.arm]
material = "soft"
section = "strip"
curve = { x = "s", y = "0.2*s^2", z = "0.1*sin(2*s)", s = [0, 1] }
y_axis = [0, 1, 0]
pretwist = 0.4
elements = 4
[beam.leg]
material = "soft"
section = "tube"
curve = { points = [[1, 0.2, 0.1], [1, 0.2, -0.4], [1.3, 0.2, -0.4]], polyline = true }
elements = 4
[body.bob]
mass = 0.2
position = [1.3, 0.2, -0.5]
inertia = [1e-4, 2e-4, 3e-4, 2e-5, 0, 0]
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[joint.elbow]
type = "spherical"
a = "arm.end"
b = "leg.start"
at = [1, 0.2, 0.1]
[joint.hook]
type = "weld"
a = "leg.end"
b = "bob"
[spring.stay]
a = "ground"
b = "bob"
stiffness = 20
[load.push]
at = "arm.end"
force = [0, "2*t", 0]
moment = ["0.2*t", 0, 0]
follower = true
[load.wind]
on = "arm"
force = [0, "3*t", 0]
[output.along]
on = "arm"
stations = 9
quantities = ["position", "quaternion", "velocity", "section_force", "section_moment", "stress", "axial_strain", "curvature", "torsion"]
[output.down]
on = "leg"
stations = 5
quantities = ["position"]
[output.end]
at = "bob"
quantities = ["position"]
[output.held]
at = "elbow"
quantities = ["reaction_force", "reaction_moment"]
[simulation]
stop = 0.2
step = 2e-3
output_step = 0.05
"#;

fn simulation(overrides: &[(&str, &str)]) -> Simulation {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Simulation::load("picture.toml", MODEL, &overrides).unwrap()
}

/// A run with a look at its start and at each row.
fn recorded(overrides: &[(&str, &str)]) -> (Simulation, Recording) {
    let mut simulation = simulation(overrides);
    let mut recording = Recording::new(&simulation);
    simulation.initialize(0.0).unwrap();
    recording.record(&simulation);
    for row in 1..=4 {
        simulation.advance(0.05 * f64::from(row)).unwrap();
        recording.record(&simulation);
    }
    (simulation, recording)
}

fn track<'a>(recording: &'a Recording, name: &str) -> &'a Track {
    recording.tracks.iter().find(|track| track.name == name).unwrap()
}

/// The numbers of one thing at the last instant.
fn last(recording: &Recording, name: &str, thing: usize) -> Vec<f64> {
    let track = track(recording, name);
    let begin = track.values.len() - (track.things - thing) * track.components;
    track.values[begin..begin + track.components].to_vec()
}

fn output(simulation: &Simulation, name: &str) -> f64 {
    let reference = simulation.variables().iter().position(|variable| variable.name == name);
    simulation.value(reference.unwrap_or_else(|| panic!("{name}"))).number()
}

fn assert_near(found: f64, expected: f64, size: f64, what: &str) {
    // The same sections of the same state, read twice: round-off of turning them.
    assert!((found - expected).abs() <= 1e-10 * size, "{what}: {found:e}, {expected:e}");
}

/// Of all formulations: each station of the output is a station of the picture, with the same place, axes, forces,
/// strains and stress.
#[test]
fn stations_tell_what_outputs_tell() {
    for overrides in [&[("arm.twist", "linear")][..], &[("arm.twist", "quadratic")], &[("arm.element", "ancf24")]] {
        let (simulation, recording) = recorded(overrides);
        let beam = &recording.scene.beams[0];
        let steps = (beam.fractions.len() - 1) / 8;
        let turned = output(&simulation, "along.quaternion[9,2]") - beam.turns.last().unwrap()[1];
        assert!(turned.abs() > 1e-2, "the end must turn for the test to mean anything: {turned}");
        for station in 0..9 {
            let place = beam.stations.start + station * steps;
            let read = |quantity: &str, component: usize| {
                output(&simulation, &format!("along.{quantity}[{},{}]", station + 1, component + 1))
            };
            let single = |quantity: &str| output(&simulation, &format!("along.{quantity}[{}]", station + 1));
            approx::assert_relative_eq!(beam.fractions[station * steps], station as f64 / 8.0, epsilon = 1e-14);
            let found = last(&recording, "station.place", place);
            (0..3).for_each(|axis| assert_near(found[axis], read("position", axis), 1.0, "position"));
            let found = last(&recording, "station.turn", place);
            let along: f64 = (0..4).map(|part| found[part] * read("quaternion", part)).sum();
            assert_near(along.abs(), 1.0, 1.0, "quaternion");
            let speed = (0..3).map(|axis| read("velocity", axis).powi(2)).sum::<f64>().sqrt();
            let expected = [
                single("stress"),
                read("section_force", 0),
                read("section_force", 1),
                read("section_force", 2),
                read("section_moment", 0),
                read("section_moment", 1),
                read("section_moment", 2),
                single("axial_strain"),
                read("curvature", 0),
                read("curvature", 1),
                single("torsion"),
                speed,
            ];
            for (result, expected) in RESULTS.iter().zip(expected) {
                let size =
                    track(&recording, result.word).values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                assert!(size > 0.0, "{} is never there", result.word);
                assert_near(last(&recording, result.word, place)[0], expected, size, result.word);
            }
        }
    }
}

/// A corner has a station on each side of it, with axes of its own; both are at one place.
#[test]
fn a_corner_has_two_sides() {
    let (simulation, recording) = recorded(&[]);
    let leg = &recording.scene.beams[1];
    let corner = (1..leg.fractions.len()).find(|k| leg.fractions[*k] == leg.fractions[k - 1]).unwrap();
    let [before, after] = [corner - 1, corner].map(|k| leg.stations.start + k);
    let place = |station| last(&recording, "station.place", station);
    (0..3).for_each(|axis| assert_near(place(before)[axis], place(after)[axis], 1.0, "corner"));
    let turns = [corner - 1, corner].map(|k| leg.turns[k]);
    let along: f64 = turns[0].iter().zip(turns[1]).map(|(a, b)| a * b).sum();
    assert!(along.abs() < 0.99, "both sides have the same axes: {along}");
    // Four elements on 0.5 m and 0.3 m: equally spaced stations of the output are no nodes, but both ends are.
    for (station, place) in [(1, leg.stations.start), (5, leg.stations.end - 1)] {
        let found = last(&recording, "station.place", place);
        (0..3).for_each(|axis| {
            let expected = output(&simulation, &format!("down.position[{station},{}]", axis + 1));
            assert_near(found[axis], expected, 1.0, "end of the leg");
        });
    }
}

/// Joints, springs, bodies, loads and measured points are where the mechanism is at that instant.
#[test]
fn signs_go_with_the_mechanism() {
    let (simulation, recording) = recorded(&[]);
    let vector = |name: &str| [1, 2, 3].map(|axis| output(&simulation, &format!("{name}[{axis}]")));
    let near = |name: &str, thing: usize, expected: [f64; 3]| {
        let found = last(&recording, name, thing);
        (0..3).for_each(|axis| assert_near(found[axis], expected[axis], 1.0, name));
    };
    let end = [1, 2, 3].map(|axis| output(&simulation, &format!("along.position[9,{axis}]")));
    near("body.place", 0, vector("end.position"));
    near("point.place", 0, vector("end.position"));
    near("spring.b", 0, vector("end.position"));
    near("spring.a", 0, [0.0; 3]);
    near("load.place", 0, end);
    assert_eq!(recording.scene.loads[0].arrows, 0..1);
    let force = last(&recording, "load.force", 0);
    let moment = last(&recording, "load.moment", 0);
    let turn = last(&recording, "station.turn", recording.scene.beams[0].stations.end - 1);
    let [w, x, y, z] = [turn[0], turn[1], turn[2], turn[3]];
    let first = [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)];
    let second = [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)];
    for axis in 0..3 {
        assert_near(force[axis], 0.4 * second[axis], 1.0, "a follower load turns with its section");
        assert_near(moment[axis], 0.04 * first[axis], 1.0, "a follower moment turns with its section");
    }
    let elbow = recording.scene.joints.iter().position(|joint| joint.name == "elbow").unwrap();
    near("joint.force", elbow, vector("held.reaction_force"));
    near("joint.moment", elbow, vector("held.reaction_moment"));
    assert_eq!(recording.scene.joints[0].kind, "weld");
    assert!(recording.scene.joints[0].is_grounded && !recording.scene.joints[elbow].is_grounded);
    let wind = &recording.scene.loads[1];
    assert!(wind.is_line && wind.arrows.len() > 3, "{wind:?}");
}

/// The shapes of modes: at nodes and bodies those that `ancf14 modes` writes.
#[test]
fn modes_move_stations_as_they_move_nodes() {
    let mut simulation = simulation(&[("simulation.stop", "0.05")]);
    let mut recording = Recording::new(&simulation);
    simulation.initialize(0.0).unwrap();
    recording.record(&simulation);
    let found = simulation.modes(4).unwrap();
    for (swing, mode) in recording.swings(&simulation, &found).iter().zip(&found.modes) {
        let arm = &recording.scene.beams[0];
        for (node, local) in arm.nodes.iter().enumerate() {
            let (displacement, turn) = swing.stations[arm.stations.start + local];
            for axis in 0..3 {
                assert_near(displacement[axis], mode.motions[node].displacement[axis], 1.0, "displacement");
                assert_near(turn[axis], mode.motions[node].turn[axis], 1.0, "turn");
            }
        }
        let body = mode.motions[found.nodes].displacement;
        assert_eq!(swing.bodies[0].0, body);
        let places = |name: &str| &swing.places.iter().find(|(own, _)| *own == name).unwrap().1;
        (0..3).for_each(|axis| assert_near(places("spring.b")[0][axis], body[axis], 1.0, "spring"));
        assert_eq!(places("spring.a")[0], [0.0; 3]);
    }
}

/// A machine that is drawn far from the global origin is told from its own middle, so that single precision shows it.
#[test]
fn machines_far_away_are_told_from_their_middle() {
    let text = MODEL
        .replace("x = \"s\"", "x = \"s + 1e7\"")
        .replace("[[1, ", "[[10000001, ")
        .replace("[1, 0.2, -0.4]", "[10000001, 0.2, -0.4]");
    let text = text.replace("[1.3, ", "[10000001.3, ").replace("at = [1, ", "at = [10000001, ");
    let simulation = Simulation::load("far.toml", &text, &[]).unwrap();
    let recording = Recording::new(&simulation);
    assert!((recording.scene.origin[0] - 1e7).abs() < 10.0, "{:?}", recording.scene.origin);
    assert!(recording.scene.beams[0].places.iter().flatten().all(|part| part.abs() < 10.0));
}

/// A block of two falls, and a line of chain from the surface of the water to a bottom that rises.
const REEVED: &str = r#"format = 1
[model]
name = "Reeved"
gravity = [0, 0, -9.81]
[water]
density = 1025
surface = 1
depth = 5
ramp = 2
[wave.swell]
type = "airy"
height = 0.5
period = 4
[seabed]
stiffness = 1e5
slope = [0.1, 0]
[section.chain]
shape = "rigidities"
EA = 1e6
EI_y = 0
EI_z = 0
GJ = 0
line_density = 5
outer_diameter = 0.05
[beam.line]
section = "chain"
from = [-3, 0, 1]
to = [-2.5, 0, -2]
elements = 2
[joint.fairlead]
type = "spherical"
a = "ground"
b = "line.start"
[body.block]
mass = 50
position = [0, 0, 2]
inertia = [1, 1, 1]
[body.weight]
mass = 20
position = [1, 0, 2]
inertia = [1, 1, 1]
[surface.wheel]
shape = "cylinder"
on = "block"
axis = [0, 1, 0]
radius = 0.2
[surface.head]
shape = "cylinder"
axis = [0, 1, 0]
offset = [0.6, 0, 4]
radius = 0.3
[point.dead_end]
on = "ground"
offset = [-0.2, 0, 4]
[rope.fall]
from = "dead_end"
over = ["wheel", "head"]
turns = [-1, 1]
to = "weight"
radius = 0.01
stiffness = 1e5
[output.rope]
at = "fall"
quantities = ["length"]
[simulation]
stop = 0.2
step = 1e-3
output_step = 0.05
"#;

/// A rope runs from its first end over its sheaves to its last one: on the rims, with the length that its output tells.
/// The water is where the file has it.
#[test]
fn ropes_and_water_are_shown() {
    let mut simulation = Simulation::load("reeved.toml", REEVED, &[]).unwrap();
    let mut recording = Recording::new(&simulation);
    simulation.initialize(0.0).unwrap();
    simulation.advance(0.2).unwrap();
    recording.record(&simulation);
    let [rope] = &recording.scene.ropes[..] else { panic!("{:?}", recording.scene.ropes) };
    assert_eq!((rope.name.as_str(), rope.radius), ("fall", 0.01));
    let origin = recording.scene.origin;
    let points: Vec<[f64; 3]> =
        rope.points.clone().map(|point| last(&recording, "rope.place", point).try_into().unwrap()).collect();
    let apart = |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt();
    let length: f64 = points.windows(2).map(|pair| apart(&pair[0], &pair[1])).sum();
    // A chord of a sixteenth of 3.5 rad is shorter than its arc by (3.5/16)²/24 = 0.2 %.
    let told = output(&simulation, "rope.length");
    assert!(told > length && told - length < 0.002 * told, "{told} {length}");
    let [first, .., end] = &points[..] else { panic!("no points") };
    let place = |own: [f64; 3]| [0, 1, 2].map(|axis| own[axis] - origin[axis]);
    assert!(apart(first, &place([-0.2, 0.0, 4.0])) < 1e-12);
    assert!(apart(end, &last(&recording, "body.place", 1).try_into().unwrap()) < 1e-12);
    let center: [f64; 3] = last(&recording, "body.place", 0).try_into().unwrap();
    let on_rim = |center: &[f64; 3], radius: f64| {
        points.iter().filter(|point| (apart(point, center) - radius).abs() < 1e-12).count()
    };
    assert_eq!([on_rim(&center, 0.21), on_rim(&place([0.6, 0.0, 4.0]), 0.31)], [17, 17]);

    let water = recording.scene.water.as_ref().unwrap();
    assert!((water.surface + origin[2] - 1.0).abs() < 1e-12 && water.ramp == 2.0);
    let bottom = water.bottom.unwrap();
    let height = bottom.height + origin[2] - 0.1 * origin[0];
    assert!((height + 4.0).abs() < 1e-12 && bottom.slope == [0.1, 0.0]);
    assert_eq!(water.waves[0].amplitude, 0.25);
}
