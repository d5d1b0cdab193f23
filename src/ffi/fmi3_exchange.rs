//! The functions of fmi3Functions.h that Model Exchange adds.
//!
//! A live instance, in what follows, comes from `fmi3InstantiateModelExchange`, was not freed, and is not in use on
//! another thread. NULL is answered with an error, and so are instances for co-simulation.
#![allow(non_snake_case, reason = "the standard's names")]

use super::{
    component::{Component, Host},
    fault,
    fmi3::{guard, instantiate, made},
    fmi3_types::*,
    guard::{answer_to, slice, slice_mut},
};
use crate::fmi::lifecycle::Call;

/// Loads the model of the resources, which must be a linear system, `resources/linear.toml`, and makes an instance of
/// it; NULL with a log line if that is not possible (section 2.3.1).
///
/// # Safety
/// The texts end with a zero byte; the function is NULL or can be called as long as the instance lives.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    instanceName: fmi3String,
    instantiationToken: fmi3String,
    resourcePath: fmi3String,
    visible: fmi3Boolean,
    loggingOn: fmi3Boolean,
    instanceEnvironment: fmi3InstanceEnvironment,
    logMessage: fmi3LogMessageCallback,
) -> fmi3Instance {
    fault::silence();
    let host = Host::Fmi3(Callbacks::of_log(instanceEnvironment, logMessage));
    made("fmi3InstantiateModelExchange", &host, || {
        // SAFETY: the caller's promise.
        let model = unsafe { instantiate(instanceName, instantiationToken, resourcePath) }?;
        Component::for_model_exchange(model, host.clone(), loggingOn != fmi3False)
    })
}

/// Enters Event Mode, where inputs may jump (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterEventMode(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::EnterEventMode, |instance| instance.enter_event_mode()) }
}

/// Says that no event follows: the unit has none of its own (section 2.3.5).
///
/// # Safety
/// `instance` is a live instance; the six answers can be written to.
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
    const CALL: Call = Call::UpdateDiscreteStates;
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, CALL, |instance| {
            instance.check(CALL)?;
            answer_to(discreteStatesNeedUpdate, "discreteStatesNeedUpdate", fmi3False)?;
            answer_to(terminateSimulation, "terminateSimulation", fmi3False)?;
            answer_to(nominalsOfContinuousStatesChanged, "nominalsOfContinuousStatesChanged", fmi3False)?;
            answer_to(valuesOfContinuousStatesChanged, "valuesOfContinuousStatesChanged", fmi3False)?;
            answer_to(nextEventTimeDefined, "nextEventTimeDefined", fmi3False)?;
            answer_to(nextEventTime, "nextEventTime", 0.0)
        })
    }
}

/// Enters Continuous-Time Mode (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterContinuousTimeMode(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::EnterContinuousTimeMode, |instance| instance.enter_continuous_time_mode()) }
}

/// Takes note of a completed step of the host's solver: no event follows (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance; both answers can be written to.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi3CompletedIntegratorStep(
    instance: fmi3Instance,
    noSetFMUStatePriorToCurrentPoint: fmi3Boolean,
    enterEventMode: *mut fmi3Boolean,
    terminateSimulation: *mut fmi3Boolean,
) -> fmi3Status {
    const CALL: Call = Call::CompletedIntegratorStep;
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, CALL, |instance| {
            instance.check(CALL)?;
            answer_to(enterEventMode, "enterEventMode", fmi3False)?;
            answer_to(terminateSimulation, "terminateSimulation", fmi3False)
        })
    }
}

/// Sets the time, s (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetTime(instance: fmi3Instance, time: fmi3Float64) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::SetTime, |instance| instance.set_time(time)) }
}

/// Sets the states: all of them, or none if one is refused (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance; `continuousStates` has `nContinuousStates` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetContinuousStates(
    instance: fmi3Instance,
    continuousStates: *const fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetContinuousStates, |instance| {
            instance.set_continuous_states(slice(continuousStates, nContinuousStates, "continuousStates")?)
        })
    }
}

/// Reads the derivatives of the states by time (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance; `derivatives` has `nContinuousStates` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStateDerivatives(
    instance: fmi3Instance,
    derivatives: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetContinuousStateDerivatives, |instance| {
            instance.get_derivatives(slice_mut(derivatives, nContinuousStates, "derivatives")?)
        })
    }
}

/// There are no event indicators: an error unless `nEventIndicators` is 0 (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi3GetEventIndicators(
    instance: fmi3Instance,
    eventIndicators: *mut fmi3Float64,
    nEventIndicators: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::GetEventIndicators, |instance| instance.event_indicators(nEventIndicators)) }
}

/// Reads the states (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance; `continuousStates` has `nContinuousStates` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStates(
    instance: fmi3Instance,
    continuousStates: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetContinuousStates, |instance| {
            instance.get_continuous_states(slice_mut(continuousStates, nContinuousStates, "continuousStates")?)
        })
    }
}

/// Reads the orders of magnitude of the states, which never change (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance; `nominals` has `nContinuousStates` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNominalsOfContinuousStates(
    instance: fmi3Instance,
    nominals: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetNominalsOfContinuousStates, |instance| {
            instance.get_nominals(slice_mut(nominals, nContinuousStates, "nominals")?)
        })
    }
}

/// Writes the number of event indicators, 0 (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance; `nEventIndicators` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfEventIndicators(
    instance: fmi3Instance,
    nEventIndicators: *mut usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetNumberOfEventIndicators, |instance| {
            let count = instance.count_indicators()?;
            answer_to(nEventIndicators, "nEventIndicators", count)
        })
    }
}

/// Writes the number of continuous states (section 3.2.1).
///
/// # Safety
/// `instance` is a live instance; `nContinuousStates` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfContinuousStates(
    instance: fmi3Instance,
    nContinuousStates: *mut usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetNumberOfContinuousStates, |instance| {
            let count = instance.count_states()?;
            answer_to(nContinuousStates, "nContinuousStates", count)
        })
    }
}
