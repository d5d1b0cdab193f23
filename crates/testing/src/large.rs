//! Model files of large mechanisms, of any size: chains, nets, combs.

use std::fmt::Write;

/// What the solver looks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// A motion of 0.05 s in steps of 1 ms.
    Motion,
    /// An equilibrium.
    Equilibrium,
}

fn head(name: &str, search: Search) -> String {
    let simulation = match search {
        Search::Motion => "stop = 0.05, step = 1e-3, output_step = 0.05",
        Search::Equilibrium => "analysis = \"static\", stop = 1, step = 1, output_step = 1",
    };
    format!(
        r#"format = 1
model = {{ name = "{name}", gravity = [0, 0, -9.81] }}
material.steel = {{ young = 210e9, poisson = 0.3, density = 7800 }}
simulation = {{ {simulation} }}
section.square = {{ shape = "rectangle", width = 0.02, height = 0.02 }}
section.tooth = {{ shape = "circle", radius = 0.005 }}
section.rope = {{ shape = "circle", radius = 0.01 }}
"#
    )
}

fn weld(name: &str, a: &str, b: &str, more: &str) -> String {
    format!("joint.{name} = {{ type = \"weld\", a = \"{a}\", b = \"{b}\"{more} }}\n")
}

/// A cantilever of `count` elements, 2 mm long each from 1,000 elements on.
pub fn chain(count: usize, search: Search) -> String {
    let length = 2e-3 * count.max(1000) as f64;
    let mut text = head("Chain", search);
    let _ = writeln!(
        text,
        "beam.chain = {{ material = \"steel\", section = \"square\", from = [0, 0, 0], to = [{length}, 0, 0], elements = {count}, strain = \"small\" }}"
    );
    text + &weld("root", "ground", "chain.start", "")
}

/// `count` ropes along x and as many along y, 1 m apart and clamped at both ends, joined at each crossing by a joint of
/// the type `joint`.
pub fn net(count: usize, joint: &str, search: Search) -> String {
    let mut text = head("Net", search);
    let spans = count + 1;
    for i in 1..=count {
        for (axis, from, to) in [('x', [0, i], [spans, i]), ('y', [i, 0], [i, spans])] {
            let _ = writeln!(
                text,
                "beam.{axis}{i} = {{ material = \"steel\", section = \"rope\", from = [{}, {}, 0], to = [{}, {}, 0], elements = {spans}, y_axis = [0, 0, 1], strain = \"small\" }}",
                from[0], from[1], to[0], to[1]
            );
            text += &weld(&format!("{axis}{i}s"), "ground", &format!("{axis}{i}.start"), "");
            text += &weld(&format!("{axis}{i}e"), "ground", &format!("{axis}{i}.end"), "");
        }
    }
    for i in 1..=count {
        for j in 1..=count {
            let _ = writeln!(
                text,
                "joint.c{i}_{j} = {{ type = \"{joint}\", a = \"x{i}.node[{j}]\", b = \"y{j}.node[{i}]\" }}"
            );
        }
    }
    text
}

/// A spine of `count` elements, clamped at both ends, with a rigid body welded to each inner node and a tooth of four
/// elements welded to each body.
pub fn comb(count: usize, search: Search) -> String {
    let mut text = head("Comb", search);
    let _ = writeln!(
        text,
        "beam.spine = {{ material = \"steel\", section = \"square\", from = [0, 0, 0], to = [{}, 0, 0], elements = {count}, strain = \"small\" }}",
        count as f64 / 10.0
    );
    text += &weld("root", "ground", "spine.start", "");
    text += &weld("root2", "ground", "spine.end", "");
    for i in 1..count {
        let x = i as f64 / 10.0;
        let at = format!(", at = [{x}, 0, 0]");
        let _ = writeln!(
            text,
            "body.b{i} = {{ mass = 0.1, position = [{x}, 0, 0], inertia = [1e-4, 1e-4, 1e-4] }}\n\
             beam.t{i} = {{ material = \"steel\", section = \"tooth\", from = [{x}, 0, 0], to = [{x}, 0.5, 0], elements = 4, y_axis = [0, 0, 1], strain = \"small\" }}"
        );
        text += &weld(&format!("h{i}"), &format!("spine.node[{i}]"), &format!("b{i}"), &at);
        text += &weld(&format!("j{i}"), &format!("b{i}"), &format!("t{i}.start"), &at);
    }
    text
}
