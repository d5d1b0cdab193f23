//! Long random sequences of calls: does a unit always do the same, and never forget what it must give back? A machine
//! with every kind of input is set, stepped, saved, taken back, shipped as bytes, reset and started anew, a thousand
//! times a sequence; the same sequence twice gives the same bits, and so do the same steps after a way back, in another
//! instance too. Wrong calls in between are refused and leave no trace: the bits are those of the sequence without
//! them.

use ancf14::{ffi::types::fmi2Status, fmi::lifecycle::Mode};
use std::{process::Command, ptr::null_mut};

use super::{
    mischief,
    unit::{Place, Saved, Unit, is_fine},
};
use crate::random::Random;
use crate::support::allocations;

/// An arm on a frame that the host moves, with a wheel that the host turns; the host pushes its end.
const MODEL: &str = r#"
format = 1
[model]
name = "Puppet"
gravity = [0.0, 0.0, -9.81]
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850.0
[section.rod]
shape = "circle"
radius = 0.01
[frame.hand]
position = [0.0, 0.0, 0.0]
input = true
[beam.arm]
material = "steel"
section = "rod"
from = [0.0, 0.0, 0.0]
to = [1.0, 0.0, 0.0]
elements = 2
[joint.grip]
type = "weld"
a = "hand"
b = "arm.start"
[body.wheel]
mass = 0.5
position = [1.0, 0.0, 0.1]
inertia = [1e-3, 1e-3, 1e-3]
[joint.axle]
type = "revolute"
a = "arm.end"
b = "wheel"
axis = [1.0, 0.0, 0.0]
[drive.motor]
joint = "axle"
coordinate = "angle"
input = "rate"
[load.push]
at = "arm.end"
force = [0.0, 0.0, 0.0]
moment = [0.0, 0.0, 0.0]
input = true
[output.tip]
at = "arm.end"
quantities = ["position", "velocity"]
[output.axle_load]
at = "axle"
quantities = ["reaction_force", "angle", "effort"]
[simulation]
stop = 1.0
step = 1e-3
output_step = 1e-3
"#;

const LENGTH: usize = 1000;
const SLOTS: usize = 4;
/// A force that no step can take, N.
const BLOW: f64 = 1e20;

/// One step of a sequence; legal where it comes.
#[derive(Clone, Copy, Debug)]
enum Action {
    Setup {
        start: f64,
    },
    Material {
        young: f64,
    },
    Mesh {
        elements: i32,
    },
    Gravity {
        along_z: f64,
    },
    Push {
        along: usize,
        force: f64,
    },
    Move {
        along: usize,
        place: f64,
    },
    Turn {
        rate: f64,
    },
    Slope {
        along: usize,
        slope: f64,
    },
    Enter,
    Exit,
    Step {
        step: f64,
    },
    /// A step that fails, under a blow.
    Break,
    Terminate,
    Reset,
    Save {
        slot: usize,
    },
    Restore {
        slot: usize,
    },
    Forget {
        slot: usize,
    },
    /// A saved state becomes bytes, and the bytes take its place.
    Ship {
        slot: usize,
    },
    /// Some steps, back, and the same again; then again in another instance, which gets the state as bytes.
    Repeat {
        seed: u64,
    },
}

/// Communication steps: internal ones, several of them, parts of them.
fn some_step(random: &mut Random) -> f64 {
    [1e-3, 1e-3, 2e-3, 3e-3, 0.4e-3, 1.7e-3][random.below(6)]
}

fn push(random: &mut Random) -> Action {
    Action::Push { along: random.below(6), force: 2.0 * random.signed() }
}

/// Where the standard says that an action leads.
fn follow(action: Action, mode: &mut Mode, slots: &mut [Option<Mode>; SLOTS]) {
    match action {
        Action::Enter => *mode = Mode::Initialization,
        Action::Exit => *mode = Mode::Step,
        Action::Break => *mode = Mode::Error,
        Action::Terminate => *mode = Mode::Terminated,
        Action::Reset => *mode = Mode::Instantiated,
        Action::Save { slot } => slots[slot] = Some(*mode),
        Action::Restore { slot } => *mode = slots[slot].unwrap(),
        Action::Forget { slot } => slots[slot] = None,
        _ => (),
    }
}

