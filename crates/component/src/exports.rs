//! The functions of the world, each a line on [`Unit`]. What the unit does not offer is refused with the reason in the
//! log.

use super::bindings::exports::fmi::fmi3::{
    co_simulation::{CoSimulationInstance, DoStepResult, Guest, GuestCoSimulationInstance},
    common,
};
use super::bindings::fmi::fmi3::types::{
    DependencyKind, DiscreteStatesInfo, IntervalFraction, IntervalQualifier, Status, VariableDependency,
};
use super::unit::{Unit, Wishes};
use ancf14::fmi::lifecycle::Call;

/// What the component exports.
pub struct Fmu;

impl common::Guest for Fmu {
    fn get_version() -> String {
        String::from("3.0")
    }
}

impl Guest for Fmu {
    type CoSimulationInstance = Unit;
}

/// The status of a check that has no other answer.
fn status(outcome: Result<(), Status>) -> Status {
    outcome.err().unwrap_or(Status::Ok)
}

impl GuestCoSimulationInstance for Unit {
    fn instantiate_co_simulation(
        name: String,
        token: String,
        resources: String,
        _visible: bool,
        logging: bool,
        event_mode: bool,
        early_return: bool,
        required: Vec<u32>,
    ) -> Option<CoSimulationInstance> {
        let wishes = Wishes { name, token, resources, logging, event_mode, early_return, required };
        Self::new(wishes).map(CoSimulationInstance::new)
    }

    fn set_debug_logging(&self, on: bool, categories: Vec<String>) -> Status {
        let names: Vec<&str> = categories.iter().map(String::as_str).collect();
        self.status(Call::SetDebugLogging, |instance| instance.set_debug_logging(on, &names))
    }

    fn enter_initialization_mode(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        let call = Call::EnterInitializationMode;
        self.status(call, |instance| instance.enter_initialization_mode_for(tolerance, start, stop))
    }

    fn exit_initialization_mode(&self) -> Status {
        self.status(Call::ExitInitializationMode, |instance| instance.exit_initialization_mode())
    }

    fn terminate(&self) -> Status {
        self.status(Call::Terminate, |instance| instance.terminate())
    }

    fn reset(&self) -> Status {
        self.status(Call::Reset, |instance| instance.reset())
    }

    fn get_float64(&self, references: Vec<u32>) -> Result<Vec<f64>, Status> {
        let mut values = vec![0.0; self.count(&references)];
        self.answer(Call::GetReal, |instance| instance.get_float64(&references, &mut values)).map(|()| values)
    }

    fn set_float64(&self, references: Vec<u32>, values: Vec<f64>) -> Status {
        self.status(Call::SetReal, |instance| instance.set_float64(&references, &values))
    }

    fn get_int32(&self, references: Vec<u32>) -> Result<Vec<i32>, Status> {
        let mut values = vec![0; self.count(&references)];
        self.answer(Call::GetInteger, |instance| instance.get_int32(&references, &mut values)).map(|()| values)
    }

    fn set_int32(&self, references: Vec<u32>, values: Vec<i32>) -> Status {
        self.status(Call::SetInteger, |instance| instance.set_int32(&references, &values))
    }

    fn get_number_of_variable_dependencies(&self, reference: u32) -> Result<u64, Status> {
        let call = Call::GetNumberOfVariableDependencies;
        self.answer(call, |instance| instance.count_dependencies(reference)).map(|count| count as u64)
    }

    fn get_variable_dependencies(&self, dependent: u32) -> Result<Vec<VariableDependency>, Status> {
        self.answer(Call::GetVariableDependencies, |instance| {
            let count = instance.count_dependencies(dependent)?;
            let (mut elements, mut others, mut references) = (vec![0; count], vec![0; count], vec![0; count]);
            instance.dependencies(dependent, &mut elements, &mut references, &mut others)?;
            // The draft counts elements from 0.
            let row = |place: usize| VariableDependency {
                dependent_value_reference: dependent,
                element_index_of_dependent: elements[place] as u32 - 1,
                independent_value_reference: references[place],
                element_index_of_independent: others[place] as u32 - 1,
                kind: DependencyKind::Dependent,
            };
            Ok((0..count).map(row).collect())
        })
    }

    fn get_fmu_state(&self) -> Result<Vec<u8>, Status> {
        self.answer(Call::GetFMUstate, |instance| {
            let state = instance.state()?;
            instance.serialize(Call::SerializeFMUstate, &state)
        })
    }

