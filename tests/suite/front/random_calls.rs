//! Do random calls, right and wrong ones in any order, leave a simulation whole? Never a fault, never a value that a
//! refused call has changed, never a result that is no number, and in the end the bits of a simulation that nobody has
//! disturbed.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

use ancf14::ffi::front::*;
use ancf14::ffi::front_types::ancf14_status::*;
use ancf14::ffi::front_types::{ancf14_kind, ancf14_simulation, ancf14_state, ancf14_status};

use crate::random::Random;

/// A clamped arm whose end can be pushed.
const ARM: &str = include_str!("../../../c-examples/arm.toml");
/// What a value is multiplied by.
const FACTORS: [f64; 9] = [1.0, 0.5, 2.0, -1.0, 0.0, f64::NAN, f64::INFINITY, 1e300, 1e-300];
const CALLS: usize = 120;

/// A simulation, freed at the end.
struct Arm(*mut ancf14_simulation);

impl Arm {
    fn new() -> Self {
        let text = CString::new(ARM).unwrap();
        // SAFETY: the texts end with a zero byte.
        let arm = unsafe { ancf14_load_text(c"arm.toml".as_ptr(), text.as_ptr(), null(), null_mut(), 0) };
        assert!(!arm.is_null());
        Self(arm)
    }

    fn value(&self, variable: i32) -> Option<f64> {
        let mut value = f64::NAN;
        // SAFETY: the simulation is live, the place is there.
        (unsafe { ancf14_get(self.0, variable, &raw mut value) } == ANCF14_OK).then_some(value)
    }

    fn name(&self, variable: i32) -> String {
        // SAFETY: the simulation is live, and so are its texts.
        unsafe { CStr::from_ptr(ancf14_variable_name(self.0, variable)) }.to_str().unwrap().to_owned()
    }

    /// Sets a variable to something; a refused value leaves the old one.
    fn set(&self, random: &mut Random, count: i32) -> ancf14_status {
        let variable = random.below(count as usize) as i32;
        let before = self.value(variable);
        let old = before.unwrap_or(1.0);
        let mut value = FACTORS[random.below(FACTORS.len())] * if old == 0.0 { 1.0 } else { old };
        let name = self.name(variable);
        if value.is_finite() && (name.starts_with("simulation.") || name == "arm.elements") {
            value = old; // a million elements, or steps, take too long
        }
        // SAFETY: the simulation is live.
        let status = unsafe { ancf14_set(self.0, variable, value) };
        let after = self.value(variable);
        match status {
            ANCF14_OK => assert_eq!(after, Some(value), "{name}"),
            _ => assert_eq!(after.map(f64::to_bits), before.map(f64::to_bits), "{name} {value}"),
        }
        status
    }

    /// Every result is a number.
    fn look(&self, count: i32) {
        for variable in 0..count {
            // SAFETY: the simulation is live.
            let kind = unsafe { ancf14_variable_kind(self.0, variable) };
            if kind == ancf14_kind::ANCF14_OUTPUT {
                assert!(self.value(variable).is_none_or(f64::is_finite), "{}", self.name(variable));
            }
        }
    }

    /// What a run from the beginning gives.
    fn run(&self) -> Option<f64> {
        // SAFETY: the simulation is live.
        unsafe {
            assert_eq!(ancf14_reset(self.0), ANCF14_OK);
            assert_eq!(ancf14_initialize(self.0), ANCF14_OK);
            assert_eq!(ancf14_advance(self.0, 0.02), ANCF14_OK);
            self.value(ancf14_find(self.0, c"tip.position[3]".as_ptr()))
        }
    }
}

impl Drop for Arm {
    fn drop(&mut self) {
        // SAFETY: the simulation is live and not used again.
        unsafe { ancf14_free(self.0) };
    }
}

#[test]
fn random_calls_leave_simulations_whole() {
    let undisturbed = Arm::new().run();
    let mut told = [0; 8];
    for seed in 0..100 {
        let (arm, mut random) = (Arm::new(), Random(seed));
        // SAFETY: the simulation is live; states are live or NULL; wrong arguments are the question.
        unsafe {
            let count = ancf14_variable_count(arm.0);
            let mut state: *mut ancf14_state = null_mut();
            if seed % 2 == 0 {
                ancf14_initialize(arm.0); // most sets of random parameters make no mechanism
            }
            for _ in 0..CALLS {
                let time = ancf14_time(arm.0);
                let status = match random.below(14) {
                    0 => ancf14_initialize(arm.0),
                    1..=3 => ancf14_advance(arm.0, time + [0.0, 2e-3, 1e-3, 1.7e-4][random.below(4)]),
                    4 => ancf14_advance(arm.0, [f64::NAN, -1.0, f64::INFINITY, 1e300][random.below(4)]),
                    5 => ancf14_get(arm.0, [-1, count, i32::MAX][random.below(3)], &mut 0.0),
                    6 => ancf14_get(arm.0, 0, null_mut()),
                    7 => {
                        ancf14_free_state(state);
                        state = ancf14_save(arm.0);
                        if state.is_null() { ANCF14_FAULT } else { ANCF14_OK }
                    }
                    8 => ancf14_restore(arm.0, state),
                    9 if random.below(4) == 0 => ancf14_finish(arm.0),
                    10 if random.below(4) == 0 => ancf14_reset(arm.0),
                    _ => arm.set(&mut random, count),
                };
                told[status as usize] += 1;
                assert_ne!(status, ANCF14_FAULT, "seed {seed}: {:?}", CStr::from_ptr(ancf14_last_error(arm.0)));
                arm.look(count);
                while !ancf14_next_warning(arm.0).is_null() {}
            }
            ancf14_free_state(state);
        }
        assert_eq!(arm.run(), undisturbed, "seed {seed}");
    }
    println!("calls by status: {told:?}");
    let seen = [
        ANCF14_OK,
        ANCF14_BAD_HANDLE,
        ANCF14_BAD_ARGUMENT,
        ANCF14_UNKNOWN_VARIABLE,
        ANCF14_REFUSED,
        ANCF14_WRONG_ORDER,
    ];
    assert!(seen.iter().all(|status| told[*status as usize] > 20), "{told:?}");
}
