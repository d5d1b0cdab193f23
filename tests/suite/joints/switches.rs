//! Do joints, locks and drives engage and release as an engineer expects? What is released flies on as it moved; what engages holds where it stands, after an impact that conserves
//! momentum; what it holds it holds to round-off, with the reaction of statics. A multiplier that outlives its joint, a velocity that an impact forgets, or a step across a switch shows here.

use crate::curves::{Curves, load};
use crate::integrators::setting;
use crate::running::{run, start, value, vector};
use ancf14::fmi::Model;

/// A pendulum of 1 kg that is drawn level, with a brake on its hinge.
fn pendulum(active: &str, more: &str) -> String {
    format!(
        r#"format = 1
[model]
name = "Pendulum"
gravity = [0, 0, -9.81]
[body.bob]
mass = 1
position = [0.5, 0, 0]
inertia = [0.01, 0.02, 0.02]
[joint.hinge]
type = "revolute"
a = "ground"
b = "bob"
at = [0, 0, 0]
axis = [0, 1, 0]
[lock.brake]
joint = "hinge"
coordinate = "angle"
active = {active}
[output.H]
at = "hinge"
quantities = ["angle", "angle_rate", "reaction_moment"]
[output.B]
at = "brake"
quantities = ["effort", "angle"]
[simulation]
stop = 1.2
{more}
"#
    )
}

const FIXED: &str = "step = 1e-3\noutput_step = 0.01\ntotals = [\"energy\", \"work\", \"momentum\", \"statistics\"]";
const CHOSEN: &str = "output_step = 0.01\ntotals = [\"energy\", \"work\", \"momentum\", \"statistics\"]";
const ALPHA: &str = "integrator = \"generalized_alpha\"\nstep = 1e-3\noutput_step = 0.01\ntotals = [\"energy\", \"work\", \"statistics\"]";

/// Weight times arm, N m.
const LEVEL: f64 = 9.81 * 0.5;

/// A lock holds from the start, lets go, and holds again where the pendulum is then; its torque is that of the weight. Between, the motion is that of a pendulum that nothing has held.
#[test]
fn a_brake_holds_where_it_stands() {
    for steps in [FIXED, CHOSEN, ALPHA] {
        let braked = Curves::run(&pendulum("\"t < 0.5 or t >= 0.8\"", steps), &[]);
        let free = Curves::run(&pendulum("0", steps), &[]);
        let [angle, effort, moment] = ["H.angle", "B.effort", "H.reaction_moment[2]"].map(|name| braked.column(name));
        let falling = free.column("H.angle");
        for (row, time) in braked.time.iter().enumerate() {
            let row_before = (time - 0.5) / 0.01;
            if *time < 0.499 {
                assert!(angle[row].abs() < 1e-12, "{steps}: held at {time} s: {}", angle[row]);
                // Weight turns b about +y; round-off of a response at an instant.
                assert!((effort[row] + LEVEL).abs() < 1e-9, "{steps}: {}", effort[row]);
                assert!((moment[row] + LEVEL).abs() < 1e-9, "{steps}: {}", moment[row]);
            } else if *time < 0.799 {
                // The same steps, shifted: fixed ones to round-off, chosen ones to their accuracy.
                let own = falling[row_before.round() as usize];
                let tolerance = if steps == CHOSEN { 1e-4 } else { 1e-9 };
                assert!((angle[row] - own).abs() < tolerance, "{steps}: {time} s: {} {own}", angle[row]);
                assert!(effort[row] == 0.0, "{steps}: released at {time} s: {}", effort[row]);
            } else {
                assert!((angle[row] - angle[80]).abs() < 1e-10, "{steps}: {time} s: {} {}", angle[row], angle[80]);
                let wanted = -LEVEL * angle[80].cos();
                assert!((effort[row] - wanted).abs() < 1e-8, "{steps}: {time} s: {} {wanted}", effort[row]);
            }
        }
        // The brake takes what the fall has given, and the account says so.
        let [total, dissipated] = ["energy.total", "work.dissipated"].map(|name| braked.column(name));
        let loss = total[0] - total[total.len() - 1];
        let fallen = LEVEL * angle[80].sin();
        let tolerance = if steps == CHOSEN { 2e-3 } else { 2e-4 };
        assert!((loss - fallen).abs() < tolerance * fallen, "{steps}: {loss} {fallen}");
        let drift = braked.last("work.drift");
        assert!((dissipated[total.len() - 1] - loss - drift).abs() < 1e-10, "{steps}: {dissipated:?}");
        assert!((dissipated[total.len() - 1] - fallen).abs() < tolerance * fallen, "{steps}");
    }
}

