//! The functions of fmi3Functions.h on values and derivatives, for the types that variables have: Float64 and Int32.
//!
//! A live instance, in what follows, comes from `fmi3InstantiateCoSimulation`, was not freed, and is not in use on
//! another thread. NULL is answered with an error.
#![allow(non_snake_case, reason = "the standard's names")]

use super::{
    fmi3::guard,
    fmi3_types::*,
    guard::{place, slice, slice_mut},
};
use crate::fmi::lifecycle::Call;

/// Reads Float64 variables, arrays element by element (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3Float64,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetReal, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.get_float64(references, slice_mut(values, nValues, "values")?)
        })
    }
}

/// Sets Float64 variables, arrays element by element: all of them, or none if one is refused (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3Float64,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetReal, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.set_float64(references, slice(values, nValues, "values")?)
        })
    }
}

/// Reads Int32 variables, arrays element by element (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetInt32(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *mut fmi3Int32,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetInteger, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.get_int32(references, slice_mut(values, nValues, "values")?)
        })
    }
}

/// Sets Int32 variables, arrays element by element: all of them, or none if one is refused (section 2.2.8).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetInt32(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    values: *const fmi3Int32,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::SetInteger, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            instance.set_int32(references, slice(values, nValues, "values")?)
        })
    }
}

/// Reads first derivatives of Float64 outputs by time, arrays element by element (section 4.1.2).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetOutputDerivatives(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    orders: *const fmi3Int32,
    values: *mut fmi3Float64,
    nValues: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetRealOutputDerivatives, |instance| {
            let references = slice(valueReferences, nValueReferences, "valueReferences")?;
            let orders = slice(orders, nValueReferences, "orders")?;
            instance.get_output_derivatives(references, orders, slice_mut(values, nValues, "values")?)
        })
    }
}

/// The change of outputs at the end of the last step with the inputs of that step (section 2.2.11).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi3GetDirectionalDerivative(
    instance: fmi3Instance,
    unknowns: *const fmi3ValueReference,
    nUnknowns: usize,
    knowns: *const fmi3ValueReference,
    nKnowns: usize,
    seed: *const fmi3Float64,
    nSeed: usize,
    sensitivity: *mut fmi3Float64,
    nSensitivity: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetDirectionalDerivative, |instance| {
            let (unknowns, knowns) = (slice(unknowns, nUnknowns, "unknowns")?, slice(knowns, nKnowns, "knowns")?);
            let seeds = slice(seed, nSeed, "seed")?;
            instance.directional_derivative_of_arrays(
                unknowns,
                knowns,
                seeds,
                slice_mut(sensitivity, nSensitivity, "sensitivity")?,
            )
        })
    }
}

/// The transposed product: derivatives of the outputs at the end of the last step, weighted by the seeds, with respect
/// to its inputs (section 2.2.11).
///
/// # Safety
/// `instance` is a live instance; the arrays have the lengths that are passed.
#[unsafe(no_mangle)]
#[allow(clippy::too_many_arguments, reason = "the standard's signature")]
pub unsafe extern "C" fn fmi3GetAdjointDerivative(
    instance: fmi3Instance,
    unknowns: *const fmi3ValueReference,
    nUnknowns: usize,
    knowns: *const fmi3ValueReference,
    nKnowns: usize,
    seed: *const fmi3Float64,
    nSeed: usize,
    sensitivity: *mut fmi3Float64,
    nSensitivity: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetAdjointDerivative, |instance| {
            let (unknowns, knowns) = (slice(unknowns, nUnknowns, "unknowns")?, slice(knowns, nKnowns, "knowns")?);
            let seeds = slice(seed, nSeed, "seed")?;
            instance.adjoint_derivative_of_arrays(
                unknowns,
                knowns,
                seeds,
                slice_mut(sensitivity, nSensitivity, "sensitivity")?,
            )
        })
    }
}

/// The number of pairs of elements, one of this variable and one that it depends on (section 2.2.10).
///
/// # Safety
/// `instance` is a live instance; `nDependencies` can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfVariableDependencies(
    instance: fmi3Instance,
    valueReference: fmi3ValueReference,
    nDependencies: *mut usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetNumberOfVariableDependencies, |instance| {
            *place(nDependencies, "nDependencies")? = instance.count_dependencies(valueReference)?;
            Ok(())
        })
    }
}

/// Which elements depend on which (section 2.2.10).
///
/// # Safety
/// `instance` is a live instance; the arrays have `nDependencies` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetVariableDependencies(
    instance: fmi3Instance,
    dependent: fmi3ValueReference,
    elementIndicesOfDependent: *mut usize,
    independents: *mut fmi3ValueReference,
    elementIndicesOfIndependents: *mut usize,
    dependencyKinds: *mut fmi3Enumeration,
    nDependencies: usize,
) -> fmi3Status {
    // SAFETY: the caller's promise.
    unsafe {
        guard(instance, Call::GetVariableDependencies, |instance| {
            // Before the arrays are touched: a host that passes another number has arrays of another length.
            instance.check_dependencies(dependent, nDependencies)?;
            let elements = slice_mut(elementIndicesOfDependent, nDependencies, "elementIndicesOfDependent")?;
            let references = slice_mut(independents, nDependencies, "independents")?;
            let others = slice_mut(elementIndicesOfIndependents, nDependencies, "elementIndicesOfIndependents")?;
            let kinds = slice_mut(dependencyKinds, nDependencies, "dependencyKinds")?;
            instance.dependencies(dependent, elements, references, others)?;
            kinds.fill(fmi3Dependent);
            Ok(())
        })
    }
}
