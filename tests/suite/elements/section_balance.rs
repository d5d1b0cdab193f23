//! Section forces by equilibrium: in balance on any mesh, and as accurate as displacements. The references are the same
//! program on a fine mesh with quadratic twist, where both kinds of mesh agree with the exact rod
//! (tests/suite/references).

use crate::running::{run, start, value};
use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf14::element::Element;
use ancf14::mechanics::marker::sensor::Facing;
use ancf14::mechanics::output::joint_loads::JointLoads;
use ancf14::mechanics::output::section_loads::SectionLoads;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::model::file::entries::simulation::Analysis;
use ancf14::model::simulation::Simulation;
use ancf14::solve::step::response::Response;
use std::fs;

/// The largest imbalance of a state, as a share of the largest force and moment of all sections.
#[derive(Clone, Copy, Debug, Default)]
struct Imbalance {
    /// Between the two elements at a node where nothing acts.
    at_nodes: f64,
    /// Between the balance of an element from its start and from its end.
    inside: f64,
    /// At free ends.
    at_ends: f64,
    /// Nodes that were looked at.
    nodes: usize,
}

fn elements_of(system: &System) -> impl Iterator<Item = &Element> {
    system.mesh.elements.iter().filter_map(|element| element.ancf14())
}

fn imbalance(simulation: &Simulation) -> Imbalance {
    let (system, state) = (simulation.system(), simulation.state());
    let (mut responder, mut response) = (None, Response::default());
    assert!(simulation.respond(&mut responder, &mut response));
    let mut snapshot = FrameCache::default();
    let c = snapshot.of(system, state);
    let passage = simulation.passage();
    let joints = JointLoads::new((system, state), (&c, &passage), &response.multipliers);
    let loads = SectionLoads { joints: &joints, acceleration: &response.acceleration };
    // At rest, a strain of 1e-14 is round-off of places over the length of an element: 1e-7 of what strains by this.
    let is_static = simulation.document().simulation.analysis == Analysis::Static;
    let axial = elements_of(system).fold(0.0, |most: f64, element| element.stiffness.axial.max(most));
    let least = if is_static { 1e-7 * axial } else { f64::MIN_POSITIVE };
    let (mut force, mut moment) = (least, least * system.size);
    let mut found = [Vec::new(), Vec::new(), Vec::new()];
    // Moments are sums of forces times arms, with their round-off: those of a chain are far smaller than these.
    let arm = elements_of(system).fold(0.0, |most: f64, element| element.length.max(most));
    for beam in &system.beams {
        for number in 0..beam.elements() {
            let element = loads.of_element(beam.first_element + number);
            // Just before the end the sum from the start is taken, at the end the end's own.
            let [start, summed, end] =
                [0.0, 1.0 - 0.5 * f64::EPSILON, 1.0].map(|xi| element.in_space(xi, Facing::After));
            (force, moment) = (force.max(end.force.norm()), moment.max(end.moment.norm()));
            found[1].push((summed.force - end.force, summed.moment - end.moment));
            if number == 0 && !system.is_held(beam.first_node) {
                found[2].push((start.force, start.moment));
            }
            if number + 1 == beam.elements() && !system.is_held(beam.node(number + 1)) {
                found[2].push((end.force, end.moment));
            }
            if number + 1 < beam.elements() && system.is_open(beam, number + 1) {
                let next = loads.of_element(beam.first_element + number + 1).in_space(0.0, Facing::After);
                found[0].push((next.force - end.force, next.moment - end.moment));
            }
        }
    }
    moment = moment.max(force * arm);
    let nodes = found[0].len();
    let [at_nodes, inside, at_ends] = found
        .map(|all| all.into_iter().fold(0.0, |most: f64, (f, m)| most.max(f.norm() / force).max(m.norm() / moment)));
    Imbalance { at_nodes, inside, at_ends, nodes }
}