/// Two wheels on a common hinge that nothing else holds, at different speeds; a clutch joins them.
fn wheels(more: &str) -> String {
    format!(
        r#"format = 1
[model]
name = "Clutch"
[body.first]
mass = 2
position = [0, 0, 0]
inertia = [0.3, 0.3, 0.5]
angular_velocity = [0, 0, 10]
velocity = [1, 0, 0]
[body.second]
mass = 3
position = [0, 0, 0.2]
inertia = [0.2, 0.2, 0.3]
angular_velocity = [0, 0, -2]
velocity = [1, 0, 0]
[joint.axle]
type = "revolute"
a = "first"
b = "second"
axis = [0, 0, 1]
[output.A]
at = "first"
quantities = ["angular_velocity", "velocity"]
[output.B]
at = "second"
quantities = ["angular_velocity", "velocity"]
{more}
"#
    )
}

/// `ω = (I₁ ω₁ + I₂ ω₂)/(I₁ + I₂)`, and the account has the loss `½ I₁ I₂/(I₁ + I₂) (ω₁ − ω₂)²`.
#[test]
fn a_clutch_conserves_momentum() {
    for steps in [FIXED, CHOSEN, ALPHA] {
        let lock = "[lock.clutch]\njoint = \"axle\"\ncoordinate = \"angle\"\nactive = \"t >= 0.3333\"\n[simulation]\nstop = 0.6\n";
        let text = wheels(&format!("{lock}{steps}"));
        let curves = Curves::run(&text, &[]);
        let common = (0.5 * 10.0 - 0.3 * 2.0) / 0.8;
        for name in ["A.angular_velocity[3]", "B.angular_velocity[3]"] {
            // Generalized-alpha does not conserve the momentum of a free rotation: its own error with this step is 3e-6.
            let tolerance = if steps == ALPHA { 1e-5 } else { 1e-9 };
            assert!((curves.last(name) - common).abs() < tolerance, "{steps}: {name} {}", curves.last(name));
        }
        let loss = 0.5 * 0.5 * 0.3 / 0.8 * 144.0;
        let tolerance = if steps == ALPHA { 1e-5 } else { 1e-9 };
        assert!((curves.last("work.dissipated") - loss).abs() < tolerance * loss, "{steps}");
        let change = curves.last("energy.total") - curves.column("energy.total")[0];
        assert!((change + curves.last("work.dissipated") - curves.last("work.drift")).abs() < 1e-9, "{steps}");
        if steps != ALPHA {
            for component in 1..=3 {
                let momentum = curves.column(&format!("momentum.angular[{component}]"));
                let most = momentum.iter().map(|value| (value - momentum[0]).abs()).fold(0.0, f64::max);
                assert!(most < 1e-10, "{steps}: {component}: {most}");
            }
        }
    }
}

