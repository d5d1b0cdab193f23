//! Does the account of energy close, and has each part of it the work that belongs there? The energy may change only by
//! the work of loads, actuators and drives, by what dampers take, and by the drift. A part that is left out or counted
//! twice opens the account; a part in a wrong column is at odds with a closed form.

use crate::running::{run, start, value};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

/// A damped arm that a drive swings under gravity, with a follower load at its end. On it hangs a body by a hinge with
/// a motor, friction, a stop and a damper; a moving frame pulls that body by a spring and a damper, a rope holds it,
/// and a law with a rate acts on the hinge.
const ALL: &str = r#"format = 1
model.name = "All"
model.gravity = [0, 0, -9.81]
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
position = [0.6, 0, 0]
inertia = [4e-4, 4e-4, 4e-4]
[frame.hand]
position = ["0.9 + 0.05*sin(9*t)", 0, "0.1*sin(7*t)"]
rotation = [0, "0.3*sin(4*t)", 0]
[point.grip]
on = "hand"
offset = [0.02, 0, 0.01]
[joint.root]
type = "revolute"
a = "ground"
b = "arm.start"
axis = [0, 1, 0]
[drive.swing]
joint = "root"
coordinate = "angle"
value = "0.4*(1 - cos(6*t))"
[joint.hinge]
type = "revolute"
a = "arm.end"
b = "bob"
at = [0.5, 0, 0]
axis = [0, 1, 0]
damping = 0.002
[actuator.motor]
joint = "hinge"
coordinate = "angle"
effort = "0.05*sin(11*t)"
[friction.rub]
joint = "hinge"
coordinate = "angle"
coulomb = 0.01
speed = 0.1
[stop.end]
joint = "hinge"
coordinate = "angle"
lower = -0.2
upper = 0.2
stiffness = 50
damping = 0.5
[spring.law]
joint = "hinge"
coordinate = "angle"
force = "0.5*x + x^3 + 0.002*v"
[spring.pull]
a = "grip"
b = "bob"
stiffness = 30
damping = 0.3
[spring.rope]
a = "ground"
b = "bob"
stiffness = 500
damping = 1
length = 0.6
only = "tension"
[load.jet]
at = "arm.end"
force = [0, 0, "0.5*sin(13*t)"]
moment = [0, 0.02, 0]
follower = true
[load.wind]
on = "arm"
force = [0, "0.3*cos(3*t)", 0.4]
[simulation]
stop = 1
totals = ["energy", "work", "momentum", "statistics"]
"#;

const COLUMNS: [&str; 5] = ["work.loads", "work.actuators", "work.drives", "work.dissipated", "work.drift"];

fn account(simulation: &Simulation) -> [f64; 5] {
    COLUMNS.map(|name| value(simulation, name))
}

/// By how much the account is open at the worst row, of the sum of all changes of its columns; and the account at the
/// end.
fn open(text: &str, every: f64, stop: f64) -> (f64, [f64; 5]) {
    let mut simulation = start(text);
    let first = value(&simulation, "energy.total");
    assert_eq!(account(&simulation), [0.0; 5]);
    let (mut before, mut passed, mut worst) = ([0.0; 5], 0.0, 0.0_f64);
    run(&mut simulation, every, stop, |simulation| {
        let now = account(simulation);
        passed += now.iter().zip(before).map(|(now, before)| (now - before).abs()).sum::<f64>();
        let [loads, actuators, drives, dissipated, drift] = now;
        let change = value(simulation, "energy.total") - first;
        worst = worst.max((change - (loads + actuators + drives - dissipated + drift)).abs() / passed);
        before = now;
    });
    (worst, before)
}

/// With everything acting, the account closes to 1e-12 of what has passed through it: round-off. All columns but the
/// drift have a part in it. The drift, which closes the account, is small: 1.4e-7 of their sum for the midpoint rule
/// without dissipation, 7e-7 with it, 4e-4 with steps of 4 ms, 6e-5 for generalized-alpha, whose powers are those of
/// instants. A part that is missing would be 2 % and more.
#[test]
fn the_account_closes_with_everything_acting() {
    for (simulation, drift) in [
        ("step = 1e-3\nspectral_radius = 1", 1e-6),
        ("step = 1e-3", 1e-5),
        ("step = 4e-3\nspectral_radius = 0.6", 1e-3),
        ("accuracy = 1e-3", 1e-4),
        ("step = 1e-3\nintegrator = \"generalized_alpha\"", 3e-4),
    ] {
        let (open, account) = open(&format!("{ALL}{simulation}\n"), 0.01, 1.0);
        println!("{simulation:?}: open {open:.1e}, {account:?}");
        assert!(open < 1e-12, "{simulation}: {open:e}");
        let passed: f64 = account[..4].iter().map(|part| part.abs()).sum();
        assert!(account[4].abs() < drift * passed, "{simulation}: {account:?}");
        assert!(account[..4].iter().all(|part| part.abs() > 1e-3), "{simulation}: {account:?}");
        assert!(account[3] > 0.0, "{account:?}");
    }
}

