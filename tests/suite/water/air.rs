//! Does the wind push what it meets, as water does, and only above the water? Forces and moments of a steady wind, the
//! decay of a vibration in still air, and the lift of a balloon have closed forms.

use super::section;
use crate::running::{run, start, value, vector};
use ancf14::fmi::Model;
use ancf14::model::document::Document;
use ancf14::model::notes::notes;
use ancf14::model::simulation::Simulation;

const DENSITY: f64 = 1.225;

/// An upright pole of 10 m and 0.1 m on the ground, which gives way by nothing that matters, in air with these keys.
fn pole(fluids: &str) -> String {
    format!("format = 1\n[model]\nname = \"Pole\"\ngravity = [0, 0, 0]\n{fluids}\n")
        + &section([1e10, 1e9], 30.0, 0.1, "drag = [1.2, 0]")
        + "[beam.pole]\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [0, 0, 10]\nelements = 8\n\
           [joint.foot]\ntype = \"weld\"\na = \"ground\"\nb = \"pole.start\"\n\
           [output.foot]\nat = \"foot\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
           [output.tip]\nat = \"pole.end\"\nquantities = [\"fluid_velocity\", \"displacement\"]\n\
           [output.half]\nat = \"pole@0.5\"\nquantities = [\"drag\"]\n\
           [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n"
}

/// Half of `ρ D C_n`, kg/m².
const PUSH: f64 = 0.5 * DENSITY * 0.1 * 1.2;

/// A uniform wind of 20 m/s bends the pole as a uniform load: `q L`, `q L²/2`, `q L⁴/(8 EI)`, which turns by 7e-7 rad.
/// A profile of the power 1/7 has the moment `∫ ρ/2 D C V² z dz`; four points of eight elements integrate `z^(9/7)` to
/// 1e-5.
#[test]
fn a_steady_wind_bends_a_pole() {
    let simulation = start(&pole("[air]\nwind = [20, 0, 0]"));
    let load = PUSH * 400.0;
    let [force, moment, tip] =
        ["foot.reaction_force", "foot.reaction_moment", "tip.displacement"].map(|own| vector(&simulation, own));
    println!("force {force:?}, moment {moment:?}, tip {tip:?}");
    assert!((force.x.abs() - load * 10.0).abs() < 1e-9 * load * 10.0);
    assert!((moment.y.abs() - load * 50.0).abs() < 1e-6 * load * 50.0);
    assert!((tip.x - load * 1e4 / 8e9).abs() < 1e-6 * tip.x);
    assert!((value(&simulation, "half.drag[1]") - load).abs() < 1e-9 * load);
    assert_eq!(value(&simulation, "tip.fluid_velocity[1]"), 20.0);

    let simulation = start(&pole("[air]\nwind = [\"12*(max(z, 0)/10)^(1/7)\", 0, 0]"));
    let expected = PUSH * 144.0 * 10.0_f64.powi(2) / (16.0 / 7.0);
    let moment = vector(&simulation, "foot.reaction_moment").y.abs();
    println!("moment {moment}, expected {expected}");
    assert!((moment - expected).abs() < 1e-4 * expected);
}

/// Wind pushes what is above the water, and the current what is in it: `q_a (L − h)` against `q_w h`. The pole crosses
/// the surface in the middle of an element.
#[test]
fn wind_and_current_share_a_pole() {
    let fluids = "[water]\ndensity = 1000\nsurface = 3.1\ncurrent = [0.5, 0, 0]\n[air]\nwind = [0, 20, 0]";
    let simulation = start(&pole(fluids));
    let force = vector(&simulation, "foot.reaction_force");
    let expected = [0.5 * 1000.0 * 0.1 * 1.2 * 0.25 * 3.1, PUSH * 400.0 * 6.9];
    println!("{force:?} of {expected:?}");
    assert!((force.x.abs() - expected[0]).abs() < 1e-6 * expected[0]);
    assert!((force.y.abs() - expected[1]).abs() < 1e-6 * expected[1]);
    assert_eq!(value(&simulation, "tip.fluid_velocity[2]"), 20.0);
}

/// Waves are looked at once a step, for the water: those of a micrometer leave the wind on the same pole as it is. The
/// orbits of their water move by 1e-6 m/s, 1e-5 of the drag of still water with the current.
#[test]
fn waves_leave_the_wind_alone() {
    let forces = ["", "[wave.ripple]\ntype = \"airy\"\nheight = 1e-6\nperiod = 5\n"].map(|wave| {
        let fluids = "[water]\ndensity = 1000\nsurface = 3.1\ncurrent = [0.5, 0, 0]\n[air]\nwind = [0, 20, 0]\n";
        let moving = "[simulation]\ninitial = \"equilibrium\"\nstop = 0.1\nstep = 0.02\n";
        let text = pole(&(String::from(fluids) + wave)).replace("gravity = [0, 0, 0]", "gravity = [0, 0, -9.81]");
        let (model, _) = text.split_once("[simulation]").unwrap();
        let mut simulation = start(&(String::from(model) + moving));
        run(&mut simulation, 0.1, 0.1, |_| {});
        vector(&simulation, "foot.reaction_force")
    });
    println!("{forces:?}");
    assert!((forces[1] - forces[0]).norm() < 1e-4 * forces[0].xy().norm());
}

