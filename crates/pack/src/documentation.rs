//! documentation/index.html of the FMU: what the unit is, how it is used and coupled, and every variable, from the
//! variable table.

use std::fmt::{Error, Write};

use quick_xml::escape::escape;

use crate::contents::{Contents, LICENCES_FILE};
use crate::description_fmi3::description;
use crate::documentation_linear;
use ancf14::fmi::arrays::{Array, arrays};
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::{Causality, Variable};
use ancf14::fmi::{About, Credits, Value};

/// Look of the page; nothing is loaded from elsewhere.
const STYLE: &str = "body{font:16px/1.5 sans-serif;max-width:70em;margin:2em auto;padding:0 1em;color:#222}\
h2{margin-top:2em}table{border-collapse:collapse}\
th,td{text-align:left;vertical-align:top;padding:.2em .8em .2em 0;border-bottom:1px solid #ccc}\
code,pre{font-size:.9em}td code{white-space:nowrap}pre{background:#f4f4f4;padding:.8em;overflow-x:auto}\
figure{margin:1em 0}figure svg{max-width:100%;height:auto;border:1px solid #ccc}iframe{width:100%;height:34em;border:1px solid #ccc}figcaption{color:#555;font-size:.9em}";

/// Groups of the variable listing: causality, heading, anchor.
const GROUPS: [(Causality, &str, &str); 6] = [
    (Causality::Input, "Inputs", "inputs"),
    (Causality::Output, "Outputs", "outputs"),
    (Causality::Parameter, "Parameters", "parameters"),
    (Causality::CalculatedParameter, "Calculated parameters", "calculated"),
    (Causality::Local, "States and their rates", "states"),
    (Causality::Independent, "Independent variable", "independent"),
];

/// How a unit of FMI 2.0 behaves.
const BEHAVIOR: [&str; 12] = [
    "FMI 2.0 for co-simulation. The model is in <code>resources/model.toml</code>, the solver in the library; nothing else has to be \
     installed.",
    "Any communication step is possible; the unit divides it into internal steps. With a parameter <code>simulation.step</code> they are at most that long, and on its \
     multiples the results do not depend on the communication step, as long as inputs do not change. With <code>simulation.accuracy</code> the unit chooses them, and a host's relative tolerance \
     (<code>fmi2SetupExperiment</code>) takes the place of that parameter.",
    "What a host moves goes through each communication step on a cubic: its velocity has no jumps, and constant accelerations are followed \
     exactly. The velocity at the end follows from the mean velocities of this step and the last one. It begins at rest, or with the derivatives \
     that the host sets for the first step. A jump of an input is reached at the end of the step too; within the next one the motion overshoots by a quarter of it.",
    "Parameters are set before the end of the initialization, tunable ones also between steps.",
    "The initial state is found at the end of the initialization, from what is set until then; outputs are valid from there on.",
    "FMU states can be taken and set at any time, also to go back after a failed step, and serialized, also for another process.",
    "A communication step shorter than a millionth of <code>simulation.step</code>, or without it of the default communication step, is done at once: the unit keeps its time and makes up for it in the \
     next step that is long enough. So a host that adds up its time may end with a step of round-off, and no short step is lost.",
    "A call that succeeds returns <code>fmi2OK</code>. Warnings go to the logger with the status <code>fmi2Warning</code> and the category \
     <code>logStatusWarning</code>; <code>fmi2Warning</code> is returned only where the host asks for something odd: results before the \
     initialization, an unknown log category.",
    "Output derivatives (<code>fmi2GetRealOutputDerivatives</code>) are of order 1: exact for what follows from positions and velocities (position, \
     displacement, velocity, rotation, quaternion, angular velocity, angle, distance, strains, section forces, stress, energies); for \
     accelerations, reactions, efforts and momenta, and for everything in a static analysis, the difference quotient of the last internal step, or, \
     before there is one, of the first internal step with unchanged inputs (0 where that step fails).",
    "Directional derivatives (<code>fmi2GetDirectionalDerivative</code>) are those of the last communication step, all its internal steps \
     together: of the outputs at its end by the values of the inputs during it. At one communication point no output depends on an input: the \
     description says so by <code>dependencies=\"\"</code>, and by an annotation that the derivative is that of the step. Before the first step it is 0. A tunable \
     parameter that is set after a step does not change the derivatives of that step.",
    "In Initialization Mode directional derivatives are those of the initial values of outputs and calculated parameters, by inputs and \
     parameters: differences of initial states, right to about four digits.",
    "A step that fails returns <code>fmi2Error</code> and says why in the log; steps are never discarded. Handles of instances and states that are \
     not alive are refused.",
];