/// A body on an axle, moment of inertia 0.04 kg m² about it, with `more`.
fn rotor(spin: f64, more: &str, simulation: &str) -> String {
    format!(
        "format = 1\nmodel.name = \"Rotor\"\n[body.rotor]\nmass = 1\nposition = [0, 0, 0]\ninertia = [0.03, 0.03, 0.04]\n\
         angular_velocity = [0, 0, {spin}]\n[joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"rotor\"\naxis = [0, 0, 1]\n{more}\n\
         [simulation]\nstop = 1\nstep = 1e-3\ntotals = [\"energy\", \"work\", \"momentum\", \"statistics\"]\n{simulation}\n"
    )
}

const INERTIA: f64 = 0.04;

/// Closed forms, each with one thing acting: the work is in its column and in no other. Steps of 1 ms leave 1e-4 of the
/// relative work where rates change within a step.
#[test]
fn work_is_in_the_column_of_its_origin() {
    let on = "joint = \"axle\"\ncoordinate = \"angle\"\n";
    // M² t²/(2 J) of a moment at rest; J w²/2 of a drive up to w = 3; what friction and dampers take of J w²/2.
    let moment = 0.1_f64.powi(2) / (2.0 * INERTIA);
    let spun = 0.5 * INERTIA * 9.0;
    let braked = 1.0 - f64::exp(-2.0 * 0.05 / INERTIA);
    for (what, text, expected) in [
        ("load", rotor(0.0, "[load.l]\nat = \"rotor\"\nmoment = [0, 0, 0.1]", ""), [moment, 0.0, 0.0, 0.0]),
        ("actuator", rotor(0.0, &format!("[actuator.m]\n{on}effort = 0.1"), ""), [0.0, moment, 0.0, 0.0]),
        ("drive", rotor(0.0, &format!("[drive.d]\n{on}value = \"1.5*t^2\""), ""), [0.0, 0.0, spun, 0.0]),
        ("damper", rotor(3.0, "damping = 0.05", ""), [0.0, 0.0, 0.0, spun * braked]),
        ("spring", rotor(3.0, &format!("[spring.s]\n{on}force = \"0.05*v\""), ""), [0.0, 0.0, 0.0, spun * braked]),
        (
            "friction",
            rotor(3.0, &format!("[friction.f]\n{on}coulomb = 0.02\nspeed = 1e-6"), ""),
            [0.0, 0.0, 0.0, spun * (1.0 - (1.0 - 0.5 / 3.0_f64).powi(2))],
        ),
    ] {
        for integrator in ["conserving", "generalized_alpha"] {
            let text = format!("{text}integrator = \"{integrator}\"\n");
            let (open, account) = open(&text, 0.1, 1.0);
            println!("{what}, {integrator}: open {open:.1e}, {account:?}");
            for (found, expected) in account.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-3 * moment, "{what}, {integrator}: {account:?} for {expected:?}");
            }
        }
    }
}

/// A frame that moves at a constant speed pulls a body by a damper alone: the work of the frame is the force times its
/// speed, and half of it becomes kinetic energy in the end.
#[test]
fn a_frame_works_through_a_damper() {
    // m v' = c (V - v): the force is c V exp(-c t/m).
    let (mass, damping, speed) = (0.5, 2.0, 3.0);
    let text = format!(
        "format = 1\nmodel.name = \"Drag\"\n[body.sled]\nmass = {mass}\nposition = [1, 0, 0]\ninertia = [1, 1, 1]\n\
         [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"sled\"\naxis = [1, 0, 0]\n\
         [frame.hook]\nposition = [\"4 + {speed}*t\", 0, 0]\n\
         [spring.tow]\na = \"hook\"\nb = \"sled\"\nstiffness = 0\ndamping = {damping}\n\
         [simulation]\nstop = 1\nstep = 1e-3\ntotals = [\"energy\", \"work\", \"momentum\", \"statistics\"]\n"
    );
    let (open, [loads, actuators, drives, dissipated, drift]) = open(&text, 0.1, 1.0);
    let fading = f64::exp(-damping / mass);
    let (given, kinetic) = (mass * speed * speed * (1.0 - fading), 0.5 * mass * speed * speed * (1.0 - fading).powi(2));
    println!("open {open:.1e}: {drives} for {given}, {dissipated} for {}, drift {drift:e}", given - kinetic);
    assert_eq!([loads, actuators], [0.0; 2]);
    // The midpoint rule is off by (c h/m)²/12.
    assert!((drives - given).abs() < 1e-4 * given && (dissipated - (given - kinetic)).abs() < 1e-4 * given);
}

