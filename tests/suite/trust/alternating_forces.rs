//! Forces that alternate from step to step are an artifact of the steps, and are told where every step can be seen. A
//! vibration that the step resolves, or that numerical damping takes away, is not warned of; nor are loads of a static
//! analysis, which may do what they want.

use crate::running::{run, start, value};
use ancf14::fmi::Model;

/// 1 kg on a mount of 1e8 N/m, 1e4 rad/s, that its weight falls on.
fn mount(simulation: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Mount\"\ngravity = [0, 0, -9.81]\n\
         [body.mass]\nmass = 1\nposition = [0, 0, 0]\ninertia = [0.01, 0.01, 0.01]\n\
         [joint.mount]\ntype = \"bushing\"\na = \"ground\"\nb = \"mass\"\nstiffness = [1e8, 1e8, 1e8]\n\
         rotational_stiffness = [1e4, 1e4, 1e4]\n\
         [output.foot]\nat = \"mount\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
         [output.motion]\nat = \"mass\"\nquantities = [\"velocity\", \"acceleration\"]\n\
         [simulation]\nstop = 1\n{simulation}\n"
    )
}

/// What a run of 100 rows, each `every` s, is told of alternating results.
fn warnings(text: &str, every: f64) -> Vec<String> {
    let mut simulation = start(text);
    run(&mut simulation, every, 100.0 * every, |_| ());
    simulation.conclude();
    let warnings = simulation.take_warnings().into_iter();
    warnings.filter(|warning| warning.contains("alternates from step to step")).collect()
}

/// Without damping the force is once about twice the weight, and once nothing.
#[test]
fn vibrations_far_too_fast_for_the_step_are_told_once() {
    let found = warnings(&mount("step = 1e-2\nspectral_radius = 1"), 1e-2);
    let told = ["motion.acceleration[3]", "% of its largest value", "simulation.step", "spectral_radius"];
    assert!(matches!(&found[..], [one] if told.iter().all(|words| one.contains(words))), "{found:?}");
}

/// From four steps a period on nothing turns the other way at every step; numerical damping leaves nothing of it after
/// ten.
#[test]
fn vibrations_that_steps_resolve_or_damp_are_not_warned_of() {
    for (settings, every) in [
        ("step = 1e-5\nspectral_radius = 1", 1e-5),
        ("step = 1.5e-4\nspectral_radius = 1", 1.5e-4),
        ("step = 1e-2\nspectral_radius = 0.6", 1e-2),
        ("step = 1e-2\nintegrator = \"generalized_alpha\"\nspectral_radius = 0.5", 1e-2),
    ] {
        assert_eq!(warnings(&mount(settings), every), Vec::<String>::new(), "{settings}");
    }
}

/// At every second step all values are alike, and one of them says nothing of the others.
#[test]
fn rows_of_several_steps_are_not_judged() {
    assert_eq!(warnings(&mount("step = 1e-2\nspectral_radius = 1"), 3e-2), Vec::<String>::new());
}

/// A load of two increments a period is what the file asks for.
#[test]
fn equilibria_may_alternate() {
    let text = mount("step = 0.1\nanalysis = \"static\"");
    let load = "[load.shake]\nat = \"mass\"\nforce = [0, 0, \"cos(10*pi*t)\"]\n[simulation]";
    assert_eq!(warnings(&text.replace("[simulation]", load), 0.1), Vec::<String>::new());
}

/// A pendulum about a skew axis, whose joint has no moment to bear: what is read is round-off, which alternates for 15
/// steps.
#[test]
fn round_off_is_not_warned_of() {
    let text = "format = 1\n[model]\nname = \"Pin\"\ngravity = [0, 0, -9.81]\n\
                [body.mass]\nmass = 1.3\nposition = [0.08, -0.06, -0.33]\ninertia = [0.01, 0.01, 0.01]\n\
                [joint.pin]\ntype = \"revolute\"\na = \"ground\"\nb = \"mass\"\nat = [0, 0, 0]\naxis = [0.6, 0.8, 0]\n\
                [output.foot]\nat = \"pin\"\nquantities = [\"reaction_moment\"]\n[simulation]\nstop = 1\nstep = 1e-3\n";
    let mut simulation = start(text);
    run(&mut simulation, 1e-3, 1.0, |_| ());
    simulation.conclude();
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
}

/// A steel rod that is pulled from its first instant on. Its material stops its first axial vibration, `omega` = 8.1e3
/// rad/s, within `1/(c omega²)`, a 66th of a step, and creeps on for `c`, a step. The velocities at the ends of the
/// steps then turn about with every step and fade by 6 % a step, and the viscous force that follows from them by as
/// much as the load. The mean forces of the steps alternate by `2/(c h omega²)` of it, 3 %; a third of that is the
/// bound here, for the mean of two steps has next to none of it. The creep has ended after 10 steps: its inertia is 1.5
/// % of the load times `exp(-10)`.
#[test]
fn viscous_forces_of_what_stops_at_once_do_not_alternate() {
    let text = "format = 1\n[model]\nname = \"Rod\"\ngravity = [0, 0, 0]\n\
                [material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\ndamping = 1e-3\n\
                [section.bar]\nshape = \"rectangle\"\nwidth = 0.01\nheight = 0.01\n\
                [beam.rod]\nmaterial = \"steel\"\nsection = \"bar\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
                [joint.wall]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n\
                [load.pull]\nat = \"rod.end\"\nforce = [1000, 0, 0]\n\
                [output.foot]\nat = \"wall\"\nquantities = [\"reaction_force\"]\n\
                [simulation]\nstop = 1\nstep = 1e-3\n";
    let mut simulation = start(text);
    let mut forces = Vec::new();
    run(&mut simulation, 1e-3, 0.04, |simulation| forces.push(value(simulation, "foot.reaction_force[1]").abs()));
    for (number, force) in forces.iter().enumerate().skip(10) {
        assert!((force / 1000.0 - 1.0).abs() < 0.01, "after step {number}: {force} N");
    }
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
}
