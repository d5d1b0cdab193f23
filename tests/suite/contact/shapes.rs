//! Rings, boxes and cones against closed forms and by their energy.

use crate::running::{run, start, value, vector};
use ancf14::math::Vec3;
use ancf14_testing::capstan;
use std::f64::consts::PI;

/// A rope through a ring whose wire is its post: as thin as it is, it slides at `e^(μ φ)`, also where the ring curves
/// away from the plane of the rope. Half a percent, as on a post.
#[test]
fn ropes_through_rings() {
    for angle in [PI / 2.0, PI] {
        // The middle of the wire runs along y through the origin, which is the middle of the post.
        let ring = "shape = \"ring\"\naxis = [0, 0, 1]\nradius = 0.4\nwire = 0.1\noffset = [0.4, 0, 0]";
        let text = capstan::model(angle, 0.0).replace("shape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.1", ring);
        assert!(text.contains("ring"));
        let mut simulation = start(&text);
        run(&mut simulation, 0.02, 1.0, |_| {});
        let (ratio, exact) = (vector(&simulation, "high.reaction_force").norm() / 100.0, (0.3 * angle).exp());
        let [sliding, wrapped] = ["sliding", "wrap_angle"].map(|name| value(&simulation, &format!("wrapped.{name}")));
        assert_eq!(sliding, 1.0);
        assert!((wrapped / angle - 1.0).abs() < 0.05, "{wrapped} of {angle}");
        assert!((ratio / exact - 1.0).abs() < 5e-3, "{angle}: {ratio} {exact}");
    }
}

/// A stiff bar on a guide along z that a force presses on `surface`, with the outputs of the contact.
fn pressed(ends: [[f64; 3]; 2], surface: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Pressed\"\ngravity = [0, 0, 0]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e7\nEI_y = 1e4\nEI_z = 1e4\nGJ = 1e4\nline_density = 1\n\
         [beam.bar]\nsection = \"s\"\nfrom = {:?}\nto = {:?}\nelements = 8\n\
         [joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"bar@0.5\"\naxis = [0, 0, 1]\n\
         [surface.own]\n{surface}\n\
         [contact.press]\nof = \"bar\"\nwith = \"own\"\nstiffness = 1e6\nradius = 0.02\n\
         [load.push]\nat = \"bar@0.5\"\nforce = [0, 0, -30]\n\
         [output.guided]\nat = \"guide\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
         [output.middle]\nat = \"bar@0.5\"\nquantities = [\"position\"]\n\
         [output.load]\nat = \"press\"\nquantities = [\"reaction_force\", \"normal_force\", \"penetration\", \
         \"contact_length\", \"energy\"]\n\
         [simulation]\nanalysis = \"static\"\ninitial = \"equilibrium\"\nstop = 1\n",
        ends[0], ends[1]
    )
}

/// A bar along the side of a cone, which leans by `α`: the cone presses across its side, so that the guide bears the
/// part `tan α` of the load. The force per length is that of a penetration that is the same everywhere, the stiffness
/// of the bar aside: a thousandth.
#[test]
fn a_bar_along_a_cone() {
    let (slope, radius) = (0.25, 0.02);
    let lean = f64::atan(slope);
    // The side falls from 0.3 m at x = -0.4 to 0.1 m at x = 0.4; the bar is 0.3 m long, its axis one radius above it.
    let [along, out] = [[lean.cos(), -lean.sin()], [lean.sin(), lean.cos()]];
    let ends = [-0.15, 0.15].map(|s: f64| [s * along[0] + radius * out[0], 0.0, 0.2 + s * along[1] + radius * out[1]]);
    let cone = "shape = \"cone\"\naxis = [1, 0, 0]\nradius = 0.3\nend_radius = 0.1\nlength = 0.8";
    let simulation = start(&pressed(ends, cone).replace("= 1e4", "= 1e5"));
    let force = vector(&simulation, "load.reaction_force");
    assert!((force - Vec3::new(30.0 * lean.tan(), 0.0, 30.0)).norm() < 1e-6, "{force:?}");
    let guided = vector(&simulation, "guided.reaction_force");
    assert!((guided + Vec3::new(30.0 * lean.tan(), 0.0, 0.0)).norm() < 1e-6, "{guided:?}");
    let names = ["normal_force", "contact_length", "penetration"];
    let [normal, length, depth] = names.map(|name| value(&simulation, &format!("load.{name}")));
    assert!((normal * lean.cos() / 30.0 - 1.0).abs() < 1e-6 && (length / 0.3 - 1.0).abs() < 1e-9, "{normal} {length}");
    assert!((depth / (normal / (1e6 * 0.3)) - 1.0).abs() < 1e-3, "{depth:e}");
}

