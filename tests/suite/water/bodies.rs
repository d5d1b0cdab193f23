//! Do bodies sink, float and swing in water as they must? Terminal speeds, and the frequencies of bodies with added mass,
//! have closed forms; buoyancy, drag or added mass that is missing somewhere changes them by percents.

use super::water;
use crate::running::{run, start, value, vector};
use ancf14::fmi::Model;
use std::f64::consts::PI;

const DENSITY: f64 = 1025.0;
const GRAVITY: f64 = 9.81;

/// A body of `mass` kg and `volume` m³ at the height `z` m, with `rest` as its other keys and the end of the file.
fn body(mass: f64, volume: f64, z: f64, rest: &str) -> String {
    water(GRAVITY, DENSITY, 0.0, "")
        + &format!(
            "[body.buoy]\nmass = {mass}\nposition = [0, 0, {z}]\ninertia = [10, 10, 10]\nvolume = {volume}\n{rest}"
        )
}

/// A clump weight that is let go sinks with `v_t tanh(t/τ)`: `v_t² = 2 w/(ρ C_d A)`, and the time `τ = (m + m_a) v_t/w`
/// counts its added mass. 100 steps have an error of the square of the step over τ, over 12.
#[test]
fn a_clump_weight_sinks() {
    let (mass, volume, area, added) = (500.0, 0.2, 0.6, 100.0);
    let weight = (mass - DENSITY * volume) * GRAVITY;
    let speed = (2.0 * weight / (DENSITY * area)).sqrt();
    let time = (mass + added) * speed / weight;
    let rest = format!(
        "drag_areas = [{area}, {area}, {area}]\nadded_mass = [{added}, {added}, {added}]\n\
         [output.buoy]\nat = \"buoy\"\nquantities = [\"velocity\", \"acceleration\"]\n\
         [simulation]\nstop = 3\nstep = 0.02\ntotals = [\"work\", \"energy\"]\n"
    );
    let mut simulation = start(&body(mass, volume, -50.0, &rest));
    // At rest the water takes its part of the weight, and moves with the body.
    assert!((value(&simulation, "buoy.acceleration[3]") + weight / (mass + added)).abs() < 1e-9);
    let mut largest = 0.0_f64;
    run(&mut simulation, 0.1, 3.0, |simulation| {
        let expected = -speed * (simulation.time() / time).tanh();
        largest = largest.max((value(simulation, "buoy.velocity[3]") - expected).abs());
    });
    println!("{largest:.1e} m/s of {speed}");
    assert!(largest < 2e-4 * speed);
    assert!(value(&simulation, "work.drift").abs() < 1e-9 * value(&simulation, "work.water").abs());
}

/// A ball that floats with half of its volume heaves with `ω² = ρ g π R²/(m + m_a/2)`: half of its added mass is in the
/// water. The steps are a 200th of the period, and the amplitude is a thousandth of the radius.
#[test]
fn a_ball_heaves() {
    let radius = 0.8_f64;
    let volume = 4.0 / 3.0 * PI * radius.powi(3);
    let (mass, added) = (0.5 * DENSITY * volume, 0.4 * DENSITY * volume);
    let frequency = (DENSITY * GRAVITY * PI * radius * radius / (mass + 0.5 * added)).sqrt();
    let period = 2.0 * PI / frequency;
    let rest = format!(
        "added_mass = [{added}, {added}, {added}]\n[output.ball]\nat = \"buoy\"\nquantities = [\"position\"]\n\
         [simulation]\nstop = 9\nstep = {}\n",
        period / 200.0
    );
    let mut simulation = start(&body(mass, volume, 8e-4, &rest));
    let mut largest = 0.0_f64;
    run(&mut simulation, period / 20.0, period, |simulation| {
        let expected = 8e-4 * (frequency * simulation.time()).cos();
        largest = largest.max((value(simulation, "ball.position[3]") - expected).abs());
    });
    println!("{largest:.1e} m");
    // The phase is late by 2 pi (2 pi/200)²/24, and the share of the added mass is not constant.
    assert!(largest < 2e-3 * 8e-4);
}

