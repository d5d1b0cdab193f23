//! What is slack: cables between poles, ropes that are shaken, chains of links, nets.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};

pub(super) const KINDS: [Kind; 4] =
    [Kind::new("cable", 6, cable), Kind::new("rope", 6, rope), Kind::new("chain", 6, chain), Kind::new("net", 6, net)];

const STEPS: usize = 500;

/// A cable between two poles, drawn as a catenary; one pole moves to and fro.
fn cable(choice: &mut Choice) -> String {
    let span = choice.scale(1.0, 100.0);
    let sag = choice.between(0.5, 1.2) * span;
    let time = (span / 9.81).sqrt();
    let mut text = Text::new(9.81);
    text.matter(choice.scale(1e9, 1e11), 5000.0, choice.pick(&[1e-4, 1e-3, 1e-2]));
    text.circle("cord", 5e-4 * span);
    let (half, sag) = (number(0.5 * span), number(sag));
    let line = format!(
        "curve = {{ x = \"s\", y = 0, z = \"{sag}*(cosh((s - {half})/{sag}) - cosh({half}/{sag}))\", s = [0, {}] }}",
        number(span)
    );
    text.line("cable", "cord", 2 * choice.whole(4, 10), &line);
    let (way, rate) = (number(choice.between(0.05, 0.3) * span), number(choice.between(0.3, 1.5) / time));
    let place = format!("\"{} - {way}*0.5*(1 - cos({rate}*t))\"", number(span));
    text.add("frame.hanger", &format!("position = [{place}, 0, 0]"));
    text.joint("anchor", "universal", ["ground", "cable.start"], "axis = [0, 1, 0]\naxis2 = [0, 0, 1]");
    text.joint("hook", "spherical", ["hanger", "cable.end"], "");
    text.watch_motion("middle", "cable@0.5");
    text.watch("pull", "hanger", &["reaction_force"]);
    text.watch("inside", "cable@0.25", &["section_force"]);
    text.end(round(0.01 * time * choice.scale(0.3, 3.0)), STEPS, "initial = \"equilibrium\"")
}

/// A rope hangs from a hand that shakes it; a weight at its end, or none.
fn rope(choice: &mut Choice) -> String {
    let length = choice.between(1.0, 5.0);
    let mut text = Text::new(9.81);
    text.matter(choice.scale(1e8, 1e10), 1200.0, choice.pick(&[1e-3, 1e-2]));
    text.circle("cord", choice.between(0.002, 0.006));
    text.beam("rope", "cord", [[0.0; 3], [0.0, 0.0, -length]], choice.whole(6, 16), "");
    let (way, rate) = (number(choice.between(0.02, 0.1) * length), number(choice.between(2.0, 6.0)));
    text.add("frame.hand", &format!("position = [\"{way}*sin({rate}*t)\", 0, 0]"));
    text.joint("grip", "weld", ["hand", "rope.start"], "");
    let mass = choice.pick(&[0.0, 0.05, 1.0]);
    if mass > 0.0 {
        text.body("weight", mass, [0.0, 0.0, -length - 0.05], [1e-3 * mass; 3], "");
        let axes = "at = [0, 0, PLACE]\naxis = [1, 0, 0]\naxis2 = [0, 1, 0]".replace("PLACE", &number(-length));
        text.joint("knot", "universal", ["rope.end", "weight"], &axes);
    }
    text.watch_motion("tip", "rope.end");
    text.watch("hand_load", "hand", &["reaction_force"]);
    text.end(round(0.005 * choice.scale(0.3, 2.0)), STEPS, "initial = \"equilibrium\"")
}

/// Links on ball joints hang between two points and swing, drawn as a zigzag.
fn chain(choice: &mut Choice) -> String {
    let links = choice.whole(3, 6);
    let (length, mass) = (choice.between(0.05, 0.5), choice.scale(0.01, 1.0));
    let slope = choice.between(0.2, 0.6);
    let mut text = Text::new(9.81);
    let inertia = [mass * length * length / 12.0; 3].map(round);
    let place = |number: usize| {
        let half = links as f64 / 2.0;
        let depth = slope * (half - (number as f64 - half).abs());
        [length * number as f64, 0.0, -length * depth]
    };
    let mut before = String::from("ground");
    for number in 0..links {
        let (from, to) = (place(number), place(number + 1));
        let middle = [0, 1, 2].map(|axis| 0.5 * (from[axis] + to[axis]));
        let own = format!("link{number}");
        text.body(&own, mass, middle, inertia, "");
        text.joint(&format!("ball{number}"), "spherical", [&before, &own], &format!("at = {}", list(from)));
        before = own;
    }
    if choice.pick(&[true, false]) {
        text.joint("end", "spherical", ["ground", &before], &format!("at = {}", list(place(links))));
    }
    text.watch_motion("middle", &format!("link{}", links / 2));
    text.watch("pull", "ball0", &["reaction_force"]);
    let time = (length * links as f64 / 9.81).sqrt();
    text.end(round(0.01 * time * choice.scale(0.2, 2.0)), STEPS, "")
}

/// A net of four cords; a weight in one knot falls.
fn net(choice: &mut Choice) -> String {
    let size = choice.between(0.5, 2.0);
    let mut text = Text::new(9.81);
    text.matter(choice.scale(1e7, 1e9), 1000.0, choice.pick(&[1e-3, 1e-2]));
    text.circle("cord", 0.004 * size);
    let places = [size / 4.0, 3.0 * size / 4.0];
    for (number, place) in places.into_iter().enumerate() {
        let (along, across) = (format!("x{number}"), format!("y{number}"));
        text.beam(&along, "cord", [[0.0, place, 0.0], [size, place, 0.0]], 4, "");
        text.beam(&across, "cord", [[place, 0.0, 0.0], [place, size, 0.0]], 4, "y_axis = [1, 0, 0]");
        for (cord, end) in [(&along, "start"), (&along, "end"), (&across, "start"), (&across, "end")] {
            text.joint(&format!("{cord}_{end}"), "weld", ["ground", &format!("{cord}.{end}")], "");
        }
    }
    for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let [a, b] = [format!("x{row}.node[{}]", 1 + 2 * column), format!("y{column}.node[{}]", 1 + 2 * row)];
        text.joint(&format!("knot{row}{column}"), "spherical", [&a, &b], "");
    }
    let mass = choice.scale(0.1, 5.0) * size;
    let speed = format!("velocity = {}", list([0.0, 0.0, -choice.between(0.0, 2.0)]));
    text.body("weight", mass, [places[0], places[0], 0.0], [0.01 * mass; 3], &speed);
    text.joint("sling", "spherical", ["x0.node[1]", "weight"], "");
    text.watch_motion("fall", "weight");
    text.watch("far", "x1.node[3]", &["position"]);
    text.watch("corner", "x0_start", &["reaction_force"]);
    text.end(round(2e-3 * size * choice.scale(0.3, 1.5)), STEPS / 2, "")
}
