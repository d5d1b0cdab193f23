//! Beams that touch each other, and coils that touch themselves: derivatives, equilibria against closed forms, energy
//! and momentum in motion. A force at fixed places of both beams would gain or lose energy as they slide, and one that
//! integrates over only one of them would depend on their order.

use crate::random::Random;
use crate::running::{goes_on_to_the_bit, run, start, try_start, value, vector};
use crate::support::machines::built;
use crate::support::tangent::{check_damping_matrix, forces_at_rest};
use ancf14::fmi::Model;
use std::f64::consts::TAU;

/// Two soft beams side by side that are inside each other along all of both, also at their ends.
fn side_by_side(rest: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Side\"\ngravity = [0, 0, 0]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 10\nEI_y = 0.1\nEI_z = 0.1\nGJ = 0.1\nline_density = 1\n\
         outer_diameter = 0.2\n\
         [beam.one]\nsection = \"s\"\nfrom = [-0.4, 0.02, 0.1]\nto = [0.5, 0.05, 0.12]\nelements = 2\n\
         [beam.other]\nsection = \"s\"\nfrom = [-0.38, 0.0, 0]\nto = [0.51, 0.03, -0.02]\nelements = 3\n\
         [contact.press]\nof = \"one\"\nwith = \"other\"\nstiffness = 50\n{rest}\n\
         [simulation]\nstop = 1\n"
    )
}

/// The tangent is the derivative of the forces with respect to all coordinates of both beams. The pieces of an element
/// end where the nearest point leaves an element of the other beam: four points of integration of what is smooth in
/// between are exact to 1e-5.
#[test]
fn tangents() {
    let (system, state) = built(&side_by_side(""));
    let mut without = system.clone();
    without.beam_contacts.clear();
    let mut random = Random(7);
    let forces = |q: &[f64]| {
        let [(whole, tangent), (beams, own)] = [&system, &without].map(|system| forces_at_rest(system, &state, q));
        (whole.iter().zip(&beams).map(|(whole, beams)| whole - beams).collect::<Vec<_>>(), tangent, own)
    };
    for _ in 0..3 {
        let [along, left] = [(); 2].map(|()| state.q.iter().map(|_| random.signed()).collect::<Vec<_>>());
        let (here, whole, beams) = forces(&state.q);
        assert!(here.iter().any(|force| force.abs() > 0.1), "{here:?}");
        let found = whole.form(&left, &along) - beams.form(&left, &along);
        let [plus, minus] = [1e-6, -1e-6].map(|share| {
            let moved: Vec<f64> = state.q.iter().zip(&along).map(|(q, change)| q + share * change).collect();
            forces(&moved).0
        });
        let expected: f64 = left.iter().zip(plus.iter().zip(&minus)).map(|(w, (a, b))| w * (a - b) / 2e-6).sum();
        println!("{found} {expected}");
        assert!((found - expected).abs() < 1e-5 * expected.abs().max(1.0), "{found} {expected}");
    }
}

/// The damping matrix is the derivative with respect to the velocities, which forces are linear in.
#[test]
fn damping_matrices() {
    let (system, state) = built(&side_by_side("damping = 0.3"));
    check_damping_matrix(&system, state, "beams");
}

/// Force of two straight bars of the radius `half` that cross at right angles with their axes at the distance `d`:
/// `k ∫ (R − √(s² + d²)) ds`, `R = 2 half`.
fn crossing_force(stiffness: f64, distance: f64, d: f64) -> f64 {
    let end = (distance * distance - d * d).max(0.0).sqrt();
    stiffness * (2.0 * distance * end - (end * distance + d * d * (end / d).asinh()))
}

