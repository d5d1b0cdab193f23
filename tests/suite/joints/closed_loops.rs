//! Closed loops: a planar four-bar of rigid bodies with four revolute joints holds its plane three times over, and must
//! be refused with a joint's name, in dynamics and in statics; with a spherical and a cylindrical joint in the place of
//! two revolutes it is held exactly once, closes to round-off, moves as plane geometry says and keeps its energy; of
//! flexible beams it runs with revolutes. A mechanism that can still move has no equilibrium that is the only one: its
//! motion is named.

use crate::running::{run, start, try_start, value, vector};
use crate::support::parts::gap;
use ancf14::fmi::Model;
use ancf14::math::Vec3;

/// Crank, coupler and rocker of a four-bar that a motion about x would not leave: in the x-z plane, with gravity.
const BODIES: &str = "
[body.crank]
mass = 0.6
position = [0, 0, 0.15]
inertia = [5e-3, 5e-3, 1e-3]

[body.coupler]
mass = 1.4
position = [0.4, 0, 0.4]
inertia = [4e-3, 8e-2, 8e-2]
axes = [[0.970142500145332, 0, 0.242535625036333], [0, 1, 0], [-0.242535625036333, 0, 0.970142500145332]]

[body.rocker]
mass = 1.1
position = [0.85, 0, 0.25]
inertia = [3e-2, 3e-2, 2e-3]
";
const BEAMS: &str = "
[material.soft]
young = 2e9
poisson = 0.3
density = 1200

[section.bar]
shape = \"rectangle\"
width = 0.02
height = 0.03

[beam.crank]
material = \"soft\"
section = \"bar\"
from = [0, 0, 0]
to = [0, 0, 0.3]
elements = 3

[beam.coupler]
material = \"soft\"
section = \"bar\"
from = [0, 0, 0.3]
to = [0.8, 0, 0.5]
elements = 4

[beam.rocker]
material = \"soft\"
section = \"bar\"
from = [0.9, 0, 0]
to = [0.8, 0, 0.5]
elements = 4
";

/// The pivots as drawn: ground to crank, crank to coupler, coupler to rocker, rocker to ground.
const PIVOTS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.3], [0.8, 0.0, 0.5], [0.9, 0.0, 0.0]];

fn four_bar(parts: &str, points: [&str; 6], kinds: [&str; 4], simulation: &str) -> String {
    let [crank_a, crank_b, coupler_a, coupler_b, rocker_b, rocker_a] = points;
    let sides = [("ground", crank_a), (crank_b, coupler_a), (coupler_b, rocker_b), ("ground", rocker_a)];
    let joints: String = (0..4)
        .map(|number| {
            let ((a, b), at, kind) = (sides[number], PIVOTS[number], kinds[number]);
            let axis = if kind == "spherical" { "" } else { "axis = [0, 1, 0]" };
            let name = ["base", "elbow", "wrist", "support"][number];
            format!("[joint.{name}]\ntype = \"{kind}\"\na = \"{a}\"\nb = \"{b}\"\nat = {at:?}\n{axis}\n")
        })
        .collect();
    format!(
        "format = 1\n[model]\nname = \"FourBar\"\ngravity = [0, 0, -9.81]\n{parts}\n{joints}\n\
         [output.turn]\nat = \"base\"\nquantities = [\"angle\"]\n\
         [simulation]\nstop = 2.0\noutput_step = 1e-2\n{simulation}\n"
    )
}

const ON_BODIES: [&str; 6] = ["crank", "crank", "coupler", "coupler", "rocker", "rocker"];
const ON_BEAMS: [&str; 6] = ["crank.start", "crank.end", "coupler.start", "coupler.end", "rocker.end", "rocker.start"];
const ALL_REVOLUTE: [&str; 4] = ["revolute"; 4];
const ONCE: [&str; 4] = ["revolute", "revolute", "spherical", "cylindrical"];

#[test]
fn a_plane_held_twice_names_a_joint() {
    for analysis in ["analysis = \"dynamic\"", "analysis = \"static\"", "initial = \"equilibrium\""] {
        let text = four_bar(BODIES, ON_BODIES, ALL_REVOLUTE, &format!("step = 1e-3\n{analysis}"));
        let message = try_start(&text).unwrap_err();
        println!("{analysis}: {message}");
        assert!(
            message.contains("joint ") && message.contains("is redundant: other joints already impose its constraints"),
            "{message}"
        );
        let named = ["base", "elbow", "wrist", "support"].into_iter().any(|name| message.contains(name));
        assert!(named, "{message}");
    }
}

/// Where the coupler's end must be: on both circles, on the branch as drawn; with the crank turned by `angle` about y.
fn wrist(angle: f64) -> Vec3 {
    let (crank, coupler, rocker, base) = (0.3, (0.68_f64).sqrt(), (0.26_f64).sqrt(), 0.9);
    let elbow = Vec3::new(angle.sin() * crank, 0.0, angle.cos() * crank);
    let apart = Vec3::new(base, 0.0, 0.0) - elbow;
    let distance = apart.norm();
    let along = (coupler * coupler - rocker * rocker + distance * distance) / (2.0 * distance);
    let across = (coupler * coupler - along * along).sqrt();
    let unit = apart / distance;
    // The side as drawn: to the left of the line from elbow to support, seen along y.
    elbow + unit * along + Vec3::new(-unit[2], 0.0, unit[0]) * across
}

