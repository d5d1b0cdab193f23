//! `correction = true`: results without the error that the lengths of the steps have caused, and what a run then says
//! of the rest.

use super::time_error::{difference, estimate, oscillator, rows, shaft};
use crate::running::{start, try_start, value};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

/// The circular frequency of the oscillator, rad/s.
fn omega() -> f64 {
    1000.0_f64.sqrt()
}

/// The same times the length of a step of 5 ms.
const OMEGA_H: f64 = 0.158;

fn corrected(text: &str) -> String {
    format!("{text}correction = true\n")
}

/// The oscillator with velocities and energies.
fn told_of(step: &str) -> String {
    oscillator(step).replace("[\"displacement\"]", "[\"displacement\", \"velocity\", \"acceleration\"]")
}

/// The estimate knows the error to a share of `omega h`: derivatives lag by parts of a step, and it is damped a little.
/// So much of it may remain, and half the step leaves an eighth. Accelerations and momenta are as computed.
#[test]
fn an_oscillation_converges_with_order_three() {
    let exact = |name: &str| -> Vec<f64> {
        let phase = (1..=200).map(|row| omega() * 5e-3 * f64::from(row));
        let value = |phase: f64| match name {
            "P.velocity[3]" => phase.cos(),
            "energy.kinetic" => 0.5 * phase.cos().powi(2),
            _ => phase.sin() / omega(),
        };
        phase.map(value).collect()
    };
    for name in ["P.displacement[3]", "P.velocity[3]", "energy.kinetic"] {
        let error = |text: &str| difference(&rows(text, name, 5e-3, 1.0).0, &exact(name));
        let found = ["2.5e-3", "1.25e-3"].map(|step| {
            let text = told_of(step);
            let [plain, left] = [error(&text), error(&corrected(&text))];
            assert!(left < omega() * step.parse::<f64>().unwrap() * plain, "{name}, {step}: {left} of {plain}");
            left
        });
        assert!(found[0] / found[1] > 7.0, "{name}: {found:?}");
    }
    for name in ["P.acceleration[3]", "momentum.linear[3]"] {
        let text = told_of("2.5e-3");
        assert!(rows(&text, name, 5e-3, 0.5).0 == rows(&corrected(&text), name, 5e-3, 0.5).0, "{name} is changed");
    }
}

/// A shaft past its critical speed: with steps of 2 ms, 50 of them a turn of the whirl, a tenth of the error is left at
/// most, and no more is told than of the uncorrected motion, which is the same.
#[test]
fn a_whirling_shaft_is_corrected() {
    let name = "middle.displacement[2]";
    let run = |text: &str| rows(text, name, 8e-3, 1.2);
    let (exact, _) = run(&corrected(&shaft("2.5e-4")));
    let ((plain, other), (found, own)) = (run(&shaft("2e-3")), run(&corrected(&shaft("2e-3"))));
    let [before, after] = [&plain, &found].map(|rows| difference(rows, &exact));
    assert!(after < 0.1 * before, "{after} of {before}");
    let [told, of_plain] = [&own, &other].map(|run| estimate(run, "middle.displacement"));
    assert!(told > after && told <= of_plain, "{told} of {of_plain}, in truth {after}");
    assert_eq!(own.state().q, other.state().q);
}

/// A clamped beam that falls under its weight: vibrations that no step resolves. The told error of the motion is at
/// least a third of the true one, as of an oscillation, with coarse and with fine steps; that of accelerations is the
/// one of the uncorrected run.
#[test]
fn the_remainder_is_told() {
    let file = format!("{}/models/cantilever.toml", env!("CARGO_MANIFEST_DIR"));
    let model = std::fs::read_to_string(file).expect("the model");
    let cantilever = |step: &str| model.replace("\nstep = 1e-3", &format!("\nstep = {step}"));
    assert_ne!(cantilever("2e-3"), model);
    let cases = [
        ("P.displacement", 3, told_of("5e-3"), told_of("1.5625e-4"), 1e-2),
        ("P.velocity", 3, told_of("1.25e-3"), told_of("1.5625e-4"), 1e-2),
        ("tip.displacement", 3, cantilever("2e-3"), cantilever("1.25e-4"), 2e-3),
        ("tip.velocity", 3, cantilever("2e-3"), cantilever("1.25e-4"), 2e-3),
    ];
    for (family, component, coarse, fine, interval) in cases {
        let run = |text: &str| rows(text, &format!("{family}[{component}]"), interval, 0.6);
        let ((found, simulation), (exact, _)) = (run(&corrected(&coarse)), run(&fine));
        let (truth, told) = (difference(&found, &exact), estimate(&simulation, family));
        assert!(told > truth / 3.0, "{family}: {told} instead of {truth}");
    }
    let of_rough = |text: &str| estimate(&rows(text, "P.velocity[3]", 1e-2, 0.6).1, "P.acceleration");
    assert_eq!(of_rough(&corrected(&told_of("5e-3"))), of_rough(&told_of("5e-3")));
}

