//! Does a static path say where it buckles? The classical critical loads of struts, of a twisted shaft and of a strip;
//! both ways, once each, also where two motions become unstable at once; and nothing on paths that stay stable. A code
//! that looked at the sign of the determinant would miss round struts, one that looked at the nearest eigenvalue only
//! would call far-buckled ones stable again.

use crate::running::start;
use ancf14::fmi::Model;
use ancf14::model::modes::Kind;
use ancf14::model::simulation::Simulation;
use std::f64::consts::PI;

/// A beam of 1 m on a static path, with `section` and joints and loads.
fn path(section: &str, elements: usize, rest: &str) -> Simulation {
    start(&text(section, elements, rest))
}

fn text(section: &str, elements: usize, rest: &str) -> String {
    format!(
        r#"
format = 1
[model]
name = "Path"
[material.metal]
young = 2e11
shear = 8e10
density = 7800
[section.profile]
{section}
[beam.bar]
material = "metal"
section = "profile"
from = [0, 0, 0]
to = [1, 0, 0]
elements = {elements}
strain = "small"
{rest}
[output.tip]
at = "bar.end"
quantities = ["displacement"]
[simulation]
analysis = "static"
stop = 2
step = 1
output_step = 1
"#
    )
}

const ROUND: &str = "shape = \"circle\"\nradius = 0.005";
const FLAT: &str = "shape = \"rectangle\"\nwidth = 0.008\nheight = 0.012";
const CLAMP: &str = "[joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"bar.start\"\n";
/// `E I` of [`ROUND`], and about the weak axis of [`FLAT`], N m².
const STIFFNESS: [f64; 2] = [2e11 * PI / 4.0 * 625e-12, 2e11 * 0.012 * 512e-9 / 12.0];

/// Goes through equilibria at `times` and returns what is warned of.
fn warnings(simulation: &mut Simulation, times: &[f64]) -> Vec<String> {
    let mut told = simulation.take_warnings();
    for time in times {
        simulation.advance(*time).unwrap_or_else(|failure| panic!("{}", failure.message));
        told.extend(simulation.take_warnings());
    }
    told
}

/// The critical time that a warning gives, s.
fn critical(warning: &str) -> f64 {
    let (_, after) = warning.split_once("by interpolation at t = ").unwrap_or_else(|| panic!("{warning}"));
    after.split_once(' ').unwrap().0.parse().unwrap()
}

/// Times from `step` to `stop`, s.
fn steps(step: f64, stop: f64) -> Vec<f64> {
    (1..=(stop / step).round() as u32).map(|number| f64::from(number) * step).collect()
}

/// Euler's strut, clamped and free, under a load that passes `π² E I/(4 L²)` at 1 s and comes back to it at 2 s.
fn strut(section: &str, stiffness: f64) -> Simulation {
    let load =
        format!("[load.weight]\nat = \"bar.end\"\nforce = [\"-{}*min(t, 3 - t)\", 0, 0]\n", PI * PI / 4.0 * stiffness);
    path(section, 8, &format!("{CLAMP}{load}"))
}

/// The critical load comes by interpolation of an eigenvalue that is nearly linear in it, from a mesh with an error of
/// 1e-5. The strut becomes stable again where it became unstable; nothing else is told, also not while the load goes on
/// and modes pass each other.
#[test]
fn struts_buckle_at_eulers_load() {
    for (section, stiffness, ways) in [(FLAT, STIFFNESS[1], 1), (ROUND, STIFFNESS[0], 2)] {
        let told = warnings(&mut strut(section, stiffness), &steps(0.1, 2.0));
        println!("{told:#?}");
        assert_eq!(told.len(), 2, "{told:#?}");
        assert!(told[0].contains("unstable") && told[1].contains("stable again"), "{told:#?}");
        assert_eq!(told[0].contains("in 2 ways at once"), ways == 2, "{told:#?}");
        assert!(told[0].contains("bar.end, along"), "{}", told[0]);
        assert!((critical(&told[0]) - 1.0).abs() < 1e-3 && (critical(&told[1]) - 2.0).abs() < 1e-3, "{told:#?}");
    }
}

