//! Does the built library behave as fmi2Functions.h says, called as a host does: loaded at run time, by symbol name?
//! Wrong arguments must be errors with a log line, never a crash.
#![allow(unsafe_code, non_snake_case, reason = "tests of the C ABI")]

use std::{
    ffi::{CString, c_int, c_void},
    fs,
    ptr::{null, null_mut},
};

use ancf14::{ffi::types::*, fmi::Model, model::simulation::Simulation};
use libloading::Library;
use tempfile::TempDir;

use super::host::Lines;
use super::library_path;

/// The model of these tests.
pub const MODEL: &str = include_str!("model.toml");

type Call = unsafe extern "C" fn(*mut c_void) -> fmi2Status;
type GetReal = unsafe extern "C" fn(*mut c_void, *const u32, usize, *mut f64) -> fmi2Status;
type SetReal = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const f64) -> fmi2Status;
type DoStep = unsafe extern "C" fn(*mut c_void, f64, f64, c_int) -> fmi2Status;
type Instantiate = unsafe extern "C" fn(
    fmi2String,
    fmi2Type,
    fmi2String,
    fmi2String,
    *const fmi2CallbackFunctions,
    c_int,
    c_int,
) -> *mut c_void;

/// An unpacked unit, its loaded library, and a host's log.
struct Unit {
    library: Library,
    directory: TempDir,
    model: Simulation,
    lines: Box<Lines>,
}

impl Unit {
    fn new() -> Self {
        let directory = tempfile::Builder::new().prefix("100% unit #").tempdir().unwrap();
        fs::create_dir_all(directory.path().join("resources")).unwrap();
        fs::create_dir_all(directory.path().join("binaries/linux64")).unwrap();
        fs::write(directory.path().join("resources/model.toml"), MODEL).unwrap();
        let copy = directory.path().join("binaries/linux64/TipForce.so");
        fs::copy(library_path(), &copy).unwrap();
        // SAFETY: loading this library runs no code.
        let library = unsafe { Library::new(copy) }.unwrap();
        Self { library, directory, model: Simulation::load("model.toml", MODEL, &[]).unwrap(), lines: Box::default() }
    }

    /// A function of the library; the type is the one of fmi2Functions.h.
    fn function<T: Copy>(&self, name: &str) -> T {
        // SAFETY: the callers name the type that belongs to the name.
        *unsafe { self.library.get::<T>(name.as_bytes()) }.unwrap_or_else(|_| panic!("{name} is not exported"))
    }

    fn guid(&self) -> &str {
        &self.model.about().guid
    }

    fn resources(&self) -> String {
        self.directory.path().join("resources").display().to_string()
    }

    fn reference(&self, name: &str) -> u32 {
        let place = self.model.variables().iter().position(|variable| variable.name == name);
        u32::try_from(place.unwrap_or_else(|| panic!("no variable {name}"))).unwrap()
    }

    fn instantiate(
        &self,
        name: Option<&str>,
        kind: fmi2Type,
        guid: Option<&str>,
        location: Option<&str>,
    ) -> *mut c_void {
        let [name, guid, location] = [name, guid, location].map(|text| text.map(|text| CString::new(text).unwrap()));
        let pointer = |text: &Option<CString>| text.as_ref().map_or(null(), |text| text.as_ptr());
        let callbacks = self.lines.callbacks();
        let instantiate: Instantiate = self.function("fmi2Instantiate");
        // SAFETY: everything lives during the call; the library copies what it keeps, so the callbacks may go away.
        unsafe { instantiate(pointer(&name), kind, pointer(&guid), pointer(&location), &raw const callbacks, 0, 0) }
    }

    fn instance(&self) -> *mut c_void {
        let c = self.instantiate(Some("one"), fmi2CoSimulation, Some(self.guid()), Some(&self.resources()));
        assert!(!c.is_null(), "{:?}", self.lines.take());
        c
    }

    fn call(&self, name: &str, c: *mut c_void) -> fmi2Status {
        // SAFETY: `name` is a function of an instance alone, `c` an instance or NULL.
        unsafe { self.function::<Call>(name)(c) }
    }