/// A bar of radius `r` across an edge of a box that stands on it, faces at 45 degrees, and across the tip of a cone.
/// Its axis is at a height `d` above it: a point of the axis `y` beside it is inside by `r - √(y² + d²)`, and is pressed up
/// by `d/√(y² + d²)` of its force. Both ends of the integral are at `a = √(r² - d²)`.
#[test]
fn a_bar_across_an_edge_and_a_tip() {
    let edge = "shape = \"box\"\nsize = [0.4, 0.4, 0.4]\n\
                edges = [[0, 1, 0], [\"sqrt(0.5)\", 0, \"sqrt(0.5)\"], [\"sqrt(0.5)\", 0, \"-sqrt(0.5)\"]]\n\
                offset = [0, 0, \"-0.2*sqrt(2)\"]";
    let tip = "shape = \"cone\"\naxis = [0, 0, 1]\nradius = 0.1\nend_radius = 0\nlength = 0.4\noffset = [0, 0, -0.2]";
    for (name, surface) in [("edge", edge), ("tip", tip)] {
        // Off the nodes of the mesh, which are 50 mm apart.
        let simulation = start(&pressed([[-0.187, 0.0, 0.0199], [0.213, 0.0, 0.0199]], surface));
        let force = vector(&simulation, "load.reaction_force");
        let height = value(&simulation, "middle.position[3]");
        assert!((force - Vec3::new(0.0, 0.0, 30.0)).norm() < 1e-4, "{name}: {force:?}");
        let half = (0.02 * 0.02 - height * height).sqrt();
        let exact = 2.0 * 1e6 * height * (0.02 * (half / height).asinh() - half);
        assert!((exact / 30.0 - 1.0).abs() < 1e-3, "{name}: {exact}");
    }
}

/// A bar that falls on the corner of a box, on the rim and on the tip of a cone, and on a ring: its energy stays to a
/// thousandth of what it has when it hits. Pieces that do not end at edges lose 7 thousandths on the corner and 18 on
/// the rim.
#[test]
fn falling_bars_keep_their_energy() {
    let corner = "shape = \"box\"\nsize = [0.3, 0.3, 0.3]\noffset = [-0.13, -0.15, -0.19]";
    let rim = "shape = \"cone\"\naxis = [0, 0, 1]\nradius = 0.3\nend_radius = 0.2\nlength = 0.2\n\
               offset = [-0.1, -0.05, -0.14]";
    let tip =
        "shape = \"cone\"\naxis = [0, 0.1, 1]\nradius = 0.2\nend_radius = 0\nlength = 0.4\noffset = [0.05, 0, -0.24]";
    let ring = "shape = \"ring\"\naxis = [0, 0.2, 1]\nradius = 0.2\nwire = 0.01\noffset = [0.05, 0.02, -0.05]";
    for (name, surface) in [("corner", corner), ("rim", rim), ("tip", tip), ("ring", ring)] {
        for stiffness in [1e5, 1e6] {
            let text = format!(
                "format = 1\n[model]\nname = \"Falling\"\ngravity = [0, 0, -9.81]\n\
                 [section.s]\nshape = \"rigidities\"\nEA = 2e5\nEI_y = 2\nEI_z = 2\nGJ = 2\nline_density = 0.5\n\
                 [beam.bar]\nsection = \"s\"\nfrom = [-0.5, -0.04, 0.02]\nto = [0.5, 0.03, 0.05]\nelements = 8\n\
                 velocity = [0.1, 0.05, -1]\n\
                 [surface.own]\n{surface}\n\
                 [contact.hit]\nof = \"bar\"\nwith = \"own\"\nstiffness = {stiffness}\nradius = 0.02\n\
                 [output.load]\nat = \"hit\"\nquantities = [\"normal_force\"]\n\
                 [simulation]\nstop = 0.4\nstep = 5e-4\nspectral_radius = 1\ntotals = [\"energy\", \"work\"]\n"
            );
            let mut simulation = start(&text);
            let (mut largest, mut drift) = (0.0_f64, 0.0_f64);
            let mut energy = 0.0_f64;
            run(&mut simulation, 0.002, 0.4, |own| {
                largest = largest.max(value(own, "load.normal_force"));
                energy = energy.max(value(own, "energy.kinetic"));
                drift = drift.max(value(own, "work.drift").abs());
            });
            println!("{name} {stiffness:e}: {largest} N, drift {:e}", drift / energy);
            assert!(largest > 10.0, "{name} {stiffness:e}: {largest}");
            assert!(drift < 1e-3 * energy, "{name} {stiffness:e}: {drift:e} of {energy}");
        }
    }
}
