//! A unit as a host holds it: the exported functions, called in this process as C calls them, on a model file in a
//! directory of its own. What it asks for is given back at its end.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::{
    ffi::{CString, c_void},
    fs,
    ptr::{null, null_mut},
};

use ancf14::{
    ffi::{fmi2::*, fmi2_values::*, types::*},
    fmi::{Model, Value, lifecycle::Call, variable::Causality},
    model::simulation::Simulation,
};
use tempfile::TempDir;

use super::host::Lines;

/// A model file, unpacked, and its variables.
pub struct Place {
    directory: TempDir,
    pub model: Simulation,
}

/// A saved state, or NULL.
pub type Saved = *mut c_void;

/// An instance.
pub struct Unit<'a> {
    pub c: *mut c_void,
    place: &'a Place,
    pub lines: Box<Lines>,
}

impl Place {
    pub fn new(text: &str) -> Self {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("model.toml"), text).unwrap();
        Self { directory, model: Simulation::load("model.toml", text, &[]).unwrap() }
    }

    /// The value reference of a variable.
    pub fn reference(&self, name: &str) -> u32 {
        let place = self.model.variables().iter().position(|variable| variable.name == name);
        u32::try_from(place.unwrap_or_else(|| panic!("no variable {name}"))).unwrap()
    }

    /// References of all outputs that are Real.
    pub fn outputs(&self) -> Vec<u32> {
        let variables = self.model.variables().iter().enumerate();
        let real = variables.filter(|(_, variable)| {
            variable.causality == Causality::Output && matches!(variable.start, Value::Real(_))
        });
        real.map(|(place, _)| u32::try_from(place).unwrap()).collect()
    }
}

// SAFETY of all calls below: `self.c` is a live instance of this process, used on one thread; arrays have the lengths
// that are passed with them; saved states come from this library and are NULL after they were given back.
impl<'a> Unit<'a> {
    pub fn new(place: &'a Place) -> Self {
        let lines = Box::<Lines>::default();
        let callbacks = lines.callbacks();
        let guid = CString::new(place.model.about().guid.as_str()).unwrap();
        let resources = CString::new(place.directory.path().to_str().unwrap()).unwrap();
        // SAFETY: everything lives during the call; the library copies what it keeps. `lines` outlives the instance.
        let c = unsafe {
            fmi2Instantiate(
                c"unit".as_ptr(),
                fmi2CoSimulation,
                guid.as_ptr(),
                resources.as_ptr(),
                &raw const callbacks,
                fmi2False,
                fmi2False,
            )
        };
        // The library silences panics, which are those of the tests in this process: the standard hook again.
        drop(std::panic::take_hook());
        assert!(!c.is_null(), "{:?}", lines.take());
        Self { c, place, lines }
    }

    /// A call without arguments.
    pub fn simple(&self, call: Call) -> fmi2Status {
        // SAFETY: see above.
        unsafe {
            match call {
                Call::EnterInitializationMode => fmi2EnterInitializationMode(self.c),
                Call::ExitInitializationMode => fmi2ExitInitializationMode(self.c),
                Call::Terminate => fmi2Terminate(self.c),
                Call::Reset => fmi2Reset(self.c),
                Call::CancelStep => fmi2CancelStep(self.c),
                other => panic!("{other} has arguments"),
            }
        }
    }