/// A body that is turned by a right angle about z, driven along x through still water, is accelerated with its mass and
/// the added mass along its own y axis; the drag counts the area of that axis.
#[test]
fn added_mass_turns_with_the_body() {
    let rest = "axes = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]\nadded_mass = [100, 300, 500]\ndrag_areas = [1, 2, 3]\n\
                [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"buoy\"\naxis = [1, 0, 0]\n\
                [drive.pull]\njoint = \"rail\"\ncoordinate = \"distance\"\nvalue = \"0.5*t^2\"\n\
                [output.pull]\nat = \"pull\"\nquantities = [\"effort\"]\n\
                [simulation]\nstop = 1\nstep = 0.01\n";
    let mut simulation = start(&body(200.0, 0.1, -20.0, rest));
    assert!((value(&simulation, "pull.effort") - 500.0).abs() < 1e-6);
    run(&mut simulation, 1.0, 1.0, |_| {});
    let expected = 500.0 + 0.5 * DENSITY * 2.0;
    let found = value(&simulation, "pull.effort");
    println!("{found} {expected}");
    assert!((found / expected - 1.0).abs() < 1e-3);
}

/// A light body under water pulls at the line that holds it: by the weight of its water less its own.
#[test]
fn a_buoy_pulls_at_its_line() {
    let rest = "[section.line]\nshape = \"rigidities\"\nEA = 1e7\nEI_y = 1e3\nEI_z = 1e3\nGJ = 1e3\nline_density = 1\n\
                outer_diameter = 0\n[beam.line]\nsection = \"line\"\nfrom = [0, 0, -30]\nto = [0, 0, -20]\nelements = 2\n\
                [joint.low]\ntype = \"weld\"\na = \"ground\"\nb = \"line.start\"\n\
                [joint.up]\ntype = \"weld\"\na = \"line.end\"\nb = \"buoy\"\n\
                [output.low]\nat = \"low\"\nquantities = [\"reaction_force\"]\n\
                [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n";
    let simulation = start(&body(200.0, 0.5, -20.0, rest));
    let force = vector(&simulation, "low.reaction_force");
    let expected = (0.5 * DENSITY - 200.0 - 10.0) * GRAVITY;
    assert!((force.z + expected).abs() < 1e-6 * expected, "{force} {expected}");
}

/// A buoy on three chains without torsion stiffness, each between two ball joints: their equilibrium is found, and
/// nothing is said of their spin. The chains pull alike, and with the weight they hold the buoyancy of the wet part of
/// a ball.
#[test]
fn a_buoy_on_three_chains() {
    let (mass, volume, length) = (8000.0, 20.0, 138.0);
    let mut rest = format!(
        "[seabed]\nstiffness = 3e5\n[section.chain]\nshape = \"rigidities\"\nEA = 1e8\nEI_y = 0\nEI_z = 0\nGJ = 0\n\
         line_density = 50\nouter_diameter = 0.08\n\
         [body.buoy]\nmass = {mass}\nposition = [0, 0, 0]\ninertia = [8e3, 8e3, 8e3]\nvolume = {volume}\n\
         [output.float]\nat = \"buoy\"\nquantities = [\"position\"]\n\
         [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n"
    );
    for line in 0..3 {
        let (y, x) = (2.0 * PI / 3.0 * f64::from(line)).sin_cos();
        rest += &format!(
            "[beam.line_{line}]\nsection = \"chain\"\nfrom = [{}, {}, -50]\nto = [{x}, {y}, -1]\n\
             lay = {{ length = {length} }}\nelements = 12\n\
             [joint.anchor_{line}]\ntype = \"spherical\"\na = \"ground\"\nb = \"line_{line}.start\"\n\
             [joint.fairlead_{line}]\ntype = \"spherical\"\na = \"buoy\"\nb = \"line_{line}.end\"\n\
             [output.pull_{line}]\nat = \"fairlead_{line}\"\nquantities = [\"reaction_force\"]\n",
            120.0 * x,
            120.0 * y
        );
    }
    let mut simulation = start(&(water(GRAVITY, DENSITY, 0.0, "depth = 50") + &rest));
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
    let pulls = [0, 1, 2].map(|line| vector(&simulation, &format!("pull_{line}.reaction_force")));
    let radius = (0.75 * volume / PI).cbrt();
    let wet = radius - value(&simulation, "float.position[3]");
    let share = wet * wet * (3.0 * radius - wet) / (4.0 * radius.powi(3));
    let expected = (share * DENSITY * volume - mass) * GRAVITY;
    let sum: f64 = pulls.iter().map(|pull| pull.z).sum();
    assert!((sum - expected).abs() < 1e-6 * expected, "{sum} {expected}");
    for pull in pulls {
        assert!((pull.norm() - pulls[0].norm()).abs() < 1e-6 * pull.norm(), "{pulls:?}");
    }
}
