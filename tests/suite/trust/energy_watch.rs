//! Energy that loads, drives and dampers do not account for is told, whatever acts on the machine and however far apart
//! the rows of the results are; a machine whose step resolves its motion is not warned of. A watch that looks at the
//! total energy alone sees nothing as soon as a load acts.

use crate::integrators::line;
use crate::running::{start, value};
use ancf14::fmi::Model;

/// A free steel strip that spins about its axis and tumbles, under a force of 1 nN: strains taken in the middle of a
/// step, instead of the mean of both ends', pump energy into it from `spin * step * elements = 0.24` on.
fn strip(step: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Strip\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
         [section.flat]\nshape = \"rectangle\"\nwidth = 0.02\nheight = 0.004\n\
         [beam.b]\nmaterial = \"steel\"\nsection = \"flat\"\nfrom = [0, 0, 0]\nto = [0.8, 0, 0]\nelements = 8\n\
         angular_velocity = [100, 0, 3]\n\
         [load.breath]\nat = \"b.end\"\nforce = [1e-9, 0, 0]\n[simulation]\nstop = 1\nstep = {step}\n"
    )
}

/// A free symmetric body with 60 rad/s under a force of 1 nN, by generalized-alpha with a radius of 0.9: 0.12 rad a
/// step are too many.
fn body(step: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Body\"\n[body.b]\nmass = 1.5\nposition = [0, 0, 0]\ninertia = [0.02, 0.02, 0.008]\n\
         angular_velocity = [18, 0, 60]\n[load.breath]\nat = \"b\"\nforce = [1e-9, 0, 0]\n\
         [simulation]\nintegrator = \"generalized_alpha\"\nspectral_radius = 0.9\nstop = 3\nstep = {step}\n"
    )
}

/// Warnings of a run in a single communication step of `stop` s.
fn warnings(text: &str, stop: f64) -> Vec<String> {
    let mut simulation = start(text);
    simulation.advance(stop).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.take_warnings()
}

