//! A host of FMI 3.0: the exported functions, called in this process as C calls them, on a model file in a directory of
//! its own. It collects log lines and hears of internal steps.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::{
    cell::{Cell, RefCell},
    ffi::{CStr, CString, c_void},
    fs,
    ptr::{null, null_mut},
};

use ancf14::{
    ffi::{fmi3::*, fmi3_types::*, fmi3_values::*},
    fmi::{Model, Value, arrays::arrays, variable::Causality},
    model::simulation::Simulation,
};
use tempfile::TempDir;

pub const OK: fmi3Status = fmi3Status::fmi3OK;
pub const ERROR: fmi3Status = fmi3Status::fmi3Error;

/// An arm that a host holds at one end and pushes at the other.
pub const HELD: &str = include_str!("held.toml");

/// What a callback was told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    pub time: f64,
    pub set_requested: bool,
    pub get_allowed: bool,
    pub finished: bool,
    pub can_return: bool,
}

/// What the host does at an update: true asks for an early return.
pub type OnUpdate<'a> = Box<dyn FnMut(&Unit<'_>, Told) -> bool + 'a>;

/// A model file in a folder.
pub struct Place {
    directory: TempDir,
    pub model: Simulation,
}

/// What the callbacks see.
#[derive(Default)]
struct Environment {
    lines: RefCell<Vec<String>>,
    told: RefCell<Vec<Told>>,
    handle: Cell<*mut c_void>,
    /// What the running call of `fmi3DoStep` has given for updates, and its place.
    update: RefCell<Option<(*const Place, OnUpdate<'static>)>>,
}

/// An instance.
pub struct Unit<'a> {
    pub c: fmi3Instance,
    pub place: &'a Place,
    environment: *const Environment,
    owns: bool,
}

/// How an instance is made.
#[derive(Clone, Copy, Debug)]
pub struct Wishes {
    pub updates: bool,
    pub early_return: bool,
    pub logging: bool,
}

/// What `fmi3DoStep` answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    pub status: fmi3Status,
    pub event: bool,
    pub end: bool,
    pub early: bool,
    pub time: f64,
}

unsafe extern "C" fn log(environment: *mut c_void, status: fmi3Status, category: fmi3String, message: fmi3String) {
    // SAFETY: the environment lives as long as the instance, and the library passes texts that end with a zero byte.
    let (environment, [category, message]) = unsafe {
        let texts = [category, message].map(|text| CStr::from_ptr(text).to_str().unwrap());
        (&*environment.cast::<Environment>(), texts)
    };
    environment.lines.borrow_mut().push(format!("{status:?} {category} {message}"));
}

#[allow(clippy::too_many_arguments, reason = "the standard's signature")]
unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    set_requested: u8,
    get_allowed: u8,
    finished: u8,
    can_return: u8,
    requested: *mut u8,
    return_time: *mut f64,
) {
    // SAFETY: as above.
    let own = unsafe { &*environment.cast::<Environment>() };
    let told = Told {
        time,
        set_requested: set_requested != 0,
        get_allowed: get_allowed != 0,
        finished: finished != 0,
        can_return: can_return != 0,
    };
    own.told.borrow_mut().push(told);
    let Some((place, mut react)) = own.update.borrow_mut().take() else { return };
    // SAFETY: the place outlives the call of `fmi3DoStep` that has put it there.
    let unit = Unit { c: own.handle.get(), place: unsafe { &*place }, environment: own, owns: false };
    if react(&unit, told) {
        // SAFETY: both answers can be written to.
        unsafe { (*requested, *return_time) = (1, time) };
    }
    *own.update.borrow_mut() = Some((place, react));
}

impl Place {
    pub fn new(text: &str) -> Self {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("model.toml"), text).unwrap();
        let model = Simulation::load("model.toml", text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
        Self { directory, model }
    }

    /// The value reference of a variable, an array by its name without the index.
    pub fn reference(&self, name: &str) -> u32 {
        let list = arrays(self.model.variables());
        let found = list.iter().find(|array| array.name == name);
        u32::try_from(found.unwrap_or_else(|| panic!("no variable {name}")).first).unwrap()
    }

