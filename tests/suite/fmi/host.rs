//! A host as C sees it: a logger that collects lines, and its callback table.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::{
    cell::RefCell,
    ffi::{CStr, c_void},
};

use ancf14::ffi::types::{fmi2CallbackFunctions, fmi2CallbackLogger, fmi2Status, fmi2String};

/// Lines the logger got: `status category message`.
#[derive(Default)]
pub struct Lines(RefCell<Vec<String>>);

impl Lines {
    /// All lines since the last call.
    pub fn take(&self) -> Vec<String> {
        self.0.take()
    }

    /// Callbacks that log to here.
    pub fn callbacks(&self) -> fmi2CallbackFunctions {
        type Fixed = unsafe extern "C" fn(*mut c_void, fmi2String, fmi2Status, fmi2String, fmi2String);
        // SAFETY: Rust cannot define a variadic function; on the platforms of these tests a variadic call without
        // variadic arguments passes its arguments the same way.
        let logger = unsafe { std::mem::transmute::<Option<Fixed>, fmi2CallbackLogger>(Some(collect)) };
        fmi2CallbackFunctions {
            logger,
            allocateMemory: None,
            freeMemory: None,
            stepFinished: None,
            componentEnvironment: std::ptr::from_ref(self).cast_mut().cast(),
        }
    }
}

unsafe extern "C" fn collect(
    environment: *mut c_void,
    name: fmi2String,
    status: fmi2Status,
    category: fmi2String,
    message: fmi2String,
) {
    // SAFETY: the environment is the `Lines` of this host, and the library passes texts that end with a zero byte.
    let (lines, [name, category, message]) = unsafe {
        (&*environment.cast::<Lines>(), [name, category, message].map(|text| CStr::from_ptr(text).to_string_lossy()))
    };
    lines.0.borrow_mut().push(format!("{name} {status:?} {category} {message}"));
}
