//! Does a motion with `initial = "steady"` begin as the rotation that its drive makes, without a vibration?

use crate::running::{run, start, try_start, value};
use ancf14::fmi::Model;

const OMEGA: f64 = 20.0;
const LENGTH: f64 = 6.0;
const STIFFNESS: f64 = 6.3e8;
const DENSITY: f64 = 24.3;
const STEP: f64 = 1e-3;

/// A blade that turns at `OMEGA`; `rest` are more sections.
fn blade(initial: &str, rest: &str) -> String {
    format!(
        "format = 1\nmodel = {{ name = \"Blade\", gravity = [0, 0, 0] }}\n\
         section.spar = {{ shape = \"rigidities\", EA = {STIFFNESS}, EI_y = 1e5, EI_z = 1e6, GJ = 1e5, \
         line_density = {DENSITY} }}\n\
         beam.blade = {{ section = \"spar\", from = [0, 0, 0], to = [{LENGTH}, 0, 0], elements = 8 }}\n\
         joint.mast = {{ type = \"revolute\", a = \"ground\", b = \"blade.start\", axis = [0, 0, 1] }}\n\
         output.tip = {{ at = \"blade.end\", quantities = [\"position\", \"velocity\"] }}\n\
         output.root = {{ at = \"blade.start\", quantities = [\"section_force\"] }}\n\
         simulation = {{ output_step = 1e-2, stop = 1, step = {STEP}, initial = \"{initial}\" }}\n{rest}"
    )
}

fn drive(rate: f64) -> String {
    format!("drive.engine = {{ joint = \"mast\", coordinate = \"angle\", rate = {rate} }}\n")
}

/// A bar that turns stretches as `y'' = −κ² y`, `κ = Ω √(m/EA)`, and bears `EA (1/cos κL − 1)` at its root. A start as
/// drawn rings with that force.
#[test]
fn a_blade_begins_stretched() {
    let kappa = OMEGA * (DENSITY / STIFFNESS).sqrt() * LENGTH;
    let (tension, radius) = (STIFFNESS * (1.0 / kappa.cos() - 1.0), LENGTH * kappa.tan() / kappa);
    let apart = |initial: &str| {
        let mut simulation = start(&blade(initial, &drive(OMEGA)));
        let mut largest = [0.0_f64; 2];
        run(&mut simulation, 1e-2, 1.0, |simulation| {
            let [x, y] = [1, 2].map(|own| value(simulation, &format!("tip.position[{own}]")));
            let force = value(simulation, "root.section_force[1]");
            largest =
                [largest[0].max((x.hypot(y) / radius - 1.0).abs()), largest[1].max((force / tension - 1.0).abs())];
        });
        assert_eq!(simulation.take_warnings(), Vec::<String>::new());
        largest
    };
    let [place, force] = apart("steady");
    println!("{place:.1e} {force:.1e}");
    // A step takes the mean of both its ends, which turn apart by Ωh: the force that balances it is (Ωh)²/4 smaller. Found
    // suddenly, it rings by twice that share, and so does the elongation.
    let of_step = (OMEGA * STEP).powi(2) / 2.0;
    assert!(place < (radius / LENGTH - 1.0) * of_step && force < of_step, "{place} {force} {of_step}");
    assert!(apart("as_drawn")[1] > 0.5);
}

/// Gravity across the axis turns with respect to the blade: the start is steady but for that, and says so.
#[test]
fn what_is_not_steady_is_told() {
    let fails = |rest: &str| try_start(&blade("steady", rest)).err().unwrap_or_default();
    assert!(fails("").contains("no drive of an angle turns at the start"), "{}", fails(""));
    assert!(fails(&drive(0.0)).contains("no drive of an angle turns at the start"));
    let two = drive(OMEGA)
        + "body.wheel = { mass = 1, position = [0, 0, 1], inertia = [1, 1, 1] }\n\
           joint.hub = { type = \"revolute\", a = \"ground\", b = \"wheel\", axis = [0, 0, 1] }\n\
           drive.other = { joint = \"hub\", coordinate = \"angle\", rate = 1 }\n";
    assert!(fails(&two).contains("the drives engine and other both turn at the start"), "{}", fails(&two));
    let held = drive(OMEGA) + "joint.hand = { type = \"spherical\", a = \"ground\", b = \"blade.end\" }\n";
    assert!(fails(&held).contains("drive engine does not turn the mechanism as a whole"), "{}", fails(&held));
    let founded = drive(OMEGA) + "foundation.soil = { on = \"blade\", stiffness = [0, 0, 1e3] }\n";
    assert!(fails(&founded).contains("with a foundation does not turn steadily here"), "{}", fails(&founded));

    let across = blade("steady", &drive(OMEGA)).replace("gravity = [0, 0, 0]", "gravity = [0, -9.81, 0]");
    let mut simulation = start(&across);
    let warnings = simulation.take_warnings();
    assert!(
        warnings.iter().any(|own| own.contains("9.810 m/s2 of gravity are across the axis of drive engine")),
        "{warnings:?}"
    );
    let given = blade("steady", &drive(OMEGA)).replace("elements = 8", "elements = 8, angular_velocity = [0, 0, 20]");
    let warnings = start(&given).take_warnings();
    let told = "the given initial velocities are not used: the motion begins as a steady rotation";
    assert!(warnings.iter().any(|own| own == told), "{warnings:?}");
}
