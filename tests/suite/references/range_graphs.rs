//! An output with `summary = "range"` tells minimum, maximum and mean over time by station along a beam. They must be
//! those of closed forms, along the whole beam, with the times of the extremes, over the rows that count. A wrong code
//! mixes up stations or components, counts rows instead of time in the mean, or adds columns and variables.

use crate::running::value;
use ancf14::fmi::Model;
use ancf14::model::ranges::{Envelope, Ranges};
use ancf14::model::rows;
use ancf14::model::simulation::Simulation;
use std::f64::consts::TAU;

/// Amplitude of the swing, rad, and the mass of the arm, kg/m.
const SWING: f64 = 0.2;
const MASS: f64 = 10.0;
const STATIONS: usize = 6;

/// An arm of 2 m on a hub that swings it up by [`SWING`] and back within 1 s. Its vibrations are so fast, some 1e4 rad/s,
/// that it moves as a rigid body but for 1e-6.
fn swung(from: &str) -> String {
    let swing = -0.5 * SWING;
    format!(
        "format = 1\n[model]\nname = \"Swung\"\n\
         [section.stiff]\nshape = \"rigidities\"\nEA = 1e10\nEI_y = 1e10\nEI_z = 1e10\nGJ = 1e10\nline_density = {MASS}\n\
         [beam.arm]\nsection = \"stiff\"\nfrom = [0, 0, 0]\nto = [2, 0, 0]\nelements = 3\n\
         [frame.hub]\nposition = [0, 0, 0]\nrotation = [0, \"{swing}*(1 - cos(2*pi*t))\", 0]\n\
         [joint.root]\ntype = \"weld\"\na = \"hub\"\nb = \"arm.start\"\n\
         [output.all]\non = \"arm\"\nstations = {STATIONS}\nquantities = [\"position\", \"twist\", \"section_moment\"]\n\
         [output.graph]\non = \"arm\"\nstations = {STATIONS}\nquantities = [\"position\", \"twist\", \"section_moment\"]\n\
         summary = \"range\"\n{from}\n\
         [simulation]\nstop = 1\nstep = 0.0025\noutput_step = 0.025\n"
    )
}

