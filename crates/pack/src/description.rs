//! modelDescription.xml (FMI 2.0, sections 2.2 and 4.3), from the same variable table that the instance answers from.
//!
//! Explicit causality, variability and initial wherever the standard allows them (it forbids `initial` for inputs and
//! the independent variable). The same model gives the same bytes: a date is the model's own. A capability flag is
//! true only where the function behind it does the work.

use std::{collections::BTreeMap, io};

use quick_xml::{
    Writer,
    events::{BytesDecl, Event},
};

use crate::error::Error;
use ancf14::fmi::identifier::is_identifier;
use ancf14::fmi::unit::{display_factor, natural};
use ancf14::fmi::variable::{Causality, Exponents, Quantity, Variability, Variable};
use ancf14::fmi::{About, Credits, Value, log};

type Xml = Writer<Vec<u8>>;

/// Attributes of one element, in order.
type Attributes<'a> = Vec<(&'static str, std::borrow::Cow<'a, str>)>;

/// The text of modelDescription.xml.
///
/// # Errors
/// The model identifier is not a C identifier, two variables have one name, a start value is outside its bounds, or a
/// display unit does not measure what its unit measures.
pub fn xml(about: &About, variables: &[Variable]) -> Result<String, Error> {
    if !is_identifier(&about.identifier) {
        return Err(Error::Identifier(about.identifier.clone()));
    }
    check_names(variables)?;
    variables.iter().try_for_each(check)?;
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    document(&mut xml, about, variables).expect("a Vec takes every byte");
    let mut text = String::from_utf8(xml.into_inner()).expect("only UTF-8 text was written");
    text.push('\n');
    Ok(text)
}

/// Names are unique (section 2.2.7).
fn check_names(variables: &[Variable]) -> Result<(), Error> {
    let mut first = BTreeMap::new();
    for (reference, variable) in variables.iter().enumerate() {
        if let Some(earlier) = first.insert(variable.name.as_str(), reference) {
            return Err(wrong(variable, format!("value references {earlier} and {reference} share this name")));
        }
    }
    Ok(())
}

/// What no schema sees: start within the bounds, a fitting display unit, a variability that the type can have.
fn check(variable: &Variable) -> Result<(), Error> {
    let (low, high) = (variable.min.unwrap_or(f64::NEG_INFINITY), variable.max.unwrap_or(f64::INFINITY));
    let start = variable.start.number();
    if low > high {
        return Err(wrong(variable, format!("its smallest value {low} is above its largest value {high}")));
    }
    if has_start(variable) && !(start.is_finite() && (low..=high).contains(&start)) {
        return Err(wrong(variable, format!("its start value {start} is not between {low} and {high}")));
    }
    if let Some(display) = &variable.display_unit
        && display_factor(&variable.quantity.unit, display).is_none()
    {
        let unit = &variable.quantity.unit;
        return Err(wrong(variable, format!("the display unit `{display}` does not convert to its unit `{unit}`")));
    }
    if matches!(variable.start, Value::Integer(_)) && variable.variability == Variability::Continuous {
        return Err(wrong(variable, "an Integer cannot be continuous".to_owned()));
    }
    Ok(())
}

fn wrong(variable: &Variable, problem: String) -> Error {
    Error::Variable { name: variable.name.clone(), problem }
}

fn document(xml: &mut Xml, about: &About, variables: &[Variable]) -> io::Result<()> {
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = xml
        .create_element("fmiModelDescription")
        .with_attribute(("fmiVersion", "2.0"))
        .with_attribute(("modelName", clean(&about.name).as_str()))
        .with_attribute(("guid", about.guid.as_str()))
        .with_attribute(("description", clean(&about.description).as_str()))
        .with_attributes(borrowed(&credits(about)))
        .with_attribute(("generationTool", concat!("ancf14 ", env!("CARGO_PKG_VERSION"))))
        .with_attribute(("variableNamingConvention", "structured"));
    root.write_inner_content(|xml| {
        co_simulation(xml, about)?;
        units(xml, variables)?;
        types(xml, variables)?;
        log_categories(xml)?;
        default_experiment(xml, about)?;
        annotations(xml)?;
        parent(xml, "ModelVariables", |xml| {
            variables.iter().enumerate().try_for_each(|(reference, variable)| scalar_variable(xml, reference, variable))
        })?;
        parent(xml, "ModelStructure", |xml| model_structure(xml, variables))
    })?;
    Ok(())
}

/// Who made the model, when, and under which terms, as far as it says so.
fn credits(about: &About) -> Attributes<'_> {
    let Credits { author, version, license, copyright, date } = &about.credits;
    let list = [
        ("author", author),
        ("version", version),
        ("copyright", copyright),
        ("license", license),
        ("generationDateAndTime", date),
    ];
    let said = list.into_iter().filter_map(|(key, text)| text.as_ref().map(|text| (key, clean(text).into())));
    said.collect()
}