/// An action that is legal in `mode` with these saved states.
fn legal(random: &mut Random, mode: Mode, slots: &[Option<Mode>; SLOTS]) -> Action {
    let slot = random.below(SLOTS);
    if random.below(100) < 12 {
        return match (random.below(6), slots[slot]) {
            (2 | 3, Some(_)) => Action::Restore { slot },
            (4, Some(_)) => Action::Forget { slot },
            (5, Some(_)) => Action::Ship { slot },
            _ => Action::Save { slot },
        };
    }
    let gravity = Action::Gravity { along_z: -10.0 * (1.0 + 0.5 * random.signed()) };
    let place = Action::Move { along: random.below(3), place: 1e-4 * random.signed() };
    let material = Action::Material { young: 2e11 * (1.0 + 0.5 * random.signed()) };
    match mode {
        Mode::Instantiated => match random.below(9) {
            0 => Action::Setup { start: random.signed() },
            1 => material,
            2 => Action::Mesh { elements: 1 + random.below(3) as i32 },
            3 => gravity,
            // Not a place of the frame: a motion begins where it is drawn.
            4 | 5 => push(random),
            _ => Action::Enter,
        },
        Mode::Initialization => match random.below(6) {
            0 => material,
            1 => gravity,
            2 => push(random),
            _ => Action::Exit,
        },
        Mode::Step => match random.below(100) {
            0..15 => push(random),
            15..23 => place,
            23..31 => Action::Turn { rate: 5.0 * random.signed() },
            31..39 => Action::Slope { along: random.below(6), slope: 1e3 * random.signed() },
            39..45 => gravity,
            45..50 => Action::Repeat { seed: random.below(1 << 30) as u64 },
            50 => Action::Break,
            51 | 52 => Action::Terminate,
            53 => Action::Reset,
            _ => Action::Step { step: some_step(random) },
        },
        _ => match slots[slot] {
            Some(_) => Action::Restore { slot },
            None => Action::Reset,
        },
    }
}

fn sequence(random: &mut Random) -> Vec<Action> {
    let (mut mode, mut slots) = (Mode::Instantiated, [None; SLOTS]);
    let mut next = |_| {
        let action = legal(random, mode, &slots);
        follow(action, &mut mode, &mut slots);
        action
    };
    (0..LENGTH).map(&mut next).collect()
}

/// Some steps under pushes; the bits after each.
fn steps(unit: &Unit, place: &Place, seed: u64) -> Vec<u64> {
    let mut random = Random(seed);
    let mut bits = Vec::new();
    for _ in 0..3 {
        assert!(is_fine(unit.set_real(&[place.reference("push.force[3]")], &[random.signed()])));
        assert!(is_fine(unit.do_step(unit.time(), some_step(&mut random))), "{:?}", unit.lines.take());
        bits.extend(unit.bits());
    }
    bits
}

/// The same steps three times: on, back and on, and in another instance that gets the state as bytes.
fn repeat(unit: &Unit, other: &Unit, place: &Place, seed: u64) {
    let (mut saved, mut shipped) = (null_mut(), null_mut());
    assert!(is_fine(unit.save(&mut saved)));
    let expected = steps(unit, place, seed);
    assert!(is_fine(unit.restore(saved)));
    assert!(steps(unit, place, seed) == expected, "other bits after the way back");
    let bytes = unit.serialize(saved);
    assert!(is_fine(other.deserialize(&bytes, &mut shipped)), "{:?}", other.lines.take());
    assert!(is_fine(other.restore(shipped)));
    assert!(steps(other, place, seed) == expected, "other bits in another instance");
    assert!(is_fine(unit.forget(&mut saved)) && is_fine(other.forget(&mut shipped)));
}