/// A bar that swings, 10 rad/s at first, and is caught on a row: its quaternion is one of a rotation, and its corrected
/// velocity stops with it.
#[test]
fn rotations_and_impacts_are_kept() {
    let text = "format = 1\n[model]\nname = \"Caught\"\ngravity = [0, 0, -9.81]\n[body.bar]\nmass = 2\nposition = [0.5, 0, 0]\n\
         inertia = [0.001, 0.17, 0.17]\nangular_velocity = [0, 10, 0]\nvelocity = [0, 0, -5]\n[joint.hinge]\ntype = \"revolute\"\na = \"ground\"\n\
         b = \"bar\"\nat = [0, 0, 0]\naxis = [0, 1, 0]\n[lock.catch]\njoint = \"hinge\"\ncoordinate = \"angle\"\nactive = \"t >= 0.6\"\n\
         [output.motion]\nat = \"bar\"\nquantities = [\"quaternion\"]\n[output.turn]\nat = \"hinge\"\nquantities = [\"angle_rate\"]\n\
         [simulation]\nstop = 1\nstep = 0.02\n";
    let mut simulation = start(&corrected(text));
    let mut differs = false;
    for row in 1..=40 {
        simulation.advance(0.02 * f64::from(row)).unwrap_or_else(|failure| panic!("{}", failure.message));
        let square: f64 = (1..=4).map(|part| value(&simulation, &format!("motion.quaternion[{part}]")).powi(2)).sum();
        assert!((square - 1.0).abs() < 1e-14, "row {row}: {square}");
        differs |= estimate(&simulation, "motion.quaternion") > 1e-3;
        if row >= 30 {
            let rate = value(&simulation, "turn.angle_rate");
            assert!(rate.abs() < 1e-12, "row {row}: {rate}");
        }
    }
    assert!(differs, "there is something to correct");
}

/// After three periods of 20 steps each the phase is lost: a linear estimate of the error grows without bound, and its
/// correction would too.
#[test]
fn a_lost_phase_is_left_alone() {
    let text = oscillator("1e-2").replace("stop = 1\n", "stop = 20\n");
    let (found, simulation) = rows(&corrected(&text), "P.displacement[3]", 1e-2, 20.0);
    let largest = found.iter().fold(0.0_f64, |most, own| most.max(own.abs())) * omega();
    // Where half of an error of 0.3 of the range of 2 is taken out.
    assert!(largest < 1.0 + 0.3, "{largest} times the amplitude");
    assert!(estimate(&simulation, "P.displacement") > 0.5);
}

/// What a run says of its results and of their errors, as bits.
fn told(simulation: &Simulation) -> (Vec<u64>, Vec<u64>) {
    let values = (0..simulation.variables().len()).map(|place| simulation.value(place).number().to_bits());
    (values.collect(), simulation.estimated_errors().iter().map(|own| own.error.to_bits()).collect())
}

/// A run that goes back to a saved state, whose step fails, or that is looked at on the way tells the same bits.
#[test]
fn what_is_told_follows_from_the_state() {
    let text = corrected(&told_of("5e-3"));
    let (_, mut simulation) = rows(&text, "P.displacement[3]", 1e-2, 0.3);
    let snapshot = simulation.snapshot();
    let bytes = simulation.write(&snapshot, Vec::new());
    let before = told(&simulation);
    let finish = |simulation: &mut Simulation| {
        (31..=50).for_each(|row| simulation.advance(f64::from(row) * 1e-2).expect("a step"));
        told(simulation)
    };
    let straight = finish(&mut simulation);
    simulation.restore(&snapshot);
    assert!(told(&simulation) == before, "going back");
    // Far too many steps for one call.
    assert!(simulation.advance(1e8).is_err());
    assert!(told(&simulation) == before, "a step that is refused");
    assert!(finish(&mut simulation) == straight, "after going back");
    let mut other = start(&text);
    let read = other.read(&bytes).expect("a state");
    other.restore(&read);
    assert!(finish(&mut other) == straight, "from bytes");
    for row in 51..=60 {
        other.begin_step(f64::from(row) * 1e-2).expect("a step");
        while !other.take_part().expect("a part") {
            other.look_between().expect("a look");
            let phase = omega() * other.state().time;
            let left = (omega() * value(&other, "P.displacement[3]") - phase.sin()).abs();
            assert!(left < OMEGA_H * phase * OMEGA_H.powi(2) / 12.0, "{left} is left at {phase} rad");
        }
        simulation.advance(f64::from(row) * 1e-2).expect("a step");
    }
    assert!(told(&simulation) == told(&other), "parts");
    let last = value(&simulation, "P.displacement[3]");
    simulation.conclude();
    assert_eq!(value(&simulation, "P.displacement[3]"), last, "the end");
}

/// A corrected run warns of what is left only.
#[test]
fn a_corrected_run_is_silent() {
    let warns = |text: &str| {
        let (_, mut simulation) = rows(text, "P.displacement[3]", 5e-3, 1.0);
        simulation.conclude();
        simulation.take_warnings().iter().any(|line| line.contains("because of the length of the steps"))
    };
    let text = oscillator("2.5e-3");
    assert_eq!([warns(&text), warns(&corrected(&text))], [true, false]);
}

/// Elements of ANCF24 tell no error, nor does a spectral radius near 1, which a parameter may give.
#[test]
fn motions_without_an_estimate_are_refused() {
    let file = format!("{}/models/cantilever.toml", env!("CARGO_MANIFEST_DIR"));
    let model = std::fs::read_to_string(file).expect("the model");
    let of_ancf24 = corrected(&model).replacen("elements", "element = \"ancf24\"\nelements", 1);
    let undamped = corrected(&model).replace("[simulation]", "[simulation]\nspectral_radius = 0.97");
    for text in [of_ancf24, undamped] {
        let told = try_start(&text).map(|_| ()).unwrap_err();
        assert!(told.contains("cannot be corrected") && told.contains("remove simulation.correction"), "{told}");
    }
}