/// A host that goes back and repeats is told again, from whatever solver state; one that does not, is not.
#[test]
fn rollbacks_do_not_lose_the_warning() {
    let mut simulation = strut(FLAT, STIFFNESS[1]);
    assert!(warnings(&mut simulation, &[0.5, 0.9]).is_empty());
    let snapshot = simulation.snapshot();
    let first = warnings(&mut simulation, &[1.1, 1.2]);
    simulation.restore(&snapshot);
    let again = warnings(&mut simulation, &[1.1, 1.2]);
    assert_eq!(first.len(), 1);
    assert_eq!(again.len(), 1);
    // Eigenvalues are known to the square of 1e-2.
    assert!((critical(&first[0]) - critical(&again[0])).abs() < 1e-4, "{first:?} {again:?}");
}

/// A strut that begins beyond its load is told to be unstable at once.
#[test]
fn a_start_beyond_the_critical_load_is_told() {
    let load = format!("[load.weight]\nat = \"bar.end\"\nforce = [-{}, 0, 0]\n", 1.2 * PI * PI / 4.0 * STIFFNESS[1]);
    let told = path(FLAT, 8, &format!("{CLAMP}{load}")).take_warnings();
    assert!(told.len() == 1 && told[0].contains("the equilibrium of t = 0 s is unstable"), "{told:?}");
}

/// Between hinges `ω² = ω0² (1 − P/P_E)` for tension and compression alike; what strains of `P_E/(E A)` = 4e-5 change
/// is left out.
#[test]
fn frequencies_fall_to_zero_at_eulers_load() {
    let hinges = "[joint.foot]\ntype = \"universal\"\na = \"ground\"\nb = \"bar.start\"\naxis = [0, 1, 0]\naxis2 = [0, 0, 1]\n\
                  [joint.head]\ntype = \"inline\"\na = \"ground\"\nb = \"bar.end\"\naxis = [1, 0, 0]\n";
    let of_load = |sign: f64| {
        let load = format!("[load.pull]\nat = \"bar.end\"\nforce = [\"{}*t\", 0, 0]\n", sign * PI * PI * STIFFNESS[1]);
        let mut simulation = path(FLAT, 8, &format!("{hinges}{load}"));
        let first = |simulation: &Simulation| simulation.modes(1).unwrap().modes[0].eigenvalue;
        let rest = first(&simulation);
        [0.3, 0.6, 0.9].map(|time| {
            simulation.advance(time).unwrap();
            first(&simulation) / rest - (1.0 + sign * time)
        })
    };
    for sign in [-1.0, 1.0] {
        let off = of_load(sign);
        println!("off by {off:?}");
        assert!(off.iter().all(|off| off.abs() < 3e-4), "{off:?}");
    }
}

/// Greenhill's shaft: clamped at both ends, one free to slide, twisted by a drive, buckles at `M = 8.98682 E I/L`. Only
/// the second derivatives of the holonomy are in it (MECHANICS 4): 1.4e-4 with 16 elements.
#[test]
fn a_twisted_shaft_buckles_at_greenhills_moment() {
    let [stiffness, torsion] = [STIFFNESS[0], 0.8 * STIFFNESS[0]];
    let angle = 8.986_818_916 * stiffness / torsion;
    let drive = format!(
        "{CLAMP}[joint.chuck]\ntype = \"cylindrical\"\na = \"ground\"\nb = \"bar.end\"\naxis = [1, 0, 0]\n\
         [drive.motor]\njoint = \"chuck\"\ncoordinate = \"angle\"\nvalue = \"{angle}*t\"\n"
    );
    let mut simulation = path(ROUND, 16, &drive);
    let told = warnings(&mut simulation, &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.96, 0.99, 1.01]);
    println!("{told:?}");
    assert_eq!(told.len(), 1, "{told:?}");
    assert!((critical(&told[0]) - 1.0).abs() < 5e-4, "{told:?}");
    assert_eq!(simulation.modes(1).unwrap().modes[0].kind, Kind::Unstable);
}

