//! Which handles a host may use: a list of those that were handed out and not given back.
//!
//! A handle is an address. Whoever passes one that is freed already, or of another library, gets an error instead of
//! whatever is at that address now. Entries are few and calls are long, so that a sorted list behind one lock will do.
//! A list that has become empty holds no memory: a library that is unloaded leaves nothing behind.

use std::{
    ffi::c_void,
    sync::{PoisonError, RwLock},
};

/// The instances of this library in this process.
pub static INSTANCES: Live = Live::new();
/// The FMU states.
pub static STATES: Live = Live::new();
/// The simulations of [`super::front`].
pub static SIMULATIONS: Live = Live::new();
/// The saved states of those.
pub static SAVED: Live = Live::new();

/// The live handles of one kind.
#[derive(Debug)]
pub struct Live(RwLock<Vec<usize>>);

impl Live {
    const fn new() -> Self {
        Self(RwLock::new(Vec::new()))
    }

    /// Hands `thing` out: its handle, to be given back by [`Self::take_back`].
    pub fn hand_out<T>(&self, thing: T) -> *mut c_void {
        let handle = Box::into_raw(Box::new(thing)).cast();
        self.add(handle);
        handle
    }

    /// What is behind a handle; none: it is not live.
    ///
    /// # Safety
    /// All handles of this list are of things of type `T`; a live `handle` is not in use elsewhere.
    pub unsafe fn behind<'a, T>(&self, handle: *mut c_void) -> Option<&'a mut T> {
        // SAFETY: the handle is live, and the caller's promise.
        self.has(handle).then(|| unsafe { &mut *handle.cast::<T>() })
    }

    /// Takes what is behind a handle back; none: it is not live.
    ///
    /// # Safety
    /// As [`Self::behind`].
    pub unsafe fn take_back<T>(&self, handle: *mut c_void) -> Option<Box<T>> {
        // SAFETY: the handle was live until now, so that `hand_out` made it of a box; and the caller's promise.
        self.remove(handle).then(|| unsafe { Box::from_raw(handle.cast()) })
    }

    /// Whether a handle is live.
    fn has(&self, handle: *const c_void) -> bool {
        // The list is whole between two statements: a panic elsewhere does it no harm.
        self.0.read().unwrap_or_else(PoisonError::into_inner).binary_search(&handle.addr()).is_ok()
    }

    /// A handle is handed out.
    fn add(&self, handle: *const c_void) {
        let mut list = self.0.write().unwrap_or_else(PoisonError::into_inner);
        if let Err(place) = list.binary_search(&handle.addr()) {
            list.insert(place, handle.addr());
        }
    }

    /// A handle is given back; false: it is not live.
    fn remove(&self, handle: *const c_void) -> bool {
        let mut list = self.0.write().unwrap_or_else(PoisonError::into_inner);
        let found = list.binary_search(&handle.addr());
        if let Ok(place) = found {
            list.remove(place);
        }
        if list.is_empty() {
            *list = Vec::new();
        }
        found.is_ok()
    }
}
