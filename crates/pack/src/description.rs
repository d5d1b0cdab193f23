//! modelDescription.xml (FMI 2.0, sections 2.2 and 4.3), from the same variable table that the instance answers from.
//!
//! Explicit causality, variability and initial wherever the standard allows them (it forbids `initial` for inputs and
//! the independent variable). The same model gives the same bytes: a date is the model's own. A capability flag is
//! true only where the function behind it does the work.

use std::{borrow::Cow, collections::BTreeMap, io};

use quick_xml::events::{BytesDecl, Event};

use crate::elements::{
    Attributes, DERIVATIVES, Xml, borrowed, check_model, clean, credits, default_experiment, empty, has_start,
    has_states, initial, interface, is_real, log_categories, nominal, parent, real, structure_note, text, type_name,
    units,
};
use crate::error::Error;
use ancf14::fmi::About;
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::{Causality, Quantity, Variable};

/// The text of modelDescription.xml.
///
/// # Errors
/// The model identifier is not a C identifier, two variables have one name, a start value is outside its bounds, or a
/// display unit does not measure what its unit measures.
pub fn xml(about: &About, variables: &[Variable]) -> Result<String, Error> {
    check_model(about, variables)?;
    Ok(text(|xml| document(xml, about, variables)))
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
    let exchange = has_states(variables);
    let root = if exchange { root.with_attribute(("numberOfEventIndicators", "0")) } else { root };
    root.write_inner_content(|xml| {
        if exchange {
            model_exchange(xml, about)?;
        }
        co_simulation(xml, about)?;
        units(xml, variables, &[])?;
        types(xml, variables)?;
        log_categories(xml, Standard::Fmi2)?;
        default_experiment(xml, about)?;
        annotations(xml, variables)?;
        parent(xml, "ModelVariables", |xml| {
            variables.iter().enumerate().try_for_each(|(reference, variable)| scalar_variable(xml, reference, variable))
        })?;
        parent(xml, "ModelStructure", |xml| model_structure(xml, variables))
    })?;
    Ok(())
}

/// What the unit can do where the host integrates its states.
fn model_exchange(xml: &mut Xml, about: &About) -> io::Result<()> {
    let flags = [
        ("needsExecutionTool", "false"),
        ("completedIntegratorStepNotNeeded", "true"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ];
    interface(xml, "ModelExchange", about, &flags)
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
    interface(xml, "CoSimulation", about, &flags)
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

/// The namespace of the annotation: VDMCheck takes an element without one for an element of the standard, and gives
/// no verdict.
const NAMESPACE: [(&str, Cow<'static, str>); 1] = [("xmlns:ancf14", Cow::Borrowed("urn:ancf14"))];

/// What the standard's own attributes cannot say: outputs depend on no input at the same communication point, and the
/// directional derivative there is that of a whole step.
fn annotations(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    parent(xml, "VendorAnnotations", |xml| {
        let tool = xml.create_element("Tool").with_attribute(("name", "ancf14"));
        tool.write_inner_content(|xml| {
            let texts = DERIVATIVES.map(|(key, text)| (key, text.into()));
            empty(
                xml,
                "ancf14:Derivatives",
                NAMESPACE.into_iter().chain(texts).chain(structure_note(variables)).collect(),
            )
        })?;
        Ok(())
    })
}

fn scalar_variable(xml: &mut Xml, reference: usize, variable: &Variable) -> io::Result<()> {
    let mut attributes: Attributes<'_> =
        vec![("name", variable.name.as_str().into()), ("valueReference", reference.to_string().into())];
    if !variable.description.is_empty() {
        attributes.push(("description", clean(&variable.description).into()));
    }
    attributes.push(("causality", variable.causality.word().into()));
    attributes.push(("variability", variable.variability.word().into()));
    if let Some(initial) = initial(variable) {
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
        attributes.extend(nominal(variable));
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
    if let Some(state) = variable.derivative_of {
        attributes.push(("derivative", (state + 1).to_string().into())); // the standard counts from 1
    }
    attributes
}

/// Outputs of a mechanism depend on nothing within the same communication point; those of a linear system, and the
/// derivatives of its states, depend on states and inputs. What the initial values depend on is said where it is
/// less than everything that is given, which the standard reads where nothing is said.
fn model_structure(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    let places = |wanted: fn(&Variable) -> bool| -> Vec<usize> {
        let chosen = variables.iter().enumerate().filter(|(_, variable)| wanted(variable));
        chosen.map(|(place, _)| place).collect()
    };
    let index = |place: usize| (place + 1).to_string(); // the standard counts from 1
    let outputs = places(|variable| variable.causality == Causality::Output);
    let derivatives = places(|variable| variable.derivative_of.is_some());
    let list = |places: &[usize]| places.iter().map(|place| index(*place)).collect::<Vec<_>>().join(" ");
    let unknowns = places(|variable| initial(variable) == Some("calculated"));
    for (group, rows) in [("Outputs", outputs), ("Derivatives", derivatives)] {
        if rows.is_empty() {
            continue;
        }
        parent(xml, group, |xml| {
            rows.iter().try_for_each(|place| {
                let dependencies = list(&variables[*place].follows_from);
                empty(xml, "Unknown", vec![("index", index(*place).into()), ("dependencies", dependencies.into())])
            })
        })?;
    }
    if !unknowns.is_empty() {
        parent(xml, "InitialUnknowns", |xml| {
            unknowns.iter().try_for_each(|place| {
                let mut attributes: Attributes<'_> = vec![("index", index(*place).into())];
                if let Some(found_from) = &variables[*place].found_from {
                    attributes.push(("dependencies", list(found_from).into()));
                }
                empty(xml, "Unknown", attributes)
            })
        })?;
    }
    Ok(())
}