/// Does what an action says; the status of the call.
fn act(action: Action, unit: &Unit, other: &Unit, place: &Place, slots: &mut [Saved; SLOTS]) -> fmi2Status {
    use ancf14::fmi::lifecycle::Call;
    let set = |name: &str, value| unit.set_real(&[place.reference(name)], &[value]);
    let pushed = |along: usize| match along {
        0..3 => format!("push.force[{}]", along + 1),
        _ => format!("push.moment[{}]", along - 2),
    };
    match action {
        Action::Setup { start } => unit.setup(start),
        Action::Material { young } => set("steel.young", young),
        Action::Mesh { elements } => unit.set_integer(place.reference("arm.elements"), elements),
        Action::Gravity { along_z } => set("gravity[3]", along_z),
        Action::Push { along, force } => set(&pushed(along), force),
        Action::Move { along, place } => set(&format!("hand.position[{}]", along + 1), place),
        Action::Turn { rate } => set("motor.rate", rate),
        Action::Slope { along, slope } => unit.set_slope(place.reference(&pushed(along)), 1, slope),
        Action::Enter => unit.simple(Call::EnterInitializationMode),
        Action::Exit => unit.simple(Call::ExitInitializationMode),
        Action::Step { step } => unit.do_step(unit.time(), step),
        Action::Break => {
            assert!(is_fine(set("push.force[3]", BLOW)));
            assert_eq!(unit.do_step(unit.time(), 1e-3), fmi2Status::fmi2Error);
            fmi2Status::fmi2OK
        }
        Action::Terminate => unit.simple(Call::Terminate),
        Action::Reset => unit.simple(Call::Reset),
        Action::Save { slot } => unit.save(&mut slots[slot]),
        Action::Restore { slot } => unit.restore(slots[slot]),
        Action::Forget { slot } => unit.forget(&mut slots[slot]),
        Action::Ship { slot } => {
            let bytes = unit.serialize(slots[slot]);
            unit.deserialize(&bytes, &mut slots[slot])
        }
        Action::Repeat { seed } => {
            repeat(unit, other, place, seed);
            fmi2Status::fmi2OK
        }
    }
}

/// The bits after every action of a sequence, with wrong calls in between if there is somebody to make them.
fn run(place: &Place, actions: &[Action], mut mischievous: Option<Random>) -> Vec<u64> {
    let (unit, other) = (Unit::new(place), Unit::new(place));
    let (mut mode, mut modes, mut slots) = (Mode::Instantiated, [None; SLOTS], [null_mut(); SLOTS]);
    let mut bits = Vec::new();
    for (number, action) in actions.iter().enumerate() {
        if let Some(random) = &mut mischievous {
            mischief::play(&unit, place, mode, random);
        }
        let status = act(*action, &unit, &other, place, &mut slots);
        assert!(is_fine(status), "{number}: {action:?} {mode}: {:?}", unit.lines.take());
        follow(*action, &mut mode, &mut modes);
        bits.extend(unit.bits());
        unit.lines.take();
    }
    for slot in &mut slots {
        assert!(is_fine(unit.forget(slot)));
    }
    bits
}

/// Set in a process that runs a single test.
const ALONE: &str = "ANCF14_TEST_ALONE";

/// Runs the body of the test `name` in a process of its own: the list of live handles belongs to the process, and other
/// tests change it meanwhile.
pub fn alone(name: &str, body: impl FnOnce()) {
    if std::env::var_os(ALONE).is_some() {
        return body();
    }
    let mut child = Command::new(std::env::current_exe().unwrap());
    let child = child.args(["--exact", name, "--test-threads=1", "--nocapture"]).env(ALONE, "1");
    let output = child.output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    println!("{told}");
    assert!(output.status.success() && told.contains("1 passed"), "{told}{}", String::from_utf8_lossy(&output.stderr));
}

/// Twice the same bits, and after the second run nothing more is in memory than before it.
#[test]
fn random_sequences_repeat_and_leave_nothing() {
    alone("fmi::sequences::random_sequences_repeat_and_leave_nothing", || {
        for seed in [1, 2] {
            let place = Place::new(MODEL);
            let actions = sequence(&mut Random(seed));
            let steps = actions.iter().filter(|action| matches!(action, Action::Step { .. })).count();
            assert!(steps > LENGTH / 4, "most of a sequence are steps, not {steps}");
            let expected = run(&place, &actions, None);
            let left = allocations::left_over(|| {
                assert!(run(&place, &actions, None) == expected, "other bits the second time")
            });
            assert_eq!(left, 0, "allocations of a run that were not given back");
        }
    });
}

/// Wrong calls between all actions change nothing.
#[test]
fn wrong_calls_leave_no_trace() {
    alone("fmi::sequences::wrong_calls_leave_no_trace", || {
        for seed in [3, 4] {
            let place = Place::new(MODEL);
            let actions = sequence(&mut Random(seed));
            let expected = run(&place, &actions, None);
            let left = allocations::left_over(|| {
                assert!(run(&place, &actions, Some(Random(5))) == expected, "other bits than without wrong calls");
            });
            assert_eq!(left, 0, "allocations of a run that were not given back");
        }
    });
}
