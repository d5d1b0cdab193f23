//! Does water that moves with a beam act as mass does, wherever mass counts? In steps, modes, accelerations, reactions
//! and impacts; a place that forgets it is wrong by the share of the added mass.

use super::{section, water};
use crate::running::{run, start, value, vector};
use ancf14::fmi::Model;
use std::f64::consts::PI;

/// A beam of 3 elements on a ball joint that is driven to and fro, for 0.64 s; all of its 2 kg/m are its own, or half
/// of them are water that moves with it in all directions.
fn shaken(share: f64) -> Vec<f64> {
    let (line_density, diameter) = (2.0 - share, (4.0 / PI / 1000.0_f64).sqrt());
    let text = water(0.0, 1000.0, 1000.0, "")
        + &section(
            [50.0, 1.0],
            line_density,
            diameter,
            &format!("added_mass = [{share}, {share}]\npolar_inertia = 0.04"),
        )
        + "[beam.b]\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 3\n\
           [frame.f]\nposition = [0, \"0.3*(1 - cos(4*t))\", 0]\n\
           [joint.a]\ntype = \"spherical\"\na = \"f\"\nb = \"b.start\"\n\
           [output.end]\nat = \"b.end\"\nquantities = [\"position\", \"acceleration\"]\n\
           [output.a]\nat = \"a\"\nquantities = [\"reaction_force\"]\n\
           [output.mid]\nat = \"b@0.4\"\nquantities = [\"section_force\"]\n\
           [simulation]\nstop = 0.64\nstep = 0.016\ntolerance = 1e-12\n";
    let mut simulation = start(&text);
    run(&mut simulation, 0.64, 0.64, |_| {});
    let names = ["end.position", "end.acceleration", "a.reaction_force", "mid.section_force"];
    names.iter().flat_map(|name| vector(&simulation, name).iter().copied().collect::<Vec<_>>()).collect()
}

/// Added mass that is the same in all directions is mass: positions, accelerations, reactions and section forces of a
/// constrained, bending motion agree to what the iteration leaves, so that the order of the steps is the same, too.
#[test]
fn isotropic_added_mass_is_mass() {
    let (dry, wet) = (shaken(0.0), shaken(1.0));
    for (dry, wet) in dry.iter().zip(&wet) {
        assert!((dry - wet).abs() < 1e-10 * dry.abs().max(1.0), "{dry} and {wet}");
    }
}

/// A steel pipe full of water between two joints: frequencies of the beam of Euler and Bernoulli with the mass of the
/// steel, of its contents and of the water around it. Eight cubic elements miss the first three by `(k l)⁴/1440`.
#[test]
fn wet_frequencies() {
    let text = water(0.0, 1025.0, 1000.0, "")
        + "[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
           [section.pipe]\nshape = \"tube\"\nouter = 0.16195\ninner = 0.15235\nadded_mass = [1, 0]\n\
           contents_density = 1000\n\
           [beam.pipe]\nsection = \"pipe\"\nmaterial = \"steel\"\nfrom = [0, 0, 0]\nto = [20, 0, 0]\nelements = 8\n\
           rotary_inertia = false\n\
           [joint.a]\ntype = \"spherical\"\na = \"ground\"\nb = \"pipe.start\"\n\
           [joint.b]\ntype = \"spherical\"\na = \"ground\"\nb = \"pipe.end\"\n\
           [simulation]\nstop = 1\nstep = 0.1\n";
    let modes = start(&text).modes(9).unwrap();
    let found: Vec<f64> =
        modes.modes.iter().map(|mode| mode.eigenvalue.max(0.0).sqrt() / (2.0 * PI)).filter(|own| *own > 0.1).collect();
    let expected = [1.279_413_326, 5.117_653_306, 11.514_719_938];
    for ((pair, expected), tolerance) in found.chunks(2).zip(expected).zip([1e-4, 1e-3, 3e-3]) {
        println!("{pair:?} Hz, {expected}");
        assert!(pair.iter().all(|own| (own / expected - 1.0).abs() < tolerance));
    }
}

