//! Does `check --view` draw a mechanism from the side that it names? A rotor that is seen edge-on shows nothing.

use super::command_line::{ancf14, model, text};

/// Views differ from one another, the default is the oblique one, and in each all names can be read.
#[test]
fn drawings_are_seen_from_sides() {
    let directory = tempfile::tempdir().unwrap();
    let draw = |file: &str, view: &[&str]| {
        let ran = ancf14(directory.path(), &[&["check", &model("four_bar"), "--draw", file], view].concat());
        assert!(ran.status.success(), "{}", text(&ran.stderr));
        std::fs::read(directory.path().join(file)).unwrap()
    };
    let views = ["oblique", "front", "top", "side", "iso"];
    let drawn = views.map(|view| draw("m.svg", &["--view", view]));
    assert!(draw("m.svg", &[]) == drawn[0]);
    for (number, svg) in drawn.iter().enumerate() {
        assert!(drawn[..number].iter().all(|other| other != svg), "{}", views[number]);
        for name in ["crank", "coupler", "rocker"] {
            assert!(text(svg).contains(&format!(">{name}</text>")), "{name} is not in the view {}", views[number]);
        }
    }
    let [front, top] = ["front", "top"].map(|view| draw("m.png", &["--view", view]));
    assert!(front.starts_with(b"\x89PNG") && front != top);
}

/// An unknown view is refused with those that there are, and a view without a drawing too.
#[test]
fn views_are_checked() {
    let directory = tempfile::tempdir().unwrap();
    let file = model("pendulum");
    let unknown = ancf14(directory.path(), &["check", &file, "--draw", "m.svg", "--view", "left"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("oblique, front, top, side, iso"), "{}", text(&unknown.stderr));
    let alone = ancf14(directory.path(), &["check", &file, "--view", "front"]);
    assert!(alone.status.code() == Some(2) && text(&alone.stderr).contains("--draw"), "{}", text(&alone.stderr));
}
