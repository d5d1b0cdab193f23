//! Which handles a host may use: a list of those that were handed out and not given back.
//!
//! A handle is an address. Whoever passes one that is freed already, or of another library, gets an error instead of whatever is at that
//! address now. Entries are few and calls are long, so that a sorted list behind one lock will do. A list that has become empty holds no
//! memory: a library that is unloaded leaves nothing behind.

use std::{
    ffi::c_void,
    sync::{PoisonError, RwLock},
};

/// The instances of this library in this process.
pub static INSTANCES: Live = Live::new();
/// The FMU states.
pub static STATES: Live = Live::new();

/// The live handles of one kind.
#[derive(Debug)]
pub struct Live(RwLock<Vec<usize>>);

impl Live {
    const fn new() -> Self {
        Self(RwLock::new(Vec::new()))
    }

    /// Whether a handle is live.
    pub fn has(&self, handle: *const c_void) -> bool {
        // The list is whole between two statements: a panic elsewhere does it no harm.
        self.0.read().unwrap_or_else(PoisonError::into_inner).binary_search(&handle.addr()).is_ok()
    }

    /// A handle is handed out.
    pub fn add(&self, handle: *const c_void) {
        let mut list = self.0.write().unwrap_or_else(PoisonError::into_inner);
        if let Err(place) = list.binary_search(&handle.addr()) {
            list.insert(place, handle.addr());
        }
    }

    /// A handle is given back; false: it is not live.
    pub fn remove(&self, handle: *const c_void) -> bool {
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
