//! The part of documentation/index.html of a small FMU that is about its linear system.

use std::fmt::{Error, Write};

use quick_xml::escape::escape;

use crate::small::{Origin, Reduction};
use ancf14::fmi::Value;
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::{Causality, Variable};

/// Poles that the page lists.
const POLES: usize = 40;

/// How a linear unit behaves.
const BEHAVIOR: [&str; 10] = [
    "The unit computes small motions about the state above. It knows no large rotations, no stops and no slack: compare it with the FMU of the \
     mechanism at the largest amplitude that you need.",
    "The matrices are in <code>resources/linear.toml</code>, the solver in the library; nothing else has to be installed.",
    "A step has no error but round-off, whatever its length, while inputs are constant or change linearly. Steps of a new length cost more: the unit keeps the \
     matrices of the last four lengths.",
    "Values of inputs and outputs have the meaning that they have in the mechanism: with all inputs at their start values the unit stays in the state above, if that is an equilibrium.",
    "The unit serves co-simulation and Model Exchange. In Model Exchange the host integrates the states, outputs are those of the instant, and directional derivatives are the entries \
     of the matrices. There are no events and no event indicators; enter Event Mode where an input jumps. The sentences on steps and communication points are about co-simulation.",
    "A motion that is prescribed is given by its acceleration. Position and rate follow from it, and begin with their values in the state above.",
    "An input that is set at a communication point acts from the next step on. Outputs are those of the end of the last step, with the inputs that it ended with.",
    "Directional derivatives are exact: of the outputs at the end of the last step by the values of the inputs during it. In Initialization Mode they are those of the initial outputs.",
    "Derivatives of outputs by time are exact, with the rates that the inputs had during the last step.",
    "FMU states can be taken and set at any time, and serialized, also for another process. A step shorter than a millionth of the default communication step is left to the next one.",
];

/// The sentence that FMI 2.0 adds.
const ADDED_FMI2: &str = "Derivatives of inputs by time (<code>fmi2SetRealInputDerivatives</code>) are for the next step only, during which the inputs change linearly.";

/// The sentences of the page.
pub fn behavior(standard: Standard) -> Vec<String> {
    let added = (standard == Standard::Fmi2).then_some(ADDED_FMI2);
    BEHAVIOR.iter().copied().chain(added).map(str::to_owned).collect()
}

/// Writes where the system comes from, its operating point and its poles.
pub fn write(out: &mut String, origin: &Origin, variables: &[Variable]) -> Result<(), Error> {
    let Origin { model, state, order, reduction, poles, warnings } = origin;
    writeln!(
        out,
        "<h2>Linear system</h2>\n<p>The linear system of {} about {}, ",
        escape(model.as_str()),
        escape(state)
    )?;
    match reduction {
        None => writeln!(out, "with all {order} states.</p>")?,
        Some(Reduction { whole, kept, bound, error }) => {
            let kept = if *kept > 0 { format!(", {kept} of them kept exactly") } else { String::new() };
            let bound = match bound {
                Some(bound) => {
                    format!("at most {bound:.1e} of the response to a sudden change of an input, at any frequency")
                }
                None => format!(
                    "{error:.1e} of the response to a sudden change of an input, at the frequencies that were looked at"
                ),
            };
            writeln!(out, "reduced from {whole} states to {order}{kept}. The error of the reduction is {bound}.</p>")?;
        }
    }
    if variables.iter().any(|variable| variable.name == "amplitude_error") {
        writeln!(
            out,
            "<p><code>amplitude_error</code> is the estimated share of nonlinearity in the outputs at the present \
             amplitude, measured by runs of the mechanism: 0.01 is 1 %. A warning appears once above that. The share \
             has the size of the error over one or two periods; outputs with one unit are taken together, and the \
             largest share counts.</p>"
        )?;
    }
    for warning in warnings {
        writeln!(out, "<p>Warning: {}.</p>", escape(warning.trim_end_matches('.')))?;
    }
    writeln!(out, "<h3>Values in that state</h3>\n<table>\n<tr><th>Variable</th><th>Value</th><th>Unit</th></tr>")?;
    for variable in variables.iter().filter(|variable| variable.causality != Causality::Local) {
        let (Value::Real(value), unit) = (variable.start, escape(variable.quantity.unit.as_str())) else { continue };
        let name = escape(variable.name.as_str());
        writeln!(out, "<tr><td><code>{name}</code></td><td>{value:?}</td><td>{unit}</td></tr>")?;
    }
    if poles.is_empty() {
        return writeln!(out, "</table>\n<p>The poles of the linear system are not known.</p>");
    }
    writeln!(
        out,
        "</table>\n<h3>Poles of the linear system</h3>\n<table>\n<tr><th>Frequency Hz</th><th>Damping ratio</th><th>Real 1/s</th></tr>"
    )?;
    for [real, imaginary] in poles.iter().take(POLES) {
        let size = real.hypot(*imaginary);
        let ratio = if size > 0.0 { format!("{:.4}", -real / size) } else { String::new() };
        let frequency = size / std::f64::consts::TAU;
        writeln!(out, "<tr><td>{frequency:.6}</td><td>{ratio}</td><td>{real:.4}</td></tr>")?;
    }
    let more = poles.len().saturating_sub(POLES);
    let more = if more > 0 { format!("<p>And {more} faster ones.</p>") } else { String::new() };
    writeln!(out, "</table>{more}")
}