/// A stiff rod shaken across itself in still water needs `(m + m_a) a + drag` of its clamp: 281.009570 N/m of drag and
/// 220.704400 N/m of the added mass at the amplitudes. Its own bending, and the steps, make 1e-3 of it.
#[test]
fn a_clamp_bears_drag_and_added_mass() {
    let (length, mass, rate) = (10.0, 100.0, 2.0 * PI / 6.0);
    let keys = "drag = [1, 0]\nadded_mass = [1, 0]\ndamping = 0.02";
    let text = water(0.0, 1025.0, 1000.0, "")
        + &section([1e9, 1e9], mass, 0.5, keys)
        + "[beam.rod]\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [10, 0, 0]\nelements = 2\n\
           velocity = [0, \"2*pi/6\", 0]\n\
           [frame.f]\nposition = [0, \"sin(2*pi*t/6)\", 0]\n\
           [joint.clamp]\ntype = \"weld\"\na = \"f\"\nb = \"rod.start\"\n\
           [output.clamp]\nat = \"clamp\"\nquantities = [\"reaction_force\"]\n\
           [output.root]\nat = \"rod.start\"\nquantities = [\"section_force\"]\n\
           [output.inside]\nat = \"rod@0.3\"\nquantities = [\"section_force\"]\n\
           [simulation]\nstop = 6\nstep = 0.015\ntotals = [\"work\"]\n";
    let mut simulation = start(&text);
    let largest = length * (rate * rate * mass + 220.704_400);
    let mut errors = [0.0_f64; 3];
    run(&mut simulation, 0.015, 6.0, |simulation| {
        let time = simulation.time();
        // The start shakes the rod.
        if time > 2.5 {
            let (sin, cos) = (rate * time).sin_cos();
            let force = length * (-sin * (rate * rate * mass + 220.704_400) + 281.009_570 * cos.abs() * cos);
            let reaction = value(simulation, "clamp.reaction_force[2]");
            let root = value(simulation, "root.section_force[2]");
            let inside = value(simulation, "inside.section_force[2]");
            let own = [reaction - force, reaction + root, root * 0.7 - inside];
            errors.iter_mut().zip(own).for_each(|(error, own)| *error = error.max(own.abs() / largest));
        }
    });
    println!("{errors:?}; work {}", value(&simulation, "work.water"));
    // The section at the clamp transmits the reaction to round-off.
    assert!(errors[0] < 1e-3 && errors[1] < 1e-12 && errors[2] < 1e-3);
    // A cycle of drag takes 749.358853 J/m.
    assert!((value(&simulation, "work.water") / length + 749.358_853).abs() < 1e-3 * 749.358_853);
}

/// A rod that hits a ball joint while it moves across itself gives up the impulse of all that moves: with mass and
/// added mass alike, it turns on as a dry rod does, and takes half of the energy with it that the dry rod of both
/// masses has.
#[test]
fn impacts_are_wet() {
    let spin = |share: f64| {
        let text = water(0.0, 1000.0, 1000.0, "")
            + &section([1e6, 1e6], 2.0 - share, (4.0 / PI / 1000.0_f64).sqrt(), &format!("added_mass = [{share}, 0]"))
            + "[beam.rod]\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\nvelocity = [0, 1, 0]\n\
               [joint.stop]\ntype = \"spherical\"\na = \"ground\"\nb = \"rod.start\"\nactive = \"t > 0.1\"\n\
               [output.end]\nat = \"rod@0.5\"\nquantities = [\"velocity\", \"position\"]\n\
               [simulation]\nstop = 0.3\nstep = 0.001\ntotals = [\"work\", \"energy\"]\n";
        let mut simulation = start(&text);
        run(&mut simulation, 0.001, 0.12, |_| {});
        let account = ["loads", "actuators", "drives", "water", "drift"];
        let work: f64 = account.iter().map(|name| value(&simulation, &format!("work.{name}"))).sum();
        let balance = value(&simulation, "energy.total") - work + value(&simulation, "work.dissipated");
        [vector(&simulation, "end.velocity").y, balance - 0.5 * (2.0 - share), value(&simulation, "work.dissipated")]
    };
    let (dry, wet) = (spin(0.0), spin(1.0));
    println!("{dry:?} {wet:?}");
    assert!((dry[0] - wet[0]).abs() < 1e-3);
    assert!(dry[1].abs() < 1e-9 && wet[1].abs() < 1e-9);
    assert!((dry[2] - wet[2]).abs() < 1e-3 * dry[2]);
}