/// What is different in a unit of FMI 3.0: beginnings of the sentences above, and what stands there instead; nothing
/// leaves the sentence out.
const BEHAVIOR_FMI3: [(&str, &str); 4] = [
    (
        "What a host moves goes",
        "What a host moves goes through each communication step on a cubic: its velocity has no jumps, and constant accelerations are followed \
         exactly. The velocity at the end follows from the mean velocities of this step and the last one. It begins at rest. A jump of an input is \
         reached at the end of the step too; within the next one the motion overshoots by a quarter of it.",
    ),
    (
        "A call that succeeds returns",
        "A call that succeeds returns <code>fmi3OK</code>. Warnings go to the logger with the status <code>fmi3Warning</code> and the category \
         <code>logStatusWarning</code> where the host has switched logging on; <code>fmi3Warning</code> is returned only for unknown log categories.",
    ),
    (
        "A step that fails",
        "A step that fails returns <code>fmi3Error</code> and says why in the log; steps are never discarded. Other calls that fail change nothing, and the \
         instance goes on. Handles of instances and states that are not alive are refused.",
    ),
    (
        "In Initialization Mode",
        "In Initialization Mode directional and adjoint derivatives are those of the initial values of outputs and calculated parameters, with respect \
         to inputs and parameters: differences of initial states, right to about four digits.",
    ),
];

/// What only FMI 3.0 has.
const ADDED_FMI3: [&str; 4] = [
    "Vectors, quaternions and the stations of a beam are arrays. The reference of an array is that of its first element in FMI 2.0.",
    "Adjoint derivatives (<code>fmi3GetAdjointDerivative</code>) are products with the same derivatives of the step as directional ones, transposed.",
    "If the host passes an <code>intermediateUpdate</code> function, the unit calls it after each internal step. Outputs and their derivatives can be read \
     there, and the communication step can be ended there: <code>fmi3DoStep</code> then returns early at that time, also if a later time was asked for.",
    "There are no events, clocks, structural parameters, Model Exchange and scheduled execution; their functions return <code>fmi3Error</code>.",
];

/// Functions of FMI 2.0 with their names in FMI 3.0.
const NAMES_FMI3: [(&str, &str); 3] = [
    ("fmi2SetupExperiment", "fmi3EnterInitializationMode"),
    ("fmi2GetRealOutputDerivatives", "fmi3GetOutputDerivatives"),
    ("fmi2", "fmi3"),
];

/// Kinds of inputs: what they are, what becomes of the value, what becomes of its derivative.
const INPUTS: [[&str; 3]; 5] = [
    ["forces and moments", "held during the step", "added, linearly in time"],
    [
        "positions, angles, distances",
        "reached at the <em>end</em> of the step, smoothly from the value before: set the value of the end of the step, or accept one \
         step of delay",
        "the end value is the value plus its derivative times the step",
    ],
    [
        "orientations: quaternions of any length, or rotation vectors",
        "the same, along the shortest arc; a quaternion of 0 leaves the orientation as it is, with a warning",
        "the same",
    ],
    ["rates", "integrated exactly, the rate being reached at the end of the step in the same way", "the same"],
    [
        "<code>active</code> of joints, locks and drives",
        "engaged from 0.5 on, released below, at the <em>start</em> of the step",
        "not used",
    ],
];

/// What every number means.
const SIGNS: [&str; 5] = [
    "SI units and radians. Display units (deg, mm, kN ...) are suggestions to the host.",
    "Vectors have components along the global axes x, y, z as <code>[1]</code>, <code>[2]</code>, <code>[3]</code> if their description names no other \
     axes; quaternions are w, x, y, z.",
    "Forces and moments that are inputs act on the part that the load is at. A moment counts about the axis by the right hand.",
    "Reactions are the force, and the moment about the joint's place, on side b of a joint; at a moving frame what the frame must supply. \
     Applied forces and moments are the same with the other sign: what side a receives, or whatever moves the frame.",
    "Inside a beam axial force is positive in tension; strains are positive in elongation.",
];

