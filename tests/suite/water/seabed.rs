//! Do lines lie on `[seabed]` as they must? Catenaries on a rigid bed, a lazy wave, and a bar that friction holds have
//! closed forms; a wrong level, a stiffness that does not count with the diameter, friction that forgets, or a damper
//! that pulls changes them by percents.

use super::{section, water};
use crate::running::{run, start, value, vector};
use ancf14::fmi::Model;
use std::f64::consts::PI;

/// A studless chain of `length` m in water of `depth` m, from the anchor at `distance` m to the fairlead, with 40
/// elements; `seabed` are keys of its section.
fn chain([distance, depth, length]: [f64; 3], seabed: &str, simulation: &str) -> String {
    water(9.80665, 1025.0, 0.0, &format!("depth = {depth}\n[seabed]\n{seabed}"))
        + &section([1.674e9, 0.0], 390.0, 0.252, "drag = [1.37, 0.64]\ndrag_area = \"diameter\"\nadded_mass = [1, 0]")
        + &format!(
            "[beam.line]\nsection = \"round\"\nfrom = [{distance}, 0, {}]\nto = [0, 0, 0]\n\
             lay = {{ length = {length} }}\nelements = 40\n\
             [joint.anchor]\ntype = \"spherical\"\na = \"ground\"\nb = \"line.start\"\n\
             [joint.fairlead]\ntype = \"spherical\"\na = \"ground\"\nb = \"line.end\"\n\
             [output.fairlead]\nat = \"fairlead\"\nquantities = [\"reaction_force\"]\n\
             [output.anchor]\nat = \"anchor\"\nquantities = [\"reaction_force\"]\n\
             [output.bed]\nat = \"seabed\"\nquantities = [\"contact_length\", \"friction_force\"]\n\
             [simulation]\n{simulation}",
            -depth
        )
}

const STATIC: &str = "analysis = \"static\"\nstop = 1\nstep = 1\n";

/// Distance of the anchor, depth and length, m; horizontal force and tension at the fairlead, N, and laid length, m, of
/// the elastic catenary on a rigid bed without friction.
const CHAINS: [([f64; 3], [f64; 3]); 3] = [
    ([400.0, 50.0, 410.0], [835_593.793, 1_001_665.153, 243.785]),
    ([700.0, 200.0, 760.0], [1_406_150.292, 2_070_110.868, 302.844]),
    ([1500.0, 600.0, 1700.0], [3_247_254.948, 5_236_165.214, 463.967]),
];

/// Chains whose axis touches a bed that is all but rigid: 40 elements miss 0.02 % of the force, and two thirds of an
/// element of the laid length. Friction of the seabed begins behind the first equilibrium.
#[test]
fn chains_on_a_rigid_bed() {
    for (geometry, [horizontal, tension, laid]) in CHAINS {
        let simulation = start(&chain(geometry, "stiffness = 1e7\ncontact = \"axis\"\nfriction = 0.5", STATIC));
        let force = vector(&simulation, "fairlead.reaction_force");
        let [h, t] = [-force.x / horizontal - 1.0, force.norm() / tension - 1.0];
        let length = value(&simulation, "bed.contact_length");
        println!("{h:.1e} {t:.1e}, laid {length} of {laid} m");
        assert!(h.abs() < 2.5e-4 && t.abs() < 2.5e-4);
        assert!((length - laid).abs() < geometry[2] / 40.0);
        assert!(value(&simulation, "bed.friction_force") < 1e-3);
    }
}

/// By default the outside of the chain touches: its axis stays half a diameter above the bed, and the force falls by
/// 0.7 %, as the catenary says whose bed is that much higher; 40 elements miss 0.03 %.
#[test]
fn the_outside_touches() {
    // The anchor holds the axis where the chain lies.
    let text = chain(CHAINS[0].0, "stiffness = 1e7", STATIC).replace("0, -50]", "0, -49.874]");
    let simulation = start(&text);
    let force = vector(&simulation, "fairlead.reaction_force");
    println!("{force}");
    assert!((force.norm() / 994_974.455 - 1.0).abs() < 4e-4);
}

