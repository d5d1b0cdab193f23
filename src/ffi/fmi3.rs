//! The functions of fmi3Functions.h, except those on values and derivatives ([`super::fmi3_values`]), on types that no
//! variable has ([`super::fmi3_other_types`]), those of Model Exchange ([`super::fmi3_exchange`]), and those that this
//! library does not offer ([`super::fmi3_absent`]).
//!
//! A live instance, in what follows, comes from `fmi3InstantiateCoSimulation`, was not freed, and is not in use on
//! another thread. NULL is answered with an error.
#![allow(non_snake_case, reason = "the standard's names")]

use std::{
    ffi::{CStr, c_char},
    ptr::null_mut,
};

use super::{
    component::{self, Component, Host},
    fault,
    fmi3_types::*,
    guard::{self, place, slice, slice_mut, text},
};
use crate::{
    fmi::{
        error::Error,
        instance::{Instance, Progress},
        lifecycle::{Call, Standard},
    },
    packed::Packed,
};

/// Three lines per function: borrow, call safe code, translate.
///
/// # Safety
/// `instance` is a live instance.
pub(super) unsafe fn guard(
    instance: fmi3Instance,
    call: Call,
    body: impl FnOnce(&mut Instance<Packed>) -> Result<(), Error>,
) -> fmi3Status {
    // SAFETY: the caller's promise; every component of this library has a `Packed`.
    unsafe { guard::run(Standard::Fmi3, instance, call, body) }.into()
}

/// `"3.0"` (section 2.2.5).
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// Switches log categories on or off; no category means all (section 2.3.1).
///
/// # Safety
/// `instance` is a live instance; `categories` has `nCategories` texts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    instance: fmi3Instance,
    loggingOn: fmi3Boolean,
    nCategories: usize,
    categories: *const fmi3String,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetDebugLogging, |instance| {
            let names = slice(categories, nCategories, "categories")?;
            let names: Result<Vec<&str>, Error> = names.iter().map(|name| text(*name, "categories")).collect();
            instance.set_debug_logging(loggingOn != fmi3False, &names?)
        })
    }
}

/// Loads the model of the resources, `resources/model.toml` or `resources/linear.toml`, and makes an instance of it;
/// NULL with a log line if that is not possible (section 2.3.1).
///
/// # Safety
/// The texts end with a zero byte; `requiredIntermediateVariables` has `nRequiredIntermediateVariables` elements; the
/// functions are NULL or can be called as long as the instance lives.
#[unsafe(no_mangle)]
#[allow(unused_variables, clippy::too_many_arguments, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    instanceName: fmi3String,
    instantiationToken: fmi3String,
    resourcePath: fmi3String,
    visible: fmi3Boolean,
    loggingOn: fmi3Boolean,
    eventModeUsed: fmi3Boolean,
    earlyReturnAllowed: fmi3Boolean,
    requiredIntermediateVariables: *const fmi3ValueReference,
    nRequiredIntermediateVariables: usize,
    instanceEnvironment: fmi3InstanceEnvironment,
    logMessage: fmi3LogMessageCallback,
    intermediateUpdate: fmi3IntermediateUpdateCallback,
) -> fmi3Instance {
    fault::silence();
    let host = Host::Fmi3(Callbacks {
        environment: instanceEnvironment,
        log_message: logMessage,
        intermediate_update: intermediateUpdate,
        early_return_allowed: earlyReturnAllowed != fmi3False,
    });
    made("fmi3InstantiateCoSimulation", &host, || {
        if eventModeUsed != fmi3False {
            return Err(Error::Instantiate(String::from(
                "eventModeUsed is true, but this unit has no Event Mode in co-simulation; pass fmi3False, as \
                 hasEventMode says",
            )));
        }
        // SAFETY: the caller's promise.
        let model = unsafe { instantiate(instanceName, instantiationToken, resourcePath) }?;
        let mut component = Component::new(model, host.clone(), loggingOn != fmi3False);
        // SAFETY: the caller's promise.
        let required = unsafe {
            slice(requiredIntermediateVariables, nRequiredIntermediateVariables, "requiredIntermediateVariables")
        }?;
        component.instance.require_between(required);
        component.report();
        Ok(component)
    })
}

