//! Equilibria of beams that touch surfaces, against closed forms and shooting solutions.

use crate::running::{run, start, value, vector};
use ancf14_testing::capstan::{self, Pulled};
use std::f64::consts::PI;

/// `e^(μ φ)` to half a percent with eight elements on half a turn; a thick rope slides earlier, since its axis turns
/// about a larger radius than the one at which friction acts.
#[test]
fn ropes_on_posts() {
    let thin = [45.0, 90.0, 180.0, 270.0].map(|angle| (angle * PI / 180.0, 0.0, (0.3 * angle * PI / 180.0).exp()));
    for (angle, radius, exact) in thin.into_iter().chain(capstan::THICK.map(|(radius, exact)| (PI, radius, exact))) {
        let Pulled { ratio, sliding, wrapped } = capstan::pulled(angle, radius);
        assert_eq!(sliding, 1.0);
        assert!((wrapped / angle - 1.0).abs() < 0.05, "{wrapped} of {angle}");
        assert!((ratio / exact - 1.0).abs() < 5e-3, "{angle}, {radius}: {ratio} {exact}");
    }
}

/// The pressure of a rope on a post that slides is its tension over the radius of the post. Elements lie deeper in their
/// middle than at their ends, and those at which the rope comes off press less than they should. The others make up for
/// it, by 3.4 % with eight elements on half a turn, which falls as the length of the elements. All pressures add up to
/// the normal force.
#[test]
fn pressures_of_ropes_on_posts() {
    let [coarse, fine] = [1, 2].map(excess_of_pressure);
    assert!(coarse.abs() < 0.05, "{coarse}");
    assert!((0.4..0.6).contains(&(fine / coarse)), "{coarse} {fine}");
}

/// How much more than its tension over the radius the inner halves of elements press, on the mean, with `finer` times as
/// many elements.
fn excess_of_pressure(finer: usize) -> f64 {
    let plain = capstan::model(PI, 0.0);
    let count: usize = plain.split("elements = ").nth(1).and_then(|rest| rest.lines().next()?.parse().ok()).unwrap();
    // Every second station is in the middle of half an element.
    let (stations, length) = (4 * finer * count + 1, 0.3 + 0.1 * PI);
    let outputs = format!(
        "quantities = [\"wrap_angle\", \"sliding\", \"normal_force\"]\n\
         [output.along]\non = \"rope\"\nstations = {stations}\n\
         quantities = [\"contact_pressure\", \"effective_tension\"]\n"
    );
    let text = plain.replace("quantities = [\"wrap_angle\", \"sliding\"]\n", &outputs);
    let text = text.replace(&format!("elements = {count}"), &format!("elements = {}", finer * count));
    let mut simulation = start(&text);
    run(&mut simulation, 0.02, 1.0, |_| {});
    let at = |quantity: &str, station: usize| value(&simulation, &format!("along.{quantity}[{station}]"));
    let middles: Vec<usize> = (2..=stations).step_by(2).collect();
    let sum: f64 = middles.iter().map(|station| at("contact_pressure", *station)).sum();
    let normal = value(&simulation, "wrapped.normal_force");
    assert!((sum * length / middles.len() as f64 / normal - 1.0).abs() < 1e-9, "{sum} {normal}");
    let touching = middles.into_iter().filter(|station| at("contact_pressure", *station) > 0.0);
    let touching: Vec<usize> = touching.collect();
    // Without the elements in which it comes off.
    let inner = &touching[2..touching.len() - 2];
    let ratios = inner.iter().map(|station| at("contact_pressure", *station) * 0.1 / at("effective_tension", *station));
    assert!(inner.len() >= 14 * finer - 2, "{inner:?}");
    ratios.sum::<f64>() / inner.len() as f64 - 1.0
}

/// A bar that lies on a plane presses with its weight, and where the ground ends with nothing.
#[test]
fn pressure_of_a_bar_that_lies() {
    let text = "format = 1\n[model]\nname = \"Lying\"\ngravity = [0, 0, -10]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 1\nEI_z = 1\nGJ = 1\nline_density = 2\n\
         [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
         [surface.floor]\nshape = \"plane\"\nnormal = [0, 0, 1]\n\
         [contact.lying]\nof = \"bar\"\nwith = \"floor\"\nstiffness = 1e6\nradius = 0\nfriction = 0.3\n\
         [output.along]\non = \"bar\"\nstations = 5\nquantities = [\"contact_pressure\"]\n\
         [simulation]\nanalysis = \"static\"\ninitial = \"equilibrium\"\nstop = 1\n";
    let simulation = start(text);
    for station in 1..=5 {
        let pressure = value(&simulation, &format!("along.contact_pressure[{station}]"));
        assert!((pressure / 20.0 - 1.0).abs() < 1e-6, "{station}: {pressure}");
    }
}