    fn initialize(&self, c: *mut c_void) {
        assert_eq!(self.call("fmi2EnterInitializationMode", c), fmi2Status::fmi2OK);
        assert_eq!(self.call("fmi2ExitInitializationMode", c), fmi2Status::fmi2OK, "{:?}", self.lines.take());
    }

    fn real(&self, c: *mut c_void, name: &str) -> f64 {
        let (reference, mut value) = (self.reference(name), f64::NAN);
        // SAFETY: one reference, one value.
        let status = unsafe { self.function::<GetReal>("fmi2GetReal")(c, &raw const reference, 1, &raw mut value) };
        assert_eq!(status, fmi2Status::fmi2OK, "{:?}", self.lines.take());
        value
    }

    fn set(&self, c: *mut c_void, name: &str, value: f64) -> fmi2Status {
        let reference = self.reference(name);
        // SAFETY: one reference, one value.
        unsafe { self.function::<SetReal>("fmi2SetReal")(c, &raw const reference, 1, &raw const value) }
    }

    fn step(&self, c: *mut c_void, time: f64, step: f64) -> fmi2Status {
        // SAFETY: `c` is an instance.
        unsafe { self.function::<DoStep>("fmi2DoStep")(c, time, step, 1) }
    }

    fn free(&self, c: *mut c_void) {
        // SAFETY: `c` is an instance or NULL and not used again.
        unsafe { self.function::<unsafe extern "C" fn(*mut c_void)>("fmi2FreeInstance")(c) }
    }
}

/// FMPy resolves all of them at load; a missing one makes the unit unusable.
#[test]
fn all_functions_are_exported() {
    let unit = Unit::new();
    for name in "GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment \
        EnterInitializationMode ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean GetString SetReal \
        SetInteger SetBoolean SetString GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate \
        DeSerializeFMUstate GetDirectionalDerivative SetRealInputDerivatives GetRealOutputDerivatives DoStep CancelStep \
        GetStatus GetRealStatus GetIntegerStatus GetBooleanStatus GetStringStatus EnterEventMode NewDiscreteStates \
        EnterContinuousTimeMode CompletedIntegratorStep SetTime SetContinuousStates GetDerivatives GetEventIndicators \
        GetContinuousStates GetNominalsOfContinuousStates"
        .split_whitespace()
    {
        unit.function::<Call>(&format!("fmi2{name}"));
    }
}

/// The words that hosts compare.
#[test]
fn versions() {
    let unit = Unit::new();
    for (name, word) in [("fmi2GetTypesPlatform", c"default"), ("fmi2GetVersion", c"2.0")] {
        // SAFETY: both take nothing and give a constant text.
        let text = unsafe { std::ffi::CStr::from_ptr(unit.function::<unsafe extern "C" fn() -> fmi2String>(name)()) };
        assert_eq!(text, word);
    }
}

/// A whole simulation, and the same again after a reset, and in a second instance beside the first: the same bits.
#[test]
fn a_simulation_repeats() {
    let unit = Unit::new();
    let (one, two) = (unit.instance(), unit.instance());
    let run = |c| {
        assert_eq!(unit.set(c, "tip.force[3]", 1.0), fmi2Status::fmi2OK);
        unit.initialize(c);
        let mut values = Vec::new();
        for k in 0..5 {
            assert_eq!(unit.step(c, 0.01 * f64::from(k), 0.01), fmi2Status::fmi2OK, "{:?}", unit.lines.take());
            values.push(unit.real(c, "P.position[3]"));
        }
        values
    };
    let first = run(one);
    assert!(first[4] != first[0] && first.iter().all(|value| value.is_finite()), "{first:?}");
    assert_eq!(run(two), first);
    assert_eq!(unit.call("fmi2Reset", one), fmi2Status::fmi2OK);
    assert_eq!(run(one), first);
    assert_eq!(unit.call("fmi2Terminate", one), fmi2Status::fmi2OK);
    unit.free(one);
    unit.free(two);
}

