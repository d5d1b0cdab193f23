//! Equilibria: cantilevers, frames, arches, cables, columns that buckle, springs that snap, linkages.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::PI;

pub(super) const KINDS: [Kind; 8] = [
    Kind::new("cantilever", 4, cantilever),
    Kind::new("portal", 4, portal),
    Kind::new("arch", 4, arch),
    Kind::new("cable", 4, cable),
    Kind::new("column", 4, column),
    Kind::new("truss", 4, truss),
    Kind::new("twist", 4, twist),
    Kind::new("scissor", 4, scissor),
];

const YOUNG: f64 = 2.1e11;

/// A cantilever under a large force and a moment at its tip; from micrometers to a kilometer.
fn cantilever(choice: &mut Choice) -> String {
    let length = choice.scale(1e-5, 1e3);
    let height = round(length * choice.between(0.005, 0.02));
    let bending = YOUNG * 2.0 * height.powi(4) / 12.0;
    let mut text = Text::new(0.0);
    text.steel();
    text.rectangle("flat", 2.0 * height, height);
    text.beam("arm", "flat", [[0.0; 3], [length, 0.0, 0.0]], choice.whole(4, 12), "");
    text.joint("root", "weld", ["ground", "arm.start"], "");
    let force = [0.2, 0.5, 3.0].map(|most| number(round(choice.between(0.0, most) * bending / length.powi(2))));
    let law = force.map(|force| format!("\"{force}*t\"")).join(", ");
    let follower = choice.pick(&["", "\nfollower = true"]);
    text.load("tip_load", "arm.end", &format!("force = [{law}]{follower}"));
    text.watch("tip", "arm.end", &["position", "rotation"]);
    text.watch("root_load", "root", &["reaction_force", "reaction_moment"]);
    text.watch("inside", "arm@0.5", &["section_force", "section_moment"]);
    text.end_static(choice.whole(4, 20))
}

/// A frame of three welded beams under a sway load and a weight.
fn portal(choice: &mut Choice) -> String {
    let (width, height) = (choice.between(0.5, 3.0), choice.between(0.5, 2.0));
    let mut text = Text::new(9.81);
    text.matter(choice.scale(1e9, 2e11), 7850.0, 0.0);
    text.rectangle("bar", 0.03, 0.02);
    let elements = choice.whole(2, 8);
    let corners = [[0.0; 3], [0.0, 0.0, height], [width, 0.0, height], [width, 0.0, 0.0]];
    for (number, name) in ["left", "top", "right"].into_iter().enumerate() {
        text.beam(name, "bar", [corners[number], corners[number + 1]], elements, "");
    }
    for (name, sides) in [
        ("foot", ["ground", "left.start"]),
        ("knee", ["left.end", "top.start"]),
        ("corner", ["top.end", "right.start"]),
        ("heel", ["ground", "right.end"]),
    ] {
        text.joint(name, "weld", sides, "");
    }
    let sway = round(choice.scale(1.0, 300.0));
    text.load("sway", "top.start", &format!("force = [\"{}*t\", \"{}*t\", 0]", number(sway), number(0.1 * sway)));
    text.watch("knee_motion", "top.start", &["position", "rotation"]);
    text.watch("foot_load", "foot", &["reaction_force", "reaction_moment"]);
    text.end_static(choice.whole(4, 20))
}

/// A shallow arch that snaps through under a dead load, or follows a drive.
fn arch(choice: &mut Choice) -> String {
    let (rise, height) = (choice.between(0.02, 0.08), choice.between(0.002, 0.01));
    let mut text = Text::new(0.0);
    text.steel();
    text.rectangle("flat", 0.02, height);
    let line = format!("curve = {{ x = \"s\", y = 0, z = \"{}*sin(pi*s)\", s = [0, 1] }}", number(rise));
    text.line("arch", "flat", 4 * choice.whole(1, 3), &line);
    text.joint("left", "revolute", ["ground", "arch.start"], "axis = [0, 1, 0]");
    text.joint("right", "revolute", ["ground", "arch.end"], "axis = [0, 1, 0]");
    if choice.pick(&[true, false]) {
        let stiffness = 48.0 * YOUNG * 0.02 * height.powi(3) / 12.0;
        let load = number(round(choice.between(2.0, 10.0) * stiffness * rise));
        text.load("press", "arch@0.5", &format!("force = [0, 0, \"-{load}*t\"]"));
    } else {
        text.joint("ram", "inplane", ["ground", "arch@0.5"], "axis = [1, 0, 0]");
        text.joint("punch", "inline", ["ground", "arch@0.25"], "axis = [0, 0, -1]");
        text.drive("motor", "punch", "distance", &format!("value = \"{}*t\"", number(round(rise))));
        text.watch("motor_force", "motor", &["effort"]);
    }
    text.watch("crown", "arch@0.5", &["position"]);
    text.watch("hinge", "left", &["reaction_force"]);
    text.end_static(choice.whole(10, 40))
}

/// A slack cable between two points, one of which moves away until it is tight.
fn cable(choice: &mut Choice) -> String {
    let (span, sag) = (choice.scale(0.1, 100.0), choice.between(0.6, 1.2));
    let mut text = Text::new(9.81);
    text.matter(choice.scale(1e9, 1e11), 5000.0, 0.0);
    text.circle("cord", round(5e-4 * span));
    let (half, sag) = (number(0.5 * span), number(round(sag * span)));
    let line = format!(
        "curve = {{ x = \"s\", y = 0, z = \"{sag}*(cosh((s - {half})/{sag}) - cosh({half}/{sag}))\", s = [0, {}] }}",
        number(span)
    );
    text.line("cable", "cord", 2 * choice.whole(4, 10), &line);
    let way = number(round(choice.between(-0.3, 0.1) * span));
    text.add("frame.hanger", &format!("position = [\"{} + {way}*t\", 0, 0]", number(span)));
    text.joint("anchor", "universal", ["ground", "cable.start"], "axis = [0, 1, 0]\naxis2 = [0, 0, 1]");
    text.joint("hook", "spherical", ["hanger", "cable.end"], "");
    text.watch("middle", "cable@0.5", &["position", "section_force"]);
    text.watch("pull", "hanger", &["reaction_force"]);
    text.end_static(choice.whole(4, 20))
}

