//! A free motion that takes no load, as the spin of a cable between two ball joints, must not keep an equilibrium from
//! being found: the solver holds it and says so. Universal joints, which leave a cable no spin, or a closed form give
//! the values. A load along such a motion must stay an error that names it. A wrong code refuses the mechanism, holds
//! what a load would move, or holds a motion that has a stiffness.

use crate::running::{run, start, try_start, value, vector};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14::solve::modes::Kind;
use std::f64::consts::PI;

const HEAD: &str = "format = 1\n[model]\nname = \"Free\"\ngravity = [0, 0, -9.81]\n\
    [material.soft]\nyoung = 4e6\npoisson = 0.3\ndensity = 1000\n[section.round]\nshape = \"circle\"\nradius = 0.005\n";
/// The solver leaves corrections below 1e-8 of the size of the mechanism, 1 m.
const TOLERANCE: f64 = 1e-7;

fn cable(name: &str, from: [f64; 3], to: [f64; 3], elements: usize) -> String {
    format!(
        "[beam.{name}]\nmaterial = \"soft\"\nsection = \"round\"\nfrom = {from:?}\nto = {to:?}\nelements = {elements}\nstrain = \"small\"\n"
    )
}

fn joint(name: &str, kind: &str, a: &str, b: &str) -> String {
    let axes = match kind {
        "universal" => "axis = [0, 1, 0]\naxis2 = [0, 0, 1]\n",
        "prismatic" => "axis = [1, 0, 0]\n",
        _ => "",
    };
    format!("[joint.{name}]\ntype = \"{kind}\"\na = \"{a}\"\nb = \"{b}\"\n{axes}")
}

fn end(place: &str, simulation: &str) -> String {
    format!("[output.seen]\nat = \"{place}\"\nquantities = [\"position\"]\n[simulation]\n{simulation}\n")
}

const STATIC: &str = "analysis = \"static\"\nstop = 1\nstep = 0.25\noutput_step = 0.25";

fn is_held(told: &str) -> bool {
    told.contains("takes no load") || told.contains("take no load")
}

/// A rope that is drawn tight over a post and is straight when free of stress can roll about itself, which no result
/// shows: nobody is told of it. One that bends less easily in one plane has no such motion.
#[test]
fn ropes_roll_about_themselves_without_a_word() {
    let told = |stiffness: f64| {
        let text = format!(
            "format = 1\n[model]\nname = \"Roll\"\ngravity = [0, 0, 0]\n[section.s]\nshape = \"rigidities\"\nEA = 1e5\n\
             EI_y = 1e-4\nEI_z = {stiffness}\nGJ = 1e-4\nline_density = 0.1\n\
             [surface.post]\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.1\n\
             [beam.rope]\nsection = \"s\"\nelements = 16\n\
             curve = {{ from = [0.1, 0, -0.15], over = [\"post\"], turns = [-1], to = [-0.1, 0, -0.15] }}\n\
             [contact.wrap]\nof = \"rope\"\nwith = \"post\"\nradius = 0\nstiffness = 1e7\nfriction = 0.3\n\
             [load.hand]\nat = \"rope.start\"\nforce = [0, 0, -100]\n{}[simulation]\ninitial = \"equilibrium\"\n{STATIC}\n",
            joint("grip", "spherical", "ground", "rope.end")
        );
        start(&text).take_warnings().concat()
    };
    assert_eq!([1e-4, 1e-1].map(told), ["", ""]);
    // A straight bar of another section turns as a shaft does: that is told.
    let bar = "format = 1\n[model]\nname = \"Bar\"\ngravity = [0, 0, 0]\n[section.s]\nshape = \"rigidities\"\nEA = 1e5\n\
               EI_y = 1\nEI_z = 2\nGJ = 1\nline_density = 1\n[beam.bar]\nsection = \"s\"\nelements = 4\n\
               from = [0, 0, 0]\nto = [1, 0, 0]\nfree_curvature = [0, 0]\n[simulation]\ninitial = \"equilibrium\"\n";
    let held = joint("a", "spherical", "ground", "bar.start") + &joint("b", "spherical", "ground", "bar.end");
    assert!(is_held(&start(&format!("{bar}{STATIC}\n{held}")).take_warnings().concat()));
}

