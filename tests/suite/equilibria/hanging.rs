//! What hangs has no stiffness before it pulls: a rope drawn slack, a pendulum drawn aside, a load on a hook. The
//! equilibrium must be found all the same, by letting the machine fall, and a motion that stays free must be named. A
//! plain Newton iteration calls all of these singular.

use crate::curves::Curves;
use crate::running::vector;
use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::model::simulation::Simulation;

const CRANE: &str = include_str!("../../../models/crane.toml");

/// A load on a chain of `links` bodies, drawn at an angle to the vertical.
fn chain(joint: &str, links: usize, aside: f64) -> String {
    let mut text = String::from(
        "format = 1\n[model]\nname = \"Chain\"\ngravity = [0, 0, -9.81]\n[simulation]\ninitial = \"equilibrium\"\nstop = 1.0\nstep = 1e-3\n",
    );
    let (along, down) = aside.sin_cos();
    for link in 0..links {
        let place = |end: f64| (along * (link as f64 + end), -down * (link as f64 + end));
        let ((x, z), (hook_x, hook_z)) = (place(0.5), place(0.0));
        let above = if link == 0 { "ground".to_owned() } else { format!("link{}", link - 1) };
        text += &format!(
            "[body.link{link}]\nmass = 2.0\nposition = [{x}, 0, {z}]\ninertia = [0.2, 0.2, 0.1]\n\
             [joint.pin{link}]\ntype = \"{joint}\"\na = \"{above}\"\nb = \"link{link}\"\nat = [{hook_x}, 0, {hook_z}]\n"
        );
        if joint != "spherical" {
            text += "axis = [0, 1, 0]\n";
        }
        text += &format!("[output.at{link}]\nat = \"link{link}\"\nquantities = [\"position\", \"velocity\"]\n");
    }
    text + "[output.top]\nat = \"pin0\"\nquantities = [\"reaction_force\"]\n"
}

/// Drawn a third of a turn aside, or a little beside its upper dead point, it comes to hang, and stays.
#[test]
fn a_chain_of_bodies_falls_to_where_it_hangs() {
    for (links, aside) in [(1, 1.2), (1, 3.0), (3, 0.7), (6, 1.5)] {
        let curves = Curves::run(&chain("revolute", links, aside), &[("simulation.stop", "0.1")]);
        for link in 0..links {
            let place = |axis: usize, row: usize| curves.column(&format!("at{link}.position[{axis}]"))[row];
            for row in [0, curves.time.len() - 1] {
                assert!(place(1, row).abs() < 1e-9, "{links} {aside}: {}", place(1, row));
                assert!((place(3, row) + link as f64 + 0.5).abs() < 1e-9);
            }
        }
        let weight = 2.0 * 9.81 * links as f64;
        let pull = curves.column("top.reaction_force[3]");
        println!("{links} links: {} {} N, weight {weight} N", pull[0], pull[1]);
        assert!((pull[0] - weight).abs() < 1e-8 * weight);
    }
}

/// A bar on a hinge, drawn level: Newton's iteration may well come to rest with the bar upright, which nothing holds.
/// Whatever its stiffness and its elements, it must hang.
#[test]
fn a_hinged_bar_hangs_down() {
    for (radius, elements, strain) in
        [("0.01", "4", "small"), ("0.005", "8", "large"), ("0.002", "16", "small"), ("0.02", "2", "large_truncated")]
    {
        let text = format!(
            "format = 1\n[model]\nname = \"Bar\"\ngravity = [0, 0, -9.81]\n\
             [material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
             [section.rod]\nshape = \"circle\"\nradius = {radius}\n\
             [beam.bar]\nmaterial = \"steel\"\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = {elements}\n\
             strain = \"{strain}\"\n[joint.hinge]\ntype = \"revolute\"\na = \"ground\"\nb = \"bar.start\"\naxis = [0, 1, 0]\n\
             [output.tip]\nat = \"bar.end\"\nquantities = [\"position\"]\n\
             [simulation]\ninitial = \"equilibrium\"\nstop = 0.01\nstep = 1e-3\noutput_step = 1e-2\n"
        );
        let curves = Curves::run(&text, &[]);
        let (x, z) = (curves.last("tip.position[1]"), curves.last("tip.position[3]"));
        println!("{radius} {elements} {strain}: tip at {x:.1e}, {z}");
        // Longer by its own weight, rho g L^2/(2 E), at most 2e-7.
        assert!(x.abs() < 1e-9 && (z + 1.0).abs() < 3e-7, "{x} {z}");
    }
}

/// By ball joints each link can spin about the vertical without end: no place of rest is better than another. The links
/// hang all the same, and are told to be held.
#[test]
fn a_motion_that_stays_free_is_named() {
    let mut simulation = Simulation::load("model.toml", &chain("spherical", 2, 0.5), &[]).unwrap();
    simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let told = simulation.take_warnings().concat();
    let names = ["free motions take no load", "link0 (turning)", "link1 (turning)"];
    assert!(names.into_iter().all(|name| told.contains(name)), "{told}");
    for (place, expected) in [("at0.position", -0.5), ("at1.position", -1.5)] {
        let place = vector(&simulation, place);
        // The tolerance of the solver.
        assert!((place - Vec3::z() * expected).norm() < 1e-8, "{place}");
    }
}

/// The load of the crane hangs from the bent boom; nothing moves before the host does.
#[test]
fn the_crane_begins_at_rest() {
    let curves = Curves::run(CRANE, &[("simulation.stop", "0.5")]);
    let pull = curves.column("rope_pull.section_force[1]")[0];
    // Half the rope hangs below its middle.
    let weight = 9.81 * (500.0 + 1.5 * 5000.0 * std::f64::consts::PI * 0.006 * 0.006);
    println!("pull {pull} N, weight below {weight} N");
    assert!((pull / weight - 1.0).abs() < 1e-6);
    for axis in 1..=3 {
        let own = curves.column(&format!("load_motion.position[{axis}]"));
        let drift = curves.difference(&own, &vec![own[0]; own.len()], 0.5);
        assert!(drift < 1e-9, "{drift}");
    }
}