#[test]
fn regression_energy_out_of_nothing_is_told_under_loads_and_within_a_row() {
    let mut simulation = start(&body("2e-3"));
    simulation.advance(3.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.conclude();
    let found = simulation.take_warnings();
    let told = "J, 2.";
    assert!(
        matches!(&found[..], [one] if one.contains("the integrator has gained") && one.contains(told) && one.contains("simulation.step")),
        "{found:?}"
    );
}

#[test]
fn resolved_motions_are_not_warned_of() {
    for (text, stop) in [(strip("4e-3"), 1.0), (strip("1e-3"), 1.0), (body("2.5e-4"), 3.0)] {
        assert_eq!(warnings(&text, stop), Vec::<String>::new());
    }
}

/// A drive that stops a mass at once, or within a step: its power jumps, and the integrator that knows powers at the
/// ends of steps only cannot tell its work. The motion is exact, whatever the account says.
#[test]
fn a_drive_that_stops_a_mass_takes_no_numerical_damping() {
    for rate in ["[{ until = 1, is = \"t\" }, { is = 0 }]", "\"smoothstep(0, 0.5, t) - smoothstep(1, 1.001, t)\""] {
        let text = format!(
            "format = 1\n[model]\nname = \"Stop\"\n[body.mass]\nmass = 2\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
             [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"mass\"\naxis = [1, 0, 0]\n\
             [drive.ramp]\njoint = \"rail\"\ncoordinate = \"distance\"\nrate = {rate}\n\
             [output.m]\nat = \"mass\"\nquantities = [\"velocity\"]\n\
             [simulation]\nintegrator = \"generalized_alpha\"\nstop = 3\nstep = 1e-3\noutput_step = 0.1\n"
        );
        let told = warnings(&text, 3.0);
        assert!(told.iter().all(|warning| !warning.contains("numerical damping has taken")), "{told:?}");
    }
}

/// A motor that works against a damper for a thousand times the kinetic energy: the sums of the work agree to their
/// last digits.
#[test]
fn steady_power_is_accounted_for() {
    for integrator in ["conserving", "undamped", "generalized_alpha"] {
        let line = line(integrator);
        let text = format!(
            "format = 1\n[model]\nname = \"Brake\"\ngravity = [0, 0, -9.81]\n\
             [body.rotor]\nmass = 1\nposition = [0.1, 0, 0]\ninertia = [0.01, 0.01, 0.01]\n\
             [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"rotor\"\nat = [0, 0, 0]\naxis = [0, 1, 0]\ndamping = 1\n\
             [drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nrate = 30\n\
             [simulation]\n{line}\nstop = 20\nstep = 4e-3\n"
        );
        let mut simulation = start(&text);
        simulation.take_warnings();
        simulation.advance(20.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        assert_eq!(simulation.take_warnings(), Vec::<String>::new(), "{integrator}");
        // (0.01 + 0.01) 30²/2.
        assert!((value(&simulation, "energy.kinetic") - 9.0).abs() < 0.1, "{}", value(&simulation, "energy.kinetic"));
    }
}

/// A frame that shakes a mass by a spring with a damper puts energy in and takes it out again, for ever.
#[test]
fn moving_frames_on_springs_are_accounted_for() {
    for integrator in ["conserving", "generalized_alpha"] {
        let line = line(integrator);
        let text = format!(
            "format = 1\n[model]\nname = \"Shaker\"\n[body.b]\nmass = 1\nposition = [1, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n\
             [frame.table]\nposition = [\"0.05*sin(20*t)\", 0, 0]\n\
             [spring.coil]\na = \"table\"\nb = \"b\"\nstiffness = 300\ndamping = 2\n\
             [simulation]\n{line}\nstop = 60\nstep = 5e-3\n"
        );
        let mut simulation = start(&text);
        simulation.take_warnings();
        simulation.advance(60.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        assert_eq!(simulation.take_warnings(), Vec::<String>::new(), "{integrator}");
        assert!(value(&simulation, "energy.kinetic") > 1e-3);
    }
}

/// A motion that grows from nearly nothing by many times a step, and one that begins with a jump of its rate: what a
/// step is off by there is as large as the energy itself, and does not matter.
#[test]
fn sudden_starts_are_not_warned_of() {
    for rate in [
        "\"exp(-1000*(t - 0.5)^2)\"",
        "[{ until = 0.2031, is = 0 }, { until = 0.6, is = 100 }, { is = 0 }]",
        "\"100*t^5\"",
    ] {
        for integrator in ["conserving", "undamped"] {
            let line = line(integrator);
            let text = format!(
                "format = 1\n[model]\nname = \"Start\"\n[body.b]\nmass = 1\nposition = [0.3, 0, 0]\ninertia = [1, 1, 1]\n\
                 [joint.j]\ntype = \"revolute\"\na = \"ground\"\nb = \"b\"\nat = [0, 0, 0]\naxis = [0, 0, 1]\n\
                 [drive.m]\njoint = \"j\"\ncoordinate = \"angle\"\nrate = {rate}\n\
                 [simulation]\n{line}\nstop = 1\nstep = 1e-3\n"
            );
            assert_eq!(warnings(&text, 1.0), Vec::<String>::new(), "{rate} {integrator}");
        }
    }
}

/// Damped beams under a load that is there at once: what dampers take in the first step is not the mean of the powers
/// at its ends.
#[test]
fn damped_sudden_starts_are_not_warned_of() {
    for damping in ["1e-6", "1e-4", "1e-2"] {
        for integrator in ["conserving", "generalized_alpha"] {
            let line = line(integrator);
            let text = format!(
                "format = 1\n[model]\nname = \"Damped\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\ndamping = {damping}\n\
                 [section.rod]\nshape = \"circle\"\nradius = 0.005\n\
                 [beam.arm]\nmaterial = \"steel\"\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 6\n\
                 [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n[load.tip]\nat = \"arm.end\"\nforce = [0, 0, 10]\n\
                 [simulation]\n{line}\nstop = 1\nstep = 1e-3\n"
            );
            assert_eq!(warnings(&text, 1.0), Vec::<String>::new(), "{damping} {integrator}");
        }
    }
}
