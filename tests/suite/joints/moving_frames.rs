//! What hangs on a moving frame moves with it, and the frame supplies the force for it: a body welded to a frame has
//! the analytical velocity and acceleration, a pendulum on a shaken support swings as its equation says, the frame's
//! supply is the reaction of what hangs on it, and of a point mass carried round it is `m r omega^2`. A term of the
//! frame's motion that is missing in velocities or accelerations (Coriolis, centrifugal, Euler) shows in full.

use crate::running::{run, start, value, vector};
use ancf14::math::jet::Jet;
use ancf14::math::{Vec3, rotation};

/// A body welded to a frame that turns about `[0, 0.6, 0.8]` and travels, with what the frame supplies.
const CARRIED: &str = r#"
format = 1
[model]
name = "Carried"
gravity = [0, 0, -9.81]

[frame.hand]
position = ["0.3*sin(2*t)", "0.1*t^2", "0.2*cos(3*t)"]
rotation = [0, "0.6*(2*t + 0.5*t^3)", "0.8*(2*t + 0.5*t^3)"]

[body.block]
mass = 1.5
position = [0.4, -0.3, 0.5]
inertia = [0.05, 0.08, 0.11, 0.01, -0.02, 0.005]

[joint.grip]
type = "weld"
a = "hand"
b = "block"
at = [0.1, 0.2, 0.3]

[output.carried]
at = "block"
quantities = ["position", "velocity", "acceleration", "angular_velocity", "rotation"]

[output.support]
at = "hand"
quantities = ["position", "velocity", "acceleration", "angular_velocity", "reaction_force", "reaction_moment"]

[output.held]
at = "grip"
quantities = ["reaction_force", "reaction_moment"]

[simulation]
stop = 1
step = 1e-3
output_step = 1e-2
"#;

const AXIS: Vec3 = Vec3::new(0.0, 0.6, 0.8);
const GRIP: Vec3 = Vec3::new(0.1, 0.2, 0.3);
const MASS: f64 = 1.5;

/// Angle, angular velocity and angular acceleration of the frame.
fn turning(t: f64) -> [f64; 3] {
    [2.0 * t + 0.5 * t.powi(3), 2.0 + 1.5 * t * t, 3.0 * t]
}

/// Place, velocity and acceleration of the frame.
fn travelling(t: f64) -> [Vec3; 3] {
    let ([s2, c2], [s3, c3]) = ([(2.0 * t).sin(), (2.0 * t).cos()], [(3.0 * t).sin(), (3.0 * t).cos()]);
    [
        Vec3::new(0.3 * s2, 0.1 * t * t, 0.2 * c3),
        Vec3::new(0.6 * c2, 0.2 * t, -0.6 * s3),
        Vec3::new(-1.2 * s2, 0.2, -1.8 * c3),
    ]
}

/// Place, velocity and acceleration of a point that is carried along, from where it is drawn at t = 0.
fn carried(drawn: Vec3, t: f64) -> [Vec3; 3] {
    let [angle, speed, rate] = turning(t);
    let [place, velocity, acceleration] = travelling(t);
    let arm = rotation::rotation_matrix(&(AXIS * angle)) * (drawn - travelling(0.0)[0]);
    let (omega, alpha) = (AXIS * speed, AXIS * rate);
    [place + arm, velocity + omega.cross(&arm), acceleration + alpha.cross(&arm) + omega.cross(&omega.cross(&arm))]
}

/// Positions and accelerations to round-off: they follow from the conditions alone. Velocities too.
#[test]
fn a_welded_body_moves_as_its_frame_does() {
    let mut simulation = start(CARRIED);
    let mut worst = [0.0_f64; 3];
    run(&mut simulation, 1e-2, 1.0, |simulation| {
        let t = simulation.state().time;
        let bodies = carried(Vec3::new(0.4, -0.3, 0.5), t);
        let frames = travelling(t);
        for (number, quantity) in ["position", "velocity", "acceleration"].into_iter().enumerate() {
            for (output, expected) in [("carried", bodies[number]), ("support", frames[number])] {
                let found = vector(simulation, &format!("{output}.{quantity}"));
                worst[number] = worst[number].max((found - expected).norm());
            }
        }
        let [angle, speed, _] = turning(t);
        for output in ["carried", "support"] {
            let found = vector(simulation, &format!("{output}.angular_velocity"));
            assert!((found - AXIS * speed).norm() < 1e-12, "{output}: {found}");
        }
        assert!((vector(simulation, "carried.rotation") - AXIS * angle).norm() < 1e-12);
    });
    println!("position off by {:.1e}, velocity {:.1e}, acceleration {:.1e}", worst[0], worst[1], worst[2]);
    // Round-off of numbers up to 10.
    assert!(worst[0] < 1e-13 && worst[1] < 1e-12 && worst[2] < 1e-11, "{worst:?}");
}