/// A lazy wave: three lines on ball joints, of which the middle one floats. Reference: pieces of elastic catenaries.
#[test]
fn a_lazy_wave() {
    let part = |name: &str, ends: [[f64; 2]; 2], length: f64, elements: usize| {
        let [from, to] = ends.map(|[x, z]| format!("[{x}, 0, {z}]"));
        let section = if name == "float" { "float" } else { "pipe" };
        format!(
            "[beam.{name}]\nsection = \"{section}\"\nfrom = {from}\nto = {to}\nlay = {{ length = {length} }}\n\
             elements = {elements}\n"
        )
    };
    let sections = [("pipe", 25.0, 0.116), ("float", 59.0, 0.361)].map(|(name, density, diameter)| {
        section([362e6, 0.0], density, diameter, "added_mass = [1, 0]").replace("round", name)
    });
    let [low, high] = [[236.7, -233.0], [309.4, -207.1]];
    let joints = [("anchor", "ground", "lower.start"), ("top", "ground", "upper.end")]
        .into_iter()
        .chain([("one", "lower.end", "float.start"), ("two", "float.end", "upper.start")]);
    let joints: String = joints
        .map(|(name, a, b)| format!("[joint.{name}]\ntype = \"spherical\"\na = \"{a}\"\nb = \"{b}\"\n"))
        .collect();
    let text = water(9.81, 1025.0, 0.0, "depth = 320\n[seabed]\nstiffness = 1e7\ncontact = \"axis\"")
        + &sections.concat()
        + &part("lower", [[0.0, -320.0], low], 260.0, 13)
        + &part("float", [low, high], 80.0, 8)
        + &part("upper", [high, [600.0, -63.6]], 340.0, 17)
        + &joints
        + "[output.top]\nat = \"top\"\nquantities = [\"reaction_force\"]\n\
           [output.one]\nat = \"lower.end\"\nquantities = [\"position\"]\n\
           [output.two]\nat = \"upper.start\"\nquantities = [\"position\"]\n[simulation]\n"
        + STATIC;
    let simulation = start(&text);
    let force = vector(&simulation, "top.reaction_force");
    let places = ["one", "two"].map(|name| vector(&simulation, &format!("{name}.position")));
    println!("{force} {places:?}");
    assert!((force.norm() / 53_979.499 - 1.0).abs() < 2e-4);
    assert!((force.x / 33_663.929 - 1.0).abs() < 5e-4 && (force.z / 42_196.281 - 1.0).abs() < 2e-4);
    // Joints from the anchor and above the bed, m.
    for (place, [x, z]) in places.into_iter().zip([[236.682, 86.940], [309.445, 112.928]]) {
        assert!((place.x - x).abs() < 0.05 && (place.z + 320.0 - z).abs() < 0.05);
    }
}

/// A bar on the seabed, with a weight of 100 N/m in water, that is drawn as deep as it sinks: 0.1 mm.
fn bar(length: f64, elements: usize, [axial, bending]: [f64; 2], seabed: &str, rest: &str) -> String {
    let density = 100.0 / 9.81 + 1000.0 * PI * 0.01 / 4.0;
    water(9.81, 1000.0, 0.0, &format!("depth = 10\n[seabed]\nstiffness = 1e7\ncontact = \"axis\"\n{seabed}"))
        + &section([axial, bending], density, 0.1, "drag = [0, 0]")
        + &format!(
            "[beam.bar]\nsection = \"round\"\nfrom = [0, 0, -10.0001]\nto = [{length}, 0, -10.0001]\n\
             elements = {elements}\n[output.bed]\nat = \"seabed\"\nquantities = [\"reaction_force\", \"sliding\"]\n{rest}"
        )
}

