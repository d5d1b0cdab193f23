//! The estimate of the error that the lengths of steps cause sees each force of a step: actuators, turning loads,
//! dampers, friction, ropes, stops and locks.

use super::time_error::{difference, estimate, rows};
use ancf14::model::simulation::Simulation;

/// A body of 1 kg, 1 m from the origin, with what holds and moves it, run for `stop` s by rows of 10 ms.
fn body(parts: &str, output: &str, accuracy: &str, stop: f64) -> String {
    format!(
        "format = 1\n[model]\nname = \"Forces\"\n{parts}\n[output.P]\n{output}\n[simulation]\nstop = {stop}\naccuracy = {accuracy}\noutput_step = 0.01\n"
    )
}

/// Each force: parts, output, name of a result, its family, the end, s, and how far the estimate may be from the truth.
type Case = (&'static str, &'static str, &'static str, &'static str, f64, f64);

const SLIDER: &str = "[body.b]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
    [joint.j]\ntype = \"prismatic\"\na = \"ground\"\nb = \"b\"\naxis = [1, 0, 0]\n";
const READING: &str = "at = \"j\"\nquantities = [\"distance\", \"distance_rate\"]";
const POINT: &str = "at = \"b\"\nquantities = [\"position\", \"angular_velocity\"]";

/// The estimate is right to the next order, `omega h`, which is 2 to 5 % here. A rope begins to pull somewhere within a
/// step: 20 %. Behind the impact of a lock two steps know no derivatives, and a jump of the second derivative is all
/// that they have: 30 %.
const CASES: [(&str, Case); 7] = [
    (
        "controller",
        (
            "[actuator.m]\njoint = \"j\"\ncoordinate = \"distance\"\neffort = \"-2500*(j.distance - 1)\"",
            READING,
            "P.distance",
            "P.distance",
            2.0,
            0.1,
        ),
    ),
    (
        "controller with a rate",
        (
            "[actuator.m]\njoint = \"j\"\ncoordinate = \"distance\"\neffort = \"-2500*(j.distance - 1) - 20*j.distance_rate\"",
            READING,
            "P.distance",
            "P.distance",
            2.0,
            0.1,
        ),
    ),
    (
        "damper",
        (
            "[spring.k]\njoint = \"j\"\ncoordinate = \"distance\"\nstiffness = 2500\nrest = 1\ndamping = 400",
            READING,
            "P.distance",
            "P.distance",
            2.0,
            0.1,
        ),
    ),
    (
        "friction",
        (
            "[spring.k]\njoint = \"j\"\ncoordinate = \"distance\"\nstiffness = 2500\nrest = 1\n[friction.f]\njoint = \"j\"\ncoordinate = \"distance\"\ncoulomb = 20\nspeed = 0.1",
            READING,
            "P.distance",
            "P.distance",
            2.0,
            0.1,
        ),
    ),
    (
        "rope",
        (
            "[point.far]\noffset = [-1, 0, 0]\n[spring.k]\na = \"far\"\nb = \"b\"\nonly = \"tension\"\nstiffness = 400\nlength = 1.3\n[load.w]\nat = \"b\"\nforce = [10, 0, 0]",
            READING,
            "P.distance",
            "P.distance",
            2.0,
            0.2,
        ),
    ),
    (
        "lock",
        (
            "[body.c]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\nvelocity = [1, 0, 0]\n\
         [joint.k]\ntype = \"prismatic\"\na = \"b\"\nb = \"c\"\naxis = [1, 0, 0]\nstiffness = 100\n\
         [spring.s]\njoint = \"j\"\ncoordinate = \"distance\"\nstiffness = 300\n\
         [lock.l]\njoint = \"k\"\ncoordinate = \"distance\"\nactive = \"t > 1\"",
            READING,
            "P.distance",
            "P.distance",
            3.0,
            0.3,
        ),
    ),
    (
        "turning load",
        (
            "[load.t]\nat = \"b\"\nfollower = true\nforce = [0, 1, 0]\nmoment = [0, 0, 3]",
            POINT,
            "P.position[1]",
            "P.position",
            2.0,
            0.1,
        ),
    ),
];

