//! Paths of equilibria past limit and branch points, against integrated rods and closed forms.

use super::{Section, dots, line, plot, study};
use ancf14_testing::paths::{Arch, Case, Twisted, follow, number_behind};
use ancf14_testing::running::start;
use ancf14_testing::spatial_rod;
use std::f64::consts::TAU;
use std::fmt::Write;
use std::process::Command;

const RIGHT_ANGLE: &str = include_str!("../../../../tests/machines/right_angle_frame.toml");

/// Meshes of Lee's frame, elements of a leg, and of arches.
const LEE: [usize; 3] = [5, 10, 20];
const ARCHES: [usize; 2] = [16, 32];

/// Equilibria whose middle has moved by less, m, are still those of the way to the branch point.
const BUCKLED: f64 = 0.02;

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
        let size = elements as f64;
        let order = before.map_or(String::new(), |(from, coarse)| study::order([from, size], [coarse, worst]));
        let limit = case.load * number_behind(&told, "t has a maximum of ");
        // In units of the rigidity and the size of the rod: length of a leg, radius.
        let power = if matches!(case.rod.load, ancf14_testing::planar_rod::Load::At(_)) { 2 } else { 3 };
        let limit = limit * case.rod.scales[0].powi(power) / case.rod.bending;
        let _ = writeln!(text, "| {name} | {elements} | {limit:.4} | {} | {order} |", study::small(worst));
        before = Some((size, worst));
    }
    text
}

pub fn write(section: &mut Section) {
    section.say(
        "Static analyses with `follow = \"arc_length\"` ([paths](../language/simulation.md#a-path-past-its-limit-load)). Lee's frame (`models/lee_frame.toml`) under a load that keeps its direction and under one that turns with the girder; a clamped shallow arch of 57 \
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

    twisted(section);
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

/// Rods that are twisted past their critical twist.
fn twisted(section: &mut Section) {
    section.say(
        "A straight rod and a closed ring, round and straight without stress, clamped at one end and twisted at the other, which slides along the axis of the rod. The path goes over to the buckled one where it branches off, and is followed while the twist falls. \
         `leaves at` is the error of the critical twist (Greenhill: 8.98682 EI/GJ; Michell and Zajac: 2 pi sqrt(3) EI/GJ), `off by` the largest distance of a buckled row from the path of an integrated rod, displacements over the length and turns over a whole one:",
    );
    let mut table = String::from("| path | elements | leaves at | off by | order |\n|---|---|---|---|---|\n");
    let mut lines = Vec::new();
    let rods = [
        ("twisted rod", false, 8.98682 / 0.75, [16, 32]),
        ("twisted ring", true, TAU * 3.0_f64.sqrt() / 0.75, [24, 48]),
    ];
    for (color, (name, is_ring, critical, meshes)) in rods.into_iter().enumerate() {
        let mut before = None;
        for elements in meshes {
            let case = Twisted::new(elements, is_ring);
            let (points, told) = case.equilibria();
            let leaves = (10.0 * number_behind(&told, ", t = ") / critical - 1.0).abs();
            if before.is_none() {
                let torque = |point: &spatial_rod::Point| -point.start[1].x;
                let path = points.iter().map(|point| (point.turn / TAU, torque(point)));
                lines.push(line(&format!("{name}, {elements} elements"), color, path.collect()));
            }
            let buckled: Vec<_> = points.into_iter().skip_while(|point| point.middle.norm() < BUCKLED).collect();
            let worst = case.rod.distance_from(&buckled);
            let size = elements as f64;
            let order = before.map_or(String::new(), |(from, coarse)| study::order([from, size], [coarse, worst]));
            let [leaves, off] = [leaves, worst].map(study::small);
            let _ = writeln!(table, "| {name} | {elements} | {leaves} | {off} | {order} |");
            before = Some((size, worst));
        }
    }
    section.say(&table);
    let axes = ["turns of the end", "torque at the start (EI/L)"];
    section.picture("paths_twisted", plot("Twisted rods past their critical twist", axes, lines));
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
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
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
                last = 0.0;
            }
            _ => panic!("the peer printed {line}"),
        }
    }
    section.say(&table);
}