/// A beam that a force presses down between two cylinders: its deflection by shooting, to a thousandth. The penetration
/// is a few ten-thousandths of it.
#[test]
fn a_beam_on_two_cylinders() {
    for (radius, force, exact) in
        [(0.05, 4.0, 0.0847462745001), (0.1, 4.0, 0.0798091121986), (0.1, 8.0, 0.185481660089)]
    {
        let text = format!(
            "format = 1\n[model]\nname = \"Two_cylinders\"\ngravity = [0, 0, 0]\n\
             [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 1\nEI_z = 1\nGJ = 1\nline_density = 1\n\
             [beam.bar]\nsection = \"s\"\nfrom = [-0.75, 0, 0]\nto = [0.75, 0, 0]\nelements = 24\n\
             [surface.left]\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = {radius}\noffset = [-0.5, 0, -{radius}]\n\
             [surface.right]\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = {radius}\noffset = [0.5, 0, -{radius}]\n\
             [contact.supports]\nof = \"bar\"\nwith = [\"left\", \"right\"]\nstiffness = 1e7\nradius = 0\n\
             [load.press]\nat = \"bar@0.5\"\nforce = [0, 0, -{force}]\n\
             [joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"bar@0.5\"\naxis = [0, 0, 1]\n\
             [output.middle]\nat = \"bar@0.5\"\nquantities = [\"position\"]\n\
             [output.borne]\nat = \"supports\"\nquantities = [\"reaction_force\"]\n\
             [simulation]\nanalysis = \"static\"\ninitial = \"equilibrium\"\nstop = 1\n"
        );
        let simulation = start(&text);
        let found = -value(&simulation, "middle.position[3]");
        assert!((found / exact - 1.0).abs() < 2e-3, "{radius} {force}: {found} {exact}");
        let borne = value(&simulation, "borne.reaction_force[3]");
        assert!((borne / force - 1.0).abs() < 1e-6, "{borne}");
    }
}

/// A heavy beam on the floor whose end is lifted: force and angle by shooting, with 16 elements.
#[test]
fn a_lifted_end() {
    let text = "format = 1\n[model]\nname = \"Lifted\"\ngravity = [0, 0, -10]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 1\nEI_z = 1\nGJ = 1\nline_density = 1\n\
         [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [2, 0, 0]\nelements = 16\n\
         [surface.floor]\nshape = \"plane\"\nnormal = [0, 0, 1]\n\
         [contact.base]\nof = \"bar\"\nwith = \"floor\"\nstiffness = 1e6\nradius = 0\n\
         [frame.hook]\nposition = [2, 0, \"0.5*t\"]\n\
         [joint.lift]\ntype = \"inplane\"\na = \"hook\"\nb = \"bar.end\"\naxis = [0, 0, 1]\n\
         [joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"bar.start\"\naxis = [0, 0, 1]\n\
         [output.force]\nat = \"lift\"\nquantities = [\"reaction_force\"]\n\
         [output.end]\nat = \"bar.end\"\nquantities = [\"tilt\"]\n\
         [output.lying]\nat = \"base\"\nquantities = [\"contact_length\"]\n\
         [simulation]\nanalysis = \"static\"\ninitial = \"equilibrium\"\nstop = 1\nstep = 0.1\n";
    let mut simulation = start(text);
    run(&mut simulation, 0.1, 1.0, |_| {});
    let [force, angle, lying] =
        ["force.reaction_force[3]", "end.tilt", "lying.contact_length"].map(|name| value(&simulation, name));
    assert!((force / 6.19962108613 - 1.0).abs() < 1e-3, "{force}");
    assert!((angle / 0.938209688216 - 1.0).abs() < 1e-3, "{angle}");
    // The touching part ends where the beam lifts off, by some roots of the fourth order of the penetration less.
    assert!((2.0 - lying - 1.12680471799).abs() < 0.05, "{lying}");
}

