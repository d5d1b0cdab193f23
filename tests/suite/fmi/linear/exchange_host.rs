//! A host for Model Exchange of either version: the exported functions, called in this process as C calls them, on the
//! file of a linear system in a directory of its own.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_void};
use std::fs;
use std::ptr::{null, null_mut};

use ancf14::ffi::{fmi2::*, fmi2_exchange::*, fmi2_values::*, types::*};
use ancf14::ffi::{fmi3::*, fmi3_exchange::*, fmi3_types::*, fmi3_values::*};
use ancf14::fmi::Model;
use ancf14::fmi::lifecycle::{Call, Kind, Mode, Standard};
use ancf14::linear::Unit as Linear;
use tempfile::TempDir;

use crate::fmi::host::Lines;

/// The states of the oscillator.
pub const STATES: usize = 2;
/// Value references of its input, its outputs, its states and their rates.
pub const INPUT: u32 = 0;
pub const OUTPUTS: [u32; 3] = [1, 2, 3];
pub const STATE: [u32; STATES] = [4, 5];
pub const RATES: [u32; STATES] = [6, 7];

/// The file of a linear system in a folder.
pub struct Place {
    directory: TempDir,
    guid: CString,
}

impl Place {
    pub fn new(text: &str) -> Self {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("linear.toml"), text).unwrap();
        let unit = Linear::load("linear.toml", text).unwrap_or_else(|failure| panic!("{}", failure.message));
        Self { directory, guid: CString::new(unit.about().guid.as_str()).unwrap() }
    }
}

/// An instance and its log.
pub struct Unit {
    pub c: *mut c_void,
    pub standard: Standard,
    lines: Box<Lines>,
    lines_fmi3: Box<RefCell<Vec<String>>>,
}

unsafe extern "C" fn log(environment: *mut c_void, status: fmi3Status, category: fmi3String, message: fmi3String) {
    // SAFETY: the environment is the list of a unit that lives, and the texts end with a zero byte.
    let (list, [category, message]) = unsafe {
        let texts = [category, message].map(|text| CStr::from_ptr(text).to_str().unwrap());
        (&*environment.cast::<RefCell<Vec<String>>>(), texts)
    };
    list.borrow_mut().push(format!("{status:?} {category} {message}"));
}

/// Whether a status of either version says that all is well.
fn is_ok(status: u32) -> bool {
    assert!([0, 1, 3].contains(&status), "{status} is neither a success nor an error");
    status < 3
}

// SAFETY of all calls below: `self.c` is a live instance of this process, used on one thread; arrays have the lengths
// that are passed; saved states come from this library.
impl Unit {
    pub fn new(place: &Place, standard: Standard, kind: Kind) -> Self {
        let (lines, lines_fmi3) = (Box::<Lines>::default(), Box::<RefCell<Vec<String>>>::default());
        let callbacks = lines.callbacks();
        let folder = CString::new(place.directory.path().to_str().unwrap()).unwrap();
        let (name, guid, folder) = (c"unit".as_ptr(), place.guid.as_ptr(), folder.as_ptr());
        let environment = std::ptr::from_ref(&*lines_fmi3).cast_mut().cast::<c_void>();
        // SAFETY: everything lives during the call, and the logs outlive the instance.
        let c = unsafe {
            match (standard, kind) {
                (Standard::Fmi2, kind) => {
                    let kind = if kind == Kind::ModelExchange { fmi2ModelExchange } else { fmi2CoSimulation };
                    fmi2Instantiate(name, kind, guid, folder, &raw const callbacks, 0, 0)
                }
                (Standard::Fmi3, Kind::ModelExchange) => {
                    fmi3InstantiateModelExchange(name, guid, folder, 0, 1, environment, Some(log))
                }
                (Standard::Fmi3, Kind::CoSimulation) => {
                    fmi3InstantiateCoSimulation(name, guid, folder, 0, 1, 0, 0, null(), 0, environment, Some(log), None)
                }
            }
        };
        drop(std::panic::take_hook());
        let unit = Self { c, standard, lines, lines_fmi3 };
        assert!(!c.is_null(), "{:?}", unit.lines());
        unit
    }