    pub fn setup(&self, start: f64) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2SetupExperiment(self.c, fmi2False, 0.0, start, fmi2False, 0.0) }
    }

    pub fn get_real(&self, references: &[u32], values: &mut [f64]) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2GetReal(self.c, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }

    pub fn set_real(&self, references: &[u32], values: &[f64]) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2SetReal(self.c, references.as_ptr(), references.len(), values.as_ptr()) }
    }

    pub fn set_integer(&self, reference: u32, value: i32) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2SetInteger(self.c, &raw const reference, 1, &raw const value) }
    }

    pub fn set_slope(&self, reference: u32, order: i32, slope: f64) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2SetRealInputDerivatives(self.c, &raw const reference, 1, &raw const order, &raw const slope) }
    }

    pub fn do_step(&self, time: f64, step: f64) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2DoStep(self.c, time, step, fmi2False) }
    }

    /// The time that it has reached, s; in modes that know of steps.
    pub fn time(&self) -> f64 {
        let mut time = f64::NAN;
        // SAFETY: see above.
        let status = unsafe { fmi2GetRealStatus(self.c, fmi2LastSuccessfulTime, &raw mut time) };
        assert_eq!(status, fmi2Status::fmi2OK);
        time
    }

    pub fn save(&self, saved: &mut Saved) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2GetFMUstate(self.c, saved) }
    }

    pub fn restore(&self, saved: Saved) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2SetFMUstate(self.c, saved) }
    }

    pub fn forget(&self, saved: &mut Saved) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2FreeFMUstate(self.c, saved) }
    }

    pub fn serialize(&self, saved: Saved) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: see above.
        let status = unsafe { fmi2SerializedFMUstateSize(self.c, saved, &raw mut size) };
        assert_eq!(status, fmi2Status::fmi2OK, "{:?}", self.lines.take());
        let mut bytes = vec![0; size];
        assert_eq!(self.serialize_to(saved, &mut bytes), fmi2Status::fmi2OK, "{:?}", self.lines.take());
        bytes
    }

    pub fn serialize_to(&self, saved: Saved, bytes: &mut [u8]) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2SerializeFMUstate(self.c, saved, bytes.as_mut_ptr().cast(), bytes.len()) }
    }

    pub fn deserialize(&self, bytes: &[u8], saved: &mut Saved) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2DeSerializeFMUstate(self.c, bytes.as_ptr().cast(), bytes.len(), saved) }
    }

    /// Bits of all Real outputs.
    pub fn bits(&self) -> Vec<u64> {
        let references = self.place.outputs();
        let mut values = vec![f64::NAN; references.len()];
        let status = self.get_real(&references, &mut values);
        assert!(is_fine(status), "{:?}", self.lines.take());
        values.into_iter().map(f64::to_bits).collect()
    }

    /// Any function, with arguments that are in order: values and derivatives of nothing, a state of its own.
    pub fn call(&self, call: Call) -> fmi2Status {
        let (c, none) = (self.c, null::<u32>());
        let (mut saved, mut size, mut status) = (null_mut(), 0, fmi2Status::fmi2OK);
        let (mut real, mut integer, mut text) = (0.0, 0, null());
        // SAFETY: see above; arrays without elements may be NULL.
        unsafe {
            match call {
                Call::SetDebugLogging => fmi2SetDebugLogging(c, fmi2False, 0, null()),
                Call::SetupExperiment => self.setup(0.0),
                Call::GetReal => fmi2GetReal(c, none, 0, null_mut()),
                Call::GetInteger => fmi2GetInteger(c, none, 0, null_mut()),
                Call::GetBoolean => fmi2GetBoolean(c, none, 0, null_mut()),
                Call::GetString => fmi2GetString(c, none, 0, null_mut()),
                Call::SetReal => fmi2SetReal(c, none, 0, null()),
                Call::SetInteger => fmi2SetInteger(c, none, 0, null()),
                Call::SetBoolean => fmi2SetBoolean(c, none, 0, null()),
                Call::SetString => fmi2SetString(c, none, 0, null()),
                Call::GetFMUstate | Call::SetFMUstate | Call::FreeFMUstate => {
                    let mut status = self.save(&mut saved);
                    if call == Call::SetFMUstate {
                        status = self.restore(saved);
                    }
                    let freed = self.forget(&mut saved);
                    if call == Call::FreeFMUstate { freed } else { status }
                }
                Call::SerializedFMUstateSize | Call::SerializeFMUstate | Call::DeSerializeFMUstate => {
                    self.save(&mut saved);
                    let mut status = fmi2SerializedFMUstateSize(c, saved, &raw mut size);
                    let mut bytes = vec![0; size];
                    if call != Call::SerializedFMUstateSize {
                        status = self.serialize_to(saved, &mut bytes);
                    }
                    if call == Call::DeSerializeFMUstate {
                        status = self.deserialize(&bytes, &mut saved);
                    }
                    self.forget(&mut saved);
                    status
                }
                Call::GetDirectionalDerivative => fmi2GetDirectionalDerivative(c, none, 0, none, 0, null(), null_mut()),
                Call::SetRealInputDerivatives => fmi2SetRealInputDerivatives(c, none, 0, null(), null()),
                Call::GetRealOutputDerivatives => fmi2GetRealOutputDerivatives(c, none, 0, null(), null_mut()),
                Call::DoStep => {
                    let mut time = 0.0;
                    fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &raw mut time); // where there is none yet: an error, and 0
                    self.lines.take();
                    self.do_step(time, 1e-3)
                }
                Call::GetStatus => fmi2GetStatus(c, fmi2DoStepStatus, &raw mut status),
                Call::GetRealStatus => fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &raw mut real),
                Call::GetIntegerStatus => fmi2GetIntegerStatus(c, fmi2DoStepStatus, &raw mut integer),
                Call::GetBooleanStatus => fmi2GetBooleanStatus(c, fmi2Terminated, &raw mut integer),
                Call::GetStringStatus => fmi2GetStringStatus(c, fmi2PendingStatus, &raw mut text),
                Call::FreeInstance => panic!("it takes the instance away"),
                _ => self.simple(call),
            }
        }
    }
}

impl Drop for Unit<'_> {
    fn drop(&mut self) {
        // SAFETY: the instance is live and not used again.
        unsafe { fmi2FreeInstance(self.c) }
    }
}

/// What a host takes for success.
pub fn is_fine(status: fmi2Status) -> bool {
    matches!(status, fmi2Status::fmi2OK | fmi2Status::fmi2Warning)
}