/// The ends of a cable of 1 m come 0.4 m nearer to each other while it hangs: its sag with ball joints is that with
/// universal joints.
#[test]
fn a_cable_between_ball_joints_hangs_as_between_universal_joints() {
    let carriage = |name: &str, x: f64, way: &str| {
        format!("[body.{name}]\nmass = 0.1\nposition = [{x}, 0, 0]\ninertia = [1e-4, 1e-4, 1e-4]\n")
            + &joint(&format!("{name}_rail"), "prismatic", "ground", name)
            + &format!(
                "[drive.{name}_drive]\njoint = \"{name}_rail\"\ncoordinate = \"distance\"\nvalue = \"{way}*t\"\n"
            )
    };
    let hang = |kind: &str| {
        let text = HEAD.to_owned()
            + &cable("rope", [0.0; 3], [1.0, 0.0, 0.0], 16)
            + &carriage("left", 0.0, "0.2")
            + &carriage("right", 1.0, "-0.2")
            + &joint("first", kind, "left", "rope.start")
            + &joint("last", kind, "right", "rope.end")
            + &end("rope@0.5", STATIC);
        let mut simulation = start(&text);
        let told = simulation.take_warnings().concat();
        assert_eq!(is_held(&told) && told.contains("turning about the beam"), kind == "spherical", "{told}");
        run(&mut simulation, 0.25, 1.0, |_| ());
        let later = simulation.take_warnings().concat();
        assert!(!is_held(&later), "{later}");
        vector(&simulation, "seen.position")
    };
    let [ball, universal] = ["spherical", "universal"].map(hang);
    println!("{ball} {universal}");
    assert!((ball - universal).norm() < TOLERANCE, "{ball} {universal}");
    // A chain of this length and span sags by 0.36278 m; the bending stiffness of the cable takes 1.7 % of that.
    assert!(ball[2] < -0.355 && ball[2] > -0.36278, "{ball}");
}

/// Two cables in series spin independently of each other, and hang slack between ball joints: two motions are held.
#[test]
fn every_cable_of_a_series_may_spin() {
    let text = |kind: &str, simulation: &str| {
        HEAD.to_owned()
            + &cable("left", [0.0; 3], [0.5, 0.0, 0.0], 8)
            + &cable("right", [0.5, 0.0, 0.0], [1.0, 0.0, 0.0], 8)
            + &joint("first", kind, "ground", "left.start")
            + &joint("middle", kind, "left.end", "right.start")
            + &joint("last", kind, "ground", "right.end")
            + &end("left.end", simulation)
    };
    let mut ball = start(&text("spherical", STATIC));
    let told = ball.take_warnings().concat();
    let both = ["left.", "right."].into_iter().all(|beam| told.contains(beam));
    assert!(is_held(&told) && both && told.matches("turning about the beam").count() == 2, "{told}");
    let [ball, universal] = [ball, start(&text("universal", STATIC))].map(|own| vector(&own, "seen.position"));
    assert!((ball - universal).norm() < TOLERANCE, "{ball} {universal}");

    // About the equilibrium of a motion the two spins are modes without stiffness, and the only ones.
    let equilibrium = "initial = \"equilibrium\"\nstop = 1";
    let found = start(&text("spherical", equilibrium)).modes(4).unwrap_or_else(|failure| panic!("{}", failure.message));
    let kinds: Vec<Kind> = found.modes.iter().map(|mode| mode.kind).collect();
    assert_eq!(kinds, [Kind::Free, Kind::Free, Kind::Vibration, Kind::Vibration]);
    let held = start(&text("universal", equilibrium)).modes(2).unwrap_or_else(|failure| panic!("{}", failure.message));
    for (free, held) in found.modes[2..].iter().zip(&held.modes) {
        // What equilibria leave is round-off of the frequencies.
        assert!((free.eigenvalue / held.eigenvalue - 1.0).abs() < 1e-5, "{} {}", free.eigenvalue, held.eigenvalue);
    }
}

/// A column with a taut cable beside it hangs on one ball joint, without weight: three free rotations, and a shortening
/// `u` with `k (d - u) = EA/L u`.
#[test]
fn a_free_part_under_its_own_stress_shortens_by_the_closed_form() {
    let text = "format = 1\n[model]\nname = \"Column\"\n\
        [material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
        [section.pipe]\nshape = \"tube\"\ninner = 0.09\nouter = 0.1\n\
        [beam.column]\nmaterial = \"steel\"\nsection = \"pipe\"\nfrom = [0, 0, 0]\nto = [0, 0, -10]\ny_axis = [0, 1, 0]\n\
        elements = 6\nstrain = \"small\"\n\
        [spring.cable]\na = \"column.start\"\nb = \"column.end\"\nstiffness = 1e6\nlength = 9.9\n\
        [joint.top]\ntype = \"spherical\"\na = \"ground\"\nb = \"column.start\"\n\
        [output.seen]\nat = \"column.end\"\nquantities = [\"displacement\"]\n\
        [simulation]\ninitial = \"equilibrium\"\nstop = 1\n";
    let mut simulation = start(text);
    let told = simulation.take_warnings().concat();
    assert!(is_held(&told) && told.contains("turning about the beam"), "{told}");
    let stiffness = 2.1e11 * PI * (0.1 * 0.1 - 0.09 * 0.09) / 10.0;
    let shortening = 1e6 * 0.1 / (1e6 + stiffness);
    let end = vector(&simulation, "seen.displacement");
    println!("{end} {shortening}");
    // The strain of this law is that of Green, off by half of itself, 4e-5.
    assert!((end[2] / shortening - 1.0).abs() < 1e-4, "{end} {shortening}");
    assert!(f64::hypot(end[0], end[1]) < 1e-7, "{end}");
}