/// What the frame supplies is what the grip transmits, taken to the frame's origin, and what Newton and Euler demand of
/// the body.
#[test]
fn the_frame_supplies_what_hangs_on_it_needs() {
    let mut simulation = start(CARRIED);
    let tensor = ancf14::math::Mat3::new(0.05, 0.01, 0.005, 0.01, 0.08, -0.02, 0.005, -0.02, 0.11);
    let mut worst = [0.0_f64; 4];
    run(&mut simulation, 1e-2, 1.0, |simulation| {
        let t = simulation.state().time;
        let [center, _, acceleration] = carried(Vec3::new(0.4, -0.3, 0.5), t);
        let grip = carried(GRIP, t)[0];
        let origin = travelling(t)[0];
        let [angle, speed, rate] = turning(t);
        let turn = rotation::rotation_matrix(&(AXIS * angle));
        let inertia = turn * tensor * turn.transpose();
        let (omega, alpha) = (AXIS * speed, AXIS * rate);
        let force = (acceleration + Vec3::z() * 9.81) * MASS;
        let about_center = inertia * alpha + omega.cross(&(inertia * omega));
        let expected = [
            ("held.reaction_force", force),
            ("held.reaction_moment", about_center + (center - grip).cross(&force)),
            ("support.reaction_force", force),
            ("support.reaction_moment", about_center + (center - origin).cross(&force)),
        ];
        for (worst, (name, expected)) in worst.iter_mut().zip(expected) {
            *worst = worst.max((vector(simulation, name) - expected).norm() / expected.norm().max(1.0));
        }
    });
    println!("grip {:.1e} {:.1e}, frame {:.1e} {:.1e}", worst[0], worst[1], worst[2], worst[3]);
    assert!(worst.into_iter().all(|worst| worst < 1e-11), "{worst:?}");
}

/// A mass on a rotating frame, at rest in it: force `m r omega^2` towards the axis, no moment about it. Held by a
/// bushing, whose springs the frame has to supply as well, it stands off by what they give way.
#[test]
fn a_carried_mass_needs_the_centripetal_force() {
    let (mass, radius, omega) = (2.5, 0.4, 3.0);
    for (kind, offset) in [("weld", 0.0), ("spherical", 0.0), ("bushing", mass * radius * 9.0 / (2000.0 - mass * 9.0))]
    {
        let stiffness = "stiffness = [2000, 2000, 2000]\nrotational_stiffness = [50, 50, 50]\n";
        let distance = radius + offset;
        let text = format!(
            "format = 1\n[model]\nname = \"Carousel\"\n\
             [frame.table]\nposition = [0, 0, 0]\nrotation = [0, 0, \"{omega}*t\"]\n\
             [body.mass]\nmass = {mass}\nposition = [{radius}, 0, 0]\ninertia = [0.01, 0.01, 0.01]\n\
             velocity = [0, {}, 0]\nangular_velocity = [0, 0, {omega}]\n\
             [joint.seat]\ntype = \"{kind}\"\na = \"table\"\nb = \"mass\"\n{}\
             [output.table_supply]\nat = \"table\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
             [output.place]\nat = \"mass\"\nquantities = [\"position\"]\n\
             [simulation]\nstop = 1\nstep = 1e-3\noutput_step = 1e-2\n",
            omega * radius,
            if kind == "bushing" { stiffness.to_owned() + "damping = [100, 100, 100]\n" } else { String::new() },
        );
        let mut simulation = start(&text);
        run(&mut simulation, 1e-2, 1.0, |_| {});
        let place = vector(&simulation, "place.position");
        let force = vector(&simulation, "table_supply.reaction_force");
        let moment = vector(&simulation, "table_supply.reaction_moment");
        let expected = -place.normalize() * (mass * distance * omega * omega);
        println!("{kind}: force off by {:.1e}, moment {:.1e}", (force - expected).norm(), moment.norm());
        // The bushing has damped its first swing by exp(-20). In the middle of a step the mass is on the chord,
        // `r (omega h)^2 / 8` nearer, which the spring of 2000 N/m feels: 9e-4 N of 9 N.
        let tolerance = if kind == "bushing" { 1.2e-4 } else { 1e-12 };
        assert!((force - expected).norm() < tolerance * expected.norm(), "{kind}: {force} {expected}");
        assert!(moment.norm() < tolerance * expected.norm(), "{kind}: {moment}");
        assert!((place.norm() - distance).abs() < tolerance, "{kind}: {place}");
    }
}

