//! Machines that are drawn oddly but soundly must run, and what cannot run must say why: bodies at one place, a drive
//! that begins turns away, a machine at rest that is no loss of energy, a bushing turned too far, a motion that begins
//! with an infinite rate.

use crate::running::{start, vector};
use ancf14::fmi::{Model, Value};
use ancf14::math::Vec3;
use ancf14::model::simulation::Simulation;

/// Runs a file for `stop` s; its warnings, or why it failed.
fn run(text: &str, stop: f64) -> Result<Vec<String>, String> {
    let mut simulation = Simulation::load("model.toml", text, &[]).map_err(|failure| failure.message)?;
    simulation.initialize(0.0).map_err(|failure| failure.message)?;
    simulation.advance(stop).map_err(|failure| failure.message)?;
    Ok(simulation.take_warnings())
}

const HEAD: &str = "format = 1\n[model]\nname = \"Odd\"\ngravity = [0, 0, -9.81]\n";

fn body(name: &str, position: &str) -> String {
    format!("[body.{name}]\nmass = 1\nposition = {position}\ninertia = [0.1, 0.1, 0.1]\n")
}

fn hinge(name: &str, a: &str, b: &str) -> String {
    format!("[joint.{name}]\ntype = \"revolute\"\na = \"{a}\"\nb = \"{b}\"\nat = [0, 0, 0]\naxis = [0, 1, 0]\n")
}

fn weld(name: &str, a: &str, b: &str, height: f64) -> String {
    format!("[joint.{name}]\ntype = \"weld\"\na = \"{a}\"\nb = \"{b}\"\nat = [0, 0, {height}]\n")
}

/// Two bodies whose centers of mass are the same but for round-off: the machine's size is not that of the round-off.
#[test]
fn bodies_at_one_place_run() {
    let bodies = body("first", "[\"0.1 + 0.2\", 0, 0]") + &body("second", "[0.3, 0, 0]");
    let joints = hinge("inner", "ground", "first") + &hinge("outer", "ground", "second");
    let end = "[simulation]\nstop = 1\nstep = 1e-3\n";
    assert_eq!(run(&format!("{HEAD}{bodies}{joints}{end}"), 0.1), Ok(Vec::new()));
}

/// A crank that begins two turns from where it is drawn, with a pendulum on it.
#[test]
fn a_drive_that_begins_turns_away_is_assembled_there() {
    let bodies = body("crank", "[0.5, 0, 0]") + &body("bob", "[1, 0, -1]");
    let joints = hinge("pivot", "ground", "crank") + &hinge("tip", "crank", "bob").replace("[0, 0, 0]", "[1, 0, 0]");
    let rest = "[drive.motor]\njoint = \"pivot\"\ncoordinate = \"angle\"\nvalue = \"12 + t\"\n\
                [simulation]\ninitial = \"equilibrium\"\nstop = 1\nstep = 1e-3\n";
    assert_eq!(run(&format!("{HEAD}{bodies}{joints}{rest}"), 0.01), Ok(Vec::new()));
}

/// The bob of the same machine hangs straight down from the crank's tip. With a damping of the fall that grew without
/// end where the drive, not the fall, was too fast, multipliers became so large that any place passed for an
/// equilibrium.
#[test]
fn regression_what_falls_while_a_drive_turns_comes_to_rest() {
    let bodies = body("crank", "[0.5, 0, 0]") + &body("bob", "[1, 0, -1]");
    let joints = hinge("pivot", "ground", "crank") + &hinge("tip", "crank", "bob").replace("[0, 0, 0]", "[1, 0, 0]");
    let rest = "[drive.motor]\njoint = \"pivot\"\ncoordinate = \"angle\"\nvalue = \"12\"\n\
                [output.place]\nat = \"bob\"\nquantities = [\"position\"]\n\
                [simulation]\ninitial = \"equilibrium\"\nstop = 1\nstep = 1e-3\n";
    let place = vector(&start(&format!("{HEAD}{bodies}{joints}{rest}")), "place.position");
    // Newton's tolerance.
    let hanging = Vec3::new(12_f64.cos(), 0.0, -12_f64.sin() - 1.0);
    assert!((place - hanging).norm() < 1e-8, "{place} {hanging}");
}

/// At rest nothing but round-off moves: no word about lost energy.
#[test]
fn a_machine_at_rest_is_not_warned_of() {
    let text = HEAD.to_owned() + &body("bob", "[0.6, 0, -0.8]") + &hinge("pivot", "ground", "bob");
    assert_eq!(run(&(text + "[simulation]\ninitial = \"equilibrium\"\nstop = 1\nstep = 1e-3\n"), 0.1), Ok(Vec::new()));
}

