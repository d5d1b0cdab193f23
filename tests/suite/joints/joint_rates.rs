//! Rates and accelerations of the free coordinates of joints as outputs, at joints and at drives.

use crate::running::{run, start, value};

/// A screw that is driven along and about the axis of a joint whose side a tumbles: the rates are those of the drives
/// to round-off, for the velocities of a step are projected to what the drives prescribe. Those of the frame itself, 2
/// rad/s and 1 m/s, must not show.
#[test]
fn driven_rates_are_those_of_the_drives() {
    let text = "format = 1\n[model]\nname = \"Screw\"\n\
                [frame.base]\nposition = [\"sin(t)\", 0, 0]\nrotation = [\"2*t\", 0, 0]\n\
                [body.nut]\nmass = 1\nposition = [0, 0, 0.1]\ninertia = [0.01, 0.01, 0.01]\n\
                [joint.thread]\ntype = \"cylindrical\"\na = \"base\"\nb = \"nut\"\naxis = [0, 0.6, 0.8]\n\
                [drive.turn]\njoint = \"thread\"\ncoordinate = \"angle\"\nrate = 3\n\
                [drive.push]\njoint = \"thread\"\ncoordinate = \"distance\"\nvalue = \"0.1*sin(2*t)\"\n\
                [output.thread_motion]\nat = \"thread\"\nquantities = [\"angle_rate\", \"distance_rate\", \"angle_acceleration\", \"distance_acceleration\"]\n\
                [output.turning]\nat = \"turn\"\nquantities = [\"angle_rate\"]\n\
                [output.pushing]\nat = \"push\"\nquantities = [\"distance_rate\", \"distance_acceleration\"]\n\
                [simulation]\nstop = 1\nstep = 1e-2\n";
    let mut simulation = start(text);
    let mut time = 1e-2;
    run(&mut simulation, 1e-2, 1.0, |simulation| {
        for (name, rate) in [("thread_motion.angle_rate", 3.0), ("turning.angle_rate", 3.0)] {
            assert!((value(simulation, name) - rate).abs() < 1e-11, "{name} at {time} s: {}", value(simulation, name));
        }
        for name in ["thread_motion.distance_rate", "pushing.distance_rate"] {
            let rate = 0.2 * f64::cos(2.0 * time);
            assert!((value(simulation, name) - rate).abs() < 1e-11, "{name} at {time} s: {}", value(simulation, name));
        }
        // Accelerations fulfil the second derivatives of the conditions at the instant; the positions of the frame are
        // right to 1e-11.
        let pushed = -0.4 * f64::sin(2.0 * time);
        for (name, expected) in [
            ("thread_motion.angle_acceleration", 0.0),
            ("thread_motion.distance_acceleration", pushed),
            ("pushing.distance_acceleration", pushed),
        ] {
            let found = value(simulation, name);
            assert!((found - expected).abs() < 1e-9, "{name} at {time} s: {found}, not {expected}");
        }
        time += 1e-2;
    });
}

/// A body that swings freely. Differences of its angle over two steps of h = 1 ms are the rate between them but for
/// `h²/6` of its second derivative, to which the midpoint rule, whose increments are means of the rates at both ends,
/// adds `h²/12`, and but for `h² ω³/12`, for the mean of two orientations is a chord. With `ω² <= 2 g/l` and
/// `|ω''| <= ω g/l` that is 1.8e-5 rad/s.
#[test]
fn free_rates_are_those_of_the_angle() {
    let text = "format = 1\n[model]\nname = \"Pendulum\"\ngravity = [0, 0, -9.81]\n\
                [body.bob]\nmass = 2\nposition = [1, 0, 0]\ninertia = [0.02, 0.02, 0.02]\n\
                [joint.pivot]\ntype = \"revolute\"\na = \"ground\"\nb = \"bob\"\nat = [0, 0, 0]\naxis = [0, 1, 0]\n\
                [output.swing]\nat = \"pivot\"\nquantities = [\"angle\", \"angle_rate\", \"angle_acceleration\"]\n\
                [simulation]\nstop = 1\nstep = 1e-3\n";
    let mut simulation = start(text);
    let mut rows = Vec::new();
    run(&mut simulation, 1e-3, 1.0, |simulation| {
        let [angle, rate, acceleration] =
            ["swing.angle", "swing.angle_rate", "swing.angle_acceleration"].map(|name| value(simulation, name));
        // The equation of the pendulum at the instant, to round-off of 10 rad/s².
        let expected = 2.0 * 9.81 * angle.cos() / 2.02;
        assert!((acceleration - expected).abs() < 1e-9, "{acceleration} instead of {expected}");
        rows.push((angle, rate));
    });
    let largest = rows.iter().fold(0.0, |largest: f64, (_, rate)| largest.max(rate.abs()));
    assert!((4.0..5.0).contains(&largest), "it falls: {largest} rad/s, sqrt(2 g/l) at most");
    for three in rows.windows(3) {
        let rate = (three[2].0 - three[0].0) / 2e-3;
        assert!((rate - three[1].1).abs() < 1.8e-5, "{rate} instead of {}", three[1].1);
    }
}
