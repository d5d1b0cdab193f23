//! Are rigid arms told that nobody asked for? A joint between places that do not meet has one, as long as the distance.
//! `at` asks for it, and so do bodies and frames with an extent.

use ancf14::model::document::Document;
use ancf14::model::notes::notes;

/// A wire of 1 m along x, welded at the ground, with `rest` at its end.
fn wire(rest: &str) -> Vec<String> {
    let text = format!(
        "format = 1\nmodel.name = \"M\"\n[material.steel]\nyoung = 210e9\npoisson = 0.3\ndensity = 7850\n[section.round]\nshape = \"circle\"\nradius = 0.002\n\
         [beam.wire]\nmaterial = \"steel\"\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
         [joint.left]\ntype = \"weld\"\na = \"ground\"\nb = \"wire.start\"\n{rest}\n[simulation]\nanalysis = \"static\"\nstop = 1\n"
    );
    notes(&Document::parse("m.toml", &text, &[]).unwrap())
}

/// A joint of `kind` between a frame at `place` and the end of the wire.
fn held(place: &str, kind: &str) -> Vec<String> {
    wire(&format!("[frame.hand]\nposition = {place}\n[joint.right]\ntype = {kind}\na = \"hand\"\nb = \"wire.end\""))
}

/// A joint of `kind` between a body of 5 kg at `place`, with a radius of gyration of 0.02 m, and the end of the wire.
fn weighted(place: &str, kind: &str) -> Vec<String> {
    wire(&format!(
        "[body.bob]\nmass = 5\nposition = {place}\ninertia = [1e-3, 2e-3, 2e-3]\n[joint.right]\ntype = {kind}"
    ))
}

#[test]
fn silent_arms_are_told_with_their_length() {
    let found = held("[\"1.5 - 0.2*t\", 0, 0]", "\"weld\"");
    assert_eq!(
        found,
        [
            "m.toml, line 22: joint right joins places that do not meet: hand is drawn at [1.5, 0, 0], and wire.end at [1, 0, 0]. The distance, 0.5 m, becomes a rigid arm \
          on hand. Draw the parts so that they meet. If the arm is meant, say where the joint is: at = [1, 0, 0]"
        ]
    );
    assert_eq!(held("[1.5, 0, 0]", "\"weld\"\nat = [1, 0, 0]"), [""; 0]);
    // Six digits of 1 m meet, four do not.
    assert_eq!(held("[1.0000005, 0, 0]", "\"spherical\""), [""; 0]);
    assert!(held("[1.0005, 0, 0]", "\"spherical\"")[0].contains("The distance, 0.0005 m,"));
    let bushing = held("[1, 0.1, 0]", "\"bushing\"\nstiffness = [1, 1, 1]");
    assert!(bushing[0].contains("The distance, 0.1 m,"), "{bushing:?}");
    let point = wire(
        "[point.post]\noffset = [1, 0, 0.25]\n[joint.right]\ntype = \"spherical\"\na = \"post\"\nb = \"wire.end\"",
    );
    assert!(point[0].contains("post is drawn at [1, 0, 0.25]") && point[0].contains("0.25 m"), "{point:?}");
}

/// A slider begins anywhere along its way, and a plane anywhere in it; across, the distance is an arm.
#[test]
fn ways_of_sliding_joints_are_no_arms() {
    let axis = "axis = [1, 0, 0]";
    for kind in ["prismatic", "cylindrical", "inline"] {
        assert_eq!(held("[1.5, 0, 0]", &format!("\"{kind}\"\n{axis}")), [""; 0], "{kind}");
        let across = held("[1.5, 0.1, 0]", &format!("\"{kind}\"\n{axis}"));
        assert!(across[0].contains("The distance, 0.1 m,"), "{kind}: {across:?}");
    }
    assert_eq!(held("[1, 0.1, 0.2]", &format!("\"inplane\"\n{axis}")), [""; 0]);
    assert!(held("[1.5, 0.1, 0]", &format!("\"inplane\"\n{axis}"))[0].contains("The distance, 0.5 m,"));
}

/// A body has an extent: within 4 radii of gyration, 0.08 m, it is held where the joint is. A hinge at the center of
/// mass puts the arm on the wire instead.
#[test]
fn bodies_and_platforms_reach_to_their_joints() {
    let ends = "a = \"bob\"\nb = \"wire.end\"";
    let turned = "a = \"wire.end\"\nb = \"bob\"";
    assert_eq!(weighted("[1.07, 0, 0]", &format!("\"spherical\"\n{ends}")), [""; 0]);
    assert_eq!(weighted("[1.07, 0, 0]", &format!("\"weld\"\n{turned}")), [""; 0]);
    assert!(weighted("[1.07, 0, 0]", &format!("\"spherical\"\n{turned}"))[0].contains("a rigid arm on wire.end"));
    assert!(weighted("[1.09, 0, 0]", &format!("\"weld\"\n{ends}"))[0].contains("The distance, 0.09 m,"));
    // A frame with joints at two places is a platform, of which neither is told.
    let one =
        "[frame.hand]\nposition = [0.7, 0, -0.1]\n[joint.end]\ntype = \"spherical\"\na = \"hand\"\nb = \"wire.end\"\n";
    let two = "[joint.middle]\ntype = \"spherical\"\na = \"wire@0.5\"\nb = \"hand\"\nat = [0.5, 0, 0]\n";
    assert_eq!(wire(one).len(), 1);
    assert_eq!(wire(&format!("{one}{two}")), [""; 0]);
}