/// Ways to connect one end: what goes in, what comes out, when to take it, where it is in the model file.
const COUPLING: [[&str; 4]; 5] = [
    [
        "force and moment",
        "motion",
        "the other side knows force laws: actuators, contact, fluids",
        "a load with <code>input = true</code> and an output there",
    ],
    [
        "motion",
        "force and moment",
        "the other side moves the end whatever it takes: robot hands, moorings, prescribed bases",
        "a frame with <code>input = true</code>, a joint to it, <code>applied_force</code> and <code>applied_moment</code> of the frame",
    ],
    [
        "effort",
        "angle or distance, and its rate",
        "motors and cylinders under a controller",
        "an actuator with <code>input = true</code>, an output at its joint",
    ],
    ["angle or distance", "effort", "drives under position control", "a drive with <code>input</code>, its effort"],
    [
        "motion, through a bushing",
        "force of the bushing",
        "explicit masters: the advised default, since the bushing between the moving frame and the end keeps the loop of two units stable",
        "a frame with <code>input = true</code>, a bushing to it",
    ],
];

/// How C programs get the names of the variables of a model file.
const HEADER: &str = "<p><code>ancf14 header model.toml -o model.h</code> writes names for the GUID or token and the references below.</p>\n";

/// The page of a unit of a version of the standard.
pub fn html(standard: Standard, about: &About, variables: &[Variable], contents: &Contents<'_>) -> String {
    let mut out = String::new();
    write_page(&mut out, standard, about, variables, contents).expect("a String takes every text");
    out
}

/// How a unit behaves, a sentence or more each.
fn behavior(standard: Standard) -> Vec<String> {
    let fmi2 = BEHAVIOR.iter().map(|text| (*text).to_owned());
    match standard {
        Standard::Fmi2 => fmi2.collect(),
        Standard::Fmi3 => {
            let other = |text: String| {
                let instead = BEHAVIOR_FMI3.iter().find(|(start, _)| text.starts_with(start));
                instead.map_or(text, |(_, instead)| (*instead).to_owned())
            };
            let renamed = |text: String| {
                let text = text.replace("FMI 2.0 for co-simulation", "FMI 3.0 for co-simulation");
                NAMES_FMI3.iter().fold(text, |text, (old, new)| text.replace(old, new))
            };
            fmi2.map(other).map(renamed).chain(ADDED_FMI3.iter().map(|text| (*text).to_owned())).collect()
        }
    }
}

fn write_page(
    out: &mut String,
    standard: Standard,
    about: &About,
    variables: &[Variable],
    contents: &Contents<'_>,
) -> Result<(), Error> {
    let name = escape(about.name.as_str());
    writeln!(out, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">")?;
    writeln!(out, "<title>{name}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{name}</h1>")?;
    writeln!(out, "<p>{}</p>", escape(about.description.as_str()))?;
    let Credits { author, version, license, copyright, date } = &about.credits;
    let said =
        [("Author", author), ("Version", version), ("License", license), ("Copyright", copyright), ("Date", date)];
    let said: Vec<String> =
        said.iter().filter_map(|(word, text)| Some(format!("{word}: {}.", escape(text.as_ref()?.as_str())))).collect();
    if !said.is_empty() {
        writeln!(out, "<p>{}</p>", said.join(" "))?;
    }
    // A page in the page: it has its own style, its policy lets it load nothing, and its sandbox keeps it apart from
    // this one.
    let page = contents.page.replace('&', "&amp;").replace('\'', "&#39;");
    let (drawing, legend) = (contents.drawing, escape(contents.legend));
    let may = "allow-scripts allow-downloads allow-forms";
    writeln!(out, "<figure>\n<iframe title=\"The mechanism as drawn\" sandbox=\"{may}\" srcdoc='{page}'></iframe>")?;
    writeln!(
        out,
        "<figcaption>{legend}</figcaption>\n<details><summary>Drawing</summary>\n{drawing}</details>\n</figure>"
    )?;
    let [start, stop, step] = [about.start, about.stop, about.output_step];
    writeln!(out, "<p>Default experiment: from {start} to {stop:?} s, communication step {step:?} s. On this page:")?;
    let rows = rows_of(standard, variables);
    let heading = |(causality, heading, anchor): &(Causality, &str, &str)| {
        let count = rows.iter().filter(|row| variables[row.first].causality == *causality).count();
        (count > 0).then(|| format!("<a href=\"#{anchor}\">{} ({count})</a>", heading.to_lowercase()))
    };
    writeln!(out, "{}.</p>", GROUPS.iter().filter_map(heading).collect::<Vec<_>>().join(", "))?;
    let inputs = variables.iter().any(|variable| variable.causality == Causality::Input);
    if let Some(origin) = contents.linear {
        documentation_linear::write(out, origin, variables)?;
        list(out, "How it behaves", &documentation_linear::behavior(standard))?;
        list(out, "Units, axes, signs", &SIGNS.map(str::to_owned))?;
        return write_end(out, standard, about, variables, "");
    }
    list(out, "How it behaves", &behavior(standard))?;
    match standard {
        Standard::Fmi2 if inputs => {
            table_of(
                out,
                "Inputs during a step",
                &["Input", "Value", "Derivative, of <code>fmi2SetRealInputDerivatives</code>"],
                &INPUTS,
            )?;
            writeln!(
                out,
                "<p>A derivative is for the next step only. Until the end of the initialization inputs are the initial values.</p>"
            )?;
        }
        Standard::Fmi3 if inputs => {
            table_of(
                out,
                "Inputs during a step",
                &["Input", "Value"],
                &INPUTS.map(|[input, value, _]| [input, value]),
            )?;
            writeln!(out, "<p>Until the end of the initialization inputs are the initial values.</p>")?;
        }
        _ => (),
    }
    list(out, "Units, axes, signs", &SIGNS.map(str::to_owned))?;
    table_of(out, "Coupling with other units", &["In", "Out", "For", "In the model file"], &COUPLING)?;
    writeln!(
        out,
        "<p>The choice is the model file's, for each end by itself. Masters that repeat a step take an FMU state before it; the directional \
         derivatives of the step are the interface Jacobian that they iterate with.</p>"
    )?;
    write_end(out, standard, about, variables, HEADER)
}