/// An arc between two ball joints turns freely about its chord, and a pull along the chord does not stir it: in
/// whichever plane it is drawn it gives way alike.
#[test]
fn an_arc_gives_way_alike_in_every_plane() {
    let ways = [0.0, 0.7, 2.0].map(|angle: f64| {
        let (sine, cosine) = angle.sin_cos();
        let text = HEAD.replace("-9.81", "0")
            + &format!(
                "[beam.arc]\nmaterial = \"soft\"\nsection = \"round\"\nelements = 8\ny_axis = [0, {}, {cosine}]\n\
                 curve = {{ x = \"-cos(s)\", y = \"{cosine}*sin(s)\", z = \"{sine}*sin(s)\", s = [0, \"pi\"] }}\n",
                -sine
            )
            + "[body.slider]\nmass = 1\nposition = [1, 0, 0]\ninertia = [1, 1, 1]\n"
            + &joint("rail", "prismatic", "ground", "slider")
            + &joint("first", "spherical", "ground", "arc.start")
            + &joint("last", "spherical", "slider", "arc.end")
            + "[load.pull]\nat = \"slider\"\nforce = [\"1e-4*t\", 0, 0]\n"
            + &end("slider", STATIC);
        let mut simulation = start(&text);
        run(&mut simulation, 0.25, 1.0, |_| ());
        let told = simulation.take_warnings().concat();
        assert!(is_held(&told), "{told}");
        vector(&simulation, "seen.position")[0] - 1.0
    });
    println!("{ways:?}");
    // By Castigliano: P R^3/(2 EI) for small loads; here the load is half of EI/R^2/2.
    let rigidity = 4e6 * PI * 0.005_f64.powi(4) / 4.0;
    let linear = 1e-4 * PI / 2.0 / rigidity;
    assert!((ways[0] / linear - 1.0).abs() < 0.1, "{ways:?} {linear}");
    assert!(ways.iter().all(|way| (way - ways[0]).abs() < 1e-6), "{ways:?}");
}

/// A moment about the axis of the spin has no equilibrium, whether it acts at once or sets in later: the error names
/// the motion. A moment across it only bends.
#[test]
fn a_moment_about_a_free_axis_is_an_error() {
    let text = |moment: &str| {
        HEAD.to_owned()
            + &cable("rope", [0.0; 3], [1.0, 0.0, 0.0], 8)
            + &joint("first", "spherical", "ground", "rope.start")
            + &joint("last", "spherical", "ground", "rope.end")
            + &format!("[load.twist]\nat = \"rope.end\"\nmoment = {moment}\n")
            + &end("rope@0.5", STATIC)
    };
    let names = |message: &str| message.contains("turning about the beam") && message.contains("can move freely");
    let at_once = try_start(&text("[1e-3, 0, 0]")).unwrap_err();
    assert!(names(&at_once), "{at_once}");
    let mut simulation = start(&text("[\"1e-3*t\", 0, 0]"));
    let later = simulation.advance(0.25).unwrap_err().message;
    assert!(names(&later), "{later}");
    let mut across = start(&text("[0, \"1e-3*t\", 0]"));
    run(&mut across, 0.25, 1.0, |_| ());
}

/// A body that hangs in its center of mass turns freely, and its thrust with it: the error names one motion, not
/// hundreds.
#[test]
fn a_thrust_that_turns_freely_is_an_error() {
    let text = HEAD.to_owned()
        + &cable("rope", [0.0; 3], [0.0, 0.0, 20.0], 8)
        + "[body.drone]\nmass = 4\nposition = [0, 0, 20]\ninertia = [0.05, 0.05, 0.08]\n"
        + &joint("foot", "universal", "ground", "rope.start")
        + &joint("hook", "universal", "rope.end", "drone")
        + "[load.thrust]\nat = \"drone\"\nforce = [0, 0, 500]\nfollower = true\n"
        + &end("drone", STATIC);
    let failure = try_start(&text).unwrap_err();
    assert!(failure.contains("can move freely, and forces turn with it") && !failure.contains("others"), "{failure}");
}

/// A state that is saved and restored goes on with the same bits: what is held belongs to it.
#[test]
fn held_motions_are_saved_and_restored() {
    let text = HEAD.to_owned()
        + &cable("rope", [0.0; 3], [1.0, 0.0, 0.0], 8)
        + &joint("first", "spherical", "ground", "rope.start")
        + &joint("last", "spherical", "ground", "rope.end")
        + "[load.push]\nat = \"rope@0.5\"\nforce = [0, \"0.05*t\", 0]\n"
        + &end("rope@0.5", STATIC);
    let finish = |simulation: &mut Simulation| {
        for time in [0.5, 0.75, 1.0] {
            simulation.advance(time).unwrap_or_else(|failure| panic!("{}", failure.message));
        }
        (1..=3).map(|axis| value(simulation, &format!("seen.position[{axis}]")).to_bits()).collect::<Vec<_>>()
    };
    let mut first = start(&text);
    first.advance(0.25).unwrap_or_else(|failure| panic!("{}", failure.message));
    let saved = first.snapshot();
    let direct = finish(&mut first);
    let mut second = start(&text);
    second.restore(&saved);
    assert_eq!(finish(&mut second), direct);
}
