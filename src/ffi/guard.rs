//! What stands between C and safe code: null checks, caught panics, log lines, status.

use std::{
    ffi::{CStr, c_void},
    panic::{AssertUnwindSafe, catch_unwind},
};

use super::{
    component::{Component, Host},
    fault,
    float_environment::Usual,
    fmi3_types::Callbacks,
    live,
    types::{fmi2Status, fmi2String},
};
use crate::fmi::{
    Model, Status,
    error::Error,
    instance::{FmuState, Instance},
    lifecycle::{Call, Standard},
};

/// Runs the `body` of a function of FMI 2.0: [`run`].
///
/// # Safety
/// As [`run`].
pub unsafe fn guard<M: Model>(
    handle: *mut c_void,
    call: Call,
    body: impl FnOnce(&mut Instance<M>) -> Result<(), Error>,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { run(Standard::Fmi2, handle, call, body) }.into()
}

/// Runs `body` on the instance behind a handle. An error goes to the log, with call and mode in front, and becomes a
/// status; a panic makes the instance unusable, is logged, and becomes [`Status::Fatal`]. A handle that is none, freed
/// already, or of the other version of the standard, is [`Status::Error`].
///
/// # Safety
/// A live `handle` is from [`Component::into_handle`] with the same model type, and not in use elsewhere.
pub unsafe fn run<M: Model>(
    standard: Standard,
    handle: *mut c_void,
    call: Call,
    body: impl FnOnce(&mut Instance<M>) -> Result<(), Error>,
) -> Status {
    let mut body = Some(body);
    let mut once = |instance: &mut Instance<M>| body.take().map_or(Ok(()), |body| body(instance));
    // SAFETY: the caller's promise.
    unsafe { run_any(standard, handle, call, &mut once) }
}

/// The body of a function, whichever.
type Body<'a, M> = &'a mut dyn FnMut(&mut Instance<M>) -> Result<(), Error>;

/// [`run`], compiled once for all functions: a guard of its own for each would take two kilobytes.
///
/// # Safety
/// As [`run`].
#[inline(never)]
unsafe fn run_any<M: Model>(standard: Standard, handle: *mut c_void, call: Call, body: Body<'_, M>) -> Status {
    // SAFETY: the caller's promise.
    let Some(component) = (unsafe { Component::<M>::behind(handle) }) else {
        return Status::Error;
    };
    match caught(|| answer(component, standard, call, body)) {
        Ok(status) => status,
        Err(message) => {
            component.instance.give_up();
            // A logger that panics, or a second fault, leaves nothing to say.
            let _ = caught(|| {
                let error = Error::Fault { message };
                component.report();
                component.host.log(error.status(), error.category(), &format!("{}: {error}", standard.name(call)));
            });
            Status::Fatal
        }
    }
}

/// The callbacks of the host of FMI 3.0 that a handle belongs to; none: it is not live, or the host is another one.
///
/// # Safety
/// As [`run`].
pub unsafe fn callbacks<M: Model>(handle: *mut c_void) -> Option<Callbacks> {
    // SAFETY: the caller's promise.
    match &unsafe { Component::<M>::behind(handle) }?.host {
        Host::Fmi3(callbacks) => Some(*callbacks),
        Host::Fmi2 { .. } => None,
    }
}

/// What `body` gives, in the usual floating-point environment; a panic in it becomes its words and its place. Whoever
/// calls this sees to it that nothing half-done is used again.
pub(super) fn caught<R>(body: impl FnOnce() -> R) -> Result<R, String> {
    let _usual = Usual::enter();
    catch_unwind(AssertUnwindSafe(body)).map_err(|payload| fault::message(payload.as_ref()))
}

fn answer<M: Model>(component: &mut Component<M>, standard: Standard, call: Call, body: Body<'_, M>) -> Status {
    let (mode, time) = (component.instance.mode(), component.instance.time());
    let outcome = match component.instance.standard() {
        own if own == standard => body(&mut component.instance),
        Standard::Fmi2 => Err(Error::OtherStandard { own: "2.0" }),
        Standard::Fmi3 => Err(Error::OtherStandard { own: "3.0" }),
    };
    component.report();
    let status = component.instance.take_status();
    match outcome {
        Ok(()) => status,
        Err(error) => {
            component.host.log(
                error.status(),
                error.category(),
                &format!("{} {mode} at t = {time} s: {error}", standard.name(call)),
            );
            error.status()
        }
    }
}

/// Gives a component back; a handle that is not live is left alone. Works after a panic too; a panic on the way leaks
/// the rest.
///
/// # Safety
/// As [`guard`].
pub unsafe fn free<M: Model>(handle: *mut c_void) {
    // SAFETY: the caller's promise.
    let _ = caught(|| drop(unsafe { Component::<M>::from_handle(handle) }));
}

/// A C array to read. NULL is fine where it has no elements.
///
/// # Safety
/// Unless NULL, `start` points to `count` values that nobody changes during the call.
pub unsafe fn slice<'a, T>(start: *const T, count: usize, argument: &'static str) -> Result<&'a [T], Error> {
    check_array(start, count, argument)?;
    if count == 0 {
        return Ok(&[]);
    }
    // SAFETY: not NULL, short enough, and the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts(start, count) })
}

/// A C array to write to. NULL is fine where it has no elements.
///
/// # Safety
/// Unless NULL, `start` points to `count` values that nobody else uses during the call.
pub unsafe fn slice_mut<'a, T>(start: *mut T, count: usize, argument: &'static str) -> Result<&'a mut [T], Error> {
    check_array(start, count, argument)?;
    if count == 0 {
        return Ok(&mut []);
    }
    // SAFETY: not NULL, short enough, and the caller's promise.
    Ok(unsafe { std::slice::from_raw_parts_mut(start, count) })
}