/// The end of all pages: hosts, variables, who made it.
fn write_end(
    out: &mut String,
    standard: Standard,
    about: &About,
    variables: &[Variable],
    header: &str,
) -> Result<(), Error> {
    hosts(out, standard, about, variables)?;
    out.push_str(header);
    let rows = rows_of(standard, variables);
    for group in &GROUPS {
        table(out, standard, group, &rows, variables)?;
    }
    writeln!(
        out,
        "<h2>Made by</h2>\n<p>ancf14 {}. GUID <code>{}</code>. <a href=\"{LICENCES_FILE}\">Licences</a> of the software in the \
         libraries.</p>",
        env!("CARGO_PKG_VERSION"),
        escape(about.guid.as_str())
    )?;
    writeln!(out, "</body>\n</html>")
}

/// The variables of a unit.
fn rows_of(standard: Standard, variables: &[Variable]) -> Vec<Array<'_>> {
    match standard {
        Standard::Fmi2 => {
            let names = variables.iter().map(|variable| variable.name.as_str()).enumerate();
            names.map(|(first, name)| Array { name, first, dimensions: Vec::new() }).collect()
        }
        Standard::Fmi3 => arrays(variables),
    }
}

fn list(out: &mut String, heading: &str, items: &[String]) -> Result<(), Error> {
    writeln!(out, "<h2>{heading}</h2>\n<ul>")?;
    items.iter().try_for_each(|item| writeln!(out, "<li>{item}</li>"))?;
    writeln!(out, "</ul>")
}

fn table_of<const N: usize>(
    out: &mut String,
    heading: &str,
    titles: &[&str; N],
    rows: &[[&str; N]],
) -> Result<(), Error> {
    writeln!(out, "<h2>{heading}</h2>\n<table>\n<tr><th>{}</th></tr>", titles.join("</th><th>"))?;
    rows.iter().try_for_each(|cells| writeln!(out, "<tr><td>{}</td></tr>", cells.join("</td><td>")))?;
    writeln!(out, "</table>")
}

