//! Dry friction that holds: for ever under less than its limit, in motions and equilibria, with its elastic way, its
//! energy and its derivatives.

use crate::running::{run, start, value};
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::{Kept, Simulation};

/// Friction of 5 N that gives by 10 µm before it slides.
const STIFFNESS: f64 = 5e5;

/// A block of 2 kg on a rail along x with that friction, pushed by `push`.
fn block(push: &str, rest: &str, simulation: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Block\"\ngravity = [0, 0, 0]\n\
         [body.block]\nmass = 2\nposition = [0, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n\
         [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"block\"\naxis = [1, 0, 0]\n\
         [friction.rub]\njoint = \"rail\"\ncoordinate = \"distance\"\ncoulomb = 5\nfriction_stiffness = {STIFFNESS}\n\
         [load.push]\nat = \"block\"\n{push}\n{rest}\n\
         [output.way]\nat = \"rail\"\nquantities = [\"distance\", \"distance_rate\"]\n\
         [output.rubbing]\nat = \"rub\"\nquantities = [\"effort\", \"power\"]\n\
         [simulation]\n{simulation}\n"
    )
}

fn advance(simulation: &mut Simulation, end: f64) {
    simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
}

/// Pushed at 80 % of its limit, also with a ripple of 10 %, the block stands: with steps that are far too long for the
/// vibration of sticking, and with chosen ones. What it has moved by is its elastic way, and where a sudden load makes
/// it slide, that of the first steps: in all the time after them it moves by less than 1e-6 of the elastic way, and in
/// the mean the friction is the load.
#[test]
fn a_block_stands_under_less_than_its_limit() {
    let elastic = 4.0 / STIFFNESS;
    for (push, ripple) in [("4", 0.0), ("4 + 0.4*sin(2*pi*t)", 0.1)] {
        for (simulation, end) in [("stop = 1e6\noutput_step = 1000", 1e6), ("stop = 2000\nstep = 0.125", 2e3)] {
            let text = block(&format!("force = [\"{push}\", 0, 0]"), "", simulation);
            let mut simulation = start(&text);
            advance(&mut simulation, 0.1 * end);
            let before = value(&simulation, "way.distance");
            // A whole number of periods later.
            advance(&mut simulation, end);
            let after = value(&simulation, "way.distance");
            assert!(before > 0.0 && before < 3.0 * elastic, "{push}: {before:e}");
            assert!((after - before).abs() < 1e-6 * elastic + ripple * elastic, "{push}: {before:e} to {after:e}");
            assert!((value(&simulation, "rubbing.effort") + 4.0).abs() <= 4.0 * ripple + 1e-6, "{push}");
            let fastest = ripple * std::f64::consts::TAU * elastic;
            assert!(value(&simulation, "way.distance_rate").abs() < 1.01 * fastest + 1e-9, "{push}");
        }
    }
}

/// A block that slides stops after `m v²/(2 F)`, and all of its energy is dissipated but for what sticking stores,
/// `F²/(2 k)` at most.
#[test]
fn a_block_slides_and_stops() {
    let text = block("force = [0, 0, 0]", "", "stop = 1\nstep = 1e-3\ntotals = [\"energy\", \"work\"]")
        .replace("mass = 2", "mass = 2\nvelocity = [1, 0, 0]");
    let mut simulation = start(&text);
    let mut time = 0.0;
    run(&mut simulation, 0.05, 0.35, |simulation| {
        time += 0.05;
        let rate = value(simulation, "way.distance_rate");
        assert!((value(simulation, "rubbing.effort") + 5.0).abs() < 1e-9);
        assert!((value(simulation, "rubbing.power") - 5.0 * rate).abs() < 1e-9);
        // The first step bends the friction: it lasts 1 ms and acts with half of its force in the mean.
        assert!((rate - (1.0 - 2.5 * time)).abs() < 2.5e-3, "{rate}");
    });
    advance(&mut simulation, 1.0);
    // A step adds a share of the square of its length times the deceleration at its start and where it stops, and the
    // way of the first one is its elastic way longer.
    let way = value(&simulation, "way.distance");
    assert!((way - 0.2).abs() < 2.0 * 2.5e-6 + 2e-5, "{way}");
    assert!(value(&simulation, "way.distance_rate").abs() < 1e-9);
    let [dissipated, stored] = ["work.dissipated", "energy.elastic"].map(|name| value(&simulation, name));
    assert!((dissipated + stored - 1.0).abs() < 1e-9 && stored <= 25.0 / (2.0 * STIFFNESS), "{dissipated} {stored}");
}

/// Equilibria: a block on a spring of 100 N/m is pushed to 12 N and let go to 4 N. It slides to 7 N of the spring, and
/// stays there, since 3 N are less than the limit.
#[test]
fn friction_holds_in_equilibria() {
    let spring = "[spring.s]\njoint = \"rail\"\ncoordinate = \"distance\"\nstiffness = 100\n";
    let text = block(
        "force = [\"if(t < 1, 12*t, 12 - 8*(t - 1))\", 0, 0]",
        spring,
        "analysis = \"static\"\nstop = 2\nstep = 0.1",
    );
    let mut simulation = start(&text);
    let whole = 100.0 + STIFFNESS;
    advance(&mut simulation, 0.3);
    let held = value(&simulation, "way.distance");
    assert!((held - 3.6 / whole).abs() < 1e-6 * held, "{held:e}");
    advance(&mut simulation, 1.0);
    let pushed = value(&simulation, "way.distance");
    assert!((pushed - 0.07).abs() < 1e-9, "{pushed}");
    advance(&mut simulation, 2.0);
    let back = value(&simulation, "way.distance");
    assert!((back - (pushed - 8.0 / whole)).abs() < 1e-9, "{back}");
    assert!((value(&simulation, "rubbing.effort") - (100.0 * back - 4.0)).abs() < 1e-6);
}

