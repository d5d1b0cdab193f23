//! Does a file with copies mean what the same file means in which every part is written out? The flat text is what is
//! read; these tests say which text that is, that it is complete, and that large models of it give the results that
//! their written-out originals gave.

use ancf14::fmi::Model;
use ancf14::model::document::Document;
use ancf14::model::simulation::Simulation;
use ancf14_testing::running::{run, start, value};

const WHEEL: &str = include_str!("../../../models/bicycle_wheel.toml");
const NET: &str = include_str!("../../machines/trampoline_net.toml");
const TURBINE: &str = include_str!("../../machines/wind_turbine.toml");

fn parse(text: &str, overrides: &[(&str, &str)]) -> Result<Document, String> {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Document::parse("m.toml", text, &overrides).map_err(|mistakes| mistakes.to_string())
}

fn flattened(text: &str) -> String {
    parse(text, &[]).unwrap_or_else(|message| panic!("{message}")).text().to_owned()
}

/// A model around some sections.
fn with(sections: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"M\"\n[material.steel]\nyoung = 2e11\npoisson = 0.3\ndensity = 7800\n[section.rod]\nshape = \"circle\"\n\
         radius = 0.01\n{sections}\n[simulation]\nstop = 0.01\nstep = 0.001\n"
    )
}

/// The lines of a section of the flat text.
fn section(text: &str, title: &str) -> String {
    let rest = text.split(&format!("[{title}]\n")).nth(1).unwrap_or_else(|| panic!("no [{title}] in\n{text}"));
    rest.split("\n\n").next().unwrap().trim_end().to_owned()
}

/// Names of the same copy get its index, those of other copies are named by brackets, others stay; the index is a
/// number in expressions.
#[test]
fn names_and_numbers_are_those_of_the_copy() {
    let text = with(
        r#"
[parameters]
L = 2.0
[body.hub]
mass = 1
position = [0, 0, 0]
inertia = [1, 1, 1]
[copy.spokes]
count = 3
[copy.spokes.parameters]
phi = "2*pi*k/3"
[copy.spokes.beam.spoke]
material = "steel"
section = "rod"
from = ["0.1*cos(phi)", "0.1*sin(phi)", 0]
to = ["L*cos(phi)", "L*sin(phi)", "-k*1e-3"]
y_axis = [0, 0, 1]
elements = 2
[copy.spokes.joint.root]
type = "weld"
a = "hub"
b = "spoke.start"
[copy.spokes.joint.next]
type = "spherical"
a = "spoke@0.5*(k - 1)"
b = "spoke[mod(k, 3) + 1].node[k - 1]"
when = "k < 3"
[output.tip]
at = "spoke[3].end"
quantities = ["position"]
"#,
    );
    let flat = flattened(&text);
    assert_eq!(
        section(&flat, "parameters"),
        "L = 2.0\nphi_1 = \"2*pi*1/3\"\nphi_2 = \"2*pi*2/3\"\nphi_3 = \"2*pi*3/3\""
    );
    assert!(section(&flat, "beam.spoke_2").contains("to = [\"L*cos(phi_2)\", \"L*sin(phi_2)\", \"-2*1e-3\"]"));
    assert_eq!(section(&flat, "joint.root_3"), "type = \"weld\"\na = \"hub\"\nb = \"spoke_3.start\"");
    assert_eq!(
        section(&flat, "joint.next_2"),
        "type = \"spherical\"\na = \"spoke_2@0.5*(2 - 1)\"\nb = \"spoke_3.node[1]\""
    );
    assert!(!flat.contains("next_3") && !flat.contains("copy") && flat.contains("at = \"spoke_3.end\""));
}

