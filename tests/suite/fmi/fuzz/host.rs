//! A host that calls anything, knows what the unit must answer, and looks whether it does.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use ancf14::ffi::{fmi2::*, fmi2_values::*, types::*};
use ancf14::fmi::lifecycle::{Call, Mode, TABLE};
use ancf14::fmi::variable::{Causality, Variable};
use ancf14::fmi::{Model, Value};
use std::ptr::null_mut;

use super::calls::Answer;
use crate::fmi::unit::{Place, Saved, Unit, is_fine};
use crate::fuzz::requirements::is_readable;
use crate::random::Random;

/// States that a host keeps.
pub const SLOTS: usize = 3;

/// A host, what it holds, and what it knows of its unit.
pub struct Host<'a> {
    pub unit: Unit<'a>,
    pub place: &'a Place,
    pub random: Random,
    pub mode: Mode,
    /// States that live, with the mode that they go back to.
    pub slots: [(Saved, Mode); SLOTS],
    /// Handles that were given back.
    pub dead: Vec<Saved>,
}

impl<'a> Host<'a> {
    pub fn new(place: &'a Place, random: Random) -> Self {
        let slots = [(null_mut(), Mode::Instantiated); SLOTS];
        Self { unit: Unit::new(place), place, random, mode: Mode::Instantiated, slots, dead: Vec::new() }
    }

    /// A call that leads on, or any other.
    fn call(&mut self) -> Call {
        let onwards = match self.mode {
            Mode::Instantiated => Call::EnterInitializationMode,
            Mode::Initialization => Call::ExitInitializationMode,
            Mode::Step => Call::DoStep,
            _ => Call::Reset,
        };
        match self.random.below(10) {
            0..3 => onwards,
            3..5 => Call::SetReal,
            _ => TABLE[self.random.below(TABLE.len())].0,
        }
    }

    /// References of the model's Real variables, of one causality or of all; now and then of none.
    pub fn references(&mut self, wanted: Option<Causality>) -> Vec<u32> {
        let variables = self.place.model.variables();
        let fits = |number: &usize| {
            let is_real = matches!(variables[*number].start, Value::Real(_));
            is_real && wanted.is_none_or(|wanted| variables[*number].causality == wanted)
        };
        let fitting: Vec<usize> = (0..variables.len()).filter(fits).collect();
        let mut one = || match self.random.below(40) {
            0 => variables.len() as u32,
            1 => u32::MAX,
            2 => self.random.below(variables.len()) as u32,
            _ if fitting.is_empty() => 0,
            _ => fitting[self.random.below(fitting.len())] as u32,
        };
        let first = one();
        let count = self.random.below(4);
        let mut list = vec![first];
        list.extend((1..count).map(|_| {
            let any = fitting.get(self.random.below(fitting.len().max(1)));
            any.map_or(0, |number| *number as u32)
        }));
        list.truncate(count);
        list
    }

    /// A number near another, or one that hardly anybody means.
    pub fn number(&mut self, near: f64) -> f64 {
        const ODD: [f64; 14] = [
            0.0,
            -0.0,
            1.0,
            -1.0,
            5e-324,
            1e-300,
            1e-9,
            1e9,
            1e300,
            f64::MAX,
            f64::MIN,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
        ];
        match self.random.below(10) {
            0..7 => near * (1.0 + 0.1 * self.random.signed()) + 1e-3 * self.random.signed(),
            7 => near * 10_f64.powi(self.random.below(13) as i32 - 6),
            8 => near,
            _ => ODD[self.random.below(ODD.len())],
        }
    }

