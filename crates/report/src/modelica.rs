//! Linear systems as models of Modelica 3, for Dymola, OpenModelica and other tools of that language.

use super::matrices::System;
use ancf14::model::linear::{Linear, Matrix, Signal};

/// Text of a Modelica string: what would end it or begin an escape has a backslash.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// An identifier that looks like `name` and is none of `taken`: letters, digits and `_`.
fn identifier(name: &str, taken: &mut Vec<String>) -> String {
    let mut own: String = name.chars().map(|own| if own.is_ascii_alphanumeric() { own } else { '_' }).collect();
    while own.contains("__") {
        own = own.replace("__", "_");
    }
    let mut own = own.trim_matches('_').to_owned();
    // Identifiers begin with a letter, and `time` and the words of the language are taken.
    if !own.starts_with(|first: char| first.is_ascii_alphabetic()) || WORDS.split(' ').any(|word| word == own) {
        own = format!("x_{own}");
    }
    let stem = own.clone();
    for number in 2.. {
        if !taken.contains(&own) {
            break;
        }
        own = format!("{stem}_{number}");
    }
    taken.push(own.clone());
    own
}

/// Words of the language, and names that the model has.
const WORDS: &str = "algorithm and annotation block break class connect connector constant constrainedby der discrete each else \
    elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for \
    function if import impure in initial inner input loop model not operator or outer output package parameter \
    partial protected public pure record redeclare replaceable return stream then true type when while within \
    time u0 y0 system Modelica Real Integer Boolean String";

/// A vector; one without numbers has no braces in Modelica.
fn vector(values: impl Iterator<Item = f64>) -> String {
    let numbers: Vec<String> = values.map(|value| format!("{value:e}")).collect();
    if numbers.is_empty() { "fill(0.0, 0)".to_owned() } else { format!("{{{}}}", numbers.join(", ")) }
}

/// A matrix, a row a line; one without rows or columns has its size only.
fn matrix(own: &Matrix) -> String {
    if own.rows == 0 || own.columns == 0 {
        return format!("fill(0.0, {}, {})", own.rows, own.columns);
    }
    let row = |row: usize| {
        let numbers: Vec<String> = (0..own.columns).map(|column| format!("{:e}", own.at(row, column))).collect();
        numbers.join(", ")
    };
    format!("[{}]", (0..own.rows).map(row).collect::<Vec<_>>().join(";\n      "))
}

impl System<'_> {
    /// The text of a model of Modelica: its inputs and outputs are whole values, not changes, and have the names of the
    /// linear system but for letters that identifiers do not have.
    pub fn modelica(&self) -> String {
        let Linear { states, inputs, outputs, a, b, c, d, time, .. } = self.linear;
        let mut taken = Vec::new();
        let name = identifier(self.model, &mut taken);
        let mut named =
            |signals: &[Signal]| signals.iter().map(|own| identifier(&own.name, &mut taken)).collect::<Vec<_>>();
        let (input_names, output_names) = (named(inputs), named(outputs));
        let connectors = |kind: &str, names: &[String], signals: &[Signal]| {
            let one = |(name, Signal { name: whole, unit, .. }): (&String, &Signal)| {
                let unit = if unit.is_empty() { String::new() } else { format!("(unit = {})", quoted(unit)) };
                format!("  Modelica.Blocks.Interfaces.Real{kind} {name}{unit} {};\n", quoted(whole))
            };
            names.iter().zip(signals).map(one).collect::<String>()
        };
        let values = |signals: &[Signal]| vector(signals.iter().map(|own| own.value));
        let given = input_names.iter().enumerate();
        let given: String = given.map(|(at, own)| format!("  system.u[{0}] = {own} - u0[{0}];\n", at + 1)).collect();
        let read = output_names.iter().enumerate();
        let read: String = read.map(|(at, own)| format!("  {own} = system.y[{0}] + y0[{0}];\n", at + 1)).collect();
        let of_states: String =
            states.iter().enumerate().map(|(number, own)| format!("  // {}: {}\n", number + 1, own.name)).collect();
        format!(
            "model {name} {about}\n{ins}{outs}  parameter Real u0[{k}] = {u0} \"inputs in the state that it is about\";\n  \
             parameter Real y0[{m}] = {y0} \"outputs in that state\";\n  \
             Modelica.Blocks.Continuous.StateSpace system(\n    \
             A = {a},\n    B = {b},\n    C = {c},\n    D = {d},\n    \
             initType = Modelica.Blocks.Types.Init.InitialState, x_start = zeros({n}))\n    \
             \"states: changes from that state\";\n{of_states}equation\n{given}{read}end {name};\n",
            about = quoted(&format!(
                "Linear system of {} about its state at t = {time} s, by ancf14 {}",
                self.model, self.version
            )),
            ins = connectors("Input", &input_names, inputs),
            outs = connectors("Output", &output_names, outputs),
            k = inputs.len(),
            m = outputs.len(),
            n = states.len(),
            u0 = values(inputs),
            y0 = values(outputs),
            a = matrix(a),
            b = matrix(b),
            c = matrix(c),
            d = matrix(d),
        )
    }
}
