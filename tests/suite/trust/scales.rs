//! Any system of units, any size: the equations are the same but for factors, so the results must be too. Whatever
//! compares kilograms with kilogram square meters, or a number with a smallest one, breaks this.

use crate::curves::Curves;
use crate::running::start;
use ancf14::fmi::{Model, Value};
use ancf14::model::modes::Kind;
use ancf14::model::simulation::Simulation;

const LINKAGE: &str = include_str!("../../../models/four_bar.toml");

/// Elastic energy of the four-bar linkage with every length and every time multiplied by `scale`, over the third power
/// of it, J: stresses and speeds stay as they are.
fn scaled(scale: f64) -> f64 {
    let mut text = String::new();
    for line in LINKAGE.lines() {
        let is_length = ["from", "to", "width", "height", "radius", "at"].iter().any(|key| {
            line.strip_prefix(key).is_some_and(|rest| rest.trim_start().starts_with('=') && !rest.contains('"'))
        });
        text += &match line.split_once('=').filter(|_| is_length) {
            None => line.to_owned(),
            Some((key, value)) => {
                let value = value.split('#').next().unwrap().trim();
                let times = |number: &str| format!("{:e}", number.trim().parse::<f64>().unwrap() * scale);
                match value.strip_prefix('[').and_then(|list| list.strip_suffix(']')) {
                    Some(list) => format!("{key}= [{}]", list.split(',').map(times).collect::<Vec<_>>().join(", ")),
                    None => format!("{key}= {}", times(value)),
                }
            }
        };
        text.push('\n');
    }
    let times = [("simulation.stop", 2.0), ("simulation.step", 0.02), ("simulation.output_step", 0.1)];
    let mut overrides = times.map(|(key, time)| (key, format!("{:e}", time * scale))).to_vec();
    overrides.push(("speed", format!("{:e}", 0.6 / scale)));
    let overrides: Vec<(&str, &str)> = overrides.iter().map(|(key, value)| (*key, value.as_str())).collect();
    let curves = Curves::run(&text, &overrides);
    assert_eq!(curves.last("statistics.rejected"), 0.0);
    curves.last("energy.elastic") / scale.powi(3)
}

/// Down to bars of ten nanometers and up to bars of ten thousand kilometers. Newton ends at 1e-8 of the size, far below
/// the bending of some hundredths; a step more or less of it, and 100 steps, leave less than 1e-4 of the energy.
#[test]
fn regression_a_linkage_runs_at_any_size() {
    let full = scaled(1.0);
    for scale in [1e-7, 1e-6, 1e-5, 1e-3, 1e5, 1e8] {
        let own = scaled(scale);
        println!("scale {scale:e}: {:.2e} apart", own / full - 1.0);
        assert!((own / full - 1.0).abs() < 1e-4, "{scale:e}: {own} {full}");
    }
}

/// A rate that fades through the numbers at which doubles lose their digits, 1e-308 to 5e-324, and through them again.
#[test]
fn regression_a_motion_may_fade_away() {
    let text = "format = 1\n[model]\nname = \"Bell\"\n[body.b]\nmass = 1\nposition = [0.3, 0, 0]\ninertia = [1, 1, 1]\n\
                [joint.j]\ntype = \"revolute\"\na = \"ground\"\nb = \"b\"\nat = [0, 0, 0]\naxis = [0, 0, 1]\n\
                [drive.m]\njoint = \"j\"\ncoordinate = \"angle\"\nrate = \"exp(-100000*(t - 0.1)^2)\"\n\
                [output.J]\nat = \"j\"\nquantities = [\"angle\"]\n[simulation]\nstop = 0.3\nstep = 1e-3\n";
    let curves = Curves::run(text, &[]);
    // The integral of the whole bell, √(π/100000).
    let whole = (std::f64::consts::PI / 1e5).sqrt();
    assert!((curves.last("J.angle") / whole - 1.0).abs() < 1e-9);
    assert_eq!(curves.last("statistics.rejected"), 0.0);
}

/// Modes of a cantilever 1e10 times as soft, or as heavy: the frequencies go with the root.
#[test]
fn modes_of_soft_and_heavy_beams_are_found() {
    // Without weight, whose stiffness does not scale.
    let model = &include_str!("../../../models/cantilever.toml").replace("-9.81", "0");
    let frequencies = |from: &str, to: &str| {
        let modes =
            start(&model.replace(from, to)).modes(6).unwrap_or_else(|failure| panic!("{}", failure.message)).modes;
        assert!(modes.iter().all(|mode| mode.kind == Kind::Vibration));
        modes.iter().map(|mode| mode.angular_frequency()).collect::<Vec<_>>()
    };
    let own = frequencies("", "");
    assert!(model.contains("young = 2.1e11") && model.contains("density = 7850"), "the replacements find nothing");
    for (from, to, factor) in [("young = 2.1e11", "young = 21", 1e5), ("density = 7850", "density = 7.85e13", 1e5)] {
        for (own, scaled) in own.iter().zip(frequencies(from, to)) {
            // The eigenvalues are known to 1e-10 of the vectors' errors squared, and to the round-off of the stiffness.
            assert!((scaled * factor / own - 1.0).abs() < 1e-9, "{to}: {own} {scaled}");
        }
    }
}