/// Bodies welded to the ground, whose energy is zero but for the round-off of nothing: some 1e-32 J are no lost energy.
#[test]
fn a_machine_without_energy_is_not_warned_of() {
    let mut text = String::from(HEAD) + &body("hub", "[0, 0, 0]") + &weld("held", "ground", "hub", 0.0);
    for (number, position) in ["[1.0, 0.0, 0]", "[0.5403, 0.84147, 0]", "[-0.41615, 0.9093, 0]"].iter().enumerate() {
        let name = format!("spoke{number}");
        text += &(body(&name, position) + &weld(&format!("weld{number}"), "hub", &name, 0.1));
    }
    assert_eq!(run(&(text + "[simulation]\nstop = 1\nstep = 1e-3\n"), 0.01), Ok(Vec::new()));
}

/// What a host gives a drive is reached at the end of its step: from rest with constant acceleration, from the velocity
/// that the host says to the same mean. A rate is integrated.
#[test]
fn a_host_s_drive_is_reached_at_the_end_of_a_step() {
    for (input, value, slope, rate, angle) in
        [("value", 0.2, 0.0, 4.0, 0.2), ("value", 0.0, 2.0, 2.0, 0.2), ("rate", 3.0, 0.0, 3.0, 0.15)]
    {
        let drive = format!("[drive.motor]\njoint = \"pivot\"\ncoordinate = \"angle\"\ninput = \"{input}\"\n");
        let output = "[output.it]\nat = \"bob\"\nquantities = [\"angular_velocity\"]\n[output.at]\nat = \"motor\"\nquantities = [\"angle\"]\n";
        let text = HEAD.to_owned() + &body("bob", "[0, 0, -1]") + &hinge("pivot", "ground", "bob") + &drive + output;
        let text = text + "[simulation]\nstop = 1\nstep = 1e-2\n";
        let mut simulation = Simulation::load("model.toml", &text, &[]).unwrap();
        simulation.initialize(0.0).unwrap();
        let place = |simulation: &Simulation, name: &str| {
            simulation.variables().iter().position(|variable| variable.name == name).unwrap()
        };
        let given = place(&simulation, &format!("motor.{input}"));
        simulation.set_value(given, Value::Real(value)).unwrap();
        simulation.set_input_derivative(given, slope);
        simulation.advance(0.1).unwrap();
        let read = |name: &str| simulation.value(place(&simulation, name)).number();
        assert!((read("it.angular_velocity[2]") - rate).abs() < 1e-9, "{input}: {}", read("it.angular_velocity[2]"));
        assert!((read("at.angle") - angle).abs() < 1e-12, "{input}: {}", read("at.angle"));
    }
}

#[test]
fn regression_a_spectral_radius_is_warned_of_beyond_its_limit_only() {
    let text = String::from(HEAD) + &body("hub", "[0, 0, 0]") + &weld("held", "ground", "hub", 0.0);
    let with = |radius: &str| {
        let keys = format!("integrator = \"generalized_alpha\"\nspectral_radius = {radius}\n");
        run(&(text.clone() + "[simulation]\nstop = 1\nstep = 1e-3\n" + &keys), 0.01).unwrap()
    };
    assert_eq!(with("0.99"), Vec::<String>::new());
    let why = "does not damp the forces of joints, which grow without end: take at most 0.99";
    assert_eq!(with("0.995"), [format!("spectral_radius = 0.995 {why}")]);
}

#[test]
fn a_static_analysis_is_silent_about_dampers() {
    let text = HEAD.to_owned() + &body("bob", "[0, 0, -1]") + &hinge("pivot", "ground", "bob") + "damping = 2.0\n";
    let warnings = run(&(text + "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n"), 1.0).unwrap();
    assert_eq!(warnings, Vec::<String>::new());
}

#[test]
fn a_bushing_turned_too_far_is_named() {
    let joint = "[joint.pad]\ntype = \"bushing\"\na = \"ground\"\nb = \"bob\"\nstiffness = [1e4, 1e4, 1e4]\nrotational_stiffness = [1e-3, 1e-3, 1e-3]\n";
    let text = HEAD.replace("-9.81", "0") + &body("bob", "[0, 0, 0]") + "angular_velocity = [0, 0, 5]\n" + joint;
    let message = run(&(text + "[simulation]\nstop = 1\nstep = 1e-3\n"), 1.0).unwrap_err();
    assert!(message.contains("bushing pad is turned by 170 degrees"), "{message}");
}