/// What to type or click in five hosts.
fn hosts(out: &mut String, standard: Standard, about: &About, variables: &[Variable]) -> Result<(), Error> {
    let About { identifier, start, stop, output_step: step, .. } = about;
    // A scalar, which has the same name in both versions.
    let mut scalars = rows_of(standard, variables).into_iter().filter(|row| row.dimensions.is_empty());
    let parameter = scalars.find(|row| variables[row.first].causality == Causality::Parameter);
    let parameter = parameter.map(|row| &variables[row.first]);
    let start_values = parameter.map_or(String::new(), |variable| {
        format!(",\n    start_values={{\"{}\": {}}}", escape(variable.name.as_str()), number(variable.start))
    });
    writeln!(out, "<h2>In hosts</h2>\n<p>FMPy (Python):</p>")?;
    writeln!(
        out,
        "<pre>from fmpy import simulate_fmu\nresult = simulate_fmu(\"{identifier}.fmu\", stop_time={stop:?}, \
         output_interval={step:?}{start_values})</pre>"
    )?;
    writeln!(out, "<p>OMSimulator (Lua):</p>")?;
    writeln!(
        out,
        "<pre>oms_newModel(\"m\")\noms_addSystem(\"m.root\", oms_system_wc)\n\
         oms_addSubModel(\"m.root.unit\", \"{identifier}.fmu\")\noms_setFixedStepSize(\"m.root\", {step:?})\n\
         oms_setStopTime(\"m\", {stop:?})\noms_instantiate(\"m\")\noms_initialize(\"m\")\noms_simulate(\"m\")\n\
         oms_terminate(\"m\")\noms_delete(\"m\")</pre>"
    )?;
    writeln!(
        out,
        "<p>Simulink: an FMU block (Simulink, FMU Import) with this file; its communication step size is {step:?} s, parameters and \
         inputs are in its dialog. Dymola and other Modelica tools: import the FMU for co-simulation, with the same communication step.</p>"
    )?;
    let name = match standard {
        Standard::Fmi2 => "2.0",
        Standard::Fmi3 => "3.0",
    };
    writeln!(
        out,
        "<p>C: unzip the file, load the library of the platform under <code>binaries/</code>, and call the functions of FMI {name}:</p>"
    )?;
    let guid = escape(about.guid.as_str());
    match standard {
        Standard::Fmi2 => writeln!(
            out,
            "<pre>c = fmi2Instantiate(\"{identifier}\", fmi2CoSimulation, \"{guid}\",\n\
             \x20                   \"file:///path/to/resources\", &amp;callbacks, fmi2False, fmi2False);\nfmi2SetupExperiment(c, fmi2False, 0.0, {start:?}, fmi2True, {stop:?});\nfmi2EnterInitializationMode(c);\n\
             fmi2ExitInitializationMode(c);\nfmi2DoStep(c, {start:?}, {step:?}, fmi2True);</pre>",
        ),
        Standard::Fmi3 => writeln!(
            out,
            "<pre>c = fmi3InstantiateCoSimulation(\"{identifier}\", \"{guid}\",\n\
             \x20                               \"/path/to/resources/\", fmi3False, fmi3True, fmi3False, fmi3False,\n\
             \x20                               NULL, 0, NULL, log_message, NULL);\nfmi3EnterInitializationMode(c, fmi3False, 0.0, {start:?}, fmi3True, {stop:?});\n\
             fmi3ExitInitializationMode(c);\nfmi3DoStep(c, {start:?}, {step:?}, fmi3True, &amp;event, &amp;end, &amp;early, &amp;time);</pre>",
        ),
    }
}

fn table(
    out: &mut String,
    standard: Standard,
    &(wanted, heading, anchor): &(Causality, &str, &str),
    rows: &[Array<'_>],
    variables: &[Variable],
) -> Result<(), Error> {
    let mut rows = rows.iter().filter(|row| variables[row.first].causality == wanted).peekable();
    if rows.peek().is_none() {
        return Ok(());
    }
    writeln!(out, "<h2 id=\"{anchor}\">{heading}</h2>\n<table>")?;
    writeln!(out, "<tr><th>Name</th><th>Reference</th><th>Type</th><th>Unit</th><th>Start</th><th>Meaning</th></tr>")?;
    for row @ Array { name, first, dimensions } in rows {
        let elements = &variables[*first..first + dimensions.iter().product::<usize>()];
        let variable = &elements[0];
        let extents: Vec<String> = dimensions.iter().map(usize::to_string).collect();
        let size = if extents.is_empty() { String::new() } else { format!(", array of {}", extents.join(" x ")) };
        writeln!(
            out,
            "<tr><td><code>{}</code></td><td>{first}</td><td>{} {}{size}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            escape(*name),
            variable.variability.word(),
            variable.type_name_in(standard),
            escape(variable.quantity.unit.as_str()),
            start(elements),
            escape(description(row, elements).as_str()),
        )?;
    }
    writeln!(out, "</table>")
}

fn number(value: Value) -> String {
    match value {
        Value::Real(number) => format!("{number:?}"),
        Value::Integer(number) => number.to_string(),
    }
}

/// Start value with its bounds, of what the host can set.
fn start(elements: &[Variable]) -> String {
    let variable = &elements[0];
    if !matches!(variable.causality.word(), "parameter" | "input") {
        return String::new();
    }
    let number = elements.iter().map(|element| number(element.start)).collect::<Vec<_>>().join(", ");
    match (variable.min, variable.max) {
        (None, None) => number,
        (Some(min), None) => format!("{number} (at least {min})"),
        (None, Some(max)) => format!("{number} (at most {max})"),
        (Some(min), Some(max)) => format!("{number} ({min} to {max})"),
    }
}
