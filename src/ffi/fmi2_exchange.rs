//! The functions of fmi2Functions.h that Model Exchange adds.
//!
//! A live instance, in what follows, comes from `fmi2Instantiate`, was not freed, and is not in use on another thread.
//! NULL is answered with an error, and so are instances for co-simulation.
#![allow(non_snake_case, reason = "the standard's names")]

use super::{
    fmi2::guard,
    guard::{answer_to, slice, slice_mut},
    types::*,
};
use crate::fmi::lifecycle::Call;

/// Enters Event Mode, where inputs may jump (section 3.2.2).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterEventMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::EnterEventMode, |instance| instance.enter_event_mode()) }
}

/// Says that no event follows: the unit has none of its own (section 3.2.2).
///
/// # Safety
/// `c` is a live instance; `eventInfo` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(c: fmi2Component, eventInfo: *mut fmi2EventInfo) -> fmi2Status {
    const CALL: Call = Call::UpdateDiscreteStates;
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, CALL, |instance| {
            instance.check(CALL)?;
            answer_to(eventInfo, "eventInfo", fmi2EventInfo::default())
        })
    }
}

/// Enters Continuous-Time Mode (section 3.2.2).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterContinuousTimeMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::EnterContinuousTimeMode, |instance| instance.enter_continuous_time_mode()) }
}

/// Takes note of a completed step of the host's solver: no event follows (section 3.2.2).
///
/// # Safety
/// `c` is a live instance; both answers can be written to.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    c: fmi2Component,
    noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
    enterEventMode: *mut fmi2Boolean,
    terminateSimulation: *mut fmi2Boolean,
) -> fmi2Status {
    const CALL: Call = Call::CompletedIntegratorStep;
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, CALL, |instance| {
            instance.check(CALL)?;
            answer_to(enterEventMode, "enterEventMode", fmi2False)?;
            answer_to(terminateSimulation, "terminateSimulation", fmi2False)
        })
    }
}

/// Sets the time, s (section 3.2.1).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(c: fmi2Component, time: fmi2Real) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::SetTime, |instance| instance.set_time(time)) }
}

/// Sets the states: all of them, or none if one is refused (section 3.2.1).
///
/// # Safety
/// `c` is a live instance; `x` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(c: fmi2Component, x: *const fmi2Real, nx: usize) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::SetContinuousStates, |instance| instance.set_continuous_states(slice(x, nx, "x")?)) }
}

/// Reads the derivatives of the states by time (section 3.2.2).
///
/// # Safety
/// `c` is a live instance; `derivatives` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDerivatives(c: fmi2Component, derivatives: *mut fmi2Real, nx: usize) -> fmi2Status {
    const CALL: Call = Call::GetContinuousStateDerivatives;
    // SAFETY: the caller's promise.
    unsafe { guard(c, CALL, |instance| instance.get_derivatives(slice_mut(derivatives, nx, "derivatives")?)) }
}

/// There are no event indicators: an error unless `ni` is 0 (section 3.2.2).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2GetEventIndicators(
    c: fmi2Component,
    eventIndicators: *mut fmi2Real,
    ni: usize,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::GetEventIndicators, |instance| instance.event_indicators(ni)) }
}

/// Reads the states (section 3.2.2).
///
/// # Safety
/// `c` is a live instance; `x` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetContinuousStates(c: fmi2Component, x: *mut fmi2Real, nx: usize) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::GetContinuousStates, |instance| instance.get_continuous_states(slice_mut(x, nx, "x")?)) }
}

/// Reads the orders of magnitude of the states, which never change (section 3.2.2).
///
/// # Safety
/// `c` is a live instance; `x_nominal` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    c: fmi2Component,
    x_nominal: *mut fmi2Real,
    nx: usize,
) -> fmi2Status {
    const CALL: Call = Call::GetNominalsOfContinuousStates;
    // SAFETY: the caller's promise.
    unsafe { guard(c, CALL, |instance| instance.get_nominals(slice_mut(x_nominal, nx, "x_nominal")?)) }
}