/// Each wrong argument of `fmi2Instantiate` gives NULL and one line that names it.
#[test]
fn instantiation_is_refused_with_a_reason() {
    let unit = Unit::new();
    let (guid, place) = (unit.guid().to_owned(), unit.resources());
    let (good, here) = (Some(guid.as_str()), Some(place.as_str()));
    let nowhere = unit.directory.path().join("missing");
    let nowhere = Some(nowhere.to_str().unwrap());
    for (name, kind, guid, location, reason) in [
        (None, 1, good, here, "instance name is NULL or blank"),
        (Some(" \t"), 1, good, here, "instance name is NULL or blank"),
        (Some("one"), 0, good, here, "co-simulation only"),
        (Some("one"), 7, good, here, "fmuType is neither fmi2ModelExchange nor fmi2CoSimulation"),
        (Some("one"), 1, None, here, "`fmuGUID` is NULL"),
        (Some("one"), 1, Some("{wrong}"), here, "the GUID `{wrong}` is not that of the model file"),
        (Some("one"), 1, good, nowhere, "missing/model.toml: No such file"),
        (Some("one"), 1, good, Some("http://x/y"), "only `file:` is possible"),
    ] {
        assert!(unit.instantiate(name, kind, guid, location).is_null(), "{reason}");
        let lines = unit.lines.take();
        assert!(lines.len() == 1 && lines[0].contains(reason), "{reason}: {lines:?}");
        assert!(lines[0].contains("fmi2Error logStatusError fmi2Instantiate: "), "{lines:?}");
    }
    let instantiate: Instantiate = unit.function("fmi2Instantiate");
    // SAFETY: NULL is the question.
    let c = unsafe { instantiate(c"one".as_ptr(), 1, c"g".as_ptr(), null(), null(), 0, 0) };
    assert!(c.is_null());
}

/// A broken model file is refused with its own message.
#[test]
fn broken_model_files_are_refused() {
    let unit = Unit::new();
    for text in ["format = 1\n[model\n", "", "\u{0}"] {
        fs::write(unit.directory.path().join("resources/model.toml"), text).unwrap();
        let c = unit.instantiate(Some("one"), fmi2CoSimulation, Some(unit.guid()), Some(&unit.resources()));
        assert!(c.is_null(), "{text:?}");
        let lines = unit.lines.take();
        assert!(lines.len() == 1 && lines[0].contains("model.toml"), "{lines:?}");
    }
}

/// No location, an encoded URI, a bare path: the same model. The `%` and `#` of the path reach no printf undoubled.
#[test]
fn resources_are_found() {
    let unit = Unit::new();
    let uri = format!("file://{}", unit.resources().replace('%', "%25").replace(' ', "%20").replace('#', "%23"));
    for location in [None, Some(""), Some(uri.as_str()), Some(unit.resources().as_str())] {
        let c = unit.instantiate(Some("one"), fmi2CoSimulation, Some(unit.guid()), location);
        assert!(!c.is_null(), "{location:?}: {:?}", unit.lines.take());
        unit.free(c);
    }
    assert!(unit.instantiate(Some("one"), fmi2CoSimulation, Some("x"), Some(&unit.resources())).is_null());
    let line = unit.lines.take().remove(0);
    assert!(line.contains("100%% unit ##"), "{line}");
}