/// Two bars on supports that cross at right angles, and a load on the upper one where they do: both deflect by their
/// stiffness `48 EI/L³`, and the surfaces give by the closed form of the contact. The deflections are a five-hundredth
/// of the lengths, of whose square the linear beam knows nothing; the contact is 2e-3 of the length wide.
#[test]
fn crossed_beams() {
    let (stiffness, radius, load, lengths) = (1e8, 0.01, 2.0, [1.0, 0.8]);
    for order in ["of = \"upper\"\nwith = \"lower\"", "of = \"lower\"\nwith = \"upper\""] {
        let text = format!(
            "format = 1\n[model]\nname = \"Crossed\"\ngravity = [0, 0, 0]\n\
             [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 10\nEI_z = 10\nGJ = 10\nline_density = 1\n\
             outer_diameter = 0.02\n\
             [beam.upper]\nsection = \"s\"\nfrom = [-0.5, 0, 0.02]\nto = [0.5, 0, 0.02]\nelements = 8\n\
             [beam.lower]\nsection = \"s\"\nfrom = [0, -0.4, 0]\nto = [0, 0.4, 0]\nelements = 8\n\
             y_axis = [0, 0, 1]\n\
             [joint.u0]\ntype = \"revolute\"\na = \"ground\"\nb = \"upper.start\"\naxis = [0, 1, 0]\n\
             [joint.u1]\ntype = \"inplane\"\na = \"ground\"\nb = \"upper.end\"\naxis = [0, 0, 1]\n\
             [joint.l0]\ntype = \"revolute\"\na = \"ground\"\nb = \"lower.start\"\naxis = [1, 0, 0]\n\
             [joint.l1]\ntype = \"inplane\"\na = \"ground\"\nb = \"lower.end\"\naxis = [0, 0, 1]\n\
             [contact.crossing]\n{order}\nstiffness = {stiffness}\n\
             [load.press]\nat = \"upper@0.5\"\nforce = [0, 0, -{load}]\n\
             [output.up]\nat = \"upper@0.5\"\nquantities = [\"displacement\"]\n\
             [output.low]\nat = \"lower@0.5\"\nquantities = [\"displacement\"]\n\
             [output.own]\nat = \"crossing\"\nquantities = [\"normal_force\", \"reaction_force\", \"penetration\"]\n\
             [output.root]\nat = \"lower@0.45\"\nquantities = [\"section_force\"]\n\
             [simulation]\nanalysis = \"static\"\ninitial = \"equilibrium\"\nstop = 1\n"
        );
        let simulation = start(&text);
        let bending = lengths.map(|length: f64| 480.0 / length.powi(3));
        let [mut low, mut high] = [0.0, load];
        for _ in 0..60 {
            let force = 0.5 * (low + high);
            let approach = (load - force) / bending[0] - force / bending[1];
            if crossing_force(stiffness, 2.0 * radius, 2.0 * radius - approach) > force {
                low = force
            } else {
                high = force
            }
        }
        let force = 0.5 * (low + high);
        let exact = [(load - force) / bending[0], force / bending[1]];
        let found = ["up", "low"].map(|name| -value(&simulation, &format!("{name}.displacement[3]")));
        println!(
            "{force} {exact:?} {found:?} {} {:?}",
            value(&simulation, "own.normal_force"),
            simulation.state().statistics
        );
        for (found, exact) in found.iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < 1e-4, "{order}: {found} {exact}");
        }
        let sign = if order.starts_with("of = \"upper\"") { 1.0 } else { -1.0 };
        assert!((sign * value(&simulation, "own.reaction_force[3]") / force - 1.0).abs() < 1e-4);
        assert!((value(&simulation, "own.normal_force") / force - 1.0).abs() < 1e-4);
        // The lower bar bears half of the force on each side.
        let sheared = vector(&simulation, "root.section_force").norm();
        assert!((sheared / (0.5 * force) - 1.0).abs() < 1e-3, "{sheared} {force}");
    }
}