/// The strip of models/lateral_buckling.toml under a dead tip load: the table of MECHANICS 4, to the digits that
/// interpolation leaves.
#[test]
fn a_strip_buckles_sideways() {
    for (elements, table) in [(8, 2984.0), (16, 2975.2)] {
        let strip = "shape = \"rectangle\"\nwidth = 0.01\nheight = 0.1\ntorsion_constant = 3.12e-8";
        let load = "[load.weight]\nat = \"bar.end\"\nforce = [0, 0, \"-3000*t\"]\n";
        let text = text(strip, elements, &format!("{CLAMP}{load}"));
        let mut simulation =
            start(&text.replace("young = 2e11", "young = 73e9").replace("shear = 8e10", "poisson = 0.3"));
        let told = warnings(&mut simulation, &[0.5, 0.9, 0.99, 0.992, 0.996]);
        assert!(told.len() == 1 && told[0].contains("along y"), "{told:?}");
        let found = 3000.0 * critical(&told[0]);
        println!("{elements} elements: {found:.2} N");
        // The table's last digit, and an eigenvalue that is no straight line between 2976 and 2988 N.
        assert!((found - table).abs() < 0.1, "{found} {table}");
    }
}

/// Paths that stay stable say nothing: the Princeton beam under its load, and a cantilever bent far.
#[test]
fn stable_paths_say_nothing() {
    let mut princeton = start(include_str!("../../../models/princeton_beam.toml"));
    assert_eq!(warnings(&mut princeton, &steps(0.1, 1.0)), [""; 0]);
    let load = format!("[load.weight]\nat = \"bar.end\"\nforce = [0, 0, \"-{}*t\"]\n", 10.0 * STIFFNESS[0]);
    let mut bent = path(ROUND, 8, &format!("{CLAMP}{load}"));
    assert_eq!(warnings(&mut bent, &steps(0.1, 1.0)), [""; 0]);
}

/// Michell's ring, models/ring.toml: bent to a ring by a moving frame and twisted, it leaves its plane at a total twist
/// of `2 pi sqrt(3) E I/G J`, in two ways at once; 2.2e-3 with 12 elements (MECHANICS 4).
#[test]
fn a_twisted_ring_leaves_its_plane_at_michells_twist() {
    for twist in ["linear", "quadratic"] {
        let mut simulation = crate::curves::load(include_str!("../../../models/ring.toml"), &[("rod.twist", twist)]);
        let told = warnings(&mut simulation, &steps(0.02, 2.0));
        assert!(told.len() == 1 && told[0].contains("in 2 ways at once"), "{told:#?}");
        // 2.5 turns from t = 1 to 2; E I/G J = 1 + 0.3.
        let found = 2.0 * PI * 2.5 * (critical(&told[0]) - 1.0);
        let exact = 2.0 * PI * 3.0_f64.sqrt() * 1.3;
        println!("ring, {twist} twist: {:.2e}", found / exact - 1.0);
        assert!((found / exact - 1.0).abs() < 3e-3, "{found} {exact}");
    }
}

/// Softer motions beside it, however many, do not hide a strut's buckling, nor its start beyond the critical load.
#[test]
fn soft_mounts_do_not_hide_the_buckling() {
    let mut mounts = String::new();
    for k in 0..6 {
        mounts += &format!(
            "[body.soft{k}]\nmass = 1\ninertia = [1, 1, 1]\nposition = [{}, 1, 0]\n[joint.mount{k}]\ntype = \"bushing\"\na = \"ground\"\n\
             b = \"soft{k}\"\nstiffness = [1, 1, 1]\nrotational_stiffness = [1, 1, 1]\n",
            k + 1
        );
    }
    let load = |load: &str| format!("{CLAMP}{mounts}[load.weight]\nat = \"bar.end\"\nforce = [\"{load}\", 0, 0]\n");
    let euler = PI * PI / 4.0 * STIFFNESS[1];
    let told = warnings(&mut path(FLAT, 8, &load(&format!("-{euler}*t"))), &steps(0.1, 1.5));
    assert!(told.len() == 1 && (critical(&told[0]) - 1.0).abs() < 2e-3, "{told:#?}");
    assert!(told[0].contains("bar.end, along"), "{}", told[0]);
    let told = path(FLAT, 8, &load(&format!("-{}", 1.2 * euler))).take_warnings();
    assert!(told.iter().any(|told| told.contains("the equilibrium of t = 0 s is unstable")), "{told:?}");
}

