//! Does a linear unit repeat its steps to the bit after it went back, in the same instance and in another one?

use super::{U0, begun, oscillator, outputs};
use crate::random::Random;
use ancf14::fmi::instance::Instance;
use ancf14::fmi::lifecycle::Call;
use ancf14::model::simulation::Simulation;
use ancf14::packed::Packed;

/// Five steps with other lengths and inputs.
fn go_on(instance: &mut Instance<Packed>, random: &mut Random) -> [u64; 3] {
    let mut time = instance.time();
    for _ in 0..5 {
        instance.set_real(&[0], &[U0 + random.signed()]).unwrap();
        instance.set_real_input_derivatives(&[0], &[1], &[random.signed()]).unwrap();
        let step = 0.1 * (1.5 + random.signed());
        instance.do_step(time, step).unwrap();
        time += step;
    }
    outputs::<3>(instance, 1).map(f64::to_bits)
}

/// A state taken in the middle, with a derivative set for the next step, leads to the same bits: whatever matrices an
/// instance has kept, and in an instance that has read its bytes.
#[test]
fn steps_repeat_to_the_bit() {
    let mut instance = begun(oscillator());
    go_on(&mut instance, &mut Random(1));
    instance.set_real_input_derivatives(&[0], &[1], &[0.125]).unwrap();
    let state = instance.state().unwrap();
    let bytes = instance.serialize(Call::SerializeFMUstate, &state).unwrap();
    let step = |instance: &mut Instance<Packed>| {
        let time = instance.time();
        instance.do_step(time, 0.037).unwrap();
        let mut change = [f64::NAN; 3];
        instance.directional_derivative(&[1, 2, 3], &[0], &[1.0], &mut change).unwrap();
        (change.map(f64::to_bits), go_on(instance, &mut Random(2)))
    };
    let first = step(&mut instance);
    for seed in 3..6 {
        go_on(&mut instance, &mut Random(seed));
        instance.set_state(&state).unwrap();
        assert_eq!(step(&mut instance), first);
    }
    let mut other = begun(oscillator());
    let read = other.deserialize(&bytes).unwrap();
    other.set_state(&read).unwrap();
    assert_eq!(step(&mut other), first);
}

/// A state of another system is refused by the GUID; damaged bytes behind an intact header by their shape.
#[test]
fn foreign_states_are_refused() {
    let instance = begun(oscillator());
    let state = instance.state().unwrap();
    let bytes = instance.serialize(Call::SerializeFMUstate, &state).unwrap();
    let mut file = oscillator();
    file.b.values[1] = 2.0;
    let mut other = begun(file);
    assert!(other.deserialize(&bytes).is_err());
    assert!(other.set_state(&state).is_err());
    let mechanism = Simulation::load("model.toml", crate::fmi::ffi::MODEL, &[]).unwrap();
    let mut mechanism = Instance::new(Packed::Mechanism(Box::new(mechanism)), false);
    let own = mechanism.serialize(Call::SerializeFMUstate, &mechanism.state().unwrap()).unwrap();
    assert!(mechanism.set_state(&state).is_err() && instance.deserialize(&own).is_err());
    let foreign = mechanism.serialize(Call::SerializeFMUstate, &state).unwrap();
    assert_eq!(foreign, bytes, "a host may have a state written by another unit");
    for count in 0..bytes.len() {
        assert!(instance.deserialize(&bytes[..count]).is_err(), "{count} bytes");
    }
}