/// In copies of copies each part has an index for each; brackets may leave out the outer ones.
#[test]
fn copies_of_copies_have_two_indices() {
    let text = with(
        r#"
[copy.rows]
count = 2
index = "i"
move = [0, "i", 0]
[copy.rows.body.post]
mass = 1
position = [0, 0, 0]
inertia = [1, 1, 1]
[copy.rows.copy.columns]
over = [{ x = 0.5, mass = "2*i" }, { x = 0.75, mass = 7 }, { x = 1, mass = 8 }]
index = "j"
turn = { axis = [0, 0, 2], angle = "pi/2*(j - 1)", center = [1, 0, 0] }
[copy.rows.copy.columns.body.cell]
mass = "mass"
position = ["x", 0, "j"]
inertia = [1, 1, 1]
[copy.rows.copy.columns.spring.along]
a = "cell"
b = "cell[j + 1]"
stiffness = 1
when = "j < 3"
[copy.rows.copy.columns.spring.across]
a = "cell"
b = "cell[i + 1][j]"
stiffness = 1
when = "i < 2 and j != 2"
[copy.rows.copy.columns.spring.tie]
a = "post"
b = "cell"
stiffness = 1
"#,
    );
    let flat = flattened(&text);
    let line = |title: &str, key: &str| {
        let lines = section(&flat, title);
        lines.lines().find(|line| line.starts_with(key)).unwrap().to_owned()
    };
    assert_eq!(line("body.cell_2_1", "mass"), "mass = \"(2*2)\"");
    // Turned by 90 degrees about (1, 0): (0.75, 0) becomes (1, -0.25); then moved by 2.
    assert_eq!(line("body.cell_2_2", "position"), "position = [1.0, 1.75, 2.0]");
    assert_eq!(line("body.cell_1_2", "axes"), "axes = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]");
    assert!(!section(&flat, "body.cell_1_1").contains("axes"));
    assert_eq!(
        [line("spring.along_2_1", "a"), line("spring.along_2_1", "b")],
        ["a = \"cell_2_1\"", "b = \"cell_2_2\""]
    );
    assert_eq!(line("spring.across_1_3", "b"), "b = \"cell_2_3\"");
    assert_eq!(line("spring.tie_2_3", "a"), "a = \"post_2\"");
    assert!(!flat.contains("along_2_3") && !flat.contains("across_1_2") && !flat.contains("across_2_1"));
}

/// Parameters that decide what there is are numbers of the flat file, also where they stand in expressions: changed
/// later, they would change half of it. `--set` changes them when the file is read.
#[test]
fn counts_are_set_when_the_file_is_read() {
    let document = parse(NET_OF_RODS, &[("n", "5")]).unwrap_or_else(|message| panic!("{message}"));
    assert_eq!(document.bodies.len(), 5);
    let names: Vec<_> = document.parameters().iter().map(|parameter| parameter.variable.name.clone()).collect();
    assert!(!names.iter().any(|name| name == "n" || name == "half") && names.iter().any(|name| name == "L"));
    assert!(document.text().contains("position = [\"L*3/5\", 0, \"2.5\"]"), "{}", document.text());
    assert_eq!(parse(NET_OF_RODS, &[("rods.count", "5")]).unwrap().bodies.len(), 5);
    assert_eq!(parse(NET_OF_RODS, &[("L", "3"), ("rod_2.mass", "4")]).unwrap().bodies.len(), 4);
    for (key, value, expected) in [
        ("n", "5.5", "a whole number from 0 to 10000 was expected"),
        ("n", "20001", "`n` must be at most 20"),
        ("rods.count", "20001", "a whole number from 0 to 10000 was expected"),
        ("rod_5.mass", "1", "nothing in the file is named `rod_5`"),
    ] {
        let message = parse(NET_OF_RODS, &[(key, value)]).unwrap_err();
        assert!(message.contains(expected), "{key} = {value}: {message}");
    }
    let message = parse(NET_OF_RODS, &[("n", "3"), ("n", "5")]).unwrap_err();
    assert!(message.contains("`n` is set twice"), "{message}");
}

const NET_OF_RODS: &str = r#"
format = 1
[model]
name = "M"
[parameters]
L = 2
half = "n/2"
n = { value = 4, min = 1, max = 20 }
[copy.rods]
count = "2*half"
[copy.rods.body.rod]
mass = 1
position = ["L*k/n", 0, "half"]
inertia = [1, 1, 1]
[simulation]
stop = 1
step = 0.1
"#;

/// The flat text is a file of its own: it reads as itself and gives the same results, bit by bit.
#[test]
fn the_flat_text_gives_the_same_results() {
    for text in [WHEEL, NET, TURBINE] {
        let flat = flattened(text);
        assert_eq!(flattened(&flat), flat);
        let values = |text: &str| {
            let mut simulation = start(text);
            simulation.advance(0.1).unwrap_or_else(|failure| panic!("{}", failure.message));
            let count = simulation.variables().len();
            let values: Vec<u64> = (0..count).map(|place| simulation.value(place).number().to_bits()).collect();
            (simulation.about().guid.clone(), values)
        };
        assert_eq!(values(text), values(&flat));
    }
}

/// The example of the page runs, and its spokes pull the ring evenly: nothing but the tension acts on it.
#[test]
fn the_example_of_the_page_runs() {
    let page = include_str!("../../../docs/language/copies.md");
    let rest = page.split("# Copies and included files").nth(1).expect("the section");
    let example = rest.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("the example");
    let simulation = start(example);
    assert_eq!((simulation.document().springs.len(), simulation.document().beams.len()), (32, 1));
    assert_eq!(parse(example, &[("spokes", "36")]).unwrap().springs.len(), 36);
}

