//! Runs that fail on a mesh of the program begin anew on finer ones. A wrong code would give up, or change a given mesh.

use crate::running::value;
use ancf14::fmi::Model;
use ancf14::model::refinement::Refinement;
use ancf14::model::rows;
use ancf14::model::simulation::Simulation;

/// A rod of 0.5 m on the sharp edge of a box at x = 0.4 m: its clamp goes 20 mm down, and then by 0.15 m towards the
/// edge.
fn rod(elements: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Rod\"\ngravity = [0, 0, 0]\n\
         [section.rod]\nshape = \"rigidities\"\nEA = 5.9e6\nEI_y = 13.4\nEI_z = 13.4\nGJ = 10\nline_density = 0.22\n\
         outer_diameter = 0.006\n\
         [beam.rod]\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [0.5, 0, 0]\n{elements}\n\
         [surface.block]\nshape = \"box\"\nsize = [0.2, 0.2, 0.1]\noffset = [0.5, 0, -0.053]\n\
         [contact.edge]\nof = \"rod\"\nwith = \"block\"\n\
         [frame.slide]\nposition = [\"0.15*max(t - 1, 0)\", 0, \"-0.02*min(t, 1)\"]\n\
         [joint.clamp]\ntype = \"weld\"\na = \"slide\"\nb = \"rod.start\"\n\
         [output.root]\nat = \"clamp\"\nquantities = [\"reaction_force\"]\n\
         [simulation]\nanalysis = \"static\"\nstop = 2\noutput_step = 0.02\n"
    )
}

fn load(text: &str) -> Box<Simulation> {
    Box::new(Simulation::load("m.toml", text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message)))
}

/// Runs to the end; the message where that fails.
fn run(simulation: &mut Simulation, mut look: impl FnMut(&Simulation)) -> Result<(), String> {
    let about = simulation.about().clone();
    let last = rows::last(&about).unwrap();
    for number in 0..=last {
        let time = rows::time(&about, number, last);
        let outcome = if number == 0 { simulation.initialize(time) } else { simulation.advance(time) };
        outcome.map_err(|failure| failure.message)?;
        look(simulation);
    }
    simulation.conclude();
    Ok(())
}

/// The default of eight elements finds no equilibrium when an element bends around the edge. The force by beam theory,
/// `3 EI d/a^3` with the 0.25 m that are left, is that of small angles: here of 0.12 rad, whose square is 1.4 %.
#[test]
fn meshes_of_the_program_become_finer_where_they_fail() {
    let mut simulation = load(&rod(""));
    let mut refinement = Refinement::of(&mut simulation, None).expect("the file leaves the elements to the program");
    let mut failed = 0;
    while run(&mut simulation, |own| refinement.look(own)).is_err() {
        simulation = refinement.rescue(&simulation).expect("a finer mesh");
        failed += 1;
    }
    assert!(failed > 0 && simulation.elements() == 8 << failed, "{failed}: {}", simulation.elements());
    while let Some(mut next) = refinement.judge(&simulation) {
        run(&mut next, |own| refinement.look(own)).unwrap();
        simulation = next;
    }
    let exact = 3.0 * 13.4 * 0.02 / 0.25_f64.powi(3);
    let force = value(&simulation, "root.reaction_force[3]").abs();
    println!("{failed} {force} {exact}");
    assert!((force / exact - 1.0).abs() < 0.03, "{force} {exact}");
}

/// A mesh that is given stays, a run that has come to its end is not begun anew, and there is an end to it.
#[test]
fn rescues_have_an_end() {
    let mut given = load(&rod("elements = 8"));
    assert!(Refinement::of(&mut given, None).is_none());

    let mut simulation = load(&rod(""));
    let mut refinement = Refinement::of(&mut simulation, None).unwrap();
    let mut rescues = 0;
    while let Some(next) = refinement.rescue(&simulation) {
        simulation = next;
        rescues += 1;
    }
    assert_eq!(rescues, 3);
}
