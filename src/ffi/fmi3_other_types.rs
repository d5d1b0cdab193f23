//! The functions of fmi3Functions.h on types that no variable has: an error unless no reference is given.
//!
//! A live instance, in what follows, comes from `fmi3InstantiateCoSimulation`, was not freed, and is not in use on
//! another thread. NULL is answered with an error.
#![allow(non_snake_case, unused_variables, reason = "the standard's signatures")]

use super::{fmi3::guard, fmi3_types::*, guard::slice};
use crate::fmi::lifecycle::Call;

/// Reads Float32 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat32(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3Float32,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetFloat32, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetFloat32, references, "Float32")
        })
    }
}

/// Sets Float32 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat32(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3Float32,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetFloat32, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetFloat32, references, "Float32")
        })
    }
}

/// Reads Int8 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt8(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3Int8,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetInt8, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetInt8, references, "Int8")
        })
    }
}

/// Sets Int8 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt8(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3Int8,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetInt8, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetInt8, references, "Int8")
        })
    }
}

/// Reads UInt8 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt8(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3UInt8,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetUInt8, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetUInt8, references, "UInt8")
        })
    }
}

/// Sets UInt8 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt8(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3UInt8,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetUInt8, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetUInt8, references, "UInt8")
        })
    }
}

/// Reads Int16 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt16(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3Int16,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetInt16, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetInt16, references, "Int16")
        })
    }
}

/// Sets Int16 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt16(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3Int16,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetInt16, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetInt16, references, "Int16")
        })
    }
}

/// Reads UInt16 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt16(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3UInt16,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetUInt16, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetUInt16, references, "UInt16")
        })
    }
}

/// Sets UInt16 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt16(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3UInt16,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetUInt16, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetUInt16, references, "UInt16")
        })
    }
}

/// Reads UInt32 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt32(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3UInt32,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetUInt32, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetUInt32, references, "UInt32")
        })
    }
}

/// Sets UInt32 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt32(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3UInt32,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetUInt32, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetUInt32, references, "UInt32")
        })
    }
}

/// Reads Int64 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt64(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3Int64,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetInt64, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetInt64, references, "Int64")
        })
    }
}

/// Sets Int64 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt64(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3Int64,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetInt64, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetInt64, references, "Int64")
        })
    }
}

/// Reads UInt64 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetUInt64(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3UInt64,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetUInt64, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetUInt64, references, "UInt64")
        })
    }
}

/// Sets UInt64 variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetUInt64(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3UInt64,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetUInt64, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetUInt64, references, "UInt64")
        })
    }
}

/// Reads Boolean variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetBoolean(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3Boolean,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetBoolean, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetBoolean, references, "Boolean")
        })
    }
}

/// Sets Boolean variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetBoolean(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3Boolean,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetBoolean, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetBoolean, references, "Boolean")
        })
    }
}

/// Reads String variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetString(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3String,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetString, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetString, references, "String")
        })
    }
}

/// Sets String variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetString(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3String,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetString, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetString, references, "String")
        })
    }
}

/// Reads Binary variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetBinary(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    valueSizes: *mut usize,
    values: *mut fmi3Binary,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetBinary, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::GetBinary, references, "Binary")
        })
    }
}

/// Sets Binary variables, of which there are none (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetBinary(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    valueSizes: *const usize,
    values: *const fmi3Binary,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetBinary, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.no_variable(Call::SetBinary, references, "Binary")
        })
    }
}