/// Every shipped model, at some rows: both elements at a node agree where nothing acts, the balance of an element is the
/// same from either end, and free ends bear nothing. In motion that is round-off, at rest the round-off of places.
#[test]
fn every_shipped_model_is_in_balance() {
    let mut models: Vec<_> = fs::read_dir("models").unwrap().map(|entry| entry.unwrap().path()).collect();
    models.retain(|path| path.extension().is_some_and(|own| own == "toml"));
    models.sort();
    let mut looked_at = 0;
    for path in models {
        let text = fs::read_to_string(&path).unwrap();
        let mut simulation = Simulation::load(path.to_str().unwrap(), &text, &[]).unwrap();
        simulation.initialize(0.0).unwrap();
        let is_static = simulation.document().simulation.analysis == Analysis::Static;
        let every = simulation.document().output_step();
        let bound = if is_static { 1e-7 } else { 1e-11 };
        for row in 1..=5 {
            if simulation.advance(f64::from(row) * every).is_err() {
                break;
            }
            let Imbalance { at_nodes, inside, at_ends, nodes } = imbalance(&simulation);
            looked_at += nodes;
            let path = path.display();
            println!("{path} row {row}: nodes {at_nodes:.1e}, inside {inside:.1e}, ends {at_ends:.1e}");
            assert!(inside < 1e-12, "{path}: {inside:e} inside elements");
            assert!(at_nodes.max(at_ends) < bound, "{path}: {at_nodes:e} at nodes, {at_ends:e} at free ends");
        }
    }
    assert!(looked_at > 500, "{looked_at} nodes");
}

/// At a clamp a section bears the reaction of the joint, at all instants of a motion with damping.
#[test]
fn a_clamped_section_bears_the_reaction() {
    let text = fs::read_to_string("models/cantilever.toml").unwrap();
    let text = format!(
        "{text}\n[output.told]\nat = \"arm.start\"\nquantities = [\"section_force\", \"section_moment\"]\n\
         [output.held]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n"
    );
    let mut simulation = start(&text);
    let mut largest = [0.0_f64; 2];
    run(&mut simulation, 0.01, 0.1, |simulation| {
        for (kind, section, joint) in
            [(0, "told.section_force", "held.reaction_force"), (1, "told.section_moment", "held.reaction_moment")]
        {
            let read = |name: &str| Vec3::from_fn(|k, _| value(simulation, &format!("{name}[{}]", k + 1)));
            // The clamped section keeps its axes, those of the ground; b is the beam: the part towards the end pulls
            // at the part towards the start as the ground is pulled.
            let (own, held) = (read(section), read(joint));
            largest[kind] = largest[kind].max(held.norm());
            assert!((own + held).norm() < 1e-12 * largest[kind], "{section}: {own} {held}");
        }
    });
    assert!(largest[0] > 1.0 && largest[1] > 1.0, "{largest:?}");
}

/// What a model tells of the section at `at`: force and moment.
fn told(text: &str, at: &str, advance: impl Fn(&mut Simulation)) -> [Vec3; 2] {
    let text = format!("{text}\n[output.probe]\nat = \"{at}\"\nquantities = [\"section_force\", \"section_moment\"]\n");
    let mut simulation = start(&text);
    advance(&mut simulation);
    ["section_force", "section_moment"]
        .map(|name| Vec3::from_fn(|k, _| value(&simulation, &format!("probe.{name}[{}]", k + 1))))
}

/// The largest errors of force and moment at `places` with each number of elements, of the largest ones there, against
/// `finest` elements with quadratic twist.
fn errors(
    model: &dyn Fn(usize, &str) -> String,
    places: &[&str],
    (meshes, finest): ([usize; 3], usize),
    twist: &str,
    advance: impl Fn(&mut Simulation) + Copy,
) -> [f64; 3] {
    let exact: Vec<[Vec3; 2]> = places.iter().map(|at| told(&model(finest, "quadratic"), at, advance)).collect();
    let scale = [0, 1].map(|kind| exact.iter().fold(0.0, |most: f64, own| own[kind].norm().max(most)));
    meshes.map(|elements| {
        places.iter().zip(&exact).fold(0.0, |most: f64, (at, exact)| {
            let own = told(&model(elements, twist), at, advance);
            let off = [0, 1].map(|kind| (own[kind] - exact[kind]).norm() / scale[kind]);
            off[0].max(off[1]).max(most)
        })
    })
}

/// Observed orders between meshes each twice as fine as the one before.
fn orders(errors: [f64; 3]) -> [f64; 2] {
    [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()]
}