/// The handle of a component; NULL with a log line if there is none.
pub(super) fn made(
    function: &str,
    host: &Host,
    make: impl FnOnce() -> Result<Component<Packed>, Error>,
) -> fmi3Instance {
    let made = guard::caught(|| make().map(Component::into_handle));
    made.unwrap_or_else(|message| Err(Error::Fault { message })).unwrap_or_else(|error| {
        host.log(error.status(), error.category(), &format!("{function}: {error}"));
        null_mut()
    })
}

/// The model of a new instance.
///
/// # Safety
/// The texts are NULL or end with a zero byte.
pub(super) unsafe fn instantiate(name: fmi3String, token: fmi3String, resources: fmi3String) -> Result<Packed, Error> {
    let refused = |reason: &str| Err(Error::Instantiate(reason.to_owned()));
    // SAFETY: the caller's promise.
    let name = if name.is_null() { c"" } else { unsafe { CStr::from_ptr(name) } };
    if name.to_bytes().trim_ascii().is_empty() {
        return refused("the instance name is NULL or blank; pass a name that is unique in the simulation");
    }
    // SAFETY: the caller's promise.
    let token = unsafe { text(token, "instantiationToken") }?;
    // SAFETY: the caller's promise.
    let resources = if resources.is_null() { "" } else { unsafe { text(resources, "resourcePath") }? };
    component::load(token, resources)
}

/// Gives an instance back; NULL is fine (section 2.3.1).
///
/// # Safety
/// `instance` is a live instance, which is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(instance: fmi3Instance) {
    // SAFETY: the caller's promise; every component of this library has a `Packed`.
    unsafe { guard::free::<Packed>(instance) }
}

/// Sets the experiment up, s, and enters Initialization Mode (section 2.3.2).
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: fmi3Instance,
    toleranceDefined: fmi3Boolean,
    tolerance: fmi3Float64,
    startTime: fmi3Float64,
    stopTimeDefined: fmi3Boolean,
    stopTime: fmi3Float64,
) -> fmi3Status {
    let tolerance = (toleranceDefined != fmi3False).then_some(tolerance);
    let stop = (stopTimeDefined != fmi3False).then_some(stopTime);
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::EnterInitializationMode, |instance| {
            instance.enter_initialization_mode_for(tolerance, startTime, stop)
        })
    }
}

/// Finds the initial state and leaves Initialization Mode, to Step Mode or Event Mode (section 2.3.3).
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitInitializationMode(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::ExitInitializationMode, |instance| instance.exit_initialization_mode()) }
}

/// Ends the simulation; values can still be read (section 2.3.4).
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Terminate(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::Terminate, |instance| instance.terminate()) }
}

/// Back to just instantiated, also after an error (section 2.3.1).
///
/// # Safety
/// `instance` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Reset(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::Reset, |instance| instance.reset()) }
}

/// Copies everything the instance is; over an earlier copy if there is one (section 2.2.9).
///
/// # Safety
/// `instance` is a live instance; `FMUState` points to NULL or to a copy made by this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(instance: fmi3Instance, FMUState: *mut fmi3FMUState) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::GetFMUstate, |instance| guard::hand_out_state(FMUState, || instance.state())) }
}

/// Goes back to a copy, also after an error (section 2.2.9).
///
/// # Safety
/// `instance` is a live instance; `FMUState` is a copy made by this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(instance: fmi3Instance, FMUState: fmi3FMUState) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::SetFMUstate, |instance| guard::load_state(instance, FMUState)) }
}

/// Gives a copy back; NULL is fine (section 2.2.9).
///
/// # Safety
/// `instance` is a live instance; `FMUState` points to NULL or to a copy made by this library, which is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(instance: fmi3Instance, FMUState: *mut fmi3FMUState) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe { guard(instance, Call::FreeFMUstate, |instance| guard::free_state(instance, FMUState)) }
}

/// The number of bytes that a copy is serialized to (section 2.2.9).
///
/// # Safety
/// `instance` is a live instance; `FMUState` is a copy made by this library; `size` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: fmi3Instance,
    FMUState: fmi3FMUState,
    size: *mut usize,
) -> fmi3Status {
    const CALL: Call = Call::SerializedFMUstateSize;
    // SAFETY: the caller's promise.
    unsafe { guard(instance, CALL, |instance| guard::serialized_size(instance, CALL, FMUState, size)) }
}