fn check_array<T>(start: *const T, count: usize, argument: &'static str) -> Result<(), Error> {
    if count > isize::MAX as usize / size_of::<T>().max(1) {
        return Err(Error::TooLong { argument, count });
    }
    if count > 0 && start.is_null() {
        return Err(Error::Null { argument });
    }
    Ok(())
}

/// A place to write one value to.
///
/// # Safety
/// Unless NULL, `place` points to a value that nobody else uses during the call.
pub unsafe fn place<'a, T>(place: *mut T, argument: &'static str) -> Result<&'a mut T, Error> {
    // SAFETY: the caller's promise.
    unsafe { place.as_mut() }.ok_or(Error::Null { argument })
}

/// Writes an answer.
///
/// # Safety
/// Unless NULL, `target` points to a value that nobody else uses during the call.
pub unsafe fn answer_to<T>(target: *mut T, argument: &'static str, value: T) -> Result<(), Error> {
    // SAFETY: the caller's promise.
    *unsafe { place(target, argument) }? = value;
    Ok(())
}

/// Text from the host.
///
/// # Safety
/// Unless NULL, `text` ends with a zero byte and stays as it is during the call.
pub unsafe fn text<'a>(text: fmi2String, argument: &'static str) -> Result<&'a str, Error> {
    if text.is_null() {
        return Err(Error::Null { argument });
    }
    // SAFETY: not NULL, and the caller's promise.
    unsafe { CStr::from_ptr(text) }.to_str().map_err(|_| Error::NotUtf8 { argument })
}

/// The copy behind a handle.
///
/// # Safety
/// A live `handle` is a state with the same model type, and not in use elsewhere.
unsafe fn state_behind<'a, M: Model>(handle: *mut c_void) -> Result<&'a mut FmuState<M>, Error> {
    if handle.is_null() {
        return Err(Error::Null { argument: "FMUstate" });
    }
    // SAFETY: the caller's promise.
    unsafe { live::STATES.behind(handle) }.ok_or(Error::UnknownState)
}

/// Puts a copy that `make` makes into `state`, over an earlier copy if there is one.
///
/// # Safety
/// Unless NULL, `state` can be written to; a live state there has the same model type.
pub unsafe fn hand_out_state<M: Model>(
    state: *mut *mut c_void,
    make: impl FnOnce() -> Result<FmuState<M>, Error>,
) -> Result<(), Error> {
    // SAFETY: the caller's promise.
    let handle = unsafe { place(state, "FMUstate") }?;
    if handle.is_null() {
        *handle = live::STATES.hand_out(make()?);
    } else {
        // SAFETY: the caller's promise.
        *unsafe { state_behind(*handle) }? = make()?;
    }
    Ok(())
}

/// Brings the instance back to a copy.
///
/// # Safety
/// A live `state` has the same model type.
pub unsafe fn load_state<M: Model>(instance: &mut Instance<M>, state: *mut c_void) -> Result<(), Error> {
    instance.check(Call::SetFMUstate)?;
    // SAFETY: the caller's promise.
    instance.set_state(unsafe { state_behind(state) }?)
}

/// The bytes of a copy.
///
/// # Safety
/// A live `state` has the same model type.
pub unsafe fn serialize<M: Model>(instance: &Instance<M>, call: Call, state: *mut c_void) -> Result<Vec<u8>, Error> {
    instance.check(call)?;
    // SAFETY: the caller's promise.
    instance.serialize(call, unsafe { state_behind(state) }?)
}

/// Writes the number of bytes of a copy to `size`.
///
/// # Safety
/// A live `state` has the same model type; unless NULL, `size` can be written to.
pub unsafe fn serialized_size<M: Model>(
    instance: &Instance<M>,
    call: Call,
    state: *mut c_void,
    size: *mut usize,
) -> Result<(), Error> {
    // SAFETY: the caller's promise.
    let bytes = unsafe { serialize(instance, call, state) }?;
    // SAFETY: the caller's promise.
    *unsafe { place(size, "size") }? = bytes.len();
    Ok(())
}

/// Writes the bytes of a copy to `target`, which has room for all of them and no more.
///
/// # Safety
/// A live `state` has the same model type.
pub unsafe fn write_serialized<M: Model>(
    instance: &Instance<M>,
    call: Call,
    state: *mut c_void,
    target: &mut [u8],
) -> Result<(), Error> {
    // SAFETY: the caller's promise.
    let bytes = unsafe { serialize(instance, call, state) }?;
    if target.len() != bytes.len() {
        return Err(Error::SerializedSize { needed: bytes.len(), given: target.len() });
    }
    target.copy_from_slice(&bytes);
    Ok(())
}

/// Gives a copy back and forgets it; NULL is fine (FMI 2.0, section 2.1.8).
///
/// # Safety
/// As [`hand_out_state`].
pub unsafe fn free_state<M: Model>(instance: &Instance<M>, state: *mut *mut c_void) -> Result<(), Error> {
    instance.check(Call::FreeFMUstate)?;
    // SAFETY: the caller's promise.
    if let Some(handle) = unsafe { state.as_mut() }
        && !handle.is_null()
    {
        // SAFETY: the caller's promise.
        drop(unsafe { live::STATES.take_back::<FmuState<M>>(*handle) }.ok_or(Error::UnknownState)?);
        *handle = std::ptr::null_mut();
    }
    Ok(())
}
