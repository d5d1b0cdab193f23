//! States of contacts: a run goes on from a saved state to the bit, across landing, sticking and sliding.

use crate::running::start;
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

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

fn results(own: &Simulation) -> Vec<u64> {
    (0..own.variables().len()).map(|place| own.value(place).number().to_bits()).collect()
}

#[test]
fn states_go_on_to_the_bit() {
    let advance = |own: &mut Simulation, end: f64| {
        own.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
    };
    let mut simulation = start(TEXT);
    let (mut slid, mut stuck) = (0, 0);
    for number in 1..=60 {
        let (begin, end) = (0.01 * f64::from(number), 0.01 * f64::from(number) + 0.03);
        advance(&mut simulation, begin);
        let snapshot = simulation.snapshot();
        advance(&mut simulation, end);
        let once = results(&simulation);
        let sliding = once.iter().zip(simulation.variables()).find(|(_, own)| own.name == "load.sliding");
        match sliding.map(|(bits, _)| f64::from_bits(*bits)) {
            Some(share) if share > 0.0 => slid += 1,
            _ => stuck += 1,
        }
        simulation.restore(&snapshot);
        advance(&mut simulation, end);
        assert_eq!(once, results(&simulation), "from {begin} s");
        simulation.restore(&snapshot);
    }
    assert!(slid > 5 && stuck > 5, "{slid} {stuck}");
}