/// A bar thrown onto another one that turns: both momenta stay to round-off, and the energy to 1e-3, from soft contacts
/// to those that are too stiff for the step.
#[test]
fn thrown_beams() {
    for (stiffness, step) in [(1e4, 1e-3), (1e6, 5e-4), (1e8, 5e-4)] {
        let text = format!(
            "format = 1\n[model]\nname = \"Thrown\"\ngravity = [0, 0, 0]\n\
             [section.s]\nshape = \"rigidities\"\nEA = 2e4\nEI_y = 2\nEI_z = 2\nGJ = 1\nline_density = 0.5\n\
             outer_diameter = 0.04\n\
             [beam.bar]\nsection = \"s\"\nfrom = [-0.5, 0.02, 0.061]\nto = [0.5, 0.0, 0.05]\nelements = 8\n\
             velocity = [0.3, 0.4, -0.9]\n\
             [beam.other]\nsection = \"s\"\nfrom = [0.1, -0.4, 0]\nto = [0.0, 0.4, 0.01]\nelements = 7\n\
             [contact.hit]\nof = \"bar\"\nwith = \"other\"\nstiffness = {stiffness}\n\
             [output.load]\nat = \"hit\"\nquantities = [\"normal_force\", \"energy\"]\n\
             [simulation]\nstop = 0.3\nstep = {step}\nspectral_radius = 1\ntotals = [\"energy\", \"work\", \"momentum\"]\n"
        );
        let mut simulation = start(&text);
        let momenta = |own: &_| ["momentum.linear", "momentum.angular"].map(|name| vector(own, name));
        let begin = momenta(&simulation);
        let (mut touched, energy, mut largest) = (0, value(&simulation, "energy.total"), [0.0_f64; 3]);
        run(&mut simulation, 0.002, 0.3, |own| {
            touched += usize::from(value(own, "load.normal_force") > 0.0);
            for (number, (now, before)) in momenta(own).iter().zip(&begin).enumerate() {
                largest[number] = largest[number].max((now - before).norm() / before.norm());
            }
            largest[2] = largest[2].max((value(own, "energy.total") / energy - 1.0).abs());
        });
        println!("{stiffness:e} {step}: {largest:?} {touched} {:?}", simulation.state().statistics);
        assert!(touched > 2, "{touched}");
        assert!(largest[0] < 1e-9 && largest[1] < 1e-9 && largest[2] < 1e-3, "{stiffness:e}: {largest:?}");
    }
}

/// A bar that slides around inside a ring, and lifts off in between: the energy stays to 1e-3 in steps of 10 ms. A force
/// at the gap in the middle of a step gains 3e-2, one along the arm in the middle loses 3e-3.
#[test]
fn a_bar_in_a_ring() {
    let text = "format = 1\n[model]\nname = \"Ring\"\ngravity = [0, 0, 0]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 1e3\nEI_z = 1e3\nGJ = 1e3\nline_density = 2\n\
         outer_diameter = 0.02\n\
         [beam.ring]\nsection = \"s\"\nelements = 16\ny_axis = [0, 0, 1]\n\
         curve = { x = \"cos(s)\", y = \"sin(s)\", z = 0, s = [0, \"2*pi\"] }\n\
         [joint.a]\ntype = \"weld\"\na = \"ground\"\nb = \"ring.start\"\n\
         [joint.b]\ntype = \"weld\"\na = \"ground\"\nb = \"ring.end\"\n\
         [beam.bar]\nsection = \"s\"\nfrom = [-0.97, 0, -0.1]\nto = [-0.97, 0, 0.1]\nelements = 2\n\
         velocity = [-0.3, 2, 0]\n\
         [contact.hit]\nof = \"bar\"\nwith = \"ring\"\nstiffness = 1e5\n\
         [output.load]\nat = \"hit\"\nquantities = [\"normal_force\"]\n\
         [simulation]\nstop = 3\nstep = 0.01\nspectral_radius = 1\ntotals = [\"energy\"]\n";
    let mut simulation = start(text);
    let (begin, mut largest, mut touched) = (value(&simulation, "energy.total"), 0.0_f64, 0);
    run(&mut simulation, 0.01, 3.0, |own| {
        largest = largest.max((value(own, "energy.total") / begin - 1.0).abs());
        touched += usize::from(value(own, "load.normal_force") > 0.0);
    });
    println!("{largest:e} {touched} {:?}", simulation.state().statistics);
    assert!(largest < 1e-3 && touched > 50, "{largest:e} {touched}");
}

