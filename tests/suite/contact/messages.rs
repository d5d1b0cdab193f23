//! Notes and warnings of contacts, copies with contacts, and numbers that are tuned while a model runs.

use crate::running::{run, start, try_start, value};
use ancf14::fmi::{Model, Value};
use ancf14::model::document::Document;
use ancf14::model::notes::notes;
use ancf14::model::simulation::Simulation;
use ancf14_testing::capstan;
use std::f64::consts::PI;

/// A bar of 1 m and 1 kg on a floor of `stiffness`, with a post beside it that it does not touch.
fn bar(elements: usize, stiffness: &str, rest: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Bar\"\ngravity = [0, 0, -10]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 10\nEI_z = 10\nGJ = 10\nline_density = 1\n{rest}\n\
         [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = {elements}\n\
         [surface.floor]\nshape = \"plane\"\nnormal = [0, 0, 1]\n\
         [surface.post]\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.2\noffset = [0, 0, 3]\n\
         [contact.base]\nof = \"bar\"\nwith = [\"floor\", \"post\"]\n{stiffness}\n\
         [output.load]\nat = \"base\"\nquantities = [\"penetration\", \"reaction_force\"]\n\
         [simulation]\ninitial = \"equilibrium\"\nstop = 0.1\nstep = 0.01\n"
    )
}

/// Elements longer than 0.6 of the radius of a cylinder are noted, with the number that is enough; a beam that may come
/// to lie on the ground is not said to be loose.
#[test]
fn coarse_meshes_are_noted() {
    let notes = |elements| notes(&Document::parse("m.toml", &bar(elements, "", ""), &[]).unwrap());
    let coarse = notes(8);
    assert_eq!(coarse.len(), 1, "{coarse:?}");
    assert!(coarse[0].contains("up to 0.125 m long") && coarse[0].contains("elements = 10 or more"), "{coarse:?}");
    assert_eq!(notes(9), Vec::<String>::new());
}

/// A floor that gives by more than a hundredth of the mechanism is told, a stiff one is not.
#[test]
fn soft_contacts_are_warned_of() {
    let warnings = |stiffness: &str| {
        let mut simulation = start(&bar(10, stiffness, ""));
        run(&mut simulation, 0.05, 0.1, |_| {});
        let all = simulation.take_warnings();
        all.into_iter().filter(|warning| warning.contains("is penetrated")).collect::<Vec<_>>()
    };
    let soft = warnings("stiffness = 200");
    assert_eq!(soft.len(), 1, "{soft:?}");
    assert!(soft[0].contains("5.00e-2 m on surface floor") && soft[0].contains("1 % of the size"), "{soft:?}");
    assert!(!soft[0].contains("radius"), "{soft:?}");
    assert_eq!(warnings("stiffness = 1e5"), Vec::<String>::new());
    // Of a thick beam, the radius may be what is wrong.
    let thick = warnings("stiffness = 200\nradius = 0.03");
    assert!(thick.len() == 1 && thick[0].ends_with("or set a smaller base.radius, which is 0.03 m"), "{thick:?}");
}

/// By default a beam touches with half its outer diameter; a radius of the contact says otherwise.
#[test]
fn beams_are_as_thick_as_their_sections_say() {
    let height = |rest: &str, radius: &str| {
        let text = bar(10, &format!("stiffness = 1e5\n{radius}"), rest)
            .replace("[output.load]", "[output.middle]\nat = \"bar@0.5\"\nquantities = [\"position\"]\n[output.load]");
        value(&start(&text), "middle.position[3]")
    };
    // Its weight of 10 N/m presses it in by 0.1 mm.
    for (rest, radius, exact) in [("", "", 0.0), ("outer_diameter = 0.02", "", 0.01), ("", "radius = 0.03", 0.03)] {
        let found = height(rest, radius);
        assert!((found - (exact - 1e-4)).abs() < 1e-9, "{rest} {radius}: {found}");
    }
}

/// Stiffness is tunable: twice as stiff, the floor gives half as much.
#[test]
fn stiffness_is_tuned() {
    let mut simulation = start(&bar(10, "stiffness = 1e4\ndamping = 100", "").replace("stop = 0.1", "stop = 5"));
    let stiffness = simulation.variables().iter().position(|variable| variable.name == "base.stiffness").unwrap();
    assert!((value(&simulation, "load.penetration") - 1e-3).abs() < 1e-9);
    simulation.set_value(stiffness, Value::Real(2e4)).unwrap();
    run(&mut simulation, 0.1, 5.0, |_| {});
    let found = value(&simulation, "load.penetration");
    assert!((found - 5e-4).abs() < 5e-6, "{found}");
}