    fn set_fmu_state(&self, bytes: Vec<u8>) -> Status {
        self.status(Call::SetFMUstate, |instance| {
            let state = instance.deserialize(&bytes)?;
            instance.set_state(&state)
        })
    }

    fn get_directional_derivative(
        &self,
        unknowns: Vec<u32>,
        knowns: Vec<u32>,
        seed: Vec<f64>,
    ) -> Result<Vec<f64>, Status> {
        let mut changes = vec![0.0; self.count(&unknowns)];
        let outcome = self.answer(Call::GetDirectionalDerivative, |instance| {
            instance.directional_derivative_of_arrays(&unknowns, &knowns, &seed, &mut changes)
        });
        outcome.map(|()| changes)
    }

    fn get_adjoint_derivative(&self, unknowns: Vec<u32>, knowns: Vec<u32>, seed: Vec<f64>) -> Result<Vec<f64>, Status> {
        let mut changes = vec![0.0; self.count(&knowns)];
        let outcome = self.answer(Call::GetAdjointDerivative, |instance| {
            instance.adjoint_derivative_of_arrays(&unknowns, &knowns, &seed, &mut changes)
        });
        outcome.map(|()| changes)
    }

    fn get_output_derivatives(&self, requests: Vec<(u32, u32)>) -> Result<Vec<f64>, Status> {
        let references: Vec<u32> = requests.iter().map(|(reference, _)| *reference).collect();
        let orders: Vec<i32> = requests.iter().map(|(_, order)| i32::try_from(*order).unwrap_or(i32::MAX)).collect();
        let mut rates = vec![0.0; self.count(&references)];
        let outcome = self.answer(Call::GetRealOutputDerivatives, |instance| {
            instance.get_output_derivatives(&references, &orders, &mut rates)
        });
        outcome.map(|()| rates)
    }

    fn do_step(&self, time: f64, step: f64, _no_state_before: bool) -> Result<DoStepResult, Status> {
        self.step(time, step)
    }

    fn update_discrete_states(&self) -> Result<DiscreteStatesInfo, Status> {
        let none = DiscreteStatesInfo {
            new_discrete_states_needed: false,
            terminate_simulation: false,
            nominals_of_continuous_states_changed: false,
            values_of_continuous_states_changed: false,
            next_event_time_defined: false,
            next_event_time: 0.0,
        };
        self.legal(Call::UpdateDiscreteStates).map(|()| none)
    }

    /// FMI 3.0 has no such function any more; the draft still lists it.
    fn set_input_derivatives(&self, _requests: Vec<(u32, u32)>, _values: Vec<f64>) -> Status {
        status(self.legal(Call::SetRealInputDerivatives))
    }

    fn get_float32(&self, references: Vec<u32>) -> Result<Vec<f32>, Status> {
        self.none(Call::GetFloat32, &references, "Float32").map(|()| Vec::new())
    }

    fn set_float32(&self, references: Vec<u32>, _values: Vec<f32>) -> Status {
        status(self.none(Call::SetFloat32, &references, "Float32"))
    }

    fn get_int8(&self, references: Vec<u32>) -> Result<Vec<i8>, Status> {
        self.none(Call::GetInt8, &references, "Int8").map(|()| Vec::new())
    }

    fn set_int8(&self, references: Vec<u32>, _values: Vec<i8>) -> Status {
        status(self.none(Call::SetInt8, &references, "Int8"))
    }

    fn get_int16(&self, references: Vec<u32>) -> Result<Vec<i16>, Status> {
        self.none(Call::GetInt16, &references, "Int16").map(|()| Vec::new())
    }

    fn set_int16(&self, references: Vec<u32>, _values: Vec<i16>) -> Status {
        status(self.none(Call::SetInt16, &references, "Int16"))
    }

    fn get_int64(&self, references: Vec<u32>) -> Result<Vec<i64>, Status> {
        self.none(Call::GetInt64, &references, "Int64").map(|()| Vec::new())
    }

    fn set_int64(&self, references: Vec<u32>, _values: Vec<i64>) -> Status {
        status(self.none(Call::SetInt64, &references, "Int64"))
    }

    fn get_uint8(&self, references: Vec<u32>) -> Result<Vec<u8>, Status> {
        self.none(Call::GetUInt8, &references, "UInt8").map(|()| Vec::new())
    }

    fn set_uint8(&self, references: Vec<u32>, _values: Vec<u8>) -> Status {
        status(self.none(Call::SetUInt8, &references, "UInt8"))
    }

    fn get_uint16(&self, references: Vec<u32>) -> Result<Vec<u16>, Status> {
        self.none(Call::GetUInt16, &references, "UInt16").map(|()| Vec::new())
    }