/// Two bodies that a joint of each type holds together turn in free flight; it opens, and each goes on with the velocity that it has then, about its own center.
#[test]
fn released_bodies_fly_on() {
    let kinds = [
        "type = \"weld\"",
        "type = \"spherical\"",
        "type = \"revolute\"\naxis = [0, 0, 1]",
        "type = \"universal\"\naxis = [0, 0, 1]\naxis2 = [0, 1, 0]",
        "type = \"cylindrical\"\naxis = [0, 0, 1]",
        "type = \"prismatic\"\naxis = [0, 0, 1]",
        "type = \"inline\"\naxis = [0, 0, 1]",
        "type = \"inplane\"\naxis = [1, 0, 0]",
    ];
    for kind in kinds {
        let text = format!(
            r#"format = 1
[model]
name = "Parting"
[body.left]
mass = 2
position = [-0.3, 0, 0]
inertia = [0.05, 0.06, 0.07]
angular_velocity = [0, 0, 6]
velocity = [0, -1.8, 0]
[body.right]
mass = 1
position = [0.6, 0, 0]
inertia = [0.01, 0.02, 0.025]
angular_velocity = [0, 0, 6]
velocity = [0, 3.6, 0]
[joint.latch]
{kind}
a = "left"
b = "right"
at = [0, 0, 0]
active = "t < 0.2005"
[output.L]
at = "left"
quantities = ["velocity", "angular_velocity"]
[output.R]
at = "right"
quantities = ["velocity", "angular_velocity"]
[output.J]
at = "latch"
quantities = ["reaction_force", "reaction_moment"]
[simulation]
stop = 0.5
step = 1e-3
output_step = 0.01
"#
        );
        let curves = Curves::run(&text, &[]);
        let turned = (6.0_f64 * 0.2005).sin_cos();
        // As a rigid whole until then: an inline or a spherical joint holds the bodies on the same circles, because nothing turns them.
        let wanted = [("L", 1.8), ("R", -3.6)].map(|(name, speed)| (name, [speed * turned.0, -speed * turned.1]));
        for (name, velocity) in wanted {
            for (component, wanted) in velocity.iter().enumerate() {
                let column = curves.column(&format!("{name}.velocity[{}]", component + 1));
                let free = &column[21..];
                let most = free.iter().map(|value| (value - free[0]).abs()).fold(0.0, f64::max);
                assert!(most < 1e-10, "{kind}: {name} changes by {most} behind the release");
                // Error of the rule with this step, (ω h)²/12 of an angle of a radian.
                assert!((free[0] - wanted).abs() < 1e-4, "{kind}: {name}[{component}] {} {wanted}", free[0]);
            }
        }
        for component in 1..=3 {
            for quantity in ["reaction_force", "reaction_moment"] {
                let column = curves.column(&format!("J.{quantity}[{component}]"));
                assert!(column[21..].iter().all(|value| *value == 0.0), "{kind}: {quantity} of nothing");
            }
            for quantity in ["linear", "angular"] {
                let column = curves.column(&format!("momentum.{quantity}[{component}]"));
                let most = column.iter().map(|value| (value - column[0]).abs()).fold(0.0, f64::max);
                assert!(most < 1e-10, "{kind}: momentum.{quantity}[{component}] changes by {most}");
            }
        }
        let held = curves.column("J.reaction_force[1]")[0].hypot(curves.column("J.reaction_force[2]")[0]);
        assert!(kind.contains("inplane") || (held - 21.6 * 3.0).abs() < 21.6 * 3.0, "{kind}: {held}");
    }
}

/// A weld that engages in flight takes hold of a body where it stands, off its drawn place: an impact without rebound, after which both are one rigid body.
#[test]
fn a_weld_takes_hold_where_the_sides_stand() {
    let text = r#"format = 1
[model]
name = "Docking"
[body.station]
mass = 3
position = [0, 0, 0]
inertia = [0.4, 0.5, 0.6]
[body.ship]
mass = 1
position = [1, 0.5, 0]
inertia = [0.1, 0.1, 0.2]
velocity = [-1, 0, 0.3]
angular_velocity = [0.5, 1, 2]
[joint.dock]
type = "weld"
a = "station"
b = "ship"
active = "t >= 0.25"
[output.S]
at = "ship"
in = "station"
quantities = ["position", "quaternion", "velocity"]
[output.G]
at = "station"
quantities = ["velocity"]
[simulation]
stop = 1
step = 1e-3
output_step = 0.05
"#;
    let curves = Curves::run(text, &[]);
    let at = |name: &str, row: usize| curves.column(name)[row];
    for component in 1..=3 {
        let name = format!("S.position[{component}]");
        let most = (5..=20).map(|row| (at(&name, row) - at(&name, 5)).abs()).fold(0.0, f64::max);
        assert!(most < 1e-10, "{name} changes by {most}");
        // Round-off of positions over a step.
        let name = format!("S.velocity[{component}]");
        assert!((5..=20).all(|row| at(&name, row).abs() < 1e-10), "{name}: {:?}", curves.column(&name));
    }
    for component in 1..=4 {
        let name = format!("S.quaternion[{component}]");
        let most = (5..=20).map(|row| (at(&name, row) - at(&name, 5)).abs()).fold(0.0, f64::max);
        assert!(most < 1e-10, "{name} changes by {most}");
    }
    // Where a free flight of 0.25 s has taken it.
    assert!((at("S.position[1]", 5) - 0.75).abs() < 1e-12 && (at("S.position[3]", 5) - 0.075).abs() < 1e-12);
    for quantity in ["linear", "angular"] {
        for component in 1..=3 {
            let column = curves.column(&format!("momentum.{quantity}[{component}]"));
            let most = column.iter().map(|value| (value - column[0]).abs()).fold(0.0, f64::max);
            assert!(most < 1e-10, "momentum.{quantity}[{component}] changes by {most}");
        }
    }
}

