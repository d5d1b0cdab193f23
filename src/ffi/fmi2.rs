//! The functions of fmi2Functions.h, except those on values and derivatives ([`super::fmi2_values`]) and those that
//! Model Exchange adds ([`super::fmi2_exchange`]).
//!
//! A live instance, in what follows, comes from `fmi2Instantiate`, was not freed, and is not in use on another thread.
//! NULL is answered with an error.
#![allow(non_snake_case, reason = "the standard's names")]

use std::{
    ffi::{CStr, c_char},
    ptr::null_mut,
};

use super::{
    component::{self, Component, Host},
    fault,
    guard::{self, place, slice, slice_mut, text},
    types::*,
};
use crate::{
    fmi::{
        error::Error,
        instance::{Instance, StatusKind},
        lifecycle::Call,
    },
    packed::Packed,
};

/// Three lines per function: borrow, call safe code, translate.
///
/// # Safety
/// `c` is a live instance.
pub(super) unsafe fn guard(
    c: fmi2Component,
    call: Call,
    body: impl FnOnce(&mut Instance<Packed>) -> Result<(), Error>,
) -> fmi2Status {
    // SAFETY: the caller's promise; every component of this library has a `Packed`.
    unsafe { guard::guard(c, call, body) }
}

/// `"default"`: the types are those of the standard's header (section 2.1.4).
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// `"2.0"` (section 2.1.4).
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// Switches debug messages; no category means all (section 2.1.5).
///
/// # Safety
/// `c` is a live instance; `categories` has `nCategories` texts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: fmi2Component,
    loggingOn: fmi2Boolean,
    nCategories: usize,
    categories: *const fmi2String,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::SetDebugLogging, |instance| {
            let names = slice(categories, nCategories, "categories")?;
            let names: Result<Vec<&str>, Error> = names.iter().map(|name| text(*name, "categories")).collect();
            instance.set_debug_logging(loggingOn != fmi2False, &names?)
        })
    }
}

/// Loads the model of the resources, `resources/model.toml` or `resources/linear.toml`, and makes an instance of it;
/// NULL with a log line if that is not possible (section 2.1.5).
///
/// # Safety
/// The texts end with a zero byte, `functions` holds functions that can be called as long as the instance lives.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2Instantiate(
    instanceName: fmi2String,
    fmuType: fmi2Type,
    fmuGUID: fmi2String,
    fmuResourceLocation: fmi2String,
    functions: *const fmi2CallbackFunctions,
    visible: fmi2Boolean,
    loggingOn: fmi2Boolean,
) -> fmi2Component {
    fault::silence();
    // SAFETY: the caller's promise.
    let Some(functions) = (unsafe { functions.as_ref() }) else {
        return null_mut(); // nowhere to log to
    };
    // SAFETY: the caller's promise.
    let name = if instanceName.is_null() { c"" } else { unsafe { CStr::from_ptr(instanceName) } };
    let host = Host::new(name, functions);
    let made = guard::caught(|| {
        // SAFETY: the caller's promise.
        let model = unsafe { instantiate(name, fmuType, fmuGUID, fmuResourceLocation) }?;
        let logging_on = loggingOn != fmi2False;
        let component = match fmuType == fmi2ModelExchange {
            true => Component::for_model_exchange(model, host.clone(), logging_on)?,
            false => Component::new(model, host.clone(), logging_on),
        };
        Ok(component.into_handle())
    });
    made.unwrap_or_else(|message| Err(Error::Fault { message })).unwrap_or_else(|error| {
        host.log(error.status(), error.category(), &format!("fmi2Instantiate: {error}"));
        null_mut()
    })
}

/// The model of a new instance.
///
/// # Safety
/// The texts are NULL or end with a zero byte.
unsafe fn instantiate(name: &CStr, kind: fmi2Type, guid: fmi2String, resources: fmi2String) -> Result<Packed, Error> {
    let refused = |reason: &str| Err(Error::Instantiate(reason.to_owned()));
    if name.to_bytes().trim_ascii().is_empty() {
        return refused("the instance name is NULL or blank; pass a name that is unique in the simulation");
    }
    if ![fmi2ModelExchange, fmi2CoSimulation].contains(&kind) {
        return refused("fmuType is neither fmi2ModelExchange nor fmi2CoSimulation; pass one of them");
    }
    // SAFETY: the caller's promise.
    let guid = unsafe { text(guid, "fmuGUID") }?;
    // SAFETY: the caller's promise.
    let resources = if resources.is_null() { "" } else { unsafe { text(resources, "fmuResourceLocation") }? };
    component::load(guid, resources)
}

/// Gives an instance back; NULL is fine (section 2.1.5).
///
/// # Safety
/// `c` is a live instance, which is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: fmi2Component) {
    // SAFETY: the caller's promise; every component of this library has a `Packed`.
    unsafe { guard::free::<Packed>(c) }
}

/// Start and stop time, s; the tolerance is not used (section 2.1.6).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    c: fmi2Component,
    toleranceDefined: fmi2Boolean,
    tolerance: fmi2Real,
    startTime: fmi2Real,
    stopTimeDefined: fmi2Boolean,
    stopTime: fmi2Real,
) -> fmi2Status {
    let tolerance = (toleranceDefined != fmi2False).then_some(tolerance);
    let stop = (stopTimeDefined != fmi2False).then_some(stopTime);
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::SetupExperiment, |instance| instance.setup_experiment(tolerance, startTime, stop)) }
}

