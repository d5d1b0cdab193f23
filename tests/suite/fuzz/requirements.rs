//! What must hold of every answer, whatever was asked.

use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

/// Longest message of one failure, bytes.
const LONGEST: usize = 4_000;
/// Longest list of mistakes of a file, bytes.
const LONGEST_LIST: usize = 40_000;

/// Several mistakes of a file, or one failure with the line that it is about.
pub fn is_readable(message: &str) -> Result<(), String> {
    is_text(message, LONGEST_LIST)
}

/// One failure or one warning.
pub fn is_sentence(message: &str) -> Result<(), String> {
    is_text(message, LONGEST)
}

fn is_text(message: &str, longest: usize) -> Result<(), String> {
    let shown: String = message.chars().take(300).collect();
    if message.trim().is_empty() || message.len() > longest {
        return Err(format!("a message of {} bytes: {shown}", message.len()));
    }
    if message.contains("internal fault") {
        return Err(format!("a fault: {shown}"));
    }
    match message.chars().find(|c| c.is_control() && *c != '\n') {
        Some(control) => Err(format!("a message with {control:?}: {shown:?}")),
        None => Ok(()),
    }
}

/// All values of the model, which are finite.
pub fn values(simulation: &Simulation) -> Result<Vec<f64>, String> {
    let rows = simulation.variables().iter().enumerate();
    rows.map(|(reference, variable)| {
        let value = simulation.value(reference).number();
        if value.is_finite() { Ok(value) } else { Err(format!("{} is {value}", variable.name)) }
    })
    .collect()
}

/// Two lists with the same bits.
pub fn same(a: &[f64], b: &[f64]) -> bool {
    a.iter().map(|value| value.to_bits()).eq(b.iter().map(|value| value.to_bits()))
}
