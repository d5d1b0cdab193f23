//! Friction of contacts: what slides stops, what stands stands for ever, what is round rolls.

use crate::running::{run, start, value};

/// A stiff bar of 5 kg on a plane, pressed in as far as its weight takes it.
fn bar(gravity: &str, velocity: f64, step: f64, surface: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Bar\"\ngravity = {gravity}\n\
         [section.s]\nshape = \"rigidities\"\nEA = 2e6\nEI_y = 2e3\nEI_z = 2e3\nGJ = 2e3\nline_density = 5\n\
         [beam.bar]\nsection = \"s\"\nfrom = [0, 0, -4.905e-5]\nto = [1, 0, -4.905e-5]\nelements = 2\n\
         velocity = [{velocity}, 0, 0]\n\
         [frame.belt]\nposition = [\"0.5*t\", 0, 0]\n\
         [surface.floor]\nshape = \"plane\"\nnormal = [0, 0, 1]\n{surface}\n\
         [contact.base]\nof = \"bar\"\nwith = \"floor\"\nstiffness = 1e6\nradius = 0\nfriction = 0.3\n\
         [output.middle]\nat = \"bar@0.5\"\nquantities = [\"displacement\", \"velocity\"]\n\
         [output.load]\nat = \"base\"\nquantities = [\"reaction_force\", \"friction_force\", \"sliding\"]\n\
         [simulation]\nstop = 2\nstep = {step}\ntotals = [\"energy\", \"work\"]\n"
    )
}

/// It stops after `v²/(2 μ g)`, less the elastic way `μ N/k` of 1.5e-5 m, to a thousandth.
#[test]
fn a_bar_slides_and_stops() {
    for step in [1e-2, 2.5e-3] {
        let mut simulation = start(&bar("[0, 0, -9.81]", 1.0, step, ""));
        run(&mut simulation, 0.01, 1.0, |_| {});
        let (way, exact) = (value(&simulation, "middle.displacement[1]"), 1.0 / (2.0 * 0.3 * 9.81));
        assert!((way / exact - 1.0).abs() < 1e-3, "{step}: {way} {exact}");
        assert!(value(&simulation, "middle.velocity[1]").abs() < 1e-9);
        assert_eq!(value(&simulation, "load.sliding"), 0.0);
        let taken = value(&simulation, "work.dissipated");
        assert!((taken / 2.5 - 1.0).abs() < 1e-4, "{taken}");
    }
}

/// On a slope of 0.2 rad it moves by the elastic way `g sin α M/(k L)` and not any farther.
#[test]
fn a_bar_holds_on_a_slope() {
    let mut simulation = start(&bar("[\"9.81*sin(0.2)\", 0, \"-9.81*cos(0.2)\"]", 0.0, 1e-2, ""));
    run(&mut simulation, 0.5, 2.0, |_| {});
    let (way, exact) = (value(&simulation, "middle.displacement[1]"), 9.81 * 0.2_f64.sin() * 5.0 / 1e6);
    // It is drawn as pressed in by its whole weight, and bounces by a fiftieth of that.
    assert!((way / exact - 1.0).abs() < 1e-2, "{way:e} {exact:e}");
    assert!(value(&simulation, "middle.velocity[1]").abs() < 1e-8);
}

/// A belt takes it along: work of the belt is twice the kinetic energy that it gives, half of which friction takes.
#[test]
fn a_belt_takes_it_along() {
    let mut simulation = start(&bar("[0, 0, -9.81]", 0.0, 1e-3, "on = \"belt\""));
    run(&mut simulation, 0.05, 0.5, |_| {});
    assert!((value(&simulation, "middle.velocity[1]") - 0.5).abs() < 1e-6);
    let [given, taken, drift] = ["work.drives", "work.dissipated", "work.drift"].map(|name| value(&simulation, name));
    // μ N/k of the elastic way is a thousandth of the way of sliding.
    assert!((given / 1.25 - 1.0).abs() < 1e-3 && (taken / 0.625 - 1.0).abs() < 4e-3, "{given} {taken}");
    assert!(drift.abs() < 1e-6, "{drift:e}");
}

/// A solid bar and a tube roll down a slope, as friction turns their sections; thrown, a bar slides until it rolls.
#[test]
fn round_bars_roll() {
    let model = |section: &str, gravity: &str, velocity: f64| {
        format!(
            "format = 1\n[model]\nname = \"Rolling\"\ngravity = {gravity}\n\
             [material.steel]\nyoung = 2e9\npoisson = 0.3\ndensity = 8000\n\
             [section.s]\n{section}\n\
             [beam.bar]\nsection = \"s\"\nmaterial = \"steel\"\nfrom = [0, 0, 0.02]\nto = [0, 0.5, 0.02]\nelements = 2\n\
             y_axis = [0, 0, 1]\nvelocity = [{velocity}, 0, 0]\n\
             [surface.slope]\nshape = \"plane\"\nnormal = [0, 0, 1]\n\
             [contact.rolling]\nof = \"bar\"\nwith = \"slope\"\nfriction = 0.3\n\
             [output.middle]\nat = \"bar@0.5\"\nquantities = [\"velocity\", \"angular_velocity\"]\n\
             [simulation]\nstop = 0.5\nstep = 1e-3\n"
        )
    };
    let slope = "[\"9.81*sin(0.2)\", 0, \"-9.81*cos(0.2)\"]";
    let fall = 9.81 * 0.2_f64.sin();
    for (section, inertia) in [
        ("shape = \"circle\"\nradius = 0.02", 0.5),
        ("shape = \"tube\"\nouter = 0.02\ninner = 0.019", 0.5 * (1.0 + 0.95 * 0.95)),
    ] {
        let mut simulation = start(&model(section, slope, 0.0));
        run(&mut simulation, 0.05, 0.5, |_| {});
        let (found, exact) = (value(&simulation, "middle.velocity[1]"), 0.5 * fall / (1.0 + inertia));
        // It begins above the surface by as much as its weight presses it in, and bounces a little.
        assert!((found / exact - 1.0).abs() < 1e-3, "{section}: {found} {exact}");
    }
    let mut simulation = start(&model("shape = \"circle\"\nradius = 0.02", "[0, 0, -9.81]", 1.0));
    run(&mut simulation, 0.05, 0.3, |_| {});
    let [speed, spin] = ["middle.velocity[1]", "middle.angular_velocity[2]"].map(|name| value(&simulation, name));
    assert!((speed - 2.0 / 3.0).abs() < 1e-4 && (0.02 * spin - 2.0 / 3.0).abs() < 1e-4, "{speed} {spin}");
}
