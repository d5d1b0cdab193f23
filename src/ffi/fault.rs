//! Panics: silent for the host's stderr, and what they said for the log.
//!
//! The standard library's own panic hook prints, and asks for the current thread, which creates a thread key that an
//! unloaded library never gives back. [`silence`] replaces it, within this library's copy of the standard library, by
//! one that only notes the place.

use std::{
    any::Any,
    cell::Cell,
    panic::{PanicHookInfo, set_hook},
};

/// Longest place kept, bytes: `src/mechanics/beam/ancf14/energy/bending.rs:123` and much more.
const LONGEST_PLACE: usize = 120;

/// Length and bytes of a file name, and the line.
type Place = (usize, [u8; LONGEST_PLACE], u32);

const NOWHERE: Place = (0, [0; LONGEST_PLACE], 0);

thread_local! {
    /// File and line of the last panic of this thread. Plain data without a destructor: it needs no thread key.
    static PLACE: Cell<Place> = const { Cell::new(NOWHERE) };
}

/// Makes panics of this library silent; the guard logs them. Called by every `fmi2Instantiate`: it costs nothing.
pub fn silence() {
    set_hook(Box::new(note_place)); // a function has no size: the box allocates nothing
}

fn note_place(panic: &PanicHookInfo<'_>) {
    if let Some(location) = panic.location() {
        let mut file = [0; LONGEST_PLACE];
        let name = location.file().as_bytes();
        let length = name.len().min(LONGEST_PLACE);
        file[..length].copy_from_slice(&name[..length]);
        PLACE.set((length, file, location.line()));
    }
}

/// What a caught panic said, and where it happened if the hook noted it.
pub(super) fn message(payload: &(dyn Any + Send)) -> String {
    let words = match (payload.downcast_ref::<&str>(), payload.downcast_ref::<String>()) {
        (Some(words), _) => words,
        (None, Some(words)) => words.as_str(),
        (None, None) => "panic without a message",
    };
    let (length, file, line) = PLACE.replace(NOWHERE);
    match length {
        0 => words.to_owned(),
        _ => format!("{words} ({}:{line})", String::from_utf8_lossy(&file[..length])),
    }
}
