//! The functions of fmi3Functions.h that this library does not offer: those of scheduled execution, clocks, discrete
//! states and structural parameters. Each is an error that says so, and touches nothing. They are exported because
//! hosts look all names up.
//!
//! A live instance, in what follows, comes from `fmi3InstantiateCoSimulation`, was not freed, and is not in use on
//! another thread. NULL is answered with an error.
#![allow(non_snake_case, unused_variables, reason = "the standard's signatures")]

use std::ptr::null_mut;

use super::{component::Host, fmi3::guard, fmi3_types::*};
use crate::fmi::{LogCategory, Status, lifecycle::Call};

/// An error that says why `call` is not offered.
///
/// # Safety
/// `instance` is a live instance.
unsafe fn refuse(instance: fmi3Instance, call: Call) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, call, |instance| instance.check(call)) }
}

/// NULL: this library has no scheduled execution (section 2.3.1).
///
/// # Safety
/// `logMessage` is NULL or can be called.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    instanceName: fmi3String,
    instantiationToken: fmi3String,
    resourcePath: fmi3String,
    visible: fmi3Boolean,
    loggingOn: fmi3Boolean,
    instanceEnvironment: fmi3InstanceEnvironment,
    logMessage: fmi3LogMessageCallback,
    clockUpdate: fmi3ClockUpdateCallback,
    lockPreemption: fmi3LockPreemptionCallback,
    unlockPreemption: fmi3UnlockPreemptionCallback,
) -> fmi3Instance {
    let reason = "this unit has no scheduled execution; call fmi3InstantiateCoSimulation";
    let message = format!("fmi3InstantiateScheduledExecution: {reason}");
    Host::Fmi3(Callbacks::of_log(instanceEnvironment, logMessage)).log(
        Status::Error,
        LogCategory::StatusError,
        &message,
    );
    null_mut()
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetClock(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3Clock,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetClock) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetClock(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3Clock,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::SetClock) }
}

/// An error: this unit has no structural parameters.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterConfigurationMode(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::EnterConfigurationMode) }
}

/// An error: this unit has no structural parameters.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitConfigurationMode(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::ExitConfigurationMode) }
}

/// An error: this unit has no events.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterStepMode(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::EnterStepMode) }
}

/// An error: this unit has no events.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EvaluateDiscreteStates(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::EvaluateDiscreteStates) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetIntervalDecimal(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    intervals: *mut fmi3Float64,
    qualifiers: *mut fmi3Enumeration,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetIntervalDecimal) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetIntervalFraction(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    counters: *mut fmi3UInt64,
    resolutions: *mut fmi3UInt64,
    qualifiers: *mut fmi3Enumeration,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetIntervalFraction) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetShiftDecimal(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    shifts: *mut fmi3Float64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetShiftDecimal) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetShiftFraction(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    counters: *mut fmi3UInt64,
    resolutions: *mut fmi3UInt64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetShiftFraction) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetIntervalDecimal(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    intervals: *const fmi3Float64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::SetIntervalDecimal) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetIntervalFraction(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    counters: *const fmi3UInt64,
    resolutions: *const fmi3UInt64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::SetIntervalFraction) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetShiftDecimal(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    shifts: *const fmi3Float64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::SetShiftDecimal) }
}

/// An error: this unit has no clocks.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetShiftFraction(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    counters: *const fmi3UInt64,
    resolutions: *const fmi3UInt64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::SetShiftFraction) }
}

/// An error: it belongs to scheduled execution.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ActivateModelPartition(
    instance: fmi3Instance,
    clockReference: fmi3ValueReference,
    activationTime: fmi3Float64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::ActivateModelPartition) }
}