/// Writes a copy as bytes that any process can read (section 2.2.9).
///
/// # Safety
/// `instance` is a live instance; `FMUState` is a copy made by this library; `serializedState` has room for `size`
/// bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: fmi3Instance,
    FMUState: fmi3FMUState,
    serializedState: *mut fmi3Byte,
    size: usize,
) -> fmi3Status {
    const CALL: Call = Call::SerializeFMUstate;
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, CALL, |instance| {
            guard::write_serialized(instance, CALL, FMUState, slice_mut(serializedState, size, "serializedState")?)
        })
    }
}

/// Makes a copy from bytes, over an earlier copy if there is one (section 2.2.9).
///
/// # Safety
/// `instance` is a live instance; `serializedState` has `size` bytes; `FMUState` points to NULL or to a copy made by
/// this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: fmi3Instance,
    serializedState: *const fmi3Byte,
    size: usize,
    FMUState: *mut fmi3FMUState,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::DeSerializeFMUstate, |instance| {
            let bytes = slice(serializedState, size, "serializedState")?;
            guard::hand_out_state(FMUState, || instance.deserialize(bytes))
        })
    }
}

/// Computes one communication step, s (section 4.2.1), and tells the host of each internal step if it wants to hear of
/// them: it may set inputs for the rest of the communication step there. Events and the end of the simulation are never
/// asked for.
///
/// # Safety
/// `instance` is a live instance; the four answers can be written to.
#[unsafe(no_mangle)]
#[allow(unused_variables, clippy::too_many_arguments, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi3DoStep(
    instance: fmi3Instance,
    currentCommunicationPoint: fmi3Float64,
    communicationStepSize: fmi3Float64,
    noSetFMUStatePriorToCurrentPoint: fmi3Boolean,
    eventHandlingNeeded: *mut fmi3Boolean,
    terminateSimulation: *mut fmi3Boolean,
    earlyReturn: *mut fmi3Boolean,
    lastSuccessfulTime: *mut fmi3Float64,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        let callbacks = guard::callbacks::<Packed>(instance).filter(Callbacks::has_update);
        let status = guard(instance, Call::DoStep, |instance| {
            *place(eventHandlingNeeded, "eventHandlingNeeded")? = fmi3False;
            *place(terminateSimulation, "terminateSimulation")? = fmi3False;
            *place(earlyReturn, "earlyReturn")? = fmi3False;
            *place(lastSuccessfulTime, "lastSuccessfulTime")? = instance.time();
            match callbacks {
                Some(_) => instance.begin_step(currentCommunicationPoint, communicationStepSize)?,
                None => instance.do_step(currentCommunicationPoint, communicationStepSize)?,
            }
            *place(lastSuccessfulTime, "lastSuccessfulTime")? = instance.time();
            Ok(())
        });
        match callbacks.filter(|_| matches!(status, fmi3Status::fmi3OK | fmi3Status::fmi3Warning)) {
            None => status,
            Some(callbacks) => step_with_updates(instance, callbacks, earlyReturn, lastSuccessfulTime),
        }
    }
}

/// Takes the internal steps of a communication step that has begun. Between them nothing is borrowed: the host calls
/// functions of the instance from its callback.
///
/// # Safety
/// As [`fmi3DoStep`].
unsafe fn step_with_updates(
    handle: fmi3Instance,
    callbacks: Callbacks,
    earlyReturn: *mut fmi3Boolean,
    lastSuccessfulTime: *mut fmi3Float64,
) -> fmi3Status {
    loop {
        let mut progress = Progress { time: f64::NAN, arrived: true };
        // SAFETY: the caller's promise.
        let status = unsafe {
            guard(handle, Call::DoStep, |instance| {
                let outcome = instance.take_part();
                // A failed step leaves the instance where the whole of it began, or where inputs were set last.
                *place(lastSuccessfulTime, "lastSuccessfulTime")? = instance.time();
                progress = outcome?;
                Ok(())
            })
        };
        if status != fmi3Status::fmi3OK {
            return status;
        }
        let returns = callbacks.update(progress);
        // SAFETY: the caller's promise.
        let status = unsafe {
            guard(handle, Call::DoStep, |instance| {
                let outcome = if returns { instance.return_early() } else { instance.go_on() };
                *place(lastSuccessfulTime, "lastSuccessfulTime")? = instance.time();
                outcome?;
                *place(earlyReturn, "earlyReturn")? = returns.into();
                Ok(())
            })
        };
        if progress.arrived || returns || status != fmi3Status::fmi3OK {
            return status;
        }
    }
}
