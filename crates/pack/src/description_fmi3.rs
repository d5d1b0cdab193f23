//! modelDescription.xml of FMI 3.0 (sections 2.4 and 4.4), from the same variable table as that of FMI 2.0: elements of
//! one array become one variable, and references stay the same.
//!
//! The same model gives the same bytes. A capability flag is true only where the function behind it does the work.

use std::{collections::BTreeMap, io};

use quick_xml::events::{BytesDecl, Event};

use crate::elements::{
    Attributes, DERIVATIVES, Xml, borrowed, check_model, clean, credits, default_experiment, empty, has_start,
    has_states, initial, interface, is_real, log_categories, nominal, parent, real, structure_note, text, type_name,
    units,
};
use crate::error::Error;
use ancf14::fmi::About;
use ancf14::fmi::arrays::{Array, arrays, time_reference};
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::{Causality, Quantity, Variability, Variable};

/// Unit of the independent variable.
const SECOND: &str = "s";

/// What descriptions say of the first one of the points along a beam.
const STATION: &str = ", station 1 of ";

/// The text of modelDescription.xml.
///
/// # Errors
/// As [`crate::description::xml`].
pub fn xml(about: &About, variables: &[Variable]) -> Result<String, Error> {
    check_model(about, variables)?;
    Ok(text(|xml| document(xml, about, variables)))
}

fn document(xml: &mut Xml, about: &About, variables: &[Variable]) -> io::Result<()> {
    let arrays = arrays(variables);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = xml
        .create_element("fmiModelDescription")
        .with_attribute(("fmiVersion", "3.0"))
        .with_attribute(("modelName", clean(&about.name).as_str()))
        .with_attribute(("instantiationToken", about.guid.as_str()))
        .with_attribute(("description", clean(&about.description).as_str()))
        .with_attributes(borrowed(&credits(about)))
        .with_attribute(("generationTool", concat!("ancf14 ", env!("CARGO_PKG_VERSION"))))
        .with_attribute(("variableNamingConvention", "structured"));
    root.write_inner_content(|xml| {
        if has_states(variables) {
            model_exchange(xml, about)?;
        }
        co_simulation(xml, about)?;
        units(xml, variables, &[SECOND])?;
        types(xml, variables)?;
        log_categories(xml, Standard::Fmi3)?;
        default_experiment(xml, about)?;
        parent(xml, "ModelVariables", |xml| {
            if time_reference(variables) == variables.len() {
                time(xml, variables.len())?;
            }
            arrays.iter().try_for_each(|array| variable(xml, array, variables))
        })?;
        structure(xml, &arrays, variables)?;
        annotations(xml, variables)
    })?;
    Ok(())
}

/// What the unit can do where the host integrates its states.
fn model_exchange(xml: &mut Xml, about: &About) -> io::Result<()> {
    let flags = [
        ("needsExecutionTool", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "true"),
        ("providesAdjointDerivatives", "true"),
        ("providesPerElementDependencies", "true"),
        ("needsCompletedIntegratorStep", "false"),
        ("providesEvaluateDiscreteStates", "false"),
    ];
    interface(xml, "ModelExchange", about, &flags)
}

/// What the unit can do. It has no events, and never returns early by itself.
fn co_simulation(xml: &mut Xml, about: &About) -> io::Result<()> {
    let flags = [
        ("needsExecutionTool", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "true"),
        ("providesAdjointDerivatives", "true"),
        ("providesPerElementDependencies", "true"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("maxOutputDerivativeOrder", "1"),
        ("providesIntermediateUpdate", "true"),
        ("mightReturnEarlyFromDoStep", "false"),
        ("canReturnEarlyAfterIntermediateUpdate", "true"),
        ("hasEventMode", "false"),
        ("providesEvaluateDiscreteStates", "false"),
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
            let mut attributes: Attributes<'_> = vec![("name", name.into()), ("quantity", quantity.name.into())];
            if !quantity.unit.is_empty() {
                attributes.push(("unit", quantity.unit.as_str().into()));
            }
            empty(xml, "Float64Type", attributes)?;
        }
        Ok(())
    })
}

/// The independent variable, which the standard demands.
fn time(xml: &mut Xml, reference: usize) -> io::Result<()> {
    let attributes = vec![
        ("name", "time".into()),
        ("valueReference", reference.to_string().into()),
        ("description", "Simulation time, s".into()),
        ("causality", "independent".into()),
        ("variability", "continuous".into()),
        ("unit", SECOND.into()),
    ];
    empty(xml, "Float64", attributes)
}

/// A variable: its first element says what all of them are, but for their start values.
fn variable(xml: &mut Xml, array: &Array<'_>, variables: &[Variable]) -> io::Result<()> {
    let elements = &variables[array.first..array.first + array.elements()];
    let first = &elements[0];
    let mut attributes: Attributes<'_> =
        vec![("name", array.name.into()), ("valueReference", array.first.to_string().into())];
    let description = description(array, elements);
    if !description.is_empty() {
        attributes.push(("description", clean(&description).into()));
    }
    attributes.push(("causality", first.causality.word().into()));
    attributes.push(("variability", first.variability.word().into()));
    if let Some(initial) = initial(first) {
        attributes.push(("initial", initial.into()));
    }
    if is_between(first) {
        attributes.push(("intermediateUpdate", "true".into()));
    }
    attributes.extend(type_attributes(elements));
    let kind = if is_real(first) { "Float64" } else { "Int32" };
    let element = xml.create_element(kind).with_attributes(borrowed(&attributes));
    if array.dimensions.is_empty() {
        element.write_empty()?;
    } else {
        element.write_inner_content(|xml| {
            let start = |extent: &usize| vec![("start", extent.to_string().into())];
            array.dimensions.iter().try_for_each(|extent| empty(xml, "Dimension", start(extent)))
        })?;
    }
    Ok(())
}

