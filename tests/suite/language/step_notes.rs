//! Is a fixed step that cannot show what a model asks for told, and a sound one not? A wrong code is silent about a
//! load that the steps skip, or warns of pulses, corners and motions that the step is meant for.

use ancf14::fmi::Model;
use ancf14::model::document::Document;
use ancf14::model::file::{Folder, Reach};
use ancf14::model::notes::notes;
use ancf14::model::simulation::Simulation;
use ancf14::model::step_length::long_step;
use std::fs;
use std::path::{Path, PathBuf};

/// A mass of 2 kg on a spring of 5000 N/m, 50 rad/s: 0.1257 s.
fn oscillator(more: &str, settings: &str) -> String {
    format!(
        "format = 1\nmodel.name = \"M\"\n[body.bob]\nmass = 2\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n[joint.rail]\ntype = \"prismatic\"\na = \"ground\"\n\
         b = \"bob\"\naxis = [1, 0, 0]\nstiffness = 5000\n{more}\n[simulation]\nstop = 2\n{settings}\n"
    )
}

fn pushed(force: &str, step: &str) -> Vec<String> {
    let text = oscillator(&format!("[load.push]\nat = \"bob\"\nforce = [{force}, 0, 0]"), &format!("step = {step}"));
    notes(&Document::parse("m.toml", &text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// Loads with fewer than ten steps a period are told, with the step to write; those with eleven, single pulses, jumps,
/// squares of pieces and rows of a table are not.
#[test]
fn fast_loads_are_told() {
    let found = pushed("\"3*sin(2*pi*20*t)\"", "0.01");
    let expected = "m.toml, line 15: push.force[1] oscillates with a period of 5.00e-2 s, which is 5.0 steps of step = 0.01 s. An oscillation needs 10 steps or more: set step = 4.9e-3 or \
                    less, or leave `step` out, and the solver chooses its steps";
    // The period is found from samples: to 2 %.
    assert!(found.len() == 1, "{found:?}");
    let (told, wanted): (Vec<_>, Vec<_>) = (found[0].split(' ').collect(), expected.split(' ').collect());
    for (told, wanted) in told.iter().zip(&wanted) {
        let close = |told: f64, wanted: f64| (told / wanted - 1.0).abs() < 0.04;
        let is_close = told.parse().ok().zip(wanted.parse().ok()).is_some_and(|(a, b)| close(a, b));
        assert!(told == wanted || is_close, "{told} instead of {wanted} in {}", found[0]);
    }
    assert_eq!(told.len(), wanted.len());
    for (force, step) in [
        ("\"sin(2*pi*200*t)\"", "0.01"),
        ("\"sin(2*pi*1000*t)\"", "0.01"),
        ("\"5 + 0.1*cos(2*pi*11*t)\"", "0.01"),
        ("\"sin(2*pi*t^2*5)\"", "0.01"),
        ("\"exp(-((t - 1)/0.2)^2)*sin(2*pi*30*t)\"", "0.01"),
    ] {
        assert_eq!(pushed(force, step).len(), 1, "{force}");
    }
    for (force, step) in [
        ("\"3*sin(2*pi*20*t)\"", "0.0045"),
        ("\"3*sin(2*pi*20*t)\"", "0.0001"),
        ("\"exp(-((t - 1)/0.01)^2)\"", "0.01"),
        ("\"100*step(1, t)\"", "0.01"),
        ("\"t + 1e-3*sin(2*pi*20*t)\"", "0.01"),
        (
            "[{ until = 1, is = 1 }, { until = 1.01, is = 0 }, { until = 1.02, is = 1 }, { until = 1.03, is = 0 }, { is = 1 }]",
            "0.01",
        ),
        ("7", "0.01"),
    ] {
        assert_eq!(pushed(force, step), Vec::<String>::new(), "{force}");
    }
    let rows = (0..200).map(|k| format!("[{}, {}]", 0.01 * f64::from(k), k % 2)).collect::<Vec<_>>().join(", ");
    let table = |interpolation: &str| {
        let more = format!(
            "[function.gust]\ntable = [{rows}]\ninterpolation = \"{interpolation}\"\n[load.push]\nat = \"bob\"\nforce = [\"gust(t)\", 0, 0]"
        );
        notes(&Document::parse("m.toml", &oscillator(&more, "step = 0.01"), &[]).unwrap()).len()
    };
    assert_eq!([table("linear"), table("monotone")], [0, 1]);
}

/// The slowest vibration decides, and only where vibrations are all that the mechanism can do.
#[test]
fn a_step_that_shows_no_vibration_is_told() {
    let told = |more: &str, settings: &str| {
        let text = oscillator(more, settings);
        let mut simulation =
            Simulation::load("m.toml", &text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
        simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        long_step(&simulation)
    };
    let expected = "m.toml, line 16: simulation.step = 0.02 s resolves no vibration: the slowest one has a period of 1.26e-1 s, 6.3 steps. The results are those of a motion without \
                    vibrations. If vibrations matter, set step = 1.2e-2 or less, or leave `step` out, and the solver chooses its steps";
    assert_eq!(told("", "step = 0.02").as_deref(), Some(expected));
    let free = "[body.ball]\nmass = 1\nposition = [1, 0, 0]\ninertia = [1, 1, 1]";
    let drive = "[body.ball]\nmass = 1\nposition = [1, 0, 0]\ninertia = [1, 1, 1]\n[joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"ball\"\n\
                 axis = [0, 0, 1]\n[drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nvalue = \"t\"";
    for (more, settings) in [
        ("", "step = 0.0125"),
        ("", "output_step = 0.02"),
        ("", "step = 0.02\nanalysis = \"static\""),
        (free, "step = 0.02"),
        (drive, "step = 0.02"),
    ] {
        assert_eq!(told(more, settings), None, "{more} {settings}");
    }
}

/// The period of the slowest mode of a large mechanism is found by a few sweeps, and told as a bound. Of a slender
/// cantilever it is `2 pi/3.516 sqrt(density area length⁴/(young I))` (Bernoulli); shear is left out here as there, and
/// the rotary inertia of a section of 1/100 of the length adds less than 1e-4. The sweeps end where they change the
/// square of the frequency by 1e-4.
#[test]
fn the_period_of_a_large_mechanism_is_told_as_a_bound() {
    let text = r#"
format = 1
model = { name = "Reed" }
material.steel = { young = 210e9, poisson = 0.3, density = 7800 }
section.square = { shape = "rectangle", width = 1e-3, height = 1e-3 }
beam.reed = { material = "steel", section = "square", from = [0, 0, 0], to = [0.1, 0, 0], elements = 2100 }
joint.root = { type = "weld", a = "ground", b = "reed.start" }
simulation = { stop = 1, step = 0.01 }
"#;
    let mut simulation = Simulation::load("m.toml", text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let note = long_step(&simulation).unwrap();
    let told = note.split("a period of about ").nth(1).unwrap().split(' ').next().unwrap();
    let (area, inertia): (f64, f64) = (1e-6, 1e-12 / 12.0);
    let expected = std::f64::consts::TAU / 3.516 * (7800.0 * area * 1e-4 / (210e9 * inertia)).sqrt();
    let told: f64 = told.parse().unwrap();
    // The text has three digits.
    assert!((told / expected - 1.0).abs() < 5e-3, "{told} {expected}");
}

/// None of the models of the release, nor of the machines of the tests, has a step that is too long.
#[test]
fn steps_of_the_models_are_not_told() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = ["models", "tests/machines"].map(|folder| fs::read_dir(root.join(folder)).unwrap());
    let files: Vec<PathBuf> = files.into_iter().flatten().map(|entry| entry.unwrap().path()).collect();
    let models = files.iter().filter(|path| path.extension().is_some_and(|own| own == "toml"));
    let mut count = 0;
    for path in models {
        let text = fs::read_to_string(path).unwrap();
        let name = path.file_name().unwrap().to_string_lossy();
        let simulation =
            Simulation::load_in(path.parent().map(|path| Folder::new(path, Reach::Inside)), &name, &text, &[]);
        // A part of another model has no [model].
        let Ok(mut simulation) = simulation else { continue };
        let found = notes(simulation.document());
        assert!(found.iter().all(|note| !note.contains("oscillates")), "{name}: {found:?}");
        simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{name}: {}", failure.message));
        assert_eq!(long_step(&simulation), None, "{name}");
        count += 1;
    }
    assert!(count > 30, "{count} models");
}