/// A light rod on a spring vibrates in still air as `m x'' + c |x'| x' + k x = 0` says, which steps of a 40,000th of a
/// period follow to round-off by Runge and Kutta's rule. A sixth of the mass is that of the air. The midpoint rule with
/// 2,000 steps a period is late by `(ω h)²/24` of a turn a radian, 8e-6 of the amplitude at the end.
#[test]
fn a_vibration_fades_in_still_air() {
    let air = 10.0 * DENSITY;
    let text = format!("format = 1\n[model]\nname = \"Vibration\"\ngravity = [0, 0, 0]\n[air]\ndensity = {air}\n")
        + &section([1e8, 1e6], 0.5, 0.1, "drag = [1.2, 0]\nadded_mass = [1, 0]")
        + "[beam.rod]\nsection = \"round\"\nfrom = [0, 0, -1]\nto = [0, 0, 1]\nelements = 2\n\
           [joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"rod@0.5\"\naxis = [1, 0, 0]\n\
           [spring.back]\njoint = \"guide\"\ncoordinate = \"distance\"\nstiffness = 10\nrest = -0.1\n\
           [output.guide]\nat = \"guide\"\nquantities = [\"distance\"]\n\
           [simulation]\nstop = 3\nstep = 1e-3\ntotals = [\"work\", \"energy\"]\n";
    let mut simulation = start(text.as_str());
    let mass = 2.0 * (0.5 + air * std::f64::consts::PI * 0.0025);
    let drag = 0.5 * air * 0.1 * 1.2 * 2.0;
    let rates = |[x, v]: [f64; 2]| [v, -(10.0 * x + drag * v.abs() * v) / mass];
    let step = 5e-5;
    let advanced = |now: [f64; 2]| {
        let moved = |by: f64, rate: [f64; 2]| [now[0] + by * rate[0], now[1] + by * rate[1]];
        let a = rates(now);
        let b = rates(moved(0.5 * step, a));
        let c = rates(moved(0.5 * step, b));
        let d = rates(moved(step, c));
        std::array::from_fn(|k| now[k] + step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]))
    };
    let (mut exact, mut largest, mut least) = ([0.1, 0.0], 0.0_f64, 0.0_f64);
    run(&mut simulation, 0.1, 3.0, |simulation| {
        (0..2000).for_each(|_| exact = advanced(exact));
        largest = largest.max((value(simulation, "guide.distance") + 0.1 - exact[0]).abs());
        least = least.min(exact[0]);
    });
    println!("largest difference {largest:.1e} m, farthest on the other side {least}");
    // Half a vibration takes a seventh of the amplitude: without drag it would come back to -0.1.
    assert!(least > -0.09 && largest < 1e-5);
    let [work, drift] = ["work.air", "work.drift"].map(|name| value(&simulation, name));
    assert!(work < 0.0 && drift.abs() < 1e-6 * work.abs(), "{work} {drift}");
}

/// A balloon of 2 m³ and 1 kg lifts its tether with `(ρ V − m) g`, and the wind drags it along with `ρ/2 C A V²`: it
/// hangs at the angle of both.
#[test]
fn a_balloon_lifts() {
    let text = format!(
        "format = 1\n[model]\nname = \"Balloon\"\ngravity = [0, 0, -9.81]\n[air]\ndensity = {DENSITY}\nwind = [3, 0, 0]\n"
    ) + "[body.balloon]\nmass = 1\nposition = [0, 0, 5]\ninertia = [1, 1, 1]\nvolume = 2\ndrag_areas = [1, 1, 1]\n\
           [joint.tether]\ntype = \"weld\"\na = \"ground\"\nb = \"balloon\"\n\
           [output.tether]\nat = \"tether\"\nquantities = [\"reaction_force\"]\n\
           [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n";
    let simulation = start(&text);
    let force = vector(&simulation, "tether.reaction_force");
    println!("{force:?}");
    assert!((force.z.abs() - (2.0 * DENSITY - 1.0) * 9.81).abs() < 1e-9);
    assert!((force.x.abs() - 0.5 * DENSITY * 9.0).abs() < 1e-9);
}

/// Air that meets nothing is told, and the pole of the other tests meets it.
#[test]
fn idle_air_is_told() {
    let text = pole("[air]\nwind = [20, 0, 0]");
    for (text, count) in [(text.replace("drag = [1.2, 0]", ""), 1), (text, 0)] {
        let found = notes(&Document::parse("m.toml", &text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        let told = found.iter().filter(|own| own.contains("[air] acts on no beam and no body"));
        assert_eq!(told.count(), count, "{found:?}");
    }
}

/// An override reaches the air: twice the density is twice the force.
#[test]
fn overrides_reach_the_air() {
    let text = pole("[air]\nwind = [20, 0, 0]");
    let forces = [DENSITY, 2.0 * DENSITY].map(|density| {
        let overrides = [(String::from("air.density"), density.to_string())];
        let mut simulation = Simulation::load("m.toml", &text, &overrides).unwrap();
        simulation.initialize(0.0).unwrap();
        vector(&simulation, "foot.reaction_force").x
    });
    assert!((forces[1] / forces[0] - 2.0).abs() < 1e-9, "{forces:?}");
}
