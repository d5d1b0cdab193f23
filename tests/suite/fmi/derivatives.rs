//! Derivatives through an instance: only of outputs, only by inputs, all of a call or none.

use super::toy::{AREA, COUNT, FORCE, GAIN, LENGTH, POSITION, TIME, toy};
use ancf14::fmi::error::Error;
use ancf14::fmi::instance::Instance;

fn stepped(steps: u32) -> Instance<super::toy::Toy> {
    let mut instance = Instance::new(toy(), false);
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    instance.set_real(&[FORCE], &[3.0]).unwrap();
    for step in 0..steps {
        instance.do_step(0.5 * f64::from(step), 0.5).unwrap();
    }
    instance
}

/// First derivatives of Real outputs, and nothing else; a call that fails writes nothing.
#[test]
fn derivatives_by_time() {
    let mut instance = stepped(1);
    let mut values = [0.0; 2];
    instance.get_real_output_derivatives(&[POSITION, POSITION], &[1, 1], &mut values).unwrap();
    assert_eq!(values, [6.0, 6.0]);
    for (reference, order) in [(POSITION, 2), (POSITION, 0), (GAIN, 1), (FORCE, 1), (COUNT, 1), (TIME, 1), (99, 1)] {
        let mut values = [7.0; 2];
        let refused = instance.get_real_output_derivatives(&[POSITION, reference], &[1, order], &mut values);
        assert!(refused.is_err(), "{reference} {order}");
        assert_eq!(values, [7.0; 2]);
    }
    assert!(matches!(
        instance.get_real_output_derivatives(&[POSITION], &[1], &mut []),
        Err(Error::LengthsDiffer { references: 1, values: 0 })
    ));
}

/// Of Real outputs by Real inputs, each with its seed; before a step they are 0.
#[test]
fn derivatives_by_inputs() {
    let mut change = [7.0];
    stepped(0).directional_derivative(&[POSITION], &[FORCE], &[1.0], &mut change).unwrap();
    assert_eq!(change, [0.0]);
    let mut instance = stepped(1);
    instance.directional_derivative(&[POSITION], &[FORCE], &[0.25], &mut change).unwrap();
    assert_eq!(change, [0.5]);
    instance.directional_derivative(&[POSITION], &[FORCE, FORCE], &[1.0, -3.0], &mut change).unwrap();
    assert_eq!(change, [-4.0]);
    instance.directional_derivative(&[POSITION], &[], &[], &mut change).unwrap();
    assert_eq!(change, [0.0]);
    for (unknown, known, seed) in
        [(GAIN, FORCE, 1.0), (COUNT, FORCE, 1.0), (POSITION, GAIN, 1.0), (POSITION, FORCE, f64::NAN), (99, FORCE, 1.0)]
    {
        let mut change = [7.0];
        assert!(
            instance.directional_derivative(&[unknown], &[known], &[seed], &mut change).is_err(),
            "{unknown} {known}"
        );
        assert_eq!(change, [7.0]);
    }
    assert!(instance.directional_derivative(&[POSITION], &[FORCE], &[], &mut change).is_err());
}

/// Seeds may be so large that their products exceed the range of a double: an error then, not an infinite change, and
/// no element of the array is written.
#[test]
fn regression_changes_are_finite() {
    let mut instance = stepped(1);
    let mut changes = [7.0; 2];
    for seeds in [[f64::MAX, f64::MAX], [f64::MAX, f64::MIN]] {
        let outcome = instance.directional_derivative(&[POSITION, POSITION], &[FORCE, FORCE], &seeds, &mut changes);
        assert!(matches!(outcome, Err(Error::SeedTooLarge { .. })), "{seeds:?}: {outcome:?}");
        assert_eq!(changes, [7.0; 2]);
    }
}

/// In Initialization Mode the unknowns are what is calculated, the knowns what can be set; by time there are
/// derivatives too.
#[test]
fn derivatives_in_initialization_mode() {
    let mut instance = Instance::new(toy(), false);
    instance.enter_initialization_mode().unwrap();
    instance.set_real(&[LENGTH], &[3.0]).unwrap();
    let mut changes = [7.0; 2];
    instance.directional_derivative(&[POSITION, AREA], &[FORCE, LENGTH], &[5.0, 0.5], &mut changes).unwrap();
    assert_eq!(changes, [0.5, 3.0]);
    for (unknown, known) in [(LENGTH, GAIN), (POSITION, AREA), (POSITION, POSITION), (COUNT, FORCE), (POSITION, TIME)] {
        assert!(
            instance.directional_derivative(&[unknown], &[known], &[1.0], &mut changes[..1]).is_err(),
            "{unknown} {known}"
        );
    }
    instance.set_real(&[FORCE], &[3.0]).unwrap();
    let mut rate = [7.0];
    instance.get_real_output_derivatives(&[POSITION], &[1], &mut rate).unwrap();
    assert_eq!(rate, [6.0]);
}
