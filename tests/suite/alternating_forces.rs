//! Forces that alternate from step to step are an artifact of the steps, and are told where every step can be seen. A vibration that the step resolves, or that
//! numerical damping takes away, is not warned of; nor are loads of a static analysis, which may do what they want.

use crate::running::{run, start};
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
    let warnings = simulation.take_warnings().into_iter();
    warnings.filter(|warning| warning.contains("alternates from step to step")).collect()
}

/// Without damping the force is once about twice the weight, and once nothing.
#[test]
fn vibrations_far_too_fast_for_the_step_are_told_once() {
    let found = warnings(&mount("step = 1e-2\nspectral_radius = 1"), 1e-2);
    let told = ["foot.reaction_force[3]", "% of its largest value", "simulation.step", "spectral_radius"];
    assert!(matches!(&found[..], [one] if told.iter().all(|words| one.contains(words))), "{found:?}");
}

/// From four steps a period on nothing turns the other way at every step; numerical damping leaves nothing of it after ten.
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

/// A pendulum about a skew axis, whose joint has no moment to bear: what is read is round-off, which alternates for 15 steps.
#[test]
fn round_off_is_not_warned_of() {
    let text = "format = 1\n[model]\nname = \"Pin\"\ngravity = [0, 0, -9.81]\n\
                [body.mass]\nmass = 1.3\nposition = [0.08, -0.06, -0.33]\ninertia = [0.01, 0.01, 0.01]\n\
                [joint.pin]\ntype = \"revolute\"\na = \"ground\"\nb = \"mass\"\nat = [0, 0, 0]\naxis = [0.6, 0.8, 0]\n\
                [output.foot]\nat = \"pin\"\nquantities = [\"reaction_moment\"]\n[simulation]\nstop = 1\nstep = 1e-3\n";
    let mut simulation = start(text);
    run(&mut simulation, 1e-3, 1.0, |_| ());
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
}
