//! The functions of fmi2Functions.h on values and derivatives.
//!
//! A live instance, in what follows, comes from `fmi2Instantiate`, was not freed, and is not in use on another thread.
//! NULL is answered with an error.
#![allow(non_snake_case, reason = "the standard's names")]

use super::{
    fmi2::guard,
    guard::{slice, slice_mut},
    types::*,
};
use crate::fmi::lifecycle::Call;

/// Reads Real variables (section 2.1.7).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetReal, |instance| instance.get_real(slice(vr, nvr, "vr")?, slice_mut(value, nvr, "value")?))
    }
}

/// Sets Real variables: all of them, or none if one is refused (section 2.1.7).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::SetReal, |instance| instance.set_real(slice(vr, nvr, "vr")?, slice(value, nvr, "value")?)) }
}

/// Reads Integer variables (section 2.1.7).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetInteger(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetInteger, |instance| {
            instance.get_integer(slice(vr, nvr, "vr")?, slice_mut(value, nvr, "value")?)
        })
    }
}

/// Sets Integer variables: all of them, or none if one is refused (section 2.1.7).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetInteger(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Integer,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::SetInteger, |instance| instance.set_integer(slice(vr, nvr, "vr")?, slice(value, nvr, "value")?))
    }
}

/// Reads Boolean variables, of which there are none: an error unless `nvr` is 0 (section 2.1.7).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2GetBoolean(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::GetBoolean, |instance| instance.get_boolean(slice(vr, nvr, "vr")?)) }
}

/// Sets Boolean variables, of which there are none: an error unless `nvr` is 0 (section 2.1.7).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2SetBoolean(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Boolean,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::SetBoolean, |instance| instance.set_boolean(slice(vr, nvr, "vr")?)) }
}

/// Reads String variables, of which there are none: an error unless `nvr` is 0 (section 2.1.7).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2GetString(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2String,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::GetString, |instance| instance.get_string(slice(vr, nvr, "vr")?)) }
}

/// Sets String variables, of which there are none: an error unless `nvr` is 0 (section 2.1.7).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
#[allow(unused_variables, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi2SetString(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2String,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe { guard(c, Call::SetString, |instance| instance.set_string(slice(vr, nvr, "vr")?)) }
}

/// Sets first derivatives of Real inputs by time, for the next step only (section 4.2.1).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::SetRealInputDerivatives, |instance| {
            let (order, value) = (slice(order, nvr, "order")?, slice(value, nvr, "value")?);
            instance.set_real_input_derivatives(slice(vr, nvr, "vr")?, order, value)
        })
    }
}

/// Reads first derivatives of Real outputs by time (section 4.2.1).
///
/// # Safety
/// `c` is a live instance; the arrays have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetRealOutputDerivatives, |instance| {
            let (order, value) = (slice(order, nvr, "order")?, slice_mut(value, nvr, "value")?);
            instance.get_real_output_derivatives(slice(vr, nvr, "vr")?, order, value)
        })
    }
}

/// The change of outputs at the end of the last step with the inputs of that step (section 2.1.9).
///
/// # Safety
/// `c` is a live instance; the arrays of unknowns have `nUnknown` elements, those of knowns `nKnown`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: fmi2Component,
    vUnknown_ref: *const fmi2ValueReference,
    nUnknown: usize,
    vKnown_ref: *const fmi2ValueReference,
    nKnown: usize,
    dvKnown: *const fmi2Real,
    dvUnknown: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(c, Call::GetDirectionalDerivative, |instance| {
            let unknowns = slice(vUnknown_ref, nUnknown, "vUnknown_ref")?;
            let knowns = slice(vKnown_ref, nKnown, "vKnown_ref")?;
            let (seeds, changes) = (slice(dvKnown, nKnown, "dvKnown")?, slice_mut(dvUnknown, nUnknown, "dvUnknown")?);
            instance.directional_derivative(unknowns, knowns, seeds, changes)
        })
    }
}