/// Runs a model row by row as programs do.
fn run(text: &str, mut look: impl FnMut(f64, &Simulation)) -> (Ranges, Simulation) {
    let mut simulation = Simulation::load("m.toml", text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let mut ranges = simulation.ranges();
    let last = rows::last(simulation.about()).unwrap();
    for row in 0..=last {
        let time = rows::time(simulation.about(), row, last);
        if row > 0 {
            simulation.advance(time).unwrap_or_else(|failure| panic!("{}", failure.message));
        }
        ranges.include(time, simulation.results());
        look(time, &simulation);
    }
    (ranges, simulation)
}

/// The stations of a component of a range, with their arc lengths.
fn component(ranges: &Ranges, name: &str, component: usize) -> Vec<(f64, Envelope)> {
    let range = ranges.list.iter().find(|range| range.name == name).unwrap_or_else(|| panic!("no {name}"));
    let envelopes = range.envelopes().skip(component - 1).step_by(range.components);
    range.stations.iter().copied().zip(envelopes).collect()
}

/// The heights of a swung arm: 0 at the start, `s sin(swing)` in the middle of the run. The mean of a whole period by
/// straight lines between its rows is exact but for round-off.
#[test]
fn heights_of_a_swung_arm() {
    let (ranges, _) = run(&swung(""), |_, _| ());
    // `sin((swing/2)(1 - cos x))` averaged over so many points of a period.
    let mean = (0..64).map(|k| (0.5 * SWING * (1.0 - (TAU * f64::from(k) / 64.0).cos())).sin()).sum::<f64>() / 64.0;
    let heights = component(&ranges, "graph.position", 3);
    assert_eq!(heights.len(), STATIONS);
    for (k, (arc, height)) in heights.into_iter().enumerate() {
        assert!((arc - 0.4 * k as f64).abs() < 1e-12, "{arc}");
        // The bending of the arm is some 1e-7 m.
        let errors = [height.minimum[0], height.maximum[0] - arc * SWING.sin(), height.mean - arc * mean];
        assert!(errors.iter().all(|error| error.abs() < 1e-6), "{arc}: {errors:?}");
        if k > 0 {
            assert_eq!(height.maximum[1], 0.5, "{arc}");
        }
    }
}

/// The inertia of the arm beyond a section bends it: `m alpha (L^3/3 - s L^2/2 + s^3/6)`, with the angular acceleration
/// `alpha` of the hub, which is largest at the start and at the end, and smallest in the middle.
#[test]
fn moments_of_a_swung_arm() {
    let (ranges, _) = run(&swung("from = 0.25"), |_, _| ());
    let alpha = 0.5 * SWING * TAU * TAU;
    for (arc, moment) in component(&ranges, "graph.section_moment", 2) {
        let unit = MASS * alpha * (8.0 / 3.0 - 2.0 * arc + arc.powi(3) / 6.0);
        let (largest, smallest) = (moment.maximum[0].abs(), moment.minimum[0].abs());
        // Steps of 1/400 period: the accelerations of the midpoint rule are off by (2 pi/400)^2/4, 6e-5.
        let tolerance = 2e-4 * MASS * alpha * 8.0 / 3.0;
        assert!((largest - unit).abs() < tolerance && (smallest - unit).abs() < tolerance, "{arc}: {moment:?}, {unit}");
    }
}

/// A range has the bits and the times of the extremes of the columns of the same stations, from its begin on.
#[test]
fn ranges_are_those_of_columns() {
    let mut lowest = vec![[f64::INFINITY; 2]; 3 * STATIONS];
    let mut rows = 0;
    let (ranges, _) = run(&swung("from = 0.3"), |time, simulation| {
        if time < 0.29 {
            return;
        }
        rows += 1;
        for (k, lowest) in lowest.iter_mut().enumerate() {
            let own = value(simulation, &format!("all.section_moment[{},{}]", k / 3 + 1, k % 3 + 1));
            if own < lowest[0] {
                *lowest = [own, time];
            }
        }
    });
    assert_eq!(rows, 29, "0.3 s is a row but for its round-off");
    let range = ranges.list.iter().find(|range| range.name == "graph.section_moment").unwrap();
    let found: Vec<[f64; 2]> = range.envelopes().map(|own| own.minimum).collect();
    assert_eq!(found, lowest);
}

/// Ranges add no variable, neither of an FMU nor of a linear system, and their errors are estimated as those of
/// columns.
#[test]
fn ranges_are_no_variables() {
    let (_, simulation) = run(&swung("from = \"0.1*2\""), |_, _| ());
    let names: Vec<&str> = simulation.variables().iter().map(|variable| variable.name.as_str()).collect();
    assert!(names.contains(&"all.position[1,3]"));
    assert!(!names.iter().any(|name| name.starts_with("graph.")), "{names:?}");
    let linear = simulation.linearize(None, None).unwrap_or_else(|failure| panic!("{}", failure.message));
    let outputs: Vec<&str> = linear.outputs.iter().map(|signal| signal.name.as_str()).collect();
    assert!(outputs.contains(&"all.position[1,3]") && !outputs.iter().any(|name| name.starts_with("graph.")));
    let errors = simulation.estimated_errors();
    let error = |name: &str| errors.iter().find(|own| own.name == name).map(|own| own.error.to_bits());
    assert!(error("all.position").is_some());
    assert_eq!(error("graph.position"), error("all.position"));
}

/// A cantilever under a growing end force in equilibrium: `M = F (L - s)` has its mean half way, over the path. The last
/// of the rows at 0, 0.3, 0.6, 0.9 and 1 is nearer than the others: a mean of rows would be 0.56 of the maximum.
#[test]
fn ranges_of_a_static_path() {
    let text = "format = 1\n[model]\nname = \"Pushed\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
         [section.rod]\nshape = \"circle\"\nradius = 0.02\n[beam.arm]\nmaterial = \"steel\"\nsection = \"rod\"\n\
         from = [0, 0, 0]\nto = [1, 0, 0]\nelements = 2\n[joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
         [load.end]\nat = \"arm.end\"\nforce = [0, 0, \"10*t\"]\n\
         [output.graph]\non = \"arm\"\nstations = 5\nquantities = [\"section_moment\"]\nsummary = \"range\"\n\
         [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.3\noutput_step = 0.3\n";
    let (ranges, _) = run(text, |_, _| ());
    for (arc, moment) in component(&ranges, "graph.section_moment", 2) {
        let Envelope { minimum, maximum, mean } = moment;
        // The force turns the arm by 2e-4, which shortens its lever by some 1e-8 of its length.
        let signed = -10.0 * (1.0 - arc);
        let errors = [minimum[0] - signed, maximum[0], mean - 0.5 * signed];
        assert!(errors.iter().all(|error| error.abs() < 1e-6), "{arc}: {errors:?}");
    }
}
