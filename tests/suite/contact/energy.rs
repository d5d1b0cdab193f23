//! Contact takes and gives as much energy as it stores, and conserves momentum.

use crate::running::{run, start, value, vector};

/// A beam of 0.5 kg/m and 0.2 MN, tilted by 0.1 rad, which falls by 0.1 m onto a plane.
fn falling(stiffness: f64, step: f64, spectral_radius: f64) -> String {
    format!(
        "format = 1\n[model]\nname = \"Falling\"\ngravity = [0, 0, -9.81]\n\
         [section.s]\nshape = \"rigidities\"\nEA = 2e5\nEI_y = 2\nEI_z = 2\nGJ = 2\nline_density = 0.5\n\
         [beam.bar]\nsection = \"s\"\nfrom = [0, 0, 0.1]\nto = [\"cos(0.1)\", 0, \"0.1 + sin(0.1)\"]\nelements = 8\n\
         [surface.floor]\nshape = \"plane\"\nnormal = [0, 0, 1]\n\
         [contact.landing]\nof = \"bar\"\nwith = \"floor\"\nstiffness = {stiffness}\n\
         [simulation]\nstop = 1\nstep = {step}\nspectral_radius = {spectral_radius}\ntotals = [\"energy\"]\n"
    )
}

/// Without dissipation the energy stays, through all impacts, for contacts from soft to far too stiff for the step: what
/// is left are the third-order terms of elastic forces, which the beam has without contact too. With numerical
/// dissipation it never rises.
#[test]
fn a_bouncing_beam_gains_nothing() {
    for (stiffness, step) in [(1e4, 2e-3), (1e4, 1e-3), (1e6, 1e-3), (1e8, 1e-3), (1e8, 2e-3)] {
        for (spectral_radius, bound) in [(1.0, 1e-3), (0.9, 1e-9)] {
            let mut simulation = start(&falling(stiffness, step, spectral_radius));
            let energy = |own: &_| value(own, "energy.total");
            let (begin, mut largest, mut least) = (energy(&simulation), 0.0_f64, f64::INFINITY);
            run(&mut simulation, 0.02, 1.0, |own| {
                largest = largest.max(energy(own));
                least = least.min(energy(own));
            });
            let gain = largest / begin - 1.0;
            assert!(gain < bound, "{stiffness:e} N/m2, {step} s, {spectral_radius}: {gain:e}");
            if spectral_radius == 1.0 {
                assert!(least / begin - 1.0 > -bound, "{stiffness:e} N/m2, {step} s: {least} of {begin}");
            }
        }
    }
}

/// A beam thrown against a free wheel that turns, also with friction: both momenta stay, and the energy is what friction
/// leaves. Friction turns sections by their turn in the middle of the step, which is that over the step to the square of
/// its angle, 1e-3 rad.
#[test]
fn momentum_stays() {
    let text = "format = 1\n[model]\nname = \"Thrown\"\ngravity = [0, 0, 0]\n\
        [section.s]\nshape = \"rigidities\"\nEA = 2e4\nEI_y = 2\nEI_z = 2\nGJ = 1\nline_density = 0.5\n\
        [beam.bar]\nsection = \"s\"\nfrom = [-0.5, 0.02, 0.061]\nto = [0.5, 0.0, 0.061]\nelements = 8\n\
        velocity = [0.3, 0.1, -0.9]\n\
        [body.wheel]\nmass = 1.5\nposition = [0, 0, 0]\ninertia = [0.002, 0.003, 0.002]\n\
        angular_velocity = [0.5, 20, 1]\n\
        [surface.post]\non = \"wheel\"\nshape = \"cylinder\"\naxis = [0, 1, 0]\nradius = 0.05\n\
        [contact.hit]\nof = \"bar\"\nwith = \"post\"\nstiffness = 1e6\nradius = 0.01\nFRICTION\n\
        [output.load]\nat = \"hit\"\nquantities = [\"normal_force\"]\n\
        [simulation]\nstop = 0.2\nstep = 5e-4\nspectral_radius = 1\ntotals = [\"energy\", \"work\", \"momentum\"]\n";
    for (friction, bound) in [("", 1e-9), ("friction = 0.3", 1e-6)] {
        let mut simulation = start(&text.replace("FRICTION", friction));
        let momenta = |own: &_| ["momentum.linear", "momentum.angular"].map(|name| vector(own, name));
        let begin = momenta(&simulation);
        let (mut touched, energy) = (false, value(&simulation, "energy.total"));
        run(&mut simulation, 0.01, 0.2, |own| {
            touched |= value(own, "load.normal_force") > 0.0;
            for (now, before) in momenta(own).iter().zip(&begin) {
                assert!((now - before).norm() < bound * before.norm(), "{friction}: {now:?} {before:?}");
            }
        });
        assert!(touched);
        let drift = value(&simulation, "work.drift");
        assert!(drift.abs() < 2e-3 * energy, "{friction}: {drift:e} of {energy}");
        assert!((value(&simulation, "work.dissipated") > 1e-3 * energy) != friction.is_empty());
    }
}
