//! Beams that are drawn tight over surfaces: `curve = { over = .. }`.

use crate::running::{start, value};
use ancf14::model::document::Document;
use ancf14::model::shape::Lines;
use std::f64::consts::{FRAC_PI_2, PI};

const SECTION: &str =
    "[section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 10\nEI_z = 10\nGJ = 10\nline_density = 1\n";

fn cylinder(name: &str, offset: [f64; 3], radius: f64) -> String {
    format!("[surface.{name}]\nshape = \"cylinder\"\naxis = [0, 1, 0]\noffset = {offset:?}\nradius = {radius}\n")
}

fn document(rest: &str) -> Document {
    let head = "format = 1\n[model]\nname = \"Over\"\ngravity = [0, 0, 0]\n[simulation]\nstop = 1\n";
    let text = format!("{head}{SECTION}{rest}");
    Document::parse("m.toml", &text, &[]).unwrap()
}

/// Positions of the nodes of all beams, m.
fn nodes(document: &Document) -> Vec<[f64; 3]> {
    let lines = Lines::of(document);
    let all = (0..document.beams.len()).flat_map(|beam| lines.line(beam).unwrap().nodes.clone());
    all.map(|node| node.place.into()).collect()
}

fn farthest(found: &[[f64; 3]], exact: &[[f64; 3]]) -> f64 {
    assert_eq!(found.len(), exact.len());
    let apart = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
    found.iter().zip(exact).map(apart).fold(0.0, f64::max)
}

/// A belt on two pulleys runs through the points that the same belt by expressions has, to the round-off of both.
#[test]
fn belts_are_as_by_expressions() {
    let surfaces = cylinder("a", [0.0; 3], 0.1) + &cylinder("b", [1.0, 0.0, 0.0], 0.1);
    // Right-handed about y: along x at the top, z = R.
    let by_hand = "x = \"if(s < 0.5, 0.5 - s, if(s < 0.5 + w, -R*sin((s - 0.5)/R), if(s < 1.5 + w, s - 0.5 - w, \
                   if(s < 1.5 + 2*w, 1 + R*sin((s - 1.5 - w)/R), 2.5 + 2*w - s))))\", y = \"0\", \
                   z = \"if(s < 0.5, -R, if(s < 0.5 + w, -R*cos((s - 0.5)/R), if(s < 1.5 + w, R, \
                   if(s < 1.5 + 2*w, R*cos((s - 1.5 - w)/R), -R))))\", s = [0, \"2 + 2*w\"]";
    let belt = |curve: &str| {
        let parameters = "[parameters]\nR = 0.11\nw = \"pi*R\"\n";
        let beam = format!("[beam.belt]\nsection = \"s\"\nelements = 40\ncurve = {{ {curve} }}\n");
        nodes(&document(&format!("{parameters}{surfaces}{beam}")))
    };
    let found = belt("over = [\"a\", \"b\"], closed = true, radius = 0.01");
    assert!(farthest(&found, &belt(by_hand)) < 1e-14);
    // The other way around on both: the mirror image in z.
    let back = belt("over = [\"a\", \"b\"], closed = true, turns = [-1, -1], radius = 0.01");
    let mirrored: Vec<_> = found.iter().map(|[x, y, z]| [*x, *y, -z]).collect();
    assert!(farthest(&back, &mirrored) < 1e-14);
}

