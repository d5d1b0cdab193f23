//! A library that panics on demand, caught and reported as src/ffi/guard.rs does it: test_portability.py builds it as
//! scripts/build.sh builds what is shipped, in which nothing can make a panic from outside.

use std::{
    ffi::{CString, c_char, c_double},
    hint::black_box,
    panic::{AssertUnwindSafe, catch_unwind},
};

#[path = "../../src/ffi/fault.rs"]
mod fault;

/// Counts what is dropped on the way of a panic.
struct Counted<'a>(&'a mut u32);

impl Drop for Counted<'_> {
    fn drop(&mut self) {
        *self.0 += 1;
    }
}

/// So deep that unwinding has frames to go through, each with something to drop.
#[inline(never)]
fn descend(levels: u32, dropped: &mut u32, value: c_double) -> c_double {
    let counted = Counted(dropped);
    if levels == 0 {
        assert!(value < 1.0, "{value} is too much");
        return value;
    }
    let deeper = descend(levels - 1, black_box(&mut *counted.0), value);
    black_box(deeper) + 0.0
}

/// 0, or 4 (fmi2Fatal) after a panic; writes what was dropped and what the log would say.
///
/// # Safety
/// `dropped` points to a number, `text` to 200 bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn step(value: c_double, dropped: *mut u32, text: *mut c_char) -> i32 {
    fault::silence();
    // SAFETY: the caller's promise.
    let dropped = unsafe { &mut *dropped };
    match catch_unwind(AssertUnwindSafe(|| descend(20, dropped, value))) {
        Ok(_) => 0,
        Err(payload) => {
            let mut message = fault::message(payload.as_ref());
            message.truncate(199);
            let message = CString::new(message).unwrap_or_default();
            // SAFETY: the caller's promise; the message is shorter.
            unsafe { text.copy_from_nonoverlapping(message.as_ptr(), message.as_bytes_with_nul().len()) };
            4
        }
    }
}
