//! The linear system as Model Exchange needs it: its states as variables, and their derivatives at an instant.

use super::amplitude::{Amplitude, MEANING, NAME};
use super::file::Signal;
use super::system::{Known, System, Unknown};
use super::{Unit, difference, result, wrong};
use crate::fmi::continuous::{Continuous, Inputs};
use crate::fmi::variable::{Causality, Quantity, Variability, Variable};
use crate::fmi::{Failure, Value};

/// The variable table: inputs, outputs, the share of nonlinearity, states, derivatives of states by time.
pub(super) fn variables(
    [inputs, outputs]: [&[Signal]; 2],
    amplitude: Option<&Amplitude>,
    states: &[String],
    system: &System,
) -> Vec<Variable> {
    let first = inputs.len() + outputs.len() + usize::from(amplitude.is_some());
    let follows_from = |unknown: Unknown| -> Vec<usize> {
        let given = (0..inputs.len()).map(|column| (column, Known::Input(column)));
        let own = (0..system.order()).map(|column| (first + column, Known::State(column)));
        let known = given.chain(own).filter(|(_, known)| system.slope(unknown, *known) != 0.0);
        known.map(|(reference, _)| reference).collect()
    };
    let given = inputs.iter().map(|signal| signal.variable(Causality::Input, None));
    let found = outputs.iter().enumerate().map(|(row, signal)| {
        let from = follows_from(Unknown::Output(row));
        Variable { follows_from: from.clone(), ..signal.variable(Causality::Output, Some(from)) }
    });
    let share = amplitude.map(|amplitude| {
        let from = (0..system.order()).filter(|state| amplitude.depends_on(*state)).map(|state| first + state);
        let from: Vec<usize> = from.collect();
        Variable {
            causality: Causality::Output,
            found_from: Some(from.clone()),
            follows_from: from,
            ..local(NAME.to_owned(), MEANING.to_owned())
        }
    });
    let size = system.size(outputs.iter().map(|signal| signal.nominal.unwrap_or(1.0)));
    let own = (0..system.order()).map(|number| {
        let meaning = states.get(number).map(|meaning| format!(", {meaning}")).unwrap_or_default();
        let nominal = size * system.unit(number);
        Variable {
            nominal: nominal.is_normal().then_some(nominal),
            ..local(format!("state[{}]", number + 1), format!("State {} of the linear system{meaning}", number + 1))
        }
    });
    let rates = (0..system.order()).map(|number| {
        let from = follows_from(Unknown::Rate(number));
        let meaning = format!("Derivative of state {} by time", number + 1);
        Variable {
            derivative_of: Some(first + number),
            found_from: Some(from.clone()),
            follows_from: from,
            ..local(format!("state_rate[{}]", number + 1), meaning)
        }
    });
    given.chain(found).chain(share).chain(own).chain(rates).collect()
}

/// A variable of the system itself.
fn local(name: String, description: String) -> Variable {
    Variable {
        name,
        description,
        causality: Causality::Local,
        variability: Variability::Continuous,
        start: Value::Real(0.0),
        min: None,
        max: None,
        quantity: Quantity::new("", ""),
        nominal: None,
        display_unit: None,
        found_from: None,
        derivative_of: None,
        follows_from: Vec::new(),
    }
}

impl Continuous for Unit {
    fn set_time(&mut self, time: f64) {
        self.state.time = time;
    }

    #[inline(never)]
    fn evaluate(&mut self, inputs: Inputs) -> Result<(), Failure> {
        let at_once = inputs == Inputs::Set;
        if at_once && self.settled {
            return Ok(());
        }
        let given = if at_once { &self.state.values } else { &self.state.ends };
        difference(&mut self.changes, given, &self.inputs);
        let (z, changes) = (&self.state.z, &self.changes);
        self.system.rate(z, changes, &mut self.rest);
        let too_large = if at_once { self.too_large(z, changes) } else { None };
        if let Some(name) = too_large.or((!self.system.are_finite(&self.rest)).then_some("a rate of its state")) {
            return Err(wrong(format!(
                "{name} is too large for a number: a state or an input is far too large; take shorter steps, or set a \
                 reasonable value"
            )));
        }
        for (number, rate) in self.rates.iter_mut().enumerate() {
            *rate = self.rest[number] * self.system.unit(number);
        }
        if at_once {
            for (row, output) in self.state.outputs.iter_mut().enumerate() {
                *output =
                    result((&self.system, self.amplitude.as_ref()), &self.outputs, row, &self.state.z, &self.changes);
            }
            self.look();
            self.state.ends.copy_from_slice(&self.state.values);
        }
        self.settled = at_once;
        Ok(())
    }
}