/// A drive whose rate jumps from 0 to 2 rad/s strikes: its work is the kinetic energy, and none of it is drift.
#[test]
fn a_jump_of_a_drive_is_its_work() {
    let drive = "[drive.d]\njoint = \"axle\"\ncoordinate = \"angle\"\nrate = [{ until = 0.5, is = 0 }, { is = 2 }]";
    let (_, account) = open(&rotor(0.0, drive, ""), 0.1, 1.0);
    let expected = [0.0, 0.0, 0.5 * INERTIA * 4.0, 0.0, 0.0];
    println!("{account:?}");
    for (found, expected) in account.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-9, "{account:?}");
    }
}

/// The drift is what numerical dissipation takes: an undamped rod whose waves the steps do not resolve loses energy to
/// nothing else. Without dissipation, the error of the rule itself is left, 1e-8 of the energy: it falls with the cube
/// of the step, and with the square of the motion.
#[test]
fn the_drift_is_what_the_integrator_takes() {
    let rod = |radius: f64| {
        format!(
            "format = 1\nmodel.name = \"Rod\"\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
             [section.round]\nshape = \"circle\"\nradius = 0.01\n\
             [beam.rod]\nmaterial = \"steel\"\nsection = \"round\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\nangular_velocity = [0, 0, 1]\n\
             [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n\
             [simulation]\nstop = 1\nstep = 1e-3\nspectral_radius = {radius}\ntotals = [\"energy\", \"work\", \"momentum\", \"statistics\"]\n"
        )
    };
    let mut shares = Vec::new();
    for radius in [0.6, 1.0] {
        let mut simulation = start(&rod(radius));
        let first = value(&simulation, "energy.total");
        run(&mut simulation, 0.01, 0.1, |_| ());
        let account = account(&simulation);
        assert_eq!(account[..4], [0.0; 4]);
        shares.push(account[4] / first);
    }
    println!("{shares:?}");
    assert!(shares[0] < -1e-3 && shares[1].abs() < 1e-7, "{shares:?}");
}

/// The columns are there where the file asks for them, behind the energies, and change no other result.
#[test]
fn the_account_changes_no_other_result() {
    let asked = format!("{ALL}step = 1e-3\n");
    let plain = asked.replace("totals = [\"energy\", \"work\", \"momentum\", \"statistics\"]\n", "");
    let [asked, plain] = [&asked, &plain].map(|text| {
        let mut simulation = start(text);
        run(&mut simulation, 0.01, 0.1, |_| ());
        let variables = simulation.variables().iter().enumerate();
        variables
            .map(|(at, variable)| (variable.name.clone(), simulation.value(at).number().to_bits()))
            .collect::<Vec<_>>()
    });
    let place = plain.iter().position(|(name, _)| name == "energy.total").unwrap() + 1;
    assert_eq!(asked[..place], plain[..place]);
    assert_eq!(asked[place..place + 5].iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), COLUMNS);
    assert_eq!(asked[place + 5..], plain[place..]);
}

/// A simulation that goes back to a state, also through bytes, has the account of that state.
#[test]
fn the_account_belongs_to_the_state() {
    let text = format!("{ALL}step = 1e-3\n");
    let mut simulation = start(&text);
    run(&mut simulation, 0.01, 0.05, |_| ());
    let snapshot = simulation.snapshot();
    let bytes = simulation.write(&snapshot, Vec::new());
    let kept = account(&simulation);
    simulation.advance(0.1).unwrap();
    let later = account(&simulation);
    assert!(kept.iter().zip(later).all(|(kept, later)| *kept != later), "{kept:?} {later:?}");
    simulation.restore(&snapshot);
    assert_eq!(account(&simulation), kept);
    let mut other = start(&text);
    other.restore(&other.read(&bytes).unwrap_or_else(|failure| panic!("{}", failure.message)));
    other.advance(0.1).unwrap();
    assert_eq!(account(&other), later);
    // The bytes are of a model that asks for the account.
    assert!(
        start(&text.replace("totals = [\"energy\", \"work\", \"momentum\", \"statistics\"]\n", ""))
            .read(&bytes)
            .is_err()
    );
}