/// A motor lets go: the wheel coasts at the rate it has. It takes hold again: the wheel follows from where it stands then, not from where it would have been.
#[test]
fn a_drive_lets_go_and_takes_hold_again() {
    let text = r#"format = 1
[model]
name = "Coasting"
[body.wheel]
mass = 2
position = [0, 0, 0]
inertia = [0.3, 0.3, 0.5]
[joint.axle]
type = "revolute"
a = "ground"
b = "wheel"
axis = [0, 0, 1]
[drive.motor]
joint = "axle"
coordinate = "angle"
rate = [{ until = 0.5, is = "4*t" }, { is = 1 }]
active = "t < 0.5 or t >= 1"
[output.W]
at = "axle"
quantities = ["angle", "angle_rate"]
[output.M]
at = "motor"
quantities = ["effort"]
[simulation]
stop = 1.5
step = 1e-3
output_step = 0.1
totals = ["energy", "work"]
"#;
    for integrator in ["conserving", "generalized_alpha"] {
        let curves = Curves::run(text, &[("simulation.integrator", integrator)]);
        let [angle, rate, effort] = ["W.angle", "W.angle_rate", "M.effort"].map(|name| curves.column(name));
        // 0.5 rad at 2 rad/s, 1.5 rad after coasting, then 1 rad/s.
        for (row, wanted) in [(5, 0.5), (7, 0.9), (10, 1.5), (15, 2.0)] {
            // The rule turns a free wheel by (ω h)²/12 too little, 3e-7.
            assert!((angle[row] - wanted).abs() < 1e-6, "{integrator}: {} at row {row}", angle[row]);
        }
        assert!((rate[9] - 2.0).abs() < 1e-5 && (rate[10] - 1.0).abs() < 1e-9, "{integrator}: {rate:?}");
        // Generalized-alpha has the effort of the accelerations that it carries on: 3e-6 off with this step.
        assert!((effort[3] - 2.0).abs() < 1e-5 && effort[7] == 0.0, "{integrator}: {effort:?}");
        // The motor gives 1 J, and at 1 s takes what slows the wheel: at its rate, the impulse of 0.5 N m s; the rest is lost in the impact.
        let [drives, dissipated] = ["work.drives", "work.dissipated"].map(|name| curves.last(name));
        // Of generalized-alpha with the error of its rates.
        let tolerance = if integrator == "conserving" { 1e-9 } else { 1e-5 };
        assert!((dissipated - 0.25).abs() < tolerance, "{integrator}: {dissipated}");
        // The same error of the rule, of the energy of a wheel at 2 rad/s.
        assert!((drives - (1.0 - 0.5)).abs() < 1e-5, "{integrator}: {drives}");
    }
}

/// A switch in the middle of steps costs no order: with half the step the error is a quarter.
#[test]
fn a_switch_keeps_the_order() {
    for integrator in ["conserving", "undamped", "generalized_alpha"] {
        let text = pendulum("\"t >= 0.4137 and t < 0.6211\"", "step = 0.01\noutput_step = 0.1");
        let run = |step: &str| {
            let curves = Curves::run(&text, &[setting(integrator), ("simulation.step", step)]);
            curves.last("H.angle")
        };
        let [coarse, middle, fine, reference] = ["0.01", "0.005", "0.0025", "0.0003125"].map(run);
        let errors = [coarse, middle, fine].map(|angle| (angle - reference).abs());
        for pair in errors.windows(2) {
            // Of order 2 to a tenth; the reference has 1/64 of the smallest error.
            let order = (pair[0] / pair[1]).log2();
            assert!((1.85..2.15).contains(&order), "{integrator}: {errors:?}");
        }
    }
}