/// A clamped beam that is pressed on a post, with friction and thickness: what its section at the clamp bears is the
/// reaction, and both together are what the load and the post leave. Positions times the axial stiffness have a round-off
/// of 1e-9 N.
#[test]
fn sections_bear_what_is_touched() {
    let text = "format = 1\n[model]\nname = \"On_a_post\"\ngravity = [0, 0, -10]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 10\nEI_z = 10\nGJ = 10\nline_density = 1\n\
         [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 7\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"bar.start\"\n\
         [surface.post]\nshape = \"cylinder\"\naxis = [0.2, 1, 0]\nradius = 0.1\noffset = [0.6, 0, -0.12]\n\
         [contact.rest]\nof = \"bar\"\nwith = \"post\"\nstiffness = 1e6\nradius = 0.01\nfriction = 0.2\n\
         [load.push]\nat = \"bar.end\"\nforce = [2, 1, -20]\n\
         [output.root]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
         [output.foot]\nat = \"bar.start\"\nquantities = [\"section_force\", \"section_moment\"]\n\
         [output.before]\nat = \"bar.node[5]\"\nquantities = [\"section_force\", \"section_moment\"]\nside = \"before\"\n\
         [output.after]\nat = \"bar.node[5]\"\nquantities = [\"section_force\", \"section_moment\"]\n\
         [output.beyond]\nat = \"bar@0.7\"\nquantities = [\"section_force\"]\n\
         [output.post]\nat = \"rest\"\nquantities = [\"reaction_force\", \"friction_force\"]\n\
         [simulation]\nanalysis = \"static\"\nstop = 1\n";
    let simulation = start(text);
    let [force, moment] = ["root.reaction_force", "root.reaction_moment"].map(|name| vector(&simulation, name));
    let [borne, bent] = ["foot.section_force", "foot.section_moment"].map(|name| vector(&simulation, name));
    // The section at the clamp has global axes; it bears the reaction with the other sign.
    assert!((force + borne).norm() < 1e-7 && (moment + bent).norm() < 1e-7, "{force:?} {borne:?} {moment:?} {bent:?}");
    // On both sides of the node between an element that touches and one that does not; and behind the post in the
    // element that touches, where only the load and the weight of 0.3 m are left.
    for quantity in ["section_force", "section_moment"] {
        let [before, after] = ["before", "after"].map(|side| vector(&simulation, &format!("{side}.{quantity}")));
        assert!((before - after).norm() < 1e-6, "{quantity}: {before:?} {after:?}");
    }
    let [beyond, left] = [vector(&simulation, "beyond.section_force"), ancf14::math::Vec3::new(2.0, 1.0, -23.0)];
    assert!((beyond.norm() / left.norm() - 1.0).abs() < 1e-6, "{beyond:?} {left:?}");
    let touched = vector(&simulation, "post.reaction_force");
    assert!(touched.z > 10.0 && value(&simulation, "post.friction_force") > 0.1, "{touched:?}");
    let left = force + touched + ancf14::math::Vec3::new(2.0, 1.0, -30.0);
    assert!(left.norm() < 1e-7, "{left:?}");
}

/// A bar on a guide whose floor falls away from under it between two rows: nothing bears it then until it touches the
/// floor again, where its weight of 10 N/m presses it in by 1 mm.
#[test]
fn beams_fall_until_they_touch() {
    let text = "format = 1\n[model]\nname = \"Falling\"\ngravity = [0, 0, -10]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 10\nEI_z = 10\nGJ = 10\nline_density = 1\n\
         [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
         [joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"bar.start\"\naxis = [0, 0, 1]\n\
         [frame.lift]\nposition = [0, 0, \"if(t < 0.15, 0, -0.3)\"]\n\
         [surface.floor]\non = \"lift\"\nshape = \"plane\"\nnormal = [0, 0, 1]\n\
         [contact.base]\nof = \"bar\"\nwith = \"floor\"\nstiffness = 1e4\n\
         [output.middle]\nat = \"bar@0.5\"\nquantities = [\"position\"]\n\
         [simulation]\nanalysis = \"static\"\ninitial = \"equilibrium\"\nstop = 0.3\nstep = 0.1\n";
    let mut simulation = start(text);
    let mut heights = vec![value(&simulation, "middle.position[3]")];
    run(&mut simulation, 0.1, 0.3, |own| heights.push(value(own, "middle.position[3]")));
    for (found, exact) in heights.iter().zip([-0.001, -0.001, -0.301, -0.301]) {
        assert!((found - exact).abs() < 1e-6, "{heights:?}");
    }
}