    /// References of Float64 variables of a causality, and the number of their elements.
    pub fn of(&self, wanted: Causality) -> (Vec<u32>, usize) {
        let variables = self.model.variables();
        let list = arrays(variables);
        let fitting = list.iter().filter(|array| {
            let first = &variables[array.first];
            first.causality == wanted && matches!(first.start, Value::Real(_))
        });
        let count = fitting.clone().map(|array| array.elements()).sum();
        (fitting.map(|array| u32::try_from(array.first).unwrap()).collect(), count)
    }

    pub fn token(&self) -> CString {
        CString::new(self.model.about().guid.as_str()).unwrap()
    }

    /// The folder as a host passes it: with the separator at its end.
    pub fn resources(&self) -> CString {
        CString::new(format!("{}/", self.directory.path().to_str().unwrap())).unwrap()
    }
}

// SAFETY of all calls below: `self.c` is a live instance of this process, used on one thread; arrays have the lengths
// that are passed.
impl<'a> Unit<'a> {
    pub fn new(place: &'a Place) -> Self {
        Self::with(place, Wishes { updates: false, early_return: false, logging: true })
    }

    pub fn with(place: &'a Place, wishes: Wishes) -> Self {
        let environment = Box::into_raw(Box::<Environment>::default());
        let (token, resources) = (place.token(), place.resources());
        let updates: fmi3IntermediateUpdateCallback = if wishes.updates { Some(update) } else { None };
        // SAFETY: everything lives during the call; the environment outlives the instance.
        let c = unsafe {
            fmi3InstantiateCoSimulation(
                c"unit".as_ptr(),
                token.as_ptr(),
                resources.as_ptr(),
                0,
                wishes.logging.into(),
                0,
                wishes.early_return.into(),
                null(),
                0,
                environment.cast(),
                Some(log),
                updates,
            )
        };
        // The library silences panics, which are those of the tests in this process: the standard hook again.
        drop(std::panic::take_hook());
        let unit = Self { c, place, environment, owns: true };
        assert!(!c.is_null(), "{:?}", unit.lines());
        unit.environment().handle.set(c);
        unit
    }

    fn environment(&self) -> &Environment {
        // SAFETY: it lives as long as the unit.
        unsafe { &*self.environment }
    }

    /// Log lines since the last call.
    pub fn lines(&self) -> Vec<String> {
        self.environment().lines.take()
    }

    /// Updates since the last call.
    pub fn told(&self) -> Vec<Told> {
        self.environment().told.take()
    }

    pub fn initialize(&self) {
        // SAFETY: see above.
        unsafe {
            assert_eq!(fmi3EnterInitializationMode(self.c, 0, 0.0, 0.0, 0, 0.0), OK, "{:?}", self.lines());
            assert_eq!(fmi3ExitInitializationMode(self.c), OK, "{:?}", self.lines());
        }
    }

    pub fn get(&self, references: &[u32], values: &mut [f64]) -> fmi3Status {
        let counts = (references.len(), values.len());
        // SAFETY: see above.
        unsafe { fmi3GetFloat64(self.c, references.as_ptr(), counts.0, values.as_mut_ptr(), counts.1) }
    }

    pub fn set(&self, references: &[u32], values: &[f64]) -> fmi3Status {
        // SAFETY: see above.
        unsafe { fmi3SetFloat64(self.c, references.as_ptr(), references.len(), values.as_ptr(), values.len()) }
    }

    /// The elements of a variable.
    pub fn value<const N: usize>(&self, name: &str) -> [f64; N] {
        let mut values = [f64::NAN; N];
        assert_eq!(self.get(&[self.place.reference(name)], &mut values), OK, "{:?}", self.lines());
        values
    }

    /// A step without updates, or with those that nobody reacts to.
    pub fn step(&self, time: f64, step: f64) -> Answer {
        let (mut flags, mut reached) = ([7_u8; 3], f64::NAN);
        let [event, end, early] = &mut flags;
        // SAFETY: see above; the answers can be written to.
        let status = unsafe { fmi3DoStep(self.c, time, step, 0, event, end, early, &raw mut reached) };
        let [event, end, early] = flags.map(|flag| flag != 0);
        Answer { status, event, end, early, time: reached }
    }