    /// Log lines since the last call.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = self.lines.take();
        lines.append(&mut self.lines_fmi3.borrow_mut());
        lines
    }

    /// A new unit in a mode, as a host brings it there.
    pub fn in_mode(place: &Place, standard: Standard, mode: Mode) -> Self {
        let unit = Self::new(place, standard, Kind::ModelExchange);
        let way: &[Call] = match mode {
            Mode::Instantiated => &[],
            Mode::Initialization => &[Call::EnterInitializationMode],
            Mode::Event => &[Call::EnterInitializationMode, Call::ExitInitializationMode],
            Mode::ContinuousTime => &[
                Call::EnterInitializationMode,
                Call::ExitInitializationMode,
                Call::UpdateDiscreteStates,
                Call::EnterContinuousTimeMode,
            ],
            Mode::Terminated => &[Call::EnterInitializationMode, Call::ExitInitializationMode, Call::Terminate],
            other => panic!("Model Exchange does not know {other:?}"),
        };
        way.iter().for_each(|call| assert!(unit.call(*call), "{call:?}: {:?}", unit.lines()));
        unit.lines();
        unit
    }

    /// A call with arguments that are in order; whether it succeeds.
    pub fn call(&self, call: Call) -> bool {
        let two = self.standard == Standard::Fmi2;
        let (c, mut x) = (self.c, [0.125; STATES]);
        let (mut flags, mut words, mut count) = ([0_u8; 5], [0; 2], 0_usize);
        let (mut info, mut time) = (fmi2EventInfo::default(), 0.0);
        let [a, b, d, e, f] = &mut flags;
        let [g, h] = &mut words;
        // SAFETY: see above.
        is_ok(unsafe {
            match (call, two) {
                (Call::EnterInitializationMode, true) => fmi2EnterInitializationMode(c) as u32,
                (Call::EnterInitializationMode, _) => fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0) as u32,
                (Call::ExitInitializationMode, true) => fmi2ExitInitializationMode(c) as u32,
                (Call::ExitInitializationMode, _) => fmi3ExitInitializationMode(c) as u32,
                (Call::Terminate, true) => fmi2Terminate(c) as u32,
                (Call::Terminate, _) => fmi3Terminate(c) as u32,
                (Call::Reset, true) => fmi2Reset(c) as u32,
                (Call::Reset, _) => fmi3Reset(c) as u32,
                (Call::EnterEventMode, true) => fmi2EnterEventMode(c) as u32,
                (Call::EnterEventMode, _) => fmi3EnterEventMode(c) as u32,
                (Call::UpdateDiscreteStates, true) => fmi2NewDiscreteStates(c, &raw mut info) as u32,
                (Call::UpdateDiscreteStates, _) => fmi3UpdateDiscreteStates(c, a, b, d, e, f, &raw mut time) as u32,
                (Call::EnterContinuousTimeMode, true) => fmi2EnterContinuousTimeMode(c) as u32,
                (Call::EnterContinuousTimeMode, _) => fmi3EnterContinuousTimeMode(c) as u32,
                (Call::CompletedIntegratorStep, true) => fmi2CompletedIntegratorStep(c, 1, g, h) as u32,
                (Call::CompletedIntegratorStep, _) => fmi3CompletedIntegratorStep(c, 1, a, b) as u32,
                (Call::SetTime, true) => fmi2SetTime(c, 0.25) as u32,
                (Call::SetTime, _) => fmi3SetTime(c, 0.25) as u32,
                (Call::SetContinuousStates, true) => fmi2SetContinuousStates(c, x.as_ptr(), STATES) as u32,
                (Call::SetContinuousStates, _) => fmi3SetContinuousStates(c, x.as_ptr(), STATES) as u32,
                (Call::GetContinuousStateDerivatives, true) => fmi2GetDerivatives(c, x.as_mut_ptr(), STATES) as u32,
                (Call::GetContinuousStateDerivatives, _) => {
                    fmi3GetContinuousStateDerivatives(c, x.as_mut_ptr(), STATES) as u32
                }
                (Call::GetEventIndicators, true) => fmi2GetEventIndicators(c, null_mut(), 0) as u32,
                (Call::GetEventIndicators, _) => fmi3GetEventIndicators(c, null_mut(), 0) as u32,
                (Call::GetContinuousStates, true) => fmi2GetContinuousStates(c, x.as_mut_ptr(), STATES) as u32,
                (Call::GetContinuousStates, _) => fmi3GetContinuousStates(c, x.as_mut_ptr(), STATES) as u32,
                (Call::GetNominalsOfContinuousStates, true) => {
                    fmi2GetNominalsOfContinuousStates(c, x.as_mut_ptr(), STATES) as u32
                }
                (Call::GetNominalsOfContinuousStates, _) => {
                    fmi3GetNominalsOfContinuousStates(c, x.as_mut_ptr(), STATES) as u32
                }
                (Call::GetNumberOfContinuousStates, false) => fmi3GetNumberOfContinuousStates(c, &raw mut count) as u32,
                (Call::GetNumberOfEventIndicators, false) => fmi3GetNumberOfEventIndicators(c, &raw mut count) as u32,
                (Call::GetReal, _) => return self.get(&OUTPUTS, &mut [0.0; 3]),
                (Call::SetReal, _) => return self.set(&[INPUT], &[0.5]),
                (Call::GetDirectionalDerivative, _) => return self.directional(&OUTPUTS, &[INPUT]).is_some(),
                (Call::DoStep, true) => fmi2DoStep(c, 0.0, 0.1, 0) as u32,
                (Call::DoStep, _) => fmi3DoStep(c, 0.0, 0.1, 0, a, b, d, &raw mut time) as u32,
                (other, _) => panic!("{other:?} has no arguments here"),
            }
        })
    }

    pub fn get(&self, references: &[u32], values: &mut [f64]) -> bool {
        let (r, n, v) = (references.as_ptr(), references.len(), values.as_mut_ptr());
        // SAFETY: see above.
        is_ok(unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2GetReal(self.c, r, n, v) as u32,
                Standard::Fmi3 => {
                    // The states are one array there, and so are their rates.
                    let whole: Vec<u32> =
                        references.iter().copied().filter(|r| ![STATE[1], RATES[1]].contains(r)).collect();
                    fmi3GetFloat64(self.c, whole.as_ptr(), whole.len(), v, values.len()) as u32
                }
            }
        })
    }

    pub fn set(&self, references: &[u32], values: &[f64]) -> bool {
        let (r, n, v) = (references.as_ptr(), references.len(), values.as_ptr());
        // SAFETY: see above.
        is_ok(unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2SetReal(self.c, r, n, v) as u32,
                Standard::Fmi3 => {
                    let whole: Vec<u32> =
                        references.iter().copied().filter(|r| ![STATE[1], RATES[1]].contains(r)).collect();
                    fmi3SetFloat64(self.c, whole.as_ptr(), whole.len(), v, values.len()) as u32
                }
            }
        })
    }

    /// The change of scalar outputs for changes of 1 of scalar inputs; none: an error.
    pub fn directional(&self, unknowns: &[u32], knowns: &[u32]) -> Option<Vec<f64>> {
        let (u, n, k, m) = (unknowns.as_ptr(), unknowns.len(), knowns.as_ptr(), knowns.len());
        let (seeds, mut changes) = (vec![1.0; m], vec![f64::NAN; n]);
        let (s, to) = (seeds.as_ptr(), changes.as_mut_ptr());
        // SAFETY: see above.
        let status = unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2GetDirectionalDerivative(self.c, u, n, k, m, s, to) as u32,
                Standard::Fmi3 => fmi3GetDirectionalDerivative(self.c, u, n, k, m, s, m, to, n) as u32,
            }
        };
        is_ok(status).then_some(changes)
    }

    pub fn set_time(&self, time: f64) -> bool {
        // SAFETY: see above.
        is_ok(unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2SetTime(self.c, time) as u32,
                Standard::Fmi3 => fmi3SetTime(self.c, time) as u32,
            }
        })
    }

    pub fn set_states(&self, x: &[f64]) -> bool {
        // SAFETY: see above.
        is_ok(unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2SetContinuousStates(self.c, x.as_ptr(), x.len()) as u32,
                Standard::Fmi3 => fmi3SetContinuousStates(self.c, x.as_ptr(), x.len()) as u32,
            }
        })
    }

    pub fn states(&self) -> [f64; STATES] {
        let mut x = [f64::NAN; STATES];
        // SAFETY: see above.
        assert!(is_ok(unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2GetContinuousStates(self.c, x.as_mut_ptr(), STATES) as u32,
                Standard::Fmi3 => fmi3GetContinuousStates(self.c, x.as_mut_ptr(), STATES) as u32,
            }
        }));
        x
    }

    /// The derivatives of the states; none: an error.
    pub fn derivatives(&self) -> Option<[f64; STATES]> {
        let mut rates = [f64::NAN; STATES];
        // SAFETY: see above.
        let status = unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2GetDerivatives(self.c, rates.as_mut_ptr(), STATES) as u32,
                Standard::Fmi3 => fmi3GetContinuousStateDerivatives(self.c, rates.as_mut_ptr(), STATES) as u32,
            }
        };
        is_ok(status).then_some(rates)
    }

    pub fn nominals(&self) -> [f64; STATES] {
        let mut nominals = [f64::NAN; STATES];
        // SAFETY: see above.
        assert!(is_ok(unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2GetNominalsOfContinuousStates(self.c, nominals.as_mut_ptr(), STATES) as u32,
                Standard::Fmi3 => fmi3GetNominalsOfContinuousStates(self.c, nominals.as_mut_ptr(), STATES) as u32,
            }
        }));
        nominals
    }

    /// The bytes of its state.
    pub fn bytes(&self) -> Vec<u8> {
        let (mut state, mut size) = (null_mut(), 0);
        // SAFETY: see above.
        unsafe {
            match self.standard {
                Standard::Fmi2 => {
                    assert_eq!(fmi2GetFMUstate(self.c, &raw mut state), fmi2Status::fmi2OK);
                    fmi2SerializedFMUstateSize(self.c, state, &raw mut size);
                    let mut bytes = vec![0_u8; size];
                    fmi2SerializeFMUstate(self.c, state, bytes.as_mut_ptr().cast(), size);
                    fmi2FreeFMUstate(self.c, &raw mut state);
                    bytes
                }
                Standard::Fmi3 => {
                    assert_eq!(fmi3GetFMUState(self.c, &raw mut state), fmi3Status::fmi3OK);
                    fmi3SerializedFMUStateSize(self.c, state, &raw mut size);
                    let mut bytes = vec![0_u8; size];
                    fmi3SerializeFMUState(self.c, state, bytes.as_mut_ptr(), size);
                    fmi3FreeFMUState(self.c, &raw mut state);
                    bytes
                }
            }
        }
    }

    /// Goes to the state of some bytes; whether that is possible.
    pub fn go_to(&self, bytes: &[u8]) -> bool {
        let mut state = null_mut();
        // SAFETY: see above.
        unsafe {
            match self.standard {
                Standard::Fmi2 => {
                    let (from, size) = (bytes.as_ptr().cast(), bytes.len());
                    let done = is_ok(fmi2DeSerializeFMUstate(self.c, from, size, &raw mut state) as u32)
                        && is_ok(fmi2SetFMUstate(self.c, state) as u32);
                    fmi2FreeFMUstate(self.c, &raw mut state);
                    done
                }
                Standard::Fmi3 => {
                    let (from, size) = (bytes.as_ptr(), bytes.len());
                    let done = is_ok(fmi3DeserializeFMUState(self.c, from, size, &raw mut state) as u32)
                        && is_ok(fmi3SetFMUState(self.c, state) as u32);
                    fmi3FreeFMUState(self.c, &raw mut state);
                    done
                }
            }
        }
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        // SAFETY: the handle is live and not used again.
        unsafe {
            match self.standard {
                Standard::Fmi2 => fmi2FreeInstance(self.c),
                Standard::Fmi3 => fmi3FreeInstance(self.c),
            }
        }
    }
}