/// A thin bar that flies by many times its thickness a step, from 20 mm above another one to 30 mm below it, bounces off.
#[test]
fn nothing_runs_through() {
    let text = "format = 1\n[model]\nname = \"Fast\"\ngravity = [0, 0, 0]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 2e4\nEI_y = 2\nEI_z = 2\nGJ = 1\nline_density = 0.5\n\
         outer_diameter = 0.01\n\
         [beam.bar]\nsection = \"s\"\nfrom = [-0.5, 0.03, 0.12]\nto = [0.5, 0.02, 0.12]\nelements = 3\n\
         velocity = [0, 0, -5]\n\
         [beam.other]\nsection = \"s\"\nfrom = [0.07, -0.4, 0]\nto = [0.05, 0.5, 0]\nelements = 3\n\
         [contact.hit]\nof = \"bar\"\nwith = \"other\"\nstiffness = 1e7\n\
         [output.bar]\nat = \"bar@0.56\"\nquantities = [\"position\"]\n\
         [output.other]\nat = \"other@0.47\"\nquantities = [\"position\"]\n\
         [simulation]\nstop = 0.05\nstep = 0.01\n";
    let mut simulation = start(text);
    run(&mut simulation, 0.01, 0.05, |_| {});
    let [bar, other] = ["bar", "other"].map(|name| value(&simulation, &format!("{name}.position[3]")));
    println!("{bar} {other} {:?}", simulation.state().statistics);
    assert!(bar > other, "{bar} {other}");
}

/// A helical spring of three turns whose upper end moves down: in 0.5 s from a pitch of 5 mm to 10 micrometers above
/// that of touching turns, then by a micrometer of the pitch a row. Further on they slide off each other.
const SPRING: &str = "format = 1\n[model]\nname = \"Spring\"\ngravity = [0, 0, 0]\n\
    [material.steel]\nyoung = 2e11\npoisson = 0.3\ndensity = 7850\n\
    [section.wire]\nshape = \"circle\"\nradius = 0.002\n\
    [beam.coil]\nmaterial = \"steel\"\nsection = \"wire\"\nelements = 24\n\
    curve = { x = \"0.015*cos(2*pi*s)\", y = \"0.015*sin(2*pi*s)\", z = \"0.005*s\", s = [0, 3] }\n\
    [contact.coils]\nof = \"coil\"\nwith = \"itself\"\n\
    [frame.plate]\nposition = [0.015, 0, \"3*(0.005 - 0.9864e-3*min(1, 2*t) - 2e-5*max(0, 2*t - 1))\"]\n\
    [joint.low]\ntype = \"revolute\"\na = \"ground\"\nb = \"coil.start\"\naxis = [1, 0, 0]\n\
    [joint.high]\ntype = \"revolute\"\na = \"plate\"\nb = \"coil.end\"\naxis = [1, 0, 0]\n\
    [output.own]\nat = \"coils\"\nquantities = [\"penetration\", \"reaction_force\"]\n\
    [output.plate]\nat = \"high\"\nquantities = [\"reaction_force\"]\n\
    [simulation]\nanalysis = \"static\"\ninitial = \"equilibrium\"\nstop = 1\nstep = 0.025\n";

/// Pitch of a helix of the radius 15 mm whose turns are 4 mm away from each other.
fn pitch_of_touching_turns() -> f64 {
    let distance = |pitch: f64| {
        // The nearest point of the next turn is one turn away, or a little less.
        let at = |angle: f64| (0.03 * (0.5 * angle).sin()).hypot(pitch * (1.0 + angle / TAU));
        (-2000..0).map(|number| at(f64::from(number) * 1e-5)).fold(f64::INFINITY, f64::min)
    };
    let [mut low, mut high] = [0.004, 0.0041];
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if distance(middle) < 0.004 { low = middle } else { high = middle }
    }
    low
}

