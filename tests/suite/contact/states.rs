//! States of contacts: a run goes on from a saved state to the bit, across landing, sticking and sliding.

use crate::running::{goes_on_to_the_bit, start};
use ancf14::fmi::Model;

/// A bar that falls onto a plane, slides and stops, and is thrown on by a load that comes and goes.
const TEXT: &str = "format = 1\n[model]\nname = \"Stick_slip\"\ngravity = [0, 0, -9.81]\n\
    [section.s]\nshape = \"rigidities\"\nEA = 2e4\nEI_y = 20\nEI_z = 20\nGJ = 20\nline_density = 2\n\
    [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0.006]\nto = [1, 0, 0.008]\nelements = 3\nvelocity = [0.5, 0.1, 0]\n\
    [surface.floor]\nshape = \"plane\"\nnormal = [0, 0, 1]\n\
    [contact.base]\nof = \"bar\"\nwith = \"floor\"\nstiffness = 1e5\nradius = 0.005\nfriction = 0.3\n\
    [load.push]\nat = \"bar.start\"\nforce = [\"12*sin(30*t)\", 0, 0]\n\
    [output.middle]\nat = \"bar@0.5\"\nquantities = [\"position\", \"velocity\"]\n\
    [output.load]\nat = \"base\"\nquantities = [\"friction_force\", \"sliding\"]\n\
    [simulation]\nstop = 1\nstep = 2e-3\n";

#[test]
fn states_go_on_to_the_bit() {
    let mut simulation = start(TEXT);
    let sliding = simulation.variables().iter().position(|own| own.name == "load.sliding").expect("an output");
    let (mut slid, mut stuck) = (0, 0);
    for number in 1..=60 {
        let begin = 0.01 * f64::from(number);
        simulation.advance(begin).unwrap_or_else(|failure| panic!("{}", failure.message));
        let share = f64::from_bits(goes_on_to_the_bit(&mut simulation, begin + 0.03)[sliding]);
        if share > 0.0 { slid += 1 } else { stuck += 1 }
    }
    assert!(slid > 5 && stuck > 5, "{slid} {stuck}");
}
