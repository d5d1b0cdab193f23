//! The C header of one model: names for its GUID and value references, so that a C program has no magic numbers.

use std::{collections::BTreeSet, fmt::Write};

use super::{
    About, Value,
    arrays::arrays,
    error::Error,
    identifier::is_identifier,
    variable::{Causality, Variable},
};

/// The text of the header. Every name in it begins with `prefix`, usually the model identifier.
///
/// It stands alone: integers and texts only, for use with `ancf14.h` or with the standard's own headers. The macros
/// `prefix_REAL_OUTPUTS(X)` and `prefix_INTEGER_OUTPUTS(X)` expand `X(value reference, name, unit)` for each output,
/// `prefix_FLOAT64_OUTPUTS(X)` expands `X(value reference, name, unit, rows, columns)` for each output of FMI 3.0,
/// arrays among them.
///
/// # Errors
/// The prefix is not a C identifier.
pub fn text(about: &About, variables: &[Variable], prefix: &str) -> Result<String, Error> {
    if !is_identifier(prefix) {
        return Err(Error::Identifier(prefix.to_owned()));
    }
    let names = names(variables, prefix);
    let mut out = String::new();
    let written = write_all(&mut out, about, variables, prefix, &names);
    written.expect("a String takes every text");
    Ok(out)
}

fn write_all(
    out: &mut String,
    about: &About,
    variables: &[Variable],
    prefix: &str,
    names: &[String],
) -> Result<(), std::fmt::Error> {
    let guard = format!("{}_MODEL_H", prefix.to_ascii_uppercase());
    writeln!(out, "/* Value references of the model {}, made by ancf14 {}. */", comment(&about.name), version())?;
    writeln!(out, "#ifndef {guard}\n#define {guard}\n")?;
    writeln!(out, "/* What fmi2Instantiate compares with the model file. */")?;
    writeln!(out, "#define {prefix}_GUID {}", literal(&about.guid))?;
    writeln!(out, "#define {prefix}_MODEL_IDENTIFIER {}\n", literal(&about.identifier))?;
    writeln!(out, "/* Default stop time and communication step, s. */")?;
    writeln!(out, "#define {prefix}_STOP_TIME {:?}", about.stop)?;
    writeln!(out, "#define {prefix}_STEP_SIZE {:?}\n", about.output_step)?;
    writeln!(out, "enum {prefix}_variable {{")?;
    for (reference, (variable, name)) in variables.iter().zip(names).enumerate() {
        let comma = if reference + 1 == variables.len() { "" } else { "," };
        writeln!(out, "    /* {} */", comment(&meaning(variable)))?;
        writeln!(out, "    {name} = {reference}{comma}")?;
    }
    writeln!(out, "}};\n")?;
    outputs(out, variables, names, &format!("{prefix}_REAL_OUTPUTS"), |start| matches!(start, Value::Real(_)))?;
    outputs(out, variables, names, &format!("{prefix}_INTEGER_OUTPUTS"), |start| matches!(start, Value::Integer(_)))?;
    arrays_of_outputs(out, variables, names, &format!("{prefix}_FLOAT64_OUTPUTS"))?;
    writeln!(out, "#endif")
}

/// A macro that names each output of one type.
fn outputs(
    out: &mut String,
    variables: &[Variable],
    names: &[String],
    macro_name: &str,
    of_type: fn(Value) -> bool,
) -> Result<(), std::fmt::Error> {
    writeln!(out, "/* X(value reference, name, unit) for each of them, in the order of the description. */")?;
    write!(out, "#define {macro_name}(X)")?;
    for (variable, name) in variables.iter().zip(names) {
        if variable.causality == Causality::Output && of_type(variable.start) {
            write!(out, " \\\n    X({name}, {}, {})", literal(&variable.name), literal(&variable.quantity.unit))?;
        }
    }
    writeln!(out, "\n")
}

/// A macro that names each output of FMI 3.0, with its dimensions: an array has the reference of its first element.
fn arrays_of_outputs(
    out: &mut String,
    variables: &[Variable],
    names: &[String],
    macro_name: &str,
) -> Result<(), std::fmt::Error> {
    writeln!(
        out,
        "/* X(value reference, name, unit, rows, columns) for each of them in FMI 3.0; of a vector there is one column. */"
    )?;
    write!(out, "#define {macro_name}(X)")?;
    for array in arrays(variables) {
        let first = &variables[array.first];
        if first.causality == Causality::Output && matches!(first.start, Value::Real(_)) {
            let (name, unit) = (literal(array.name), literal(&first.quantity.unit));
            let [rows, columns] = [0, 1].map(|place| array.dimensions.get(place).copied().unwrap_or(1));
            write!(out, " \\\n    X({}, {name}, {unit}, {rows}, {columns})", names[array.first])?;
        }
    }
    writeln!(out, "\n")
}

/// Name, kind, type, unit and description in one line.
fn meaning(variable: &Variable) -> String {
    let kind = variable.causality.word();
    let unit = match variable.quantity.unit.as_str() {
        "" => String::new(),
        unit => format!(", {unit}"),
    };
    let text = format!("{}: {kind}, {}{unit}. {}", variable.name, variable.type_name(), variable.description);
    text.trim_end().to_owned()
}

/// A C name for each variable: everything but letters and digits becomes `_`; a name taken already gets its value
/// reference behind it.
fn names(variables: &[Variable], prefix: &str) -> Vec<String> {
    let macros = [
        "GUID",
        "MODEL_IDENTIFIER",
        "STOP_TIME",
        "STEP_SIZE",
        "REAL_OUTPUTS",
        "INTEGER_OUTPUTS",
        "FLOAT64_OUTPUTS",
        "MODEL_H",
    ];
    let mut taken: BTreeSet<String> = macros.iter().map(|word| format!("{prefix}_{word}")).collect();
    let mut names = Vec::with_capacity(variables.len());
    for (reference, variable) in variables.iter().enumerate() {
        let mangled: String = variable.name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let mut name = format!("{prefix}_{}", mangled.trim_end_matches('_'));
        while !taken.insert(name.clone()) {
            name = format!("{name}_{reference}");
        }
        names.push(name);
    }
    names
}

/// A C string literal.
fn literal(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace(['\n', '\r'], " "))
}

/// Text that cannot end, nest or continue a comment.
fn comment(text: &str) -> String {
    text.replace("*/", "* /").replace("/*", "/ *").replace(['\n', '\r'], " ").trim_end_matches('\\').to_owned()
}

fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}
