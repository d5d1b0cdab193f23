//! Do joints, locks and drives engage and release as an engineer expects? What is released flies on as it moved; what engages holds where it stands, after an impact that conserves
//! momentum; what it holds it holds to round-off, with the reaction of statics. A multiplier that outlives its joint, a velocity that an impact forgets, or a step across a switch shows here.

use crate::curves::{Curves, load};
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
        assert!((effort[3] - 2.0).abs() < 1e-8 && effort[7] == 0.0, "{integrator}: {effort:?}");
        // The motor gives 1 J, and at 1 s takes what slows the wheel: at its rate, the impulse of 0.5 N m s; the rest is lost in the impact.
        let [drives, dissipated] = ["work.drives", "work.dissipated"].map(|name| curves.last(name));
        assert!((dissipated - 0.25).abs() < 1e-9, "{integrator}: {dissipated}");
        assert!((drives - (1.0 - 0.5)).abs() < 1e-6, "{integrator}: {drives}");
    }
}

/// A switch in the middle of steps costs no order: with half the step the error is a quarter.
#[test]
fn a_switch_keeps_the_order() {
    for integrator in ["conserving", "variational", "generalized_alpha"] {
        let text = pendulum("\"t >= 0.4137 and t < 0.6211\"", "step = 0.01\noutput_step = 0.1");
        let run = |step: &str| {
            let curves = Curves::run(&text, &[("simulation.integrator", integrator), ("simulation.step", step)]);
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

/// A statics analysis: a prop carries the arm until it is taken away; the spring behind it takes over. A lock holds what the arm has then.
#[test]
fn equilibria_switch_too() {
    let text = r#"format = 1
[model]
name = "Prop"
gravity = [0, 0, -9.81]
[body.arm]
mass = 1
position = [0.5, 0, 0]
inertia = [0.01, 0.02, 0.02]
[joint.hinge]
type = "revolute"
a = "ground"
b = "arm"
at = [0, 0, 0]
axis = [0, 1, 0]
[spring.law]
joint = "hinge"
coordinate = "angle"
stiffness = 20
[load.push]
at = "arm"
force = [0, 0, "-10*t"]
[lock.prop]
joint = "hinge"
coordinate = "angle"
active = "t < 0.5 or t >= 0.75"
[output.H]
at = "hinge"
quantities = ["angle"]
[output.P]
at = "prop"
quantities = ["effort"]
[simulation]
analysis = "static"
stop = 1
step = 0.125
output_step = 0.125
"#;
    let curves = Curves::run(text, &[]);
    let [angle, effort] = ["H.angle", "P.effort"].map(|name| curves.column(name));
    assert!(angle[..4].iter().all(|angle| angle.abs() < 1e-12), "{angle:?}");
    assert!((effort[2] + 0.5 * (9.81 + 2.5)).abs() < 1e-9, "{effort:?}");
    for row in [4, 5] {
        let force = 9.81 + 1.25 * row as f64;
        assert!((20.0 * angle[row] - 0.5 * force * angle[row].cos()).abs() < 1e-8, "{angle:?}");
        assert!(effort[row] == 0.0);
    }
    assert!(angle[6..].iter().all(|own| (own - angle[5]).abs() < 1e-12), "{angle:?}");
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

/// A beam with a body at its end that a latch lets go, a wheel on the body with a brake, and a dock that takes hold of the body in flight: all of it switches between 0.1 s and 0.3 s.
const EVERYTHING: &str = r#"format = 1
[model]
name = "Everything"
gravity = [0, 0, -9.81]
[material.plastic]
young = 2e9
poisson = 0.4
density = 1200
damping = 1e-3
[section.bar]
shape = "rectangle"
width = 0.02
height = 0.01
[beam.arm]
material = "plastic"
section = "bar"
from = [0, 0, 0]
to = [0.5, 0, 0]
elements = 3
[body.bob]
mass = 0.2
position = [0.55, 0, 0]
inertia = [4e-4, 4e-4, 4e-4]
[body.wheel]
mass = 0.1
position = [0.55, 0.05, 0]
inertia = [1e-4, 2e-4, 1e-4]
angular_velocity = [0, 30, 0]
[body.net]
mass = 0.5
position = [0.7, 0, -0.3]
inertia = [1e-3, 1e-3, 2e-3]
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[joint.latch]
type = "weld"
a = "arm.end"
b = "bob"
at = [0.5, 0, 0]
active = "t < 0.1234"
[joint.axle]
type = "revolute"
a = "bob"
b = "wheel"
axis = [0, 1, 0]
[lock.brake]
joint = "axle"
coordinate = "angle"
active = "t >= 0.155 and t < 0.23"
[joint.dock]
type = "revolute"
a = "net"
b = "bob"
axis = [0, 0, 1]
active = "t >= 0.2"
[drive.turner]
joint = "dock"
coordinate = "angle"
rate = "2 + t"
[load.push]
at = "bob"
force = [0, 0, 0.3]
moment = [0, 0.01, 0]
input = true
[output.B]
at = "bob"
quantities = ["position", "velocity", "angular_velocity", "acceleration"]
[output.N]
at = "net"
quantities = ["position", "quaternion", "velocity"]
[output.A]
at = "axle"
quantities = ["angle", "angle_rate", "reaction_moment"]
[output.D]
at = "dock"
quantities = ["angle", "angle_rate", "reaction_force"]
[output.K]
at = "brake"
quantities = ["effort"]
[simulation]
stop = 0.3
step = 2e-3
output_step = 0.02
tolerance = 1e-12
totals = ["energy", "work", "momentum", "statistics"]
"#;

/// The same bits behind a saved state, through bytes, wherever it was taken: before switches change, between them, behind them.
#[test]
fn saved_states_know_the_switches() {
    let chosen = EVERYTHING.replace("step = 2e-3\noutput_step", "output_step");
    let alpha = EVERYTHING.replace("[simulation]\n", "[simulation]\nintegrator = \"generalized_alpha\"\n");
    for text in [EVERYTHING, &chosen, &alpha] {
        let mut simulation = load(text, &[]);
        let bits = |simulation: &ancf14::model::simulation::Simulation| {
            let all = 0..simulation.variables().len();
            all.map(|reference| simulation.value(reference).number().to_bits()).collect::<Vec<_>>()
        };
        let mut rows = Vec::new();
        let mut snapshots = vec![simulation.snapshot()];
        run(&mut simulation, 0.02, 0.3, |now| {
            rows.push(bits(now));
            snapshots.push(now.snapshot());
        });
        for first in [3, 6, 7, 8, 10, 12, 14] {
            let mut other = load(text, &[]);
            let bytes = simulation.write(&snapshots[first], Vec::new());
            let read = other.read(&bytes).unwrap_or_else(|failure| panic!("{}", failure.message));
            other.restore(&read);
            simulation.restore(&snapshots[first]);
            for (number, row) in rows.iter().enumerate().skip(first) {
                let end = f64::from(number as u32 + 1) * 0.02;
                for own in [&mut simulation, &mut other] {
                    own.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
                    assert_eq!(bits(own), *row, "from {first}, row {number}");
                }
            }
        }
    }
}

/// Derivatives of a communication step over which switches change: those of the motion behind them, with what they hold. Compared with differences of repeated steps.
#[test]
fn derivatives_pass_switches() {
    for integrator in ["conserving", "generalized_alpha"] {
        let mut simulation = load(EVERYTHING, &[("simulation.integrator", integrator)]);
        let inputs: Vec<usize> = (0..simulation.variables().len())
            .filter(|place| simulation.variables()[*place].name.starts_with("push."))
            .collect();
        assert_eq!(inputs.len(), 6);
        let outputs: Vec<usize> = (0..simulation.variables().len())
            .filter(|place| {
                ["B.", "N.", "A.", "D.", "K."].iter().any(|own| simulation.variables()[*place].name.starts_with(own))
            })
            .collect();
        // The latch, the brake, the dock with its drive, the brake again; all of them.
        for [begin, end] in [[0.1, 0.14], [0.14, 0.17], [0.19, 0.21], [0.21, 0.25], [0.1, 0.26], [0.26, 0.28]] {
            simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
            simulation.advance(begin).unwrap_or_else(|failure| panic!("{}", failure.message));
            let start = simulation.snapshot();
            let mut at = |place: usize, by: f64| {
                simulation.restore(&start);
                let own = simulation.value(place).number();
                simulation
                    .set_value(place, ancf14::fmi::Value::Real(own + by))
                    .unwrap_or_else(|failure| panic!("{}", failure.message));
                simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
                let values: Vec<f64> = outputs.iter().map(|output| simulation.value(*output).number()).collect();
                (
                    values,
                    outputs.iter().map(|output| simulation.partial_derivative_of(*output, place)).collect::<Vec<f64>>(),
                )
            };
            for place in &inputs {
                let by = 1e-3;
                let (after, _) = at(*place, by);
                let (before, _) = at(*place, -by);
                let (_, derivatives) = at(*place, 0.0);
                let largest = derivatives.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                for (number, derivative) in derivatives.iter().enumerate() {
                    let difference = (after[number] - before[number]) / (2.0 * by);
                    // Differences of second order, and round-off of 1e-12 of the values over the change.
                    let tolerance = 2e-4 * difference.abs() + 1e-6 * largest;
                    assert!(
                        (derivative - difference).abs() < tolerance,
                        "{integrator}, {begin} to {end}: output {number} by input {place}: {derivative} {difference}"
                    );
                }
            }
        }
    }
}

trait Derivative {
    fn partial_derivative_of(&mut self, output: usize, input: usize) -> f64;
}

impl Derivative for ancf14::model::simulation::Simulation {
    fn partial_derivative_of(&mut self, output: usize, input: usize) -> f64 {
        Model::partial_derivative(self, output, input).unwrap_or_else(|failure| panic!("{}", failure.message))
    }
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