/// Around three pulleys that are listed against the right-handed sense, a belt is outside of all of them.
#[test]
fn belts_are_around_all_pulleys() {
    let places = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.0, 0.8]];
    let surfaces: String =
        places.iter().zip(["a", "b", "c"]).map(|(place, name)| cylinder(name, *place, 0.1)).collect();
    for order in ["\"a\", \"b\", \"c\"", "\"a\", \"c\", \"b\""] {
        let curve = format!("over = [{order}], closed = true");
        let beam = format!("[beam.belt]\nsection = \"s\"\nelements = 60\ncurve = {{ {curve} }}\n");
        let document = document(&format!("{surfaces}{beam}"));
        let line = Lines::of(&document).line(0).unwrap().clone();
        let sides = 1.0 + 2.0 * f64::hypot(0.5, 0.8);
        let length: f64 = line.spans.iter().map(|span| span.length).sum();
        assert!((length - (sides + 0.2 * PI)).abs() < 1e-13, "{order}: {length}");
        for node in &line.nodes {
            let away = |place: &[f64; 3]| (node.place.x - place[0]).hypot(node.place.z - place[2]);
            assert!(places.iter().all(|place| away(place) > 0.1 - 1e-14), "{:?}", node.place);
        }
    }
}

/// Whole turns rise evenly from end to end, and the ends are where they are written.
#[test]
fn whole_turns_rise_evenly() {
    let beam = "[beam.rope]\nsection = \"s\"\nelements = 96\n\
                curve = { from = [-1, -0.1, 0.1], over = [\"barrel\"], turns = [3], to = [1, 0.1, 0.1] }\n";
    let found = nodes(&document(&(cylinder("barrel", [0.0; 3], 0.1) + beam)));
    assert!(farthest(&[found[0], found[96]], &[[-1.0, -0.1, 0.1], [1.0, 0.1, 0.1]]) < 1e-14);
    let step = (2.0 + 0.4 * PI) / 96.0;
    for (number, [x, y, z]) in found.iter().enumerate() {
        assert!((y + 0.1 - 0.2 * number as f64 / 96.0).abs() < 1e-14);
        let s = step * number as f64;
        if (1.0..1.0 + 0.4 * PI).contains(&s) {
            let angle = (s - 1.0) / 0.1;
            assert!((x - 0.1 * angle.sin()).abs() < 1e-14 && (z - 0.1 * angle.cos()).abs() < 1e-14);
        }
    }
}

/// The axis runs outside of the surface by the radius of its contact, else by half of its section.
#[test]
fn beams_are_as_thick_as_in_their_contact() {
    let round = "[material.m]\nyoung = 1e9\npoisson = 0.3\ndensity = 1e3\n\
                 [section.round]\nshape = \"circle\"\nradius = 0.02\n\
                 [beam.ring]\nmaterial = \"m\"\nsection = \"round\"\nelements = 16\n";
    let radius = |key: &str, contact: &str| {
        let curve = format!("curve = {{ over = [\"post\"], closed = true{key} }}\n");
        let found = nodes(&document(&format!("{}{round}{curve}{contact}", cylinder("post", [0.0; 3], 0.5))));
        found[3][0].hypot(found[3][2])
    };
    let contact = |key: &str| format!("[contact.c]\nof = \"ring\"\nwith = \"post\"\n{key}\n");
    for (key, contact, exact) in [
        ("", String::new(), 0.52),
        ("", contact(""), 0.52),
        ("", contact("radius = 0.015"), 0.515),
        (", radius = 0.1", contact("radius = 0.015"), 0.6),
    ] {
        assert!((radius(key, &contact) - exact).abs() < 1e-14, "{key} {contact}");
    }
}

/// Free of stress it is straight: a quarter of a turn has the energy `EI/(2 R²)` per length, to what cubic elements of a
/// ninth of the arc lose, `(π/18)⁴/720` of it; with the free curvature of the arc there it has none.
#[test]
fn beams_over_surfaces_are_straight_without_stress() {
    let energy = |key: &str| {
        let radius = 2.0 / PI;
        let beam = format!(
            "[beam.bow]\nsection = \"s\"\nelements = 27\nstrain = \"small\"\n{key}\n\
             curve = {{ from = [-1, 0, {radius}], over = [\"post\"], turns = [1], to = [{radius}, 0, -1] }}\n\
             [simulation]\nstop = 0.1\n"
        );
        let text = format!("format = 1\n[model]\nname = \"Bow\"\ngravity = [0, 0, 0]\n{SECTION}");
        value(&start(&format!("{text}{}{beam}", cylinder("post", [0.0; 3], radius))), "energy.elastic")
    };
    let exact = 0.5 * 10.0 * FRAC_PI_2 * FRAC_PI_2;
    let found = energy("");
    assert!((found / exact - 1.0).abs() < 1e-4, "{found} {exact}");
    // The curvature of the arc along the whole beam: on its straight pieces, twice as long, it bends the other way.
    let other = energy(&format!("free_curvature = [{FRAC_PI_2}, 0]"));
    assert!((other / (2.0 * exact) - 1.0).abs() < 1e-4, "{other} {exact}");
}