/// A short pulse of a lock is not stepped over, and a comparison with a curved function of time switches where it does.
#[test]
fn switches_are_not_stepped_over() {
    let free = Curves::run(&pendulum("0", FIXED), &[]).column("H.angle_rate");
    // From a rest at 0.50003 s, wherever it is in a step of 1 ms.
    let pulse = Curves::run(&pendulum("\"t >= 0.50002 and t < 0.50003\"", FIXED), &[]).column("H.angle_rate");
    assert!((pulse[49] - free[49]).abs() < 1e-12 && pulse[50] > 1.0 && pulse[51] < 0.2, "{:?}", &pulse[49..52]);
    let curved = Curves::run(&pendulum("\"sin(t) >= sin(0.5)\"", FIXED), &[]);
    let angle = curved.column("H.angle");
    assert!((angle[50] - Curves::run(&pendulum("0", FIXED), &[]).column("H.angle")[50]).abs() < 1e-12);
    assert!((angle[120] - angle[50]).abs() < 1e-10);
}

/// Without a switch that changes, the bytes of the results are those of a model without it.
#[test]
fn an_engaged_switch_changes_nothing() {
    let text = pendulum("1", FIXED);
    let held = Curves::run(&text, &[]);
    assert!(held.column("H.angle").iter().all(|angle| angle.abs() < 1e-12));
    let plain = wheels("[simulation]\nstop = 0.2\nstep = 1e-3\noutput_step = 0.05");
    let switched = plain.replace("axis = [0, 0, 1]\n", "axis = [0, 0, 1]\nactive = \"t < 1\"\n");
    let [plain, switched] = [plain, switched].map(|text| Curves::run(&text, &[]).column("A.angular_velocity[3]"));
    assert!(plain.iter().zip(&switched).all(|(a, b)| (a - b).abs() < 1e-12), "{plain:?} {switched:?}");
}