    /// A step whose updates the host reacts to.
    pub fn step_with<'b>(&self, time: f64, step: f64, react: impl FnMut(&Unit<'_>, Told) -> bool + 'b) -> Answer {
        let react: OnUpdate<'b> = Box::new(react);
        // SAFETY: it is taken away again before what it borrows can go.
        let react = unsafe { std::mem::transmute::<OnUpdate<'b>, OnUpdate<'static>>(react) };
        *self.environment().update.borrow_mut() = Some((self.place, react));
        let answer = self.step(time, step);
        drop(self.environment().update.take());
        answer
    }

    /// A step that is fine and goes all the way.
    pub fn whole_step(&self, time: f64, step: f64) {
        let answer = self.step(time, step);
        assert_eq!(
            (answer.status, answer.event, answer.end, answer.early),
            (OK, false, false, false),
            "{:?}",
            self.lines()
        );
    }

    /// Bits of all Float64 outputs.
    pub fn bits(&self) -> Vec<u64> {
        let (references, count) = self.place.of(Causality::Output);
        let mut values = vec![f64::NAN; count];
        assert_eq!(self.get(&references, &mut values), OK, "{:?}", self.lines());
        values.into_iter().map(f64::to_bits).collect()
    }

    pub fn save(&self) -> fmi3FMUState {
        let mut state = null_mut();
        // SAFETY: see above.
        assert_eq!(unsafe { fmi3GetFMUState(self.c, &raw mut state) }, OK, "{:?}", self.lines());
        state
    }

    pub fn restore(&self, state: fmi3FMUState) {
        // SAFETY: see above.
        assert_eq!(unsafe { fmi3SetFMUState(self.c, state) }, OK, "{:?}", self.lines());
    }

    pub fn forget(&self, mut state: fmi3FMUState) {
        // SAFETY: see above.
        assert_eq!(unsafe { fmi3FreeFMUState(self.c, &raw mut state) }, OK, "{:?}", self.lines());
        assert!(state.is_null());
    }

    pub fn serialize(&self, state: fmi3FMUState) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: see above.
        unsafe {
            assert_eq!(fmi3SerializedFMUStateSize(self.c, state, &raw mut size), OK, "{:?}", self.lines());
            let mut bytes = vec![0; size];
            assert_eq!(fmi3SerializeFMUState(self.c, state, bytes.as_mut_ptr(), size), OK, "{:?}", self.lines());
            bytes
        }
    }

    pub fn deserialize(&self, bytes: &[u8]) -> fmi3FMUState {
        let mut state = null_mut();
        // SAFETY: see above.
        let status = unsafe { fmi3DeserializeFMUState(self.c, bytes.as_ptr(), bytes.len(), &raw mut state) };
        assert_eq!(status, OK, "{:?}", self.lines());
        state
    }

    /// The directional derivative of all outputs, `J seeds`.
    pub fn directional(&self, knowns: &[u32], seeds: &[f64]) -> Vec<f64> {
        let (unknowns, count) = self.place.of(Causality::Output);
        let mut changes = vec![f64::NAN; count];
        let (known, seed, change) = (knowns.as_ptr(), seeds.as_ptr(), changes.as_mut_ptr());
        // SAFETY: see above.
        let status = unsafe {
            fmi3GetDirectionalDerivative(
                self.c,
                unknowns.as_ptr(),
                unknowns.len(),
                known,
                knowns.len(),
                seed,
                seeds.len(),
                change,
                count,
            )
        };
        assert_eq!(status, OK, "{:?}", self.lines());
        changes
    }
}

impl Drop for Unit<'_> {
    fn drop(&mut self) {
        if self.owns {
            // SAFETY: the instance is not used again; the environment was made by `with`.
            unsafe {
                fmi3FreeInstance(self.c);
                drop(Box::from_raw(self.environment.cast_mut()));
            }
        }
    }
}