/// With a loose tolerance one iteration is enough for a strut, whose matrix then is still that of the strut as drawn:
/// what is asked is the equilibrium that it leads to, at the start and on the way.
#[test]
fn regression_loose_tolerances_hide_no_buckling() {
    let euler = PI * PI / 4.0 * STIFFNESS[1];
    for tolerance in ["1e-5", "1e-3"] {
        let strut = |load: &str| {
            let rest = format!("{CLAMP}[load.weight]\nat = \"bar.end\"\nforce = [\"{load}\", 0, 0]\n");
            start(&(text(FLAT, 8, &rest) + &format!("tolerance = {tolerance}\n")))
        };
        let told = warnings(&mut strut(&format!("-{euler}*t")), &steps(0.1, 1.5));
        assert!(told.len() == 1 && (critical(&told[0]) - 1.0).abs() < 2e-3, "{tolerance}: {told:#?}");
        let told = strut(&format!("-{}", 1.1 * euler)).take_warnings();
        assert!(
            told.len() == 1 && told[0].contains("the equilibrium of t = 0 s is unstable"),
            "{tolerance}: {told:#?}"
        );
    }
}

/// An upright pendulum of 1 m on a hinge of 5 N m/rad does not move at all under its load: Newton has nothing to do,
/// and falls over beyond 5 N.
#[test]
fn regression_what_stands_still_is_judged_under_its_load() {
    let pendulum = |load: &str| {
        let text = format!(
            r#"
format = 1
model = {{ name = "Upright" }}
body.bob = {{ mass = 1, position = [0, 0, 1], inertia = [0.1, 0.1, 0.1] }}
joint.pivot = {{ type = "revolute", a = "ground", b = "bob", at = [0, 0, 0], axis = [0, 1, 0], stiffness = 5 }}
load.weight = {{ at = "bob", force = [0, 0, "{load}"] }}
simulation = {{ analysis = "static", stop = 2, step = 1, output_step = 1 }}
"#
        );
        start(&text)
    };
    for (load, warned) in [("-4.9", false), ("-5.1", true)] {
        let told = pendulum(load).take_warnings();
        assert_eq!(told.iter().any(|told| told.contains("the equilibrium of t = 0 s is unstable")), warned, "{told:?}");
    }
    let told = warnings(&mut pendulum("-5*t"), &steps(0.15, 1.5));
    // The cost of the motion is linear in the load, and so in time.
    assert!(told.len() == 1 && (critical(&told[0]) - 1.0).abs() < 1e-6, "{told:#?}");
}

/// Beside a spring of 2.6e8 N/m at the tip of a strip of half a millimeter round-off counts a motion that releases
/// energy; the softest motion costs some.
#[test]
fn regression_stiff_springs_raise_no_alarm() {
    let strip = "shape = \"rectangle\"\nwidth = 0.000508896\nheight = 0.00101779";
    let rest = r#"
[body.slack]
mass = 2.207
position = [1, -0.189, 0.149]
inertia = [0.01, 0.01, 0.01]
[joint.hinge]
type = "revolute"
a = "bar.end"
b = "slack"
at = [1, 0, 0]
axis = [0, 1, 0]
stiffness = 21.47
[body.held]
mass = 0.1557
position = [1, 0.003, 0.203]
inertia = [0.01, 0.01, 0.01]
[joint.mount]
type = "weld"
a = "bar.end"
b = "held"
at = [1, 0, 0]
[spring.stay]
a = "held"
b = "ground"
stiffness = 2.583e8
"#;
    let told = warnings(&mut path(strip, 32, &format!("{CLAMP}{rest}")), &steps(1.0, 2.0));
    assert!(told.is_empty(), "{told:#?}");
}
