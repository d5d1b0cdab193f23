//! Do beams sink, tow and hang in a current as they must? Terminal speeds and angles have closed forms with the drag of
//! an infinite cylinder, across and along; a wrong normal velocity, area or density changes them by percents.

use super::{section, water};
use crate::running::{run, start, value, vector};
use ancf14::fmi::Model;
use ancf14::model::document::Document;
use ancf14::model::notes::notes;
use std::f64::consts::PI;

const DENSITY: f64 = 1025.0;
const GRAVITY: f64 = 9.81;

/// A rod of 30 kg/m and 0.1 m from the origin, with more keys of its section.
fn rod(to: &str, keys: &str, water_keys: &str) -> String {
    let section = section([1e8, 1e8], 30.0, 0.1, keys);
    let beam = format!("[beam.rod]\nsection = \"round\"\nfrom = [0, 0, 0]\nto = {to}\nelements = 2\n");
    water(GRAVITY, DENSITY, 1000.0, water_keys) + &section + &beam
}

/// A rod released broadside falls with `v_n tanh(t/τ)`: its added mass is that of a cylinder, its end speed that of the
/// drag across. 100 steps have an error of `(0.01/0.33)²/12`, 8e-5.
#[test]
fn a_rod_sinks_broadside() {
    let keys = "drag = [1.2, 0.02]\ndrag_area = \"circumference\"\nadded_mass = [1, 0]";
    let rest = "[output.rod]\nat = \"rod@0.5\"\nquantities = [\"velocity\"]\n[simulation]\nstop = 1\nstep = 0.01\n";
    let mut simulation = start(&(rod("[2, 0, 0]", keys, "") + rest));
    let mut largest = 0.0_f64;
    run(&mut simulation, 0.1, 1.0, |simulation| {
        let expected = -1.871_160_030 * (simulation.time() / 0.330_652_944).tanh();
        largest = largest.max((value(simulation, "rod.velocity[3]") - expected).abs());
    });
    println!("largest difference {largest:.1e} m/s");
    assert!(largest < 2e-4);
}

/// A rod released upright ends at the speed of the drag along it, which counts with the circumference, or with the
/// diameter: pi times less area. The tolerance is what is left of `exp(-2 t/τ)` after 20 s.
#[test]
fn a_rod_sinks_lengthwise() {
    for (area, factor) in [("circumference", 1.0), ("diameter", PI.sqrt())] {
        let keys = format!("drag = [1.2, 0.02]\ndrag_area = \"{area}\"");
        let rest = "[output.rod]\nat = \"rod@0.5\"\nquantities = [\"velocity\"]\n[simulation]\nstop = 30\nstep = 0.1\n";
        let mut simulation = start(&(rod("[0, 0, -2]", &keys, "") + rest));
        run(&mut simulation, 30.0, 30.0, |_| {});
        let speed = -value(&simulation, "rod.velocity[3]");
        assert!((speed - 8.177_331_815 * factor).abs() < 1e-5 * speed, "{area}: {speed}");
    }
}

/// A rod on a ball joint in a current hangs at the critical angle, `w cos a = ρ/2 D C_n V² sin² a`, at every speed:
/// the forces across it are in balance all along. The tolerance is that of the equilibrium.
#[test]
fn a_towed_rod_has_the_critical_angle() {
    for (speed, angle) in [(0.5, 85.926_110), (1.0, 74.604_358), (2.0, 49.161_985)] {
        let current = format!("current = [{}, 0, 0]", -speed);
        let rest = "[joint.top]\ntype = \"spherical\"\na = \"ground\"\nb = \"rod.start\"\n\
                    [output.rod]\nat = \"rod.end\"\nquantities = [\"position\"]\n\
                    [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n";
        let simulation = start(&(rod("[-1, 0, -1]", "drag = [1.2, 0]", &current) + rest));
        let tip = vector(&simulation, "rod.position");
        let found = (-tip.z).atan2(-tip.x).to_degrees();
        assert!((found - angle).abs() < 1e-5, "{speed} m/s: {found}");
    }
}

/// A line of 100 m hangs in a current that falls with depth; the reference solves the equation of the line to 1e-12.
/// The error falls with the fourth power of the element.
#[test]
fn a_line_hangs_in_a_current() {
    let mut errors = Vec::new();
    for elements in [4, 8] {
        let keys = "drag = [1.2, 0.01]\ndrag_area = \"circumference\"";
        let text = water(GRAVITY, DENSITY, 0.0, "current = [\"1.5*exp(z/60)\", 0, 0]")
            + &section([2e7, 1e-3], 5.0, 0.05, keys)
            + &format!(
                "[beam.line]\nsection = \"round\"\nfrom = [0, 0, -100]\nto = [0, 0, 0]\nelements = {elements}\n\
                 [joint.top]\ntype = \"spherical\"\na = \"ground\"\nb = \"line.end\"\n\
                 [load.clump]\nat = \"line.start\"\nforce = [0, 0, -2000]\n\
                 [output.bottom]\nat = \"line.start\"\nquantities = [\"position\"]\n\
                 [output.top]\nat = \"top\"\nquantities = [\"reaction_force\"]\n\
                 [output.line]\nat = \"line.end\"\nquantities = [\"section_force\"]\n\
                 [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\n"
            );
        let simulation = start(&text);
        let bottom = vector(&simulation, "bottom.position");
        errors.push((bottom.x - 12.754_513_803).hypot(bottom.z + 98.604_912_160));
        let reaction = vector(&simulation, "top.reaction_force");
        // What the section transmits is what the joint bears, whatever the mesh.
        let section = vector(&simulation, "line.section_force");
        assert!((reaction.norm() - section.norm()).abs() < 1e-9 * reaction.norm());
    }
    println!("{errors:?} m");
    assert!(errors[0] < 2e-3 && errors[1] < 2e-4);
}

/// A section without drag is told where water may slow its beam: in a motion, and in a current. In an equilibrium of still
/// water it does not matter.
#[test]
fn missing_drag_is_told_where_it_matters() {
    let told = |water_keys: &str, analysis: &str| {
        let text = rod("[2, 0, 0]", "", water_keys) + &format!("[simulation]\nanalysis = \"{analysis}\"\nstop = 1\n");
        let found = notes(&Document::parse("m.toml", &text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}")));
        found.iter().filter(|own| own.contains("no `drag` and no `added_mass`")).count()
    };
    let cases =
        [("", "static"), ("current = [0.5, 0, 0]", "static"), ("current = [\"t\", 0, 0]", "static"), ("", "dynamic")];
    assert_eq!(cases.map(|(keys, analysis)| told(keys, analysis)), [0, 1, 1, 1]);
}