    /// Values for references: near those that are there.
    pub fn values(&mut self, references: &[u32]) -> Vec<f64> {
        let variables = self.place.model.variables();
        let can_be_set = |row: &Variable| matches!(row.causality, Causality::Input | Causality::Parameter);
        let near = |host: &Self, reference: u32| {
            let mut value = 0.0;
            if variables.get(reference as usize).is_some_and(can_be_set) {
                // SAFETY: the unit is live and there is room for one value. Whatever the answer is, there is a number.
                unsafe { fmi2GetReal(host.unit.c, &raw const reference, 1, &raw mut value) };
            }
            value
        };
        references
            .iter()
            .map(|&reference| {
                let near = near(self, reference);
                self.number(near)
            })
            .collect()
    }

    /// The bytes of all that the unit is.
    fn bytes(&self) -> Vec<u8> {
        let mut saved = null_mut();
        assert_eq!(self.unit.save(&mut saved), fmi2Status::fmi2OK);
        let bytes = self.unit.serialize(saved);
        assert_eq!(self.unit.forget(&mut saved), fmi2Status::fmi2OK);
        bytes
    }

    /// A handle of a state, and where it is kept: one that lives, NULL, one that was given back, or no handle at all.
    pub fn handle(&mut self) -> (Saved, Option<usize>) {
        let slot = self.random.below(SLOTS);
        match self.random.below(8) {
            0 => (self.unit.c, None),
            1 if !self.dead.is_empty() => {
                let dead = self.dead[self.random.below(self.dead.len())];
                // The allocator may have handed out the address again.
                (dead, self.slots.iter().position(|(saved, _)| *saved == dead))
            }
            _ => (self.slots[slot].0, Some(slot)),
        }
    }

    /// A communication step: of internal steps, of parts of them, of round-off, or none.
    pub fn step(&mut self) -> (f64, f64) {
        let mut internal = [f64::NAN];
        assert!(is_fine(self.unit.get_real(&[self.place.reference("simulation.step")], &mut internal)));
        let [internal] = internal;
        let mut time = 0.0;
        // SAFETY: the unit is live and there is room for one value; before the first step there is no time.
        unsafe { fmi2GetRealStatus(self.unit.c, fmi2LastSuccessfulTime, &raw mut time) };
        let step = match self.random.below(16) {
            0..7 => internal,
            7..9 => 2.0 * internal,
            9 => 0.3 * internal,
            10 => 1e-7 * internal,
            11 => 4.0 * f64::EPSILON * time,
            12 => 1e-12,
            13 => 1e12 * internal,
            _ => [0.0, -internal, f64::NAN, f64::INFINITY, 5e-324][self.random.below(5)],
        };
        let begin = match self.random.below(16) {
            0 => self.number(time),
            1 => time.next_up(),
            _ => time,
        };
        // Many internal steps: more than are taken in one call, or this test would take days.
        let count = step / internal;
        (begin, if count > 10.0 && count < 1e9 { internal } else { step })
    }

    /// Numbers that a call has handed out are finite; one that failed has left them alone.
    pub fn are_sound(&self, call: Call, status: fmi2Status, values: &[f64]) {
        let is_sound = |value: &f64| if is_fine(status) { value.is_finite() } else { *value == 7.5 };
        assert!(values.iter().all(is_sound), "{call} {}: {status:?} with {values:?}", self.mode);
    }

    /// Makes a call and looks whether the answer is what the table and the arguments say.
    pub fn play(&mut self) {
        let call = self.call();
        let mode = self.mode;
        let before = self.bytes();
        self.unit.lines.take();
        let Answer { status, is_wrong } = self.make(call);
        let lines = self.unit.lines.take();
        let said = format!("{call} {mode}: {status:?} {lines:?}");
        lines.iter().for_each(|line| is_readable(line).unwrap_or_else(|problem| panic!("{said}: {problem}")));
        assert!(!matches!(status, fmi2Status::fmi2Fatal | fmi2Status::fmi2Pending), "{said}");
        let is_forbidden = call != Call::FreeInstance && TABLE[call as usize].1.as_bytes()[mode as usize] == b'.';
        if is_forbidden {
            assert_eq!(status, fmi2Status::fmi2Error, "{said}");
        }
        assert!(!is_wrong || !is_fine(status), "{said}");
        if is_fine(status) {
            self.follow(call);
            return;
        }
        assert!(!lines.is_empty(), "{said}: no word of why");
        let finds_start = mode == Mode::Initialization && !is_forbidden;
        if self.bytes() == before || finds_start {
            return;
        }
        // A step that the model itself could not do.
        let has_failed = call == Call::DoStep && self.unit.set_real(&[], &[]) == fmi2Status::fmi2Error;
        assert!(has_failed, "{said}: the unit has changed");
        self.mode = Mode::Error;
    }