/// Place, velocity and acceleration of the shaken support: along x and z.
fn support(t: f64) -> [Jet; 2] {
    let wave = |amplitude: f64, omega: f64| Jet {
        value: amplitude * (omega * t).sin(),
        first: amplitude * omega * (omega * t).cos(),
        second: -amplitude * omega * omega * (omega * t).sin(),
    };
    [wave(0.1, 5.0), wave(0.05, 11.0)]
}

/// The angle of a compound pendulum on the shaken support, by Runge and Kutta's rule in steps of 1e-5 s.
fn pendulum(duration: f64, (mass, arm, inertia): (f64, f64, f64)) -> f64 {
    let about = inertia + mass * arm * arm;
    let rate = |t: f64, [angle, speed]: [f64; 2]| {
        let [x, z] = support(t);
        [speed, -mass * arm * ((9.81 + z.second) * angle.sin() + x.second * angle.cos()) / about]
    };
    let along = |[a, b]: [f64; 2], [c, d]: [f64; 2], h: f64| [a + h * c, b + h * d];
    // At rest in space as drawn: the support that starts to move turns it by the impulse at the pivot.
    let (steps, mut now) = ((duration * 1e5).round() as u32, [0.0, -mass * arm * support(0.0)[0].first / about]);
    let h = duration / f64::from(steps);
    for number in 0..steps {
        let t = f64::from(number) * h;
        let k1 = rate(t, now);
        let k2 = rate(t + 0.5 * h, along(now, k1, 0.5 * h));
        let k3 = rate(t + 0.5 * h, along(now, k2, 0.5 * h));
        let k4 = rate(t + h, along(now, k3, h));
        now = [0, 1].map(|i| now[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    now[0]
}

/// A pendulum hung on a shaken frame that starts with a knock: its angle after 2 s, with order 2 in the step.
#[test]
fn a_pendulum_on_a_shaken_frame_swings_as_its_equation_says() {
    let (mass, arm, inertia) = (1.2, 0.35, 0.02);
    let expected = pendulum(2.0, (mass, arm, inertia));
    let errors = [4e-3, 2e-3].map(|step| {
        let text = format!(
            "format = 1\n[model]\nname = \"Shaken\"\ngravity = [0, 0, -9.81]\n\
             [frame.support]\nposition = [\"0.1*sin(5*t)\", 0, \"0.05*sin(11*t)\"]\n\
             [body.bob]\nmass = {mass}\nposition = [0, 0, -{arm}]\ninertia = [0.03, {inertia}, 0.01]\n\
             [joint.pivot]\ntype = \"revolute\"\na = \"support\"\nb = \"bob\"\nat = [0, 0, 0]\naxis = [0, -1, 0]\n\
             [output.swing]\nat = \"pivot\"\nquantities = [\"angle\"]\n\
             [simulation]\nstop = 2\nstep = {step}\noutput_step = 0.02\n"
        );
        let mut simulation = start(&text);
        let mut largest = 0.0_f64;
        run(&mut simulation, 0.02, 2.0, |simulation| largest = largest.max(value(simulation, "swing.angle").abs()));
        assert!(largest > 0.3, "nothing swings");
        value(&simulation, "swing.angle") - expected
    });
    let order = (errors[0] / errors[1]).log2();
    println!("angle {expected:.6} rad, off by {:.2e}, {:.2e}, order {order:.2}", errors[0], errors[1]);
    assert!(errors[1].abs() < 1e-2 && (order - 2.0).abs() < 0.2, "{errors:?}");
}