/// The host opens a latch and closes it: at communication points.
#[test]
fn a_host_switches() {
    let text = pendulum("1\ninput = true", FIXED);
    let mut simulation = start(&text);
    let place = simulation.variables().iter().position(|variable| variable.name == "brake.active").expect("an input");
    let set = |simulation: &mut ancf14::model::simulation::Simulation, to: f64| {
        simulation
            .set_value(place, ancf14::fmi::Value::Real(to))
            .unwrap_or_else(|failure| panic!("{}", failure.message));
    };
    run(&mut simulation, 0.1, 0.2, |_| ());
    assert!(value(&simulation, "H.angle").abs() < 1e-12);
    set(&mut simulation, 0.0);
    for end in [0.3, 0.4] {
        simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
    let fallen = value(&simulation, "H.angle");
    let mut free = load(&pendulum("0", FIXED), &[]);
    run(&mut free, 0.1, 0.2, |_| ());
    assert!((fallen - value(&free, "H.angle")).abs() < 1e-9, "{fallen}");
    set(&mut simulation, 1.0);
    simulation.advance(0.5).unwrap_or_else(|failure| panic!("{}", failure.message));
    assert!((value(&simulation, "H.angle") - fallen).abs() < 1e-10);
    assert!(vector(&simulation, "H.reaction_moment")[1] < -1.0);
}

/// What engages where something else holds already is told before the run, with the time; the run names it.
#[test]
fn a_redundant_lock_is_told() {
    let text = pendulum("\"t >= 0.5\"", FIXED)
        .replace("[output.H]", "[drive.motor]\njoint = \"hinge\"\ncoordinate = \"angle\"\nvalue = 0\n[output.H]");
    let mut simulation = start(&text);
    let warnings = simulation.take_warnings();
    assert!(
        warnings.iter().any(|one| one.starts_with("from t = 0.5 s on, ") && one.contains("is redundant")),
        "{warnings:?}"
    );
    let failure = simulation.advance(0.6).expect_err("two hold one angle");
    assert!(failure.message.contains("is redundant"), "{}", failure.message);
    // One after the other is as it should be.
    let text = text.replace("value = 0\n", "value = 0\nactive = \"t < 0.5\"\n");
    let mut simulation = start(&text);
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
    simulation.advance(0.6).unwrap_or_else(|failure| panic!("{}", failure.message));
}

/// The natural frequencies are those of what is engaged as drawn.
#[test]
fn modes_know_what_is_engaged() {
    let text = pendulum("\"t >= 1\"", FIXED).replace("position = [0.5, 0, 0]", "position = [0, 0, -0.5]");
    let frequency = |text: &str| {
        let simulation = start(text);
        let found = simulation.modes(3).unwrap_or_else(|failure| panic!("{}", failure.message));
        found.modes.iter().map(|mode| mode.eigenvalue).collect::<Vec<_>>()
    };
    let free = frequency(&text);
    // `m g l/(I + m l²)`.
    assert!(free.len() == 1 && (free[0] - LEVEL / 0.27).abs() < 1e-9, "{free:?}");
    assert_eq!(frequency(&text.replace("t >= 1", "t >= 0")), Vec::<f64>::new());
}

/// The example of docs/language/drives.md: the hand lets go at 0.5 s, and the arrow leaves the string where it is
/// fastest, and flies on. The trigger is held in between.
#[test]
fn the_example_of_the_page_shoots() {
    let page = include_str!("../../../docs/language/drives.md");
    let text = page.split("```toml\n").find(|text| text.contains("name = \"Bow\"")).expect("the example");
    let text = text.split("```").next().expect("its end");
    let curves = Curves::run(text, &[]);
    let speed = curves.column("flight.velocity[1]");
    let [row, last] = [105, 140];
    assert!(speed[100].abs() < 0.01 && speed[row] > 5.0, "{} {}", speed[100], speed[row]);
    assert!((speed[last] - speed[row]).abs() < 1e-9 * speed[row], "{} {}", speed[last], speed[row]);
    let force = curves.column("hand_force.effort");
    assert!(force[99] < -10.0 && force[100] == 0.0, "{} {}", force[99], force[100]);
    let angle = curves.column("caught.angle");
    assert!(
        (angle[119] - angle[60]).abs() < 1e-10 && (angle[60] - 0.9).abs() < 1e-3 && angle[140] == angle[120],
        "{angle:?}"
    );
}

/// A lock that never engages in a run, and one that never lets go, are told at its end, with the times. One that switches is not, however short its pulse; neither are numbers, parameters and
/// what an equilibrium before the start has released.
#[test]
fn switches_that_never_switch_are_told() {
    let remedy = "0.5 all the time; correct the times in `active`, or run until it switches (simulation.stop)";
    let never = format!("lock brake never engages between t = 0 s and t = 1.2 s: `active` is below {remedy}");
    let always = format!("lock brake is never released between t = 0 s and t = 1.2 s: `active` is at least {remedy}");
    let preload = format!("{FIXED}\ninitial = \"equilibrium\"\npreload = 1");
    for (active, more, expected) in [
        ("\"t >= 1.5\"", FIXED, Some(&never)),
        ("\"t < 1.5\"", FIXED, Some(&always)),
        ("\"t >= 0.5\"", FIXED, None),
        ("\"t >= 0.50001 and t < 0.50002\"", FIXED, None),
        ("1", FIXED, None),
        ("\"on\"", &format!("{FIXED}\n[parameters]\non = 0"), None),
        ("0\ninput = true", FIXED, None),
        ("\"t < 0\"", &preload, None),
    ] {
        let mut simulation = start(&pendulum(active, more));
        run(&mut simulation, 0.1, 1.2, |_| ());
        simulation.take_warnings();
        simulation.conclude();
        let told = simulation.take_warnings();
        let told: Vec<_> = told.iter().filter(|warning| warning.contains("active")).collect();
        assert_eq!(told, Vec::from_iter(expected), "{active}");
    }
}