/// Nested counts make no machine that nobody can read: the limit is reached at once, also by copies of nothing.
#[test]
fn there_is_a_limit_of_parts() {
    let nested = |sections: &str| {
        with(&format!(
            "[copy.a]\ncount = 10000\nindex = \"i\"\n[copy.a.copy.b]\ncount = 10000\nindex = \"j\"\n{sections}"
        ))
    };
    let body = "[copy.a.copy.b.body.c]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]";
    let deep = "[copy.a.copy.b.copy.c]\ncount = 10000";
    let wide = format!("[copy.a.copy.b.load.c]\nat = \"x\"\nforce = [{}]", "1, ".repeat(100_000));
    for text in [nested(body), nested(deep), nested(""), nested(&wide)] {
        let clock = std::time::Instant::now();
        let message = parse(&text, &[]).unwrap_err();
        assert!(message.contains("the copies make too many parts") && message.contains("10000 parts"), "{message}");
        assert!(clock.elapsed().as_secs_f64() < 20.0, "it takes {:?}", clock.elapsed());
    }
    // Texts that double from copy to copy stop growing, and the reader refuses them.
    let mut text = String::from("[copy.c0]\nover = [{ x0 = \"t + t\" }]\nindex = \"k0\"\n");
    let mut path = String::from("copy.c0");
    for k in 1..18 {
        path.push_str(&format!(".copy.c{k}"));
        text.push_str(&format!(
            "[{path}]\nover = [{{ x{k} = \"x{0} + x{0} + x{0} + x{0}\" }}]\nindex = \"k{k}\"\n",
            k - 1
        ));
    }
    text.push_str(&format!("[{path}.body.b]\nmass = \"x17\"\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n"));
    let message = parse(&with(&text), &[]).unwrap_err();
    assert!(message.contains("the limit is 4000"), "{message}");
}

// What the files that a program had written gave, part by part, with the same version of the solver. The force and the
// moment of the turbine are those after a change of the numerical dissipation, which moved them by up to
// 5e-5.
const WHEEL_CONTACT: f64 = 2.2057544304771026e-4;
const WHEEL_TOP: f64 = -1.1114192730415917e-4;
const NET_HEIGHT: f64 = -0.1575660434009597;
const TURBINE_TIP: f64 = -30.153072758125;
const TURBINE_FORCE: f64 = 58915.04647117718;
const TURBINE_MOMENT: f64 = 1798717.7728679865;

/// The results of a wheel that was written out by a program: 32 frames with their coordinates to the last digit, in
/// place of points on the hub.
#[test]
fn the_wheel_agrees_with_the_written_out_one() {
    let mut simulation = start(WHEEL);
    run(&mut simulation, 0.1, 1.0, |_| {});
    assert_eq!(simulation.document().springs.len(), 32);
    for (name, expected) in [("contact.displacement[3]", WHEEL_CONTACT), ("rim_top.displacement[3]", WHEEL_TOP)] {
        let result = value(&simulation, name);
        // Coordinates rounded in other places, and Newton's tolerance of 1e-8.
        assert!((result - expected).abs() < 1e-6 * expected.abs(), "{name} is {result}, {expected} in the original");
    }
}

/// The originals had none.
fn without_rotary_inertia(text: &str) -> String {
    text.replace("\nelements =", "\nrotary_inertia = false\nelements =")
}

#[test]
fn the_net_agrees_with_the_written_out_one() {
    let mut simulation = start(&without_rotary_inertia(NET));
    run(&mut simulation, 4e-3, 0.1, |_| {});
    let result = value(&simulation, "ball_motion.position[3]");
    assert!((result - NET_HEIGHT).abs() < 1e-6 * NET_HEIGHT.abs(), "{result}, {NET_HEIGHT} in the original");
    let set = |n: &str| parse(NET, &[("n", n)]).unwrap_or_else(|message| panic!("{message}"));
    assert_eq!([set("3").joints.len(), set("7").joints.len()], [12 + 9 + 1, 28 + 49 + 1]);
}

#[test]
fn the_turbine_agrees_with_the_written_out_one() {
    let mut simulation = start(&without_rotary_inertia(TURBINE));
    run(&mut simulation, 0.05, 2.0, |_| {});
    for (name, expected) in [
        ("tip1.displacement[2]", TURBINE_TIP),
        ("root1.reaction_force[3]", TURBINE_FORCE),
        ("base.reaction_moment[2]", TURBINE_MOMENT),
    ] {
        let result = value(&simulation, name);
        assert!((result - expected).abs() < 1e-6 * expected.abs(), "{name} is {result}, {expected} in the original");
    }
}

/// A model from memory includes nothing.
#[test]
fn a_text_without_a_folder_includes_no_file() {
    let text = with("[include.blade]\nfile = \"blade.toml\"");
    let failure = Simulation::load("m.toml", &text, &[]).unwrap_err();
    assert!(failure.message.contains("`blade.toml` cannot be included: this model is a text without a folder"));
}
