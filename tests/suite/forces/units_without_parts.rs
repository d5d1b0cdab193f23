//! A unit that is only a spring and a damper between the ground and a frame that a host moves, as the force side of a
//! co-simulation. It has no coordinate to solve for; forces, their account and saved states must be right all the same.

use crate::curves::Curves;
use crate::running::try_start;
use ancf14::Simulation;
use std::f64::consts::PI;

const UNIT: &str = r#"format = 1
[model]
name = "SpringUnit"
[frame.tip]
position = [0, 0, 0]
input = "rotation"
[point.wall]
offset = [-1, 0, 0]
[spring.strut]
a = "wall"
b = "tip"
stiffness = 100
damping = 2
length = 1
[output.grip]
at = "tip"
quantities = ["applied_force", "position"]
[output.strut]
at = "strut"
quantities = ["force", "energy", "distance", "distance_rate"]
[simulation]
stop = 2
output_step = 0.01
"#;

/// The host moves the frame at a constant speed: tension by the way, and by the speed from the second step on.
#[test]
fn a_host_moves_the_end_of_a_spring() {
    for analysis in ["dynamic", "static"] {
        let text = UNIT.replace("[simulation]", &format!("[simulation]\nanalysis = \"{analysis}\""));
        let mut unit = Simulation::from_text("m.toml", &text).unwrap_or_else(|error| panic!("{error}"));
        unit.initialize().unwrap_or_else(|error| panic!("{error}"));
        let mut saved = None;
        let read = |unit: &Simulation| {
            ["strut.force", "grip.applied_force[1]", "strut.energy"]
                .map(|name| unit.value(name).unwrap_or_else(|error| panic!("{error}")))
        };
        let mut last = [0.0; 3];
        for step in 1..=20 {
            let (time, way) = (0.01 * f64::from(step), 0.005 * f64::from(step));
            unit.set("tip.position[1]", way).unwrap_or_else(|error| panic!("{error}"));
            unit.advance(time).unwrap_or_else(|error| panic!("{error}"));
            last = read(&unit);
            let damping = if analysis == "static" { 0.0 } else { 2.0 * 0.5 };
            let force = 100.0 * way + damping;
            // Round-off; the speed is that of the last two values of the host.
            if step > 2 {
                assert!((last[0] - force).abs() < 1e-9, "{analysis}, step {step}: {last:?} {force}");
                assert!((last[1] + force).abs() < 1e-9, "{analysis}, step {step}: {last:?} {force}");
            }
            assert!((last[2] - 50.0 * way * way).abs() < 1e-12, "{last:?}");
            if step == 10 {
                saved = Some(unit.save().unwrap_or_else(|error| panic!("{error}")));
            }
        }
        unit.restore(&saved.expect("saved at step 10")).unwrap_or_else(|error| panic!("{error}"));
        for step in 11..=20 {
            unit.set("tip.position[1]", 0.005 * f64::from(step)).unwrap_or_else(|error| panic!("{error}"));
            unit.advance(0.01 * f64::from(step)).unwrap_or_else(|error| panic!("{error}"));
        }
        assert_eq!(read(&unit).map(f64::to_bits), last.map(f64::to_bits));
    }
}

/// A frame that moves by an expression: force, and the account of energy, whose damper takes `c ∫ v² dt`.
#[test]
fn a_frame_that_moves_by_itself_stretches_a_spring() {
    let text = UNIT
        .replace("position = [0, 0, 0]\ninput = \"rotation\"", "position = [\"0.1*sin(2*pi*t)\", 0, 0]")
        .replace("[simulation]", "[simulation]\ntotals = [\"work\", \"energy\"]");
    let curves = Curves::run(&text, &[]);
    let (force, length) = (curves.column("strut.force"), curves.column("strut.distance"));
    for (time, length) in curves.time.iter().zip(&length) {
        // From the first row on; round-off.
        assert!((length - 1.0 - 0.1 * (2.0 * PI * time).sin()).abs() < 1e-14, "at {time} s: {length}");
    }
    for (time, force) in curves.time.iter().zip(&force) {
        let (sine, cosine) = (2.0 * PI * time).sin_cos();
        let exact = 100.0 * 0.1 * sine + 2.0 * 0.1 * 2.0 * PI * cosine;
        // Round-off of 13 N.
        assert!((force - exact).abs() < 1e-10, "at {time} s: {force} {exact}");
    }
}

/// Nothing to move and nothing that moves it stays a mistake, and so does a spring between places that stand still.
#[test]
fn a_unit_needs_something_that_moves() {
    let still = UNIT.replace("input = \"rotation\"\n", "");
    let message = try_start(&still).unwrap_err();
    assert!(message.contains("connects two points that cannot move"), "{message}");
    let spring =
        UNIT.find("[spring").zip(UNIT.find("[output.grip]")).map(|(from, to)| &UNIT[from..to]).expect("a spring");
    let without = UNIT.replace(spring, "").replace(
        "[output.strut]\nat = \"strut\"\nquantities = [\"force\", \"energy\", \"distance\", \"distance_rate\"]\n",
        "",
    );
    let message = try_start(&without).unwrap_err();
    assert!(message.contains("the file has no beam and no body"), "{message}");
}