/// A helical spring is solid where its turns touch, at a pitch of 4.0036 mm with a wire of 4 mm: to the micrometer of a
/// row, and another one for the helix between its nodes. From then on its coils bear: it is stiffer at once. Forces of
/// coils on each other have no sum.
#[test]
fn coils_that_clash() {
    let exact = pitch_of_touching_turns();
    assert!((exact - 0.0040036).abs() < 1e-7, "{exact}");
    let mut simulation = start(SPRING);
    let mut rows = Vec::new();
    run(&mut simulation, 0.025, 0.85, |own| {
        let t: f64 = own.state().time;
        let pitch = 0.005 - 0.9864e-3 * (2.0 * t).min(1.0) - 2e-5 * (2.0 * t - 1.0).max(0.0);
        assert_eq!(vector(own, "own.reaction_force").norm(), 0.0);
        rows.push((pitch, value(own, "own.penetration"), -value(own, "plate.reaction_force[3]")));
    });
    println!("{exact} {:?}", simulation.state().statistics);
    let solid = rows.iter().position(|row| row.1 > 0.0).expect("solid at last");
    assert!((rows[solid].0 - exact).abs() < 2e-6, "{} {exact}", rows[solid].0);
    let stiffness = |number: usize| (rows[number].2 - rows[number - 1].2) / (rows[number - 1].0 - rows[number].0);
    let [free, borne] = [stiffness(solid - 1), stiffness(solid + 2)];
    assert!(borne > 50.0 * free, "{free} {borne}");
}

/// States go on to the bit while beams land on each other and lift off.
#[test]
fn states_go_on_to_the_bit() {
    let text = "format = 1\n[model]\nname = \"Bits\"\ngravity = [0, 0, -9.81]\n\
        [section.s]\nshape = \"rigidities\"\nEA = 2e4\nEI_y = 2\nEI_z = 2\nGJ = 2\nline_density = 1\n\
        outer_diameter = 0.02\n\
        [beam.base]\nsection = \"s\"\nfrom = [0, -0.4, 0]\nto = [0, 0.4, 0]\nelements = 4\n\
        y_axis = [0, 0, 1]\n\
        [joint.low]\ntype = \"weld\"\na = \"ground\"\nb = \"base.start\"\n\
        [joint.high]\ntype = \"weld\"\na = \"ground\"\nb = \"base.end\"\n\
        [beam.bar]\nsection = \"s\"\nfrom = [-0.5, 0.03, 0.03]\nto = [0.6, 0, 0.02]\nelements = 4\n\
        [contact.hit]\nof = \"bar\"\nwith = [\"base\", \"itself\"]\nstiffness = 1e6\ndamping = 0.1\n\
        [output.load]\nat = \"hit\"\nquantities = [\"normal_force\"]\n\
        [simulation]\nstop = 0.3\nstep = 2e-3\n";
    let mut simulation = start(text);
    let force = simulation.variables().iter().position(|own| own.name == "load.normal_force").expect("an output");
    let (mut touching, mut free) = (0, 0);
    for number in 1..=20 {
        let begin = 0.01 * f64::from(number);
        simulation.advance(begin).unwrap_or_else(|failure| panic!("{}", failure.message));
        let force = f64::from_bits(goes_on_to_the_bit(&mut simulation, begin + 0.02)[force]);
        if force > 0.0 { touching += 1 } else { free += 1 }
    }
    println!("{touching} {free}");
    assert!(touching > 2 && free > 2, "{touching} {free}");
}

/// Copies have beams of their own; `itself` and each pair of two lists count once.
#[test]
fn names_of_what_is_touched() {
    let text = |with: &str| {
        format!(
            "format = 1\n[model]\nname = \"Names\"\n\
             [section.s]\nshape = \"rigidities\"\nEA = 1e5\nEI_y = 10\nEI_z = 10\nGJ = 10\nline_density = 1\n\
             outer_diameter = 0.01\n\
             [copy.stand]\ncount = 2\nmove = [0, \"2*k\", 0]\n\
             [copy.stand.beam.one]\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\n\
             [copy.stand.beam.two]\nsection = \"s\"\nfrom = [0, 0, 1]\nto = [1, 0, 1]\nelements = 3\n\
             [copy.stand.contact.touch]\nof = [\"one\", \"two\"]\nwith = {with}\n[simulation]\nstop = 1\n"
        )
    };
    let pairs = |with: &str| {
        let (system, _) = built(&text(with));
        let contacts = system.beam_contacts.iter();
        contacts.map(|own| own.strands.clone().map(|strand| strand.elements.start)).collect::<Vec<_>>()
    };
    assert_eq!(pairs("[\"one\", \"two\"]"), [[0, 4], [7, 11]]);
    assert_eq!(pairs("\"itself\""), [[0, 0], [4, 4], [7, 7], [11, 11]]);
    assert!(try_start(&text("\"three\"")).is_err());
    // A file without the section of its beams has no thickness to compare.
    let bare = text("\"itself\"");
    let (head, rest) = bare.split_once("[section.s]").unwrap();
    let (_, tail) = rest.split_once("[copy.stand]").unwrap();
    let message = try_start(&format!("{head}[copy.stand]{tail}")).unwrap_err();
    assert!(message.contains("section"), "{message}");
}

