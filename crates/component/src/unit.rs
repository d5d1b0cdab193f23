//! An instance of the unit with its host: calls, their log lines, communication steps.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::bindings::exports::fmi::fmi3::co_simulation::DoStepResult;
use super::bindings::fmi::fmi3::{
    callbacks::log_message, intermediate_update_callbacks::intermediate_update, types::Status,
};
use super::files;
use ancf14::fmi::{
    self, Model,
    arrays::{arrays, time_reference},
    error::Error,
    instance::Instance,
    lifecycle::{Call, Standard},
    location::{LINEAR_FILE, STATE_FILE},
};
use ancf14::model::simulation::Simulation;
use ancf14::packed::Packed;

/// How a host makes an instance.
#[derive(Debug)]
pub struct Wishes {
    /// `instanceName`.
    pub name: String,
    /// `instantiationToken`.
    pub token: String,
    /// `resourcePath`, with the separator at its end.
    pub resources: String,
    pub logging: bool,
    pub event_mode: bool,
    pub early_return: bool,
    /// `requiredIntermediateVariables`.
    pub required: Vec<u32>,
}

/// An instance and its host.
pub struct Unit {
    instance: RefCell<Instance<Packed>>,
    name: String,
    early_return: bool,
    /// Elements of the variables by their references.
    elements: BTreeMap<u32, usize>,
}

impl Unit {
    /// Loads the model of the resources; none with a log line if that is not possible.
    pub fn new(wishes: Wishes) -> Option<Self> {
        let name = wishes.name.clone();
        Self::load(wishes)
            .inspect_err(|error| {
                let text = format!("fmi3InstantiateCoSimulation: {error}");
                log_message(&name, word(error.status()), error.category().name(), &text);
            })
            .ok()
    }

    fn load(wishes: Wishes) -> Result<Self, Error> {
        let refused = |reason: String| Err(Error::Instantiate(reason));
        if wishes.name.trim().is_empty() {
            return refused(String::from("the instance name is blank; pass a name that is unique in the simulation"));
        }
        if wishes.event_mode {
            return refused(String::from(
                "eventModeUsed is true, but this unit has no Event Mode; pass false, as hasEventMode says",
            ));
        }
        let resources = wishes.resources.trim_end_matches('/');
        let file = Packed::file(|name| files::read(&format!("{resources}/{name}")).is_ok());
        let path = format!("{resources}/{file}");
        let text = files::text(&path).map_err(|reason| {
            Error::Instantiate(format!(
                "cannot read the model file {path}: {reason}; the resource path must be the unpacked `resources` \
                 directory of the FMU, which the host opens for the component"
            ))
        })?;
        let model = if file == LINEAR_FILE {
            Packed::linear(&path, &text)?
        } else {
            let mut model = Simulation::load_with(None, &path, &text, &[], &|_| {
                let path = format!("{resources}/{STATE_FILE}");
                files::read(&path).map_err(|reason| format!("cannot read {path}: {reason}"))
            })?;
            model.heed_mesh_error();
            Packed::Mechanism(Box::new(model))
        };
        let own = &model.about().guid;
        if *own != wishes.token {
            return refused(format!(
                "the token `{}` is not that of the model file {path}, `{own}`: modelDescription.xml and resources belong \
                 to different models, or the file was changed; pack it again",
                wishes.token
            ));
        }
        let list = arrays(model.variables());
        let mut elements: BTreeMap<u32, usize> =
            list.iter().map(|array| (array.first as u32, array.elements())).collect();
        elements.insert(time_reference(model.variables()) as u32, 1);
        let mut instance = Instance::of(Standard::Fmi3, model, wishes.logging);
        instance.require_between(&wishes.required);
        let instance = RefCell::new(instance);
        let unit = Self { instance, name: wishes.name, early_return: wishes.early_return, elements };
        unit.report();
        Ok(unit)
    }

    /// Elements of variables together; of those that are unknown one each, and the call says so.
    pub fn count(&self, references: &[u32]) -> usize {
        references.iter().map(|reference| self.elements.get(reference).copied().unwrap_or(1)).sum()
    }

    /// Runs the body of a call that returns values; an error goes to the log. The status of a success has no place next
    /// to values: its warnings are in the log.
    pub fn answer<T>(
        &self,
        call: Call,
        body: impl FnOnce(&mut Instance<Packed>) -> Result<T, Error>,
    ) -> Result<T, Status> {
        self.run(call, body).map(|(values, _)| values)
    }

    /// Runs the body of a call that returns its status only; an error goes to the log.
    pub fn status(&self, call: Call, body: impl FnOnce(&mut Instance<Packed>) -> Result<(), Error>) -> Status {
        self.run(call, body).map_or_else(|refused| refused, |((), status)| status)
    }

    fn run<T>(
        &self,
        call: Call,
        body: impl FnOnce(&mut Instance<Packed>) -> Result<T, Error>,
    ) -> Result<(T, Status), Status> {
        let (mode, time) = {
            let instance = self.instance.borrow();
            (instance.mode(), instance.time())
        };
        let outcome = body(&mut self.instance.borrow_mut());
        self.report();
        let status = word(self.instance.borrow_mut().take_status());
        outcome.map(|values| (values, status)).map_err(|error| {
            let text = format!("{} {mode} at t = {time} s: {error}", Standard::Fmi3.name(call));
            log_message(&self.name, word(error.status()), error.category().name(), &text);
            word(error.status())
        })
    }

    /// Hands log lines to the host, errors always.
    fn report(&self) {
        let entries = self.instance.borrow_mut().take_entries();
        for entry in entries {
            if entry.status >= fmi::Status::Error || self.instance.borrow().wants(entry.category) {
                log_message(&self.name, word(entry.status), entry.category.name(), &entry.message);
            }
        }
    }

    /// Whether a call is legal; the log says why it is not.
    pub fn legal(&self, call: Call) -> Result<(), Status> {
        self.answer(call, |instance| instance.check(call))
    }

    /// Reads or sets variables of a type that no variable has.
    pub fn none(&self, call: Call, references: &[u32], asked: &'static str) -> Result<(), Status> {
        self.answer(call, |instance| instance.no_variable(call, references, asked))
    }

    /// A communication step. A host that allows early returns hears of each internal step. It can call nothing of the
    /// unit meanwhile: a component that waits for its host is not entered again.
    pub fn step(&self, time: f64, step: f64) -> Result<DoStepResult, Status> {
        const CALL: Call = Call::DoStep;
        let mut early = false;
        if self.early_return {
            self.answer(CALL, |instance| instance.begin_step(time, step))?;
            loop {
                let progress = self.answer(CALL, Instance::take_part)?;
                let can_return = !progress.arrived;
                let (asked, _) = intermediate_update(progress.time, false, false, true, can_return);
                early = asked && can_return;
                self.answer(CALL, |instance| if early { instance.return_early() } else { instance.go_on() })?;
                if progress.arrived || early {
                    break;
                }
            }
        } else {
            self.answer(CALL, |instance| instance.do_step(time, step))?;
        }
        Ok(DoStepResult {
            last_successful_time: self.instance.borrow().time(),
            event_handling_needed: false,
            terminate_simulation: false,
            early_return: early,
        })
    }
}

/// A status as the host has it.
fn word(status: fmi::Status) -> Status {
    match status {
        fmi::Status::Ok => Status::Ok,
        fmi::Status::Warning => Status::Warning,
        fmi::Status::Discard => Status::Discard,
        fmi::Status::Error => Status::Error,
        fmi::Status::Fatal => Status::Fatal,
    }
}