/// With a hundredth of the accuracy a run has a hundredth of the error.
#[test]
fn the_errors_of_forces_are_known() {
    for (force, (parts, output, name, family, stop, bound)) in CASES {
        let parts = format!("{SLIDER}{parts}");
        let parts =
            if output == POINT { parts.replace(&SLIDER[SLIDER.find("[joint").expect("a joint")..], "") } else { parts };
        // An estimate is that of the component that is off by most, over the range of the one that ranges most.
        let other = name.replace("[1]", "[2]");
        let errors = [name, &other].map(|name| {
            let (found, simulation) = rows(&body(&parts, output, "1e-3", stop), name, 0.01, stop);
            let (exact, _) = rows(&body(&parts, output, "1e-5", stop), name, 0.01, stop);
            let range = exact.iter().copied().fold(0.0, f64::max) - exact.iter().copied().fold(0.0, f64::min);
            (range * difference(&found, &exact), range, simulation)
        });
        let largest = |own: fn(&(f64, f64, Simulation)) -> f64| own(&errors[0]).max(own(&errors[1]));
        let truth = largest(|own| own.0) / largest(|own| own.1);
        let told = estimate(&errors[0].2, family);
        let ratio = told / truth;
        assert!(ratio.max(1.0 / ratio) < 1.0 + bound, "{force}: {told} instead of {truth}");
    }
}

/// A belt of two ropes that wind off one drum and onto another one at 20 rad/s. What drums have wound up holds them
/// together: the phase that each of them loses a step alone would be a third of the tensions after 3 s, where the ends
/// of the belt in fact stay within a thousandth of the range of the tension, with 1 ms. The estimate stays within the
/// order of the truth.
#[test]
fn what_drums_wind_up_holds_the_error() {
    let belt = |step: f64| {
        let text = format!(
            r#"format = 1
model = {{ name = "Belt", gravity = [0, 0, 0] }}
body.driver = {{ mass = 5, position = [0, 0, 0], inertia = [0.015, 0.025, 0.015] }}
body.driven = {{ mass = 10, position = [1, 0, 0], inertia = [0.11, 0.2, 0.11] }}
joint.shaft = {{ type = "revolute", a = "ground", b = "driver", axis = [0, 1, 0] }}
joint.axle = {{ type = "revolute", a = "ground", b = "driven", axis = [0, 1, 0] }}
surface.small = {{ on = "driver", shape = "cylinder", axis = [0, 1, 0], radius = 0.1 }}
surface.large = {{ on = "driven", shape = "cylinder", axis = [0, 1, 0], radius = 0.2 }}
rope.upper = {{ from_drum = "small", to_drum = "large", turns = [1, 1], stiffness = 1e6, damping = 500, pretension = 500 }}
rope.lower = {{ from_drum = "large", to_drum = "small", turns = [1, 1], stiffness = 1e6, damping = 500, pretension = 500 }}
drive.motor = {{ joint = "shaft", coordinate = "angle", rate = "20*smoothstep(0, 1, t)" }}
actuator.load = {{ joint = "axle", coordinate = "angle", effort = "-40*smoothstep(0, 1, t)" }}
output.P = {{ at = "upper", quantities = ["tension"] }}
simulation = {{ stop = 3, step = {step}, output_step = 0.01 }}
"#
        );
        let (tensions, simulation) = rows(&text, "P.tension", 0.01, 3.0);
        (tensions.iter().map(|tension| tension - 500.0).collect::<Vec<f64>>(), simulation)
    };
    let [(coarse, own), (fine, _)] = [1e-3, 1e-4].map(belt);
    let (truth, told) = (difference(&coarse, &fine), estimate(&own, "P.tension"));
    println!("{truth:e} {told:e}");
    assert!(truth < 5e-4, "{truth}");
    assert!((1.0 / 3.0..3.0).contains(&(told / truth)), "{told} {truth}");
}
