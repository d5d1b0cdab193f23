//! Straight pieces welded at corners: is it one beam, and right at the corners? Against statics by hand, against the
//! straight beam it is when its pieces are in line, and in what the names of points mean. A weld that lets the corner
//! turn, elements shared wrongly, fractions that forget a piece, the wrong side of a corner: each fails here.

use crate::curves::Curves;
use crate::running::{start, value, vector};
use ancf14::math::Vec3;
use ancf14::mechanics::marker::Marker;

/// A model with a beam `arm` of 1 cm by 2 cm steel, clamped at its start.
fn model(line: &str, load: &str, more: &str) -> String {
    format!(
        r#"format = 1
[model]
name = "Corners"
[material.steel]
young = 2e11
shear = 8e10
density = 7800
[section.bar]
shape = "rectangle"
width = 0.01
height = 0.02
[beam.arm]
material = "steel"
section = "bar"
strain = "small"
{line}
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[load.tip]
at = "arm.end"
{load}
[output.end]
at = "arm.end"
quantities = ["displacement", "rotation", "twist"]
[output.corner]
at = "arm@0.25"
quantities = ["position", "section_moment", "section_force", "rotation", "twist"]
[output.foot]
at = "arm.start"
quantities = ["section_force", "section_moment"]
[output.root_joint]
at = "root"
quantities = ["reaction_force", "reaction_moment"]
{more}
[simulation]
analysis = "static"
stop = 1.0
step = 1.0
output_step = 1.0
tolerance = 1e-13
"#
    )
}

/// Two pieces, 1 m along x and 3 m along y, with a load across their plane at the end: the first piece carries the
/// second one's moment as torque, its own as bending. By hand, for small loads.
#[test]
fn a_frame_corner_carries_its_load() {
    let line = "elements = 8\ncurve = { points = [[0, 0, 0], [1, 0, 0], [1, 3, 0]], polyline = true }";
    let force = 1e-3;
    let curves = Curves::run(&model(line, "force = [0, 0, \"1e-3*t\"]", ""), &[]);
    let last = |name: &str| curves.last(name);
    let (e, g) = (2e11, 8e10);
    let bending_y = 0.01 * 0.02_f64.powi(3) / 12.0;
    // Saint-Venant's constant of a rectangle 1 to 2: 0.2287 a³ b, four digits.
    let torsion = 0.2287 * 0.01_f64.powi(3) * 0.02;
    let (a, b) = (1.0_f64, 3.0_f64);
    let deflection =
        force * (a.powi(3) / (3.0 * e * bending_y) + b.powi(3) / (3.0 * e * bending_y) + a * b * b / (g * torsion));
    let found = last("end.displacement[3]");
    println!("frame corner: tip moves by {found:.6e} m, by hand {deflection:.6e} m");
    assert!((found / deflection - 1.0).abs() < 2e-4, "{found} {deflection}");
    // At the corner the name means the side towards the start: the torque F b, the bending moment of the second piece's
    // own length is there 0.
    let torque = force * b;
    assert!((last("corner.section_moment[1]") / torque - 1.0).abs() < 1e-6);
    assert!(last("corner.section_moment[2]").abs() < 1e-6 * torque);
    assert!((last("foot.section_moment[1]") / torque - 1.0).abs() < 1e-6);
    assert!((last("foot.section_moment[2]") + force * a).abs() < 1e-6 * torque);
    assert!(
        (last("root_joint.reaction_force[3]") / -force - 1.0).abs() < 1e-6
            || (last("root_joint.reaction_force[3]") / force - 1.0).abs() < 1e-6
    );
    // The twist goes on over the corner: all of it is in the first piece.
    let twist = torque * a / (g * torsion);
    assert!(
        (last("corner.twist") / twist - 1.0).abs() < 2e-4
            && (last("end.twist") / last("corner.twist") - 1.0).abs() < 1e-6
    );
}

/// Pieces in line are the straight beam, but for the size of the slopes, which a weld leaves free on both sides
/// (MECHANICS, trap 12): with loads that bend the beam by a quarter of its length that is felt by 2e-8.
#[test]
fn pieces_in_line_are_a_straight_beam() {
    let load = "force = [5, 200, \"-300*t\"]\nmoment = [4, 0, 0]";
    let straight = Curves::run(&model("elements = 8\nfrom = [0, 0, 0]\nto = [2, 0, 0]\npretwist = 1.5", load, ""), &[]);
    for (points, elements) in [
        ("[0, 0, 0], [1, 0, 0], [2, 0, 0]", 8),
        ("[0, 0, 0], [0.5, 0, 0], [1.5, 0, 0], [2, 0, 0]", 8),
        ("[0, 0, 0], [2, 0, 0]", 8),
    ] {
        let line = format!("elements = {elements}\ncurve = {{ points = [{points}], polyline = true }}\npretwist = 1.5");
        let pieces = Curves::run(&model(&line, load, ""), &[]);
        for name in [
            "end.displacement[3]",
            "end.displacement[2]",
            "end.rotation[1]",
            "end.twist",
            "corner.position[3]",
            "foot.section_moment[3]",
            "energy.elastic",
        ] {
            let (own, expected) = (pieces.last(name), straight.last(name));
            assert!((own / expected - 1.0).abs() < 1e-7, "{points}: {name} {own} {expected}");
        }
    }
}

