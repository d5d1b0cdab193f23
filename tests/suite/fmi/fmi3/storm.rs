//! Random calls of FMI 3.0 with random arguments, also from within intermediate updates: is every one answered as the
//! calling table says? Nothing may panic; a call that is refused changes nothing and says why; values that are handed
//! out are finite; and what follows a saved state is the same to the bit each time, with inputs that are set between
//! internal steps and with early returns.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::ptr::null_mut;

use ancf14::{
    ffi::{fmi3::*, fmi3_types::*, fmi3_values::*},
    fmi::{
        Model,
        lifecycle::{
            Call, Mode,
            fmi3::{TABLE, name},
        },
        variable::Causality,
    },
};

use super::host::{ERROR, HELD, OK, Place, Unit, Wishes};
use super::modes;
use crate::fmi::sequences::alone;
use crate::fuzz::requirements::is_readable;
use crate::fuzz::round;
use crate::random::Random;

/// Calls of a sequence.
const LENGTH: usize = 120;

/// What values hold before a call; one that is refused leaves them alone.
const UNTOUCHED: f64 = 7.5;

const WISHES: Wishes = Wishes { updates: true, early_return: true, logging: true };

/// A host, and what it knows of its unit.
struct Host<'a> {
    unit: Unit<'a>,
    random: Random,
    mode: Mode,
    /// Whether the last step told of an internal step: the host may have set inputs there.
    is_under_way: bool,
    /// A state that lives, with the mode that it goes back to.
    saved: Option<(fmi3FMUState, Mode)>,
}

