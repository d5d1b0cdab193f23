//! Does the surface act where the axis crosses it, at any angle? A floating beam has a closed form; points at fixed
//! places of an element would see its buoyancy jump.

use super::{section, water};
use crate::running::{run, start, value};
use std::f64::consts::PI;

/// An upright beam of 10 m, 0.5 m and 100 kg/m on vertical guides, lifted by `lift` m, and the end of its model file.
fn upright(lift: f64, simulation: &str) -> String {
    let guides = "[joint.low]\ntype = \"inline\"\naxis = [0, 0, 1]\na = \"ground\"\nb = \"beam.start\"\n\
                  [joint.high]\ntype = \"inline\"\naxis = [0, 0, 1]\na = \"ground\"\nb = \"beam.end\"\n\
                  [output.low]\nat = \"beam.start\"\nquantities = [\"position\"]\n";
    let beam = format!(
        "[beam.beam]\nsection = \"round\"\nfrom = [0, 0, {}]\nto = [0, 0, {}]\nelements = 5\n",
        lift - 4.968_739_687,
        lift + 5.031_260_313
    );
    water(9.81, 1025.0, 0.0, "") + &section([1e8, 1e6], 100.0, 0.5, "") + &beam + guides + simulation
}

/// Weight and displaced water are equal at a draft of 4.968739687 m, less what the weight above shortens the beam.
#[test]
fn the_draft_of_an_upright_beam() {
    let simulation = start(&upright(0.1, "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n"));
    let draft = -value(&simulation, "low.position[3]");
    assert!((draft - 4.968_617).abs() < 1e-6, "{draft}");
}

/// It heaves with the period 4.471657036 s, which the midpoint rule makes longer by `(ω h)²/12` at 0.05 s, and keeps
/// its amplitude; the force has no jumps where the surface passes points of the quadrature.
#[test]
fn an_upright_beam_heaves() {
    let mut simulation = start(&upright(0.3, "[simulation]\nstop = 30\nstep = 0.05\n"));
    let mut heights = Vec::new();
    run(&mut simulation, 0.05, 30.0, |simulation| {
        heights.push(value(simulation, "low.position[3]") + 4.968_617);
    });
    let falls = heights.windows(2).enumerate().filter(|(_, pair)| pair[0] > 0.0 && pair[1] <= 0.0);
    let times: Vec<f64> = falls.map(|(k, pair)| 0.05 * (k as f64 + pair[0] / (pair[0] - pair[1]))).collect();
    let period = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    let exact = 4.471_657_036;
    let expected = exact * (1.0 + (2.0 * PI * 0.05 / exact).powi(2) / 12.0);
    assert!((period - expected).abs() < 2e-4, "{period} s");
    let last = heights[heights.len() - 100..].iter().copied().fold(0.0, f64::max);
    assert!((last - 0.3).abs() < 3e-4, "{last} m");
    // The acceleration, by differences, is that of a sine at every step.
    let largest = heights.windows(3).map(|own| (own[2] - 2.0 * own[1] + own[0]) / (0.05 * 0.05)).fold(0.0, f64::max);
    assert!((largest / ((2.0 * PI / period).powi(2) * 0.3) - 1.0).abs() < 5e-3, "{largest} m/s2");
}

/// A level cylinder of half the density of water floats with its axis in the surface, and, of a quarter, with the
/// segment of a circle below it that has a quarter of its area: 0.40397 radii above the middle.
#[test]
fn a_level_cylinder_floats() {
    for (share, height) in [(0.5, 0.0), (0.25, 0.403_972_753_299)] {
        let line_density = share * 1000.0 * PI * 0.01;
        let text = water(9.81, 1000.0, 0.0, "")
            + &section([1e8, 1e6], line_density, 0.2, "")
            + "[beam.beam]\nsection = \"round\"\nfrom = [0, 0, 0.01]\nto = [2, 0, 0.01]\nelements = 2\n\
               [joint.low]\ntype = \"inline\"\naxis = [0, 0, 1]\na = \"ground\"\nb = \"beam.start\"\n\
               [joint.guide]\ntype = \"inplane\"\naxis = [0, 1, 0]\na = \"ground\"\nb = \"beam.end\"\n\
               [output.low]\nat = \"beam@0.5\"\nquantities = [\"position\"]\n\
               [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n";
        let simulation = start(&text);
        let found = value(&simulation, "low.position[3]") / 0.1;
        assert!((found - height).abs() < 1e-6, "{found}");
    }
}