/// What friction remembers is part of a state: after a rollback the same steps end at the same bits.
#[test]
fn friction_remembers_over_rollbacks() {
    let text = block("force = [\"4*sin(7*t)\", 0, 0]", "", "stop = 2\nstep = 0.01");
    let mut simulation = start(&text);
    advance(&mut simulation, 0.7);
    let snapshot = simulation.snapshot();
    advance(&mut simulation, 1.9);
    let read = |simulation: &Simulation| {
        ["way.distance", "way.distance_rate", "rubbing.effort"].map(|name| value(simulation, name).to_bits())
    };
    let found = read(&simulation);
    simulation.restore(&snapshot);
    advance(&mut simulation, 1.9);
    assert_eq!(read(&simulation), found);
}

/// Directional derivatives over a communication step: a host's force moves what sticks by `1/k` and what slides by the
/// time in which it accelerates the mass.
#[test]
fn derivatives_are_elastic_or_those_of_sliding() {
    let derivative = |force: f64| {
        let text = block(&format!("input = true\nforce = [{force}, 0, 0]"), "", "stop = 10\nstep = 0.01");
        let mut simulation = start(&text);
        advance(&mut simulation, 5.0);
        let of = |name: &str| simulation.variables().iter().position(|own| own.name == name).expect(name);
        let [way, push] = ["way.distance", "push.force[1]"].map(of);
        advance(&mut simulation, 5.1);
        simulation.partial_derivative(way, push).unwrap_or_else(|failure| panic!("{}", failure.message))
    };
    // Held at its value, the force acts from the start of the step. Sticking has ended to rest within ten steps.
    let sticks = derivative(4.0);
    assert!((sticks * STIFFNESS - 1.0).abs() < 1e-3, "{sticks:e}");
    let slides = derivative(7.0);
    assert!((slides / (0.1 * 0.1 / (2.0 * 2.0)) - 1.0).abs() < 1e-6, "{slides:e}");
}

/// Modes are those without dry friction: a block on a spring vibrates although friction would hold it.
#[test]
fn modes_leave_friction_out() {
    let text = block(
        "force = [4, 0, 0]",
        "[spring.s]\njoint = \"rail\"\ncoordinate = \"distance\"\nstiffness = 100\n",
        "stop = 1\ninitial = \"equilibrium\"",
    );
    let modes = start(&text).modes(1).unwrap_or_else(|failure| panic!("{}", failure.message));
    let eigenvalue = modes.modes[0].eigenvalue;
    assert!((eigenvalue - 50.0).abs() < 1e-9, "{eigenvalue}");
    // What friction holds is in balance: the only warning is that of the friction.
    assert!(
        matches!(&modes.warnings[..], [one] if one.starts_with("dry friction is left out")),
        "{:?}",
        modes.warnings
    );
}

/// A run that begins with the state of another model begins with what friction has held there: a block at rest stays at
/// rest. Without its memory, the friction would begin at nothing, and the block would move by an elastic way more.
#[test]
fn friction_remembers_over_models() {
    let first = start(&block("force = [4, 0, 0]", "", "initial = \"equilibrium\"\nstop = 1\nstep = 0.01"));
    let held = value(&first, "way.distance");
    let kept = Kept::read(&first.keep().unwrap_or_else(|failure| panic!("{}", failure.message))).unwrap();
    let mut second = start(&block("force = [4, 0, 0]", "", "stop = 2\nstep = 0.01"));
    let beginning = second.fit(kept).unwrap();
    assert!(!beginning.continues());
    second.begin_from(&beginning).unwrap_or_else(|failure| panic!("{}", failure.message));
    advance(&mut second, 2.0);
    // Newton leaves 1e-8 of the size of 0.27 m at most.
    assert!((value(&second, "way.distance") - held).abs() < 3e-9, "{:e} {held:e}", value(&second, "way.distance"));
}

/// A brake that a host begins to apply finds its sides free of force, whatever way they went before: a block at rest
/// stays at rest.
#[test]
fn a_brake_applied_at_rest_moves_nothing() {
    let text = block("force = [0, 0, 0]", "", "stop = 2\nstep = 0.01")
        .replace("friction_stiffness = 500000", "friction_stiffness = 100");
    let mut simulation =
        start(&text.replace("coulomb = 5", "coulomb = 0").replace("mass = 2", "mass = 2\nvelocity = [1, 0, 0]"));
    advance(&mut simulation, 1.0);
    let of = |name: &str| simulation.variables().iter().position(|own| own.name == name).expect(name);
    let coulomb = of("rub.coulomb");
    let rate = value(&simulation, "way.distance_rate");
    simulation.set_value(coulomb, Value::Real(5.0)).unwrap_or_else(|failure| panic!("{}", failure.message));
    assert_eq!(value(&simulation, "rubbing.effort"), 0.0);
    advance(&mut simulation, 1.01);
    // In the first step the friction bends by the way of the block, and by half a step more: less than 100 N/m times 15
    // mm.
    let effort = value(&simulation, "rubbing.effort");
    assert!(rate > 0.99 && effort < 0.0 && effort > -1.5, "{rate} {effort}");
}