/// Meaning of an array: that of its first element without the place of that element. Where a word in the middle tells
/// elements apart, all of them are listed: "Force of load tip along global x, y, z".
pub(crate) fn description(array: &Array<'_>, elements: &[Variable]) -> String {
    let whole = &elements[0].description;
    if array.dimensions.is_empty() {
        return whole.clone();
    }
    let Some(whole) = whole.strip_suffix(", component 1").or_else(|| whole.contains(STATION).then_some(whole)) else {
        return listed(elements).unwrap_or_else(|| whole.clone());
    };
    match whole.split_once(STATION) {
        Some((before, rest)) => format!("{before}, {rest}"),
        None => whole.to_owned(),
    }
}

/// The sentence of elements whose descriptions differ in one word, with the words of all; none: they do not.
fn listed(elements: &[Variable]) -> Option<String> {
    let [first, second, ..] = elements else { return None };
    let words = first.description.split(' ');
    let place = words.zip(second.description.split(' ')).position(|(word, other)| word != other)?;
    let mut list: Vec<&str> = Vec::new();
    let mut sentence = Vec::new();
    for element in elements {
        let mut words: Vec<&str> = element.description.split(' ').collect();
        let word = std::mem::take(words.get_mut(place)?);
        // A comma belongs to the sentence.
        let (word, comma) = word.strip_suffix(',').map_or((word, ""), |word| (word, ","));
        words[place] = comma;
        if list.is_empty() {
            sentence = words;
        } else if sentence != words {
            return None;
        }
        list.push(word);
    }
    let all = list.join(", ") + sentence[place];
    sentence[place] = &all;
    Some(sentence.join(" "))
}

/// Whether an intermediate update can read or set it.
fn is_between(variable: &Variable) -> bool {
    matches!(variable.causality, Causality::Input | Causality::Output)
        && variable.variability == Variability::Continuous
}

fn type_attributes(elements: &[Variable]) -> Attributes<'_> {
    let variable = &elements[0];
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
        // One order of magnitude is written for all elements.
        if elements.iter().all(|element| element.nominal == variable.nominal) {
            attributes.extend(nominal(variable));
        }
    }
    if let Some(min) = variable.min {
        attributes.push(("min", number(min).into()));
    }
    if let Some(max) = variable.max {
        attributes.push(("max", number(max).into()));
    }
    if has_start(variable) {
        let starts: Vec<String> = elements.iter().map(|element| number(element.start.number())).collect();
        attributes.push(("start", starts.join(" ").into()));
    }
    if let Some(state) = variable.derivative_of {
        attributes.push(("derivative", state.to_string().into()));
    }
    attributes
}

/// Outputs of a mechanism depend on nothing within the same communication point; those of a linear system, and the
/// derivatives of its states, depend on states and inputs. What the initial values depend on is always said,
/// since importers as CasADi do not know that no list means everything that is given: of an array what any of its
/// elements depends on.
fn structure(xml: &mut Xml, arrays: &[Array<'_>], variables: &[Variable]) -> io::Result<()> {
    // The variable that each row is an element of.
    let owners: Vec<usize> = arrays.iter().flat_map(|array| vec![array.first; array.elements()]).collect();
    let outputs = arrays.iter().filter(|array| variables[array.first].causality == Causality::Output);
    let derivatives = arrays.iter().filter(|array| variables[array.first].derivative_of.is_some());
    // The variables that any of these rows is an element of.
    let list = |mut known: Vec<usize>| {
        known.sort_unstable();
        known.dedup();
        known.iter().map(usize::to_string).collect::<Vec<_>>().join(" ")
    };
    let elements = |array: &Array<'_>| &variables[array.first..array.first + array.elements()];
    let owners = &owners;
    let is_unknown = |array: &&Array<'_>| initial(&variables[array.first]) == Some("calculated");
    let is_given = |array: &&Array<'_>| has_start(&variables[array.first]);
    let given: Vec<usize> = arrays.iter().filter(is_given).map(|array| array.first).collect();
    let reference = |array: &Array<'_>| array.first.to_string();
    parent(xml, "ModelStructure", |xml| {
        let outputs = outputs.map(|array| ("Output", array));
        for (name, array) in outputs.chain(derivatives.map(|array| ("ContinuousStateDerivative", array))) {
            let known = elements(array).iter().flat_map(|element| &element.follows_from).map(|row| owners[*row]);
            let known = list(known.collect());
            empty(xml, name, vec![("valueReference", reference(array).into()), ("dependencies", known.into())])?;
        }
        for unknown in arrays.iter().filter(is_unknown) {
            let mut attributes: Attributes<'_> = vec![("valueReference", reference(unknown).into())];
            let rows: Option<Vec<&Vec<usize>>> =
                elements(unknown).iter().map(|element| element.found_from.as_ref()).collect();
            let known = match rows {
                Some(rows) => rows.into_iter().flatten().map(|row| owners[*row]).collect(),
                None => given.clone(),
            };
            attributes.push(("dependencies", list(known).into()));
            empty(xml, "InitialUnknown", attributes)?;
        }
        Ok(())
    })
}

/// What the standard's own attributes cannot say of derivatives.
fn annotations(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    parent(xml, "Annotations", |xml| {
        let annotation = xml.create_element("Annotation").with_attribute(("type", "ancf14.derivatives"));
        annotation.write_inner_content(|xml| {
            let texts = DERIVATIVES.map(|(key, text)| (key, text.into()));
            empty(xml, "Derivatives", texts.into_iter().chain(structure_note(variables)).collect())
        })?;
        Ok(())
    })
}
