//! The functions of fmi3Functions.h that this library does not offer: those of model exchange, scheduled execution,
//! clocks, events and structural parameters. Each is an error that says so, and touches nothing. They are exported
//! because hosts look all names up.
//!
//! A live instance, in what follows, comes from `fmi3InstantiateCoSimulation`, was not freed, and is not in use on
//! another thread. NULL is answered with an error.
#![allow(non_snake_case, unused_variables, reason = "the standard's signatures")]

use std::{ffi::CStr, ptr::null_mut};

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

/// NULL, with a log line that says why.
///
/// # Safety
/// `logMessage` is NULL or can be called.
unsafe fn refuse_instance(
    function: &CStr,
    environment: fmi3InstanceEnvironment,
    logMessage: fmi3LogMessageCallback,
) -> fmi3Instance {
    let callbacks =
        Callbacks { environment, log_message: logMessage, intermediate_update: None, early_return_allowed: false };
    let function = function.to_string_lossy();
    let message = format!("{function}: this unit is for co-simulation only; call fmi3InstantiateCoSimulation");
    Host::Fmi3(callbacks).log(Status::Error, LogCategory::StatusError, &message);
    null_mut()
}

/// NULL: this library is for co-simulation (section 2.3.1).
///
/// # Safety
/// `logMessage` is NULL or can be called.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    instanceName: fmi3String,
    instantiationToken: fmi3String,
    resourcePath: fmi3String,
    visible: fmi3Boolean,
    loggingOn: fmi3Boolean,
    instanceEnvironment: fmi3InstanceEnvironment,
    logMessage: fmi3LogMessageCallback,
) -> fmi3Instance {
    // SAFETY: the caller's promise.
    unsafe { refuse_instance(c"fmi3InstantiateModelExchange", instanceEnvironment, logMessage) }
}

/// NULL: this library is for co-simulation (section 2.3.1).
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
    // SAFETY: the caller's promise.
    unsafe { refuse_instance(c"fmi3InstantiateScheduledExecution", instanceEnvironment, logMessage) }
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
pub unsafe extern "C" fn fmi3EnterEventMode(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::EnterEventMode) }
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

/// An error: this unit has no events.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3UpdateDiscreteStates(
    instance: fmi3Instance,
    discreteStatesNeedUpdate: *mut fmi3Boolean,
    terminateSimulation: *mut fmi3Boolean,
    nominalsOfContinuousStatesChanged: *mut fmi3Boolean,
    valuesOfContinuousStatesChanged: *mut fmi3Boolean,
    nextEventTimeDefined: *mut fmi3Boolean,
    nextEventTime: *mut fmi3Float64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::UpdateDiscreteStates) }
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

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterContinuousTimeMode(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::EnterContinuousTimeMode) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3CompletedIntegratorStep(
    instance: fmi3Instance,
    noSetFMUStatePriorToCurrentPoint: fmi3Boolean,
    enterEventMode: *mut fmi3Boolean,
    terminateSimulation: *mut fmi3Boolean,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::CompletedIntegratorStep) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetTime(instance: fmi3Instance, time: fmi3Float64) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::SetTime) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetContinuousStates(
    instance: fmi3Instance,
    continuousStates: *const fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::SetContinuousStates) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStateDerivatives(
    instance: fmi3Instance,
    derivatives: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetContinuousStateDerivatives) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetEventIndicators(
    instance: fmi3Instance,
    eventIndicators: *mut fmi3Float64,
    nEventIndicators: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetEventIndicators) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStates(
    instance: fmi3Instance,
    continuousStates: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetContinuousStates) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNominalsOfContinuousStates(
    instance: fmi3Instance,
    nominals: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetNominalsOfContinuousStates) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfEventIndicators(
    instance: fmi3Instance,
    nEventIndicators: *mut usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetNumberOfEventIndicators) }
}

/// An error: it belongs to model exchange.
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfContinuousStates(
    instance: fmi3Instance,
    nContinuousStates: *mut usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { refuse(instance, Call::GetNumberOfContinuousStates) }
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