/// A thread of 0.2 mm and 300 m under its weight: round-off of its axial stiffness counts motions that release energy
/// at every shift that would be best.
#[test]
fn regression_modes_of_a_long_thread_are_found() {
    let text = "format = 1\n[model]\nname = \"Thread\"\ngravity = [0, 0, -9.81]\n[material.nylon]\nyoung = 2e9\npoisson = 0.4\ndensity = 1150\n\
                [section.thread]\nshape = \"circle\"\nradius = 1e-4\n\
                [beam.line]\nmaterial = \"nylon\"\nsection = \"thread\"\nfrom = [0, 0, 0]\nto = [300, 0, 0]\nelements = 20\n\
                [joint.left]\ntype = \"weld\"\na = \"ground\"\nb = \"line.start\"\n[simulation]\nstop = 1\nstep = 1e-2\n";
    let modes = start(text).modes(10).unwrap_or_else(|failure| panic!("{}", failure.message)).modes;
    // 3.516 sqrt(EI/(ρA))/L², with sqrt(EI/(ρA)) = r/2 sqrt(E/ρ); 20 elements are good to 1e-6, the round-off of the
    // stretch to 1e-3.
    let exact = 3.516 * 0.5e-4 * (2e9_f64 / 1150.0).sqrt() / (300.0 * 300.0);
    assert!((modes[0].angular_frequency() / exact - 1.0).abs() < 1e-3, "{} {exact}", modes[0].angular_frequency());
}

/// A beam, a body, a moving frame, a frame that a host moves, a spring to the ground: drawn `x0` away in all
/// directions, with the host's inputs moved along.
fn drawn_at(x0: f64) -> Vec<(String, f64)> {
    let text = format!(
        "format = 1\n[model]\nname = \"Far\"\ngravity = [0, 0, -9.81]\n[parameters]\nx0 = {x0:e}\n\
         [material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n[section.rod]\nshape = \"circle\"\nradius = 0.005\n\
         [beam.arm]\nmaterial = \"steel\"\nsection = \"rod\"\nfrom = [\"x0\", \"x0\", 0]\nto = [\"x0 + 1\", \"x0\", 0]\nelements = 4\n\
         [body.bob]\nmass = 1\nposition = [\"x0 + 1\", \"x0\", -0.5]\ninertia = [0.01, 0.01, 0.01]\n\
         [frame.table]\nposition = [\"x0 + 0.01*sin(20*t)\", \"x0\", 0]\n\
         [frame.hand]\ninput = true\nposition = [{:?}, {x0:?}, -1.5]\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
         [spring.shaker]\na = \"table\"\nb = \"bob\"\nstiffness = 20\n\
         [joint.pin]\ntype = \"spherical\"\na = \"arm.end\"\nb = \"bob\"\nat = [\"x0 + 1\", \"x0\", 0]\n\
         [spring.rope]\na = \"hand\"\nb = \"bob\"\nstiffness = 50\n\
         [output.bob_place]\nat = \"bob\"\nquantities = [\"position\", \"velocity\"]\n\
         [output.root_load]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
         [output.hand_load]\nat = \"hand\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
         [simulation]\nstop = 0.3\nstep = 1e-3\n",
        x0 + 1.0
    );
    let mut simulation = start(&text);
    let reference =
        |simulation: &Simulation, name: &str| simulation.variables().iter().position(|own| own.name == name).unwrap();
    for number in 1..=30 {
        let time = 0.01 * f64::from(number);
        let hand = reference(&simulation, "hand.position[2]");
        simulation
            .set_value(hand, Value::Real(x0 + 0.02 * (10.0 * time).sin()))
            .unwrap_or_else(|failure| panic!("{}", failure.message));
        simulation.advance(time).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
    let is_result = |name: &str| {
        ["bob_place", "root_load", "hand_load", "energy", "momentum.linear"].iter().any(|own| name.starts_with(own))
    };
    let variables = simulation.variables().iter().enumerate().filter(|(_, variable)| is_result(&variable.name));
    variables
        .map(|(place, variable)| {
            let moved = if variable.name == "bob_place.position[1]" || variable.name == "bob_place.position[2]" {
                x0
            } else {
                0.0
            };
            (variable.name.clone(), simulation.value(place).number() - moved)
        })
        .collect()
}

/// Map coordinates are millions of meters: positions kept from there would leave newtons of round-off in the axial
/// force of the rod.
#[test]
fn regression_far_from_the_origin_all_is_the_same() {
    let near = drawn_at(0.0);
    assert!(near.len() > 15);
    for x0 in [1e4, 1e6, 1e8] {
        for ((name, own), (_, near)) in drawn_at(x0).iter().zip(&near) {
            // The numbers of the file and of the host are rounded to 1e-16 x0; a host's moves by them in steps of 10
            // ms, twice differentiated, at 2 kg.
            let rounding = 1e-16 * x0;
            let bound = 1e-6 * near.abs().max(1.0) + 2.0 * rounding / 1e-4 + 50.0 * rounding;
            assert!((own - near).abs() < bound, "{x0:e}, {name}: {own} {near}");
        }
    }
}
