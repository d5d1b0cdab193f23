//! What does the way through the C ABI cost? Each measure is the median of many rounds, printed beside its goal:
//!
//!     cargo bench --bench overhead
//!
//! Nothing is asserted: times belong to the machine.
#![allow(unsafe_code, reason = "the C ABI is what is measured")]
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]
#![allow(clippy::unwrap_used, reason = "a benchmark that cannot run has nothing to say")]

use ancf14::{
    ffi::{fmi2::*, fmi2_values::*, types::*},
    fmi::{Model, Value, variable::Causality},
    model::simulation::Simulation,
};
use std::{
    ffi::{CString, c_void},
    fs,
    hint::black_box,
    ptr::null_mut,
    time::Instant,
};

const ROUNDS: usize = 41;

/// A mechanism whose steps take so little time that what C adds to them can be seen.
const SLIDE: &str = r#"
format = 1
[model]
name = "Slide"
[body.block]
mass = 1.0
position = [0.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0]
velocity = [1.0, 0.0, 0.0]
[joint.rail]
type = "prismatic"
a = "ground"
b = "block"
axis = [1.0, 0.0, 0.0]
stiffness = 100.0
[simulation]
stop = 1e3
step = 1e-3
output_step = 1e-3
"#;

/// Median time of one call of `work`, s, of rounds of `repeats` calls each.
fn median(repeats: usize, mut work: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            (0..repeats).for_each(|_| work());
            start.elapsed().as_secs_f64() / repeats as f64
        })
        .collect();
    middle(&mut times)
}

fn middle(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// A model file in a directory of its own, and instances of it.
struct Place {
    directory: tempfile::TempDir,
    text: String,
    model: Simulation,
}

impl Place {
    /// A file of models/.
    fn new(file: &str) -> Self {
        Self::of_text(fs::read_to_string(ancf14_testing::root().join("models").join(file)).unwrap())
    }

    fn of_text(text: String) -> Self {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("model.toml"), &text).unwrap();
        let model = Simulation::load("model.toml", &text, &[]).unwrap();
        Self { directory, text, model }
    }

    fn instance(&self) -> Instance {
        let callbacks = fmi2CallbackFunctions {
            logger: None,
            allocateMemory: None,
            freeMemory: None,
            stepFinished: None,
            componentEnvironment: null_mut(),
        };
        let guid = CString::new(self.model.about().guid.as_str()).unwrap();
        let resources = CString::new(self.directory.path().to_str().unwrap()).unwrap();
        // SAFETY: everything lives during the call.
        let c = unsafe {
            fmi2Instantiate(c"bench".as_ptr(), 1, guid.as_ptr(), resources.as_ptr(), &raw const callbacks, 0, 0)
        };
        assert!(!c.is_null());
        // SAFETY: a live instance.
        unsafe {
            fine(fmi2EnterInitializationMode(c));
            fine(fmi2ExitInitializationMode(c));
        }
        Instance(c)
    }

    /// References of the Real variables of a causality.
    fn real(&self, causality: Causality) -> Vec<u32> {
        let variables = self.model.variables().iter().enumerate();
        let chosen = variables.filter(|(_, v)| v.causality == causality && matches!(v.start, Value::Real(_)));
        chosen.map(|(place, _)| place as u32).collect()
    }

    fn reference(&self, name: &str) -> u32 {
        self.model.variables().iter().position(|variable| variable.name == name).unwrap() as u32
    }
}

/// An initialized instance. It is live until it is dropped, which is what all calls below need; arrays have the lengths
/// given.
struct Instance(*mut c_void);

impl Instance {
    fn get(&self, references: &[u32], values: &mut [f64]) {
        // SAFETY: see above.
        fine(unsafe { fmi2GetReal(self.0, black_box(references.as_ptr()), references.len(), values.as_mut_ptr()) });
    }

    fn set(&self, references: &[u32], values: &[f64]) {
        // SAFETY: see above.
        fine(unsafe { fmi2SetReal(self.0, black_box(references.as_ptr()), references.len(), values.as_ptr()) });
    }

    fn step(&self, time: f64, step: f64) {
        // SAFETY: see above.
        fine(unsafe { fmi2DoStep(self.0, time, step, 0) });
    }

    fn save(&self, saved: &mut *mut c_void) {
        // SAFETY: see above; `saved` is NULL or a state of this library.
        fine(unsafe { fmi2GetFMUstate(self.0, saved) });
    }

    fn restore(&self, saved: *mut c_void) {
        // SAFETY: as before.
        fine(unsafe { fmi2SetFMUstate(self.0, saved) });
    }

