//! Serialized FMU states: whole ones are read back, anything else is refused with the reason.

use super::toy::{FORCE, Toy, toy};
use ancf14::fmi::error::Error;
use ancf14::fmi::instance::Instance;
use ancf14::fmi::lifecycle::Call;

/// A toy after a step, its state as bytes.
fn stepped() -> (Instance<Toy>, Vec<u8>) {
    let mut instance = Instance::new(toy(), false);
    instance.setup_experiment(None, 0.5, Some(9.0)).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    instance.set_real(&[FORCE], &[3.0]).unwrap();
    instance.do_step(0.5, 0.25).unwrap();
    let bytes = instance.serialize(Call::SerializeFMUstate, &instance.state().unwrap()).unwrap();
    (instance, bytes)
}

fn problem(bytes: &[u8]) -> String {
    match Instance::new(toy(), false).deserialize(bytes) {
        Err(Error::Serialized { problem }) => problem,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("{} bytes were taken", bytes.len()),
    }
}

/// Mode, times and values come back in an instance that has done nothing yet, and it goes on alike.
#[test]
fn another_instance_goes_on() {
    let (mut first, bytes) = stepped();
    let mut second = Instance::new(toy(), false);
    let state = second.deserialize(&bytes).unwrap();
    second.set_state(&state).unwrap();
    assert_eq!((second.mode(), second.time()), (first.mode(), first.time()));
    for instance in [&mut first, &mut second] {
        instance.do_step(0.75, 0.25).unwrap();
        assert!(instance.do_step(1.0, 8.5).is_err(), "the stop time is 9 s");
    }
    assert_eq!(first.model().plain(), second.model().plain());
    let again = second.serialize(Call::SerializeFMUstate, &state).unwrap();
    assert_eq!(again, bytes);
}

/// Every shorter piece, every flipped bit, and bytes too many.
#[test]
fn damaged_bytes_are_refused() {
    let (_, bytes) = stepped();
    for length in 0..bytes.len() {
        problem(&bytes[..length]);
    }
    for bit in 0..8 * bytes.len() {
        let mut damaged = bytes.clone();
        damaged[bit / 8] ^= 1 << (bit % 8);
        problem(&damaged);
    }
    assert!(problem(&[&bytes[..], &[0]].concat()).contains("bytes were written behind the header"));
    assert!(problem(b"ancf14").contains("do not begin as such a state does (there are 6 bytes)"));
    let other_layout = [&bytes[..8], &99_u32.to_le_bytes(), &bytes[12..]].concat();
    assert!(problem(&other_layout).contains("layout 99"));
}

/// The state of another model names both.
#[test]
fn foreign_states_are_refused() {
    let (_, bytes) = stepped();
    let mut other = toy();
    other.rename("{11111111-0000-0000-0000-000000000000}");
    let refused = Instance::new(other, false).deserialize(&bytes).err().unwrap();
    assert!(matches!(&refused, Error::ForeignState { own, .. } if own.starts_with("{1111")), "{refused}");
}
