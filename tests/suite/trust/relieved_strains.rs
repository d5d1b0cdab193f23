//! Beams that follow their heat or their prestress freely hold no force and no energy, but for what their mesh makes of
//! it. Such forces and energies have no range of their own to be compared with: a share of it would call a result wrong
//! that is right to a millionth. They are compared with what the same deformation holds without heat or prestress. A
//! beam that is held against its heat is judged by what it holds, as any other.

use crate::running::value;
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

/// `EI` about y and `EA` of the strip, N m² and N.
const BENDING: f64 = 2.1e11 * 0.02 * 1e-6 / 12.0;
const AXIAL: f64 = 2.1e11 * 0.02 * 0.01;

/// A steel strip of 2 m, clamped at its start, with what `beam` says of it and all that beams tell as outputs.
fn strip(beam: &str, more: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Strip\"\ngravity = [0, 0, 0]\n\
         [material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\nexpansion = 1.2e-5\n\
         [section.flat]\nshape = \"rectangle\"\nwidth = 0.02\nheight = 0.01\n\
         [beam.strip]\nmaterial = \"steel\"\nsection = \"flat\"\nfrom = [0, 0, 0]\nto = [2, 0, 0]\nelements = 8\n{beam}\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"strip.start\"\n\
         [output.tip]\nat = \"strip.end\"\n\
         quantities = [\"position\", \"section_force\", \"section_moment\", \"stress\", \"curvature\", \"axial_strain\", \"torsion\"]\n\
         [output.root_load]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
         [output.held]\nof = \"strip\"\nquantities = [\"elastic_energy\"]\n{more}\n"
    )
}

const STATIC: &str = "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\n";
const AT_REST: &str = "[simulation]\ninitial = \"equilibrium\"\nstop = 0.1\noutput_step = 0.002\n";

/// The run to its end, with the mesh error, and what it is told but of where it starts.
fn concluded(text: &str, every: f64, stop: f64) -> (Simulation, Vec<String>) {
    let mut simulation = Simulation::load("m.toml", text, &[]).unwrap();
    simulation.ask_for_mesh_error(|companion| Box::new(companion));
    simulation.initialize(0.0).unwrap();
    for number in 1..=(stop / every).round() as u32 {
        simulation.advance(f64::from(number) * every).unwrap();
    }
    simulation.conclude();
    let told = simulation.take_warnings().into_iter();
    let told = told.filter(|warning| !warning.contains("far from where the mechanism is drawn")).collect();
    (simulation, told)
}

/// A gradient of heat bends the strip to an arc of 0.48/m: the tip is right to 1e-6, as the mesh is to order 4,
/// `(0.12)⁴/720` of a turn of 1 rad a length, and the energy to 1e-6 of `EI κ² L/2`, which the same bend would hold
/// without heat.
#[test]
fn a_strip_that_heat_bends_freely_is_right_and_not_warned_of() {
    let bent: f64 = 1.2e-5 * 4e4;
    let (hot, told) = concluded(&strip("temperature_gradient = [0, \"4e4*t\"]", STATIC), 0.1, 1.0);
    assert_eq!(told, Vec::<String>::new());
    let tip = [(2.0 * bent).sin() / bent, -((1.0 - (2.0 * bent).cos()) / bent)];
    for (name, exact) in [("tip.position[1]", tip[0]), ("tip.position[3]", tip[1])] {
        assert!((value(&hot, name) - exact).abs() < 2e-6, "{name}: {} for {exact}", value(&hot, name));
    }
    assert!(value(&hot, "energy.elastic") < 1e-6 * 0.5 * BENDING * bent * bent * 2.0);
    let energy = hot.mesh_errors().iter().find(|error| error.name == "energy").unwrap();
    assert!(energy.error < 1e-6, "{energy:?}");
    // The end bears nothing, on any mesh.
    assert!(hot.mesh_errors().iter().all(|error| error.name != "tip.section_moment"));
    assert!(value(&hot, "tip.section_moment[2]").abs() < 1e-9 * BENDING * bent);
}

/// Pretension of a bar that nothing holds, and a curvature and a torsion that a strip takes freely, in equilibria and
/// at rest, where the last digits are all that moves.
#[test]
fn prestress_that_nothing_holds_is_not_warned_of() {
    for beam in ["pretension = 1e4", "free_curvature = [0, 1]", "free_torsion = 1", "temperature = \"100\""] {
        for (simulation, every, stop) in [(STATIC, 0.1, 1.0), (AT_REST, 0.002, 0.1)] {
            let (_, told) = concluded(&strip(beam, simulation), every, stop);
            assert_eq!(told, Vec::<String>::new(), "{beam} {simulation}");
        }
    }
}

/// A strip that is turned by the frame that it is welded to has no strain at all: forces of 1e-14 of its rigidities are
/// round-off.
#[test]
fn a_strip_that_is_turned_has_no_forces_to_be_off() {
    let frame = "[frame.hand]\nposition = [0, 0, 0]\nrotation = [0, \"t\", \"0.3*t\"]\n";
    let text = strip("", &format!("{frame}{STATIC}")).replace("a = \"ground\"", "a = \"hand\"");
    assert_eq!(concluded(&text, 0.1, 1.0).1, Vec::<String>::new());
}

/// Held at both ends against its heat the strip relieves nothing: its force is `EA α T`, and its energy is judged by
/// itself.
#[test]
fn a_held_strip_is_judged_by_what_it_holds() {
    let wall = "[joint.wall]\ntype = \"weld\"\na = \"ground\"\nb = \"strip.end\"\n";
    let (held, told) = concluded(&strip("temperature = \"5*t\"", &format!("{wall}{STATIC}")), 0.1, 1.0);
    assert_eq!(told, Vec::<String>::new());
    let force = AXIAL * 1.2e-5 * 5.0;
    // Green's strain differs from the elongation by the share of a strain, 6e-5.
    assert!((value(&held, "tip.section_force[1]") / -force - 1.0).abs() < 1e-4);
    let beams = held.measures().beams;
    assert!(beams.relieved.energy < 1e-12 * value(&held, "energy.elastic"), "{:?}", beams.relieved);
    // Free, it relieves all of it.
    let free = concluded(&strip("temperature = \"5*t\"", STATIC), 0.1, 1.0).0.measures().beams.relieved;
    assert!((free.force / force - 1.0).abs() < 1e-4 && (free.energy / (force * force / AXIAL) - 1.0).abs() < 1e-3);
}

/// A mesh that is too coarse for a strip which heat bends unevenly is told all the same, by the places that it is wrong
/// at.
#[test]
fn a_coarse_mesh_is_told_of_a_strip_that_bends_freely() {
    let text = strip("temperature_gradient = [0, \"1e4*t*sin(5*s)\"]", STATIC).replace("elements = 8", "elements = 3");
    let (_, told) = concluded(&text, 0.1, 1.0);
    assert!(told.iter().any(|warning| warning.contains("because of the mesh")), "{told:?}");
}