/// An elastic bar is pulled by its end: it slides up to where friction holds it, `F = √(2 EA μ w u)`. The bristle gives
/// by 0.05 mm before it slides, which makes the bar softer by 0.1 %. At rest afterwards the force stays.
#[test]
fn friction_holds_a_bar() {
    let rest = "[frame.end]\nposition = [\"100 + 0.09*min(t, 1)\", 0, -10.0001]\n\
                [joint.pull]\ntype = \"spherical\"\na = \"end\"\nb = \"bar.end\"\n\
                [output.pull]\nat = \"pull\"\nquantities = [\"reaction_force\"]\n\
                [simulation]\nanalysis = \"static\"\nstop = 3\nstep = 0.05\n";
    let mut simulation = start(&bar(100.0, 20, [1e6, 10.0], "friction = 0.5", rest));
    run(&mut simulation, 1.0, 1.0, |_| {});
    let force = value(&simulation, "pull.reaction_force[1]");
    println!("{force} N");
    assert!((force / 3000.0 - 1.0).abs() < 2e-3);
    simulation.advance(3.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    assert!((value(&simulation, "pull.reaction_force[1]") / force - 1.0).abs() < 1e-6);
}

/// A stiff bar that both ends drag by a meter along itself, across, and at 45 degrees bears `μ w L` along the way, of
/// an ellipse with the coefficients along and across: `1/μ² = cos²/μ_a² + sin²/μ_t²`. It turns by no more than its
/// elastic line does.
#[test]
fn friction_along_and_across() {
    for (angle, coefficient) in [(0.0_f64, 0.3), (90.0, 0.6), (45.0, (0.5 / 0.09 + 0.5 / 0.36_f64).powf(-0.5))] {
        let (sin, cos) = angle.to_radians().sin_cos();
        let frame = |name: &str, x: f64, end: &str| {
            format!(
                "[frame.{name}]\nposition = [\"{x} + {cos}*t\", \"{sin}*t\", -10.0001]\n\
                 [joint.{name}]\ntype = \"spherical\"\na = \"{name}\"\nb = \"bar.{end}\"\n"
            )
        };
        let rest = frame("one", 0.0, "start")
            + &frame("two", 10.0, "end")
            + "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.05\n";
        let mut simulation = start(&bar(10.0, 2, [1e9, 1e9], "friction = [0.3, 0.6]", &rest));
        run(&mut simulation, 1.0, 1.0, |_| {});
        let force = vector(&simulation, "bed.reaction_force");
        println!("{angle} degrees: {force}");
        let expected = -coefficient * 1000.0;
        assert!((force.x - expected * cos).abs() < 0.5 && (force.y - expected * sin).abs() < 0.5);
        assert!((force.z - 1000.0).abs() < 0.5 && value(&simulation, "bed.sliding") == 1.0);
    }
}

/// A bar without other support on a bed with a slope of 0.2 lies still with a friction of 0.3 that the first
/// equilibrium has too: normal to the bed it bears `w L cos`, along it `w L sin`.
#[test]
fn friction_holds_on_a_slope() {
    let seabed = "friction = 0.3\nfriction_in_statics = true\nslope = [0.2, 0]";
    let text = bar(10.0, 2, [1e9, 1e9], seabed, "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n");
    let text = text.replace("to = [10, 0, -10.0001]", "to = [10, 0, -8.0001]")
        + "[output.more]\nat = \"seabed\"\nquantities = [\"normal_force\", \"friction_force\"]\n";
    let simulation = start(&text);
    let angle = 0.2_f64.atan();
    let weight = 100.0 * 10.0_f64.hypot(2.0);
    let [normal, friction] = ["normal", "friction"].map(|name| value(&simulation, &format!("more.{name}_force")));
    println!("{normal} {friction} of {weight} N");
    assert!((normal / (weight * angle.cos()) - 1.0).abs() < 1e-3);
    assert!((friction / (weight * angle.sin()) - 1.0).abs() < 1e-3);
}

/// A bar drawn 0.02 mm above its equilibrium swings about it with `ω² = kD/m` and the damping `c/(2 m ω)`, stiffness and
/// damping per diameter. A step of a fiftieth of the period has an error of its square over 12.
#[test]
fn a_bed_damps() {
    let density = 100.0 / 9.81 + 1000.0 * PI * 0.01 / 4.0;
    let (stiffness, damping) = (1e7 * 0.1, 4e3 * 0.1);
    let frequency = (stiffness / density - (damping / (2.0 * density)).powi(2)).sqrt();
    let period = 2.0 * PI / frequency;
    let rest = format!(
        "[output.bar]\nat = \"bar@0.5\"\nquantities = [\"position\"]\n\
         [simulation]\nstop = 1\nstep = {}\ntotals = [\"work\"]\n",
        period / 50.0
    );
    let text = bar(10.0, 2, [1e9, 1e9], "damping = 4e3", &rest).replace("-10.0001]", "-10.00008]");
    let mut simulation = start(&text);
    let mut largest = 0.0_f64;
    run(&mut simulation, period / 50.0, 2.0 * period, |simulation| {
        let time = simulation.time();
        let decay = damping / (2.0 * density);
        let swing = (frequency * time).cos() + decay / frequency * (frequency * time).sin();
        let expected = 2e-5 * (-decay * time).exp() * swing;
        largest = largest.max((value(simulation, "bar.position[3]") + 10.0001 - expected).abs());
    });
    println!("largest difference {largest:.1e} m of 2e-5 m");
    // The phase after two periods is late by 4 pi (2 pi/50)²/24.
    assert!(largest < 3e-7);
    assert!(value(&simulation, "work.drift").abs() < 1e-6 * value(&simulation, "work.dissipated"));
}

/// A chain that swings on the bed with friction takes two iterations a step at most, and keeps the account of energy.
#[test]
fn a_chain_moves_on_the_bed() {
    let simulation = "initial = \"equilibrium\"\nstop = 10\nstep = 0.05\ntotals = [\"work\", \"statistics\"]\n";
    let motion = "[frame.vessel]\nposition = [0, 0, \"5*sin(2*pi*t/10)*min(t/5, 1)^3\"]\n[joint.fairlead]";
    let seabed = "stiffness = 1e5\ndamping = 1e4\nfriction = [0.5, 0.4]";
    let text = chain(CHAINS[0].0, seabed, simulation)
        .replace("elements = 40", "elements = 20")
        .replace("[joint.fairlead]", motion)
        .replace("a = \"ground\"\nb = \"line.end\"", "a = \"vessel\"\nb = \"line.end\"");
    let mut simulation = start(&text);
    run(&mut simulation, 10.0, 10.0, |_| {});
    let [iterations, steps] = ["iterations", "steps"].map(|own| value(&simulation, &format!("statistics.{own}")));
    let [drift, water, friction] =
        ["work.drift", "work.water", "bed.friction_force"].map(|own| value(&simulation, own));
    println!("{iterations} iterations in {steps} steps; drift {drift} J of {water} J; friction {friction} N");
    assert!(iterations < 2.0 * steps && value(&simulation, "statistics.rejected") == 0.0);
    assert!(drift.abs() < 1e-4 * water.abs() && friction > 1e3, "{drift} {water} {friction}");
}

/// A chain comes down where it begins to lie, seen from both ends, which is within two thirds of an element of the
/// catenary; what lies and what touches is one length. A height above the bed is that above its slope.
#[test]
fn where_a_line_lies() {
    let more = "[output.line]\nof = \"line\"\nquantities = [\"touchdown\", \"laid_length\"]\n\
                [output.top]\nat = \"line.end\"\nquantities = [\"clearance\", \"azimuth\"]\n\
                [output.low]\nat = \"line.start\"\nquantities = [\"clearance\", \"azimuth\"]\n";
    let seabed = "stiffness = 1e7\ncontact = \"axis\"";
    let text = chain(CHAINS[0].0, seabed, STATIC) + more;
    let simulation = start(&text);
    let [touchdown, laid, top, low, azimuth] =
        ["line.touchdown", "line.laid_length", "top.clearance", "low.clearance", "top.azimuth"]
            .map(|name| value(&simulation, name));
    println!("{touchdown} {laid} {top} {low} {azimuth}");
    assert!((touchdown - 243.785).abs() < 7.0 && (laid - touchdown).abs() < 10.25);
    assert!((laid - value(&simulation, "bed.contact_length")).abs() < 1e-9);
    assert!((top - 50.0).abs() < 1e-9 && low.abs() < 1e-9 && (azimuth.abs() - PI).abs() < 1e-6);

    let ends = ["from = [400, 0, -50]\nto = [0, 0, 0]", "from = [0, 0, 0]\nto = [400, 0, -50]"];
    let text = text.replace(ends[0], ends[1]).replace("line.start", "line.x");
    let text = text.replace("line.end", "line.start").replace("line.x", "line.end");
    let other = start(&text);
    assert!((value(&other, "line.touchdown") - (410.0 - touchdown)).abs() < 1e-3);

    let lifted = chain([400.0, 200.0, 460.0], &format!("{seabed}\nslope = [-0.1, 0]"), STATIC) + more;
    let simulation = start(&lifted.replace("depth = 200", "depth = 300"));
    assert!((value(&simulation, "low.clearance") - (100.0 + 40.0)).abs() < 1e-9);
    assert_eq!(["touchdown", "laid_length"].map(|name| value(&simulation, &format!("line.{name}"))), [-1.0, 0.0]);
}

/// The wall of a pipe that hangs in still water bears the effective tension less the pressure on its section.
#[test]
fn tension_in_the_wall() {
    let text = water(9.81, 1025.0, 2.0, "")
        + &section([1e8, 1e4], 60.0, 0.2, "drag = [1, 0]")
        + "[beam.pipe]\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [0, 0, -50]\nelements = 4\n\
           [joint.top]\ntype = \"weld\"\na = \"ground\"\nb = \"pipe.start\"\n\
           [output.pipe]\nat = \"pipe.start\"\nquantities = [\"effective_tension\", \"wall_tension\"]\n\
           [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n";
    let simulation = start(&text);
    let area = PI * 0.01;
    let effective = (60.0 - 1025.0 * area) * 9.81 * 50.0;
    let [found, wall] = ["effective", "wall"].map(|name| value(&simulation, &format!("pipe.{name}_tension")));
    println!("{found} {wall}");
    assert!((found / effective - 1.0).abs() < 1e-6);
    assert!((found - wall - 1025.0 * 9.81 * 2.0 * area).abs() < 1e-6);
}