/// In a copy that is turned and moved, the surfaces are those of the copy, and the ends move along.
#[test]
fn copies_have_their_own_surfaces() {
    let copy = "[copy.k]\ncount = 2\nmove = [0, 0, \"3*(k - 1)\"]\n\
                turn = { axis = [0, 1, 0], center = [0, 0, 0], angle = \"pi/2*(k - 1)\" }\n\
                [copy.k.surface.post]\nshape = \"cylinder\"\naxis = [0, 1, 0]\noffset = [0, 0, 0]\nradius = 0.1\n\
                [copy.k.beam.rope]\nsection = \"s\"\nelements = 8\n\
                curve = { from = [-1, 0, 0.1], over = [\"post\"], turns = [1], to = [0.1, 0, -1] }\n";
    let found = nodes(&document(copy));
    // A quarter of a turn about y leads x to -z and z to x.
    let moved: Vec<_> = found[..9].iter().map(|[x, y, z]| [*z, *y, 3.0 - x]).collect();
    assert!(farthest(&found[9..], &moved) < 1e-14, "{found:?}");
}

/// Surfaces that are too large, too small or too far away to compute with are refused in a sentence.
#[test]
fn sizes_beyond_numbers_are_refused() {
    let closed = "curve = { over = [\"a\", \"b\"], closed = true }";
    let open = "curve = { from = [0, 0, 0], over = [\"a\"], turns = [1], to = [0, 1, 1] }";
    for curve in [closed, open] {
        for [radius, distance] in [[1e200, 1e300], [1e-320, 1e-315], [1.0, 1e308], [1e-200, 1e200], [1e308, 1.0]] {
            let surfaces = [("a", 0.1 * distance), ("b", distance)];
            let surfaces = surfaces.map(|(name, along)| cylinder(name, [0.0, along, along], radius));
            let text = format!(
                "format = 1\n[model]\nname = \"Odd\"\n[section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 1\n\
                 EI_z = 1\nGJ = 1\nline_density = 1\n[beam.rope]\nsection = \"s\"\nelements = 8\n{curve}\n{}\n\
                 [simulation]\nstop = 1\n",
                surfaces.concat()
            );
            let refused = Document::parse("m.toml", &text, &[]).map(|_| ());
            // A line over a point is one.
            let is_line = curve == open && radius < 1e-300;
            assert!(refused.is_err() || is_line, "{curve} {radius:e} {distance:e}");
        }
    }
}

/// A body without a position is told, and nothing else of the belt around it.
#[test]
fn surfaces_on_broken_bodies_are_left_alone() {
    let text = format!(
        "format = 1\n[model]\nname = \"Broken\"\n[section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 1\nEI_z = 1\n\
         GJ = 1\nline_density = 1\n[body.large]\nmass = 1\ninertia = [1, 1, 1]\n\
         [beam.belt]\nsection = \"s\"\nelements = 8\ncurve = {{ over = [\"a\", \"b\"], closed = true }}\n{}{}\n\
         on = \"large\"\n[simulation]\nstop = 1\n",
        cylinder("a", [0.0, 0.0, 0.5], 0.05),
        cylinder("b", [0.0; 3], 0.15)
    );
    let mistakes = Document::parse("m.toml", &text, &[]).map(|_| ()).unwrap_err().to_string();
    assert!(mistakes.contains("position") && !mistakes.contains("belt"), "{mistakes}");
}
