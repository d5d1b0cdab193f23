//! Is a force that does not do what its author meant told? Each of these models is legal, runs, and gives numbers: the
//! sign of a spring, a stop that pushes from the start or gives way, copies in one place, an equilibrium far from the
//! drawing.

use crate::running::start;
use ancf14::fmi::Model;
use ancf14::model::document::Document;
use ancf14::model::notes::notes;

fn of(text: &str) -> Vec<String> {
    notes(&Document::parse("m.toml", text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

fn arm(parts: &str, simulation: &str) -> String {
    format!(
        r#"format = 1
model.name = "Arm"
model.gravity = [0, 0, -9.81]
[body.arm]
mass = 1
position = [0.5, 0, 0]
inertia = [0.01, 0.02, 0.02]
[joint.hinge]
type = "revolute"
a = "ground"
b = "arm"
at = [0, 0, 0]
axis = [0, 1, 0]
{parts}
[simulation]
stop = 1
{simulation}
"#
    )
}

/// Whether exactly one note says this; without it none at all.
fn check(text: &str, wanted: Option<&str>) {
    let found = of(text);
    match wanted {
        Some(wanted) => assert!(found.len() == 1 && found[0].contains(wanted), "{wanted}: {found:?}"),
        None => assert!(found.is_empty(), "{found:?}"),
    }
}

#[test]
fn the_sign_of_a_law_is_told() {
    let spring =
        |force: &str| arm(&format!("[spring.s]\njoint = \"hinge\"\ncoordinate = \"angle\"\nforce = \"{force}\"\n"), "");
    let told = "line 17: s.force pushes away from rest";
    check(&spring("-100*x - 2*v"), Some(told));
    check(&spring("100*x + 2*v"), None);
    // Two places of rest; a force without rest.
    check(&spring("-10*x + 1000*x^3"), None);
    check(&spring("5"), None);
}

#[test]
fn stops_that_push_from_the_start_are_told() {
    let stop = |limits: &str| {
        arm(&format!("[stop.end]\njoint = \"hinge\"\ncoordinate = \"angle\"\nstiffness = 1e4\n{limits}\n"), "")
    };
    check(&stop("lower = 0\nupper = 1"), None);
    check(&stop("lower = 0.2\nupper = 1"), Some("end.lower = 0.2: the coordinate is 0 as drawn, below this limit"));
    check(&stop("upper = -0.1"), Some("end.upper = -0.1: the coordinate is 0 as drawn, above this limit"));
}

#[test]
fn copies_in_one_place_are_told() {
    let copies = |position: &str| {
        format!(
            "format = 1\nmodel.name = \"Stack\"\n[copy.row]\ncount = 3\n[copy.row.body.ball]\nmass = 1\nposition = {position}\ninertia = [1, 1, 1]\n\
             [copy.row.joint.hold]\ntype = \"weld\"\na = \"ground\"\nb = \"ball\"\n[simulation]\nstop = 1\n"
        )
    };
    check(&copies("[\"k\", 0, 0]"), None);
    check(
        &copies("[1, 0, 0]"),
        Some("the copies ball_1 and ball_2 have their centers of mass at the same place, [1.0, 0.0, 0.0]"),
    );
}

/// A motion that jumps inside an expression. Jumps between pieces are told by the run itself; corners are none.
#[test]
fn jumps_inside_expressions_are_told() {
    let drive =
        |value: &str| arm(&format!("[drive.m]\njoint = \"hinge\"\ncoordinate = \"angle\"\nvalue = {value}\n"), "");
    let told = "m.value jumps by 0.2000 at t = 0.512300 s";
    check(&drive("\"0.2*step(0.5123, t)\""), Some(told));
    check(&drive("\"if(t < 0.5123, 0, 0.2)\""), Some(told));
    for smooth in [
        "\"0.2*smoothstep(0.5, 0.6, t)\"",
        "\"max(0, t - 0.5)\"",
        "\"0.01*sin(3000*t)\"",
        "[{ until = 0.5, is = 0 }, { is = 0.3 }]",
    ] {
        check(&drive(smooth), None);
    }
}

/// A stop that gives way is told once, while the run goes on; a stiff one is not.
#[test]
fn a_stop_that_gives_way_is_told() {
    let warnings = |stiffness: &str| {
        let stop =
            format!("[stop.end]\njoint = \"hinge\"\ncoordinate = \"angle\"\nupper = 0.2\nstiffness = {stiffness}\n");
        let mut simulation = start(&arm(&stop, "step = 1e-3\noutput_step = 0.01"));
        (1..=100).for_each(|row| {
            simulation.advance(0.01 * f64::from(row)).unwrap_or_else(|failure| panic!("{}", failure.message))
        });
        simulation.take_warnings()
    };
    assert_eq!(warnings("1e4"), Vec::<String>::new());
    let soft = warnings("5");
    assert!(soft.len() == 1 && soft[0].starts_with("stop end is penetrated by 0.5"), "{soft:?}");
}

/// An arm that gravity turns to where it hangs, a quarter turn away from its drawing: told. Drawn where it hangs, or
/// held, it is not.
#[test]
fn an_equilibrium_far_from_the_drawing_is_told() {
    let told = |text: &str| {
        let mut simulation = start(text);
        simulation.take_warnings().iter().any(|one| one.contains("found far from where the mechanism is drawn"))
    };
    let free = arm("", "analysis = \"static\"");
    assert!(told(&free));
    assert!(!told(&free.replace("position = [0.5, 0, 0]", "position = [0, 0, -0.5]")));
    let spring = "[spring.s]\njoint = \"hinge\"\ncoordinate = \"angle\"\nstiffness = 50\n";
    assert!(!told(&arm(spring, "analysis = \"static\"")));
    assert!(told(&arm("", "initial = \"equilibrium\"")));
}