/// Plane geometry, energy of order 2 and conditions at round-off of the loop that is held once.
#[test]
fn a_loop_held_once_moves_as_plane_geometry_says() {
    let bands = [5e-3, 2.5e-3].map(|step| {
        let outputs = "[output.middle]\nat = \"coupler\"\nquantities = [\"position\"]\n";
        let text = four_bar(BODIES, ON_BODIES, ONCE, &format!("step = {step}\ntolerance = 1e-11")) + outputs;
        let mut simulation = start(&text);
        let (mut low, mut high, mut swing) = (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64);
        let (mut worst, mut apart, mut turned) = (0.0_f64, 0.0_f64, 0.0_f64);
        run(&mut simulation, 1e-2, 2.0, |simulation| {
            let energy = value(simulation, "energy.total");
            (low, high) = (low.min(energy), high.max(energy));
            swing = swing.max(value(simulation, "energy.kinetic"));
            worst = worst.max(gap(simulation.system(), simulation.state()));
            let angle = value(simulation, "turn.angle");
            turned = turned.max(angle.abs());
            // The coupler's center of mass is half way between the pivots.
            let elbow = Vec3::new(angle.sin() * 0.3, 0.0, angle.cos() * 0.3);
            let middle = (elbow + wrist(angle)) * 0.5;
            apart = apart.max((vector(simulation, "middle.position") - middle).norm());
        });
        println!(
            "h = {step}: energy band {:.1e}, conditions {worst:.1e}, off plane geometry {apart:.1e}, turned {turned:.1} rad",
            (high - low) / swing
        );
        assert!(turned > 1.0, "nothing moves");
        // Round-off of sums of a few numbers of order 1.
        assert!(worst < 1e-13 && apart < 1e-12, "{worst:e} {apart:e}");
        (high - low) / swing
    });
    let ratio = bands[0] / bands[1];
    println!("ratio {ratio:.2}");
    assert!(bands[1] < 1e-4 && ratio > 3.0, "{bands:?}");
}

/// Beams bend out of the plane: four revolutes do not hold anything twice.
#[test]
fn a_flexible_four_bar_runs_with_revolutes() {
    let mut simulation = start(&four_bar(BEAMS, ON_BEAMS, ALL_REVOLUTE, "step = 1e-3"));
    let (mut low, mut high, mut swing, mut worst, mut turned) =
        (f64::INFINITY, f64::NEG_INFINITY, 0.0_f64, 0.0_f64, 0.0_f64);
    run(&mut simulation, 1e-2, 2.0, |simulation| {
        let energy = value(simulation, "energy.total");
        (low, high) = (low.min(energy), high.max(energy));
        swing = swing.max(value(simulation, "energy.kinetic"));
        worst = worst.max(gap(simulation.system(), simulation.state()));
        turned = turned.max(value(simulation, "turn.angle").abs());
    });
    let band = (high - low) / swing;
    println!("energy band {band:.1e}, conditions {worst:.1e}, turned {turned:.1} rad");
    assert!(turned > 1.0, "nothing moves");
    // Turns of some 10 rad/s at 1e-3 s: (1e-2)^2, and bending vibration that the step does not resolve.
    assert!(worst < 1e-12 && band < 1e-3, "{worst:e} {band:e}");
}

/// A free motion has no equilibrium of its own. Where a load acts along it, the error says what moves, and how;
/// without, the solver holds it and says so.
#[test]
fn free_motions_are_named() {
    let told = |text: &str| {
        let mut simulation = try_start(text).unwrap_or_else(|message| panic!("{message}"));
        let told = simulation.take_warnings().concat();
        println!("{told}");
        assert!(told.contains("takes no load") || told.contains("take no load"), "{told}");
        told
    };
    let file = |sections: &str| {
        format!(
            "format = 1\n[model]\nname = \"Free\"\n\
             [body.block]\nmass = 2\nposition = [0.3, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n{sections}\n\
             [output.place]\nat = \"block\"\nquantities = [\"position\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\noutput_step = 0.1\n"
        )
    };
    let message = |sections: &str| told(&file(sections));
    let joint =
        |kind: &str, rest: &str| format!("[joint.guide]\ntype = \"{kind}\"\na = \"ground\"\nb = \"block\"\n{rest}\n");
    assert!(message(&joint("prismatic", "axis = [0, 0, 1]")).contains("block (along z)"));
    assert!(message(&joint("prismatic", "axis = [1, 0, 0]")).contains("block (along x)"));
    assert!(message(&joint("revolute", "axis = [0, 1, 0]")).contains("block (turning)"));
    assert!(message(&joint("inplane", "axis = [0, 1, 0]")).contains("block ("));
    // No pivot vanishes exactly along a skew axis.
    assert!(message(&joint("prismatic", "axis = [0.2, -0.3, 1]")).contains("block (along z)"));
    // A load that does no work in the free direction does not hide it.
    let pulled = joint("prismatic", "axis = [0.2, -1, 0]") + "[load.pull]\nat = \"block\"\nforce = [5, 1, 0]\n";
    assert!(message(&pulled).contains("block (along y)"));
    // One that does is an error.
    let pushed = pulled.replace("force = [5, 1, 0]", "force = [5, 2, 0]");
    let failure = try_start(&file(&pushed)).unwrap_err();
    assert!(failure.contains("block (along y) can move freely"), "{failure}");
    // A one-degree-of-freedom loop without anything that holds it.
    let text = four_bar(BODIES, ON_BODIES, ONCE, "step = 1e-2\nanalysis = \"static\"").replace("-9.81", "0");
    let message = told(&text);
    let on_what = ["crank (", "coupler (", "rocker ("].into_iter().any(|name| message.contains(name));
    assert!(on_what, "{message}");
}
