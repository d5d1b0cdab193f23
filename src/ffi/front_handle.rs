//! What a program holds behind an `ancf14_simulation *`: the simulation, and the texts that C reads of it.

use std::{
    collections::VecDeque,
    ffi::{CString, c_char},
};

use super::{
    front_types::{ancf14_simulation, ancf14_status},
    guard::{caught, slice_mut},
    live,
};
use crate::fmi;
use crate::simulation::{Error, SavedState, Simulation};

/// What is said of a handle that is none.
pub(super) const NO_HANDLE: &std::ffi::CStr =
    c"this is no live simulation: the handle is NULL, was freed, or is another pointer; pass one that ancf14_load_file or \
    ancf14_load_text has returned";

/// A simulation and its texts for C.
pub(super) struct Front {
    pub simulation: Simulation,
    /// Name, unit and description of each variable.
    pub texts: Vec<[CString; 3]>,
    /// The sentence of the last call that failed.
    pub error: CString,
    warnings: VecDeque<String>,
    /// The warning that was handed out last.
    warning: CString,
}

/// A program may use them in any thread, in one at a time.
const _: () = {
    const fn may_move<T: Send>() {}
    may_move::<Front>();
    may_move::<SavedState>();
};

/// Why a call failed.
pub(super) enum Mistake {
    /// An argument is no address, no text, or no handle.
    Argument(ancf14_status, String),
    /// The simulation says why.
    Simulation(Error),
}

impl From<Error> for Mistake {
    fn from(error: Error) -> Self {
        Self::Simulation(error)
    }
}

impl From<fmi::error::Error> for Mistake {
    fn from(error: fmi::error::Error) -> Self {
        Self::Argument(ancf14_status::ANCF14_BAD_ARGUMENT, error.to_string())
    }
}

impl Mistake {
    pub fn status(&self) -> ancf14_status {
        match self {
            Self::Argument(status, _) => *status,
            Self::Simulation(error) => error.into(),
        }
    }

    pub fn sentence(&self) -> String {
        match self {
            Self::Argument(_, sentence) => sentence.clone(),
            Self::Simulation(error) => error.to_string(),
        }
    }
}

impl Front {
    pub fn new(simulation: Simulation) -> Self {
        let texts = simulation.variables().map(|row| [row.name, row.unit, row.description].map(c_text)).collect();
        let (error, warnings, warning) = (CString::default(), VecDeque::new(), CString::default());
        Self { simulation, texts, error, warnings, warning }
    }

    /// The oldest warning that was not handed out yet.
    pub fn next_warning(&mut self) -> Option<*const c_char> {
        self.warnings.extend(self.simulation.take_warnings());
        self.warning = c_text(&self.warnings.pop_front()?);
        Some(self.warning.as_ptr())
    }

    /// The texts of a variable.
    pub fn texts_of(&self, variable: i32) -> Result<&[CString; 3], Error> {
        Ok(&self.texts[self.simulation.variable(place(variable))?.id.index()])
    }
}

/// The number of a variable as C counts; a negative one is beyond every table.
pub(super) fn place(variable: i32) -> usize {
    usize::try_from(variable).unwrap_or(usize::MAX)
}

/// Runs `body` on the simulation behind a handle; an error becomes a status and the sentence of `ancf14_last_error`. A
/// panic makes the simulation unusable.
///
/// # Safety
/// A live `handle` is not in use elsewhere.
pub(super) unsafe fn guard(
    handle: *mut ancf14_simulation,
    body: impl FnOnce(&mut Front) -> Result<(), Mistake>,
) -> ancf14_status {
    // SAFETY: all handles of this list are of this type, and the caller's promise.
    let Some(front) = (unsafe { live::SIMULATIONS.behind::<Front>(handle.cast()) }) else {
        return ancf14_status::ANCF14_BAD_HANDLE;
    };
    let outcome = caught(|| body(front)).unwrap_or_else(|message| {
        front.simulation.give_up();
        Err(Error::Fault { message }.into())
    });
    match outcome {
        Ok(()) => ancf14_status::ANCF14_OK,
        Err(mistake) => {
            front.error = c_text(&mistake.sentence());
            mistake.status()
        }
    }
}

/// As [`guard`], for what gives a value; `otherwise` where it fails.
///
/// # Safety
/// As [`guard`].
pub(super) unsafe fn ask<T>(
    handle: *mut ancf14_simulation,
    otherwise: T,
    body: impl FnOnce(&mut Front) -> Result<T, Mistake>,
) -> T {
    let mut answer = otherwise;
    // SAFETY: the caller's promise.
    unsafe {
        guard(handle, |front| {
            answer = body(front)?;
            Ok(())
        });
    }
    answer
}

/// A text for C: a zero byte inside becomes a blank.
pub(super) fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).expect("every zero byte was replaced")
}

/// Writes `text` into the memory of a program, as much as fits before a zero byte, cut between characters.
///
/// # Safety
/// Unless NULL, `buffer` has room for `size` bytes.
pub(super) unsafe fn write(text: &str, buffer: *mut c_char, size: usize) {
    // SAFETY: the caller's promise.
    let room = unsafe { slice_mut(buffer.cast::<u8>(), if buffer.is_null() { 0 } else { size }, "error") };
    let Ok([room @ .., _]) = room else { return };
    let length = text.floor_char_boundary(room.len());
    room[..length].copy_from_slice(&text.as_bytes()[..length]);
    room[..length].iter_mut().filter(|byte| **byte == 0).for_each(|byte| *byte = b' ');
    // SAFETY: one byte is left behind what was written.
    unsafe { buffer.add(length).write(0) };
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A panic becomes a status and a sentence with its words; then the simulation can only be freed.
    #[test]
    fn a_panic_becomes_a_fault() {
        let text = include_str!("../../c-examples/arm.toml");
        let simulation = Simulation::from_text("arm.toml", text).unwrap_or_else(|error| panic!("{error}"));
        let handle = live::SIMULATIONS.hand_out(Front::new(simulation)).cast();
        let radius = |front: &mut Front| Ok(front.simulation.value("rod.radius")?);
        // SAFETY: the handle is live and used here only.
        unsafe {
            assert_eq!(ask(handle, 0.0, radius), 0.01);
            assert_eq!(guard(handle, |_| panic!("it broke")), ancf14_status::ANCF14_FAULT);
            let sentence = |front: &mut Front| Ok(front.error.to_string_lossy().into_owned());
            let told = ask(handle, String::new(), sentence);
            assert!(told.contains("it broke") && told.contains("can only be freed"), "{told}");
            assert_eq!(guard(handle, |front| Ok(front.simulation.initialize()?)), ancf14_status::ANCF14_FAULT);
            assert_eq!(guard(handle, |front| Ok(front.simulation.reset()?)), ancf14_status::ANCF14_FAULT);
            assert_eq!(ask(handle, 0.0, radius), 0.0);
            assert!(live::SIMULATIONS.take_back::<Front>(handle.cast()).is_some());
            assert_eq!(guard(handle, |_| Ok(())), ancf14_status::ANCF14_BAD_HANDLE);
        }
    }
}
