//! Random calls with random arguments on shipped models: is every one of them answered as the calling table says?
//! Whatever comes, NULL, numbers that are none, values at the limits, handles that were given back, nothing may panic;
//! a call that is refused changes nothing and says why; values that are handed out are finite; and what follows a saved
//! state is the same to the bit each time.
#![allow(unsafe_code, reason = "tests of the C ABI")]

mod calls;
mod host;

use ancf14::ffi::{fmi2::*, fmi2_values::*, types::*};
use ancf14::fmi::lifecycle::{Call, Mode};
use std::ptr::null_mut;

use self::host::Host;
use super::sequences::alone;
use super::unit::{Place, Unit, is_fine};
use crate::fuzz::round;
use crate::random::Random;

/// A small machine without inputs, and one with a host that drives its foot; few elements make quick steps.
fn places() -> [Place; 2] {
    let pendulum = include_str!("../../../../models/pendulum.toml").replace("elements = 8", "elements = 2");
    let crane = include_str!("../../../../models/crane.toml").replace("elements = 6", "elements = 2");
    [Place::new(&pendulum), Place::new(&crane)]
}

/// Calls of a sequence.
const LENGTH: usize = 150;

/// Calls of one sequence.
fn sequence(place: &Place, seed: u64) {
    let mut host = Host::new(place, Random(seed));
    for _ in 0..LENGTH {
        host.play();
        if host.mode == Mode::Step && host.random.below(30) == 0 {
            host.repeat();
        }
    }
}

#[test]
fn calls_are_answered_as_the_table_says() {
    alone("fmi::fuzz::calls_are_answered_as_the_table_says", || {
        let places = places();
        round("sequences of calls", 15, |seed| {
            sequence(&places[seed as usize % places.len()], seed);
            Ok(())
        });
    });
}

/// The bytes of a state with some of them changed, and a checksum that fits.
fn forged(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    const CHECKSUM: usize = 20;
    const HEADER: usize = 24;
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + random.below(3) {
        let at = HEADER + random.below(bytes.len() - HEADER);
        bytes[at] = match random.below(3) {
            0 => bytes[at] ^ 1 << random.below(8),
            1 => random.below(256) as u8,
            _ => [0, 1, 0x7f, 0x80, 0xff][random.below(5)],
        };
    }
    let checksum = crc32fast::hash(&bytes[HEADER..]).to_le_bytes();
    bytes[CHECKSUM..HEADER].copy_from_slice(&checksum);
    bytes
}

/// Restores a forged state, if it is one, and uses the unit.
fn use_forged(place: &Place, random: &mut Random) {
    let unit = Unit::new(place);
    let steps = random.below(4);
    if steps > 0 {
        assert!(
            is_fine(unit.simple(Call::EnterInitializationMode)) && is_fine(unit.simple(Call::ExitInitializationMode))
        );
    }
    (1..steps).for_each(|_| assert!(is_fine(unit.do_step(unit.time(), 1e-3))));
    let (mut saved, mut read) = (null_mut(), null_mut());
    assert!(is_fine(unit.save(&mut saved)));
    let bytes = forged(&unit.serialize(saved), random);
    let outputs = place.outputs();
    let (mut values, orders) = (vec![0.0; outputs.len()], vec![1; outputs.len()]);
    let mut answers = vec![unit.deserialize(&bytes, &mut read)];
    if is_fine(answers[0]) {
        let (mut time, mut internal) = (0.0, [1e-3]);
        answers.push(unit.restore(read));
        answers.push(unit.get_real(&outputs, &mut values));
        unit.get_real(&[place.reference("simulation.step")], &mut internal);
        // SAFETY: the unit is live, and all arrays are as long as is said.
        unsafe {
            fmi2GetRealStatus(unit.c, fmi2LastSuccessfulTime, &raw mut time);
            answers.push(unit.do_step(time, internal[0]));
            let count = outputs.len();
            let rates =
                fmi2GetRealOutputDerivatives(unit.c, outputs.as_ptr(), count, orders.as_ptr(), values.as_mut_ptr());
            answers.push(rates);
        }
        answers.push(unit.simple(Call::Reset));
        answers.push(unit.simple(Call::EnterInitializationMode));
        answers.push(unit.simple(Call::ExitInitializationMode));
    }
    let lines = unit.lines.take();
    assert!(answers.iter().all(|status| *status != fmi2Status::fmi2Fatal), "{answers:?} {lines:?}");
    unit.forget(&mut saved);
    unit.forget(&mut read);
}

#[test]
fn forged_states_are_refused_or_used() {
    alone("fmi::fuzz::forged_states_are_refused_or_used", || {
        let places = places();
        round("forged states", 100, |seed| {
            use_forged(&places[seed as usize % places.len()], &mut Random(seed));
            Ok(())
        });
    });
}