/// A small number, or now and then one that hardly anybody means.
fn number(random: &mut Random) -> f64 {
    const ODD: [f64; 8] = [0.0, -0.0, 5e-324, 1e300, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    if random.below(12) == 0 { ODD[random.below(ODD.len())] } else { 1e-3 * random.signed() }
}

/// Up to three references of variables of a causality; now and then of none.
fn references(place: &Place, random: &mut Random, wanted: Causality) -> (Vec<u32>, usize) {
    let (all, _) = place.of(wanted);
    let mut list: Vec<u32> =
        (0..random.below(4)).filter_map(|_| all.get(random.below(all.len().max(1)))).copied().collect();
    if random.below(30) == 0 {
        list.push([u32::MAX, place.model.variables().len() as u32 + 1, 2][random.below(3)]);
    }
    let variables = place.model.variables();
    let elements = |reference: &u32| {
        let arrays = ancf14::fmi::arrays::arrays(variables);
        arrays.iter().find(|array| array.first == *reference as usize).map_or(1, |array| array.elements())
    };
    let count = list.iter().map(elements).sum::<usize>();
    (list, if random.below(30) == 0 { count + 1 } else { count })
}

/// Whether values are what an answer promises.
fn is_sound(status: fmi3Status, values: &[f64]) -> bool {
    values.iter().all(|value| if status == OK { value.is_finite() } else { *value == UNTOUCHED })
}

/// Reads outputs, their derivatives by time, or products with the derivatives of the step.
fn read(unit: &Unit<'_>, random: &mut Random, call: Call) -> fmi3Status {
    let (outputs, count) = references(unit.place, random, Causality::Output);
    let (inputs, given) = references(unit.place, random, Causality::Input);
    let (o, n, i, m) = (outputs.as_ptr(), outputs.len(), inputs.as_ptr(), inputs.len());
    let length = if call == Call::GetAdjointDerivative { given } else { count };
    let mut values = vec![UNTOUCHED; length];
    let to = values.as_mut_ptr();
    let seeds: Vec<f64> = (0..count.max(given)).map(|_| random.signed()).collect();
    let orders = vec![1; n];
    // SAFETY: the unit is live; the arrays have the lengths that are passed.
    let status = unsafe {
        match call {
            Call::GetReal => fmi3GetFloat64(unit.c, o, n, to, count),
            Call::GetRealOutputDerivatives => fmi3GetOutputDerivatives(unit.c, o, n, orders.as_ptr(), to, count),
            Call::GetDirectionalDerivative => {
                fmi3GetDirectionalDerivative(unit.c, o, n, i, m, seeds.as_ptr(), given, to, count)
            }
            _ => fmi3GetAdjointDerivative(unit.c, o, n, i, m, seeds.as_ptr(), count, to, given),
        }
    };
    assert!(is_sound(status, &values), "{}: {status:?} with {values:?}", name(call));
    status
}

/// Sets inputs or parameters. Steps keep their length: a million of them in a communication step would take hours.
fn write(unit: &Unit<'_>, random: &mut Random) -> fmi3Status {
    let wanted = if random.below(4) == 0 { Causality::Parameter } else { Causality::Input };
    let (mut list, _) = references(unit.place, random, wanted);
    let variables = unit.place.model.variables();
    list.retain(|reference| !variables.get(*reference as usize).is_some_and(|row| row.name.starts_with("simulation")));
    let arrays = ancf14::fmi::arrays::arrays(variables);
    let elements =
        |reference: &u32| arrays.iter().find(|array| array.first == *reference as usize).map_or(1, |a| a.elements());
    let values: Vec<f64> = (0..list.iter().map(elements).sum()).map(|_| number(random)).collect();
    let status = unit.set(&list, &values);
    assert!(status != OK || values.iter().all(|value| value.is_finite()), "{values:?}");
    status
}

/// What a host does in an intermediate update; returns whether it asks for an early return.
fn react(unit: &Unit<'_>, random: &mut Random) -> bool {
    for _ in 0..random.below(3) {
        let status = match random.below(4) {
            0 => read(unit, random, Call::GetReal),
            1 => read(unit, random, Call::GetRealOutputDerivatives),
            2 => write(unit, random),
            _ => {
                let (call, row) = TABLE[random.below(TABLE.len())];
                // It would be the unit's end.
                if call == Call::FreeInstance {
                    continue;
                }
                let status = modes::call(unit, call);
                let is_legal = row.as_bytes()[Mode::Update as usize] != b'.';
                assert_eq!(status == OK, is_legal, "{} during an update: {status:?}", name(call));
                status
            }
        };
        assert!(matches!(status, fmi3Status::fmi3OK | fmi3Status::fmi3Error), "{status:?}");
    }
    random.below(8) == 0
}

impl<'a> Host<'a> {
    fn new(place: &'a Place, random: Random) -> Self {
        Self { unit: Unit::with(place, WISHES), random, mode: Mode::Instantiated, saved: None, is_under_way: false }
    }

    /// The state, as bytes.
    fn bytes(&self) -> Vec<u8> {
        let state = self.unit.save();
        let bytes = self.unit.serialize(state);
        self.unit.forget(state);
        bytes
    }

    fn time(&self) -> f64 {
        let mut time = [0.0];
        self.unit.get(&[self.unit.place.model.variables().len() as u32], &mut time);
        time[0]
    }

    /// A step from about now, of about a few internal steps.
    fn step(&mut self) -> fmi3Status {
        let begin = self.time() + if self.random.below(15) == 0 { number(&mut self.random) } else { 0.0 };
        let length = match self.random.below(8) {
            0 => number(&mut self.random),
            1 => 1e-12,
            _ => 1e-3 * (1.0 + 3.0 * self.random.signed().abs()),
        };
        // Far more internal steps than a test has time for.
        let length = if length.is_finite() { length.min(5e-3) } else { length };
        let Self { unit, random, is_under_way, .. } = self;
        *is_under_way = false;
        let answer = unit.step_with(begin, length, |unit, _| {
            *is_under_way = true;
            react(unit, random)
        });
        let is_wrong = !(length > 0.0 && length.is_finite() && begin.is_finite());
        assert!(!is_wrong || answer.status != OK, "{begin} + {length}: {answer:?}");
        if answer.status == OK {
            // A step of round-off moves nothing.
            assert!(
                answer.time <= begin + length + 1e-9 && answer.time >= begin - 1e-9,
                "{begin} + {length}: {answer:?}"
            );
        }
        answer.status
    }

    /// A call that leads on, or any other.
    fn choose(&mut self) -> Call {
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

    fn make(&mut self, call: Call) -> fmi3Status {
        match call {
            Call::GetReal
            | Call::GetRealOutputDerivatives
            | Call::GetDirectionalDerivative
            | Call::GetAdjointDerivative => read(&self.unit, &mut self.random, call),
            Call::SetReal => write(&self.unit, &mut self.random),
            Call::DoStep => self.step(),
            Call::GetFMUstate => {
                self.drop_saved();
                self.saved = Some((self.unit.save(), self.mode));
                OK
            }
            Call::SetFMUstate => match self.saved {
                // SAFETY: the unit and the state are live.
                Some((state, mode)) if unsafe { fmi3SetFMUState(self.unit.c, state) } == OK => {
                    self.mode = mode;
                    OK
                }
                Some(_) => ERROR,
                // SAFETY: as above; NULL is refused.
                None => unsafe { fmi3SetFMUState(self.unit.c, null_mut()) },
            },
            Call::DeSerializeFMUstate => {
                let mut bytes = self.bytes();
                let at = self.random.below(bytes.len());
                bytes[at] ^= 1 << self.random.below(8);
                let mut state = null_mut();
                // SAFETY: the unit is live; the bytes are as many as is said.
                unsafe { fmi3DeserializeFMUState(self.unit.c, bytes.as_ptr(), bytes.len(), &raw mut state) }
            }
            // It would be the unit's end.
            Call::FreeInstance => OK,
            other => modes::call(&self.unit, other),
        }
    }

    /// Makes a call and looks whether the answer is what the table says.
    fn play(&mut self) {
        let (call, mode) = (self.choose(), self.mode);
        let row = TABLE.iter().find(|(listed, _)| *listed == call).unwrap().1;
        let is_forbidden = row.as_bytes()[mode as usize] == b'.';
        let before = self.bytes();
        self.unit.lines();
        let status = self.make(call);
        let lines = self.unit.lines();
        let said = format!("{} {mode}: {status:?} {lines:?}", name(call));
        lines.iter().for_each(|line| is_readable(line).unwrap_or_else(|problem| panic!("{said}: {problem}")));
        assert!(matches!(status, fmi3Status::fmi3OK | fmi3Status::fmi3Warning | fmi3Status::fmi3Error), "{said}");
        assert!(!is_forbidden || status == ERROR, "{said}");
        if status != ERROR {
            self.follow(call);
            return;
        }
        assert!(!lines.is_empty(), "{said}: no word of why");
        // A step that the model itself could not do, perhaps in the middle, after inputs were set there.
        if call == Call::DoStep && !is_forbidden && self.unit.set(&[], &[]) == ERROR {
            self.mode = Mode::Error;
            return;
        }
        let finds_start = mode == Mode::Initialization && !is_forbidden;
        let stops_between = call == Call::DoStep && self.is_under_way;
        assert!(self.bytes() == before || finds_start || stops_between, "{said}: the unit has changed");
    }

    /// Where a call leads that succeeded.
    fn follow(&mut self, call: Call) {
        match call {
            Call::EnterInitializationMode | Call::SetupExperiment => self.mode = Mode::Initialization,
            Call::ExitInitializationMode => self.mode = Mode::Step,
            Call::Terminate => self.mode = Mode::Terminated,
            Call::Reset => self.mode = Mode::Instantiated,
            _ => (),
        }
    }

    /// Steps with inputs, updates and early returns; statuses and bits of all that can be asked after each.
    fn steps(unit: &Unit<'_>, seed: u64) -> Vec<u64> {
        let mut random = Random(seed);
        let (inputs, count) = unit.place.of(Causality::Input);
        let values = |random: &mut Random| -> Vec<f64> { (0..count).map(|_| 1e-3 * random.signed()).collect() };
        let mut found = Vec::new();
        let mut time = [0.0];
        unit.get(&[unit.place.model.variables().len() as u32], &mut time);
        for _ in 0..3 {
            found.push(unit.set(&inputs, &values(&mut random)) as u64);
            let answer = unit.step_with(time[0], 3e-3, |unit, _| {
                match random.below(4) {
                    0 => drop(unit.bits()),
                    1 => assert_eq!(unit.set(&inputs, &values(&mut random)), OK),
                    2 => return true,
                    _ => (),
                }
                false
            });
            found.extend([answer.status as u64, answer.early.into(), answer.time.to_bits()]);
            if answer.status != OK {
                return found;
            }
            time[0] = answer.time;
            found.extend(unit.bits());
            if count > 0 {
                let seeds = values(&mut random);
                found.extend(unit.directional(&inputs, &seeds).into_iter().map(f64::to_bits));
            }
        }
        found
    }

    /// The same steps from the same state: on, back and on, and in another instance from bytes.
    fn repeat(&mut self) {
        let seed = self.random.below(1 << 30) as u64;
        let (state, other) = (self.unit.save(), Unit::with(self.unit.place, WISHES));
        let bytes = self.unit.serialize(state);
        let expected = Self::steps(&self.unit, seed);
        self.unit.restore(state);
        assert!(Self::steps(&self.unit, seed) == expected, "other bits after the way back");
        let shipped = other.deserialize(&bytes);
        other.restore(shipped);
        assert!(Self::steps(&other, seed) == expected, "other bits in another instance");
        self.unit.restore(state);
        self.unit.forget(state);
        other.forget(shipped);
    }

    fn drop_saved(&mut self) {
        if let Some((state, _)) = self.saved.take() {
            self.unit.forget(state);
        }
    }
}

#[test]
fn calls_are_answered_as_the_table_says() {
    alone("fmi::fmi3::storm::calls_are_answered_as_the_table_says", || {
        let pendulum = include_str!("../../../../models/pendulum.toml").replace("elements = 8", "elements = 2");
        let places = [Place::new(HELD), Place::new(&pendulum)];
        round("sequences of calls of FMI 3.0", 12, |seed| {
            let mut host = Host::new(&places[seed as usize % places.len()], Random(seed));
            for _ in 0..LENGTH {
                host.play();
                if host.mode == Mode::Step && host.random.below(30) == 0 {
                    host.repeat();
                }
            }
            host.drop_saved();
            Ok(())
        });
    });
}
