//! documentation/index.html of the FMU: what the unit is, how to use it, and every variable, from the variable table.

use std::fmt::Write;

use quick_xml::escape::escape;

use super::{
    About, Value,
    description::{causality, variability},
    variable::{Causality, Variable},
};

/// Look of the page; nothing is loaded from elsewhere.
const STYLE: &str = "body{font:16px/1.5 sans-serif;max-width:70em;margin:2em auto;padding:0 1em}\
table{border-collapse:collapse}th,td{text-align:left;vertical-align:top;padding:.2em .8em .2em 0;border-bottom:1px solid #ccc}\
code{font-size:.95em}";

/// Groups of the variable listing: causality, heading.
const GROUPS: [(Causality, &str); 5] = [
    (Causality::Input, "Inputs"),
    (Causality::Output, "Outputs"),
    (Causality::Parameter, "Parameters"),
    (Causality::CalculatedParameter, "Calculated parameters"),
    (Causality::Independent, "Independent variable"),
];

/// How the unit behaves, as a list of HTML items.
const USAGE: [&str; 8] = [
    "FMI 2.0 for co-simulation. The model is in <code>resources/model.toml</code>, the solver in the library; nothing \
     else has to be installed.",
    "Any communication step is possible; the unit divides it into internal steps of at most \
     <code>simulation.step</code>. On multiples of that step the results do not depend on the communication step.",
    "SI units and radians. Display units are suggestions to the host.",
    "Parameters are set before the end of the initialization, tunable ones also between steps. Inputs keep their value \
     during a step.",
    "The initial state is found at the end of the initialization; outputs are valid from there on.",
    "FMU states can be taken and set at any time, also to go back after a failed step. They cannot be serialized.",
    "A step that fails returns <code>fmi2Error</code> and says why in the log; steps are never discarded.",
    "Input derivatives, output derivatives and directional derivatives are not offered.",
];

/// The page.
pub fn html(about: &About, variables: &[Variable]) -> String {
    let mut out = String::new();
    write_page(&mut out, about, variables).expect("a String takes every text");
    out
}

fn write_page(out: &mut String, about: &About, variables: &[Variable]) -> Result<(), std::fmt::Error> {
    let name = escape(about.name.as_str());
    writeln!(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">")?;
    writeln!(out, "<title>{name}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{name}</h1>")?;
    writeln!(out, "<p>{}</p>", escape(about.description.as_str()))?;
    writeln!(
        out,
        "<p>Made by ancf14 {}. GUID <code>{}</code>.</p>",
        env!("CARGO_PKG_VERSION"),
        escape(about.guid.as_str())
    )?;
    writeln!(out, "<h2>Usage</h2>\n<ul>")?;
    for item in USAGE {
        writeln!(out, "<li>{item}</li>")?;
    }
    writeln!(out, "</ul>")?;
    writeln!(
        out,
        "<p>Default experiment: from 0 to {:?} s, communication step {:?} s.</p>",
        about.stop, about.output_step
    )?;
    for (causality, heading) in GROUPS {
        table(out, heading, causality, variables)?;
    }
    writeln!(out, "</body>\n</html>")
}

fn table(out: &mut String, heading: &str, wanted: Causality, variables: &[Variable]) -> Result<(), std::fmt::Error> {
    let mut rows = variables.iter().enumerate().filter(|(_, variable)| variable.causality == wanted).peekable();
    if rows.peek().is_none() {
        return Ok(());
    }
    writeln!(out, "<h2>{heading}</h2>\n<table>")?;
    writeln!(out, "<tr><th>Name</th><th>Reference</th><th>Type</th><th>Unit</th><th>Start</th><th>Meaning</th></tr>")?;
    for (reference, variable) in rows {
        writeln!(
            out,
            "<tr><td><code>{}</code></td><td>{reference}</td><td>{} {}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            escape(variable.name.as_str()),
            variability(variable.variability),
            variable.type_name(),
            escape(variable.quantity.unit.as_str()),
            start(variable),
            escape(variable.description.as_str()),
        )?;
    }
    writeln!(out, "</table>")
}

/// Start value with its bounds, of what the host can set.
fn start(variable: &Variable) -> String {
    if !matches!(causality(variable.causality), "parameter" | "input") {
        return String::new();
    }
    let number = match variable.start {
        Value::Real(number) => format!("{number:?}"),
        Value::Integer(number) => number.to_string(),
    };
    match (variable.min, variable.max) {
        (None, None) => number,
        (Some(min), None) => format!("{number} (at least {min})"),
        (None, Some(max)) => format!("{number} (at most {max})"),
        (Some(min), Some(max)) => format!("{number} ({min} to {max})"),
    }
}