#[test]
fn a_motion_without_a_rate_is_named() {
    let frame = "[frame.table]\nposition = [\"sqrt(t)\", 0, 0]\n";
    let joint = "[joint.grip]\ntype = \"weld\"\na = \"table\"\nb = \"bob\"\n";
    let text = HEAD.to_owned() + &body("bob", "[0, 0, 0]") + frame + joint + "[simulation]\nstop = 1\nstep = 1e-3\n";
    let message = run(&text, 0.1).unwrap_err();
    assert!(message.contains("the motion of frame table is not a finite number at t = 0 s"), "{message}");
}

/// A branch that a body holds, and once more by a condition: where nothing has a mass, pivots sought among few rows do
/// not show it.
#[test]
fn what_is_held_twice_at_rest_is_refused() {
    let beam = |name: &str, from: &str, to: &str| {
        format!("[beam.{name}]\nmaterial = \"steel\"\nsection = \"bar\"\nfrom = {from}\nto = {to}\nelements = 8\n")
    };
    let joint = |name: &str, kind: &str, a: &str, b: &str| {
        format!("[joint.{name}]\ntype = \"{kind}\"\na = \"{a}\"\nb = \"{b}\"\n")
    };
    let parts = "[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n[section.bar]\nshape = \"rectangle\"\nwidth = 0.3\nheight = 0.25\n";
    let beams = beam("arm", "[0, 0, 0]", "[1, 0.2, 0.1]") + &beam("branch", "[1, 0.2, 0.1]", "[0.4, 0.9, 0.35]");
    let welds = joint("root", "weld", "ground", "arm.start")
        + &joint("tie", "weld", "arm.end", "knot")
        + &joint("grip", "weld", "knot", "branch.start");
    let load = "[load.tip]\nat = \"branch.end\"\nforce = [3, 4, \"-20*t\"]\n";
    let end = "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.25\noutput_step = 0.25\n";
    let machine = [HEAD, parts, &beams, &body("knot", "[1, 0.2, 0.1]"), &welds, load, end].concat();
    assert_eq!(run(&machine, 1.0), Ok(Vec::new()));
    let twice = joint("twice", "inplane", "knot", "branch.start") + "axis = [0.1, 0.2, 1]\n";
    let message = run(&(machine + &twice), 1.0).unwrap_err();
    assert!(message.contains("is redundant: other joints already impose its constraints"), "{message}");
}

/// A beam that nothing holds falls away under any weight: that no iteration finds where it comes to rest is not what
/// its user has to hear.
#[test]
fn a_beam_that_nothing_holds_is_free() {
    // Oblique: with round numbers round-off would show at once that it is free.
    for end in ["[-0.802, -0.275, 0.536]", "[0.8, -0.2, 0.5]"] {
        let beam = format!(
            "[material.soft]\nyoung = 1e7\npoisson = 0.3\ndensity = 1000\n[section.rod]\nshape = \"circle\"\nradius = 6e-3\n\
             [beam.noodle]\nmaterial = \"soft\"\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = {end}\nelements = 5\n\
             y_axis = [0.123, 0.456, 0.789]\n[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.25\n"
        );
        let message = run(&format!("{HEAD}{beam}"), 0.25).unwrap_err();
        assert!(message.contains("noodle.") && message.contains("can move freely"), "{message}");
    }
}

/// A heavy body on a universal joint at the end of a soft strip is free as drawn, but meant to hang. Where its fall
/// goes too far for the elements, both are told: neither alone says what to do.
#[test]
fn what_is_free_as_drawn_and_finds_no_rest_is_told_of_both() {
    let text = "[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
                [section.strip]\nshape = \"rectangle\"\nwidth = 0.02\nheight = 0.002\n\
                [beam.arm]\nmaterial = \"steel\"\nsection = \"strip\"\nfrom = [0, 0, 0]\nto = [-0.39, -0.233, 0.777]\n\
                y_axis = [0.123, 0.456, 0.789]\nelements = 2\n\
                [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
                [body.bob]\nmass = 2000\nposition = [0.0645, -0.3815, 0.8805]\ninertia = [20, 20, 20]\n\
                [joint.cross]\ntype = \"universal\"\na = \"arm.end\"\nb = \"bob\"\nat = [-0.39, -0.233, 0.777]\n\
                axis = [-0.952, -0.012, -0.255]\naxis2 = [\"-0.012\", \"0.952\", 0]\n\
                [simulation]\nanalysis = \"static\"\nstop = 0.25\nstep = 0.25\n";
    let message = run(&format!("{HEAD}{text}"), 0.25).unwrap_err();
    assert!(message.contains("bob (turning) can move freely") && message.contains("it comes to no rest"), "{message}");
}