/// NULL arrays are errors where they have elements, and fine where they have none; NULL places are errors.
#[test]
fn null_arrays_and_places() {
    let unit = Unit::new();
    let c = unit.instance();
    unit.initialize(c);
    let (get, set): (GetReal, SetReal) = (unit.function("fmi2GetReal"), unit.function("fmi2SetReal"));
    let (reference, mut value) = (unit.reference("P.position[3]"), 0.0);
    // SAFETY: NULL is the question; what is not NULL has one element.
    unsafe {
        assert_eq!(get(c, null(), 0, null_mut()), fmi2Status::fmi2OK);
        assert_eq!(get(c, null(), 1, &raw mut value), fmi2Status::fmi2Error);
        assert_eq!(get(c, &raw const reference, 1, null_mut()), fmi2Status::fmi2Error);
        assert_eq!(get(c, &raw const reference, usize::MAX, &raw mut value), fmi2Status::fmi2Error);
        assert_eq!(set(c, null(), 1, &raw const value), fmi2Status::fmi2Error);
        assert_eq!(set(c, null(), 0, null()), fmi2Status::fmi2OK);
        assert_eq!(get(null_mut(), &raw const reference, 1, &raw mut value), fmi2Status::fmi2Error);
        type Logging = unsafe extern "C" fn(*mut c_void, c_int, usize, *const fmi2String) -> fmi2Status;
        let logging: Logging = unit.function("fmi2SetDebugLogging");
        assert_eq!(logging(c, 1, 1, null()), fmi2Status::fmi2Error);
        assert_eq!(logging(c, 1, 1, [null()].as_ptr()), fmi2Status::fmi2Error);
        assert_eq!(logging(c, 1, 1, [c"\xff".as_ptr()].as_ptr()), fmi2Status::fmi2Error);
        assert_eq!(logging(c, 1, 1, [c"logEvents".as_ptr()].as_ptr()), fmi2Status::fmi2OK);
        type Status<T> = unsafe extern "C" fn(*mut c_void, c_int, *mut T) -> fmi2Status;
        let real: Status<f64> = unit.function("fmi2GetRealStatus");
        assert_eq!(real(c, fmi2LastSuccessfulTime, null_mut()), fmi2Status::fmi2Error);
        assert_eq!(real(c, 99, &raw mut value), fmi2Status::fmi2Discard);
        assert_eq!(real(c, fmi2LastSuccessfulTime, &raw mut value), fmi2Status::fmi2OK);
        type States = unsafe extern "C" fn(*mut c_void, *mut *mut c_void) -> fmi2Status;
        assert_eq!(unit.function::<States>("fmi2GetFMUstate")(c, null_mut()), fmi2Status::fmi2Error);
        assert_eq!(unit.function::<States>("fmi2FreeFMUstate")(c, null_mut()), fmi2Status::fmi2OK);
    }
    unit.free(c);
    unit.free(null_mut());
}

/// Reading and setting through C arrives at the variable named in the description.
#[test]
fn values_go_where_the_description_says() {
    let unit = Unit::new();
    let c = unit.instance();
    assert_eq!(unit.set(c, "young", 1e11), fmi2Status::fmi2OK);
    assert_eq!(unit.set(c, "half_young", 1e11), fmi2Status::fmi2Error);
    assert_eq!(unit.set(c, "P.position[3]", 1.0), fmi2Status::fmi2Error);
    unit.initialize(c);
    assert_eq!((unit.real(c, "young"), unit.real(c, "half_young")), (1e11, 5e10));
    assert_eq!(unit.set(c, "young", 2e11), fmi2Status::fmi2Error);
    assert_eq!(unit.set(c, "tip.force[3]", f64::NAN), fmi2Status::fmi2Error);
    assert_eq!(unit.set(c, "tip.force[3]", 5.0), fmi2Status::fmi2OK);
    assert_eq!(unit.real(c, "tip.force[3]"), 5.0);
    unit.free(c);
}

/// What the description does not promise answers with an error that says so.
#[test]
fn what_is_not_offered_says_so() {
    let unit = Unit::new();
    let c = unit.instance();
    unit.initialize(c);
    assert_eq!(unit.call("fmi2CancelStep", c), fmi2Status::fmi2Error);
    unit.free(c);
}

/// A library that leaves a thread key or itself behind at every load kills its host after about 1,020 simulations: here
/// 1,100 times load, instantiate, step, free, unload in one process.
#[test]
fn loading_leaves_nothing_behind() {
    let unit = Unit::new();
    let path = unit.directory.path().join("binaries/linux64/again.so");
    fs::copy(library_path(), &path).unwrap();
    let mut unit = unit;
    for _ in 0..1100 {
        // SAFETY: loading this library runs no code.
        unit.library = unsafe { Library::new(&path) }.unwrap();
        let c = unit.instance();
        unit.initialize(c);
        assert_eq!(unit.step(c, 0.0, 1e-3), fmi2Status::fmi2OK);
        unit.free(c);
        // SAFETY: as above; the other one is unloaded by this.
        unit.library = unsafe { Library::new(library_path()) }.unwrap();
        let maps = fs::read_to_string("/proc/self/maps").unwrap();
        assert!(!maps.contains("again.so"), "the library stays in memory");
    }
}