/// A column under a rising load, with an imperfection or without.
fn column(choice: &mut Choice) -> String {
    let height = choice.between(0.003, 0.02);
    let critical = PI.powi(2) * YOUNG * 2.0 * height.powi(4) / 12.0 / 4.0;
    let mut text = Text::new(0.0);
    text.steel();
    text.rectangle("flat", 2.0 * height, height);
    text.beam("column", "flat", [[0.0; 3], [1.0, 0.0, 0.0]], choice.whole(3, 10), "");
    text.joint("foot", "weld", ["ground", "column.start"], "");
    let (load, side) = (number(round(choice.between(0.8, 2.0) * critical)), choice.pick(&[0.0, 1e-3, 1e-2]));
    text.load("weight", "column.end", &format!("force = [\"-{load}*t\", 0, {}]", number(round(side * critical))));
    text.watch("tip", "column.end", &["position"]);
    text.watch("foot_load", "foot", &["reaction_force", "reaction_moment"]);
    text.end_static(choice.whole(5, 40))
}

/// A truss of springs from soft to stiff, with a mass that hangs in it.
fn truss(choice: &mut Choice) -> String {
    let mut text = Text::new(9.81);
    text.body("weight", choice.scale(0.1, 1000.0), [0.0, 0.0, -1.0], [1.0; 3], "");
    for (name, place) in [("east", [1.0, 0.2, 0.0]), ("north", [-0.6, 0.9, 0.1]), ("west", [-0.5, -0.8, -0.2])] {
        text.add(&format!("frame.{name}_nail"), &format!("position = {}", list(place)));
        let nail = format!("{name}_nail");
        text.spring(&format!("{name}_wire"), [&nail, "weight"], [choice.scale(1e3, 1e10), 0.0], "");
    }
    text.joint("upright", "bushing", ["ground", "weight"], "stiffness = [0, 0, 0]\nrotational_stiffness = [1, 1, 1]");
    text.load("wind", "weight", "force = [\"3*t\", \"5*t\", 0]");
    text.watch("motion", "weight", &["displacement"]);
    text.watch("pull", "east_nail", &["reaction_force"]);
    text.end_static(choice.whole(2, 10))
}

/// A pretwisted strip is turned at its end and pulled.
fn twist(choice: &mut Choice) -> String {
    let (width, height) = (choice.between(0.02, 0.1), choice.between(0.001, 0.004));
    let mut text = Text::new(0.0);
    text.steel();
    text.rectangle("flat", width, height);
    let pretwist = number(choice.between(0.0, 1.0));
    text.beam("strip", "flat", [[0.0; 3], [1.0, 0.0, 0.0]], choice.whole(2, 8), &format!("pretwist = {pretwist}"));
    text.joint("root", "weld", ["ground", "strip.start"], "");
    text.joint("chuck", "cylindrical", ["ground", "strip.end"], "axis = [1, 0, 0]");
    text.drive("motor", "chuck", "angle", &format!("value = \"{}*t\"", number(choice.between(0.5, 3.0))));
    text.load("pull", "strip.end", &format!("force = [\"{}*t\", 0, 0]", number(choice.scale(1.0, 1e4))));
    text.watch("torque", "motor", &["effort"]);
    text.watch("shortening", "chuck", &["distance"]);
    text.watch("inside", "strip@0.5", &["section_force", "section_moment"]);
    text.end_static(choice.whole(4, 20))
}

/// A scissor lift is raised under its load.
fn scissor(choice: &mut Choice) -> String {
    let (angle, length) = (choice.between(0.3, 0.6), choice.scale(1e-3, 10.0));
    let (width, height) = (length * angle.cos(), length * angle.sin());
    let mut text = Text::new(9.81);
    text.steel();
    text.rectangle("arm", round(0.02 * length), round(0.05 * length));
    let elements = 2 * choice.whole(1, 3);
    text.beam("rising", "arm", [[0.0; 3], [width, 0.0, height]], elements, "");
    text.beam("falling", "arm", [[width, 0.0, 0.0], [0.0, 0.0, height]], elements, "");
    let hinge = "axis = [0, 1, 0]";
    text.joint("foot", "revolute", ["ground", "rising.start"], hinge);
    text.joint("slide", "inline", ["ground", "falling.start"], "axis = [-1, 0, 0]");
    text.joint("cross", "revolute", ["rising@0.5", "falling@0.5"], hinge);
    let load = number(round(choice.scale(1e3, 1e6) * length.powi(2)));
    text.load("left_weight", "falling.end", &format!("force = [0, 0, -{load}]"));
    text.load("right_weight", "rising.end", &format!("force = [0, 0, -{load}]"));
    text.drive("screw", "slide", "distance", &format!("value = \"{}*t\"", number(round(0.2 * length))));
    text.watch("top", "falling.end", &["position"]);
    text.watch("push", "screw", &["effort"]);
    text.watch("arm_load", "rising@0.25", &["section_force"]);
    text.end_static(choice.whole(4, 20))
}