/// Nodes are numbered along the beam, a corner once; a joint at a corner holds the side towards the start; both sides
/// move as one.
#[test]
fn names_at_corners_mean_the_side_towards_the_start() {
    let line = "elements = 8\ncurve = { points = [[0, 0, 0], [1, 0, 0], [1, 3, 0]], polyline = true }";
    let more = "[output.third]\nat = \"arm.node[3]\"\nquantities = [\"position\"]\n[output.shape]\non = \"arm\"\nstations = 9\nquantities = [\"position\"]";
    let simulation = start(&model(line, "force = [0, 0, 0]", more));
    let (system, state) = (simulation.system(), simulation.state());
    let beam = &system.beams[0];
    assert_eq!((beam.elements(), beam.node_range(), beam.corners.as_slice()), (8, 0..10, &[2][..]));
    assert_eq!((0..=8).map(|end| beam.node(end)).collect::<Vec<_>>(), [0, 1, 2, 4, 5, 6, 7, 8, 9]);
    assert_eq!((0..10).map(|node| beam.end_of(node)).collect::<Vec<_>>(), [0, 1, 2, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(
        (0..10).map(|node| beam.elements_at(node)).collect::<Vec<_>>()[1..5],
        [[Some(0), Some(1)], [Some(1), None], [None, Some(2)], [Some(2), Some(3)]]
    );
    assert_eq!(
        (system.describe_node(2), system.describe_node(3), system.describe_node(4), system.describe_node(9)),
        ("arm.node[2]".into(), "arm.node[2]".into(), "arm.node[3]".into(), "arm.end".into())
    );
    // The corner's sensor is on the first piece: its x is the global x.
    assert!(matches!(system.sensors[1].marker, Marker::Node { node: 2, .. }));
    assert!((system.sensors[1].drawn.axes.column(0) - Vec3::x()).norm() < 1e-15);
    assert_eq!(vector(&simulation, "third.position"), Vec3::new(1.0, 0.5, 0.0));
    for k in 0..9 {
        let arc = 0.5 * f64::from(k);
        let expected = if arc < 1.0 { Vec3::new(arc, 0.0, 0.0) } else { Vec3::new(1.0, arc - 1.0, 0.0) };
        let found = Vec3::from_fn(|i, _| value(&simulation, &format!("shape.position[{},{}]", k + 1, i + 1)));
        assert!((found - expected).norm() < 1e-14, "{found}");
    }
    assert_eq!(state.triads.len(), 10);
}

/// A rigid frame of pieces flies as one body: velocities as given, `v + w x (x - start)`, energy kept, corners closed.
#[test]
fn a_flying_frame_keeps_together() {
    let text = r#"format = 1
[model]
name = "Boomerang"
[material.steel]
young = 2e11
shear = 8e10
density = 7800
[section.bar]
shape = "rectangle"
width = 0.03
height = 0.02
[beam.arm]
material = "steel"
section = "bar"
elements = 5
curve = { points = [[0, 0, 0], [0.5, 0, 0], [0.5, 0.4, 0.3], [0.2, 0.4, 0.5]], polyline = true }
velocity = [1, 2, 3]
angular_velocity = [3, -2, 4]
[output.corner]
at = "arm@0.5"
quantities = ["velocity", "angular_velocity"]
[output.end]
at = "arm.end"
quantities = ["velocity", "angular_velocity", "position"]
[simulation]
stop = 0.2
step = 1e-3
output_step = 1e-2
tolerance = 1e-11
"#;
    let mut simulation = start(text);
    let (v, w) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(3.0, -2.0, 4.0));
    let expected = v + w.cross(&Vec3::new(0.2, 0.4, 0.5));
    assert!((vector(&simulation, "end.velocity") - expected).norm() < 1e-9);
    assert!((vector(&simulation, "end.angular_velocity") - w).norm() < 1e-9);
    let begin = [value(&simulation, "energy.total"), vector(&simulation, "momentum.angular").norm()];
    crate::running::run(&mut simulation, 1e-2, 0.2, |_| {});
    let end = [value(&simulation, "energy.total"), vector(&simulation, "momentum.angular").norm()];
    println!("flying frame: energy {:.1e}, angular momentum {:.1e}", end[0] / begin[0] - 1.0, end[1] / begin[1] - 1.0);
    assert!((end[1] / begin[1] - 1.0).abs() < 1e-10 && (end[0] / begin[0] - 1.0).abs() < 1e-3);
    let q = &simulation.state().q;
    for corner in &simulation.system().beams[0].corners {
        let node = simulation.system().beams[0].node(*corner);
        let apart = (0..3).map(|i| (q[7 * node + i] - q[7 * (node + 1) + i]).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-12, "{apart:e}");
    }
}