    fn forget(&self, saved: &mut *mut c_void) {
        // SAFETY: as before.
        fine(unsafe { fmi2FreeFMUstate(self.0, saved) });
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: a live instance, not used again.
        unsafe { fmi2FreeInstance(self.0) };
    }
}

fn fine(status: fmi2Status) {
    assert!(matches!(status, fmi2Status::fmi2OK | fmi2Status::fmi2Warning), "{status:?}");
}

fn row(what: &str, measured: f64, goal: f64, unit: (&str, f64)) {
    let (label, scale) = unit;
    let goal = if goal.is_finite() { format!("{:>8.0} {label}", goal * scale) } else { String::from("          -") };
    println!("{what:<66} {:>10.2} {label} {goal}", measured * scale);
}

const MICRO: (&str, f64) = ("us", 1e6);
const NANO: (&str, f64) = ("ns", 1e9);

/// The same steps by the model and through C, in turns, so that both see the same machine: the median of the model's,
/// and that of the differences, s.
fn steps(place: &Place) -> (f64, f64) {
    let step = place.model.about().output_step;
    let mut model = Simulation::load("model.toml", &place.text, &[]).unwrap();
    model.initialize(0.0).unwrap();
    let instance = place.instance();
    let timed = |work: &mut dyn FnMut()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    };
    let (mut own, mut more) = (Vec::new(), Vec::new());
    for k in 0..20_000 {
        let (time, end) = (f64::from(k) * step, f64::from(k + 1) * step);
        let mut by_model = || model.advance(end).unwrap();
        let mut through_c = || instance.step(time, end - time);
        // Whoever comes second finds warm caches: they take turns.
        let (a, b) = if k % 2 == 0 {
            (timed(&mut by_model), timed(&mut through_c))
        } else {
            let b = timed(&mut through_c);
            (timed(&mut by_model), b)
        };
        own.push(a);
        more.push(b - a);
    }
    (middle(&mut own), middle(&mut more))
}

fn main() {
    println!("{:<66} {:>13} {:>11}", "", "median", "goal");
    let (own, more) = steps(&Place::of_text(SLIDE.to_owned()));
    row("a step of a block on a rail, by the model", own, f64::INFINITY, MICRO);
    row("fmi2DoStep of the same, beyond that", more, 1e-6, MICRO);

    let place = Place::new("crane.toml");
    let instance = place.instance();
    let outputs = place.real(Causality::Output);
    let mut values = vec![0.0; outputs.len()];
    let time = median(10_000, || instance.get(&outputs, &mut values));
    row(&format!("fmi2GetReal of {} outputs, a value", outputs.len()), time / outputs.len() as f64, 20e-9, NANO);
    let time = median(50_000, || instance.get(&outputs[..1], &mut values));
    row("fmi2GetReal of one output", time, 20e-9, NANO);
    let inputs = place.real(Causality::Input);
    let mut pose = vec![0.0; inputs.len()];
    instance.get(&inputs, &mut pose);
    let time = median(5_000, || instance.set(&inputs, &pose));
    row(
        &format!("fmi2SetReal of {} inputs of a frame, a value", inputs.len()),
        time / inputs.len() as f64,
        20e-9,
        NANO,
    );

    let place = Place::new("cantilever.toml");
    let instance = place.instance();
    let gravity = [1, 2, 3].map(|i| place.reference(&format!("gravity[{i}]")));
    let time = median(5_000, || instance.set(&gravity, &[0.0, 0.0, -9.81]));
    row("fmi2SetReal of 3 tunable parameters, a value", time / 3.0, 20e-9, NANO);

    let place = Place::new("rotating_shaft.toml");
    let instance = place.instance();
    instance.step(0.0, 1e-3);
    let mut saved = null_mut();
    let time = median(5_000, || {
        instance.save(&mut saved);
        instance.restore(saved);
    });
    row("fmi2GetFMUstate, over an earlier one, + fmi2SetFMUstate, shaft", time, 5e-6, MICRO);
    instance.forget(&mut saved);
    let time = median(5_000, || {
        instance.save(&mut saved);
        instance.restore(saved);
        instance.forget(&mut saved);
    });
    row("fmi2GetFMUstate + fmi2SetFMUstate + fmi2FreeFMUstate, shaft", time, 5e-6, MICRO);

    for file in ["pendulum.toml", "rotating_shaft.toml"] {
        let place = Place::new(file);
        let step = place.model.about().output_step;
        let time = median(3, || place.instance().step(0.0, step));
        row(&format!("{file}: from fmi2Instantiate to the end of the first step"), time, f64::INFINITY, MICRO);
    }
}