/// Enters Initialization Mode (section 2.1.6).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::EnterInitializationMode, |instance| instance.enter_initialization_mode()) }
}

/// Finds the initial state and leaves Initialization Mode (section 2.1.6).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::ExitInitializationMode, |instance| instance.exit_initialization_mode()) }
}

/// Ends the simulation; values can still be read (section 2.1.6).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::Terminate, |instance| instance.terminate()) }
}

/// Back to just instantiated, also after an error (section 2.1.6).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::Reset, |instance| instance.reset()) }
}

/// Copies everything the instance is; over an earlier copy if there is one (section 2.1.8).
///
/// # Safety
/// `c` is a live instance; `FMUstate` points to NULL or to a copy made by this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::GetFMUstate, |instance| guard::hand_out_state(FMUstate, || instance.state())) }
}

/// Goes back to a copy, also after an error (section 2.1.8).
///
/// # Safety
/// `c` is a live instance; `FMUstate` is a copy made by this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: fmi2Component, FMUstate: fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::SetFMUstate, |instance| guard::load_state(instance, FMUstate)) }
}

/// Gives a copy back; NULL is fine (section 2.1.8).
///
/// # Safety
/// `c` is a live instance; `FMUstate` points to NULL or to a copy made by this library, which is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: fmi2Component, FMUstate: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::FreeFMUstate, |instance| guard::free_state(instance, FMUstate)) }
}

/// The number of bytes that a copy is serialized to (section 2.1.8).
///
/// # Safety
/// `c` is a live instance; `FMUstate` is a copy made by this library; `size` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    size: *mut usize,
) -> fmi2Status {
    const CALL: Call = Call::SerializedFMUstateSize;
    // SAFETY: the caller's promise.
    unsafe { guard(c, CALL, |instance| guard::serialized_size(instance, CALL, FMUstate, size)) }
}

/// Writes a copy as bytes that any process can read (section 2.1.8).
///
/// # Safety
/// `c` is a live instance; `FMUstate` is a copy made by this library; `serializedState` has room for `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: fmi2Component,
    FMUstate: fmi2FMUstate,
    serializedState: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    const CALL: Call = Call::SerializeFMUstate;
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, CALL, |instance| {
            let target = slice_mut(serializedState.cast::<u8>(), size, "serializedState")?;
            guard::write_serialized(instance, CALL, FMUstate, target)
        })
    }
}

/// Makes a copy from bytes, over an earlier copy if there is one (section 2.1.8).
///
/// # Safety
/// `c` is a live instance; `serializedState` has `size` bytes; `FMUstate` points to NULL or to a copy made by this
/// library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: fmi2Component,
    serializedState: *const fmi2Byte,
    size: usize,
    FMUstate: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::DeSerializeFMUstate, |instance| {
            let bytes = slice(serializedState.cast::<u8>(), size, "serializedState")?;
            guard::hand_out_state(FMUstate, || instance.deserialize(bytes))
        })
    }
}

/// Computes one communication step, s (section 4.2.2).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2DoStep(
    c: fmi2Component,
    currentCommunicationPoint: fmi2Real,
    communicationStepSize: fmi2Real,
    noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::DoStep, |instance| instance.do_step(currentCommunicationPoint, communicationStepSize)) }
}

/// Always an error: steps are done when `fmi2DoStep` returns (section 4.2.2).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: fmi2Component) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::CancelStep, |instance| instance.cancel_step()) }
}

/// `fmi2Discard`: no status of this type exists, since steps are never pending (section 4.2.3).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2GetStatus(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Status) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetStatus, |instance| {
            instance.other_status(Call::GetStatus, kind(instance, Call::GetStatus, s)?)
        })
    }
}

/// The time reached, s, for `fmi2LastSuccessfulTime`; otherwise `fmi2Discard` (section 4.2.3).
///
/// # Safety
/// `c` is a live instance; `value` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(c: fmi2Component, s: fmi2StatusKind, value: *mut fmi2Real) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetRealStatus, |instance| {
            *place(value, "value")? = instance.real_status(kind(instance, Call::GetRealStatus, s)?)?;
            Ok(())
        })
    }
}

/// `fmi2Discard`: no status of this type exists (section 4.2.3).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2GetIntegerStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetIntegerStatus, |instance| {
            instance.other_status(Call::GetIntegerStatus, kind(instance, Call::GetIntegerStatus, s)?)
        })
    }
}

/// False for `fmi2Terminated`: the unit never ends by itself; otherwise `fmi2Discard` (section 4.2.3).
///
/// # Safety
/// `c` is a live instance; `value` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetBooleanStatus, |instance| {
            *place(value, "value")? =
                fmi2Boolean::from(instance.boolean_status(kind(instance, Call::GetBooleanStatus, s)?)?);
            Ok(())
        })
    }
}

/// `fmi2Discard`: no status of this type exists (section 4.2.3).
///
/// # Safety
/// `c` is a live instance.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2GetStringStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2String,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetStringStatus, |instance| {
            instance.other_status(Call::GetStringStatus, kind(instance, Call::GetStringStatus, s)?)
        })
    }
}

/// The kind of status a host asks for. The calling table comes first: in a mode that forbids the call, its kind does
/// not matter.
fn kind(instance: &Instance<Packed>, call: Call, s: fmi2StatusKind) -> Result<StatusKind, Error> {
    instance.check(call)?;
    status_kind(s).ok_or(Error::NoSuchStatus { reason: "the standard has the kinds 0 to 3" })
}