/// What the unit can do: all but asynchronous steps.
fn co_simulation(xml: &mut Xml, about: &About) -> io::Result<()> {
    let flags = [
        ("needsExecutionTool", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", "true"),
        ("maxOutputDerivativeOrder", "1"),
        ("canRunAsynchronuously", "false"), // the standard's spelling
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ];
    let element = xml.create_element("CoSimulation").with_attribute(("modelIdentifier", about.identifier.as_str()));
    element.with_attributes(flags).write_empty()?;
    Ok(())
}

/// Every unit in use, once, by name, with what hosts may show instead.
fn units(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    let mut units: BTreeMap<&str, (Option<Exponents>, Vec<&str>)> = BTreeMap::new();
    for variable in variables.iter().filter(|variable| is_real(variable) && !variable.quantity.unit.is_empty()) {
        let Quantity { unit, exponents, .. } = &variable.quantity;
        let (_, shown) = units.entry(unit).or_insert_with(|| (*exponents, natural(unit).to_vec()));
        if let Some(display) = &variable.display_unit
            && !shown.contains(&display.as_str())
        {
            shown.push(display);
        }
    }
    if units.is_empty() {
        return Ok(());
    }
    parent(xml, "UnitDefinitions", |xml| {
        units.iter().try_for_each(|(name, (exponents, shown))| unit(xml, name, *exponents, shown))
    })
}

fn unit(xml: &mut Xml, name: &str, exponents: Option<Exponents>, shown: &[&str]) -> io::Result<()> {
    let element = xml.create_element("Unit").with_attribute(("name", name));
    let Some(exponents) = exponents else {
        element.write_empty()?;
        return Ok(());
    };
    let powers = [("kg", exponents.kg), ("m", exponents.m), ("s", exponents.s), ("rad", exponents.rad)];
    let powers: Attributes<'_> = powers
        .into_iter()
        .filter(|(_, power)| *power != 0)
        .map(|(base, power)| (base, power.to_string().into()))
        .collect();
    element.write_inner_content(|xml| {
        empty(xml, "BaseUnit", powers)?;
        for display in shown {
            if let Some(factor) = display_factor(name, display) {
                empty(xml, "DisplayUnit", vec![("name", (*display).into()), ("factor", real(factor).into())])?;
            }
        }
        Ok(())
    })?;
    Ok(())
}

/// One type for each kind of quantity.
fn types(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    let mut types: BTreeMap<String, &Quantity> = BTreeMap::new();
    for variable in variables.iter().filter(|variable| is_real(variable)) {
        if let Some(name) = type_name(&variable.quantity) {
            types.entry(name).or_insert(&variable.quantity);
        }
    }
    if types.is_empty() {
        return Ok(());
    }
    parent(xml, "TypeDefinitions", |xml| {
        for (name, quantity) in &types {
            let element = xml.create_element("SimpleType").with_attribute(("name", name.as_str()));
            let mut attributes: Attributes<'_> = vec![("quantity", quantity.name.into())];
            if !quantity.unit.is_empty() {
                attributes.push(("unit", quantity.unit.as_str().into()));
            }
            element.write_inner_content(|xml| empty(xml, "Real", attributes))?;
        }
        Ok(())
    })
}

/// Type names must differ from all variable names (section 2.2.3); no variable can be called `ancf14.Force`, because
/// quantities are written small.
fn type_name(quantity: &Quantity) -> Option<String> {
    (!quantity.name.is_empty()).then(|| format!("ancf14.{}", quantity.name))
}

fn log_categories(xml: &mut Xml) -> io::Result<()> {
    parent(xml, "LogCategories", |xml| {
        for category in log::CATEGORIES {
            let attributes = vec![("name", category.name().into()), ("description", category.description().into())];
            empty(xml, "Category", attributes)?;
        }
        empty(xml, "Category", vec![("name", log::ALL.into()), ("description", "All of them".into())])
    })
}

fn default_experiment(xml: &mut Xml, about: &About) -> io::Result<()> {
    let attributes = vec![
        ("startTime", "0".into()),
        ("stopTime", real(about.stop).into()),
        ("tolerance", real(about.tolerance).into()),
        ("stepSize", real(about.output_step).into()),
    ];
    empty(xml, "DefaultExperiment", attributes)
}

/// What the standard's own attributes cannot say: outputs depend on no input at the same communication point, and the directional derivative
/// there is that of a whole step.
fn annotations(xml: &mut Xml) -> io::Result<()> {
    parent(xml, "VendorAnnotations", |xml| {
        let tool = xml.create_element("Tool").with_attribute(("name", "ancf14"));
        tool.write_inner_content(|xml| {
            empty(xml, "Derivatives", DERIVATIVES.map(|(key, text)| (key, text.into())).into())
        })?;
        Ok(())
    })
}

/// What the derivatives are.
const DERIVATIVES: [(&str, &str); 3] = [
    (
        "directional",
        "of the outputs at the end of the last communication step by the inputs during it; 0 before the first step",
    ),
    ("directionalInInitializationMode", "of the initial values by inputs and parameters"),
    ("time", "right-hand where they follow from positions and velocities, else over the last internal step"),
];

fn scalar_variable(xml: &mut Xml, reference: usize, variable: &Variable) -> io::Result<()> {
    let mut attributes: Attributes<'_> =
        vec![("name", variable.name.as_str().into()), ("valueReference", reference.to_string().into())];
    if !variable.description.is_empty() {
        attributes.push(("description", clean(&variable.description).into()));
    }
    attributes.push(("causality", variable.causality.word().into()));
    attributes.push(("variability", variable.variability.word().into()));
    if let Some(initial) = initial(variable.causality) {
        attributes.push(("initial", initial.into()));
    }
    let element = xml.create_element("ScalarVariable").with_attributes(borrowed(&attributes));
    element.write_inner_content(|xml| empty(xml, variable.type_name(), type_attributes(variable)))?;
    Ok(())
}

fn type_attributes(variable: &Variable) -> Attributes<'_> {
    let number = |number: f64| if is_real(variable) { real(number) } else { number.to_string() };
    let mut attributes: Attributes<'_> = Vec::new();
    if is_real(variable) {
        if let Some(name) = type_name(&variable.quantity) {
            attributes.push(("declaredType", name.into()));
        }
        if !variable.quantity.unit.is_empty() {
            attributes.push(("unit", variable.quantity.unit.as_str().into()));
        }
        if let Some(display) = &variable.display_unit {
            attributes.push(("displayUnit", display.as_str().into()));
        }
    }
    if let Some(min) = variable.min {
        attributes.push(("min", number(min).into()));
    }
    if let Some(max) = variable.max {
        attributes.push(("max", number(max).into()));
    }
    if has_start(variable) {
        attributes.push(("start", number(variable.start.number()).into()));
    }
    attributes
}