/// Copies have contacts of their own: names in lists are those of the copy.
#[test]
fn copies_touch_their_own_surfaces() {
    let text = "format = 1\n[model]\nname = \"Copies\"\ngravity = [0, 0, -10]\n\
        [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 10\nEI_z = 10\nGJ = 10\nline_density = 1\n\
        [copy.stand]\ncount = 2\nmove = [0, \"2*k\", \"k\"]\n\
        [copy.stand.beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
        [copy.stand.surface.floor]\nshape = \"plane\"\nnormal = [0, 0, 1]\n\
        [copy.stand.surface.roof]\nshape = \"plane\"\nnormal = [0, 0, -1]\noffset = [0, 0, 0.5]\n\
        [copy.stand.contact.base]\nof = [\"bar\"]\nwith = [\"floor\", \"roof\"]\nstiffness = 1e4\n\
        [output.second]\nat = \"base_2\"\nquantities = [\"reaction_force\"]\n\
        [simulation]\ninitial = \"equilibrium\"\nstop = 0.1\nstep = 0.01\n";
    let simulation = start(text);
    let force = value(&simulation, "second.reaction_force[3]");
    assert!((force - 10.0).abs() < 1e-6, "{force}");
}

/// Beams and surfaces that are drawn inside each other are named: every step would be refused as running through.
#[test]
fn beams_that_are_drawn_inside_of_something_are_named() {
    let leaves = |radius: &str| {
        format!(
            "format = 1\n[model]\nname = \"Leaves\"\ngravity = [0, 0, 0]\n\
             [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 10\nEI_z = 10\nGJ = 10\nline_density = 1\n\
             outer_diameter = 0.07\n\
             [beam.first]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
             [beam.second]\nsection = \"s\"\nfrom = [0, 0, -0.01]\nto = [1, 0, -0.01]\nelements = 4\n\
             [joint.one]\ntype = \"weld\"\na = \"ground\"\nb = \"first.start\"\n\
             [joint.other]\ntype = \"weld\"\na = \"ground\"\nb = \"second.start\"\n\
             [contact.both]\nof = [\"first\", \"second\"]\nwith = [\"first\", \"second\"]\n{radius}\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\n"
        )
    };
    let failure = try_start(&leaves("")).unwrap_err();
    assert!(failure.contains("first is drawn inside element 0 of second"), "{failure}");
    assert!(failure.contains("0.07 m") && failure.contains("smaller `radius`"), "{failure}");
    // They touch at the thickness of a leaf.
    start(&leaves("radius = 0.005"));

    let post = bar(10, "", "").replace("offset = [0, 0, 3]", "offset = [0.5, 0, 0.05]");
    let failure = try_start(&post).unwrap_err();
    assert!(failure.contains("bar is drawn inside surface post"), "{failure}");
}

/// The share of a contact that slides jumps from 0 to 1 at another load on every mesh: no error is told of it. Pressures
/// along a rope jump where it comes off: the mean of their errors counts, a tenth of the largest one.
#[test]
fn jumps_of_contacts_are_not_told_as_errors() {
    let plain = capstan::model(PI, 0.0);
    let output = "[output.along]\non = \"rope\"\nstations = 57\nquantities = [\"contact_pressure\"]\n[simulation]";
    let text = plain.replace("[simulation]", output);
    let mut simulation = Simulation::load("m.toml", &text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.ask_for_mesh_error(|companion| Box::new(companion));
    simulation.initialize(0.0).unwrap();
    run(&mut simulation, 0.02, 1.0, |_| {});
    simulation.conclude();
    let errors = simulation.mesh_errors();
    assert!(errors.iter().all(|own| own.name != "wrapped.sliding"), "{errors:?}");
    let pressure = errors.iter().find(|own| own.name == "along.contact_pressure").expect("it is judged");
    // Measured: 3.7 % on the mean of the stations, 37 % at the worst one.
    assert!((0.01..0.1).contains(&pressure.error), "{pressure:?}");
}

/// Friction on surfaces has no potential: the stiffness of such equilibria does not decide whether they are stable.
#[test]
fn friction_on_surfaces_has_no_potential() {
    let rope = capstan::model(PI, 0.0);
    let follows = |text: &str| {
        let simulation = start(text);
        simulation.system().follows_no_potential(&simulation.state().excitation)
    };
    assert!(follows(&rope));
    assert!(!follows(&bar(10, "stiffness = 1e5", "")));
}