/// The 45-degree bend: forces and moments at its clamp, at nodes and inside elements, which are those of a rod, are of
/// the order of the twist: 2, or 4. Inside elements with linear twist the axes of sections are turned by the torque;
/// without this the order would be the same, the error 30 times as large.
#[test]
fn section_forces_of_the_bend_converge_as_displacements_do() {
    let text = fs::read_to_string("models/bend_45.toml").unwrap();
    let model = |elements: usize, twist: &str| {
        text.replace("elements = 8", &format!("elements = {elements}\ntwist = \"{twist}\""))
    };
    let advance = |simulation: &mut Simulation| run(simulation, 0.05, 1.0, |_| ());
    // Nodes of all meshes, and places inside the elements of all.
    let (nodes, inside) = (["arc.start", "arc@0.25", "arc@0.5", "arc@0.75"], ["arc@0.0625", "arc@0.4375"]);
    let meshes = ([8, 16, 32], 64);
    let linear = [&nodes[..], &inside[..]].map(|places| errors(&model, places, meshes, "linear", advance));
    let quadratic = [&nodes[..], &inside[..]].map(|places| errors(&model, places, meshes, "quadratic", advance));
    println!("linear {linear:?} quadratic {quadratic:?}");
    for own in linear {
        assert!(own[0] < 5e-4 && orders(own).iter().all(|order| *order > 1.9), "{own:?} {:?}", orders(own));
    }
    // The last difference is partly that of the reference, which is 16 times as accurate.
    assert!(quadratic[0][0] < 1e-5 && orders(quadratic[0])[0] > 3.8, "{quadratic:?}");
    assert!(quadratic[1][0] < 5e-5 && orders(quadratic[1])[0] > 3.7, "{quadratic:?}");
}

/// A damped cantilever that falls: of order 4 in the mesh with the same steps, on the way.
#[test]
fn section_forces_in_motion_are_of_order_4() {
    let model = |elements: usize, twist: &str| {
        format!(
            "format = 1\n[model]\nname = \"Falling\"\ngravity = [0, 0, -9.81]\n\
             [material.soft]\nyoung = 2.1e9\npoisson = 0.3\ndensity = 1200\ndamping = 1e-4\n\
             [section.strip]\nshape = \"rectangle\"\nwidth = 0.02\nheight = 0.01\n\
             [beam.arm]\nmaterial = \"soft\"\nsection = \"strip\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = {elements}\n\
             twist = \"{twist}\"\n\
             [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
             [load.side]\nat = \"arm.end\"\nforce = [0, \"0.2*sin(5*t)\", 0]\n\
             [simulation]\nstop = 0.6\nstep = 1e-3\noutput_step = 0.1\n"
        )
    };
    let advance = |simulation: &mut Simulation| run(simulation, 0.1, 0.6, |_| ());
    let found = errors(&model, &["arm.start", "arm@0.5"], ([8, 16, 32], 64), "quadratic", advance);
    println!("{found:?} {:?}", orders(found));
    assert!(found[2] < 1e-5 && orders(found).iter().all(|order| *order > 3.7), "{found:?} {:?}", orders(found));
}

/// The disk of the shipped shaft: forces of both sides of its node differ by the reaction of the joint that holds it.
#[test]
fn both_sides_of_a_body_differ_by_what_holds_it() {
    let text = fs::read_to_string("models/rotating_shaft.toml").unwrap();
    let [mut before, mut after, mut held] = [Vec3::zeros(); 3];
    for (side, place) in [("before", &mut before), ("after", &mut after)] {
        let text = format!(
            "{text}\n[output.probe]\nat = \"shaft@0.5\"\nside = \"{side}\"\nquantities = [\"section_force\"]\n\
             [output.hold]\nat = \"hub\"\nquantities = [\"reaction_force\"]\n"
        );
        let mut simulation = start(&text);
        run(&mut simulation, 0.01, 0.05, |_| ());
        let read = |name: &str| Vec3::from_fn(|k, _| value(&simulation, &format!("{name}[{}]", k + 1)));
        *place = read("probe.section_force");
        held = read("hold.reaction_force");
    }
    assert!(held.norm() > 100.0, "{held}");
    // The sections have the same axes: the sizes of the differences are those in space.
    assert!(((after - before).norm() / held.norm() - 1.0).abs() < 1e-9, "{before} {after} {held}");
}