/// Outputs depend on nothing within the same communication point. What the initial values depend on is said where it is less than everything
/// that is given, which the standard reads where nothing is said.
fn model_structure(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    let places = |wanted: fn(&Variable) -> bool| -> Vec<usize> {
        let chosen = variables.iter().enumerate().filter(|(_, variable)| wanted(variable));
        chosen.map(|(place, _)| place).collect()
    };
    let index = |place: usize| (place + 1).to_string(); // the standard counts from 1
    let outputs = places(|variable| variable.causality == Causality::Output);
    let unknowns = places(|variable| initial(variable.causality) == Some("calculated"));
    if !outputs.is_empty() {
        parent(xml, "Outputs", |xml| {
            outputs.iter().try_for_each(|place| {
                empty(xml, "Unknown", vec![("index", index(*place).into()), ("dependencies", "".into())])
            })
        })?;
    }
    if !unknowns.is_empty() {
        parent(xml, "InitialUnknowns", |xml| {
            unknowns.iter().try_for_each(|place| {
                let mut attributes: Attributes<'_> = vec![("index", index(*place).into())];
                if let Some(found_from) = &variables[*place].found_from {
                    let indices: Vec<String> = found_from.iter().map(|known| index(*known)).collect();
                    attributes.push(("dependencies", indices.join(" ").into()));
                }
                empty(xml, "Unknown", attributes)
            })
        })?;
    }
    Ok(())
}

fn initial(causality: Causality) -> Option<&'static str> {
    match causality {
        Causality::Parameter => Some("exact"),
        Causality::CalculatedParameter | Causality::Output => Some("calculated"),
        Causality::Input | Causality::Independent => None,
    }
}

fn has_start(variable: &Variable) -> bool {
    matches!(variable.causality, Causality::Parameter | Causality::Input)
}

fn is_real(variable: &Variable) -> bool {
    matches!(variable.start, Value::Real(_))
}

/// Shortest text that reads back to the same double.
fn real(number: f64) -> String {
    format!("{number:?}")
}

/// Text on one line without the characters that XML forbids (XML 1.0, section 2.2).
fn clean(text: &str) -> String {
    let is_plain = |character: char| !character.is_control() && !matches!(character, '\u{fffe}' | '\u{ffff}');
    text.chars().map(|character| if is_plain(character) { character } else { ' ' }).collect()
}

fn borrowed<'a>(attributes: &'a Attributes<'_>) -> impl Iterator<Item = (&'a str, &'a str)> {
    attributes.iter().map(|(name, value)| (*name, value.as_ref()))
}

fn empty(xml: &mut Xml, name: &str, attributes: Attributes<'_>) -> io::Result<()> {
    xml.create_element(name).with_attributes(borrowed(&attributes)).write_empty()?;
    Ok(())
}

fn parent(xml: &mut Xml, name: &str, content: impl FnOnce(&mut Xml) -> io::Result<()>) -> io::Result<()> {
    xml.create_element(name).write_inner_content(content)?;
    Ok(())
}