    fn set_uint16(&self, references: Vec<u32>, _values: Vec<u16>) -> Status {
        status(self.none(Call::SetUInt16, &references, "UInt16"))
    }

    fn get_uint32(&self, references: Vec<u32>) -> Result<Vec<u32>, Status> {
        self.none(Call::GetUInt32, &references, "UInt32").map(|()| Vec::new())
    }

    fn set_uint32(&self, references: Vec<u32>, _values: Vec<u32>) -> Status {
        status(self.none(Call::SetUInt32, &references, "UInt32"))
    }

    fn get_uint64(&self, references: Vec<u32>) -> Result<Vec<u64>, Status> {
        self.none(Call::GetUInt64, &references, "UInt64").map(|()| Vec::new())
    }

    fn set_uint64(&self, references: Vec<u32>, _values: Vec<u64>) -> Status {
        status(self.none(Call::SetUInt64, &references, "UInt64"))
    }

    fn get_boolean(&self, references: Vec<u32>) -> Result<Vec<bool>, Status> {
        self.none(Call::GetBoolean, &references, "Boolean").map(|()| Vec::new())
    }

    fn set_boolean(&self, references: Vec<u32>, _values: Vec<bool>) -> Status {
        status(self.none(Call::SetBoolean, &references, "Boolean"))
    }

    fn get_string(&self, references: Vec<u32>) -> Result<Vec<String>, Status> {
        self.none(Call::GetString, &references, "String").map(|()| Vec::new())
    }

    fn set_string(&self, references: Vec<u32>, _values: Vec<String>) -> Status {
        status(self.none(Call::SetString, &references, "String"))
    }

    fn get_binary(&self, references: Vec<u32>) -> Result<Vec<Vec<u8>>, Status> {
        self.none(Call::GetBinary, &references, "Binary").map(|()| Vec::new())
    }

    fn set_binary(&self, references: Vec<u32>, _values: Vec<Vec<u8>>) -> Status {
        status(self.none(Call::SetBinary, &references, "Binary"))
    }

    fn enter_event_mode(&self) -> Status {
        status(self.legal(Call::EnterEventMode))
    }

    fn enter_configuration_mode(&self) -> Status {
        status(self.legal(Call::EnterConfigurationMode))
    }

    fn exit_configuration_mode(&self) -> Status {
        status(self.legal(Call::ExitConfigurationMode))
    }

    fn set_clock(&self, _references: Vec<u32>, _values: Vec<bool>) -> Status {
        status(self.legal(Call::SetClock))
    }

    fn set_interval_decimal(&self, _references: Vec<u32>, _intervals: Vec<f64>) -> Status {
        status(self.legal(Call::SetIntervalDecimal))
    }

    fn set_interval_fraction(&self, _references: Vec<u32>, _intervals: Vec<IntervalFraction>) -> Status {
        status(self.legal(Call::SetIntervalFraction))
    }

    fn set_shift_decimal(&self, _references: Vec<u32>, _shifts: Vec<f64>) -> Status {
        status(self.legal(Call::SetShiftDecimal))
    }

    fn set_shift_fraction(&self, _references: Vec<u32>, _shifts: Vec<IntervalFraction>) -> Status {
        status(self.legal(Call::SetShiftFraction))
    }

    fn evaluate_discrete_states(&self) -> Status {
        status(self.legal(Call::EvaluateDiscreteStates))
    }

    fn enter_step_mode(&self) -> Status {
        status(self.legal(Call::EnterStepMode))
    }

    fn get_clock(&self, _references: Vec<u32>) -> Result<Vec<bool>, Status> {
        self.legal(Call::GetClock).map(|()| Vec::new())
    }

    fn get_interval_decimal(&self, _references: Vec<u32>) -> Result<Vec<(f64, IntervalQualifier)>, Status> {
        self.legal(Call::GetIntervalDecimal).map(|()| Vec::new())
    }

    fn get_interval_fraction(
        &self,
        _references: Vec<u32>,
    ) -> Result<Vec<(IntervalFraction, IntervalQualifier)>, Status> {
        self.legal(Call::GetIntervalFraction).map(|()| Vec::new())
    }

    fn get_shift_decimal(&self, _references: Vec<u32>) -> Result<Vec<f64>, Status> {
        self.legal(Call::GetShiftDecimal).map(|()| Vec::new())
    }

    fn get_shift_fraction(&self, _references: Vec<u32>) -> Result<Vec<IntervalFraction>, Status> {
        self.legal(Call::GetShiftFraction).map(|()| Vec::new())
    }
}
