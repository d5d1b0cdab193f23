//! Claims of accuracy that were not true: of loads that travel, of steps that the file gives, of vibrations that the
//! steps damp away, of equilibria far from the origin. A wrong code tells errors ten or a thousand times too small, and warns of nothing.

use super::refinement::repeated;
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use std::f64::consts::PI;

/// A load that travels along a wire bends it at a kink, which no mesh resolves with its full order: three meshes show
/// how the error falls, and the claim is true. The order of smooth motions claimed 0.25 % for 1 %.
///
/// The reference is the sum of the modes of a pinned wire under tension; 10 N change the tension by 1e-5 of itself.
#[test]
fn kinks_of_traveling_loads_are_told() {
    let text = "format = 1\nmodel = { name = \"Wire\" }\n\
                section.wire = { shape = \"rigidities\", EA = 1.45e7, EI_y = 139, EI_z = 139, GJ = 104, line_density = 1.08 }\n\
                beam.wire = { section = \"wire\", from = [0, 0, 0], to = [60, 0, 0], pretension = 2e4 }\n\
                joint.a = { type = \"universal\", a = \"ground\", b = \"wire.start\", axis = [0, 1, 0], axis2 = [0, 0, 1] }\n\
                joint.b = { type = \"universal\", a = \"ground\", b = \"wire.end\", axis = [0, 1, 0], axis2 = [0, 0, 1] }\n\
                load.pantograph = { on = \"wire\", station = \"40*t/60\", force = [0, 0, 10] }\n\
                output.middle = { at = \"wire@0.5\", quantities = [\"displacement\"] }\n\
                simulation = { stop = 1, output_step = 0.01 }\n";
    let reference = |time: f64| -> f64 {
        let mode = |n: u32| {
            let k = f64::from(n) * PI / 60.0;
            let (own, forced) = (((2e4 * k * k + 139.0 * k.powi(4)) / 1.08).sqrt(), 40.0 * k);
            let size = 2.0 * 10.0 / (1.08 * 60.0) / (own * own - forced * forced);
            size * ((forced * time).sin() - forced / own * (own * time).sin()) * (30.0 * k).sin()
        };
        (1..2000).map(mode).sum()
    };
    let (rows, outcome, _) = repeated(text, &["middle.displacement[3]"], None);
    let range = rows.iter().map(|row| row.values[0]).fold(0.0, f64::max);
    let error = rows.iter().map(|row| (row.values[0] - reference(row.time)).abs()).fold(0.0, f64::max) / range;
    let claim = outcome.worst.as_ref().map_or(0.0, |worst| worst.error);
    println!("{}: {error:.2e} of {range}", outcome.line());
    assert!(error < 0.01 && error < 3.0 * claim, "{error} {outcome:?}");
}

/// Steps that the file gives stay, and so does their error: the runs reach the accuracy of the mesh alone, and say so.
/// The load has seven steps in a period. The last run told nothing of them.
#[test]
fn errors_of_given_steps_are_told_after_repetitions() {
    let text = "format = 1\nmodel = { name = \"Strip\" }\n\
                section.strip = { shape = \"rigidities\", EA = 1.7e7, EI_y = 140, EI_z = 22, GJ = 30, line_density = 0.63 }\n\
                beam.arm = { section = \"strip\", from = [0, 0, 0], to = [1, 0, 0] }\n\
                joint.root = { type = \"weld\", a = \"ground\", b = \"arm.start\" }\n\
                load.push = { at = \"arm.end\", force = [0, 0, \"0.01*sin(3000*t)\"] }\n\
                output.tip = { at = \"arm.end\", quantities = [\"velocity\"] }\n\
                simulation = { stop = 0.1, step = 3e-4, output_step = 3e-3 }\n";
    let (_, outcome, mut simulation) = repeated(text, &["tip.velocity[3]"], None);
    let line = outcome.line();
    assert!(outcome.keeps_steps && outcome.runs > 1 && line.contains("accuracy of the mesh"), "{line}");
    let warnings = simulation.take_warnings();
    assert!(warnings.iter().any(|own| own.contains("because of the length of the steps")), "{line} {warnings:?}");
}

/// A bar that is thrown turning rings along its axis for ever: nothing in the model damps it. Steps of a half and of a
/// quarter of a period lose the vibration within five rows, the first twentieth of them, and agree in all others. Rows
/// that follow each other may not be off; they were left out with the jumps of single rows, and 0.42 % was claimed for
/// a force that is lost altogether.
#[test]
fn vibrations_that_all_runs_lose_are_told() {
    let text = "format = 1\nmodel = { name = \"Thrown\", gravity = [0, 0, 0] }\n\
                material.matter = { young = 2.1e11, poisson = 0.3, density = 7850 }\n\
                section.bar = { shape = \"rectangle\", width = 5.06e-7, height = 5.06e-7 }\n\
                beam.rod = { material = \"matter\", section = \"bar\", from = [0, 0, 0], to = [1.96e-5, 0, 0], \
                velocity = [0, 2.3324, 0], angular_velocity = [0, 1.19e5, 1.19e6] }\n\
                output.middle = { at = \"rod@0.5\", quantities = [\"section_force\"] }\n\
                simulation = { stop = 1.152e-5, output_step = 9.6e-8 }\n";
    let (rows, outcome, _) = repeated(text, &["middle.section_force[1]"], None);
    let forces: Vec<f64> = rows.iter().map(|row| row.values[0]).collect();
    let late = &forces[forces.len() / 2..];
    let [low, high] = [f64::min, f64::max].map(|pick| late.iter().copied().reduce(pick).unwrap());
    // The true force goes from 0 to twice its mean.
    let lost = 1.0 - (high - low) / (high + low);
    let claim = outcome.worst.as_ref().map_or(0.0, |worst| worst.error);
    println!("{}: {lost} of the vibration is lost", outcome.line());
    assert!(lost < 0.01 || claim > 0.01, "{lost} {outcome:?}");
}

/// An equilibrium is judged by itself, wherever the file puts the origin: the elastic energy is not lost in that of the
/// height, nor the sag in the coordinates.
#[test]
fn equilibria_are_judged_alike_far_from_the_origin() {
    let worst = |place: &str| {
        let text = format!(
            "format = 1\nmodel = {{ name = \"Strip\", gravity = [0, 0, -9.81] }}\n\
             section.strip = {{ shape = \"rigidities\", EA = 1e7, EI_y = 1, EI_z = 1, GJ = 1, line_density = 1 }}\n\
             beam.strip = {{ section = \"strip\", from = [0, 0, {place}], to = [1, 0, {place}], elements = 2 }}\n\
             joint.clamp = {{ type = \"weld\", a = \"ground\", b = \"strip.start\" }}\n\
             output.tip = {{ at = \"strip.end\", quantities = [\"position\"] }}\n\
             simulation = {{ analysis = \"static\", stop = 1 }}\n"
        );
        let mut simulation = Simulation::load("strip.toml", &text, &[]).unwrap();
        simulation.initialize(0.0).unwrap();
        simulation.advance(1.0).unwrap();
        simulation.conclude();
        simulation.mesh_errors().to_vec()
    };
    let [near, far] = [worst("0"), worst("1e5")];
    assert!(near.len() == 2 && near.iter().all(|error| error.error > 1e-3), "{near:?}");
    for (near, far) in near.iter().zip(&far) {
        // A position is compared with its own 0.7 m near the origin, and with twice the size of 1 m far from there.
        let ratio = far.error / near.error;
        assert!(near.name == far.name && (0.3..1.1).contains(&ratio), "{near:?} {far:?}");
    }
}
