//! Is a clamped end of a taut beam told whose element does not resolve the bend there? Under a tension `T` the moment
//! at the clamp is `F √(EI/T)` for a force `F` across the other end. A longer element gives another moment, while the
//! energy hardly changes, which the check of the whole mesh looks at. Ends that are fine enough, that can turn, or that
//! are pressed are not told.

use crate::running::{run, start, value};
use ancf14::fmi::Model;

/// `EI` of the rod, N m², its tension and the force across its end, N.
const BENDING: f64 = 2.1e11 * std::f64::consts::PI * 0.005 * 0.005 * 0.005 * 0.005 / 4.0;
const TENSION: f64 = 1e5;
const ACROSS: f64 = 1e3;

/// A steel rod of 1 m, radius 5 mm, in `elements` elements, held by `joint` at its start and pulled by `along` N at its
/// end.
fn rod(elements: usize, joint: &str, along: f64, simulation: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Rod\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\ndamping = 1e-4\n\
         [section.round]\nshape = \"circle\"\nradius = 0.005\n\
         [beam.rod]\nmaterial = \"steel\"\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = {elements}\n\
         [joint.root]\n{joint}\na = \"ground\"\nb = \"rod.start\"\n\
         [load.pull]\nat = \"rod.end\"\nforce = [{along}, 0, {ACROSS}]\n\
         [output.clamp]\nat = \"root\"\nquantities = [\"reaction_moment\"]\n[simulation]\nstop = 1\n{simulation}"
    )
}

const WELD: &str = "type = \"weld\"";
const STATIC: &str = "analysis = \"static\"\nstep = 1\n";

/// The warnings of clamped ends in a run to `stop` with rows each `every` s, and the moment at the clamp at its end, N
/// m.
fn told(text: &str, every: f64, stop: f64) -> (Vec<String>, f64) {
    let mut simulation = start(text);
    run(&mut simulation, every, stop, |_| ());
    let moment = value(&simulation, "clamp.reaction_moment[2]").abs();
    let warnings = simulation.take_warnings().into_iter();
    (warnings.filter(|warning| warning.contains("at the clamped end")).collect(), moment)
}

/// With elements of 8 bending lengths the moment is off by half of it, and a warning names end, length and remedy. With
/// elements of 0.8 bending lengths, which the remedy asks for, it is right to 2 %, and there is none.
#[test]
fn a_clamp_that_its_element_does_not_resolve_is_told() {
    let bending_length = (BENDING / TENSION).sqrt();
    let exact = ACROSS * bending_length;
    let (warnings, moment) = told(&rod(4, WELD, TENSION, STATIC), 1.0, 1.0);
    println!("{moment} for {exact}");
    assert!((moment / exact - 1.0).abs() > 0.3, "{moment} for {exact}");
    let [warning] = warnings.as_slice() else { panic!("{warnings:?}") };
    for part in [
        "clamped end rod.start",
        "beam rod bends within sqrt(EI/T) = 3.2",
        "its element is 2.5",
        "elements = 32 or more",
    ] {
        assert!(warning.contains(part), "{part}: {warning}");
    }
    let (warnings, moment) = told(&rod(40, WELD, TENSION, STATIC), 1.0, 1.0);
    println!("{moment} for {exact}");
    assert!((moment / exact - 1.0).abs() < 0.02, "{moment} for {exact}");
    assert_eq!(warnings, Vec::<String>::new());
}

/// An end that can turn has no bend, a pressed rod none that short. A motion is told once.
#[test]
fn other_ends_are_not_told() {
    let hinge = "type = \"revolute\"\naxis = [0, 1, 0]";
    for text in [rod(4, hinge, TENSION, STATIC), rod(4, WELD, -10.0, STATIC), rod(4, WELD, 10.0, STATIC)] {
        assert_eq!(told(&text, 1.0, 1.0).0, Vec::<String>::new(), "{text}");
    }
    let (warnings, _) = told(&rod(4, WELD, TENSION, "step = 1e-4\n"), 1e-3, 0.1);
    assert_eq!(warnings.len(), 1, "{warnings:?}");
}
