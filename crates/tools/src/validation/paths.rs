//! Paths of equilibria past limit and branch points, against integrated rods and closed forms.

use super::{Section, dots, line, plot, study};
use ancf14_testing::paths::{Arch, Case, follow, number_behind};
use ancf14_testing::running::start;
use std::fmt::Write;
use std::process::Command;

const RIGHT_ANGLE: &str = include_str!("../../../../tests/machines/right_angle_frame.toml");

/// Meshes of Lee's frame, elements of a leg, and of arches.
const LEE: [usize; 3] = [5, 10, 20];
const ARCHES: [usize; 2] = [16, 32];

/// A path and its rod's points, as displacement downward over the load.
fn curves(name: &str, color: usize, case: &Case) -> [super::Line; 2] {
    let (points, _) = case.equilibria();
    let own = points.iter().map(|point| case.rod.scaled(point)).map(|[_, z, load]| (-z, load)).collect();
    let exact = case.rod.near(&points).into_iter().step_by(4).map(|[_, z, load]| (-z, load)).collect();
    [line(name, color, own), dots("its rod", color, exact)]
}

/// Rows of the table of one path.
fn rows(name: &str, meshes: &[usize], case: impl Fn(usize) -> Case) -> String {
    let mut text = String::new();
    let mut before = None;
    for &elements in meshes {
        let case = case(elements);
        let (points, told) = case.equilibria();
        let worst = case.rod.distance_from(&points);
        let order = before.map_or(String::new(), |before: f64| format!("{:.2}", (before / worst).log2()));
        let limit = case.load * number_behind(&told, "t has a maximum of ");
        // In units of the rigidity and the size of the rod: length of a leg, radius.
        let power = if matches!(case.rod.load, ancf14_testing::planar_rod::Load::At(_)) { 2 } else { 3 };
        let limit = limit * case.rod.scales[0].powi(power) / case.rod.bending;
        let _ = writeln!(text, "| {name} | {elements} | {limit:.4} | {} | {order} |", study::small(worst));
        before = Some(worst);
    }
    text
}

pub fn write(section: &mut Section) {
    section.say(
        "Static analyses with `follow = \"arc_length\"` ([model-file.md](model-file.md#a-path-past-its-limit-load)). Lee's frame (`models/lee_frame.toml`) under a load that keeps its direction and under one that turns with the girder; a clamped shallow arch of 57 \
         degrees; an arch of 215 degrees, hinged at one foot and clamped at the other. Loads act at a point or along the whole arch, downward or as a pressure.\n\n\
         References: the same frames as extensible rods in a plane, integrated by Runge and Kutta's method and shot at the far support, at every row of the run, in the plane across the path. `off by` is the largest distance of a row from the rod's path, \
         displacements over the side or the radius, loads over the largest one. The first limit load is in EI/L^2, EI/R^2 for a load at a point, EI/R^3 for one along the arch; the deep arch bears 8.97 at its crown (DaDeppo and Schmidt 1975).",
    );
    let mut table = String::from("| path | elements | limit load | off by | order |\n|---|---|---|---|---|\n");
    for (name, follower) in [("Lee's frame", false), ("Lee's frame, follower load", true)] {
        table += &rows(name, &LEE, |elements| Case::lee(elements, follower));
    }
    for (name, arch) in Arch::all() {
        table += &rows(name, &ARCHES, |elements| Case::arch(&arch, elements));
    }
    section.say(&table);
    let lee = [("dead load", false), ("follower load", true)].into_iter().enumerate();
    let lines = lee.flat_map(|(color, (name, follower))| curves(name, color, &Case::lee(10, follower))).collect();
    let axes = ["downward displacement / L", "load / (18.5 EI/L^2)"];
    section.picture("paths_lee", plot("Lee's frame: 10 elements a leg, and integrated rods", axes, lines));
    let arches = Arch::all().into_iter().enumerate();
    let lines = arches
        .flat_map(|(color, (name, arch))| curves(&name.replace(" arch", ""), color, &Case::arch(&arch, 32)))
        .collect();
    let axes = ["downward displacement of the crown / R", "load over that of the file"];
    section.picture("paths_arches", plot("Arches: 32 elements, and integrated rods", axes, lines));

    let (_, told) = Case::half_circle(32).equilibria();
    let sways = 3.0 * number_behind(&told, ", t = ");
    let names = ["hinge.angle", "path.parameter"];
    let (frame, told) = follow(&mut start(RIGHT_ANGLE), 0.05, 13.95, &names);
    let leaves = number_behind(&told, ", t = ");
    let last = told.iter().rev().find(|sentence| sentence.contains("limit point")).cloned();
    let returns = number_behind(last.as_slice(), "t has a maximum of ");
    section.say(&format!(
        "Branch points. A half circle, hinged at both feet, sways under a pressure of {sways:.5} EI/R^3 (3 without compression; 32 elements). The right-angle frame of Argyris (`tests/machines/right_angle_frame.toml`), a sheet cut to an angle whose ends are turned \
         by moments, leaves its plane at {leaves:.6} N m, and its path is followed until its ends have turned around once and it is flat again, at {returns:.6} N m: the opposite, by symmetry, to {:.0e}.",
        (1.0 + returns / leaves).abs()
    ));
    let path = frame.iter().map(|row| (row[0].to_degrees(), row[1])).collect();
    let lines = vec![line("moment", 0, path)];
    let axes = ["turn of an end (degrees)", "moment (N m)"];
    section.picture("paths_right_angle", plot("Right-angle frame: the whole path", axes, lines));
}

/// The same path by load steps of the peer.
pub fn peer(section: &mut Section) {
    section.say(
        "EXUDYN 1.13.6 (`scripts/peer-env.sh`, `crates/tools/benches/peer/lee.py`) on Lee's frame, 10 elements a leg: its static solver increases the load step by step and halves steps that fail. It has no arc length, and stops before the limit load. `last` is the last \
         equilibrium that it finds, `limit` the limit load of the section above, both over EI/L^2.",
    );
    let root = ancf14_testing::root();
    let output = Command::new(root.join("target/peer-env/bin/python"))
        .arg("lee.py")
        .current_dir(root.join("crates/tools/benches/peer"))
        .output()
        .expect("the peer is installed: scripts/peer-env.sh");
    let text = String::from_utf8(output.stdout).expect("the peer prints text");
    let case = Case::lee(10, false);
    let limit = number_behind(&case.equilibria().1, "t has a maximum of ");
    let scale = case.load * case.rod.scales[0].powi(2) / case.rod.bending;
    let mut table = String::from("| load steps | end | last | limit |\n|---|---|---|---|\n");
    let mut last = 0.0;
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            [_, factor, _] => last = factor.parse().expect("a number"),
            [steps, end] => {
                let _ = writeln!(table, "| {steps} | {end} | {:.3} | {:.3} |", last * scale, limit * scale);
            }
            _ => panic!("the peer printed {line}"),
        }
    }
    section.say(&table);
}