    /// Where a call leads that succeeded.
    fn follow(&mut self, call: Call) {
        match call {
            Call::EnterInitializationMode => self.mode = Mode::Initialization,
            Call::ExitInitializationMode => self.mode = Mode::Step,
            Call::Terminate => self.mode = Mode::Terminated,
            Call::Reset => self.mode = Mode::Instantiated,
            _ => (),
        }
    }

    /// Some steps under inputs and derivatives of theirs; statuses and bits of all that can be asked after each.
    fn steps(unit: &Unit, place: &Place, seed: u64) -> Vec<u64> {
        let mut random = Random(seed);
        let all = place.model.variables().iter().enumerate();
        let inputs: Vec<u32> =
            all.filter(|(_, row)| row.causality == Causality::Input).map(|(number, _)| number as u32).collect();
        let outputs = place.outputs();
        let mut found = Vec::new();
        let mut internal = [f64::NAN];
        unit.get_real(&[place.reference("simulation.step")], &mut internal);
        for _ in 0..3 {
            if let Some(&input) = inputs.get(random.below(inputs.len().max(1))) {
                found.push(unit.set_real(&[input], &[1e-3 * random.signed()]) as u64);
                found.push(unit.set_slope(input, 1, random.signed()) as u64);
            }
            let step = internal[0] * [1.0, 0.4, 2.0, 1e-8][random.below(4)];
            found.push(unit.do_step(unit.time(), step) as u64);
            found.extend(unit.bits());
            let (order, seed, mut numbers) = ([1], [1.0], [7.5; 2]);
            let output = outputs[random.below(outputs.len())];
            let input = *inputs.first().unwrap_or(&0);
            // SAFETY: the unit is live, and every array has one element.
            unsafe {
                let [rate, change] = &mut numbers;
                found.push(fmi2GetRealOutputDerivatives(unit.c, &raw const output, 1, order.as_ptr(), rate) as u64);
                let [output, input] = [&raw const output, &raw const input];
                found.push(fmi2GetDirectionalDerivative(unit.c, output, 1, input, 1, seed.as_ptr(), change) as u64);
            }
            found.extend(numbers.map(f64::to_bits));
        }
        found
    }

    /// The same steps from the same state: on, back and on, and in another instance from bytes.
    pub fn repeat(&mut self) {
        let seed = self.random.below(1 << 30) as u64;
        let (mut saved, mut shipped) = (null_mut(), null_mut());
        assert!(is_fine(self.unit.save(&mut saved)));
        let bytes = self.unit.serialize(saved);
        let expected = Self::steps(&self.unit, self.place, seed);
        assert!(is_fine(self.unit.restore(saved)));
        assert!(Self::steps(&self.unit, self.place, seed) == expected, "other bits after the way back");
        let other = Unit::new(self.place);
        assert!(is_fine(other.deserialize(&bytes, &mut shipped)), "{:?}", other.lines.take());
        assert!(is_fine(other.restore(shipped)));
        assert!(Self::steps(&other, self.place, seed) == expected, "other bits in another instance");
        assert!(is_fine(self.unit.restore(saved)));
        assert!(is_fine(self.unit.forget(&mut saved)) && is_fine(other.forget(&mut shipped)));
    }
}

impl Drop for Host<'_> {
    fn drop(&mut self) {
        for (saved, _) in &mut self.slots {
            self.unit.forget(saved);
        }
    }
}
