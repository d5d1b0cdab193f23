//! Every function of the C interface with random arguments: good ones, wrong ones, and those that no host should pass.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use ancf14::ffi::{fmi2::*, fmi2_values::*, types::*};
use ancf14::fmi::Model;
use ancf14::fmi::lifecycle::Call;
use ancf14::fmi::variable::Causality;
use std::ptr::{null, null_mut};

use super::host::{Host, SLOTS};
use crate::fmi::unit::{Unit, is_fine};

/// The answer to a call.
pub struct Answer {
    pub status: fmi2Status,
    /// The argument is such that the call must fail.
    pub is_wrong: bool,
}

impl From<fmi2Status> for Answer {
    fn from(status: fmi2Status) -> Self {
        Self { status, is_wrong: false }
    }
}

fn wrong(status: fmi2Status) -> Answer {
    Answer { status, is_wrong: true }
}

impl Host<'_> {
    /// Calls a function with any arguments.
    pub fn make(&mut self, call: Call) -> Answer {
        let c = self.unit.c;
        let kind = self.random.below(6) as i32 - 1;
        let (mut status, mut real, mut integer, mut text) = (fmi2Status::fmi2OK, 7.0, 7, null());
        let is_null = self.random.below(20) == 0;
        // SAFETY: the unit is live; arrays have the lengths that are passed with them, or are NULL, or are so long that
        // no array can be and are refused; texts end with a zero byte.
        unsafe {
            match call {
                Call::SetDebugLogging => {
                    let names = [c"logAll".as_ptr(), c"logEvents".as_ptr(), c"\xff".as_ptr(), c"x".as_ptr(), null()];
                    let count = self.random.below(names.len() + 1);
                    fmi2SetDebugLogging(c, kind, count, names.as_ptr()).into()
                }
                Call::FreeInstance => self.instantiate_wrongly(),
                Call::SetupExperiment => {
                    let [tolerance, start, stop] = [1e-4, 0.0, 10.0].map(|near| self.number(near));
                    fmi2SetupExperiment(c, kind, tolerance, start, kind % 2, stop).into()
                }
                Call::GetReal => {
                    let references = self.references(None);
                    let mut values = vec![7.5; references.len()];
                    let status = self.unit.get_real(&references, &mut values);
                    self.are_sound(call, status, &values);
                    status.into()
                }
                Call::GetInteger | Call::SetInteger => {
                    let references = self.integers();
                    let mut values: Vec<i32> =
                        references.iter().map(|_| [1, 2, 3, 0, -1, i32::MAX, i32::MIN][self.random.below(7)]).collect();
                    match call {
                        Call::GetInteger => {
                            fmi2GetInteger(c, references.as_ptr(), references.len(), values.as_mut_ptr())
                        }
                        _ => fmi2SetInteger(c, references.as_ptr(), references.len(), values.as_ptr()),
                    }
                    .into()
                }
                Call::GetBoolean => wrong(fmi2GetBoolean(c, &raw const kind as *const u32, 1, &raw mut integer)),
                Call::SetBoolean => wrong(fmi2SetBoolean(c, &raw const kind as *const u32, 1, &raw const integer)),
                Call::GetString => wrong(fmi2GetString(c, &raw const kind as *const u32, 1, &raw mut text)),
                Call::SetString => wrong(fmi2SetString(c, &raw const kind as *const u32, 1, &raw const text)),
                Call::SetReal if is_null => {
                    let reference = 0;
                    match self.random.below(3) {
                        0 => wrong(fmi2SetReal(c, null(), 1, &raw const real)),
                        1 => wrong(fmi2SetReal(c, &raw const reference, 1, null())),
                        _ => wrong(fmi2SetReal(c, &raw const reference, usize::MAX, &raw const real)),
                    }
                }
                Call::SetReal => {
                    let wanted = [None, Some(Causality::Input), Some(Causality::Parameter)][self.random.below(3)];
                    let references = self.references(wanted);
                    let values = self.values(&references);
                    self.unit.lines.take();
                    let status = self.unit.set_real(&references, &values);
                    Answer { status, is_wrong: values.iter().any(|value| !value.is_finite()) }
                }
                Call::GetFMUstate | Call::DeSerializeFMUstate => self.get_state(call),
                Call::SetFMUstate => {
                    let (saved, slot) = self.handle();
                    let status = self.unit.restore(saved);
                    match slot.filter(|_| !saved.is_null()) {
                        Some(slot) if is_fine(status) => {
                            self.mode = self.slots[slot].1;
                            status.into()
                        }
                        Some(_) => status.into(),
                        None => wrong(status),
                    }
                }
                Call::FreeFMUstate => {
                    let (mut saved, slot) = self.handle();
                    let status = self.unit.forget(&mut saved);
                    match slot {
                        Some(slot) if is_fine(status) => {
                            assert!(saved.is_null());
                            let old = std::mem::replace(&mut self.slots[slot].0, null_mut());
                            self.dead.extend((!old.is_null()).then_some(old));
                            status.into()
                        }
                        Some(_) => status.into(),
                        None => wrong(status),
                    }
                }
                Call::SerializedFMUstateSize | Call::SerializeFMUstate => {
                    let (saved, slot) = self.handle();
                    let mut size = 0;
                    let status = fmi2SerializedFMUstateSize(c, saved, &raw mut size);
                    let status = match call {
                        Call::SerializedFMUstateSize => status,
                        _ => self.unit.serialize_to(saved, &mut vec![0; size]),
                    };
                    if slot.is_some() && !saved.is_null() { status.into() } else { wrong(status) }
                }
                Call::GetDirectionalDerivative => {
                    let unknowns = self.references(Some(Causality::Output));
                    let wanted = [Causality::Input, Causality::Parameter][self.random.below(2)];
                    let knowns = self.references(Some(wanted));
                    let seeds: Vec<f64> = knowns.iter().map(|_| self.number(1.0)).collect();
                    let mut changes = vec![7.5; unknowns.len()];
                    let status = fmi2GetDirectionalDerivative(
                        c,
                        unknowns.as_ptr(),
                        unknowns.len(),
                        knowns.as_ptr(),
                        knowns.len(),
                        seeds.as_ptr(),
                        changes.as_mut_ptr(),
                    );
                    self.are_sound(call, status, &changes);
                    Answer { status, is_wrong: seeds.iter().any(|seed| !seed.is_finite()) }
                }
                Call::SetRealInputDerivatives | Call::GetRealOutputDerivatives => {
                    let sets = call == Call::SetRealInputDerivatives;
                    let references = self.references(Some(if sets { Causality::Input } else { Causality::Output }));
                    let order = if self.random.below(10) == 0 { kind } else { 1 };
                    let orders = vec![order; references.len()];
                    let mut slopes: Vec<f64> = references.iter().map(|_| self.number(0.1)).collect();
                    let count = references.len();
                    let status = if sets {
                        fmi2SetRealInputDerivatives(c, references.as_ptr(), count, orders.as_ptr(), slopes.as_ptr())
                    } else {
                        slopes.fill(7.5);
                        fmi2GetRealOutputDerivatives(
                            c,
                            references.as_ptr(),
                            count,
                            orders.as_ptr(),
                            slopes.as_mut_ptr(),
                        )
                    };
                    if !sets {
                        self.are_sound(call, status, &slopes);
                    }
                    Answer {
                        status,
                        is_wrong: count > 0 && order != 1 || slopes.iter().any(|slope| !slope.is_finite()),
                    }
                }
                Call::DoStep => {
                    let (time, step) = self.step();
                    self.unit.lines.take();
                    let status = self.unit.do_step(time, step);
                    Answer { status, is_wrong: !(step > 0.0 && step.is_finite() && time.is_finite()) }
                }
                Call::GetStatus => wrong(fmi2GetStatus(c, kind, &raw mut status)),
                Call::GetRealStatus if is_null => wrong(fmi2GetRealStatus(c, kind, null_mut())),
                Call::GetRealStatus => {
                    let status = fmi2GetRealStatus(c, kind, &raw mut real);
                    Answer { status, is_wrong: kind != fmi2LastSuccessfulTime }
                }
                Call::GetIntegerStatus => wrong(fmi2GetIntegerStatus(c, kind, &raw mut integer)),
                Call::GetBooleanStatus => {
                    let status = fmi2GetBooleanStatus(c, kind, &raw mut integer);
                    Answer { status, is_wrong: kind != fmi2Terminated }
                }
                Call::GetStringStatus => wrong(fmi2GetStringStatus(c, kind, &raw mut text)),
                Call::CancelStep => wrong(self.unit.simple(call)),
                _ => self.unit.simple(call).into(),
            }
        }
    }

    /// References of the model's Integer variables that can be set, and others.
    fn integers(&mut self) -> Vec<u32> {
        let names = ["upper.elements", "boom.elements", "rope.elements", "steel.young"];
        let variables = self.place.model.variables();
        let place =
            |name: &&str| variables.iter().position(|variable| variable.name == **name).map(|place| place as u32);
        let known: Vec<u32> = names.iter().filter_map(place).collect();
        (0..self.random.below(3)).map(|_| known[self.random.below(known.len())]).collect()
    }

    /// Asks for an instance with arguments of which one is wrong or missing, and for the end of one that has ended.
    fn instantiate_wrongly(&mut self) -> Answer {
        let callbacks = self.unit.lines.callbacks();
        let other = Unit::new(self.place);
        let ended = other.c;
        drop(other);
        // SAFETY: texts end with a zero byte or are NULL; the callbacks live as long as the unit. What the ended handle
        // is, is the question.
        unsafe {
            let nobody = fmi2Instantiate(
                [null(), c"".as_ptr(), c"name".as_ptr()][self.random.below(3)],
                self.random.below(4) as i32 - 1,
                [null(), c"\xff".as_ptr(), c"{no guid}".as_ptr()][self.random.below(3)],
                [null(), c"file:///nowhere".as_ptr(), c"\xff".as_ptr()][self.random.below(3)],
                if self.random.below(4) == 0 { null() } else { &raw const callbacks },
                0,
                1,
            );
            drop(std::panic::take_hook());
            assert!(nobody.is_null(), "an instance with a wrong argument");
            self.unit.lines.take();
            fmi2FreeInstance(ended);
            fmi2FreeInstance(null_mut());
            assert_eq!(fmi2DoStep(ended, 0.0, 1e-3, fmi2False), fmi2Status::fmi2Error, "a handle that has ended");
        }
        fmi2Status::fmi2OK.into()
    }

    /// Copies the state, or reads one from bytes, perhaps damaged, to a place that has one or none.
    fn get_state(&mut self, call: Call) -> Answer {
        let (mut saved, slot) = self.handle();
        let (source, mut is_wrong) = (self.random.below(SLOTS), slot.is_none());
        let mut mode = self.mode;
        let status = if call == Call::GetFMUstate {
            self.unit.save(&mut saved)
        } else {
            let (given, its_mode) = self.slots[source];
            let mut bytes = if given.is_null() { vec![1, 2, 3] } else { self.unit.serialize(given) };
            is_wrong |= given.is_null();
            if self.random.below(3) == 0 {
                let at = self.random.below(bytes.len());
                bytes[at] ^= 1 << self.random.below(8);
                is_wrong = true;
            }
            mode = its_mode;
            self.unit.deserialize(&bytes, &mut saved)
        };
        if let Some(slot) = slot.filter(|_| is_fine(status)) {
            self.slots[slot] = (saved, mode);
        }
        Answer { status, is_wrong }
    }
}
