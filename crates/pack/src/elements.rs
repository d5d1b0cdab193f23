//! The parts that the descriptions of FMI 2.0 and 3.0 have in common, and what both demand of a variable table.

use std::{collections::BTreeMap, io};

use quick_xml::Writer;

use crate::error::Error;
use ancf14::fmi::identifier::is_identifier;
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::unit::{display_factor, exponents, natural};
use ancf14::fmi::variable::{Causality, Exponents, Quantity, Variability, Variable};
use ancf14::fmi::{About, Credits, Value, log};

pub(crate) type Xml = Writer<Vec<u8>>;

/// Attributes of one element, in order.
pub(crate) type Attributes<'a> = Vec<(&'static str, std::borrow::Cow<'a, str>)>;

/// What no schema sees of a model.
///
/// # Errors
/// The model identifier is not a C identifier, two variables have one name, a start value is outside its bounds, or a
/// display unit does not measure what its unit measures.
pub(crate) fn check_model(about: &About, variables: &[Variable]) -> Result<(), Error> {
    if !is_identifier(&about.identifier) {
        return Err(Error::Identifier(about.identifier.clone()));
    }
    check_names(variables)?;
    variables.iter().try_for_each(check)
}

/// The text that `write` writes.
pub(crate) fn text(write: impl FnOnce(&mut Xml) -> io::Result<()>) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    write(&mut xml).expect("a Vec takes every byte");
    let mut text = String::from_utf8(xml.into_inner()).expect("only UTF-8 text was written");
    text.push('\n');
    text
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

/// Who made the model, when, and under which terms, as far as it says so.
pub(crate) fn credits(about: &About) -> Attributes<'_> {
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

/// Every unit in use, and `more`, once, by name, with what hosts may show instead.
pub(crate) fn units(xml: &mut Xml, variables: &[Variable], more: &[&str]) -> io::Result<()> {
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
    for name in more {
        units.entry(name).or_insert_with(|| (exponents(name), natural(name).to_vec()));
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
    let Exponents { kg, m, s, kelvin, rad } = exponents;
    let powers = [("kg", kg), ("m", m), ("s", s), ("K", kelvin), ("rad", rad)];
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

/// Order of magnitude of a Real, where it is known.
pub(crate) fn nominal(variable: &Variable) -> Option<(&'static str, std::borrow::Cow<'static, str>)> {
    variable.nominal.map(|nominal| ("nominal", real(nominal).into()))
}

/// Type names must differ from all variable names (section 2.2.3); no variable can be called `ancf14.Force`, because
/// quantities are written small.
pub(crate) fn type_name(quantity: &Quantity) -> Option<String> {
    (!quantity.name.is_empty()).then(|| format!("ancf14.{}", quantity.name))
}

pub(crate) fn log_categories(xml: &mut Xml, standard: Standard) -> io::Result<()> {
    parent(xml, "LogCategories", |xml| {
        for category in log::CATEGORIES {
            let attributes = vec![("name", category.name().into()), ("description", category.description().into())];
            empty(xml, "Category", attributes)?;
        }
        match standard {
            Standard::Fmi2 => {
                empty(xml, "Category", vec![("name", log::ALL.into()), ("description", "All of them".into())])
            }
            // Of FMI 3.0 no name stands for all others.
            Standard::Fmi3 => Ok(()),
        }
    })
}

pub(crate) fn default_experiment(xml: &mut Xml, about: &About) -> io::Result<()> {
    let attributes = vec![
        ("startTime", if about.start == 0.0 { "0".into() } else { real(about.start).into() }),
        ("stopTime", real(about.stop).into()),
        ("tolerance", real(about.tolerance).into()),
        ("stepSize", real(about.output_step).into()),
    ];
    empty(xml, "DefaultExperiment", attributes)
}

/// What the derivatives are.
pub(crate) const DERIVATIVES: [(&str, &str); 3] = [
    (
        "directional",
        "of the outputs at the end of the last communication step by the inputs during it; 0 before the first step",
    ),
    ("directionalInInitializationMode", "of the initial values by inputs and parameters"),
    ("time", "right-hand where they follow from positions and velocities, else over the last communication step"),
];

/// Whether a host may integrate the model: it has states.
pub(crate) fn has_states(variables: &[Variable]) -> bool {
    variables.iter().any(Variable::is_state)
}

/// What the model structure of a unit for both kinds of hosts means.
pub(crate) fn structure_note(variables: &[Variable]) -> Option<(&'static str, std::borrow::Cow<'static, str>)> {
    const NOTE: &str = "those of Model Exchange; in co-simulation an output depends on no input at the same communication point, and \
                        directional derivatives are those of the step";
    has_states(variables).then_some(("dependencies", NOTE.into()))
}

pub(crate) fn initial(variable: &Variable) -> Option<&'static str> {
    match variable.causality {
        Causality::Local if variable.is_state() => Some("exact"),
        Causality::Parameter => Some("exact"),
        Causality::CalculatedParameter | Causality::Output | Causality::Local => Some("calculated"),
        Causality::Input | Causality::Independent => None,
    }
}

pub(crate) fn has_start(variable: &Variable) -> bool {
    matches!(variable.causality, Causality::Parameter | Causality::Input) || variable.is_state()
}

pub(crate) fn is_real(variable: &Variable) -> bool {
    matches!(variable.start, Value::Real(_))
}

/// Shortest text that reads back to the same double.
pub(crate) fn real(number: f64) -> String {
    format!("{number:?}")
}

/// Text on one line without the characters that XML forbids (XML 1.0, section 2.2).
pub(crate) fn clean(text: &str) -> String {
    let is_plain = |character: char| !character.is_control() && !matches!(character, '\u{fffe}' | '\u{ffff}');
    text.chars().map(|character| if is_plain(character) { character } else { ' ' }).collect()
}

pub(crate) fn borrowed<'a>(attributes: &'a Attributes<'_>) -> impl Iterator<Item = (&'a str, &'a str)> {
    attributes.iter().map(|(name, value)| (*name, value.as_ref()))
}

/// The element of a purpose of a unit, `ModelExchange` or `CoSimulation`, with what it can do.
pub(crate) fn interface(xml: &mut Xml, name: &str, about: &About, flags: &[(&str, &str)]) -> io::Result<()> {
    let element = xml.create_element(name).with_attribute(("modelIdentifier", about.identifier.as_str()));
    element.with_attributes(flags.iter().copied()).write_empty()?;
    Ok(())
}

pub(crate) fn empty(xml: &mut Xml, name: &str, attributes: Attributes<'_>) -> io::Result<()> {
    xml.create_element(name).with_attributes(borrowed(&attributes)).write_empty()?;
    Ok(())
}

pub(crate) fn parent(xml: &mut Xml, name: &str, content: impl FnOnce(&mut Xml) -> io::Result<()>) -> io::Result<()> {
    xml.create_element(name).write_inner_content(content)?;
    Ok(())
}
