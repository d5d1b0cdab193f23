//! Loads, rates and drives in pieces: the times at which pieces meet must be hit, wherever the grid of steps is. A step
//! that runs over such a time sees a pulse not at all, or as if it lasted the whole step.

use crate::curves::Curves;
use crate::integrators::setting;
use crate::running::{start, value};
use ancf14::fmi::Model;

const BODY: &str =
    "format = 1\n[model]\nname = \"Pulse\"\n[body.b]\nmass = 1.0\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n";
const RUN: &str = "[output.P]\nat = \"b\"\nquantities = [\"velocity\"]\n[simulation]\nstop = 0.1\nstep = 1e-2\n";

/// A pulse of 1000 N for 1 ms gives 1 kg 1 m/s, wherever it lies in steps of 10 ms: at a round-off of the sums of
/// forces and times.
#[test]
fn regression_a_pulse_within_a_step_gives_its_impulse() {
    // Within a step, over its middle, over its end, from its end on.
    for begin in [0.0131, 0.0145, 0.0195, 0.02] {
        let force = format!(
            "[load.f]\nat = \"b\"\nforce = [[{{ until = {begin}, is = 0 }}, {{ until = \"{begin} + 0.001\", is = 1000 }}, {{ is = 0 }}], 0, 0]\n"
        );
        for integrator in ["conserving", "undamped", "generalized_alpha"] {
            let curves = Curves::run(&format!("{BODY}{force}{RUN}"), &[setting(integrator)]);
            let velocity = curves.last("P.velocity[1]");
            assert!((velocity - 1.0).abs() < 1e-12, "{integrator}, from {begin} s: {velocity}");
        }
    }
}

fn motor(motion: &str) -> String {
    let joint = "[joint.j]\ntype = \"revolute\"\na = \"ground\"\nb = \"b\"\naxis = [0, 0, 1]\n";
    let output = "[output.J]\nat = \"j\"\nquantities = [\"angle\"]\n";
    format!("{BODY}{joint}[drive.m]\njoint = \"j\"\ncoordinate = \"angle\"\n{motion}\n{output}{RUN}")
}

/// 100 rad/s for 0.9 ms, between two places of any rule of 15 points over the step: 0.09 rad.
#[test]
fn regression_a_short_rate_is_integrated() {
    let text = motor("rate = [{ until = 0.0551, is = 0 }, { until = 0.0560, is = 100 }, { is = 0 }]");
    let angle = Curves::run(&text, &[]).last("J.angle");
    assert!((angle - 0.09).abs() < 1e-12, "{angle}");
}

/// A value that jumps is told, with its time; one that only changes its rate is not.
#[test]
fn regression_a_drive_that_jumps_is_warned_of() {
    let mut jumps = start(&motor("value = [{ until = 0.05, is = 0 }, { is = 0.3 }]"));
    let warnings = jumps.take_warnings();
    assert!(
        matches!(&warnings[..], [one] if one.starts_with("the value of drive m jumps by 0.3 at t = 0.05 s")),
        "{warnings:?}"
    );
    let mut bends = start(&motor("value = [{ until = 0.05, is = 0 }, { is = \"t - 0.05\" }]"));
    assert_eq!(bends.take_warnings(), Vec::<String>::new());
}

/// Breaks on the grid, or off it by rounding, make no steps of their own.
#[test]
fn breaks_on_the_grid_cost_no_steps() {
    let text = motor("value = [{ until = \"0.1*0.3\", is = 0 }, { until = 0.05, is = \"t - 0.03\" }, { is = 0.02 }]");
    let mut simulation = start(&text);
    simulation.advance(0.1).unwrap_or_else(|failure| panic!("{}", failure.message));
    assert_eq!(value(&simulation, "statistics.steps"), 10.0);
}

/// A rate that is not finite at an instant is named, instead of a part of the mechanism that its gap in the equations
/// seems to free.
#[test]
fn regression_a_rate_without_a_value_is_named() {
    let mut simulation = start(
        &motor("value = \"acos(cos(t - 0.05))\"").replace("stop = 0.1\n", "stop = 0.1\ninitial = \"equilibrium\"\n"),
    );
    let failure = simulation.advance(0.1).expect_err("the slope jumps by 2 at 0.05 s");
    assert!(
        failure.message.contains("the rate of drive m is not a finite number at t = 0.05 s"),
        "{}",
        failure.message
    );
}