/// A bar that is pressed on another one, 1 m and 1.2 m long, as stiff as steel: they touch over a fifth of a millimeter,
/// with 20 elements at nodes of both. Statics of the upper bar close, and the lower one bears what the other one does
/// not. Before, one half of the force was missed or counted twice at nodes, and contacts of less than a hundredth of an
/// element were not found, so that Newton did not converge. The force is
/// `c p^1.5`, 348 N at a penetration of 1.26e-6 m, so that a correction of the tolerance, 1e-8 m, changes it by
/// `1.5 c^(2/3) F^(1/3)` of that.
#[test]
fn crossing_bars_touch_at_nodes_and_between() {
    for elements in [7, 20] {
        let text = format!(
            "format = 1\n[model]\nname = \"Cross\"\ngravity = [0, 0, 0]\n\
             [material.steel]\nyoung = 2e11\npoisson = 0.3\ndensity = 7800\n\
             [section.bar]\nshape = \"circle\"\nradius = 0.01\n\
             [beam.upper]\nmaterial = \"steel\"\nsection = \"bar\"\nfrom = [0, 0, 0.025]\nto = [1, 0, 0.025]\n\
             elements = {elements}\n\
             [beam.lower]\nmaterial = \"steel\"\nsection = \"bar\"\nfrom = [0.8, -0.6, 0]\nto = [0.8, 0.6, 0]\n\
             y_axis = [0, 0, 1]\nelements = {elements}\n\
             [joint.a]\ntype = \"weld\"\na = \"ground\"\nb = \"upper.start\"\n\
             [joint.b]\ntype = \"weld\"\na = \"ground\"\nb = \"lower.start\"\n\
             [joint.c]\ntype = \"weld\"\na = \"ground\"\nb = \"lower.end\"\n\
             [contact.touch]\nof = \"upper\"\nwith = \"lower\"\n\
             [load.p]\nat = \"upper.end\"\nforce = [0, 0, \"-300*t\"]\n\
             [output.touch]\nat = \"touch\"\nquantities = [\"reaction_force\"]\n\
             [output.wall]\nat = \"a\"\nquantities = [\"reaction_force\"]\n\
             [output.left]\nat = \"b\"\nquantities = [\"reaction_force\"]\n\
             [output.right]\nat = \"c\"\nquantities = [\"reaction_force\"]\n\
             [output.before]\nat = \"lower@0.45\"\nquantities = [\"section_force\"]\n\
             [output.after]\nat = \"lower@0.55\"\nquantities = [\"section_force\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.04\n"
        );
        let mut simulation = start(&text);
        run(&mut simulation, 0.04, 1.0, |simulation| {
            let [touch, wall, left, right] =
                ["touch", "wall", "left", "right"].map(|name| vector(simulation, &format!("{name}.reaction_force")).z);
            let (load, error) = (
                300.0 * simulation.time(),
                1e-3 + 1.5e-8 * (348.0 / 1.26e-6_f64.powf(1.5)).powf(2.0 / 3.0) * touch.cbrt(),
            );
            assert!((touch + wall - load).abs() < error, "{elements}, {load} N: {touch} {wall}");
            assert!((left + right - touch).abs() < error, "{elements}, {load} N: {touch} {left} {right}");
            // Sections on both sides of the crossing, of one element of seven, bear the force between them. The pull of
            // the bar has a share of 1e-3 in what is across its axis there.
            let sheared = value(simulation, "before.section_force[2]") - value(simulation, "after.section_force[2]");
            assert!((sheared.abs() - touch).abs() < error + 5e-3 * touch, "{elements}, {load} N: {touch} {sheared}");
        });
        assert!(vector(&simulation, "touch.reaction_force").z > 300.0, "{elements}");
    }
}
